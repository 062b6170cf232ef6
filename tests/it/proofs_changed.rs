//! Correct programs, changed in one place: the verdict, and the counts of findings.

use crate::proofs::{mm, of_post, one};
use crate::support::check;
use crate::verify::{document, post, verified};
use postform::internals::verify::Verdict;
use postform::{Job, Proof};

/// The verdict on a program of a post after a change: the codes with their counts, or the allowances.
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

/// Paths without a cut are compared, too: moves of a tool or in a work offset that has no cut, and whole programs
/// without cuts.
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
    assert_eq!(
        after("haas.pf", &last, &[("X10.", "X-10.")]),
        "equivalent: 1 path to another position after the last cut"
    );
    let offsets = one(
        r#"{"rapid":[0,0,25]},{"line":[0,0,-1]},{"rapid":[0,0,25]},{"work":55},{"rapid":[20,20,25]},{"rapid":[40,40,25]},{"work":56},{"rapid":[10,10,25]},{"line":[10,10,-1]},{"rapid":[10,10,25]}"#,
    );
    assert_eq!(after("haas.pf", &offsets, &[]), "identical");
    for (from, to) in [("X40. Y40.\n", "(none)\n"), ("X40. Y40.", "X40. Y-40."), ("G55", "G54")] {
        assert_eq!(
            after("haas.pf", &offsets, &[(from, to)]),
            "equivalent: 1 path to other positions by a tool or in a work offset without cuts",
            "{from}"
        );
    }
    assert_eq!(after("haas.pf", &offsets, &[("G55", "G57")]), "PV012 1, PV009 1");
    let nothing = one(r#"{"rapid":[0,0,25]},{"rapid":[10,10,25]}"#);
    assert_eq!(after("haas.pf", &nothing, &[]), "identical");
    assert_eq!(after("haas.pf", &nothing, &[("G54", "G57")]), "PV012 1, PV009 1");
    assert_eq!(
        after("haas.pf", &nothing, &[("X10. Y10.\n", "(none)\n")]),
        "equivalent: 1 path to another position after the last cut"
    );
}

/// A stop at home must stay at home. Other stops and dwells may be elsewhere on the path to the next cut, and are then
/// counted.
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
    let behind = "equivalent: 1 pause at another position between the same cuts";
    assert_eq!(after("grbl.pf", &way, &[("G4 P2.\n", "(none)\n"), ("X10. Y10.\n", "X10. Y10.\nG4 P2.\n")]), behind);
    assert_eq!(after("grbl.pf", &way, &[("M1\n", "(none)\n"), ("X10. Y10.\n", "X10. Y10.\nM1\n")]), behind);
}

/// If the job moves the tool home, the tool must not move across the part before the move home.
#[test]
fn nothing_crosses_the_part_before_the_way_home() {
    let home = one(
        r#"{"rapid":[0,0,25]},{"line":[0,0,-1]},{"rapid":[0,0,25]},{"home":true},{"rapid":[10,10,25]},{"line":[10,10,-1]},{"rapid":[10,10,25]}"#,
    );
    assert_eq!(after("linuxcnc.pf", &home, &[]), "identical");
    let swapped = ("G0 G53 Z0\nG0 X10. Y10.\nZ25.\n", "X10. Y10.\nG0 G53 Z0\nG0 Z25.\n");
    assert_eq!(after("linuxcnc.pf", &home, &[swapped]), "PV001 1");
}

/// A stop with the tool in a hole is a difference. A stop outside the hole is counted.
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
        assert_eq!(pecks("", stop), "equivalent: 1 stop added by the form", "{stop}");
    }
}

/// Differences with one cause are counted, and the cuts after them are still compared.
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

