//! Preparation of each move of the path, in order.

use super::rapid_blocks::split_rapid;
use super::travel::in_travel;
use crate::diag::Code;
use crate::lang::VarId;
use crate::render::cx::Cx;
use crate::render::fault::{Done, fault};
use crate::render::said::Said;
use crate::render::settle::{settle_here, stands_at_cut};
use crate::render::shape::{ROTARY_BITS, Shape};
use crate::render::targets::set_targets;
use crate::render::upon::upons;
use crate::render::vars::MOVE_VARS;
use crate::toolpath::Axes;

/// The target of a job item, with rotary angles within the machine's travel. `free`: the tool is out of the part. Call
/// this function only after the end of an open cycle.
#[inline]
pub fn reach(to: &Axes, free: bool, cx: &mut Cx<'_>) -> Done<Axes> {
    let shape = cx.shape;
    if cx.said.stand.left_hole.is_some() {
        stand_as_left(&cx.said.stand.target(to, shape), free, cx)?;
        if to.given & shape.depth_bit() != 0 {
            cx.said.stand.left_hole = None; // the item has a height of its own
        }
    }
    let target = cx.said.stand.target(to, shape);
    if to.given & ROTARY_BITS != 0 { in_travel(&target, to.given, free, cx) } else { Ok(target) }
}

/// Moves the tool to the job's height after a cycle that left the tool at another height. The move is printed before a
/// cut, and before a rapid across. The rapid across may lead to the next cycle.
#[cold]
pub fn stand_as_left(target: &Axes, free: bool, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let Some((at, height)) = cx.said.stand.left_hole.take() else { return Ok(()) };
    // only if nothing has moved the tool since
    if at != cx.said.stand.position {
        return Ok(());
    }
    if cx.said.lacks(cx.want, shape).has(VarId::Work) {
        // in another work offset all axes are printed again, with the job's height
        cx.said.stand.position.set(shape.depth, height);
        return Ok(());
    }
    let across = (0..6).any(|axis| axis != shape.depth && target.get(axis) != at.get(axis));
    let lower = at.get(shape.depth).is_some_and(|left| left < height);
    if free && !(across && lower) {
        // the next cut still begins at the job's height
        let as_high = target.get(shape.depth) == at.get(shape.depth);
        cx.said.stand.left_hole = as_high.then_some((*target, height));
        return Ok(());
    }
    let mut to = cx.said.stand.position;
    to.set(shape.depth, height);
    to.given = shape.depth_bit();
    set_targets(&to, shape, cx.want, cx.said)?;
    split_rapid(&to, cx)
}

/// First half of the preparation of a cut: finds its target and sets its feed. Steps in order: correct the height after
/// a cycle, bring the target into the travel, check that the start is known, set the feed. `feed`: the job's feed; an
/// outer `None` means a rapid.
#[inline]
pub fn begin_cut(to: &Axes, feed: Option<Option<f64>>, cx: &mut Cx<'_>) -> Done<Axes> {
    let target = reach(to, false, cx)?;
    if let Some(feed) = feed {
        if cx.said.stand.fresh_tool.is_some() {
            begins_somewhere(&target, cx.shape, cx.said)?;
        }
        cx.want.take_feed(feed, cx.shape)?;
    }
    Ok(target)
}

/// Second half of the preparation of a cut. Steps in order: print waiting changes, check that the tool is at the start
/// of the cut, set the position variables, run the Upon sequences of these variables. `targets`: whether the form's
/// sequence for the cut uses the position variables.
#[inline]
pub fn cut_goes_to(target: &Axes, targets: bool, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    if cx.said.is_unsettled(cx.want) {
        settle_here(true, cx)?;
    } else if cx.said.stand.moved_by.is_some() {
        stands_at_cut(cx.said)?;
    }
    if targets || shape.sets_targets || target.given & ROTARY_BITS != 0 {
        set_targets(target, shape, cx.want, cx.said)?;
    }
    if shape.watches_moves && (targets || cx.said.differs_from(target, 0x3f, shape)) {
        upons(MOVE_VARS, cx)?;
    }
    Ok(())
}

/// Checks that the start of the first cut is known: a new tool comes from an unknown position.
#[cold]
fn begins_somewhere(target: &Axes, shape: &Shape, said: &mut Said) -> Done {
    // the upper guides of a wire follow the lower ones
    let axes = if shape.linear == 4 { 2 } else { shape.linear };
    let needed = target.given | said.stand.fresh_tool.take().unwrap_or(0);
    let unknown = needed & !said.stand.position.given & ((1 << axes) - 1);
    if unknown == 0 || shape.program.settings.incremental {
        return Ok(());
    }
    let unsaid = (0..6).filter(|axis| unknown & 1 << axis != 0).map(|axis| char::from(shape.axes[axis]).to_string());
    let unsaid = unsaid.collect::<Vec<_>>().join(" and ");
    let message =
        format!("the operation begins with a cut, but {unsaid} is unknown since the tool change or the move home");
    fault(Code::PR012, message, "begin the operation with a rapid to the start of its first cut")
}
