//! Programs with recorded results of LinuxCNC 2.9's interpreter. The simulator must make the same motions, and stop at
//! the same refused block.

use crate::support::{control, root};
use std::fs;
use std::io::Cursor;

use crate::support::nc::{difference, interpreted, simulated};
use postform::internals::nc::{RunSettings, Simulator};
use serde_json::Value;

/// The first difference in a program, if there is one.
fn compare(program: &str, canon: &str) -> Option<String> {
    let settings = RunSettings::new(control("linuxcnc"));
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

/// The cases of a file, each with its difference.
fn cases(file: &str) -> Vec<(Value, Option<String>)> {
    let path = root().join("tests/data").join(file);
    let cases: Vec<Value> = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let compared = |case: Value| {
        let canon: Vec<&str> = case["calls"].as_array().unwrap().iter().map(|call| call.as_str().unwrap()).collect();
        let problem = compare(case["program"].as_str().unwrap(), &canon.join("\n"));
        (case, problem)
    };
    cases.into_iter().map(compared).collect()
}

/// The recorded programs of this repository; each tests one rule.
#[test]
fn every_rule_has_its_case() {
    let cases = cases("nc.json");
    let mut wrong = Vec::new();
    for (case, problem) in &cases {
        let text = |key: &str| case[key].as_str().unwrap();
        // the simulator tracks the state of the compensation, but does not offset the path
        let offset = text("name").starts_with("comp_");
        if let Some(problem) = problem.as_ref().filter(|problem| !(offset && problem.starts_with("call"))) {
            wrong.push(format!("{} ({}): {problem}", text("name"), text("pins")));
        }
    }
    assert!(wrong.is_empty(), "{} of {}\n{}", wrong.len(), cases.len(), wrong.join("\n"));
    assert!(cases.len() > 140);
}

/// Warnings about code that the control runs, but that may surprise a machinist.
#[test]
fn surprises_are_warned_of() {
    let warned = |program: &str| -> Vec<String> {
        let mut simulator = Simulator::new(Cursor::new(program), RunSettings::new(control("linuxcnc")));
        while let Ok(true) = simulator.step(&mut Vec::new()) {}
        simulator.take_warnings().iter().map(|diag| diag.code.name().to_owned()).collect()
    };
    let start = "G21 G17 G90 M3 F100\nG0 Z10\n";
    let cases = [
        ("G81 X1 Z-5 R2\nG91 X1\n", "PN030"),
        ("G99 G81 X1 Z-5 R2\nG98 X2\n", "PN031"),
        ("G83 X1 Z-1 R0 Q0.1\n", "PN032"),
        ("G4 P1 G82 X1 Z-5 R2\n", "PN033"),
        ("G88 X1 Z-5 R2 P0\n", "PN034"),
    ];
    for (blocks, code) in cases {
        assert!(warned(&format!("{start}{blocks}M2\n")).contains(&code.to_owned()), "{blocks}");
    }
    // a warning has the first block that causes it, and help
    let text = format!("{start}G83 X1 Z-1 R0 Q0.1\nX2\nG80\nG0 X9\nM2\n");
    let mut simulator = Simulator::new(Cursor::new(text), RunSettings::new(control("linuxcnc")));
    while let Ok(true) = simulator.step(&mut Vec::new()) {}
    let warnings = simulator.take_warnings();
    let [warning] = warnings.as_slice() else { panic!("{warnings:?}") };
    assert!(warning.message.contains("G83 X1 Z-1"), "{}", warning.message);
    assert_eq!(warning.place.as_ref().and_then(|place| place.line), Some(3));
    assert!(warning.help.as_deref().unwrap_or_default().contains("--back-off"), "{:?}", warning.help);
    assert_eq!(warned(&format!("{start}G98 G81 X1 Z-5 R2\nX2\nG80\nM2\n")), Vec::<String>::new());
}

#[test]
fn random_programs_agree() {
    let cases = cases("nc-random.json");
    let wrong: Vec<String> =
        cases.iter().filter_map(|(case, problem)| Some(format!("{}: {}", case["name"], problem.as_ref()?))).collect();
    assert!(wrong.is_empty(), "{} of {}\n{}", wrong.len(), cases.len(), wrong.join("\n"));
    assert!(cases.len() > 200);
}
