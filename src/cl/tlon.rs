//! Arcs of CATIA: INDIRV and then TLON,GOFWD.

use super::arcs::arc_event;
use super::fault::{Done, fault};
use super::motion::no_jump;
use super::state::{Arcs, PendingArc, Shift, State};
use super::vector::cross;
use super::words::{Word, numbers};
use crate::diag::Code;

/// Handles INDIRV, the direction in which the next TLON begins.
pub(super) fn indirv(words: &[Word], arcs: &mut Arcs, shift: &Shift) -> Done {
    match numbers(words).as_deref() {
        Some([i, j, k]) => {
            arcs.direction = Some(shift.turned([*i, *j, *k]));
            Ok(())
        }
        _ => fault(Code::PL001, "INDIRV takes a vector", "write i, j, k"),
    }
}

/// Handles TLON,GOFWD/(CIRCLE/x,y,z,r),ON,[n,INTOF,](LINE/x,y,z,x,y,z): an arc to the second point of the line.
pub(super) fn tlon(words: &[Word], state: &mut State<'_>) -> Done {
    let number = |at: usize| words.get(at).and_then(Word::number);
    let circle = words.iter().position(|word| word.is("CIRCLE"));
    let line = words.iter().position(|word| word.is("LINE"));
    let point = |at: usize| Some([number(at)?, number(at + 1)?, number(at + 2)?]);
    let read = circle.zip(line).and_then(|(circle, line)| Some((point(circle + 1)?, point(line + 4)?)));
    let (Some((centre, to)), Some(direction)) = (read, state.arcs.direction.take()) else {
        let help = "write INDIRV, then TLON,GOFWD/(CIRCLE/x,y,z,r),ON,(LINE/x,y,z,x,y,z)";
        return fault(Code::PL004, "a TLON that can't be read", help);
    };
    let Some(from) = state.motion.position else {
        return fault(Code::PR005, "the arc begins at an unknown position", "put a GOTO before the arc");
    };
    if state.cycle.is_active() {
        return fault(Code::PC042, "an arc inside a cycle", "end the cycle first, with CYCLE/OFF");
    }
    if state.motion.rapid || state.motion.rapid_after_cycle {
        let help = "remove RAPID; after CYCLE/OFF, write FEDRAT before the arc";
        return fault(Code::PL004, "a rapid along an arc", help);
    }
    no_jump(&mut state.motion)?;
    state.job.begin_motion();
    let shift = &state.motion.shift;
    let (centre, to) = (shift.of(centre), shift.of(to));
    let axis = if state.job.turns_part() { 1 } else { 2 };
    let in_plane = |mut vector: [f64; 3]| {
        vector[axis] = 0.0;
        vector
    };
    let radius = in_plane([from[0] - centre[0], from[1] - centre[1], from[2] - centre[2]]);
    let direction = in_plane(direction);
    let turn = cross(radius, direction)[axis];
    let length = |vector: [f64; 3]| vector.iter().map(|c| c * c).sum::<f64>().sqrt();
    if turn.abs() < 0.1 * length(radius) * length(direction) {
        let help = "INDIRV must point along the arc";
        return fault(Code::PL004, "INDIRV points to the centre, so the direction of the arc is unknown", help);
    }
    state.motion.point = Some(to);
    let arc = PendingArc { centre, axis, up: true, radius: None, sense: None, times: None, angle: None };
    arc_event(&arc, to, turn > 0.0, state)
}
