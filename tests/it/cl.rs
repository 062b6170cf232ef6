//! APT CL files in the style of each CAM system: the effect of each statement, and the refusals.

use crate::support;
use std::fs;
use std::sync::LazyLock;

use crate::support::folder::{Folder, err};
use crate::support::mill;
use postform::internals::cl::{Assumed, AssumedSpeed, Dialect, Options, Report, read_cl};
use postform::internals::compile::Program;
use postform::internals::render::Renderer;
use postform::toolpath::{Coolant, Event, Flow, Place, ReadError, Sink, Summary, Units};

const DRILL: &str = "Drill\nG[retplane] G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";

/// The blocks of a file between the tool change and the end, followed by the warnings. For a refused file: the error.
fn read(text: &str, options: Options) -> Vec<String> {
    static PROGRAM: LazyLock<Program> = LazyLock::new(|| {
        let form = mill("Units mm", DRILL).replace("G[work] X[h] Y[v] Z[d]\nEnd", "G[work]\nEnd");
        support::ready(&support::check(&form.replace("%0\n", "%0\nG[unitmode]\n"))).unwrap()
    });
    let mut renderer = Renderer::new(&PROGRAM, postform::internals::render::Options::default());
    let mut report = Report::default();
    let read = read_cl(text.as_bytes(), &options, &mut report, &mut renderer);
    let mut lines: Vec<String> =
        String::from_utf8(renderer.text().clone()).unwrap().lines().map(str::to_owned).collect();
    match read {
        Ok(()) => {
            lines.pop();
            let begins = lines.iter().position(|line| line.starts_with("G0 G54")).unwrap_or(0) + 1;
            lines.drain(..begins);
            lines.extend(report.warnings.iter().map(|warning| format!("{} {}", warning.code.name(), warning.message)));
            lines
        }
        Err(ReadError::Job(diag)) => {
            vec![format!("{} {} at {}", diag.code.name(), diag.message, diag.place.unwrap_or_default())]
        }
        Err(other) => panic!("{other:?}"),
    }
}

const HEAD: &str = "UNITS/MM\nLOADTL/1\nSPINDL/1000,RPM,CLW\nFEDRAT/100,MMPM\nRAPID\nGOTO/0,0,10\n";

fn body(text: &str) -> Vec<String> {
    read(&format!("{HEAD}{text}\nFINI\n"), Options::default())[1..].to_vec()
}

fn error(text: &str) -> String {
    let lines = read(&format!("{HEAD}{text}\nFINI\n"), Options::default());
    assert_eq!(lines.len(), 1, "{lines:?}");
    lines[0].clone()
}

#[test]
fn motions_go_where_they_say() {
    assert_eq!(body("GOTO/1,2,3\nRAPID\nGOTO / .5 , 2., 3\nGOTO/1,2,3"), ["G1 X1. Y2. Z3. F100.", "G0 X.5", "G1 X1."]);
    assert_eq!(body("GODLTA/1,0,-2\nGODLTA/-3"), ["G1 X1. Z8. F100.", "Z5."]);
    assert_eq!(body("FEDRAT/MMPM,50\nGOTO/1,0,10\nGOTO/2,0,10,75"), ["G1 X1. F50.", "X2. F75."]);
    assert_eq!(body("RAPID/GOTO/5,0,10"), ["X5."]);
    assert_eq!(body("TRANS/1,2,3\nGOTO/0,0,0\nORIGIN/1,0,0\nGOTO/5,0,0"), ["G1 X1. Y2. Z3. F100.", "X5."]);
}

/// Blanks, case, continuation lines, comments, record numbers, and points without GOTO are read as in real files.
#[test]
fn statements_are_read_as_they_are_written() {
    assert_eq!(body("goto/1,$ to the next line\n  2,3 $$ a remark"), ["G1 X1. Y2. Z3. F100."]);
    assert_eq!(body("N27 , GOTO/1,0,10\n2,0,10\n3,0,10"), ["G1 X1. F100.", "X2.", "X3."]);
    assert_eq!(body("PPRINT/OPERATION: (face)\r\nGOTO/1,0,10\r"), ["(OPERATION: [FACE])", "G1 X1. F100."]);
    assert_eq!(body("INSERT/M88\nSYN/'A','$$*B'\nAUXFUN/8\nPREFUN/61"), ["M88", "M8", "G61"]);
    assert_eq!(body("SPINKL/5\nSPINKL/6\nGOTO/1,0,10")[1], "PL003 `SPINKL` is unknown and is ignored, 2 times");
}

#[test]
fn feeds_are_those_of_their_units() {
    assert_eq!(body("FEDRAT/1,IPM\nGOTO/1,0,10"), ["G1 X1. F25.4"]);
    assert_eq!(body("FEDRAT/.2,MMPR\nGOTO/1,0,10"), ["G1 X1. F200."]);
    assert_eq!(body("FEDRAT/PERREV,.1\nSPINDL/500,CLW\nGOTO/1,0,10"), ["S500 M3", "G1 X1. F50."]);
    assert!(error("SPINDL/OFF\nFEDRAT/.2,MMPR\nGOTO/1,0,10").starts_with("PC009 a feed per revolution"));
    assert!(error("FEDRAT/10,FURLONGS").starts_with("PL002 a FEDRAT"));
}

/// A tool change is complete when its spindle speed is known. The speed may come after the first rapids.
#[test]
fn the_spindle_may_come_after_the_first_rapids() {
    let text =
        "UNITS/MM\nLOAD/TOOL,45\nRAPID\nGOTO/0,0,50\nSPINDL/RPM,1310,CCLW\nCOOLNT/ON\nRAPID\nGOTO/1,0,50\nFINI\n";
    let lines = read(text, Options::default());
    assert_eq!(lines, ["M8", "G0 X0 Y0 Z50.", "X1."]);
    assert!(
        read("UNITS/MM\nRAPID\nGOTO/0,0,1\nFINI", Options::default())[0]
            .starts_with("PJ006 the file loads no tool before")
    );
    let stop = read("UNITS/MM\nSTOP\nLOADTL/1\nFINI", Options::default());
    assert_eq!(stop, ["PJ006 the file loads no tool before this line at 2:1"]);
    // a tool change that a stop completes has no speed
    let folder = Folder::new("speed-after-stop");
    folder.write("job.cl", "UNITS/MM\nLOADTL/2\nSTOP\nSPINDL/900,CLW\nRAPID\nGOTO/0,0,1\nFINI\n");
    let form = support::root().join("postforms/haas.pf");
    let run = folder.run(&["render", "job.cl", "--program", "1", "--form", form.to_str().unwrap()]);
    let help = "the tool change of line 2 has no spindle speed, because SPINDL is not before line 3";
    assert!(err(&run).contains(help), "{}", err(&run));
    let assumed = Options { tool: Some(Assumed::One(3.0)), ..Options::default() };
    assert!(read("UNITS/MM\nSPINDL/9,CLW\nRAPID\nGOTO/0,0,1\nFINI", assumed)[0].starts_with("G0 X0"));
}

#[test]
fn arcs_turn_as_their_system_means_them() {
    let arc = "GOTO/1,0,10\nCIRCLE/1,1,10,0,0,1,1\nGOTO/2,1,10";
    let by = |dialect| {
        let options = Options { dialect: Some(dialect), ..Options::default() };
        read(&format!("{HEAD}{arc}\nFINI\n"), options)[2].clone()
    };
    assert_eq!(by(Dialect::SolidWorksCam), "G17 G3 X2. Y1. I0 J1.");
    assert_eq!(by(Dialect::Makino), "G17 G2 X2. Y1. I0 J1.");
    // in a file of an unknown CAM system, the direction of an arc follows from the direction of the line before the arc
    assert_eq!(body(arc)[1], "G17 G3 X2. Y1. I0 J1.");
    assert!(error("GOTO/1,0,10\nCIRCLE/2,0,10,0,0,1,1\nGOTO/3,0,10").starts_with("PL006 the direction of this CIRCLE"));
    assert!(
        error(&format!("{arc}\nGOTO/2,5,10\nCIRCLE/3,5,10,0,0,1,1\nGOTO/4,5,10"))
            .starts_with("PL006 if this arc is tangent")
    );
    assert_eq!(body("GOTO/1,0,10\nMOVARC/1,1,10,0,0,1,1\nGOTO/2,1,10")[1], "G17 G3 X2. Y1. I0 J1.");
    let tlon = "GOTO/1,0,10\nINDIRV/1,0,0\nTLON,GOFWD/ (CIRCLE/ 1, 1, 10,$\n 1),ON,(LINE/1,1,10,$\n 2,1,10)";
    assert_eq!(body(tlon)[1], "G17 G3 X2. Y1. I0 J1.");
    // the axis of a circle may have any length
    let circle = |axis: &str| format!("GOTO/1,0,10\nCIRCLE/1,1,10,{axis},1\nGOTO/2,1,10");
    for tilted in [".6,0,.8", ".5,0,1", ".5,0,-1", "0,5,5"] {
        assert!(error(&circle(tilted)).starts_with("PL004 an arc in a tilted plane"), "{tilted}");
    }
    assert!(error(&circle("0,0,0")).starts_with("PL001 a circle with an axis of no direction"));
    let movarc = |axis: &str| body(&circle(axis).replace("CIRCLE", "MOVARC"))[1].clone();
    assert_eq!(
        [movarc("0,0,1"), movarc("0,0,5"), movarc("0,0,.2")].map(|line| line == "G17 G3 X2. Y1. I0 J1."),
        [true; 3]
    );
}

#[test]
fn compensation_goes_with_the_next_motion() {
    let lines = body("CUTCOM/LEFT\nGOTO/1,0,10\nGOTO/5,0,10\nCUTCOM/OFF\nRAPID\nGOTO/5,5,10");
    assert_eq!(lines, ["G1 G41 X1. D1 F100.", "X5.", "G0 G40 Y5."]);
    assert_eq!(body("CUTCOM/OFF\nGOTO/1,0,10"), ["G1 X1. F100."]);
    assert!(error("CUTCOM/LEFT\nCYCLE/DRILL,DEPTH,1,MMPM,9\nGOTO/1,1,0").starts_with("PC041"));
}

