//! The motions of programs on different controls: canned cycles of Fanuc mills and of EMC2's manual, subprograms,
//! refusals.
//!
//! LinuxCNC's own rules are tested with recorded programs (`nc_golden.rs`) and with its interpreter (`linuxcnc_random.rs`).

use crate::support::control;
use postform::diag::Diag;
use postform::internals::control::Control;
use std::io::Cursor;

use crate::support::nc::{Call, simulated};
use postform::internals::nc::{Action, RunError, RunSettings, Simulator, Unpointed};

/// Motions as text: `T` rapid, `F` feed.
fn motions(control: &'static Control, program: &str) -> Vec<String> {
    let (calls, ended, _) = simulated(program.as_bytes(), RunSettings::new(control));
    assert_eq!(ended, Ok(()), "{program}");
    calls.iter().map(shown).collect()
}

fn shown(call: &Call) -> String {
    let at = |to: &[f64; 6]| {
        let round = |v: f64| (v * 1e4).round() / 1e4 + 0.0;
        let angles: String = to[3..].iter().filter(|a| **a != 0.0).map(|a| format!(" a{a}")).collect();
        format!("{} {} {}{angles}", round(to[0]), round(to[1]), round(to[2]))
    };
    match call {
        Call::Rapid(to) => format!("T {}", at(to)),
        Call::Feed(to) => format!("F {}", at(to)),
        Call::Arc(to, center, turns) => format!("ARC {} about {center:?} {turns}", at(to)),
        Call::Dwell(seconds) => format!("dwell {seconds}"),
        Call::Spindle(rotation) => rotation.name().into(),
        Call::Orient => "orient".into(),
        Call::Stop => "stop here".into(),
        Call::OptionalStop => "optional stop".into(),
    }
}

/// The code and line of a refusal.
fn refused(control: &'static Control, program: &str) -> (String, u64) {
    refused_with(RunSettings::new(control), program)
}

fn refused_with(settings: RunSettings, program: &str) -> (String, u64) {
    let (diag, line) = refusal(settings, program);
    (diag.code.name().into(), line)
}

/// The finding of the block that the control refuses, and the line of this block.
fn refusal(settings: RunSettings, program: &str) -> (Box<Diag>, u64) {
    let mut simulator = Simulator::new(Cursor::new(program), settings);
    loop {
        match simulator.step(&mut Vec::new()) {
            Ok(true) => {}
            Ok(false) => panic!("not refused: {program}"),
            Err(RunError::Refused(diag, line)) => {
                assert!(diag.help.as_ref().is_some_and(|help| !help.is_empty()), "{}", diag.message);
                return (diag, line);
            }
            Err(RunError::Io(error)) => panic!("{error}"),
        }
    }
}

#[test]
fn an_additional_work_offset_needs_a_number_that_postform_knows() {
    for (block, message) in [
        ("G54.1 G0 X1.", "an additional work offset without its number"),
        ("G54.1 P141 G0 X1.", "postform knows no work offset P141, only P1 to P99"),
        ("G54.1 P0 G0 X1.", "postform knows no work offset P0, only P1 to P99"),
    ] {
        let (found, _) = refusal(RunSettings::new(control("fanuc")), &format!("{block}\nM30\n"));
        assert!(found.message.starts_with(message), "{}", found.message);
        assert!(found.help.unwrap().contains("write P1 to P99"));
    }
}

const START: &str = "G21 G17 G90 G94\nS500 M3\nG0 X0. Y0. Z10.\n";

fn fanuc(blocks: &str) -> Vec<String> {
    let lines = motions(control("fanuc"), &format!("{START}{blocks}\nM30\n"));
    lines[2..].to_vec() // without the spindle and the first rapid
}

