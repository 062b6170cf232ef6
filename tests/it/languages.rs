//! Programs in the languages of Siemens, Heidenhain and Okuma: the effect of each call, and the order of execution. The
//! expected effects are from the makers' texts and public programs (tests/data/languages). Each case names its source.

use std::fs;
use std::io::Cursor;

use crate::support::{control, root};
use postform::internals::control::Control;
use postform::internals::nc::{Action, RunError, RunSettings, Simulator};
use postform::toolpath::FeedMode;
use serde_json::Value;

/// The actions of a program, and the message if it is refused.
fn actions(program: &str, name: &str) -> (Vec<Action>, Option<String>) {
    let mut simulator = Simulator::new(Cursor::new(program.as_bytes()), RunSettings::new(control(name)));
    let (mut all, mut items) = (Vec::new(), Vec::new());
    loop {
        items.clear();
        let step = simulator.step(&mut items);
        all.extend(items.iter().map(|item| item.action.clone()));
        match step {
            Ok(true) => {}
            Ok(false) => return (all, None),
            Err(RunError::Refused(diag, _)) => return (all, Some(diag.message)),
            Err(RunError::Io(error)) => panic!("{error}"),
        }
    }
}

/// Whether the machine's value matches the expected value. An expectation without a value matches all values.
fn near(said: &Value, is: f64) -> bool {
    said.as_f64().is_none_or(|said| (said - is).abs() < 1e-6)
}

fn is_place(said: &Value, at: &[f64; 6]) -> bool {
    said["to"].as_array().is_none_or(|to| to.iter().zip(at).all(|(said, is)| near(said, *is)))
        && said["above"].as_f64().is_none_or(|above| at[2] > above - 1e-9)
        && said["at_most"].as_f64().is_none_or(|most| at[2] <= most + 1e-9)
}

/// Whether an action matches a row of expectations. The rows give all feeds per minute, even if the program has feeds
/// per revolution.
fn is_expected(said: &Value, action: &Action, per_turn: f64) -> bool {
    match (said["kind"].as_str().unwrap(), action) {
        ("rapid" | "retract", Action::Rapid { to, machine, .. }) => *machine & 0b100 == 0 && is_place(said, to),
        ("rapid_machine", Action::Rapid { machine, .. }) => *machine & 0b100 != 0,
        ("feed" | "retract", Action::Feed { to, feed, .. }) => is_place(said, to) && near(&said["f"], feed * per_turn),
        ("arc", Action::Arc(turn)) => {
            let centre = &said["centre"];
            let ccw = turn.direction == postform::toolpath::Direction::Ccw;
            is_place(said, &turn.to)
                && near(&said["f"], turn.feed)
                && (0..2).all(|axis| near(&centre[axis], turn.center[axis]))
                && (said["dir"] == "ccw") == ccw
        }
        ("dwell", Action::Dwell(seconds)) => near(&said["s"], *seconds),
        ("tool", Action::Tool(tool)) => near(&said["t"], *tool),
        ("work", Action::Work(work)) => near(&said["n"], *work),
        ("length", Action::Length(register)) => near(&said["h"], register.unwrap_or(0.0)),
        ("stop", Action::Stop(_)) | ("orient", Action::Orient(_)) => true,
        ("spindle", Action::Spindle(rotation, speed)) => {
            let dir = if rotation.name() == "stop" { "off" } else { rotation.name() };
            said["dir"] == dir && near(&said["s"], *speed)
        }
        _ => false,
    }
}

/// Whether the case must list this action. The case must list every move, dwell and stop. It must list an orientation
/// only if it lists any orientation.
fn counts(action: &Action, listed: &[Value]) -> bool {
    let lists = |kind: &str| listed.iter().any(|said| said["kind"] == kind);
    match action {
        Action::Rapid { .. } | Action::Feed { .. } | Action::Arc(_) | Action::Dwell(_) | Action::Stop(_) => true,
        Action::Orient(_) => lists("orient"),
        _ => false,
    }
}

fn wrong(case: &Value, name: &str) -> Option<String> {
    let program = case["program"].as_str().unwrap();
    let (mut found, refused) = actions(program, name);
    let expected = case["expect"].as_array().unwrap();
    if refused.is_some() && case["refuse_ok"] == true {
        return None;
    }
    if expected.iter().any(|said| said["kind"] == "refuse") {
        return refused.is_none().then(|| "not refused".to_owned());
    }
    if let Some(message) = refused {
        return Some(format!("refused: {message}"));
    }
    let per_turn = if program.contains("G95") { 400.0 } else { 1.0 };
    // a shift in the plane appears as a rapid
    let rows: Vec<&Value> =
        expected.iter().filter(|said| !said["kind"].as_str().unwrap().starts_with("shift")).collect();
    let shifts = rows.len() < expected.len();
    // a case for a single block begins with that block
    let first = rows.first().map(|row| row["kind"].clone());
    if first == Some("length".into()) {
        let begin = found.iter().rposition(|action| matches!(action, Action::Length(_)));
        found.drain(..begin.unwrap_or(0));
    }
    let mut left = found.iter().peekable();
    let mut turning = "off";
    for row in rows {
        let is_row = |action: &Action| is_expected(row, action, per_turn);
        // the spindle may already turn in the direction that the tap needs
        if row["synchronous"] == true && row["dir"] == turning {
            continue;
        }
        while let Some(action) = left.peek()
            && !is_row(action)
            && (!counts(action, expected) || shifts)
        {
            left.next();
        }
        match left.next() {
            Some(action) if is_row(action) => {}
            other => return Some(format!("{other:?} instead of {row}")),
        }
        if row["kind"] == "spindle" {
            turning = row["dir"].as_str().unwrap();
        }
    }
    let more = left.find(|action| counts(action, expected) && !shifts);
    more.map(|action| format!("{action:?} is one more"))
}