/// Cycle words of other systems have the meaning that their own system defines.
#[test]
fn cycles_of_other_systems_are_read_by_their_dialect() {
    let by = |dialect, text: &str| {
        let options = Options { dialect: Some(dialect), ..Options::default() };
        read(&format!("{HEAD}{text}\nGOTO/1,1,0\nCYCLE/OFF\nFINI\n"), options)
    };
    let drilled =
        |lines: &[String]| lines.iter().find(|line| line.contains("G81")).cloned().unwrap_or(lines[0].clone());
    let swcam = by(Dialect::SolidWorksCam, "CYCLE/INIT\nCYCLE/DRILL,FEDTO,5,MMPM,90,RAPTO,2,RTRCTO,8,DWELL,0");
    assert_eq!(drilled(&swcam), "G98 G81 X1. Y1. Z-5. R2. F90.");
    let ncl = by(Dialect::Ncl, "CYCLE/DRILL,FEDTO,5,MMPM,90,RAPTO,2");
    assert_eq!(drilled(&ncl), "G99 G81 X1. Y1. Z-5. R2. F90.");
    let catia = by(Dialect::Catia, "CYCLE/DRILL,5,2,90,MMPM");
    assert_eq!(drilled(&catia), "G99 G81 X1. Y1. Z-5. R2. F90.");
    assert!(by(Dialect::Gener, "CYCLE/DRILL,5,2,90,MMPM")[0].starts_with("PC032"));
    let feed = by(Dialect::Catia, "FEDRAT/300,MMPM\nCYCLE/DRILL,5,2");
    assert_eq!(drilled(&feed), "G99 G81 X1. Y1. Z-5. R2. F300.");
    let tap = by(Dialect::Catia, "FEDRAT/1.25,MMPR\nCYCLE/TAP,5,2");
    assert!(tap.iter().any(|line| line.contains("F1250.")) || tap[0].starts_with("PC021"), "{tap:?}");
    assert!(by(Dialect::Gener, "CYCLE/DRILL,FEDTO,5,MMPM,90")[0].starts_with("PC018 `FEDTO`"));
    let text = "CYCLE/DRILL,RAPTO,2,FEDTO,-5,RTRCTO,AUTO,MMPM,90\nGOTO/1,1,0\nCYCLE/OFF\nEND-OF-PATH\n";
    let options = Options { dialect: Some(Dialect::Nx), ..Options::default() };
    // RTRCTO,AUTO returns to the height of the tool before the cycle
    assert_eq!(drilled(&read(&format!("{HEAD}{text}"), options)), "G98 G81 X1. Y1. Z-5. R2. F90.");
}

#[test]
fn what_moves_the_part_or_is_cut_off_is_refused() {
    assert!(error("TRACUT/1").starts_with("PL004 TRACUT"));
    assert!(error("GOTO/1,2").starts_with("PL001 GOTO with 2 numbers at 7:1"));
    assert!(error("GOTO/1,2,1e999").starts_with("PL001 `1E999` is not a number"));
    assert!(error("GOTO/1,2,3,.6,0,.8").starts_with("PR008 the tool is tilted"));
    assert!(error("COOLNT/BEER").starts_with("PL002 COOLNT can't take `BEER`"));
    assert!(error("MODE/INCR").starts_with("PL004"));
    assert!(error("CIRCLE/1,1,1,0,0,1").starts_with("PL007"));
    let whole = |text: &str| read(text, Options::default())[0].clone();
    assert!(whole(&format!("{HEAD}GOTO/1,2,3\n")).starts_with("PL007 the file ends without FINI"));
    assert!(whole(&format!("{HEAD}GOTO/1,$\n")).starts_with("PL007 the file ends inside a statement"));
    assert!(whole(&format!("{HEAD}FINI\nGOTO/1,1,1\n")).starts_with("PL001 a statement after FINI"));
    assert!(whole("LOADTL/1\nSPINDL/1,CLW\nRAPID\nGOTO/0,0,0\nFINI").starts_with("PL005"));
    assert!(whole("").starts_with("PL007"));
    assert!(whole("\0\0\0\nFINI").starts_with("PL001 a byte"));
    assert!(
        whole("UNITS/MM\nLOADTL/1\nSPINDL/1,CLW\nGOTO/0,0,0\nFINI").starts_with("PR011 a feed motion before any feed")
    );
}

/// Every randomly changed file gives a result or an error, and never a panic.
#[test]
fn mutated_files_get_an_answer() {
    let mut state = 7u64;
    let mut next = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) as usize % below
    };
    let parts = [
        "GOTO/1,2,3\n",
        "RAPID\n",
        "CYCLE/",
        "DRILL,",
        "DEEP,",
        "DEPTH,5,",
        "STEP,",
        "CLEAR,2,",
        "MMPM,90,",
        "-1,",
        "$\n",
        "\n",
        "CIRCLE/1,1,1,0,0,1\n",
        "CUTCOM/LEFT\n",
        "CYCLE/OFF\n",
        "LOADTL/2\n",
        ",,",
        "'",
        "TLON,GOFWD/(CIRCLE/1,1,1,1),ON,(LINE/",
        "FEDRAT/1,IPR\n",
        "SPINDL/OFF\n",
        "CYCLE/ON\n",
        "RETURN,",
        "DECR,1,",
        "1e300,",
        "GODLTA/1\n",
        "INDIRV/1,0,0\n",
        "FINI\n",
        "GOHOME/5,5,5\n",
        "MOVARC/1,1,1,0,0,1,1,TIMES,1e3\n",
        "MOVARC/1,1,1,0,0,1,1,ANGLE,9e4\n",
        "CSYS/1,0,0,0,0,1,0,0,0,0,1,0\n",
        "TOOLNO/1,TURN\n",
        "MODE/TURN\n",
        "TOOL PATH/A,TOOL,B\n",
        "SPINDL/100,SFM,MAXRPM,\n",
        "CUTCOM/OFF\n",
        "BORE,NODRAG,RTRCTO,AUTO,FEDTO,-1,",
        "INCR,1,IPM,5,5,RAPTO,",
    ];
    let dialects: Vec<Option<Dialect>> = Dialect::names().map(|name| Dialect::parse(name).ok()).chain([None]).collect();
    for _ in 0..20_000 {
        let mut text = HEAD.to_owned();
        for _ in 0..next(24) {
            text += parts[next(parts.len())];
        }
        let mut report = Report::default();
        let mut summary = Summary::default();
        let options = Options { dialect: dialects[next(dialects.len())], ..Options::default() };
        let _ = read_cl(text.as_bytes(), &options, &mut report, &mut summary);
        read(&text, options);
    }
}

/// If a file lacks a value, the error names the option for this value. With the option, the job is printed.
#[test]
fn what_a_file_leaves_open_has_an_option() {
    let file = "LOADTL/1\nSPINDL/900,CLW\nFROM/0,0,20\nFEDRAT/50\nGOTO/0,0,1\nFINI\n";
    let whole = format!("UNITS/MM\n{file}");
    let cases: [(&str, String, &str, Options); 6] = [
        ("--assume-units", file.into(), "PL005", Options { units: Some(Units::Mm), ..Options::default() }),
        (
            "--assume-tool",
            whole.replace("LOADTL/1\n", ""),
            "PJ006",
            Options { tool: Some(Assumed::One(1.0)), ..Options::default() },
        ),
        (
            "--assume-speed",
            whole.replace("SPINDL/900,CLW\n", ""),
            "PL009",
            Options { speed: Some(AssumedSpeed { rpm: 900.0, ccw: false }), ..Options::default() },
        ),
        (
            "--assume-feed",
            whole.replace("FEDRAT/50\n", ""),
            "PR011",
            Options { feed: Some(50.0), ..Options::default() },
        ),
        (
            "--assume-start",
            whole.replace("FROM/0,0,20\n", ""),
            "PL009",
            Options { start: Some([0.0, 0.0, 20.0]), ..Options::default() },
        ),
        ("--assume-end", whole.replace("FINI\n", ""), "PL007", Options { end: true, ..Options::default() }),
    ];
    for (option, text, code, assumed) in cases {
        let mut report = Report::default();
        let Err(ReadError::Job(diag)) =
            read_cl(text.as_bytes(), &Options::default(), &mut report, &mut Summary::default())
        else {
            panic!("{option}: the file is read without it");
        };
        assert_eq!(diag.code.name(), code, "{option}");
        assert!(diag.help.as_deref().unwrap_or("").contains(option), "{option}: {diag:?}");
        assert_eq!(read(&text, assumed), ["G0 X0 Y0 Z20.", "G1 Z1. F50."], "{option}");
    }
}

/// One error names all missing values. `check` reports why no form can print a job.
#[test]
fn whatever_keeps_a_file_from_being_printed_is_said_at_once() {
    let summary = |text: &str| {
        let mut summary = Summary::default();
        read_cl(text.as_bytes(), &Options::default(), &mut Report::default(), &mut summary).map(|()| summary)
    };
    let Err(ReadError::Job(diag)) = summary("RAPID\nGOTO/0,0,9\nFEDRAT/100\nGOTO/0,0,1\nFINI\n") else {
        panic!("read")
    };
    let help = diag.help.unwrap();
    for option in ["--assume-speed 3000", "--assume-units mm", "--assume-tool 1"] {
        assert!(help.contains(option), "{option}: {help}");
    }
    let why = |text: &str| -> Vec<String> {
        let found = summary(&format!("{HEAD}{text}\nFINI\n")).unwrap().unprintable();
        found.into_iter().map(|diag| format!("{} {}", diag.code.name(), diag.message)).collect()
    };
    assert!(why("GOTO/1,1,1").is_empty());
    assert_eq!(
        why("GOTO/1,1,1,.6,0,.8\nGOTO/1,2,1,.8,0,.6"),
        ["PR008 no form can print the job, because the tool is tilted (2 moves, the first one here)"]
    );
    assert_eq!(
        why("GOTO/1,1,1\nLOADTL/2\nLOADTL/3\nSPINDL/9,CLW\nRAPID\nGOTO/1,1,9"),
        ["PR012 no form can print the job, because an operation has no move"]
    );
}

/// GOHOME with a position is a rapid to this position. The tool moves up before it moves across. TIMES of NX and ANGLE
/// of Autodesk give the number of turns of a helix.
#[test]
fn places_and_turns_are_those_that_are_written() {
    assert_eq!(body("GOTO/1,0,2\nGOHOME/5,5,40"), ["G1 X1. Z2. F100.", "G0 Z40.", "X5. Y5."]);
    assert_eq!(body("GOTO/1,0,50\nGOHOME/5,5,40")[1..], ["G0 X5. Y5.", "Z40."]);
    assert!(error("GOHOME").starts_with("PR008 the tool goes home here"));
    assert!(error("GOHOME/1,2").starts_with("PL001 a GOHOME that can't be read"));
    let arc = |tail: &str| format!("GOTO/1,0,10\nMOVARC/1,1,10,0,0,1,1{tail}\nGOTO/2,1,10");
    assert_eq!(body(&arc(",ANGLE,90")), body(&arc("")));
    assert_eq!(body(&arc(",ANGLE,450")), body(&arc(",TIMES,2")));
    assert_ne!(body(&arc(",TIMES,2")), body(&arc("")));
    assert!(error(&arc(",ANGLE,100")).starts_with("PR005 an arc of 100 degrees"));
    assert!(error(&arc(",FOO,2")).starts_with("PL002 `FOO` after the numbers"));
    assert!(error("NURBS/1,2").starts_with("PL004 NURBS: a spline"));
}