#[test]
fn cycles_of_a_fanuc() {
    let drill = |blocks| fanuc(blocks);
    // G98 is the default: the tool returns to the height that it had before the first block of the cycle
    assert_eq!(
        drill("G81 X1. Y1. Z-5. R2. F100.\nX2.\nG80"),
        ["T 1 1 10", "T 1 1 2", "F 1 1 -5", "T 1 1 10", "T 2 1 10", "T 2 1 2", "F 2 1 -5", "T 2 1 10"]
    );
    assert_eq!(
        drill("G99 G82 X1. Z-5. R2. P500 F100.\nX2. P1500\nG80"),
        ["T 1 0 10", "T 1 0 2", "F 1 0 -5", "dwell 0.5", "T 1 0 2", "T 2 0 2", "F 2 0 -5", "dwell 1.5", "T 2 0 2"]
    );
    // the words stay active when the cycle changes
    assert_eq!(
        drill("G99 G81 X1. Z-5. R2. F100.\nG85 X2.\nG80"),
        ["T 1 0 10", "T 1 0 2", "F 1 0 -5", "T 1 0 2", "T 2 0 2", "F 2 0 -5", "F 2 0 2", "T 2 0 2"]
    );
    // the usual retract is 0.5 mm
    assert_eq!(
        drill("G99 G83 X1. Z-3. R0. Q2. F100.\nG80"),
        ["T 1 0 10", "T 1 0 0", "F 1 0 -2", "T 1 0 0", "T 1 0 -1.5", "F 1 0 -3", "T 1 0 0"]
    );
    assert_eq!(
        drill("G99 G73 X1. Z-3. R0. Q2. F100.\nG80"),
        ["T 1 0 10", "T 1 0 0", "F 1 0 -2", "T 1 0 -1.5", "F 1 0 -3", "T 1 0 0"]
    );
    assert_eq!(
        drill("G98 G84 X1. Z-3. R2. F500.\nG80"),
        ["T 1 0 10", "T 1 0 2", "F 1 0 -3", "ccw", "F 1 0 2", "cw", "T 1 0 10"]
    );
    assert_eq!(
        drill("G99 G76 X1. Z-3. R2. Q0.2 F50.\nG80")[2..],
        ["F 1 0 -3", "stop", "orient", "T 1.2 0 -3", "T 1.2 0 2", "T 1 0 2", "cw"]
    );
    assert_eq!(
        drill("G98 G87 X1. Z-3. R-8. Q0.2 F50.\nG80"),
        [
            "T 1 0 10",
            "stop",
            "orient",
            "T 1.2 0 10",
            "T 1.2 0 -8",
            "T 1 0 -8",
            "cw",
            "F 1 0 -3",
            "stop",
            "orient",
            "T 1.2 0 -3",
            "T 1.2 0 10",
            "T 1 0 10",
            "cw"
        ]
    );
    assert_eq!(drill("G99 G86 X1. Z-3. R2. F50.\nG80")[2..], ["F 1 0 -3", "dwell 0", "stop", "T 1 0 2", "cw"]);
    // K is the number of holes in a row; K0 only stores the words
    assert_eq!(
        drill("G91 G99 G81 X1. Z-4. R-8. K2 F100.\nG80 G90"),
        ["T 1 0 10", "T 1 0 2", "F 1 0 -2", "T 1 0 2", "T 2 0 2", "F 2 0 -2", "T 2 0 2"]
    );
    assert_eq!(drill("G99 G81 X1. Z-5. R2. K0 F100.\nX2.\nG80").len(), 4);
    // G80 restores the motion before the cycle
    assert_eq!(drill("G1 X3. F100.\nG99 G81 X1. Z-5. R2.\nG80\nX9.").last().unwrap(), "F 9 0 2");
    // a block without X, Y, Z or R drills no hole
    assert_eq!(drill("G99 G81 X1. Z-5. R2. F100.\nM8\nF50.\nG4 P100\nG80").len(), 5);
    // in G18 the holes are along Y
    assert_eq!(drill("G18\nG99 G81 X1. Y-5. Z0. R-2. F100.\nG80")[1..3], ["T 1 -2 0", "F 1 -5 0"]);
}

#[test]
fn programs_of_a_fanuc_and_their_subprograms() {
    let program = "%\nO1\nG21 G90 G0 X0. Y0. Z1.\nM98 P100 L2\nM98 P20200\nM30\nO100\nG91 X1.\nG90 M99\nO200\nG91 Y1.\nG90 M99\n%\n";
    assert_eq!(motions(control("fanuc"), program), ["T 0 0 1", "T 1 0 1", "T 2 0 1", "T 2 1 1", "T 2 2 1"]);
    assert_eq!(refused(control("fanuc"), "G21\nM98 P7\nM30\n"), ("PN016".into(), 2));
    // only the given axes move home, through the intermediate position
    let home = motions(control("fanuc"), "G21 G90 G0 X1. Y2. Z3.\nG91 G28 Z0\nG90\nM30\n");
    assert_eq!(home, ["T 1 2 3", "T 1 2 3", "T 1 2 0"]);
    assert_eq!(motions(control("fanuc"), "G90 G10 L2 P1 X5.\n#1=2.5\nG0 X#1 Y[#1*2]\nM30\n"), ["T 2.5 5 0"]);
}

#[test]
fn lengths_without_a_point() {
    let program = "G21\nG0 X1000 Z0\nM30\n";
    assert_eq!(refused(control("fanuc"), program), ("PN017".into(), 2));
    for (unpointed, x) in [(Unpointed::Whole, 1000.0), (Unpointed::Increments, 1.0)] {
        let (calls, ended, _) =
            simulated(program.as_bytes(), RunSettings { unpointed, ..RunSettings::new(control("fanuc")) });
        assert_eq!((calls, ended), (vec![Call::Rapid([x, 0.0, 0.0, 0.0, 0.0, 0.0])], Ok(())));
    }
    assert_eq!(motions(control("linuxcnc"), program), ["T 1000 0 0"]);
}

