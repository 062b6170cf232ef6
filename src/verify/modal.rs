//! Compares the modal state at a cut: tool, registers, work offset, spindle, coolant, compensation, feed.

use super::cooled;
use super::cut::{Cut, State, is_length, number};
use super::expectation::taps_ahead;
use super::sides::{Sides, Unnamed};
use super::tables::{PITCH, ROUNDED};
use crate::diag::Code;
use crate::nc::Rotation;
use crate::toolpath::{self, FeedMode, Plane};

/// A difference between two states: the code, the correction, and the message.
type Differs = (Code, &'static str, String);

/// Compares tool, work offset, spindle, coolant and compensation. `tap`: the cut is made by a tap, so feed and speed
/// define the pitch of the thread.
pub(super) fn compare(s: &mut Sides<'_>, cut: &Cut, found: &Cut, tap: bool) {
    let both = [cut.state.clone(), found.state.clone()];
    let before = std::mem::replace(&mut s.before, found.state.clone());
    if s.agreed.as_ref() == Some(&both) {
        s.agreed = Some(both); // the next comparison needs only the pointers
        return;
    }
    let states = both.each_ref().map(|state| &**state);
    let mut agree = true;
    let checks = [
        tool(states, s),
        offsets(states, s),
        unsaid(&before, states),
        turning(states),
        coolant(states),
        rigid(states, tap, s),
        into_tap(states),
        compensation(states),
    ];
    for (code, help, message) in checks.into_iter().flatten() {
        agree = false;
        s.found(code, found.line, help, || message.clone());
    }
    if tap && states[0].rigid == Some(false) && states[1].rigid == Some(true) {
        s.report.allowed.taps += 1;
        agree = false; // count each cut
    }
    agree &= speed(s, cut, found, tap);
    s.agreed = agree.then_some(both);
}

fn tool([wanted, is]: [&State; 2], s: &Sides<'_>) -> Option<Differs> {
    let wanted = wanted.tool.filter(|_| s.tools)?;
    let message = match is.tool {
        Some(is) if is == wanted => return None,
        Some(is) => format!("tool {} cuts, but the job has tool {} here", s.program.tool_text(is), number(wanted)),
        None => format!("no tool is loaded, but the job has tool {} here", number(wanted)),
    };
    Some((Code::PV012, "print T[tool] M6 in the tool change", message))
}

fn offsets([wanted, is]: [&State; 2], s: &mut Sides<'_>) -> Option<Differs> {
    if let Some(differs) = length([wanted.length, is.length], s) {
        return Some(differs);
    }
    let a = wanted.work.filter(|_| wanted.work != is.work)?;
    let is = is.work.map_or("not printed".to_owned(), |b| b.to_string());
    let message = format!("the work offset is {is}, but {a} in the job");
    Some((Code::PV012, "print G[work] in the tool change, or in the sequence `Upon [work]`", message))
}

/// Compares the length registers. If the job is an NC program, also compares whether the length offset is on: other
/// jobs contain no code for it, and a length offset that is off is a hazard of the program.
/// Helps of the findings about the register of the tool length.
pub(super) const TOOL_LENGTH: &str = "print G43 H[lcomp] in the tool change";
pub(super) const WITHOUT: &str = "remove G43, or check the job: its tool cuts without its length";

fn length([wanted, is]: [Option<f64>; 2], s: &mut Sides<'_>) -> Option<Differs> {
    if s.unnamed == Unnamed::NoneSoFar && wanted.is_some() {
        s.unnamed = Unnamed::Off;
    }
    // the register of a tool without a number is part of the finding about the tool
    if is_length(wanted, is) || is.is_some_and(|is| s.program.is_name(is)) {
        return None;
    }
    let is_off = |is: f64| format!("the length offset is H{}, but off in the job", number(is));
    let (help, message) = match (wanted, is) {
        (Some(0.0), Some(b)) => (WITHOUT, is_off(b)),
        (Some(a), Some(b)) => {
            (TOOL_LENGTH, format!("the length offset is H{}, but the job's tool has H{}", number(b), number(a)))
        }
        _ if s.unnamed != Unnamed::Off => return None,
        (Some(a), None) => (
            "write G43 H before the cut, also after a move to the machine zero that ends the offset",
            format!("the length offset is off, but the job's tool cuts with H{}", number(a)),
        ),
        (None, _) => (WITHOUT, is_off(is.unwrap_or_default())),
    };
    Some((Code::PV014, help, message))
}

/// A value that the job does not contain must not change in the program: a tool has one length register, and a job
/// without work offsets is cut in one offset.
fn unsaid(before: &State, [wanted, is]: [&State; 2]) -> Option<Differs> {
    if let (Some(a), Some(b)) = (before.work, is.work)
        && a != b
        && wanted.work.is_none()
    {
        let message = format!("the work offset changes from {a} to {b}, but the job has one work offset");
        return Some((Code::PV012, "give the operations of the job their `work`, or print one work offset", message));
    }
    let (a, b) = (before.length?, is.length?);
    if a == b || wanted.length.is_some() || before.tool != is.tool {
        return None;
    }
    let message = format!("the length offset of the tool changes from H{} to H{}", number(a), number(b));
    Some((Code::PV014, "print one length register for each tool", message))
}

fn turning([wanted, is]: [&State; 2]) -> Option<Differs> {
    if let (Some(a), Some(b)) = (wanted.rotation, is.rotation)
        && a != b
    {
        let message = format!("the spindle is {}, but {} in the job", b.name(), a.name());
        return Some((Code::PV011, "print M[direct] with the speed", message));
    }
    if wanted.speed.is_none() || wanted.css == is.css {
        let limit = wanted.limit.filter(|limit| wanted.css && is.limit != Some(*limit))?;
        let said = is.limit.map_or("none".to_owned(), |is| number(is).to_string());
        let message = format!("the speed limit of the spindle is {said}, but {} in the job", number(limit));
        return Some((Code::PV011, "print G50 S[maxrpm] before the surface speed", message));
    }
    let [is, wanted] = [is, wanted].map(|state| if state.css { "a surface speed" } else { "in revolutions" });
    Some((Code::PV011, "print G[speedtype]", format!("the spindle speed is {is}, but {wanted} in the job")))
}

fn speed(s: &mut Sides<'_>, cut: &Cut, found: &Cut, tap: bool) -> bool {
    let wanted = cut.state.speed.filter(|_| cut.state.rotation != Some(Rotation::Stop));
    let (Some(a), Some(b)) = (wanted, found.state.speed) else { return true };
    if (a - b).abs() <= (if tap { PITCH } else { ROUNDED } * a).max(0.5) {
        return true;
    }
    // a tap with the same feed and another speed has another pitch
    if !tap && s.own[1].says(a, cut.by[0], |own| (own - b).abs() <= 0.5) {
        s.report.allowed.speeds += 1;
        return false; // count each cut
    }
    s.found(Code::PV011, found.line, "print S[speed]", || {
        format!("the spindle speed is S{}, but {} in the job", number(b), number(a))
    });
    false
}

fn coolant(states: [&State; 2]) -> Option<Differs> {
    let message = cooled::differs(states)?;
    Some((Code::PV024, "print M[cool] in the tool change, and after a stop", message))
}

/// Compares the spindle before a floating tap. A floating tap starts with the rotation that is already on.
fn into_tap([wanted, is]: [&State; 2]) -> Option<Differs> {
    let (a, b) = (wanted.into_tap?, is.into_tap?);
    let message = format!("the spindle is {} before the floating tap, but {} in the job", b.name(), a.name());
    (a != b).then_some((Code::PV011, "print M[direct] before the tap, and no M5 after it", message))
}

fn rigid([wanted, is]: [&State; 2], tap: bool, s: &Sides<'_>) -> Option<Differs> {
    if !tap || wanted.rigid != Some(true) || is.rigid != Some(false) {
        return None;
    }
    let (help, message) = match taps_ahead(s.program.control()) {
        true => (
            "print M29 S[speed] before the tap; if the cycle alone is rigid on this machine, write `rigid = true` into its row \
             in a control file: `postform explain PF446` shows the row",
            "the job's tap is rigid, but the program has no M29 to synchronize feed and spindle",
        ),
        false => (
            "print the control's cycle for rigid taps, or write `\"rigid\": false` into the job",
            "the job's tap is rigid, but the program taps with the cycle for a floating holder",
        ),
    };
    Some((Code::PV011, help, message.to_owned()))
}

fn compensation([wanted, is]: [&State; 2]) -> Option<Differs> {
    if let (Some(a), Some(b)) = (wanted.side, is.side)
        && a != b
    {
        let name = |side: Option<toolpath::Side>| side.map_or("off", toolpath::Side::name);
        let message = format!("cutter compensation is {}, but {} in the job", name(b), name(a));
        return Some((Code::PV018, "check InFeed and OutFeed", message));
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
    let message = format!("cutter compensation uses register {b}, but the job's tool has D{}", number(a));
    Some((Code::PV018, "print D[dcomp] in InFeed", message))
}

/// Compares the feeds of two cuts, within the allowed rounding.
pub(super) fn feeds(s: &mut Sides<'_>, cut: &Cut, found: &Cut, tap: bool) {
    let (Some(wanted), Some(mut is)) = (cut.feed, found.feed) else { return };
    let typed = is;
    // the feed of a tap defines its pitch, per minute or per revolution
    let speed = found.state.speed.filter(|speed| tap && !found.state.css && *speed > 0.0);
    if cut.mode != found.mode {
        match (cut.mode, found.mode, speed) {
            (FeedMode::PerMinute, FeedMode::PerRev, Some(speed)) => is *= speed,
            (FeedMode::PerRev, FeedMode::PerMinute, Some(speed)) => is /= speed,
            _ => {
                s.found(Code::PV006, found.line, "print G[feedtype]", || {
                    "the feed mode is different (per minute, per revolution or inverse time)".to_owned()
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
        format!("the feed is {}, but {} in the job", number(is), number(wanted))
    });
}

/// Whether a cut of the program has the job's feed. If the feed modes differ, the feeds are not compared.
pub(super) fn has_feed(cut: &Cut, found: &Cut, tap: bool) -> bool {
    match (cut.feed, found.feed) {
        (Some(wanted), Some(is)) => cut.mode != found.mode || is_feed(wanted, is, tap),
        _ => true,
    }
}

/// Whether a feed equals the required feed within the allowed rounding.
pub(super) fn is_feed(wanted: f64, is: f64, tap: bool) -> bool {
    (wanted - is).abs() <= (if tap { PITCH } else { ROUNDED } * wanted).max(1e-9)
}