#[test]
fn every_call_does_what_its_makers_text_says() {
    let mut problems = Vec::new();
    for (name, least) in [("siemens", 11), ("heidenhain", 13), ("okuma", 10)] {
        let path = root().join(format!("tests/data/languages/{name}.json"));
        let cases: Vec<Value> = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
        assert!(cases.len() >= least);
        for case in &cases {
            if let Some(problem) = wrong(case, name) {
                problems.push(format!("{}: {problem}", case["name"]));
            }
        }
    }
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

/// The ends of all moves as `X Y Z`, and the refused line.
fn ends(program: &str, name: &str) -> String {
    let (found, refused) = actions(program, name);
    let shown = |to: &[f64; 6]| {
        to[..3].iter().map(|value| format!("{}", (value * 1e4).round() / 1e4)).collect::<Vec<_>>().join(" ")
    };
    let mut ends: Vec<String> = found
        .iter()
        .filter_map(|action| match action {
            Action::Rapid { to, .. } => Some(shown(to)),
            Action::Feed { to, .. } => Some(shown(to)),
            Action::Arc(turn) => Some(format!("{} about {} {}", shown(&turn.to), turn.center[0], turn.center[1])),
            _ => None,
        })
        .collect();
    ends.extend(refused.map(|message| format!("! {message}")));
    ends.join("\n")
}

#[track_caller]
fn goes(name: &str, program: &str, expected: &[&str]) {
    assert_eq!(ends(program, name), expected.join("\n"), "{program}");
}

#[test]
fn a_siemens_jumps_loops_and_calls() {
    let head = "G17 G90 G54 G71 G94\nG0 X0 Y0 Z0\n";
    let table: [(&str, &[&str]); 9] = [
        ("R1=0\nAGAIN:\nG0 X=R1\nR1=R1+1\nIF R1<3 GOTOB AGAIN\nM30", &["0 0 0", "1 0 0", "2 0 0"]),
        ("GOTOF DONE\nG0 X1\nDONE: G0 Y1\nM30", &["0 1 0"]),
        ("DEF REAL A=2\nIF A==2\nG0 X1\nELSE\nG0 X2\nENDIF\nM30", &["1 0 0"]),
        ("FOR R5=1 TO 3\nG0 Y=R5*2\nENDFOR\nM30", &["0 2 0", "0 4 0", "0 6 0"]),
        ("R1=2\nWHILE R1>0\nG0 X=IC(1)\nR1=R1-1\nENDWHILE\nM30", &["1 0 0", "2 0 0"]),
        ("PART: G0 X=IC(1)\nG0 Y=IC(1)\nREPEAT PART P=1\nM30", &["1 0 0", "1 1 0", "2 1 0", "2 2 0"]),
        ("HOLE(5, -2)\nM30\n%_N_HOLE_SPF\nPROC HOLE(REAL X1, REAL Z1)\nG0 X=X1 Z=Z1\nM17", &["5 0 -2"]),
        ("L10 P2\nM30\n%_N_L10_SPF\nG0 X=IC(3)\nM17", &["3 0 0", "6 0 0"]),
        ("TRANS X10\nG0 X0\nATRANS X5\nG0 X0\nTRANS\nG0 X0\nM30", &["0 0 0", "0 0 0", "0 0 0"]),
    ];
    for (program, expected) in table {
        let all: Vec<&str> = ["0 0 0"].iter().chain(expected).copied().collect();
        goes("siemens", &format!("{head}{program}\n"), &all);
    }
}

#[test]
fn a_heidenhain_repeats_calls_and_rounds() {
    let head = "0 BEGIN PGM T MM\n1 TOOL CALL 1 Z S1000\n2 L X+0 Y+0 Z+0 R0 FMAX M3\n";
    let table: [(&str, &[&str]); 8] = [
        ("LBL 1\nL IX+5 FMAX\nCALL LBL 1 REP 2\nM30", &["5 0 0", "10 0 0", "15 0 0"]),
        ("CALL LBL \"S\"\nM30\nLBL \"S\"\nL Y+1,5 FMAX\nLBL 0", &["0 1.5 0"]),
        ("Q1 = 2 * (3 + 1)\nLBL 3\nFN 2: Q1 = +Q1 - +3\nFN 11: IF +Q1 GT +0 GOTO LBL 3\nL X+Q1 FMAX\nM2", &["-1 0 0"]),
        ("L X+20 F500\nRND R3\nL Y+20\nM2", &["17 0 0", "20 3 0 about 17 3", "20 20 0"]),
        ("L X+20 F500\nCHF 2\nL Y+20\nM2", &["18 0 0", "20 2 0", "20 20 0"]),
        ("CC X+10 Y+0\nCP IPA+360 IZ-2 DR+ F100\nM2", &["0 0 -2 about 10 0"]),
        ("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+10\nL X+0 FMAX\nM2", &["0 0 0"]),
        ("PLANE SPATIAL SPA+0 SPB+0 SPC+0 STAY\nL X+1 FMAX\nM2", &["1 0 0"]),
    ];
    for (program, expected) in table {
        let all: Vec<&str> = ["0 0 0"].iter().chain(expected).copied().collect();
        goes("heidenhain", &format!("{head}{program}\n"), &all);
    }
}

#[test]
fn an_okuma_jumps_and_calls() {
    let head = "G15 H1\nT1 M6\nS1000 M3\nG56 H1\nG0 G90 G17 X0 Y0 Z0\n";
    let table: [(&str, &[&str]); 7] = [
        ("VC1=FIX[2.7]+FUP[.2]\nG0 X=VC1 Y=ROUND[1.4]\nM2", &["3 1 0"]),
        ("VC1=5\nIF [[VC1 EQ 5] EOR [VC1 EQ 2]] N5\nG0 X1\nN5 G0 Y1\nM2", &["0 1 0"]),
        ("CALL O100 PA=7 PB=3\nM2\nO100\nG0 X=PA Y=PB\nRTS", &["7 3 0"]),
        ("VC1=0\nN10 VC1=VC1+1\nG0 X=VC1*10\nIF [VC1 LT 3] N10\nM2", &["10 0 0", "20 0 0", "30 0 0"]),
        ("GOTO N20\nG0 X1\nN20 G0 Y1\nM2", &["0 1 0"]),
        ("NCYL G81 X5 Z-3 R1 F100 M54\nX6\nG80\nM2", &["5 0 0", "6 0 0", "6 0 1", "6 0 -3", "6 0 1"]),
        (
            "G83 Z-9 R0 I2 J4 F100 M54\nM2",
            &[
                "0 0 0", "0 0 -2", "0 0 -1.5", "0 0 -4", "0 0 0", "0 0 -3.5", "0 0 -6", "0 0 -5.5", "0 0 -8", "0 0 0",
                "0 0 -7.5", "0 0 -9", "0 0 0",
            ],
        ),
    ];
    for (program, expected) in table {
        let all: Vec<&str> = ["0 0 0"].iter().chain(expected).copied().collect();
        goes("okuma", &format!("{head}{program}\n"), &all);
    }
}

/// An unknown word stops the run with an error that names the word. Unknown words are never skipped silently.
#[test]
fn what_is_not_read_is_refused_by_name() {
    let table = [
        ("siemens", "G17 G54\nROT RPL=45\nM30", "ROT"),
        ("siemens", "CYCLE800(1,0,0,27)\nM30", "CYCLE800"),
        ("heidenhain", "0 BEGIN PGM T MM\nL M140 MB50\nEND PGM T MM", "M140 is supported only with MB MAX"),
        ("siemens", "CYCLE81(50,0,-2,-10)\nM30", "CYCLE81 with SDIS -2 is not supported"),
        ("siemens", "CYCLE83(50,0,2,-10,,,5,-2,0,0,1,1)\nM30", "CYCLE83 with DAM -2 is not supported"),
        ("siemens", "CYCLE83(50,0,2,-10,,,5,0,0,0,2,1)\nM30", "CYCLE83 with FRF 2 is not supported"),
        ("siemens", "CYCLE84(50,0,2,-10,,0,3,,1,0,500,-500)\nM30", "CYCLE84 with SST1 -500 is not supported"),
        ("siemens", "G0 X=$AA_IM[X]\nM30", "$AA_IM"),
        ("siemens", "POCKET3(50,0,2)\nM30", "POCKET3"),
        ("siemens", "G500 G0 X0\nM30", "G500"),
        ("siemens", "G71 G54\nG0 X1\nG70\nM30", "unit of feeds"),
        ("siemens", "GOTOF NOWHERE\nM30", "NOWHERE"),
        ("siemens", "WHILE 1\nG0 X1\nM30", "ENDWHILE"),
        ("heidenhain", "0 BEGIN PGM T MM\nPLANE SPATIAL SPA+10 SPB+0 SPC+0\nEND PGM T MM", "tilted"),
        ("heidenhain", "0 BEGIN PGM T MM\nL X+Q5 FMAX\nEND PGM T MM", "Q5"),
        ("heidenhain", "0 BEGIN PGM T MM\nCYCL DEF 251 POCKET ~\n Q215=0\nEND PGM T MM", "251"),
        ("heidenhain", "0 BEGIN PGM T MM\nM128\nEND PGM T MM", "M128"),
        ("heidenhain", "0 BEGIN PGM T MM\nLBL 9\nFN 9: IF +1 EQU +4 GOTO LBL 9 M5\nEND PGM T MM", "`M5` can't be read"),
        ("heidenhain", "0 BEGIN PGM T MM\nCYCL DEF 247 DATUM Q339=+1 Q340=+2\nEND PGM T MM", "Q340 in CYCL DEF 247"),
        ("heidenhain", "0 BEGIN PGM T MM\nAPPR LT X+0 Y+0 LEN5 RL\nEND PGM T MM", "APPR"),
        ("heidenhain", "0 BEGIN PGM T MM\nFPOL X+0 Y+0\nEND PGM T MM", "FPOL"),
        (
            "heidenhain",
            "0 BEGIN PGM T MM\nTOOL CALL 1 Z S1000\nL X+0 Y+0 Z+50 R0 FMAX M3\nL Z+40 F500\nCYCL DEF 200 DRILLING ~\n Q200=2 ~\n Q201=-5 ~\n Q206=200 ~\n Q202=5 ~\n Q210=0 ~\n Q203=0 ~\n Q204=50 ~\n Q211=0\nCYCL CALL\nL X+9\nEND PGM T MM",
            "a feed move without a feed",
        ),
        ("okuma", "G15 H1\nG62 X1\nM2", "G62"),
        ("okuma", "G15 H1\nG0 G90 X0 Y0 Z50\nG81 Z-5 R2 F100\nM2", "M52, M53 or M54"),
        ("okuma", "G15 H1\nG0 G90 X0 Y0 Z50\nG82 Z-5 R2 P500 F100 M54\nM2", "P500"),
        ("okuma", "G15 H1\nG0 G90 X0 Y0 Z50\nG81 Z-5 R2 F100 M54\nG0 X5\nM2", "whether it ends the cycle"),
        ("okuma", "VZOFX[1]=5\nM2", "VZOFX"),
        // `$` may continue the block before it; only before the first block, it begins the name of the file
        ("okuma", "$A.MIN%\nG15 H1\nG0 X1\n$ Y9\nM2", "may continue the block before it"),
        ("okuma", "$ Y9\nM2", "may continue the block before it"),
        // whether AND and OR join bits or truth values matters only for other values than 0 and 1
        ("okuma", "VC1=10 AND 12\nM2", "10 AND 12 joins the bits"),
        ("okuma", "VC1=[1 EQ 1] OR [1 EQ 2] AND [1 EQ 1]\nM2", "AND and OR in one formula without brackets"),
        ("okuma", "VC1=ATAN2[1,-1]\nM2", "`ATAN2` with a value in brackets is not simulated"),
        ("okuma", "VC1=TRUNC[1.5]\nM2", "`TRUNC` with a value in brackets is not simulated"),
        ("okuma", "VC1=1 XOR 0\nM2", "`XOR` can't be read"),
        ("okuma", "SB=500\nM2", "`SB` is a word of machines with a driven tool"),
        ("okuma", "G15 H1\nNOEX G0 X5\nM2", "NOEX without a cycle"),
        ("okuma", "G15 H1\nG0 G90 X0 Y0 Z50\nG81 Z-5 R2 F100 M54 I3\nM2", "the block has I"),
        ("okuma", "G15 H1\nG0 G90 X0 Y0 Z50\nG81 Z-5 R2 F100 M54 FA=30\nM2", "the block has FA"),
        ("okuma", "G15 H1\nFA=30 G1 X5 F100\nM2", "the block has FA"),
        ("okuma", "LAP\nM2", "LAP"),
    ];
    for (name, program, word) in table {
        let (_, refused) = actions(program, name);
        assert!(refused.as_ref().is_some_and(|message| message.contains(word)), "{program}: {refused:?}");
    }
}

/// Empty, truncated, non-UTF-8 and malicious programs give an error and never a panic.
#[test]
fn bad_programs_are_refused() {
    let deep = format!("R1={}1\nM30", "(".repeat(100_000));
    for (name, program) in [
        ("siemens", "G0 X"),
        ("siemens", "G0 X=("),
        ("siemens", deep.as_str()),
        ("siemens", "AGAIN:\nGOTOB AGAIN"),
        ("siemens", "MCALL CYCLE83(50,0,2,-1e9,,,1e-9,0,0,0,1,1)\nG54 G0 X0 Y0 Z0 F1\nM30"),
        ("heidenhain", "0 BEGIN PGM T MM\nCYCL DEF 200 ~"),
        ("heidenhain", "0 BEGIN PGM T MM\nL X+"),
        ("heidenhain", "0 BEGIN PGM T MM\nLBL 1\nCALL LBL 1"),
        ("heidenhain", "0 BEGIN PGM T MM\nL X+0 Y+0 F5\nRND R1"),
        ("okuma", "G15 H1\nCALL O1"),
        ("okuma", "G15 H1\nN1 GOTO N1"),
        ("okuma", "G15 H1\nVC1=[[["),
        ("okuma", "\u{0}\u{fffd}(("),
    ] {
        let (_, refused) = actions(program, name);
        assert!(refused.is_some(), "{}", &program[..program.len().min(60)]);
    }
}

/// If postform does not run a feature of Siemens programs, the message names the feature, and not a missing subprogram.
#[test]
fn what_is_not_run_is_named() {
    let refused = |block: &str| actions(&format!("G17 G54\n{block}\nG0 X1\nM30"), "siemens").1;
    for (block, message) in [
        ("TRAORI", "`TRAORI`, a transformation of five axes, is not supported"),
        ("TRAORI(1)", "`TRAORI`, a transformation of five axes, is not supported"),
        ("ROT RPL=45", "`ROT`, a turned frame, is not supported"),
        ("LIMS=3000", "`LIMS`, the speed limit of the spindle under G96, is not supported"),
        ("POCKET7", "there is no subprogram POCKET7 in this file"),
    ] {
        assert!(refused(block).unwrap().contains(message), "{block}");
    }
    assert_eq!(refused("TRAFOOF"), None);
    assert_eq!(refused("FNORM"), None);
}

/// A mistyped parameter of a cycle is refused. Earlier versions ignored it as a part of the cycle's name.
#[test]
fn mistyped_parameters_of_a_cycle_are_refused() {
    let cycle = |words: &str| {
        let program = format!(
            "0 BEGIN PGM T MM\n1 TOOL CALL 1 Z S1000 F500\n2 L X+0 Y+0 Z+10 FMAX M3\n3 CYCL DEF 200 {words}\n4 L X+5 Y+5 FMAX M99\n5 M30\n"
        );
        actions(&program, "heidenhain").1
    };
    let right = "DRILLING Q200=2 Q201=-10 Q206=100 Q202=5 Q210=0 Q203=0 Q204=10 Q211=0";
    assert_eq!(cycle(right), None);
    assert_eq!(cycle(&right.replace("DRILLING", "BOHREN 2-FACH (NEU)")), None);
    for (from, to) in [
        ("Q210=0", "Q-210=0"),
        ("Q210=0", "Q210 0"),
        ("Q210=0", "W210=0"),
        ("Q211=0", "Q211=0 X"),
        ("Q200=2", "Q-200=2"),
    ] {
        assert!(cycle(&right.replacen(from, to, 1)).unwrap().contains("can't be read"), "{to}");
    }
}

/// If no control is named, postform runs a program by the rules of the control for its language.
#[test]
fn the_language_of_a_program_is_found() {
    for (program, name) in [
        ("%_N_A_MPF\nM30", "siemens"),
        ("N10 MCALL CYCLE81(50,0,2,-10)\nM30", "siemens"),
        ("0  BEGIN PGM T MM\n", "heidenhain"),
        ("$A.MIN%\nG15 H1\nM2", "okuma"),
        ("%\nO1\nG0 X1.\nM30", "fanuc"),
    ] {
        let settings = RunSettings { assumed: true, ..RunSettings::new(control("fanuc")) };
        let mut input = Cursor::new(program.as_bytes());
        let found = postform::internals::nc::settings_for(&mut input, std::path::Path::new(""), settings).unwrap();
        assert_eq!(found.control.name(), name, "{program}");
        // with another control, the program is refused, and the message names the language
        let (_, refused) = actions(program, "grbl");
        assert_eq!(refused.is_some_and(|message| message.contains("reads another")), name != "fanuc", "{program}");
    }
}

/// After a return to home the height is unknown. Earlier versions printed the bottom of the hole as the height in a
/// rapid sequence of the form.
#[test]
fn a_rapid_of_the_forms_own_has_no_height_of_a_hole() {
    let form = fs::read_to_string(root().join("postforms/heidenhain.pf")).unwrap();
    let post = postform::Post::compile(postform::Source::from_text("form", &form), &postform::NoFiles).unwrap();
    let job = r#"{"postform": 1, "units": "mm", "tools": [{"number": 1}], "operations": [{"tool": 1, "spindle": {"speed": 900, "direction": "cw"},
        "path": [{"rapid": [3, -1, 10]}, {"home": true}, {"cycle": {"kind": "bore", "depth": 9, "feed": 6, "points": [[-1, -2, 0]]}}]}]}"#;
    let mut options = postform::Options::default();
    options.proof = None;
    let error = post.render(postform::Job::json(job), &options).unwrap_err().to_string();
    assert!(error.contains("[d] has no value here"), "{error}");
}

