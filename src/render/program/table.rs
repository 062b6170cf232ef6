//! What is known of the job's subprograms: where they stand, their numbers, and who calls whom.

use std::collections::HashMap;

use crate::lang::{VarId, VarSet};
use crate::render::printer::Page;
use crate::render::said::{Angles, Conditions, Own, Spins};
use crate::render::vars::Vars;
use crate::toolpath::{Axes, Place, key};

/// What is known of the job's subprograms.
#[derive(Debug, Default)]
pub struct Subprograms {
    pub defined: Vec<Defined>,
    /// Where each number is in `defined`.
    pub by_number: HashMap<u64, usize>,
    /// The calls inside subprograms.
    pub calls: Vec<Called>,
    /// The subprogram that is open, as an index of `defined`.
    pub open: Option<usize>,
    /// Subprograms that stand after the main program wait here.
    pub waiting: Page,
    /// The rest of StartCode is still to be printed: subprograms come first.
    pub start_waits: bool,
    /// What is so in the main program, while a subprogram is written.
    pub main: Option<Box<State>>,
}

impl Subprograms {
    /// The subprogram of a number, as an index of `defined`.
    pub fn index(&self, number: f64) -> Option<usize> {
        self.by_number.get(&key(number)).copied()
    }

    /// Does a subprogram tap, or one that it calls, without a word of how the spindle turns?
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

    /// Which subprograms end: those all of whose calls do. Each of the others is in a circle, or leads into one.
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

/// What a subprogram's own items must not change for the program around it.
#[derive(Debug)]
pub struct State {
    pub vars: Vars,
    pub conditions: Conditions,
    pub own: Own,
    pub upon_used: Vec<Option<f64>>,
    pub angles: Angles,
    pub feed: Option<f64>,
}

/// What a subprogram leaves to its caller.
#[derive(Debug, Default)]
pub struct Left {
    pub conditions: Conditions,
    pub upon_used: Vec<Option<f64>>,
    /// A rotary axis turned.
    pub turned: bool,
    pub spins: Spins,
    /// The height at which it leaves the tool.
    pub height: Option<f64>,
    /// Where it leaves the tool, as far as its own items say.
    pub position: Axes,
}

impl Left {
    /// Does the subprogram leave nothing that its next run would find otherwise?
    pub fn is_nothing(&self) -> bool {
        self.conditions.known().is_empty() && !self.spins.stops
    }
}

#[derive(Debug)]
pub struct Defined {
    pub printed: f64,
    pub first_block: Option<f64>,
    pub left: Left,
    /// The subprogram calls one that comes later: what that one leaves is not known here.
    pub calls_ahead: bool,
}

#[derive(Debug)]
pub struct Called {
    /// The calling subprogram, as an index of `defined`.
    pub from: usize,
    pub to: f64,
    pub place: Place,
    /// What the caller does not know of spindle, coolant and work offset, so that it can't put it back.
    pub unknown: VarSet,
    /// The caller turns the spindle counterclockwise.
    pub turned_back: bool,
}
