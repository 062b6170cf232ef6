//! Options for reading a program as a job.

use crate::nc::settings::RunSettings;
use crate::toolpath::Units;

/// Options for reading a program as a job.
#[derive(Clone, Copy, Debug)]
pub struct JobOptions {
    /// Control of the program, and settings of the run.
    pub settings: RunSettings,
    /// Units for a program without a unit code.
    pub units: Option<Units>,
    /// Number of the first tool, for a program that cuts before it loads a tool.
    pub tool: Option<f64>,
    /// Position of the tool before a cut that begins at a position known only at the machine.
    pub start: Option<[f64; 3]>,
}
