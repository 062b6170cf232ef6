//! Programs for lathes that are read as jobs. The post of another lathe prints them, or they are refused if a job can't
//! express them.

use std::io::Cursor;

use crate::support::{check, control, job_options, plain_post};
use postform::internals::compile::compile;
use postform::internals::nc::{RunSettings, read_program};
use postform::internals::render::{Options, Renderer};
use postform::toolpath::ReadError;

const HEAD: &str = "%\nO0042\nG21 G18 G40 G99\nG28 U0 W0\nT0101\nG50 S2500\nG97 S500 M3\nG0 X42. Z5.\n";

/// The program of the Haas lathe's post without its block numbers, and the warnings; or the refusal.
fn printed(program: &str) -> Result<(Vec<String>, Vec<String>), String> {
    let checked = check(&plain_post("haas-lathe.pf"));
    let form = compile(&checked.form);
    let mut renderer = Renderer::new(&form, Options::default());
    let settings = RunSettings::new(control("fanuc-lathe"));
    let options = job_options(settings);
    let mut warnings = Vec::new();
    match read_program(Cursor::new(program), &options, &mut warnings, &mut renderer) {
        Ok(()) => {
            let text = String::from_utf8(std::mem::take(renderer.text())).unwrap();
            let plain = |line: &str| match line.split_once(' ') {
                Some((number, rest)) if number.starts_with('N') => rest.to_owned(),
                _ => line.to_owned(),
            };
            Ok((text.lines().map(plain).collect(), warnings.into_iter().map(|diag| diag.message).collect()))
        }
        Err(ReadError::Job(diag)) => Err(format!("{} {}", diag.code.name(), diag.message)),
        Err(other) => panic!("{other:?}"),
    }
}

/// The blocks after the spindle of the first tool.
fn path(blocks: &str) -> Vec<String> {
    let (lines, _) = printed(&format!("{HEAD}{blocks}\nM30\n%\n")).unwrap_or_else(|error| panic!("{blocks}: {error}"));
    let lines: Vec<String> = lines.into_iter().skip_while(|line| !line.starts_with("G97")).skip(1).collect();
    let end = lines.iter().rposition(|line| line == "M9").unwrap_or(lines.len());
    lines[..end].to_vec()
}

/// X is a diameter in the program and a radius in the job. Arcs keep their centres; surface speed and spindle limit are
/// kept.
#[test]
fn moves_compensation_and_speeds_stay_what_they_were() {
    let blocks = "G42 G1 X38. Z1. F.3\nG1 Z-20. F.2\nG2 X42. Z-22. R2.\nG40 G1 X46.\nG96 S180\nG0 Z3.";
    let expected = [
        "M9",
        "G0 Z5. X42.",
        "G1 G42 Z1. X38. F.3",
        "Z-20. F.2",
        "G2 Z-22. X42. K0 I2.",
        "G1 G40 X46.",
        "G96 S180 M3",
        "G0 Z3.",
    ];
    assert_eq!(path(blocks), expected);
}

/// G76 becomes one thread of the job. The Haas post prints its passes by G92, and the radii are the same.
#[test]
fn a_thread_stays_a_thread() {
    let blocks = "G0 X28. Z4.\nG76 P010060 Q100 R0\nG76 X32. Z-20. R-.5 P1000 Q600 F1.5\nG0 Z10.";
    let expected = ["M9", "G0 Z5. X42.", "Z4. X28.", "G92 X31.2 Z-20. I-.5 F1.5", "X31.6971", "X32.", "G0 Z10. X28."];
    assert_eq!(path(blocks), expected);
}

