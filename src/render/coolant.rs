//! The codes of each kind of coolant, as the form defines them.

use super::fault::{Done, fault};
use crate::diag::Code;
use crate::lang::Coolant;
use crate::sema::Settings;

/// The codes of one kind: its "on" code and, if the form has one, the code that turns off only this kind.
#[derive(Clone, Copy, Debug)]
pub struct Codes {
    /// Code that turns the kind on.
    pub on: f64,
    /// Code that turns off only this kind.
    pub own_off: Option<f64>,
}

/// The codes of one kind; `None` if the form has no codes for the kind.
pub fn codes(kind: Coolant, settings: &Settings) -> Option<Codes> {
    let [on, _, mist] = settings.coolant;
    match (settings.coolant_kinds.iter().find(|own| own.kind == kind), kind) {
        (Some(own), _) => Some(Codes { on: own.on, own_off: own.off }),
        (None, Coolant::FLOOD) => Some(Codes { on, own_off: None }),
        (None, Coolant::MIST) => Some(Codes { on: mist, own_off: None }),
        _ => None,
    }
}

/// The codes of one kind.
///
/// # Errors
/// PR054 if the form has no codes for the kind.
pub fn codes_of(kind: Coolant, settings: &Settings) -> Done<Codes> {
    match codes(kind, settings) {
        Some(codes) => Ok(codes),
        None => fault(
            Code::PR054,
            format!("the form has no coolant `{}`", kind.name()),
            format!(
                "add `CoolantKind {} M88 M89` with the machine's codes, and print `M[coolantoff]`, the off code of the active \
                 kind, instead of M9 (postforms/haas.pf has two kinds), or use flood coolant",
                kind.name()
            ),
        ),
    }
}
