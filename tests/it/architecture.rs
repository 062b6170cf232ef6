//! Imports point one way: the `use crate::` lines of each module against the table in ARCHITECTURE.md.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::support::root;

/// Rows `| module | what | imports |` of the table.
fn table() -> Vec<(String, BTreeSet<String>)> {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let rows = text.lines().skip_while(|line| !line.starts_with("| module |")).skip(2);
    rows.take_while(|line| line.starts_with('|'))
        .map(|line| {
            let cells: Vec<&str> = line.split('|').map(str::trim).collect();
            let imports = cells[3].split(' ').filter(|i| !i.is_empty() && *i != "-").map(str::to_owned);
            (cells[1].trim_matches('`').to_owned(), imports.collect())
        })
        .collect()
}

fn files(path: &Path, found: &mut Vec<std::path::PathBuf>) {
    if path.is_dir() {
        for entry in fs::read_dir(path).unwrap() {
            files(&entry.unwrap().path(), found);
        }
    } else {
        found.push(path.to_path_buf());
    }
}

#[test]
fn imports_are_those_of_the_table() {
    let table = table();
    assert!(table.len() > 10, "the table of ARCHITECTURE.md");
    let names: Vec<&str> = table.iter().map(|(name, _)| name.as_str()).collect();
    let mut sources = Vec::new();
    files(&root().join("src"), &mut sources);
    for path in sources {
        let relative = path.strip_prefix(root().join("src")).unwrap().to_string_lossy().into_owned();
        let module = relative.split(['/', '.']).next().unwrap();
        if ["lib", "main", "cli"].contains(&module) {
            continue;
        }
        let Some((_, allowed)) = table.iter().find(|(name, _)| name == module) else {
            panic!("{module} is not in the table of ARCHITECTURE.md");
        };
        let text = fs::read_to_string(&path).unwrap();
        for (at, _) in text.match_indices("crate::") {
            let target = text[at + 7..].split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap();
            if target != module && names.contains(&target) {
                assert!(allowed.contains(target), "{relative} imports {target}, the table does not let {module} do so");
            }
        }
    }
    // one way: a module imports only rows above its own
    for (i, (name, imports)) in table.iter().enumerate() {
        for import in imports {
            assert!(names[..i].contains(&import.as_str()), "{name} imports {import}, which is not above it");
        }
    }
}

#[test]
fn only_the_parser_knows_the_grammar() {
    let mut sources = Vec::new();
    files(&root().join("src"), &mut sources);
    for path in sources {
        let text = fs::read_to_string(&path).unwrap();
        if (text.contains("pest::") || text.contains("pest_derive")) && !path.ends_with("syntax/parse.rs") {
            panic!("{} knows of the grammar crate", path.display());
        }
    }
}
