//! Command lines with their output: those of the README, of docs/ and of `tests/cmd/`. After an intended change,
//! `TRYCMD=overwrite cargo test transcripts::` writes the outputs again; check the difference.

use std::fs;
use std::process::Command;

use crate::support::root;

#[test]
fn transcripts() {
    // commands in documents are run at the top of the repository; no other test uses a relative path
    std::env::set_current_dir(root()).unwrap();
    trycmd::TestCases::new().case("README.md").case("docs/*.md").case("docs/sources/*.md").case("tests/cmd/*.trycmd");
}

/// The README's commands for a new machine: the first one renders, the second one is run by CI.
#[test]
fn the_two_commands() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let block = readme.split("```sh\n").nth(1).unwrap().split("```").next().unwrap();
    let commands: Vec<&str> = block.lines().collect();
    assert_eq!(commands.len(), 2);
    let arguments = commands[0].strip_prefix("cargo run --release -- ").unwrap();
    let output =
        Command::new(env!("CARGO_BIN_EXE_postform")).args(arguments.split(' ')).current_dir(root()).output().unwrap();
    assert!(output.status.success());
    let expected = fs::read(root().join("samples/bracket/expected.fanuc.nc")).unwrap();
    assert!(output.stdout == expected, "the README's first command prints the bracket for Fanuc");
    let ci = fs::read_to_string(root().join(".ci/run")).unwrap();
    assert!(ci.lines().any(|line| line.trim() == commands[1]), "CI runs `{}`", commands[1]);
}

/// Each error of a cycle has a section in docs/cycles.md, which `postform explain` prints.
#[test]
fn every_problem_of_a_cycle_is_explained() {
    let page = fs::read_to_string(root().join("docs/cycles.md")).unwrap();
    let rows = postform::diag::CODES.iter().filter(|row| row.name.starts_with("PC"));
    for row in rows {
        let head = format!("\n### {} {}\n", row.name, row.code.key());
        let section = page.split_once(&head).unwrap_or_else(|| panic!("docs/cycles.md has no {head}")).1;
        let section = section.split("\n### ").next().unwrap();
        assert!(section.contains("*Instead:*") || section.contains("*Better:*"), "{} says nothing to do", row.name);
    }
}

/// Each problem of a program and each finding of verify has a section, too, with the title in the table of codes.
#[test]
fn every_problem_of_a_program_is_explained() {
    for (file, family) in [("docs/programs.md", "PN"), ("docs/verify.md", "PV"), ("docs/machine.md", "PM")] {
        let page = fs::read_to_string(root().join(file)).unwrap();
        for row in postform::diag::CODES.iter().filter(|row| row.name.starts_with(family)) {
            let head = format!("\n### {} {}\n", row.name, row.title);
            let section = page.split_once(&head).unwrap_or_else(|| panic!("{file} has no {head}")).1;
            assert!(section.split("\n### ").next().unwrap().contains("*Instead:* "), "{} says nothing to do", row.name);
        }
        let sections = page.matches(&format!("\n### {family}")).count();
        assert_eq!(sections, postform::diag::CODES.iter().filter(|row| row.name.starts_with(family)).count());
    }
}

/// The published schema is up to date with the types, and the sample jobs match it.
#[test]
fn the_job_schema_is_current() {
    let made = format!("{:#}\n", postform::internals::json::schema());
    let path = root().join("docs/job.schema.json");
    if std::env::var("SAMPLES").is_ok_and(|v| v == "overwrite") {
        fs::write(&path, &made).unwrap();
    }
    assert!(fs::read_to_string(path).unwrap() == made, "the types that read jobs make another schema");
    let output = Command::new(env!("CARGO_BIN_EXE_postform")).args(["check", "--schema"]).output().unwrap();
    assert!(output.stdout == made.as_bytes(), "`postform check --schema` prints another schema");
}
