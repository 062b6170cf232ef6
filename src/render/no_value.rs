//! Errors for variables without a value, and for calculations that fail.

use super::fault::{Done, fault};
use super::vars::MOVED;
use crate::diag::{Code, Diag};
use crate::lang::{AHEAD, Origin, VarId};
use crate::span::Span;

/// The error of a variable that has no value.
#[cold]
pub fn no_value<T>(var: VarId) -> Done<T> {
    let help = match var {
        VarId::Nexttool => {
            "list the tools under `tool_order` at the beginning of the job, or render without `--stream`".to_owned()
        }
        VarId::Cuttime => {
            "the time of a cut is unknown, for example because of a constant surface speed; print it only inside `@if [cuttime]`".to_owned()
        }
        _ if AHEAD.has(var) => "the job has no cut for this value; test it first, as `@if [hmin]`".to_owned(),
        VarId::Dcomp => {
            "give the operation a tool with a `diameter_offset`; a wire without a tool takes \"set\": {\"dcomp\": 1}"
                .to_owned()
        }
        VarId::Program => "give the job a `program`, or use `--program NUMBER`".to_owned(),
        VarId::H | VarId::V | VarId::D => "begin the operation with a rapid that gives all coordinates".to_owned(),
        _ if MOVED.contains(&var) => {
            "the position of the tool is unknown here: print it in the sequence that moved the tool or changed the \
             offset"
                .to_owned()
        }
        _ if var.row().origin == Origin::Job => {
            format!("give it with `--set {}=VALUE` or under \"set\" in the job", var.name())
        }
        _ => format!(
            "meaning of the variable: {}; give its value in the job, or remove the word from the form",
            var.row().meaning
        ),
    };
    fault(Code::PR001, format!("[{}] has no value here", var.name()), help)
}

/// Error: a condition depends on the tools ahead, but the job is read only once and does not list its tools.
#[cold]
pub fn no_order() -> Diag {
    Diag::new(Code::PR052, "the next tools are unknown")
        .help("list the tools under `tool_order` at the beginning of the job, or render without `--stream`")
}

/// The error of a division by zero.
#[cold]
pub fn division_by_zero(divisor: Span) -> Diag {
    Diag::new(Code::PR051, "a division by zero")
        .at(divisor, "this is 0 here")
        .help("test the divisor first, as `@if [pitch] > 0`")
}
