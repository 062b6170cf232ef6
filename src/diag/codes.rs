//! The table of all codes. A code never changes its meaning; a retired one is not used again.

use super::Severity::{self, Error, Note, Warning};

/// One row: what a finding is called.
#[derive(Debug)]
pub struct CodeRow {
    /// Which code.
    pub code: Code,
    /// As printed, `PF101`.
    pub name: &'static str,
    /// Its severity.
    pub severity: Severity,
    /// What it finds, in a few words.
    pub title: &'static str,
}

macro_rules! codes {
    ($($name:ident $severity:ident $title:literal)*) => {
        /// A code of a finding: `PF` form, `PJ` job, `PR` rendering.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u8)]
        pub enum Code { $(#[doc = $title] $name),* }

        /// All codes in order.
        pub const CODES: &[CodeRow] =
            &[$(CodeRow { code: Code::$name, name: stringify!($name), severity: $severity, title: $title }),*];
    };
}

codes! {
    // PF0: structure
    PF001 Error "a line or word that can't be read"
    PF002 Error "a sequence without End"
    PF003 Warning "a command or letter format after the first sequence, or out of order"
    PF004 Error "a sequence that is there twice"
    PF005 Error "a standard sequence is missing"
    PF006 Error "a command or letter format that is there twice"
    PF007 Error "End outside a sequence"
    PF008 Warning "the file is not UTF-8"
    PF009 Error "a called form that can't be included"
    // PF1: blanks and comments
    PF101 Warning "words lost after a double blank or a tab"
    PF102 Warning "a missing blank between two words"
    // PF2: names
    PF201 Error "an unknown command or sequence"
    PF202 Error "an unknown variable"
    PF203 Note "a command without effect"
    // PF3: numbers and letter formats
    PF301 Error "a bad letter format"
    PF302 Error "a bad command argument"
    PF303 Note "a letter without a format"
    // PF4: sequences and cycles
    PF401 Error "a cycle count larger than the body"
    PF402 Error "End Cancel without a Cancel sequence"
    PF403 Warning "End Cancel on an emulated cycle"
    PF404 Warning "a machine cycle code in a cycle of several lines without a count"
    PF405 Error "a count or Cancel on a sequence that is no canned cycle"
    PF406 Warning "a canned cycle that does not print the position"
    // PF6: limits and machine type
    PF601 Error "too many words on a line"
    PF602 Error "too many sequence lines"
    PF603 Error "a sequence that this type of machine does not have"
    PF604 Error "a variable that this type of machine does not have"
    // PJ: the job
    PJ001 Error "the job is not well-formed"
    PJ002 Error "an unknown key"
    PJ003 Error "a value of the wrong type or out of range"
    PJ004 Error "a key is missing"
    PJ005 Error "keys in an order or combination that can't be used"
    PJ006 Error "a tool that the job does not have"
    PJ007 Error "the job is cut short"
    PJ008 Error "something after the end of the job"
    PJ009 Error "the job has no operations"
    PJ010 Error "a number there twice"
    // PR: rendering
    PR001 Error "a variable without a value"
    PR002 Error "a value that does not fit its letter's format"
    PR003 Error "a negative value for a letter without a sign"
    PR004 Error "a number that is not finite"
    PR005 Error "an arc that can't be an arc"
    PR006 Error "a canned cycle that can't be made"
    PR007 Error "beyond a travel limit"
    PR008 Error "an event that this machine or form can't do"
    PR009 Error "a rigid tap without a sequence"
    PR010 Error "units of job and form differ"
    PR011 Error "a move without a feed"
    PR012 Error "a path that begins with a cut"
    PR013 Warning "the return plane is not reached"
    PR014 Note "a cycle printed as single moves"
    PR015 Error "a prompted variable without an answer"
    PR016 Error "a setting that can't be used"
    PR017 Error "a change that the form can't print"
    PR019 Warning "a peck cycle without a step"
    PR020 Warning "a return plane below the clearance"
}

impl Code {
    /// Its row of the table.
    pub fn row(self) -> &'static CodeRow {
        &CODES[self as usize]
    }

    /// As printed, `PF101`.
    pub fn name(self) -> &'static str {
        self.row().name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_finds_its_own_row() {
        for (i, row) in CODES.iter().enumerate() {
            assert_eq!(row.code as usize, i);
            assert_eq!(row.code.row().name, row.name);
        }
    }
}
