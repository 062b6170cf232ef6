//! Programs that begin in the middle of another one, and selected parts of jobs.

use std::fs;
use std::path::Path;

use crate::support::folder::{Folder, err, out};
use crate::support::{nc, root};

/// The program that begins at this entry, or the message.
fn restarted(folder: &Folder, control: &str, at: &[&str]) -> Result<(String, String), String> {
    let run = folder.run(&[&["restart", "a.nc", "--control", control], at].concat());
    if run.status.success() { Ok((out(&run), err(&run))) } else { Err(err(&run)) }
}

/// Tries every line of the samples' programs as an entry. The rest of the program must be unchanged, or there must be a
/// message.
#[test]
fn every_line_of_the_samples_is_an_entry_or_has_a_reason() {
    let folder = Folder::new("restart-samples");
    for (control, file) in [
        ("haas", "bracket/expected.haas.nc"),
        ("fanuc", "bracket/expected.fanuc.nc"),
        ("linuxcnc", "bracket/expected.linuxcnc.nc"),
        ("grbl", "plate/expected.grbl.nc"),
        ("haas-lathe", "lathe-part/expected.haas-lathe.nc"),
    ] {
        let text = fs::read_to_string(root().join("samples").join(file)).unwrap();
        folder.write("a.nc", &text);
        let lines: Vec<&str> = text.lines().collect();
        let mut made = 0;
        for line in (1..=lines.len()).step_by(7) {
            match restarted(&folder, control, &["--line", &line.to_string()]) {
                Ok((program, said)) => {
                    made += 1;
                    let begin: usize = said
                        .split("begins at line ")
                        .nth(1)
                        .and_then(|rest| rest.split(' ').next())
                        .and_then(|number| number.parse().ok())
                        .unwrap();
                    let rest = lines[begin - 1..].join("\n");
                    assert!(begin <= line && program.trim_end().ends_with(&rest), "{file} {line}: {said}\n{program}");
                    assert!(said.contains("proven"), "{said}");
                }
                Err(said) => assert!(said.contains("can't begin") || said.contains("no block is run"), "{said}"),
            }
        }
        assert!(made * 2 > lines.len() / 7, "{file}: {made} of {}", lines.len() / 7);
    }
}

const PROGRAM: &str = "%\nO1 (PART)\nN1 G21 G17 G40 G49 G80 G90 G94\nN2 T1 M6\nN3 G54 G0 X0 Y0 S1000 M3\nN4 G43 H1 Z50. M8\nN5 Z2.\nN6 G1 Z-1. F100.\nN7 X50. F300.\nN8 G0 Z50.\nN9 (SECOND)\nN10 X10. Y10.\nN11 Z2.\nN12 G41 D1 G1 X20. F200.\nN13 Y40.\nN14 G40 X10.\nN15 G0 Z50. M9\nN16 G91 G28 Z0 M5\nN17 G90 T2 M6\nN18 G55 X5. Y5. S2000 M3\nN19 G43 H2 Z20.\nN20 G98 G81 X5. Y5. Z-9. R2. F80.\nN21 X15.\nN22 G80\nN23 M30\n%\n";

#[test]
fn what_is_in_force_is_put_in_force() {
    let folder = Folder::new("restart-force");
    folder.write("a.nc", PROGRAM);
    let at = |at: &[&str]| restarted(&folder, "fanuc", at).unwrap();
    // for a line in the middle of a compensated contour, the entry is before the tool moves down
    let (program, said) = at(&["--at", "N13"]);
    assert!(said.contains("the program begins at line 13, where the tool is clear, not at line 15"), "{said}");
    let own: Vec<&str> = program.lines().skip(3).take_while(|line| !line.starts_with("N11")).collect();
    assert_eq!(
        own,
        [
            "(RESTART AT LINE 13)",
            "G21 G17 G40 G80",
            "G49 G90 G94",
            "G0 G53 Z0.",
            "T1 M6",
            "G54",
            "S1000 M3",
            "M8",
            "G0 X10. Y10.",
            "G43 H1 Z50.",
            "F300.",
            "G98"
        ]
    );
    // at a tool change
    let (program, _) = at(&["--tool", "2"]);
    assert!(program.contains("G98\nN17 G90 T2 M6\nN18 G55"), "{program}");
    assert!(!program.contains("T1 M6"), "the tool before is not loaded");
    assert!(!program.contains("G0 X"), "the blocks after the change say where they go");
    // at a hole of a cycle, the tool starts at the height before the hole
    let (program, _) = at(&["--at", "21"]);
    assert!(program.contains("G55\nS2000 M3\nM9\nG0 X5. Y5.\nG43 H2 Z20.\n"), "{program}");
    assert!(program.contains("\nN20 G98 G81"), "{program}");
    let (_, said) = at(&["--operation", "second"]);
    assert!(said.contains("begins at line 11"), "{said}");
}

