//! Printing of a work offset: by G codes, by words of the form's own (possibly calculated), or after a text.

use crate::control::{Code, Control, Group, WorkOffset};
use crate::lang::{VarId, additional_work};
use crate::sema::{Formula, Values};

/// A format for the work offset: `G[work]`, `G154 P[work]`, `G15 H[work]`, `E[work]`, or `[work]` after a text.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkWord {
    /// The G code before it in its block.
    pub code: Option<Code>,
    /// The letter of the word. `None`: the value follows a text and has no letter.
    pub letter: Option<u8>,
    /// The value is the number of a G code.
    pub is_code: bool,
    /// Calculation of the value, as `[work-53]`; `None`: the job's value is printed.
    pub(super) calculated: Option<Formula>,
}

/// All formats of a form for the work offset, and the operations that print it. Arguments of macros, subprograms and G10 are not
/// included.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WorkWords {
    /// The formats; those of the tool changes come first. Empty: G codes, or no work offset at all.
    pub ways: Vec<WorkWord>,
    /// The operations that print the work offset, in order.
    pub(super) says: Vec<usize>,
    /// Words of `G[work]` for further fixtures: the first value of `[work]`, the words, and the number of the last one.
    pub(super) more: Vec<(f64, WorkWord, f64)>,
    /// G54 to G59 select offsets besides the form's own words. False if such a word follows another code: on an Okuma with G15,
    /// G56 is a length.
    pub shares_its_codes: bool,
}

impl WorkWords {
    /// Does this operation print the work offset?
    pub fn says(&self, op: usize) -> bool {
        self.says.binary_search(&op).is_ok()
    }

    /// Is the work offset printed only by G codes, so that each such code is an offset?
    pub fn by_code(&self) -> bool {
        self.ways.is_empty() || self.ways.iter().any(|way| way.is_code)
    }

    /// The first format that is possible on the control for this offset, and the value of its word.
    pub fn way(&self, values: &dyn Values, control: &Control) -> Option<(&WorkWord, f64)> {
        if let Some((word, value)) = values.number(VarId::Work).and_then(|work| self.more(work)) {
            return word.has(value, control).then_some((word, value));
        }
        self.ways.iter().find_map(|way| {
            let value = match &way.calculated {
                Some(formula) => formula.number(values).ok(),
                None => values.number(VarId::Work),
            };
            value.filter(|value| way.has(*value, control)).map(|value| (way, value))
        })
    }

    /// The words of `MoreWork` for this value of `[work]`, and the number of the last one.
    pub fn more(&self, work: f64) -> Option<(&WorkWord, f64)> {
        let (first, word, number) = self.more.iter().rfind(|(first, ..)| *first <= work && work.fract() == 0.0)?;
        Some((word, number + (work - first)))
    }

    /// The identifier of the printed offset in a program: its code, its number, or the name of an additional offset.
    pub fn name(&self, values: &dyn Values, control: &Control) -> Option<f64> {
        let (way, value) = self.way(values, control)?;
        Some(match way.is_code {
            true => code_of_work(value, control).unwrap_or(value),
            false if way.is_additional(control) => additional_work(value),
            false => value,
        })
    }
}

/// The identifier of the offset that a G code selects. A control may have several codes for one offset.
fn code_of_work(value: f64, control: &Control) -> Option<f64> {
    match control.row(Code::of(b'G', value)?)?.runs.work? {
        WorkOffset::Usual(tenths) => Some(f64::from(tenths) / 10.0),
        WorkOffset::Additional(number) => Some(additional_work(f64::from(number))),
        WorkOffset::Word(_) | WorkOffset::Counted(_) => None,
    }
}

impl WorkWord {
    /// Is the word a parameter of a code that selects additional offsets?
    fn is_parameter(&self, control: &Control) -> bool {
        !self.is_code && self.code.is_some_and(|code| control.group(code) == Some(Group::Work))
    }

    /// Is the word a parameter of a code that selects offsets besides those with codes of their own?
    fn is_additional(&self, control: &Control) -> bool {
        let row = self.code.and_then(|code| control.row(code));
        self.is_parameter(control) && !matches!(row.and_then(|row| row.runs.work), Some(WorkOffset::Counted(_)))
    }

    /// Does the control have this offset, as far as is known?
    fn has(&self, value: f64, control: &Control) -> bool {
        match self.is_code {
            true => Code::of(b'G', value).is_some_and(|code| control.group(code) == Some(Group::Work)),
            false if self.is_parameter(control) => value >= 1.0 && value.fract() == 0.0,
            // E19 on a control with E1 to E18
            false => {
                let traits = control.traits();
                let most = traits.most_work.filter(|_| self.code.is_none() && self.letter == traits.work_letter);
                most.is_none_or(|most| value <= f64::from(most))
            }
        }
    }
}
