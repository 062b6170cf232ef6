//! Differences between two programs: verdicts on pairs, properties, the command with its output formats, git.

use crate::support::control;
use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::support::root;
use postform::internals::diff::{Comparison, Edit, Ignore, Options, Program, compare};
use postform::internals::nc::RunSettings;
use postform::internals::verify::compare_motions;
use postform::toolpath::Units;
use proptest::prelude::*;

const BASE: &str = "%\nO100 (BRACKET)\nN10 G21 G17 G40 G49 G80 G90\nN20 T1 M6\nN30 G54 G0 X10. Y5.5 S1000 M3\nN40 G43 H1 Z50. M8\n\
N50 Z2.\nN60 G1 Z-1. F100.\nN70 X30. F300.\nN80 Y20.\nN90 G3 X20. Y30. I-10. J0\nN100 G0 Z50.\nN110 G99 G81 X0. Y0. Z-5. R2. F80.\n\
N120 X10.\nN130 X20.\nN140 G80\nN150 G0 Z50. M9\nN160 G91 G28 Z0 M5\nN170 M30\n%\n";

fn ignoring(names: &str) -> Ignore {
    let mut ignore = Ignore::default();
    names.split(',').filter(|name| !name.is_empty()).for_each(|name| assert!(ignore.set(name), "{name}"));
    ignore
}

fn program(text: &str) -> Program {
    Program::new(text.as_bytes().to_vec()).unwrap()
}

fn compared(old: &str, new: &str, ignore: Ignore, tolerance: f64) -> Comparison {
    compare(&program(old), &program(new), &Options { ignore, tolerance })
}

/// Whether both programs make the same motions.
fn same_motion(old: &str, new: &str) -> bool {
    let settings = RunSettings::new(control("fanuc"));
    compare_motions([old, new].map(|text| (Cursor::new(text), settings)), Units::Mm, 1e-6)
        .is_ok_and(|found| found.difference.is_none())
}

/// The program in inches: each length and feed is divided by 25.4.
fn in_inches(text: &str) -> String {
    let mut out = String::new();
    for word in text.replace("G21", "G20").split_inclusive([' ', '\n']) {
        let (body, end) = word.split_at(word.trim_end().len());
        match body.split_at_checked(1) {
            Some((letter, number)) if "XYZIJRF".contains(letter) && number.parse::<f64>().is_ok() => {
                out += &format!("{letter}{:?}{end}", number.parse::<f64>().unwrap() / 25.4);
            }
            _ => out += word,
        }
    }
    out
}

fn renumbered(text: &str) -> String {
    let lines = text.lines().enumerate().map(|(i, line)| match line.strip_prefix('N') {
        Some(rest) => format!("N{} {}\n", 5 * i, rest.split_once(' ').unwrap().1),
        None => format!("{line}\n"),
    });
    lines.collect()
}

/// The program with its cycle written as single moves.
fn expanded() -> String {
    let moves = "G0 X0. Y0.\nZ2.\nG1 Z-5. F80.\nG0 Z2.\nX10.\nG1 Z-5.\nG0 Z2.\nX20.\nG1 Z-5.\nG0 Z2.\n";
    let (head, rest) = BASE.split_once("N110").unwrap();
    let (_, tail) = rest.split_once("N140").unwrap();
    format!("{head}{moves}N140{tail}")
}

#[test]
fn pairs_and_their_verdicts() {
    let edit = |from: &str, to: &str| {
        assert!(BASE.contains(from), "{from}");
        BASE.replacen(from, to, 1)
    };
    // each row: a name, the new program, the differences that must be ignored so that both programs count as equal
    // ("-": not possible), and whether both programs make the same motions
    let pairs: Vec<(&str, String, &str, bool)> = vec![
        ("itself", BASE.into(), "", true),
        ("renumbered", renumbered(BASE), "numbers", true),
        (
            "without numbers",
            BASE.lines()
                .map(|l| l.split_once(' ').filter(|_| l.starts_with('N')).map_or(l, |(_, r)| r).to_owned() + "\n")
                .collect(),
            "numbers",
            true,
        ),
        ("lines ended by CR and LF", BASE.replace('\n', "\r\n"), "spaces", true),
        ("without blanks", BASE.replace(' ', ""), "spaces", true),
        ("tabs for blanks", BASE.replace(' ', "\t"), "spaces", true),
        ("empty lines between", BASE.replace('\n', "\n\n"), "spaces", true),
        // a Fanuc may refuse small letters, so their motions are not proven
        ("lower case", BASE.replace("(BRACKET)", "").to_lowercase(), "case,comments,spaces", false),
        ("lower case with its comment", BASE.to_lowercase().replace("(bracket)", "(BRACKET)"), "case", false),
        ("another comment", edit("(BRACKET)", "(BRACKET REV B)"), "comments", true),
        ("a comment more, on its own line", edit("N50", "(DOWN)\nN50"), "comments", true),
        ("a comment behind a block", edit("N60 G1 Z-1. F100.", "N60 G1 Z-1. F100. (DOWN)"), "comments", true),
        ("trailing zeros", edit("X30.", "X30.000"), "format", true),
        ("a point less", edit("X30.", "X30"), "format,points", false),
        ("leading zeros", edit("G1 Z-1.", "G01 Z-01."), "format", true),
        ("a plus sign", edit("X30.", "X+30."), "format", true),
        ("minus before zero", edit("X0. Y0.", "X-0. Y0."), "format", true),
        ("words in another order", edit("G43 H1 Z50. M8", "M8 Z50. H1 G43"), "order,spaces", true),
        (
            "order, case and numbers at once",
            edit("N40 G43 H1 Z50. M8", "n5 m8 z50. h01 g43"),
            "order,case,numbers,format,spaces",
            false,
        ),
        ("a modal code repeated", edit("N70 X30.", "N70 G1 X30."), "-", true),
        ("a move in two parts that stand in one", edit("N50 Z2.", "N50 Z20.\nZ2."), "-", true),
        ("the cycle as moves", expanded(), "-", true),
        ("inches", in_inches(BASE), "-", true),
        ("another feed", edit("F300.", "F320."), "-", false),
        ("another depth", edit("Z-5. R2.", "Z-6. R2."), "-", false),
        ("another R plane", edit("Z-5. R2.", "Z-5. R3."), "-", false),
        ("a hole more", edit("N130", "N125 X15.\nN130"), "-", false),
        ("a hole less", edit("N120 X10.\n", ""), "-", false),
        ("another tool", edit("T1 M6", "T2 M6"), "-", false),
        ("another work offset", edit("G54", "G55"), "-", false),
        ("an arc the other way", edit("G3 X20. Y30. I-10. J0", "G2 X20. Y30. I-10. J0"), "-", false),
        ("the spindle the other way", edit("M3", "M4"), "-", false),
        (
            "a block moved",
            edit("N60 G1 Z-1. F100.\nN70 X30. F300.\n", "N70 G1 X30. F300.\nN60 Z-1. F100.\n"),
            "-",
            false,
        ),
        ("blocks swapped in the cycle", edit("N120 X10.\nN130 X20.\n", "N130 X20.\nN120 X10.\n"), "-", false),
        ("the last retract lost", edit("N150 G0 Z50. M9", "N150 G0 X-50. M9"), "-", false),
        ("a stop more", edit("N110", "M1\nN110"), "-", false),
        ("coolant off too early", edit("N100 G0 Z50.", "N100 G0 Z50. M9"), "-", false),
        ("a dwell between cuts", edit("N110", "G4 P500\nN110"), "-", false),
        ("the spindle stopped and started between cuts", edit("N110", "M5\nM3\nN110"), "-", false),
    ];
    assert!(pairs.len() >= 30);
    for (what, new, helps, motion) in &pairs {
        let same = |ignore: Ignore| compared(BASE, new, ignore, 0.0).is_same();
        let all = ignoring("numbers,comments,spaces,case,format,points,order");
        match *helps {
            "" => assert!(same(Ignore::default()), "{what}"),
            "-" => assert!(!same(all) && !same(Ignore::default()), "{what}"),
            names => {
                assert!(!same(Ignore::default()), "{what} differs when nothing is ignored");
                assert!(same(ignoring(names)) && same(all), "{what} is the same ignoring {names}");
                for left_out in names.split(',').filter(|_| names.contains(',')) {
                    // leaving out `spaces` makes no difference if another ignored kind covers the blanks
                    let rest: Vec<&str> = names.split(',').filter(|name| *name != left_out).collect();
                    assert!(left_out == "spaces" || !same(ignoring(&rest.join(","))), "{what} needs {left_out}");
                }
            }
        }
        assert_eq!(same_motion(BASE, new), *motion, "{what}: motion");
        assert_eq!(same_motion(new, BASE), *motion, "{what}: motion the other way round");
    }
}

