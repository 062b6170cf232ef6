//! Codes after which a program is not proven, because postform does not know what the control does at these codes.

use crate::control::{Control, Rules};
use crate::diag::{Code, Diag};

/// Whether a fault is a limit of postform and not a refusal of the control. It is a limit of postform if the control's
/// file does not contain the code, or if postform does not run the code.
///
/// For LinuxCNC and similar controls all codes are known. If a control file of this kind does not contain a code, the
/// control refuses the code.
pub(super) fn is_unknown(code: Code, control: &Control) -> bool {
    match code {
        Code::PN003 => control.rules() == Rules::Fanuc,
        Code::PN016 => true,
        _ => false,
    }
}

/// The reason and the help as texts. The reason is, for example, `G201 is unknown for fanuc`, or why postform does not
/// run the code.
pub(super) fn unknown_code(diag: &Diag, control: &Control) -> (String, &'static str) {
    let name = control.name();
    let words = diag.message.split(|c: char| !c.is_ascii_alphanumeric() && c != '.');
    let is_code = |word: &&str| word.len() > 1 && word[1..].starts_with(|c: char| c.is_ascii_digit());
    let code = words.into_iter().find(is_code).filter(|_| diag.code == Code::PN003);
    let why = code.map_or_else(|| diag.message.clone(), |code| format!("{code} is unknown for {name}"));
    if code.and_then(|code| code.parse().ok()).is_some_and(|code| control.lacks(code)) {
        return (format!("{why}: its control file marks the code as absent"), "let the form print another code");
    }
    (why, "describe the code in a control file, or check its effect at the machine")
}