/// `M140 MB MAX` moves up to the end of the travel. An empty CYCLE800 does not turn the part.
#[test]
fn resets_and_ways_home_are_run() {
    let (all, refused) =
        actions("0 BEGIN PGM T MM\n1 TOOL CALL 1 Z S1000\nL X+1 FMAX\nL M140 MB MAX\nM30\n", "heidenhain");
    assert_eq!(refused, None);
    let home = |action: &Action| matches!(action, Action::Rapid { machine, .. } if machine & 0b100 != 0);
    assert_eq!(all.iter().filter(|action| home(action)).count(), 1, "{all:?}");
    for block in ["CYCLE800", "CYCLE800()"] {
        assert_eq!(actions(&format!("G17 G54\n{block}\nG0 X1\nM30"), "siemens").1, None, "{block}");
    }
}

/// Two programs make one part on two controls. Other pecks and rounded feeds are no difference. Another depth, position
/// or feed is a difference.
#[test]
fn one_part_for_two_controls_is_compared_by_its_holes() {
    use postform::internals::verify::compare_motions;
    use postform::toolpath::Units;

    let siemens = "G17 G710 G54 G90 G94\nT1\nM6\nG0 D1 X0 Y0 S295 M3\nZ60\nF637\nMCALL CYCLE83(60,52,0,30,,,5,,,,1,0,3,5,1)\nX10 Y0\nX20\nMCALL\n\
                   MCALL CYCLE81(60,52,0,40)\nX30\nMCALL\nG0 SUPA D0 Z0\nM30\n";
    let klartext = "0 BEGIN PGM T MM\n1 TOOL CALL 1 Z S295\nCYCL DEF 247 Q339=1\nL X+0 Y+0 R0 FMAX M3\nL Z+60 R0 FMAX\n\
                    CYCL DEF 203 Q200=0 Q201=-22 Q206=636.62 Q202=4 Q210=0 Q203=52 Q204=8 Q212=0 Q213=9 Q205=4 Q211=0 Q208=MAX Q256=1\n\
                    L X+10 Y+0 FMAX M99\nL X+20 FMAX M99\nCYCL DEF 200 Q200=0 Q201=-12 Q206=636.62 Q202=12 Q210=0 Q203=52 Q204=8 Q211=0\n\
                    L X+30 FMAX M99\nL Z+0 R0 FMAX M91\nM30\nEND PGM T MM\n";
    let compared = |klartext: &str| {
        let sides = [(siemens, "siemens"), (klartext, "heidenhain")];
        let sides = sides.map(|(text, name)| (Cursor::new(text.to_owned()), RunSettings::new(control(name))));
        compare_motions(sides, Units::Mm, 1e-6).unwrap_or_else(|error| panic!("{error:?}"))
    };
    let same = compared(klartext);
    assert_eq!(same.difference, None);
    assert_eq!((same.cuts, same.pecks, same.feeds), (3, 2, 3));
    for (what, by, said) in [
        ("Q201=-22", "Q201=-21", "a hole goes to Z31, but to Z30 in the old program"),
        ("L X+20", "L X+21", "X21"),
        ("Q206=636.62 Q202=12", "Q206=600 Q202=12", "the feed is 600, but 637 in the old program"),
        ("S295", "S300", "the spindle speed is 300, but 295 in the old program"),
        ("Q339=1", "Q339=2", "the work offset"),
    ] {
        let other = compared(&klartext.replace(what, by)).difference.map(|difference| difference.message);
        assert!(other.as_ref().is_some_and(|message| message.contains(said)), "{what}: {other:?}");
    }
}

