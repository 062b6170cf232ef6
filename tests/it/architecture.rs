//! Checks that imports go in one direction. The `crate::` paths of each module must agree with the table in
//! ARCHITECTURE.md. A circle of imports between the files of a module contains at most two files. Checks that no source
//! file is longer than 500 lines.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::support::root;

/// The rows of the table `| module | contents | imports |`.
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

/// Each row of `allowed!` is a difference that the proof accepts. The row names the one file that counts these differences.
#[test]
fn an_allowance_is_decided_in_one_file() {
    let table = fs::read_to_string(root().join("src/verify/verdict.rs")).unwrap();
    let (_, rows) = table.split_once("\nallowed! {\n").unwrap();
    let rows = rows.split_once("\n}").unwrap().0.lines();
    let named: BTreeSet<(String, String)> = rows
        .map(|row| (row.trim().split(' ').next().unwrap().to_owned(), row.split('"').nth(5).unwrap().to_owned()))
        .collect();
    let mut sources = Vec::new();
    files(&root().join("src/verify"), &mut sources);
    let mut counted = BTreeSet::new();
    for path in sources {
        let text = fs::read_to_string(&path).unwrap();
        let places = text.split("allowed.").skip(1).filter_map(|rest| rest.split_once(" += "));
        let file = path.file_name().unwrap().to_string_lossy();
        counted.extend(
            places.filter(|(name, _)| !name.contains(' ')).map(|(name, _)| (name.to_owned(), file.to_string())),
        );
    }
    assert!(named.len() > 10, "{named:?}");
    assert_eq!(named, counted);
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
        if ["lib"].contains(&module) {
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
    // a module imports only modules from the rows above its own row
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
        let may = ["grammar", "parse", "expression"].iter().any(|name| path.ends_with(format!("syntax/{name}.rs")));
        if (text.contains("pest::") || text.contains("pest_derive")) && !may {
            panic!("{} knows of the grammar crate", path.display());
        }
    }
}

/// The paths in a file: those of its `use` lines, with braces expanded, and those in its code.
fn paths(text: &str) -> Vec<String> {
    fn open(tree: &str, before: &str, found: &mut Vec<String>) {
        let Some((head, rest)) = tree.split_once('{') else {
            let name = tree.split(" as ").next().unwrap().trim();
            return found.push(format!("{before}{name}"));
        };
        let before = format!("{before}{}", head.trim());
        let inside = rest.trim_end().strip_suffix('}').unwrap();
        let (mut depth, mut start) = (0, 0);
        for (i, c) in inside.char_indices().chain([(inside.len(), ',')]) {
            depth += i32::from(c == '{') - i32::from(c == '}');
            if c == ',' && depth == 0 {
                open(inside[start..i].trim(), &before, found);
                start = i + 1;
            }
        }
    }
    let mut found = Vec::new();
    let code: Vec<&str> = text.lines().map(|line| line.split("//").next().unwrap().trim()).collect();
    for statement in code.join("\n").split(';') {
        let mut before = statement;
        for (at, line) in
            statement.split('\n').scan(0, |at, line| Some((std::mem::replace(at, *at + line.len() + 1), line)))
        {
            let line = line.strip_prefix("pub").map_or(line, |rest| rest.split_once(' ').map_or("", |(_, rest)| rest));
            if line.starts_with("use ") {
                let tree = &statement[at..];
                open(&tree[tree.find("use ").unwrap() + 4..].replace('\n', " "), "", &mut found);
                before = &statement[..at];
                break;
            }
        }
        let words = before.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
        found
            .extend(words.filter(|word| word.starts_with("crate::") || word.starts_with("super::")).map(str::to_owned));
    }
    found
}

