//! What a machine does when it runs a program.

use crate::control::{Code, Meaning, Motions, Row};
use crate::toolpath::{Direction, FeedMode, Plane, Side, StopKind, Units};

/// X Y Z A B C in program coordinates and the program's units; degrees for the angles.
pub type Position = [f64; 6];

/// One action with its block.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Line of the program, from 1.
    pub line: u64,
    /// A canned cycle makes it.
    pub by_cycle: bool,
    /// What the block does.
    pub action: Action,
}

/// An action.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// A rapid.
    Rapid {
        /// End of the move.
        to: Position,
        /// Axes that stand at a place in machine coordinates, as bits: where that is in the work is known only there.
        machine: u8,
        /// Those of them that increments have moved since, so that their position is unknown.
        astray: u8,
        /// Those of them whose place in machine coordinates the program says, by G28 or G53.
        placed: u8,
    },
    /// A straight feed move.
    Feed {
        /// End of the move.
        to: Position,
        /// The feed, in the feed mode's unit.
        feed: f64,
        /// Feed follows the spindle, by so much a turn: threads.
        lead: Option<f64>,
        /// Axes whose position only the machine knows, as bits.
        machine: u8,
        /// Those of them that this move takes to a place in machine coordinates (G53 under G1).
        home: u8,
    },
    /// An arc or helix at feed.
    Arc(Turn),
    /// A dwell in seconds.
    Dwell(f64),
    /// The spindle is switched: direction and speed, in revolutions a minute or the surface speed's unit.
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
    /// Units from here on.
    Units(Units),
    /// What feeds count from here on.
    FeedMode(FeedMode),
    /// The plane of arcs, cycles and compensation.
    Plane(Plane),
    /// Work offset, as 54, 59.1, or 1540 + the number of a Haas.
    Work(f64),
    /// Tool length offset by its register; `None` without.
    Length(Option<f64>),
    /// Cutter compensation: its side and register; `None`: off.
    Compensation(Option<(Side, Option<f64>)>),
    /// Surface speed instead of revolutions.
    SurfaceSpeed(Option<f64>),
    /// Highest speed of the spindle.
    SpeedLimit(f64),
    /// The coordinate frame was moved by G10, G52 or G92.
    Frame,
    /// A hole of a canned cycle; its moves follow.
    Hole(Box<Drilling>),
    /// How the next moves cut a thread.
    Threading(Threading),
    /// A thread in passes; its moves follow.
    Passes(Box<Passes>),
    /// The cycle is no longer in force.
    CycleOff,
    /// Text of a comment, by its columns in the line.
    Comment(usize, usize),
    /// A code that moves nothing and that is not simulated, as M10 or G8, with what it means.
    LeftOut(Code, Meaning),
    /// The block has a slash, and is run.
    BlockDelete,
}

/// What a lathe's thread says besides its moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Threading {
    /// Where on its turn the spindle is when the cut begins, in degrees from its mark.
    pub start: f64,
    /// The angle of the flanks, along which the passes go in, in degrees.
    pub flanks: f64,
    /// How far from the end the tool begins to leave the thread, in leads.
    pub pull_out: f64,
}

/// A thread in passes, as G76 of a lathe. Positions are a radius and Z, in the units in force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passes {
    /// The crest where the thread begins.
    pub from: [f64; 2],
    /// The crest where it ends.
    pub to: [f64; 2],
    /// The distance of one turn, as the feed mode counts it.
    pub lead: f64,
    /// Its height, on the radius; negative for an inner thread.
    pub depth: f64,
    /// The first cut, on the radius.
    pub first: f64,
    /// The least cut, on the radius.
    pub least: f64,
    /// What is left for the last cut, on the radius.
    pub allowance: f64,
    /// Passes at the full depth after those that the cuts make.
    pub last: u32,
    /// The radius at the start less that at the end.
    pub taper: f64,
}

/// What the spindle does.
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
    /// Centre of the arc, X Y Z; the plane's third coordinate is that of the start.
    pub center: [f64; 3],
    /// The plane of the arc.
    pub plane: Plane,
    /// Direction of the arc, seen from the plane's positive third axis.
    pub direction: Direction,
    /// Full turns before the end is reached for good.
    pub turns: u32,
    /// Feed of the arc, in the feed mode's unit.
    pub feed: f64,
    /// Axes of its end whose position only the machine knows, as bits.
    pub machine: u8,
}

/// Which heights of a hole the program gives; the others only the machine knows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Heights {
    /// All of them.
    #[default]
    Given,
    /// All but the level to which it returns.
    ButClear,
    /// None: they are increments from a place of the machine.
    Unknown,
}

/// The code of a canned cycle, and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle {
    /// As the program has it.
    pub code: Code,
    /// What the tool does.
    pub motions: Motions,
    /// It dwells at the bottom.
    pub dwells: bool,
}

impl Cycle {
    /// The cycle of a row that is run; `None`: the row is none.
    pub fn of(row: &Row) -> Option<Cycle> {
        Some(Cycle { code: row.code, motions: row.runs.motions?, dwells: row.dwells() })
    }
}

/// A hole of a control's canned cycle: all its words, resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drilling {
    /// The cycle that makes it.
    pub cycle: Cycle,
    /// The place over the hole, at the height of the clear level; while the cycle is worked out the height does not
    /// count.
    pub at: Position,
    /// The plane across the hole.
    pub plane: Plane,
    /// Height of the R plane, where the feed begins, as a position of the depth axis.
    pub r: f64,
    /// Height of the bottom, as a position of the depth axis.
    pub bottom: f64,
    /// Where the tool goes back to.
    pub clear: f64,
    /// Dwell at the bottom in seconds.
    pub dwell: f64,
    /// Depth of a peck, a length.
    pub peck: f64,
    /// Shift of boring cycles in the plane.
    pub shift: [f64; 2],
    /// Where a back bore ends.
    pub level: f64,
    /// Feed into the hole, in the feed mode's unit.
    pub feed: f64,
    /// Which of its heights the program gives.
    pub heights: Heights,
}
