//! Where a program goes: places in its text, what it is inside of, and what it looks for.

use super::action::Position;
use super::profiled::Profiled;

/// A place in the program to go to: byte and lines before it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Spot {
    pub byte: u64,
    pub line: u64,
}

/// What runs inside the main program.
#[derive(Debug)]
pub(super) enum Frame {
    /// A subprogram: where it was called, and how often it still runs.
    Call { label: String, back: Spot, start: Spot, times: u32, arguments: bool },
    /// A `while`, with the place of its line.
    While { label: String, start: Spot },
    /// A `do`, with the place of its line.
    Do { label: String, start: Spot },
    /// A `repeat`, from the line after it.
    Repeat { label: String, start: Spot, left: u32 },
    /// The profile of a cycle: where its block ends, where the profile ends, and from where the cycle began.
    Profile { back: Spot, end: Spot, start: Position },
    /// An `if` one of whose branches runs.
    If { label: String },
}

impl Frame {
    /// The label by which it was begun.
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

/// What ends a part that is passed over.
#[derive(Clone, Copy, Debug)]
pub(super) enum Ends {
    Sub,
    While,
    Do,
    Repeat,
    If,
    Branch,
    /// The condition of a `do`, which is run.
    Test,
}

/// Where to go from a line.
pub(super) enum Jump {
    On,
    End,
    To(Spot),
    Find(String, u32),
    Skip(String, Ends),
    /// To the profile of a cycle.
    Profile(Profiled),
    /// To what must be looked for first.
    Search(Search),
}

/// What the way through a program of another language needs to look for.
#[derive(Debug)]
pub(super) enum Search {
    /// A label: forwards, backwards, or either.
    Label(String, Option<bool>),
    /// The end of what this line opens; `true`: it is entered.
    Part(bool),
    /// A subprogram with its arguments, so many times.
    Call(String, Vec<Option<f64>>, u32),
}