/// The spindle angle during the retract of a bore is compared.
#[test]
fn motions_differ_where_the_spindle_stands_at_another_angle() {
    let bore = |stands: &str| {
        format!(
            "G90 G21 G17 G94\nT1 M6\nG0 X0 Y0\nG43 H1 Z5.\nS900 M3\nG1 Z-5. F90.\n{stands}\nG0 X.2\nZ5.\nM3\nX9. Y9.\nG1 Z-5.\nG0 Z5.\nM30\n"
        )
    };
    let settings = [RunSettings::new(control("haas")); 2];
    let differs = |old: &str, new: &str| {
        let [old, new] = [bore(old), bore(new)].map(Cursor::new);
        compare_motions([(old, settings[0]), (new, settings[1])], Units::Mm, 1e-6)
            .unwrap()
            .difference
            .map(|found| found.message)
    };
    assert_eq!(differs("M19 R90.", "M19 R90."), None);
    // a cut with a stopped spindle, as in broaching
    let broach = |angle: &str| bore(&format!("M19 R{angle}.\nG1 Y1."));
    assert_eq!(difference("haas", ["90", "90"].map(broach)), None);
    assert!(
        difference("haas", ["90", "270"].map(broach)).unwrap().starts_with("the spindle angle before this cut is 270")
    );
    for (new, angle) in [("M19 R270.", "270 degrees"), ("M5", "no angle")] {
        let found = differs("M19 R90.", new).unwrap();
        assert_eq!(found, format!("the spindle angle before this cut is {angle}, but 90 degrees in the old program"));
    }
}

/// The first difference between the motions of two programs for one control.
fn difference(name: &str, programs: [String; 2]) -> Option<String> {
    let settings = RunSettings::new(control(name));
    let programs = programs.map(|program| (Cursor::new(program), settings));
    compare_motions(programs, Units::Mm, 1e-6).unwrap().difference.map(|found| found.message)
}

/// Positions are measured from the program zero, which a program may shift. The zeros of both programs are compared.
#[test]
fn motions_differ_in_the_zero_of_the_program() {
    let part = |shift: &str| {
        format!(
            "G90\nT1 M6\nG54 G0 X0. Y0.\nG43 H1 Z10.\n{shift}\nG0 X0. Y0. Z10.\nG1 Z-1. F100.\nX10.\nG0 Z50.\nM30\n"
        )
    };
    let differs = |name: &str, shifts: [&str; 2]| difference(name, shifts.map(part));
    for (name, code) in [("fanuc", "G52"), ("haas", "G10 L2 P1"), ("linuxcnc", "G92"), ("linuxcnc", "G10 L2 P1")] {
        let [no, five, six] =
            ["", " X5.", " X6."].map(|shift| if shift.is_empty() { String::new() } else { format!("{code}{shift}") });
        assert_eq!(differs(name, [&five, &five]), None, "{name} {code}");
        assert!(differs(name, [&no, &five]).is_some(), "{name} {code}");
        let found = differs(name, [&five, &six]).unwrap();
        let [old, new] = if code == "G92" { ["X-5", "X-6"] } else { ["X5", "X6"] };
        assert_eq!(
            found,
            format!("the zero of the program is shifted to {new} Y0 Z0, but to {old} Y0 Z0 in the old program")
        );
    }
    assert_eq!(
        differs("fanuc", ["", "G10 L2 P1 X0."]).unwrap(),
        "only one program sets the work offset, or shifts it from an unknown machine position"
    );
    let shifted = |shift: &str| {
        format!("G710\nG54 G0 X0 Y0\nT1 M6\nD1\nZ10\n{shift}\nG0 X0 Y0 Z10\nG1 Z-1 F100\nX10\nG0 Z50\nM30\n")
    };
    assert_eq!(difference("siemens", ["TRANS X50", "TRANS X50"].map(shifted)), None);
    assert_eq!(
        difference("siemens", ["TRANS X50", "TRANS X70"].map(shifted)).unwrap(),
        "the zero of the program is shifted to X70 Y0 Z0, but to X50 Y0 Z0 in the old program"
    );
    let data = ["G10 L10 P1 R100.", "G10 L10 P1 R101.", ""];
    assert_eq!(differs("fanuc", [data[0], "G10 L10 P1 R100.0"]), None);
    assert_eq!(
        differs("fanuc", [data[0], data[1]]).unwrap(),
        "the tool data set by G10 before this cut are L10, P1, R101, but L10, P1, R100 in the old program"
    );
    assert!(differs("haas", [data[0], data[2]]).is_some() && differs("haas", [data[2], data[0]]).is_some());
    // the message about a cut along a rotary axis names this axis
    let turned = |word: &str| {
        format!("G21 G90\nT1 M6\nG54 G0 X0. Y0. A0.\nG43 H1 Z10.\nG1 Z-1. F100.\nX10.{word}\nG0 Z50.\nM30\n")
    };
    let found = difference("fanuc", ["", " A30."].map(turned)).unwrap();
    assert_eq!(found, "a cut goes to X10 Y0 Z-1 A30, but to X10 Y0 Z-1 A0 in the old program");
}

/// A program may set a work offset for the program after it. The offsets that both programs leave are compared.
#[test]
fn motions_differ_in_the_offsets_that_stay_set() {
    let part = |end: &str| {
        format!("G21 G90\nT1 M6\nG54 G0 X0. Y0. S500 M3\nG43 H1 Z10.\nG1 Z-1. F100.\nG0 Z50.\n{end}\nM30\n")
    };
    let sets = |name: &str, new: &str, old: &str| {
        Some(format!("the program sets {name} to {new}, but to {old} in the old program"))
    };
    let only = Some("the programs set G55 for other axes, or only one program sets it".to_owned());
    let zero = Some("the zero of the program is shifted to X6 Y0 Z0, but to X5 Y0 Z0 in the old program".to_owned());
    for (old, new, expected) in [
        ("G10 L2 P2 X5.", "G10 L2 P2 X5.", None),
        ("G10 L2 P2 X25.4", "G20\nG10 L2 P2 X1.", None),
        ("G10 L2 P2 X5.", "G10 L2 P2 X6.", sets("G55", "X6 Y0 Z0", "X5 Y0 Z0")),
        ("G10 L20 P2 X5.", "G10 L20 P2 X6.", sets("G54.1 P2", "X6 Y0 Z0", "X5 Y0 Z0")),
        ("G10 L2 P0 Z5.", "G10 L2 P0 Z5.", None),
        ("G10 L2 P2 X0.", "", only.clone()),
        ("G10 L2 P2 X5.", "G10 L2 P3 X5.", only),
        ("G10 L2 P1 X5.", "G10 L2 P1 X6.", zero),
    ] {
        assert_eq!(difference("fanuc", [old, new].map(part)), expected, "{old} / {new}");
    }
}