/// Compensation that is turned off before an arc ends in the next straight motion in the plane. A motion along the
/// depth axis does not end the compensation.
#[test]
fn compensation_waits_for_a_straight_motion_in_the_plane() {
    let lines = body(
        "CUTCOM/LEFT\nGOTO/1,0,10\nCUTCOM/OFF\nMOVARC/1,1,10,0,0,1,1\nGOTO/2,1,10\nRAPID\nGOTO/2,1,20\nRAPID\nGOTO/5,5,20",
    );
    assert_eq!(lines[..4], ["G1 G41 X1. D1 F100.", "G17 G3 X2. Y1. I0 J1.", "G0 Z20.", "G40 X5. Y5."]);
    assert!(lines[4].starts_with("PL008 CUTCOM/OFF comes before an arc"));
    assert!(error("CUTCOM/LEFT\nMOVARC/0,1,10,0,0,1,1\nGOTO/1,1,10").starts_with("PL004 cutter compensation can't"));
}

/// Rapids before the first tool are left out. If a file loads the same tool twice in a row, the job has one tool
/// change.
#[test]
fn what_stands_before_the_first_tool_is_not_its_path() {
    let text = "UNITS/MM\nRAPID\nGOTO/0,0,100\nRAPID\nGOTO/9,9,100\nLOADTL/1\nLOADTL/1,1\nSPINDL/9,CLW\nRAPID\nGOTO/1,1,50\nFINI\n";
    assert_eq!(
        read(text, Options::default()),
        ["G0 X1. Y1. Z50.", "PL008 2 rapids before the first tool, from line 3 on, are left out"]
    );
}

/// Cycles of Autodesk contain the bottom and the other heights as absolute positions. If postform read these values as
/// depths below the points, the holes would be twice as deep.
#[test]
fn holes_of_autodesk_begin_above_their_points() {
    let options = || Options { dialect: Some(Dialect::Autodesk), ..Options::default() };
    let text = |cycle: &str| format!("{HEAD}CYCLE/{cycle}\nGOTO/1,1,-10\nGOTO/2,2,-11\nCYCLE/OFF\nFINI\n");
    let holes =
        |cycle: &str| read(&text(cycle), options()).into_iter().filter(|l| l.contains("G81")).collect::<Vec<_>>();
    assert_eq!(
        holes("DRILL, 10., MMPM, 150., 15., RAPTO, 12."),
        ["G98 G81 X1. Y1. Z-10. R3. F150.", "G98 G81 X2. Y2. Z-11. R3. F150."]
    );
    assert_eq!(holes("DRILL, 10., MMPM, 150., 15.")[0], "G99 G81 X1. Y1. Z-10. R15. F150.");
    for (cycle, code) in [
        ("BORE, 10., MMPM, 9., 15., ORIENT, 0", "PC001"),
        ("DRILL, 10.", "PC037"),
        ("DRILL, 10., MMPM, 150., -5.", "PC004"),
    ] {
        assert!(read(&text(cycle), options())[0].starts_with(code), "{cycle}: {:?}", read(&text(cycle), options()));
    }
    assert!(read(&format!("{HEAD}SPINDL/ON\nFINI"), options())[0].starts_with("PL004 SPINDL/ON: Autodesk's"));
}

/// A tool path of Autodesk's post for CAMplete: the lines from NEW SECTION to the statement before the first motion.
fn tool_path(name: &str, mcs: &str, rest: &str) -> String {
    format!(
        "PPRINT/'NEW SECTION'\nPPRINT/'Comment: {name}'\nCSI_TOOL_PATH/{name}\nUNITS/MM\nMULTAX/OFF\n\
        PPRINT/'MATRIX DEFINITION'\nMCS/{mcs}\n{rest}\n"
    )
}

const UPRIGHT: &str = "1., 0., 0., $\n0., 1., 0., $\n0., 0., 1., $\n0., 0., 0.";

/// The blocks of a file with one tool path of Autodesk's post for CAMplete.
fn camplete(rest: &str) -> Vec<String> {
    let tool = format!("LOADTL/1, 0, 40., 1\nSPINDL/RPM,1000,CLW\n{rest}");
    read(&format!("MODE/MILL\nPARTNO/'1'\n{}END\nFINI\n", tool_path("A", UPRIGHT, &tool)), Options::default())
}

/// The points of CAMplete's cycles are the tops of the holes. CLEAR is a height of the file, RAPTO is a distance.
#[test]
fn holes_of_camplete_begin_at_rapto_and_return_to_clear() {
    let holes = |cycle: &str| {
        let text = format!("RAPID\nGOTO/1., 1., 20.\nCYCLE/{cycle}\nGOTO/1., 1., 4.\nGOTO/2., 2., 3.\nCYCLE/OFF");
        camplete(&text).into_iter().filter(|line| line.contains(" R") || line.starts_with('P')).collect::<Vec<_>>()
    };
    assert_eq!(
        holes("DRILL, FEDTO, 10., MMPM, 150., CLEAR, 20., RTRCTO, 16., RETURN, 16., RAPTO, 5."),
        ["G98 G81 X1. Y1. Z-6. R9. F150.", "X2. Y2. Z-7. R8."]
    );
    for (cycle, error) in [
        ("DRILL, FEDTO, 10., MMPM, 150., CLEAR, 20., RETURN, 15., RAPTO, 5.", "PC040 the return plane is at 20"),
        ("DRILL, FEDTO, 10., MMPM, 150., CLEAR, 20., RETURN, 16.", "PL009 a cycle without RAPTO"),
        ("BORE, FEDTO, 10., MMPM, 150., CLEAR, 20., 0.2, RETURN, 16., RAPTO, 5., ORIENT, 0", "PC015 the angle at"),
        ("DRILL, FEDTO, 10., MMPM, 150., RAPTO, 5.", "PC040 a cycle without CLEAR"),
        ("FACE, FEDTO, 10., MMPM, 150., CLEAR, 20., RAPTO, 5.", "PC001 `FACE` is a cycle"),
        ("DRILL, FEDTO, 10., MMPM, 150., CLEAR, 20., RAPTO, 5., STEP, 1.", "PC018 `STEP` in a cycle"),
        ("DRILL, FEDTO, MMPM, 150., CLEAR, 20., RAPTO, 5.", "PC033 FEDTO without its number"),
    ] {
        let refused = holes(cycle);
        assert!(refused[0].starts_with(error), "{cycle}: {refused:?}");
    }
}

/// Statements of Autodesk's post for CAMplete that differ from those of other systems.
#[test]
fn statements_of_camplete_are_read_as_its_post_writes_them() {
    let cut = "RAPID\nGOTO/0., 0., 9.\nFEDRAT/100., MMPM\nGOTO/1., 0., 9.";
    let lines = |rest: &str| camplete(&format!("{rest}\n{cut}"));
    let has = |rest: &str, line: &str| {
        let lines = lines(rest);
        assert!(lines.iter().any(|found| found.starts_with(line)), "{rest}: {lines:?}");
    };
    // the last three numbers of CIRCLE are zero, the fourth last is the angle; circles turn clockwise about their axis
    let arc = |axis: &str, angle: &str| {
        format!("{cut}\nCIRCLE/1., 1., 9., 0., 0., {axis}, 1., {angle}, 0.0, 0.0, 0.0\nGOTO/2., 1., 9.")
    };
    has(&arc("-1.", "90."), "G17 G3 X2. Y1. I0 J1.");
    has(&arc("1.", "270."), "G17 G2 X2. Y1. I0 J1.");
    has(&arc("1.", "90."), "PR005 an arc of 90 degrees");
    // only a left-hand tap has a negative speed
    has(&format!("{cut}\nSPINDL/RPM,-500,CLW"), "S500 M4");
    has("CSI_INSERT_CUSTOM_GCODE/G10 L2 P1 (it's $5)", "G10 L2 P1 (it's $5)");
    has("CSI_SET_PATH_PARAM/TOOL_BREAK=ON", "PL008 TOOL_BREAK=ON of CSI_SET_PATH_PARAM is ignored");
    has("CSI_SET_PATH_PARAM/CSI_FORCE_TOOL_CHANGE=1\nLOADTL/1, 0, 40., 1", "PL008 CSI_FORCE_TOOL_CHANGE is ignored");
    has("PPRINT/'Unsupported command COMMANDSTOP'", "PL008 the post did not write a command");
    has("COOLNT/CUSTOM2", "PL002 COOLNT/CUSTOM2 is air through the tool");
    has("MULTAX/ON\nCYCLE/DRILL, FEDTO, 1., MMPM, 9., CLEAR, 9., RAPTO, 1.", "PL004 a cycle after MULTAX/ON");
    has("SPINDL/ON", "PL004 SPINDL/ON: Autodesk's post exchanges ON and OFF");
    has("ZERO/2", "G0 G55");
    has("ZERO/0", "PL001 ZERO without the number of a work offset");
    let silent = lines("CSI_TOOL_PATH/Rand \u{d8}40 it's\nUNDEFINED\nCSI_PATH_TOLERANCE/0.01");
    assert!(!silent.iter().any(|line| line.starts_with('P')), "{silent:?}");
}

/// Each tool path of CAMplete writes all its coolants. A tool path without COOLNT has no coolant.
#[test]
fn coolants_of_camplete_are_those_of_each_tool_path() {
    let cut = "RAPID\nGOTO/0,0,9\nFEDRAT/100,MMPM\nGOTO/1,0,9\n";
    let path =
        |coolant: &str| tool_path("A", UPRIGHT, &format!("LOADTL/1, 0, 40., 1\nSPINDL/RPM,900,CLW\n{coolant}{cut}"));
    let text = format!("{}{}{}END\n", path("COOLNT/FLOOD\nCOOLNT/MIST\n"), path("COOLNT/ON\nCOOLNT/MIST\n"), path(""));
    struct Coolants(Vec<Option<Coolant>>);
    impl Sink for Coolants {
        fn event(&mut self, event: Event<'_>, _: Place) -> Flow {
            if let Event::ToolChange(change) = event {
                self.0.push(change.coolant);
            }
            Flow::Continue(())
        }
    }
    let mut coolants = Coolants(Vec::new());
    read_cl(text.as_bytes(), &Options::default(), &mut Report::default(), &mut coolants).unwrap();
    let both = |coolant: &Option<Coolant>| coolant.is_some_and(|c| c.is_same(Coolant::FLOOD.and(Coolant::MIST)));
    assert!(both(&coolants.0[0]) && both(&coolants.0[1]), "{:?}", coolants.0);
    assert_eq!(coolants.0[2], Some(Coolant::OFF));
}

