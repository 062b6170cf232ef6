//! Pairs of programs that look alike but move differently, mostly in the languages of Heidenhain and Siemens: the
//! comparison finds the difference, or the program is refused with what to write instead.

use std::io::Cursor;

use crate::support::control;
use postform::internals::nc::{RunError, RunSettings};
use postform::internals::verify::{NoMotion, compare_motions};
use postform::toolpath::Units;

/// Compares two programs. Returns `same`, the first difference, or why a program is refused.
fn compared(name: &str, programs: [String; 2]) -> String {
    let settings = RunSettings::new(control(name));
    match compare_motions(programs.map(|program| (Cursor::new(program), settings)), Units::Mm, 1e-6) {
        Ok(motions) => motions.difference.map_or("same".to_owned(), |found| found.message),
        Err(NoMotion(_, RunError::Refused(diag, _))) => diag.message,
        Err(NoMotion(_, RunError::Io(error))) => panic!("{error}"),
    }
}

/// Compares each pair of a table, and checks that the result contains the third text. An empty second text means the
/// same program, which is refused.
fn check(name: &str, program: &dyn Fn(&str) -> String, table: &[(&str, &str, &str)]) {
    for (old, new, expected) in table {
        let new = if new.is_empty() { old } else { new };
        let result = compared(name, [old, new].map(|blocks| program(blocks)));
        assert!(result.contains(expected), "{old} / {new}: {result}");
    }
}

fn klartext(blocks: &str) -> String {
    format!(
        "0 BEGIN PGM T MM\nTOOL CALL 1 Z S2000 F300\nL X+0 Y+0 R0 FMAX M3\nL Z+50 FMAX\n{blocks}\nL Z+50 R0 FMAX\nM30\n\
         END PGM T MM\n"
    )
}

const DRILL: &str = "CYCL DEF 200 DRILLING Q200=2 Q201=-20 Q206=150 Q202=20 Q210=0 Q203=0 Q204=50 Q211=0";
const BORE: &str = "CYCL DEF 202 BORING Q200=2 Q201=-20 Q206=150 Q211=0 Q208=250 Q203=0 Q204=50 Q214=1 Q336=";

#[test]
fn heights_and_calls_of_klartext_cycles() {
    let lifted = DRILL.replace("Q203=0", "Q203=5");
    let table: [(&str, &str, &str); 9] = [
        // Z of CYCL CALL POS shifts the heights of the cycle
        ("D\nCYCL CALL POS X+10 Y+10 Z+5 FMAX", "D\nL X+10 Y+10 FMAX M99", "a cut begins at X10 Y10 Z2"),
        ("D\nCYCL CALL POS X+10 Y+10 Z+5 FMAX", "U\nL X+10 Y+10 FMAX M99", "same"),
        ("D\nCYCL CALL POS X+10 Y+10 Z+0 FMAX", "D\nL X+10 Y+10 FMAX M99", "same"),
        ("D\nCYCL CALL POS X+10 Y+10 FMAX", "", "CYCL CALL POS without X, Y and the height Z"),
        ("D\nL Z-5 FMAX\nCYCL CALL POS X+10 Y+10 Z+0 FMAX", "", "below the surface of the hole, Z0"),
        ("D\nCYCL CALL POS X+10 Y+10 Z+0 FMAX M99", "", "CYCL CALL POS with M89"),
        // CYCL CALL POS ends M89
        (
            "D\nL X+10 FMAX M89\nCYCL CALL POS X+20 Y+0 Z+0 FMAX\nL X+40 FMAX",
            "D\nL X+10 FMAX M99\nL X+20 FMAX M99\nL X+40 FMAX",
            "same",
        ),
        // the tool is taken away from the wall at the angle of the spindle
        ("B0\nL X+10 FMAX M99", "B180\nL X+10 FMAX M99", "the spindle angle before this cut is 180 degrees"),
        ("D\nL X+10 FMAX M99 M5", "", "M5 in a block that makes a hole"),
    ];
    let program = |blocks: &str| {
        let blocks: Vec<String> = blocks
            .lines()
            .map(|line| match line.split_at(usize::from(!line.is_empty())) {
                ("D", "") => DRILL.to_owned(),
                ("U", "") => lifted.clone(),
                ("B", angle) => format!("{BORE}{angle}"),
                _ => line.to_owned(),
            })
            .collect();
        klartext(&blocks.join("\n"))
    };
    check("heidenhain", &program, &table);
}

