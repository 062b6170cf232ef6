//! The coolant at a cut, in the job and in the program. Both are sets of kinds: one kind may begin while another is on,
//! and may have its own code that turns it off.

use super::cut::State;
use crate::control::{Code, Control, Meaning};
use crate::lang::Coolant;
use crate::nc::coolant_of;
use crate::render::{CoolantCodes, coolant_codes};
use crate::sema::Settings;

/// The codes for each kind of coolant. `OFF` has the code that turns off all kinds.
#[derive(Clone, Debug)]
pub struct Codes(Vec<(Coolant, CoolantCodes)>);

impl Codes {
    /// The codes that most forms use: M8, M7 and M9.
    pub fn usual() -> Codes {
        let row = |kind, on| (kind, CoolantCodes { on, own_off: None });
        Codes(vec![row(Coolant::FLOOD, 8.0), row(Coolant::MIST, 7.0), row(Coolant::OFF, 9.0)])
    }

    /// The codes of a form. Mist may be a kind of its own (`CoolantKind mist M50 M51`).
    pub fn of_form(settings: &Settings) -> Codes {
        let off = (Coolant::OFF, CoolantCodes { on: settings.coolant[1], own_off: None });
        let kinds = Coolant::NAMES.iter().skip(1).map(|(_, kind)| *kind).filter(|kind| *kind != Coolant::OFF);
        Codes(kinds.filter_map(|kind| Some((kind, coolant_codes(kind, settings)?))).chain([off]).collect())
    }

    /// The coolant that the program must switch on for a coolant of the job. `None`: not compared, because neither the
    /// form nor the control defines a code for it.
    pub fn of_job(&self, coolant: Coolant, control: &Control) -> Option<Coolant> {
        let mut each = coolant.each().map(|kind| self.of_kind(kind, control));
        each.try_fold(Coolant::OFF, |all, kind| Some(all.and(kind?)))
    }

    /// Two kinds of coolant may have the same code, for example on a machine without mist: the meaning of the code
    /// decides. A code that turns coolant off is no kind of coolant.
    fn of_kind(&self, kind: Coolant, control: &Control) -> Option<Coolant> {
        let Some((_, codes)) = self.0.iter().find(|(own, _)| *own == kind) else {
            return (kind == Coolant::THROUGH && control.has(Meaning::Through)).then_some(kind);
        };
        let printed = Code::of(b'M', codes.on).and_then(|code| control.meaning(code)).and_then(coolant_of);
        Some(printed.filter(|printed| *printed != Coolant::OFF).unwrap_or(kind))
    }

    /// The coolant after a code that the simulator does not run. The code may be a coolant code of the form.
    pub fn after(&self, code: Code, coolant: Option<Coolant>) -> Option<Coolant> {
        let is = |own: f64| code.letter == b'M' && own == code.value();
        self.0.iter().fold(coolant, |coolant, (kind, own)| match own.own_off {
            _ if is(own.on) => Some(coolant.unwrap_or_default().then(*kind)),
            Some(off) if is(off) => coolant.map(|coolant| coolant.without(*kind)),
            _ => coolant,
        })
    }
}

/// Compares the coolant of job and program. Coolant that the job does not request is allowed, because it does no harm.
/// Of kinds other than flood, mist and through the spindle, only a dry cut is found.
pub fn differs([wanted, is]: [&State; 2]) -> Option<String> {
    let (wanted, is) = (wanted.coolant?, is.coolant?);
    // of flood and mist, the state contains only the kind that was turned on later
    let either = wanted.holds(Coolant::FLOOD.and(Coolant::MIST));
    let agrees = wanted.each().all(|kind| match kind {
        Coolant::FLOOD | Coolant::MIST if either => is.holds(Coolant::FLOOD) || is.holds(Coolant::MIST),
        Coolant::FLOOD | Coolant::MIST | Coolant::THROUGH => is.holds(kind),
        _ => is != Coolant::OFF,
    });
    (!agrees).then(|| format!("the coolant is {}, but {} in the job", name(is), name(wanted)))
}

/// The kinds by their names, for messages.
pub fn name(coolant: Coolant) -> String {
    let names: Vec<_> = coolant.each().map(Coolant::name).collect();
    if names.is_empty() { "off".to_owned() } else { names.join(" and ") }
}
