//! Prints the codes of plane, motion and feed before a sequence of moves that does not print them.

use super::cx::Writer;
use super::fault::{Done, fault_at};
use super::prints::{moves_without_motion, prints_angle, prints_axis, prints_code, prints_motion, words_of};
use super::said::Said;
use super::shape::Shape;
use super::words::{code_word, feed_word};
use crate::compile::Routine;
use crate::control::Code;
use crate::diag;
use crate::lang::{Machine, VarId};
use crate::sema;
use crate::toolpath::Axes;

/// Prints the plane's code in a separate block if the sequence needs the code and does not print it.
pub fn plane_block(plane: Code, routine: &Routine, writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    if writer.said.is_in_plane(plane) || prints_code(routine, |code| shape.is_plane(code), shape) {
        return Ok(());
    }
    enter_plane(plane, writer)
}

/// Prints the plane's code in a separate block if the control is in another plane. Only mills have planes.
pub fn enter_plane(plane: Code, writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    if !writer.said.is_in_plane(plane) && shape.program.settings.machine == Machine::Mill {
        code_word(&sema::Code::plain(plane), writer)?;
        writer.out.end_block();
    }
    Ok(())
}

/// Prints the motion code before a sequence of moves without a motion code, if the control is in another motion.
/// Without the motion code, a cut could become a rapid. Returns whether the code was printed.
fn motion_before(code: &sema::Code, routine: &Routine, writer: &mut Writer<'_>) -> Done<bool> {
    let shape = writer.shape;
    let lacks = !writer.said.motion_in_force(code) && shape.program.speaks_g && !prints_motion(routine, shape);
    if lacks {
        code_word(code, writer)?;
    }
    Ok(lacks)
}

/// Prints the motion code in a separate block, before a sequence of rapids without a motion code.
pub fn motion_block(code: &sema::Code, routine: &Routine, writer: &mut Writer<'_>) -> Done {
    motion_before(code, routine, writer)?;
    writer.out.end_block();
    Ok(())
}

/// Prints the motion code before a sequence that moves without a motion code: the feed code for cuts, the rapid code
/// for everything else.
pub fn way_before(routine: &Routine, writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    let program = shape.program;
    let code = if writer.want.cutting { &program.settings.feed } else { &program.settings.rapid };
    let known = writer.said.is_in_motion(code);
    if known || !program.speaks_g || !moves_without_motion(routine, shape) {
        return Ok(());
    }
    code_word(code, writer)?;
    if writer.want.cutting && !writer.want.inverse_time() {
        feed_word(writer)?;
    }
    writer.out.end_block();
    Ok(())
}

/// Prints motion code and feed in a separate block, before a sequence that lacks the motion code or the feed. Arc
/// sequences print their own code.
pub fn feed_block(code: &sema::Code, routine: &Routine, writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    let begun = code.code == shape.program.settings.feed.code && motion_before(code, routine, writer)?;
    let says_feed = routine.vars.has(VarId::Frate);
    if !says_feed && writer.want.inverse_time() {
        let message = "in inverse time each move needs its feed, but the sequence does not print [frate]";
        return fault_at(diag::Code::PR017, message, "add `F[frate]` to the sequence", Some(routine.span));
    }
    // Grbl refuses G1 if no feed was set before
    if !says_feed || begun && !writer.want.inverse_time() {
        feed_word(writer)?;
    }
    writer.out.end_block();
    Ok(())
}

/// Checks that a motion sequence prints every axis that moves; otherwise the move would be lost.
pub fn check_prints(routine: &Routine, target: &Axes, shape: &Shape, said: &Said) -> Done {
    let moves = |axis: usize| target.get(axis).is_some() && target.get(axis) != said.stand.position.get(axis);
    let lost = (0..shape.linear).find(|&axis| moves(axis) && !prints_axis(routine, axis, shape));
    let turns = said.turned_axes(target, shape).find(|&axis| !prints_angle(routine, axis, shape));
    let word = match (lost, turns) {
        (Some(axis), _) => format!("[{}]", words_of(axis, shape)[0].name()),
        (None, Some(axis)) => format!("{}[rotangle]", char::from(shape.axes[axis])),
        (None, None) => return Ok(()),
    };
    let message = format!("this move changes {word}, but the sequence does not print it");
    fault_at(diag::Code::PR017, message, format!("add the word of {word} to the sequence"), Some(routine.span))
}
