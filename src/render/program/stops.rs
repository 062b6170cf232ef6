//! Dwells and stops.

use crate::control::Meaning;
use crate::lang::{SequenceId, VarId};
use crate::render::fault::Done;
use crate::render::printer::Printer;
use crate::render::prints::prints_code;
use crate::render::said::Said;
use crate::render::settle::settle_here;
use crate::render::shape::Shape;
use crate::render::targets::set_here;
use crate::render::upon::{run_with_upons, upon_is_due};
use crate::render::want::Want;
use crate::render::words::{dwell_block, value_code};
use crate::toolpath::StopKind;

/// A dwell in seconds.
pub fn dwell(seconds: f64, shape: &Shape, want: &mut Want, said: &mut Said, out: &mut Printer) -> Done {
    settle_between_moves(shape, want, said, out)?;
    let Some(routine) = shape.program.routine(SequenceId::DwellBlock) else {
        return dwell_block(seconds, shape, want, said, out);
    };
    let milliseconds = shape.program.settings.dwell.milliseconds;
    want.set(VarId::Dwell, if milliseconds { seconds * 1000.0 } else { seconds });
    set_here(shape, want, said)?;
    let routine = shape.way(routine, want, said);
    run_with_upons(routine, shape, want, said, out)?;
    let says = routine.vars.has(VarId::Dwell);
    want.put(VarId::Dwell, None);
    // a way that does not say it has not dwelt
    if says { Ok(()) } else { dwell_block(seconds, shape, want, said, out) }
}

/// A program stop or an optional one.
pub fn stop(kind: StopKind, shape: &Shape, want: &mut Want, said: &mut Said, out: &mut Printer) -> Done {
    settle_between_moves(shape, want, said, out)?;
    let [program, optional] = shape.program.settings.stop_code;
    let code = if kind == StopKind::Program { program } else { optional };
    want.set(VarId::Stop, code);
    let own = shape.program.routine(SequenceId::OptStop).filter(|_| kind == StopKind::Optional);
    match own.or_else(|| shape.program.routine(SequenceId::Stop)) {
        Some(routine) => {
            set_here(shape, want, said)?;
            let routine = shape.way(routine, want, said);
            run_with_upons(routine, shape, want, said, out)?;
            if !routine.vars.has(VarId::Stop)
                && !prints_code(routine, |code| shape.meaning_of(code).is_some_and(Meaning::is_stop), shape)
            {
                said.stopped(want, shape); // by words of its own
            }
        }
        None => {
            value_code(b'M', code, shape, want, said, out)?;
            out.end_block();
        }
    }
    Ok(())
}

/// Changes of spindle and coolant come before a dwell or stop too.
pub fn settle_between_moves(shape: &Shape, want: &mut Want, said: &mut Said, out: &mut Printer) -> Done {
    // where nobody knows the place, what would move the tool waits for the next rapid
    let lost =
        said.stand.position.given & 0b11 != 0b11 && upon_is_due(said.lacks(want, shape), true, shape, want, said);
    if said.is_unsettled(want) && !lost { settle_here(false, shape, want, said, out) } else { Ok(()) }
}
