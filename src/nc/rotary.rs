//! Codes that change the moves of rotary axes in a way that is not simulated, such as M126 of a Heidenhain control.

use super::block::Block;
use super::codes::{Group, Motion, letters};
use super::fault::{Done, refuse};
use super::state::State;
use crate::control::{Meaning, StopsRotary};
use crate::diag::Code;

impl State {
    /// Turns on and off the codes of a block that change the moves of rotary axes.
    pub(super) fn rotary_codes(&mut self, block: &Block) {
        for (_, row) in block.m() {
            if let Some(ended) = row.runs.ends {
                self.rotary.retain(|own| own.code != ended);
            }
            if row.runs.stops_rotary.is_some() && !self.rotary.iter().any(|own| own.code == row.code) {
                self.rotary.push(row);
            }
        }
    }

    /// Refuses a block in which a rotary axis moves while a code changes this move.
    pub(super) fn check_rotary(&self, block: &Block, motion: Motion) -> Done {
        if self.rotary.is_empty() || !block.has(letters("ABC")) {
            return Ok(());
        }
        let feeds = motion.is_some_and(|row| row.meaning != Meaning::Rapid);
        let stops = |kind: StopsRotary| kind == StopsRotary::Moves || feeds;
        let code = self.rotary.iter().find(|row| row.runs.stops_rotary.is_some_and(stops));
        match (code, (3..6).find(|axis| self.turns(block, *axis))) {
            (Some(row), Some(axis)) => {
                let letter = char::from(self.control.axes()[axis]);
                let message = format!("{letter} moves while {} is active, which is not simulated", row.code);
                refuse(Code::PN016, message, "run the program without this code, or end the code before the move")
            }
            _ => Ok(()),
        }
    }

    /// Whether a rotary axis moves in a block.
    fn turns(&self, block: &Block, axis: usize) -> bool {
        let in_machine = block.g_meaning(Group::Once) == Some(Meaning::Machine);
        let start = if self.is_absolute(block, axis) { self.place.position[axis] } else { 0.0 };
        self.axis_word(block, axis).is_some_and(|value| in_machine || value != start)
    }
}
