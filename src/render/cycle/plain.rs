//! Usual holes of a machine cycle. A usual hole is not the first hole, is as deep as the previous hole, and needs only
//! its position words. Most holes of long jobs are usual holes. A usual hole is printed without planning the cycle
//! again. The general code of [`super::hole`] would print the same block for a usual hole.

use super::open::{ActiveCycle, Drilling};
use crate::compile::{CycleStyle, Routine};
use crate::lang::{VarId, VarSet};
use crate::render::body::next_hole::PositionWords;
use crate::render::cx::Cx;
use crate::render::fault::Done;
use crate::render::shape::ROTARY_BITS;
use crate::toolpath::Hole;

/// The variables that differ between two usual holes.
const CHANGES: VarSet = VarSet::of(&[VarId::H, VarId::V, VarId::Block]);

/// The words of the next hole, if the next hole is as deep as the previous hole.
#[derive(Clone, Copy, Debug)]
pub enum NextHole {
    /// Not determined yet: the general code of [`super::hole`] printed the last hole.
    Unknown,
    /// Only these words are printed for the next hole.
    Position(PositionWords),
    /// The general code is needed for the next hole and all later holes of the cycle. An event between two holes can't
    /// remove this need.
    Other,
}

/// The words of this hole, if the hole is usual.
#[inline]
pub fn plain_words(hole: &Hole, cx: &mut Cx<'_>, drill: &mut Drilling) -> Option<PositionWords> {
    let shape = cx.shape;
    let cycle = drill.open.as_mut()?;
    let as_deep = cycle.in_force
        && cycle.holes > 1 // `[isfirsthole]` is 0 from the second hole
        && hole.depth == cycle.depth
        && hole.at.get(shape.depth).is_none_or(|at| Some(at * shape.scale) == cycle.point)
        && (hole.at.given | cx.said.stand.position.given) & ROTARY_BITS == 0
        && !cx.said.is_unsettled(cx.want);
    if !as_deep {
        return None;
    }
    if let NextHole::Unknown = cycle.next {
        let routine = cycle.sequence.and_then(|id| shape.routine(id, cx.want, cx.said));
        let words = routine
            .filter(|routine| prints_no_more(routine, cycle, cx))
            .and_then(|routine| PositionWords::of(routine, &mut cx.writer()));
        cycle.next = words.map_or(NextHole::Other, NextHole::Position);
    }
    match cycle.next {
        NextHole::Position(words) => Some(words),
        _ => None,
    }
}

/// Prints a usual hole.
#[inline]
pub fn plain_hole(hole: &Hole, words: &PositionWords, cx: &mut Cx<'_>, drill: &mut Drilling) -> Done {
    let shape = cx.shape;
    cx.said.stand.moved_by = None; // rapids approach every hole
    let position = &mut cx.said.stand.position;
    for axis in 0..2 {
        if hole.at.given & 1 << axis != 0 {
            position.values[axis] = hole.at.values[axis] * shape.scale;
        }
    }
    let position = *position;
    let at = [position.values[0] * shape.scales[0], position.values[1] * shape.scales[1]];
    cx.want.set(VarId::H, at[0]);
    cx.want.set(VarId::V, at[1]);
    if let Some(cycle) = &mut drill.open {
        cycle.holes += 1;
        cycle.last = Some(position);
    }
    words.print(at, &mut cx.writer())
}

/// Whether the words of this sequence are the only output for a hole, at any position of the hole.
#[cold]
fn prints_no_more(routine: &Routine, cycle: &ActiveCycle, cx: &Cx<'_>) -> bool {
    let (shape, program) = (cx.shape, cx.shape.program);
    let settings = &program.settings;
    routine.style == CycleStyle::Machine
        && routine.branches == cycle.branches
        && !cycle.sequence.and_then(|id| program.routine(id)).is_some_and(|whole| whole.tests(CHANGES, program))
        && !routine.first_only.vars.meets(CHANGES)
        && shape.linear == 3
        && shape.depth == 2
        && settings.modality
        && settings.limits.is_empty()
        && !(settings.incremental || shape.measures || shape.sets_targets || shape.watches_moves)
        && !program.printed.with(program.asked).has(VarId::Lasthole)
        && !program.upon_vars.meets(routine.vars.with(VarSet::of(&[VarId::D])))
        && cycle.spec.starts.is_none()
        && cx.out.mark().is_none()
        && !cx.said.is_elsewhere(shape)
}
