//! Chamfers and rounded corners of lathes. I, K or R in a straight cut along one axis requests a corner. The next block
//! must continue along the other axis.
//!
//! Sources: Fanuc's operator's manual of the 0i-T (chamfering and corner R), Haas's lathe operator's manual (G1). The
//! sign of the word is the direction of the next block. The next block is measured from the corner point, although the
//! tool does not reach this point. The next block must be at least as long as the chamfer.

use crate::control::Meaning;
use crate::diag::Code;
use crate::nc::action::{Action, Position, Turn};
use crate::nc::block::Block;
use crate::nc::codes::{Group, Motion, letters};
use crate::nc::fault::{Done, refuse};
use crate::nc::out::Out;
use crate::nc::profiled::Corner;
use crate::nc::state::State;
use crate::toolpath::{Direction, Plane};

/// The corner that a word of a block requests.
struct Asked {
    /// The axis along which the block itself cuts.
    along: usize,
    /// The length of the chamfer, or the radius; positive if the next block moves in the positive direction.
    size: f64,
    rounds: bool,
}

/// Positions that differ by less than this are equal.
const SAME: f64 = 1e-7;

const NEXT: &str = "write a G1 along the other axis in the next block, or write the corner as moves";

impl State {
    /// Checks that a block continues from the previous corner as required. This function is called for every block that
    /// is not empty.
    pub(in crate::nc) fn check_after_corner(&self, motion: Motion, block: &Block) -> Done {
        let Some(due) = self.turning.corner else { return Ok(()) };
        let [own, other] = if due.axis == 0 { ["XU", "ZW"] } else { ["ZW", "XU"] };
        let moves = motion.is_some_and(|row| row.meaning == Meaning::Line) && block.has(letters(own));
        let frames = [Group::Work, Group::Once].iter().any(|group| block.row(*group).is_some());
        if moves && !block.has(letters(other)) && !block.has(letters("YT")) && !frames {
            return Ok(());
        }
        refuse(Code::PN006, "a chamfer or rounded corner, but the next block does not move along the other axis", NEXT)
    }

    /// Makes a straight cut of a lathe, with the corners at its start and at its end.
    pub(in crate::nc) fn cut_with_corners(&mut self, block: &Block, feed: f64, out: &mut Out<'_>) -> Done {
        let from = self.place.position;
        let asked = asked(block)?;
        let mut to = self.target(block)?;
        if let Some(due) = self.turning.corner.take() {
            if block.has(if due.axis == 0 { letters("U") } else { letters("W") }) {
                to[due.axis] -= due.by;
            }
            if (to[due.axis] - from[due.axis]) * due.by.signum() < -SAME {
                let message =
                    "the block after a chamfer or rounded corner moves in the opposite direction, or is too short";
                return refuse(Code::PN018, message, "check the sign and the size of I, K or R in the block before");
            }
            // if the previous chamfer is as long as this cut, no cut remains
            if asked.is_none() && (to[due.axis] - from[due.axis]).abs() <= SAME {
                return Ok(());
            }
        }
        let Some(Asked { along, size, rounds }) = asked else {
            self.place.feed_to(to, feed, None, out);
            return Ok(());
        };
        if self.place.at_machine & 0b101 != 0 {
            let message = "a chamfer or rounded corner from an unknown machine position";
            return refuse(Code::PN007, message, "write a move with X and Z before this block");
        }
        let length = to[along] - from[along];
        if length.abs() < size.abs() - SAME {
            let message = format!("a cut of {} is shorter than its chamfer or rounded corner of {size}", length.abs());
            return refuse(Code::PN018, message, "write a smaller I, K or R");
        }
        let across = 2 - along;
        let mut begin = to;
        begin[along] -= length.signum() * size.abs();
        let mut end = to;
        end[across] += size;
        if (begin[along] - from[along]).abs() > SAME {
            self.place.feed_to(begin, feed, None, out);
        } else {
            begin = from;
        }
        if rounds {
            self.place.position = end;
            out.push(Action::Arc(self.rounding(begin, end, along, length * size, feed)));
        } else {
            self.place.feed_to(end, feed, None, out);
        }
        self.turning.corner = Some(Corner { axis: across, by: size });
        Ok(())
    }

    /// A quarter circle whose first direction is along an axis. `turns` is positive if both cuts go in the positive
    /// direction, or both in the negative direction.
    fn rounding(&self, from: Position, to: Position, along: usize, turns: f64, feed: f64) -> Turn {
        let mut center = [to[0], to[1], to[2]];
        center[along] = from[along];
        // direction of the arc as seen from Z to X
        let ccw = (turns > 0.0) == (along == 2);
        let direction = if ccw { Direction::Ccw } else { Direction::Cw };
        Turn { to, center, plane: Plane::Xz, direction, turns: 0, feed, machine: self.place.at_machine }
    }
}

/// Reads the words I, K and R. Each of these words is a length on the radius.
fn asked(block: &Block) -> Done<Option<Asked>> {
    let words = [b'I', b'K', b'R'].map(|letter| block.get(letter).map(|value| (letter, value)));
    let mut words = words.into_iter().flatten();
    let Some((letter, size)) = words.next() else { return Ok(None) };
    if words.next().is_some() {
        let message = "a cut with two of I, K and R";
        return refuse(Code::PN004, message, "write I or K for a chamfer, or R for a rounded corner");
    }
    let [x, z] = [letters("XU"), letters("ZW")].map(|own| block.has(own));
    let along = if z { 2 } else { 0 };
    if x == z || letter == b'I' && along == 0 || letter == b'K' && along == 2 {
        let message = format!(
            "{} in a cut that is not along {}",
            char::from(letter),
            match letter {
                b'I' => "Z",
                b'K' => "X",
                _ => "one axis",
            }
        );
        return refuse(Code::PN009, message, "use I in a cut along Z, K in a cut along X, and R in both");
    }
    if size == 0.0 {
        return refuse(Code::PN018, "a chamfer or rounded corner of 0", "leave it out");
    }
    Ok(Some(Asked { along, size, rounds: letter == b'R' }))
}