/// A program for one machine is printed for another machine in another language. Cuts and holes stay the same.
#[test]
fn a_program_is_printed_for_another_machine() {
    for from in ["haas", "okuma", "heidenhain"] {
        for to in ["haas", "okuma", "heidenhain"].into_iter().filter(|to| *to != from) {
            let program = format!("samples/bracket/expected.{from}.nc");
            let form = format!("postforms/{to}.pf");
            let command = ["render", &program, "--job-control", from, "--form", &form, "--program", "7"];
            let printed = crate::program_commands::postform(&command);
            let (text, said) = (String::from_utf8(printed.stdout).unwrap(), String::from_utf8(printed.stderr).unwrap());
            assert_eq!(printed.status.code(), Some(0), "{from} to {to}: {said}");
            assert!(
                said.contains("equivalent: the program makes the cuts of samples/bracket"),
                "{from} to {to}: {said}"
            );
            assert!(said.contains("20 holes") || said.contains("16 holes"), "{from} to {to}: {said}");
            // only pecks and the parts of arcs differ
            let verdict = said.lines().find(|line| line.starts_with("equivalent")).unwrap();
            let counted = verdict.rsplit(": ").next().unwrap();
            assert!(
                counted.split(", ").all(|one| ["4 holes with other pecks", "2 arcs made of parts"].contains(&one)),
                "{verdict}"
            );
            assert!(text.lines().count() > 100, "{from} to {to}");
        }
    }
}

