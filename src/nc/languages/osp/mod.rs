//! The language of Okuma OSP controls for mills.
//!
//! Sources: OSP-P200 and OSP-P300 manuals as quoted in public notes, and public programs and posts.

mod block;
mod cycles;
mod flow;

use std::collections::HashMap;

use crate::nc::way::Spot;
use cycles::{Back, Cycle};

/// The state of an Okuma program, in addition to the state of the machine.
#[derive(Debug, Default)]
pub struct Osp {
    /// Values of the common variables, such as `VC1`.
    common: HashMap<String, f64>,
    /// Values of the local variables: one map for the main program, then one for each running subprogram.
    local: Vec<HashMap<String, f64>>,
    /// The arguments for the next call.
    arguments: HashMap<String, f64>,
    /// The active cycle, with its words.
    cycle: Option<Cycle>,
    /// The return level of cycles; `None`: the program contains no M52, M53 or M54 after the last G80.
    back: Option<Back>,
    /// The level that `G71 Z` has set.
    level: Option<f64>,
    /// Positions of labels, by program and label. An empty label is the beginning of the program; `None`: the input has
    /// not been searched yet.
    labels: Option<HashMap<(String, String), Spot>>,
}

impl Osp {
    fn value(&self, name: &str) -> Option<f64> {
        self.local.last().and_then(|own| own.get(name)).or_else(|| self.common.get(name)).copied()
    }

    /// Removes the variables of subprograms that have ended, and adds those of the subprogram that is running.
    fn at_depth(&mut self, depth: usize) {
        self.local.truncate(depth + 1);
        while self.local.len() < depth + 1 {
            self.local.push(std::mem::take(&mut self.arguments));
        }
    }
}
