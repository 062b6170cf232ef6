//! The head of a job.

use super::axes::Units;
use crate::lang::Machine;

/// A value that a job gives to a variable or property of the form.
#[derive(Clone, Debug, PartialEq)]
pub enum Given {
    /// A number.
    Number(f64),
    /// A text, a word of a choice, or `yes` or `no`.
    Text(String),
}

/// Information for people about the part to be made.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct About {
    /// Name or number of the part.
    pub part: Option<String>,
    /// Material of the part.
    pub material: Option<String>,
    /// Customer of the part.
    pub customer: Option<String>,
    /// Author of the job.
    pub author: Option<String>,
}

/// The head of a job.
#[derive(Clone, Debug)]
pub struct Start {
    /// Number of the program.
    pub program: Option<f64>,
    /// Name of the job.
    pub name: Option<String>,
    /// Information about the part.
    pub about: About,
    /// Units of the job's numbers.
    pub units: Units,
    /// Type of machine that the job is for.
    pub machine: Machine,
    /// Values that the job sets for variables and properties, by name.
    pub set: Vec<(String, Given)>,
    /// The tool numbers in the order of use, if the job gives them.
    pub tool_order: Option<Vec<f64>>,
}

impl Start {
    /// The head of a job for a mill, with no data except the units.
    pub fn new(units: Units) -> Start {
        Start {
            program: None,
            name: None,
            about: About::default(),
            units,
            machine: Default::default(),
            set: Vec::new(),
            tool_order: None,
        }
    }
}
