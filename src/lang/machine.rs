//! Types of machine.

/// The type of machine for which a form or job is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Machine {
    /// Mill, drill, router.
    #[default]
    Mill,
    /// Lathe.
    Lathe,
    /// Wire EDM.
    Edm,
}

impl Machine {
    /// Name in messages and forms.
    pub fn name(self) -> &'static str {
        match self {
            Machine::Mill => "mill",
            Machine::Lathe => "lathe",
            Machine::Edm => "EDM",
        }
    }

    /// Finds a machine by its name; upper and lower case are equal. A machine with a torch or a laser has the machine
    /// type mill.
    pub fn parse(name: &str) -> Option<Machine> {
        let own =
            [Machine::Mill, Machine::Lathe, Machine::Edm].into_iter().find(|m| m.name().eq_ignore_ascii_case(name));
        own.or(Beam::parse(name).map(|_| Machine::Mill))
    }
}

/// Tools that the program switches on and off instead of moving the tools up and down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beam {
    /// A torch for plasma or flame cutting.
    Torch,
    /// A laser.
    Laser,
}

impl Beam {
    /// Name in messages and forms.
    pub fn name(self) -> &'static str {
        match self {
            Beam::Torch => "torch",
            Beam::Laser => "laser",
        }
    }

    /// Finds a torch or laser by its name; upper and lower case are equal.
    pub fn parse(name: &str) -> Option<Beam> {
        [Beam::Torch, Beam::Laser].into_iter().find(|beam| beam.name().eq_ignore_ascii_case(name))
    }
}

/// Units of the lengths in a form.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum UnitChoice {
    /// Inches.
    #[default]
    Inch,
    /// Millimetres.
    Mm,
    /// The form accepts jobs in both units. Lengths in the form itself are in inches.
    Both,
}

impl UnitChoice {
    /// Finds units by their name; upper and lower case are equal.
    pub fn parse(name: &str) -> Option<UnitChoice> {
        let names = [("inch", UnitChoice::Inch), ("mm", UnitChoice::Mm), ("both", UnitChoice::Both)];
        names.into_iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, units)| units)
    }
}

/// A set of machine types. The manual gives a set of machine types for each sequence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Machines {
    /// Whether mills are in the set.
    pub mill: bool,
    /// Whether lathes are in the set.
    pub lathe: bool,
    /// Whether wire EDM machines are in the set.
    pub edm: bool,
}

impl Machines {
    /// The set for the letters M (mill), L (lathe) and E (wire EDM).
    pub const fn of(letters: &str) -> Machines {
        let bytes = letters.as_bytes();
        let mut set = Machines { mill: false, lathe: false, edm: false };
        let mut i = 0;
        while i < bytes.len() {
            match bytes[i] {
                b'M' => set.mill = true,
                b'L' => set.lathe = true,
                _ => set.edm = true,
            }
            i += 1;
        }
        set
    }

    /// Whether this machine is in the set.
    pub fn has(self, machine: Machine) -> bool {
        match machine {
            Machine::Mill => self.mill,
            Machine::Lathe => self.lathe,
            Machine::Edm => self.edm,
        }
    }
}

impl std::fmt::Display for Machines {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let names: Vec<_> = [Machine::Mill, Machine::Lathe, Machine::Edm]
            .into_iter()
            .filter(|&m| self.has(m))
            .map(Machine::name)
            .collect();
        f.write_str(&names.join(", "))
    }
}