/// The blocks between the mark of the new program and the first old block.
fn way_in(program: &str, first_old: &str) -> String {
    let own = program.split("RESTART AT LINE").nth(1).unwrap_or_else(|| panic!("{program}"));
    own.split(first_old).next().unwrap().lines().skip(1).collect::<Vec<_>>().join(" / ")
}

/// The tool retracts before the spindle or coolant starts. Blocks that start the spindle or coolant do not belong to
/// the head.
#[test]
fn nothing_turns_before_the_tool_is_out() {
    let folder = Folder::new("restart-still");
    folder.write(
        "a.nc",
        "G21 G90\nS1000 M3\nM8\nG54 G0 X0 Y0\nG43 H1 Z50.\nG1 Z-1. F100.\nG0 Z50.\nX10.\nG1 Z-1.\nG0 Z50.\nM30\n",
    );
    let (program, _) = restarted(&folder, "haas", &["--line", "8"]).unwrap();
    assert!(program.starts_with("G21 G90\n(RESTART AT LINE 8)\n"), "{program}");
    let way = way_in(&program, "X10.");
    assert!(way.find("G53").unwrap() < way.find("M3").unwrap() && way.contains("M8"), "{way}");
    // before a tool change the spindle is stopped, even if the old program did not stop it
    folder.write("a.nc", "G21 G90 G94\nT1 M6\nG54 G0 X0 Y0 S1000 M3\nG43 H1 Z50.\nG1 Z-1. F100.\nG0 Z50.\nG0 G53 Z0\nT2 M6\nX5. S500 M3\nG43 H2 Z50.\nG1 Z-2.\nG0 Z50.\nM30\n");
    let (program, _) = restarted(&folder, "haas", &["--tool", "T2"]).unwrap();
    let way = way_in(&program, "T2 M6");
    assert!(way.contains("M5") && !way.contains("M3"), "{way}");
}

/// The tool must not move down to a height that the old program gave with another length offset, or without one.
#[test]
fn a_height_counts_with_its_own_length() {
    let folder = Folder::new("restart-length");
    let program = "G21 G90\nT1 M6\nG54 G0 X0 Y0 S1000 M3\nG43 H1 Z50.\nG1 Z-1. F100.\nG0 Z50.\nG49\nG91 G28 Z0\nG90\nT2 M6\nS900 M3\nM30\n";
    folder.write("a.nc", program);
    for line in ["8", "9"] {
        let said = restarted(&folder, "fanuc", &["--line", line]).unwrap().1;
        assert!(said.contains("begins at line 7"), "{line}: {said}");
    }
}

/// On a control without tool change codes, a stop for changing the tool can be an entry, with the tool at machine zero.
#[test]
fn a_stop_for_a_tool_is_an_entry_where_no_code_changes_it() {
    let folder = Folder::new("restart-stops");
    let text = fs::read_to_string(root().join("samples/plate/expected.grbl.nc")).unwrap();
    folder.write("a.nc", &text);
    let lines: Vec<&str> = text.lines().collect();
    let stops: Vec<usize> = (1..=lines.len()).filter(|line| lines[line - 1] == "M0").collect();
    assert!(stops.len() > 2, "{text}");
    for stop in stops {
        let (program, said) = restarted(&folder, "grbl", &["--line", &(stop + 1).to_string()]).unwrap();
        assert!(said.contains(&format!("begins at line {stop} ")) && said.contains("home the machine first"), "{said}");
        assert!(way_in(&program, "M0").contains("M5"), "{program}");
    }
    // `--clear-z` is a height in the work offset, above the rapids; it is refused if tool lengths are active
    let way = restarted(&folder, "grbl", &["--line", "60", "--clear-z", "40"]).unwrap().0;
    assert!(way.find("G54").unwrap() < way.find("G0 Z40.").unwrap(), "{way}");
    let low = restarted(&folder, "grbl", &["--line", "58", "--clear-z", "-5"]).unwrap_err();
    assert!(low.contains("the height of the rapids"), "{low}");
    folder.write("a.nc", PROGRAM);
    let long = restarted(&folder, "fanuc", &["--tool", "2", "--clear-z", "80"]).unwrap_err();
    assert!(long.contains("is a height of the tool tip") && long.contains("leave --clear-z out"), "{long}");
}

