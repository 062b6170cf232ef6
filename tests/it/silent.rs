//! Programs that were wrong in earlier versions, without a message. Each test checks the block that was wrong.

use crate::support;
use crate::support::{job, mill, path_lines, program, root};

/// The program of a post for a job.
fn post(name: &str, text: &str) -> Vec<String> {
    let checked = support::check_file(&root().join(format!("postforms/{name}.pf")));
    match support::render_checked(&checked, text.as_bytes(), false, Default::default()) {
        Ok(rendered) => rendered.text.lines().map(str::to_owned).collect(),
        Err(diag) => vec![format!("{} {}", diag.code.name(), diag.message)],
    }
}

/// The spindle is started again between a stop and the next cut. The stop may come from a cycle, a text of the job, or
/// a sequence of the form.
#[test]
fn after_every_stop_the_spindle_turns_again() {
    let manual = "{\"cycle\":{\"kind\":\"manual\",\"clear\":0.1,\"points\":[[1,1,0]]}},{\"line\":[1,1,-1]}";
    let lines = path_lines("", "", manual);
    let stop = lines.iter().position(|line| line == "M0").unwrap_or_else(|| panic!("{lines:?}"));
    assert_eq!(lines[stop..], ["M0", "S1000 M3", "G1 Z-1. F10."]);

    for text in ["M00", "M0", "M1", "N7 M01 (LOOK)"] {
        let lines = path_lines("", "", &format!("{{\"text\":\"{text}\"}},{{\"line\":[1,0,1]}}"));
        assert_eq!(lines[1..], ["S1000 M3", "G1 X1. Y0 Z1. F10."], "{text}");
    }
    let row = "{\"begin\":\"row\"},{\"line\":[1,0,1]},{\"end\":\"row\"}";
    assert_eq!(path_lines("", "BeginRow\nM0\nEnd", row), ["M0", "S1000 M3", "G1 X1. F10."]);
    assert_eq!(path_lines("", "BeginRow\n/M1\nEnd", row), ["/M1", "S1000 M3", "G1 X1. F10."]);
    // if the sequence prints the spindle after its stop, it is not printed twice
    let own = "BeginRow\nM0\nS[speed] M[direct]\nEnd";
    assert_eq!(path_lines("", own, row), ["M0", "S1000 M3", "G1 X1. F10."]);
    // a spindle that the job turned off stays off
    let off = "{\"text\":\"M5\"},{\"text\":\"M0\"},{\"rapid\":[1,0,1]}";
    assert_eq!(path_lines("", "", off), ["M5", "M0", "G0 X1. Y0 Z1."]);
}

/// A cutting sequence without a motion code must cut, whatever motion was active before.
#[test]
fn a_cut_is_no_rapid() {
    let infeed = "InFeed\nG[side] X[h] Y[v] D[dcomp] F[frate]\nEnd\nOutFeed\nG40 X[h] Y[v]\nEnd";
    let path = "{\"rapid\":[0,0,-0.1]},{\"infeed\":[1,1],\"side\":\"left\"},{\"line\":[2,1]},{\"rapid\":[3,1]},{\"outfeed\":[0,0]}";
    let cut = ["G0 Z-.1", "G1 F10.", "G41 X1. Y1. D21 F10.", "X2.", "G0 X3.", "G1", "G40 X0 Y0"];
    assert_eq!(path_lines("", infeed, path), cut);
    let line = "LineCode\nX[h] Y[v] Z[d] F[frate]\nEnd";
    assert_eq!(path_lines("", line, "{\"line\":[1,0,1]},{\"line\":[2,0,1]}"), ["G1 F10.", "X1.", "X2."]);
    let rapid = "RapidCode\nX[h] Y[v] Z[d]\nEnd";
    assert_eq!(path_lines("", rapid, "{\"line\":[1,0,1]},{\"rapid\":[2,0,1]}"), ["G1 X1. F10.", "G0", "X2."]);
    // an arc code can't be a separate block; a form without G codes has no code to print
    let arc = "{\"arc\":{\"to\":[1,1],\"center\":[0,1],\"direction\":\"ccw\"}}";
    let lines = path_lines("", "CcwCode\nX[h] Y[v] I[ival] J[jval] F[frate]\nEnd", arc);
    assert_eq!(lines, ["PR017 the sequence does not print G3, but another motion code is active"]);
    let klartext = mill("", &format!("{}\n{}", rapid.replace('X', "L X"), line.replace('X', "L X")));
    let lines = program(&klartext.replace("G0 G[work]", "G[work]"), &job("{\"line\":[1,0,1]}"));
    assert_eq!(lines[lines.len() - 2], "L X1. F10.");
}

/// No spindle block is generated if the form switches the torch itself, or if it prints the power of the laser in the
/// moves.
#[test]
fn forms_that_switch_the_tool_themselves_do_so_alone() {
    let torch = "BeginLeadin\nM3\nG4 P.4\nEnd\nEndLeadout\nM5\nEnd";
    let path = "{\"begin\":\"leadin\"},{\"line\":[1,0,1]},{\"end\":\"leadin\"},{\"begin\":\"leadout\"},{\"line\":[2,0,1]},\
                {\"end\":\"leadout\"},{\"rapid\":[5,0,1]},{\"begin\":\"leadin\"},{\"line\":[6,0,1]},{\"end\":\"leadin\"}";
    let lines = ["M3", "G4 P.4", "G1 X1. F10.", "X2.", "M5", "G0 X5.", "M3", "G4 P.4", "G1 X6."];
    assert_eq!(path_lines("", torch, path), lines);
    let laser = mill("", "RapidCode\nG0 X[h] Y[v] S0\nEnd\nLineCode\nG1 X[h] Y[v] F[frate] S[speed]\nEnd")
        .replace("S[speed] M[direct]", "M4 S0");
    let lines = program(&laser, &job("{\"line\":[1,0]},{\"rapid\":[2,0]},{\"line\":[3,0]}"));
    assert_eq!(lines[4..7], ["G1 X1. F10. S1000", "G0 X2. S0", "G1 X3. S1000"]);
}

/// Values at the beginning of an operation apply to its tool change. They may also be a key of the operation.
#[test]
fn values_come_with_their_tool_change() {
    let form = mill("", "").replace("T[tool] M6", "T[tool] M6\nM[val1]");
    let jobs = |first: &str, head: &str| {
        format!(
            "{{\"postform\":1,\"units\":\"inch\",\"set\":{{\"val1\":9}},\"tools\":[{{\"number\":1}},{{\"number\":2}}],\"operations\":[\
             {{\"tool\":1,\"spindle\":{{\"speed\":1,\"direction\":\"cw\"}},\"path\":[{{\"set\":{{\"val1\":67}}}},{{\"rapid\":[0,0,1]}}]}},\
             {{\"tool\":2,\"spindle\":{{\"speed\":1,\"direction\":\"cw\"}}{head},\"path\":[{first}{{\"rapid\":[0,0,1]}}]}}]}}"
        )
    };
    let said = |job: &str| program(&form, job).into_iter().filter(|line| line.starts_with('M')).collect::<Vec<_>>();
    let form_said = |job: &str| said(job)[..2].to_vec();
    assert_eq!(form_said(&jobs("{\"set\":{\"val1\":68}},", "")), ["M67", "M68"]);
    assert_eq!(form_said(&jobs("", ",\"set\":{\"val1\":68}")), ["M67", "M68"]);
    assert!(said(&jobs("", ",\"set\":{\"vall\":68}"))[..].is_empty(), "an unknown name is an error");
}

