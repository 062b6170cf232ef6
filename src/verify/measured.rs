//! The frames in which a program makes its rapids: work offset, shifts, tool length and cutter compensation. The same
//! numbers are other positions of the machine in another frame.

use super::cut::{ALL, Place, number, same, shown};
use super::tables::ANGLE;
use crate::toolpath::Side;

/// The zero of a program. A work offset that the program does not set is at the machine's zero.
pub(super) struct Zero {
    /// Machine position of the zero.
    pub at: Place,
    /// Rotation about the zero, in degrees.
    pub angle: f64,
    /// As bits, the axes for which the program has set the work offset to a machine position.
    pub set: u8,
    /// As bits, the axes that were shifted from an unknown machine position.
    pub unknown: u8,
}

/// The frame of the axes, without the height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Across {
    pub work: Option<f64>,
    /// Machine position of the program's zero. Its height is 0, see [`Level::zero`].
    pub zero: Place,
    /// Rotation about the zero, in degrees.
    pub angle: f64,
    /// The side and the register of the cutter compensation.
    pub side: Option<Side>,
    pub diameter: Option<f64>,
}

/// The frame of the height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Level {
    pub tool: Option<f64>,
    pub work: Option<f64>,
    /// Register of the tool length.
    pub length: Option<f64>,
    /// Machine height of the program's zero, with the tool length that the program gives as a number (G43.1).
    pub zero: f64,
}

/// The frames of a program at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frames {
    pub across: Across,
    pub level: Level,
}

/// The frames of the rapids between two cuts, each with the index of its first rapid.
#[derive(Clone, Debug, Default)]
pub(super) struct Measured {
    across: Vec<(usize, Across)>,
    levels: Vec<(usize, Level)>,
}

impl Measured {
    /// Records the frames of the rapid with this index. `has_height`: whether the height of the rapid is known.
    pub fn rapid(&mut self, at: usize, frames: &Frames, has_height: bool) {
        if self.across.last().is_none_or(|(_, last)| *last != frames.across) {
            self.across.push((at, frames.across));
        }
        if has_height && self.levels.last().is_none_or(|(_, last)| *last != frames.level) {
            self.levels.push((at, frames.level));
        }
    }

    /// Whether there are no rapids.
    pub fn is_empty(&self) -> bool {
        self.across.is_empty()
    }

    pub fn clear(&mut self) {
        self.across.clear();
        self.levels.clear();
    }
}

impl Across {
    pub fn is(&self, other: &Across, tolerance: f64) -> bool {
        (self.work, self.side, self.diameter) == (other.work, other.side, other.diameter)
            && (self.angle - other.angle).abs() <= ANGLE
            && same(&self.zero, &other.zero, ALL, tolerance)
    }

    /// The frame in words.
    pub fn text(&self) -> String {
        let mut text = work(self.work);
        if self.zero[..6] != [0.0; 6] || self.angle != 0.0 {
            text += &format!(", zero shifted to {} and rotated by {}", shown(&self.zero, 0b11), number(self.angle));
        }
        let side = match self.side {
            Some(Side::Left) => "cutter compensation left",
            Some(Side::Right) => "cutter compensation right",
            None => "no cutter compensation",
        };
        let register = self.diameter.map_or(String::new(), |register| format!(" D{}", number(register)));
        text + ", " + side + &register
    }
}

impl Level {
    pub fn is(&self, other: &Level, tolerance: f64) -> bool {
        (self.tool, self.work, self.length) == (other.tool, other.work, other.length)
            && (self.zero - other.zero).abs() <= tolerance
    }

    /// The frame in words. `tool`: the name of the tool.
    pub fn text(&self, tool: &str) -> String {
        let length = match self.length {
            None => "no tool length offset".to_owned(),
            Some(0.0) => "a tool length from the program".to_owned(),
            Some(register) if register < 0.0 => format!("tool length offset G44 H{}", number(-register)),
            Some(register) => format!("tool length offset H{}", number(register)),
        };
        let zero = if self.zero == 0.0 { String::new() } else { format!(", zero shifted to Z{}", number(self.zero)) };
        format!("tool {tool}, {length}, {}{zero}", work(self.work))
    }
}

fn work(work: Option<f64>) -> String {
    work.map_or("no work offset".to_owned(), |work| format!("work offset {}", number(work)))
}

/// The rapids of one program between two cuts, with the frames of these cuts. Without a cut, the frames are `None`.
pub(super) struct Between<'a> {
    pub measured: &'a Measured,
    pub before: Option<&'a Frames>,
    pub next: Option<&'a Frames>,
}

/// A frame of a rapid that is not a frame of the other program.
pub(super) enum Other {
    Across([Option<Across>; 2]),
    Level([Option<Level>; 2]),
}

/// The first frame of the rapids in which two programs differ: the frame in the old and in the new program.
/// `same_rapids`: both programs have the same rapids, so that each of them must have the same frame. Otherwise a program
/// may have more or fewer rapids in the frames of the cuts before and after them.
pub(super) fn differs(
    old: &Between<'_>,
    new: &Between<'_>,
    same_rapids: bool,
    across: impl Fn(&Across, &Across) -> bool,
    level: impl Fn(&Level, &Level) -> bool,
) -> Option<Other> {
    let levels = [old, new].map(|side| {
        let ends = [side.before, side.next].map(|frames| frames.map(|frames| frames.level));
        inner(&side.measured.levels, ends, same_rapids, &level)
    });
    if let Some(pair) = first(levels, same_rapids, &level) {
        return Some(Other::Level(pair));
    }
    let across_of = [old, new].map(|side| {
        let ends = [side.before, side.next].map(|frames| frames.map(|frames| frames.across));
        inner(&side.measured.across, ends, same_rapids, &across)
    });
    first(across_of, same_rapids, &across).map(Other::Across)
}

/// The frames without the frame of the last cut at the start, and without the frame of the next cut at the end.
fn inner<T>(
    frames: &[(usize, T)],
    [before, next]: [Option<T>; 2],
    all: bool,
    is: impl Fn(&T, &T) -> bool,
) -> &[(usize, T)] {
    let is_end = |end: &Option<T>, frame: &T| !all && end.as_ref().is_some_and(|end| is(end, frame));
    let frames = match frames {
        [(_, first), rest @ ..] if is_end(&before, first) => rest,
        frames => frames,
    };
    match frames {
        [rest @ .., (_, last)] if is_end(&next, last) => rest,
        frames => frames,
    }
}

/// The first pair of different frames.
fn first<T: Copy>(
    [old, new]: [&[(usize, T)]; 2],
    by_rapid: bool,
    is: impl Fn(&T, &T) -> bool,
) -> Option<[Option<T>; 2]> {
    let is = |a: &(usize, T), b: &(usize, T)| is(&a.1, &b.1) && (!by_rapid || a.0 == b.0);
    let at = (0..old.len().max(new.len())).find(|&at| match (old.get(at), new.get(at)) {
        (Some(a), Some(b)) => !is(a, b),
        _ => true,
    })?;
    Some([old, new].map(|list| list.get(at).map(|(_, frame)| *frame)))
}