/// A state that the old program never set is not written into the new program. A lathe moves home along one axis after
/// the other.
#[test]
fn what_was_never_said_is_not_written() {
    let folder = Folder::new("restart-unsaid");
    let program = "G21 G40 G80\nT0101\nG97 S1000 M3\nG0 X50. Z2.\nG1 Z-10. F0.2\nG0 X100. Z50.\nT0202\nG97 S900 M3\nG0 X40. Z2.\nG1 Z-5. F.1\nM30\n";
    folder.write("a.nc", program);
    let (program, said) = restarted(&folder, "fanuc-lathe", &["--tool", "202"]).unwrap();
    let way = way_in(&program, "T0202");
    assert!(
        !way.contains("G98") && !way.contains("G99") && !way.contains("G49") && way.contains("G28 U0 / G28 W0"),
        "{way}"
    );
    assert!(said.contains("first goes home along X:"), "{said}");
}

/// If X and Y of a cut come from blocks before the entry, the new program first moves to this position. If the position
/// is unknown, the entry is refused.
#[test]
fn a_cut_is_where_it_was() {
    let folder = Folder::new("restart-where");
    let program = "G21 G90 G94\nT1 M6\nG0 G54 X50. Y50. S1000 M3\nG43 H1 Z50.\nG1 Z-1. F100.\nG0 Z50.\nG0 G53 Z0.\nT2 M6\nG55\nS1000 M3\nG43 H2 Z2.\nG1 Z-5.\nG0 Z50.\nM30\n";
    folder.write("a.nc", program);
    let (new, _) = restarted(&folder, "fanuc", &["--tool", "2"]).unwrap();
    assert!(way_in(&new, "T2 M6").contains("G54 / M5 / M9 / G0 X50. Y50."), "{new}");
    folder.write("a.nc", program.replace("G0 G53 Z0.", "G0 G53 Z0.\nG53 X-10. Y-10."));
    let said = restarted(&folder, "fanuc", &["--tool", "2"]).unwrap_err();
    assert!(
        said.contains("the tool moves down, but the X and Y of the move are given only before the entry"),
        "{said}"
    );
    // if the entry is the program end, the new program still restores the modal state
    folder.write("a.nc", "G21 G90 G17 G94\nG0 G56 X0 Y0 S1000 M3\nZ5.\nX10.\nM30\n");
    let (new, _) = restarted(&folder, "grbl", &["--line", "5"]).unwrap();
    assert!(way_in(&new, "M30").contains("G56 / S1000 M3"), "{new}");
}

/// After an interruption, the table may be at any angle: the new program turns every rotary axis that the old program
/// has turned, also to 0. A turned angle that is unknown at a line is no entry.
#[test]
fn the_table_is_turned_as_in_the_old_program() {
    let folder = Folder::new("restart-turned");
    // (blocks before the entry, the approach, the first line of the old program)
    let cases = [
        ("A0.\nX3.", "G0 X3. Y0. A0.", 12),
        ("A-90.\nX3.", "G0 X3. Y0. A-90.", 12),
        ("G91 A-90.\nG90 X3.", "G0 X3. Y0. A0.", 12),
        // the angle of a machine position is unknown
        ("G53 A0.\nX3.", "G0 X0. Y0. A90.", 10),
    ];
    for (blocks, approach, line) in cases {
        let text = format!(
            "G21 G90 G94\nT1 M6\nG0 G54 X0. Y0. A90. S1000 M3\nG43 H1 Z50.\nZ2.\nG1 Z-1. F100.\nG0 Z50.\nX5.\nX0.\n{blocks}\n(NEXT)\nZ2.\nG1 Z-1.\nG0 Z50.\nA0.\nM30\n"
        );
        folder.write("a.nc", &text);
        let (new, said) = restarted(&folder, "haas", &["--operation", "next"]).unwrap();
        assert!(new.contains(&format!("\n{approach}\nG43 H1 Z50.\n")), "{blocks}: {new}");
        assert!(said.contains(&format!("begins at line {line}")), "{blocks}: {said}");
    }
    // at a tool change, the new program turns the part before it goes down
    let change = "G21 G90 G94\nT1 M6\nG0 G54 X0. Y0. A0. S1000 M3\nG43 H1 Z50.\nG1 Z-1. F100.\nG0 Z50.\nG0 G53 Z0.\nT2 M6\nX9. Y9. S500 M3\nG43 H2 Z50.\nG1 Z-1.\nG0 Z50.\nM30\n";
    folder.write("a.nc", change);
    let (new, _) = restarted(&folder, "haas", &["--tool", "2"]).unwrap();
    assert!(way_in(&new, "T2 M6").contains("G0 X0. Y0. A0."), "{new}");
    folder.write("a.nc", change.replace("T2 M6", "G53 A0.\nT2 M6"));
    let said = restarted(&folder, "haas", &["--tool", "2"]).unwrap_err();
    assert!(said.contains("at line 11 the tool moves down, but its angle A is unknown"), "{said}");
}

