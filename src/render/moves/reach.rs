//! Where an item of the path goes, and from where a cut begins.

use super::rapid_blocks::split_rapid;
use super::travel::in_travel;
use crate::diag::Code;
use crate::lang::VarId;
use crate::render::fault::{Done, fault};
use crate::render::printer::Printer;
use crate::render::said::Said;
use crate::render::settle::{settle_here, stands_at_cut};
use crate::render::shape::{ROTARY_BITS, Shape};
use crate::render::targets::set_targets;
use crate::render::upon::upons;
use crate::render::vars::MOVE_VARS;
use crate::render::want::Want;
use crate::toolpath::Axes;

/// Where an item of the path goes, in the travel of the machine; `free`: out of the part. An open cycle ends before it.
#[inline]
pub fn reach(to: &Axes, free: bool, shape: &Shape, want: &mut Want, said: &mut Said, out: &mut Printer) -> Done<Axes> {
    if said.stand.left_hole.is_some() {
        stand_as_left(&said.stand.target(to, shape), free, shape, want, said, out)?;
        if to.given & shape.depth_bit() != 0 {
            said.stand.left_hole = None; // the item says its own height
        }
    }
    let target = said.stand.target(to, shape);
    if to.given & ROTARY_BITS != 0 { in_travel(&target, to.given, free, shape, want, said, out) } else { Ok(target) }
}

/// After a cycle that left the tool at another height than the job: a cut begins at the job's, and a rapid across, which
/// may also be the way to the next cycle, is made there.
#[cold]
pub fn stand_as_left(
    target: &Axes,
    free: bool,
    shape: &Shape,
    want: &mut Want,
    said: &mut Said,
    out: &mut Printer,
) -> Done {
    let Some((at, height)) = said.stand.left_hole.take() else { return Ok(()) };
    // only where nothing moved the tool since
    if at != said.stand.position {
        return Ok(());
    }
    if said.lacks(want, shape).has(VarId::Work) {
        // in another offset all axes are said again: at the job's height
        said.stand.position.set(shape.depth, height);
        return Ok(());
    }
    let across = (0..6).any(|axis| axis != shape.depth && target.get(axis) != at.get(axis));
    let lower = at.get(shape.depth).is_some_and(|left| left < height);
    if free && !(across && lower) {
        // the next cut still begins at the job's height
        let as_high = target.get(shape.depth) == at.get(shape.depth);
        said.stand.left_hole = as_high.then_some((*target, height));
        return Ok(());
    }
    let mut to = said.stand.position;
    to.set(shape.depth, height);
    to.given = shape.depth_bit();
    set_targets(&to, shape, want, said)?;
    split_rapid(&to, shape, want, said, out)
}

/// Prints what must stand before a cut to a target, and gives the form's sequences their target.
pub fn cut_goes_to(target: &Axes, shape: &Shape, want: &mut Want, said: &mut Said, out: &mut Printer) -> Done {
    if said.is_unsettled(want) {
        settle_here(true, shape, want, said, out)?;
    }
    stands_at_cut(said)?;
    set_targets(target, shape, want, said)?;
    if shape.watches_moves {
        upons(MOVE_VARS, shape, want, said, out)?;
    }
    Ok(())
}

/// A new tool comes from where nobody knows: its first cut must have a beginning.
#[cold]
pub fn begins_somewhere(target: &Axes, shape: &Shape, said: &mut Said) -> Done {
    // the upper guides of a wire follow the lower ones
    let axes = if shape.linear == 4 { 2 } else { shape.linear };
    let needed = target.given | said.stand.fresh_tool.take().unwrap_or(0);
    let unknown = needed & !said.stand.position.given & ((1 << axes) - 1);
    if unknown == 0 || shape.program.settings.incremental {
        return Ok(());
    }
    let unsaid = (0..6).filter(|axis| unknown & 1 << axis != 0).map(|axis| char::from(shape.axes[axis]).to_string());
    let unsaid = unsaid.collect::<Vec<_>>().join(" and ");
    let message = format!(
        "the operation begins with a cut, and nothing before it says {unsaid} since the tool change or the way home"
    );
    fault(Code::PR012, message, "begin it with a rapid to the beginning of its first cut")
}
