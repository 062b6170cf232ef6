//! Torches and lasers: the start and end of cuts, heights that have no effect, and findings in programs.

use crate::support::folder::{Folder, err, out};
use crate::support::root;

/// A job of two squares, with heights.
const JOB: &str = r#"{"name":"P","units":"mm","tools":[{"number":1},{"number":2}],"operations":[{"tool":1,"feed":900,"path":[
{"rapid":[0,0,10]},{"begin":"leadin"},{"line":[5,0,1]},{"end":"leadin"},{"line":[5,5]},{"rapid":[5,5,10]},
{"rapid":[20,0,10]},{"line":[25,0,1]},{"comment":"NEXT"},{"line":[25,5]},{"rapid":[25,5,10]},
{"rapid":[40,0,10]},{"line":[45,0,1]},{"line":[45,5]},{"rapid":[45,5,10]}]}]}"#;

fn posts(name: &str) -> String {
    root().join("postforms").join(format!("{name}.pf")).to_string_lossy().into_owned()
}

/// The program of a job, or the message.
fn printed(folder: &Folder, job: &str, form: &str, more: &[&str]) -> Result<String, String> {
    folder.write("job.json", job);
    let run = folder.run(&[&["render", "job.json", "--form", form, "--set", "header=off"], more].concat());
    if run.status.success() { Ok(out(&run)) } else { Err(err(&run)) }
}

/// The verdict of a program, with its findings.
fn verified(folder: &Folder, program: &str, form: &str) -> String {
    folder.write("program.nc", program);
    let run = folder.run(&["verify", "job.json", "--form", form, "--nc", "program.nc"]);
    format!("{}{}", out(&run), err(&run))
}

/// The torch is turned on before the lead-in and off after the last feed move. No block contains a height of the job.
#[test]
fn a_cut_lies_between_two_rapids() {
    let folder = Folder::new("torch_cut");
    let form = posts("plasma");
    let program = printed(&folder, JOB, &form, &["--set", "qtplasmac=yes"]).unwrap();
    let lines: Vec<&str> = program.lines().skip(4).collect();
    let cuts = [
        "G0 G54 X0 Y0",
        "M3 S1",
        "G1 X5. F900.",
        "Y5.",
        "M5",
        "G0 X20. Y0",
        "M3 S1",
        "G1 X25.",
        "(NEXT)",
        "Y5.",
        "M5",
        "G0 X40. Y0",
        "M3 S1",
        "G1 X45.",
        "Y5.",
        "M5",
        "M5",
        "M2",
        "%",
    ];
    assert_eq!(lines, cuts);
    assert!(verified(&folder, &program, &form).contains("identical"));
    // heights of the form: down to the sheet, pierce height, cutting height
    let program = printed(&folder, JOB, &form, &["--set", "pierce=0.8", "--set", "cutheight=2"]).unwrap();
    let begins =
        "G38.2 Z-50. F500.\nG92 Z0\nG0 Z3.8\nM3 S1\nG4 P.8\nG1 Z2. F2000.\nX5. Y0 F900.\nY5.\nM5\nG0 Z20.\nG92.1\n";
    assert!(program.contains(begins), "{program}");
}

/// Every wrong action of a torch has its own finding.
#[test]
fn a_torch_is_on_in_cuts_alone() {
    let folder = Folder::new("torch_wrong");
    let form = posts("plasma");
    let right = printed(&folder, JOB, &form, &[]).unwrap();
    assert!(verified(&folder, &right, &form).contains("equivalent"), "{right}");
    let second = |what: &str, by: &str| {
        let at = right.match_indices(what).nth(1).map(|(at, _)| at).unwrap();
        format!("{}{by}{}", &right[..at], &right[at + what.len()..])
    };
    let cases = [
        (second("M3 S1\n", ""), "PV026", "the torch is off in this cut"),
        (second("M5\nG0 Z20.", "G0 Z20."), "PV027", "the torch is on in a rapid"),
        (second("G0 Z20.\n", "G0\n"), "PV028", "the torch moves across at cutting height"),
        (second("G92 Z0", "G92 X1. Z0"), "PV", "different"),
        (second("G38.2 Z-50.", "G38.2 X1. Z-50."), "not proven", "an unknown machine position"),
        (right.replacen("X25.", "X26.", 1), "PV001", "different"),
        (right.replacen("F900.", "F950.", 1), "PV006", "different"),
        (right.replacen("M2\n", "", 1).replace('%', ""), "PV", "different"),
    ];
    for (program, code, said) in cases {
        let verdict = verified(&folder, &program, &form);
        assert!(verdict.contains(code) && verdict.contains(said), "{program}\n{verdict}");
    }
    // another cutting height is accepted, because the form ignores Z
    assert!(verified(&folder, &right.replace("G1 Z1.5", "G1 Z1.2"), &form).contains("equivalent"));
}

