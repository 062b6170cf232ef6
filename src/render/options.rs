//! What a caller may choose.

use std::sync::Arc;

use crate::lang::VarId;
use crate::sema::PropertyValue;
use crate::survey::Survey;
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

/// Day and time of printing: nothing of the library looks at a clock.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Clock {
    /// `[date]`, as 2026-03-31.
    pub date: String,
    /// `[time]`, as 14:05; empty where only the day is said.
    pub time: String,
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
    /// Properties of the form that go before all else, by their rows.
    pub properties: Vec<(u16, PropertyValue)>,
    /// Properties that go before the form's defaults.
    pub shop: Vec<(u16, PropertyValue)>,
    /// Countersink depths by the formula that GENER's manual prints, which is right at 90 degrees only.
    pub sink_as_printed: bool,
    /// Day and time of printing, as the program says them.
    pub clock: Option<Clock>,
    /// The job's file, as the program says it.
    pub job_file: Option<String>,
    /// What lies ahead in the job, for forms that print any of it.
    pub survey: Option<Arc<Survey>>,
    /// Keep a source map.
    pub trace: bool,
    /// Keep what each word of the form came to.
    pub words: bool,
}
