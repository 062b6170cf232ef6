//! The result of a check, and the tools of a job.

use super::clock::Times;
use super::fit::Fit;
use crate::diag::Severity;
use crate::times::BlockTime;
use crate::verify::Finding;

/// The findings, and the fit of the program in the machine.
#[derive(Debug)]
pub struct Fitted {
    /// The findings, in the order of the program.
    pub findings: Vec<Finding>,
    /// The extents, and the allowed values of unknown offsets or lengths.
    pub fit: Fit,
    /// Its time, or the missing accelerations of the machine.
    pub times: Result<Times, String>,
    /// The times of blocks in the order in which they ran, if they were asked for and the machine has accelerations.
    pub block_times: Vec<BlockTime>,
    /// The line of a refused block, and the reason. Everything after that block is unknown.
    pub refused: Option<(u64, String)>,
}

impl Fitted {
    /// Was the program run to its end without findings?
    pub fn fits(&self) -> bool {
        self.findings.is_empty() && self.refused.is_none()
    }

    /// Are there errors, so that the program must not run on this machine?
    pub fn has_errors(&self) -> bool {
        self.findings.iter().any(|finding| finding.code.row().severity == Severity::Error)
    }
}

/// A tool of the job.
#[derive(Clone, Debug)]
pub struct JobTool {
    /// Its number.
    pub number: u32,
    /// Its diameter in millimetres.
    pub diameter: Option<f64>,
    /// The radius of its corner in millimetres.
    pub corner_radius: Option<f64>,
}
