//! How a form prints a work offset: as a G code, as another word, or as a value after a text. The value of a word may
//! be calculated.

use crate::control::{Code, Control, Group, WorkOffset};
use crate::lang::{VarId, additional_work};
use crate::sema::{Formula, Values};

/// One way to print a work offset: `G[work]`, `G154 P[work]`, `G15 H[work]`, `E[work]`, or `[work]` after a text.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkWord {
    /// The G code before the word in its block.
    pub code: Option<Code>,
    /// The letter of the word. `None`: the value follows a text without a letter.
    pub letter: Option<u8>,
    /// Whether the value is the number of a G code.
    pub is_code: bool,
    /// How the value is calculated, as in `[work-53]`. `None`: the value of the job is printed.
    pub(super) calculated: Option<Formula>,
}

/// The words of one `MoreWork` command.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MoreWords {
    /// The first value of `[work]` to which the command applies.
    pub(super) from: f64,
    /// The word that selects the offset.
    pub(super) word: WorkWord,
    /// The number in the word for the first offset.
    pub(super) number: f64,
    /// The greatest number in the word; `None`: no limit is known.
    pub(super) last: Option<f64>,
}

/// All ways in which a form prints a work offset, and the operations that print it. Arguments of macros, subprograms and G10 are
/// not included.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WorkWords {
    /// The ways to print a work offset. Ways in tool changes come first. Empty: the form prints offsets by G codes
    /// only, or prints no offsets.
    pub ways: Vec<WorkWord>,
    /// The indices of the operations that print the work offset, in ascending order.
    pub(super) says: Vec<usize>,
    /// The words from `MoreWork`.
    pub(super) more: Vec<MoreWords>,
    /// Whether G54 to G59 also select offsets if the form has other words for offsets. False if one of these other
    /// words follows a code. For example, on an Okuma, offsets follow G15, and G56 is a code for tool lengths.
    pub shares_its_codes: bool,
}

impl WorkWords {
    /// Whether this operation prints the work offset.
    pub fn says(&self, op: usize) -> bool {
        self.says.binary_search(&op).is_ok()
    }

    /// Whether the form can print a work offset as a G code. Also true if the form prints no offsets.
    pub fn by_code(&self) -> bool {
        self.ways.is_empty() || self.ways.iter().any(|way| way.is_code)
    }

    /// The first word of the form for this offset that the control supports, and the value of the word.
    pub fn way(&self, values: &dyn Values, control: &Control) -> Option<(&WorkWord, f64)> {
        if let Some((row, value)) = values.number(VarId::Work).and_then(|work| self.row(work)) {
            // a last number in `MoreWork` replaces the highest number that postform knows
            let is_known =
                row.last.is_some() || !row.word.is_additional(control) || value <= f64::from(WorkOffset::MOST);
            return (is_known && row.word.has(value, control)).then_some((&row.word, value));
        }
        self.ways.iter().find_map(|way| {
            let value = match &way.calculated {
                Some(formula) => formula.number(values).ok(),
                None => values.number(VarId::Work),
            };
            value.filter(|value| way.has(*value, control)).map(|value| (way, value))
        })
    }

    /// The word from `MoreWork` for this value of `[work]`, and the number in the word.
    pub fn more(&self, work: f64) -> Option<(&WorkWord, f64)> {
        self.row(work).map(|(row, number)| (&row.word, number))
    }

    fn row(&self, work: f64) -> Option<(&MoreWords, f64)> {
        let row = self.more.iter().rfind(|row| row.from <= work && work.fract() == 0.0)?;
        Some((row, row.number + (work - row.from)))
    }

    /// Whether the form has a `MoreWork` command.
    pub fn has_more(&self) -> bool {
        !self.more.is_empty()
    }

    /// The last number of `MoreWork`, if the number of this value of `[work]` is greater.
    pub fn beyond(&self, work: f64) -> Option<f64> {
        let (row, number) = self.row(work)?;
        row.last.filter(|last| number > *last)
    }

    /// The identifier of the work offset that is printed: its code, its number, or the identifier of an additional offset.
    pub fn name(&self, values: &dyn Values, control: &Control) -> Option<f64> {
        let (way, value) = self.way(values, control)?;
        Some(match way.is_code {
            true => code_of_work(value, control).unwrap_or(value),
            false if way.is_additional(control) => additional_work(value),
            false => value,
        })
    }
}

/// The identifier of the offset that a G code selects. On some controls several codes select the same offset.
fn code_of_work(value: f64, control: &Control) -> Option<f64> {
    match control.row(Code::of(b'G', value)?)?.runs.work? {
        WorkOffset::Usual(tenths) => Some(f64::from(tenths) / 10.0),
        WorkOffset::Additional(number) => Some(additional_work(f64::from(number))),
        WorkOffset::Word(_) | WorkOffset::Counted(_) => None,
    }
}

impl WorkWord {
    /// Whether the word is a parameter of a code that selects work offsets.
    fn is_parameter(&self, control: &Control) -> bool {
        !self.is_code && self.code.is_some_and(|code| control.group(code) == Some(Group::Work))
    }

    /// Whether the word is a parameter of a code for additional work offsets, such as P of G54.1. An additional offset
    /// has only a number.
    fn is_additional(&self, control: &Control) -> bool {
        let row = self.code.and_then(|code| control.row(code));
        self.is_parameter(control) && !matches!(row.and_then(|row| row.runs.work), Some(WorkOffset::Counted(_)))
    }

    /// Whether the control has this offset, as far as postform knows the offsets of the control.
    fn has(&self, value: f64, control: &Control) -> bool {
        match self.is_code {
            true => Code::of(b'G', value).is_some_and(|code| control.selects_work(code)),
            false if self.is_parameter(control) => value >= 1.0 && value.fract() == 0.0,
            // for example, E19 on a control that has E1 to E18
            false => {
                let traits = control.traits();
                let most = traits.most_work.filter(|_| self.code.is_none() && self.letter == traits.work_letter);
                most.is_none_or(|most| value <= f64::from(most))
            }
        }
    }
}
