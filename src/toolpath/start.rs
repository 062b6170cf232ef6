//! The head of a job.

use super::axes::Units;
use crate::lang::Machine;

/// A value that a job gives a variable or a property of the form.
#[derive(Clone, Debug, PartialEq)]
pub enum Given {
    /// A number.
    Number(f64),
    /// A text, a word, or `yes` and `no`.
    Text(String),
}

/// What a job says of its part, for people.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct About {
    /// Name or number of the part.
    pub part: Option<String>,
    /// What the part is made of.
    pub material: Option<String>,
    /// Who gets the part.
    pub customer: Option<String>,
    /// Who made the job.
    pub author: Option<String>,
}

/// The head of a job.
#[derive(Clone, Debug)]
pub struct Start {
    /// Number of the program.
    pub program: Option<f64>,
    /// Name of the job.
    pub name: Option<String>,
    /// What the job says of its part.
    pub about: About,
    /// Units of the job's numbers.
    pub units: Units,
    /// Type of machine that the job is for.
    pub machine: Machine,
    /// Values for variables, by name.
    pub set: Vec<(String, Given)>,
    /// The tools in order of use, where the job tells.
    pub tool_order: Option<Vec<f64>>,
}

impl Start {
    /// The head of a mill's job that says nothing else.
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
