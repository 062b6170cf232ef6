//! The result of a preflight check, and the tools of a job.

use super::clock::Times;
use super::fit::Fit;
use crate::control;
use crate::diag::Severity;
use crate::times::BlockTime;
use crate::toolpath::Coolant;
use crate::verify::Finding;

/// The result of a check of a program on a machine.
#[derive(Debug)]
pub struct Fitted {
    /// The findings, in the order of the program.
    pub findings: Vec<Finding>,
    /// The extents, and the allowed values of unknown offsets and lengths.
    pub fit: Fit,
    /// The times of the program. If the machine's file lacks accelerations, the error names them.
    pub times: Result<Times, String>,
    /// The times of the blocks in the order in which they ran, if they were requested and the machine has accelerations.
    pub block_times: Vec<BlockTime>,
    /// The line of a refused block, and the reason. Everything after that block is unknown.
    pub refused: Option<(u64, String)>,
}

impl Fitted {
    /// Whether the program ran to its end without findings.
    pub fn fits(&self) -> bool {
        self.findings.is_empty() && self.refused.is_none()
    }

    /// Whether there are errors. With errors, the program must not run on this machine.
    pub fn has_errors(&self) -> bool {
        self.findings.iter().any(|finding| finding.code.row().severity == Severity::Error)
    }
}

/// What the job and the form add to the program itself.
#[derive(Clone, Debug, Default)]
pub struct Known {
    /// The tools of the job.
    pub tools: Vec<JobTool>,
    /// The codes that turn on coolant in the form, with the kinds of coolant.
    pub coolant: Vec<(control::Code, Coolant)>,
}

/// A tool of the job.
#[derive(Clone, Debug)]
pub struct JobTool {
    /// The number of the tool.
    pub number: u32,
    /// The name of the tool.
    pub name: Option<String>,
    /// The diameter of the tool in millimetres.
    pub diameter: Option<f64>,
    /// The radius of the corner of the tool, in millimetres.
    pub corner_radius: Option<f64>,
}
