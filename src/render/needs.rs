//! What the form's control does not have: an error of the job, where the program would need it.

use super::fault::{Done, fault};
use super::shape::Shape;
use crate::control::Meaning;
use crate::diag::Code;

/// Codes that a control may lack: what a job needs them for, and what to do without.
const NEEDED: [(Meaning, &str, &str); 5] = [
    (
        Meaning::SideLeft,
        "cutter compensation",
        "write the path of the tool's centre into the job, and no infeed or outfeed",
    ),
    (
        Meaning::Orient,
        "a stop of the spindle at an angle",
        "leave `orient` and `offset` out: the tool comes out along the wall",
    ),
    (Meaning::PerRev, "a feed per revolution", "say the feed per minute: the feed per revolution times the speed"),
    (Meaning::InverseTime, "an inverse time feed", "say the feed per minute"),
    (Meaning::SurfaceSpeed, "a constant surface speed", "say the speed in revolutions per minute"),
];

impl Shape<'_> {
    /// The job needs a code of this meaning.
    ///
    /// # Errors
    /// The control has none.
    pub fn needs(&self, meaning: Meaning) -> Done {
        let control = self.program.settings.control();
        let needed = NEEDED.iter().find(|(needed, ..)| *needed == meaning);
        match needed.filter(|_| control.is_run() && !control.has(meaning)) {
            None => Ok(()),
            Some((_, what, help)) => fault(Code::PR008, format!("{} has no code for {what}", control.title()), *help),
        }
    }

    /// The job moves the axis of this letter.
    ///
    /// # Errors
    /// The control has no such axis.
    pub fn needs_axis(&self, letter: u8) -> Done {
        let control = self.program.settings.control();
        if control.reads(letter) {
            return Ok(());
        }
        let message = format!("{} has no axis {}", control.title(), char::from(letter));
        fault(Code::PR008, message, "take a form of a control that has it, or leave the axis out of the job")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_meaning_that_is_asked_for_is_one_that_some_control_has() {
        for (meaning, ..) in NEEDED {
            assert!(crate::control::Control::usual().has(meaning), "{}", meaning.name());
        }
    }
}
