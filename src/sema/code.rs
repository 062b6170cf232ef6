//! A G or M code in a command of a form.

use crate::control;

/// A code in a command. A code written with its letter is printed as written. A code written without its letter is
/// printed in the format of the letter.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Code {
    /// The letter (written or implied) and the number.
    pub code: control::Code,
    /// The code as written, such as `G00`; `None` if it was written without its letter.
    pub text: Option<String>,
}

impl Code {
    /// A code that is not written with its letter in the form.
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