/// No stop or other action may be inside a cut that is printed in parts. Between two cuts, only the stops and actions
/// of the job are allowed.
#[test]
fn nothing_stands_inside_a_cut() {
    let cuts =
        one(r#"{"rapid":[0,0,25]},{"line":[0,0,-1]},{"line":[40,0,-1]},{"line":[40,30,-1]},{"rapid":[40,30,25]}"#);
    let inside = |what: &str| after("haas.pf", &cuts, &[("X40.\n", &format!("X20.\n{what}X40.\n"))]);
    assert_eq!(inside(""), "equivalent: 1 straight cut made of parts");
    assert_eq!(inside("G0 Z25.\nZ-1.\nG1 "), "PV001 1");
    assert_eq!(inside("G0 X10.\nX20.\nG1 "), "PV001 1, PV001 1");
    assert_eq!(inside("G4 P1.\n"), "PV001 1, PV010 1");
    // M1 of a Haas stops the spindle and the coolant
    assert_eq!(inside("M1\n"), "PV001 1, PV019 1, PV011 2, PV024 2");
    let between = |what: &str| after("haas.pf", &cuts, &[("Y30.\n", &format!("{what}Y30.\n"))]);
    assert_eq!(between(""), "identical");
    assert_eq!(between("G0 X30.\nX40.\nG1 "), "PV001 1");
    assert_eq!(between("G4 P1.\n"), "PV010 1");
    assert_eq!(between("M1\nM3\nM8\n"), "PV019 1");
    assert_eq!(between("M1\n"), "PV019 1, PV011 1, PV024 1");
    let arc = one(
        r#"{"rapid":[20,0,25]},{"line":[20,0,-1]},{"arc":{"to":[-20,0],"center":[0,0],"direction":"ccw"}},{"rapid":[-20,0,25]}"#,
    );
    let inside = |what: &str| {
        let parts = format!("G3 X0 Y20. I-20. J0\n{what}G3 X-20. Y0 I0 J-20.");
        after("haas.pf", &arc, &[("G3 X-20. I-20. J0", &parts)])
    };
    assert_eq!(inside(""), "equivalent: 1 arc made of parts");
    for what in ["G0 Z25.\nZ-1.\n", "G4 P1.\n", "M1\n"] {
        assert_eq!(inside(what), "PV001 1", "{what}");
    }
    let pauses = one(
        r#"{"rapid":[0,0,25]},{"line":[0,0,-1]},{"dwell":2},{"line":[40,0,-1]},{"stop":"optional"},{"line":[40,30,-1]},{"rapid":[40,30,25]}"#,
    );
    assert_eq!(after("haas.pf", &pauses, &[]), "identical");
    assert_eq!(after("haas.pf", &pauses, &[("G4 P2.\n", "(none)\n")]), "PV010 1");
    assert_eq!(after("haas.pf", &pauses, &[("M1\n", "(none)\n")]), "PV019 1");
}

/// The tool may leave a reamed hole at feed, up to the highest position of this tool in the job since its last cut.
#[test]
fn holes_are_left_at_feed_up_to_the_return_plane() {
    let ream =
        r#"{"cycle":{"kind":"ream","depth":5,"clear":2,"return":10,"feed":50,"emulate":true,"points":[[4,4,0]]}}"#;
    let drill = r#"{"cycle":{"kind":"drill","depth":5,"clear":2,"return":40,"feed":50,"points":[[0,4,0]]}}"#;
    let two = ream.replace("[[4,4,0]]", "[[4,4,0],[8,4,0]]");
    let job = one(&format!(r#"{{"rapid":[0,0,25]}},{two},{{"rapid":[8,4,25]}}"#));
    assert_eq!(after("haas.pf", &job, &[]), "identical");
    let left = |up: &str| after("haas.pf", &job, &[("N100 Z2.\n", &format!("N100 {up}\n"))]);
    let farther = "equivalent: 1 path between cuts with the axes in another order or at a greater height, 1 hole with \
                   a higher retract at feed";
    assert_eq!(left("Z2.003"), farther);
    assert_eq!(left("Z10."), farther);
    assert_eq!(left("Z10.003"), "PV004 1");
    assert_eq!(left("Z90."), "PV004 1");
    assert_eq!(left("Z1."), "PV004 1, PV009 1");
    // this allows no difference on the way down
    let cut = |down: &str| after("haas.pf", &job, &[("N90 G1 Z-5. F50.\n", &format!("N90 G1 {down} F50.\n"))]);
    assert_eq!([cut("Z-4."), cut("Z-6."), cut("Z3.")], ["PV004 1"; 3].map(str::to_owned));
    // after another cut or tool, earlier heights of the job no longer count
    let path =
        format!(r#"{{"rapid":[0,0,50]}},{drill},{{"line":[0,4,30]}},{{"rapid":[0,0,50]}},{ream},{{"rapid":[8,4,50]}}"#);
    let cut = one(&path);
    assert!(after("haas.pf", &cut, &[("N160 Z2.\n", "N160 Z10.\n")]).starts_with("equivalent: "));
    assert_eq!(after("haas.pf", &cut, &[("N160 Z2.\n", "N160 Z40.\n")]), "PV004 1");
    let spindle = r#""work":54,"spindle":{"speed":1000,"direction":"cw"}"#;
    let tools = mm(&format!(
        r#"{{"tool":1,{spindle},"path":[{{"rapid":[0,0,50]}},{drill},{{"rapid":[0,0,50]}}]}},{{"tool":2,{spindle},"path":[{{"rapid":[0,0,50]}},{ream},{{"rapid":[8,4,50]}}]}}"#
    ));
    assert!(after("haas.pf", &tools, &[("N210 Z2.\n", "N210 Z10.\n")]).starts_with("equivalent: "));
    assert_eq!(after("haas.pf", &tools, &[("N210 Z2.\n", "N210 Z40.\n")]), "PV004 1");
}

/// A form may dwell and stop outside holes, but not inside them.
#[test]
fn nothing_waits_in_a_hole() {
    let taps = mm(
        r#"{"tool":1,"work":54,"spindle":{"speed":500,"direction":"cw"},"path":[{"rapid":[0,0,10]},{"cycle":{"kind":"face","dwell":5,"depth":10,"clear":5,"feed":500,"points":[[10,10,0]]}},{"cycle":{"kind":"tap","rigid":false,"depth":10,"clear":5,"feed":500,"points":[[10,30,0],[20,30,0]]}},{"rapid":[0,0,50]}]}"#,
    );
    assert_eq!(after("linuxcnc.pf", &taps, &[]), "identical");
    assert_eq!(after("linuxcnc.pf", &taps, &[(" P0 ", " ")]), "PV010 2");
    assert_eq!(
        after("linuxcnc.pf", &taps, &[("G80\nG0", "G80\nG4 P2.\nG0")]),
        "equivalent: 3 dwells added by the form"
    );
    let tap = one(
        r#"{"rapid":[0,0,20]},{"cycle":{"kind":"tap","rigid":false,"emulate":true,"depth":10,"clear":5,"feed":500,"points":[[10,10,0]]}},{"rapid":[0,0,20]}"#,
    );
    assert_eq!(after("fanuc.pf", &tap, &[("M4\n", "M4\nG4 P9000\n")]), "PV010 1");
    assert_eq!(
        after("fanuc.pf", &tap, &[("N100 M3\n", "N100 M3\nG4 P9000\n")]),
        "equivalent: 1 dwell added by the form"
    );
    // after a stop the spindle needs time to start, but it must not be reversed in the cut
    let cuts =
        one(r#"{"rapid":[0,0,25]},{"line":[0,0,-1]},{"line":[40,0,-1]},{"line":[40,30,-1]},{"rapid":[40,30,25]}"#);
    let between = |what: &str| after("haas.pf", &cuts, &[("Y30.\n", &format!("{what}Y30.\n"))]);
    assert_eq!(between("M5\nM3\nG4 P1.\n"), "equivalent: 1 dwell added by the form");
    assert_eq!(between("M4\nG4 P1.\nM3\n"), "PV010 1");
    // a stop or dwell between webs, at the bottom of a bore or below a back bore is a difference; outside the hole it
    // is counted
    let hole = |cycle: &str| {
        one(&format!(
            r#"{{"rapid":[0,0,50]}},{{"cycle":{{{cycle},"clear":5,"feed":300,"points":[[10,10,0]]}}}},{{"rapid":[10,10,50]}}"#
        ))
    };
    let thru = hole(r#""kind":"thru","webs":[3,6,10]"#);
    let bore = hole(r#""kind":"bore","depth":10,"orient":90,"offset":0.5"#);
    let back = hole(r#""kind":"back","depth":10,"rapto":20,"orient":90,"offset":0.5"#);
    // M1 of a Haas stops the spindle and the coolant, and an oriented spindle is no longer at its angle after it
    const STOP: &str = "equivalent: 1 stop added by the form";
    let made = |job: &str, at: &str, what: &str| after("haas.pf", job, &[(at, &format!("{at}{what}"))]);
    for (job, low, out, stops) in [
        (&thru, "N90 G0 Z-5.\n", "N110 G0 Z5.\n", ["PV011 1, PV019 1, PV011 1, PV024 1", "PV019 1", STOP, STOP]),
        (&bore, "Y9.5\n", "N110 Z5.\n", ["PV011 1, PV019 1", "PV011 1, PV019 1", "PV011 1", "PV011 1"]),
        (&back, "N100 Z-20.\n", "N160 Z5.\n", ["PV019 1, PV011 1, PV024 1", "PV019 1, PV011 1", "PV011 1", "PV011 1"]),
    ] {
        let stop = ["M1\n", "M1\nM3\nM8\n"];
        assert_eq!([low, out].map(|at| stop.map(|what| made(job, at, what))).concat(), stops, "{low}");
        assert_eq!(made(job, low, "G4 P1.\n"), "PV010 1", "{low}");
        assert_eq!(made(job, out, "G4 P1.\n"), "equivalent: 1 dwell added by the form", "{out}");
    }
    for stop in ["M0\nS1000 M3\nM8\n", "M1\n"] {
        assert_eq!(after("linuxcnc.pf", &thru, &[("G0 Z-5.\n", &format!("G0 Z-5.\n{stop}"))]), "PV019 1");
    }
}

/// A chip break must lift the tool by at least one digit, and the tool must retract as often as in the job.
#[test]
fn pecks_leave_the_bottom() {
    let chips = |more: &str| {
        one(&format!(
            r#"{{"rapid":[0,0,20]}},{{"cycle":{{"kind":"chipbreak","depth":20,"clear":2,"step":5,"back":1,"emulate":true,"feed":100{more},"points":[[10,10,0]]}}}},{{"rapid":[10,10,20]}}"#
        ))
    };
    let lifts = ["Z-2.", "Z-7.", "Z-12.", "Z-17."];
    let made = |job: &str, changes: &[(String, String)]| {
        let changes: Vec<(&str, &str)> = changes.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
        after("linuxcnc.pf", job, &changes)
    };
    let lost = lifts.map(|up| (format!("G0 {up}\nG1 "), String::new()));
    let (job, other) = (chips(""), "equivalent: 1 hole with other pecks");
    assert_eq!(made(&job, &lost), "PV023 1");
    assert_eq!(made(&job, &lost[1..2]), "PV023 1", "10 at once, the job 5");
    let a_digit = lifts.map(|up| {
        let lower = up[2..up.len() - 1].parse::<u32>().unwrap();
        (format!("G0 {up}\n"), format!("G0 Z-{lower}.99999\n"))
    });
    assert_eq!(made(&job, &a_digit), other);
    let times = chips(r#","times":2"#);
    let [first, second] = ["Z-7.", "Z-17."].map(|up| (format!("G0 Z2.\n{up}\n"), format!("G0 {up}\n")));
    assert_eq!(made(&times, &[]), "identical");
    assert_eq!(made(&times, &[first.clone(), second.clone()]), "PV023 1");
    assert_eq!(made(&times, &[first]), "PV023 1", "20 deep before it comes out, the job 10");
    assert_eq!(made(&times, &[second]), other, "12 of 10: within 1.5");
}

/// A short straight cut before an arc must be on the arc.
#[test]
fn a_short_line_at_an_arc_lies_on_it() {
    let arc = one(
        r#"{"rapid":[0,0,5]},{"line":[0,0,-1]},{"arc":{"to":[20,20],"center":[0,20],"direction":"ccw"}},{"rapid":[20,20,5]}"#,
    );
    let with = |line: &str| after("haas.pf", &arc, &[("G17 G3", &format!("{line}\nG17 G3"))]);
    for on in ["X.003", "X.006"] {
        assert_eq!(with(on), "equivalent: 1 arc made of parts", "{on}");
    }
    for off in ["X-.003", "Y.003", "X-.006"] {
        assert_eq!(with(off), "PV001 1", "{off}");
    }
}

/// S alone does not start the spindle. If no M3 came before a tap, the spindle is stopped after the tap.
#[test]
fn a_speed_alone_starts_no_spindle() {
    let taps = mm(
        r#"{"tool":1,"work":54,"feed":300,"spindle":{"speed":1000,"direction":"cw"},"path":[{"rapid":[0,0,50]},{"cycle":{"kind":"tap","clear":5,"depth":10,"feed":1000,"points":[[0,0,0]]}},{"rapid":[20,0,20]},{"cycle":{"kind":"tap","clear":6,"depth":10,"feed":1000,"points":[[20,0,0]]}},{"cycle":{"kind":"drill","clear":5,"depth":10,"feed":100,"points":[[40,0,0],[50,0,0]]}},{"rapid":[null,null,50]}]}"#,
    );
    for post in ["fanuc.pf", "haas.pf"] {
        assert!(after(post, &taps, &[]).starts_with("equivalent") || after(post, &taps, &[]) == "identical");
        let lost = after(post, &taps, &[("S1000 M3", "S1000")]);
        assert!(lost.contains("PV011"), "{post}: {lost}");
    }
}

/// On the path to its first position, the tool moves down only directly above this position.
#[test]
fn the_tool_comes_down_over_the_first_place() {
    let low = mm(
        r#"{"tool":1,"work":54,"spindle":{"speed":900,"direction":"cw"},"feed":90,"path":[{"rapid":[20,20,25]},{"line":[20,20,-1]},{"rapid":[20,20,25]}]},
        {"tool":2,"work":54,"spindle":{"speed":900,"direction":"cw"},"path":[{"rapid":[60,80,-10]},{"cycle":{"kind":"drill","clear":2,"depth":5,"feed":100,"points":[[60,80,-12]]}},{"rapid":[null,null,50]}]}"#,
    );
    assert_eq!(after("haas.pf", &low, &[]), "identical");
    for to in ["X60. Y-80.", "X60."] {
        assert_eq!(after("haas.pf", &low, &[("G54 X60. Y80.", &format!("G54 {to}"))]), "PV009 1", "{to}");
    }
    let home = one(
        r#"{"rapid":[0,-80,50]},{"line":[0,-80,-2]},{"rapid":[null,null,50]},{"home":true},{"rapid":[0,80,-10]},{"cycle":{"kind":"drill","clear":2,"depth":5,"feed":100,"points":[[0,80,-12]]}},{"rapid":[null,null,50]}"#,
    );
    assert!(
        ["identical", "equivalent: 1 path between cuts with the axes in another order or at a greater height"]
            .contains(&after("fanuc.pf", &home, &[]).as_str())
    );
    assert_eq!(after("fanuc.pf", &home, &[("X0 Y80.\n", "X0\n")]), "PV009 1");
}

/// A state that a text of the job changes must also change in the program.
#[test]
fn what_a_text_of_the_job_switches_counts() {
    let texts = one(
        r#"{"rapid":[0,0,50]},{"rapid":[0,0,2]},{"text":"M7"},{"line":[null,null,-3]},{"line":[60,0,-3]},{"rapid":[null,null,20]},{"text":"M4"},{"rapid":[0,30,20]},{"line":[0,30,-3]},{"rapid":[null,null,20]}"#,
    );
    assert_eq!(after("fanuc.pf", &texts, &[]), "identical");
    for (from, to, code) in [("M7\n", "(none)\n", "PV024"), ("M4\n", "(none)\n", "PV011"), ("M4\n", "M5\n", "PV011")] {
        let changed = after("fanuc.pf", &texts, &[(from, to)]);
        assert!(changed.contains(code), "{from:?} {to:?}: {changed}");
    }
}

/// A tool that cuts nothing must still be loaded: the length register of another tool is a difference.
#[test]
fn a_lost_change_is_seen_at_the_length() {
    let changes = mm(
        r#"{"tool":1,"work":54,"feed":300,"spindle":{"speed":2000,"direction":"cw"},"path":[{"rapid":[0,0,50]},{"rapid":[0,0,2]},{"line":[null,null,-3]},{"line":[60,0,-3]},{"rapid":[null,null,5]}]},
        {"tool":2,"work":54,"feed":200,"spindle":{"speed":1000,"direction":"cw"},"path":[{"rapid":[30,30,6]},{"stop":"program"}]},
        {"tool":1,"work":54,"feed":200,"spindle":{"speed":1500,"direction":"cw"},"path":[{"rapid":[60,80,10]},{"line":[60,80,-2]},{"rapid":[null,null,50]}]}"#,
    );
    assert_eq!(after("haas.pf", &changes, &[]), "identical");
    for post in ["haas.pf", "fanuc.pf"] {
        let lost = after(post, &changes, &[("T2 M6", "T2")]);
        assert!(lost.contains("PV014") || lost.contains("PV012"), "{post}: {lost}");
    }
}

/// G43 on a control without length registers is a difference.
#[test]
fn a_length_where_there_are_none_is_wrong() {
    let cut = one(r#"{"rapid":[0,0,25]},{"line":[0,0,-1]},{"line":[9,0,-1]},{"rapid":[9,0,25]}"#);
    let changed = after("grblhal.pf", &cut, &[("X9.", "G43 H3\nX9.")]);
    assert!(changed.contains("PV014"), "{changed}");
}

/// After the last cut, the tool moves down only at positions where the tool also moves down in the job.
#[test]
fn the_way_out_goes_down_where_the_jobs_does() {
    let leave = mm(
        r#"{"tool":1,"work":54,"feed":300,"spindle":{"speed":2000,"direction":"cw"},"path":[{"rapid":[0,0,50]},{"rapid":[0,0,2]},{"line":[null,null,-3]},{"line":[60,0,-3]},{"rapid":[null,null,20]},{"rapid":[-60,0,20]},{"rapid":[-60,0,-8]}]},
        {"tool":2,"work":54,"feed":200,"spindle":{"speed":1000,"direction":"cw"},"path":[{"rapid":[30,30,40]},{"line":[30,30,-2]},{"rapid":[null,null,20]},{"rapid":[-70,0,20]},{"rapid":[-70,0,-8]}]}"#,
    );
    assert_eq!(after("linuxcnc.pf", &leave, &[]), "identical");
    for (from, to) in [("X-60.", "X45."), ("X-70. Y0", "X45. Y0")] {
        assert_eq!(after("linuxcnc.pf", &leave, &[(from, to)]), "PV009 1", "{from}");
    }
}

/// On many controls, a move to the machine zero cancels the tool length. Without another G43, the tool would move down
/// too far, by its whole length.
#[test]
fn the_length_is_turned_on_again_after_home() {
    let offsets = one(
        r#"{"rapid":[0,0,25]},{"line":[0,0,-1]},{"rapid":[0,0,25]},{"work":55},{"rapid":[20,20,25]},{"line":[20,20,-1]},{"rapid":[20,20,25]}"#,
    );
    let home = one(
        r#"{"rapid":[0,0,25]},{"line":[0,0,-1]},{"rapid":[0,0,25]},{"home":true},{"rapid":[20,20,25]},{"line":[20,20,-1]},{"rapid":[20,20,25]}"#,
    );
    for (job, height) in [(&offsets, "Z25."), (&home, "Z25.")] {
        for post in ["fanuc.pf", "brother.pf"] {
            let (program, _) = of_post(post, job);
            let (first, rest) = program.split_at(program.find("G28").unwrap());
            assert!(first.contains("G43 H1") && rest.contains(&format!("G43 H1 {height}")), "{post}\n{program}");
            assert!(!after(post, job, &[]).contains("PV"), "{post}");
            let lost = after(post, job, &[(&format!("G43 H1 {height}\n"), &format!("{height}\n"))]);
            assert!(lost.starts_with("PV014"), "{post}: {lost}");
        }
    }
    // a cycle after the move home
    for kind in ["drill", "deep", "chipbreak", "tap", "bore"] {
        let cycle = one(&format!(
            r#"{{"rapid":[0,0,25]}},{{"home":true}},{{"cycle":{{"kind":"{kind}","depth":9,"clear":2,"return":20,"feed":1250,"points":[[1,1,0],[5,1,0]]}}}},{{"rapid":[5,1,25]}}"#
        ));
        for post in ["fanuc.pf", "brother.pf"] {
            let verdict = after(post, &cycle, &[]);
            assert!(!verdict.contains("PV"), "{post} {kind}: {verdict}");
        }
    }
    // the same program on other controls: on a Haas, G28 cancels the tool length and G53 does not; LinuxCNC keeps the
    // tool length
    let verdict = |control: &str, program: &str| {
        let mut proof = Proof::default();
        proof.control = Some(crate::support::control(control));
        match proof.verify(Job::json(&home), std::io::Cursor::new(program.to_owned())).unwrap().verdict {
            Verdict::Different(found) => {
                let length = found.iter().find(|found| found.code.name() == "PV014");
                let length = length.unwrap_or_else(|| panic!("{control}: {found:#?}"));
                assert!(length.help.contains("AfterHome"), "{length:#?}");
                "PV014"
            }
            verdict => {
                assert!(verdict.is_proven(), "{control}: {verdict:?}");
                "proven"
            }
        }
    };
    let program = |up: &str| {
        format!(
            "%\nO1\nG21 G17 G40 G49 G80 G90\nT1 M6\nG54 G0 X0 Y0 S1000 M3\nG43 H1 Z25. M8\nG1 Z-1. F100.\nG0 Z25.\n{up}\nG0 X20. Y20.\nZ25.\n\
             G1 Z-1.\nG0 Z25.\nM30\n%\n"
        )
    };
    let table = [
        ("G91 G28 Z0\nG90", "fanuc haas mazak mitsubishi brother", "linuxcnc"),
        ("G53 G0 Z0", "fanuc brother", "haas mazak mitsubishi centroid linuxcnc"),
        ("G91 G30 P2 Z0\nG90", "fanuc haas", ""),
        ("G53 G0 Z0\nG91 G28 Y0\nG90", "haas", "mazak"),
    ];
    for (up, wrong, right) in table {
        for control in wrong.split_whitespace() {
            assert_eq!(verdict(control, &program(up)), "PV014", "{control}: {up}");
        }
        for control in right.split_whitespace() {
            assert_eq!(verdict(control, &program(up)), "proven", "{control}: {up}");
        }
    }
}

/// While a cycle is active, the tool returns to the initial level of the work offset in which the cycle began. In
/// another work offset, the height of this level is unknown.
#[test]
fn a_cycle_that_goes_on_in_another_work_offset_is_not_proven() {
    let job = one(
        r#"{"rapid":[0,0,25]},{"cycle":{"kind":"drill","depth":5,"clear":2,"return":25,"feed":100,"points":[[0,0,0]]}},{"work":55},
        {"rapid":[0,0,25]},{"cycle":{"kind":"drill","depth":5,"clear":2,"return":25,"feed":100,"points":[[0,0,0],[90,0,0]]}},{"rapid":[90,0,25]}"#,
    );
    let program = |back: &str| {
        format!(
            "%\nO1\nG21 G17 G40 G49 G80 G90\nT1 M6\nG54 G0 X0 Y0 S1000 M3\nG43 H1 Z25. M8\nG{back} G81 X0 Y0 Z-5. R2. F100.\n             G55 X0 Y0\nX90.\nG80\nG0 Z25.\nM30\n%\n"
        )
    };
    let mut proof = Proof::default();
    proof.control = Some(crate::support::control("fanuc"));
    let verdict = |program: String| proof.verify(Job::json(&job), std::io::Cursor::new(program)).unwrap().verdict;
    let by_initial = verdict(program("98"));
    assert!(!by_initial.is_proven(), "{by_initial:?}");
    // R is a position in the new work offset
    let by_r = verdict(program("99"));
    assert!(!matches!(by_r, Verdict::NotProven(_)), "{by_r:?}");
}

/// Between M29 and the tap no axis may move: a Fanuc stops there with the alarm 204.
#[test]
fn nothing_moves_between_m29_and_its_tap() {
    let tap = one(
        r#"{"rapid":[0,0,25]},{"cycle":{"kind":"tap","depth":9,"clear":2,"feed":1250,"points":[[10,10,0],[20,10,0]]}},{"rapid":[20,10,25]}"#,
    );
    assert!(!after("fanuc.pf", &tap, &[]).contains("PV"));
    let moved = after("fanuc.pf", &tap, &[("M29 S1000\n", "M29 S1000\nG0 X10. Y10.\n")]);
    assert!(moved.starts_with("PV011"), "{moved}");
}

/// The offset register stays the same while the compensation is on, even if the job names no register.
#[test]
fn a_contour_keeps_its_offset_register() {
    let contour = mm(
        r#"{"tool":1,"work":54,"spindle":{"speed":900,"direction":"cw"},"feed":90,"path":[{"rapid":[0,0,25]},{"line":[0,0,-1]},
        {"infeed":[5,0],"side":"left"},{"line":[30,0,-1]},{"line":[30,20,-1]},{"outfeed":[40,20]},{"rapid":[40,20,25]}]}"#,
    );
    for post in ["fanuc.pf", "haas.pf"] {
        assert!(!after(post, &contour, &[]).contains("PV"), "{post}");
        let changed = after(post, &contour, &[("Y20.\n", "Y20. D7\n")]);
        assert!(changed.contains("PV018"), "{post}: {changed}");
    }
}

/// If the job does not give a value, any value is allowed in the program, but the value must not change.
#[test]
fn what_a_job_leaves_open_does_not_change() {
    let job = r#"{"postform":1,"program":1,"units":"mm","tools":[{"number":1}],"operations":[{"tool":1,
        "spindle":{"speed":1000,"direction":"cw"},"coolant":"flood","feed":100,"path":[{"rapid":[0,0,25]},{"line":[0,0,-1]},{"line":[10,0,-1]},
        {"rapid":[10,0,25]},{"line":[10,0,-1]},{"line":[20,0,-1]},{"rapid":[20,0,25]}]}]}"#;
    let program = |between: &str, length: &str| {
        format!(
            "%\nO1\nG21 G17 G40 G49 G80 G90\nT1 M6\nG56 G0 X0 Y0 S1000 M3\nG43 {length} Z25. M8\nG1 Z-1. F100.\nX10.\n{between}\nG0 Z25.\n\
             G1 Z-1.\nX20.\nG0 Z25.\nM30\n%\n"
        )
    };
    let codes = |control: &str, between: &str, length: &str| {
        let mut proof = Proof::default();
        proof.control = Some(crate::support::control(control));
        let program = std::io::Cursor::new(program(between, length));
        match proof.verify(Job::json(job), program).unwrap().verdict {
            Verdict::Different(found) => found.iter().map(|found| found.code.name()).collect::<Vec<_>>().join(" "),
            verdict => verdict.to_string(),
        }
    };
    for control in ["fanuc", "haas"] {
        assert_eq!(codes(control, "", "H8"), "identical");
        for offset in ["G54", "G54.1 P2"] {
            let said = codes(control, &format!("G0 Z25.\n{offset} X10. Y0"), "H8");
            assert!(said.contains("PV012"), "{control} {offset}: {said}");
        }
        assert!(codes(control, "G43 H5", "H8").contains("PV014"), "{control}");
    }
    // H0 is no length, but on LinuxCNC the length of the tool in the spindle
    for control in ["fanuc", "haas", "centroid"] {
        assert!(codes(control, "", "H0").contains("PV014"), "{control}: {}", codes(control, "", "H0"));
    }
    assert_eq!(codes("linuxcnc", "", "H0"), codes("linuxcnc", "", "H1"));
}

/// If the job is an NC program, it also says whether the tool cuts with its length offset.
#[test]
fn a_length_offset_that_is_off_is_another_length() {
    let job = "%\nO1\nG21 G17 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X0 Y0 S1000 M3\nG43 H1 Z50.\nG1 Z-5. F100.\nX50.\nY30.\nX9.\nG0 Z50.\nM5\nG91 G28 Z0\nG90\nM30\n%\n";
    let said = |control: &str, job: &str, program: &str| {
        let mut proof = Proof::default();
        proof.control = Some(crate::support::control(control));
        let mut job = Job::nc(job);
        job.reading.control = proof.control;
        match proof.verify(job, std::io::Cursor::new(program)).unwrap().verdict {
            Verdict::Different(found) => {
                found.iter().map(|one| format!("{} {}", one.code.name(), one.message)).collect()
            }
            verdict => verdict.to_string(),
        }
    };
    for control in ["fanuc", "haas", "linuxcnc"] {
        assert_eq!(said(control, job, job), "identical", "{control}");
        for (from, to) in [("Y30.\n", "Y30.\nG49\n"), ("Y30.\n", "Y30.\nG43 H0\n"), ("G43 H1 Z50.", "Z50.")] {
            let found = said(control, job, &job.replace(from, to));
            if control == "linuxcnc" && to.contains("H0") {
                assert_eq!(found, "identical", "H0 is the tool in the spindle");
                continue;
            }
            assert!(
                found.contains("PV014") && found.contains("the job's tool cuts with H1"),
                "{control} {to}: {found}"
            );
        }
    }
    // a tool without an offset, after a tool with one
    let second = "T2 M6\nG0 X0 Y0 S900 M3\nZ20.\nG1 Z-1. F80.\nX10.\nG0 Z50.\nM30\n";
    let two = job.replace("G90\nM30\n", &format!("G90 G49\n{second}"));
    assert_eq!(said("haas", &two, &two), "identical");
    let found = said("haas", &two, &two.replace("Z20.", "G43 H2 Z20."));
    assert!(found.contains("PV014") && found.contains("off in the job"), "{found}");
}