#[test]
fn moves_of_klartext() {
    let table: [(&str, &str, &str); 13] = [
        // an increment after a rounding or chamfer begins at the programmed corner
        ("L X+20 F100\nRND R3\nL IY+20", "L X+20 F100\nRND R3\nL Y+20", "same"),
        ("L X+20 F100\nRND R3\nL IY+20\nL IX+5", "L X+20 F100\nRND R3\nL Y+20\nL X+25", "same"),
        ("L X+20 F100\nCHF 2\nL IY+20\nRND R1\nL IX+9", "L X+20 F100\nCHF 2\nL Y+20\nRND R1\nL X+29", "same"),
        ("L X+20 F100\nRND R3\nL IY+20", "L X+20 F100\nRND R3\nL Y+23", "a cut goes to X20 Y23"),
        ("L X+20 F100\nRND R3 FMAX\nL Y+20", "", "a rounding or chamfer at FMAX"),
        ("L X+20 F100\nRND R3\n/L Y+20\nL Y+30", "", "next to a block with `/`"),
        // M91 only changes the reference of the positions: the block is still a cut
        ("L X+20 F100 M91", "L X+20 F900 M91", "the feed is 900, but 100"),
        ("L X+20 F100 M91", "L X+20 FMAX M91", "the new program ends before a cut"),
        // the tool retracts first, and moves along X and Y then
        ("L X+20 Y+38.5 F125 M140 MB MAX", "", "M140 MB MAX in a block with a move"),
        ("L Z-1 F100\nL M140 MB MAX", "L Z-1 F100\nL M140 MB MAX FMAX", "same"),
        // the angle of FN 13 is from 0 to 360
        ("FN 13: Q2 = -1 ANG +1\nL X+Q2 F100", "L X+315 F100", "same"),
        ("FN 13: Q2 = +1 ANG +1\nL X+Q2 F100", "L X+45 F100", "same"),
        // L and R of TOOL DEF are the length and the radius of the tool
        ("TOOL DEF 1 L+10 R+3", "", "L and R of TOOL DEF"),
    ];
    check("heidenhain", &klartext, &table);
    check("heidenhain", &klartext, &[("TOOL DEF 2", "TOOL DEF \"MILL\"", "same")]);
}

#[test]
fn values_of_klartext() {
    let table: [(&str, &str, &str); 15] = [
        ("Q1 = 0.5\nCYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL Q1", "", "it turns or scales the frame"),
        ("Q1 = 1\nCYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL Q1\nL X+1 F9", "L X+1 F9", "same"),
        ("Q0 = 45\nCYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT Q0", "", "it turns or scales the frame"),
        ("CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+0+30", "", "`+30` can't be read"),
        ("CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT QS1", "", "`QS1` can't be read"),
        (
            "Q5 = 2\nCYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL Q5\nL X+1 F9",
            "CYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 V.ZEIT 2\nL X+1 F9",
            "same",
        ),
        (
            "CYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL .5\nL X+1 F9",
            "CYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL 5\nL X+1 F9",
            "the dwells before this cut are 5 s, but 0.5 s",
        ),
        ("CYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL -3", "", "a dwell of -3 s"),
        ("FUNCTION DWELL TIME 2 REV", "", "`REV` can't be read"),
        // the programmed repeats, and those that are left
        ("LBL 1\nL IX+10 F9\nCALL LBL 1 REP 3/3", "LBL 1\nL IX+10 F9\nCALL LBL 1 REP 3", "same"),
        ("LBL 1\nL IX+10 F9\nCALL LBL 1 REP 3/1", "", "the number of repeats can't be read"),
        ("LBL 1\nL IX+10 F9\nLBL 1\nCALL LBL 1 REP 3", "", "LBL 1 is twice in the program"),
        ("M3.5", "", "`M3.5` can't be read"),
        ("CYCL DEF 200 DRILLING Q200=MAX", "", "MAX as the value of Q200"),
        ("CYCL DEF 200 DRILLING Q200=AUTO", "", "can't be read"),
    ];
    check("heidenhain", &klartext, &table);
}

