//! What is in force at a cut: tool, registers, work offset, spindle, coolant, compensation, feed.

use super::cut::{Cut, State, number};
use super::sides::Sides;
use super::tables::{PITCH, ROUNDED};
use crate::diag::Code;
use crate::nc::{Cooling, Rotation};
use crate::toolpath::{self, FeedMode, Plane};

/// A difference of two states: code, what to do, what differs.
type Differs = (Code, &'static str, String);

/// Tool, work offset, spindle, coolant, compensation. `tap`: feed and speed are its pitch.
pub(super) fn compare(s: &mut Sides<'_>, cut: &Cut, found: &Cut, tap: bool) {
    let both = [cut.state.clone(), found.state.clone()];
    s.before = found.state.clone();
    if s.agreed.as_ref() == Some(&both) {
        s.agreed = Some(both); // alike at a glance the next time
        return;
    }
    let states = both.each_ref().map(|state| &**state);
    let mut agree = true;
    let tools = s.tools;
    let checks = [
        tool(states, tools),
        offsets(states),
        turning(states),
        coolant(states),
        rigid(states, tap),
        into_tap(states),
        compensation(states),
    ];
    for (code, help, message) in checks.into_iter().flatten() {
        agree = false;
        s.found(code, found.line, help, || message.clone());
    }
    agree &= speed(s, cut, found, tap);
    s.agreed = agree.then_some(both);
}

fn tool([wanted, is]: [&State; 2], tools: bool) -> Option<Differs> {
    let wanted = wanted.tool.filter(|_| tools)?;
    let message = match is.tool {
        Some(is) if is == wanted => return None,
        Some(is) => format!("tool {} cuts, the job has tool {} here", number(is), number(wanted)),
        None => format!("no tool was loaded, the job has tool {} here", number(wanted)),
    };
    Some((Code::PV012, "print T[tool] M6 in the tool change", message))
}

fn offsets([wanted, is]: [&State; 2]) -> Option<Differs> {
    if let (Some(a), Some(b)) = (wanted.length, is.length)
        && a != b
    {
        let message = format!("the length offset is H{}, the job's tool has H{}", number(b), number(a));
        return Some((Code::PV014, "print G43 H[lcomp] in the tool change", message));
    }
    let a = wanted.work.filter(|_| wanted.work != is.work)?;
    let is = is.work.map_or("none that the program says".to_owned(), |b| b.to_string());
    let message = format!("the work offset is {is}, the job's is {a}");
    Some((Code::PV012, "print G[work] in the tool change, or in `Upon [work]`", message))
}

fn turning([wanted, is]: [&State; 2]) -> Option<Differs> {
    if let (Some(a), Some(b)) = (wanted.rotation, is.rotation)
        && a != b
    {
        let message = format!("the spindle is {}, the job wants {}", b.name(), a.name());
        return Some((Code::PV011, "print M[direct] with the speed", message));
    }
    if wanted.speed.is_none() || wanted.css == is.css {
        let limit = wanted.limit.filter(|limit| wanted.css && is.limit != Some(*limit))?;
        let said = is.limit.map_or("none".to_owned(), |is| number(is).to_string());
        let message = format!("the highest speed of the spindle is {said}, the job's {}", number(limit));
        return Some((Code::PV011, "print G50 S[maxrpm] before the surface speed", message));
    }
    let counts = if is.css { "at the surface (G96)" } else { "turns" };
    Some((Code::PV011, "print G[speedtype]", format!("the speed counts {counts}, the job's does not")))
}

fn speed(s: &mut Sides<'_>, cut: &Cut, found: &Cut, tap: bool) -> bool {
    let wanted = cut.state.speed.filter(|_| cut.state.rotation != Some(Rotation::Stop));
    let (Some(a), Some(b)) = (wanted, found.state.speed) else { return true };
    if (a - b).abs() <= (if tap { PITCH } else { ROUNDED } * a).max(0.5) {
        return true;
    }
    // a tap whose feed stays cuts another thread
    if !tap && s.own[1].says(a, cut.by[0], |own| (own - b).abs() <= 0.5) {
        s.report.allowed.speeds += 1;
        return false; // each cut is counted
    }
    s.found(Code::PV011, found.line, "print S[speed]", || {
        format!("the spindle turns S{}, the job wants {}", number(b), number(a))
    });
    false
}

fn coolant([wanted, is]: [&State; 2]) -> Option<Differs> {
    let (a, b) = (wanted.coolant?, is.coolant?);
    // what a job does not ask for may be on: it is only wet
    if a == b || a == Cooling::Off {
        return None;
    }
    let message = format!("the coolant is {}, the job wants {}", b.name(), a.name());
    Some((Code::PV024, "print M[cool] in the tool change, and after a stop", message))
}

/// A floating tap goes in as the spindle turns already.
fn into_tap([wanted, is]: [&State; 2]) -> Option<Differs> {
    let (a, b) = (wanted.into_tap?, is.into_tap?);
    let message = format!("the spindle is {} before the floating tap, the job wants {}", b.name(), a.name());
    (a != b).then_some((Code::PV011, "print M[direct] before the tap, and no M5 after it", message))
}

fn rigid([wanted, is]: [&State; 2], tap: bool) -> Option<Differs> {
    if !tap || wanted.rigid != Some(true) || is.rigid != Some(false) {
        return None;
    }
    let message = "the job's tap is rigid, and no M29 keeps feed and spindle in step".to_owned();
    Some((Code::PV011, "print M29 S[speed] before the tap", message))
}

fn compensation([wanted, is]: [&State; 2]) -> Option<Differs> {
    if let (Some(a), Some(b)) = (wanted.side, is.side)
        && a != b
    {
        let name = |side: Option<toolpath::Side>| match side {
            None => "off",
            Some(toolpath::Side::Left) => "left",
            Some(toolpath::Side::Right) => "right",
        };
        let message = format!("cutter compensation is {}, the job wants {}", name(b), name(a));
        return Some((Code::PV018, "look at InFeed and OutFeed", message));
    }
    if wanted.side.flatten().is_some() && is.plane != wanted.plane {
        let (help, name) = match wanted.plane {
            Plane::Xz => ("print G18 before it", "ZX"),
            _ => ("print G17 before it", "XY"),
        };
        return Some((Code::PV018, help, format!("cutter compensation is in another plane than {name}")));
    }
    let a = wanted.diameter.filter(|_| wanted.diameter != is.diameter)?;
    let b = is.diameter.map_or("none".to_owned(), |b| format!("D{}", number(b)));
    let message = format!("cutter compensation takes register {b}, the job's tool has D{}", number(a));
    Some((Code::PV018, "print D[dcomp] in InFeed", message))
}

/// The feed, within what its digits are rounded off.
pub(super) fn feeds(s: &mut Sides<'_>, cut: &Cut, found: &Cut, tap: bool) {
    let (Some(wanted), Some(mut is)) = (cut.feed, found.feed) else { return };
    let typed = is;
    // a tap's feed is its pitch, however it counts
    let speed = found.state.speed.filter(|speed| tap && !found.state.css && *speed > 0.0);
    if cut.mode != found.mode {
        match (cut.mode, found.mode, speed) {
            (FeedMode::PerMinute, FeedMode::PerRev, Some(speed)) => is *= speed,
            (FeedMode::PerRev, FeedMode::PerMinute, Some(speed)) => is /= speed,
            _ => {
                s.found(Code::PV006, found.line, "print G[feedtype]", || {
                    "feeds count otherwise: per minute, per turn or inverse time".to_owned()
                });
                return;
            }
        }
    }
    if is_feed(wanted, is, tap) {
        return;
    }
    if !tap && s.own[0].says(wanted, cut.by[1], |own| is_feed(own, typed, true)) {
        s.report.allowed.feeds += 1;
        return;
    }
    s.found(Code::PV006, found.line, "print F[frate] where the feed changes", || {
        format!("the feed is {}, the job's {}", number(is), number(wanted))
    });
}

/// Is the feed of a cut the job's, as far as both count it alike?
pub(super) fn has_feed(cut: &Cut, found: &Cut) -> bool {
    match (cut.feed, found.feed) {
        (Some(wanted), Some(is)) => cut.mode != found.mode || is_feed(wanted, is, false),
        _ => true,
    }
}

/// Is a feed the wanted one, but for its digits?
pub(super) fn is_feed(wanted: f64, is: f64, tap: bool) -> bool {
    (wanted - is).abs() <= (if tap { PITCH } else { ROUNDED } * wanted).max(1e-9)
}