/// The new program does not begin while the spindle is stopped at an angle, and a change of the pallet is named.
#[test]
fn an_oriented_spindle_and_a_pallet_are_not_forgotten() {
    let folder = Folder::new("restart-oriented");
    let text = "G21 G90 G94\nT1 M6\nG0 G54 X0. Y0. S1000 M3\nG43 H1 Z50.\nG1 Z-1. F100.\nG0 Z50.\nX5.\nM19 P90\nX9.\n(BORE)\nZ-1.\nX8.\nZ50.\nM3\nG1 Z-2.\nG0 Z50.\nM30\n";
    folder.write("a.nc", text);
    let (new, said) = restarted(&folder, "haas", &["--operation", "bore"]).unwrap();
    assert!(said.contains("begins at line 8") && new.contains("\nM19 P90\n"), "{said}{new}");
    let said = restarted(&folder, "haas", &["--operation", "bore", "--exactly"]).unwrap_err();
    assert!(said.contains("the spindle is stopped at an angle"), "{said}");
    folder.write("a.nc", text.replace("M19 P90", "M60"));
    let (_, said) = restarted(&folder, "fanuc", &["--operation", "bore"]).unwrap();
    assert!(said.contains("M60 of line 8 is not run again"), "{said}");
}

/// The program begins at the first of several equal texts or block numbers. The lines of the others are listed.
#[test]
fn equal_texts_and_block_numbers_are_listed() {
    let folder = Folder::new("restart-equal");
    let holes = |tool: u8| {
        format!("(HOLES)\nN10 T{tool} M6\nG0 G54 X{tool}. Y0. S500 M3\nG43 H{tool} Z50.\nG1 Z-1. F100.\nG0 Z50.\n")
    };
    folder.write("a.nc", format!("G21 G90 G94\n(FACE)\n{}{}{}M30\n", holes(1), holes(2), holes(3)));
    for (where_, others) in [
        (["--operation", "holes"], Some("`holes` of line 9 is also in line 15: to begin there, give --line")),
        (["--at", "N10"], Some("N10 of line 4 is also in lines 10 and 16: to begin there, give --line")),
        (["--line", "9"], None),
        (["--tool", "2"], None),
    ] {
        let said = restarted(&folder, "fanuc", &where_).unwrap().1;
        assert_eq!(said.contains("is also in"), others.is_some(), "{where_:?}: {said}");
        assert!(others.is_none_or(|others| said.contains(others)), "{where_:?}: {said}");
    }
}

/// These do not prevent a restart: subprograms, a T word long before its M6, and a list of operations in the header.
#[test]
fn subprograms_and_tools_named_before_are_no_obstacle() {
    let folder = Folder::new("restart-subs");
    folder.write("a.nc", "O1 (- SECOND)\nG21 G90\nT1 M6\nT2\nG54 G0 X0 Y0 S1000 M3\nG43 H1 Z50.\nM98 P100\nG0 Z50.\nG0 G53 Z0\n(SECOND)\nM6\nG0 X9. Y9. S500 M3\nG43 H2 Z50.\nM98 P100\nG0 Z50.\nM30\nO100\nG1 Z-1. F100.\nG0 Z5.\nM99\n");
    let (program, said) = restarted(&folder, "fanuc", &["--tool", "2"]).unwrap();
    assert!(said.contains("begins at line 11") && way_in(&program, "\nM6").contains("T2"), "{said}{program}");
    assert!(restarted(&folder, "fanuc", &["--line", "14"]).unwrap().1.contains("begins at line 14"));
    // the comment in the header does not count
    let said = restarted(&folder, "fanuc", &["--operation", "second"]).unwrap().1;
    assert!(said.contains("begins at line 10") || said.contains("begins at line 9"), "{said}");
}