/// Rules of EMC2's old manual that differ from LinuxCNC: the height before each block counts, and pecks dwell and
/// retract completely.
#[test]
fn cycles_of_emc2() {
    let emc2 = |program: &str| motions(control("emc2"), program);
    let holes = |program: &str| -> Vec<String> {
        emc2(program).into_iter().filter(|line| line.starts_with('F')).map(|line| line[2..].to_owned()).collect()
    };
    assert_eq!(
        emc2("G0 X1 Y2 Z3\nG90 G81 G98 X4 Y5 Z1.5 R2.8 F10\nM2\n")[1..],
        ["T 4 5 3", "T 4 5 2.8", "F 4 5 1.5", "T 4 5 3"]
    );
    let repeated = emc2("G0 X1 Y2 Z3\nG91 G81 G98 X4 Y5 Z-0.6 R1.8 L3 F10\nM2\n");
    assert_eq!(
        repeated[1..],
        [
            "T 1 2 4.8",
            "T 5 7 4.8",
            "F 5 7 4.2",
            "T 5 7 4.8",
            "T 9 12 4.8",
            "F 9 12 4.2",
            "T 9 12 4.8",
            "T 13 17 4.8",
            "F 13 17 4.2",
            "T 13 17 4.8"
        ]
    );
    let eight = "G90 G0 X0 Y0 Z0\nG1 F10 X0 G4 P0.1\nG81 X1 Y0 Z0 R1\nX2\nX3\nX4\nY1 Z0.5\nX3\nX2\nX1\nG80\nG0 X0\nY0\nZ0\nM2\n";
    assert_eq!(holes(eight)[1..], ["1 0 0", "2 0 0", "3 0 0", "4 0 0", "4 1 0.5", "3 1 0.5", "2 1 0.5", "1 1 0.5"]);
    // there is no vertical move of zero length at a hole, and all twelve holes are equally deep
    assert_eq!(emc2(eight).iter().filter(|line| line.starts_with('T')).count(), 1 + 1 + 8 * 2 + 3);
    let twelve = "G90 G0 X0 Y0 Z0\nG1 F50 X0 G4 P0.1\nG91 G81 X1 Y0 Z-0.5 R1 L4\nX0 Y1 R0 L3\nX-1 Y0 L3\nX0 Y-1 L2\nG80\nG90 G0 X0\nY0\nZ0\nM2\n";
    let bottoms = holes(twelve)[1..].to_vec();
    assert_eq!(bottoms.len(), 12);
    assert!(bottoms.iter().all(|place| place.ends_with(" 0.5")), "{bottoms:?}");
    let pecks = emc2("G20 F10 G0 X0 Y0 Z0.5\nG98 G83 X0.285 Y0.00 Z0.1 R0.2 Q0.05\nM2\n");
    assert_eq!(
        pecks[1..],
        [
            "T 0.285 0 0.5",
            "T 0.285 0 0.2",
            "F 0.285 0 0.15",
            "dwell 0.25",
            "T 0.285 0 0.5",
            "F 0.285 0 0.1",
            "dwell 0.25",
            "T 0.285 0 0.5"
        ]
    );
    assert_eq!(emc2("G0 Z3\nG98 G85 X1 Z1 R2 F10\nM2\n")[1..], ["T 1 0 3", "T 1 0 2", "F 1 0 1", "F 1 0 3"]);
    assert_eq!(
        emc2("G0 Z3\nG98 G81 X1 Z1 R2 F10\nG99 X2\nG98 X3\nM2\n").last().unwrap(),
        "T 3 0 2",
        "G98 returns to the Z before this block, which G99 left at R"
    );
}

#[test]
fn what_a_control_refuses_is_an_error_with_its_block() {
    let cases = [
        ("G21\nG0 X1. X2.\nM30", "PN002", 2),
        ("G21\nG0 X1.\nG777 Z1.\nM30", "PN003", 3),
        ("G90 G91\nM30", "PN004", 1),
        ("G0 X1. I2.\nM30", "PN005", 1),
        ("X1.\nM30", "PN006", 1),
        ("G81 X1. Z-1. F10.\nM30", "PN007", 1),
        ("G1 X1.\nM30", "PN008", 1),
        ("G2 X1. Y1. I5. F10.\nM30", "PN009", 1),
        ("G0 X1.\n", "PN010", 1),
        ("", "PN010", 0),
        ("%\nG0 X1.\n%\n", "PN010", 3),
        ("G81 X1. R-2. Z-1. F10.\nM30", "PN011", 1),
        ("M5\nG87 X1. R-2. Z-1. Q.1 F10.\nM30", "PN012", 2),
        ("G41 D1\nG1 X1. F10.\nG81 X2. Z-1. R1.\nM30", "PN013", 3),
        ("G0 X#9\nM30", "PN016", 1),
        ("G0 X[1/0]\nM30", "PN014", 1),
        ("M98 P1\nM30", "PN016", 1),
        ("G68 X0 Y0 R45.\nM30", "PN016", 1),
        ("G5 P10001\nM30", "PN016", 1),
        ("IF[#1 EQ 1]GOTO 10\nM30", "PN016", 1),
        ("G0 X5\nM30", "PN017", 1),
        ("G83 X1. Z-1. R0 Q0. F10.\nM30", "PN018", 1),
        ("G0 X1. ?\nM30", "PN001", 1),
        ("G0 X1.2.3\nM30", "PN001", 1),
        ("(open\nM30", "PN001", 1),
    ];
    for (program, code, line) in cases {
        assert_eq!(refused(control("fanuc"), program), (code.into(), line), "{program}");
    }
    for (program, code, line) in [
        ("o1 sub\nG0 X1\nM2", "PN015", 3),
        ("o1 while [1]\nG4 P0\no1 endwhile\nM2", "PN015", 1),
        ("o1 call\nM2", "PN016", 1),
        ("o1 sub\no1 call\no1 endsub\no1 call\nM2", "PN015", 2),
        ("G0 X[[[[1\nM2", "PN014", 1),
        ("G0 X#1#2\nM2", "PN014", 1),
        ("G0 X1 (a (b))\nM2", "PN001", 1),
    ] {
        let (found, at) = refused(control("linuxcnc"), program);
        assert_eq!(found, code, "{program} at {at}");
        assert!(at >= line, "{program}: {at}");
    }
    let deep = format!("G0 X{}1{}\nM2\n", "[".repeat(100), "]".repeat(100));
    assert_eq!(refused(control("linuxcnc"), &deep).0, "PN014");
    let long = format!("G0 X1 ({})\nM2\n", "x".repeat(100_000));
    assert_eq!(refused(control("fanuc"), &long), ("PN001".into(), 1));
}

