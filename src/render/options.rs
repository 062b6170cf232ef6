//! What a caller may choose.

use crate::lang::VarId;
use crate::toolpath::Units;

/// Where canned cycles come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Cycles {
    /// The form's sequences; moves where it has none.
    #[default]
    Form,
    /// Always moves.
    Emulated,
}

/// What a caller may choose.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Where cycles come from.
    pub cycles: Cycles,
    /// Units of the program; else those of the job.
    pub units: Option<Units>,
    /// The program's number; else that of the job.
    pub program: Option<u32>,
    /// Answers to prompts and values of variables; they go before the job's.
    pub set: Vec<(VarId, f64)>,
    /// Countersink depths by the formula that GENER's manual prints, which is right at 90 degrees only.
    pub sink_as_printed: bool,
    /// Keep a source map.
    pub trace: bool,
}
