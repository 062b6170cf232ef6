//! The result of the check whether the program fits into its machine, and the times of the blocks on this machine.

use serde_json::{Value, json};

use super::behind;
use super::pack::Scene;
use super::verdict::finding;
use crate::control::Control;
use crate::diag::Severity;
use crate::machine::Machine;
use crate::nc::clock;
use crate::preflight::Fitted;
use crate::render::TraceLine;
use crate::source::Source;
use crate::terminal::escaped;
use crate::times::BlockTime;

/// The result of the check as a short text, the allowed values of unknown offsets and lengths, the checks that were
/// left out, and the findings.
pub fn fit(fitted: &Fitted, machine: &Machine, control: &Control, trace: &[TraceLine], files: &[Source]) -> Value {
    let name = escaped(&machine.name);
    let is_error = |severity: Severity| severity == Severity::Error;
    let errors = fitted.findings.iter().filter(|found| is_error(found.code.row().severity)).count();
    let all = fitted.findings.len();
    let some = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let (kind, text) = match (errors, all) {
        (0, 0) if fitted.refused.is_some() => ("warn", format!("can't be run to its end for {name}")),
        (0, 0) => ("ok", format!("fits {name}")),
        (0, warnings) => ("warn", format!("fits {name}, {}", some(warnings, "warning"))),
        (errors, _) => ("bad", format!("does not fit {name}: {}", some(errors, "error"))),
    };
    let mut more = fitted.fit.sentences(machine, control);
    let mut text = text;
    if let Ok(times) = &fitted.times {
        text += &format!(" · {}", clock(times.whole() / 60.0));
        more.insert(0, format!("time {}", times.sentence()));
    }
    more.extend(fitted.fit.not_checked.iter().map(|what| format!("not checked: {}", escaped(what))));
    let findings: Vec<Value> = fitted
        .findings
        .iter()
        .map(|found| {
            let mut said = finding(found, trace, files);
            said["severity"] = json!(found.code.row().severity.name());
            said
        })
        .collect();
    json!({ "kind": kind, "text": text, "more": more, "findings": findings })
}

/// The lines of the blocks in the order in which they ran. For each block, the seconds from the beginning of the
/// program to the end of the block on the machine.
pub fn times(scene: &mut Scene, blocks: &[BlockTime]) {
    let mut end = 0.0;
    let ends = blocks.iter().map(|block| {
        end += f64::from(block.seconds);
        (end as f32).to_le_bytes()
    });
    scene.section("timedLine".into(), blocks.iter().map(|block| block.line.to_le_bytes()));
    scene.section("timedEnd".into(), ends);
}

/// A scene that reports that the machine's file can't be read.
pub fn no_machine(why: &str) -> Scene {
    behind("fit", json!({ "kind": "bad", "text": why, "more": [], "findings": [] }))
}
