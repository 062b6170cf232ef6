//! NC programs read as jobs and printed by the Haas post: what comes out, what is warned of, what is refused.

use crate::support::control;
use std::fs;
use std::io::Cursor;

use crate::support::{check, root};
use postform::compile::compile;
use postform::nc::{JobOptions, RunSettings, read_program};
use postform::render::{Options, Renderer};
use postform::toolpath::ReadError;

const HEAD: &str = "G20 G17 G90\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z1. M8\n";

/// The new program with its warnings, or the code of the refusal.
fn printed(program: &str) -> Result<(String, Vec<String>), String> {
    let checked = check(&fs::read_to_string(root().join("postforms/haas.pf")).unwrap());
    let form = compile(&checked.form);
    let mut renderer = Renderer::new(&form, Options { program: Some(1), ..Options::default() });
    let options = JobOptions { settings: RunSettings::new(control("fanuc")), units: None, tool: None };
    let mut warnings = Vec::new();
    match read_program(Cursor::new(program), &options, &mut warnings, &mut renderer) {
        Ok(()) => {
            let text = String::from_utf8(std::mem::take(renderer.text())).unwrap();
            Ok((text, warnings.into_iter().map(|diag| diag.message).collect()))
        }
        Err(ReadError::Job(diag)) => Err(diag.code.name().into()),
        Err(other) => panic!("{other:?}"),
    }
}

/// The blocks of the path, without their numbers.
fn path(blocks: &str) -> Vec<String> {
    let (text, _) = printed(&format!("{HEAD}{blocks}\nM30\n")).unwrap_or_else(|code| panic!("{blocks}: {code}"));
    let lines = text.lines().map(|line| line.split_once(' ').map_or(line, |(_, rest)| rest).to_owned());
    let lines: Vec<String> = lines.skip_while(|line| !line.starts_with("G43")).skip(1).collect();
    let end = lines.iter().rposition(|line| line == "M9").unwrap_or(lines.len());
    lines[..end].to_vec()
}

#[test]
fn motions_feeds_and_switches_stay_what_they_were() {
    assert_eq!(path("G1 Z-.1 F5.\nX1. M5\nG0 Z1."), ["G1 Z-.1 F5.", "X1.", "M5", "G0 Z1."]);
    assert_eq!(path("M5\nS500\nG84 X1. Z-.5 R.1 F25.\nG80")[0], "S500 M3", "the tap starts the spindle");
    assert_eq!(path("G1 Z-.1 F5.\nG4 P500\nM0\nX1."), ["G1 Z-.1 F5.", "G4 P.5", "M0", "S1000 M3", "M8", "X1."]);
    assert_eq!(path("G91 G1 Z-1.1 F5.\nX1.\nX1.\nG90 G0 Z1."), ["G1 Z-.1 F5.", "X1.", "X2.", "G0 Z1."]);
    assert_eq!(
        path("G1 Z-.1 F5.\nM98 P7 L2\nG0 Z1.\nM30\nO7\nG91 X1.\nG90\nM99"),
        ["G1 Z-.1 F5.", "X1.", "X2.", "G0 Z1."]
    );
    assert_eq!(path("D5\nG1 Z-.1 F5.\nG41 X1.\nG40 X2.")[1], "G1 G41 D5 X1. Y0 F5.");
    let (text, _) = printed("G20 G90 F10.\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z1.\nG1 Z-.1\nM30\n").unwrap();
    assert!(text.contains("G1 Z-.1 F10."), "F counts in the block's own units\n{text}");
    let (text, _) = printed(&format!(
        "{HEAD}G1 Z-.1 F5.\nG0 Z1.\nG91 G28 Z0\nG90\nT2 M6\nG55 X3. Y3. S500 M4\nG43 H12 Z1.\nG1 Z-.2 F6.\nM30\n"
    ))
    .unwrap();
    for part in ["T2 M6", "G55 X3. Y3.", "S500 M4", "G43 H12 Z1. M8", "G1 Z-.2 F6."] {
        assert!(text.contains(part), "{part}\n{text}");
    }
}

