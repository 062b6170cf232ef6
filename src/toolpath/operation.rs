//! How an operation begins.

use super::axes::Axes;
use super::cycle::{CycleSpec, Hole};
use super::start::Given;
use super::tool::{FeedMode, Spindle, Tool};
use crate::lang::Coolant;

/// How an operation's path begins: readers look ahead for it, because a tool change may print the position.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum First {
    /// The path begins with a rapid to here.
    Rapid(Axes),
    /// The path begins with the first hole of a cycle.
    Hole(Box<CycleSpec>, Hole),
    /// The path begins with a move that cuts, whose target is no place to rapid to.
    Cut,
    /// The path has no move.
    #[default]
    Nothing,
}

/// The beginning of an operation: the tool changes where its number does.
#[derive(Clone, Debug, Default)]
pub struct ToolChange {
    /// Name of the operation.
    pub name: Option<String>,
    /// Tool of the operation; machines without tools have none.
    pub tool: Option<Tool>,
    /// Spindle, where given.
    pub spindle: Option<Spindle>,
    /// Coolant, where given.
    pub coolant: Option<Coolant>,
    /// Work offset: a fixture number below 50, else the code.
    pub work: Option<f64>,
    /// Feed of the moves until one names another, by `feed_mode`.
    pub feed: Option<f64>,
    /// Feed of plunges, by `feed_mode`.
    pub plunge: Option<f64>,
    /// What feeds of the operation count.
    pub feed_mode: Option<FeedMode>,
    /// A comment to print.
    pub comment: Option<String>,
    /// Values for variables, by name: those of the operation, and those set before its first move.
    pub set: Vec<(String, Given)>,
    /// How the path begins.
    pub first: First,
}
