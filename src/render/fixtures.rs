//! Lists the work offsets that a form prints, for the help of a finding.

use std::fmt::Write as _;

use crate::compile::Program;
use crate::control::{Code, Control, Row, WorkOffset};

/// The greatest number of a work offset that is tried.
const MOST: u32 = 999;
/// The seventh work offset of LinuxCNC.
const AFTER_G59: Code = Code { letter: b'G', tenths: 591 };

/// The work offsets for which `prints` is true, as in `1 to 6, 54 to 59, 59.1 to 59.3`. Numbers below 50 are fixtures,
/// and numbers from 50 on are codes.
pub fn fixtures(prints: impl Fn(f64) -> bool) -> String {
    let whole = (1..=MOST).map(|number| number * 10);
    let tenths = 591..=593;
    let mut ranges: Vec<[u32; 2]> = Vec::new();
    for (number, step) in whole.map(|number| (number, 10)).chain(tenths.map(|number| (number, 1))) {
        match ranges.last_mut() {
            _ if !prints(f64::from(number) / 10.0) => {}
            // 49 is a fixture, and 50 is a code
            Some([_, last]) if *last + step == number && (step == 10) == (*last % 10 == 0) && number != 500 => {
                *last = number
            }
            _ => ranges.push([number; 2]),
        }
    }
    let mut text = String::new();
    for [first, last] in ranges {
        let comma = if text.is_empty() { "" } else { ", " };
        let [first, last] = [first, last].map(|number| f64::from(number) / 10.0);
        _ = if first == last { write!(text, "{comma}{first}") } else { write!(text, "{comma}{first} to {last}") };
    }
    text
}

/// The help of a finding for a work offset that the form does not print. `printed`: the offsets that it prints.
pub fn help_for_fixtures(printed: &str, program: &Program) -> String {
    let give = match printed {
        "" => "print `G[work]` in the tool changes of the form".to_owned(),
        printed => format!("this form prints the work offsets {printed}: give one of these"),
    };
    match additional(program.settings.control()) {
        _ if program.work.has_more() => {
            format!("{give}; if the control has more offsets, write the number of the last one into `MoreWork`")
        }
        Some(words) => format!("{give}; or define further ones at the top of the form: `MoreWork 7 {words}`"),
        None => give,
    }
}

/// The words that select the first work offset after G59, such as `G54.1 P1`; `None`: the control has none.
fn additional(control: &Control) -> Option<String> {
    if let Some(letter) = control.traits().work_letter {
        return Some(format!("{0}7", char::from(letter)));
    }
    let by_word = |row: &Row| match row.runs.work {
        Some(WorkOffset::Word(letter)) if row.not_run.is_none() => {
            Some(format!("{} {}1", row.code, char::from(letter)))
        }
        _ => None,
    };
    let after_g59 = || control.rows().map(|row| row.code).find(|code| *code == AFTER_G59);
    control.rows().find_map(by_word).or_else(|| after_g59().map(|code| code.to_string()))
}