/// With `--exactly`, the program begins inside a cut and moves down at feed.
#[test]
fn exactly_goes_down_at_feed() {
    let folder = Folder::new("restart-exactly");
    folder.write("a.nc", "G21 G90 G94 G17\nT1 M6\nG54 G0 X0 Y0 S1000 M3\nG43 H1 Z50.\nX1.\nZ2.\nG1 Z-1. F100.\nX50. F300.\nY20.\nG2 X60. Y30. I10.\nX70. Y40. I10.\nG0 Z50.\nM30\n");
    let at = |line: &str| restarted(&folder, "haas", &["--line", line, "--exactly"]);
    let (program, said) = at("9").unwrap();
    assert!(way_in(&program, "Y20.").contains("G0 X50. Y0. / G43 H1 Z50. / G1 Z-1. F300."), "{program}");
    assert!(said.contains("begins at line 9") && said.contains("feeds down to Z-1."), "{said}");
    let refused = at("11").unwrap_err();
    assert!(
        refused.contains("depends on the G2, G3 or G0 of an earlier block") && refused.contains("leave --exactly out"),
        "{refused}"
    );
    folder.write("a.nc", PROGRAM);
    let refused = restarted(&folder, "fanuc", &["--at", "N13", "--exactly"]).unwrap_err();
    assert!(refused.contains("cutter compensation is on in the block"), "{refused}");
    let refused = restarted(&folder, "fanuc", &["--at", "N21", "--exactly"]).unwrap_err();
    assert!(refused.contains("a canned cycle is active"), "{refused}");
}

/// The tool comes down by rapid only to a height that the old program reached by rapid, above all cuts of the tool.
#[test]
fn no_rapid_goes_down_into_a_cut() {
    let folder = Folder::new("restart-plunge");
    let base = "%\nO0001\nG21 G17 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z50. M8\nG1 Z-5. F100.\nX50.\nY20.\nG0 X40.\nG1 Y10.\nG0 Z50.\nM5\nG91 G28 Z0\nG90\nM30\n%\n";
    folder.write("a.nc", base);
    // a rapid at the depth of the cuts is no entry
    for line in ["9", "11", "12"] {
        let (program, said) = restarted(&folder, "fanuc", &["--line", line]).unwrap();
        assert!(said.contains("begins at line 7") && program.contains("G43 H1 Z50.\n"), "{line}: {said}\n{program}");
    }
    // with --exactly, the tool feeds down from the height of its rapids
    for (line, across) in [("9", "X50. Y0."), ("11", "X40. Y20.")] {
        let (program, said) = restarted(&folder, "fanuc", &["--line", line, "--exactly"]).unwrap();
        assert!(program.contains(&format!("G0 {across}\nG43 H1 Z50.\nG1 Z-5. F100.\n")), "{line}: {said}\n{program}");
    }
    // a height that the program does not give is no height for a rapid, and neither is one of another tool length
    for (from, to) in [("G43 H1 Z50. M8\nG1 Z-5.", "X7.\nG43 H1 M8\nG1 Z-5."), ("G1 Z-5.", "G43 H2\nG1 Z-5.")] {
        folder.write("a.nc", base.replace(from, to));
        let said = restarted(&folder, "fanuc", &["--line", "10", "--exactly"]).unwrap_err();
        assert!(said.contains("no rapid at a known height above its cuts"), "{to}: {said}");
    }
}

