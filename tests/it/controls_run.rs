//! Runs programs on the shipped controls: codes, words and settings whose effect differs from control to control.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::support::folder::{Folder, err, out};

/// Simulates a program. Returns the actions as JSON, or the message.
fn run(control: &str, program: &str) -> Result<String, String> {
    static RUNS: AtomicUsize = AtomicUsize::new(0);
    let folder = Folder::new(&format!("controls_run_{}", RUNS.fetch_add(1, Ordering::Relaxed)));
    folder.write("program.nc", program);
    let run = folder.run(&["simulate", "program.nc", "--control", control, "--format", "json"]);
    if run.status.success() { Ok(out(&run)) } else { Err(err(&run)) }
}

/// Runs the block of each case after a usual head. Each case has the expected message. If the message is empty, the
/// block must run without an error.
fn blocks(head: &str, end: &str, cases: &[(&str, &str, &str)]) {
    for (control, block, said) in cases {
        let ran = run(control, &format!("{head}{block}\n{end}"));
        match said.is_empty() {
            true => assert!(ran.is_ok(), "{control} {block}: {ran:?}"),
            false => assert!(ran.as_ref().is_err_and(|error| error.contains(said)), "{control} {block}: {ran:?}"),
        }
    }
}

const HEAD: &str = "G21 G90 G94 G17\nT1 M6\nS900 M3\nG0 X0 Y0 Z20.\n";

#[test]
fn mills_differ_by_their_files() {
    let cases = [
        // the meaning depends on a setting of the machine
        ("mach3", "G4 P2", "the control file of mach3 does not give the unit of P of a dwell"),
        ("mach3", "G1 F90.\nG2 X10. I5.", "the control file of mach3 does not give the origin of I and J"),
        ("mach3", "G91.1\nG1 F90.\nG2 X10. I5.", ""),
        ("mach3", "G1 F90.\nG2 X10. R5.", ""),
        ("mach3", "G84 X1. Z-5. R2. F90.", "G84 is not a code"),
        ("mach3", "G71", ""),
        ("mach3", "G59.1", "G59.1 is not a code"),
        ("pathpilot", "G84 X1. Z-5. R2. F900.", ""),
        ("pathpilot", "G74 X1. Z-5. R2. F900.", "G74 is not a code"),
        ("pathpilot", "G7", ""),
        ("pathpilot", "G8", ""),
        ("pathpilot", "G54.1 P2", "its P1 is G54 itself"),
        ("centroid", "E7", ""),
        ("centroid", "E19", "E19"),
        ("centroid", "G86 X1. Z-5. R2. F90.", "G86 is not a code"),
        ("centroid", "G84 X1. Z-5. R2. Q1. F90.", "the block has Q"),
        ("centroid", "M25", "M25 is not supported"),
        ("grblhal", "G98 G81 X1. Z-5. R2. F90.", ""),
        ("grblhal", "G98 G82 X1. Z-5. R2. P.5 F90.", ""),
        ("grblhal", "G98 G82 X1. Z-5. R2. F90.", "G82 without P"),
        ("grblhal", "G73 X1. Z-5. R2. Q1. F90.", "G73 is not supported"),
        ("grblhal", "G84 X1. Z-5. R2. F90.", "G84 is not supported"),
        ("grblhal", "G64 P.01", "G64 is not a code"),
        ("grblhal", "G59.3", ""),
    ];
    blocks(HEAD, "M30\n", &cases);
}

/// FluidNC is a Grbl with M6 and outputs. A line may have at most 127 characters, including its comment.
#[test]
fn fluidnc_counts_comments() {
    let comment = |length: usize| format!("(A{}", "B".repeat(length - 3)) + ")";
    let (fits, longer) = (comment(127), comment(128));
    let cases = [
        ("fluidnc", fits.as_str(), ""),
        ("fluidnc", longer.as_str(), "more than 127 characters"),
        ("grbl", longer.as_str(), ""),
        ("fluidnc", "T2 M6", ""),
        ("grbl", "T2 M6", "not a code or word of Grbl"),
        ("fluidnc", "M64 P0", ""),
        ("fluidnc", "M7", ""),
        ("fluidnc", "G81 X1 Z-5 R2 F90", "not a code or word of Grbl"),
        ("fluidnc", "G59.1", "fraction"),
    ];
    blocks("G21 G90 G94 G17\nG0 X0 Y0 Z20\n", "M30\n", &cases);
}

/// G83 of grblHAL dwells at the end of each stroke, retracts to the return level, and feeds down again from there.
#[test]
fn grblhal_feeds_again_from_the_return_level() {
    let drilled = run("grblhal", &format!("{HEAD}G99 G83 X1. Y0 Z-4. R2. Q3. F90.\nG80\nM30\n")).unwrap();
    let moves: Vec<&str> = drilled.lines().filter(|action| action.contains("\"line\":5,")).collect();
    let expected = [
        "rapid\":[1,0,20",
        "rapid\":[1,0,2,",
        "feed\":[1,0,-1",
        "dwell\":0.25",
        "rapid\":[1,0,2,",
        "feed\":[1,0,-4",
        "dwell\":0.25",
        "rapid\":[1,0,2,",
    ];
    assert_eq!(moves.len(), expected.len(), "{moves:?}");
    for (action, expected) in moves.iter().zip(expected) {
        assert!(action.contains(expected), "{action} is no {expected}");
    }
}

/// G28 without axes moves all axes home on a Haas and a Centroid. On a Fanuc it is refused.
#[test]
fn a_haas_goes_home_with_all_axes() {
    blocks(HEAD, "M30\n", &[("haas", "G28", ""), ("centroid", "G28", ""), ("fanuc", "G28", "G28 or G30 without axes")]);
    let lathe = "G18 G99\nT0101\nG97 S900 M3\nG0 X50. Z5.\nG28\nM30\n";
    let home = run("haas-lathe", lathe).unwrap();
    assert!(home.matches("\"rapid\"").count() >= 2, "{home}");
}

/// Text before the first `%` is skipped if it contains only comments.
#[test]
fn a_program_may_have_comments_before_its_first_percent() {
    let program = format!("(SHAFT)\n; of the shop\n%\nO7\n{HEAD}M30\n%\n");
    assert_eq!(run("fanuc", &program).map(|_| ()), Ok(()));
    let cut = program.replace("; of the shop", "G0 X9.");
    assert!(run("fanuc", &cut).unwrap_err().contains("the program ends at `%`"));
}

/// In a cut of a lathe, `C0.4` is a chamfer on many machines and an axis on other machines. `A30.` is an angle. Both
/// words are refused.
#[test]
fn a_chamfer_of_a_lathe_is_no_axis() {
    let head = "G18 G99\nT0101\nG97 S900 M3\nG0 X50. Z5.\nG1 Z0 F.2\n";
    let refused = "an angle, a chamfer or an axis";
    let cases = [
        ("fanuc-lathe", "X60. C0.4", refused),
        ("fanuc-lathe", "Z-5. A30.", refused),
        ("haas-lathe", "U2. C.5", refused),
        ("fanuc-lathe", "X60. Z-2.", ""),
        ("fanuc-lathe", "G0 C90.", ""),
        ("fanuc-lathe", "G1 C90.", ""),
    ];
    blocks(head, "M30\n", &cases);
}