/// A laser with power 0 is off. Grbl turns off a laser in rapids, other controls do not.
#[test]
fn a_laser_has_a_power() {
    let folder = Folder::new("laser");
    let form = posts("laser");
    let program = printed(&folder, JOB, &form, &[]).unwrap();
    assert!(program.contains("G0 G54 X0 Y0\nM4 S500\nG1 X5. F900.\n") && !program.contains('Z'), "{program}");
    let own = JOB.replace("\"feed\":900", "\"feed\":900,\"spindle\":{\"speed\":320,\"direction\":\"cw\"}");
    assert!(printed(&folder, &own, &form, &[]).unwrap().contains("M4 S320\n"));
    printed(&folder, JOB, &form, &[]).unwrap();
    let dark = verified(&folder, &program.replacen("M4 S500", "M4 S0", 1), &form);
    assert!(dark.contains("PV026") && dark.contains("the laser is off in this cut"), "{dark}");
    let stays_on = program.replace("M5\nG0", "G0");
    assert!(verified(&folder, &stays_on, &form).contains("identical"), "{stays_on}");
    folder.write("other.pf", std::fs::read_to_string(&form).unwrap().replace("Control grbl", "Control linuxcnc"));
    assert!(verified(&folder, &stays_on, "other.pf").contains("the laser is on in a rapid"));
}

/// A path that the machine can't cut is an error with its location.
#[test]
fn what_no_torch_cuts_is_refused() {
    let folder = Folder::new("torch_refused");
    let form = posts("plasma");
    let two = JOB.replace("{\"line\":[25,5]}", "{\"line\":[25,5,-2]}");
    let cases = [
        (two, "the job cuts at Z-2 and at Z1"),
        (
            JOB.replace("{\"line\":[25,5]}", "{\"cycle\":{\"kind\":\"drill\",\"depth\":2,\"points\":[[1,1,0]]}}"),
            "can't make holes with cycles",
        ),
        (
            JOB.replace(
                "{\"line\":[25,5]}",
                "{\"arc\":{\"to\":[25,0,1],\"center\":[26,0,1],\"plane\":\"xz\",\"direction\":\"cw\"}}",
            ),
            "an arc outside XY",
        ),
    ];
    for (job, said) in cases {
        let refused = printed(&folder, &job, &form, &[]).unwrap_err();
        assert!(
            refused.contains("PR058") && refused.contains(said) && refused.contains("operations[0].path"),
            "{refused}"
        );
    }
    // a form for a mill does not ignore the axis
    let text = std::fs::read_to_string(&form).unwrap();
    for (wrong, said) in [
        (text.replace("Ignore Z", "Ignore X"), "only the depth axis, Z, can be ignored"),
        (text.replace("Machine Torch", "Machine Mill"), "Ignore is for torches and lasers"),
        (text.replace("Machine Torch", "Machine Mill").replace("Ignore Z", "# none"), "BeginCut is never printed"),
    ] {
        folder.write("wrong.pf", &wrong);
        let lint = folder.run(&["lint", "wrong.pf"]);
        let lint = format!("{}{}", out(&lint), err(&lint));
        assert!(lint.contains(said), "{said}: {lint}");
    }
}