/// A move home before another tool belongs to the form. A move home between moves of one tool belongs to the job.
#[test]
fn ways_home_and_the_turret() {
    let (lines, warnings) = printed(&format!(
        "{HEAD}G1 Z-1. F.2\nG28 U0 W0\nM1\nG0 X40. Z2.\nG0 X90. Z90. T0100\nT0212\nG0 X30. Z5.\nM30\n%\n"
    ))
    .unwrap();
    let text = lines.join("\n");
    assert!(
        text.contains("G1 Z-1. F.2\nG0 G53 X0\nG53 Z0\nM1\nS500 M3\nZ2. X40.\nM9\nG0 G53 X0\nG53 Z0\nT0212\n"),
        "{text}"
    );
    let home = "a rapid without the tool's offset (T with 00 after the station) becomes a move home in the job";
    assert!(warnings.iter().any(|warning| warning == home), "{warnings:?}");
}

/// Two blocks that move home along X and then along Z are one move home. A single block along X before a stop also
/// counts as a move home, with a warning.
#[test]
fn ways_home_along_one_axis_after_the_other() {
    let (lines, warnings) =
        printed(&format!("{HEAD}G1 Z-1. F.2\nG28 U0\nG28 W0\nT0202\nG0 X30. Z5.\nG28 U0\nM1\nG28 W0\nM30\n%\n"))
            .unwrap();
    let text = lines.join("\n");
    assert!(text.contains("G1 Z-1. F.2\nM9\nG0 G53 X0\nG53 Z0\nT0202\n"), "{text}");
    assert!(text.contains("G0 Z5. X30.\nG0 G53 X0\nG53 Z0\nM1\n"), "{text}");
    assert!(warnings.iter().any(|warning| warning.contains("along only X or Z before a stop")), "{warnings:?}");
}

/// Features that the job of a lathe can't express, each refused by name.
#[test]
fn what_no_job_of_a_lathe_has_is_refused() {
    let cases = [
        ("G92 X40. Z-20. F1.5", "PN036 a single pass of a thread"),
        ("G32 Z-20. F1.5", "PN036 a single pass of a thread"),
        ("G28 U0 W0\nG1 X40. F.2", "PN036 a cut begins at an unknown machine position"),
        ("G28 U0 W0\nG0 X40.\nG1 X39. F.2", "PN036 a cut begins at an unknown machine position"),
        ("G1 X40. F.2\nG28 U0\nG0 Z-50.", "PN036 the tool goes home along only X or Z, and then moves on"),
        ("G1 X40. F.2\nG53 G0 X0\nM1\nG0 X50.", "PN036 the tool goes home along only X or Z, and then moves on"),
        ("G1 X40. Y5. F.2", "PN036 a move along Y"),
        ("G0 X40. Y5.", "PN036 a move along Y"),
        ("T0100\nG1 X40. F.2", "PN036 a cut begins at an unknown machine position"),
        ("G28 U0 W0\nG0 U2.", "PN036 an increment from an unknown machine position"),
        ("G50 X10. Z10.", "PN036 a frame that moves"),
        ("G42 G1 Z1. F.2\nT0202", "PN036 the tool changes under compensation"),
        ("G42 G1 Z1. F.2\nG41 Z-1.", "PN036 compensation changes its side"),
        ("G42 G1 Z1. F.2\nG40\nG53 G0 X0 Z0", "PN036 the tool goes home under compensation"),
        ("G42 G1 Z1. F.2\nG40 G3 X44. Z2. R1.", "PN036 compensation is switched on an arc"),
        ("G71 U1. R.5\nG71 P10 Q20 U.4 F.2", "PN018 the profile's block N10 does not follow this block"),
    ];
    for (blocks, refused) in cases {
        let outcome = printed(&format!("{HEAD}{blocks}\nM30\n%\n"));
        let message = outcome.as_ref().err().map(String::as_str).unwrap_or_default();
        assert!(message.starts_with(refused), "{blocks}: {outcome:?}");
    }
    assert!(printed("O1\nG21 G99\nM3 S100\nG0 X1. Z1.\nM30\n").unwrap_err().contains("before it loads a tool"));
    assert!(
        printed("O1\nG99 T0101\nM3 S100\nG0 X1. Z1.\nM30\n")
            .unwrap_err()
            .contains("the units of the program are unknown")
    );
}