/// The same numbers of a rapid are another position of the machine with another tool length, work offset or zero.
#[test]
fn motions_differ_in_the_frames_of_rapids() {
    let part = |retract: &str| {
        format!(
            "G21 G90\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z50.\nZ5.\nG1 Z-5. F100.\n{retract}\nG0 X0. Z50.\nG43 H1 Z5.\n\
             G1 Z-6.\nG0 Z50.\nM30\n"
        )
    };
    let old = "G0 Z50.\nX1. Z50.";
    let length = |now: &str| {
        format!(
            "the rapids here are made with tool 1, {now}, work offset 54, but with tool 1, tool length offset H1, work \
             offset 54 in the old program"
        )
    };
    let only = |frame: &str| format!("only the new program makes rapids here with {frame}");
    let level = |frame: &str| only(&format!("tool 1, tool length offset H1, {frame}"));
    let rows = [
        ("G0 Z60.\nX1. Z50.", None),
        ("G43 H1 G0 Z50.\nX1.", None),
        ("G49 G0 Z50.\nX1.", Some(length("no tool length offset"))),
        ("H99 G0 Z50.\nX1.", Some(length("tool length offset H99"))),
        ("G44 H1 G0 Z50.\nX1.", Some(length("tool length offset G44 H1"))),
        // the offset changes where no rapid has a known height
        ("G0 Z50.\nG91 G28 Z0\nG90 G49\nG0 X1.\nG43 H1 Z50.", None),
        ("G0 Z50.\nG52 Z-100.\nX1. Z50.\nG52 Z0", Some(level("work offset 54, zero shifted to Z-100"))),
        ("G0 Z50.\nG55 X1. Y0. Z50.\nG54 G0 X0. Y0. Z50.", Some(level("work offset 55"))),
        ("G0 Z50.\nG41 D1 X1.\nG40", Some(only("work offset 54, cutter compensation left D1"))),
    ];
    for (new, expected) in rows {
        assert_eq!(difference("fanuc", [old, new].map(part)), expected, "{new}");
    }
    // G43.1 gives the length as a number
    let grbl =
        |length: &str| format!("G21 G90\nG54 G0 X0 Y0 S1000 M3\nG43.1 Z{length}\nG0 Z10\nG1 Z-5 F100\nG0 Z10\nM2\n");
    for name in ["grbl", "fluidnc", "grblhal", "linuxcnc"] {
        assert_eq!(difference(name, ["5", "5"].map(grbl)), None, "{name}");
        let found = difference(name, ["5", "50"].map(grbl)).unwrap();
        let zeros = "X0 Y0 Z50, but to X0 Y0 Z5";
        assert_eq!(
            found,
            format!("the zero of the program, with the length of G43.1, is shifted to {zeros} in the old program")
        );
    }
}

/// Two programs differ if only one of them sets its units, or if they end in different ways.
#[test]
fn motions_differ_in_units_and_end() {
    let part = |head: &str, end: &str| {
        format!("{head}G90\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z10.\nG1 Z-5. F100.\nG0 Z50.\n{end}\n")
    };
    let differs = |a: [&str; 2], b: [&str; 2]| difference("fanuc", [a, b].map(|[head, end]| part(head, end)));
    assert_eq!(differs(["G21 ", "M30"], ["G21 ", "M2"]), None);
    assert_eq!(
        differs(["G21 ", "M30"], ["", "M30"]).unwrap(),
        "the new program has no code for units, but the old program sets its units"
    );
    assert_eq!(
        differs(["G21 ", "M30"], ["G21 ", "M99"]).unwrap(),
        "the new program ends with M99, which starts it again, but the old program ends with M2, M30 or the like"
    );
}

/// Machine positions that both programs give as numbers are compared. The reference point of G28 counts as 0.
#[test]
fn motions_differ_in_machine_positions() {
    let part = |way: &str| {
        format!(
            "G21 G90\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z10.\n{way}\nX50. Y0.\nG43 H1 Z10.\nG1 Z-5. F100.\nG0 Z50.\nM30\n"
        )
    };
    let differs = |ways: [&str; 2]| difference("haas", ways.map(part));
    assert_eq!(differs(["G53 G0 Z0.", "G91 G28 Z0.\nG90"]), None);
    assert_eq!(
        differs(["G53 G0 Z0.", "G53 G0 Z-100."]).unwrap(),
        "before this cut, the machine positions are Z-100, but Z0 in the old program"
    );
    assert_eq!(differs(["G53 G0 Z0.", "G53 G0 Z0.\nG53 X-20."]), None);
    let home = ["G91 G28 Z0.\nG90", "G91 G30 Z0.\nG90", "G91 G30 P2 Z0.\nG90", "G91 G30 P3 Z0.\nG90"];
    assert_eq!(differs([home[1], home[2]]), None);
    assert_eq!(
        differs([home[0], home[1]]).unwrap(),
        "before this cut, the machine positions are Z of reference point 2, but Z0 in the old program"
    );
    assert!(differs([home[2], home[3]]).is_some());
    // the same for a rotary axis, also if the cut itself turns the part from there
    for cut in ["G0 A0.", "G43 H1 Z10.\nG1 A20. F100."] {
        let turned = |point: &str| format!("G0 A9.\nG91 {point} A0.\nG90 {cut}");
        assert_eq!(differs(["G28", "G28"].map(&turned).each_ref().map(String::as_str)), None);
        assert_eq!(
            differs(["G28", "G30"].map(&turned).each_ref().map(String::as_str)).unwrap(),
            "before this cut, the machine positions are A of reference point 2, but A0 in the old program"
        );
    }
}

/// A machine position has a number, but this number is no height in the part. Under a machine position, the new program
/// may go only as low as the old program goes.
#[test]
fn a_machine_position_gives_no_height() {
    let part = |home: &str, height: &str| {
        format!(
            "G21 G90 G94 G17\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z50.\nG1 Z-1. F100.\nX10.\nG0 Z50.\n{home}\nT2 M6\n\
             G54 G0 X60. Y5. S500 M3\nG43 H2 Z{height}\nZ2.\nG1 Z-3. F100.\nX70.\nG0 Z50.\nM30\n"
        )
    };
    for (name, home) in
        [("haas", "G53 G0 Z-10."), ("linuxcnc", "G53 G0 Z-10."), ("fanuc", "G53 G0 Z0."), ("fanuc", "G91 G28 Z0\nG90")]
    {
        let differs = |heights: [&str; 2]| difference(name, heights.map(|height| part(home, height)));
        assert_eq!(differs(["50.", "50."]), None, "{name} {home}");
        assert_eq!(differs(["50.", "60."]), None, "{name} {home}");
        assert_eq!(
            differs(["50.", "-1.5"]).unwrap(),
            "a rapid goes to X60 Y5 Z-1.5, which is lower than in the old program",
            "{name} {home}"
        );
    }
}

/// After the last cut: G28 without G91 goes to a position of the part first, and X and Y must not go home before Z.
#[test]
fn the_way_home_differs() {
    let part = |home: &str| {
        format!(
            "G21 G90\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z50.\nG1 Z-3. F100.\nX30.\nG0 Z5.\nX50. Y50.\n{home}\nM30\n"
        )
    };
    let differs = |new: &str| difference("haas", ["G91 G28 Z0\nG28 X0 Y0", new].map(part));
    assert_eq!(differs("G91 G28 Z0\nG28 X0 Y0"), None);
    for new in ["G28 Z0\nG91 G28 X0 Y0", "G91 G28 X0 Y0\nG28 Z0"] {
        assert_eq!(differs(new).unwrap(), "the path after the last cut is different", "{new}");
    }
}

/// At a stop or a dwell, the tool is at least as high as in the old program.
#[test]
fn motions_differ_in_the_height_of_a_stop() {
    let part = |pause: &str| {
        format!(
            "G21 G90\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z50.\nG1 Z-3. F100.\nX30.\n{pause}\nM3\nG0 Z50.\nX60.\nG1 \
             Z-3.\nG0 Z50.\nM30\n"
        )
    };
    let differs = |pauses: [&str; 2]| difference("fanuc", pauses.map(part));
    for (code, name) in [("M0", "M0"), ("M1", "M1"), ("G4 P500", "a dwell")] {
        let [high, low, higher] = ["5.", "-2.", "20."].map(|height| format!("G0 Z{height}\n{code}"));
        assert_eq!(differs([&high, &high]), None, "{code}");
        assert_eq!(differs([&high, &higher]), None, "{code}");
        assert_eq!(
            differs([&high, &low]).unwrap(),
            format!("at {name} before this cut, the tool is at Z-2, but at Z5 in the old program"),
        );
    }
}