/// Each MCS with another frame is a setup, whose positions are in this frame. The texts before an MCS belong to its setup.
/// A tool path without a work offset among others with a work offset is refused.
#[test]
fn setups_of_camplete_are_those_of_mcs() {
    let front = "1., 0., 0., $\n0., 0., 1., $\n0., -1., 0., $\n5., 6., 7.";
    let path = |name: &str, mcs: &str, zero: &str| {
        let cut = "RAPID\nGOTO/0,0,9\nFEDRAT/100,MMPM\nGOTO/1,0,9";
        let code = format!("CSI_TOOL_PATH/{name}\nCSI_INSERT_CUSTOM_GCODE/M{name}");
        tool_path(name, mcs, &format!("LOADTL/{name}, 0, 9., 1\nSPINDL/RPM,900,CLW\n{zero}{cut}"))
            .replace(&format!("CSI_TOOL_PATH/{name}"), &code)
    };
    let text = format!(
        "{}{}{}{}END\n",
        path("21", UPRIGHT, "ZERO/1\n"),
        path("22", front, "ZERO/2\n"),
        path("23", front, "ZERO/2\n"),
        path("24", UPRIGHT, "ZERO/1\n")
    );
    let found = postform::internals::cl::setups(text.as_bytes(), &Options::default()).unwrap();
    let said: Vec<String> = found.iter().map(ToString::to_string).collect();
    assert_eq!(said[1], "tool axis 0 -1 0, x axis 1 0 0, origin 5 6 7, 4 motions in lines 34 to 54");
    assert_eq!(said.len(), 3);
    let codes = |setup| {
        let blocks = read(&text, Options { setup: Some(setup), ..Options::default() });
        blocks.into_iter().filter(|block| block.starts_with("M2")).collect::<Vec<_>>()
    };
    assert_eq!([codes(1), codes(2), codes(3)], [vec!["M21"], vec!["M22", "M23"], vec!["M24"]]);
    let whole = read(&text, Options::default());
    assert!(whole[0].starts_with("PL004 a turned MCS"), "{whole:?}");
    let mixed = format!("{}{}END\n", path("21", UPRIGHT, "ZERO/1\n"), path("22", UPRIGHT, ""));
    let mixed = read(&mixed, Options::default());
    assert!(mixed[0].starts_with("PL004 some tool paths of the file have a work offset"), "{mixed:?}");
}

/// BORE of NX feeds out of the hole. BORE with DRAG retracts at rapid. In files of other systems, BORE stops the
/// spindle.
#[test]
fn bores_of_nx_come_out_as_they_are_named() {
    let kind = |cycle: &str| {
        let text = format!("{HEAD}CYCLE/{cycle},RAPTO,3,FEDTO,-5,MMPM,90\nGOTO/1,1,0\nCYCLE/OFF\nEND-OF-PATH\n");
        let options = Options { dialect: Some(Dialect::Nx), ..Options::default() };
        let mut summary = Summary::default();
        match read_cl(text.as_bytes(), &options, &mut Report::default(), &mut summary) {
            Ok(()) => summary.holes[0].0.name().to_owned(),
            Err(ReadError::Job(diag)) => diag.code.name().to_owned(),
            Err(ReadError::Stopped) => panic!("a summary takes all"),
            Err(ReadError::Io(error)) => panic!("{error}"),
        }
    };
    assert_eq!([kind("BORE"), kind("BORE,DRAG"), kind("BORE,NODRAG")], ["ream", "bore", "bore"]);
    assert_eq!(kind("BORE,MANUAL"), "PC001");
}

/// A coordinate system whose Z axis is not the tool axis is an error in the current setup.
#[test]
fn coordinate_systems_agree_with_the_tool() {
    let turned = "CSYS/1,0,0,0,0,0,-1,-40,0,1,0,-20";
    assert!(
        error(&format!("{turned}\nGOTO/1,0,10"))
            .starts_with("PL004 the tool axis is not the z axis of the CSYS of line 7:")
    );
    // the same error with a hole as the first point, and with a small angle
    let hole = format!("{turned}\nCYCLE/DRILL,DEPTH,1,MMPM,9,CLEAR,2\nGOTO/1,0,10\nCYCLE/OFF");
    assert!(error(&hole).starts_with("PL004 the tool axis is not the z axis of the CSYS of line 7:"));
    let little = "CSYS/1,0,.005,0,0,1,0,0,-.005,0,1,0";
    assert!(
        error(&format!("{little}\nGOTO/1,0,10"))
            .starts_with("PL004 the tool axis is not the z axis of the CSYS of line 7:")
    );
    let moved = "CSYS/1,0,0,0,0,1,0,0,0,0,1,0\nGOTO/1,0,10\nCSYS/1,0,0,5,0,1,0,0,0,0,1,0\nGOTO/2,0,10";
    assert!(body(moved)[2].starts_with("PL008 this CSYS differs from the CSYS of line 7"));
}

/// A turning file becomes a job for a lathe: with Z and the radius, feeds per revolution and constant surface speed.
#[test]
fn turning_is_a_job_for_a_lathe() {
    let text = fs::read_to_string(support::root().join("tests/data/cl/catia-turning.aptsource")).unwrap();
    let form = support::check_file(&support::root().join("postforms/fanuc-lathe.pf"));
    let metric =
        postform::internals::render::Options { units: Some(Units::Inch), program: Some(1), ..Default::default() };
    let rendered = support::render_kind(&form, text.as_bytes(), support::Kind::Cl, metric).unwrap().text;
    for block in ["G96", "Z-1.5748", "F.0118"] {
        assert!(rendered.contains(block), "{block} in\n{rendered}");
    }
    // CATIA describes a turning tool in the words after the tool number
    let told = "TOOLNO/1,TURN,1,0,3,0.4,$\n0.0,0.0,0.1,MMPR,500.0,SFM,$\nCCLW,ON,0.0,NOTE";
    assert!(text.contains("TOOLNO/1,TURN"));
    let described = text.replace("TOOLNO/1,TURN", told);
    let options =
        postform::internals::render::Options { units: Some(Units::Inch), program: Some(1), ..Default::default() };
    let same = support::render_kind(&form, described.as_bytes(), support::Kind::Cl, options).unwrap().text;
    assert_eq!(same, rendered);
    let off = text.replace("28.00000,    0.00000,  -40", "28.00000,    1.00000,  -40");
    let mut summary = Summary::default();
    let Err(ReadError::Job(diag)) = read_cl(off.as_bytes(), &Options::default(), &mut Report::default(), &mut summary)
    else {
        panic!("a point off the plane is read");
    };
    assert_eq!(diag.message, "a turning tool at y 1");
}

/// Each real file is read, or is refused because it lacks a value. The test runs only if the files are next to the
/// checkout.
#[test_with::path(../shared/data/cl)]
#[test]
fn real_files_are_read_or_refused_for_a_reason() {
    let folder = fs::read_dir(support::root().join("../shared/data/cl")).unwrap();
    let mut names = 0;
    for entry in folder {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if name.ends_with(".md") {
            continue;
        }
        names += 1;
        let text = fs::read_to_string(&path).unwrap();
        let first = |options: Options| {
            let lines = read(&text, options);
            let line = lines.into_iter().find(|line| !line.starts_with('(')).unwrap();
            if line.starts_with(['P', 'L']) { line } else { "printed".into() }
        };
        let (plain, assumed) = match name.as_str() {
            "ncl_fed_0.as" => ("PL009", "printed"),
            "ncl_upside_down.as" => ("PL005", "PR008"),
            "nx_simple_block.cls" => ("PJ006", "printed"),
            "catia5_multi_axis_0001.aptsource" => ("PR008", "PR008"),
            _ => ("printed", "printed"),
        };
        assert!(first(Options::default()).starts_with(plain), "{name}: {}", first(Options::default()));
        let all = Options {
            units: Some(Units::Mm).filter(|_| name.starts_with("ncl")),
            tool: Some(Assumed::One(1.0)),
            speed: Some(AssumedSpeed { rpm: 1000.0, ccw: false }),
            start: Some([0.0, 0.0, 50.0]),
            ..Options::default()
        };
        assert!(first(all.clone()).starts_with(assumed), "{name}: {}", first(all));
    }
    assert_eq!(names, 12);
}

/// Related values stay together: feeds and speeds, points and their motions, registers and tools.
#[test]
fn nothing_is_lost_between_statements() {
    let drill = "CYCLE/DRILL,DEPTH,10,MMPM,100,CLEAR,2";
    // SPINDL/ON restores the last spindle direction
    let lines = body("SPINDL/OFF\nGOTO/1,0,10\nSPINDL/ON\nGOTO/2,0,10");
    assert_eq!(lines, ["M5", "G1 X1. F100.", "S1000 M3", "X2."]);
    // inside a cycle, a feed per revolution follows the spindle speed
    let lines = body("CYCLE/DRILL,DEPTH,1,MMPR,.1,CLEAR,2\nGOTO/1,1,0\nSPINDL/500,CLW\nGOTO/2,2,0\nCYCLE/OFF");
    assert!(lines.contains(&"G99 G81 X2. Y2. Z-1. R2. F50.".to_owned()), "{lines:?}");
    // GODLTA is relative to the point, not to the tool's height after the hole
    let lines = body(&format!("{drill}\nGOTO/1,1,0\nGODLTA/10,0,0\nCYCLE/OFF\nGODLTA/0,0,50"));
    assert_eq!(lines[2..], ["G99 G81 X1. Y1. Z-10. R2. F100.", "X11.", "G80", "G0 Z50."]);
    // both shifts apply
    assert_eq!(body("TRANS/10,0,0\nORIGIN/0,0,5\nGOTO/1,2,3"), ["G1 X11. Y2. Z-2. F100."]);
    // CYCLE/ON replaces only the words that it contains
    let lines = body(&format!("{drill}\nCYCLE/ON,DEPTH,5\nGOTO/1,1,0\nCYCLE/OFF"));
    assert_eq!(lines[2], "G99 G81 X1. Y1. Z-5. R2. F100.");
    assert_eq!(body("N29 GOTO/6,0,10\n100 GOTO/5,0,10"), ["G1 X6. F100.", "X5."]);
    for (text, code) in [
        ("FEDRAT/60\n4,5,6", "PL001 numbers"),
        ("L1) GOTO/1,1,1", "PL001 the unknown word `L1` is in front of GOTO"),
        ("COOLNT/FLOOD,OFF", "PL002 COOLNT"),
        ("LOADTL/2,FOO,7", "PL002 LOADTL"),
        ("LOADTL/1,OFSETNO,7\nGOTO/1,1,1", "PR039 the length offset register changes while tool 1 is in"),
        ("CUTCOM/LEFT,ZXPLAN", "PL002 CUTCOM"),
        ("SCALE/2", "PL004 SCALE"),
        ("MODE/INCREM", "PL004 MODE"),
        ("END\nGOTO/1,1,1", "PL001 a statement after"),
        ("GOTO/10,0,10\nINDIRV/1,0,0\nTLON,GOFWD/(CIRCLE/0,0,10,10),ON,(LINE/0,0,10,0,10,10)", "PL004 INDIRV"),
        ("GOTO/10,0,10\nMOVARC/0,0,10,0,0,1,12\nGOTO/0,10,10", "PR005 the CIRCLE has the radius 12"),
        ("CUTCOM/LEFT\nGOTO/1,0,10\nLOADTL/2\nSPINDL/1,CLW\nRAPID\nGOTO/1,1,1", "PR030 the tool changes"),
        ("CYCLE/TAP,RIGID,DEPTH,1,MMPR,1\nGOTO/1,1,0", "PC021"),
    ] {
        assert!(error(text).starts_with(code), "{text}: {}", error(text));
    }
    assert!(read("PARTNO A\rUNITS/MM\rFINI\r", Options::default())[0].starts_with("PL001 the lines end"));
}

