//! Rotary axes: the part turns before the tool moves down, and no angle is lost.

use crate::support::folder::{Folder, err, out};
use crate::support::{job, mill, path_lines, plain_post, program};

const DRILL: &str = "Drill\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
const INDEX: &str = "Index\nG0 Z9.\nA[rotangle]\nX[h] Y[v]\nZ[d]\nEnd";

fn holes(points: &str) -> String {
    format!("{{\"cycle\":{{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[{points}]}}}}")
}

#[test]
fn a_hole_in_another_view_ends_the_cycle_turns_the_part_and_begins_again() {
    let path = holes("[1,1,0],[2,1,0],[2,1,0,90],[3,1,0,90]");
    let cycle = ["G81 X1. Y1. Z-1. R.1 F5.", "X2.", "G80"];
    let again = ["G81 X2. Y1. Z-1. R.1 F5.", "X3.", "G80"];
    let indexed = path_lines("", &format!("{DRILL}\n{INDEX}"), &path);
    assert_eq!(indexed[2..5], cycle);
    assert_eq!(indexed[5..9], ["G0 Z9.", "A90.", "X2. Y1.", "Z.1"]);
    assert_eq!(indexed[9..], again);
    let rapid = path_lines("", DRILL, &path);
    assert_eq!(rapid[5..], [&["G0 A90."][..], &again].concat());
    // as single moves
    let moves = path_lines("", INDEX, &holes("[1,1,0],[1,1,0,90]"));
    assert_eq!(moves[2..], ["G1 Z-1. F5.", "G0 Z.1", "G0 Z9.", "A90.", "X1. Y1.", "Z.1", "G1 Z-1. F5.", "G0 Z.1"]);
}

#[test]
fn a_rapid_beyond_the_travel_goes_to_the_same_view_within_it() {
    let path = format!("{{\"line\":[0,0,1,360]}},{}", holes("[1,1,0,400]"));
    let lines = path_lines("Limits A -360 360", DRILL, &path);
    assert_eq!(lines[1..], ["G0 X1. Y1. A40.", "Z.1", "G81 X1. Y1. Z-1. R.1 F5.", "G80"]);
    // later angles count from the unwound position: 760 is 400 on the axis, which equals 40
    let on = format!("{path},{{\"rapid\":[1,1,1,760]}},{{\"line\":[1,1,1,770]}}");
    let lines = path_lines("Limits A -360 360", DRILL, &on);
    assert_eq!(lines[5..], ["G0 Z1.", "G1 A50. F10."]);
}

/// A form that gives its linear axes formats, but does not mention A, is for a machine without A.
#[test]
fn a_form_without_the_axis_refuses_the_job() {
    let path = "{\"line\":[1,0,0]},{\"rapid\":[0,0,1,90]}";
    let linear = "X->4.>4\nY->4.>4\nZ->4.>4";
    let refused = ["PR008 the form has no axis A"];
    let turned = ["G1 X1. Z0 F10.", "G0 X0 Z1. A90."];
    for (head, sequences, lines) in [
        (linear, "", &refused[..]),
        // the form mentions A by a format, a travel, another name or a word
        (&format!("{linear}\nA->4.>4"), "", &turned),
        (&format!("{linear}\nLimits A -360 360"), "", &turned),
        (&format!("{linear}\nRename A B"), "", &["G1 X1. Z0 F10.", "G0 X0 Z1. B90."]),
        (linear, INDEX, &["G1 X1. Z0 F10.", "G0 Z9.", "A90.", "X0 Y0", "Z1."]),
        // a form without formats of its own uses the built-in formats for all axes
        ("", "", &turned),
    ] {
        assert_eq!(path_lines(head, sequences, path), lines, "{head}\n{sequences}");
    }
}

