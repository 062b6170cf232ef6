//! Why a program is not proven from a block on: its control is not known well enough.

use crate::control::{Control, Rules};
use crate::diag::{Code, Diag};

/// Is this a reason of ours, and none of the control's: a code that its file does not have, or that is not run?
///
/// Of LinuxCNC and what is like it all codes are known: it refuses others itself.
pub(super) fn is_unknown(code: Code, control: &Control) -> bool {
    match code {
        Code::PN003 => control.rules() == Rules::Fanuc,
        Code::PN016 => true,
        _ => false,
    }
}

/// `fanuc has no G201 that we know`, or why a code is not run.
pub(super) fn unknown_code(diag: &Diag, control: &Control) -> String {
    let name = control.name();
    let code = diag.message.split(|c: char| !c.is_ascii_alphanumeric() && c != '.');
    let is_code = |word: &&str| word.len() > 1 && word[1..].starts_with(|c: char| c.is_ascii_digit());
    match code.into_iter().find(is_code).filter(|_| diag.code == Code::PN003) {
        Some(code) => format!("{name} has no {code} that we know"),
        None => diag.message.clone(),
    }
}