/// Surface speeds are converted from the units of the file. The code of the speed mode is printed before the speed.
#[test]
fn surface_speeds_have_units_and_their_code() {
    let text = "UNITS/MM\nLOADTL/1\nSPINDL/SFM,100,CLW\nRAPID\nGOTO/0,0,10\nFINI\n";
    let form = mill("Units mm", "").replace("%0\n", "%0\nG[unitmode]\n");
    let rendered = support::render_kind(
        &support::check(&form),
        text.as_bytes(),
        support::Kind::Cl,
        postform::internals::render::Options::default(),
    );
    assert!(rendered.unwrap().text.contains("G96 S30\nT1 M6\nS30"), "30.48 metres a minute");
}

/// Coolant stays on for the next tool. TOOLNO of CATIA only describes the tool that LOADTL loads.
#[test]
fn what_is_said_once_holds() {
    let lines = body("COOLNT/FLOOD\nGOTO/1,0,10\nLOADTL/2\nSPINDL/500,CLW\nFEDRAT/9\nRAPID\nGOTO/1,1,1");
    assert_eq!(lines.iter().filter(|line| *line == "M8" || *line == "M9").collect::<Vec<_>>(), ["M8"]);
    let options = Options { dialect: Some(Dialect::Catia), ..Options::default() };
    let text = format!("UNITS/MM\nTOOLNO/1,MILL,MMPM,10,ON,,NOTE\n{}FINI\n", &HEAD[9..]);
    assert_eq!(read(&text, options), ["G0 X0 Y0 Z10."]);
}

/// Units and CAM system are determined at the beginning of the file. Later statements do not change the meaning of earlier ones.
#[test]
fn units_and_dialect_are_known_before_they_are_needed() {
    let early = "LOADTL/1\nSPINDL/1,CLW\nFEDRAT/5,IPM\nUNITS/MM\nRAPID\nGOTO/0,0,1\nFINI\n";
    assert!(read(early, Options::default())[0].starts_with("PL005 the units of the file are not known yet at 3:1"));
    // the units in the file override the assumed units
    let own =
        early.replace("LOADTL", "UNITS/INCHES\nLOADTL").replace("UNITS/MM\n", "").replace("FINI", "GOTO/1,0,1\nFINI");
    let lines = read(&own, Options { units: Some(Units::Mm), ..Options::default() });
    assert_eq!(lines, ["G0 X0 Y0 Z1.", "G1 X1. F5."]);
    // the mark of another system in a later text is ignored; with this system, circles would turn in the opposite
    // direction
    let arc = "GOTO/1,0,10\nPPRINT/APTCL-SPEC\nCIRCLE/1,1,10,0,0,1,1\nGOTO/2,1,10";
    assert_eq!(body(arc).last().unwrap(), "G17 G3 X2. Y1. I0 J1.");
}

/// A statement between the points of a cycle never removes a hole.
#[test]
fn text_between_holes_loses_none() {
    let words =
        ["PPRINT/HI", "TPRINT/HI", "DISPLY/HI", "INSERT/M88", "AUXFUN/8", "OPSTOP", "DELAY/1", "COOLNT/ON", "REMARK A"];
    for word in words {
        let lines = body(&format!(
            "CYCLE/DRILL,DEPTH,12,MMPM,100,CLEAR,3\nGOTO/10,10,0\n{word}\nGOTO/30,10,0\n{word}\nGOTO/50,20,0\nCYCLE/OFF"
        ));
        for hole in ["X30.", "X50. Y20."] {
            assert!(lines.iter().any(|line| line.contains(hole)), "{word}: {hole} in {lines:?}");
        }
    }
    let lines = body("CYCLE/DRILL,DEPTH,12,MMPM,100,CLEAR,3\nGOTO/10,10,0\nPPRINT/HI\nGOTO/30,10,0\nCYCLE/OFF");
    let from = lines.iter().position(|line| line == "G80").unwrap();
    assert_eq!(lines[from..], ["G80", "(HI)", "G99 G81 X30. Y10. Z-12. R3. F100.", "G80"]);
}

/// SolidWorks CAM writes stops and tool descriptions with INSERT, even before the line that names the system.
#[test]
fn solidworks_inserts_are_stops_and_tools() {
    let text = "PARTNO/1\nUNIT/MM\nINSERT/4.0mm JOBBER DRILL\nCUTTER/4.,0,2.,3.,31.,0,83.\nLOAD/TOOL,14\n\
        CSI_SET_FLUTE_LENGTH/54.\nSPINDL/3500,RPM,CLW\nINSERT/Stock Size X350. Y150. Z10.5\nRAPID/\nGOTO/10,10,25.\n\
        FEDRAT/100,MMPM\nGOTO/10,10,-1.\nRAPID/\nGOTO/10,10,25.\nINSERT/STOP  change fixture\nINSERT/mind the clamp\n\
        RAPID/\nGOTO/50,10,25.\nFINI\n";
    let lines = read(text, Options::default());
    assert_eq!(lines[..2], ["(4.0MM JOBBER DRILL)", "(STOCK SIZE X350. Y150. Z10.5)"]);
    let stop = lines.iter().position(|line| line == "M0").unwrap();
    assert_eq!(lines[stop - 1..=stop + 1], ["(CHANGE FIXTURE)", "M0", "(MIND THE CLAMP)"]);
    assert_eq!(lines.last().unwrap(), "PL008 INSERT/mind the clamp is printed as a comment");
    assert!(lines.contains(&"S3500 M3".to_owned()), "the spindle turns again: {lines:?}");
    // in files of other systems, the text of INSERT is printed unchanged
    assert_eq!(body("INSERT/M88"), ["M88"]);
}

/// A tool change ends a cycle. Points after the tool change are refused until a feed or another cycle follows.
#[test]
fn points_after_a_tool_change_that_ended_a_cycle_are_refused() {
    let drill = "CYCLE/DRILL,DEPTH,5,MMPM,100,CLEAR,2";
    let change =
        |then: &str| format!("{drill}\nGOTO/1,1,0\nLOADTL/2\nSPINDL/700,CLW\nRAPID\nGOTO/1,1,50\n{then}\nGOTO/2,2,0");
    let refused = error(&change(""));
    assert!(refused.starts_with("PC043 the tool change in line 9 ended a cycle"), "{refused}");
    for then in ["FEDRAT/50,MMPM", drill, "RAPID"] {
        assert!(body(&change(then)).len() > 1, "{then}");
    }
}

/// NX may name tools without loading them. Each of these names needs a tool number. Two MSYS statements are two setups.
#[test]
fn tools_that_are_only_named_need_numbers() {
    let path = |tool: &str, x: u8| {
        format!(
            "TOOL PATH/OP{x},TOOL,{tool}\nTLDATA/MILL,10.0\nSPINDL/RPM,900,CLW\nRAPID\nGOTO/{x},0,10\n\
             FEDRAT/MMPM,100\nGOTO/{x},0,1\nEND-OF-PATH\n"
        )
    };
    let by = |text: &str, assumed: &str| {
        read(text, Options { tool: Some(Assumed::parse(assumed).unwrap()), ..Options::default() })
    };
    let two = format!("UNITS/MM\n{}{}", path("MILL", 1), path("Face Mill", 2));
    assert!(read(&two, Options::default())[0].starts_with("PJ006"));
    let refused = by(&two, "1");
    assert!(refused[0].starts_with("PJ006 the file names the tool FACEMILL but does not load it"), "{refused:?}");
    let lines = by(&two, "MILL=1,face mill=7");
    assert!(lines.iter().any(|line| line.starts_with("T7 M6")), "{lines:?}");
    let same = by(&format!("UNITS/MM\n{}{}", path("MILL", 1), path("MILL", 2)), "1");
    assert!(same.len() > 2 && !same.iter().any(|line| line.contains("M6")), "{same:?}");
    let loads = two.replace("TLDATA", "LOAD/TOOL,3\nTLDATA");
    assert!(!read(&loads, Options::default())[0].starts_with("PJ006"));
    let msys = "MSYS/0,0,0,1,0,0,0,1,0\n";
    let other = msys.replace("/0,0,0", "/0,-40,-20");
    let setups = format!("UNITS/MM\n{msys}{}{other}{}", path("MILL", 1), path("MILL", 2));
    assert!(by(&setups, "1")[0].starts_with("PL004 this MSYS differs from the MSYS of line 2"));
    assert!(by(&setups.replace(&other, msys), "1")[0].starts_with("G0"));
}

/// A part that is milled from above, then drilled and milled from the front. In the front's frame, Z is along the part's Y axis.
const TWO_SIDES: &str = "UNITS/MM\nFEDRAT/100,MMPM\n\
    LOADTL/1\nSPINDL/1000,RPM,CLW\nRAPID\nGOTO/0,0,10\nGOTO/5,0,-1\nSTOP\nRAPID\nGOTO/5,0,50\n\
    LOADTL/2\nSPINDL/2000,RPM,CLW\nCOOLNT/MIST\nRAPID\nGOTO/10,-30,5,0,-1,0\nGOTO/10,-8,5\n\
    INDIRV/0,0,1\nTLON,GOFWD/(CIRCLE/15,-8,5,5),ON,(LINE/15,-8,5,20,-8,5)\n\
    CYCLE/DRILL,DEPTH,5,MMPM,100,CLEAR,2\nGOTO/30,0,5\nGOTO/40,0,5\nCYCLE/OFF\nRAPID\nGOTO/40,-50,5\n\
    RAPID\nGOTO/0,0,50,0,0,1\nGOTO/0,0,1\nFINI\n";

