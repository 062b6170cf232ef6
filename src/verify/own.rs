//! Feeds and speeds that a form says itself: typed, or calculated from the job's.

use super::tables::OWN;
use crate::compile::{Program, WorkWords};
use crate::control::Control;
use crate::lang::{Coolant, TextId, VarId, VarSet};
use crate::sema::{Formula, PropertyValue, Values};

/// What a form says of one quantity.
#[derive(Clone, Debug, Default)]
pub struct Own {
    /// Numbers that it types.
    pub typed: Vec<f64>,
    /// Calculations with the job's value, as `[min(speed,800)]`.
    calculated: Vec<Formula>,
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

    /// The form types a number.
    pub(super) fn types(&mut self, value: f64) {
        if !self.typed.contains(&value) {
            self.typed.push(value);
        }
    }

    /// The form calculates a word; it counts where it is made of one of these variables alone, or of properties.
    pub(super) fn calculates(&mut self, formula: &Formula, of: &[VarId]) {
        let vars = formula.vars();
        let counts = vars.is_empty() || of.iter().any(|&var| vars == VarSet::of(&[var]));
        if counts && !self.calculated.contains(formula) {
            self.calculated.push(formula.clone());
        }
    }

    /// The number or code in the program of a work offset of the job.
    pub(super) fn work(&self, work: f64, words: &WorkWords, control: &Control) -> f64 {
        let values = OfJob { wanted: work, properties: &self.properties };
        words.name(&values, control).unwrap_or(work)
    }

    /// Does the form say a value where the job wants this one, and near enough to it? `is`: whether a number is the value.
    pub(super) fn says(&self, wanted: f64, is: impl Fn(f64) -> bool) -> bool {
        let values = OfJob { wanted, properties: &self.properties };
        let near = |own: f64| (OWN[0] * wanted..=OWN[1] * wanted).contains(&own) && is(own);
        self.typed.iter().any(|own| near(*own))
            || self.calculated.iter().any(|formula| formula.number(&values).is_ok_and(near))
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
