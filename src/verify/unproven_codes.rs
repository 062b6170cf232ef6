//! Codes after which a program is not proven, because its control is not known well enough.

use crate::control::{Control, Rules};
use crate::diag::{Code, Diag};

/// Whether the fault is a limit of postform and not a refusal of the control. Then the control's file does not have the
/// code, or the code is not run.
///
/// For LinuxCNC and similar controls all codes are known, so they refuse all others themselves.
pub(super) fn is_unknown(code: Code, control: &Control) -> bool {
    match code {
        Code::PN003 => control.rules() == Rules::Fanuc,
        Code::PN016 => true,
        _ => false,
    }
}

/// `fanuc has no G201 that we know`, or the reason why a code is not run.
pub(super) fn unknown_code(diag: &Diag, control: &Control) -> String {
    let name = control.name();
    let code = diag.message.split(|c: char| !c.is_ascii_alphanumeric() && c != '.');
    let is_code = |word: &&str| word.len() > 1 && word[1..].starts_with(|c: char| c.is_ascii_digit());
    match code.into_iter().find(is_code).filter(|_| diag.code == Code::PN003) {
        Some(code) => format!("{code} is unknown for {name}"),
        None => diag.message.clone(),
    }
}
