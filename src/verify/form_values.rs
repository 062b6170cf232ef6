//! Feeds and speeds that a form itself defines, as numbers or calculated from the job's values. Each value has the
//! kinds of events that print it, because only cuts after such an event may have the value.

use super::tables::OWN;
use crate::compile::{Program, WorkWords};
use crate::control::Control;
use crate::lang::{Coolant, SEQUENCES, SequenceId, TextId, VarId, VarSet};
use crate::sema::{Formula, PropertyValue, Values};
use crate::toolpath::Event;

/// Kinds of events that print a sequence, as bits. If the job has no event of these kinds, the values of the sequence
/// do not apply.
pub(super) mod by {
    /// Events of every job: its start, its tool changes, its plain moves.
    pub const JOB: u8 = 1;
    /// A hole.
    pub const HOLE: u8 = 1 << 1;
    /// The move that turns compensation on.
    pub const INFEED: u8 = 1 << 2;
    /// The move that turns compensation off.
    pub const OUTFEED: u8 = 1 << 3;
    /// The beginning or end of a section.
    pub const SECTION: u8 = 1 << 4;
    /// A stop, a dwell, the move home.
    pub const PAUSE: u8 = 1 << 5;
    /// A subprogram.
    pub const SUB: u8 = 1 << 6;
    /// Events whose sequences print a cut. A feed in one of these sequences is the feed of the cut.
    pub const CUTS: u8 = HOLE | INFEED | OUTFEED;
}

/// The events that print this sequence.
pub(super) fn printed_by(sequence: SequenceId) -> u8 {
    use SequenceId as S;
    match sequence {
        S::InFeed => by::INFEED,
        S::OutFeed => by::OUTFEED,
        // a sequence for threads prints the whole thread; a value in Cancel stays active after the hole
        S::AutoThread | S::CanThread | S::Cancel => by::JOB,
        S::Stop | S::OptStop | S::DwellBlock | S::MoveHome => by::PAUSE,
        // these print how a torch comes down, but no cut
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

/// The values that the form itself defines for one quantity, such as the feed.
#[derive(Clone, Debug, Default)]
pub struct Own {
    /// Numbers in the form, each with the kinds of events that print the number.
    typed: Vec<(f64, u8)>,
    /// Calculations from the job's value, such as `[min(speed,800)]`, each with the kinds of events that print the
    /// result.
    calculated: Vec<(Formula, u8)>,
    /// The form's properties as numbers: the value given by the user, or the form's default if no value is given.
    properties: Vec<f64>,
}

impl Own {
    /// The values of a form before its sequences are read.
    pub(super) fn of(program: &Program) -> Own {
        let properties = program.settings.properties.iter().map(|property| number(&property.default)).collect();
        Own { properties, ..Own::default() }
    }

    /// Sets a property to a given value instead of the form's default.
    pub(super) fn given(&mut self, row: u16, value: &PropertyValue) {
        if let Some(own) = self.properties.get_mut(usize::from(row)) {
            *own = number(value);
        }
    }

    /// Adds a number of a sequence. `by`: the events that print the sequence.
    pub(super) fn types(&mut self, value: f64, by: u8) {
        match self.typed.iter_mut().find(|(own, _)| *own == value) {
            Some((_, bits)) => *bits |= by,
            None => self.typed.push((value, by)),
        }
    }

    /// Adds a calculated word if its formula uses no variable, or only one variable, which is in `of`.
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

    /// The number or code that the program has for a work offset of the job.
    pub(super) fn work(&self, work: f64, words: &WorkWords, control: &Control) -> f64 {
        let values = OfJob { wanted: work, properties: &self.properties };
        words.name(&values, control).unwrap_or(work)
    }

    /// Whether the form itself defines a value that may replace the job's value `wanted`. The form's value must be
    /// within the allowed range around the job's value. `by`: the kinds of events that the job has had so far. `is`:
    /// tests whether a number is the program's value.
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

/// Variables for a formula: each variable has the job's value `wanted`.
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

/// The kind of an event, as a bit of [`by`].
pub(super) fn made_by(event: &Event<'_>) -> u8 {
    match event {
        Event::Hole(_) => by::HOLE,
        Event::Infeed { .. } => by::INFEED,
        Event::Outfeed { .. } => by::OUTFEED,
        Event::Begin(_) | Event::End(_) => by::SECTION,
        Event::Stop(_) | Event::Dwell(_) | Event::Home => by::PAUSE,
        Event::SubStart(_) | Event::SubEnd | Event::SubCall(_) => by::SUB,
        _ => by::JOB,
    }
}
