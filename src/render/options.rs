//! Options that a caller may set.

use std::sync::Arc;

use crate::lang::VarId;
use crate::sema::PropertyValue;
use crate::survey::Survey;
use crate::toolpath::Units;

/// How canned cycles are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Cycles {
    /// By the form's sequences, or as single moves if the form has no sequence for the cycle.
    #[default]
    Form,
    /// Always as single moves.
    Emulated,
}

/// Date and time of printing. The caller provides date and time, because the library never reads a clock.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Clock {
    /// `[date]`, as 2026-03-31.
    pub date: String,
    /// `[time]`, as 14:05; empty if only the date is known.
    pub time: String,
}

impl Clock {
    /// Parses a date, as `2026-03-31`, or a date with a time, as `2026-03-31T14:05`. A space instead of the T and
    /// trailing seconds are also accepted. `None`: the text has neither format, or the date or time does not exist.
    pub fn parse(text: &str) -> Option<Clock> {
        let (date, time) = match text.split_once(['T', ' ']) {
            Some((date, time)) => (date, Some(time)),
            None => (text, None),
        };
        let [year, month, day] = numbers(date, '-', &[4, 2, 2])?[..] else { return None };
        let leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
        let days = match month {
            1 | 3 | 5 | 7 | 8 | 10 | 12 => 31,
            4 | 6 | 9 | 11 => 30,
            2 => 28 + u32::from(leap),
            _ => return None,
        };
        let of_day = match time {
            Some(time) => {
                let read = numbers(time, ':', &[2, 2]).or_else(|| numbers(time, ':', &[2, 2, 2]))?;
                if read[0] > 23 || read[1..].iter().any(|part| *part > 59) {
                    return None;
                }
                time.get(..5)?
            }
            None => "",
        };
        (1..=days).contains(&day).then(|| Clock { date: date.to_owned(), time: of_day.to_owned() })
    }
}

/// Parses numbers with the given counts of digits.
fn numbers(text: &str, between: char, digits: &[usize]) -> Option<Vec<u32>> {
    let parts: Vec<&str> = text.split(between).collect();
    let fits =
        |(part, digits): (&&str, &usize)| part.len() == *digits && part.bytes().all(|byte| byte.is_ascii_digit());
    if parts.len() != digits.len() || !parts.iter().zip(digits).all(fits) {
        return None;
    }
    parts.iter().map(|part| part.parse().ok()).collect()
}

/// Options that a caller may set.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// How canned cycles are printed.
    pub cycles: Cycles,
    /// Units of the program; default: the units of the job.
    pub units: Option<Units>,
    /// Number of the program; default: the number in the job.
    pub program: Option<u32>,
    /// Answers to prompts and values of variables. These values override the values of the job.
    pub set: Vec<(VarId, f64)>,
    /// Values of properties that override all other values, by row.
    pub properties: Vec<(u16, PropertyValue)>,
    /// Values of properties that override only the form's defaults, by row.
    pub shop: Vec<(u16, PropertyValue)>,
    /// Compute countersink depths by the formula printed in GENER's manual, which is correct only at 90 degrees.
    pub sink_as_printed: bool,
    /// Date and time of printing, for texts of the program.
    pub clock: Option<Clock>,
    /// Name of the job's file, for texts of the program.
    pub job_file: Option<String>,
    /// Results of the first reading of the job, for forms that use them.
    pub survey: Option<Arc<Survey>>,
    /// Keep a source map.
    pub trace: bool,
    /// Record the output of each word of the form.
    pub words: bool,
}
