//! Unknown positions never count as 0. If a result depends on an unknown position, nothing is proven, there is no job,
//! and motions do not count as equal.

use std::io::Cursor;

use crate::support::{check, control, job_options};
use crate::verify::{document, inches, post, rendered, verified};
use postform::internals::compile::compile;
use postform::internals::nc::{JobOptions, RunSettings, read_program};
use postform::internals::render::{Cycles, Options, Renderer};
use postform::internals::verify::{Verdict, compare_motions};
use postform::toolpath::{ReadError, Units};

const PATH: &str = r#"{"rapid":[0,0,2]},{"line":[0,0,-1]},{"rapid":[0,0,2]},{"work":55},{"rapid":[3,3,2]},{"line":[3,3,1.5]},{"rapid":[3,3,2]}"#;

/// The end of an increment is unknown if the increment starts at the reference point, or at the unknown position where
/// the program starts.
#[test]
fn increments_from_an_unknown_position_end_the_proof() {
    let (form, text) = (check(&post("fanuc.pf")), inches("1", PATH));
    let job = document(&text);
    let program = rendered(&form, &job, Cycles::Form);
    assert!(verified(&form, &program, &job).is_proven(), "{program}");
    for (from, to) in [("G91 G28 Z0\n", "G91 G28 Z0\nG0 Z-5.\n"), ("T1 M6\n", "T1 M6\nG91 G0 Z-5.\nG90\n")] {
        let changed = program.replacen(from, to, 1);
        assert_ne!(changed, program);
        let Verdict::NotProven(unproven) = verified(&form, &changed, &job) else { panic!("{changed}") };
        assert!(unproven.why.starts_with("an increment from an unknown") && unproven.line > 0, "{unproven:?}");
    }
}

/// G92 at an unknown position moves the frame by an unknown distance, so moves in this frame are dangerous.
#[test]
fn g92_at_an_unknown_position_moves_the_frame() {
    let (form, text) = (check(&post("haas.pf")), inches("1", PATH));
    let job = document(&text);
    let program = rendered(&form, &job, Cycles::Form);
    for blocks in ["G92 X0 Y0 Z0\n", "G91 G28 Z0\nG90\nG92 Z0\n"] {
        let changed = program.replacen("T1 M6\n", &format!("{blocks}T1 M6\n"), 1);
        let Verdict::Different(found) = verified(&form, &changed, &job) else { panic!("{changed}") };
        assert!(found.iter().any(|found| found.code.name() == "PV021"), "{found:?}");
    }
    // if no move follows in this frame, G92 has no effect
    let ends = program.replacen("M30", "G91 G28 Z0\nG90\nG92 Z0\nM30", 1);
    assert!(verified(&form, &ends, &job).is_proven(), "{ends}");
}

fn same_motion(old: &str, new: &str) -> bool {
    let settings = RunSettings::new(control("fanuc"));
    compare_motions([old, new].map(|text| (Cursor::new(text), settings)), Units::Mm, 1e-6).unwrap().difference.is_none()
}

#[test]
fn motions_to_unknown_positions_are_compared() {
    let begins = "G21 G90 G54 G94\nT1 M6\nS1000 M3\nG0 X0 Y0\nG43 H1 Z0.\nG1 Z-5. F100.\nG0 Z50.\nM30\n";
    let machine = begins.replace("G43 H1 Z0.", "G43 H1 G53 Z0.");
    assert!(same_motion(begins, begins) && same_motion(&machine, &machine) && !same_motion(begins, &machine));
    let dives = |depth: &str| {
        format!(
            "G21 G90 G54 G94\nT1 M6\nS1000 M3\nG0 X0 Y0\nG43 H1 Z50.\nG1 Z-5. F100.\nG0 Z50.\nG91 G28 Z0.\n\
             G0 Z-{depth}.\nG90\nG0 X50.\nG0 Z50.\nG1 Z-5.\nG0 Z50.\nM30\n"
        )
    };
    assert!(same_motion(&dives("300"), &dives("300")) && !same_motion(&dives("300"), &dives("400")));
}

