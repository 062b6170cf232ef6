//! Kinds of coolant, by their names.

/// Coolant: one kind, several kinds at the same time, or none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Coolant {
    /// The kinds that are on, as bits.
    kinds: u8,
    /// The bit of the first kind of coolant. `[cool]` prints the code of this first kind.
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
    /// Coolant under high pressure.
    pub const HIGH: Coolant = Coolant::of(16);

    /// The kinds that `CoolantKind` defines.
    pub const FURTHER: [Coolant; 4] = [Coolant::THROUGH, Coolant::AIR, Coolant::MIST, Coolant::HIGH];

    /// All names of coolant in jobs and forms, with their kinds.
    pub const NAMES: [(&'static str, Coolant); 7] = [
        ("flood", Coolant::FLOOD),
        ("on", Coolant::FLOOD),
        ("mist", Coolant::MIST),
        ("off", Coolant::OFF),
        ("through", Coolant::THROUGH),
        ("air", Coolant::AIR),
        ("high", Coolant::HIGH),
    ];

    const fn of(kind: u8) -> Coolant {
        Coolant { kinds: kind, first: kind }
    }

    /// Finds a kind by its name; upper and lower case are equal.
    pub fn parse(name: &str) -> Option<Coolant> {
        Coolant::NAMES.iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, kind)| *kind)
    }

    /// Name of the first kind, as in forms and messages.
    pub fn name(self) -> &'static str {
        Coolant::NAMES.iter().find(|(_, kind)| *kind == self.first()).map_or("off", |(name, _)| *name)
    }

    /// The first kind.
    #[must_use]
    pub fn first(self) -> Coolant {
        Coolant::of(self.first)
    }

    /// The kinds, one by one.
    pub fn each(self) -> impl Iterator<Item = Coolant> {
        (0..8).map(|bit| 1 << bit).filter(move |&kind| self.kinds & kind != 0).map(Coolant::of)
    }

    /// The kinds other than the first, one by one.
    pub fn others(self) -> impl Iterator<Item = Coolant> {
        self.each().filter(move |kind| kind.first != self.first)
    }

    /// The kinds of this coolant together with the kinds of `other`.
    #[must_use]
    pub fn and(self, other: Coolant) -> Coolant {
        let first = if self.first == 0 { other.first } else { self.first };
        Coolant { kinds: self.kinds | other.kinds, first }
    }

    /// This coolant without the kinds of `other`.
    #[must_use]
    pub fn without(self, other: Coolant) -> Coolant {
        let kinds = self.kinds & !other.kinds;
        let lowest = kinds & kinds.wrapping_neg();
        Coolant { kinds, first: if self.first & kinds == 0 { lowest } else { self.first } }
    }

    /// This coolant after a code that turns on this kind, or all kinds off. Flood and mist replace each other.
    #[must_use]
    pub fn then(self, kind: Coolant) -> Coolant {
        match kind {
            Coolant::OFF => Coolant::OFF,
            Coolant::FLOOD | Coolant::MIST => self.without(Coolant::FLOOD.and(Coolant::MIST)).and(kind),
            _ => self.and(kind),
        }
    }

    /// Whether the same kinds are on, in any order.
    pub fn is_same(self, other: Coolant) -> bool {
        self.kinds == other.kinds
    }

    /// Whether this kind is on. If the kind is `OFF`: whether no kind of coolant is on.
    pub fn holds(self, kind: Coolant) -> bool {
        if kind == Coolant::OFF { self == Coolant::OFF } else { self.kinds & kind.kinds == kind.kinds }
    }
}