/// A job without heights, with one operation.
fn flat(path: &str) -> String {
    format!(
        r#"{{"postform":1,"program":1,"units":"mm","tools":[{{"number":1,"diameter":0.05}}],"operations":[{{"tool":1,"work":1,"feed":300.0,{path}}}]}}"#
    )
}

/// The ignored depth axis is not compared. X and Y are compared, including shifts of the frame.
#[test]
fn frames_of_a_flat_job_go_nowhere() {
    let folder = Folder::new("torch_frames");
    let job = flat(
        r#""path":[{"rapid":[0,0]},{"line":[10,5]},{"line":[20,10]},{"line":[30,-10]},{"rapid":[21,22]},{"line":[30,25]}]"#,
    );
    let cases = [
        (
            "laser",
            "identical",
            ["G92 X1. Y1. Z1.", "G92 X0 Z0", "G92 X1. Y1.", "G10 L2 P1 X1.", "G10 L2 P1 X50. Y50. Z0"],
        ),
        ("plasma", "equivalent", ["G92 X1. Y1.", "G92 X0", "G52 X1.", "G10 L2 P1 X1.", "G92 Y2. Z0"]),
    ];
    for (name, verdict, frames) in cases {
        let form = posts(name);
        let right = printed(&folder, &job, &form, &[]).unwrap();
        assert!(verified(&folder, &right, &form).contains(verdict), "{right}");
        assert!(right.contains("X20. Y10."), "{right}");
        for frame in frames {
            let said = verified(&folder, &right.replace("X20. Y10.", &format!("{frame}\nX20. Y10.")), &form);
            assert!(said.contains("PV021"), "{name} {frame}: {said}");
        }
    }
}

/// The power of a laser is the spindle speed in the job.
#[test]
fn the_power_of_a_laser_is_the_jobs() {
    let folder = Folder::new("torch_power");
    let form = posts("laser");
    let path = r#""path":[{"rapid":[0,0]},{"line":[10,0]},{"line":[10,10]},{"rapid":[20,20]},{"line":[30,20]}]"#;
    let job = flat(&format!(r#""spindle":{{"speed":600,"direction":"cw"}},{path}"#));
    let right = printed(&folder, &job, &form, &[]).unwrap();
    assert!(verified(&folder, &right, &form).contains("identical"), "{right}");
    for to in ["M4 S60\n", "M4 S6000\n", "M4\n"] {
        let said = verified(&folder, &right.replace("M4 S600\n", to), &form);
        assert!(said.contains("PV011") || said.contains("PV026"), "{to}: {said}");
    }
    // without a speed in the job, the form's own power is used
    let right = printed(&folder, &flat(path), &form, &["--set", "beampower=300"]).unwrap();
    assert!(right.contains("M4 S300") && verified(&folder, &right, &form).contains("identical"), "{right}");
}

/// The feed and the dwell in `BeginCut` apply only to this sequence: cuts must not have this feed, and the dwell occurs
/// once.
#[test]
fn what_a_torch_does_before_a_cut_is_no_excuse_for_it() {
    let folder = Folder::new("torch_begin");
    let form = posts("plasma");
    let path = r#""path":[{"rapid":[0,0]},{"line":[10,5]},{"line":[20,10]},{"rapid":[21,22]},{"line":[30,25]}]"#;
    let right = printed(&folder, &flat(path), &form, &[]).unwrap();
    assert!(verified(&folder, &right, &form).contains("equivalent"), "{right}");
    let cases = [
        ("X10. Y5. F300.", "X10. Y5. F500.", "PV006"),
        ("X10. Y5. F300.", "X10. Y5.", "PV006"),
        ("G4 P.5\n", "G4 P100\n", "PV010"),
        ("G4 P.5\n", "G4 P.5\nG4 P6\n", "PV010"),
        // a dwell with the torch off between them makes no difference
        ("G4 P.5\n", "G4 P.5\nM5\nG4 P1\nM3 S1\nG4 P6\n", "PV010"),
    ];
    for (from, to, code) in cases {
        assert!(right.contains(from), "{right}");
        let said = verified(&folder, &right.replacen(from, to, 1), &form);
        assert!(said.contains(code), "{from} {to}: {said}");
    }
}
