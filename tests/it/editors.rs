//! Tests the files under `editors/`: the highlighting covers every name, and the versions agree.

use std::fs;
use std::process::Command;

use postform::Format;
use postform::internals::lang::{COMMANDS, SEQUENCES};
use serde_json::{Value, json as value};

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

/// File name extensions in TypeScript, JSON and Markdown are those of the table of formats.
#[test]
fn file_name_extensions_are_those_of_the_table() {
    let of = |formats: &[Format]| -> Vec<String> {
        formats.iter().flat_map(|format| format.extensions()).map(|extension| format!(".{extension}")).collect()
    };
    // the file name extensions between two texts of a file; each extension begins with a point
    let listed = |file: &str, start: &str, end: &str| -> Vec<String> {
        let text = fs::read_to_string(root().join(file)).unwrap();
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let (_, rest) = text.split_once(start).unwrap_or_else(|| panic!("{file} lacks {start}"));
        let list = rest.split_once(end).unwrap().0;
        let names = list.split(|c: char| !c.is_ascii_lowercase()).filter(|name| !["", "or"].contains(name));
        names.map(|name| format!(".{name}")).collect()
    };
    let programs = of(&[Format::Nc]);
    let all = of(&Format::ALL);
    assert_eq!(listed("page/src/opening.ts", "JOBS =", ";"), [all, vec![".gz".into()]].concat());
    assert_eq!(listed("page/src/opening.ts", "PROGRAMS = ", "$"), programs);
    assert_eq!(listed("docs/programs.md", "program if its extension is", "The canned"), programs);
    assert_eq!(listed("docs/cl.md", "CAM systems: `", "`"), of(&[Format::Cl]));
    // VS Code has a language for programs, and FreeCAD documents are not text
    let texts = of(&[Format::Json, Format::JsonLines, Format::Cl, Format::Nci]);
    assert_eq!(listed("editors/vscode/src/extension.ts", "**/*.{", "}"), texts);
    // .h and .i are also the extensions of C files
    let of_no_other_language: Vec<String> = programs.into_iter().filter(|name| name != ".h" && name != ".i").collect();
    assert_eq!(json("package.json")["contributes"]["languages"][1]["extensions"], value!(of_no_other_language));
}

#[test]
fn pages_of_editors_name_the_server_as_it_is_started() {
    for page in ["neovim", "helix", "emacs", "kate"] {
        let text = fs::read_to_string(root().join(format!("editors/{page}.md"))).unwrap();
        assert!(text.contains("\"lsp\""), "{page}");
    }
}
