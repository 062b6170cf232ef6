//! What a program needs and its file has not said: errors that name the option for it, and for all else that is missing.

use super::fault::{Done, fault};
use super::job::Job;
use crate::diag::Code;

/// What may be missing.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Missing {
    Units,
    Tool,
    Speed,
    Start,
}

/// No units: `at` says where they are missed.
#[cold]
pub(super) fn no_units<T>(job: &Job<'_>, at: &str) -> Done<T> {
    let help = "put UNITS/MM or UNITS/INCHES before it, or say it with `--assume-units mm` (or inch)";
    fault(Code::PL005, at, help.to_owned() + &others(job, Missing::Units))
}

/// No tool is loaded; `option` says its number.
#[cold]
pub(super) fn no_tool<T>(job: &Job<'_>, option: &str) -> Done<T> {
    let (message, help) = match &job.tools.name {
        Some(name) => (
            format!("the file names the tool {name} and does not load it"),
            format!("say the number of each with `{option}`"),
        ),
        None => (
            "the file loads no tool".to_owned(),
            format!("put LOADTL/1 before its first motion, or say the tool's number with `{option}`"),
        ),
    };
    fault(Code::PJ006, message, help + &others(job, Missing::Tool))
}

/// A cut, and the spindle has no speed.
#[cold]
pub(super) fn no_speed<T>(job: &Job<'_>) -> Done<T> {
    let help = "put SPINDL/3000,RPM,CLW before it, or say it with `--assume-speed 3000` (or 3000,CCLW)";
    let message = "a cut, and the file does not say how fast the spindle turns";
    fault(Code::PL009, message, help.to_owned() + &others(job, Missing::Speed))
}

/// A cut is the first motion.
#[cold]
pub(super) fn no_start<T>(job: &Job<'_>) -> Done<T> {
    let help = "put RAPID and GOTO before it, or FROM, or say it with `--assume-start X,Y,Z`";
    let message = "the file begins with a cut, and does not say where the tool is before it";
    fault(Code::PL009, message, help.to_owned() + &others(job, Missing::Start))
}

/// What else the file has not said so far, by the options that say it.
fn others(job: &Job<'_>, told: Missing) -> String {
    let mut options = Vec::new();
    if told != Missing::Units && !job.knows_units() {
        options.push("`--assume-units mm`".to_owned());
    }
    if told != Missing::Tool
        && let Some(option) = job.missing_tool()
    {
        options.push(format!("`{option}`"));
    }
    if told != Missing::Speed && !job.spindle.is_known() {
        options.push("`--assume-speed 3000`".to_owned());
    }
    if options.is_empty() { String::new() } else { format!("; so far it also lacks {}", options.join(", ")) }
}
