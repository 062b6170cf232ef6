//! Moves that turn cutter compensation on and off.

use super::measure::measure;
use super::prepare::{begin_cut, cut_goes_to};
use crate::control::{self, Meaning};
use crate::diag::Code;
use crate::lang::{Machine, SequenceId, VarId};
use crate::render::body::run_all;
use crate::render::cx::Cx;
use crate::render::fault::{Done, fault, fault_at};
use crate::render::prelude::{check_prints, enter_plane, feed_block, plane_block};
use crate::render::said::LastMove;
use crate::render::upon::upons;
use crate::render::words::{AxisUnits, axis_units, axis_words, feed_word, letter_word, motion_word, value_code};
use crate::toolpath::{Axes, Infeed, Side};

/// Prints the move that turns cutter compensation on.
pub fn infeed(infeed: &Infeed, feed: Option<f64>, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    shape.needs(Meaning::SideLeft)?;
    let [left, right, _] = shape.program.settings.cdc;
    let mirrored = shape.scales[1] < 0.0; // a turret on the other side
    let code = if (infeed.side == Side::Left) != mirrored { left } else { right };
    let reversed = |axis: usize| shape.letters[shape.axes[axis]].reversed;
    if reversed(0) != reversed(1) && left < right {
        let message = "one axis is reversed, so the offset would be on the wrong side";
        return fault(Code::PR036, message, "exchange the codes: `CDC 42 41 40`");
    }
    cx.want.set(VarId::Side, code);
    let switch = Switch { id: SequenceId::InFeed, code, offset: true, feed, rapid: infeed.rapid };
    compensate(&infeed.to, &switch, cx)?;
    cx.want.compensated = true;
    Ok(())
}

/// Prints the move that turns cutter compensation off.
pub fn outfeed(to: &Axes, feed: Option<f64>, rapid: bool, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let off = shape.program.settings.cdc[2];
    cx.want.set(VarId::Side, off);
    let switch = Switch { id: SequenceId::OutFeed, code: off, offset: false, feed, rapid };
    compensate(to, &switch, cx)?;
    cx.want.compensated = false;
    Ok(())
}

/// How a move turns cutter compensation on or off.
struct Switch {
    id: SequenceId,
    code: f64,
    /// Whether the block also prints the offset register.
    offset: bool,
    feed: Option<f64>,
    /// Whether the job requests a rapid. A sequence of the form may print a feed move instead, which is slower but
    /// correct.
    rapid: bool,
}

/// Prints the move that turns cutter compensation on (infeed) or off (outfeed).
fn compensate(to: &Axes, switch: &Switch, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let program = shape.program;
    let &Switch { id, code, offset, feed, rapid } = switch;
    if rapid && program.routine(id).is_some() {
        let message = format!("a rapid with cutter compensation is printed by {}, which may be at feed", id.name());
        cx.out.note(Code::PR022, message, "check the move");
    }
    let rapid = rapid && program.routine(id).is_none();
    let target = begin_cut(to, (!rapid).then_some(feed), cx)?;
    cut_goes_to(&target, true, cx)?;
    if shape.measures {
        measure(&target, !rapid, cx);
    }
    if let Some(routine) = shape.routine(id, cx.want, cx.said) {
        let tapers = shape.linear == 4 && (2..4).any(|axis| to.get(axis).is_some());
        let blocks = routine.steps().filter(|&i| matches!(program.ops[i], crate::compile::Op::Line { .. })).count();
        if tapers && blocks > 1 {
            let message = format!("{} has {blocks} blocks, but a four-axis wire needs exactly one", id.name());
            return fault_at(Code::PR008, message, "write the sequence on one line", Some(routine.span));
        }
        check_prints(routine, &target, shape, cx.said)?;
        // with incremental moves the registers hold no height, so this check does not apply
        if program.settings.machine == Machine::Mill
            && !program.settings.incremental
            && !routine.vars.has(VarId::D)
            && cx.said.differs_from(&target, shape.depth_bit(), shape)
        {
            let message = format!("the height is unknown here, and {} does not print it", id.name());
            let help = "put a rapid before this move, or print [d] in the sequence";
            return fault_at(Code::PR017, message, help, Some(routine.span));
        }
        plane_block(control::Code::g(17), routine, &mut cx.writer())?;
        upons(routine.vars, cx)?;
        feed_block(&program.settings.feed, routine, &mut cx.writer())?;
        run_all(routine, &mut cx.writer())?;
    } else {
        enter_plane(control::Code::g(17), &mut cx.writer())?;
        motion_word(if rapid { &program.settings.rapid } else { &program.settings.feed }, &mut cx.writer())?;
        value_code(b'G', code, &mut cx.writer())?;
        let mut axes = AxisUnits::default();
        axis_units(&target, &mut axes, shape, cx.said)?;
        axis_words(&target, &axes, shape, cx.said, cx.out)?;
        if offset && program.settings.machine != Machine::Lathe {
            let Some(register) = cx.want.get(VarId::Dcomp) else {
                cx.out.clear_block();
                let help = "give the tool a \"diameter_offset\"";
                return fault(Code::PR001, "cutter compensation without an offset register", help);
            };
            letter_word(program.settings.cdc_code, register, shape, cx.said, cx.out)?;
        }
        if !rapid {
            feed_word(&mut cx.writer())?;
        }
        cx.out.end_block();
    }
    cx.said.stand.position = target;
    cx.said.last_move = if rapid { LastMove::Rapid } else { LastMove::Line };
    Ok(())
}
