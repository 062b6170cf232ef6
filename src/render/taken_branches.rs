//! The ways through sequences that were taken so far.

use std::cell::OnceCell;

use elsa::FrozenMap;

use super::fault::Done;
use crate::compile::Routine;
use crate::diag::Diag;

/// The ways that were taken so far, each made once, by the sequence and its branches.
#[derive(Default)]
pub struct Ways {
    pub known: FrozenMap<(usize, usize, u128), Box<Routine>>,
    /// A condition could not be asked.
    pub fault: OnceCell<Box<Diag>>,
}

impl Ways {
    /// Were all conditions so far such that they can be asked?
    #[inline]
    pub fn check(&self) -> Done {
        self.fault.get().map_or(Ok(()), |diag| Err(diag.clone()))
    }
}
