//! The checks for every form, even a mutated form. The form is read, linted, fixed and formatted, and its programs must
//! stay the same.

use postform::internals::compile::compile;
use postform::internals::fmt::format;
use postform::internals::json::read_document;
use postform::internals::lint::{Changed, Found, Levels, fix, lint};
use postform::internals::render::{Options, Renderer};
use postform::internals::sema::{Checked, Limits, analyse};
use postform::internals::source::Source;

const JOB: &str = include_str!("../samples/drill-machine/job.json");

/// Checks a form from bytes. The form calls no other form.
fn checked(bytes: &[u8]) -> Checked {
    analyse(Source::from_bytes("form.pf", bytes), Limits::Classic, &mut |_| Err("can't be found".into()))
}

fn found(form: &Checked) -> Found {
    lint(form, &Levels::default())
}

/// The program of a small job, if the form prints one.
fn program(form: &Checked) -> Option<String> {
    if form.has_errors() {
        return None;
    }
    let compiled = compile(&form.form);
    let mut renderer = Renderer::new(&compiled, Options::default());
    read_document(JOB.as_bytes(), &mut renderer).ok()?;
    String::from_utf8(std::mem::take(renderer.text())).ok()
}

/// Applies fixes until none is left; `None`: there were none.
fn after_fixes(form: &Checked, unsafe_too: bool) -> Option<Checked> {
    let text = &form.files[0].text;
    let mut read = |changed: &Changed| checked(changed.get("form.pf").unwrap_or(text).as_bytes());
    let fixed = fix(&Levels::default(), unsafe_too, &mut read);
    let left = fixed.findings.diags.iter().filter_map(|diag| diag.fix.as_ref()).any(|fix| fix.safe || unsafe_too);
    assert!(!left, "fixes without an end");
    (!fixed.made.is_empty()).then_some(fixed.checked)
}

/// Reads and lints a form. `thoroughly`: also fixes and formats it.
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
    if let Some(after) = after_fixes(&form, false) {
        assert_eq!(program(&after), before, "a safe fix changes the program");
    }
    after_fixes(&form, true);
    let once = format(&form.files[0]);
    assert_eq!(format(&Source::from_text("form.pf", once.as_str())), once, "the layout is not stable");
    assert_eq!(program(&checked(once.as_bytes())), before, "the layout changes the program");
}
