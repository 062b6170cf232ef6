//! The beginning of an operation.

use super::axes::Axes;
use super::cycle::{CycleSpec, Hole};
use super::start::Given;
use super::tool::{FeedMode, Spindle, Tool};
use crate::lang::Coolant;

/// The beginning of an operation's path. Readers find the first move in advance, because a tool change may print its
/// position.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum First {
    /// The path begins with a rapid to this position.
    Rapid(Axes),
    /// The path begins with the first hole of a cycle.
    Hole(Box<CycleSpec>, Hole),
    /// The path begins with a cut. The tool must not move at rapid to the end of this cut.
    Cut,
    /// The path has no move.
    #[default]
    Nothing,
}

/// The beginning of an operation.
#[derive(Clone, Debug, Default)]
pub struct ToolChange {
    /// Name of the operation.
    pub name: Option<String>,
    /// Tool of the operation; `None` on machines without tools.
    pub tool: Option<Tool>,
    /// Whether the tool is changed even if it is in the spindle. The first operation of a joined job, and an operation
    /// after left-out operations, need this change, because it retracts the tool.
    pub reloads: bool,
    /// Spindle data of the operation, if given.
    pub spindle: Option<Spindle>,
    /// Coolant of the operation, if given.
    pub coolant: Option<Coolant>,
    /// Work offset: a fixture number if below 50, otherwise a code.
    pub work: Option<f64>,
    /// Feed of moves that have no feed of their own, in the unit of `feed_mode`.
    pub feed: Option<f64>,
    /// Feed of plunges, in the unit of `feed_mode`.
    pub plunge: Option<f64>,
    /// Feed mode of the operation.
    pub feed_mode: Option<FeedMode>,
    /// A comment to print.
    pub comment: Option<String>,
    /// Values for variables, by name: the values of the operation, and the values that are set before its first move.
    pub set: Vec<(String, Given)>,
    /// The beginning of the path.
    pub first: First,
}

impl ToolChange {
    /// The tool that the operation changes to. `None`: the tool in the spindle, with the number `before`, stays.
    pub fn changes_to(&self, before: Option<f64>) -> Option<&Tool> {
        self.tool.as_ref().filter(|tool| self.reloads || before != Some(tool.number))
    }
}
