//! The LinuxCNC post, tested with LinuxCNC's own interpreter as a separate program, if it is installed.

use crate::support;
use crate::support::control;
use std::fs;
use std::path::Path;

use crate::support::nc::{self, difference, simulated};
use crate::support::{Kind, root, sample_job, samples};
use postform::internals::json::{read_document, read_lines};
use postform::internals::nc::RunSettings;
use postform::internals::render::{Cycles, Options};
use postform::internals::verify::{Comparer, Expectation, Verdict};
use postform::toolpath::Sink;

/// The interpreter's output for a program: its canonical calls, or its error.
fn interpreted(program: &Path, tools: &str) -> String {
    // all processes of the interpreter share one tool table file
    let table = Path::new(env!("CARGO_TARGET_TMPDIR")).join("tools.tbl");
    let arguments = ["-t".as_ref(), table.as_os_str(), "-g".as_ref(), program.as_os_str()];
    let output = nc::rs274(&[(&table, tools)], &arguments);
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

#[test_with::executable(rs274)]
#[test]
fn the_bracket_runs_to_its_end() {
    let program = root().join("samples/bracket/expected.linuxcnc.nc");
    let tools: String = [1, 2, 3, 4, 5, 11].map(|n| format!("T{n} P{n} Z0 D0.5\n")).concat();
    let calls = interpreted(&program, &tools);
    assert!(calls.contains("PROGRAM_END()"), "{}", calls.lines().rev().take(4).collect::<Vec<_>>().join("\n"));
    // every hole of the job is drilled to its bottom
    let fed = |x: &str, y: &str, z: &str| calls.contains(&format!("STRAIGHT_FEED({x}, {y}, {z}, "));
    for (x, y) in [("0.3750", "0.3750"), ("0.3750", "2.1250"), ("2.6250", "2.1250"), ("2.6250", "0.3750")] {
        assert!(fed(x, y, "-0.1000"), "spot at {x} {y}");
        assert!(fed(x, y, "-0.5000"), "thread at {x} {y}");
    }
    assert!(fed("2.6250", "2.1250", "-0.6000"), "the hole with its own depth");
    assert!(!fed("2.6250", "2.1250", "-0.8000"), "and no deeper");
}

/// Positions of the motions before the end of the program; true: a feed. The parts of one straight rapid are joined: a
/// move up and a move across become one position.
fn places(calls: &str) -> Vec<(bool, [f64; 3])> {
    let mut list: Vec<(bool, [f64; 3])> = Vec::new();
    for line in calls.lines() {
        let Some((feeds, rest)) = line
            .split_once("STRAIGHT_TRAVERSE(")
            .map(|(_, rest)| (false, rest))
            .or_else(|| line.split_once("STRAIGHT_FEED(").map(|(_, rest)| (true, rest)))
        else {
            continue;
        };
        let numbers: Vec<f64> = rest.split([',', ')']).filter_map(|n| n.trim().parse().ok()).collect();
        let to = [numbers[0], numbers[1], numbers[2]];
        if list.last().is_some_and(|(was, at)| *was == feeds && (*at == to || !feeds)) {
            list.pop();
        }
        list.push((feeds, to));
    }
    list
}

/// With its own cycles, the interpreter must reach the same bottoms and planes as with single moves.
#[test_with::executable(rs274)]
#[test]
fn cycles_of_the_control_go_where_the_moves_go() {
    for (name, exact) in [("drill", true), ("face", true), ("ream", true), ("deep", false), ("brkchp", false)] {
        let folder = root().join(format!("samples/cl-{name}"));
        let form = root().join("postforms/linuxcnc.pf");
        let both = [Cycles::Form, Cycles::Emulated].map(|cycles| {
            let options = Options { cycles, ..Options::default() };
            let rendered = support::render_sample_with(&folder, &form, options).unwrap();
            let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{cycles:?}.ngc"));
            fs::write(&program, &rendered.text).unwrap();
            let calls = interpreted(&program, "T1 P1 Z0 D10\n");
            assert!(calls.contains("PROGRAM_END()"), "{name}: {}\n{calls}", rendered.text);
            (rendered.text, places(&calls))
        });
        let [(cycle, by_control), (moves, by_moves)] = both;
        assert!(cycle.contains("G80") && cycle != moves, "{name} is printed as the control's cycle\n{cycle}");
        if exact {
            assert_eq!(by_control, by_moves, "{name}");
        }
        let deepest = |list: &[(bool, [f64; 3])]| list.iter().map(|(_, to)| to[2]).fold(f64::MAX, f64::min);
        assert_eq!(deepest(&by_control), deepest(&by_moves), "{name}");
    }
}

/// For every sample that this post can print, the interpreter must make the same motions as the simulator, and the
/// simulator must make the motions of the job. So the real interpreter makes the motions of the job.
#[test_with::executable(rs274)]
#[test]
fn samples_run_in_the_interpreter_as_their_jobs_ask() {
    let form = root().join("postforms/linuxcnc.pf");
    let checked = support::check_file(&form);
    let settings = postform::internals::compile::compile(&checked.form).settings;
    let (mut run, mut compensated) = (0, 0);
    for folder in samples() {
        let (job, kind) = sample_job(&folder);
        let bytes = fs::read(&job).unwrap();
        let read = |sink: &mut dyn Sink| match kind {
            Kind::Document => read_document(&bytes[..], sink).is_ok(),
            Kind::Lines => read_lines(&bytes[..], sink).is_ok(),
            Kind::Cl => {
                let mut report = postform::internals::cl::Report::default();
                postform::internals::cl::read_cl(
                    &bytes[..],
                    &postform::internals::cl::Options::default(),
                    &mut report,
                    sink,
                )
                .is_ok()
            }
        };
        // diameter registers are also rows of the tool table
        let tools: String = (1..40).map(|n| format!("T{n} P{n} Z0 D0.0001\n")).collect();
        for cycles in [Cycles::Form, Cycles::Emulated] {
            let options = Options { cycles, program: Some(1), ..Options::default() };
            // skips jobs for other machines, and jobs that this post refuses
            let Ok(rendered) = support::render_sample_with(&folder, &form, options) else { continue };
            if rendered.notes.iter().any(|note| note.code == postform::diag::Code::PR023) {
                continue; // the program ends with compensation on, and no control then moves home
            }
            let name = folder.file_name().unwrap().to_string_lossy().into_owned();
            let mut comparer = Comparer::new(
                std::io::Cursor::new(rendered.text.clone()),
                RunSettings::new(control("linuxcnc")),
                Expectation::of_form(&settings, false),
                None,
                false,
            );
            read(&mut comparer);
            let verdict = comparer.verdict().unwrap();
            if matches!(verdict, Verdict::NotProven(_)) || name.starts_with("custom") {
                continue; // not proven: for example subprograms, or custom cycles of another form
            }
            assert!(!matches!(verdict, Verdict::Different(_)), "{name} {cycles:?}: {verdict:?}\n{}", rendered.text);
            let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("sample-{name}-{cycles:?}.ngc"));
            fs::write(&program, &rendered.text).unwrap();
            let calls = interpreted(&program, &tools);
            assert!(calls.contains("PROGRAM_END()"), "{name}: {}\n{calls}", rendered.text);
            let (ours, ended, _) = simulated(rendered.text.as_bytes(), RunSettings::new(control("linuxcnc")));
            assert_eq!(ended, Ok(()), "{name}");
            // the interpreter outputs the compensated path, the simulator outputs the programmed path
            if rendered.text.contains("G41") || rendered.text.contains("G42") {
                compensated += 1;
            } else {
                let difference = difference(&ours, &nc::interpreted(&calls));
                assert_eq!(difference, None, "{name} {cycles:?}\n{}", rendered.text);
                run += 1;
            }
        }
    }
    assert!(run >= 20, "{run} programs compared, {compensated} with compensation");
}

/// The interpreter gives a single call for a rigid tap by G33.1. This call must match the moves in and out of the
/// simulator.
#[test_with::executable(rs274)]
#[test]
fn rigid_taps_run_as_in_the_interpreter() {
    let text = "G21 G17 G90 G94\nS100 M3\nG0 X1 Y1 Z5\nG33.1 Z-10 K1.5\nG0 X3\nG33.1 X3 Z-5 K1\nG91\nG33.1 Z-2 K1 I2\nM4\nZ-1 K1\nG90\nG0 Z9\nM2\n";
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("rigid-tap.ngc");
    fs::write(&program, text).unwrap();
    let calls = interpreted(&program, "T1 P1 Z0 D1\n");
    let (ours, ended, _) = simulated(text.as_bytes(), RunSettings::new(control("linuxcnc")));
    assert_eq!(ended, Ok(()));
    assert_eq!(difference(&ours, &nc::interpreted(&calls)), None, "{calls}");
}
