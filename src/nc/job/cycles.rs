//! Converts a canned cycle of a control to a cycle of a job. The points of the holes are on the R plane, because a
//! program does not contain the height of the top of the part.

use super::fault::unsaid;
use crate::control::Motions;
use crate::diag::Diag;
use crate::nc::action::Drilling;
use crate::toolpath::{Axes, CycleKind, CycleSpec, Hole};

/// Whether two holes belong to the same cycle.
pub(super) fn is_same(a: &Drilling, b: &Drilling) -> bool {
    let key = |d: &Drilling| (d.cycle.code, [d.r, d.clear, d.dwell, d.peck, d.level, d.feed], d.shift);
    key(a) == key(b)
}

/// Converts a hole of a program to a cycle of a job.
///
/// # Errors
/// A job can't contain the cycle of this hole.
pub(super) fn spec_of(hole: &Drilling, rigid: bool, line: u64) -> Result<CycleSpec, Box<Diag>> {
    let kind = match hole.cycle.motions {
        Motions::Drill if hole.cycle.dwells => CycleKind::Face,
        Motions::Drill => CycleKind::Drill,
        Motions::Peck => CycleKind::Deep,
        Motions::Chipbreak => CycleKind::Chipbreak,
        Motions::Tap => CycleKind::Tap,
        Motions::LeftTap => CycleKind::LTap,
        Motions::FeedOut => CycleKind::Ream,
        Motions::StopOut => CycleKind::Bore,
        Motions::ShiftOut => {
            let help = "write the bore by hand, with `orient`, `offset` and the side";
            let name = hole.cycle.name();
            let message = match hole.cycle.code.letter {
                b'G' | b'g' => {
                    format!("{name}: a parameter of the control sets the side to which the tool moves off the wall")
                }
                _ => format!("{name}, a bore that moves the tool off the wall, is not read as a cycle of a job"),
            };
            return unsaid(line, message, help);
        }
        Motions::Back | Motions::ByHand => {
            let message = format!("a job has no cycle like {}", hole.cycle.name());
            return unsaid(line, message, "program the moves of the cycle, or write the job by hand");
        }
    };
    let mut spec = CycleSpec::new(kind);
    spec.clear = Some(0.0);
    spec.depth = Some(hole.r - hole.bottom);
    spec.return_height = Some(hole.clear - hole.r);
    spec.feed = Some(hole.feed);
    spec.step = Some(hole.peck).filter(|_| matches!(kind, CycleKind::Deep | CycleKind::Chipbreak));
    if kind.is_tap() && hole.peck > 0.0 {
        (spec.step, spec.mode) = (Some(hole.peck), Some(CycleKind::Chipbreak));
    }
    // a dwell of zero seconds is left out, unless this kind of cycle requires a dwell
    spec.dwell = Some(hole.dwell).filter(|&seconds| seconds > 0.0 || kind == CycleKind::Face);
    if let Some(angle) = hole.cycle.start.filter(|angle| *angle != 0.0) {
        let message = format!("{} with the spindle angle {angle} before the thread", hole.cycle.name());
        return unsaid(
            line,
            message,
            "a job has no angle at which a thread starts: write the angle 0, or leave it out",
        );
    }
    spec.rigid = hole.cycle.rigid.or(rigid.then_some(true)).filter(|_| kind.is_tap());
    Ok(spec)
}

/// Converts a hole of a program to a hole of a job. `first` is the first hole of the cycle.
pub(super) fn hole_of(hole: &Drilling, first: &Drilling, axes: u8) -> Hole {
    let mut at = Axes { values: hole.at, given: axes };
    at.set(2, hole.r);
    Hole { at, depth: (hole.bottom != first.bottom).then_some(hole.r - hole.bottom) }
}
