//! Table of the job's subprograms: their definitions, numbers and calls.

use std::collections::HashMap;

use crate::lang::{VarId, VarSet};
use crate::render::printer::Page;
use crate::render::said::{Angles, Conditions, Own, Spins};
use crate::render::vars::Vars;
use crate::toolpath::{Axes, Place, key};

/// Table of the job's subprograms.
#[derive(Debug, Default)]
pub struct Subprograms {
    pub defined: Vec<Defined>,
    /// For each subprogram number: the index in `defined`.
    pub by_number: HashMap<u64, usize>,
    /// The calls inside subprograms.
    pub calls: Vec<Called>,
    /// The subprogram that is open, as an index of `defined`.
    pub open: Option<usize>,
    /// Stored subprograms that are printed after the main program.
    pub waiting: Page,
    /// Whether the rest of the StartCode sequence still has to be printed, because subprograms are printed before it.
    pub start_waits: bool,
    /// Saved state of the main program while a subprogram is written.
    pub main: Option<Box<State>>,
}

impl Subprograms {
    /// The subprogram with this number, as an index of `defined`.
    pub fn index(&self, number: f64) -> Option<usize> {
        self.by_number.get(&key(number)).copied()
    }

    /// Whether a subprogram taps without setting the spindle direction first. Subprograms that this subprogram calls
    /// with an unknown spindle direction are included.
    pub fn taps(&self, sub: usize) -> bool {
        let mut seen = vec![false; self.defined.len()];
        let mut open = vec![sub];
        while let Some(sub) = open.pop() {
            if std::mem::replace(&mut seen[sub], true) {
                continue;
            }
            if self.defined[sub].left.spins.taps {
                return true;
            }
            let calls = self.calls.iter().filter(|call| call.from == sub && call.unknown.has(VarId::Direct));
            open.extend(calls.filter_map(|call| self.index(call.to)));
        }
        false
    }

    /// Whether each subprogram ends, by the index of the subprogram in `defined`. A subprogram ends if all subprograms
    /// that it calls end. A subprogram that does not end is part of a cycle of calls, or calls a subprogram in such a
    /// cycle.
    pub fn ending(&self) -> Vec<bool> {
        let mut open = vec![0_usize; self.defined.len()];
        let mut callers = vec![Vec::new(); self.defined.len()];
        for call in &self.calls {
            if let Some(to) = self.index(call.to) {
                open[call.from] += 1;
                callers[to].push(call.from);
            }
        }
        let mut done: Vec<usize> = (0..open.len()).filter(|&sub| open[sub] == 0).collect();
        let mut ends = vec![false; open.len()];
        while let Some(sub) = done.pop() {
            ends[sub] = true;
            for &caller in &callers[sub] {
                open[caller] -= 1;
                if open[caller] == 0 {
                    done.push(caller);
                }
            }
        }
        ends
    }
}

/// State of the main program that a subprogram must not change.
#[derive(Debug)]
pub struct State {
    pub vars: Vars,
    pub conditions: Conditions,
    pub own: Own,
    pub upon_used: Vec<Option<f64>>,
    pub angles: Angles,
    pub feed: Option<f64>,
}

/// Effects of a subprogram on its caller.
#[derive(Debug, Default)]
pub struct Left {
    pub conditions: Conditions,
    pub upon_used: Vec<Option<f64>>,
    /// Whether the subprogram turned a rotary axis.
    pub turned: bool,
    pub spins: Spins,
    /// Height of the tool at the end of the subprogram.
    pub height: Option<f64>,
    /// Position of the tool at the end of the subprogram, as far as the subprogram itself defines this position.
    pub position: Axes,
}

impl Left {
    /// Whether the subprogram sets no condition and contains no stop. A second run then begins in the same state as the
    /// first run.
    pub fn is_nothing(&self) -> bool {
        self.conditions.known().is_empty() && !self.spins.stops
    }
}

#[derive(Debug)]
pub struct Defined {
    pub printed: f64,
    pub first_block: Option<f64>,
    pub left: Left,
    /// Whether the subprogram calls a subprogram that is defined later and whose effects are therefore not known yet.
    pub calls_ahead: bool,
}

#[derive(Debug)]
pub struct Called {
    /// The calling subprogram, as an index of `defined`.
    pub from: usize,
    pub to: f64,
    pub place: Place,
    /// Values of spindle, coolant and work offset that are unknown in the caller and therefore can't be restored.
    pub unknown: VarSet,
    /// Whether the caller turns the spindle counterclockwise.
    pub turned_back: bool,
}
