//! Defaults of commands: the default applies if a form does not have the command.

use crate::lang::{Machine, UnitChoice};

/// The default of a command, written as the arguments that the form would have.
#[derive(Clone, Copy, Debug)]
pub struct Without {
    usual: &'static str,
    lathe: Option<&'static str>,
    inch: Option<&'static str>,
    mm: Option<&'static str>,
    told: &'static str,
}

/// A default with these arguments. The other methods add different arguments for lathes or for one unit.
pub(super) const fn of(usual: &'static str) -> Without {
    Without { usual, lathe: None, inch: None, mm: None, told: "" }
}

impl Without {
    pub(super) const fn lathe(self, lathe: &'static str) -> Without {
        Without { lathe: Some(lathe), ..self }
    }

    pub(super) const fn mm(self, mm: &'static str) -> Without {
        Without { mm: Some(mm), ..self }
    }

    /// Sets the defaults for each unit of the form. For a form with both units, the default for the units of the job
    /// applies.
    pub(super) const fn by_units(self, inch: &'static str, mm: &'static str) -> Without {
        Without { inch: Some(inch), mm: Some(mm), ..self }
    }

    /// Adds a description of a default that can't be written as arguments.
    pub(super) const fn told(self, told: &'static str) -> Without {
        Without { told, ..self }
    }

    /// The default arguments for a form with this machine and these units; empty if the command has no default. The
    /// default may be several lines with the command. Commas then separate the arguments of these lines.
    pub fn arguments(self, machine: Machine, units: UnitChoice) -> &'static str {
        let by_units = match units {
            UnitChoice::Inch => self.inch,
            UnitChoice::Mm => self.mm,
            UnitChoice::Both => None,
        };
        self.lathe.filter(|_| machine == Machine::Lathe).or(by_units).unwrap_or(self.usual)
    }

    /// Whether the command has no default.
    pub fn is_nothing(self) -> bool {
        self.to_string().is_empty()
    }
}

impl std::fmt::Display for Without {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let columns = [("", Some(self.usual)), ("lathe ", self.lathe), ("inch ", self.inch), ("mm ", self.mm)];
        let said =
            columns.into_iter().filter_map(|(column, text)| Some((column, text.filter(|text| !text.is_empty())?)));
        let all: Vec<String> = said
            .chain([("", self.told)].into_iter().filter(|(_, told)| !told.is_empty()))
            .map(|(column, text)| format!("{column}{text}"))
            .collect();
        f.write_str(&all.join("; "))
    }
}
