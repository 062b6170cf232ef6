//! Checks the beginning of a cut. The program must have a cut of the same kind that begins at the same position.

use super::cut::{ACROSS, ALL, Cut, DEPTH, NAMES, Rapid, number, over, same, shown};
use super::intent::{Done, Expected};
use super::sides::Sides;
use super::{align, modal, pauses, rapids, wire};
use crate::diag::Code;

/// The beginning of the program's next cut, relative to the job's cut.
enum Begins {
    /// The program's cut begins at the beginning of the job's cut.
    There,
    /// The program's cut begins after the job's cut. The program reaches the end of the job's cut by a rapid.
    Behind,
    /// The program's cut begins before the job's cut. The program has a feed move where the job has a rapid.
    Before,
}

/// Finds the program's cut for this cut of the job. Compares the path to the cut, the beginning of the cut and its
/// modal state. `None`: the program has a rapid where the job cuts.
pub(super) fn meet(s: &mut Sides<'_>, cut: &Cut, hole: Option<&Expected>) -> Done<Option<Cut>> {
    let found = loop {
        let Some(found) = align::partner(s, cut)? else { return is_missing(s, cut, hole) };
        match begins(s, cut, &found, hole)? {
            Begins::There => break found,
            Begins::Behind => {
                // the job's next cut begins at this end
                s.job.goes_on(cut.end());
                return Ok(None);
            }
            Begins::Before => s.program.pass_over(),
        }
    };
    pauses::compare(s);
    wire::compare(s, found.line);
    let goes_down = hole.is_some() || cut.end()[DEPTH] < cut.from[DEPTH] - s.limits.tolerance;
    rapids::compare(s, goes_down, found.line);
    modal::compare(s, cut, &found, hole.is_some_and(|hole| hole.is_tap));
    s.slipped = None;
    Ok(Some(found))
}

fn is_missing<T>(s: &mut Sides<'_>, cut: &Cut, hole: Option<&Expected>) -> Done<T> {
    if let Some(hole) = hole {
        let message = format!("the hole at {} is not drilled: the program ends before it", over(&hole.at));
        return s.differs(Code::PV002, 0, message, "check the cycle and its end");
    }
    let end = cut.end();
    let to = shown(&end, 0b111);
    let tolerance = s.limits.tolerance;
    let by_rapid = |rapid: &Rapid| rapid.unknown == 0 && same(&rapid.to, &end, ALL, tolerance);
    if s.program.passage.rapids.iter().any(by_rapid) {
        let message = format!("a rapid goes to {to}, but the job cuts to this position");
        return s.differs(Code::PV007, 0, message, "print the feed code (G1) for this move");
    }
    let message = format!("the program ends before the cut to {to}");
    s.differs(Code::PV017, 0, message, "check the words that the form prints for this move")
}

/// Checks that both cuts begin at the same position.
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
        return Ok(Begins::There); // both follow the previous cut
    }
    let end = cut.end();
    let angles = (3..6).filter(|&axis| cut.from[axis] != found.from[axis]).map(|axis| 1 << axis).sum::<u8>();
    let (wanted, is) = (shown(&cut.from, 0b111 | angles), shown(&found.from, 0b111 | angles));
    let line = found.line;
    // a rapid goes to the end of the job's cut
    let cuts_by_rapid = |rapid: &Rapid| rapid.unknown == 0 && same(&rapid.to, &end, ALL, tolerance);
    if s.program.passage.rapids.iter().any(cuts_by_rapid) && !same(&end, &cut.from, ALL, tolerance) {
        s.found(Code::PV007, line, "print the feed code (G1) for this move", || {
            format!("a rapid goes to {}, but the job cuts to this position", shown(&end, 0b111))
        });
        return Ok(Begins::Behind);
    }
    if is_the_jobs_rapid(s, found) {
        return Ok(Begins::Before);
    }
    if found.by_cycle && found.lead.is_none() && hole.is_none() {
        let place = over(&found.from);
        let message =
            format!("the canned cycle is still active: it drills at {place}, but the job has no hole at this position");
        return s.differs(Code::PV013, line, message, "end the cycle: print G80 in Cancel, and `End Cancel`");
    }
    if let (None, Some(axes)) = (hole, unsaid(unknown)) {
        let message = format!(
            "a cut begins at an unknown position: {axes} is not printed since a change of the work offset or the \
             tool, or since a move home"
        );
        return s.differs(Code::PV001, line, message, "print all axes before the cut");
    }
    let Some(hole) = hole else {
        let message = format!("a cut begins at {is}, but the job's cut begins at {wanted}");
        return s.differs(
            Code::PV001,
            line,
            message,
            "check the words that the form prints for the moves before the cut",
        );
    };
    if !same(&hole.at, &found.from, ACROSS, tolerance) {
        let at = over(&hole.at);
        if s.hole.last.is_some_and(|last| same(&last.at, &found.from, ACROSS, tolerance)) {
            let message = format!("the hole at {} is drilled twice", over(&found.from));
            return s.differs(Code::PV003, line, message, "remove a second position line from the cycle");
        }
        if !found.by_cycle && same(&hole.at, &found.end(), ACROSS, tolerance) {
            s.found(Code::PV008, line, FEEDS, || {
                format!("a feed move goes to the hole at {at}, but the job has a rapid")
            });
            return Ok(Begins::Before);
        }
        let message = format!("the hole at {at} is not drilled: the next cut begins at {is}");
        return s.differs(Code::PV002, line, message, "print [h] and [v] in the cycle's position line");
    }
    if unknown & 1 << DEPTH != 0 {
        let message = format!("the hole at {} is drilled from an unknown height", over(&hole.at));
        return s.differs(Code::PV005, line, message, "print [d] before the cycle");
    }
    // report it and continue: the hole is at the job's position, and the next hole may be too
    s.found(Code::PV005, line, "print R[vclear] in the cycle, at every hole where the R plane changes", || {
        format!(
            "the feed begins at Z{}, but the job's clearance plane is Z{}",
            number(found.from[DEPTH]),
            number(cut.from[DEPTH])
        )
    });
    Ok(Begins::There)
}

/// The correction of a feed move instead of a rapid.
const FEEDS: &str = "print the rapid code (G0) for this move";

/// Whether the program has a feed move to a position that the job reaches at rapid. If `true`, the difference is
/// reported.
pub(super) fn is_the_jobs_rapid(s: &mut Sides<'_>, found: &Cut) -> bool {
    let (end, tolerance) = (found.end(), s.limits.tolerance);
    let is = s.job.rapids.iter().any(|rapid| same(&rapid.to, &end, ALL, tolerance));
    if is {
        s.found(Code::PV008, found.line, FEEDS, || {
            format!("a feed move goes to {}, but the job has a rapid to this position", shown(&end, 0b111))
        });
    }
    is
}

/// The names of the axes in these bits, such as `X and Y`; `None` if no bit is set.
pub(super) fn unsaid(axes: u8) -> Option<String> {
    let names: Vec<String> =
        (0..8).filter(|axis| axes & 1 << axis != 0).map(|axis| char::from(NAMES[axis]).to_string()).collect();
    (!names.is_empty()).then(|| names.join(" and "))
}
