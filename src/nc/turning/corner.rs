//! Chamfers and rounded corners of lathes: I, K or R in a straight cut along one axis, which the next block leaves along the other.
//!
//! Sources: Fanuc's operator's manual of the 0i-T (chamfering and corner R), Haas's lathe operator's manual (G1). The sign says
//! the way of the next block; it counts from the corner, which no block reaches, and is as long as the chamfer at least.

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

/// What the words of a block ask for.
struct Asked {
    /// The axis of its own cut.
    along: usize,
    /// The chamfer or radius, positive where the next block goes to plus.
    size: f64,
    rounds: bool,
}

/// Lengths below which two positions are one.
const SAME: f64 = 1e-7;

const NEXT: &str = "write a G1 along the other axis after it, or write the corner as moves";

impl State {
    /// Is the block what a corner before it needs? It is asked of every block that does something.
    pub(in crate::nc) fn check_after_corner(&self, motion: Motion, block: &Block) -> Done {
        let Some(due) = self.turning.corner else { return Ok(()) };
        let [own, other] = if due.axis == 0 { ["XU", "ZW"] } else { ["ZW", "XU"] };
        let moves = motion.is_some_and(|row| row.meaning == Meaning::Line) && block.has(letters(own));
        let frames = [Group::Work, Group::Once].iter().any(|group| block.row(*group).is_some());
        if moves && !block.has(letters(other)) && !block.has(letters("YT")) && !frames {
            return Ok(());
        }
        refuse(Code::PN006, "a chamfer or rounded corner, and the next block does not leave it", NEXT)
    }

    /// A straight cut of a lathe with what is before and after it: the corner where it begins, and the one where it ends.
    pub(in crate::nc) fn cut_with_corners(&mut self, block: &Block, feed: f64, out: &mut Out<'_>) -> Done {
        let from = self.place.position;
        let asked = asked(block)?;
        let mut to = self.target(block)?;
        if let Some(due) = self.turning.corner.take() {
            if block.has(if due.axis == 0 { letters("U") } else { letters("W") }) {
                to[due.axis] -= due.by;
            }
            if (to[due.axis] - from[due.axis]) * due.by.signum() < -SAME {
                let message = "the block after a chamfer or rounded corner goes the other way, or is shorter than it";
                return refuse(Code::PN018, message, "look at the sign and the size of I, K or R before it");
            }
            // a chamfer as long as this cut leaves nothing of it
            if asked.is_none() && (to[due.axis] - from[due.axis]).abs() <= SAME {
                return Ok(());
            }
        }
        let Some(Asked { along, size, rounds }) = asked else {
            self.place.feed_to(to, feed, None, out);
            return Ok(());
        };
        if self.place.at_machine & 0b101 != 0 {
            let message = "a chamfer or rounded corner from a position that only the machine knows";
            return refuse(Code::PN007, message, "write a move with X and Z before it");
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

    /// A quarter of a circle that leaves its first point along an axis. `turns`: above 0 where both ways go the same way.
    fn rounding(&self, from: Position, to: Position, along: usize, turns: f64, feed: f64) -> Turn {
        let mut center = [to[0], to[1], to[2]];
        center[along] = from[along];
        // seen from Z to X
        let ccw = (turns > 0.0) == (along == 2);
        let direction = if ccw { Direction::Ccw } else { Direction::Cw };
        Turn { to, center, plane: Plane::Xz, direction, turns: 0, feed, machine: self.place.at_machine }
    }
}

/// I, K and R are all on the radius.
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
        return refuse(Code::PN009, message, "I belongs to a cut along Z, K to one along X, R to both");
    }
    if size == 0.0 {
        return refuse(Code::PN018, "a chamfer or rounded corner of 0", "leave it out");
    }
    Ok(Some(Asked { along, size, rounds: letter == b'R' }))
}
