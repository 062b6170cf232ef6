//! Defaults: the effect of leaving out a command.

use crate::lang::{Machine, UnitChoice};

/// The default of a command, as the arguments that a form would have.
#[derive(Clone, Copy, Debug)]
pub struct Without {
    usual: &'static str,
    lathe: Option<&'static str>,
    inch: Option<&'static str>,
    mm: Option<&'static str>,
    told: &'static str,
}

/// These arguments for every form.
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

    /// By the units of the form; for a form with both units, by those of the job.
    pub(super) const fn by_units(self, inch: &'static str, mm: &'static str) -> Without {
        Without { inch: Some(inch), mm: Some(mm), ..self }
    }

    /// A description of a default that arguments can't express.
    pub(super) const fn told(self, told: &'static str) -> Without {
        Without { told, ..self }
    }

    /// The arguments for a form of this machine and these units; empty if there are none. For a command that occurs
    /// several times, a comma separates its arguments.
    pub fn arguments(self, machine: Machine, units: UnitChoice) -> &'static str {
        let by_units = match units {
            UnitChoice::Inch => self.inch,
            UnitChoice::Mm => self.mm,
            UnitChoice::Both => None,
        };
        self.lathe.filter(|_| machine == Machine::Lathe).or(by_units).unwrap_or(self.usual)
    }

    /// Whether there is no default.
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