/// On a Siemens, a setting decides whether the length of an active D counts in a machine position.
#[test]
fn motions_differ_in_the_length_at_a_machine_position() {
    let part = |home: &str| {
        format!(
            "G17 G710 G40 G90 G94\nT1\nM6\nG54 D1 S2000 M3\nG0 X0 Y0\nZ50\nZ2\nG1 Z-1 F100\nX10\nG0 Z50\n{home}\nM5\nM30\n"
        )
    };
    let differs = |homes: [&str; 2]| difference("siemens", homes.map(part));
    assert_eq!(differs(["G0 SUPA Z-100", "G0 SUPA Z-100"]), None);
    assert_eq!(differs(["G0 SUPA D0 Z-100", "D0\nG0 SUPA Z-100"]), None);
    for new in ["G0 SUPA Z-100", "G0 G153 Z-100"] {
        assert_eq!(
            differs(["G0 SUPA D0 Z-100", new]).unwrap(),
            "before this cut, the machine positions are Z-100 with D1 active, but Z-100 in the old program"
        );
    }
}

/// Codes that are not simulated are compared with their words.
#[test]
fn codes_that_are_not_simulated_have_words() {
    let part = |code: &str| {
        format!("G21 G90\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z10.\n{code}\nG1 Z-5. F100.\nG0 Z50.\nM30\n")
    };
    for (name, codes) in [
        ("linuxcnc", ["M67 E0 Q10", "M67 E0 Q50"]),
        ("linuxcnc", ["G64 P.01", "G64 P1"]),
        ("fanuc", ["G5.1 Q1", "G5.1 Q0"]),
        ("haas", ["G187 P1", "G187 P3"]),
        // both stop the program, and M60 changes the pallet as well
        ("fanuc", ["M0", "M60"]),
    ] {
        let settings = RunSettings::new(control(name));
        let counted = |codes: [&str; 2]| {
            let texts = codes.map(|code| (Cursor::new(part(code)), settings));
            compare_motions(texts, Units::Mm, 1e-6).unwrap().codes
        };
        assert_eq!(counted([codes[0]; 2]), 0, "{name}");
        assert_eq!(counted(codes), 1, "{name}: {codes:?}");
    }
}

/// After the last cut, a rapid at the depth of the cut is allowed only if the old program has the same rapid. The
/// spindle must turn as in the old program.
#[test]
fn motions_differ_after_the_last_cut() {
    let part =
        |end: &str| format!("G21 G90\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z10.\nG1 Z-5. F100.\nX50.\n{end}\nM30\n");
    let differs = |old: &str, new: &str| difference("fanuc", [old, new].map(part));
    let old = "G0 X52.\nZ50.";
    assert_eq!(differs(old, "G0 X51.\nX52.\nZ50."), None);
    assert_eq!(differs(old, "G0 X52.\nZ50.\nX80."), None);
    for new in ["G0 X150.\nZ50.", "G0 X0.\nZ50.", "G0 X52.\nY3.\nZ50."] {
        assert_eq!(differs(old, new).unwrap(), "the path after the last cut is different", "{new}");
    }
    let bored = |shift: &str| part(&format!("G0 Z10.\nG76 X10. Y0. Z-20. R2. Q{shift} F100.\nG80\nG0 Z50."));
    assert_eq!(difference("haas", ["1.5", "1.5"].map(bored)), None);
    assert!(
        difference("haas", ["1.5", ".5"].map(bored)).is_some()
            && difference("haas", [".5", "1.5"].map(bored)).is_some()
    );
    let drilled = |code: &str| part(&format!("G0 Z10.\n{code} X10. Y0. Z-20. R2. F100.\nG80\nG0 Z50."));
    let found = difference("fanuc", ["G81", "G86"].map(drilled)).unwrap();
    assert_eq!(found, "the spindle leaves the last cut with stop, but with cw in the old program");
}

/// On a lathe, a rapid can meet the part from every direction. The tool must go to the same positions in the same order,
/// also next to the home position. Two rapids may replace a slanted rapid, with the corner at the greater Z.
/// LinuxCNC has no control file of its own for lathes.
#[test]
fn motions_of_lathes_follow_the_same_path() {
    let part = |[enter, leave, end]: [&str; 3]| {
        format!(
            "G21 G18 G40 G80 G99\nG0 G53 X0\nG53 Z0\nT0101\nG97 S500 M3\nG0 {enter}\nX82.\nG1 X60. F.1\nG0 {leave}\nG1 X82. \
             F.1\nG0 {end}\nM30\n"
        )
    };
    const OLD: [&str; 3] = ["Z-40. X220.", "X220.\nZ5.\nX100.", "X220.\nG53 X0\nG53 Z0"];
    let at = |index: usize, old: &str, new: &str| {
        let with = |text| {
            let mut parts = OLD;
            parts[index] = text;
            part(parts)
        };
        let linuxcnc = |text| with(text).replace("G99", "G95 G7").replace("T0101", "T1 M6");
        let found = difference("haas-lathe", [old, new].map(with));
        assert_eq!(difference("linuxcnc", [old, new].map(linuxcnc)), found, "{old:?} -> {new:?}");
        found.unwrap_or("none".to_owned())
    };
    let [enter, leave, end] = OLD;
    for (index, old, new, found) in [
        // from home to the first cut
        (0, enter, "Z-40. X220.", "none"),
        (0, enter, "Z-40.\nX220.", "none"),
        (0, enter, "Z-40. X220.\nX150.", "none"),
        (0, enter, "X20.\nZ-40.", "the rapids near X10 Z-40 follow another path than in the old program"),
        (0, enter, "Z-45. X220.\nZ-40.", "the rapids near X110 Z-45 follow another path than in the old program"),
        (0, "Z-40.\nX220.", "X220.\nZ-40.", "the rapids near X110 follow another path than in the old program"),
        (0, "X220.\nZ-40.", "Z-40.\nX220.", "the rapids near Z-40 follow another path than in the old program"),
        (0, "X220.\nZ-40.", "X220. Z-40.", "the rapids near X110 Z-40 follow another path than in the old program"),
        // between two cuts
        (1, leave, "X220.\nZ5.\nX150.\nX100.", "none"),
        (1, leave, "Z5.\nX100.", "the rapids near X30 Z5 follow another path than in the old program"),
        (1, "X220.\nZ-30. X250.", "X220.\nZ-30.\nX250.", "none"),
        (
            1,
            "X220.\nZ-30. X250.",
            "X220.\nX250.\nZ-30.",
            "the rapids near X125 Z-40 follow another path than in the old program",
        ),
        // home after the last cut
        (2, end, "X220.\nG53 X0\nG53 Z0", "none"),
        (2, end, "X150.\nX220.\nG53 X0\nG53 Z0", "none"),
        (2, end, "X-20.\nX220.\nG53 X0\nG53 Z0", "the path after the last cut is different"),
        (2, end, "X-20.\nG53 Z0\nG53 X0", "the path after the last cut is different"),
        (2, end, "X220.\nG53 Z0\nG53 X0", "the path after the last cut is different"),
    ] {
        assert_eq!(at(index, old, new), found, "{old:?} -> {new:?}");
    }
}

