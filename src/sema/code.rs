//! A code as a command of a form gives it.

use crate::control;

/// A code of a command: printed as typed when its letter was typed, else by the letter's format.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Code {
    /// The letter, given or implied, and the number.
    pub code: control::Code,
    /// The code as typed, `G00`.
    pub text: Option<String>,
}

impl Code {
    /// A code that nobody typed.
    pub fn plain(code: control::Code) -> Code {
        Code { code, text: None }
    }

    /// The letter of the code.
    pub fn letter(&self) -> u8 {
        self.code.letter
    }

    /// The number after the letter.
    pub fn value(&self) -> f64 {
        self.code.value()
    }
}