/// A job may give the height before the position, or after it: the tool change waits for both.
#[test]
fn a_tool_change_waits_for_the_axes_that_it_prints() {
    let path = |items: &str| job("@").replace("{\"rapid\":[0,0,1]},@", items);
    for items in [
        "{\"rapid\":[null,null,2]},{\"comment\":\"up\"},{\"rapid\":[5,6]},{\"line\":[5,6,0]}",
        "{\"rapid\":[5,6]},{\"comment\":\"up\"},{\"rapid\":[null,null,2]},{\"line\":[5,6,0]}",
        "{\"rapid\":[null,6]},{\"rapid\":[null,null,2]},{\"comment\":\"up\"},{\"rapid\":[5]},{\"line\":[5,6,0]}",
    ] {
        let lines = program(&mill("", ""), &path(items));
        assert_eq!(lines[3..], ["G0 G54 X5. Y6. Z2.", "(UP)", "G1 Z0 F10.", "M30"], "{items}");
    }
    // the height of the rapid, over the first hole
    let items = "{\"rapid\":[null,null,2]},{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[5,6,0]]}}";
    assert_eq!(program(&mill("", ""), &path(items))[3..5], ["G0 G54 X5. Y6. Z2.", "G0 Z.1"]);
    // without a position in X and Y, it is still an error
    let items = "{\"rapid\":[null,null,2]},{\"line\":[5,6,0]}";
    assert!(program(&mill("", ""), &path(items))[0].starts_with("PR001 [h] has no value here"));
}

/// A job gives the number or the code of a fixture. A form with its own word prints its own number: never the code 54,
/// and never a number that does not exist.
#[test]
fn work_offsets_are_counted_as_the_form_counts() {
    let form = mill("Work 1", "").replace("G0 G[work]", "G15 H[work]\nG0");
    let line = |work: &str| program(&form, &job("{\"line\":[1,0,1]}").replace("\"work\":54", work))[3].clone();
    assert_eq!(line("\"work\":54"), "G15 H1");
    assert_eq!(line("\"work\":56"), "G15 H3");
    assert_eq!(line("\"work\":3"), "G15 H3");
    let error = program(&form, &job("{\"line\":[1,0,1]}").replace("\"work\":54", "\"work\":59.1"));
    assert_eq!(error, ["PR037 the work offset 59.1 is a code, but this form counts its offsets from 1"]);
}

/// Before a call in another work offset, the work offset is selected, and the Upon for the work offset prints.
#[test]
fn a_call_in_another_work_offset_goes_up_first() {
    let subs = "Upon [work]\nG53 G0 Z0\nG[work] X[h] Y[v]\nEnd\nSubStart\nO[sub]\nEnd\nSubEnd\nM99\nEnd\nSubCall\nG[work] M98 P[sub]\nEnd";
    let text = job("{\"call\":{\"sub\":1,\"at\":[1,1],\"work\":55}}")
        .replace("\"operations\"", "\"subprograms\":[{\"number\":1,\"path\":[{\"rapid\":[0,0,1]}]}],\"operations\"");
    let lines = program(&mill("", subs), &text);
    let at = lines.iter().position(|line| line == "G53 G0 Z0").unwrap_or_else(|| panic!("{lines:?}"));
    assert!(lines[at + 1].starts_with("G55 X1. Y1."), "{lines:?}");
}

/// On some controls, a block without an axis word makes no hole in a cycle. So each hole prints its position.
#[test]
fn a_hole_that_differs_in_its_clearance_has_its_place() {
    let drill = "Drill\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    let cycle = "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[1,1,0],{\"at\":[1,1,-0.5],\"depth\":0.5}]}}";
    let lines = path_lines("", drill, cycle);
    assert!(lines.contains(&"X1. Y1. R-.4".to_owned()), "{lines:?}");
}

/// If the format of a letter has too few digits for a feed, there is a warning.
#[test]
fn feeds_that_lose_digits_are_said() {
    let notes = |head: &str, feed: &str| {
        let text = job(&format!("{{\"line\":[1,0,1],\"feed\":{feed}}}"));
        let notes = support::render(&mill(head, ""), &text).unwrap().notes;
        notes.iter().map(|note| format!("{} {}", note.code.name(), note.message)).collect::<Vec<_>>()
    };
    assert_eq!(notes("F >4.>2", "0.0055"), ["PR025 [frate] is 0.00550, but prints as F0.01: +81.8 %"]);
    assert_eq!(notes("F >4.>4", "0.0055"), [""; 0]);
    assert_eq!(notes("F >4.>2", "1.004"), [""; 0]);
    // also for a word in a sequence
    let line = mill("F >4", "LineCode\nG1 X[h] F[frate]\nEnd");
    let rendered = support::render(&line, &job("{\"line\":[1,0,1],\"feed\":1.4}")).unwrap();
    assert_eq!(rendered.notes[0].code.name(), "PR025");
    // for the pitch of a tap, the limit is the tolerance of the proof
    let hole =
        |kind: &str| format!("{{\"cycle\":{{\"kind\":\"{kind}\",\"depth\":1,\"feed\":0.01905,\"points\":[[1,1,0]]}}}}");
    let notes = |kind: &str| support::render(&mill("F >4.>3", ""), &job(&hole(kind))).unwrap().notes;
    assert_eq!(notes("tap")[0].message, "[frate] is 0.01905, but prints as F0.019: -0.3 %");
    assert!(notes("drill").iter().all(|note| note.code.name() != "PR025"));
}

/// A right-handed tap in a subprogram must suit every caller. Either the caller's spindle turns clockwise, or the
/// subprogram sets the direction.
#[test]
fn a_tap_in_a_subprogram_needs_its_turn() {
    let tap = "{\"rapid\":[0,0,1]},{\"cycle\":{\"kind\":\"tap\",\"depth\":1,\"feed\":5,\"points\":[[0,0,0]]}}";
    let path = "{\"spindle\":{\"speed\":50,\"direction\":\"TURN\"}},{\"call\":{\"sub\":1}},{\"rapid\":[0,0,1]},{\"line\":[1,0,0]}";
    let form = mill("", &format!("{SUBS}\nTap\nG84 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel"));
    let called = |turn: &str, sub: &str| program(&form, &with_sub(sub, &path.replace("TURN", turn)));
    assert!(called("ccw", tap)[0].starts_with("PR033"), "{:?}", called("ccw", tap));
    assert!(called("cw", tap).contains(&"M98 P1".to_owned()), "{:?}", called("cw", tap));
    let own = format!("{{\"spindle\":{{\"speed\":50,\"direction\":\"cw\"}}}},{tap}");
    let lines = called("ccw", &own);
    let at = lines.iter().position(|line| line == "M98 P1").unwrap_or_else(|| panic!("{lines:?}"));
    assert!(lines[at + 1..].iter().any(|line| line.contains("M4")), "{lines:?}");
}

/// The T word of a lathe contains station and offset register.
#[test]
fn a_lathe_indexes_its_turret() {
    let text = |tool: &str| {
        format!(
            "{{\"postform\":1,\"program\":1,\"units\":\"inch\",\"machine\":\"lathe\",\"tools\":[{tool}],\"operations\":[{{\"tool\":101,\
             \"spindle\":{{\"speed\":500,\"direction\":\"cw\",\"max\":1000}},\"path\":[{{\"rapid\":[0.1,1]}}]}}]}}"
        )
    };
    for name in ["fanuc-lathe", "haas-lathe"] {
        for (number, registers, word) in
            [("1", "", "T0101"), ("1", ",\"length_offset\":12", "T0112"), ("12", "", "T1212"), ("101", "", "T0101")]
        {
            let job = text(&format!("{{\"number\":{number}{registers}}}"))
                .replace("\"tool\":101", &format!("\"tool\":{number}"));
            let lines = post(name, &job);
            assert!(lines.iter().any(|line| line.contains(word)), "{name} {number}: {lines:?}");
        }
    }
}

/// For an arc of nearly half a turn, a change of R by one last digit moves the centre much farther. The arc is printed
/// in parts for which R is exact enough.
#[test]
fn arcs_by_their_radius_stay_on_the_circle() {
    let head = "Units mm\nX->4.>3\nY->4.>3\nZ->4.>3\nR->4.>3\nCtrCode R";
    let arc = |degrees: f64, centre: [f64; 2], radius: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (x, y) = (centre[0] + radius * cos, centre[1] + radius * sin);
        let start = format!("{{\"line\":[{},{},1]}}", centre[0] + radius, centre[1]);
        let path = format!(
            "{start},{{\"arc\":{{\"to\":[{x},{y}],\"center\":[{},{}],\"direction\":\"ccw\"}}}}",
            centre[0], centre[1]
        );
        program(&mill(head, ""), &job(&path).replace("inch", "mm"))
    };
    for (degrees, radius) in [(179.94, 28.0), (179.5, 28.0005), (180.3, 13.3), (178.0, 400.0)] {
        let (mut at, mut arcs) = ([radius, 0.0], 0);
        for line in arc(degrees, [0.0, 0.0], radius) {
            let word = |letter: char| line.split(' ').find_map(|word| word.strip_prefix(letter)?.parse::<f64>().ok());
            let to = [word('X').unwrap_or(at[0]), word('Y').unwrap_or(at[1])];
            if let Some(r) = word('R') {
                // the control computes the centre from R and the chord, to the left of the chord
                let chord = (to[0] - at[0]).hypot(to[1] - at[1]);
                let height = (r * r - chord * chord / 4.0).sqrt() * r.signum();
                let centre = [
                    (at[0] + to[0]) / 2.0 - height * (to[1] - at[1]) / chord,
                    (at[1] + to[1]) / 2.0 + height * (to[0] - at[0]) / chord,
                ];
                assert!(centre[0].hypot(centre[1]) < 0.0051, "{degrees} {radius}: {line} turns about {centre:?}");
                arcs += 1;
            }
            at = to;
        }
        assert!(arcs >= 2, "{degrees} {radius}: {arcs} arcs");
    }
    // exactly half a turn stays one block
    assert_eq!(arc(180.0, [0.0, 0.0], 28.0).iter().filter(|line| line.contains('R')).count(), 1);
}