/// Spindle and turret of a lathe are compared.
#[test]
fn motions_of_lathes_differ_in_spindle_and_turret() {
    const PART: &str = "G21 G18 G40 G99\nT0101\nG50 S2500\nG96 S150 M3\nG0 X44. Z5.\nG1 Z-20. F2.\nG28 U0 W0\nT0202\nG97 S800 M3\n\
        G0 X44. Z5.\nG1 Z-20. F.2\nG28 U0 W0\nM5\nM30\n";
    let differs = |from: &str, to: &str| {
        difference("fanuc-lathe", [PART.to_owned(), PART.replacen(from, to, 1)]).unwrap_or("none".to_owned())
    };
    assert_eq!(differs("G21", "G21"), "none");
    for (from, to, message) in [
        (
            "G96 S150",
            "G97 S150",
            "the spindle speed is in revolutions (G97), but a surface speed (G96) in the old program",
        ),
        ("S2500", "S500", "the speed limit of the spindle is 500, but 2500 in the old program"),
        ("G50 S2500\n", "", "the speed limit of the spindle is none, but 2500 in the old program"),
        ("G1 Z-20. F2.", "G32 Z-20. F2.", "only one program synchronizes a cut with the spindle, as for a thread"),
        (
            "G28 U0 W0",
            "G58 U0 W0",
            "a cut begins at an unknown machine position of X and Y and Z, but at an unknown machine position of Y in the \
             old program",
        ),
        ("G28 U0 W0", "G28 W0", "the turret turns at home only along Z, but at home in the old program"),
        ("G28 U0 W0", "G28 U0", "the turret turns at home only along X, but at home in the old program"),
    ] {
        assert_eq!(differs(from, to), message, "{from} -> {to}");
    }
}

/// Threads are also compared by the words that do not change the moves.
#[test]
fn motions_of_threads_differ_in_their_words() {
    let part =
        |thread: &str| format!("G21 G18 G40 G99\nT0101\nG97 S800 M3\nG0 X40. Z2.\n{thread}\nG0 X60.\nG28 U0 W0\nM30\n");
    let differs = |old: &str, new: &str| difference("fanuc-lathe", [part(old), part(new)]);
    let twice = "G92 X38. Z-10. F1.5\nG92 X38. Z-10. F1.5 Q180000";
    let at = |angle: &str| {
        format!(
            "a thread begins at {angle}, with flanks of 0 degrees and a runout of 0 leads, but at 180 degrees, with \
             flanks of 0 degrees and a runout of 0 leads in the old program"
        )
    };
    assert_eq!(differs(twice, "G92 X38. Z-10. F1.5\nG92 X38. Z-10. F1.5"), Some(at("0 degrees")));
    assert_eq!(differs(twice, &twice.replace("Q180000", "Q-180000")), None);
    let cycle = "G76 P010060 Q50 R.02\nG76 X38. Z-10. P1000 Q300 F1.5";
    for words in ["P010000", "P010055", "P012060"] {
        let found = differs(cycle, &cycle.replace("P010060", words)).unwrap();
        assert!(found.starts_with("a thread begins at 0 degrees, with flanks of "), "{words}: {found}");
    }
    assert_eq!(differs(cycle, cycle), None);
}

/// Two unknown positions count as different if they are unknown for different reasons: an offset, a move home, or an
/// axis that stayed in another offset.
#[test]
fn motions_differ_where_a_position_is_unknown_for_another_reason() {
    let part = |middle: &str| {
        format!("G90 G21 G17 G94\nT1 M6\nG54 G0 X0 Y0 S900 M3\nG43 H1 Z2.\nG1 Z-20. F200.\n{middle}\nM30\n")
    };
    let differs = |old: &str, new: &str| difference("fanuc", [part(old), part(new)]);
    let home = "G0 Z2.\nG91 G28 Z0\nG90 G54\nG0 X90. Y50.\nG43 H1 Z2.\nG1 Z-5.";
    assert_eq!(
        differs(home, &home.replace("G28", "G58")),
        Some("the tool no longer goes home along Z before this cut".to_owned())
    );
    assert_eq!(
        differs("G55\nG1 X50.", "G55\nG1 X50. Z-20."),
        Some("only one program cuts to an unknown machine position".to_owned())
    );
}

#[test]
fn motions_of_taps_differ_in_what_makes_them_rigid() {
    let tap = |ahead: &str| {
        format!("G90 G21 G17 G94\nT1 M6\nG0 X0 Y0\nG43 H1 Z5.\nS500 M3\n{ahead}G84 Z-9. R2. F500.\nG80\nM30\n")
    };
    let settings = [RunSettings::new(control("fanuc")); 2];
    let [old, new] = ["M29 S500\n", ""].map(|ahead| Cursor::new(tap(ahead)));
    let found = compare_motions([(old, settings[0]), (new, settings[1])], Units::Mm, 1e-6).unwrap();
    assert!(found.difference.unwrap().message.starts_with("only one program synchronizes a tap with the spindle"));
}

/// A tap begins at the angle of its cycle. If only the angle or the technology of the cycle differs, the moves are equal.
#[test]
fn motions_of_taps_differ_in_their_start_angle() {
    let siemens = |angle: &str, more: &str| {
        format!(
            "G17 G90 G710 G94 G54\nT1 M6\nD1 S500 M3\nG0 X0 Y0 Z50\n\
             CYCLE84(10,2,0,-10,,0,3,,1,{angle},500,500{more})\nG0 Z50\nM30\n"
        )
    };
    let klartext = |angle: &str| {
        format!(
            "0 BEGIN PGM T MM\nTOOL CALL 1 Z S500\nL X+0 Y+0 Z+50 R0 FMAX M3\n\
             CYCL DEF 209 TAPPING Q200=2 Q201=-10 Q239=1 Q203=0 Q204=50 Q257=0 Q256=0 Q336={angle}\n\
             CYCL CALL\nL Z+50 FMAX\nM30\nEND PGM T MM\n"
        )
    };
    let starts =
        |new: u16| Some(format!("the thread of a tap starts at {new} degrees, but at 0 degrees in the old program"));
    for (new, expected) in [("0", None), ("360", None), ("90", starts(90))] {
        assert_eq!(difference("siemens", [siemens("0", ""), siemens(new, "")]), expected);
        assert_eq!(difference("heidenhain", [klartext("0"), klartext(new)]), expected);
    }
    let settings = RunSettings::new(control("siemens"));
    let other = [siemens("0", ""), siemens("0", ",,,1")].map(|program| (Cursor::new(program), settings));
    let found = compare_motions(other, Units::Mm, 1e-6).unwrap();
    assert_eq!((found.difference, found.codes), (None, 1), "TECHNO is not simulated");
}

/// G83 retracts out of the hole after each peck, G73 only breaks the chips. The cuts of both are equal. Pecks that clear
/// the chips may replace pecks that only break them, but not the other way round.
#[test]
fn motions_of_pecks_differ_in_their_retracts() {
    let fanuc = |cycle: &str| {
        let text = format!(
            "G90 G21 G17 G94 G54\nT1 M6\nG0 X0 Y0 S1000 M3\nG43 H1 Z50.\n{cycle} F100.\nX10.\nG80\nG0 Z50.\nM30\n"
        );
        ("fanuc", text)
    };
    let siemens = |cycle: &str| {
        let text = format!(
            "G17 G90 G710 G94 G54\nT1 M6\nD1 S1000 M3\nG0 X0 Y0 Z50 F100\nMCALL {cycle}\nG0 X0 Y0\nG0 X10\nMCALL\n\
             G0 Z50\nM30\n"
        );
        ("siemens", text)
    };
    let clears = fanuc("G98 G83 Z-18. R2. Q5.");
    let breaks = fanuc("G98 G73 Z-18. R2. Q5.");
    let drills = fanuc("G98 G81 Z-18. R2.");
    let clears_there = siemens("CYCLE83(50,0,2,-18,,-3,,0,0,0,1,1)");
    let breaks_there = siemens("CYCLE83(50,0,2,-18,,-3,,0,0,0,1,0)");
    let compared = |old: &(&'static str, String), new: &(&'static str, String)| {
        let sides = [old, new].map(|(name, text)| (Cursor::new(text.clone()), RunSettings::new(control(name))));
        let found = compare_motions(sides, Units::Mm, 1e-6).unwrap();
        (found.difference.map(|found| found.message).unwrap_or_default(), [found.retracts, found.pecks])
    };
    let only_breaks = "the tool only breaks the chips, but in the old program it retracts out of the hole";
    let one_peck = "one peck is 20 deep, but at most 5 in the old program";
    for (old, new, message, counts) in [
        (&clears, &breaks, only_breaks, [0, 0]),
        (&breaks, &clears, "", [6, 0]),
        (&clears, &clears, "", [0, 0]),
        (&breaks, &breaks, "", [0, 0]),
        (&clears, &breaks_there, "the tool only breaks the chips, but in the old program it retracts", [0, 0]),
        (&breaks, &clears_there, "", [10, 0]),
        (&clears, &clears_there, "", [0, 2]),
        (&breaks, &breaks_there, "", [0, 2]),
        (&clears_there, &drills, one_peck, [0, 0]),
        (&breaks_there, &drills, one_peck, [0, 0]),
    ] {
        let (found, counted) = compared(old, new);
        assert!(found.contains(message) && found.is_empty() == message.is_empty(), "{} {}: {found}", old.1, new.1);
        assert!(!found.is_empty() || counted == counts, "{} {}: {counted:?}", old.1, new.1);
    }
}

