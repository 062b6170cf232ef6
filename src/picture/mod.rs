//! The backplot: the motions of a program, as lines that can be drawn.
//!
//! To make the backplot, a program is run by the rules of its control. The result is a [`Picture`]: the moves in their
//! order, the block of each move, and the modal state after each block. [`strips`](Picture::strips) converts the
//! picture to points, including the arcs, and [`svg`] draws a still picture.

use std::sync::Arc;

mod frame;
mod run;
mod state;
mod strips;
mod svg;
mod view;

pub use run::draw;
pub use state::{Change, Register};
pub use strips::{Strips, round};
pub use svg::{Sheet, svg, svg_over};
pub use view::View;

use crate::diag::Diag;
use crate::nc::{Tally, Turn};
use crate::toolpath::Units;

/// The kind of a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Kind {
    /// A rapid.
    Rapid = 0,
    /// A straight feed move.
    Feed = 1,
    /// An arc or helix.
    Arc = 2,
    /// Nothing is drawn: the coordinate frame was moved, or the position before the move was unknown.
    Jump = 3,
}

/// A move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// End of the move, X Y Z in program coordinates and the picture's units; NaN if unknown. On a wire EDM machine, each
    /// move of the program becomes two moves: one of the lower guide at Z 0, and one of the upper guide, whose Z is NaN.
    pub to: [f64; 3],
    /// Line of the program, from 1.
    pub line: u32,
    /// If the move is an arc: the index of this arc in [`Picture::arcs`].
    pub arc: u32,
    /// The tool, as an index into [`Picture::tools`].
    pub tool: u16,
    /// The kind of the move.
    pub kind: Kind,
    /// Whether the move is part of a canned cycle.
    pub by_cycle: bool,
}

/// A hole of a canned cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hole {
    /// Line of the program, from 1.
    pub line: u32,
    /// Position at which the feed begins, X Y Z in the picture's units.
    pub top: [f64; 3],
    /// Bottom of the hole, X Y Z in the picture's units.
    pub bottom: [f64; 3],
    /// The tool, as an index into [`Picture::tools`].
    pub tool: u16,
    /// Positions of the rotary axes A B C at the hole, in degrees.
    pub turned: [f64; 3],
}

impl Hole {
    /// Top and bottom of the hole as positions X Y Z on the part, after the rotary axes have turned the part.
    pub fn on_part(&self) -> [[f64; 3]; 2] {
        [self.top, self.bottom].map(|at| frame::on_part(at, self.turned))
    }
}

/// New positions of the rotary axes. The new positions are valid from the move `from` on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turned {
    /// The first move that ends at these positions of the rotary axes, as an index into [`Picture::moves`].
    pub from: u32,
    /// Positions of A B C in degrees.
    pub to: [f64; 3],
}

/// The motions of a program.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Units of all lengths: the units of the first move.
    pub units: Units,
    /// The moves, in the order of the program.
    pub moves: Vec<Move>,
    /// For each move, the minutes from the beginning of the program to the end of the move, calculated as in
    /// [`Tally::minutes`].
    pub minutes: Vec<f32>,
    /// Positions of the rotary axes: one row for each move that turns a rotary axis, in the order of the moves. Empty:
    /// no axis turns.
    pub turned: Vec<Turned>,
    /// Letters of the axes in `Move::to`: `XYZ`, or `XY` on a wire EDM machine.
    pub letters: &'static str,
    /// Arcs of the moves, in the picture's units. The field `to` of each arc is the end of the move with this arc.
    pub arcs: Vec<Turn>,
    /// The holes, in the order of the program.
    pub holes: Vec<Hole>,
    /// Numbers of the tools in the order of their first use. The first number is 0: no tool is active yet.
    pub tools: Vec<f64>,
    /// Names of tools whose numbers are unknown. The tool 10^9 + n has the name with the index n.
    pub tool_names: Vec<Arc<str>>,
    /// Changes of the modal state, in the order in which the blocks are run.
    pub changes: Vec<Change>,
    /// Counts and times.
    pub tally: Tally,
    /// Number of blocks that were run.
    pub blocks: u64,
    /// Warnings of the run, at most one hundred; their locations are lines of the program.
    pub warnings: Vec<Diag>,
    /// The error with which the control refused a block, and the line of this block. The run ended at this line, before
    /// the end of the program.
    pub refused: Option<(Box<Diag>, u64)>,
}