/// A word that no code of the block reads is refused: without it, the simulation would be of another program.
#[test]
fn words_that_no_code_reads_are_refused() {
    let cases = [
        ("fanuc", "M3 S100 P11", "PN005"),
        ("fanuc", "M8 R5.", "PN005"),
        ("fanuc", "G10 L2 P1 X1. R7.", "PN005"),
        ("fanuc", "G10 L10 P1 R5. X7.", "PN005"),
        ("fanuc", "G91 G30 P7 Z0.", "PN018"),
        ("fanuc", "G4 P100 X1.", "PN004"),
        ("fanuc", "G81 X1. Z-5. R2. F100. K2 L3", "PN004"),
        ("haas", "M30 P5", "PN005"),
        ("linuxcnc", "M3 $1 S500", "PN016"),
        ("fanuc-lathe", "G4 U1. W2.", "PN005"),
        ("fanuc-lathe", "G0 H90.", "PN005"),
        ("fanuc-lathe", "G32 Z-5. F1. R2.", "PN016"),
        ("fanuc-lathe", "G90 X8. Z-5. F.2 Y1.", "PN016"),
        ("fanuc-lathe", "G92 X8. Z-5. F1. C5.", "PN016"),
        ("fanuc-lathe", "G92 X8. Z-5. F1. R1. I1.", "PN004"),
        ("fanuc-lathe", "G76 P010060", "PN007"),
        ("fanuc-lathe", "G71 U1. R1. P7", "PN007"),
        ("fanuc-lathe", "G74 R1.\nG74 Z-5. Q1000 F.1 C5.", "PN016"),
        ("haas-lathe", "G0 H90.", "PN005"),
    ];
    for (name, blocks, code) in cases {
        let start = if name.ends_with("lathe") { "G21 G99\nT0101\nM3 S500\nG0 X10. Z1.\n" } else { START };
        assert_eq!(refused(control(name), &format!("{start}{blocks}\nM30\n")).0, code, "{name}: {blocks}");
    }
    let cycle = |end: &str| {
        let profile = "N1 G0 X4.\nG1 Z-3. F.1\nN2 X10.";
        format!("G21 G99\nT0101\nM3 S500\nG0 X10. Z1.\nG71 U1. R1.\nG71 P1 Q2 U0 W0 F.2{end}\n{profile}\nM30\n")
    };
    assert!(motions(control("fanuc-lathe"), &cycle(" M8")).len() > 5);
    for code in ["M30", "M5", "M9", "M0", "M99"] {
        let found = refused(control("fanuc-lathe"), &cycle(&format!(" {code}")));
        assert_eq!(found, ("PN016".into(), 6), "{code} would take effect after the cycle");
    }
}

/// A Fanuc stops at a decimal point in D, H, M, S and T. An expression may have one, and so may the letters that a control
/// file leaves out. Of other controls it is not public, or they accept the point.
#[test]
fn whole_numbers_have_no_decimal_point() {
    for word in ["S3000.", "S3000.0", "M3.", "T2.", "G43 H1."] {
        let program = format!("{START}{word}\nM30\n");
        assert_eq!(refused(control("fanuc"), &program).0, "PN018", "{word}");
        assert!(!motions(control("haas"), &program).is_empty() && !motions(control("linuxcnc"), &program).is_empty());
    }
    assert_eq!(refused(control("fanuc-lathe"), "G21 G99\nT0101\nG97 S500. M3\nM30\n").0, "PN018");
    assert!(!motions(control("fanuc"), &format!("{START}#1=3000.\nS#1 M[3.]\nG54.1 P1\nM30\n")).is_empty());
    let own = "name = \"own\"\ntitle = \"with a point in S\"\nlike = \"fanuc\"\n[numbers]\nno_point = \"DHMT\"\n";
    let own: &'static Control = Box::leak(Box::new(Control::read("own.toml", own).unwrap()));
    assert!(!motions(own, &format!("{START}S3000.\nM30\n")).is_empty());
    assert_eq!(refused(own, &format!("{START}M3.\nM30\n")).0, "PN018");
}

/// K is the number of fine bores in G17. In another plane, K may be the shift of the tool.
#[test]
fn the_repeats_of_a_fine_bore() {
    let holes = |k: &str| fanuc(&format!("G91 G76 X5. R-5. Z-3. Q.5 F10.{k}\nG80"));
    assert_eq!(holes("").len() * 3, holes(" K3").len());
}