/// If the work offset and the angle change together, Index retracts the tool, and the tool then moves over the new
/// position.
#[test]
fn an_index_serves_a_new_work_offset() {
    let text = "{\"postform\":1,\"program\":7,\"units\":\"inch\",\"tools\":[{\"number\":1}],\"operations\":[{\"tool\":1,\"work\":54,\
        \"spindle\":{\"speed\":500,\"direction\":\"cw\"},\"feed\":5,\"path\":[{\"rapid\":[0,0,1,0]},{\"line\":[0,0,0,0]},{\"rapid\":[0,0,1,0]},\
        {\"work\":55},{\"rapid\":[2,3,1,90]},{\"line\":[2,3,0,90]}]}]}";
    let lines: Vec<_> =
        post("haas-4axis", text).iter().map(|line| line.split_once(' ').unwrap_or(("", line)).1.to_owned()).collect();
    let at = lines.iter().position(|line| line == "G55").unwrap_or_else(|| panic!("{lines:?}"));
    assert_eq!(lines[at..at + 6], ["G55", "G0 G53 Z0", "A90.", "X2. Y3.", "Z1.", "G1 Z0 F5."]);
}

/// If the job gives the height last, the tool moves down only at the last position, and does not move across at that height.
#[test]
fn a_tool_change_goes_down_at_the_last_place() {
    let path = |items: &str| job("@").replace("{\"rapid\":[0,0,1]},@", items);
    let items = "{\"rapid\":[0,0]},{\"rapid\":[5,5]},{\"rapid\":[null,null,0.1]},{\"line\":[5,5,-1]}";
    assert_eq!(program(&mill("", ""), &path(items))[3..], ["G0 G54 X5. Y5. Z.1", "G1 Z-1. F10.", "M30"]);
    let hole = "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[5,6,0]]}}";
    let lines = program(&mill("", ""), &path(&format!("{{\"rapid\":[1,1]}},{hole}")));
    assert_eq!(lines[3..5], ["G0 G54 X5. Y6. Z.1", "G1 Z-1. F5."]);
}

/// Values before the first move, and the blocks between these values, keep their order.
#[test]
fn values_before_the_first_move_keep_their_order() {
    let form = mill("", "BeginRow\nM[val1]\nEnd");
    let row = "{\"begin\":\"row\"},{\"end\":\"row\"}";
    let items = format!("{{\"set\":{{\"val1\":41}}}},{row},{{\"set\":{{\"val1\":42}}}},{{\"rapid\":[0,0,1]}},{row}");
    let text = job("@").replace("{\"rapid\":[0,0,1]},@", &items);
    let said: Vec<_> = program(&form, &text).into_iter().filter(|line| line.starts_with("M4")).collect();
    assert_eq!(said, ["M41", "M42"]);
}

const SUBS: &str = "SubStart\nO[sub]\nEnd\nSubEnd\nM99\nEnd\nSubCall\nM98 P[sub]\nEnd";

/// A job with one subprogram and this path of its operation.
fn with_sub(sub: &str, path: &str) -> String {
    job(path).replace("\"operations\"", &format!("\"subprograms\":[{{\"number\":1,\"path\":[{sub}]}}],\"operations\""))
}

/// The move to a call is a rapid, even if the form prints no motion code. The move of an Upon is a rapid, too.
#[test]
fn the_way_to_a_call_is_a_rapid() {
    let text = with_sub("{\"rapid\":[3,3,1]}", "{\"line\":[1,0,0]},{\"call\":{\"sub\":1,\"at\":[3,3]}}");
    let subs = SUBS.replace("M98", "X[h] Y[v]\nM98");
    let lines = program(&mill("", &subs), &text);
    let at = lines.iter().position(|line| line == "X3. Y3.").unwrap_or_else(|| panic!("{lines:?}"));
    assert_eq!(lines[at - 1], "G0");
    let upon = "Upon [work]\nG[work] X[h] Y[v]\nEnd";
    let lines = path_lines("", upon, "{\"line\":[1,0,1]},{\"work\":55},{\"rapid\":[5,5,1]}");
    assert_eq!(lines[1..3], ["G0", "G55 X5. Y5."]);
}

