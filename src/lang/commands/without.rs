//! What holds without a command.

use crate::lang::{Machine, UnitChoice};

/// What holds without a command: its arguments as a form would give them.
#[derive(Clone, Copy, Debug)]
pub struct Without {
    usual: &'static str,
    lathe: Option<&'static str>,
    inch: Option<&'static str>,
    mm: Option<&'static str>,
    told: &'static str,
}

/// In every form these arguments.
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

    /// By the form's units, and for a form of both by the job's.
    pub(super) const fn by_units(self, inch: &'static str, mm: &'static str) -> Without {
        Without { inch: Some(inch), mm: Some(mm), ..self }
    }

    /// What other things say it, for readers.
    pub(super) const fn told(self, told: &'static str) -> Without {
        Without { told, ..self }
    }

    /// The arguments for a form of this machine and these units; empty where there are none. A comma stands between those of
    /// a command that is given several times.
    pub fn arguments(self, machine: Machine, units: UnitChoice) -> &'static str {
        let by_units = match units {
            UnitChoice::Inch => self.inch,
            UnitChoice::Mm => self.mm,
            UnitChoice::Both => None,
        };
        self.lathe.filter(|_| machine == Machine::Lathe).or(by_units).unwrap_or(self.usual)
    }

    /// Nothing holds: there is no default to tell.
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
