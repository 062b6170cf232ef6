//! Feed moves.

use super::measure::measure;
use super::plain::{is_plain, plain_line};
use super::prepare::{begin_cut, cut_goes_to};
use crate::lang::SequenceId;
use crate::render::body::{Mode, run};
use crate::render::cx::Cx;
use crate::render::fault::Done;
use crate::render::prelude::{check_prints, feed_block};
use crate::render::said::LastMove;
use crate::render::upon::upons;
use crate::render::words::move_block;
use crate::toolpath::Axes;

/// A feed move of the path.
pub fn line(to: &Axes, feed: Option<f64>, cx: &mut Cx<'_>) -> Done {
    if let Some(factors) = is_plain(to, cx.shape, cx.want, cx.said) {
        return plain_line(to, feed, factors, cx);
    }
    let target = begin_cut(to, Some(feed), cx)?;
    cut_goes_to(&target, false, cx)?;
    line_to(&target, cx)
}

/// A feed move to a target in program units.
pub fn line_to(target: &Axes, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let program = shape.program;
    if cx.said.last_move == LastMove::Rapid && !program.settings.force.is_empty() {
        cx.said.force(shape);
    }
    if shape.measures {
        measure(target, true, cx.want, cx.said);
    }
    match shape.routine(SequenceId::LineCode, cx.want, cx.said) {
        Some(routine) if cx.said.differs_from(target, 0x3f, shape) => {
            check_prints(routine, target, shape, cx.said)?;
            upons(routine.vars, cx)?;
            feed_block(&program.settings.feed, routine, &mut cx.writer())?;
            run(routine, Mode::Motion, &mut cx.writer())?;
        }
        Some(_) => {}
        None => {
            move_block(target, &program.settings.feed, true, &mut cx.writer())?;
        }
    }
    cx.said.stand.position = *target;
    cx.said.last_move = LastMove::Line;
    Ok(())
}