/// A stop in a subprogram also stops the caller's spindle. If the subprogram cuts after the stop, it must contain its
/// own spindle values.
#[test]
fn a_stop_in_a_subprogram_is_known_behind_its_call() {
    let path = "{\"call\":{\"sub\":1}},{\"rapid\":[0,0,1]},{\"line\":[1,0,0]}";
    let lines = program(&mill("", SUBS), &with_sub("{\"rapid\":[0,0,1]},{\"stop\":\"program\"}", path));
    let at = lines.iter().position(|line| line == "M98 P1").unwrap_or_else(|| panic!("{lines:?}"));
    assert_eq!(lines[at + 1], "S1000 M3");
    let cuts = "{\"rapid\":[0,0,1]},{\"stop\":\"program\"},{\"line\":[0,0,0],\"feed\":5}";
    assert!(program(&mill("", SUBS), &with_sub(cuts, path))[0].starts_with("PR033"));
    let own = format!("{{\"spindle\":{{\"speed\":9,\"direction\":\"cw\"}}}},{{\"coolant\":\"off\"}},{cuts}");
    let lines = program(&mill("", SUBS), &with_sub(&own, path));
    assert!(lines.windows(2).any(|pair| pair == ["M0", "S9 M3"]), "{lines:?}");
}

/// The T word of a lathe has two digits for the station and two for the register.
#[test]
fn a_turret_has_no_other_registers() {
    let text = |tool: &str, number: u32| {
        format!(
            "{{\"postform\":1,\"program\":1,\"units\":\"inch\",\"machine\":\"lathe\",\"tools\":[{tool}],\"operations\":[{{\"tool\":{number},\
             \"spindle\":{{\"speed\":500,\"direction\":\"cw\",\"max\":1000}},\"feed\":0.01,\"path\":[{{\"rapid\":[0.1,1]}}]}}]}}"
        )
    };
    for (tool, number) in [("{\"number\":1,\"length_offset\":101}", 1), ("{\"number\":101,\"length_offset\":11}", 101)]
    {
        assert!(post("fanuc-lathe", &text(tool, number))[0].starts_with("PR039"), "{tool}");
    }
    // the position of a new tool is unknown, so the tool can't begin with a cut
    for path in ["{\"line\":[-1,0.5]}", "{\"rapid\":[null,0.5]},{\"line\":[-1]}"] {
        let job = text("{\"number\":1}", 1).replace("{\"rapid\":[0.1,1]}", path);
        assert!(post("haas-lathe", &job)[0].starts_with("PR012"), "{path}");
    }
    // a new tool can't begin with a cut along an axis for which only the previous tool had a position
    let two = text("{\"number\":1},{\"number\":2}", 1);
    for path in ["{\"line\":[null,0.2]}", "{\"arc\":{\"to\":[null,0.2],\"radius\":0.3,\"direction\":\"cw\"}}"] {
        let second = format!(
            "}},{{\"tool\":2,\"spindle\":{{\"speed\":500,\"direction\":\"cw\",\"max\":1000}},\"feed\":0.01,\"path\":[{{\"rapid\":[null,0.5]}},{path}]}}]}}"
        );
        let job = format!("{}{second}", two.strip_suffix("}]}").unwrap());
        assert!(post("haas-lathe", &job)[0].starts_with("P"), "{path}: {:?}", post("haas-lathe", &job));
    }
    let bore = "{\"rapid\":[0.1,0]},{\"cycle\":{\"kind\":\"bore\",\"depth\":1,\"clear\":0.1,\"orient\":0,\"offset\":0.02,\"feed\":0.01,\"points\":[[0,0]]}}";
    let job = text("{\"number\":1}", 1).replace("{\"rapid\":[0.1,1]}", bore);
    assert!(post("haas-lathe", &job)[0].starts_with("PR006"), "{:?}", post("haas-lathe", &job));
}

/// After a macro or an undefined code, all positions are unknown.
#[test]
fn after_a_macro_the_place_is_said_again() {
    let lines = |head: &str, line: &str| {
        let change = format!("X[h] Y[v] Z[d]\n{line}\nEnd\nToolChange");
        program(&mill(head, "").replace("X[h] Y[v] Z[d]\nEnd\nToolChange", &change), &job("{\"line\":[0,0,0]}"))
    };
    let again = |head: &str, line: &str| lines(head, line).iter().any(|line| line == "G0 X0 Y0 Z1.");
    for line in ["G65 P9010", "M98 P9010", "G154 P2", "G110", "G254", "G68.2 P1", "G16", "G51.1 P1", "G199"] {
        assert!(again("Control haas", line), "{line}: {:?}", lines("Control haas", line));
    }
    for (head, line) in
        [("Control haas", "G187 P1"), ("Control haas", "G64"), ("Control haas", "G4 P1"), ("Control fanuc", "G5.1 Q1")]
    {
        assert!(!again(head, line), "{line}: {:?}", lines(head, line));
    }
}

/// The effect of a code that the control's file lacks is unknown: the next block prints its motion code again, even if
/// the unknown code was in a block with axis words.
#[test]
fn after_an_unknown_code_the_motion_is_said_again() {
    for code in ["G6", "G6 X[h]", "G199 X[h]"] {
        let change = format!("G0 X[h] Y[v] Z[d]\n{code}\nEnd\nToolChange");
        let form = mill("Control haas", "").replace("X[h] Y[v] Z[d]\nEnd\nToolChange", &change);
        let lines = program(&form, &job("{\"rapid\":[0,0,0]}"));
        assert!(lines.iter().any(|line| line == "G0 X0 Y0 Z1."), "{code}: {lines:?}");
    }
}

/// If an axis is reversed, the centres and directions of its arcs must be reversed too.
#[test]
fn reversed_axes_reverse_their_arcs() {
    let arc = "{\"arc\":{\"to\":[2,0],\"center\":[1,0.5],\"direction\":\"ccw\"}}";
    assert!(path_lines("RevSigns X", "", arc)[0].starts_with("PR036"));
    assert!(path_lines("RevSigns X I", "", arc)[0].starts_with("PR036"));
    assert_eq!(path_lines("RevSigns X I\nCW G3\nCCW G2", "", arc), ["G17 G2 X-2. I-1. J.5 F10."]);
    // a control that measures from the centre to the start of the arc
    assert_eq!(path_lines("RevSigns I J", "", arc), ["G17 G3 X2. I-1. J-.5 F10."]);
    let own = "CcwCode\nG3 X[h] Y[v] I[ival] J[jval] F[frate]\nEnd";
    assert!(path_lines("RevSigns X I", own, arc)[0].starts_with("PR036"));
}