#[test]
fn what_cant_be_rebuilt_is_refused() {
    let folder = Folder::new("restart-refused");
    let cases = [
        (PROGRAM.to_owned(), "fanuc", vec!["--tool", "9"], "no tool change to T9, only to T1, T2"),
        (PROGRAM.to_owned(), "fanuc", vec!["--at", "N99"], "no block N99"),
        (PROGRAM.to_owned(), "fanuc", vec!["--line", "999"], "no block is run at line 999"),
        (PROGRAM.to_owned(), "fanuc", vec!["--operation", "third"], "no comment of the program has `third`"),
        (PROGRAM.replace("N21 X15.", "N21 X15. Q"), "fanuc", vec!["--tool", "2"], "line 23"),
        ("".into(), "fanuc", vec!["--tool", "2"], ""),
        (
            "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S100\n2 M30\n3 END PGM A MM\n".into(),
            "heidenhain",
            vec!["--tool", "1"],
            "can't be restarted",
        ),
    ];
    for (text, control, at, part) in cases {
        folder.write("a.nc", &text);
        let said = restarted(&folder, control, &at).unwrap_err();
        assert!(said.contains(part), "{at:?}: {said}");
    }
    folder.write("a.nc", PROGRAM);
    assert_eq!(folder.run(&["restart", "a.nc", "--control", "fanuc"]).status.code(), Some(2), "nowhere");
    let same = folder.run(&["restart", "a.nc", "--control", "fanuc", "--tool", "2", "-o", "a.nc"]);
    assert!(same.status.code() == Some(2) && folder.read("a.nc") == PROGRAM, "{}", err(&same));
    // the entry is before a block that computes values or moves the frame, so the block is run again
    for block in ["#1=5", "G52 X1."] {
        folder.write("a.nc", PROGRAM.replace("N9 (SECOND)", &format!("N9 {block}")));
        let (_, said) = restarted(&folder, "fanuc", &["--tool", "2"]).unwrap();
        assert!(said.contains("begins at line 11"), "{said}");
    }
    folder.write("a.nc", PROGRAM.replace("N7 X50. F300.", "N7 X50. F300.\n#1=5").replace("N2 T1", "#2=1\nN2 T1"));
    let (program, _) = restarted(&folder, "fanuc", &["--tool", "2"]).unwrap();
    assert!(program.contains("#2=1") && program.contains("\nT1 M6"), "{program}");
    // a code whose effect is not tracked is named in the message
    folder.write("a.nc", PROGRAM.replace("N9 (SECOND)", "N9 M31"));
    let (_, said) = restarted(&folder, "haas", &["--tool", "2"]).unwrap();
    assert!(said.contains("M31 of line 11 is not run again"), "{said}");
}

/// LinuxCNC's interpreter makes the same motions after each entry as in the whole program.
#[test_with::executable(rs274)]
#[test]
fn the_interpreter_goes_on_as_in_the_whole_program() {
    let folder = Folder::new("restart-rs274");
    let text = fs::read_to_string(root().join("samples/bracket/expected.linuxcnc.nc")).unwrap();
    folder.write("a.nc", &text);
    let table = Path::new(env!("CARGO_TARGET_TMPDIR")).join("restart-tools.tbl");
    let tools: String = (1..=20).map(|n| format!("T{n} P{n} Z0 D0.5\n")).collect();
    let calls = |text: &str| -> Vec<String> {
        let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("restart.ngc");
        fs::write(&program, text).unwrap();
        let arguments = ["-t".as_ref(), table.as_os_str(), "-g".as_ref(), program.as_os_str()];
        let output = nc::rs274(&[(&table, &tools)], &arguments);
        let moves = ["STRAIGHT_FEED(", "STRAIGHT_TRAVERSE(", "ARC_FEED(", "DWELL(", "CHANGE_TOOL("];
        let lines = String::from_utf8_lossy(&output.stdout).into_owned();
        let call = |line: &str| moves.iter().find_map(|name| line.find(name)).map(|at| line[at..].to_owned());
        lines.lines().filter_map(call).collect()
    };
    let whole = calls(&text);
    let mut made = 0;
    for line in (1..=text.lines().count()).step_by(5) {
        let Ok((program, _)) = restarted(&folder, "linuxcnc", &["--line", &line.to_string()]) else { continue };
        let own = calls(&program);
        let same = own.iter().rev().zip(whole.iter().rev()).take_while(|(one, two)| one == two).count();
        // before these equal calls, there are only the approach moves, which do not cut
        let before = &own[..own.len() - same];
        assert!(same > 0 && before.len() < 7, "{line}: {before:?}\n{program}");
        assert!(!before.iter().any(|call| call.contains("FEED")), "{line}: {before:?}");
        made += 1;
    }
    assert!(made > 15, "{made}");
}

