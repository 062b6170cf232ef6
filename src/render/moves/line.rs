//! Feed moves.

use super::measure::measure;
use super::reach::{begins_somewhere, reach};
use crate::lang::SequenceId;
use crate::render::body::{Mode, run};
use crate::render::fault::Done;
use crate::render::prelude::{check_prints, feed_block};
use crate::render::printer::Printer;
use crate::render::said::{LastMove, Said};
use crate::render::settle::{settle_here, stands_at_cut};
use crate::render::shape::{ROTARY_BITS, Shape};
use crate::render::targets::set_targets;
use crate::render::upon::upons;
use crate::render::vars::MOVE_VARS;
use crate::render::want::Want;
use crate::render::words::move_block;
use crate::toolpath::Axes;

/// A feed move of the path.
pub fn line(to: &Axes, feed: Option<f64>, shape: &Shape, want: &mut Want, said: &mut Said, out: &mut Printer) -> Done {
    let target = reach(to, false, shape, want, said, out)?;
    if said.stand.fresh_tool.is_some() {
        begins_somewhere(&target, shape, said)?;
    }
    want.take_feed(feed, shape)?;
    if said.is_unsettled(want) {
        settle_here(true, shape, want, said, out)?;
    } else if said.stand.moved_by.is_some() {
        stands_at_cut(said)?;
    }
    if shape.sets_targets || target.given & ROTARY_BITS != 0 {
        set_targets(&target, shape, want, said)?;
    }
    if shape.watches_moves && said.differs_from(&target, 0x3f, shape) {
        upons(MOVE_VARS, shape, want, said, out)?;
    }
    line_to(&target, shape, want, said, out)
}

/// A feed move to a target in program units.
pub fn line_to(target: &Axes, shape: &Shape, want: &mut Want, said: &mut Said, out: &mut Printer) -> Done {
    let program = shape.program;
    if said.last_move == LastMove::Rapid && !program.settings.force.is_empty() {
        said.force(shape);
    }
    if shape.measures {
        measure(target, true, want, said);
    }
    match shape.routine(SequenceId::LineCode, want, said) {
        Some(routine) if said.differs_from(target, 0x3f, shape) => {
            check_prints(routine, target, shape, said)?;
            upons(routine.vars, shape, want, said, out)?;
            feed_block(&program.settings.feed, routine, shape, want, said, out)?;
            run(routine, Mode::Motion, shape, want, said, out)?;
        }
        Some(_) => {}
        None => {
            move_block(target, &program.settings.feed, true, shape, want, said, out)?;
        }
    }
    said.stand.position = *target;
    said.last_move = LastMove::Line;
    Ok(())
}