/// If the tool change of a form moves down, the form must turn the part before this move.
#[test]
fn a_tool_change_turns_the_part_before_it_goes_down() {
    let turned = job("{\"line\":[1,0,1]}").replace("[0,0,1]", "[0,0,1,90]");
    let error = &program(&mill("", INDEX), &turned)[0];
    assert!(error.starts_with("PR017 the tool begins at A90"), "{error}");
    let says = mill("", INDEX).replace("X[h] Y[v] Z[d]\nEnd", "X[h] Y[v] A[rotangle]\nZ[d]\nEnd");
    assert_eq!(program(&says, &turned)[3..5], ["G0 G54 X0 Y0 A90.", "Z1."]);
    // if the tool change stays up, Index turns the part
    let high = mill("", INDEX).replace(" Z[d]\nEnd", "\nEnd");
    assert_eq!(program(&high, &turned)[3..8], ["G0 G54 X0 Y0", "G0 Z9.", "A90.", "X0 Y0", "Z1."]);
}

/// Axes that Index does not print are moved after Index. If Index does not print the angle, there is an error.
#[test]
fn index_loses_no_axis() {
    let short = "Index\nG0 Z9.\nA[rotangle]\nEnd";
    let lines = path_lines("", short, "{\"rapid\":[2,1,1,90]}");
    assert_eq!(lines[2..], ["G0 X2. Y1. Z1."]);
    let silent = "Index\nG0 Z9.\nX[h] Y[v]\nZ[d]\nEnd";
    assert!(path_lines("", silent, "{\"rapid\":[2,1,1,90]}")[0].starts_with("PR017 A turns to 90"));
    let other = "{\"rapid\":[2,1,1,0,90]}";
    assert!(path_lines("", INDEX, other)[0].starts_with("PR017 B turns to 90"));
    let both = "Index\nG0 Z9.\nA[rotangle] B[rotangle]\nX[h] Y[v]\nZ[d]\nEnd";
    assert_eq!(path_lines("", both, "{\"rapid\":[2,1,1,30,90]}")[1], "A30. B90.");
}

#[test]
fn a_motion_sequence_prints_the_angle_or_refuses() {
    let path = "{\"line\":[2,1,1,90]}";
    let error = &path_lines("", "LineCode\nG1 X[h] Y[v] Z[d] F[frate]\nEnd", path)[0];
    assert!(error.starts_with("PR017 this move changes A[rotangle]"), "{error}");
    let says = "LineCode\nG1 X[h] Y[v] Z[d] A[rotangle] F[frate]\nEnd";
    assert_eq!(path_lines("", says, path), ["G1 X2. Y1. A90. F10."]);
}

/// The angle is printed before the height. An arc turns the part evenly along its path.
#[test]
fn the_angle_comes_before_the_height_and_arcs_turn_evenly() {
    let turned = job("{\"line\":[1,0,1]}").replace("[0,0,1]", "[0,0,1,90]");
    let late = mill("", "").replace("Z[d]\nEnd", "Z[d]\nA[rotangle]\nEnd");
    assert!(program(&late, &turned)[0].starts_with("PR017 the tool begins at A90"));
    let arc = "{\"arc\":{\"to\":[2,0,1,180],\"center\":[1,0,1],\"direction\":\"cw\"}}";
    let lines = path_lines("Tolerance 0.1", "", arc);
    let angles: Vec<_> =
        lines.iter().filter_map(|l| l.split('A').nth(1)?.split('.').next()?.parse::<f64>().ok()).collect();
    assert!(angles.len() > 2 && angles.windows(2).all(|w| w[0] < w[1]) && angles[0] < 90.0, "{lines:?}");
}

/// A tool change keeps the angle of the previous cut.
#[test]
fn the_part_stays_turned_at_a_tool_change() {
    let second = "{\"tool\":2,\"spindle\":{\"speed\":1,\"direction\":\"cw\"},\"path\":[{\"rapid\":[3,3,1]}]}";
    let text = job("{\"line\":[1,0,1,20]}").replace("20]}]}]}", &format!("20]}}]}},{second}]}}"));
    let form = mill("", "").replace("X[h] Y[v] Z[d]\nEnd", "X[h] Y[v] A[rotangle]\nZ[d]\nEnd");
    assert!(program(&form, &text).contains(&"G0 G54 X3. Y3. A20.".to_owned()), "{:?}", program(&form, &text));
}

