//! The language of Okuma OSP controls of mills.
//!
//! Sources: OSP-P200 and OSP-P300 manuals as public notes give them, and what public programs and posts show.

mod block;
mod cycles;
mod flow;

use std::collections::HashMap;

use crate::nc::way::Spot;
use cycles::{Back, Cycle};

/// What a program keeps besides the state of the machine.
#[derive(Debug, Default)]
pub struct Osp {
    /// Common variables, `VC1`.
    common: HashMap<String, f64>,
    /// Local variables, those of the main program first, one map for each subprogram that runs.
    local: Vec<HashMap<String, f64>>,
    /// The arguments of a call that comes next.
    arguments: HashMap<String, f64>,
    /// The cycle in force, with its words.
    cycle: Option<Cycle>,
    /// Where cycles return to; `None`: M52, M53 or M54 was not said since the last G80.
    back: Option<Back>,
    /// The level of `G71 Z`.
    level: Option<f64>,
    /// Labels with their places, by the program that they stand in; and the programs.
    labels: Option<HashMap<(String, String), Spot>>,
}

impl Osp {
    fn value(&self, name: &str) -> Option<f64> {
        self.local.last().and_then(|own| own.get(name)).or_else(|| self.common.get(name)).copied()
    }

    /// Variables of so many subprograms inside each other are kept, and those of the one that runs are there.
    fn at_depth(&mut self, depth: usize) {
        self.local.truncate(depth + 1);
        while self.local.len() < depth + 1 {
            self.local.push(std::mem::take(&mut self.arguments));
        }
    }
}
