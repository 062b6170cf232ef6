//! Kinds of coolant that are on beside the first.

use super::state::Said;
use crate::lang::Coolant;
use crate::render::coolant::codes;
use crate::render::shape::Shape;
use crate::render::want::Want;

impl Said {
    /// Does the job want other kinds beside the first than are on?
    pub(super) fn lacks_beside(&self, want: &Want) -> bool {
        let others = want.coolant.without(want.coolant.first());
        self.beside.without(others) != Coolant::OFF || others.without(self.beside) != Coolant::OFF
    }

    /// Takes a code that switches a kind beside the first. `false`: it says nothing of those alone.
    pub(super) fn beside_code(&mut self, code: f64, want: &Want, shape: &Shape) -> bool {
        let settings = &shape.program.settings;
        if self.beside == Coolant::OFF && want.coolant == want.coolant.first() {
            return false; // one kind, or none
        }
        let begins = |kind: &Coolant| codes(*kind, settings).is_some_and(|codes| codes.on == code);
        let ends = |kind: &Coolant| codes(*kind, settings).is_some_and(|codes| codes.own_off == Some(code));
        if let Some(kind) = want.coolant.others().find(begins) {
            self.beside = self.beside.and(kind);
            return true;
        }
        if let Some(kind) = self.beside.each().find(ends).filter(|_| !ends(&want.coolant.first())) {
            self.beside = self.beside.without(kind);
            return true;
        }
        if code == settings.coolant[1] {
            self.beside = Coolant::OFF;
        }
        false
    }
}
