//! Feeds and speeds that a form says itself: typed, or calculated from the job's; and for which cuts of the job.

use super::tables::OWN;
use crate::compile::{Program, WorkWords};
use crate::control::Control;
use crate::lang::{Coolant, SEQUENCES, SequenceId, TextId, VarId, VarSet};
use crate::sema::{Formula, PropertyValue, Values};

/// What makes a sequence print, as bits: a job that has none of it never gets what the sequence types.
pub(super) mod by {
    /// Every job: its start, its tool changes, its plain moves.
    pub const JOB: u8 = 1;
    /// A hole.
    pub const HOLE: u8 = 1 << 1;
    /// The move that turns compensation on.
    pub const INFEED: u8 = 1 << 2;
    /// The move that turns it off.
    pub const OUTFEED: u8 = 1 << 3;
    /// A section begins or ends.
    pub const SECTION: u8 = 1 << 4;
    /// A stop, a dwell, the way home.
    pub const PAUSE: u8 = 1 << 5;
    /// A subprogram.
    pub const SUB: u8 = 1 << 6;
    /// Those that print a cut themselves: a feed that they type is that cut's.
    pub const CUTS: u8 = HOLE | INFEED | OUTFEED;
}

/// What makes this sequence print.
pub(super) fn printed_by(sequence: SequenceId) -> u8 {
    use SequenceId as S;
    match sequence {
        S::InFeed => by::INFEED,
        S::OutFeed => by::OUTFEED,
        // a thread is printed for all that it is; what Cancel types holds on after its hole
        S::AutoThread | S::CanThread | S::Cancel => by::JOB,
        S::Stop | S::OptStop | S::DwellBlock | S::MoveHome => by::PAUSE,
        // of a torch: how it comes down, and no cut
        S::BeginCut | S::EndCut => 0,
        S::SubStart | S::SubEnd | S::SubCall | S::Between => by::SUB,
        S::BeginLeadin
        | S::EndLeadin
        | S::BeginLeadout
        | S::EndLeadout
        | S::BeginPlunge
        | S::EndPlunge
        | S::BeginRetract
        | S::EndRetract
        | S::BeginSideStep
        | S::EndSideStep
        | S::BeginZLevel
        | S::EndZLevel
        | S::BeginRow
        | S::EndRow => by::SECTION,
        cycle if SEQUENCES.iter().any(|row| row.id == cycle && row.is_cycle) => by::HOLE,
        _ => by::JOB,
    }
}

/// What a form says of one quantity.
#[derive(Clone, Debug, Default)]
pub struct Own {
    /// Numbers that it types, with what makes them print.
    typed: Vec<(f64, u8)>,
    /// Calculations with the job's value, as `[min(speed,800)]`, with the same.
    calculated: Vec<(Formula, u8)>,
    /// Its properties as numbers, where nobody says otherwise.
    properties: Vec<f64>,
}

impl Own {
    /// Of a form that types and calculates nothing so far.
    pub(super) fn of(program: &Program) -> Own {
        let properties = program.settings.properties.iter().map(|property| number(&property.default)).collect();
        Own { properties, ..Own::default() }
    }

    /// Somebody gives a property its value, which goes before the form's default.
    pub(super) fn given(&mut self, row: u16, value: &PropertyValue) {
        if let Some(own) = self.properties.get_mut(usize::from(row)) {
            *own = number(value);
        }
    }

    /// The form types a number in a sequence that these print.
    pub(super) fn types(&mut self, value: f64, by: u8) {
        match self.typed.iter_mut().find(|(own, _)| *own == value) {
            Some((_, bits)) => *bits |= by,
            None => self.typed.push((value, by)),
        }
    }

    /// The form calculates a word; it counts where it is made of one of these variables alone, or of properties.
    pub(super) fn calculates(&mut self, formula: &Formula, of: &[VarId], by: u8) {
        let vars = formula.vars();
        let counts = vars.is_empty() || of.iter().any(|&var| vars == VarSet::of(&[var]));
        if !counts {
            return;
        }
        match self.calculated.iter_mut().find(|(own, _)| own == formula) {
            Some((_, bits)) => *bits |= by,
            None => self.calculated.push((formula.clone(), by)),
        }
    }

    /// The number or code in the program of a work offset of the job.
    pub(super) fn work(&self, work: f64, words: &WorkWords, control: &Control) -> f64 {
        let values = OfJob { wanted: work, properties: &self.properties };
        words.name(&values, control).unwrap_or(work)
    }

    /// Does the form say a value where the job wants this one, and near enough to it? `by`: what the job has had so far that
    /// sequences print for; `is`: whether a number is the value.
    pub(super) fn says(&self, wanted: f64, by: u8, is: impl Fn(f64) -> bool) -> bool {
        let values = OfJob { wanted, properties: &self.properties };
        let near = |own: f64| (OWN[0] * wanted..=OWN[1] * wanted).contains(&own) && is(own);
        let printed = |bits: u8| bits & by != 0;
        self.typed.iter().any(|(own, bits)| printed(*bits) && near(*own))
            || self.calculated.iter().any(|(own, bits)| printed(*bits) && own.number(&values).is_ok_and(near))
    }
}

fn number(value: &PropertyValue) -> f64 {
    match value {
        PropertyValue::Number(number) => *number,
        PropertyValue::YesNo(yes) => f64::from(u8::from(*yes)),
        PropertyValue::Text(_) => 0.0,
    }
}

/// The value that a job wants, for whichever variable is asked.
struct OfJob<'a> {
    wanted: f64,
    properties: &'a [f64],
}

impl Values for OfJob<'_> {
    fn number(&self, _: VarId) -> Option<f64> {
        Some(self.wanted)
    }

    fn text(&self, _: TextId) -> &str {
        ""
    }

    fn coolant(&self) -> Coolant {
        Coolant::OFF
    }

    fn property(&self, row: u16) -> f64 {
        self.properties.get(usize::from(row)).copied().unwrap_or_default()
    }

    fn property_text(&self, _: u16) -> &str {
        ""
    }
}
