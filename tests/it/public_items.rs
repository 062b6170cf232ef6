//! The public items of the library, as a list that is reviewed before it grows.

use std::fs;

use crate::support::root;

/// Maximum number of public items: of the library, and of `internals`, which only this repository uses.
const MOST: [usize; 2] = [95, 30];

/// The public names of a file: `pub use`, and its own items.
fn public(path: &str, text: &str) -> Vec<String> {
    let mut names = Vec::new();
    let mut rest = text;
    while let Some(at) = rest.find("\npub ") {
        rest = &rest[at + "\npub ".len()..];
        let (kind, item) = rest.split_once(' ').unwrap();
        match kind {
            "use" => {
                let (from, what) = item.split_once(';').unwrap().0.split_once("::").unwrap();
                for name in what.trim_matches(['{', '}']).split(',').map(str::trim).filter(|name| !name.is_empty()) {
                    let name = name.rsplit(" as ").next().unwrap();
                    assert!(name != "*" && !name.contains("::"), "{path}: {from}::{what} names its items one by one");
                    names.push(name.to_owned());
                }
            }
            "mod" => {}
            "struct" | "enum" | "trait" | "fn" | "const" | "type" => {
                names.push(item.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap().to_owned());
            }
            other => panic!("{path}: a public `{other}` is not counted yet"),
        }
    }
    names.sort();
    names
}

#[test]
fn public_items_are_those_of_the_list() {
    let read = |path: &str| fs::read_to_string(root().join(path)).unwrap();
    let library = read("src/lib.rs");
    let (front, internals) = library.split_once("#[doc(hidden)]\npub mod internals {").unwrap();
    let mut list = public("src/lib.rs", front);
    for line in front.lines().filter_map(|line| line.strip_prefix("pub mod ")) {
        let module = line.trim_end_matches(';');
        let path = format!("src/{module}/mod.rs");
        list.extend(public(&path, &read(&path)).into_iter().map(|name| format!("{module}::{name}")));
    }
    let hidden = internals.matches("\n    pub mod ").count();
    assert!(list.len() <= MOST[0] && hidden <= MOST[1], "{} items are public, and {hidden} modules hidden", list.len());
    let path = root().join("tests/data/public-items.txt");
    let text = list.join("\n") + "\n";
    if std::env::var_os("SAMPLES").is_some_and(|to| to == "overwrite") {
        fs::write(&path, &text).unwrap();
    }
    let known = fs::read_to_string(&path).unwrap_or_default();
    assert_eq!(text, known, "tests/data/public-items.txt: is each new item for other programs? then `just overwrite`");
}