/// Words of LinuxCNC that change the moves of the tool or the spindle, but not the numbers in the axis words. The taper
/// of a thread has an effect only if it is greater than 0, as in the interpreter.
#[test]
fn motions_of_linuxcnc_differ_in_words_beside_the_axes() {
    let mill = |blocks: &str| format!("G21 G90 G17 G94\nT1 M6\nS500 M3 F100\nG0 X0 Y0 Z5\n{blocks}\nG0 Z9\nM2\n");
    let lathe = |blocks: &str| format!("G21 G90 G18 G95 G8\nT1 M6\nS500 M3 F.2\nG0 X22 Z5\n{blocks}\nG0 Z10\nM2\n");
    let thread = |words: &str| lathe(&format!("G76 P1.5 Z-20 I-2 J.3 K1.2 {words}"));
    let side = |code: &str| mill(&format!("{code}\nG1 X5\nG1 Y9\nG40 X30"));
    let turned = |code: &str| lathe(&format!("{code}\nG1 X40\nG1 Z-5\nG40 X60"));
    for (old, new, found) in [
        (side("G41.1 D3"), side("G41.1 D4"), Some("the compensated tool has a diameter of 4, but a diameter of 3")),
        (side("G41.1 D25.4"), side("G20 G41.1 D1\nG21"), None),
        (turned("G42.1 D3 L5"), turned("G42.1 D3 L6"), Some("orientation 6, but a diameter of 3 and orientation 5")),
        (thread("E1 L2"), thread("E-1 L2"), Some("a cut goes to X19.7 Y0 Z-20, but to X19.7 Y0 Z-19")),
        (thread(""), thread("E-1 L3"), None),
        (mill("G33.1 Z-2 K1 I2"), mill("G33.1 Z-2 K1 I3"), Some("the feed is 1500, but 1000")),
        (mill("G33.1 Z-2 K1"), mill("G33.1 Z-2 K1 I1"), None),
    ] {
        let message = difference("linuxcnc", [old, new.clone()]);
        assert_eq!(message.is_some(), found.is_some(), "{new}: {message:?}");
        assert!(found.is_none_or(|found| message.as_ref().unwrap().contains(found)), "{new}: {message:?}");
    }
}

/// Words and statements that are not simulated count before the next cut, as codes do.
#[test]
fn other_words_that_are_not_simulated_are_counted() {
    let siemens = |words: &str| {
        format!(
            "G17 G90 G710 G94 G54\nT1 M6\nD1 S1000 M3\nG0 X0 Y0 Z50\nG1 Z-1 F100\n{words}\nG1 X20 Y5\nG0 Z50\nM30\n"
        )
    };
    let klartext = |words: &str| {
        format!(
            "0 BEGIN PGM T MM\nTOOL CALL 1 Z S1000\nL X+0 Y+0 Z+50 R0 FMAX M3\nL Z-1 F100\nCYCL DEF 32.0 TOLERANCE\n\
             CYCL DEF 32.1 {words}\nL X+20 Y+5\nL Z+50 FMAX\nM30\nEND PGM T MM\n"
        )
    };
    let of = |name: &'static str, make: &dyn Fn(&str) -> String, words: [&str; 2]| (name, words.map(make));
    for ((name, programs), count) in [
        (of("siemens", &siemens, ["CFC", "CFTCP"]), 1),
        (of("siemens", &siemens, ["KONT", "NORM"]), 1),
        (of("siemens", &siemens, ["G1 X5 CFIN", "G1 X5"]), 1),
        (of("siemens", &siemens, ["CYCLE832(5,1,1)", "CYCLE832(0.01,1,1)"]), 1),
        (of("siemens", &siemens, ["cfc", "CFC"]), 0),
        (of("heidenhain", &klartext, ["T5", "T0.01"]), 1),
        (of("heidenhain", &klartext, ["T5", "T5"]), 0),
    ] {
        let settings = RunSettings::new(control(name));
        let sides = programs.clone().map(|program| (Cursor::new(program), settings));
        let found = compare_motions(sides, Units::Mm, 1e-6).unwrap();
        assert_eq!((found.difference, found.codes), (None, count), "{programs:?}");
    }
}

/// A detour at rapid is no difference, but it is counted and reported.
#[test]
fn other_ways_are_counted() {
    let detour = BASE.replacen("N110", "G0 X-20.\nN110", 1);
    let settings = [RunSettings::new(control("fanuc")); 2];
    let found = compare_motions(
        [(Cursor::new(BASE), settings[0]), (Cursor::new(detour.as_str()), settings[1])],
        Units::Mm,
        1e-6,
    )
    .unwrap();
    assert_eq!((found.difference, found.ways), (None, 1));
}

#[test]
fn tolerance_moves_and_words() {
    let new = BASE.replace("X30.", "X30.0004").replace("Y5.5", "Y5.4996");
    assert_eq!(compared(BASE, &new, Ignore::USUAL, 0.0).edits().count(), 2);
    assert!(compared(BASE, &new, Ignore::USUAL, 0.0005).is_same());
    assert!(!compared(BASE, &new, Ignore::USUAL, 0.0003).is_same());
    // one block is moved to another position: it is removed once and added once
    let moved = BASE.replacen("N80 Y20.\n", "", 1).replacen("N130 X20.\n", "N130 X20.\nN80 Y20.\n", 1);
    let comparison = compared(BASE, &moved, Ignore::USUAL, 0.0);
    let edits: Vec<Edit> = comparison.edits().copied().collect();
    assert_eq!(edits, [Edit::Moved(9, 14), Edit::Moved(9, 14)]);
    let spans = postform::internals::diff::changed_spans(b"N1 G1 X1. F5.", b"N2 G1 X1. F6. M8", &Ignore::USUAL);
    let places =
        |list: &[std::ops::Range<usize>]| -> Vec<(usize, usize)> { list.iter().map(|r| (r.start, r.end)).collect() };
    assert_eq!(places(&spans[0]), [(10, 13)]);
    assert_eq!(places(&spans[1]), [(10, 13), (14, 16)]);
}

/// Programs without common blocks, or with the same blocks in another order, are compared in bounded time. The result
/// is correct, and the same in every run.
#[test]
fn large_differences_have_one_answer() {
    let line = |i: u64, seed: u64| format!("G1 X{}\n", i * 7919 + seed);
    let lines = |seed: u64| -> String { (0..60_000u64).map(|i| line(i, seed)).collect() };
    let shuffled: String = (0..60_000u64).map(|i| line(i * 48_271 % 60_000, 1)).collect();
    let backwards: String = (0..60_000u64).rev().map(|i| line(i, 1)).collect();
    let few: String = (0..60_000u64).map(|i| format!("G1 X{}\n", i * i % 97 % 8)).collect();
    for new in [lines(2), shuffled, backwards, few] {
        let (old, new) = (program(&lines(1)), program(&new));
        let comparison = compare(&old, &new, &Options::default());
        assert!(compare(&old, &new, &Options::default()) == comparison);
        assert_eq!(
            applied(&old, &new, &comparison),
            (0..new.len()).map(|line| new.line(line)).collect::<Vec<_>>().concat()
        );
    }
}

