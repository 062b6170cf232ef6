//! Options for reading a program as a job.

use crate::nc::settings::RunSettings;
use crate::toolpath::Units;

/// Options for reading a program as a job.
#[derive(Clone, Copy, Debug)]
pub struct JobOptions<'a> {
    /// Settings for running the program, including its control.
    pub settings: RunSettings,
    /// Units of a program that has no code for units.
    pub units: Option<Units>,
    /// Number of the first tool, if the program cuts before it loads a tool.
    pub tool: Option<f64>,
    /// Numbers of tools that the program calls by their names.
    pub tool_names: &'a [(String, f64)],
    /// Position of the tool at a cut that begins at an unknown machine position.
    pub start: Option<[f64; 3]>,
}
