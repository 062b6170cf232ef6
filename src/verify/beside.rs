//! Everything between two cuts except the path: stops, dwells, codes, machine positions and more.

use super::cut::Place;
use super::measured::Measured;
use super::wire_codes::Coded;
use crate::nc::Rotation;
use crate::toolpath::{self, Side, StopKind};

/// Cutter compensation that is on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Compensated {
    pub side: Side,
    /// The register of the diameter; `None`: the job or the program does not name it.
    pub register: Option<f64>,
}

/// A machine position of an axis that the program gives as a number.
#[derive(Clone, Copy, Debug)]
pub(super) struct AtMachine {
    /// The number, measured from the zero of the program.
    pub at: f64,
    /// The reference point ([`Simulator::reference_point`](crate::nc::Simulator::reference_point)).
    pub point: usize,
    /// The register of the active tool length, if a setting of the machine decides whether the length counts.
    pub length: Option<f64>,
}

/// An action between two cuts, such as a stop or a dwell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mark<T> {
    pub what: T,
    /// Number of rapids before the mark.
    pub at: usize,
    /// Number of frame changes between the last cut and the mark.
    pub leg: usize,
    /// Whether the spindle was started from a stop between the last cut and the mark.
    pub started: bool,
    /// Whether a torch or a laser is off at the mark. A torch or laser that is off is not in a cut.
    pub is_off: bool,
    /// The program's line; 0 for a job.
    pub line: u64,
    /// The item of the job.
    pub place: toolpath::Place,
}

/// Everything between two cuts except the path. Most passages contain nothing of it: [`Passage`](super::passage::Passage) gives access to the
/// fields, and records each access that may change them.
#[derive(Clone, Debug, Default)]
pub(super) struct Beside {
    /// The compensations with which the rapids were made, in order.
    pub compensated: Vec<Compensated>,
    /// The frames of the program's rapids.
    pub measured: Measured,
    pub stops: Vec<Mark<StopKind>>,
    /// Changes of the program to the tool that is in the spindle.
    pub reloads: Vec<Mark<()>>,
    /// Dwells in seconds. NaN means a dwell of any length.
    pub waits: Vec<Mark<f64>>,
    /// The changes of the spindle's rotation, in order.
    pub turns: Vec<Rotation>,
    /// Whether the spindle was started from a stop.
    pub started: bool,
    /// Whether a torch or a laser is off now.
    pub is_off: bool,
    /// Codes of the program that are not simulated, each followed by its words: the letter, and the number.
    pub codes: Vec<(u8, f64)>,
    /// Words and statements of the program that are not simulated.
    pub words: Vec<Box<str>>,
    /// The words with which the program sets tool data (G10 L10 to L13), in their order.
    pub tool_data: Vec<(u8, f64)>,
    /// Codes for threading and cutting a wire.
    pub does: Vec<Mark<Coded>>,
    /// Whether the tool was changed.
    pub new_tool: bool,
    /// For each tool change of a lathe: the axes that are at a machine position, as bits.
    pub turrets: Vec<u8>,
    /// Axes that went to a machine position that the program gives as a number.
    pub homes: u8,
    /// For X, Y, Z, A, B and C: these positions in their order.
    pub machine: [Vec<AtMachine>; 6],
    /// Targets of incremental moves from an unknown machine position, each with its line.
    pub astray: Vec<(u64, Place)>,
}

impl Beside {
    /// Empties everything, and keeps the memory.
    pub fn clear(&mut self) {
        self.compensated.clear();
        self.measured.clear();
        self.stops.clear();
        self.reloads.clear();
        self.waits.clear();
        self.turns.clear();
        (self.started, self.is_off, self.new_tool) = (false, false, false);
        self.codes.clear();
        self.words.clear();
        self.tool_data.clear();
        self.does.clear();
        self.turrets.clear();
        self.homes = 0;
        self.machine.iter_mut().for_each(Vec::clear);
        self.astray.clear();
    }
}
