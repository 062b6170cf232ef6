//! The values of variables, by slot.

use crate::lang::{VARIABLES, VarId, VarSet};

/// One value for each variable that has one.
#[derive(Clone, Debug)]
pub struct Vars {
    values: [f64; 128],
    known: VarSet,
}

impl Default for Vars {
    fn default() -> Self {
        const { assert!(VARIABLES.len() <= 128) };
        Vars { values: [0.0; 128], known: VarSet::default() }
    }
}

impl Vars {
    /// The value, if there is one.
    #[inline]
    pub fn get(&self, var: VarId) -> Option<f64> {
        self.known.has(var).then(|| self.values[var as usize])
    }

    /// Gives a value.
    #[inline]
    pub fn set(&mut self, var: VarId, value: f64) {
        self.values[var as usize] = value;
        self.known.insert(var);
    }

    /// Gives a value, or takes it away.
    pub fn put(&mut self, var: VarId, value: Option<f64>) {
        match value {
            Some(value) => self.set(var, value),
            None => self.known.remove(var),
        }
    }
}
