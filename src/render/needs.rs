//! Checks that the form's control has what the job needs. If the control lacks a code or an axis, the job is an error.

use super::fault::{Done, fault};
use super::shape::Shape;
use crate::compile::Op;
use crate::control::Meaning;
use crate::diag::Code;

/// Codes that a control may lack. Each code has its purpose in a job, and advice for controls without the code.
const NEEDED: [(Meaning, &str, &str); 5] = [
    (
        Meaning::SideLeft,
        "cutter compensation",
        "write the path of the tool's centre into the job, without infeed or outfeed",
    ),
    (
        Meaning::Orient,
        "a stop of the spindle at an angle",
        "leave `orient` and `offset` out: then the tool retracts along the wall",
    ),
    (Meaning::PerRev, "a feed per revolution", "give the feed per minute: the feed per revolution times the speed"),
    (Meaning::InverseTime, "an inverse time feed", "give the feed per minute"),
    (Meaning::SurfaceSpeed, "a constant surface speed", "give the speed in revolutions per minute"),
];

impl Shape<'_> {
    /// Checks a code of this meaning that the job needs.
    ///
    /// # Errors
    /// The control has no such code.
    pub fn needs(&self, meaning: Meaning) -> Done {
        let control = self.program.settings.control();
        let needed = NEEDED.iter().find(|(needed, ..)| *needed == meaning);
        match needed.filter(|_| control.is_run() && !control.has(meaning)) {
            None => Ok(()),
            Some((_, what, help)) => fault(Code::PR008, format!("{} has no code for {what}", control.title()), *help),
        }
    }

    /// Checks the rotary axis of this letter that the job moves.
    ///
    /// # Errors
    /// The control or the form has no such axis.
    pub fn needs_axis(&self, letter: u8) -> Done {
        let control = self.program.settings.control();
        let name = char::from(letter);
        if !control.reads(letter) {
            let message = format!("{} has no axis {name}", control.title());
            return fault(
                Code::PR008,
                message,
                "use a form for a control with this axis, or leave the axis out of the job",
            );
        }
        if self.lacks_axis(letter) {
            let help = format!(
                "if the machine has this axis, give it a format at the top of the form: `{name}->4.>4`; otherwise use a \
                 form for a machine with this axis, or leave the axis out of the job"
            );
            return fault(Code::PR008, format!("the form has no axis {name}"), help);
        }
        Ok(())
    }

    /// Whether the form defines its axes by their formats, but does not mention this one. A form without formats for
    /// its axes uses the built-in formats for all of them.
    fn lacks_axis(&self, letter: u8) -> bool {
        let settings = &self.program.settings;
        let has_formats = self.axes[..self.linear].iter().any(|&axis| self.letters[axis].has_format);
        let is_printed = |op: &Op| match *op {
            Op::Var { letter: own, .. } | Op::Formula { letter: own, .. } => own == letter,
            Op::Literal { index, .. } => self.program.literals[index as usize].letter == letter,
            _ => false,
        };
        has_formats
            && !self.letters[letter].has_format
            && !settings.limits.iter().any(|limit| limit.letter == letter)
            && !settings.rename.iter().any(|&(from, _)| from == letter)
            && !self.program.ops.iter().any(is_printed)
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