/// In inch programs, feeds are written in tenths of an inch, also those of a tool call and of a cycle.
#[test]
fn feeds_of_klartext_in_inches() {
    let program = |feed: &str| {
        let cycle = DRILL.replace("Q206=150", feed);
        klartext(&format!("{cycle}\nL X+10 FMAX M99")).replace("T MM", "T INCH")
    };
    let table: [(&str, &str, &str); 2] =
        [("Q206=AUTO", "Q206=300", "same"), ("Q206=AUTO", "Q206=30", "the feed is 76.2, but 762")];
    check("heidenhain", &program, &table);
    let reams = |feed: &str| {
        let cycle = format!("CYCL DEF 201 REAMING Q200=2 Q201=-20 Q206=150 Q211=0 Q203=0 Q204=50 Q208={feed}");
        klartext(&format!("{cycle}\nL X+10 FMAX M99")).replace("T MM", "T INCH")
    };
    check("heidenhain", &reams, &[("MAX", "99999", "same"), ("MAX", "9999", "the new program")]);
}

/// A word that is twice in a block is refused, and not replaced by the second.
#[test]
fn words_are_once_in_a_block() {
    let table: [(&str, &str); 15] = [
        ("L X+1 F100 F200", "F"),
        ("L X+1 RL RR F100", "RR"),
        ("L X+1 RL R0 F100", "R0"),
        ("CR X+10 Y+0 R+5 R+6 DR+ F100", "R"),
        ("CR X+10 Y+0 R+5 DR+ DR- F100", "DR"),
        ("CC X+0 Y+0\nLP PR+5 PR+6 PA+0 F100", "PR"),
        ("CC X+0 Y+0\nLP PR+5 PA+0 IPA+90 F100", "IPA"),
        ("CC X+0 X+5", "X"),
        ("TOOL CALL 2 Z S100 S200", "S"),
        ("TOOL CALL 2 Z F100 F200", "F"),
        ("TOOL CALL 2 Z Z", "Z"),
        ("CYCL DEF 200 DRILLING Q201=-20 Q201=-5", "Q201"),
        ("CYCL DEF 247 DATUM Q339=2 Q339=3", "Q339"),
        ("TRANS DATUM AXIS X+1 X+2", "X"),
        ("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+1 IX+2", "X"),
    ];
    for (blocks, word) in table {
        check("heidenhain", &klartext, &[(blocks, "", &format!("{word} is twice in the block"))]);
    }
    let table: [(&str, &str); 2] = [("TRANS X1 X2", "X"), ("G3 X0 Y0 Z-1 I5 J0 TURN=2 TURN=3 F100", "TURN")];
    for (blocks, word) in table {
        check("siemens", &siemens, &[(blocks, "", &format!("{word} is twice in the block"))]);
    }
    let okuma = |blocks: &str| format!("G15 H1\nT1 M6\nS1000 M3\nG56 H1\nG0 G90 G17 X0 Y0 Z50\n{blocks}\nM2\n");
    let table: [(&str, &str); 2] =
        [("G85 Z-5 R2 F100 FA=30 FA=40 M54", "FA"), ("G81 Z-5 R2 F100 M52 M54", "M52, M53 or M54")];
    for (blocks, word) in table {
        check("okuma", &okuma, &[(blocks, "", &format!("{word} is twice in the block"))]);
    }
}

fn siemens(blocks: &str) -> String {
    format!("G17 G90 G54 G710\nT1 M6\nD1\nS400 M3\nG0 X0 Y0\nZ60 F150\n{blocks}\nG0 Z60\nM30\n")
}