/// In programs of any length, exactly the edited blocks are found.
#[test]
fn edits_far_apart_are_all_that_is_found() {
    let old: Vec<String> = (0..200_000u64).map(|i| format!("G1 X{} Y{}\n", i * 7919 % 10_007, i % 3)).collect();
    let mut new = old.clone();
    new[1_000] = "G1 X-1 Y-1\n".into();
    new.insert(100_000, "M8\n".into());
    new.remove(150_000);
    let at = |number| old[number..number + 1].concat();
    assert_ne!(at(149_998), at(149_999));
    let comparison = compare(&program(&old.concat()), &program(&new.concat()), &Options::default());
    let edits: Vec<Edit> = comparison.edits().copied().collect();
    assert_eq!(edits, [Edit::Changed(1_000, 1_000), Edit::Added(100_000), Edit::Removed(149_999)]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]
    /// For a few edits in repeated blocks, the comparison finds the smallest number of changes.
    #[test]
    fn few_edits_have_the_shortest_answer(
        blocks in prop_oneof![Just(3), Just(12), Just(40)].prop_flat_map(|kinds| proptest::collection::vec((0..kinds, 0..3u8), 250..300)),
        edits in proptest::collection::vec((0..250usize, 0..4u8, 1..30usize), 1..10),
    ) {
        let old: Vec<String> = blocks.iter().map(|(x, y)| format!("G1 X{x} Y{y}\n")).collect();
        let mut new = old.clone();
        for (number, (at, kind, length)) in edits.into_iter().enumerate() {
            let at = at.min(new.len() - 1);
            match kind {
                0 => new[at] = format!("G1 X9 Y{number}\n"),
                1 => new.insert(at, format!("M{number}\n")),
                2 => _ = new.remove(at),
                _ => {
                    let part: Vec<String> = new.drain(at..(at + length).min(new.len())).collect();
                    new.splice(0..0, part);
                }
            }
        }
        let shortest = similar::capture_diff_slices(similar::Algorithm::RawMyers, &old, &new);
        let kept: usize = shortest.iter().filter(|op| op.tag() == similar::DiffTag::Equal).map(|op| op.old_range().len()).sum();
        let comparison = compare(&program(&old.concat()), &program(&new.concat()), &Options::default());
        let gone = comparison.hunks.iter().map(|hunk| hunk.old.len()).sum::<usize>();
        prop_assert_eq!(old.len() - gone, kept);
    }
}

/// Long blocks without common words are compared in bounded time, and every changed word is reported.
#[test]
fn long_blocks_are_compared_in_bounded_time() {
    let block = |end: &str| (0..60_000).map(|i| format!("X{i}{end} ")).collect::<String>() + "\n";
    let (old, new) = (program(&block("")), program(&block(".5")));
    let spans = postform::internals::diff::changed_spans(old.line(0), new.line(0), &Ignore::USUAL);
    assert_eq!(spans.map(|list| list.len()), [60_000; 2]);
    assert_eq!(compare(&old, &new, &Options::default()).edits().count(), 1);
}

/// NEW, made from OLD by applying the edits.
fn applied(old: &Program, new: &Program, comparison: &Comparison) -> Vec<u8> {
    let mut out = Vec::new();
    let mut at = 0;
    for hunk in &comparison.hunks {
        (at..hunk.old.start).for_each(|line| out.extend_from_slice(old.line(line)));
        let mut lines: Vec<usize> = Vec::new();
        for edit in &hunk.edits {
            match *edit {
                Edit::Added(line) | Edit::Changed(_, line) => lines.push(line),
                Edit::Moved(_, line) if hunk.new.contains(&line) => lines.push(line),
                Edit::Removed(_) | Edit::Moved(..) => {}
            }
        }
        lines.sort_unstable();
        lines.iter().for_each(|&line| out.extend_from_slice(new.line(line)));
        at = hunk.old.end;
    }
    (at..old.len()).for_each(|line| out.extend_from_slice(old.line(line)));
    out
}

fn any_program() -> impl Strategy<Value = String> {
    let block = prop_oneof![
        Just("G0 X1."),
        Just("g0 x1."),
        Just("G00 X1.0"),
        Just("N5 G0 X1."),
        Just("X1. G0"),
        Just("G1 Z-1. F5."),
        Just("(A)"),
        Just("(B)"),
        Just(""),
        Just("  "),
        Just("X#1"),
        Just("M30"),
        Just("G0X1."),
        Just("X2."),
        Just("Y3. (A)"),
    ];
    proptest::collection::vec(block, 0..25).prop_map(|lines| lines.iter().map(|line| format!("{line}\n")).collect())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn applying_the_edits_gives_the_new_program(old in any_program(), new in any_program()) {
        let (old, new) = (program(&old), program(&new));
        let comparison = compare(&old, &new, &Options { ignore: Ignore::default(), ..Options::default() });
        let whole: Vec<u8> = (0..new.len()).flat_map(|line| new.line(line).to_vec()).collect();
        prop_assert_eq!(applied(&old, &new, &comparison), whole);
    }

    #[test]
    fn a_program_is_itself(text in any_program()) {
        prop_assert!(compared(&text, &text, Ignore::default(), 0.0).is_same());
    }

    #[test]
    fn ignoring_more_never_finds_more(old in any_program(), new in any_program(), mask in 0u8..64, more in 0u8..64) {
        let ignore = |bits: u8| {
            let names: Vec<&str> = (0..6).filter(|i| bits & 1 << i != 0).map(|i| Ignore::NAMES[i]).collect();
            ignoring(&names.join(","))
        };
        // counts removed and added lines; a changed line counts as one removed and one added line
        let found = |bits: u8| -> usize {
            let weigh = |edit: &Edit| if matches!(edit, Edit::Changed(..)) { 2 } else { 1 };
            compared(&old, &new, ignore(bits), 0.0).edits().map(weigh).sum()
        };
        prop_assert!(found(mask | more) <= found(mask));
    }
}

fn postform(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_postform")).args(arguments).current_dir(root()).output().unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn written(name: &str, text: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&path, text).unwrap();
    path
}

