//! Feed moves.

use super::measure::measure;
use super::plain::{is_plain, plain_line};
use super::prepare::{begin_cut, cut_goes_to};
use crate::lang::SequenceId;
use crate::render::body::{Mode, run};
use crate::render::cx::Cx;
use crate::render::fault::Done;
use crate::render::prelude::{check_prints, feed_block};
use crate::render::said::{LastMove, Said};
use crate::render::shape::{ROTARY_BITS, Shape};
use crate::render::upon::upons;
use crate::render::words::move_block;
use crate::toolpath::Axes;

/// A feed move of the path.
pub fn line(to: &Axes, feed: Option<f64>, cx: &mut Cx<'_>) -> Done {
    if let Some(factors) = is_plain(to, cx.shape, cx.want, cx.said) {
        return plain_line(to, feed, factors, cx);
    }
    let target = begin_cut(to, Some(feed), cx)?;
    let feed = cx.want.feed();
    let in_degrees = cx.shape.scale != 1.0 && !cx.want.inverse_time() && only_turns(&target, cx.shape, cx.said);
    if in_degrees {
        cx.want.keep_feed(feed.map(|feed| feed / cx.shape.scale), cx.shape);
    }
    cut_goes_to(&target, false, cx)?;
    line_to(&target, cx)?;
    if in_degrees {
        cx.want.keep_feed(feed, cx.shape);
    }
    Ok(())
}

/// Whether a cut moves only rotary axes. Its feed is in degrees per minute, so it is the same in other units.
fn only_turns(target: &Axes, shape: &Shape, said: &Said) -> bool {
    let stays = |axis: usize| {
        let known = target.get(axis).is_none_or(|to| said.stand.position.get(axis) == Some(to));
        known || !said.differs_from(target, 1 << axis, shape)
    };
    target.given & ROTARY_BITS != 0 && said.turns(target, shape) && (0..3).all(stays)
}

/// A feed move to a target in program units.
pub fn line_to(target: &Axes, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let program = shape.program;
    if cx.said.last_move == LastMove::Rapid && !program.settings.force.is_empty() {
        cx.said.force(shape);
    }
    if shape.measures {
        measure(target, true, cx);
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
