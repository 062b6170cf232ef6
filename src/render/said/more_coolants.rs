//! Additional kinds of coolant that are on, besides the first kind.

use super::state::Said;
use crate::lang::Coolant;
use crate::render::coolant::codes;
use crate::render::shape::Shape;
use crate::render::want::Want;

/// Additional kinds of coolant, as known from the printed program.
#[derive(Clone, Copy, Debug)]
pub struct Beside {
    /// Kinds of coolant that may be on: they were turned on and possibly not turned off later.
    may: Coolant,
    /// Kinds of coolant that are certainly on: they were turned on and certainly not turned off later.
    sure: Coolant,
}

impl Beside {
    /// None.
    pub const OFF: Beside = Beside { may: Coolant::OFF, sure: Coolant::OFF };

    /// Records that a kind of coolant is on.
    pub fn begin(&mut self, kind: Coolant) {
        *self = Beside { may: self.may.and(kind), sure: self.sure.and(kind) };
    }

    /// Records that a kind of coolant is off, or has become the first kind.
    pub fn end(&mut self, kind: Coolant) {
        *self = Beside { may: self.may.without(kind), sure: self.sure.without(kind) };
    }

    /// Records a stop or subprogram, after which all kinds of coolant may be off.
    pub fn doubt(&mut self) {
        self.sure = Coolant::OFF;
    }

    /// Whether a kind of coolant is certainly on.
    pub fn holds(self, kind: Coolant) -> bool {
        self.sure.holds(kind)
    }

    /// A kind of coolant that may be on and is not in `keeps`.
    pub fn other_than(self, keeps: Coolant) -> Option<Coolant> {
        self.may.without(keeps).each().next()
    }
}

impl Said {
    /// Whether the additional kinds of coolant that the job requests differ from the additional kinds that are on.
    pub(super) fn lacks_beside(&self, want: &Want) -> bool {
        let others = want.coolant.without(want.coolant.first());
        self.beside.other_than(others).is_some() || others.without(self.beside.sure) != Coolant::OFF
    }

    /// Records a code that switches an additional kind of coolant. Returns `false` if the code is not for additional
    /// kinds only.
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
