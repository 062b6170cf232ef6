//! The actions of a machine that runs a program.

use crate::control::{Code, Meaning, Motions, Row};
use crate::toolpath::{Direction, FeedMode, Plane, Side, StopKind, Units};

/// X Y Z A B C in program coordinates: lengths in the program's units, angles in degrees.
pub type Position = [f64; 6];

/// One action with its block.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Line of the program, from 1.
    pub line: u64,
    /// Whether a canned cycle makes the action.
    pub by_cycle: bool,
    /// The action itself.
    pub action: Action,
}

/// An action.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// A rapid.
    Rapid {
        /// End of the move.
        to: Position,
        /// Axes whose end is a position in machine coordinates, as bits. Their position in the work is known only at the
        /// machine.
        machine: u8,
        /// Those of the `machine` axes that have since moved by increments, so that their position is unknown.
        astray: u8,
        /// Those of the `machine` axes whose machine position is given in the program, by G28 or G53.
        placed: u8,
    },
    /// A straight feed move.
    Feed {
        /// End of the move.
        to: Position,
        /// The feed, in the feed mode's unit.
        feed: f64,
        /// For a thread: the feed per turn of the spindle, which the feed follows.
        lead: Option<f64>,
        /// Axes whose position is known only at the machine, as bits.
        machine: u8,
        /// Those of the `machine` axes that this move takes to a machine position (G53 under G1).
        home: u8,
    },
    /// An arc or helix at feed.
    Arc(Turn),
    /// A dwell in seconds.
    Dwell(f64),
    /// The spindle is switched: direction, and speed in revolutions per minute or in the unit of the surface speed.
    Spindle(Rotation, f64),
    /// The spindle is stopped at an angle.
    Orient(f64),
    /// A stop.
    Stop(StopKind),
    /// The program is over.
    End,
    /// A tool is in the spindle.
    Tool(f64),
    /// Coolant: flood, mist or off.
    Coolant(Cooling),
    /// The units from here on.
    Units(Units),
    /// The feed mode from here on.
    FeedMode(FeedMode),
    /// The plane of arcs, cycles and compensation.
    Plane(Plane),
    /// Work offset: 54, 59.1, or 1540 + the number for a Haas.
    Work(f64),
    /// Tool length offset by its register; `None`: off.
    Length(Option<f64>),
    /// Cutter compensation: its side and register; `None`: off.
    Compensation(Option<(Side, Option<f64>)>),
    /// Constant surface speed; `None`: revolutions per minute.
    SurfaceSpeed(Option<f64>),
    /// Highest speed of the spindle.
    SpeedLimit(f64),
    /// The coordinate frame was moved by G10, G52 or G92.
    Frame,
    /// A hole of a canned cycle. Its moves follow as actions.
    Hole(Box<Drilling>),
    /// How the next moves cut a thread.
    Threading(Threading),
    /// A thread in passes. Its moves follow as actions.
    Passes(Box<Passes>),
    /// The cycle is no longer in force.
    CycleOff,
    /// A comment: its first and last column in the line.
    Comment(usize, usize),
    /// A code with its meaning that moves nothing and is not simulated, such as M10 or G8.
    LeftOut(Code, Meaning),
    /// The block begins with a slash and is run.
    BlockDelete,
}

/// Data of a lathe's thread besides its moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Threading {
    /// Angle of the spindle from its mark when the cut begins, in degrees.
    pub start: f64,
    /// The angle of the flanks in degrees. The infeed of the passes follows the flanks.
    pub flanks: f64,
    /// Distance before the end at which the tool begins to leave the thread, in leads.
    pub pull_out: f64,
}

/// A thread in passes, such as G76 of a lathe. Positions are a radius and Z, in the units in force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passes {
    /// Start of the thread at its crest.
    pub from: [f64; 2],
    /// End of the thread at its crest.
    pub to: [f64; 2],
    /// Distance per turn of the spindle, in the unit of the feed mode.
    pub lead: f64,
    /// Height of the thread, on the radius; negative for an internal thread.
    pub depth: f64,
    /// Depth of the first cut, on the radius.
    pub first: f64,
    /// Smallest cut, on the radius.
    pub least: f64,
    /// Allowance for the last cut, on the radius.
    pub allowance: f64,
    /// Number of passes at full depth after the regular cuts.
    pub last: u32,
    /// The radius at the start minus the radius at the end.
    pub taper: f64,
}

/// Rotation of the spindle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Rotation {
    Cw,
    Ccw,
    Stop,
}

impl Rotation {
    /// Name of the rotation, as `simulate` writes it.
    pub fn name(self) -> &'static str {
        match self {
            Rotation::Cw => "cw",
            Rotation::Ccw => "ccw",
            Rotation::Stop => "stop",
        }
    }

    /// The opposite direction; a stopped spindle stays stopped.
    pub fn reversed(self) -> Rotation {
        match self {
            Rotation::Cw => Rotation::Ccw,
            Rotation::Ccw => Rotation::Cw,
            Rotation::Stop => Rotation::Stop,
        }
    }
}

/// Coolant codes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Cooling {
    Flood,
    Mist,
    Off,
}

impl Cooling {
    /// Name of the coolant, as `simulate` writes it.
    pub fn name(self) -> &'static str {
        match self {
            Cooling::Flood => "flood",
            Cooling::Mist => "mist",
            Cooling::Off => "off",
        }
    }
}

/// An arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// End of the arc.
    pub to: Position,
    /// Centre of the arc, X Y Z. Its coordinate across the plane is that of the start.
    pub center: [f64; 3],
    /// The plane of the arc.
    pub plane: Plane,
    /// Direction of the arc, seen from the positive end of the axis across the plane.
    pub direction: Direction,
    /// Full turns before the arc stops at its end.
    pub turns: u32,
    /// Feed of the arc, in the feed mode's unit.
    pub feed: f64,
    /// The axes, as bits, whose end position is an unknown machine position.
    pub machine: u8,
}

/// Which heights of a hole are given in the program. The others are known only at the machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Heights {
    /// All heights.
    #[default]
    Given,
    /// All heights except the return level.
    ButClear,
    /// None: the heights are increments from a machine position.
    Unknown,
}

/// The code of a canned cycle, and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle {
    /// The code as in the program.
    pub code: Code,
    /// The motions of the tool.
    pub motions: Motions,
    /// Whether the tool dwells at the bottom.
    pub dwells: bool,
}

impl Cycle {
    /// The cycle of a row of the code table; `None`: the row is not a cycle.
    pub fn of(row: &Row) -> Option<Cycle> {
        Some(Cycle { code: row.code, motions: row.runs.motions?, dwells: row.dwells() })
    }
}

/// A hole of a canned cycle with all its words resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drilling {
    /// The cycle of the hole.
    pub cycle: Cycle,
    /// The position above the hole, at the clear level. The height is ignored while the cycle is being resolved.
    pub at: Position,
    /// The plane across the hole.
    pub plane: Plane,
    /// Height of the R plane, where the feed begins, as a position of the depth axis.
    pub r: f64,
    /// Height of the bottom, as a position of the depth axis.
    pub bottom: f64,
    /// Return level of the tool.
    pub clear: f64,
    /// Dwell at the bottom in seconds.
    pub dwell: f64,
    /// Length of a peck.
    pub peck: f64,
    /// Shift of a boring cycle in the plane.
    pub shift: [f64; 2],
    /// Height at which a back bore ends.
    pub level: f64,
    /// Feed into the hole, in the feed mode's unit.
    pub feed: f64,
    /// Which of the heights are given in the program.
    pub heights: Heights,
}
