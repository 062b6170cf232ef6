//! What is asked of every form, whatever it is: it is read, looked at, mended and laid out, and its programs stay the same.

use postform::compile::compile;
use postform::fmt::format;
use postform::lint::{Findings, Levels, edited, edits_of, fixes_of, lint};
use postform::render::{Options, Renderer};
use postform::sema::{Checked, Limits, analyse};
use postform::source::Source;
use postform::toolpath::json::read_document;

const JOB: &str = include_str!("../samples/drill-machine/job.json");

/// A form from bytes; it calls no other.
fn checked(bytes: &[u8]) -> Checked {
    analyse(Source::from_bytes("form.pf", bytes), Limits::Classic, &mut |_| Err("can't be found".into()))
}

fn found(form: &Checked) -> Findings {
    lint(form, &Levels::default())
}

/// The program of a small job, or nothing.
fn program(form: &Checked) -> Option<String> {
    if form.has_errors() {
        return None;
    }
    let compiled = compile(&form.form);
    let mut renderer = Renderer::new(&compiled, Options::default());
    read_document(JOB.as_bytes(), &mut renderer).ok()?;
    String::from_utf8(std::mem::take(renderer.text())).ok()
}

/// Fixes made until there are none.
fn mended(form: &Checked, unsafe_too: bool) -> Option<Checked> {
    let mut current: Option<Checked> = None;
    for _ in 0..100 {
        let form = current.as_ref().unwrap_or(form);
        let findings = found(form);
        let fixes = fixes_of(&findings.diags, unsafe_too);
        if fixes.is_empty() {
            return current;
        }
        let text = edited(&form.files[0].text, &edits_of(&fixes, 0));
        current = Some(checked(text.as_bytes()));
    }
    panic!("fixes without an end");
}

/// Reads a form and looks at it; thoroughly: mends it and lays it out, too.
pub fn look(bytes: &[u8], thoroughly: bool) {
    let form = checked(bytes);
    let text = &form.files[0].text;
    for label in found(&form).diags.iter().flat_map(|diag| &diag.labels) {
        assert!(text.get(label.span.range()).is_some(), "a place outside the text");
    }
    if !thoroughly {
        return;
    }
    let before = program(&form);
    if let Some(after) = mended(&form, false) {
        assert_eq!(program(&after), before, "a safe fix changes the program");
    }
    mended(&form, true);
    let once = format(&form.files[0]);
    assert_eq!(format(&Source::from_text("form.pf", once.as_str())), once, "the layout is not stable");
    assert_eq!(program(&checked(once.as_bytes())), before, "the layout changes the program");
}
