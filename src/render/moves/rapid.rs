//! A rapid of the path.

use super::prepare::reach;
use super::rapid_blocks::rapid_to;
use super::rotary::turn_to;
use crate::diag::Code;
use crate::lang::{VarId, VarSet};
use crate::render::cx::Cx;
use crate::render::fault::{Done, fault};
use crate::render::settle::print_lacking;
use crate::render::shape::ROTARY_BITS;
use crate::render::targets::set_targets;
use crate::render::upon::{index_replaces_work_upon, upon_is_due, upons};
use crate::render::vars::MOVE_VARS;
use crate::render::work::work_before;
use crate::toolpath::Axes;

/// Prints a rapid of the path.
pub fn rapid(to: &Axes, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let target = reach(to, true, cx)?;
    if shape.sets_targets || cx.said.is_unsettled(cx.want) || target.given & ROTARY_BITS != 0 {
        set_targets(&target, shape, cx.want, cx.said)?;
    }
    let turns = target.given & ROTARY_BITS != 0 && cx.said.turns(&target, shape);
    if cx.said.is_unsettled(cx.want) {
        if turns && index_replaces_work_upon(shape) {
            work_before(&mut cx.writer())?;
        }
        if turns && upon_is_due(cx.said.lacks(cx.want, shape), true, shape, cx.want, cx.said) {
            let message = "at this rapid, an Upon sequence would move the tool before the part turns";
            return fault(
                Code::PR017,
                message,
                "print the work offset in `WorkChange`, with the angle: `G[work] A[rotangle]`; or put a rapid at the \
                 same angle before it",
            );
        }
        print_lacking(cx)?;
        cx.said.differs |= cx.said.sub.is_some_and(|sub| sub.stops); // a cut after it must check the spindle again
        cx.said.differs |= cx.said.from_home; // so that no rapid from home is printed as a plain rapid
    }
    cx.said.stand.moved_by = None;
    if turns {
        return turn_to(&target, cx);
    }
    if shape.watches_moves && cx.said.differs_from(&target, 0x3f, shape) {
        upons(MOVE_VARS.without(VarSet::of(&[VarId::Frate])), cx)?;
    }
    rapid_to(&target, cx)
}
