//! Writes a job as text in its format: a document, JSON Lines, a CL file, a program.

use std::fmt::Write;

use postform::Format;
use serde_json::{Value, json};

use crate::cl::cl;

/// The file name extension for jobs of this format.
pub fn ending(format: Format) -> &'static str {
    match format {
        Format::Cl => "cl",
        Format::Nc => "nc",
        Format::Freecad => "commands",
        Format::JsonLines => "jsonl",
        _ => "json",
    }
}

/// The job in this format. For a CL file, only the parts that CL can express are written ([`crate::cl::for_cl`]).
pub fn written(job: &Value, format: Format) -> String {
    let lines_of = |job: &Value| {
        list(job, "lines").iter().filter_map(Value::as_str).fold(String::new(), |text, line| text + line + "\n")
    };
    match format {
        Format::Cl if job.get("lines").is_some() => {
            let units = if job["units"] == json!("mm") { "MM" } else { "INCHES" };
            format!("PARTNO/7\nUNITS/{units}\n{}FINI\n", lines_of(job))
        }
        Format::Nc => lines_of(job),
        // the paths as lists of commands, for display
        Format::Freecad => list(job, "operations")
            .iter()
            .map(|operation| format!("{}:\n{}", operation["name"], lines_of(operation)))
            .collect(),
        Format::Cl => cl(job),
        Format::JsonLines => lines(job),
        _ => job.to_string(),
    }
}

pub(crate) fn list<'v>(value: &'v Value, key: &str) -> &'v [Value] {
    value.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

fn without(value: &Value, keys: &[&str]) -> Value {
    let mut value = value.clone();
    if let Some(object) = value.as_object_mut() {
        object.retain(|key, _| !keys.contains(&key.as_str()));
    }
    value
}

fn lines(job: &Value) -> String {
    let mut text = format!("{}\n", json!({ "start": without(job, &["subprograms", "operations"]) }));
    let put = |text: &mut String, value: &Value| _ = writeln!(text, "{value}");
    for sub in list(job, "subprograms") {
        put(&mut text, &json!({ "subprogram": without(sub, &["path"]) }));
        list(sub, "path").iter().for_each(|item| put(&mut text, item));
        put(&mut text, &json!({ "subprogram_end": true }));
    }
    for operation in list(job, "operations") {
        put(&mut text, &json!({ "operation": without(operation, &["path"]) }));
        for item in list(operation, "path") {
            // sometimes a cycle with three points is split in two
            match item.get("cycle").filter(|cycle| list(cycle, "points").len() == 3) {
                Some(cycle) => {
                    put(&mut text, &json!({ "cycle": without(cycle, &["points"]) }));
                    list(cycle, "points").iter().for_each(|point| put(&mut text, &json!({ "point": point })));
                    put(&mut text, &json!({ "cycle_end": true }));
                }
                None => put(&mut text, item),
            }
        }
    }
    text + "{\"end\":true}\n"
}