/// If the upper wire guide moves during an arc of the lower guide, the arc is printed as lines, not as a helix.
#[test]
fn an_arc_of_one_guide_is_printed_as_lines() {
    let text = "{\"postform\":1,\"program\":7,\"units\":\"mm\",\"machine\":\"edm\",\"operations\":[{\"work\":54,\"feed\":3,\"path\":[\
        {\"rapid\":[0,0,0,0]},{\"arc\":{\"to\":[10,10,8,0],\"center\":[0,10],\"direction\":\"ccw\"}}]}]}";
    let lines = post("wire-edm", text);
    assert!(lines.len() > 5 && lines.iter().all(|line| !line.contains("G3")), "{lines:?}");
}

/// Increments in a sequence are differences of printed positions, as in generated blocks, so they add up exactly.
#[test]
fn increments_of_a_sequence_add_up() {
    let line = "LineCode\nG1 X[hdist] Y[vdist] Z[ddist] F[frate]\nEnd";
    let sum = |step: f64, count: u32| {
        let path: Vec<_> = (1..=count).map(|i| format!("{{\"line\":[{:.5},0,1]}}", step * f64::from(i))).collect();
        let lines = path_lines("X->4.>3\nIncremental? Y", line, &path.join(","));
        let words = lines.iter().flat_map(|line| line.split(' '));
        words.filter_map(|word| word.strip_prefix('X')?.parse::<f64>().ok()).sum::<f64>()
    };
    assert!((sum(0.0004, 2000) - 0.8).abs() < 1e-6, "{}", sum(0.0004, 2000));
    assert!((sum(0.03333, 6) - 0.2).abs() < 1e-6, "{}", sum(0.03333, 6));
}

const HOLES: &str = "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":";

/// If Cancel stops the spindle between two holes, the spindle is started again before the next hole.
#[test]
fn a_cancel_between_holes_leaves_the_spindle_turning() {
    let drill = "Drill\nG0 X[h] Y[v]\nG98 G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    let form = mill("", drill).replace("Cancel\nG80\nEnd", "Cancel\nG80\nM5\nEnd");
    let lines = program(&form, &job(&format!("{HOLES}[[1,1,0],[2,1,3]]}}}}")));
    let (stop, hole) = (lines.iter().position(|l| l == "M5"), lines.iter().rposition(|l| l.contains("G81")));
    assert!(lines[stop.unwrap()..hole.unwrap()].iter().any(|line| line.ends_with("M3")), "{lines:?}");
}

/// If the counted first lines of a cycle only set up the cycle, the other lines drill the first hole, too.
#[test]
fn a_cycle_that_waits_for_its_holes_drills_the_first() {
    let first_hole = |first: &str| {
        let form = format!("Drill 1\nG98 G81 X[h] Y[v] Z[d] R[vclear] F[frate]{first}\nX[h] Y[v]\nEnd Cancel");
        let lines = path_lines("", &form, &format!("{HOLES}[[1,1,0],[2,1,0]]}}}}"));
        lines.contains(&"X1. Y1.".to_owned())
    };
    assert!(first_hole(" K0") && first_hole(" L0") && !first_hole(""));
}

/// Increments after a cycle need a known height; otherwise they are an error.
#[test]
fn no_increment_from_a_height_that_nobody_knows() {
    let drill = "Drill\nG90\nG98 G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    let form = mill("Incremental? Y", drill)
        .replace("Cancel\nG80\nEnd", "Cancel\nG80 G91\nEnd")
        .replace("G0 G[work] X[h] Y[v] Z[d]", "G90 G0 G[work] X[h] Y[v] Z[d]\nG91");
    let path = format!("{{\"rapid\":[0,0,4]}},{HOLES}[[1,1,0]],\"return\":2}}}},{{\"line\":[3,1,-0.5]}}");
    assert!(program(&form, &job(&path))[0].starts_with("PR001 an increment of Z"));
    // with G99 the tool is at the clearance
    let lines = program(&form.replace("G98", "G99"), &job(&path));
    assert_eq!(lines[lines.len() - 4..lines.len() - 1], ["G80 G91", "G0 Z1.9", "G1 X2. Z-2.5 F10."]);
}

/// A sequence that contains the code of one plane is not used for an arc in another plane.
#[test]
fn an_arc_of_another_plane_is_not_printed_in_the_sequences_own() {
    let arc =
        "{\"line\":[0,0,0]},{\"arc\":{\"to\":[0,1,1],\"center\":[null,0,1],\"direction\":\"cw\",\"plane\":\"yz\"}}";
    for centre in ["I[ival] J[jval] K[kval]", "R[arcrad]"] {
        let lines = path_lines("", &format!("CwCode\nG17 G2 X[h] Y[v] Z[d] {centre} F[frate]\nEnd"), arc);
        assert!(lines.len() > 4 && lines.iter().all(|line| !line.contains("G2")), "{lines:?}");
    }
}

/// The default work offset of a job is converted to the form's own numbers.
#[test]
fn the_default_offset_is_counted_as_the_form_counts() {
    let form = mill("Work 1", "").replace("G0 G[work]", "G15 H[work]\nG0");
    let lines = program(&form, &job("{\"line\":[1,0,1]}").replace("\"work\":54,", ""));
    assert_eq!(lines[3], "G15 H1");
}

/// After an Index, the tool moves to the hole first across and then down. The part does not turn while the tool is low.
#[test]
fn a_hole_behind_an_index_is_reached_across_first() {
    let form = "Index\nG0 G53 Z0\nA[rotangle]\nEnd\nDrill\nG98 G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    let cycle = format!("{HOLES}[[1,1,0,90],[4,2,0,180]]}}}}");
    let lines = path_lines("", form, &cycle);
    let at = lines.iter().rposition(|line| line == "A180.").unwrap_or_else(|| panic!("{lines:?}"));
    assert_eq!(lines[at + 1..at + 3], ["G0 X4. Y2.", "Z.1"]);
    let low = form.replace("G0 G53 Z0\nA", "G0 A");
    let lines = path_lines("", &low, &format!("{{\"line\":[1,1,-0.1]}},{cycle}"));
    let turn = lines.iter().position(|line| line.ends_with("A90.")).unwrap_or_else(|| panic!("{lines:?}"));
    assert!(lines[..turn].iter().any(|line| line.ends_with("Z.1")), "{lines:?}");
}

/// The move to a hole is a rapid, even if an emulated cycle begins without a motion code.
#[test]
fn the_way_to_an_emulated_hole_is_a_rapid() {
    let drill = "Drill\nX[h] Y[v]\nZ[vclear]\nG1 Z[d] F[frate]\nG0 Z[rplane]\nEnd";
    let lines = path_lines("", drill, &format!("{{\"line\":[0.5,0,1]}},{HOLES}[[1,1,0],[2,1,0]]}}}}"));
    assert_eq!(lines[1..3], ["G0", "X1. Y1."], "{lines:?}");
}

/// If the format of a dwell's letter has too few digits, there is a warning.
#[test]
fn dwells_that_lose_digits_are_said() {
    let dwell = |head: &str, seconds: &str| path_lines(head, "", &format!("{{\"dwell\":{seconds}}}"));
    assert!(dwell("P >4", "0.4")[0].starts_with("PR002 [dwell] is 0.4, but prints as 0"), "{:?}", dwell("P >4", "0.4"));
    assert_eq!(dwell("P >4.>1", "0.4"), ["G4 P.4"]);
}

