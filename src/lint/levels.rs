//! Severities of findings, as a shop sets them.

use crate::diag::{CODES, Code, Diag, Severity};

/// The level that a shop sets for a code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// Findings of the code are not shown.
    Off,
    /// Findings of the code have this severity.
    As(Severity),
}

impl Level {
    /// Parses `off`, `note`, `warning` or `error`.
    pub fn parse(name: &str) -> Option<Level> {
        Some(match name {
            "off" => Level::Off,
            "note" => Level::As(Severity::Note),
            "warning" => Level::As(Severity::Warning),
            "error" => Level::As(Severity::Error),
            _ => return None,
        })
    }
}

/// The levels that a shop sets differently from the table of codes. If a code has several levels, the last one applies.
#[derive(Clone, Debug, Default)]
pub struct Levels(Vec<(Code, Level)>);

impl Levels {
    /// Sets the level of a code such as `PF303`, or of all codes of a family such as `PF3`.
    ///
    /// # Errors
    /// The code is unknown, or it is an error of the form and therefore always prevents printing. The error text is the
    /// rest of a sentence that begins with the name of the code.
    pub fn set(&mut self, name: &str, level: Level) -> Result<(), &'static str> {
        let upper = name.to_ascii_uppercase();
        let is_code = |row: &&crate::diag::CodeRow| row.name.starts_with("PF") && upper.len() > 2;
        if let Some(row) = CODES.iter().filter(is_code).find(|row| row.name == upper) {
            if row.severity == Severity::Error {
                return Err("is an error, and the level of an error can't be changed: fix the form");
            }
            self.0.push((row.code, level));
            return Ok(());
        }
        let family = CODES.iter().filter(is_code).filter(|row| upper.len() == 3 && row.name.starts_with(&upper));
        let codes: Vec<Code> = family.filter(|row| row.severity != Severity::Error).map(|row| row.code).collect();
        if codes.is_empty() {
            return Err(
                "is neither the code of a finding in forms (such as PF303) nor a family of codes (such as PF3)",
            );
        }
        self.0.extend(codes.into_iter().map(|code| (code, level)));
        Ok(())
    }

    /// Adds levels, which override the present levels of the same codes.
    pub fn extend(&mut self, levels: Levels) {
        self.0.extend(levels.0);
    }

    /// Whether findings of this code are shown.
    pub(super) fn shows(&self, code: Code) -> bool {
        self.level(code) != Some(Level::Off)
    }

    fn level(&self, code: Code) -> Option<Level> {
        self.0.iter().rev().find(|(c, _)| *c == code).map(|(_, level)| *level)
    }

    /// Applies the level of its code to a finding. Returns `false` if the level is off.
    pub(super) fn apply(&self, diag: &mut Diag) -> bool {
        match self.level(diag.code) {
            Some(Level::Off) => false,
            Some(Level::As(severity)) => {
                diag.severity = severity;
                true
            }
            None => true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_and_families_are_set_and_the_later_wins() {
        let mut levels = Levels::default();
        levels.set("pf3", Level::Off).unwrap();
        levels.set("PF303", Level::As(Severity::Error)).unwrap();
        assert!(!levels.shows(Code::PF306) && levels.shows(Code::PF303));
        let mut diag = Diag::new(Code::PF303, "");
        assert!(levels.apply(&mut diag) && diag.is_error());
        assert!(levels.set("PF001", Level::Off).unwrap_err().contains("error"));
        for name in ["PF", "P", "", "PF9", "PR001", "PF3x"] {
            assert!(levels.set(name, Level::Off).is_err(), "{name}");
        }
    }
}