#[test]
fn moves_and_cycles_of_siemens() {
    let table: [(&str, &str, &str); 9] = [
        // SUPA, G53 and G153 only suppress frames: the block is still a cut
        ("G1 G153 X10 F100", "G1 G153 X10 F900", "the feed is 900, but 100"),
        ("G1 SUPA X10 F100", "G0 SUPA X10", "the new program ends before a cut"),
        // the tool is taken away from the wall at the angle POSS
        (
            "CYCLE86(50,0,2,-20,,0,3,1,0,0,0)",
            "CYCLE86(50,0,2,-20,,0,3,1,0,0,180)",
            "the spindle angle before this cut is 180 degrees",
        ),
        // CYCLE840 needs a compensating chuck
        (
            "CYCLE84(50,0,2,-20,,0,3,,1.25,0,400)",
            "CYCLE840(50,0,2,-20,,0,0,3,0,,1.25)",
            "only one program synchronizes a tap with the spindle",
        ),
        // the control calls the modal cycle after the whole block
        ("MCALL CYCLE81(50,0,2,-20)\nX10 M5\nMCALL", "", "M5 in a block that makes a hole"),
        ("MCALL CYCLE81(50,0,2,-20)\nX10\nMCALL\nX20 M5", "MCALL CYCLE81(50,0,2,-20)\nX10\nMCALL\nX20\nM5", "same"),
        // the kind of machining may be a name of the control
        ("CYCLE832(0.05,_ROUGH,1)\nG1 X1", "CYCLE832(0.05,_ROUGH,1)\nG1 X1", "same"),
        ("CYCLE832(0.05,_ROUGH", "", "`)` is missing"),
        ("G641 ADIS=0.05\nG1 X1", "G641 ADIS=0.05\nG1 X1", "same"),
    ];
    check("siemens", &siemens, &table);
}

/// D in the block of T selects the edge of the tool that M6 loads. Without D, machine data decides.
#[test]
fn a_siemens_has_a_tool_length_after_m6() {
    let program =
        |change: &str| format!("G17 G90 G54 G710\n{change}\nS400 M3\nG0 X0 Y0\nZ20\nG1 Z-1 F100\nG0 Z60\nM30\n");
    let unknown = "no D since the tool change";
    let table: [(&str, &str, &str); 9] = [
        ("T1 M6\nD1", "T1 D1\nM6", "same"),
        ("T1 M6\nD1", "T1 D1 M6", "same"),
        ("T1 D1\nM6", "T1 D2\nM6", "the length register is 1.01, but 1"),
        ("T1 D1\nM6", "T1 D0\nM6", "length"),
        ("T1 D2\nM6\nD1", "T1 D1\nM6", "same"),
        ("T1 M6", "", unknown),
        ("T1\nD1\nM6", "", unknown),
        ("T1 D1\nM6\nT2\nM6", "", unknown),
        ("T1 M6\nG0 SUPA Z0\nD1", "T1 M6\nG0 SUPA Z0\nD1", "same"),
    ];
    check("siemens", &program, &table);
    check(
        "siemens",
        &|cycle| format!("G17 G90 G54 G710\nT1 M6\nS400 M3 F100\n{cycle}\nM30\n"),
        &[("CYCLE81(50,0,2,-20)", "", unknown)],
    );
}

/// A Fanuc runs the M code of a block with a hole before the tool goes down.
#[test]
fn codes_that_stop_are_not_in_the_block_of_a_hole() {
    let program = |blocks: &str| {
        format!(
            "O1\nG21 G90 G17 G40 G80 G54 G94\nT1 M6\nS500 M3\nG0 X0 Y0\nG43 H1 Z30. M8\nG98 G81 X1. Z-6. R2. \
             F100.\n{blocks}\nG0 Z100.\nM30\n"
        )
    };
    for name in ["fanuc", "haas", "mazak"] {
        for code in ["M5", "M9", "M0", "M1"] {
            let refused = format!("{code} in a block that makes a hole takes effect before the hole");
            check(name, &program, &[(&format!("X2. {code}\nG80"), "G80", &refused)]);
        }
        check(name, &program, &[("X2.\nG80 M5", "X2.\nG80\nM5", "same")]);
    }
}

/// On a Fanuc, G53 is always a rapid.
#[test]
fn machine_positions_of_a_fanuc_are_rapids() {
    let program = |block: &str| {
        format!("G21 G90 G17 G94 G54\nT1 M6\nS500 M3\nG0 X0 Y0\nG43 H1 Z5.\nG1 X9. F100.\n{block}\nM30\n")
    };
    check("fanuc", &program, &[("G53 Y0", "G0 G53 Y0", "same")]);
}