/// A call of a missing subprogram is refused, but the blocks after it are still run.
#[test]
fn a_refused_call_hides_nothing() {
    for (name, program) in [
        ("siemens", "G0 X0 Y0 Z5\nHOME\nG0 X1\nM30\n"),
        ("okuma", "G15 H1\nG0 G90 X0 Y0 Z50\nCALL O77\nG0 X1\nM2\n"),
        ("heidenhain", "0 BEGIN PGM T MM\nL X+0 FMAX\nCALL LBL 9\nL X+1 FMAX\nM2\nEND PGM T MM\n"),
        ("fanuc", "G21\nG0 X0.\nM98 P77\nG0 X1.\nM30\n"),
    ] {
        let mut simulator = Simulator::new(Cursor::new(program.as_bytes()), RunSettings::new(control(name)));
        let (mut items, mut refused) = (Vec::new(), Vec::new());
        loop {
            match simulator.step(&mut items) {
                Ok(true) => {}
                Ok(false) => break,
                Err(RunError::Refused(diag, line)) => {
                    refused.push((line, diag.message));
                    assert!(simulator.pass_over(), "{name}: {refused:?}");
                }
                Err(RunError::Io(error)) => panic!("{error}"),
            }
        }
        assert!(refused.len() == 1 && refused[0].0 == 3 - u64::from(name == "siemens"), "{name}: {refused:?}");
        let last = items.iter().rev().find_map(|item| match &item.action {
            Action::Rapid { to, .. } => Some(to[0]),
            _ => None,
        });
        assert_eq!(last, Some(1.0), "{name}");
    }
}

/// Some codes change positions in a way that postform does not know. The program is refused at such a code and not run
/// further.
#[test]
fn codes_that_move_the_frame_or_the_tool_are_refused() {
    let klartext = |block: &str| {
        let program = format!(
            "0 BEGIN PGM T MM\n1 TOOL CALL 1 Z S1000 DL+0 DR+0\n2 L X+1 Y+1 R0 FMAX M3\n{block}\nL Z-1 F100\nM30\n"
        );
        actions(&program, "heidenhain").1
    };
    assert_eq!(klartext("L X+2 F200 M8"), None);
    for block in ["TOOL CALL 1 Z S1000 DL+0.5", "TOOL CALL S1200 DL-1", "TOOL CALL 1 Z S1000 DR+0.1 DR2:+0"] {
        let refused = klartext(block).unwrap_or_else(|| panic!("{block} is run"));
        assert!(refused.contains("changes the length or the radius of the tool"), "{block}: {refused}");
    }
    for code in ["M93", "M95", "M96", "M104", "M112", "M114", "M142", "M143", "M197"] {
        let refused = klartext(&format!("L X+2 F200 {code}")).unwrap_or_else(|| panic!("{code} is run"));
        assert!(refused.starts_with(&format!("{code} is not supported")), "{refused}");
    }
    // a direction and a number of chip breaks are whole numbers
    let bore = |q214: &str| {
        klartext(&format!(
            "CYCL DEF 202 BORING ~\n Q200=2 ~\n Q201=-5 ~\n Q206=200 ~\n Q211=0 ~\n Q208=0 ~\n Q203=0 ~\n Q204=50 ~\n Q214={q214} ~\n Q336=0\nL M99"
        ))
    };
    assert_eq!(bore("1"), None);
    assert!(bore("1.7").unwrap().contains("Q214=1.7 is not a whole number"));
    // axis words in a block with a code that may use them: G22 X Y Z I J K sets stroke limits and moves no axis
    let codes = |control: &str, block: &str| actions(&format!("G21 G90\nG0 X1. Y1. Z1.\n{block}\nM30\n"), control).1;
    for (control, block) in [
        ("fanuc", "G22 X20. Y0 Z20. I-10. J-10. K-10."),
        ("fanuc", "G23 X20."),
        ("fanuc", "G5.1 Q1 X20."),
        ("fanuc", "G8 P1 Y2."),
        ("haas", "G103 P1 Z2."),
        ("haas", "G187 P1 G0 X2."),
    ] {
        let refused = codes(control, block).unwrap_or_else(|| panic!("{block} is run"));
        assert!(refused.contains("the axis words may belong to"), "{block}: {refused}");
        let alone: String =
            block.split(' ').filter(|word| !word.starts_with(['X', 'Y', 'Z'])).collect::<Vec<_>>().join(" ");
        assert_eq!(codes(control, &alone), None, "{alone}");
    }
    // a Haas repeats a cycle by L, not by K
    let cycle = |word: &str| codes("haas", &format!("G91 G99 G81 X1. Z-1. R-.5 {word} F100."));
    assert_eq!(cycle("L3"), None);
    assert!(cycle("K3").unwrap().contains("the block has K"), "K3");
}

