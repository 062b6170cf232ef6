//! The words of generated blocks: axes, increments, codes, the feed.

use super::cx::Writer;
use super::fault::{Done, fault, fault_at};
use super::numbers::{ROUNDED, as_number, loses, quantised};
use super::printer::Printer;
use super::said::{Line, Said};
use super::shape::Shape;
use super::want::Want;
use crate::compile::Letter;
use crate::diag::Code;
use crate::lang::VarId;
use crate::sema;
use crate::toolpath::Axes;

/// A target in units of its letters.
#[derive(Default)]
pub struct AxisUnits {
    pub units: [i64; 6],
    /// Axes whose value differs from the printed value.
    pub changed: u8,
    /// Axes whose words must be printed: the axes changed, or their words are never left out.
    pub prints: u8,
}

/// Computes a target in units of its letters, and the axes that must be printed.
#[inline]
pub fn axis_units(target: &Axes, found: &mut AxisUnits, shape: &Shape, said: &Said) -> Done {
    let mut axes = target.given;
    while axes != 0 {
        let axis = axes.trailing_zeros() as usize;
        axes &= axes - 1;
        let info = &shape.letters[shape.axes[axis]];
        let units = quantised(info, target.values[axis] * shape.scales[axis])?;
        found.units[axis] = units;
        let changed = !said.holds(info, units);
        found.changed |= u8::from(changed) << axis;
        found.prints |= u8::from(changed || !info.modal) << axis;
    }
    Ok(())
}

/// Prints the words of the axes that must be printed.
#[inline]
pub fn axis_words(target: &Axes, axes: &AxisUnits, shape: &Shape, said: &mut Said, out: &mut Printer) -> Done {
    if shape.program.settings.incremental {
        return increments(target, axes.prints, shape, said, out);
    }
    let mut left = axes.prints;
    while left != 0 {
        let axis = left.trailing_zeros() as usize;
        left &= left - 1;
        let info = &shape.letters[shape.axes[axis]];
        out.letter(info, axes.units[axis], false)?;
        said.word(info, axes.units[axis]);
    }
    Ok(())
}

