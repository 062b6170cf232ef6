//! The result of verifying the program against its job.

use serde_json::{Value, json};

use super::form;
use crate::error::Error;
use crate::post::Proven;
use crate::render::TraceLine;
use crate::source::Source;
use crate::verify::{Finding, Verdict};

/// The verdict as a short text, and the findings, each with its block, its job item and its form line.
pub fn verdict(proven: Result<Proven, Error>, trace: &[TraceLine], files: &[Source]) -> Value {
    let proven = match proven {
        Ok(proven) => proven,
        Err(error) => return json!({ "kind": "none", "text": error.to_string(), "findings": [] }),
    };
    let counts = format!("{}, {}", count(proven.counts.cuts, "cut"), count(proven.counts.holes, "hole"));
    let (kind, text, found): (&str, String, &[Finding]) = match &proven.verdict {
        Verdict::Identical => ("proven", format!("proven: {counts}"), &[]),
        Verdict::Equivalent(_) => ("proven", format!("proven equivalent: {counts}"), &[]),
        Verdict::NotProven(unproven) => {
            ("unproven", format!("not proven{}: {}", unproven.from(), unproven.why), unproven.notes.as_slice())
        }
        Verdict::Different(found) => {
            ("different", format!("different: {}", count(found.len() as u64, "finding")), found)
        }
    };
    let (from, help, allowed) = match &proven.verdict {
        Verdict::NotProven(unproven) => (unproven.line, unproven.help.as_str(), Vec::new()),
        Verdict::Equivalent(other) => {
            let done = other.counts().filter(|(number, ..)| *number > 0);
            (0, "", done.map(|(number, what, how)| format!("{} {how}", count(number, what))).collect())
        }
        _ => (0, "", Vec::new()),
    };
    let findings: Vec<Value> = found.iter().map(|found| finding(found, trace, files)).collect();
    json!({ "kind": kind, "text": text, "line": from, "help": help, "allowed": allowed, "findings": findings })
}

pub fn finding(found: &Finding, trace: &[TraceLine], files: &[Source]) -> Value {
    let traced = trace.binary_search_by_key(&found.line, |line| line.line).ok().map(|at| &trace[at]);
    let place = found.place.or(traced.map(|traced| traced.place));
    json!({
        "code": found.code.name(),
        "message": found.message,
        "help": found.help,
        "line": found.line,
        "times": found.times,
        "item": place.map(|place| place.path()),
        "form": traced.and_then(|traced| form::place(traced.form?, files)),
    })
}

/// A number with its noun: `1 cut`, `2 cuts`.
fn count(number: u64, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}
