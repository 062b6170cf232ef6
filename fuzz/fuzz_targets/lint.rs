//! Whatever becomes of a form: it is read, looked at, mended and laid out, and nothing panics.
//!
//! `fuzz/run 1800` mutates the forms that ship for half an hour (see CONTRIBUTING.md).
#![no_main]

use libfuzzer_sys::fuzz_target;
use postform::fmt::format;
use postform::lint::{Levels, edited, edits_of, fixes_of, lint};
use postform::sema::{Checked, Limits, analyse};
use postform::source::Source;

fn checked(bytes: &[u8]) -> Checked {
    analyse(Source::from_bytes("form.pf", bytes), Limits::Classic, &mut |_| Err("can't be found".into()))
}

fuzz_target!(|bytes: &[u8]| {
    let form = checked(bytes);
    let text = &form.files[0].text;
    let findings = lint(&form, &Levels::default());
    for label in findings.diags.iter().flat_map(|diag| &diag.labels) {
        assert!(text.get(label.span.range()).is_some(), "a place outside the text");
    }
    let fixes = fixes_of(&findings.diags, true);
    if !fixes.is_empty() {
        // what a fix makes of it is looked at, too
        lint(&checked(edited(text, &edits_of(&fixes, 0)).as_bytes()), &Levels::default());
    }
    let once = format(&form.files[0]);
    assert_eq!(format(&Source::from_text("form.pf", once.as_str())), once, "the layout is not stable");
});
