//! A verdict as JSON for other programs, version 1 (docs/verify.md).

use serde_json::{Value, json};

use crate::source::Source;
use crate::verify::{Counts, Finding, Verdict};

/// A verdict with all findings. `names` are the names of the job and of the program, `files` the files of the form.
pub fn proof(verdict: &Verdict, counts: Counts, names: [&str; 2], files: &[Source]) -> Value {
    let [job, program] = names;
    let allowed: serde_json::Map<String, Value> = match verdict {
        Verdict::Equivalent(allowed) => {
            allowed.named().filter(|(_, n)| *n > 0).map(|(name, n)| (name.into(), n.into())).collect()
        }
        _ => Default::default(),
    };
    let unproven = match verdict {
        Verdict::NotProven(unproven) => Some(unproven),
        _ => None,
    };
    let findings = match verdict {
        Verdict::Different(findings) => &findings[..],
        _ => unproven.map_or(&[][..], |unproven| &unproven.notes[..]),
    };
    let from = unproven.map(|unproven| {
        json!({
            "why": unproven.why, "help": unproven.help, "program_line": some(unproven.line), "block": unproven.block,
            "job": unproven.place.map(|place| json!({ "line": some(place.line), "step": place.path() })),
        })
    });
    json!({
        "postform_verify": 1, "verdict": verdict.name(), "job": job, "program": program,
        "compared": { "cuts": counts.cuts, "holes": counts.holes },
        "allowed": allowed, "not_proven": from,
        "findings": findings.iter().map(|found| finding(found, files)).collect::<Vec<_>>(),
    })
}

fn some(line: u64) -> Option<u64> {
    Some(line).filter(|line| *line > 0)
}

/// A finding about a program, with its locations in the job, the form and the program. `files` are the files of the
/// form.
pub fn finding(found: &Finding, files: &[Source]) -> Value {
    let form = found.form.and_then(|span| Some((files.get(span.file as usize)?, span)));
    json!({
        "code": found.code.name(), "key": found.code.key(), "message": found.message, "help": found.help,
        "times": found.times, "program_line": some(found.line), "block": found.block,
        "job": found.place.map(|place| json!({ "line": some(place.line), "step": place.path() })),
        "form": form.map(|(source, span)| json!({ "file": source.name, "line": source.line(span.start) + 1 })),
    })
}
