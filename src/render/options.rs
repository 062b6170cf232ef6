//! What a caller may choose.

use std::sync::Arc;

use crate::lang::VarId;
use crate::sema::PropertyValue;
use crate::survey::Survey;
use crate::toolpath::Units;

/// Where canned cycles come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Cycles {
    /// The form's sequences; moves where it has none.
    #[default]
    Form,
    /// Always moves.
    Emulated,
}

/// Day and time of printing: nothing of the library looks at a clock.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Clock {
    /// `[date]`, as 2026-03-31.
    pub date: String,
    /// `[time]`, as 14:05; empty where only the day is said.
    pub time: String,
}

impl Clock {
    /// Reads a day, as `2026-03-31`, or a day and a time, as `2026-03-31T14:05`; a blank in place of the T and seconds are read,
    /// too. `None`: it is neither, or there is no such day or time.
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

/// Numbers of so many digits each.
fn numbers(text: &str, between: char, digits: &[usize]) -> Option<Vec<u32>> {
    let parts: Vec<&str> = text.split(between).collect();
    let fits =
        |(part, digits): (&&str, &usize)| part.len() == *digits && part.bytes().all(|byte| byte.is_ascii_digit());
    if parts.len() != digits.len() || !parts.iter().zip(digits).all(fits) {
        return None;
    }
    parts.iter().map(|part| part.parse().ok()).collect()
}

/// What a caller may choose.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Where cycles come from.
    pub cycles: Cycles,
    /// Units of the program; else those of the job.
    pub units: Option<Units>,
    /// The program's number; else that of the job.
    pub program: Option<u32>,
    /// Answers to prompts and values of variables; they go before the job's.
    pub set: Vec<(VarId, f64)>,
    /// Properties of the form that go before all else, by their rows.
    pub properties: Vec<(u16, PropertyValue)>,
    /// Properties that go before the form's defaults.
    pub shop: Vec<(u16, PropertyValue)>,
    /// Countersink depths by the formula that GENER's manual prints, which is right at 90 degrees only.
    pub sink_as_printed: bool,
    /// Day and time of printing, as the program says them.
    pub clock: Option<Clock>,
    /// The job's file, as the program says it.
    pub job_file: Option<String>,
    /// What lies ahead in the job, for forms that print any of it.
    pub survey: Option<Arc<Survey>>,
    /// Keep a source map.
    pub trace: bool,
    /// Keep what each word of the form came to.
    pub words: bool,
}