/// An arc whose radii differ only by the form's rounding is printed as lines, with a note. A wrong centre is an error.
#[test]
fn arcs_in_coarse_digits_are_lines() {
    let path = "{\"line\":[-0.28491,0.37034,1]},{\"arc\":{\"to\":[-0.65683,2.01101],\"center\":[-1.1415,1.03865],\"direction\":\"ccw\"}}";
    let coarse = support::render(&mill("X->4.>3\nY->4.>3\nI->4.>3\nJ->4.>3", ""), &job(path)).unwrap();
    assert!(!coarse.text.contains("G3") && coarse.notes[0].code.name() == "PR024", "{coarse:?}");
    assert!(support::render(&mill("", ""), &job(path)).unwrap().text.contains("G3"));
    assert!(path_lines("", "", &path.replace("1.03865", "1.05"))[0].starts_with("PR005"));
}

/// A position before a change of the work offset belongs to the previous offset.
#[test]
fn places_belong_to_the_offset_in_which_they_are_told() {
    let items = "{\"rapid\":[20,20]},{\"work\":55},{\"rapid\":[null,null,5]},{\"line\":[20,20,0]}";
    let second = format!("{{\"tool\":1,\"work\":54,\"feed\":10,\"path\":[{items}]}}]}}");
    let text = job("{\"line\":[0,0,0]}");
    let text = format!("{},{second}", &text[..text.len() - 2]);
    let lines = program(&mill("", ""), &text);
    let at = lines.iter().position(|line| line.starts_with("G0 X20. Y20.")).unwrap_or_else(|| panic!("{lines:?}"));
    assert_eq!(lines[at + 1], "G55", "{lines:?}");
}

/// G90 is not a motion code, so the move to an emulated hole also needs G0.
#[test]
fn the_way_to_an_emulated_hole_is_a_rapid_behind_g90() {
    let drill = "Drill\nG90 X[h] Y[v] Z[vclear]\nG1 Z[d] F[frate]\nG0 Z[rplane]\nEnd";
    let lines = path_lines("", drill, &format!("{{\"line\":[0.5,0,1]}},{HOLES}[[1,1,0]]}}}}"));
    assert_eq!(lines[1..3], ["G0", "G90 X1. Y1. Z.1"], "{lines:?}");
}

/// A wire with a tool definition can cut at an angle from its first cut on.
#[test]
fn a_wire_tapers_from_its_first_cut() {
    let text = "{\"postform\":1,\"program\":7,\"units\":\"mm\",\"machine\":\"edm\",\"tools\":[{\"number\":1}],\"operations\":[{\"tool\":1,\
        \"work\":54,\"feed\":3,\"path\":[{\"rapid\":[0,0]},{\"line\":[5,10,4.5,10]}]}]}";
    assert!(post("wire-edm", text).len() > 4, "{:?}", post("wire-edm", text));
}

/// If a part of the path leaves G91 active, later axis words are an error, unless a G90 comes before them.
#[test]
fn increments_left_on_are_ended_by_the_sequence_itself() {
    let row = "{\"begin\":\"row\"},{\"end\":\"row\"}";
    let lines = |end: &str| {
        program(&mill("", "EndRow\nG91\nEnd").replace("EndCode\n", &format!("EndCode\n{end}\n")), &job(row))
    };
    assert!(lines("G0 G53 Z0")[0].starts_with("PR040"), "{:?}", lines("G0 G53 Z0"));
    assert!(lines("G90 G0 G53 Z0").contains(&"M30".to_owned()) && lines("M9").contains(&"M30".to_owned()));
}

/// If an Upon makes a part of a cut, it moves at feed, never at rapid into the part.
#[test]
fn an_upon_of_a_cut_cuts() {
    let path = "{\"line\":[1,0,0]},{\"line\":[2,0,-1]},{\"line\":[3,0,-1]}";
    let lines = path_lines("", "Upon [d]\nZ[d] F[frate]\nEnd", path);
    assert_eq!(lines, ["G1 F10.", "Z0 F10.", "X1.", "Z-1. F10.", "X2.", "X3."]);
}

/// A macro with arguments named like axes may still move to any position.
#[test]
fn the_arguments_of_a_macro_are_no_position() {
    let lines = |line: &str| {
        let change = format!("X[h] Y[v] Z[d]\n{line}\nEnd\nToolChange");
        program(&mill("", "").replace("X[h] Y[v] Z[d]\nEnd\nToolChange", &change), &job("{\"line\":[0,0,0]}"))
    };
    for line in ["G65 P9010 X1. Y2.", "G65 P9010 Z2.", "G66 P9010 X2."] {
        assert!(lines(line).iter().any(|line| line == "G0 X0 Y0 Z1."), "{line}: {:?}", lines(line));
    }
    // a macro may leave any motion, feed mode, speed and work offset active
    let row = "{\"line\":[1,0,0]},{\"begin\":\"row\"},{\"line\":[2,0,0]},{\"end\":\"row\"}";
    assert_eq!(path_lines("", "BeginRow\nG65 P9010\nEnd", row)[2..], ["G54", "S1000 M3", "G94", "G1 X2. Y0 Z0 F10."]);
}

/// The move to a call and the move of an Upon are rapids, also after another call, after a text, and after a cycle.
#[test]
fn the_way_to_a_call_is_a_rapid_whatever_came_before() {
    let subs = SUBS.replace("M98", "X[h] Y[v]\nM98");
    let cuts = "{\"rapid\":[0,0,1]},{\"line\":[0,0,-1],\"feed\":5}";
    let before = |lines: &[String], way: &str| {
        let at = lines.iter().rposition(|line| line == way).unwrap_or_else(|| panic!("{lines:?}"));
        lines[at - 1].clone()
    };
    let calls = "{\"call\":{\"sub\":1,\"at\":[3,3]}},{\"call\":{\"sub\":1,\"at\":[4,4]}},{\"rapid\":[0,0,1]}";
    assert_eq!(before(&program(&mill("", &subs), &with_sub(cuts, calls)), "X4. Y4."), "G0");
    // the first run begins at the position of the call; the next run begins at the end position of the first run
    let times = "{\"call\":{\"sub\":1,\"at\":[4,4],\"times\":2}},{\"rapid\":[0,0,1]}";
    let lines = program(&mill("", &subs), &with_sub(cuts, times));
    let at = lines.iter().position(|line| line == "M98 P1").unwrap();
    assert_eq!(lines[at - 1..at + 4], ["X4. Y4.", "M98 P1", "G0", "X0 Y0", "M98 P1"]);
    let from = |end: &str| {
        let calls = "{\"rapid\":[0,0,1]},{\"call\":{\"sub\":1,\"times\":2}},{\"rapid\":[0,0,1]}";
        program(&mill("", &subs), &with_sub(&format!("{cuts},{end}"), calls))
    };
    assert_eq!(from("{\"rapid\":[0,0,1]}").iter().filter(|line| *line == "M98 P1").count(), 2);
    assert_eq!(from("{\"rapid\":[2,0,1]}").iter().filter(|line| *line == "X2. Y0").count(), 1);
    assert!(from("{\"work\":56},{\"rapid\":[2,0,1]}")[0].starts_with("PR033"));
    let text = "{\"text\":\"G1 Z-1. F5.\"},{\"call\":{\"sub\":1,\"at\":[4,4]}},{\"rapid\":[0,0,1]}";
    assert_eq!(before(&program(&mill("", &subs), &with_sub(cuts, text)), "X4. Y4."), "G0");
    let upon = format!("{SUBS}\nUpon [work]\nG[work] X[h] Y[v]\nEnd");
    let path = "{\"call\":{\"sub\":1}},{\"work\":55},{\"rapid\":[5,5,1]}";
    assert_eq!(before(&program(&mill("", &upon), &with_sub(cuts, path)), "G55 X5. Y5."), "G0");
}

