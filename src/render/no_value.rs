//! Variables that have no value where they are printed, and calculations that have none.

use super::fault::{Done, fault};
use super::vars::MOVED;
use crate::diag::{Code, Diag};
use crate::lang::{AHEAD, Origin, VarId};
use crate::span::Span;

/// The error of a variable that has no value.
#[cold]
pub fn no_value<T>(var: VarId) -> Done<T> {
    let help = match var {
        VarId::Nexttool => "list the tools ahead under `tool_order`, or render without `--stream`".to_owned(),
        VarId::Cuttime => {
            "there is a cut whose time is unknown, as at a constant surface speed; ask before it: `@if [cuttime]`"
                .to_owned()
        }
        _ if AHEAD.has(var) => "the job has no cut that tells it; ask before it, as `@if [hmin]`".to_owned(),
        VarId::Dcomp => {
            "give the operation a tool with a `diameter_offset`; a wire without a tool takes \"set\": {\"dcomp\": 1}"
                .to_owned()
        }
        VarId::Program => "give the job a `program`, or say it with `--program NUMBER`".to_owned(),
        VarId::H | VarId::V | VarId::D => "begin the operation with a rapid that gives all coordinates".to_owned(),
        _ if MOVED.contains(&var) => {
            "the position of the tool is unknown here: print its position in the sequence that moved it, or changed the offset"
                .to_owned()
        }
        _ if var.row().origin == Origin::Job => {
            format!("give it with `--set {}=VALUE` or under \"set\" in the job", var.name())
        }
        _ => format!("it stands for: {}; let the job say it, or take the word out of the form", var.row().meaning),
    };
    fault(Code::PR001, format!("[{}] has no value here", var.name()), help)
}

/// The error of a condition that asks for the tools ahead in a job that is read once and does not list them.
#[cold]
pub fn no_order() -> Diag {
    Diag::new(Code::PR052, "the tools that come next are not known")
        .help("list them under `tool_order` in the job's head, or render without `--stream`")
}

/// The error of a division by zero.
#[cold]
pub fn division_by_zero(divisor: Span) -> Diag {
    Diag::new(Code::PR051, "a division by zero")
        .at(divisor, "this is 0 here")
        .help("ask before it, as `@if [pitch] > 0`")
}
