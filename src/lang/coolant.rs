//! Kinds of coolant, by their names.

/// Coolant: one kind, several at once, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coolant {
    /// The kinds that are on, a bit each.
    kinds: u8,
    /// The bit of the kind that is named first, which `[cool]` prints.
    first: u8,
}

impl Coolant {
    /// No coolant: M9.
    pub const OFF: Coolant = Coolant { kinds: 0, first: 0 };
    /// Flood: M8.
    pub const FLOOD: Coolant = Coolant::of(1);
    /// Mist: M7.
    pub const MIST: Coolant = Coolant::of(2);
    /// Through the spindle.
    pub const THROUGH: Coolant = Coolant::of(4);
    /// Air.
    pub const AIR: Coolant = Coolant::of(8);
    /// Under high pressure.
    pub const HIGH: Coolant = Coolant::of(16);

    /// All kinds by the names that jobs and forms give them.
    pub const NAMES: [(&'static str, Coolant); 7] = [
        ("on", Coolant::FLOOD),
        ("flood", Coolant::FLOOD),
        ("mist", Coolant::MIST),
        ("off", Coolant::OFF),
        ("through", Coolant::THROUGH),
        ("air", Coolant::AIR),
        ("high", Coolant::HIGH),
    ];

    const fn of(kind: u8) -> Coolant {
        Coolant { kinds: kind, first: kind }
    }

    /// Finds the name of a kind, in any case.
    pub fn parse(name: &str) -> Option<Coolant> {
        Coolant::NAMES.iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, kind)| *kind)
    }

    /// The first kind, as forms and messages write it.
    pub fn name(self) -> &'static str {
        Coolant::NAMES.iter().find(|(_, kind)| *kind == self.first()).map_or("on", |(name, _)| *name)
    }

    /// The kind that is named first.
    #[must_use]
    pub fn first(self) -> Coolant {
        Coolant::of(self.first)
    }

    /// The kinds, each alone.
    pub fn each(self) -> impl Iterator<Item = Coolant> {
        (0..8).map(|bit| 1 << bit).filter(move |&kind| self.kinds & kind != 0).map(Coolant::of)
    }

    /// The kinds beside the first, each alone.
    pub fn others(self) -> impl Iterator<Item = Coolant> {
        self.each().filter(move |kind| kind.first != self.first)
    }

    /// With the kinds of another besides.
    #[must_use]
    pub fn and(self, other: Coolant) -> Coolant {
        let first = if self.first == 0 { other.first } else { self.first };
        Coolant { kinds: self.kinds | other.kinds, first }
    }

    /// Without the kinds of another.
    #[must_use]
    pub fn without(self, other: Coolant) -> Coolant {
        let kinds = self.kinds & !other.kinds;
        let lowest = kinds & kinds.wrapping_neg();
        Coolant { kinds, first: if self.first & kinds == 0 { lowest } else { self.first } }
    }

    /// Is this kind among those that are on? `OFF`: is none on?
    pub fn holds(self, kind: Coolant) -> bool {
        if kind == Coolant::OFF { self == Coolant::OFF } else { self.kinds & kind.kinds == kind.kinds }
    }
}