/// A cycle does not turn the part, so the next move does not print the angle again.
#[test]
fn an_angle_is_known_behind_a_cycle() {
    let path = format!("{{\"rapid\":[0,0,1,90]}},{},{{\"rapid\":[3,0,2]}}", holes("[1,1,0],[2,1,0]"));
    let lines = path_lines("", &format!("{DRILL}\n{INDEX}"), &path);
    assert_eq!(lines.last().unwrap(), "G0 X3. Y0 Z2.", "{lines:?}");
}

/// In another work offset, the part may need a turn even if the angle stays the same. The Haas post prints the angle
/// again while the tool is up.
#[test]
fn another_work_offset_turns_the_part_before_the_tool_goes_down() {
    let operation = |work: u8| {
        format!(
            r#"{{"tool":1,"work":{work},"spindle":{{"speed":1000,"direction":"cw"}},"feed":100,"path":[{{"rapid":[0,0,50,90]}},{{"rapid":[0,0,2,90]}},{{"line":[9,0,2,90]}},{{"rapid":[9,0,50,90]}}]}}"#
        )
    };
    let text = format!(
        r#"{{"postform":1,"program":1,"units":"mm","tools":[{{"number":1}}],"operations":[{},{}]}}"#,
        operation(54),
        operation(55)
    );
    let lines = program(&plain_post("haas-4axis.pf"), &text);
    let at = lines.iter().position(|line| line.contains("G55 A90.")).unwrap_or_else(|| panic!("{lines:#?}"));
    let plain = |line: &str| line.split_once(' ').map_or(line.to_owned(), |(_, rest)| rest.to_owned());
    let around: Vec<String> = lines[at - 1..at + 3].iter().map(|line| plain(line)).collect();
    assert_eq!(around, ["G0 G53 Z0", "G55 A90.", "X0 Y0", "Z50."]);
}

/// A job in inches with a path, and a program with these blocks.
fn job_and_program(folder: &Folder, path: &str, blocks: &str) {
    folder.write("job.json", format!(
        r#"{{"postform":1,"program":1,"units":"inch","tools":[{{"number":1}}],"operations":[{{"tool":1,"work":54,"spindle":{{"speed":1000,"direction":"cw"}},"feed":10,"path":[{{"rapid":[0,0,5,0]}},{{"line":[0,0,-0.1]}},{path}]}}]}}"#
    ));
    folder.write("a.nc", nc(blocks));
}

fn nc(blocks: &str) -> String {
    format!(
        "%\nO1\nG20 G17 G40 G49 G80 G90 G94\nT1 M6\nG0 G54 X0. Y0. A0. S1000 M3\nG43 H1 Z5.\nG1 Z-.1 F10.\n{blocks}\nM5\nG91 G28 Z0.\nM30\n%\n"
    )
}