/// LinuxCNC can move to a machine position at feed (G53 with G1). Its position in the work offset is unknown.
#[test]
fn a_cut_to_a_position_of_the_machine_is_no_cut_of_the_job() {
    let up = r#"{"rapid":[0,0,2]},{"line":[0,0,-1]},{"line":[0,0,0]},{"rapid":[0,0,2]}"#;
    let (form, text) = (check(&post("linuxcnc.pf")), inches("1", up));
    let job = document(&text);
    let program = rendered(&form, &job, Cycles::Form);
    assert!(verified(&form, &program, &job).is_proven(), "{program}");
    let changed = program.replacen("\nZ0\n", "\nG53 Z0\n", 1);
    assert_ne!(changed, program);
    let Verdict::NotProven(unproven) = verified(&form, &changed, &job) else { panic!("{changed}") };
    assert_eq!(unproven.why, "a feed move goes to an unknown machine position");
    // the position is also unknown if the program is read as a job, or compared with another program
    let settings = RunSettings::new(control("linuxcnc"));
    let same = |old: &str, new: &str| {
        let compared =
            compare_motions([old, new].map(|text| (Cursor::new(text.to_owned()), settings)), Units::Mm, 1e-6);
        compared.unwrap().difference.is_none()
    };
    assert!(same(&changed, &changed) && !same(&program, &changed));
    let checked = check(&post("haas.pf"));
    let haas = compile(&checked.form);
    let mut renderer = Renderer::new(&haas, Options { program: Some(1), ..Options::default() });
    let options = job_options(settings);
    let read = read_program(Cursor::new(changed.as_str()), &options, &mut Vec::new(), &mut renderer);
    assert!(matches!(read, Err(ReadError::Job(diag)) if diag.message.contains("an unknown machine position")));
}

/// Reads a program as a job. Returns the printed program, or the error code.
fn printed(program: &str, start: Option<[f64; 3]>) -> Result<String, String> {
    let checked = check(&crate::support::plain_post("haas.pf"));
    let form = compile(&checked.form);
    let mut renderer = Renderer::new(&form, Options { program: Some(1), ..Options::default() });
    let options = JobOptions { start, ..job_options(RunSettings::new(control("fanuc"))) };
    match read_program(Cursor::new(program), &options, &mut Vec::new(), &mut renderer) {
        Ok(()) => Ok(String::from_utf8(std::mem::take(renderer.text())).unwrap()),
        Err(ReadError::Job(diag)) => Err(diag.code.name().into()),
        Err(other) => panic!("{other:?}"),
    }
}

#[test]
fn increments_from_an_unknown_position_are_no_job() {
    const HEAD: &str = "G20 G17 G90\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z1. M8\nG1 Z-.1 F5.\nG0 Z1.\n";
    for blocks in ["G91 G28 Z0\nG0 Z-5.\nG90\nG0 Z1.", "G55 G0 X1. Y1.\nG91 G81 X1. Z-1. R-2. F5.\nG80 G90"] {
        assert_eq!(printed(&format!("{HEAD}{blocks}\nM30\n"), None).unwrap_err(), "PN036", "{blocks}");
    }
    // a new tool without a height: the return level of G98 is unknown
    let program = "G20 G17 G90\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1\nG98 G81 X1. Z-.5 R.1 F5.\nG80\nM30\n";
    assert_eq!(printed(program, None).unwrap_err(), "PN036");
    // register 0 means no length offset
    assert!(printed(&format!("{HEAD}G91 G28 Z0 H0\nG90\nM30\n"), None).is_ok());
}

/// Incremental cuts start at the position that the caller assumes.
#[test]
fn increments_count_from_an_assumed_start() {
    let program = "G21 G17 G90\nG54\nT1 M6\nS500 M3\nG43 H1\nG91 G1 X10. F100.\nY10.\nM30\n";
    let printed = printed(program, Some([1.0, 2.0, 3.0])).unwrap();
    assert!(printed.contains("X11.") && printed.contains("Y12."), "{printed}");
}

/// The same numbers in another work offset, or with another tool length, are another position.
#[test]
fn the_same_numbers_in_another_frame_are_another_position() {
    let program = |between: &str| {
        format!(
            "G21 G17 G90 G54\nT1 M6\nS1000 M3\nG0 X0 Y0\nG43 H1 Z50.\nG1 Z-5. F100.\n{between}\nG0 Z50.\nG54 X0 Y0\n\
             G1 Z-5.\nG0 Z50.\nM30\n"
        )
    };
    let up = "G0 Z50.\nG55 X0 Y0\nZ50.\nG1 Z-5.";
    let cases = [
        ("", "", true),
        ("", "G55 G1 X0 Y0 Z-5.\nG54 X0 Y0 Z-5.", false),
        ("", "H9\nG1 Z-5.\nH1\nZ-5.", false),
        (up, up, true),
        // the height at which the work offset changes
        (up, "G55 G0 X0 Y0\nZ50.\nG1 Z-5.", false),
        (up, "G0 Z20.\nG55 X0 Y0\nZ50.\nG1 Z-5.", false),
    ];
    for (old, new, wanted) in cases {
        assert_eq!(same_motion(&program(old), &program(new)), wanted, "{old}\n\n{new}");
    }
    // a plunge at an unknown X and Y is no job
    assert_eq!(printed(&program("G0 Z50.\nG55\nG1 Z-5."), None).unwrap_err(), "PN036");
}
