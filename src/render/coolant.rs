//! The codes of each kind of coolant, as the form says them.

use super::fault::{Done, fault};
use crate::diag::Code;
use crate::lang::Coolant;
use crate::sema::Settings;

/// The codes of one kind: what turns it on, and what ends it alone where the form says that.
#[derive(Clone, Copy, Debug)]
pub struct Codes {
    /// Turns it on.
    pub on: f64,
    /// Ends it, and nothing else.
    pub own_off: Option<f64>,
}

/// The codes of one kind; `None`: the form has none.
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
/// The form has none: PR054.
pub fn codes_of(kind: Coolant, settings: &Settings) -> Done<Codes> {
    match codes(kind, settings) {
        Some(codes) => Ok(codes),
        None => fault(
            Code::PR054,
            format!("the form has no coolant `{}`", kind.name()),
            format!(
                "add `CoolantKind {} M88 M89` with the machine's codes (postforms/haas.pf has two kinds), or take flood \
                 coolant",
                kind.name()
            ),
        ),
    }
}
