//! The LinuxCNC post through the interpreter of LinuxCNC itself, run as a separate program where it is installed.
#![allow(missing_docs)]

mod support;

use std::fs;
use std::path::Path;
use std::process::Command;

use support::root;

/// What the interpreter makes of a program: its canonical calls, or its error.
fn interpreted(program: &Path, tools: &str) -> Option<String> {
    let table = Path::new(env!("CARGO_TARGET_TMPDIR")).join("tools.tbl");
    fs::write(&table, tools).unwrap();
    match Command::new("rs274").arg("-t").arg(&table).arg("-g").arg(program).output() {
        Ok(output) => {
            Some(String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr))
        }
        Err(_) => {
            eprintln!("skipped: rs274 is not installed");
            None
        }
    }
}

#[test]
fn the_bracket_runs_to_its_end() {
    let program = root().join("samples/bracket/expected.linuxcnc.nc");
    let tools: String = [1, 2, 3, 4, 5, 11].map(|n| format!("T{n} P{n} Z0 D0.5\n")).concat();
    let Some(calls) = interpreted(&program, &tools) else { return };
    assert!(calls.contains("PROGRAM_END()"), "{}", calls.lines().rev().take(4).collect::<Vec<_>>().join("\n"));
    // every hole of the job is fed to its bottom
    let fed = |x: &str, y: &str, z: &str| calls.contains(&format!("STRAIGHT_FEED({x}, {y}, {z}, "));
    for (x, y) in [("0.3750", "0.3750"), ("0.3750", "2.1250"), ("2.6250", "2.1250"), ("2.6250", "0.3750")] {
        assert!(fed(x, y, "-0.1000"), "spot at {x} {y}");
        assert!(fed(x, y, "-0.5000"), "thread at {x} {y}");
    }
    assert!(fed("2.6250", "2.1250", "-0.6000"), "the hole with its own depth");
    assert!(!fed("2.6250", "2.1250", "-0.8000"), "and no deeper");
}