/// The blocks of a setup, without its coolant.
fn front_of(text: &str, setup: usize) -> Vec<String> {
    let mut blocks = read(text, Options { setup: Some(setup), ..Options::default() });
    blocks.retain(|block| block != "M7");
    blocks
}

#[test]
fn a_setup_is_read_in_a_frame_of_its_own() {
    let setup = |n| front_of(TWO_SIDES, n);
    assert_eq!(setup(1), ["G0 X0 Y0 Z10.", "G1 X5. Z-1. F100.", "M0", "S1000 M3", "G0 Z50."]);
    let front = [
        "G0 X10. Y5. Z30.",
        "G1 Z8. F100.",
        "G17 G2 X20. I5. J0",
        "G0 X30.",
        "Z2.",
        "G99 G81 X30. Y5. Z-5. R2. F100.",
        "X40.",
        "G80",
        "G0 Z50.",
    ];
    assert_eq!(setup(2), front);
    // the tool of the setup before stays loaded
    assert_eq!(setup(3), ["G0 X0 Y0 Z50.", "G1 Z1. F100."]);
    let none = setup(4);
    assert_eq!(none.len(), 1);
    assert!(none[0].starts_with("PL004 the file has no setup 4 at "), "{none:?}");
    let whole = read(TWO_SIDES, Options::default());
    assert!(whole[0].starts_with("PR008 the tool is tilted"), "{whole:?}");
}

#[test]
fn setups_are_listed_whatever_is_in_them() {
    let found = postform::internals::cl::setups(TWO_SIDES.as_bytes(), &Options::default()).unwrap();
    let said: Vec<String> = found.iter().map(ToString::to_string).collect();
    assert_eq!(
        said,
        [
            "tool axis 0 0 1, x axis 1 0 0, 3 motions in lines 6 to 10",
            "tool axis 0 -1 0, x axis 1 0 0, 5 motions in lines 15 to 24",
            "tool axis 0 0 1, x axis 1 0 0, 2 motions in lines 26 to 27",
        ]
    );
    let arc = TWO_SIDES.replace("INDIRV/0,0,1", "CIRCLE/0,0,0,.6,0,.8,5\nTRACUT/1\nCYCLE/NONSENSE");
    assert_eq!(postform::internals::cl::setups(arc.as_bytes(), &Options::default()).unwrap().len(), 3);
}

/// If the file contains a CSYS for a setup, the X axis of the setup is that of the CSYS.
#[test]
fn a_setup_lies_as_its_csys_does() {
    let csys = "CSYS/0,1,0,0,0,0,-1,0,-1,0,0,0\n"; // row by row: X of the CSYS is -Z of the part, Z is -Y
    let text = TWO_SIDES.replace("RAPID\nGOTO/10,-30,5,0,-1,0", &format!("{csys}RAPID\nGOTO/10,-30,5,0,-1,0"));
    let front = front_of(&text, 2);
    assert_eq!(front[0], "G0 X-5. Y10. Z30.");
    assert!(front.contains(&"G99 G81 X-5. Y30. Z-5. R2. F100.".to_owned()), "{front:?}");
}

/// A tool axis without motions is no setup: the motions after it belong to the setup before it.
#[test]
fn a_setup_goes_on_after_a_tool_axis_without_motions() {
    let text = TWO_SIDES.replace("STOP\n", "TLAXIS/1,0,0\nTLAXIS/0,0,1\nGOTO/6,0,-1\n");
    assert_eq!(front_of(&text, 1), ["G0 X0 Y0 Z10.", "G1 X5. Z-1. F100.", "X6.", "G0 X5. Z50."]);
    assert_eq!(front_of(&text, 2), front_of(TWO_SIDES, 2));
}

#[test]
fn a_setup_does_not_begin_inside_a_cut() {
    let text = TWO_SIDES.replace("RAPID\nGOTO/10,-30,5,0,-1,0", "GOTO/10,-30,5,0,-1,0");
    let refused = read(&text, Options { setup: Some(2), ..Options::default() });
    assert!(refused[0].starts_with("PL004 the tool axis turns while the tool cuts at "), "{refused:?}");
    let text = TWO_SIDES.replace("STOP\n", "CUTCOM/LEFT\nGOTO/9,9,-1\n");
    let refused = read(&text, Options { setup: Some(1), ..Options::default() });
    assert!(refused[0].starts_with("PL004 the tool axis turns under cutter compensation"), "{refused:?}");
}

/// If the file name extension is not known, postform finds the format of a job by the first bytes. The test has an
/// example of each format.
#[test]
fn jobs_are_known_by_how_they_begin() {
    use postform::{Format, Job};
    let root = support::root();
    let mut kinds = vec![
        ("tests/data/freecad/holes-1.1.FCStd".to_owned(), Format::Freecad),
        ("tests/data/fusion.jsonl".to_owned(), Format::JsonLines),
        ("samples/bracket/job.json".to_owned(), Format::Json),
        ("samples/bracket/expected.haas.nc".to_owned(), Format::Nc),
    ];
    for entry in fs::read_dir(root.join("tests/data/cl")).unwrap() {
        kinds.push((format!("tests/data/cl/{}", entry.unwrap().file_name().to_string_lossy()), Format::Cl));
    }
    for (name, format) in kinds {
        let bytes = fs::read(root.join(&name)).unwrap();
        assert_eq!(Format::of_content(&bytes), Some(format), "{name}");
        assert_eq!(Job::open("export", &bytes).unwrap().format(), format, "{name}");
    }
    assert!(Job::open("export", b"hello, world").is_err());
}

/// The return plane is one height for the whole cycle, regardless of statements between its points. The tool returns to
/// the return plane or to the hole's clearance, whichever is higher.
#[test]
fn a_return_plane_holds_for_the_whole_cycle() {
    let drill = "CYCLE/DRILL,DEPTH,10,MMPM,90,CLEAR,3";
    let points = "GOTO/1,1,0\nGOTO/2,1,-20\nGOTO/3,1,-20\nCYCLE/OFF";
    let kept = ["X1. Y1.", "Z3.", "G99 G81 X1. Y1. Z-10. R3. F90.", "G98 X2. Z-30. R-17.", "X3.", "G80"];
    let low = ["X1. Y1.", "Z3.", "G99 G81 X1. Y1. Z-10. R3. F90.", "X2. Z-30. R-17.", "X3.", "G80"];
    for returns in ["RETURN", "RETURN,3", "RETURN,2", "RETURN,0"] {
        assert_eq!(body(&format!("{drill},{returns}\n{points}")), kept, "{returns}");
    }
    assert_eq!(body(&format!("CYCLE/RETURN,3\n{drill}\n{points}")), kept);
    // there is no return plane if the file gives none, or gives OFF before the cycle; OFF inside a cycle applies to the
    // next cycle
    assert_eq!(body(&format!("{drill}\n{points}")), low);
    assert_eq!(body(&format!("CYCLE/RETURN,OFF\n{drill},RETURN\n{points}")), low);
    assert_eq!(body(&format!("{drill},RETURN\nCYCLE/RETURN,OFF\n{points}")), kept);
    let catia = Options { dialect: Some(Dialect::Catia), ..Options::default() };
    assert_eq!(read(&format!("{HEAD}{drill},RETURN,0\n{points}\nFINI\n"), catia)[1..], low);
    // statements between holes; the next hole is above the return plane
    for between in [
        "RAPID\nGOTO/2,2,40",
        "CYCLE/AUTO,OFF\nCYCLE/AUTO,ON",
        "SPINDL/900,CLW",
        "COOLNT/FLOOD",
        "DELAY/1",
        "PPRINT/HALF",
    ] {
        let holes = format!("GOTO/1,1,0\n{between}\nGOTO/2,1,25\nGOTO/3,1,0\nGOTO/4,1,-10\nCYCLE/OFF");
        let lines = body(&format!("{drill},RETURN,20\n{holes}"));
        assert!(lines.contains(&"G98 X3. Z-10. R3.".to_owned()), "{between}: {lines:?}");
    }
    assert!(error("CYCLE/DRILL,DEPTH,10,MMPM,90,RETURN\nGOTO/1,1,0").starts_with("PC040 RETURN without a height"));
    let manual = body("CYCLE/RETURN,20\nCYCLE/MANUAL,CLEAR,4\nGOTO/1,1,0\nCYCLE/OFF");
    assert!(manual.contains(&"M0".to_owned()), "{manual:?}");
}

/// A file is refused if a CSYS turns back to the first side, but the tool axis does not. The side of the part is then
/// unknown.
#[test]
fn a_setup_ends_where_a_csys_turns_back() {
    let up = "CSYS/1,0,0,0,0,1,0,0,0,0,1,0\n";
    let text = TWO_SIDES.replace("RAPID\nGOTO/0,0,50,0,0,1", &format!("{up}RAPID\nGOTO/0,0,50"));
    let refused = front_of(&text, 2);
    assert!(refused[0].starts_with("PL004 the tool axis is not the z axis of the CSYS of line 25:"), "{refused:?}");
    let said = text.replace(up, &format!("{up}TLAXIS/0,0,1\n"));
    assert_eq!(front_of(&said, 3), ["G0 X0 Y0 Z50.", "G1 Z1. F100."]);
}

/// The arcs of a file show the meaning of CIRCLE. postform checks this meaning even if the file has the mark of a CAM
/// system.
#[test]
fn the_arcs_of_a_marked_file_agree_with_its_mark() {
    let csi = |k: i32| format!("CSI_TOOL_PATH/A\n{HEAD}GOTO/1,0,10\nCIRCLE/1,1,10,0,0,{k},1\nGOTO/2,1,10\nFINI\n");
    assert_eq!(read(&csi(1), Options::default())[2], "G17 G3 X2. Y1. I0 J1.");
    let other = read(&csi(-1), Options::default());
    assert!(
        other[0].starts_with(
            "PL006 if this CIRCLE is tangent to the path before it, it turns in the opposite \
        direction to the circles of SolidWorks CAM"
        ),
        "{other:?}"
    );
    let said = Options { dialect: Some(Dialect::Gener), ..Options::default() };
    assert_eq!(read(&csi(-1), said)[2], "G17 G3 X2. Y1. I0 J1.");
}

