//! Codes after which a program is not proven, because postform does not know what the control does with them.

use crate::control::{Control, Rules};
use crate::diag::{Code, Diag};

/// Whether a fault is a limit of postform and not a refusal of the control. This is so if the control's file does not
/// contain the code, or if postform does not run the code.
///
/// For LinuxCNC and similar controls all codes are known. A code that is missing in their files is therefore a refusal.
pub(super) fn is_unknown(code: Code, control: &Control) -> bool {
    match code {
        Code::PN003 => control.rules() == Rules::Fanuc,
        Code::PN016 => true,
        _ => false,
    }
}

/// The reason as text: `G201 is unknown for fanuc`, or why postform does not run the code.
pub(super) fn unknown_code(diag: &Diag, control: &Control) -> String {
    let name = control.name();
    let code = diag.message.split(|c: char| !c.is_ascii_alphanumeric() && c != '.');
    let is_code = |word: &&str| word.len() > 1 && word[1..].starts_with(|c: char| c.is_ascii_digit());
    match code.into_iter().find(is_code).filter(|_| diag.code == Code::PN003) {
        Some(code) => format!("{code} is unknown for {name}"),
        None => diag.message.clone(),
    }
}
