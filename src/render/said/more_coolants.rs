//! Further kinds of coolant that are on besides the first.

use super::state::Said;
use crate::lang::Coolant;
use crate::render::coolant::codes;
use crate::render::shape::Shape;
use crate::render::want::Want;

/// Further kinds of coolant, as printed by the program.
#[derive(Clone, Copy, Debug)]
pub struct Beside {
    /// Kinds that may be on: they were turned on, and it is not certain that they were turned off.
    may: Coolant,
    /// Kinds that are certainly on: nothing may have turned them off since.
    sure: Coolant,
}

impl Beside {
    /// None.
    pub const OFF: Beside = Beside { may: Coolant::OFF, sure: Coolant::OFF };

    /// Records that a kind is on.
    pub fn begin(&mut self, kind: Coolant) {
        *self = Beside { may: self.may.and(kind), sure: self.sure.and(kind) };
    }

    /// Records that a kind is off, or is the first kind now.
    pub fn end(&mut self, kind: Coolant) {
        *self = Beside { may: self.may.without(kind), sure: self.sure.without(kind) };
    }

    /// Records a stop or subprogram, after which all kinds may be off.
    pub fn doubt(&mut self) {
        self.sure = Coolant::OFF;
    }

    /// Is a kind on for certain?
    pub fn holds(self, kind: Coolant) -> bool {
        self.sure.holds(kind)
    }

    /// A kind that may be on and is not in `keeps`.
    pub fn other_than(self, keeps: Coolant) -> Option<Coolant> {
        self.may.without(keeps).each().next()
    }
}

impl Said {
    /// Do the further kinds that the job requests differ from those that are on?
    pub(super) fn lacks_beside(&self, want: &Want) -> bool {
        let others = want.coolant.without(want.coolant.first());
        self.beside.other_than(others).is_some() || others.without(self.beside.sure) != Coolant::OFF
    }

    /// Records a code that switches a further kind. Returns `false` if the code is not only for further kinds.
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