/// A statement that selects a work offset or a frame must not be ignored like a remark.
#[test]
fn work_offsets_and_frames_of_cl_files_are_not_passed_over() {
    assert!(error("GOTO/1,0,10\nZERO/2").starts_with("PL004 ZERO selects a work offset"));
    let upright = "MCS/1,0,0,$\n0,1,0,$\n0,0,1,$\n0,0,0";
    assert_eq!(body(&format!("{upright}\nGOTO/1,0,10")), ["G1 X1. F100."]);
    let other = format!("{upright}\nGOTO/1,0,10\n{}", upright.replace("0,0,0", "5,0,0"));
    assert!(error(&other).starts_with("PL004 this MCS differs from the MCS of line 7"));
    assert!(error("MCS/1,0,0,0,0,-1,0,1,0,0,0,0").starts_with("PL004 a turned MCS"));
}

/// An ignored word may be the cause of an error that follows. The error then names the word.
#[test]
fn a_mistyped_word_is_named_in_the_error_that_it_causes() {
    let file = "UNITS/MM\nLOADTL/1\nSPINDL/900,CLW\nFROM/0,0,20\nFEDRAT/50\nGOTO/0,0,1\nFINI\n";
    for (from, to) in [("LOADTL", "LODTL"), ("FEDRAT", "FEDRT"), ("SPINDL", "SPINDLE"), ("UNITS", "UNIS")] {
        let text = file.replacen(from, to, 1);
        let mut options = Options::default();
        if from == "FEDRAT" {
            options.start = None;
        }
        let Err(ReadError::Job(diag)) =
            read_cl(text.as_bytes(), &options, &mut Report::default(), &mut Summary::default())
        else {
            // the renderer reports a missing feed
            assert_eq!(from, "FEDRAT", "{to} is read");
            continue;
        };
        let help = diag.help.unwrap_or_default();
        assert!(
            help.contains(&format!("`{to}` in line")) && help.contains(&format!("did you mean `{from}`?")),
            "{help}"
        );
    }
    let mut report = Report::default();
    let text = file.replacen("FEDRAT/50\n", "FEDRAT/50\nRAPD\n", 1);
    read_cl(text.as_bytes(), &Options::default(), &mut report, &mut Summary::default()).unwrap();
    let help = report.warnings[0].help.as_deref().unwrap_or_default();
    assert!(help.starts_with("did you mean `RAPID`?"), "{help}");
}

/// Texts that are not UTF-8 are read as Windows-1252, so that no letter is lost.
#[test]
fn letters_of_old_files_are_kept() {
    let said = |bytes: &[u8]| {
        let mut comments = Comments::default();
        read_cl(bytes, &Options::default(), &mut Report::default(), &mut comments).unwrap();
        comments.0
    };
    let file = b"UNITS/MM\nLOADTL/1\nSPINDL/900,CLW\nPPRINT GR\xd6SSE\nFROM/0,0,20\nFEDRAT/50\nGOTO/0,0,1\nFINI\n";
    assert_eq!(said(file), ["GR\u{d6}SSE"]);
    let utf8 = String::from_utf8(file.iter().flat_map(|&b| char::from(b).to_string().into_bytes()).collect()).unwrap();
    assert_eq!(said(utf8.as_bytes()), ["GR\u{d6}SSE"]);
}

/// After CYCLE/OFF, the next motion is a rapid, unless it has a feed. A rapid that goes down must be written. Without an active
/// cycle, CYCLE/OFF changes nothing.
#[test]
fn the_motion_after_a_cycle_is_a_rapid_only_without_a_feed() {
    let after = |then: &str| format!("CYCLE/DRILL,DEPTH,5,CLEAR,2,MMPM,100\nGOTO/5,5,0\nCYCLE/OFF\n{then}");
    let last = |then: &str| body(&after(then)).pop().unwrap();
    assert_eq!(last("GOTO/9,9,2"), "G0 X9. Y9.");
    assert_eq!(last("GOTO/9,9,-3,50"), "G1 X9. Y9. Z-3. F50.");
    assert_eq!(last("FEDRAT/50\nGOTO/9,9,-3"), "G1 X9. Y9. Z-3. F50.");
    assert_eq!(last("GODLTA/0,0,-3,50"), "G1 Z-3. F50.");
    assert_eq!(last("RAPID\nGOTO/9,9,-3"), "G0 X9. Y9. Z-3.");
    let down = "PL004 the first motion after CYCLE/OFF goes down, without RAPID and without a feed at 10:1";
    assert_eq!(error(&after("GOTO/9,9,-3")), down);
    for dialect in Dialect::names().filter(|name| *name != "autodesk") {
        let options = Options { dialect: Dialect::parse(dialect).ok(), end: true, ..Options::default() };
        let cycle = after("GOTO/9,9,-3")
            .replace(
                "DEPTH,5,CLEAR",
                match dialect {
                    "solidworks" | "nx" | "ncl" => "FEDTO,5,RAPTO",
                    "camplete" => "FEDTO,5,CLEAR,2,RAPTO",
                    _ => "DEPTH,5,CLEAR",
                },
            )
            .replace("FEDTO,5", if dialect == "nx" { "FEDTO,-5" } else { "FEDTO,5" });
        assert_eq!(read(&format!("{HEAD}{cycle}\nFINI\n"), options), [down], "{dialect}");
    }
    // without CLEAR, the tool is above the point of the hole
    assert!(error(&after("GOTO/9,9,-3").replace("CLEAR,2,", "")).starts_with("PL004 the first motion after"));
    let arc = "GOTO/1,0,0\nCYCLE/DRILL,DEPTH,5,CLEAR,10,MMPM,100\nGOTO/1,0,0\nCYCLE/OFF\nINDIRV/1,0,0\n\
        TLON,GOFWD/(CIRCLE/1,1,10,1),ON,(LINE/1,1,10,2,1,10)";
    assert!(error(arc).starts_with("PL004 a rapid along an arc"));
    let lines = body("GOTO/0,0,-1\nCYCLE/OFF\nGOTO/9,9,-3");
    assert_eq!(lines[..2], ["G1 Z-1. F100.", "X9. Y9. Z-3."]);
    assert!(lines[2].starts_with("PC051"));
}

/// Feeds inside a cycle are ignored with a warning, whichever statement gives them.
#[test]
fn a_feed_inside_a_cycle_is_not_lost_silently() {
    let drill = |point: &str| format!("CYCLE/DRILL,DEPTH,5,CLEAR,2,MMPM,100\n{point}\nCYCLE/OFF\nRAPID\nGOTO/1,1,9");
    let lines = body(&drill("GOTO/6,6,0,77"));
    assert!(lines.contains(&"G99 G81 X6. Y6. Z-5. R2. F100.".to_owned()), "{lines:?}");
    assert_eq!(lines.last().unwrap(), "PC052 a feed in a motion statement inside a cycle is ignored");
    assert_eq!(body(&drill("FEDRAT/77\nGOTO/6,6,0")).last().unwrap(), "PC052 FEDRAT inside a cycle is ignored");
}

/// The units of a file do not change after a value was converted, even if the value was converted with assumed units.
#[test]
fn units_stay_those_of_the_first_converted_value() {
    let mm = || Options { units: Some(Units::Mm), ..Options::default() };
    for first in ["FEDRAT/10,IPM", "SPINDL/100,SFM,CLW", "CYCLE/DRILL,DEPTH,1,IPM,9,CLEAR,1"] {
        let file = |units: &str| {
            format!("LOADTL/1\nSPINDL/100,RPM,CLW\n{first}\nUNITS/{units}\nRAPID\nGOTO/0,0,2\nCYCLE/OFF\nFINI\n")
        };
        assert_eq!(
            read(&file("INCHES"), mm()),
            ["PL004 these units differ from the units of the statements before them at 4:1"],
            "{first}"
        );
        assert!(!read(&file("MM"), mm())[0].starts_with("PL004"), "{first}");
    }
    assert!(error("UNITS/INCHES").starts_with("PL004 these units differ"));
}

/// A damaged statement is an error, and is not read with a part of its values.
#[test]
fn a_statement_with_a_missing_value_is_not_read() {
    for (text, found) in [
        ("GOTO/10,20,-1,\n0,0,1", "PL001 GOTO ends with a comma: a part of it may be missing at 7:1"),
        ("GOTO/10,20,-1,,", "PL001 GOTO takes only numbers"),
        // blanks between digits: a lost comma, or the number of a punched card in columns 73 to 80
        ("GOTO/1,2,3 4", "PL001 a number with blanks inside: `3 4` at 7:1"),
        ("GOTO/   1.0,   2.0,   -3.0              120", "PL001 a number with blanks inside: `-3.0 120`"),
        ("GOTO/1,2,3$\n4", "PL001 a number with blanks inside: `3 4`"),
        ("GOTO/1,0,10\n1 0,5,0", "PL001 a number with blanks inside: `1 0`"),
        ("LOADTL/1  2", "PL001 a number with blanks inside: `1 2`"),
        ("SPINDL/ 15 00", "PL001 a number with blanks inside: `15 00`"),
        ("RAPID           130", "PL001 a number directly after RAPID"),
        ("LOADTL/2,,", "PL002 LOADTL can't take `nothing`"),
        ("FEDRAT/50,", "PL001 FEDRAT ends with a comma"),
        ("CYCLE/DRILL,DEPTH,5,MMPM,9,CLEAR,2,\nRETURN,20", "PL001 CYCLE ends with a comma"),
        ("GODLTA/,5", "PL001 GODLTA takes one, three or four numbers"),
        ("GOTO/,1,2,3", "PL001 GOTO takes only numbers"),
        ("GOTO/1,,2", "PL001 GOTO takes only numbers"),
        ("GOHOME/0,7,0,50", "PL001 a GOHOME that can't be read"),
        ("GOHOME/0,7,0,0,1", "PL001 a GOHOME that can't be read"),
        ("FROM/0,0,40,20,1", "PL001 FROM with 5 numbers"),
        ("SPINDL/2000,MAXRPM,CCLW", "PL001 MAXRPM without its number"),
        ("SPINDL/2000,CLW,CCLW", "PL002 CCLW contradicts a word before it"),
        ("SPINDL/200,SFM,RPM", "PL002 RPM contradicts a word before it"),
        ("SPINDL/200,MAXRPM,500,MAXRPM,600", "PL002 MAXRPM contradicts a word before it"),
        ("CUTCOM/LEFT,RIGHT", "PL002 RIGHT contradicts a word before it"),
        ("LOADTL/2,ADJUST", "PL001 ADJUST without its number"),
        ("TOOL PATH/B,C,TOOL,DRILL", "PL001 a TOOL PATH that can't be read"),
        ("TOOL PATH/B,TOOL,DRILL(6)", "PL001 a TOOL PATH that can't be read"),
        ("TOOL PATH/HOLES,DRILL_6", "PL001 a TOOL PATH that can't be read"),
    ] {
        assert!(error(text).starts_with(found), "{text}: {}", error(text));
    }
    // these statements give no value of the program
    assert_eq!(body("SETUP/1 2\nMACHIN/MILL,1 2\nGOTO/1,0,10"), ["G1 X1. F100."]);
    assert_eq!(body("SELECT/1,\nINTOL/.01,\nGOTO/1,0,10"), ["G1 X1. F100."]);
    let by = |dialect, text: &str| {
        let options = Options { dialect: Some(dialect), end: true, ..Options::default() };
        read(&format!("{HEAD}{text}\nGOTO/1,1,0\nFINI\n"), options)[0].clone()
    };
    let nx = |options: &str| by(Dialect::Nx, &format!("CYCLE/DRILL,RAPTO,2,FEDTO,-5,{options}"));
    for options in ["RTRCTO,DWELL", "RTRCTO,MMPM,90", "MMPM,90,RTRCTO"] {
        assert!(nx(options).starts_with("PC033 RTRCTO without its number"), "{options}: {}", nx(options));
    }
    let pecks = |options: &str| by(Dialect::SolidWorksCam, &format!("CYCLE/DEEP2,FEDTO,9,{options},MMPM,90,RAPTO,2"));
    assert!(pecks("1STPECK,SUBPECK,2").starts_with("PC033 1STPECK without its number"));
    assert!(pecks("1STPECK,3,SUBPECK").starts_with("PC033 SUBPECK without its number"));
    for load in ["LOADTL/2, 0, 50.0,", "LOADTL/2, 0, 50.0", "LOADTL/2, 0, 50.0, 11, 12"] {
        assert!(by(Dialect::Autodesk, load).starts_with("PL001"), "{load}: {}", by(Dialect::Autodesk, load));
    }
}

