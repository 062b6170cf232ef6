//! Prints jobs with a tap, a thread and a long travel by the shipped forms. Checks the programs and their proofs.

use std::fs;

use crate::support::folder::{Folder, err, out};
use crate::support::root;

/// A job for a mill in millimetres, with this path.
fn mill(path: &str) -> String {
    format!(
        "{{\"postform\":1,\"program\":1,\"units\":\"mm\",\"tools\":[{{\"number\":1}}],\"operations\":[{{\"tool\":1,\"work\":54,\
         \"spindle\":{{\"speed\":1000,\"direction\":\"cw\"}},\"feed\":100,\"path\":[{{\"rapid\":[0,0,50]}},{path}]}}]}}"
    )
}

/// The program of a shipped form, and the verdict.
fn printed(test: &str, form: &str, job: &str) -> (Vec<String>, String) {
    let folder = Folder::new(&format!("kit-{test}-{form}"));
    folder.write("job.json", job);
    let form = root().join("postforms").join(form);
    let output = folder.run(&["render", "job.json", "--form", form.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    (out(&output).lines().map(str::to_owned).collect(), err(&output))
}

fn has(lines: &[String], text: &str) -> bool {
    lines.iter().any(|line| line.ends_with(text))
}

fn tap(options: &str) -> String {
    mill(&format!(
        "{{\"cycle\":{{\"kind\":\"tap\",\"depth\":20,\"clear\":2,\"return\":5,\"feed\":1500{options},\"points\":[[1,2,0]]}}}}"
    ))
}

#[test]
fn a_tap_pecks_where_the_job_gives_a_step() {
    for form in ["fanuc.pf", "haas.pf", "haas-4axis.pf"] {
        let (lines, said) = printed("step", form, &tap(",\"step\":5"));
        assert!(has(&lines, "G84 X1. Y2. Z-20. R2. Q5. F1500."), "{form}: {lines:#?}");
        assert!(said.contains("equivalent") && said.contains("1 hole with other pecks"), "{form}: {said}");
        let (lines, said) = printed("one", form, &tap(""));
        assert!(has(&lines, "G84 X1. Y2. Z-20. R2. F1500."), "{form}: {lines:#?}");
        assert!(said.contains("identical"), "{form}: {said}");
    }
}

#[test]
fn a_rigid_tap_of_linuxcnc_is_one_move_with_the_spindle() {
    let (lines, said) = printed("rigid", "linuxcnc.pf", &tap(",\"rigid\":true"));
    assert!(has(&lines, "G33.1 Z-20. K1.5") && !has(&lines, "G80"), "{lines:#?}");
    assert!(said.contains("identical"), "{said}");
    let (lines, _) = printed("floating", "linuxcnc.pf", &tap(""));
    assert!(has(&lines, "G98 G84 X1. Y2. Z-20. R2. P0 F1500.") && has(&lines, "G80"), "{lines:#?}");
}

#[test]
fn a_haas_travels_more_than_a_metre() {
    let job = mill("{\"line\":[1625.6,-812.8,-1000.5]}");
    for form in ["haas.pf", "haas-4axis.pf"] {
        let (lines, said) = printed("travel", form, &job);
        assert!(has(&lines, "X1625.6 Y-812.8 Z-1000.5 F100."), "{form}: {lines:#?}");
        assert!(said.contains("identical"), "{form}: {said}");
    }
}

/// P and Q of G76 have no decimal point: they are in units of 0.001 mm or 0.0001 inch.
#[test]
fn a_lathe_cuts_threads_in_both_units() {
    let inch = fs::read_to_string(root().join("samples/lathe-part/job.json")).unwrap();
    let (lines, said) = printed("inch", "fanuc-lathe.pf", &inch);
    assert!(has(&lines, "G76 X.6734 Z-.9 R0 P383 Q120 F.0625"), "{lines:#?}");
    assert!(said.contains("identical") || said.contains("equivalent"), "{said}");
    let mm = "{\"postform\":1,\"program\":20,\"units\":\"mm\",\"machine\":\"lathe\",\"tools\":[{\"number\":303}],\"operations\":[\
         {\"tool\":303,\"spindle\":{\"speed\":600,\"direction\":\"cw\",\"mode\":\"rpm\",\"max\":2500},\"feed_mode\":\"per_rev\",\"path\":[\
         {\"rapid\":[5,12]},{\"thread\":{\"from\":[5,10],\"to\":[-20],\"pitch\":1.5,\"depth\":0.92,\"first_depth\":0.3,\"min_depth\":0.05}},\
         {\"rapid\":[5,25]}]}]}";
    let (lines, said) = printed("mm", "fanuc-lathe.pf", mm);
    assert!(has(&lines, "G76 X18.16 Z-20. R0 P920 Q300 F1.5"), "{lines:#?}");
    assert!(lines.iter().any(|line| line.contains("G21")), "{lines:#?}");
    assert!(said.contains("identical") || said.contains("equivalent"), "{said}");
}

/// A program that has no code for its units is proven only with `--units`. With the wrong units, the program is
/// reported as different.
#[test]
fn the_units_of_a_program_are_said_by_it_or_by_an_option() {
    let folder = Folder::new("kit-units");
    let job = mill("{\"line\":[10,0,-1]}");
    folder.write("job.json", &job);
    let (lines, _) = printed("units", "haas.pf", &job);
    folder.write("job.nc", lines.join("\n").replace("G21 ", ""));
    let verify = |more: &[&str]| {
        let output = folder.run(&[&["verify", "job.json", "--nc", "job.nc", "--control", "haas"], more].concat());
        out(&output) + &err(&output)
    };
    assert!(verify(&[]).contains("PV022"), "{}", verify(&[]));
    assert!(verify(&["--units", "mm"]).contains("identical"), "{}", verify(&["--units", "mm"]));
    assert!(verify(&["--units", "inch"]).contains("different"), "{}", verify(&["--units", "inch"]));
}
