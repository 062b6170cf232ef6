//! Tests the files under `editors/`: the highlighting covers every name, and the versions agree.

use std::fs;
use std::process::Command;

use postform::internals::lang::{COMMANDS, SEQUENCES};
use serde_json::Value;

use crate::support::root;

/// Runs a script that tests the configuration on an editor's page, with this build's postform.
fn tried(script: &str) {
    let ran = Command::new(root().join("editors").join(script)).arg(env!("CARGO_BIN_EXE_postform")).output().unwrap();
    let said = String::from_utf8_lossy(&[ran.stdout, ran.stderr].concat()).into_owned();
    assert!(ran.status.success() && said.contains(": all of it"), "{said}");
}

#[test_with::executable(nvim)]
#[test]
fn the_page_of_neovim_is_tried_in_neovim() {
    tried("neovim-test");
}

#[test_with::executable(emacs)]
#[test]
fn the_page_of_emacs_is_tried_in_emacs() {
    tried("emacs-test");
}

fn json(name: &str) -> Value {
    serde_json::from_str(&fs::read_to_string(root().join("editors/vscode").join(name)).unwrap()).unwrap()
}

#[test]
fn the_grammar_of_forms_knows_every_sequence_and_takes_no_command_for_one() {
    let grammar = json("syntaxes/postform.tmLanguage.json");
    let begin = grammar["repository"]["sequence"]["begin"].as_str().unwrap();
    let names = &begin[begin.find("(Chip Break|").unwrap() + 1..];
    let mut names: Vec<&str> = names[..names.find(')').unwrap()].split('|').collect();
    names.sort_unstable();
    let mut known: Vec<&str> = SEQUENCES.iter().map(|row| row.name).chain(["Chip Break"]).collect();
    known.sort_unstable();
    assert_eq!(names, known, "editors/vscode/syntaxes/postform.tmLanguage.json against the table of sequences");
    for command in COMMANDS {
        assert!(!names.contains(&command.name), "{}", command.name);
    }
}

#[test]
fn the_extension_has_the_version_and_the_licence_of_the_program() {
    assert_eq!(json("package.json")["version"], env!("CARGO_PKG_VERSION"));
    let read = |name: &str| fs::read_to_string(root().join(name)).unwrap();
    assert_eq!(read("editors/vscode/LICENSE"), read("LICENSE"));
}

#[test]
fn pages_of_editors_name_the_server_as_it_is_started() {
    for page in ["neovim", "helix", "emacs", "kate"] {
        let text = fs::read_to_string(root().join(format!("editors/{page}.md"))).unwrap();
        assert!(text.contains("\"lsp\""), "{page}");
    }
}
