//! Runs the tests of the posts inside CAM systems. The tests are in the languages of these posts and do not need the
//! CAM systems.
#![allow(clippy::unwrap_used)]

use std::process::Command;

use crate::support;

/// Runs tests in another language. They find this build's postform in the variable `POSTFORM`.
fn passes(program: &str, arguments: &[&str]) {
    let done = Command::new(program)
        .args(arguments)
        .current_dir(support::root())
        .env("POSTFORM", env!("CARGO_BIN_EXE_postform"))
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&done.stderr).into_owned() + &String::from_utf8_lossy(&done.stdout);
    assert!(done.status.success(), "{said}");
    assert!(said.contains("Ran ") || said.contains("# pass "), "no test ran: {said}");
}

/// Stand-ins replace FreeCAD's objects; they are made from dumps of FreeCAD. `just freecad` runs the post inside
/// FreeCAD.
#[test_with::executable(python3)]
#[test]
fn the_post_for_freecad_prints_what_the_saved_document_gives() {
    passes("python3", &["integrations/freecad/test_postform_post.py"]);
}

/// A stand-in replaces Autodesk's post engine. It has the functions of Autodesk's documentation.
#[test_with::executable(node)]
#[test]
fn the_post_for_fusion_writes_the_job() {
    passes("node", &["--test", "integrations/fusion/"]);
}
