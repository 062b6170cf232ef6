//! Programs that once came out wrong without a word, each with the block that must stand in it.

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

/// Whoever prints the stop: a cycle, the job's text, a sequence of the form. The next cut finds the spindle turning.
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
    // what the sequence itself says after its stop is not said twice
    let own = "BeginRow\nM0\nS[speed] M[direct]\nEnd";
    assert_eq!(path_lines("", own, row), ["M0", "S1000 M3", "G1 X1. F10."]);
    // what the job itself has switched off stays off
    let off = "{\"text\":\"M5\"},{\"text\":\"M0\"},{\"rapid\":[1,0,1]}";
    assert_eq!(path_lines("", "", off), ["M5", "M0", "G0 X1. Y0 Z1."]);
}

/// A sequence of moves that prints no motion code is a cut, whatever came before it.
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
    // an arc can't be a block of its own; a form without G codes has none to say
    let arc = "{\"arc\":{\"to\":[1,1],\"center\":[0,1],\"direction\":\"ccw\"}}";
    let lines = path_lines("", "CcwCode\nX[h] Y[v] I[ival] J[jval] F[frate]\nEnd", arc);
    assert_eq!(lines, ["PR017 the sequence prints no G3, and the control is in another motion"]);
    let klartext = mill("", &format!("{}\n{}", rapid.replace('X', "L X"), line.replace('X', "L X")));
    let lines = program(&klartext.replace("G0 G[work]", "G[work]"), &job("{\"line\":[1,0,1]}"));
    assert_eq!(lines[lines.len() - 2], "L X1. F10.");
}

/// A torch that the form switches, and a laser whose moves say their power: no block of the spindle stands between.
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

/// Values at the head of an operation are those of its tool change, also as a key of the operation.
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

/// The height first and then the place, or the other way: the tool change waits for both.
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
    // the height of a rapid, over the first hole
    let items = "{\"rapid\":[null,null,2]},{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[5,6,0]]}}";
    assert_eq!(program(&mill("", ""), &path(items))[3..5], ["G0 G54 X5. Y6. Z2.", "G0 Z.1"]);
    // without a place at all it is as it was
    let items = "{\"rapid\":[null,null,2]},{\"line\":[5,6,0]}";
    assert!(program(&mill("", ""), &path(items))[0].starts_with("PR001 [h] has no value here"));
}

/// A fixture's number or its code: the form's word says neither 54 as a number nor a number that nobody has.
#[test]
fn work_offsets_are_counted_as_the_form_counts() {
    let form = mill("Work 1", "").replace("G0 G[work]", "G15 H[work]\nG0");
    let line = |work: &str| program(&form, &job("{\"line\":[1,0,1]}").replace("\"work\":54", work))[3].clone();
    assert_eq!(line("\"work\":54"), "G15 H1");
    assert_eq!(line("\"work\":56"), "G15 H3");
    assert_eq!(line("\"work\":3"), "G15 H3");
    let error = program(&form, &job("{\"line\":[1,0,1]}").replace("\"work\":54", "\"work\":59.1"));
    assert_eq!(error, ["PR017 the work offset 59.1 is a code, and this form counts its offsets from 1"]);
}

/// A call in another work offset uses it: what an Upon does before it is not left out.
#[test]
fn a_call_in_another_work_offset_goes_up_first() {
    let subs = "Upon [work]\nG53 G0 Z0\nG[work] X[h] Y[v]\nEnd\nSubStart\nO[sub]\nEnd\nSubEnd\nM99\nEnd\nSubCall\nG[work] M98 P[sub]\nEnd";
    let text = job("{\"call\":{\"sub\":1,\"at\":[1,1],\"work\":55}}")
        .replace("\"operations\"", "\"subprograms\":[{\"number\":1,\"path\":[{\"rapid\":[0,0,1]}]}],\"operations\"");
    let lines = program(&mill("", subs), &text);
    let at = lines.iter().position(|line| line == "G53 G0 Z0").unwrap_or_else(|| panic!("{lines:?}"));
    assert!(lines[at + 1].starts_with("G55 X1. Y1."), "{lines:?}");
}

/// A block of a control's cycle without an axis word drills on no control, or only on some.
#[test]
fn a_hole_that_differs_in_its_clearance_has_its_place() {
    let drill = "Drill\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    let cycle = "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[1,1,0],{\"at\":[1,1,-0.5],\"depth\":0.5}]}}";
    let lines = path_lines("", drill, cycle);
    assert!(lines.contains(&"X1. Y1. R-.4".to_owned()), "{lines:?}");
}

/// Digits that a letter does not have change a feed: that is said.
#[test]
fn feeds_that_lose_digits_are_said() {
    let notes = |head: &str, feed: &str| {
        let text = job(&format!("{{\"line\":[1,0,1],\"feed\":{feed}}}"));
        let notes = support::render(&mill(head, ""), &text).unwrap().notes;
        notes.iter().map(|note| format!("{} {}", note.code.name(), note.message)).collect::<Vec<_>>()
    };
    assert_eq!(notes("F >4.>2", "0.0055"), ["PR025 [frate] is 0.00550 and prints as F0.01: +81.8 %"]);
    assert_eq!(notes("F >4.>4", "0.0055"), [""; 0]);
    assert_eq!(notes("F >4.>2", "1.004"), [""; 0]);
    // a sequence's own word too
    let line = mill("F >4", "LineCode\nG1 X[h] F[frate]\nEnd");
    let rendered = support::render(&line, &job("{\"line\":[1,0,1],\"feed\":1.4}")).unwrap();
    assert_eq!(rendered.notes[0].code.name(), "PR025");
}

/// A lathe's T word holds station and offset register.
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

/// Near half a turn the last digit of R moves the centre: the arc is said in parts that R can say.
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
                // the control's centre: on the left of the chord, farther than half of it
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
    // exactly half a turn is said as it was
    assert_eq!(arc(180.0, [0.0, 0.0], 28.0).iter().filter(|line| line.contains('R')).count(), 1);
}

/// Another work offset together with another view: Index takes the tool up and goes over the new place.
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