/// A part of a job, selected by tools, is proven like a whole job. It includes the modal state of the operations before
/// it.
#[test]
fn a_part_of_a_job_is_taken() {
    let folder = Folder::new("select");
    let job = fs::read_to_string(root().join("samples/bracket/job.json")).unwrap();
    folder.write("job.json", &job);
    let form = root().join("postforms/haas.pf").to_string_lossy().into_owned();
    let tools = |more: &[&str]| {
        let run = folder.run(&[&["render", "job.json", "--form", &form, "--require-proof"], more].concat());
        assert!(run.status.success(), "{more:?}: {}", err(&run));
        let program = out(&run);
        let changes =
            program.lines().filter(|line| line.contains(" M6")).map(|line| line.split(' ').nth(1).unwrap().to_owned());
        changes.collect::<Vec<_>>().join(" ")
    };
    assert_eq!(tools(&[]), "T1 T2 T3 T4 T5");
    assert_eq!(tools(&["--from-tool", "3"]), "T3 T4 T5");
    assert_eq!(tools(&["--until", "2"]), "T1 T2");
    assert_eq!(tools(&["--only", "2,T5"]), "T2 T5");
    assert_eq!(tools(&["--skip", "1,3", "--until", "4"]), "T2 T4");
    // every named tool must be a tool of the job, so that a typing error does not print another selection
    for (selection, wrong) in [
        ("--only 9", "the job has no T9"),
        ("--only 3,9", "the job has no T9"),
        ("--skip 33", "the job has no T33"),
        ("--until 9 --skip 8", "the job has no T8, T9"),
        ("--from-tool 7", "the job has no T7"),
        ("--from-tool 5 --until 3", "no operation is selected"),
    ] {
        let arguments: Vec<_> =
            ["render", "job.json", "--form", &form].into_iter().chain(selection.split(' ')).collect();
        let run = folder.run(&arguments);
        let message = format!("{wrong}: the tools of the job are T1, T2, T3, T4, T5");
        assert!(run.status.code() == Some(1) && err(&run).contains(&message), "{selection}: {}", err(&run));
    }
    let selects = |selection| err(&folder.run(&["render", "job.json", "--form", &form, "--until", selection]));
    assert!(selects("4").contains("only a part of the job is printed"), "{}", selects("4"));
    assert!(!selects("5").contains("only a part"), "no operation is left out: {}", selects("5"));
    // the work offset of a skipped operation still applies, its spindle and coolant end with its tool
    folder.write(
        "job.json",
        r#"{"postform":1,"program":1,"units":"mm","tools":[{"number":1},{"number":2}],"operations":[
{"tool":1,"work":56,"coolant":"flood","spindle":{"speed":1500,"direction":"cw"},"feed":100,"path":[{"rapid":[1,2,30]},{"line":[1,2,-1]},{"rapid":[1,2,30]}]},
{"tool":2,"spindle":{"speed":900,"direction":"ccw"},"feed":80,"path":[{"rapid":[9,2,30]},{"line":[9,2,-1]},{"rapid":[9,2,30]}]},
{"tool":2,"feed":80,"path":[{"line":[9,5,-1]},{"rapid":[9,2,30]}]}]}"#,
    );
    let second = folder.run(&["render", "job.json", "--form", &form, "--from-tool", "2", "--set", "header=off"]);
    let program = out(&second);
    assert!(second.status.success(), "{}", err(&second));
    assert!(
        program.contains("G56 X9. Y2.") && program.contains("S900 M4") && program.contains("H2 Z30. M9"),
        "{program}"
    );
    folder
        .write("cut.json", folder.read("job.json").replace("[{\"rapid\":[9,2,30]},{\"line\":[9,2", "[{\"line\":[9,2"));
    let cut = folder.run(&["render", "cut.json", "--form", &form, "--from-tool", "2"]);
    assert!(cut.status.code() == Some(1) && err(&cut).contains("PR060"), "{}", err(&cut));
}