/// If a subprogram contains a stop, each of its runs begins in the same state. After the stop, a cut needs spindle and
/// coolant; a rapid does not.
#[test]
fn a_stop_in_a_subprogram_is_one_for_its_next_run() {
    let cut = "{\"rapid\":[0,0,1]},{\"line\":[0,0,-1],\"feed\":5},{\"rapid\":[0,0,1]},{\"stop\":\"program\"}";
    let path = "{\"call\":{\"sub\":1,\"times\":2}},{\"rapid\":[0,0,1]}";
    for call in ["M98 P[sub]", "M98 P[sub] L[times]"] {
        let lines = program(&mill("", &SUBS.replace("M98 P[sub]", call)), &with_sub(cut, path));
        let calls: Vec<_> = (0..lines.len()).filter(|&i| lines[i].starts_with("M98")).collect();
        assert_eq!(calls.len(), 2, "{lines:?}");
        assert_eq!(lines[calls[0] + 1], "S1000 M3", "{lines:?}");
    }
    let dry = format!("{{\"spindle\":{{\"speed\":9,\"direction\":\"cw\"}}}},{cut},{{\"line\":[0,0,-1]}}");
    assert!(program(&mill("", SUBS), &with_sub(&dry, path))[0].starts_with("PR033"));
    let away = format!("{cut},{{\"rapid\":[9,9,1]}}");
    assert!(program(&mill("", SUBS), &with_sub(&away, path)).contains(&"X9. Y9.".to_owned()));
    let on = format!("{away},{{\"line\":[9,9,0]}}");
    assert!(program(&mill("", SUBS), &with_sub(&on, path))[0].starts_with("PR033"));
}

/// If a subprogram ends with the tool low, the tool moves up before it moves across.
#[test]
fn behind_a_call_the_tool_goes_up_before_it_crosses() {
    let low = "{\"rapid\":[0,0,1]},{\"line\":[0,0,-1],\"feed\":5}";
    let lines = program(&mill("", SUBS), &with_sub(low, &format!("{{\"call\":{{\"sub\":1}}}},{HOLES}[[5,5,0]]}}}}")));
    let at = lines.iter().position(|line| line == "M98 P1").unwrap_or_else(|| panic!("{lines:?}"));
    assert_eq!(lines[at + 1..at + 3], ["G0 Z.1", "X5. Y5."]);
    let path = "{\"call\":{\"sub\":1}},{\"rapid\":[5,5,1]}";
    let lines = program(&mill("VRapid G0", SUBS), &with_sub(low, path));
    assert_eq!(lines[at + 1..at + 3], ["G0 Z1.", "X5. Y5."], "{lines:?}");
}

/// With a reversed axis, the compensation side must be reversed too, and the form's own arc sequences are checked like generated arcs.
#[test]
fn reversed_axes_reverse_sides_and_sequences() {
    let infeed = "{\"infeed\":[1,1],\"side\":\"left\"},{\"outfeed\":[3,1]}";
    let head = "RevSigns X I\nCW G3\nCCW G2";
    assert!(path_lines(head, "", infeed)[0].starts_with("PR036"));
    assert_eq!(path_lines(&format!("{head}\nCDC 42 41 40"), "", infeed)[0], "G1 G42 X-1. Y1. D21 F10.");
    let arc = "{\"arc\":{\"to\":[2,0],\"center\":[1,0.5],\"direction\":\"ccw\"}}";
    let own = |code: &str| format!("CcwCode\n{code} X[h] Y[v] I[ival] J[jval] F[frate]\nEnd");
    assert!(path_lines("RevSigns X", &own("G2"), arc)[0].starts_with("PR036"));
    assert!(path_lines("RevSigns X I", &own("G3"), arc)[0].starts_with("PR036"));
    assert_eq!(path_lines("RevSigns X I", &own("G2"), arc), ["G2 X-2. I-1. J.5 F10."]);
    let yz = "{\"arc\":{\"to\":[0,2,1],\"center\":[null,1,1],\"direction\":\"ccw\",\"plane\":\"yz\"}}";
    assert!(path_lines(head, "", yz)[0].starts_with("PR036"));
    // controls that measure from the centre to the start
    assert_eq!(path_lines("RevSigns I J", "", arc), ["G17 G3 X2. I-1. J-.5 F10."]);
}

/// G99 leaves the tool at the clearance, from which increments can start.
#[test]
fn increments_count_from_a_height_that_is_certain() {
    for drill in [
        "Drill\nG90\nG[retplane] G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel",
        "Drill\nG90 G99 G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel",
    ] {
        let form = mill("Incremental? Y", drill)
            .replace("Cancel\nG80\nEnd", "Cancel\nG80 G91\nEnd")
            .replace("G0 G[work] X[h] Y[v] Z[d]", "G90 G0 G[work] X[h] Y[v] Z[d]\nG91");
        let path = format!("{HOLES}[[1,1,0]]}}}},{{\"line\":[3,1,-0.5]}}");
        let lines = program(&form, &job(&path));
        assert_eq!(lines[lines.len() - 2], "G1 X2. Z-.6 F10.", "{lines:?}");
    }
}

/// A sequence of moves without a motion code must not continue an arc that came before.
#[test]
fn a_part_behind_an_arc_is_no_arc() {
    let arc = "{\"arc\":{\"to\":[2,0],\"center\":[1,0],\"direction\":\"ccw\"}}";
    let path = format!("{arc},{{\"begin\":\"row\"}},{{\"line\":[3,0,1]}},{{\"end\":\"row\"}}");
    let lines = path_lines("", "BeginRow\nX[h] Y[v]\nEnd", &path);
    assert_eq!(lines[1..3], ["G1", "X2. Y0"], "{lines:?}");
}

