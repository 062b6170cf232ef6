//! The worked examples of the POSTFORM manual. The sample of each example must print exactly the expected lines, and
//! print them with the sequence of the example.

use crate::support;
use std::fs;

use crate::support::{check_file, render_sample, root, sample_form};
use serde_json::Value;

fn strings(value: &Value) -> Vec<String> {
    value.as_array().unwrap().iter().map(|s| s.as_str().unwrap().to_owned()).collect()
}

#[test]
fn worked_examples_are_exact() {
    let text = fs::read_to_string(root().join("tests/data/postform.json")).unwrap();
    let cases: Vec<Value> = serde_json::from_str(&text).unwrap();
    let mut seen = 0;
    for case in &cases {
        let id = case["id"].as_str().unwrap();
        let folder = root().join("samples").join(id);
        let form = sample_form(&folder).unwrap_or_else(|| panic!("no sample for {id}"));
        let rendered = render_sample(&folder, &form).unwrap_or_else(|diag| panic!("{id}: {diag:?}"));
        let expected = strings(&case["expected"]);
        let lines: Vec<&str> = rendered.text.lines().collect();
        if case["kind"] == "program" {
            assert_eq!(lines, expected, "{id}");
        } else if strings(&case["sequence"]).len() == 1 {
            // this example is a command, so its lines are in generated blocks
            assert!(lines.windows(expected.len()).any(|found| found == expected), "{id}: {lines:?}");
        } else {
            let from_sequence = lines_of(&case["sequence"], case["kind"] == "cycle", &form, &rendered);
            assert_eq!(from_sequence, expected, "{id}");
        }
        seen += 1;
    }
    assert!(seen == cases.len() && seen > 10, "{seen}");
}

/// The program lines that come from this sequence of the form; for a cycle, also the lines of Cancel.
fn lines_of(sequence: &Value, cycle: bool, form: &std::path::Path, rendered: &support::Rendered) -> Vec<String> {
    let checked = check_file(form);
    let source = &checked.files[0];
    let name = &strings(sequence)[0];
    let first = source.text.lines().position(|l| l == name).unwrap() as u32 + 1;
    let length = strings(sequence).len() as u32;
    let cancel = source.text.lines().position(|l| l == "Cancel").map(|at| at as u32 + 2);
    let lines = rendered.text.lines();
    lines
        .zip(&rendered.trace)
        .filter(|(_, trace)| {
            trace.form.is_some_and(|span| {
                let line = source.line_column(span.start).0;
                (first..first + length).contains(&line) || cycle && Some(line) == cancel
            })
        })
        .map(|(text, _)| text.to_owned())
        .collect()
}
