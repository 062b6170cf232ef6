//! Positions, frames and jumps of a program's text.

use super::action::Position;
use super::profiled::Profiled;

/// A position in the program's text: its byte, and the number of lines before it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Spot {
    pub byte: u64,
    pub line: u64,
}

/// A part that runs inside the main program.
#[derive(Debug)]
pub(super) enum Frame {
    /// A subprogram: the position of its call, its start, and the number of runs left.
    Call { label: String, back: Spot, start: Spot, times: u32, arguments: bool },
    /// A `while`, with the position of its line.
    While { label: String, start: Spot },
    /// A `do`, with the position of its line.
    Do { label: String, start: Spot },
    /// A `repeat`, with the position after its line.
    Repeat { label: String, start: Spot, left: u32 },
    /// The profile of a cycle: the end of the cycle's block, the end of the profile, and the start position of the cycle.
    Profile { back: Spot, end: Spot, start: Position },
    /// An `if` with one of its branches running.
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

/// The end of a part that is skipped.
#[derive(Clone, Copy, Debug)]
pub(super) enum Ends {
    Sub,
    While,
    Do,
    Repeat,
    If,
    Branch,
    /// The condition of a `do`. The condition is run.
    Test,
}

/// Where the program continues after a line.
pub(super) enum Jump {
    On,
    End,
    To(Spot),
    Find(String, u32),
    Skip(String, Ends),
    /// Continue at the profile of a cycle.
    Profile(Profiled),
    /// Continue at a target that must be searched first.
    Search(Search),
}

/// A search target of a program in another language.
#[derive(Debug)]
pub(super) enum Search {
    /// A label: `true` forwards, `false` backwards, `None` either.
    Label(String, Option<bool>),
    /// The end of the part that this line opens; `true`: the part is entered.
    Part(bool),
    /// A subprogram with its arguments and the number of calls.
    Call(String, Vec<Option<f64>>, u32),
}
