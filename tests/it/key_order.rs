//! The keys of a job may be in any order, because objects in JSON have no order. A key may be written with escapes.

use std::fs;
use std::io::Cursor;

use postform::{Format, Job, NoFiles, Options, Post, Source};
use proptest::prelude::*;
use serde_json::Value;

use crate::program_commands::{fed, postform, text};
use crate::support::{root, samples};

/// A key as text. By the next number, its first letter is an escape.
fn key_text(key: &str, by: &mut impl Iterator<Item = usize>) -> String {
    match key.chars().next() {
        Some(first) if by.next().is_some_and(|number| number % 3 == 0) => {
            format!("\"\\u{:04x}{}\"", u32::from(first), &key[first.len_utf8()..])
        }
        _ => Value::from(key).to_string(),
    }
}

/// A value as text. The keys of each object are rotated by the next number.
fn turned(value: &Value, by: &mut impl Iterator<Item = usize>) -> String {
    match value {
        Value::Object(map) => {
            let mut rows: Vec<String> =
                map.iter().map(|(key, value)| format!("{}:{}", key_text(key, by), turned(value, by))).collect();
            if !rows.is_empty() {
                let count = by.next().unwrap_or(0) % rows.len();
                rows.rotate_left(count);
            }
            format!("{{{}}}", rows.join(",\n"))
        }
        Value::Array(list) => {
            format!("[{}]", list.iter().map(|value| turned(value, by)).collect::<Vec<_>>().join(", "))
        }
        other => other.to_string(),
    }
}

fn printed(post: &Post, job: Job<'_>) -> String {
    let mut options = Options::default();
    options.proof = None;
    options.program = Some(7);
    match post.render(job, &options) {
        Ok(program) => program.into_text(),
        Err(error) => {
            error.findings().diags.iter().map(|diag| format!("{} {}\n", diag.code.name(), diag.message)).collect()
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2))]

    /// The job of every sample prints the same program in any order of keys.
    #[test]
    fn order_and_escapes_of_keys_change_no_program(by in proptest::collection::vec(0usize..12, 1..40)) {
        let form = fs::read_to_string(root().join("postforms/fanuc.pf")).unwrap();
        let post = Post::compile(Source::from_text("fanuc.pf", form), &NoFiles).unwrap();
        for folder in samples() {
            let Ok(whole) = fs::read_to_string(folder.join("job.json")) else { continue };
            let value: Value = serde_json::from_str(&whole).unwrap();
            let mut numbers = by.iter().copied().cycle();
            let other = turned(&value, &mut numbers);
            let usual = printed(&post, Job::json(&whole));
            prop_assert_eq!(&printed(&post, Job::json(&other)), &usual, "{}\n{}", folder.display(), other);
            prop_assert_eq!(&printed(&post, Job::file(Format::Json, Cursor::new(other.as_bytes()))), &usual);
        }
    }
}

#[test]
fn an_error_has_its_place_in_the_text_as_it_stands() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("job.json");
    let job = "{\n \"operations\": [\n  {\"path\": [{\"rapid\": [0, 0, 9]},\n   {\"line\": [0, 0, \"x\"]}],\n   \"tool\": 1}],\n \"postform\": 1,\n \"units\": \"mm\",\n \"tools\": [{\"number\": 1}]\n}\n";
    fs::write(&file, job).unwrap();
    let said = text(&postform(&["check", file.to_str().unwrap()]).stderr);
    assert!(said.contains("job.json:4:") && said.contains("operations[0].path[1].line"), "{said}");
    // text after the end of the job is an error in any order of keys
    for after in ["{\"postform\": 1}", " x", "}", ","] {
        fs::write(&file, job.replace("\"x\"", "1") + after).unwrap();
        let said = text(&postform(&["check", file.to_str().unwrap()]).stderr);
        assert!(said.contains("PJ008"), "{after}: {said}");
    }
    // a truncated job gives the same error as in the usual order
    for length in (0..job.len() - 2).step_by(3) {
        fs::write(&file, &job[..length]).unwrap();
        let output = postform(&["check", file.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(1), "{}", &job[..length]);
        let said = text(&output.stderr);
        // the order of keys is known only after the first list of the job
        let is_named = said.contains("PJ007") || length < 90 && said.starts_with("PJ");
        assert!(is_named, "{}: {said}", &job[..length]);
    }
}

/// The reader can't go back in a stream, so the error names the key that comes too late.
#[test]
fn a_stream_says_which_key_comes_too_late() {
    let arguments =
        ["render", "-", "--from", "json", "--form", "postforms/linuxcnc.pf", "--set", "header=off", "--stream"];
    let feed = |job: &str| text(&fed(&arguments, job.as_bytes()).stderr);
    let said = feed(
        r#"{"postform": 1, "program": 1, "units": "inch", "operations": [{"tool": 1, "path": [{"rapid": [0, 0, 1]}]}], "tools": [{"number": 1}]}"#,
    );
    assert!(said.contains("list the tools under \"tools\", before the operations"), "{said}");
}

/// Only 4,096 points of a cycle are kept until its other keys are read, also for a file.
#[test]
fn a_key_after_many_points_is_named() {
    let render = |points: usize, before: &str, after: &str| {
        let list = vec!["[1, 1, 0]"; points].join(", ");
        let cycle = format!(r#"{{{before}"depth": 5, "clear": 2, "feed": 200, "points": [{list}]{after}}}"#);
        let job = format!(
            r#"{{"postform": 1, "units": "mm", "tools": [{{"number": 1}}], "operations": [{{"tool": 1, "work": 54,
            "spindle": {{"speed": 900, "direction": "cw"}}, "path": [{{"rapid": [0, 0, 5]}}, {{"cycle": {cycle}}}]}}]}}"#
        );
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("job.json");
        fs::write(&file, job).unwrap();
        text(&postform(&["check", file.to_str().unwrap()]).stderr)
    };
    assert_eq!(render(4000, "", r#", "kind": "drill""#), "");
    assert_eq!(render(5000, r#""kind": "drill", "#, ""), "");
    for (before, after, key) in
        [("", r#", "kind": "drill""#, "kind"), (r#""kind": "drill", "#, r#", "return": 9"#, "return")]
    {
        let said = render(5000, before, after);
        assert!(said.contains(&format!("`{key}` does not come before the `points`")), "{said}");
        assert!(said.contains("make `points` the last key of the cycle"), "{said}");
    }
}