/// Rules for formulas of Siemens controls that other languages do not have.
#[test]
fn a_siemens_ranks_operators_and_rounds_whole_numbers() {
    let runs = |blocks: &str| actions(&format!("G17 G54 G90\nG0 X0 Y0 Z0\nG1 F100 X1\n{blocks}\nM30\n"), "siemens");
    let goes = |blocks: &str| {
        let (actions, refused) = runs(blocks);
        assert_eq!(refused, None, "{blocks}");
        let last = actions.iter().rev().find_map(|action| match action {
            Action::Feed { to, .. } => Some(to[0]),
            _ => None,
        });
        last.unwrap()
    };
    // AND is evaluated before XOR, and XOR before OR: the jump is made
    assert_eq!(goes("R1=1 R2=0 R3=0\nIF R1 OR R2 AND R3 GOTOF SKIP\nX9\nSKIP:"), 1.0);
    assert_eq!(goes("R1=1 R2=1 R3=1\nIF R1 XOR R2 OR R3 GOTOF SKIP\nX9\nSKIP:"), 1.0);
    assert_eq!(goes("R1=5 R2=7\nIF (R1==5) AND (R2==7) GOTOF SKIP\nX9\nSKIP:"), 1.0);
    let refused = runs("R1=5 R2=7\nIF R1==5 AND R2==7 GOTOF SKIP\nX9\nSKIP:").1.unwrap();
    assert!(refused.contains("AND and a comparison in one formula without brackets"), "{refused}");
    // INT rounds, BOOL is 0 or 1
    assert_eq!(goes("DEF INT N\nN=2.5\nX=N*4"), 12.0);
    assert_eq!(goes("DEF INT N=2.4\nX=N*4"), 8.0);
    assert_eq!(goes("DEF BOOL B=5\nX=B*4"), 4.0);
    assert_eq!(goes("DEF REAL N=2.5\nX=N*4"), 10.0);
    assert!(runs("X2 M70").1.unwrap().contains("M70"));
    // while MCALL and G0 or G1 are active, a block with S or F drills again, even if the block has other words
    let holes = |block: &str| {
        let program = format!("S900 M3\nG0 Z50\nMCALL CYCLE81(50,0,2,-10)\nX10 Y20\n{block}\nMCALL");
        let (actions, refused) = runs(&program);
        assert_eq!(refused, None, "{block}");
        actions.iter().filter(|action| matches!(action, Action::Hole(_))).count()
    };
    let drilled = [("M8", 1), ("S1000 M3", 2), ("F150", 2), ("F100 M8", 2), ("G0", 2), ("G4 F1", 1)];
    for (block, count) in drilled {
        assert_eq!(holes(block), count, "{block}");
    }
    // G96 and G97 turn on feeds per revolution
    let modes = |block: &str| {
        let (actions, refused) = runs(block);
        assert_eq!(refused, None, "{block}");
        actions.iter().any(|action| matches!(action, Action::FeedMode(FeedMode::PerRev)))
    };
    assert!(modes("G97 S2000 M3") && modes("G96 S200 M3") && !modes("G94 G97 S2000 M3") && !modes("S2000 M3"));
}

/// Words of a lathe to which earlier versions gave another meaning than the control.
#[test]
fn a_lathe_reads_increments_and_g76_as_its_control() {
    let runs =
        |blocks: &str| actions(&format!("G21 G99 G97 S500 M3\nT0101\nG0 X40. Z5.\n{blocks}\nM30\n"), "fanuc-lathe");
    let at = |blocks: &str| {
        let (actions, refused) = runs(blocks);
        assert_eq!(refused, None, "{blocks}");
        actions.iter().rev().find_map(|action| match action {
            Action::Rapid { to, machine, .. } | Action::Feed { to, machine, .. } => Some((to[0], to[2], *machine)),
            _ => None,
        })
    };
    // after the shift, the tool is at X42 Z5.5; it then moves by 2 in X, to X44
    let moved = runs("G50 U2. W.5\nG0 X44. Z5.5");
    assert!(moved.0.iter().any(|action| matches!(action, Action::Frame)), "{moved:?}");
    assert_eq!(at("G0 U2. Z5."), Some((21.0, 5.0, 0)));
    for (block, message) in [("G0 X44. U2.", "X and U in one block"), ("G1 Z-1. W-.1 F.1", "Z and W in one block")] {
        assert!(runs(block).1.unwrap().contains(message), "{block}");
    }
    // G76 applies only to its own blocks: a block after G76 is a rapid again
    let thread = "G76 P010060 Q100 R.05\nG76 X36. Z-20. R0 P1200 Q400 F1.5\nX50.";
    let (actions, refused) = runs(thread);
    assert_eq!(refused, None);
    assert!(matches!(actions.iter().rev().find(|action| !matches!(action, Action::End)), Some(Action::Rapid { .. })));
}

/// The bottom, the feed and the dwell of the first hole.
fn hole(program: &str, name: &str) -> [f64; 3] {
    let (all, refused) = actions(program, name);
    assert_eq!(refused, None, "{program}");
    let hole = |action: &Action| match action {
        Action::Hole(hole) => Some([hole.bottom, hole.feed, hole.dwell]),
        _ => None,
    };
    all.iter().find_map(hole).unwrap()
}

/// The first depth of CYCLE83 was read as a dwell. The dwell at the bottom is DTD, or DTB.
#[test]
fn a_siemens_peck_dwells_by_its_own_arguments() {
    let dwell = |arguments: &str| {
        let program = format!("G17 G54 G90\nS1000 M3\nG0 X0 Y0 Z50 F200\nCYCLE83({arguments})\nM30\n");
        hole(&program, "siemens")[2]
    };
    assert_eq!(dwell("50,0,2,-20,,-8,,0,0,0,1,1"), 0.0);
    assert_eq!(dwell("50,0,2,-20,,-8,,0,0.5,0,1,1"), 0.5);
    assert_eq!(dwell("50,0,2,-20,,-8,,0,0.5,0,1,1,,,,1.5"), 1.5);
}

/// An argument of a cycle that postform does not use must not be dropped: AXN drills along another axis.
#[test]
fn arguments_of_a_cycle_are_used_or_refused() {
    let refused = |call: &str| {
        actions(&format!("G17 G54 G90\nS1000 M3\nG0 X0 Y0 Z50 F200\nMCALL {call}\nX1\nMCALL\nM30\n"), "siemens").1
    };
    for call in [
        "CYCLE83(50,0,2,-20,,,8,0,0,0,1,1,3)",
        "CYCLE84(50,0,2,-20,,0,5,,1,90,500,500,3,0,,0)",
        "CYCLE84(50,0,2,-20,,0,5,,1,0,500,500,0,0,1001,0)",
        "CYCLE840(50,0,2,-20,,0,0,0,0,,1,3)",
        "CYCLE86(50,0,2,-20,,0,3,-1,0,1,45)",
        "CYCLE81(50,0,2,-20,,0,0,0)",
    ] {
        assert_eq!(refused(call), None, "{call}");
    }
    for (call, message) in [
        ("CYCLE83(50,0,2,-20,,,8,0,0,0,1,1,1)", "CYCLE83 with AXN 1 is not supported"),
        ("CYCLE83(50,0,2,-20,,,8,0,0,0,1,2)", "CYCLE83 with VARI 2 is not supported"),
        ("CYCLE84(50,0,2,-20,,0,5,,1,0,500,500,1)", "CYCLE84 with AXN 1 is not supported"),
        ("CYCLE84(50,0,2,-20,,0,7,,1,0,500,500)", "CYCLE84 with SDAC 7 is not supported"),
        ("CYCLE840(50,0,2,-20,,0,0,0,0,,1,2)", "CYCLE840 with AXN 2 is not supported"),
        ("CYCLE840(50,0,2,-20,,0,0,0,20,,1)", "CYCLE840 with ENC 20 is not supported"),
        ("CYCLE86(50,0,2,-20,,0,5,-1,0,1,45)", "CYCLE86 with SDIR 5 is not supported"),
        ("CYCLE81(50,0,2,-20,,0,0,1,12)", "CYCLE81 with 1 as argument 8 is not supported"),
        ("CYCLE81(50,0,2,-20)\nHOLES1(0,0,0,10,10,3,1)", "HOLES1 with 1 as argument 7 is not supported"),
    ] {
        let said = refused(call).unwrap_or_else(|| panic!("{call} is run"));
        assert!(said.contains(message), "{call}: {said}");
    }
}

