//! A code in a command of a form.

use crate::control;

/// A code in a command: if its letter was typed, it prints as typed, otherwise in its letter's format.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Code {
    /// The letter, typed or implied, and the number.
    pub code: control::Code,
    /// The code as typed, `G00`.
    pub text: Option<String>,
}

impl Code {
    /// A code that is not typed in the form.
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