/// An O word begins a program. A file can contain subprograms after the main program, but no other main program.
#[test]
fn a_file_has_one_main_program() {
    let cut = "G1 X5. F10.";
    let sub = "O5\nG1 X9.\nM99\n";
    assert_eq!(motions(control("fanuc"), &format!("O7\n{START}{cut}\nM30\n{sub}%\nO8\nM30\n")).len(), 3);
    for name in ["fanuc", "haas", "mazak"] {
        let inside = format!("O7\n{START}O5\n{cut}\nM30\n");
        assert_eq!(refused(control(name), &inside), ("PN015".into(), 5), "{name}");
        let another = format!("O7\n{START}{cut}\nM30\n{sub}O8\n{cut}\nM30\n");
        assert_eq!(refused(control(name), &another), ("PN015".into(), 10), "{name}");
    }
}

/// On a Fanuc, the zero of G52 is measured from the zero that G92 has shifted, and G92 ends G52. LinuxCNC has one shift
/// for both codes.
#[test]
fn g52_and_g92_add_up_on_a_fanuc() {
    let machine = |name: &str, blocks: &str| {
        let text = format!("{START}X5.\n{blocks}\nG1 G53 X0. F10.\nM30\n");
        motions(control(name), &text).last().unwrap().clone()
    };
    for (blocks, fanuc_x, linuxcnc_x) in [
        ("G92 X0. Y0. Z10.", "-5", "-5"),
        ("G92 X0. Y0. Z10.\nG52 X0. Y0. Z0.", "-5", "0"),
        ("G92 X0. Y0. Z10.\nG52 X3.", "-8", "-3"),
        ("G52 X3.\nG92 X1. Y0. Z10.", "-4", "-4"),
    ] {
        for (name, x) in [("fanuc", fanuc_x), ("linuxcnc", linuxcnc_x)] {
            let found = machine(name, blocks);
            assert_eq!(found.split(' ').nth(1), Some(x), "{name}: {blocks}: {found}");
        }
    }
}

/// In a block with G28, G0 sets the motion of later blocks, and the axis words belong to G28. In a block with G53, the
/// axis words belong to G0 or G1.
#[test]
fn the_axis_words_of_a_block_have_one_code() {
    let went = fanuc("X1. Y1.\nG1 G28 X5. Y5.\nX7. F10.");
    assert_eq!(went, ["T 1 1 10", "T 5 5 10", "T 0 0 10", "F 7 0 10"]);
    for (block, code) in [("G53 G81 X1. Y1. Z-1. R1. F10.", "PN006"), ("G28 G81 X1. Y1. Z-1. R1. F10.", "PN004")] {
        assert_eq!(refused(control("fanuc"), &format!("{START}{block}\nM30\n")), (code.to_owned(), 4), "{block}");
    }
}

/// Cases that a machinist found in a trial, or that the real interpreter showed.
#[test]
fn rules_that_are_easily_missed() {
    let both = |program: &str| motions(control("linuxcnc"), program);
    assert_eq!(both("G80 G0 X1\nM2\n"), ["T 1 0 0"], "G80 beside a motion counts for nothing");
    assert_eq!(both("G0 X[1 EQ 1.00005]\nM2\n"), ["T 1 0 0"]);
    assert_eq!(both("#1=0\no1 do\n#1=[#1+1]\no1 continue\nG0 X1\no1 while [#1 LT 3]\nM2\n"), Vec::<String>::new());
    assert_eq!(both("\u{feff}G0 X1\nM2\n"), ["T 1 0 0"], "the mark before UTF-8");
    assert_eq!(refused(control("linuxcnc"), "G0 X5 o1 if [1]\nM2\n"), ("PN015".into(), 1));
    assert_eq!(refused(control("linuxcnc"), "#5161=10\nM2\n"), ("PN016".into(), 1));
    assert_eq!(refused(control("linuxcnc"), "F10\nG81 X1 Z-1 R1\nG53 X2\nM2\n"), ("PN006".into(), 3));
    assert_eq!(
        refused(control("linuxcnc"), "M3 S1\nT1 M6\nF10\nG84 X2 Z-1 R1\nM2\n"),
        ("PN012".into(), 4),
        "M6 stops the spindle"
    );
    assert_eq!(refused(control("fanuc"), "G81 X1. Z-1. R.1 F5.\nX3. G4 P200\nM30\n"), ("PN004".into(), 2));
    assert_eq!(refused(control("fanuc"), "G1 G41 X1. F9.\nM30\n"), ("PN007".into(), 1));
    // the spindle stops after the motion
    assert_eq!(fanuc("G1 X1. F10. M5")[..], ["F 1 0 10", "stop"]);
    // a full circle with its centre alone
    assert_eq!(fanuc("G2 X0. I1. F10.\nI2.").len(), 2);
    // blocks and loops with too many moves
    let many = refused(control("linuxcnc"), "F10\nG91 G83 X1 Z-10000 R1 Q.011 L9999\nM2\n");
    assert_eq!(many, ("PN018".into(), 2));
    let deep = "F10. G91\nG81 X0. Y0. Z-.1 R.1\nM98 P2 L9999\nM30\nO2\nM98 P3 L9999\nM99\nO3\nX.0001 K9999\nM99\n";
    assert_eq!(refused(control("fanuc"), deep).0, "PN015");
}

