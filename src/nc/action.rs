//! The actions of a machine that runs a program.

use crate::control::{Code, Meaning, Motions, Row};
use crate::toolpath::{Coolant, Direction, FeedMode, Plane, Side, SpindleTurn, StopKind, Units};

/// X Y Z A B C in program coordinates: lengths in the program's units, angles in degrees.
pub type Position = [f64; 6];

/// The rotary axes A, B and C of a position, as bits.
pub const ROTARY: u8 = 0b11_1000;

/// Whether a move only turns the part: X, Y and Z stay where they are.
pub(super) fn only_turns(from: &Position, to: &Position) -> bool {
    from[..3] == to[..3] && from[3..] != to[3..]
}

/// One action, with the line of its block.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Line of the program, from 1.
    pub line: u64,
    /// Whether the action is part of a canned cycle.
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
        /// As bits, the axes whose end is a machine position. The positions of these axes in the work offset are
        /// unknown, because they depend on values that only the machine has.
        machine: u8,
        /// As bits, the `machine` axes that later moved by increments. The machine position of these axes is unknown,
        /// too.
        astray: u8,
        /// As bits, the `machine` axes whose machine position the program contains, by G28 or G53.
        placed: u8,
        /// As bits, the `machine` axes that have not moved since the work offset changed.
        kept: u8,
    },
    /// A straight feed move.
    Feed {
        /// End of the move.
        to: Position,
        /// The feed, in the feed mode's unit.
        feed: f64,
        /// For a move that follows the spindle, such as a thread: the feed per revolution.
        lead: Option<f64>,
        /// As bits, the axes whose position is known only at the machine.
        machine: u8,
        /// As bits, the `machine` axes that this move takes to a machine position, by G53 with G1.
        home: u8,
    },
    /// An arc or helix at feed.
    Arc(Turn),
    /// A dwell in seconds.
    Dwell(f64),
    /// The spindle gets a new state: its direction, and its speed in revolutions per minute or in the unit of the surface speed.
    Spindle(Rotation, f64),
    /// The spindle is stopped at an angle in degrees; `None`: at the control's own angle.
    Orient(Option<f64>),
    /// A stop.
    Stop(StopKind),
    /// The program has ended.
    End,
    /// A tool is now in the spindle.
    Tool(f64),
    /// Coolant: flood, mist or off.
    Coolant(Coolant),
    /// The units of the following blocks.
    Units(Units),
    /// The feed mode of the following blocks.
    FeedMode(FeedMode),
    /// The plane of arcs, cycles and compensation.
    Plane(Plane),
    /// The work offset as a number: 54, 59.1, or for a Haas 1540 plus the number of the offset.
    Work(f64),
    /// The tool length offset as its register; `None`: off.
    Length(Option<f64>),
    /// Cutter compensation; `None`: off.
    Compensation(Option<Compensation>),
    /// Constant surface speed; `None`: revolutions per minute.
    SurfaceSpeed(Option<f64>),
    /// The maximum spindle speed.
    SpeedLimit(f64),
    /// The coordinate frame was moved by G10, G52 or G92.
    Frame,
    /// A hole of a canned cycle. The moves of the hole follow as separate actions.
    Hole(Box<Drilling>),
    /// The data of a thread. The next moves cut this thread.
    Threading(Threading),
    /// A thread that is cut in passes. The moves of the passes follow as separate actions.
    Passes(Box<Passes>),
    /// The canned cycle has ended.
    CycleOff,
    /// A comment: the columns of its start and its end in the line.
    Comment(usize, usize),
    /// A code that moves nothing and is not simulated, such as M10 or G8, with its meaning.
    LeftOut(Code, Meaning),
    /// A word or statement in whole words that moves nothing and is not simulated, such as `CFC` or `CYCLE832(0.05,1)`,
    /// as written, in upper case.
    LeftOutWord(Box<str>),
    /// The block begins with a slash, and is run.
    BlockDelete,
}

/// Cutter compensation that is on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compensation {
    /// The side of the path on which the tool is.
    pub side: Side,
    /// The source of the tool's radius.
    pub cutter: Cutter,
}

/// The source of the radius of a compensated tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cutter {
    /// The tool in the spindle: the program names no register.
    Tool,
    /// A register of the control: D.
    Register(f64),
    /// The program: the diameter, in the program's units, and the orientation of a lathe tool, 0 without one.
    Given {
        /// D of G41.1 and G42.1.
        diameter: f64,
        /// L of G41.1 and G42.1.
        orientation: f64,
    },
}

impl Cutter {
    /// The register with the radius.
    pub fn register(self) -> Option<f64> {
        if let Cutter::Register(register) = self { Some(register) } else { None }
    }
}

