//! G74 and G75: pecks along one axis, at several positions along the other axis.

use super::MOST;
use crate::control::{Meaning, Row};
use crate::diag::Code;
use crate::nc::block::Block;
use crate::nc::codes::letters;
use crate::nc::fault::{Done, refuse};
use crate::nc::out::Out;
use crate::nc::state::State;

impl State {
    /// G74 pecks along Z and steps along X; G75 pecks along X and steps along Z.
    pub(super) fn turning_pecks(&mut self, row: &Row, block: &Block, out: &mut Out<'_>) -> Done {
        // on a Haas, one block contains all lengths: the peck and the step of G74 are K and I, those of G75 are I and K
        let one_block = row.words.has(b'K');
        let is_first = !one_block && !block.has(letters("XZUWPQ"));
        if is_first {
            self.is_size(block, b'R')?;
            self.turning.back = block.get(b'R').or(self.turning.back);
            return Ok(());
        }
        let code = row.code;
        let relief = block.get(if one_block { b'D' } else { b'R' }).unwrap_or(0.0);
        if relief != 0.0 {
            let message = format!("{code} with a relief at the bottom: no manual clearly defines its side");
            return refuse(Code::PN016, message, "write the moves of the cycle, or leave the relief out");
        }
        let feed = self.drive.feed_of(block, self.modes.feed_mode)?;
        let [along, across] = if row.meaning == Meaning::FacePecks { [2, 0] } else { [0, 2] };
        let letter_of = |axis: usize| match (one_block, axis) {
            (true, 0) => b'I',
            (true, _) => b'K',
            (false, 0) => b'P',
            (false, _) => b'Q',
        };
        for axis in [along, across] {
            self.is_size(block, letter_of(axis))?;
        }
        let size = |axis: usize| {
            let said = block.get(letter_of(axis)).filter(|size| *size > 0.0)?;
            Some(if one_block { said } else { self.increments(said) })
        };
        let (peck, step) = (size(along), size(across));
        let back = match self.turning.back {
            Some(back) => back,
            None if one_block => self.usual_back(),
            None if peck.is_none() => 0.0,
            None => {
                let help = format!("write {code} R1. before this block");
                return refuse(Code::PN007, format!("{code} without the retract after a peck"), help);
            }
        };
        self.begins_in_the_program(code)?;
        self.only_turns(block)?;
        let begin = self.place.position;
        let end = self.target(block)?;
        let (depth, width) = (end[along] - begin[along], end[across] - begin[across]);
        let strokes = peck.map_or(1.0, |peck| (depth.abs() / peck).ceil());
        let places = step.map_or(1.0, |step| (width.abs() / step).ceil());
        if strokes * places > MOST {
            return refuse(Code::PN018, format!("{code} of more than {MOST} pecks"), "write larger P and Q");
        }
        if width != 0.0 && step.is_none() {
            let message = format!("{code} has several positions, but their step is missing");
            return refuse(Code::PN007, message, format!("write {} in this block", char::from(letter_of(across))));
        }
        let mut to = begin;
        let mut side = 0.0;
        loop {
            let mut reached = 0.0;
            loop {
                reached = (reached + peck.unwrap_or(f64::INFINITY)).min(depth.abs());
                to[along] = begin[along] + reached.copysign(depth);
                self.place.feed_to(to, feed, None, out);
                if reached >= depth.abs() - 1e-9 {
                    break;
                }
                to[along] = begin[along] + (reached - back).max(0.0).copysign(depth);
                self.place.rapid_to(to, out);
            }
            to[along] = begin[along];
            self.place.rapid_to(to, out);
            if side >= width.abs() - 1e-9 {
                break;
            }
            side = (side + step.unwrap_or(f64::INFINITY)).min(width.abs());
            to[across] = begin[across] + side.copysign(width);
            self.place.rapid_to(to, out);
        }
        if to != begin {
            self.place.rapid_to(begin, out);
        }
        Ok(())
    }
}