/// Programs that differ only in line ends, encoding or case are the same program.
#[test]
fn the_same_program_however_it_is_written() {
    let plain = "%\nN10 G21 G90\nN20 G0 X1.5 Y-2.\nG1 Z-1. F100.\nM30\n%\n";
    let wanted = motions(control("fanuc"), plain);
    let variants = [
        plain.replace('\n', "\r\n"),
        plain.replace(' ', ""),
        plain.replace(' ', "\t  "),
        plain.replace("G21", "(caf\u{e9} \u{fffd}) G21"),
        plain.replace("X1.5", "X 1. 5"),
        plain.replace("G0 ", "G00 "),
        plain.replace("N20", "/N20"),
    ];
    for text in variants {
        assert_eq!(motions(control("fanuc"), &text), wanted, "{text:?}");
    }
    // a Fanuc may refuse small letters
    assert_eq!(refused(control("fanuc"), &plain.to_lowercase()), ("PN016".into(), 2));
    assert_eq!(motions(control("linuxcnc"), &plain.to_lowercase()), wanted);
    let latin1 = [&b"(90\xb0)\n"[..], &plain.as_bytes()[2..]].concat();
    let (calls, ended, _) = simulated(&latin1, RunSettings::new(control("fanuc")));
    assert_eq!((calls.len(), ended), (2, Ok(())));
    let skipped = RunSettings { block_delete: true, ..RunSettings::new(control("fanuc")) };
    let (calls, ..) = simulated(
        plain.replace("N20", "/N20").replace("G1", "G0 X0 G1").replace("G0 X0 G1", "G1 X0").as_bytes(),
        skipped,
    );
    assert_eq!(calls.len(), 1, "the deleted block is left out");
}

/// Simple blocks are read by a faster function, but not if they have a remark. Line ends, spaces and leading zeros of codes
/// change no action.
#[test]
fn simple_blocks_are_read_the_same_in_each_layout() {
    let mut state = 3u64;
    let mut random = |limit: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) as usize % limit
    };
    for control in ["fanuc", "haas", "linuxcnc", "grbl", "mach3", "brother"].map(control) {
        let mut blocks = vec!["G21 G17 G90 G94".to_owned(), "G0 X0. Y0. Z5.".into(), "G1 Z-1. F100.".into()];
        for _ in 0..300 {
            let mut words = vec![["", "", "", "G1", "G0"][random(5)].to_owned()];
            for letter in ["X", "Y", "Z", "F"] {
                if random(2) == 0 {
                    let sign = if letter != "F" && random(2) == 0 { "-" } else { "" };
                    words.push(format!("{letter}{sign}{}.{:03}", random(200) + 1, random(1000)));
                }
            }
            words.retain(|word| !word.is_empty());
            blocks.push(words.join(" "));
        }
        let program = |change: &dyn Fn(&str) -> String| {
            let text: String = blocks.iter().map(|block| change(block)).chain(["M30\n".into()]).collect();
            let (calls, ended, _) = simulated(text.as_bytes(), RunSettings::new(control));
            assert_eq!(ended, Ok(()), "{}\n{text}", control.name());
            format!("{calls:?}")
        };
        let usual = program(&|block| format!("{block}\n"));
        let long = |block: &str| block.replace("G0 ", "G00 ").replace("G1 ", "G01 ");
        let layouts: [&dyn Fn(&str) -> String; 6] = [
            &|block| format!("{block} (A)\n"),
            &|block| format!("{block}\r\n"),
            &|block| format!("{}\n", block.replace(' ', "")),
            &|block| format!("{}\r\n", long(block)),
            &|block| format!("{}\r\n", long(block).replace(' ', "")),
            &|block| format!("  {}  \n", block.replace(' ', "  ")),
        ];
        for (at, layout) in layouts.iter().enumerate() {
            assert_eq!(program(layout), usual, "{} in layout {at}", control.name());
        }
    }
}

/// A message shows the number of a character that looks like a space.
#[test]
fn a_no_break_space_is_shown_by_its_number() {
    for (block, message) in [
        ("G0\u{a0}X1.", r"`\u{a0}` can't be read, in `G0\u{a0}X1.`"),
        ("G0 X\u{a0}1.", r"a value instead of `\u{a0}`, in `G0 X\u{a0}1.`"),
    ] {
        let program = Cursor::new(format!("G21\n{block}\nM30\n"));
        let mut simulator = Simulator::new(program, RunSettings::new(control("fanuc")));
        let refused = std::iter::repeat_with(|| simulator.step(&mut Vec::new())).find_map(Result::err);
        let Some(RunError::Refused(diag, 2)) = refused else { panic!("{refused:?}") };
        assert_eq!(diag.message, message);
    }
}

/// A truncated program, or a program with a changed byte, is run or refused. The simulator never panics or hangs.
#[test]
fn mutilated_programs_get_an_answer() {
    let program = "%\nO1\nG21 G17 G90\n#1=[2+3]\nG0 X#1 Y[SIN[30]*2]\nG99 G81 X1. Y1. Z-5. R2. F100.\nX2. K3\nG80\nG2 X5. I2. F10.\no1 if [1]\no1 endif\nM98 P2\nM30\nO2\nM99\n";
    let mut state = 1u64;
    let mut random = |limit: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) as usize % limit
    };
    for round in 0..8_000 {
        let mut bytes = program.as_bytes().to_vec();
        if round % 3 == 0 {
            bytes.truncate(random(bytes.len()));
        }
        for _ in 0..random(4) {
            if !bytes.is_empty() {
                let at = random(bytes.len());
                bytes[at] = [b'[', b']', b'#', b'(', b'%', b'-', b'9', b'G', b'o', b'\n', 0, 0xff][random(12)];
            }
        }
        for control in postform::internals::control::names().map(control) {
            let _ended = simulated(&bytes, RunSettings::new(control)).1;
        }
    }
}

