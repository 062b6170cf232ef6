//! Values of variables, by slot, and groups of variables.

use crate::lang::{MOST_VARIABLES, VARIABLES, VarId, VarSet};

/// Variables of the target, for the linear axes.
pub const NOW: [VarId; 3] = [VarId::H, VarId::V, VarId::D];

/// Variables of the distances, for the linear axes.
pub const MOVED: [VarId; 3] = [VarId::Hdist, VarId::Vdist, VarId::Ddist];

/// Variables that generated moves use.
pub const MOVE_VARS: VarSet = VarSet::of(&[VarId::H, VarId::V, VarId::D, VarId::Frate, VarId::Rotangle]);

/// Variables that hold the position before a move.
pub const LAST_VARS: VarSet =
    VarSet::of(&[VarId::Lasth, VarId::Lastv, VarId::Lastd, VarId::Hdist, VarId::Vdist, VarId::Ddist]);

/// Variables of the tool's position.
pub const PLACE: [VarId; 6] = [VarId::H, VarId::V, VarId::D, VarId::Lasth, VarId::Lastv, VarId::Lastd];

/// Variables that require the length of each move.
pub const MEASURES: VarSet =
    VarSet::of(&[VarId::Movelength, VarId::Movetime, VarId::Totalcutdist, VarId::Totalcuttime, VarId::Invtime]);

/// The values of variables; a variable may have no value.
#[derive(Clone, Debug)]
pub struct Vars {
    values: [f64; MOST_VARIABLES],
    known: VarSet,
}

impl Default for Vars {
    fn default() -> Self {
        const { assert!(VARIABLES.len() <= MOST_VARIABLES) };
        Vars { values: [0.0; MOST_VARIABLES], known: VarSet::default() }
    }
}

impl Vars {
    /// The value, if there is one.
    #[inline]
    pub fn get(&self, var: VarId) -> Option<f64> {
        self.known.has(var).then(|| self.values[var as usize])
    }

    /// Gives a variable a value.
    #[inline]
    pub fn set(&mut self, var: VarId, value: f64) {
        self.values[var as usize] = value;
        self.known.insert(var);
    }

    /// Sets or clears a value.
    pub fn put(&mut self, var: VarId, value: Option<f64>) {
        match value {
            Some(value) => self.set(var, value),
            None => self.known.remove(var),
        }
    }
}
