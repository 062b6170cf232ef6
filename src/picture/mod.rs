//! The backplot: what a program does, as lines that can be drawn.
//!
//! A program is run by the rules of its control. What comes of it is a [`Picture`]: moves in the order in which they are made, each
//! with its block, and what is modal after each block. [`strips`](Picture::strips) makes points of it, arcs among them, and
//! [`svg`] a still picture.

mod frame;
mod run;
mod state;
mod strips;
mod svg;
mod view;

pub use run::draw;
pub use state::{Change, Register};
pub use strips::Strips;
pub use svg::{Sheet, svg, svg_over};
pub use view::View;

use crate::diag::Diag;
use crate::nc::{Tally, Turn};
use crate::toolpath::Units;

/// What a move is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Kind {
    /// A rapid.
    Rapid = 0,
    /// A straight feed move.
    Feed = 1,
    /// An arc or helix.
    Arc = 2,
    /// Nothing is drawn: the frame was moved, or the place was not known before.
    Jump = 3,
}

/// A move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// End of the move, X Y Z in program coordinates and the picture's units; NaN where only the machine knows. A wire has two moves
    /// for each of the program: of the lower guide at Z 0, and of the upper guide, whose height is NaN.
    pub to: [f64; 3],
    /// Line of the program, from 1.
    pub line: u32,
    /// Arc of the move in [`Picture::arcs`].
    pub arc: u32,
    /// The tool, as a place in [`Picture::tools`].
    pub tool: u16,
    /// What the move is.
    pub kind: Kind,
    /// A canned cycle makes it.
    pub by_cycle: bool,
}

/// A hole of a canned cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hole {
    /// Line of the program, from 1.
    pub line: u32,
    /// Where the hole is drilled from, X Y Z in the picture's units.
    pub top: [f64; 3],
    /// Bottom of the hole, X Y Z in the picture's units.
    pub bottom: [f64; 3],
    /// The tool, as a place in [`Picture::tools`].
    pub tool: u16,
    /// Positions of the rotary axes A B C at the hole, in degrees.
    pub turned: [f64; 3],
}

impl Hole {
    /// Top and bottom on the part, X Y Z: turned as the rotary axes turn them.
    pub fn on_part(&self) -> [[f64; 3]; 2] {
        [self.top, self.bottom].map(|at| frame::on_part(at, self.turned))
    }
}

/// The rotary axes from a move on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turned {
    /// First move that ends there, as a place in [`Picture::moves`].
    pub from: u32,
    /// Positions of A B C in degrees.
    pub to: [f64; 3],
}

/// What a program does.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Units of all lengths: those of the first move.
    pub units: Units,
    /// Moves, in their order.
    pub moves: Vec<Move>,
    /// The rotary axes: a row for each move that turns them, in the order of the moves. None: nothing is turned.
    pub turned: Vec<Turned>,
    /// Letters of the axes whose positions [`Move::to`] has: `XYZ`, or `XY` for a wire.
    pub letters: &'static str,
    /// Arcs of the moves that are some, in the picture's units; `to` is that of the move.
    pub arcs: Vec<Turn>,
    /// Holes, in their order.
    pub holes: Vec<Hole>,
    /// Numbers of the tools, in the order of their first use; the first is 0, no tool yet.
    pub tools: Vec<f64>,
    /// What changed in the state of the control, in the order of the run.
    pub changes: Vec<Change>,
    /// Counts and times.
    pub tally: Tally,
    /// Blocks that were run.
    pub blocks: u64,
    /// Warnings of the run, the first hundred; their places are lines of the program.
    pub warnings: Vec<Diag>,
    /// Why the run ended before the program did: what the control refuses, and its line.
    pub refused: Option<(Box<Diag>, u64)>,
}
