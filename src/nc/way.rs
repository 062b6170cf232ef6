//! Positions in the text of a program, program parts that are being run, and jumps.

use super::action::Position;
use super::profiled::Profiled;

/// A position in the text of a program: its byte, and the number of lines before it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Spot {
    pub byte: u64,
    pub line: u64,
}

/// A part of the program that is being run: a subprogram, a loop or a branch.
#[derive(Debug)]
pub(super) enum Frame {
    /// A subprogram: the position after its call, its start, and the number of runs that are left.
    Call { label: String, back: Spot, start: Spot, times: u32, arguments: bool },
    /// A `while` loop, with the position of its first line.
    While { label: String, start: Spot },
    /// A `do` loop, with the position of its first line.
    Do { label: String, start: Spot },
    /// A `repeat` loop, with the position after its first line.
    Repeat { label: String, start: Spot, left: u32 },
    /// The profile of a cycle: the position after the block of the cycle, the end of the profile, and the position of
    /// the tool at the start of the cycle.
    Profile { back: Spot, end: Spot, start: Position },
    /// An `if`, one of whose branches is being run.
    If { label: String },
}

impl Frame {
    /// The label of the part.
    pub fn label(&self) -> &str {
        match self {
            Frame::Call { label, .. }
            | Frame::While { label, .. }
            | Frame::Do { label, .. }
            | Frame::Repeat { label, .. }
            | Frame::If { label } => label,
            Frame::Profile { .. } => "",
        }
    }
}

/// The end up to which lines are skipped.
#[derive(Clone, Copy, Debug)]
pub(super) enum Ends {
    Sub,
    While,
    Do,
    Repeat,
    If,
    Branch,
    /// The condition of a `do`, which is evaluated after the skipped lines.
    Test,
}

/// Where the program continues after a line.
pub(super) enum Jump {
    On,
    End,
    To(Spot),
    Find(String, u32),
    Skip(String, Ends),
    /// Continue with the profile of a cycle.
    Profile(Profiled),
    /// Continue at a target that has to be searched first.
    Search(Search),
}

/// The target of a search, in a program that is not in G code with O words.
#[derive(Debug)]
pub(super) enum Search {
    /// A label. `true`: search forwards, `false`: backwards, `None`: in both directions.
    Label(String, Option<bool>),
    /// The end of the part that this line opens. `true`: the part is being run.
    Part(bool),
    /// A subprogram: its name, the arguments, and the number of calls.
    Call(String, Vec<Option<f64>>, u32),
}
