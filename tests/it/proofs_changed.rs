//! Right programs changed in one place: what verify calls them, and how often it met it.

use crate::proofs::{mm, of_post, one};
use crate::support::check;
use crate::verify::{document, post, verified};
use postform::internals::verify::Verdict;

/// A program that a post printed, changed, and its verdict: its codes with how often each was met, or what was allowed.
fn after(post_name: &str, job: &str, changes: &[(&str, &str)]) -> String {
    let (mut program, _) = of_post(post_name, job);
    let (form, job) = (check(&post(post_name)), document(job));
    for (from, to) in changes {
        assert!(program.contains(from), "no {from:?} in\n{program}");
        program = program.replace(from, to);
    }
    match verified(&form, &program, &job) {
        Verdict::Different(list) => {
            list.iter().map(|found| format!("{} {}", found.code.name(), found.times)).collect::<Vec<_>>().join(", ")
        }
        verdict => verdict.to_string(),
    }
}

/// What leads to no cut is compared, too: a tool or a work offset that only goes somewhere, and whole programs of that kind.
#[test]
fn ways_to_no_cut_are_compared() {
    let last = mm(
        r#"{"tool":1,"work":54,"spindle":{"speed":900,"direction":"cw"},"feed":90,"path":[{"rapid":[20,20,25]},{"line":[20,20,-1]},{"rapid":[20,20,25]}]},
        {"tool":2,"work":54,"spindle":{"speed":900,"direction":"cw"},"path":[{"rapid":[0,0,25]},{"rapid":[10,0,25]}]}"#,
    );
    assert_eq!(after("haas.pf", &last, &[]), "identical");
    assert_eq!(after("haas.pf", &last, &[("G43 H2 Z25.", "G43 H2 Z-25.")]), "PV009 1");
    assert_eq!(after("haas.pf", &last, &[("T2 M6", "T3 M6")]), "PV012 1, PV009 1");
    assert_eq!(after("haas.pf", &last, &[("G43 H2", "G43 H3")]), "PV014 1");
    assert_eq!(after("haas.pf", &last, &[("X10.", "X-10.")]), "equivalent: 1 tail that ends elsewhere");
    let offsets = one(
        r#"{"rapid":[0,0,25]},{"line":[0,0,-1]},{"rapid":[0,0,25]},{"work":55},{"rapid":[20,20,25]},{"rapid":[40,40,25]},{"work":56},{"rapid":[10,10,25]},{"line":[10,10,-1]},{"rapid":[10,10,25]}"#,
    );
    assert_eq!(after("haas.pf", &offsets, &[]), "identical");
    for (from, to) in [("X40. Y40.\n", "(none)\n"), ("X40. Y40.", "X40. Y-40."), ("G55", "G54")] {
        assert_eq!(after("haas.pf", &offsets, &[(from, to)]), "equivalent: 1 way to no cut otherwise", "{from}");
    }
    assert_eq!(after("haas.pf", &offsets, &[("G55", "G57")]), "PV012 1, PV009 1");
    let nothing = one(r#"{"rapid":[0,0,25]},{"rapid":[10,10,25]}"#);
    assert_eq!(after("haas.pf", &nothing, &[]), "identical");
    assert_eq!(after("haas.pf", &nothing, &[("G54", "G57")]), "PV012 1, PV009 1");
    assert_eq!(after("haas.pf", &nothing, &[("X10. Y10.\n", "(none)\n")]), "equivalent: 1 tail that ends elsewhere");
}

/// Stops and dwells stand where the job has them: at home, or elsewhere on the way, which is counted.
#[test]
fn pauses_keep_their_places() {
    let home = one(
        r#"{"rapid":[0,0,25]},{"line":[0,0,-1]},{"rapid":[0,0,25]},{"home":true},{"stop":"program"},{"rapid":[10,10,25]},{"line":[10,10,-1]},{"rapid":[10,10,25]}"#,
    );
    assert_eq!(after("linuxcnc.pf", &home, &[]), "identical");
    assert_eq!(after("linuxcnc.pf", &home, &[("G0 G53 Z0\nM0\n", "M0\nG0 G53 Z0\n")]), "PV019 1");
    let way = one(
        r#"{"rapid":[0,0,25]},{"line":[0,0,-1]},{"rapid":[0,0,25]},{"stop":"optional"},{"dwell":2},{"rapid":[10,10,25]},{"line":[10,10,-1]},{"rapid":[10,10,25]}"#,
    );
    assert_eq!(after("grbl.pf", &way, &[]), "identical");
    let behind = "equivalent: 1 pause elsewhere on the way";
    assert_eq!(after("grbl.pf", &way, &[("G4 P2.\n", "(none)\n"), ("X10. Y10.\n", "X10. Y10.\nG4 P2.\n")]), behind);
    assert_eq!(after("grbl.pf", &way, &[("M1\n", "(none)\n"), ("X10. Y10.\n", "X10. Y10.\nM1\n")]), behind);
}

/// Nobody stops with the tool in a hole, and who does outside is counted.
#[test]
fn stops_between_pecks_are_seen() {
    let hole = r#"{"cycle":{"kind":"deep","depth":5,"clear":1,"return":10,"feed":50,"pecks":[{"to":2},{"to":5}],"points":[[0,0,0]]}}"#;
    let job = one(&format!("{{\"rapid\":[0,0,20]}},{hole}"));
    let (down, up) = ("G1 Z-2. F50.\n", "G0 Z1.\nZ-1.\n");
    let pecks = |first: &str, second: &str| {
        let moves = format!("{down}{first}G0 Z1.\n{second}Z-1.\n");
        after("linuxcnc.pf", &job, &[(&format!("{down}{up}"), &moves)])
    };
    assert_eq!(pecks("", ""), "identical");
    for stop in ["M0\n", "M1\n"] {
        assert_eq!(pecks(stop, ""), "PV019 1", "{stop}");
        assert_eq!(pecks("", stop), "equivalent: 1 stop of the form", "{stop}");
    }
}

/// Each difference of one cause is counted, and those behind it are met still.
#[test]
fn cuts_behind_a_difference_are_compared() {
    let path: Vec<String> = (0..5)
        .map(|i| {
            let (x, to) = (10 * i, 10 * i + 5);
            format!(
                r#"{{"rapid":[{x},30,20]}},{{"line":[{x},30,-3]}},{{"arc":{{"to":[{to},35,-3],"center":[{to},30],"direction":"cw"}}}},{{"rapid":[{to},35,20]}}"#
            )
        })
        .collect();
    let holes = r#"{"cycle":{"kind":"drill","depth":5,"clear":1,"return":10,"feed":50,"points":[[0,0,0],[10,0,0],[20,0,0],[30,0,0]]}}"#;
    let job = one(&format!("{{\"rapid\":[0,0,20]}},{holes},{}", path.join(",")));
    assert_eq!(after("linuxcnc.pf", &job, &[]), "identical");
    assert_eq!(after("linuxcnc.pf", &job, &[("R1.", "R2.")]), "PV005 4");
    assert_eq!(after("linuxcnc.pf", &job, &[("G2 ", "G3 ")]), "PV001 5");
    assert_eq!(after("linuxcnc.pf", &job, &[("G1 Z-3.", "G0 Z-3.")]), "PV007 5");
    assert_eq!(after("linuxcnc.pf", &job, &[("G0 Z20.\nX", "G1 Z20.\nG0 X")]), "PV008 4");
}
