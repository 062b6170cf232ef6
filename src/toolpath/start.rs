//! The head of a job.

use super::axes::Units;
use crate::lang::Machine;

/// The head of a job.
#[derive(Clone, Debug)]
pub struct Start {
    /// Number of the program.
    pub program: Option<f64>,
    /// Name of the job.
    pub name: Option<String>,
    /// Units of the job's numbers.
    pub units: Units,
    /// Type of machine that the job is for.
    pub machine: Machine,
    /// Values for variables, by name.
    pub set: Vec<(String, f64)>,
    /// The tools in order of use, where the job tells.
    pub tool_order: Option<Vec<f64>>,
}

impl Start {
    /// The head of a mill's job that says nothing else.
    pub fn new(units: Units) -> Start {
        Start { program: None, name: None, units, machine: Default::default(), set: Vec::new(), tool_order: None }
    }
}