/// FROM makes no motion, so the motion after it would begin at another position than in the CAM system.
#[test]
fn a_tool_that_has_moved_is_not_placed_by_from() {
    let jump = "PL004 the FROM of line 8 gives another position than the motion before it at 9:1";
    assert_eq!(error("GOTO/1,0,5\nFROM/50,0,5\nGODLTA/0,5,0"), jump);
    let arc = "GOTO/0,0,5\nFROM/1,0,5\nINDIRV/1,0,0\nTLON,GOFWD/(CIRCLE/1,1,5,1),ON,(LINE/1,1,5,2,1,5)";
    assert_eq!(error(arc), jump.replace("at 9:1", "at 10:1"));
    assert_eq!(body("GOTO/1,0,5\nFROM/1,0,5\nGOTO/2,0,5"), ["G1 X1. Z5. F100.", "X2."]);
    // before a tool change, FROM gives the position of the change
    let change = body("GOTO/1,0,5\nFROM/0,0,90\nLOADTL/2\nSPINDL/900,CLW\nFROM/0,0,99\nRAPID\nGOTO/1,1,50");
    assert!(change.contains(&"G0 G54 X1. Y1. Z50.".to_owned()) || change.len() > 2, "{change:?}");
    let fed = "UNITS/MM\nLOADTL/1\nSPINDL/900,CLW\nFROM/0,0,40,20\nGOTO/0,0,1\nFINI\n";
    assert_eq!(read(fed, Options::default()), ["G0 X0 Y0 Z40.", "G1 Z1. F20."]);
}

/// A speed turns the spindle on. After OFF, it turns in its last direction.
#[test]
fn a_speed_after_off_turns_the_spindle() {
    assert_eq!(body("SPINDL/OFF\nSPINDL/1500,RPM\nGOTO/1,0,10"), ["S1500 M3", "G1 X1. F100."]);
    let lines = body("SPINDL/500,CCLW\nGOTO/1,0,10\nSPINDL/OFF\nSPINDL/1500\nGOTO/2,0,10");
    assert_eq!(lines, ["S500 M4", "G1 X1. F100.", "S1500 M4", "X2."]);
}

/// Compensation that never begins is an error.
#[test]
fn compensation_that_never_begins_is_not_lost() {
    let end = "PL004 CUTCOM/LEFT has no effect: the end of the file comes before a motion in the plane";
    assert!(error("GOTO/0,0,-1\nCUTCOM/LEFT\nGOTO/0,0,-3").starts_with(end));
    let change = "PL004 CUTCOM/RIGHT has no effect: a tool change comes before a motion in the plane";
    assert!(error("CUTCOM/RIGHT\nGOTO/0,0,-3\nLOADTL/2").starts_with(change));
    let replaced = "PL008 CUTCOM/LEFT has no effect: no motion in the plane comes before the next CUTCOM";
    assert_eq!(body("CUTCOM/LEFT\nCUTCOM/OFF\nGOTO/1,0,10"), ["G1 X1. F100.", replaced]);
    let other = body("CUTCOM/LEFT\nCUTCOM/RIGHT\nGOTO/1,0,10\nCUTCOM/OFF\nGOTO/1,5,10");
    assert_eq!(other, ["G1 G42 X1. D1 F100.", "G40 Y5.", replaced]);
}

/// Two origins in one file are reported in the data of Creo as in a plain CSYS. Registers outside LOADTL are reported.
#[test]
fn data_that_one_program_cannot_hold_is_reported() {
    let csys = |x: u8| format!("$$-> CSYS / 1,0,0,{x}, $\n 0,1,0,0, $\n 0,0,1,0\n");
    let creo = |text: &str| read(&format!("$$* Pro/CLfile\n{HEAD}{text}\nFINI\n"), Options::default());
    let same = creo(&format!("{}GOTO/1,0,10\n{}GOTO/2,0,10", csys(0), csys(0)));
    assert!(!same.iter().any(|line| line.starts_with("PL008")), "{same:?}");
    let other = creo(&format!("{}GOTO/1,0,10\n{}GOTO/2,0,10", csys(0), csys(9)));
    assert!(other.last().unwrap().starts_with("PL008 this CSYS differs from the CSYS of line 8"), "{other:?}");
    let load = "SPINDL/9,CLW\nRAPID\nGOTO/1,0,10";
    for (text, warning) in [
        ("OFSETNO/5", "OFSETNO 5 is ignored: the registers are those of LOADTL"),
        ("SET/ADJUST,5", "SET/ADJUST,5 is ignored: its effect is unknown"),
        ("SET/MODE,LASER", "SET/MODE,LASER is ignored: its effect is unknown"),
        ("MODE/FOO", "MODE/FOO is ignored: its effect is unknown"),
        ("CLAMP/ON", "CLAMP/ON is ignored: clamps of axes are not printed"),
        ("CLAMP", "CLAMP is ignored: clamps of axes are not printed"),
        ("STOP/5", "STOP/5 is printed as STOP: STOP takes no other words"),
        ("OPSTOP/FOO", "OPSTOP/FOO is printed as OPSTOP: OPSTOP takes no other words"),
        ("SPINDL/900,CLW,RANGE,2", "RANGE of SPINDL is ignored: the program does not select a gear range"),
        ("SPINDL/900,HIGH", "HIGH of SPINDL is ignored: the program does not select a gear range"),
        (
            &format!("LOADTL/2,MANUAL\n{load}"),
            "MANUAL of LOADTL is ignored: the program does not stop for a tool change by hand",
        ),
        (
            &format!("LOADTL/2,ADJUST,OFF\n{load}"),
            "ADJUST,OFF of LOADTL is ignored: forms print the length register of the tool",
        ),
    ] {
        let lines = body(&format!("{text}\nGOTO/2,0,10"));
        assert_eq!(lines.last().unwrap(), &format!("PL008 {warning}"), "{text}");
    }
    // these words have no effect that a program could have
    for text in
        ["SET/MODE,ABSOL", "MODE/MILL", "MODE/CIRCUL,5,2", &format!("LOADTL/2,IN,3,LENGTH,70,ADJUST,2,AUTO\n{load}")]
    {
        let lines = body(&format!("{text}\nGOTO/2,0,10"));
        assert!(!lines.iter().any(|line| line.starts_with("PL")), "{text}: {lines:?}");
    }
    let load = body("LOADTL/2,7\nSPINDL/9,CLW\nRAPID\nGOTO/1,0,10");
    assert_eq!(load.last().unwrap(), "PL008 the number 7 of LOADTL is ignored, because its meaning is unknown");
}

/// A tool without CUTTER and TOOL PATH has no diameter and no name. CUTTER may come before LOADTL.
#[test]
fn a_tool_does_not_get_the_data_of_the_tool_before() {
    let tools = |text: &str| {
        let mut tools = ToolsSeen::default();
        let text = format!("UNITS/MM\nSPINDL/900,CLW\nFEDRAT/100\n{text}FINI\n");
        let options = Options { end: true, ..Options::default() };
        read_cl(text.as_bytes(), &options, &mut Report::default(), &mut tools).unwrap();
        tools.0
    };
    let path = "SPINDL/900,CLW\nRAPID\nGOTO/0,0,9\nGOTO/0,0,1\n";
    assert_eq!(tools(&format!("LOADTL/1\nCUTTER/10\n{path}LOADTL/2\n{path}")), ["1 Some(10.0) None", "2 None None"]);
    assert_eq!(
        tools(&format!("CUTTER/10\nLOADTL/1\n{path}CUTTER/8\nLOADTL/2\n{path}LOADTL/2\n{path}")),
        ["1 Some(10.0) None", "2 Some(8.0) None", "2 Some(8.0) None"]
    );
    let named = format!("TOOL PATH/A,TOOL,MILL\nTLDATA/MILL,12\nLOAD/TOOL,1\n{path}LOAD/TOOL,2\n{path}");
    assert_eq!(tools(&named), ["1 Some(12.0) Some(\"MILL\")", "2 None None"]);
}

/// The tools of the tool changes: number, diameter and name.
#[derive(Default)]
struct ToolsSeen(Vec<String>);

impl Sink for ToolsSeen {
    fn event(&mut self, event: Event<'_>, _: Place) -> Flow {
        if let Event::ToolChange(change) = event {
            let tool = change.tool.as_ref().unwrap();
            self.0.push(format!("{} {:?} {:?}", tool.number, tool.diameter, tool.name));
        }
        Flow::Continue(())
    }
}

#[derive(Default)]
struct Comments(Vec<String>);

impl Sink for Comments {
    fn event(&mut self, event: Event<'_>, _: Place) -> Flow {
        if let Event::Comment(text) = event {
            self.0.push(text.trim().to_owned());
        }
        Flow::Continue(())
    }
}
