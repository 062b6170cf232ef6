//! Where a cut begins: the program has one, of the same kind, from the same place.

use super::cut::{ACROSS, ALL, Cut, DEPTH, NAMES, Rapid, number, over, same, shown};
use super::intent::{Done, Expected};
use super::sides::Sides;
use super::{align, modal, pauses, rapids, wire};
use crate::diag::Code;

/// How the program's next cut begins.
enum Begins {
    /// Where the job's does.
    There,
    /// After the end of the job's, to which the program goes at rapid.
    Behind,
    /// Before it: the program feeds where the job has a rapid.
    Before,
}

/// The program's next cut, whose way, beginning and state are compared; `None`: the program goes at rapid where the job cuts.
pub(super) fn meet(s: &mut Sides<'_>, cut: &Cut, hole: Option<&Expected>) -> Done<Option<Cut>> {
    let found = loop {
        let Some(found) = align::partner(s, cut)? else { return is_missing(s, cut, hole) };
        match begins(s, cut, &found, hole)? {
            Begins::There => break found,
            Begins::Behind => {
                // the next cut begins there all the same
                s.job.goes_on(cut.end());
                return Ok(None);
            }
            Begins::Before => s.program.pass_over(),
        }
    };
    pauses::compare(s);
    wire::compare(s, found.line);
    rapids::compare(s, found.line);
    modal::compare(s, cut, &found, hole.is_some_and(|hole| hole.is_tap));
    s.slipped = None;
    Ok(Some(found))
}

fn is_missing<T>(s: &mut Sides<'_>, cut: &Cut, hole: Option<&Expected>) -> Done<T> {
    if let Some(hole) = hole {
        let message = format!("the hole at {} is not drilled: the program is over", over(&hole.at));
        return s.differs(Code::PV002, 0, message, "look at the cycle, and at what ends it");
    }
    let end = cut.end();
    let to = shown(&end, 0b111);
    let tolerance = s.limits.tolerance;
    let by_rapid = |rapid: &Rapid| rapid.unknown == 0 && same(&rapid.to, &end, ALL, tolerance);
    if s.program.passage.rapids.iter().any(by_rapid) {
        let message = format!("a rapid goes to {to}, where the job cuts");
        return s.differs(Code::PV007, 0, message, "print the feed code (G1) for this move");
    }
    let message = format!("the program is over, and the cut to {to} is missing");
    s.differs(Code::PV017, 0, message, "look at what the form prints for this move")
}

/// Checks that both cuts begin at one place.
fn begins(s: &mut Sides<'_>, cut: &Cut, found: &Cut, hole: Option<&Expected>) -> Done<Begins> {
    let tolerance = s.limits.tolerance;
    let unknown = found.unknown & !cut.unknown & ALL;
    if unknown == 0 && same(&cut.from, &found.from, ALL, tolerance) {
        return Ok(Begins::There);
    }
    if let Some([job, program]) = s.slipped
        && unknown == 0
        && same(&cut.from, &job, ALL, tolerance)
        && same(&found.from, &program, ALL, tolerance)
    {
        return Ok(Begins::There); // follows from where the cut before it ended
    }
    let end = cut.end();
    let angles = (3..6).filter(|&axis| cut.from[axis] != found.from[axis]).map(|axis| 1 << axis).sum::<u8>();
    let (wanted, is) = (shown(&cut.from, 0b111 | angles), shown(&found.from, 0b111 | angles));
    let line = found.line;
    // the rapid went where the cut goes
    let cuts_by_rapid = |rapid: &Rapid| rapid.unknown == 0 && same(&rapid.to, &end, ALL, tolerance);
    if s.program.passage.rapids.iter().any(cuts_by_rapid) && !same(&end, &cut.from, ALL, tolerance) {
        s.found(Code::PV007, line, "print the feed code (G1) for this move", || {
            format!("a rapid goes to {}, where the job cuts", shown(&end, 0b111))
        });
        return Ok(Begins::Behind);
    }
    if is_the_jobs_rapid(s, found) {
        return Ok(Begins::Before);
    }
    if found.by_cycle && found.lead.is_none() && hole.is_none() {
        let place = over(&found.from);
        let message = format!("the canned cycle is still in force: it drills at {place}, where the job has no hole");
        return s.differs(Code::PV013, line, message, "end the cycle: print G80 in Cancel, and `End Cancel`");
    }
    if let (None, Some(axes)) = (hole, unsaid(unknown)) {
        let message = format!(
            "a cut begins at a place that only the machine knows: {axes} was not said since the work offset or the tool \
             was changed, or an axis went home"
        );
        return s.differs(Code::PV001, line, message, "print all axes before the cut");
    }
    let Some(hole) = hole else {
        let message = format!("a cut begins at {is}, the job's at {wanted}");
        return s.differs(Code::PV001, line, message, "look at what the form prints for the moves before it");
    };
    if !same(&hole.at, &found.from, ACROSS, tolerance) {
        let at = over(&hole.at);
        if s.hole.last.is_some_and(|last| same(&last.at, &found.from, ACROSS, tolerance)) {
            let message = format!("the hole at {} is drilled twice", over(&found.from));
            return s.differs(Code::PV003, line, message, "look for a second position line in the cycle");
        }
        let message = format!("the hole at {at} is not drilled: the next cut begins at {is}");
        return s.differs(Code::PV002, line, message, "print [h] and [v] in the cycle's position line");
    }
    if unknown & 1 << DEPTH != 0 {
        let message = format!("the hole at {} is drilled from a height that only the machine knows", over(&hole.at));
        return s.differs(Code::PV005, line, message, "print [d] before the cycle");
    }
    // the hole is the job's all the same, and the next may be, too
    s.found(Code::PV005, line, "print R[vclear] in the cycle, at every hole where it changes", || {
        format!(
            "the feed begins at Z{}, the job's clearance plane is Z{}",
            number(found.from[DEPTH]),
            number(cut.from[DEPTH])
        )
    });
    Ok(Begins::There)
}

/// Does the program feed to where the job goes at rapid? Says so.
pub(super) fn is_the_jobs_rapid(s: &mut Sides<'_>, found: &Cut) -> bool {
    let (end, tolerance) = (found.end(), s.limits.tolerance);
    let is = s.job.rapids.iter().any(|rapid| same(&rapid.to, &end, ALL, tolerance));
    if is {
        s.found(Code::PV008, found.line, "print the rapid code (G0) for this move", || {
            format!("a feed move goes to {}, where the job has a rapid", shown(&end, 0b111))
        });
    }
    is
}

/// The names of axes, unless there are none.
pub(super) fn unsaid(axes: u8) -> Option<String> {
    let names: Vec<String> =
        (0..8).filter(|axis| axes & 1 << axis != 0).map(|axis| char::from(NAMES[axis]).to_string()).collect();
    (!names.is_empty()).then(|| names.join(" and "))
}
