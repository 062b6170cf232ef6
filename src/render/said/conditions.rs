//! Conditions: modal states of the control (work offset, spindle, coolant, feed mode), as last printed.

use crate::lang::{VarId, VarSet};

/// The variables of the conditions.
pub const CONDITIONS: [VarId; 7] =
    [VarId::Work, VarId::Speed, VarId::Direct, VarId::Cool, VarId::Feedtype, VarId::Speedtype, VarId::Maxrpm];

/// The values that were printed last; `None`: unknown.
#[derive(Clone, Copy, Debug, Default)]
pub struct Conditions {
    /// Values in the order of [`CONDITIONS`].
    values: [Option<f64>; CONDITIONS.len()],
}

impl Conditions {
    /// Each condition with its last printed value.
    pub fn each(&self) -> impl Iterator<Item = (VarId, Option<f64>)> {
        CONDITIONS.into_iter().zip(self.values)
    }

    /// The last printed value of a condition.
    pub fn get(&self, var: VarId) -> Option<f64> {
        index(var).and_then(|at| self.values[at])
    }

    /// Stores a printed value, or `None` for unknown. Returns whether the variable is a condition.
    pub fn put(&mut self, var: VarId, value: Option<f64>) -> bool {
        let at = index(var);
        if let Some(at) = at {
            self.values[at] = value;
        }
        at.is_some()
    }

    /// Whether this value is the last printed value of the condition.
    pub fn holds(&self, var: VarId, value: f64) -> bool {
        self.get(var) == Some(value)
    }

    /// The conditions whose printed values are known.
    pub fn known(&self) -> VarSet {
        let mut known = VarSet::default();
        for (var, _) in self.each().filter(|(_, value)| value.is_some()) {
            known.insert(var);
        }
        known
    }

    /// The conditions after a call of a subprogram that printed the conditions `later`.
    pub fn then(&self, later: &Conditions) -> Conditions {
        let mut values = self.values;
        for (value, later) in values.iter_mut().zip(later.values) {
            *value = later.or(*value);
        }
        Conditions { values }
    }
}

fn index(var: VarId) -> Option<usize> {
    Some(match var {
        VarId::Work => 0,
        VarId::Speed => 1,
        VarId::Direct => 2,
        VarId::Cool => 3,
        VarId::Feedtype => 4,
        VarId::Speedtype => 5,
        VarId::Maxrpm => 6,
        _ => return None,
    })
}