/// Siemens controls compare with a relative equality of 10^-12, so a sum with rounding errors reaches its limit.
#[test]
fn a_siemens_compares_with_relative_equality() {
    let head = "G17 G90 G54\nG0 X0 Y0 Z0\n";
    let table: [(&str, &[&str]); 3] = [
        ("R1=0.1\nWHILE R1<=0.3\nG0 X=IC(1)\nR1=R1+0.1\nENDWHILE\nM30", &["1 0 0", "2 0 0", "3 0 0"]),
        ("R1=0.1+0.2\nIF R1==0.3\nG0 X1\nENDIF\nIF R1<>0.3\nG0 X2\nENDIF\nM30", &["1 0 0"]),
        ("R1=0.3001\nIF R1<=0.3\nG0 X1\nENDIF\nM30", &[]),
    ];
    for (program, expected) in table {
        let all: Vec<&str> = ["0 0 0"].iter().chain(expected).copied().collect();
        goes("siemens", &format!("{head}{program}\n"), &all);
    }
    // a setting decides whether > and < take the difference for zero
    let said = actions(&format!("{head}R1=0.1+0.2\nIF R1>0.3\nG0 X1\nENDIF\nM30\n"), "siemens").1.unwrap();
    assert!(said.contains("differ only by rounding errors"), "{said}");
}

/// `REPEAT` ends at ENDLABEL, and a subprogram with SAVE restores the modes of its caller.
#[test]
fn a_siemens_repeats_to_its_end_label_and_restores_modes() {
    let head = "G17 G90 G54 G94\nG0 X0 Y0 Z0\n";
    let table: [(&str, &[&str]); 5] = [
        ("A1: G0 X=IC(1)\nENDLABEL:\nG0 Y=IC(1)\nREPEAT A1\nG0 Z1\nM30", &["1 0 0", "1 1 0", "2 1 0", "2 1 1"]),
        ("A1: G0 X=IC(1)\nENDLABEL:\nG0 Y=IC(1)\nREPEAT A1 P=2\nM30", &["1 0 0", "1 1 0", "2 1 0", "3 1 0"]),
        ("A1: G0 X=IC(1)\nG0 Y=IC(1)\nREPEAT A1\nM30", &["1 0 0", "1 1 0", "2 1 0", "2 2 0"]),
        ("SUB1\nX5\nM30\n%_N_SUB1_SPF\nPROC SUB1 SAVE DISPLOF\nG91 G0 X1\nM17", &["1 0 0", "5 0 0"]),
        ("SUB1\nX5\nM30\n%_N_SUB1_SPF\nPROC SUB1\nG91 G0 X1\nRET", &["1 0 0", "6 0 0"]),
    ];
    for (program, expected) in table {
        let all: Vec<&str> = ["0 0 0"].iter().chain(expected).copied().collect();
        goes("siemens", &format!("{head}{program}\n"), &all);
    }
    for (program, message) in [
        ("SUB1\nX5\nM30\n%_N_SUB1_SPF\nPROC SUB1 SAVE\nG18\nM17", "a subprogram with SAVE changes a plane"),
        ("SUB1\nX5\nM30\n%_N_SUB1_SPF\nPROC SUB1 SAVE\nTRANS X10\nM17", "a subprogram with SAVE changes a plane"),
        ("SUB1\nX5\nM30\n%_N_SUB1_SPF\nG91 G0 X1\nM30", "M30 in a subprogram ends the program or only the subprogram"),
        ("SUB1\nX5\nM30\n%_N_SUB1_SPF\nG0 X1 M2", "M2 in a subprogram"),
        ("A1: G0 X1\nENDLABEL: G0 Y1\nREPEAT A1\nM30", "ENDLABEL with a statement in its line"),
    ] {
        let said = actions(&format!("{head}{program}\n"), "siemens").1.unwrap_or_else(|| panic!("{program} is run"));
        assert!(said.contains(message), "{program}: {said}");
    }
}

/// G70 and G71 do not change the unit of feeds. Without the basic units of the machine, a feed is not proven.
#[test]
fn feeds_after_g70_and_g71_depend_on_the_machine() {
    let refused = |program: &str, own: Option<&'static str>| {
        let own = own.map(|text| Control::own("own.toml", text).unwrap());
        let settings =
            RunSettings { places_unknown: true, ..RunSettings::new(own.unwrap_or_else(|| control("siemens"))) };
        let mut simulator = Simulator::new(Cursor::new(program.as_bytes()), settings);
        let mut items = Vec::new();
        loop {
            match simulator.step(&mut items) {
                Ok(true) => {}
                Ok(false) => return None,
                Err(RunError::Refused(diag, _)) => return Some(diag.message.clone()),
                Err(RunError::Io(error)) => panic!("{error}"),
            }
        }
    };
    let program = |code: &str| format!("G17 G90 G54 {code}\nS500 M3\nG0 X0 Y0 Z5\nG1 Z-1 F100\nM30\n");
    for code in ["G70", "G71"] {
        let said = refused(&program(code), None).unwrap_or_else(|| panic!("{code} is run"));
        assert!(said.contains("a feed after G70 or G71"), "{said}");
        assert!(refused(&format!("F100\n{}", program(code).replace(" F100", "")), None).is_some(), "{code}");
    }
    for code in ["G700", "G710"] {
        assert_eq!(refused(&program(code), None), None, "{code}");
    }
    assert_eq!(refused("G17 G90 G54 G71\nG0 X0 Y0 Z5\nM30\n", None), None);
    let metric = "name = \"own\"\nlike = \"siemens\"\n[start]\nunits = \"mm\"\n";
    assert_eq!(refused(&program("G71"), Some(metric)), None);
    assert!(refused(&program("G70"), Some(metric)).is_some());
}