#[test]
fn the_command_and_its_formats() {
    let old = written("diff-old.nc", BASE);
    let new = written(
        "diff-new.nc",
        &BASE.replace("F300.", "F320.").replace("N130 X20.\n", "").replace("(BRACKET)", "(<b>&)"),
    );
    let (old, new) = (old.to_str().unwrap(), new.to_str().unwrap());
    assert_eq!(postform(&["diff", old, old]).status.code(), Some(0));
    assert!(postform(&["diff", old, old]).stdout.is_empty());
    let text = postform(&["diff", old, new]);
    assert_eq!(text.status.code(), Some(1));
    for part in ["-N70 X30. F300.\n?         ^^^^^", "+N70 X30. F320.", "-N130 X20.", "1 block removed", "F in 1 block"]
    {
        assert!(stdout(&text).contains(part), "{part}\n{}", stdout(&text));
    }
    assert_eq!(postform(&["diff", old, new, "--color", "always"]).stdout.iter().filter(|b| **b == 0x1b).count() % 2, 0);
    assert!(stdout(&postform(&["diff", old, new, "--layout", "side"])).contains("F300."));
    let json: serde_json::Value =
        serde_json::from_slice(&postform(&["diff", old, new, "--format", "json"]).stdout).unwrap();
    assert_eq!((&json["postform_diff"], &json["same"]), (&1.into(), &false.into()));
    assert_eq!(json["summary"]["letters"]["F"], 1);
    let html = stdout(&postform(&["diff", old, new, "--format", "html"]));
    assert!(html.contains("<mark>F320.</mark>") && html.contains("(&lt;b&gt;&amp;)"), "{html}");
    // the page loads nothing; the only URL in it is the XML namespace of its picture
    assert!(!html.replace("http://www.w3.org/2000/svg", "").contains("http"));
    let motion = postform(&["diff", old, new, "--motion"]);
    assert_eq!(motion.status.code(), Some(1));
    assert!(
        stdout(&motion).contains("the feed is 320, but 300 in the old program")
            && stdout(&motion).contains("N70 X30. F300."),
        "{}",
        stdout(&motion)
    );
    for arguments in [
        &["diff", old][..],
        &["diff", old, "no.nc"],
        &["diff", old, new, "--ignore", "everything"],
        &["diff", "-", "-"],
        &["diff", old, new, "--motion", "--format", "html"],
        &["diff", "--forms", old, new],
    ] {
        let output = postform(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(output.stdout.is_empty() && !output.stderr.is_empty(), "{arguments:?}");
    }
    let refused = written("diff-refused.nc", "G777\nM30\n");
    assert_eq!(postform(&["diff", old, refused.to_str().unwrap(), "--motion"]).status.code(), Some(1));
}

/// Programs with different codes that are not simulated are not identical.
#[test]
fn other_codes_are_counted_in_the_verdict() {
    let old = written("diff-codes-old.nc", BASE);
    for (code, verdict) in [("M9", "identical: "), ("M31", "equivalent: ")] {
        let text = BASE.replace("N160 ", &format!("N155 {code}\nN160 "));
        let new = written(&format!("diff-codes-{code}.nc"), &text);
        let output = postform(&["diff", "--motion", old.to_str().unwrap(), new.to_str().unwrap()]);
        let said = String::from_utf8(output.stderr.clone()).unwrap();
        assert_eq!(output.status.code(), Some(0), "{code}: {said}");
        assert!(said.starts_with(verdict), "{code}: {said}");
        let counts = said.contains("1 cut after different codes that are not simulated");
        assert_eq!(counts, code == "M31", "{code}: {said}");
    }
}

#[test]
fn forms_and_what_they_change() {
    let fanuc = fs::read_to_string(root().join("postforms/fanuc.pf")).unwrap();
    let changed =
        written("diff-form.pf", &fanuc.replace("G83 X[h] Y[v] Z[d] R[vclear]", "G83 X[h] Y[v] Z[d] R[rplane]"));
    let changed = changed.to_str().unwrap();
    let line = fanuc.lines().position(|line| line.contains("G83 X[h]")).unwrap() + 1;
    let job = "samples/bracket/job.json";
    let against = postform(&["diff", "--form", changed, "--against", "samples/bracket/expected.fanuc.nc", job]);
    assert_eq!(against.status.code(), Some(1), "{}", String::from_utf8_lossy(&against.stderr));
    let origin = format!("printed by {changed}:{line} for operations[3].path[0].cycle.points[0]");
    assert!(stdout(&against).contains(&origin), "{origin}\n{}", stdout(&against));
    let both = postform(&["diff", "--forms", "postforms/fanuc.pf", changed, job]);
    assert!(stdout(&both).contains(&origin) && stdout(&both).contains("R[rplane]"), "{}", stdout(&both));
    let same =
        postform(&["diff", "--form", "postforms/fanuc.pf", "--against", "samples/bracket/expected.fanuc.nc", job]);
    assert_eq!((same.status.code(), stdout(&same).as_str()), (Some(0), ""));
}

/// Uses git as the documentation describes, in a repository of its own.
#[test_with::executable(git)]
#[test]
fn git_shows_programs_by_their_words() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("git-diff");
    _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let run = |arguments: &[&str]| {
        let output = Command::new("git").args(arguments).current_dir(&folder).env("HOME", &folder).output().unwrap();
        assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        stdout(&output)
    };
    run(&["init", "-q"]);
    run(&["config", "user.email", "a@b"]);
    run(&["config", "user.name", "a"]);
    fs::write(folder.join("part.nc"), BASE).unwrap();
    run(&["add", "."]);
    run(&["commit", "-qm", "one"]);
    fs::write(folder.join("part.nc"), renumbered(BASE).replace("F300.", "F320.")).unwrap();
    let tool = format!("'{}' diff \"$LOCAL\" \"$REMOTE\"", env!("CARGO_BIN_EXE_postform"));
    run(&["config", "difftool.postform.cmd", &tool]);
    let shown = run(&["difftool", "-y", "--tool=postform", "--no-prompt"]);
    assert!(shown.contains("F in 1 block") && shown.contains("1 block changed"), "{shown}");
}

/// Shows the page in a real browser, if one is installed.
#[test_with::executable(chromium || chromium-headless-shell || google-chrome)]
#[test]
fn the_page_is_shown_by_a_browser() {
    let old = written("page-old.nc", BASE);
    let new = written("page-new.nc", &BASE.replace("F300.", "F320.").replace("N130 X20.\n", "N130 X21.\nN135 X25.\n"));
    let html = stdout(&postform(&["diff", old.to_str().unwrap(), new.to_str().unwrap(), "--format", "html"]));
    let page = written("page.html", &html);
    let picture = Path::new(env!("CARGO_TARGET_TMPDIR")).join("page.png");
    _ = fs::remove_file(&picture);
    let profile = Path::new(env!("CARGO_TARGET_TMPDIR")).join("browser");
    let browser = ["chromium", "chromium-headless-shell", "google-chrome"].into_iter().find_map(|name| {
        let options = [
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-background-networking",
            "--window-size=1200,700",
        ];
        Command::new(name)
            .args(options)
            .arg(format!("--user-data-dir={}", profile.display()))
            .arg(format!("--screenshot={}", picture.display()))
            .arg(format!("file://{}", page.display()))
            .output()
            .ok()
    });
    let output = browser.unwrap();
    let bytes = fs::read(&picture).unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&output.stderr)));
    // the picture of an empty page is much smaller
    assert!(bytes.starts_with(b"\x89PNG") && bytes.len() > 20_000, "{} bytes", bytes.len());
}

/// A block number is compared if a block refers to it, and a decimal point is compared.
#[test]
fn numbers_that_the_machine_reads_are_compared() {
    let same = |old: &str, new: &str| compared(old, new, Ignore::USUAL, 0.0).is_same();
    let profile = "G71 P10 Q20 U.4 F.2\nN10 G0 X20.\nN15 G1 Z-5.\nN20 X30.\nM30\n";
    assert!(same(profile, &profile.replace("N15", "N16")));
    assert!(!same(profile, &profile.replace("N15", "N5").replace("N10", "N15").replace("N5", "N10")));
    for refers in ["GOTO 10", "GOTO10", "M97 P10", "M99 P10", "M96 P10 Q8"] {
        let jump = format!("N10 X1.\nN11 X2.\n{refers}\n");
        let moved = format!("N11 X1.\nN10 X2.\n{refers}\n");
        assert!(!same(&jump, &moved) && same(&jump, &jump.replace("N11", "N12")), "{refers}");
    }
    assert!(!same("X5\n", "X5.\n") && !same("G4 P500\n", "G4 P500.\n"));
    assert!(same("X0\n", "X0.\n") && same("X5.0\n", "X5.\n") && same("X[1+2]\n", "X[1.+2]\n"));
    assert!(!compared("X5\n", "X5.\n", Ignore::USUAL, 0.001).is_same());
    assert!(compared("X5\n", "X5.\n", Ignore { points: true, ..Ignore::USUAL }, 0.0).is_same());
    let folder = crate::support::folder::Folder::new("diff-points");
    folder.write("a.nc", "G0 X5\n");
    folder.write("b.nc", "G0 X5.\n");
    for (more, status) in [
        (&[][..], 1),
        (&["--ignore", "format,points"], 0),
        (&["--no-point", "whole"], 0),
        (&["--control", "linuxcnc"], 0),
        (&["--control", "haas"], 1),
    ] {
        assert_eq!(folder.run(&[&["diff", "a.nc", "b.nc"], more].concat()).status.code(), Some(status), "{more:?}");
    }
}