/// The way by which a part turns is a part of each cut, and of each rapid before the retract: verify and diff compare
/// the direction and the number of turns.
#[test]
fn the_way_of_a_turn_is_compared_not_only_its_end() {
    let line = r#"{"line":[1,0,-0.1,90]},{"rapid":[1,0,5]}"#;
    let alone = r#"{"line":[0,0,-0.1,360]},{"rapid":[0,0,5]}"#;
    let arc = r#"{"arc":{"to":[1,0,-0.1,90],"center":[0.5,0],"direction":"cw"}},{"rapid":[1,0,5]}"#;
    let circle = r#"{"arc":{"to":[0,0,-0.1,0],"center":[0.5,0],"direction":"cw"}},{"rapid":[0,0,5]}"#;
    let rapid = r#"{"line":[1,0,-0.1]},{"rapid":[1,0,-0.1,90]},{"line":[2,0,-0.1]},{"rapid":[2,0,5]}"#;
    let leaves = r#"{"line":[1,0,-0.1]},{"rapid":[1,0,-0.1,90]},{"rapid":[1,0,5]}"#;
    let otherwise = "in another direction than in the job, or by more turns";
    // (the job's path, the right blocks, the wrong blocks, the message of verify, the message of diff)
    let cases = [
        (line, "X1. A90.\nG0 Z5.", "X1. A-270.\nG0 Z5.", otherwise, "turns the part from A0 to A-270"),
        (line, "X1. A90.\nG0 Z5.", "X1. A450.\nG0 Z5.", otherwise, "turns the part from A0 to A450"),
        (alone, "A360.\nG0 Z5.", "A-360.\nG0 Z5.", otherwise, "turns the part from A0 to A-360"),
        (arc, "G2 X1. I.5 A90.\nG0 Z5.", "G2 X1. I.5 A-270.\nG0 Z5.", "to A-270 at X1", "from A0 to A-270"),
        (circle, "G2 I.5\nG0 Z5.", "G2 I.5 A360.\nG0 Z5.", "to A360 at X0", "from A0 to A360"),
        (
            rapid,
            "X1.\nG0 A90.\nG1 X2.\nG0 Z5.",
            "X1.\nG0 A-270.\nG1 X2.\nG0 Z5.",
            "before the tool is retracted, a rapid to X1 Y0 Z-0.1 A-270 turns",
            "before the tool is retracted, a rapid to X1 Y0 Z-0.1 A-270 turns",
        ),
        (leaves, "X1.\nG0 A90.\nZ5.", "X1.\nG0 A-270.\nZ5.", "a rapid to X1 Y0 Z-0.1 A-270 turns", "the path after"),
    ];
    let folder = Folder::new("rotary-turns");
    let verify = ["verify", "job.json", "--nc", "a.nc", "--control", "haas"];
    let text =
        |output: &std::process::Output| (out(output) + &err(output)).split_whitespace().collect::<Vec<_>>().join(" ");
    for (path, right, wrong, in_verify, in_diff) in cases {
        job_and_program(&folder, path, right);
        let proven = text(&folder.run(&verify));
        assert!(proven.contains("identical"), "{right}: {proven}");
        folder.write("b.nc", nc(wrong));
        let diff = folder.run(&["diff", "--motion", "a.nc", "b.nc", "--control", "haas"]);
        assert!(text(&diff).contains(in_diff), "{wrong}: {}", text(&diff));
        job_and_program(&folder, path, wrong);
        let said = text(&folder.run(&verify)).replace("│ ", "");
        assert!(said.contains(in_verify), "{wrong}: {said}");
    }
}

/// Parts of a cut turn the part in proportion. The program may count its angles from another turn than the job, and
/// above the part it may turn by another way.
#[test]
fn parts_of_a_cut_turn_in_proportion() {
    let line = r#"{"line":[1,0,-0.1,90]},{"rapid":[1,0,5]}"#;
    let arc = r#"{"arc":{"to":[1,0,-0.1,90],"center":[0.5,0],"direction":"cw"}},{"rapid":[1,0,5]}"#;
    let turns = r#"{"line":[1,0,-0.1,720]},{"rapid":[1,0,5]},{"rapid":[1,0,0.1,750]},{"line":[2,0,-0.1,840]},{"rapid":[2,0,5]}"#;
    let cases = [
        (line, "X.5 A45.\nX1. A90.\nG0 Z5.", "1 straight cut made of parts"),
        (line, "X.5 A60.\nX1. A90.\nG0 Z5.", "different"),
        (arc, "G2 X.5 Y.5 I.5 A45.\nX1. Y0. J-.5 A90.\nG0 Z5.", "1 arc made of parts"),
        (arc, "G2 X.5 Y.5 I.5 A90.\nX1. Y0. J-.5\nG0 Z5.", "different"),
        (
            turns,
            "X1. A720.\nG0 Z5.\nA30.\nZ.1\nG1 X1.5 Z0. A75.\nX2. Z-.1 A120.\nG0 Z5.",
            "1 straight cut made of parts",
        ),
        (turns, "X1. A720.\nG0 Z5.\nA390.\nZ.1\nG1 X2. Z-.1 A480.\nG0 Z5.", "equivalent"),
    ];
    let folder = Folder::new("rotary-parts");
    for (path, blocks, verdict) in cases {
        job_and_program(&folder, path, blocks);
        let run = folder.run(&["verify", "job.json", "--nc", "a.nc", "--control", "haas"]);
        let said = out(&run) + &err(&run);
        assert!(said.contains(verdict), "{blocks}: {said}");
    }
}

