//! What the form itself has set.

use crate::sema::Target;

/// What the form itself has set: it holds from there to the end of the program.
#[derive(Clone, Debug, Default)]
pub struct Kept(Vec<(Target, f64)>);

impl Kept {
    /// The value, if the form has set it.
    #[inline]
    pub fn of(&self, target: Target) -> Option<f64> {
        if self.0.is_empty() {
            return None;
        }
        self.0.iter().find(|(own, _)| *own == target).map(|(_, value)| *value)
    }

    /// The form sets it.
    pub fn set(&mut self, target: Target, value: f64) {
        match self.0.iter_mut().find(|(own, _)| *own == target) {
            Some(row) => row.1 = value,
            None => self.0.push((target, value)),
        }
    }
}