/// For a turret on the other side, the angles of an arc are mirrored. A thread begins at the end of the rapid before it.
#[test]
fn a_mirrored_turret_has_mirrored_angles() {
    let lathe = |head: &str, seqs: &str| {
        format!(
            "Machine Lathe\n{head}\nStartCode\n%0\nEnd\n1stToolChange\nT[comp]\nG97 S[speed] M[direct]\nG0 X[v] Z[h]\nEnd\n\
                 ToolChange\nT[comp]\nEnd\nEndCode\nM30\nEnd\n{seqs}\n"
        )
    };
    let text = |turret: u32, path: &str| {
        format!(
            "{{\"postform\":1,\"program\":1,\"units\":\"inch\",\"machine\":\"lathe\",\"tools\":[{{\"number\":2,\"turret\":{turret}}}],\
                 \"operations\":[{{\"tool\":2,\"spindle\":{{\"speed\":500,\"direction\":\"cw\"}},\"feed\":5,\"path\":[{path}]}}]}}"
        )
    };
    let own = "CcwCode\nG3 X[v] Z[h] A[startang] B[endang] C[sweep] I[jval] K[ival] F[frate]\nEnd\nCwCode\nG2 X[v] Z[h] A[startang] B[endang] C[sweep] I[jval] K[ival] F[frate]\nEnd";
    let arc = "{\"rapid\":[-1,0.375]},{\"arc\":{\"to\":[-1.125,0.5],\"center\":[-1.125,0.375],\"direction\":\"ccw\"}}";
    let said = |turret| {
        program(&lathe("RevTurret2? Y", own), &text(turret, arc)).into_iter().find(|line| line.contains("A0")).unwrap()
    };
    assert!(said(1).contains("B90. C90."), "{}", said(1));
    assert!(said(2).contains("B270. C-90."), "{}", said(2));
    let thread = "{\"rapid\":[null,0.6]},{\"thread\":{\"from\":[0.2,0.5],\"to\":[-0.9],\"pitch\":0.0625,\"depth\":0.0383,\"passes\":2}}";
    let lines = program(&lathe("Thread G33\nThreadPasses full", ""), &text(1, thread));
    assert!(lines.iter().any(|line| line.starts_with("G0 X1.2 Z.2")), "{lines:?}");
}

/// Rapids of a new tool before a change of the work offset are skipped. The tool change moves directly to the position
/// in the new offset.
#[test]
fn ways_before_another_offset_are_those_of_the_tool_change() {
    let items = "{\"rapid\":[1,1]},{\"work\":55},{\"rapid\":[2,2,1]},{\"line\":[2,2,0]}";
    let lines = program(&mill("", ""), &job("@").replace("{\"rapid\":[0,0,1]},@", items));
    assert_eq!(lines[3..], ["G0 G55 X2. Y2. Z1.", "G1 Z0 F10.", "M30"]);
}

/// A rigid tap turns the spindle in both directions without a code, so the direction is printed again before the next
/// cut.
#[test]
fn after_a_tap_against_the_spindle_its_direction_is_said() {
    let rigid = "Tap\nM29\nG[retplane] G84 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    let path = "{\"spindle\":{\"direction\":\"ccw\"}},{\"rapid\":[0,0,2]},\
        {\"cycle\":{\"kind\":\"tap\",\"rigid\":true,\"depth\":0.8,\"clear\":0.1,\"feed\":9,\"points\":[[0,1,0]]}},\
        {\"spindle\":{\"direction\":\"cw\"}},{\"rapid\":[1,1,0.1]},{\"line\":[1,1,-0.2]}";
    let lines = program(&mill("RigidTap? Y", rigid), &job(path));
    let tap = lines.iter().position(|line| line.contains("G84")).unwrap();
    let cut = lines.iter().rposition(|line| line.starts_with("G1")).unwrap();
    assert!(lines[tap..cut].iter().any(|line| line.contains("M3")), "{lines:?}");
}

/// If the form prints no return plane, the tool is lower after a cycle than in the job. The tool moves up before the
/// next rapid in X and Y.
#[test]
fn a_rapid_after_a_hole_is_as_high_as_the_jobs() {
    let form = support::check_file(&root().join("tests/data/forms/no-return-plane.pf"));
    let printed = |path: &str| {
        let job = job(path);
        let rendered = support::render_checked(&form, job.as_bytes(), false, Default::default()).unwrap();
        let lines: Vec<String> =
            rendered.text.lines().map(|line| line.split_once(' ').map_or("", |it| it.1).into()).collect();
        let drilled = lines.iter().position(|line| line.contains("G81")).unwrap();
        lines[drilled + 1..].iter().take_while(|line| *line != "M9").cloned().collect::<Vec<String>>()
    };
    let drill = |x: f64, returns: &str| {
        format!(r#"{{"cycle":{{"kind":"drill","depth":0.5,"clear":0.1,{returns}"feed":5,"points":[[{x},1,0]]}}}}"#)
    };
    let high = drill(1.0, r#""return":2,"#);
    assert_eq!(printed(&format!("{high},{{\"rapid\":[5,5]}}")), ["G80", "G0 Z2.", "X5. Y5."]);
    assert_eq!(printed(&format!("{high},{}", drill(3.0, "")))[..3], ["G80", "G0 Z2.", "X3."]);
    // a rapid straight up needs only one block
    assert_eq!(printed(&format!("{high},{{\"rapid\":[1,1,3]}}")), ["G80", "G0 Z3."]);
}

/// Without a return plane, the tool returns to the clearance of each hole.
#[test]
fn each_hole_has_its_own_clearance() {
    let points = "[1,1,0],[2,1,-0.5],[3,1,0.25]";
    let cycle = format!(
        r#"{{"cycle":{{"kind":"drill","depth":0.5,"clear":0.1,"feed":5,"emulate":true,"points":[{points}]}}}}"#
    );
    let lines = path_lines("", "", &cycle);
    let heights: Vec<&String> = lines.iter().filter(|line| line.starts_with('Z') || line.starts_with("G0 Z")).collect();
    assert_eq!(heights, ["Z.1", "G0 Z.1", "Z-.4", "G0 Z-.4", "Z.35", "G0 Z.35"], "{lines:?}");
}

/// The last start of a thread begins lower, and the control returns to this lower height. So the tool moves up before
/// it moves across or stops.
#[test]
fn the_last_start_of_a_thread_goes_up() {
    let taps = |after: &str| {
        let tap = r#"{"rapid":[0,0,2]},{"cycle":{"kind":"tap","rigid":true,"starts":2,"depth":0.5,"clear":0.25,"feed":100,"points":[[0,1,0],[2,1,0]]}}"#;
        post("fanuc", &job(&format!("{tap}{after}")))
    };
    for after in ["", r#",{"stop":"optional"}"#] {
        let lines = taps(after);
        let cycles: Vec<usize> = (0..lines.len()).filter(|&at| lines[at].contains(" R.2")).collect();
        assert!(cycles.len() == 4, "{lines:?}");
        for last in [cycles[1], cycles[3]] {
            assert!(lines[last + 1].ends_with("G80") && lines[last + 2].ends_with("G0 Z.25"), "{lines:?}");
        }
    }
}

/// If the control does not turn the spindle for a rigid tap, the spindle is started in the tap's direction before the
/// tap.
#[test]
fn a_tap_by_g33_1_turns_the_spindle_its_way() {
    let path = r#"{"spindle":{"direction":"ccw"}},{"rapid":[0,0,2]},{"cycle":{"kind":"tap","rigid":true,"depth":0.8,"clear":0.1,"feed":9,"points":[[0,1,0]]}}"#;
    let lines = post("linuxcnc", &job(path));
    let tap = lines.iter().position(|line| line.contains("G33.1")).unwrap();
    assert!(lines[tap - 1].contains("M3"), "{lines:?}");
}
