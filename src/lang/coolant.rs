//! Kinds of coolant, by their names.

/// Coolant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coolant {
    /// Flood: M8.
    On,
    /// Mist: M7.
    Mist,
    /// No coolant: M9.
    Off,
    /// Through the spindle.
    Through,
    /// Air.
    Air,
    /// Under high pressure.
    High,
}

impl Coolant {
    /// All kinds by the names that jobs and forms give them.
    pub const NAMES: [(&'static str, Coolant); 7] = [
        ("on", Coolant::On),
        ("flood", Coolant::On),
        ("mist", Coolant::Mist),
        ("off", Coolant::Off),
        ("through", Coolant::Through),
        ("air", Coolant::Air),
        ("high", Coolant::High),
    ];

    /// Finds a name in any case.
    pub fn parse(name: &str) -> Option<Coolant> {
        Coolant::NAMES.iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, kind)| *kind)
    }

    /// As forms and messages write it.
    pub fn name(self) -> &'static str {
        Coolant::NAMES.iter().find(|(_, kind)| *kind == self).map_or("on", |(name, _)| *name)
    }
}