/// The zero of a rotary axis is another one in each work offset, and machine positions are known only at the machine.
/// After both, the angle is unknown until the program gives it again.
#[test]
fn an_angle_is_unknown_in_another_work_offset_and_at_home() {
    // the first cut is at A90 in G54; `blocks` lead to the second cut
    let program = |blocks: &str| nc(&format!("G0 Z5.\nA90.\nZ.1\nG1 Z-.1\nG0 Z5.\n{blocks}\nG1 Z-.1\nG0 Z5."));
    let folder = Folder::new("rotary-offsets");
    let compared = |old: &str, new: &str| {
        folder.write("a.nc", program(old));
        folder.write("b.nc", program(new));
        let run = folder.run(&["diff", "--motion", "a.nc", "b.nc", "--control", "haas"]);
        (run.status.success(), out(&run) + &err(&run))
    };
    let given = "G55 X0. Y0. A90.\nZ5.";
    let home = "G91 G28 A0.\nG90 G0 A0.\nG43 H1 Z5.";
    let there = "A0.\nG43 H1 Z5.";
    // (old, new, whether the motions are the same)
    let cases = [
        (given, given, true),
        ("G55 X0. Y0.\nZ5.", "G55 X0. Y0.\nZ5.", true),
        (given, "G55 X0. Y0.\nZ5.", false),
        (home, home, true),
        (home, there, true),
        (there, "G91 G28 A0.\nG90 G43 H1 Z5.", false),
        (there, "G91 G30 A0.\nG90 G43 H1 Z5.", false),
        ("A0.", "G53 A0.", false),
        ("G55 X0. Y0. A90.\nZ5.", "G91 G28 Z0.\nG90 G55 X0. Y0. A90.\nG43 H1 Z5.", true),
    ];
    for (old, new, same) in cases {
        let (is_same, said) = compared(old, new);
        assert!(is_same == same, "{old} / {new}: {said}");
        assert!(same || said.contains("an unknown machine position of A"), "{old} / {new}: {said}");
    }
    // an axis may be turned by any kind of block
    for turn in
        ["G1 A90. F100.", "G1 X1. F100.\nA90.", "G91 G1 A90. F100.\nG90", "G0 G53 A90.", "G2 X0. I1. A90. F100."]
    {
        for (file, angle) in [("a.nc", ""), ("b.nc", " A90.")] {
            folder.write(file, nc(&format!("G0 Z5.\n{turn}\nG55 G0 X0. Y0.{angle}\nZ5.\nG1 Z-.1\nG0 Z5.")));
        }
        let run = folder.run(&["diff", "--motion", "a.nc", "b.nc", "--control", "haas"]);
        assert!(!run.status.success(), "{turn}: {}{}", out(&run), err(&run));
    }
    // an axis that is never turned away from 0 is at 0 in each work offset and at its reference point
    for (old, new) in [("G55 X0. Y0.\nZ5.", "G55 X0. Y0. A0.\nZ5."), ("G91 G28 A0.\nG90 G43 H1 Z5.", "A0.\nG43 H1 Z5.")]
    {
        for (file, blocks) in [("a.nc", old), ("b.nc", new)] {
            folder.write(file, nc(&format!("G0 Z5.\n{blocks}\nG1 Z-.1\nG0 Z5.")));
        }
        let run = folder.run(&["diff", "--motion", "a.nc", "b.nc", "--control", "haas"]);
        assert!(run.status.success(), "{old} / {new}: {}{}", out(&run), err(&run));
    }
    // as a job, a program must give the angle before each cut
    let form = crate::support::root().join("postforms/haas-4axis.pf").to_string_lossy().into_owned();
    for (blocks, proven) in [(given, true), (home, true), ("G55 X0. Y0.\nZ5.", false), ("G53 A0.\nX0.", false)] {
        folder.write("a.nc", program(blocks));
        let run = folder.run(&["render", "a.nc", "--form", &form, "--job-control", "haas", "-o", "b.nc"]);
        let said = err(&run) + &out(&run);
        assert_eq!(run.status.success(), proven, "{blocks}: {said}");
        assert!(
            proven || said.contains("PN036") && said.contains("unknown angle of a rotary axis"),
            "{blocks}: {said}"
        );
    }
    // a job with its own angle in each operation
    let operation = |work: u8| {
        format!(
            r#"{{"tool":1,"work":{work},"spindle":{{"speed":1000,"direction":"cw"}},"feed":10,"path":[{{"rapid":[0,0,5,90]}},{{"rapid":[0,0,0.1,90]}},{{"line":[0,0,-0.1,90]}},{{"rapid":[0,0,5,90]}}]}}"#
        )
    };
    folder.write(
        "job.json",
        format!(
            r#"{{"postform":1,"program":1,"units":"inch","tools":[{{"number":1}}],"operations":[{},{}]}}"#,
            operation(54),
            operation(55)
        ),
    );
    let cuts = |turn: &str| {
        let text = program(turn);
        text.replacen("G1 Z-.1 F10.\nG0 Z5.\nA90.\nZ.1\nG1 Z-.1\n", "A90.\nZ.1\nG1 Z-.1 F10.\n", 1)
    };
    for (blocks, verdict) in [
        ("G55 X0. Y0. A90.\nZ5.\nZ.1", "identical"),
        ("G55 X0. Y0.\nZ5.\nA90.\nZ.1", "identical"),
        ("G55 X0. Y0.\nZ5.\nZ.1", "A is not printed since a change of the work offset"),
        ("G55 X0. Y0.\nZ.1\nA90.", "PV009"),
    ] {
        folder.write("a.nc", cuts(blocks));
        let run = folder.run(&["verify", "job.json", "--nc", "a.nc", "--control", "haas"]);
        let said = out(&run) + &err(&run);
        assert!(said.contains(verdict), "{blocks}: {said}");
    }
}