/// A part of a job has the same state as in the whole job. Text of a left-out operation sets spindle and coolant as in
/// the whole program; if its effect is unknown, the part is refused.
#[test]
fn a_part_of_a_job_keeps_the_state_of_left_out_operations() {
    let folder = Folder::new("select-state");
    let path = |z: i32| {
        format!(r#"{{"rapid":[0,0,50]}},{{"rapid":[0,0,2]}},{{"line":[0,0,{z}],"feed":100}},{{"rapid":[0,0,50]}}"#)
    };
    let subprogram = r#""subprograms":[{"number":1,"path":[{"text":"G68 X0 Y0 R90."}]}],"#;
    let second = |tool: u32, item: &str, more: &str| {
        let (form, subprogram) = match item.contains("call") {
            true => ("tests/data/forms/subprograms.pf", subprogram),
            false => ("postforms/haas.pf", ""),
        };
        let job = format!(
            r#"{{"postform":1,"program":1,"units":"mm","tools":[{{"number":1}},{{"number":2}}],
{subprogram}"operations":[
{{"tool":1,"work":54,"spindle":{{"speed":1000,"direction":"cw"}},"path":[{}{item}]}},{{"tool":{tool}{more},"path":[{}]}}]}}"#,
            path(-1),
            path(-2)
        );
        folder.write("job.json", &job);
        let form = root().join(form).to_string_lossy().into_owned();
        folder.run(&[
            "render",
            "job.json",
            "--form",
            &form,
            "--split",
            "operation",
            "--out-dir",
            "nc",
            "--name",
            "{operation}",
        ])
    };
    let own = r#","spindle":{"speed":900,"direction":"cw"}"#;
    let cases: &[(&str, u32, &str, &str)] = &[
        ("S500 M4", 1, "", "S500 M4"),
        ("S500", 1, "", "S500 M3"),
        ("M8", 1, "", "Z50. M8"),
        ("M8", 2, own, "Z50. M9"),
        ("M88", 2, own, "S900 M3"),
        ("M19", 2, own, "S900 M3"),
        ("M1 (look)", 1, "", "S1000 M3"),
        ("G4 P500", 1, "", "S1000 M3"),
    ];
    for (text, tool, more, block) in cases {
        let output = second(*tool, &format!(r#",{{"text":"{text}"}}"#), more);
        assert!(output.status.success(), "{text}: {}", err(&output));
        let program = folder.read("nc/OP02.nc");
        assert!(program.contains(block), "{text}: {program}");
    }
    let text = |text: &str| format!(r#",{{"text":"{text}"}}"#);
    let infeed = r#",{"infeed":[1,1,50],"side":"left"}"#;
    let refused: &[(&str, u32, &str)] = &[
        (&text("G55"), 1, "the effect of the text `G55` on this operation is unknown"),
        (&text("G68 X0 Y0 R90."), 2, "the text `G68 X0 Y0 R90.`"),
        (&text("G52 X100."), 2, "the text `G52 X100.`"),
        (&text("X5."), 2, "the text `X5.`"),
        (&text("G253"), 2, "the text `G253`"),
        (&text("#100=5"), 2, "the text `#100=5`"),
        (&text("M19"), 1, "the text `M19`"),
        (r#",{"call":{"sub":1}}"#, 2, "the text in subprogram 1"),
        (infeed, 1, "cutter compensation stays on"),
    ];
    for (item, tool, why) in refused {
        let output = second(*tool, item, own);
        assert!(!output.status.success() && err(&output).contains("PR060"), "{item}: {}", err(&output));
        assert!(err(&output).replace("\n  │ ", " ").contains(why), "{item}: {}", err(&output));
    }
}

/// The tool axis at the end of a left-out operation stays until the job tilts the tool again.
#[test]
fn a_part_of_a_job_keeps_the_tilt_of_the_tool() {
    let folder = Folder::new("select-tilt");
    let job = |second: &str| {
        format!(
            "PARTNO/X\nUNITS/MM\nMULTAX/ON\nLOADTL/1\nSPINDL/1000,CLW\nFEDRAT/100,MMPM\nRAPID\nGOTO/0,0,50,0,0,1\n\
GOTO/0,0,0,0,0,1\nGOTO/0,0,0,0,1,0\nLOADTL/2\nSPINDL/1000,CLW\nRAPID\nGOTO/0,60,50,{second}\nGOTO/0,60,0,{second}\n\
RAPID\nGOTO/0,60,50,{second}\nFINI\n"
        )
    };
    let form = root().join("postforms/haas.pf").to_string_lossy().into_owned();
    let run = |second: &str| {
        folder.write("tilt.cl", job(second));
        folder.run(&["render", "tilt.cl", "--form", &form, "--program", "5", "--only", "2", "--require-proof"])
    };
    let tilted = run("0,1,0");
    assert!(!tilted.status.success() && err(&tilted).contains("PR008"), "{}", err(&tilted));
    let upright = run("0,0,1");
    assert!(upright.status.success(), "{}", err(&upright));
}
