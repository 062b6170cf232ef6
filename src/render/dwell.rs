//! Dwells, printed by the form's own sequence, or otherwise as a generated block.

use crate::lang::{SequenceId, VarId};
use crate::render::cx::Cx;
use crate::render::fault::Done;
use crate::render::targets::set_here;
use crate::render::upon::run_with_upons;
use crate::render::words::dwell_block;

/// Prints a dwell in seconds: by `DwellBlock`, otherwise as a generated block.
pub fn dwell_here(seconds: f64, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let Some(routine) = shape.program.routine(SequenceId::DwellBlock) else {
        return dwell_block(seconds, &mut cx.writer());
    };
    let milliseconds = shape.program.settings.dwell.milliseconds;
    cx.want.set(VarId::Dwell, if milliseconds { seconds * 1000.0 } else { seconds });
    set_here(shape, cx.want, cx.said)?;
    let routine = shape.way(routine, cx.want, cx.said);
    run_with_upons(routine, cx)?;
    let says = routine.vars.has(VarId::Dwell);
    cx.want.put(VarId::Dwell, None);
    // a dwell that the selected branches do not print must still be printed
    if says { Ok(()) } else { dwell_block(seconds, &mut cx.writer()) }
}
