//! Kinds of coolant that are on beside the first.

use super::state::Said;
use crate::lang::Coolant;
use crate::render::coolant::codes;
use crate::render::shape::Shape;
use crate::render::want::Want;

/// Kinds of coolant beside the first, as the program said them.
#[derive(Clone, Copy, Debug)]
pub struct Beside {
    /// Those that may be on: they were turned on, and nothing ended them for certain.
    may: Coolant,
    /// Those of them that are on: nothing may have ended them since.
    sure: Coolant,
}

impl Beside {
    /// None.
    pub const OFF: Beside = Beside { may: Coolant::OFF, sure: Coolant::OFF };

    /// A kind is on.
    pub fn begin(&mut self, kind: Coolant) {
        *self = Beside { may: self.may.and(kind), sure: self.sure.and(kind) };
    }

    /// A kind is off, or is the first now.
    pub fn end(&mut self, kind: Coolant) {
        *self = Beside { may: self.may.without(kind), sure: self.sure.without(kind) };
    }

    /// A stop, or a subprogram: all may be off.
    pub fn doubt(&mut self) {
        self.sure = Coolant::OFF;
    }

    /// Is a kind on for certain?
    pub fn holds(self, kind: Coolant) -> bool {
        self.sure.holds(kind)
    }

    /// A kind that may be on, and is none of these.
    pub fn other_than(self, keeps: Coolant) -> Option<Coolant> {
        self.may.without(keeps).each().next()
    }
}

impl Said {
    /// Does the job want other kinds beside the first than are on?
    pub(super) fn lacks_beside(&self, want: &Want) -> bool {
        let others = want.coolant.without(want.coolant.first());
        self.beside.other_than(others).is_some() || others.without(self.beside.sure) != Coolant::OFF
    }

    /// Takes a code that switches a kind beside the first. `false`: it says nothing of those alone.
    pub(super) fn beside_code(&mut self, code: f64, want: &Want, shape: &Shape) -> bool {
        let settings = &shape.program.settings;
        if self.beside.may == Coolant::OFF && want.coolant == want.coolant.first() {
            return false; // one kind, or none
        }
        let begins = |kind: &Coolant| codes(*kind, settings).is_some_and(|codes| codes.on == code);
        let ends = |kind: &Coolant| codes(*kind, settings).is_some_and(|codes| codes.own_off == Some(code));
        if let Some(kind) = want.coolant.others().find(begins) {
            self.beside.begin(kind);
            return true;
        }
        if let Some(kind) = self.beside.may.each().find(ends).filter(|_| !ends(&want.coolant.first())) {
            self.beside.end(kind);
            return true;
        }
        if code == settings.coolant[1] {
            self.beside = Beside::OFF;
        }
        false
    }
}
