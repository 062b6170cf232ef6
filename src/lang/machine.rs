//! Types of machine.

/// What a form or a job is for.
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
    /// As messages and forms write it.
    pub fn name(self) -> &'static str {
        match self {
            Machine::Mill => "mill",
            Machine::Lathe => "lathe",
            Machine::Edm => "EDM",
        }
    }

    /// Reads a name in any case; a torch or a laser is a mill with another tool.
    pub fn parse(name: &str) -> Option<Machine> {
        let own =
            [Machine::Mill, Machine::Lathe, Machine::Edm].into_iter().find(|m| m.name().eq_ignore_ascii_case(name));
        own.or(Beam::parse(name).map(|_| Machine::Mill))
    }
}

/// What a machine cuts with that is switched on and off, and does not go up and down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beam {
    /// A torch: plasma, flame.
    Torch,
    /// A laser.
    Laser,
}

impl Beam {
    /// As messages and forms write it.
    pub fn name(self) -> &'static str {
        match self {
            Beam::Torch => "torch",
            Beam::Laser => "laser",
        }
    }

    /// Reads a name in any case.
    pub fn parse(name: &str) -> Option<Beam> {
        [Beam::Torch, Beam::Laser].into_iter().find(|beam| beam.name().eq_ignore_ascii_case(name))
    }
}

/// Which lengths a form is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum UnitChoice {
    /// Inches.
    #[default]
    Inch,
    /// Millimetres.
    Mm,
    /// Serves both; its own lengths are inches.
    Both,
}

impl UnitChoice {
    /// Reads a name in any case.
    pub fn parse(name: &str) -> Option<UnitChoice> {
        let names = [("inch", UnitChoice::Inch), ("mm", UnitChoice::Mm), ("both", UnitChoice::Both)];
        names.into_iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, units)| units)
    }
}

/// A set of machine types, as the manual gives one for each sequence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Machines {
    /// Has mills.
    pub mill: bool,
    /// Has lathes.
    pub lathe: bool,
    /// Has wire EDM machines.
    pub edm: bool,
}

impl Machines {
    /// The set named by the letters M, L and E.
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

    /// Is this machine in the set?
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
