//! The dwell that holds from one cycle to the next.

use super::{CycleKind, CycleSpec};

/// The last dwell of a cycle: a face, and a tap that does not reverse, take it when they say none.
#[derive(Clone, Copy, Debug, Default)]
pub struct LastDwell {
    seconds: Option<f64>,
    revs: Option<f64>,
}

impl LastDwell {
    /// Fills a cycle in, or remembers what it says.
    pub fn fill(&mut self, spec: &mut CycleSpec) {
        match (spec.dwell, spec.revs) {
            (None, None) if spec.kind == CycleKind::Face || spec.norevr => {
                (spec.dwell, spec.revs) = (self.seconds, self.revs);
            }
            (None, None) => {}
            (seconds, revs) => *self = LastDwell { seconds, revs },
        }
    }
}
