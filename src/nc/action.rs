//! What a machine does when it runs a program.

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
    /// What is done.
    pub action: Action,
}

/// An action.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// A rapid.
    Rapid {
        /// Its end.
        to: Position,
        /// Axes that stand at a place in machine coordinates, as bits: where that is in the work is known only there.
        machine: u8,
    },
    /// A straight feed move.
    Feed {
        /// Its end.
        to: Position,
        /// The feed, in the feed mode's unit.
        feed: f64,
        /// Feed follows the spindle, by so much a turn: threads.
        lead: Option<f64>,
    },
    /// An arc or helix at feed.
    Arc(Turn),
    /// A dwell in seconds.
    Dwell(f64),
    /// The spindle.
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
    /// Cutter compensation by its register.
    Compensation(Option<(Side, Option<f64>)>),
    /// Surface speed instead of revolutions.
    SurfaceSpeed(Option<f64>),
    /// The coordinate frame was moved by G10, G52 or G92.
    Frame,
    /// A hole of a canned cycle; its moves follow.
    Hole(Box<Drilling>),
    /// The cycle is no longer in force.
    CycleOff,
    /// Text of a comment, by its columns in the line.
    Comment(usize, usize),
    /// A code that moves nothing and that is not simulated, as M10 or G8: its letter, and ten times its number.
    LeftOut(u8, u16),
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
    /// As simulate writes it.
    pub fn name(self) -> &'static str {
        match self {
            Rotation::Cw => "cw",
            Rotation::Ccw => "ccw",
            Rotation::Stop => "stop",
        }
    }

    /// The other way round.
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
    /// As simulate writes it.
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
    /// Its end.
    pub to: Position,
    /// Its centre, X Y Z; the plane's third coordinate is that of the start.
    pub center: [f64; 3],
    /// In which plane.
    pub plane: Plane,
    /// Which way.
    pub direction: Direction,
    /// Full turns before the end is reached for good.
    pub turns: u32,
    /// The feed.
    pub feed: f64,
}

/// A hole of a control's canned cycle: all its words, resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drilling {
    /// The cycle's G code times ten.
    pub code: u16,
    /// Over the hole, at the height of the clear level; while the cycle is worked out the height does not count.
    pub at: Position,
    /// The plane across the hole.
    pub plane: Plane,
    /// The R plane.
    pub r: f64,
    /// The bottom.
    pub bottom: f64,
    /// Where the tool goes back to.
    pub clear: f64,
    /// Dwell in seconds.
    pub dwell: f64,
    /// The peck.
    pub peck: f64,
    /// Shift of boring cycles in the plane.
    pub shift: [f64; 2],
    /// Where a back bore ends.
    pub level: f64,
    /// The feed.
    pub feed: f64,
}