/// A setting of the machine decides whether an increment also traverses a change of frame or tool length.
#[test]
fn increments_after_a_change_of_frame_are_refused() {
    let run = |blocks: &str| actions(&format!("G17 G90 G54\nT1 M6\nG0 D1 X0 Y0 Z50\n{blocks}\nM30\n"), "siemens").1;
    for blocks in
        ["TRANS X10\nG0 X0\nG91 X1", "TRANS X10\nG91 G0 Y1", "TRANS X0\nG91 G0 X1", "D1\nG91 G0 Z1", "D0\nG91 G0 X1"]
    {
        assert_eq!(run(blocks), None, "{blocks}");
    }
    for blocks in [
        "TRANS X10\nG91 G0 X1",
        "TRANS X10\nG0 X=IC(1)",
        "ATRANS Z1\nG0 X1\nG91 Z-1",
        "D2\nG91 G0 Z1",
        "G91 G0 D0 Z100",
    ] {
        let said = run(blocks).unwrap_or_else(|| panic!("{blocks} is run"));
        assert!(said.contains("directly after a change of frame or tool length"), "{blocks}: {said}");
    }
}

/// The feed of TOOL CALL replaces the active feed.
#[test]
fn a_feed_of_a_tool_call_is_active() {
    let program = "0 BEGIN PGM T MM\n1 TOOL CALL 1 Z S1000 F300\n2 L X+0 Y+0 Z+5 R0 FMAX M3\n3 L Z-1 F100\n\
                   4 TOOL CALL S1200 F500\n5 L X+10\n6 M30\n";
    let (all, refused) = actions(program, "heidenhain");
    assert_eq!(refused, None);
    let feeds: Vec<f64> = all
        .iter()
        .filter_map(|action| if let Action::Feed { feed, .. } = action { Some(*feed) } else { None })
        .collect();
    assert_eq!(feeds, [100.0, 500.0]);
}

/// The parameters of a cycle are Q parameters: the call reads their current values.
#[test]
fn a_cycle_call_reads_its_parameters() {
    let bottom = |between: &str| {
        let program = format!(
            "0 BEGIN PGM T MM\n1 TOOL CALL 1 Z S1000 F500\n2 L X+0 Y+0 Z+10 FMAX M3\n3 CYCL DEF 200 DRILLING Q200=2 \
             Q201=-10 Q206=100 Q202=50 Q210=0 Q203=0 Q204=10 Q211=0\n{between}\n4 L X+5 Y+5 FMAX M99\n5 M30\n"
        );
        let [bottom, feed, _] = hole(&program, "heidenhain");
        (bottom, feed)
    };
    assert_eq!(bottom(";"), (-10.0, 100.0));
    assert_eq!(bottom("FN 0: Q201 = -20"), (-20.0, 100.0));
    assert_eq!(bottom("Q201 = -5 * 3\nQ206 = 80"), (-15.0, 80.0));
    assert_eq!(bottom("Q5 = -20"), (-10.0, 100.0));
}

/// A new datum resets the shift of CYCL DEF 7.
#[test]
fn a_datum_resets_the_shift() {
    let program = "0 BEGIN PGM T MM\n1 TOOL CALL 1 Z S1000\n2 CYCL DEF 247 Q339=1\n3 L X+0 Y+0 Z+0 R0 FMAX M3\n\
                   4 CYCL DEF 7.0\n5 CYCL DEF 7.1 X+10\n6 L X+0 FMAX\n7 CYCL DEF 247 Q339=1\n8 L Y+1 FMAX\n9 M30\n";
    // X stays where it is: 0 in the shifted frame is 10 in the frame of the datum
    goes("heidenhain", program, &["0 0 0", "0 0 0", "10 1 0"]);
}

/// M126, M116 and M94 change the moves of rotary axes, and PLANE with TURN or MOVE turns these axes.
#[test]
fn codes_that_turn_rotary_axes_are_refused() {
    let run = |blocks: &str| {
        let head = "0 BEGIN PGM T MM\n1 TOOL CALL 1 Z S1000\n2 L X+0 Y+0 Z+50 C+0 R0 FMAX M3\n";
        actions(&format!("{head}{blocks}\nM30\n"), "heidenhain").1
    };
    for blocks in [
        "M126\nL X+10 F100",
        "M126\nL X+10 C+0 F100",
        "M126\nM127\nL C+350 FMAX",
        "M116\nL C+90 FMAX",
        "M116\nM117\nL C+90 F100",
        "PLANE RESET TURN FMAX",
        "PLANE SPATIAL SPA+0 SPB+0 SPC+0 MOVE FMAX",
        "L C+90 FMAX\nPLANE RESET STAY",
        "L C+90 FMAX\nL C+0 FMAX\nPLANE RESET TURN FMAX",
        "L X+1 FMAX M120 LA5\nL X+2 F100",
    ] {
        assert_eq!(run(blocks), None, "{blocks}");
    }
    for (blocks, message) in [
        ("M126\nL C+350 FMAX", "C moves while M126 is active"),
        ("L C+350 FMAX M126", "C moves while M126 is active"),
        ("M126\nL IC+10 F100", "C moves while M126 is active"),
        ("M116\nL C+90 F100", "C moves while M116 is active"),
        ("M94\nL C+90 FMAX", "C moves while M94 is active"),
        ("L C+400 FMAX M94", "C moves while M94 is active"),
        ("L C+90 FMAX\nPLANE RESET TURN FMAX", "PLANE with TURN or MOVE"),
        ("L C+90 FMAX\nPLANE SPATIAL SPA+0 SPB+0 SPC+0 MOVE FMAX", "PLANE with TURN or MOVE"),
        ("PLANE RESET TURN MB MAX FMAX", "PLANE with MB"),
    ] {
        let said = run(blocks).unwrap_or_else(|| panic!("{blocks} is run"));
        assert!(said.contains(message), "{blocks}: {said}");
    }
}

/// A block with a slash causes one warning in each language: the result is for one position of the switch.
#[test]
fn blocks_with_a_slash_are_reported() {
    let klartext = "BEGIN PGM T MM\nTOOL CALL 1 Z S1000\n/L X+1 R0 FMAX\n/L X+2 FMAX\nM30\nEND PGM T MM\n";
    let siemens = "G17 G710 G90\n/G0 X1\n/2 G0 X2\nM30\n";
    for (name, program) in [("heidenhain", klartext), ("siemens", siemens), ("okuma", "G90\n/G0 X1\n/G0 X2\nM02\n")] {
        for (block_delete, does) in [(false, "are run"), (true, "are skipped")] {
            let settings = RunSettings { block_delete, ..RunSettings::new(control(name)) };
            let mut run = Simulator::new(Cursor::new(program), settings);
            let mut items = Vec::new();
            while run.step(&mut items).unwrap() {}
            let warnings = run.take_warnings();
            let [warning] = warnings.as_slice() else { panic!("{name}: {warnings:?}") };
            assert!(warning.code.name() == "PN038" && warning.message.contains(does), "{name}: {}", warning.message);
            let moves = items.iter().filter(|item| matches!(item.action, Action::Rapid { .. })).count();
            assert_eq!(moves, if block_delete { 0 } else { 2 }, "{name}");
        }
    }
}
