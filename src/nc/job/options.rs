//! How a program is read as a job.

use crate::nc::settings::RunSettings;
use crate::toolpath::Units;

/// How a program is read as a job.
#[derive(Clone, Copy, Debug)]
pub struct JobOptions {
    /// Control of the program, and how it is run.
    pub settings: RunSettings,
    /// Units of a program that says none.
    pub units: Option<Units>,
    /// Number of the first tool, for a program that cuts before it loads one.
    pub tool: Option<f64>,
    /// Where the tool is before a cut that begins at a place that only the machine knows.
    pub start: Option<[f64; 3]>,
}
