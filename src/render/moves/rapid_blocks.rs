//! Rapids as blocks: in one block, or in two (up first or down last).

use super::measure::measure;
use crate::diag::Code;
use crate::lang::SequenceId;
use crate::render::body::{Mode, run};
use crate::render::cx::Cx;
use crate::render::fault::{Done, fault};
use crate::render::prelude::{check_prints, motion_block};
use crate::render::program::home::after_home;
use crate::render::said::{LastMove, Said};
use crate::render::shape::Shape;
use crate::render::targets::set_targets;
use crate::render::upon::upons;
use crate::render::vars::NOW;
use crate::render::words::move_block;
use crate::sema;
use crate::toolpath::Axes;

/// Prints a rapid to a target in program units: as one block, or as two blocks if the form has the `VRapid` command.
pub fn rapid_to(target: &Axes, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    if shape.program.settings.depth_rapid.is_some()
        && shape.linear == 3
        && changes_depth_and_plane(target, shape, cx.said)
    {
        return split_rapid(target, cx);
    }
    rapid_block(target, None, cx)
}

/// Prints a rapid that goes up first or down last: for rapids between holes, and for forms with the `VRapid` command.
pub fn split_rapid(target: &Axes, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let code = shape.program.settings.depth_rapid.clone();
    if !changes_depth_and_plane(target, shape, cx.said) {
        let depth_only =
            target.given & shape.depth_bit() != 0 && cx.said.differs_from(target, shape.depth_bit(), shape);
        return rapid_block(target, code.filter(|_| depth_only), cx);
    }
    // each of the two rapids moves only its own axes; the other axes do not move, whether they are printed or not
    let depth = shape.depth_bit();
    let part = |axes: u8| Axes { given: target.given & axes, ..*target };
    if is_below(target, shape, cx.said)? {
        rapid_block(&part(depth), code, cx)?;
        rapid_block(target, None, cx)
    } else {
        rapid_block(&part(!depth), None, cx)?;
        rapid_block(target, code, cx)
    }
}

/// Whether the tool is below the target, so that it must move up before it moves across. A tool at an unknown height counts
/// as above the target. After a change of the work offset, a tool that the form has retracted is above the target.
///
/// # Errors
/// The tool's height is a number of another work offset, and this number is below the target: whether the tool is below
/// the target depends on the zero points.
pub fn is_below(target: &Axes, shape: &Shape, said: &Said) -> Done<bool> {
    let from = said.stand.position.get(shape.depth).or(said.stand.left_at);
    let is_below = from.is_some_and(|from| target.values[shape.depth] > from);
    if !is_below || !said.stand.is_of_other_work() {
        return Ok(is_below);
    }
    if said.stand.is_retracted {
        return Ok(false);
    }
    let message = "the work offset changes before this move, so whether the tool is below the target is unknown";
    let help = "retract in the form, with `G0 G53 Z0` before G[work] in `WorkChange` or `Upon [work]`; or put a rapid to \
        a height above the target before the change of the work offset";
    fault(Code::PR017, message, help)
}

/// Whether a rapid changes the height and another axis.
pub fn changes_depth_and_plane(target: &Axes, shape: &Shape, said: &Said) -> bool {
    said.differs_from(target, shape.depth_bit(), shape) && said.differs_from(target, 0x3f & !shape.depth_bit(), shape)
}

pub fn rapid_block(target: &Axes, code: Option<sema::Code>, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let program = shape.program;
    if cx.said.from_home && target.given & shape.depth_bit() != 0 {
        after_home(target, cx)?;
    }
    // the depth part of VRapid has its own code, which the sequence can't print
    match program.routine(SequenceId::RapidCode).filter(|_| code.is_none()) {
        Some(routine) if cx.said.differs_from(target, 0x3f, shape) => {
            let mut whole = cx.said.stand.position;
            for axis in (0..6).filter(|axis| target.given & 1 << axis != 0) {
                whole.set(axis, target.values[axis]);
            }
            set_targets(&whole, shape, cx.want, cx.said)?;
            // the variable of an unknown axis may still hold the height of a hole
            for axis in (0..shape.linear.min(3)).filter(|axis| whole.given & 1 << axis == 0) {
                cx.want.put(NOW[axis], None);
            }
            measure(target, false, cx);
            let routine = shape.way(routine, cx.want, cx.said);
            check_prints(routine, target, shape, cx.said)?;
            upons(routine.vars, cx)?;
            motion_block(&program.settings.rapid, routine, &mut cx.writer())?;
            run(routine, Mode::Motion, &mut cx.writer())?;
        }
        Some(_) => {}
        None => {
            match &code {
                Some(code) => move_block(target, code, false, &mut cx.writer())?,
                None => move_block(target, &program.settings.rapid, false, &mut cx.writer())?,
            };
        }
    }
    cx.said.stand.move_to(target);
    cx.said.last_move = LastMove::Rapid;
    Ok(())
}

pub fn raise(target: &Axes, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let above = Axes { given: shape.depth_bit(), ..*target };
    set_targets(&above, shape, cx.want, cx.said)?;
    split_rapid(&above, cx)?;
    set_targets(target, shape, cx.want, cx.said)
}
