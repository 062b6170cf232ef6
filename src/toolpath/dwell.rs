//! The last dwell of a cycle, which a later cycle can use.

use super::{CycleKind, CycleSpec};

/// The last dwell of a cycle. A face cycle, or a tap that does not reverse the spindle, uses the last dwell if it has
/// no dwell of its own.
#[derive(Clone, Copy, Debug, Default)]
pub struct LastDwell {
    seconds: Option<f64>,
    revs: Option<f64>,
}

impl LastDwell {
    /// Sets the dwell of a cycle that needs a dwell and has none. If the cycle has its own dwell, stores this dwell.
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
