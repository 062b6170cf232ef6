//! What is in force at a cut: tool, registers, work offset, spindle, compensation, feed.

use std::io::{BufRead, Seek};

use super::comparer::{Counts, Sides};
use super::cut::{Cut, number};
use crate::diag::{Code, Diag};
use crate::toolpath::{self, FeedMode, StopKind};

/// How far feeds and speeds may be off for their digits.
const ROUNDED: f64 = 0.01;
/// The same where feed and speed make a pitch.
const PITCH: f64 = 0.0025;

impl<R: BufRead + Seek> Sides<R> {
    /// Tool, work offset, spindle, compensation. `tap`: feed and speed are its pitch.
    pub(super) fn states(&mut self, cut: &Cut, found: &Cut, tap: bool) -> Result<(), Box<Diag>> {
        let (wanted, is) = (&cut.state, &found.state);
        let line = found.line;
        if let Some(missing) = self.stops.iter().find(|kind| !self.program.stops.iter().any(|(is, _)| is == *kind)) {
            let message = format!(
                "the job's {} stop is missing",
                if *missing == StopKind::Program { "program" } else { "optional" }
            );
            return self.differs(Code::PV019, line, message, "print M0 or M1");
        }
        if self.stops.is_empty() && self.program.stops.iter().any(|(_, in_cut)| *in_cut) {
            let message = "a stop that the job does not have, with the tool in the cut".to_owned();
            return self.differs(Code::PV019, line, message, "retract before the stop, or take it out");
        }
        if self.new_tool && !self.tools && self.counts != Counts::default() {
            // a machine without tool changes stops for the next tool
            if !self.program.stops.iter().any(|(kind, _)| *kind == StopKind::Program) {
                let message = "the program goes on without a stop for the next tool".to_owned();
                return self.differs(Code::PV012, line, message, "print M0 in the tool change");
            }
        }
        self.stops.clear();
        match (wanted.tool.filter(|_| self.tools), is.tool) {
            (Some(a), Some(b)) if a != b => {
                let message = format!("tool {b} cuts, the job has tool {a} here");
                return self.differs(Code::PV012, line, message, "print T[tool] M6 in the tool change");
            }
            (Some(a), None) => {
                let message = format!("no tool was loaded, the job has tool {a} here");
                return self.differs(Code::PV012, line, message, "print T[tool] M6 in the tool change");
            }
            _ => {}
        }
        if let (Some(a), Some(b)) = (wanted.length, is.length)
            && a != b
        {
            let message = format!("the length offset is H{}, the job's tool has H{}", number(b), number(a));
            return self.differs(Code::PV014, line, message, "print G43 H[lcomp] in the tool change");
        }
        if let Some(a) = wanted.work.filter(|_| wanted.work != is.work) {
            let is = is.work.map_or("none that the program says".to_owned(), |b| b.to_string());
            let message = format!("the work offset is {is}, the job's is {a}");
            return self.differs(Code::PV012, line, message, "print G[work] in the tool change, or in `Upon [work]`");
        }
        if !cut.what.feeds() {
            return Ok(());
        }
        // on its way the tool may have been moved in the offsets of before, and in no others
        let allowed = [[self.before.length, self.before.work], [is.length, is.work]];
        if self.tools
            && let Some([length, work]) = self.program.moved_with.iter().find(|with| !allowed.contains(with)).copied()
        {
            let text =
                |name: &str, value: Option<f64>| value.map_or(format!("no {name}"), |v| format!("{name}{}", number(v)));
            let message =
                format!("the tool comes to this cut with {} in {}", text("H", length), text("work offset ", work));
            let code = if work == is.work { Code::PV014 } else { Code::PV012 };
            return self.differs(code, line, message, "print the offsets before the first height");
        }
        self.before = *is;
        if let (Some(a), Some(b)) = (wanted.rotation, is.rotation)
            && a != b
        {
            let message = format!("the spindle is {}, the job wants {}", b.name(), a.name());
            return self.differs(Code::PV011, line, message, "print M[direct] with the speed");
        }
        if wanted.speed.is_some() && wanted.css != is.css {
            let message = format!(
                "the speed counts {}, the job's does not",
                if is.css { "at the surface (G96)" } else { "turns" }
            );
            return self.differs(Code::PV011, line, message, "print G[speedtype]");
        }
        if let (Some(a), Some(b)) =
            (wanted.speed.filter(|_| wanted.rotation != Some(crate::nc::Rotation::Stop)), is.speed)
            && (a - b).abs() > (if tap { PITCH } else { ROUNDED } * a).max(0.5)
        {
            let message = format!("the spindle turns S{}, the job wants {}", number(b), number(a));
            return self.differs(Code::PV011, line, message, "print S[speed]");
        }
        if let (Some(a), Some(b)) = (wanted.side, is.side)
            && a != b
        {
            let name = |side: Option<toolpath::Side>| match side {
                None => "off",
                Some(toolpath::Side::Left) => "left",
                Some(toolpath::Side::Right) => "right",
            };
            let message = format!("cutter compensation is {}, the job wants {}", name(b), name(a));
            return self.differs(Code::PV018, line, message, "look at InFeed and OutFeed");
        }
        if wanted.side.flatten().is_some() && is.plane != toolpath::Plane::Xy {
            let message = "cutter compensation is in another plane than XY".to_owned();
            return self.differs(Code::PV018, line, message, "print G17 before it");
        }
        if let (Some(a), b) = (wanted.diameter, is.diameter)
            && Some(a) != b
        {
            let b = b.map_or("none".to_owned(), |b| format!("D{}", number(b)));
            let message = format!("cutter compensation takes register {b}, the job's tool has D{}", number(a));
            return self.differs(Code::PV018, line, message, "print D[dcomp] in InFeed");
        }
        // of a cut in parts each part is looked at, where its share is known
        if cut.mode == FeedMode::InverseTime && found.mode == FeedMode::InverseTime {
            return Ok(());
        }
        self.feeds(cut, found, tap)
    }

    /// The feed, within what its digits are rounded off.
    pub(super) fn feeds(&mut self, cut: &Cut, found: &Cut, tap: bool) -> Result<(), Box<Diag>> {
        let (Some(wanted), Some(mut is)) = (cut.feed, found.feed) else { return Ok(()) };
        // a tap's feed is its pitch, however it counts
        let speed = found.state.speed.filter(|speed| tap && !found.state.css && *speed > 0.0);
        if cut.mode != found.mode {
            match (cut.mode, found.mode, speed) {
                (FeedMode::PerMinute, FeedMode::PerRev, Some(speed)) => is *= speed,
                (FeedMode::PerRev, FeedMode::PerMinute, Some(speed)) => is /= speed,
                _ => {
                    let message = "feeds count otherwise: per minute, per turn or inverse time".to_owned();
                    return self.differs(Code::PV006, found.line, message, "print G[feedtype]");
                }
            }
        }
        if (wanted - is).abs() <= (if tap { PITCH } else { ROUNDED } * wanted).max(1e-9) {
            return Ok(());
        }
        let message = format!("the feed is {}, the job's {}", number(is), number(wanted));
        self.differs(Code::PV006, found.line, message, "print F[frate] where the feed changes")
    }
}
