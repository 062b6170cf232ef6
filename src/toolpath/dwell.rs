//! The last dwell, which one cycle takes over from another.

use super::{CycleKind, CycleSpec};

/// The last dwell of a cycle. A face cycle, or a tap that does not reverse the spindle, uses it if it has no dwell of its own.
#[derive(Clone, Copy, Debug, Default)]
pub struct LastDwell {
    seconds: Option<f64>,
    revs: Option<f64>,
}

impl LastDwell {
    /// Sets the dwell of a cycle that needs one and has none. If the cycle has its own dwell, remembers it.
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
