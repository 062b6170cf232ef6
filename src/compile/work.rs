//! How a form prints a work offset: by G codes, by words of its own, whose values may be calculated, or after a text.

use crate::control::{Code, Control, Group, WorkOffset};
use crate::lang::{VarId, additional_work};
use crate::sema::{Formula, Values};

/// One way in which a form prints its work offset: `G[work]`, `G154 P[work]`, `G15 H[work]`, `E[work]`, `[work]` after a text.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkWord {
    /// The G code before it in its block.
    pub code: Option<Code>,
    /// The letter of the word; `None`: the value is printed after a text.
    pub letter: Option<u8>,
    /// The value is the number of a G code.
    pub is_code: bool,
    /// How the form makes its value, as `[work-53]`; `None`: it is the job's.
    pub(super) calculated: Option<Formula>,
}

/// How a form prints its work offset, and where. An argument of a macro, of a subprogram or of G10 is none of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WorkWords {
    /// The ways, those of the tool changes first; none: G codes say it, or nothing.
    pub ways: Vec<WorkWord>,
    /// The operations that say it, in their order.
    pub(super) says: Vec<usize>,
    /// What `G[work]` prints for further fixtures: the first value of `[work]`, its words, and the number of their last one.
    pub(super) more: Vec<(f64, WorkWord, f64)>,
    /// G54 to G59 select offsets beside words of the form's own. Not where such a word has another code: G56 of an Okuma, which
    /// has G15, is a length.
    pub shares_its_codes: bool,
}

impl WorkWords {
    /// Does this operation say the work offset?
    pub fn says(&self, op: usize) -> bool {
        self.says.binary_search(&op).is_ok()
    }

    /// Do G codes alone say it, so that each of them is one?
    pub fn by_code(&self) -> bool {
        self.ways.is_empty() || self.ways.iter().any(|way| way.is_code)
    }

    /// How an offset is said: the first way for which the control has such an offset, and the value of its word.
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

    /// What a program calls the offset that the form prints so: its code, its number, or the name of an additional one.
    pub fn name(&self, values: &dyn Values, control: &Control) -> Option<f64> {
        let (way, value) = self.way(values, control)?;
        Some(match way.is_code {
            true => code_of_work(value, control).unwrap_or(value),
            false if way.is_additional(control) => additional_work(value),
            false => value,
        })
    }
}

/// What a program calls the offset that this G code selects: a control may have several codes for one.
fn code_of_work(value: f64, control: &Control) -> Option<f64> {
    match control.row(Code::of(b'G', value)?)?.runs.work? {
        WorkOffset::Usual(tenths) => Some(f64::from(tenths) / 10.0),
        WorkOffset::Additional(number) => Some(additional_work(f64::from(number))),
        WorkOffset::Word(_) | WorkOffset::Counted(_) => None,
    }
}

impl WorkWord {
    /// Is it the parameter of a code that selects additional offsets?
    fn is_parameter(&self, control: &Control) -> bool {
        !self.is_code && self.code.is_some_and(|code| control.group(code) == Some(Group::Work))
    }

    /// Is it the parameter of a code that selects offsets beside those that have codes of their own?
    fn is_additional(&self, control: &Control) -> bool {
        let row = self.code.and_then(|code| control.row(code));
        self.is_parameter(control) && !matches!(row.and_then(|row| row.runs.work), Some(WorkOffset::Counted(_)))
    }

    /// Does the control have such an offset, as far as that is known?
    fn has(&self, value: f64, control: &Control) -> bool {
        match self.is_code {
            true => Code::of(b'G', value).is_some_and(|code| control.group(code) == Some(Group::Work)),
            false if self.is_parameter(control) => value >= 1.0 && value.fract() == 0.0,
            // E19 of a control that has E1 to E18
            false => {
                let traits = control.traits();
                let most = traits.most_work.filter(|_| self.code.is_none() && self.letter == traits.work_letter);
                most.is_none_or(|most| value <= f64::from(most))
            }
        }
    }
}