/// Whether the printed value of a target differs from the printed value of the tool's position. A zero increment is no
/// move, even if the last value of the letter is unknown.
#[cold]
fn has_increment(target: &Axes, shape: &Shape, said: &Said) -> Done<bool> {
    for axis in 0..6 {
        let (Some(from), Some(to)) = (said.stand.position.get(axis), target.get(axis)) else {
            if target.get(axis).is_some() {
                return Ok(true);
            }
            continue;
        };
        let (info, scale) = (&shape.letters[shape.axes[axis]], shape.scales[axis]);
        if quantised(info, from * scale)? != quantised(info, to * scale)? {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Prints increments between rounded positions, so that the increments add up exactly.
pub fn increments(target: &Axes, axes: u8, shape: &Shape, said: &mut Said, out: &mut Printer) -> Done {
    for axis in 0..6 {
        if axes & 1 << axis == 0 {
            continue;
        }
        let info = &shape.letters[shape.axes[axis]];
        let Some(from) = said.stand.position.get(axis) else {
            return fault(
                Code::PR001,
                format!("an increment of {} from an unknown position", char::from(info.printed)),
                "after a new work offset or a typed axis word the position is unknown: print a position with a \
                 variable first, as in a tool change",
            );
        };
        let scale = shape.scales[axis];
        let (from, to) = (quantised(info, from * scale)?, quantised(info, target.values[axis] * scale)?);
        if to != from {
            out.letter(info, to - from, false)?;
        }
        said.word(info, to);
    }
    Ok(())
}

/// Prints the motion code, unless it is active and may be left out.
#[inline]
pub fn motion_word(code: &sema::Code, writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    if writer.said.code_drops(code.code, shape) {
        return Ok(());
    }
    code_word(code, writer)
}

/// Prints a code as typed in its command. A code that is typed without its letter is printed in the format of the
/// letter.
pub fn code_word(code: &sema::Code, writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    let info = &shape.letters[code.letter()];
    match &code.text {
        Some(text) => writer.out.text(text, false),
        None => writer.out.letter(info, quantised(info, code.value())?, false)?,
    }
    writer.said.code_word(info, code.value(), Line::NONE, writer.want, shape);
    Ok(())
}

/// Prints the code of a value from the job or the form's commands, in its letter's format.
pub fn value_code(letter: u8, value: f64, writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    let info = &shape.letters[letter];
    writer.out.letter(info, quantised(info, value)?, false)?;
    writer.said.code_word(info, value, Line::NONE, writer.want, shape);
    Ok(())
}

/// Prints a word that is a parameter of the code before it: the time of a dwell, the angle of an orientation. If the
/// letter of the parameter is that of an axis, the feed or the speed, the value of the letter is unknown afterwards.
pub fn parameter_word(letter: u8, value: f64, shape: &Shape, said: &mut Said, out: &mut Printer) -> Done {
    letter_word(letter, value, shape, said, out)?;
    said.forget(&shape.letters[letter]);
    said.parameter_of_code(letter, shape);
    Ok(())
}

/// Prints the word of one axis, even if the value did not change.
pub fn axis_word(axis: usize, target: &Axes, shape: &Shape, said: &mut Said, out: &mut Printer) -> Done {
    letter_word(shape.axes[axis], target.values[axis] * shape.scales[axis], shape, said, out)
}

/// Prints a letter with a value, even if the value did not change.
pub fn letter_word(letter: u8, value: f64, shape: &Shape, said: &mut Said, out: &mut Printer) -> Done {
    let info = &shape.letters[letter];
    let units = quantised(info, value)?;
    out.letter(info, units, false)?;
    said.word(info, units);
    Ok(())
}

/// Prints the speed of the spindle, even if the speed did not change.
pub fn speed_word(speed: f64, writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    let letter = shape.program.settings.speed_code;
    let info = &shape.letters[letter];
    check_feed(info, VarId::Speed, speed, quantised(info, speed)?, writer.want, writer.out)?;
    letter_word(letter, speed, shape, writer.said, writer.out)
}

/// Prints the feed if it changed. With inverse time, the feed is always printed.
#[inline]
pub fn feed_word(writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    let info = &shape.letters[shape.program.settings.feed_code];
    if let Some(units) = writer.want.feed_units()
        && writer.said.holds(info, units)
        && info.modal
        && !writer.want.inverse_time()
    {
        return Ok(());
    }
    let Some(feed) = writer.want.feed() else { return Ok(()) };
    let units = quantised(info, feed)?;
    check_feed(info, VarId::Frate, feed, units, writer.want, writer.out)?;
    if writer.said.holds(info, units) && info.modal && !writer.want.inverse_time() {
        return Ok(());
    }
    writer.out.letter(info, units, false)?;
    writer.said.word(info, units);
    Ok(())
}

/// Checks the rounding of a feed: rounding to zero is an error. A rounding error above 1 % is reported. For the pitch
/// of a tap, the limit is 0.25 %.
#[inline]
pub fn check_feed(info: &Letter, var: VarId, value: f64, units: i64, want: &Want, out: &mut Printer) -> Done {
    const OF_TAP: f64 = 0.0025;
    let taps = want.cycle.is_some_and(|kind| kind.inwards().is_some());
    let printed = as_number(units, info.format.dec.count);
    if !loses(value, printed, if taps { OF_TAP } else { ROUNDED }) {
        return Ok(());
    }
    lost_digits(info, var, value, printed, out)
}

#[cold]
fn lost_digits(info: &Letter, var: VarId, value: f64, printed: f64, out: &mut Printer) -> Done {
    let (name, format) = (var.name(), &info.format);
    if printed == 0.0 {
        let message = format!("[{name}] is {value}, but prints as 0 in the format `{format}`");
        return fault_at(Code::PR002, message, "give the letter more decimals", None);
    }
    const MOST: usize = 5; // all of them have the same cause: the letter's format
    if out.notes().iter().filter(|note| note.code == Code::PR025).count() == MOST {
        return Ok(());
    }
    let percent = (printed.abs() / value.abs() - 1.0) * 100.0;
    let letter = char::from(info.printed);
    let message = format!("[{name}] is {value:.5}, but prints as {letter}{printed}: {percent:+.1} %");
    if out.notes().iter().any(|note| note.message == message) {
        return Ok(());
    }
    out.note(Code::PR025, message, "give the letter more decimals, or use a value with fewer digits in the job");
    Ok(())
}

/// Prints a generated block: motion code, changed axes, feed. If nothing changed, prints nothing.
#[inline]
pub fn move_block(target: &Axes, code: &sema::Code, feeds: bool, writer: &mut Writer<'_>) -> Done<bool> {
    let shape = writer.shape;
    let mut axes = AxisUnits::default();
    axis_units(target, &mut axes, shape, writer.said)?;
    if axes.changed == 0 || (shape.program.settings.incremental && !has_increment(target, shape, writer.said)?) {
        return Ok(false);
    }
    motion_word(code, writer)?;
    axis_words(target, &axes, shape, writer.said, writer.out)?;
    if feeds {
        feed_word(writer)?;
    }
    writer.out.end_block();
    Ok(true)
}

/// Prints the generated dwell block.
pub fn dwell_block(seconds: f64, writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    let dwell = &shape.program.settings.dwell;
    let (info, time) = (&shape.letters[dwell.letter], if dwell.milliseconds { seconds * 1000.0 } else { seconds });
    let units = quantised(info, time)?;
    check_feed(info, VarId::Dwell, time, units, writer.want, writer.out)?;
    code_word(&dwell.code, writer)?;
    parameter_word(dwell.letter, time, shape, writer.said, writer.out)?;
    writer.out.end_block();
    Ok(())
}