/// Stops stay, also where a feed mode changes; before one the tool goes up, as it went home.
#[test]
fn stops_and_the_way_before_them_stay() {
    let lines = path("G81 X1. Z-1. R.1 F5.\nG80 G94\nM1\nG81 X2. Z-1. R.1");
    assert!(lines.contains(&"M1".to_owned()), "{lines:?}");
    let (text, _) =
        printed(&format!("{HEAD}G95 G81 X1. Z-1. R.1 F.05\nG80 G94\nM0\nM3\nG81 X2. Z-1. R.1 F5.\nG80\nM30\n"))
            .unwrap();
    assert!(text.contains(" M0\n"), "{text}");
    let (text, warnings) = printed(&format!("{HEAD}G0 Z3.\nZ1.\nG1 Z-.1 F5.\nG91 G28 Z0\nM0\nG90\nM30\n")).unwrap();
    let (up, stop) = (text.find("G0 Z3.\n").unwrap(), text.find(" M0\n").unwrap());
    assert!(text[up + 1..].contains("G0 Z3.") && up < stop, "{text}");
    assert!(warnings.iter().any(|warning| warning.contains("reference point")), "{warnings:?}");
}

#[test]
fn what_no_job_can_say_is_refused() {
    let cases = [
        ("G18 G81 X1. Z1. Y-1. R.1 F5.\nG80 G17", "a cycle along another axis"),
        ("G1 Z-.1 F5.\nG52 X2. Y0\nX1.", "a frame that moves between moves"),
        ("G1 Z-.1 F5.\nG92 X5.\nX6.", "G92 between moves"),
        ("G18\nG1 Z-.1 F5.\nG41 D1 X1.\nX2.\nG40 X3.", "compensation in another plane"),
        ("G44 H1 Z2.\nG1 Z-.1 F5.", "an offset that is taken off"),
        ("G41 D1 G1 X1. F5.\nX2.\nD3 X3.\nG40 X4.", "two diameter registers of one tool"),
        ("G43 H2 Z2.\nG1 Z-.1 F5.", "two length registers of one tool"),
        ("G98 G87 X1. Z-.3 R-.8 Q.1 F5.\nG80", "a back bore"),
        ("G99 G76 X1. Z-.3 R.1 Q.02 F5.\nG80", "a fine bore, whose side only the control knows"),
        ("G54.1 P8\nG1 Z-.1 F5.", "an additional work offset"),
        ("M19\nG1 Z-.1 F5.", "an orientation"),
        ("G1 Z-.1 F5.\nG21 X10.", "other units"),
        ("G28 G91 Z0\nG90 G1 X1. F5.", "a cut from the reference point"),
    ];
    for (blocks, what) in cases {
        let outcome = printed(&format!("{HEAD}{blocks}\nM30\n"));
        assert_eq!(outcome.as_ref().err().map(String::as_str), Some("PN036"), "{what}: {outcome:?}");
    }
    assert_eq!(printed("G90 T1 M6\nG0 X1. Y1. Z1.\nM30\n").unwrap_err(), "PL005");
    assert_eq!(printed("G20 G90\nG0 X1. Y1. Z1.\nM30\n").unwrap_err(), "PN036");
    assert_eq!(printed(&format!("{HEAD}G1 X1. F5. G4 P2\nM30\n")).unwrap_err(), "PN004");
}

#[test]
fn what_is_left_out_is_warned_of() {
    let cases = [
        ("/G1 X1. F5.", "block delete"),
        ("G10 L10 P1 R2.", "G10"),
        ("G61\nG1 X1. F5.", "G61"),
        ("G1 G9 X1. F5.", "G9"),
        ("M88\nG1 X1. F5.", "M88"),
        ("G08 P1\nG1 X1. F5.", "G8"),
        ("M7\nG1 X1. F5.", "flood and mist"),
        ("G49\nG0 Z2.\nG1 X1. F5.", "without a length offset"),
        ("G1 Z-.1 F5.\nG91 G28 Z0\nG90 G0 X3. Y3. Z1.\nG1 Z-.1", "reference point"),
    ];
    for (blocks, part) in cases {
        let (text, warnings) =
            printed(&format!("{HEAD}{blocks}\nM30\n")).unwrap_or_else(|code| panic!("{blocks}: {code}"));
        assert!(warnings.iter().any(|warning| warning.contains(part)), "{blocks}: {warnings:?}\n{text}");
    }
    let (_, warnings) = printed(&format!("{HEAD}G1 X1. F5.\nM30\n")).unwrap();
    assert_eq!(warnings, Vec::<String>::new());
    let (_, warnings) = printed(&format!("{HEAD}G1 X1. F5.\nM99\n")).unwrap();
    assert!(warnings.iter().any(|warning| warning.contains("M99")), "{warnings:?}");
}