/// Data of a thread on a lathe, besides its moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Threading {
    /// Angle in degrees between the mark of the spindle and the start of the cut.
    pub start: f64,
    /// The angle between the flanks in degrees. The infeed of the passes follows the flanks.
    pub flanks: f64,
    /// Distance from the end of the thread at which the tool begins to move out, as a number of leads.
    pub pull_out: f64,
}

/// A thread that is cut in passes, for example by G76 on a lathe. Positions are a radius and Z, in the active units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passes {
    /// Start of the thread at its crest.
    pub from: [f64; 2],
    /// End of the thread at its crest.
    pub to: [f64; 2],
    /// Distance per revolution of the spindle, in the unit of the feed mode.
    pub lead: f64,
    /// Height of the thread, on the radius; negative for an internal thread.
    pub depth: f64,
    /// Depth of the first pass, on the radius.
    pub first: f64,
    /// Smallest depth of a pass, on the radius.
    pub least: f64,
    /// Allowance for the last pass, on the radius.
    pub allowance: f64,
    /// Number of passes at full depth after the other passes.
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

    /// The state of the spindle in a job.
    pub(crate) fn turn(self) -> SpindleTurn {
        match self {
            Rotation::Cw => SpindleTurn::Cw,
            Rotation::Ccw => SpindleTurn::Ccw,
            Rotation::Stop => SpindleTurn::Off,
        }
    }

    /// The opposite direction; a stopped spindle remains stopped.
    pub fn reversed(self) -> Rotation {
        match self {
            Rotation::Cw => Rotation::Ccw,
            Rotation::Ccw => Rotation::Cw,
            Rotation::Stop => Rotation::Stop,
        }
    }
}

/// An arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// End of the arc.
    pub to: Position,
    /// Centre of the arc, X Y Z. Along the axis perpendicular to the plane, the centre has the coordinate of the arc's
    /// start.
    pub center: [f64; 3],
    /// The plane of the arc.
    pub plane: Plane,
    /// Direction of the arc, seen from the positive end of the axis perpendicular to the plane.
    pub direction: Direction,
    /// Number of full turns in addition to the part of a turn to the end.
    pub turns: u32,
    /// Feed of the arc, in the feed mode's unit.
    pub feed: f64,
    /// As bits, the axes whose end is an unknown machine position.
    pub machine: u8,
}

/// The heights of a hole that the program contains. The heights that the program does not contain are known only at the
/// machine.
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

/// The code of a canned cycle, and its motions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle {
    /// The code as in the program.
    pub code: Code,
    /// The motions of the tool.
    pub motions: Motions,
    /// Whether the tool dwells at the bottom.
    pub dwells: bool,
    /// For a tap: whether the control synchronises feed and spindle. `None`: the code of the cycle does not define it.
    pub rigid: Option<bool>,
    /// For a tap: the angle in degrees to which the control turns the spindle before the thread. `None`: the cycle has
    /// no such angle.
    pub start: Option<f64>,
}

impl Cycle {
    /// The cycle of a row of the code table; `None`: the code of the row is not a cycle.
    pub fn of(row: &Row) -> Option<Cycle> {
        Some(Cycle {
            code: row.code,
            motions: row.runs.motions?,
            dwells: row.dwells(),
            rigid: row.runs.rigid,
            start: None,
        })
    }

    /// The name of the cycle, as a program writes it.
    pub fn name(&self) -> String {
        let number = self.code.tenths / 10;
        match self.code.letter {
            b'c' => format!("CYCLE{number}"),
            b'q' => format!("CYCL DEF {number}"),
            _ => self.code.to_string(),
        }
    }
}

/// A hole of a canned cycle, with the values of all words.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drilling {
    /// The cycle of the hole.
    pub cycle: Cycle,
    /// The position above the hole at the return level. The height of this position is not used while the words of the
    /// cycle are read.
    pub at: Position,
    /// The plane perpendicular to the hole.
    pub plane: Plane,
    /// Height of the R plane, where the feed begins, as a position of the depth axis.
    pub r: f64,
    /// Height of the bottom, as a position of the depth axis.
    pub bottom: f64,
    /// The return level: the height to which the tool retracts.
    pub clear: f64,
    /// Dwell at the bottom in seconds.
    pub dwell: f64,
    /// Depth of a peck.
    pub peck: f64,
    /// Sideways shift of the tool in the plane, for a boring cycle.
    pub shift: [f64; 2],
    /// Height at which the cut of a back bore ends.
    pub level: f64,
    /// Feed into the hole, in the feed mode's unit.
    pub feed: f64,
    /// The heights that the program contains.
    pub heights: Heights,
}
