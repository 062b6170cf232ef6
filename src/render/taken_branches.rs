//! The branch combinations of sequences that were taken so far.

use std::cell::OnceCell;

use elsa::FrozenMap;

use super::fault::Done;
use crate::compile::Routine;
use crate::diag::Diag;

/// Routines for the branch combinations that were taken so far, each built once. The key is the sequence with its branches.
#[derive(Default)]
pub struct Ways {
    pub known: FrozenMap<(usize, usize, u128), Box<Routine>>,
    /// Error of a condition that could not be evaluated.
    pub fault: OnceCell<Box<Diag>>,
}

impl Ways {
    /// Fails if a condition could not be evaluated.
    #[inline]
    pub fn check(&self) -> Done {
        self.fault.get().map_or(Ok(()), |diag| Err(diag.clone()))
    }
}