/// A read that a signal interrupts is repeated.
#[test]
fn interrupted_reads_are_made_again() {
    use std::io::{BufReader, Error, ErrorKind, Read, Result, Seek, SeekFrom};
    struct Interrupted(Cursor<&'static str>, bool);
    impl Read for Interrupted {
        fn read(&mut self, out: &mut [u8]) -> Result<usize> {
            self.1 = !self.1;
            if self.1 { Err(Error::from(ErrorKind::Interrupted)) } else { self.0.read(out) }
        }
    }
    impl Seek for Interrupted {
        fn seek(&mut self, to: SeekFrom) -> Result<u64> {
            self.0.seek(to)
        }
    }
    let (program, settings) = ("G21\nG0 X1.\nM30\n", RunSettings::new(control("fanuc")));
    let input = BufReader::with_capacity(4, Interrupted(Cursor::new(program), false));
    let mut simulator = Simulator::new(input, settings);
    let mut items = Vec::new();
    while simulator.step(&mut items).unwrap() {}
    assert_eq!(items, simulated(program.as_bytes(), settings).2);
}

/// Q in a tap of a Fanuc breaks the chip after each peck. Without Q, the tap goes down in one stroke.
#[test]
fn a_tap_with_q_turns_back_after_each_peck() {
    let lines = fanuc("G99 G84 X0. Y0. Z-5. R1. Q2. F500.");
    let pecks = [
        "F 0 0 -1",
        "ccw",
        "F 0 0 -0.5",
        "cw",
        "F 0 0 -3",
        "ccw",
        "F 0 0 -2.5",
        "cw",
        "F 0 0 -5",
        "ccw",
        "F 0 0 1",
        "cw",
    ];
    assert_eq!(lines[2..lines.len() - 1], pecks, "{lines:?}");
    assert_eq!(fanuc("G99 G84 X0. Y0. Z-5. R1. F500.")[2..6], ["F 0 0 -5", "ccw", "F 0 0 1", "cw"]);
}

/// G33.1 of LinuxCNC moves into the hole with the spindle, reverses the spindle, and moves back to its start.
#[test]
fn rigid_taps_of_linuxcnc_come_back() {
    let program = "G21 G90\nS100 M3\nG0 X1 Y2 Z5\nG33.1 Z-10 K1.5\nG91\nZ-3 K2\nM2\n";
    let lines = ["cw", "T 1 2 5", "F 1 2 -10", "ccw", "F 1 2 5", "cw", "F 1 2 2", "ccw", "F 1 2 5", "cw"];
    assert_eq!(motions(control("linuxcnc"), program), lines);
    let refused = |block: &str| refused(control("linuxcnc"), &format!("G21 G90\nG0 Z5\n{block}\nM2\n")).0;
    assert_eq!(refused("G33.1 Z-10 K1.5"), "PN012");
    assert_eq!(refused("S100 M3 G33.1 Z-10"), "PN007");
    assert_eq!(refused("S100 M3 G33.1 K1"), "PN006");
    assert_eq!(refused_with(RunSettings::new(control("fanuc")), "G21\nG33.1 Z-10. K1.\n").0, "PN016");
}

/// Even very many skipped lines do not count as a loop. Skipped lines inside an endless loop do count as a loop.
#[test]
fn lines_passed_over_are_no_loop() {
    let lines = "G1 X1.\n".repeat(2_100_000);
    for program in [format!("o1 if [0]\n{lines}o1 endif\nM2\n"), format!("o1 sub\n{lines}o1 endsub\nM2\n")] {
        let (calls, ended, _) = simulated(program.as_bytes(), RunSettings::new(control("linuxcnc")));
        assert_eq!((calls.len(), ended), (0, Ok(())));
    }
    let lines = "G1 X1.\n".repeat(1_000);
    let program = format!("o1 while [1]\no2 if [0]\n{lines}o2 endif\no1 endwhile\nM2\n");
    assert_eq!(refused(control("linuxcnc"), &program).0, "PN015");
}

/// The simulator passes on a hole with very many pecks in parts, completely and in order.
#[test]
fn a_block_of_many_moves_is_not_held() {
    for (code, each) in [("G83", 1), ("G84", 2)] {
        let program = format!("{START}G98 {code} X0. Y0. Z-100. R0. Q0.001 F100. K2\nG80\nM30\n");
        let mut simulator = Simulator::new(Cursor::new(program), RunSettings::new(control("fanuc")));
        let (mut items, mut most, mut depths) = (Vec::new(), 0, Vec::new());
        loop {
            items.clear();
            let more = simulator.step(&mut items).unwrap();
            most = most.max(items.len());
            depths.extend(items.iter().filter_map(|item| match item.action {
                Action::Feed { to, .. } => Some(to[2]),
                _ => None,
            }));
            if !more {
                break;
            }
        }
        assert!(most < 5_000, "{most} actions at once");
        // apart from rounding in the sums
        let wanted = 2 * each * 100_000;
        assert!(depths.len().abs_diff(wanted) < 4, "{code}: {} feeds", depths.len());
        // the second hole equals the first one
        let (first, second) = depths.split_at(depths.len() / 2);
        assert!(first == second && first.contains(&-100.0), "{code}");
    }
}

/// The control's file defines the effect of M codes: M14 starts the spindle, M198 calls a program that is not
/// available, and a Haas allows one M code in a block.
#[test]
fn m_codes_do_what_the_file_of_the_control_says() {
    let started = motions(control("fanuc"), "G21 G90 G94\nS500 M14\nG0 X1.\nM30\n");
    assert_eq!(started[0], "ccw");
    assert_eq!(refused(control("fanuc"), &format!("{START}M198 P5\nM30\n")), ("PN016".into(), 4));
    assert_eq!(refused(control("fanuc"), &format!("{START}M97 P5\nM30\n")), ("PN016".into(), 4));
    let two = format!("{START}M8 M5\nM30\n");
    assert_eq!(motions(control("fanuc"), &two).last().unwrap(), "stop");
    assert_eq!(refused(control("haas"), &two), ("PN004".into(), 4));
    assert_eq!(refused(control("haas"), &format!("{START}G88 X1. Z-1. R1. F10.\nM30\n")), ("PN003".into(), 4));
}

/// Blocks that the interpreter of LinuxCNC refuses, and codes whose effect is outside of the program.
#[test]
fn what_linuxcnc_refuses_or_has_elsewhere_is_refused() {
    let linuxcnc = |blocks: &str| {
        let mut simulator = Simulator::new(
            Cursor::new(format!("G21 G90 G17\nT1 M6\nF100 S900 M3\n{blocks}\nM2\n")),
            RunSettings::new(control("linuxcnc")),
        );
        loop {
            match simulator.step(&mut Vec::new()) {
                Ok(true) => {}
                Err(RunError::Refused(diag, _)) => return diag.message,
                end => panic!("{blocks}: {end:?}"),
            }
        }
    };
    for (blocks, message) in [
        ("G96", "G96 without S"),
        ("G96 D500", "G96 without S"),
        ("G10 L2 P2 X1 I1", "G10 L2 with I or J"),
        ("G10 L20 P2 X1 J1", "G10 L20 with I or J"),
        ("G41 D1\nM48", "a change of the override switches under cutter compensation"),
        ("G41.1", "G41.1 without D"),
        ("G41.1 D3 L5", "G41.1 with L outside G18"),
        ("G33.1 Z-2 K1 I0", "I0 of G33.1"),
        ("M66 P0 L0", "M66 is not supported: the state of an input"),
        ("M61 Q2", "M61 is not supported: the tool of M61"),
    ] {
        let refused = linuxcnc(blocks);
        assert!(refused.contains(message), "{blocks}: {refused}");
    }
}

/// Codes in real Haas programs: high precision on and off, a G53 without axis words.
#[test]
fn codes_that_real_programs_hold_are_read() {
    assert_eq!(motions(control("haas"), "G20 G5 P10000\nG0 X1.\nG53\nX2.\nG5 P0\nM30\n"), ["T 1 0 0", "T 2 0 0"]);
}

/// LinuxCNC refuses these codes while compensation is on; each was tested in rs274.
#[test]
fn compensation_forbids_what_linuxcnc_forbids() {
    let refused_by = |code: &str| {
        let program = format!("G21 G90 F9\nG0 X0 Y0\nT1 M6\nG41 D1 G1 X500\n{code}\nM2\n");
        let mut simulator = Simulator::new(Cursor::new(program), RunSettings::new(control("linuxcnc")));
        let mut items = Vec::new();
        loop {
            match simulator.step(&mut items) {
                Ok(true) => {}
                Ok(false) => break String::new(),
                Err(RunError::Refused(diag, line)) => break format!("{} {line}", diag.code.name()),
                Err(error) => panic!("{error:?}"),
            }
        }
    };
    for code in [
        "G64 P1",
        "G61",
        "G54",
        "G52 X0",
        "G92 X0",
        "G18",
        "M62 P0",
        "M64 P0",
        "M68 E0 Q1",
        "G43 H1",
        "G49",
        "T2 M6",
        "G10 L2 P1 X0",
        "G53 G0 X1",
        "G28",
    ] {
        assert_eq!(refused_by(code), "PN013 5", "{code}");
    }
    for code in ["G17", "G92.1", "G10 L2 P2 X0", "G4 P1", "M3 S100", "M0"] {
        assert_eq!(refused_by(code), "", "{code}");
    }
    assert_eq!(refused(control("linuxcnc"), "M19 R-90\nM2\n"), ("PN018".into(), 1));
}

/// A Fadal has the work offsets E1 to E24.
#[test]
fn work_offsets_of_a_fadal_end_at_24() {
    assert_eq!(refused(control("fadal"), "G20 G90\nE54 G0 X1.\nM30\n"), ("PN018".into(), 2));
    assert_eq!(motions(control("fadal"), "G20 G90\nE24 G0 X1.\nM30\n").len(), 1);
}
