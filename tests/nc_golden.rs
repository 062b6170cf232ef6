//! Programs and what LinuxCNC's interpreter makes of them: the same motions, the same refusals at the same block.
#![allow(missing_docs)]

#[path = "support/nc.rs"]
mod nc;

use std::fs;
use std::path::PathBuf;

use nc::{difference, interpreted, simulated};
use postform::nc::{Control, Settings};

fn golden() -> Option<PathBuf> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/golden/nc");
    if path.is_dir() {
        return Some(path);
    }
    eprintln!("skipped: the recorded programs are not beside this checkout");
    None
}

/// What is wrong with one program, if anything.
fn compare(program: &str, canon: &str) -> Option<String> {
    let settings = Settings::new(Control::Linuxcnc);
    let (ours, ended, _) = simulated(program.as_bytes(), settings);
    let refused = canon.lines().find_map(|line| line.strip_prefix("!error "));
    match (refused, ended) {
        (None, Err(line)) => return Some(format!("refused at line {line}")),
        (Some(error), Ok(())) => return Some(format!("not refused: {error}")),
        (Some(error), Err(line)) => {
            let block = canon.lines().find_map(|line| line.strip_prefix("!block ")).unwrap_or("");
            let found = program.lines().nth(line as usize - 1).unwrap_or("").trim();
            if found != block.trim() && !block.is_empty() {
                return Some(format!("refused `{found}` instead of `{block}`: {error}"));
            }
        }
        (None, Ok(())) => {}
    }
    difference(&ours, &interpreted(canon))
}

fn folder(name: &str, leave: &[String]) {
    let Some(golden) = golden() else { return };
    let (mut wrong, mut seen) = (Vec::new(), 0);
    let mut paths: Vec<PathBuf> = fs::read_dir(golden.join(name)).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    for path in paths.iter().filter(|path| path.extension().is_some_and(|e| e == "ngc")) {
        let stem = path.file_stem().unwrap().to_string_lossy().into_owned();
        if leave.contains(&stem) {
            continue;
        }
        seen += 1;
        let program = String::from_utf8_lossy(&fs::read(path).unwrap()).into_owned();
        let canon = fs::read_to_string(path.with_extension("canon")).unwrap();
        let problem = compare(&program, &canon);
        // the path under compensation is tracked, not offset
        if let Some(problem) = problem.filter(|text| !(stem.starts_with("comp_") && text.starts_with("call"))) {
            wrong.push(format!("{stem}: {problem}"));
        }
    }
    assert!(wrong.is_empty(), "{} of {seen}\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn every_rule_has_its_case() {
    let Some(golden) = golden() else { return };
    let manifest = fs::read_to_string(golden.join("MANIFEST.tsv")).unwrap();
    let defects: Vec<String> = manifest
        .lines()
        .filter_map(|line| line.split_once('\t'))
        .filter(|(_, rest)| rest.starts_with("bug\t"))
        .map(|(name, _)| name.to_owned())
        .collect();
    folder("cases", &defects);
}

#[test]
fn random_programs_agree() {
    folder("fuzz", &[]);
}

#[test]
fn examples_of_the_manual_agree() {
    folder("doc", &[]);
}
