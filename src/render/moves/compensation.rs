//! Moves that turn cutter compensation on and off.

use super::measure::measure;
use super::reach::{begins_somewhere, cut_goes_to, reach};
use crate::control::{self, Meaning};
use crate::diag::Code;
use crate::lang::{Machine, SequenceId, VarId};
use crate::render::body::run_all;
use crate::render::fault::{Done, fault, fault_at};
use crate::render::prelude::{check_prints, enter_plane, feed_block, plane_block};
use crate::render::printer::Printer;
use crate::render::said::{LastMove, Said};
use crate::render::shape::Shape;
use crate::render::upon::upons;
use crate::render::want::Want;
use crate::render::words::{AxisUnits, axis_units, axis_words, feed_word, letter_word, motion_word, value_code};
use crate::toolpath::{Axes, Infeed, Side};

/// The move that turns cutter compensation on.
pub fn infeed(
    infeed: &Infeed,
    feed: Option<f64>,
    shape: &Shape,
    want: &mut Want,
    said: &mut Said,
    out: &mut Printer,
) -> Done {
    shape.needs(Meaning::SideLeft)?;
    let [left, right, _] = shape.program.settings.cdc;
    let mirrored = shape.scales[1] < 0.0; // a turret on the other side
    let code = if (infeed.side == Side::Left) != mirrored { left } else { right };
    let reversed = |axis: usize| shape.letters[shape.axes[axis]].reversed;
    if reversed(0) != reversed(1) && left < right {
        let message = "one axis is printed with the other sign, and the offset would be on the other side";
        return fault(Code::PR036, message, "exchange the codes: `CDC 42 41 40`");
    }
    want.set(VarId::Side, code);
    let switch = Switch { id: SequenceId::InFeed, code, offset: true, feed, rapid: infeed.rapid };
    compensate(&infeed.to, &switch, shape, want, said, out)?;
    want.compensated = true;
    Ok(())
}

/// The move that turns it off.
pub fn outfeed(
    to: &Axes,
    feed: Option<f64>,
    rapid: bool,
    shape: &Shape,
    want: &mut Want,
    said: &mut Said,
    out: &mut Printer,
) -> Done {
    let off = shape.program.settings.cdc[2];
    want.set(VarId::Side, off);
    let switch = Switch { id: SequenceId::OutFeed, code: off, offset: false, feed, rapid };
    compensate(to, &switch, shape, want, said, out)?;
    want.compensated = false;
    Ok(())
}

/// How compensation is turned on or off.
struct Switch {
    id: SequenceId,
    code: f64,
    /// The offset register is said with it.
    offset: bool,
    feed: Option<f64>,
    /// The job rapids there; a sequence of the form feeds all the same, which is slower and not wrong.
    rapid: bool,
}

/// The move of an infeed or an outfeed.
fn compensate(to: &Axes, switch: &Switch, shape: &Shape, want: &mut Want, said: &mut Said, out: &mut Printer) -> Done {
    let program = shape.program;
    let &Switch { id, code, offset, feed, rapid } = switch;
    if rapid && program.routine(id).is_some() {
        let message = format!("a rapid with cutter compensation is printed by {}, which may feed", id.name());
        out.note(Code::PR022, message, "look at the move");
    }
    let rapid = rapid && program.routine(id).is_none();
    let target = reach(to, false, shape, want, said, out)?;
    if said.stand.fresh_tool.is_some() && !rapid {
        begins_somewhere(&target, shape, said)?;
    }
    if !rapid {
        want.take_feed(feed, shape)?;
    }
    cut_goes_to(&target, shape, want, said, out)?;
    if shape.measures {
        measure(&target, !rapid, want, said);
    }
    if let Some(routine) = shape.routine(id, want, said) {
        let tapers = shape.linear == 4 && (2..4).any(|axis| to.get(axis).is_some());
        let blocks = routine.steps().filter(|&i| matches!(program.ops[i], crate::compile::Op::Line { .. })).count();
        if tapers && blocks > 1 {
            let message = format!("{} has {blocks} blocks, a four-axis wire takes one", id.name());
            return fault_at(Code::PR008, message, "write the sequence on one line", Some(routine.span));
        }
        check_prints(routine, &target, shape, said)?;
        // among increments no register holds a height: it is where the moves so far lead
        if program.settings.machine == Machine::Mill
            && !program.settings.incremental
            && !routine.vars.has(VarId::D)
            && said.differs_from(&target, shape.depth_bit(), shape)
        {
            let message = format!("nobody knows the height here, and {} does not print it", id.name());
            let help = "put a rapid before it, or the word of [d] into the sequence";
            return fault_at(Code::PR017, message, help, Some(routine.span));
        }
        plane_block(control::Code::g(17), routine, shape, want, said, out)?;
        upons(routine.vars, shape, want, said, out)?;
        feed_block(&program.settings.feed, routine, shape, want, said, out)?;
        run_all(routine, shape, want, said, out)?;
    } else {
        enter_plane(control::Code::g(17), shape, want, said, out)?;
        motion_word(if rapid { &program.settings.rapid } else { &program.settings.feed }, shape, want, said, out)?;
        value_code(b'G', code, shape, want, said, out)?;
        let mut axes = AxisUnits::default();
        axis_units(&target, &mut axes, shape, said)?;
        axis_words(&target, &axes, shape, said, out)?;
        if offset && program.settings.machine != Machine::Lathe {
            let Some(register) = want.get(VarId::Dcomp) else {
                out.clear_block();
                let help = "give the tool a \"diameter_offset\"";
                return fault(Code::PR001, "cutter compensation without an offset register", help);
            };
            letter_word(program.settings.cdc_code, register, shape, said, out)?;
        }
        if !rapid {
            feed_word(shape, want, said, out)?;
        }
        out.end_block();
    }
    said.stand.position = target;
    said.last_move = if rapid { LastMove::Rapid } else { LastMove::Line };
    Ok(())
}
