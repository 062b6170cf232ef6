//! Dwells and stops.

use crate::control::Meaning;
use crate::lang::{SequenceId, VarId};
use crate::render::cx::Cx;
use crate::render::dwell::dwell_here;
use crate::render::fault::Done;
use crate::render::prints::prints_code;
use crate::render::settle::settle_here;
use crate::render::targets::set_here;
use crate::render::upon::{run_with_upons, upon_is_due};
use crate::render::words::value_code;
use crate::toolpath::StopKind;

/// Prints a dwell in seconds.
pub fn dwell(seconds: f64, cx: &mut Cx<'_>) -> Done {
    settle_between_moves(cx)?;
    dwell_here(seconds, cx)
}

/// Prints a program stop or an optional stop.
pub fn stop(kind: StopKind, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    settle_between_moves(cx)?;
    let [program, optional] = shape.program.settings.stop_code;
    let code = if kind == StopKind::Program { program } else { optional };
    cx.want.set(VarId::Stop, code);
    let own = shape.program.routine(SequenceId::OptStop).filter(|_| kind == StopKind::Optional);
    match own.or_else(|| shape.program.routine(SequenceId::Stop)) {
        Some(routine) => {
            set_here(shape, cx.want, cx.said)?;
            let routine = shape.way(routine, cx.want, cx.said);
            run_with_upons(routine, cx)?;
            if !routine.vars.has(VarId::Stop)
                && !prints_code(routine, |code| shape.meaning_of(code).is_some_and(Meaning::is_stop), shape)
            {
                cx.said.stopped(cx.want, shape); // the sequence stops with other words than a known stop code
            }
        }
        None => {
            value_code(b'M', code, &mut cx.writer())?;
            cx.out.end_block();
        }
    }
    Ok(())
}

/// Prints waiting changes of spindle and coolant before a dwell or stop.
pub fn settle_between_moves(cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    // at an unknown position, an Upon that would move the tool waits for the next rapid
    let lost = cx.said.stand.position.given & 0b11 != 0b11
        && upon_is_due(cx.said.lacks(cx.want, shape), true, shape, cx.want, cx.said);
    if cx.said.is_unsettled(cx.want) && !lost { settle_here(false, cx) } else { Ok(()) }
}
