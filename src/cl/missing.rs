//! The errors for data that the program needs but the file does not have. Each error names the option that gives this data,
//! and the options for other missing data.

use super::fault::{Done, fault};
use super::job::Job;
use crate::diag::Code;

/// Data that may be missing.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Missing {
    Units,
    Tool,
    Speed,
    Start,
}

/// The error for missing units. `at` describes where the units are needed.
#[cold]
pub(super) fn no_units<T>(job: &Job<'_>, at: &str) -> Done<T> {
    let help = "put UNITS/MM or UNITS/INCHES before this line, or give the units with `--assume-units mm` (or inch)";
    fault(Code::PL005, at, help.to_owned() + &others(job, Missing::Units))
}

/// The error if no tool is loaded. `option` sets the number of the tool.
#[cold]
pub(super) fn no_tool<T>(job: &Job<'_>, option: &str) -> Done<T> {
    let (message, help) = match job.tools.name.get() {
        Some(name) => (
            format!("the file names the tool {name} but does not load it"),
            format!("give the number of each tool with `{option}`"),
        ),
        None => (
            "the file loads no tool before this line".to_owned(),
            format!("put LOADTL/1 before the first motion, stop or dwell, or give the tool's number with `{option}`"),
        ),
    };
    fault(Code::PJ006, message, help + &others(job, Missing::Tool))
}

/// The error for a cut without a spindle speed.
#[cold]
pub(super) fn no_speed<T>(job: &Job<'_>) -> Done<T> {
    let help = "put SPINDL/3000,RPM,CLW before the cut, or give the speed with `--assume-speed 3000` (or 3000,CCLW)";
    let message = "a cut without a spindle speed";
    fault(Code::PL009, message, help.to_owned() + &others(job, Missing::Speed))
}

/// The error if the first motion is a cut and the tool's position before it is unknown.
#[cold]
pub(super) fn no_start<T>(job: &Job<'_>) -> Done<T> {
    let help = "put RAPID and GOTO, or FROM, before the cut, or give the position with `--assume-start X,Y,Z`";
    let message = "the file begins with a cut, and the position of the tool before it is unknown";
    fault(Code::PL009, message, help.to_owned() + &others(job, Missing::Start))
}

/// The options for other data that the file does not have so far.
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
    if options.is_empty() {
        String::new()
    } else {
        format!("; up to this line the file also needs {}", options.join(", "))
    }
}