/// The files that each file of a module imports. The name of a file is its path in the module, such as `moves/arc`. The
/// module's own `mod.rs` only declares the other files, so it is left out.
fn imports(module: &str) -> BTreeMap<String, BTreeSet<String>> {
    let folder = root().join("src").join(module);
    let mut sources = Vec::new();
    files(&folder, &mut sources);
    let texts: BTreeMap<String, String> = sources
        .iter()
        .map(|path| {
            let name = path.strip_prefix(&folder).unwrap().with_extension("").to_string_lossy().replace('\\', "/");
            (name.strip_suffix("/mod").unwrap_or(&name).to_owned(), fs::read_to_string(path).unwrap())
        })
        .filter(|(name, _)| name != "mod")
        .collect();
    let of = |name: &String, text: &String| {
        let mut found = BTreeSet::new();
        // tests inside a file refer to the file as `super`
        for path in paths(text).iter().filter(|path| *path != "super::*") {
            let mut steps: Vec<&str> = path.split("::").map(str::trim).collect();
            let mut place: Vec<&str> = name.split('/').collect();
            match steps[0] {
                "crate" if steps.get(1) == Some(&module) => {
                    place.clear();
                    steps.drain(..2);
                }
                "super" => {
                    while steps.first() == Some(&"super") {
                        place.pop();
                        steps.remove(0);
                    }
                }
                // a path without a prefix leads to a file below the importing file
                _ => {}
            }
            place.extend(steps);
            // the longest part of the path that is a file
            let file = (1..=place.len()).rev().map(|n| place[..n].join("/")).find(|file| texts.contains_key(file));
            found.extend(file.filter(|file| file != name));
        }
        found
    };
    texts.iter().map(|(name, text)| (name.clone(), of(name, text))).collect()
}

/// Files that import one another, directly or through other files.
fn circles(imports: &BTreeMap<String, BTreeSet<String>>) -> BTreeSet<Vec<String>> {
    let reached = |from: &String| {
        let (mut found, mut open) = (BTreeSet::new(), vec![from]);
        while let Some(file) = open.pop() {
            open.extend(imports[file].iter().filter(|next| found.insert((*next).clone())));
        }
        found
    };
    let reach: BTreeMap<&String, BTreeSet<String>> = imports.keys().map(|file| (file, reached(file))).collect();
    let circle = |file: &String| reach[file].iter().filter(|other| reach[other].contains(file)).cloned().collect();
    imports.keys().map(circle).filter(|circle: &Vec<String>| !circle.is_empty()).collect()
}

#[test]
fn circles_are_found() {
    let named =
        paths("use super::{a::{B, C}, d as e};\npub use crate::x::y::*;\nfn f() -> super::g::H { 1 } // super::no");
    assert_eq!(named, ["super::a::B", "super::a::C", "super::d", "crate::x::y::*", "super::g::H"]);
    let graph = [("a", vec!["b"]), ("b", vec!["c"]), ("c", vec!["b", "d"]), ("d", vec![])];
    let graph = graph.map(|(file, to)| (file.to_owned(), to.into_iter().map(str::to_owned).collect()));
    assert_eq!(circles(&graph.into()), [vec!["b".to_owned(), "c".to_owned()]].into());
    assert!(imports("render")["moves/arc"].len() > 3);
}

/// In `src`, a circle of imports contains at most two files, so that a newcomer can read a module from its lowest files
/// up. The command line is not checked.
#[test]
fn files_of_a_module_import_one_way() {
    for entry in fs::read_dir(root().join("src")).unwrap() {
        let path = entry.unwrap().path();
        let module = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            let found: Vec<_> = circles(&imports(&module)).into_iter().filter(|circle| circle.len() > 2).collect();
            assert!(found.is_empty(), "src/{module}: {found:?}: what they share goes into a file below them");
        }
    }
}

#[test]
fn no_file_is_longer_than_can_be_read() {
    let mut sources = Vec::new();
    files(&root().join("src"), &mut sources);
    files(&root().join("crates"), &mut sources);
    for path in sources.iter().filter(|path| path.extension().is_some_and(|extension| extension == "rs")) {
        let lines = fs::read_to_string(path).unwrap().lines().count();
        assert!(lines <= 500, "{} has {lines} lines: give one of its nouns a file", path.display());
    }
}
