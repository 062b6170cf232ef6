//! The dwell that is kept from one cycle to the next.

use super::{CycleKind, CycleSpec};

/// The last dwell of a cycle. A face cycle, or a tap that does not reverse, uses it if it has no dwell of its own.
#[derive(Clone, Copy, Debug, Default)]
pub struct LastDwell {
    seconds: Option<f64>,
    revs: Option<f64>,
}

impl LastDwell {
    /// Fills in the dwell of a cycle, or keeps the cycle's own dwell.
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