/// If only rotary axes move, the feed is in degrees per minute: it is the same number in inches and in millimetres.
#[test]
fn the_feed_of_a_turn_is_the_same_in_other_units() {
    let folder = Folder::new("rotary-feeds");
    let path = r#"{"line":[0,0,-0.1,90],"feed":100},{"line":[1,0,-0.1]},{"rapid":[1,0,5]}"#;
    job_and_program(&folder, path, "A90. F100.\nX1.\nG0 Z5.");
    let form = crate::support::root().join("postforms/haas-4axis.pf").to_string_lossy().into_owned();
    let run = folder.run(&["render", "job.json", "--form", &form, "--units", "mm", "--require-proof", "-o", "mm.nc"]);
    assert!(run.status.success(), "{}", err(&run));
    let text = folder.read("mm.nc");
    // the next cut has the same feed of the job, but along X
    assert!(text.contains("A90. F100.\n") && text.contains("X25.4 F2540.\n"), "{text}");
    let mm = |feeds: [&str; 2]| {
        let [turn, across] = feeds;
        let blocks = format!("G1 Z-2.54 F254.\nA90. F{turn}\nX25.4 F{across}\nG0 Z127.");
        nc("").replace("G20", "G21").replace("Z5.", "Z127.").replace("G1 Z-.1 F10.\n", &blocks)
    };
    for (feeds, same) in [(["100.", "2540."], true), (["2540.", "2540."], false), (["100.", "100."], false)] {
        folder.write("b.nc", mm(feeds));
        let run = folder.run(&["diff", "--motion", "a.nc", "b.nc", "--control", "haas"]);
        assert_eq!(run.status.success(), same, "{feeds:?}: {}{}", out(&run), err(&run));
        let run = folder.run(&["verify", "job.json", "--nc", "b.nc", "--control", "haas"]);
        assert_eq!(run.status.success(), same, "{feeds:?}: {}{}", out(&run), err(&run));
    }
    // 5.1 inch at F10, 90 degrees and 1 inch at F100
    let run = folder.run(&["simulate", "--dry", "a.nc", "--control", "haas"]);
    assert!(out(&run).contains("cutting 1:25"), "{}", out(&run));
}

