//! The language of Okuma OSP controls for mills.
//!
//! Sources: OSP-P200 and OSP-P300 manuals as quoted in public notes, and public programs and posts.

mod block;
mod cycles;
mod flow;

use std::collections::HashMap;

use crate::nc::way::Spot;
use cycles::{Back, Cycle};

/// State of a program besides the state of the machine.
#[derive(Debug, Default)]
pub struct Osp {
    /// Common variables, `VC1`.
    common: HashMap<String, f64>,
    /// Local variables, one map for each running subprogram; the main program is first.
    local: Vec<HashMap<String, f64>>,
    /// The arguments of the next call.
    arguments: HashMap<String, f64>,
    /// The cycle in force with its words.
    cycle: Option<Cycle>,
    /// The return level of cycles; `None`: no M52, M53 or M54 since the last G80.
    back: Option<Back>,
    /// The level of `G71 Z`.
    level: Option<f64>,
    /// Positions of labels, by program and name. A program itself has an empty label name.
    labels: Option<HashMap<(String, String), Spot>>,
}

impl Osp {
    fn value(&self, name: &str) -> Option<f64> {
        self.local.last().and_then(|own| own.get(name)).or_else(|| self.common.get(name)).copied()
    }

    /// Keeps the variables of this many nested subprograms, and creates those of the running one.
    fn at_depth(&mut self, depth: usize) {
        self.local.truncate(depth + 1);
        while self.local.len() < depth + 1 {
            self.local.push(std::mem::take(&mut self.arguments));
        }
    }
}