/// LinuxCNC keeps the number of F for a turn if the units change after F. On other controls the feed is unknown.
#[test]
fn the_feed_of_a_turn_is_given_after_the_units() {
    let folder = Folder::new("rotary-units");
    let program =
        |blocks: &str| format!("%\nO1\nG20 G90 G94 S1000 M3\nT1 M6\nG43 H1 F100.\n{blocks}\nX9. A180.\nM30\n%\n");
    let feeds = |control: &str, blocks: &str| {
        folder.write("a.nc", program(blocks));
        let run = folder.run(&["simulate", "a.nc", "--control", control]);
        let said = out(&run) + &err(&run);
        let feed = |line: &str| line.split_once(" F").map(|(_, feed)| feed.trim().to_owned());
        if said.contains("given before the units changed") { vec![] } else { said.lines().filter_map(feed).collect() }
    };
    for (control, blocks, expected) in [
        ("linuxcnc", "G21\nG1 A90.", vec!["100", "2540"]),
        ("linuxcnc", "G21 G1 A90.", vec!["100", "2540"]),
        ("linuxcnc", "G21\nG20\nG1 A90.", vec!["100", "100"]),
        ("haas", "G21\nG1 A90.", vec![]),
        ("fanuc", "G1\nG21\nA90.", vec![]),
        ("haas", "G21\nG20\nG1 A90.", vec!["100", "100"]),
        ("haas", "G21\nG1 A90. F300.", vec!["300", "300"]),
        ("haas", "G21 G1 A90. F300.", vec!["300", "300"]),
    ] {
        assert_eq!(feeds(control, blocks), expected, "{control}: {blocks}");
    }
}

/// The feed of a rotary axis is compared with its fastest feed, also if X, Y or Z moves too.
#[test]
fn a_rotary_axis_has_a_fastest_feed() {
    let folder = Folder::new("rotary-fastest");
    let machine = "name = \"M\"\ncontrol = \"haas\"\nunits = \"inch\"\n[axes.A]\nfeed = 1000\n";
    folder.write("m.toml", machine);
    folder.write("x.toml", machine.replace("axes.A", "axes.X"));
    // X moves 3 inches while A turns by 4 degrees: at F100, X feeds at 60 inches per minute
    for (cut, is_fast) in [("X3. A4. F1600.", false), ("X3. A4. F1700.", true), ("X3. F1001.", true)] {
        folder.write("a.nc", nc(&format!("{cut}\nG0 Z5.")));
        let run = folder.run(&["fit", "a.nc", "--machine", "x.toml", "--control", "haas"]);
        assert_eq!((out(&run) + &err(&run)).contains("X would feed at"), is_fast, "{cut}");
    }
    for (cut, feed) in [
        ("A90. F1000.", None),
        ("A90. F1001.", Some("1001")),
        ("X1. A100. F5000.", Some("4999.75")),
        ("X100. A1. F5000.", None),
        ("G2 I.5 A90. F2000.", Some("1998.783")),
        ("G93 X1. A90. F20.", Some("1800")),
        ("G93 X1. A90. F10.", None),
    ] {
        folder.write("a.nc", nc(&format!("{cut}\nG0 Z5.")));
        let run = folder.run(&["fit", "a.nc", "--machine", "m.toml", "--control", "haas"]);
        let said = out(&run) + &err(&run);
        let message = feed.map(|feed| format!("A would feed at {feed} degrees/min, but its maximum is 1000"));
        assert_eq!(said.contains("would feed"), feed.is_some(), "{cut}: {said}");
        assert!(message.is_none_or(|message| said.contains(&message)), "{cut}: {said}");
    }
}
