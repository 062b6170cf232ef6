//! The safety rules of rendering. Every test prints a short program for one rule and checks its blocks.

use crate::support;
use crate::support::folder::{Folder, err};
use crate::support::{job, mill, path_lines, plain_post, program, render, wrong};
use postform::diag::{Diag, Location};
use postform::internals::compile::compile;
use postform::internals::json::read_lines;
use postform::internals::render::{Options, Renderer};
use postform::toolpath::{Axes, Event, Hole, Place, Sink, Summary, Units};
use postform::{NoFiles, Post, Source};

const DRILL: &str = "Drill\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
const RETURNS: &str = "Drill\nG[retplane] G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";

/// After a tool change, the motion code is printed again, because the tool change may have left another motion active.
/// The first position is not printed again.
#[test]
fn motion_code_is_unknown_after_a_tool_change() {
    assert_eq!(path_lines("", "", "{\"rapid\":[0,0,0.5]}"), ["G0 Z.5"]);
}

/// If a tool change prints a position in another frame, or moves the machine after the position, the next move prints
/// the position again. A position that is still valid is not printed again.
#[test]
fn positions_in_another_frame_are_unknown() {
    const CHANGE: &str = "G0 G[work] X[h] Y[v] Z[d]";
    let after = |change: &str| {
        let lines = program(&mill("", "").replacen(CHANGE, change, 1), &job("{\"rapid\":[0,0,1]},{\"line\":[1,0,1]}"));
        let from = lines.iter().rposition(|line| line.contains("G54")).unwrap() + 1;
        lines[from..lines.len() - 1].to_vec()
    };
    let cut = "G1 X1. F10.";
    // the move to the reference point comes before the position, and G90 ends the increments
    assert_eq!(after(&format!("G91 G28 Z0\nG90\n{CHANGE}")), [cut]);
    assert_eq!(after(&format!("G53 G0 Z0\n{CHANGE}")), [cut]);
    // another frame, and moves after the position
    assert_eq!(after(&format!("G92 X0\n{CHANGE}")), ["G0 X0 Y0 Z1.", cut]);
    assert_eq!(after(&format!("{CHANGE}\nG28 X0")), ["G28 X0", "G0 X0", cut]);
    assert_eq!(after(&format!("{CHANGE}\nG28")), ["G28", "G0 X0 Y0 Z1.", cut]);
    assert_eq!(after(&format!("{CHANGE}\nM6")), ["M6", "G0 X0 Y0 Z1.", cut]);
    // another length register invalidates only the depth axis
    assert_eq!(after(&format!("{CHANGE}\nG43 H[lcomp]")), ["G43 H1", "G0 Z1.", cut]);
    assert_eq!(after(&format!("{CHANGE}\nH[lcomp]")), ["H1", "G0 Z1.", cut]);
    assert_eq!(after("G0 G[work] X[h] Y[v]\nG43 H[lcomp] Z[d]"), ["G43 H1 Z1.", cut]);
}

/// A new work offset invalidates all positions.
#[test]
fn a_work_offset_makes_positions_unknown() {
    let path = "{\"line\":[1,1,0]},{\"work\":55},{\"rapid\":[1,1,0]},{\"work\":55},{\"rapid\":[1,1,1]}";
    assert_eq!(path_lines("", "", path), ["G1 X1. Y1. Z0 F10.", "G55", "G0 X1. Y1. Z0", "Z1."]);
}

/// After unchanged text of a job, no state is known.
#[test]
fn nothing_is_known_after_verbatim_text() {
    let path = "{\"line\":[1,1,0]},{\"text\":\"G65 P9001\"},{\"line\":[1,2,0]}";
    assert_eq!(
        path_lines("", "", path),
        ["G1 X1. Y1. Z0 F10.", "G65 P9001", "G54", "S1000 M3", "G94", "G1 X1. Y2. Z0 F10."]
    );
}

/// Text in backquotes has the same effect on the known state as the same words without backquotes.
#[test]
fn text_in_backquotes_is_read() {
    let row = "{\"line\":[1,0,0]},{\"begin\":\"row\"},{\"line\":[2,0,0]},{\"end\":\"row\"}";
    let after = |text: &str| {
        let quoted = path_lines("Control fanuc", &format!("BeginRow\n{text}\nEnd"), row);
        quoted[quoted.iter().position(|line| line == text.trim_matches('`')).unwrap() + 1..].join(", ")
    };
    let unknown = "G54, S1000 M3, G94, G1 X2. Y0 Z0 F10.";
    // a macro, a text that contains more than words, a code that the control's file lists but the simulator does not run
    for text in ["`G65 P9000 Z-5. F10.`", "`#3006=1(CHECK)`", "`IF[#1EQ0]GOTO10`", "`M98 P8000`", "`G12 I1. F50`"] {
        assert_eq!(after(text), unknown, "{text}");
    }
    for (text, expected) in [
        ("`F2000`", "X2. F10."),
        ("`G0`", "G1 X2."),
        ("`M5`", "S1000 M3, X2."),
        ("`S50`", "S1000 M3, X2."),
        ("`G55`", "G54, X2. Y0 Z0"),
        ("`G95`", "G94, X2. F10."),
        ("`(G0)`", "X2."),
        ("`#500=[#500+1]`", "X2."),
        ("`/M5`", "S1000 M3, X2."),
    ] {
        assert_eq!(after(text), expected, "{text}");
    }
    // a value inside the text belongs to its word
    let lines = path_lines("Control fanuc", "BeginRow\n`F`[frate*2]\nEnd", row);
    assert_eq!(lines[1..], ["F20", "X2. F10."]);
}

/// After a feed mode code, the feed is unknown, because its unit has changed.
#[test]
fn a_feed_mode_makes_the_feed_unknown() {
    let form = mill("", "BeginRow\nG94\nEnd");
    let lines = program(&form, &job("{\"line\":[1,0,0]},{\"begin\":\"row\"},{\"line\":[2,0,0]},{\"end\":\"row\"}"));
    assert_eq!(lines[4..7], ["G1 X1. Z0 F10.", "G94", "X2. F10."]);
}

/// If an operation begins with a cut, the tool change must not move at rapid to the end of that cut.
#[test]
fn a_tool_change_does_not_rapid_to_the_end_of_a_cut() {
    let text = job("{\"line\":[1,1,-1]}").replace("{\"rapid\":[0,0,1]},", "");
    assert!(program(&mill("", ""), &text)[0].starts_with("PR012"), "{:?}", program(&mill("", ""), &text));
}

/// Changes for which the form has no Upon are printed before the next move.
#[test]
fn changes_that_no_upon_serves_are_printed() {
    let path = "{\"line\":[1,0,0]},{\"spindle\":{\"speed\":2000}},{\"coolant\":\"mist\"},{\"work\":56},{\"line\":[2,0,0]},\
                {\"spindle\":{\"direction\":\"off\"}},{\"coolant\":\"off\"},{\"rapid\":[2,0,1]}";
    let expected = ["G1 X1. Z0 F10.", "G56", "S2000 M3", "M7", "X2. Y0 Z0", "M5", "M9", "G0 Z1."];
    assert_eq!(path_lines("", "", path), expected);
}

/// A change for which the form has an Upon is printed only by the Upon, before the move.
#[test]
fn changes_that_an_upon_serves_are_printed_by_it() {
    let upon = "Upon [speed]\nG4 P1\nS[speed]\nEnd";
    let path = "{\"line\":[1,0,0]},{\"spindle\":{\"speed\":2000}},{\"line\":[2,0,0]}";
    assert_eq!(path_lines("", upon, path), ["G1 X1. Z0 F10.", "G4 P1", "S2000", "X2."]);
}

/// A work offset for which the form has no word is an error. Fixture 1 must never become the code G1.
#[test]
fn a_work_offset_without_a_word_is_an_error() {
    let form = mill("Work 1\nWorkDefault 1", "").replace(" G[work]", "");
    let lines = program(&form, &job("{\"work\":2},{\"line\":[1,1,1]}"));
    assert!(lines[0].starts_with("PR037"), "{lines:?}");
}

/// A second operation with the same tool prints only the changes, and no tool change.
#[test]
fn the_same_tool_again_prints_only_changes() {
    let text = job("{\"line\":[1,0,0]}").replace(
        "[1,0,0]}]}",
        "[1,0,0]}]},{\"tool\":1,\"spindle\":{\"speed\":1500},\"feed\":7,\"path\":[{\"line\":[2,0,0]}]}",
    );
    assert_eq!(program(&mill("", ""), &text)[4..7], ["G1 X1. Z0 F10.", "S1500 M3", "X2. F7."]);
}

/// A cycle of the control begins with the tool at the return plane. The tool first moves up and then across, or first
/// across and then down.
#[test]
fn a_cycle_begins_at_its_return_plane() {
    let cycle =
        "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"return\":0.5,\"feed\":5,\"points\":[[1,1,0]]}}";
    let down = ["G0 X1. Y1.", "Z.5", "G98 G81 X1. Y1. Z-1. R.1 F5.", "G80"];
    assert_eq!(path_lines("", RETURNS, cycle), down);
    let up = ["G1 Z0 F10.", "G0 Z.5", "G98 G81 X1. Y1. Z-1. R.1 F5.", "G80"];
    assert_eq!(path_lines("", RETURNS, &format!("{{\"line\":[0,0,0]}},{cycle}")), up);
}

/// The control would move at rapid through the material to a higher hole. So postform ends the cycle, raises the tool,
/// and starts the cycle again.
#[test]
fn a_cycle_is_raised_to_a_higher_hole() {
    let cycle =
        "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[1,1,0],[2,1,3],[3,1,0]]}}";
    let expected = [
        "G0 X1. Y1.",
        "Z.1",
        "G81 X1. Y1. Z-1. R.1 F5.",
        "G80",
        "G0 Z3.1",
        "G81 X2. Y1. Z2. R3.1 F5.",
        "X3. Z-1. R.1",
        "G80",
    ];
    assert_eq!(path_lines("", DRILL, cycle), expected);
}

/// The height of the previous hole counts: after a higher hole, the tool is already above the next hole.
#[test]
fn generated_holes_go_up_first_and_down_last() {
    let cycle =
        "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[1,1,0],[2,1,3],[3,1,0]]}}";
    let expected = [
        "G0 X1. Y1.",
        "Z.1",
        "G1 Z-1. F5.",
        "G0 Z.1", // the first hole
        "Z3.1",
        "X2.",
        "G1 Z2. F5.",
        "G0 Z3.1", // up before it moves across
        "X3.",
        "Z.1",
        "G1 Z-1. F5.",
        "G0 Z.1", // across before it moves down
    ];
    assert_eq!(path_lines("", "", cycle), expected);
}

/// A hole with its own depth prints it, and the next hole prints the cycle's depth again.
#[test]
fn a_changed_depth_is_printed_at_each_hole_that_changes_it() {
    let points = "[[1,1,0],{\"at\":[2,1,0],\"depth\":0.5},[3,1,0],[3,1,0]]";
    let cycle = format!("{{\"cycle\":{{\"kind\":\"drill\",\"depth\":1,\"clear\":1,\"feed\":5,\"points\":{points}}}}}");
    let expected = ["G81 X1. Y1. Z-1. R1. F5.", "X2. Z-.5", "X3. Z-1.", "X3. Y1.", "G80"];
    assert_eq!(path_lines("", DRILL, &cycle), expected);
}

/// If two cycles of one kind follow each other, the first cycle is cancelled, and the second cycle prints its whole
/// first line.
#[test]
fn a_new_cycle_starts_with_its_whole_line() {
    let cycle = |depth: &str| {
        format!("{{\"cycle\":{{\"kind\":\"drill\",\"depth\":{depth},\"clear\":1,\"feed\":5,\"points\":[[1,1,0]]}}}}")
    };
    let expected = ["G81 X1. Y1. Z-1. R1. F5.", "G80", "G81 X1. Y1. Z-2. R1. F5.", "G80", "G0 X0"];
    assert_eq!(path_lines("", DRILL, &format!("{},{},{{\"rapid\":[0]}}", cycle("1"), cycle("2"))), expected);
}

/// After a cycle only the position of the last hole is known, so the feed is printed again.
#[test]
fn the_feed_is_unknown_after_a_cycle() {
    let path = "{\"line\":[1,1,1]},{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":1,\"feed\":10,\"points\":[[1,1,0]]}},\
                {\"line\":[1,2,1]}";
    let expected = ["G1 X1. Y1. F10.", "G81 X1. Y1. Z-1. R1. F10.", "G80", "G1 Y2. F10."];
    assert_eq!(path_lines("", DRILL, path), expected);
}

/// If the form does not print the return plane, there is a warning, because a clamp may be between the holes.
#[test]
fn a_return_plane_that_is_not_reached_is_a_warning() {
    let cycle =
        "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"return\":2,\"feed\":5,\"points\":[[1,1,0]]}}";
    let notes = |form: &str| support::render(form, &job(cycle)).map(|r| r.notes).unwrap_or_default();
    assert!(notes(&mill("", DRILL)).iter().any(|n| n.code.name() == "PR013"));
    assert!(notes(&mill("", RETURNS)).is_empty());
}

/// If the sequence of a cycle does not print a value, the cycle is printed as moves. Here the value is the dwell at the bottom.
#[test]
fn a_dwell_that_the_form_does_not_print_becomes_moves() {
    let cycle =
        "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":1,\"dwell\":0.5,\"feed\":5,\"points\":[[1,1,0]]}}";
    let expected = ["G0 X1. Y1.", "G1 Z-1. F5.", "G4 P.5", "G0 Z1."];
    assert_eq!(path_lines("", DRILL, cycle), expected);
    let dwells = DRILL.replace("F[frate]", "P[dwell] F[frate]");
    assert_eq!(path_lines("", &dwells, cycle), ["G81 X1. Y1. Z-1. R1. P.5 F5.", "G80"]);
}

/// A rigid tap is never printed as single moves, because they are not synchronised with the spindle.
#[test]
fn a_rigid_tap_is_never_made_of_moves() {
    let tap = "{\"cycle\":{\"kind\":\"tap\",\"depth\":1,\"clear\":1,\"feed\":50,\"rigid\":true,\"points\":[[1,1,0]]}}";
    assert!(path_lines("", "", tap)[0].starts_with("PC021"));
    let floating = tap.replace(",\"rigid\":true", "");
    assert_eq!(path_lines("", "", &floating), ["G0 X1. Y1.", "G1 Z-1. F50.", "M4", "Z1.", "M3"]);
}

/// Centre words of arcs are always printed, even with unchanged values, because no control keeps them.
#[test]
fn centre_words_are_always_printed() {
    let path = "{\"line\":[0,0,0]},{\"arc\":{\"to\":[2,0],\"center\":[1,0],\"direction\":\"cw\"}},\
                {\"arc\":{\"to\":[4,0],\"center\":[3,0],\"direction\":\"cw\"}}";
    assert_eq!(path_lines("", "", path), ["G1 Z0 F10.", "G17 G2 X2. I1. J0", "X4. I1. J0"]);
}

/// A very short arc whose ends print the same position would become a full circle on the machine.
#[test]
fn a_tiny_arc_does_not_become_a_full_circle() {
    let path = "{\"line\":[1,0,0]},{\"arc\":{\"to\":[0.9999999,0.00001],\"center\":[0,0],\"direction\":\"ccw\"}},{\"line\":[0,0,0]}";
    assert_eq!(path_lines("", "", path), ["G1 X1. Z0 F10.", "X0"]);
}

/// A number that does not fit its letter's format is an error, because the control would stop with an alarm or misread it.
#[test]
fn a_number_that_does_not_fit_is_an_error() {
    assert!(path_lines("X->2.>4", "", "{\"line\":[100,0,0]}")[0].starts_with("PR002"));
    assert!(path_lines("X >2.>4", "", "{\"line\":[-1,0,0]}")[0].starts_with("PR003"));
    assert!(path_lines("F >3", "", "{\"line\":[1,0,0],\"feed\":0.4}")[0].starts_with("PR002"));
    assert!(path_lines("G 2", "", "{\"work\":59.1},{\"line\":[1,0,0]}")[0].starts_with("PR002"));
    // a speed that its format would round to 0
    let slow = path_lines("S >5", "", "{\"spindle\":{\"speed\":0.4}},{\"line\":[1,0,0]}");
    assert!(slow[0].starts_with("PR002 [speed] is 0.4, but prints as 0"), "{slow:?}");
    let slow = program(&mill("S >5", ""), &job("{\"line\":[1,0,0]}").replace("\"speed\":1000", "\"speed\":0.4"));
    assert!(slow[0].starts_with("PR002 [speed]"), "{slow:?}");
}

/// A cut on a mill with the spindle off is usually a mistake: there is one warning for each operation.
#[test]
fn a_cut_with_the_spindle_off_is_warned_of() {
    let told = |path: &str| {
        let notes = support::render(&mill("", ""), &job(path)).unwrap().notes;
        notes.into_iter().filter(|note| note.code.name() == "PR055").map(|note| note.message).collect::<Vec<_>>()
    };
    let off = "{\"spindle\":{\"direction\":\"off\"}},{\"line\":[1,0,0]},{\"line\":[2,0,0]}";
    assert_eq!(told(off), ["tool 1 cuts with the spindle off"]);
    assert_eq!(told("{\"spindle\":{\"speed\":0}},{\"line\":[1,0,0]}").len(), 1);
    assert_eq!(told("{\"line\":[1,0,0]},{\"spindle\":{\"direction\":\"off\"}},{\"rapid\":[2,0,1]}"), [""; 0]);
}

/// If a sequence with rigid tapping prints a tap for a floating holder, there is a warning, because the holders differ.
#[test]
fn a_floating_tap_by_a_rigid_sequence_is_told() {
    let form = mill("RigidTap? Y", "Tap\nG84 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel");
    let tap = "{\"cycle\":{\"kind\":\"tap\",\"rigid\":false,\"depth\":1,\"clear\":1,\"feed\":50,\"points\":[[1,1,0]]}}";
    let notes = support::render(&form, &job(tap)).unwrap().notes;
    assert!(notes.iter().any(|note| note.code.name() == "PR021"), "{notes:?}");
}

/// In an inch program, metric lengths would move 25.4 times as far.
#[test]
fn other_units_need_a_printed_unit_code() {
    let metric = job("{\"line\":[25.4,0,0]}").replace("inch", "mm");
    assert!(program(&mill("", ""), &metric)[0].starts_with("PR010"));
    let form = mill("Units both", "").replacen("%0", "G[unitmode]", 1);
    assert_eq!(program(&form, &metric)[..5], ["G21", "T1 M6", "S1000 M3", "G0 G54 X0 Y0 Z1.", "G1 X25.4 Z0 F10."]);
}

/// A text must not end its comment early, because the control would execute the rest.
#[test]
fn comments_keep_their_marks() {
    assert_eq!(path_lines("", "", "{\"comment\":\"a) G0 Z-9 (b\\u0007é%\"}"), ["(A] G0 Z-9 [B?E_)"]);
    assert_eq!(path_lines("Comment ;", "", "{\"comment\":\"a (b)\"}"), [";A (B)"]);
}

/// Words in a comment that goes to the end of the block have no effect, and do not prevent other words.
#[test]
fn values_in_a_comment_to_the_end_of_the_block_are_not_positions() {
    let drill = "Drill\n; HOLE AT X[h] Y[v]\nG0 X[h] Y[v]\nZ[vclear]\nG1 Z[d] F[frate] ; to Z[d]\nG0 Z[rplane]\nEnd";
    let path = "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[1,2,0]]}}";
    let lines = path_lines("Comment ;", drill, path);
    assert_eq!(lines, ["; HOLE AT X1 Y2", "G0 X1. Y2.", "Z.1", "G1 Z-1. F5. ; to Z-1", "G0 Z.1"]);
}

/// The travel limits of the form are checked.
#[test]
fn travel_limits_are_kept() {
    assert!(path_lines("Limits Z -5 5", "", "{\"line\":[1,0,-5.001]}")[0].starts_with("PR007"));
    assert_eq!(path_lines("Limits Z -5 5", "", "{\"line\":[0,0,-5]}"), ["G1 Z-5. F10."]);
}

/// A feed move without a feed is an error. The feed of the previous tool is not used.
#[test]
fn a_move_needs_a_feed() {
    let text = job("{\"line\":[1,0,0]}").replace("\"feed\":10,", "");
    assert!(program(&mill("", ""), &text)[0].starts_with("PR011"));
}

/// Cutter compensation without an offset register is an error.
#[test]
fn compensation_needs_its_offset() {
    let path = "{\"infeed\":[1,0],\"side\":\"left\"},{\"line\":[2,0]},{\"outfeed\":[3,0]}";
    assert_eq!(path_lines("", "", path), ["G1 G41 X1. D21 F10.", "X2.", "G40 X3."]);
}

/// If a dwell uses an axis letter, the position of that axis is unknown afterwards, so the next move prints it.
#[test]
fn a_dwell_does_not_count_as_a_position() {
    let path = "{\"line\":[0,0,0]},{\"dwell\":2},{\"line\":[2,0]},{\"line\":[3,0]}";
    assert_eq!(path_lines("Dwell G4 X s", "", path), ["G1 Z0 F10.", "G4 X2.", "X2.", "X3."]);
    let feed = "{\"line\":[0,0,0]},{\"dwell\":10},{\"line\":[2,0]}";
    assert_eq!(path_lines("Dwell G4 F s", "", feed), ["G1 Z0 F10.", "G4 F10.", "X2. F10."]);
}

/// An arc sequence with only a radius prints at most half a turn: longer arcs are split.
#[test]
fn a_radius_sequence_prints_long_arcs_in_parts() {
    let sequence = "CcwCode\nG3 X[h] Y[v] R[arcrad]\nEnd";
    let path = "{\"line\":[1,0,1]},{\"arc\":{\"to\":[0,-1],\"center\":[0,0],\"direction\":\"ccw\"}}";
    assert_eq!(path_lines("", sequence, path)[1..], ["G3 X-.7071 Y.7071 R1.", "X0 Y-1. R1."]);
}

/// If an arc sequence prints no plane, a separate block before the arc prints the code of the plane. The same applies
/// before a later block in another plane.
#[test]
fn planes_are_said_where_a_sequence_does_not() {
    let sequence = "CwCode\nG2 X[h] Y[v] Z[d] R[arcrad]\nEnd";
    let xz = "{\"line\":[0,0,1]},{\"arc\":{\"to\":[1,0,1],\"center\":[0.5,0,1],\"direction\":\"cw\",\"plane\":\"xz\"}}";
    let hole = "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":1,\"feed\":5,\"points\":[[1,0,0]]}}";
    let lines = path_lines("", &format!("{sequence}\n{DRILL}"), &format!("{xz},{hole}"));
    assert_eq!(lines, ["G18", "F10.", "G2 X1. R.5", "G17", "G81 X1. Y0 Z-1. R1. F5.", "G80"]);
}

/// A cycle sequence without positions would drill only one hole, so the cycle is printed as moves.
#[test]
fn a_cycle_without_a_position_becomes_moves() {
    let cycle = "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":1,\"feed\":5,\"points\":[[1,1,0],[2,1,0]]}}";
    let sequence = "Drill\nG81 Z[d] R[vclear] F[frate]\nEnd Cancel";
    let expected = ["G0 X1. Y1.", "G1 Z-1. F5.", "G0 Z1.", "X2.", "G1 Z-1. F5.", "G0 Z1."];
    assert_eq!(path_lines("", sequence, cycle), expected);
}

/// A motion sequence must print every axis that moves; otherwise the move would be lost.
#[test]
fn a_motion_sequence_must_print_what_moves() {
    let sequence = "RapidCode\nG0 X[h] Y[v]\nEnd";
    assert!(path_lines("", sequence, "{\"rapid\":[0,0,2]}")[0].starts_with("PR017"));
    assert_eq!(path_lines("", sequence, "{\"rapid\":[1,0]}"), ["G0 X1."]);
    // if the sequence has no feed, the feed is printed before the sequence
    let line = "LineCode\nG1 X[h] Y[v] Z[d]\nEnd";
    assert_eq!(path_lines("", line, "{\"line\":[1,0,1]},{\"line\":[2,0,1]}"), ["F10.", "G1 X1.", "X2."]);
}

/// The limits are checked at the extreme points of an arc and at the bottom of a hole.
#[test]
fn travel_limits_hold_along_arcs_and_in_holes() {
    let arc = "{\"line\":[0,0,1]},{\"arc\":{\"to\":[0,1],\"center\":[0.8,0.5],\"direction\":\"ccw\"}}";
    assert!(path_lines("Limits X -1 1", "", arc)[0].starts_with("PR007"));
    let hole = "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":1,\"feed\":5,\"points\":[[1,1,0]]}}";
    assert!(path_lines("Limits Z -0.5 5", DRILL, hole)[0].starts_with("PR007"));
}

/// No control drills with cutter compensation on.
#[test]
fn a_cycle_under_cutter_compensation_is_an_error() {
    let path = "{\"infeed\":[1,0],\"side\":\"left\"},{\"rapid\":[2,2,2]},\
                {\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":1,\"feed\":5,\"points\":[[1,1,0]]}}";
    assert!(path_lines("", DRILL, path)[0].starts_with("PC041"));
}

/// The position of a new tool is unknown, so its first rapid must contain a height.
#[test]
fn a_new_tool_does_not_keep_the_last_ones_depth() {
    let second = "{\"tool\":2,\"spindle\":{\"speed\":1,\"direction\":\"cw\"},\"path\":[{\"rapid\":[3,3]}]}";
    let text = job("{\"line\":[1,0,-1]}").replace("-1]}]}]}", &format!("-1]}}]}},{second}]}}"));
    assert!(program(&mill("", ""), &text)[0].starts_with("PR001 [d]"), "{:?}", program(&mill("", ""), &text));
}

/// Some missing or contradictory values of a cycle are not errors. They give a warning.
#[test]
fn odd_cycles_are_warned_of() {
    const TAP: &str = "Tap\nG84 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    let cases = [
        ("", "\"kind\":\"deep\",\"clear\":1", "PC060", "drills in one peck"),
        (
            "",
            "\"kind\":\"drill\",\"clear\":1,\"return\":0.5",
            "PC053",
            "0.5 above the point, is below the clearance, 1",
        ),
        // 3 inches are 76.19999999999999 mm
        ("", "\"kind\":\"drill\",\"clear\":76.19999999999999,\"return\":25", "PC053", "the clearance, 76.2;"),
        (TAP, "\"kind\":\"tap\",\"clear\":1,\"step\":0.5", "PC061", "print `Q[vbite]` in the sequence `Tap`"),
    ];
    for (sequences, cycle, code, wanted) in cases {
        let path = format!("{{\"cycle\":{{{cycle},\"depth\":1,\"feed\":5,\"points\":[[1,1,0]]}}}}");
        let rendered = support::render(&mill("", sequences), &job(&path)).unwrap();
        let told = |note: &Diag| format!("{}; {}", note.message, note.help.as_deref().unwrap_or_default());
        let found = rendered.notes.iter().any(|note| note.code.name() == code && told(note).contains(wanted));
        assert!(found, "{code}: {:?}", rendered.notes);
    }
}

/// Without its code, a surface speed would be read as revolutions.
#[test]
fn a_surface_speed_prints_its_code() {
    let css = "{\"spindle\":{\"speed\":100,\"mode\":\"css\"}},{\"line\":[1,0,1]}";
    assert_eq!(path_lines("", "", css), ["G96 S100 M3", "G1 X1. F10."]);
    let limited = "{\"spindle\":{\"speed\":100,\"mode\":\"css\",\"max\":3000}},{\"line\":[1,0,1]}";
    assert!(path_lines("", "", limited)[0].starts_with("PR038"));
}

/// An Upon Every prints only where its variable is used.
#[test]
fn upon_every_prints_at_uses_alone() {
    let form = mill("", "Upon Every [work]\n(UPON)\nEnd");
    let lines = program(&form, &job("{\"line\":[1,0,1]}"));
    assert_eq!(lines.iter().filter(|l| *l == "(UPON)").count(), 1, "{lines:?}");
    let feeds = path_lines("", "Upon Every [frate]\n(FEED)\nEnd", "{\"rapid\":[1,0,1]},{\"line\":[2,0,1]}");
    assert_eq!(feeds, ["G0 X1.", "(FEED)", "G1 X2. F10."]);
}

/// With VRapid, the part of a rapid along the depth axis has its own code, even if the form has a RapidCode.
#[test]
fn vrapid_splits_before_a_rapid_sequence() {
    let sequence = "RapidCode\nG0 X[h] Y[v] Z[d]\nEnd";
    let lines = path_lines("VRapid G0", sequence, "{\"rapid\":[2,2,0.5]}");
    assert_eq!(lines, ["G0 X2. Y2.", "Z.5"]);
}

/// A text with no words prints no block.
#[test]
fn empty_text_prints_nothing() {
    assert_eq!(path_lines("Sequence#s N 1 1", "", "{\"text\":\" \"},{\"line\":[1,0,1]}").len(), 1);
}

/// A work offset that is set before the first rapid is used for the position of the tool change.
#[test]
fn the_first_position_is_in_its_own_work_offset() {
    let text = job("{\"line\":[1,0,1]}").replace("[{\"rapid\"", "[{\"work\":56},{\"rapid\"");
    assert_eq!(program(&mill("", ""), &text)[3..5], ["G0 G56 X0 Y0 Z1.", "G1 X1. F10."]);
}

/// A surface speed in feet per minute is converted to metres per minute in a metric program.
#[test]
fn a_surface_speed_follows_the_units() {
    let text = job("{\"spindle\":{\"speed\":100,\"mode\":\"css\"}},{\"line\":[1,0,1]}");
    let form = mill("S >5.>1", "").replace("%0\n", "%0\nG[unitmode]\n");
    let options = Options { units: Some(Units::Mm), ..Options::default() };
    let rendered = support::render_checked(&support::check(&form), text.as_bytes(), false, options).unwrap();
    assert!(rendered.text.contains("\nG96 S30.5 M3\n"), "{}", rendered.text);
}

/// If the tool change prints no work offset, the work offset is printed before the tool change, because the position
/// depends on it.
#[test]
fn a_tool_change_goes_to_its_own_work_offset() {
    let form = mill("", "").replace("G0 G[work] X[h]", "G0 X[h]");
    let second =
        "{\"tool\":2,\"work\":55,\"spindle\":{\"speed\":1,\"direction\":\"cw\"},\"path\":[{\"rapid\":[3,3,1]}]}";
    let text = job("{\"rapid\":[1,0,1]}").replace("1]}]}]}", &format!("1]}}]}},{second}]}}"));
    assert_eq!(program(&form, &text)[5..9], ["G55", "T2 M6", "S1 M3", "G0 X3. Y3. Z1."]);
}

/// A variable in a comment does not count as printed, so its value is printed in a word.
#[test]
fn a_comment_prints_no_word() {
    let lines = path_lines("", "LineCode\nG1 X[h] Y[v] Z[d] (FEED [frate])\nEnd", "{\"line\":[1,0,1]}");
    assert_eq!(lines, ["F10.", "G1 X1. (FEED 10)"]);
    let begin = "BeginRow\n(AT [work])\nEnd";
    let path = "{\"work\":55},{\"begin\":\"row\"},{\"end\":\"row\"},{\"rapid\":[1,0,1]}";
    assert_eq!(path_lines("", begin, path)[..2], ["(AT 55)", "G55"]);
}

/// Work offset, spindle and coolant are printed before a text. Codes in the text count as printed, and as requested by the job.
#[test]
fn text_comes_after_what_goes_before_it() {
    let path = "{\"spindle\":{\"direction\":\"off\"}},{\"coolant\":\"on\"},{\"text\":\"M0 (M9)\"},{\"line\":[1,0,1]}";
    assert_eq!(path_lines("", "", path)[..3], ["M5", "M8", "M0 (M9)"]);
    let stopped = "{\"text\":\"M5\"},{\"spindle\":{\"direction\":\"cw\"}},{\"line\":[1,0,1]}";
    assert_eq!(path_lines("", "", stopped)[..2], ["M5", "S1000 M3"]);
    let coolant = "{\"text\":\"M8\"},{\"line\":[1,0,1]},{\"work\":55},{\"rapid\":[1,0,2]}";
    assert_eq!(path_lines("", "", coolant), ["M8", "G1 X1. Y0 Z1. F10.", "G55", "G0 X1. Y0 Z2."]);
    // a code that would change the meaning of later words is reversed, or refused
    assert_eq!(path_lines("", "", "{\"text\":\"G95\"},{\"line\":[1,0,1]}")[1], "G94");
    assert!(path_lines("", "", "{\"text\":\"G91\"},{\"line\":[1,0,1]}")[0].starts_with("PR040 the control is in G91"));
    assert!(path_lines("", "", "{\"text\":\"G22 G21\"}")[0].starts_with("PR035 the text changes the units"));
}

/// If an Upon does not print the change, the change is printed elsewhere.
#[test]
fn an_upon_that_says_nothing_serves_nothing() {
    let lines = path_lines("", "Upon [work]\nG0 G53 Z0\nEnd", "{\"work\":55},{\"rapid\":[1,0,1]}");
    assert_eq!(lines, ["G0 G53 Z0", "G55", "X1. Y0 Z1."]);
}

/// An Upon that moves the tool before a cut is refused, because part of the cut would be lost.
#[test]
fn a_cut_does_not_begin_with_an_upon_that_moves() {
    let upon = "Upon [work]\nG0 G53 Z0\nG[work] X[h] Y[v]\nEnd";
    for cut in ["{\"line\":[1,1]}", "{\"infeed\":[1,1],\"side\":\"left\"}"] {
        assert!(path_lines("", upon, &format!("{{\"work\":55}},{cut}"))[0].starts_with("PR012 this sequence"), "{cut}");
    }
    // at a stop, such an Upon does not move
    let lines = path_lines("", upon, "{\"line\":[4,4]},{\"work\":55},{\"stop\":\"program\"}");
    assert_eq!(lines[1..], ["G0 G53 Z0", "G55 X4. Y4.", "M0"]);
}

/// An increment is left out only if it is zero. An increment that equals the previous increment is printed again.
#[test]
fn increments_of_a_sequence_are_no_positions() {
    let sequence = "LineCode\nG91 G1 X[hdist] Y[vdist] F[frate]\nG90\nEnd";
    let lines = path_lines("", sequence, "{\"rapid\":[1,2,1]},{\"line\":[2,4,1]},{\"line\":[3,4,1]}");
    assert_eq!(lines[1..], ["G91 G1 X1. Y2. F10.", "G90", "G91 X1.", "G90"]);
}

/// InFeed and OutFeed must print every axis that moves, and the feed.
#[test]
fn compensation_sequences_lose_nothing() {
    let infeed = "InFeed\nG1 G[side] D[dcomp] X[h] Y[v]\nEnd";
    let error = &path_lines("", infeed, "{\"infeed\":[1,0,0.5],\"side\":\"left\"}")[0];
    assert!(error.starts_with("PR017 this move changes [d]"), "{error}");
    let lines = path_lines("", infeed, "{\"infeed\":[1,0],\"side\":\"left\",\"feed\":3}");
    assert_eq!(lines, ["F3.", "G1 G41 D21 X1. Y0"]);
}

/// An arc sequence without a centre word for the arc's plane is not used.
#[test]
fn an_arc_sequence_without_its_centre_word_gives_lines() {
    let sequence = "CwCode\nG2 X[h] Y[v] Z[d] I[ival] J[jval] F[frate]\nEnd";
    let arc = |plane: &str| {
        format!("{{\"arc\":{{\"to\":[2,0,1],\"center\":[1,0,1],\"direction\":\"cw\",\"plane\":\"{plane}\"}}}}")
    };
    assert!(path_lines("", sequence, &arc("xz"))[0].starts_with("G1 X"));
    assert_eq!(path_lines("", sequence, &arc("xy")), ["G2 X2. I1. J0 F10."]);
    let notes = |plane: &str| support::render(&mill("", sequence), &job(&arc(plane))).unwrap().notes;
    assert!(notes("xz").iter().any(|note| note.code.name() == "PR024" && note.message.contains("[kval]")));
    assert_eq!(notes("xy"), []);
}

/// A fixture number whose code is not a work offset is refused.
#[test]
fn fixture_numbers_end_where_work_offsets_do() {
    assert!(
        path_lines("", "", "{\"work\":7},{\"rapid\":[1,0,1]}")[0]
            .starts_with("PR037 the form has no word for the work offset 7")
    );
    assert_eq!(path_lines("", "", "{\"work\":59.1},{\"rapid\":[1,0,1]}")[0], "G59.1");
}

/// If the form does not print a work offset of the job, the help gives the offsets that it prints. G54.1 P99 is the last
/// one that is known of a Fanuc, and G599 the last one of a Siemens. A last number in `MoreWork` replaces this limit.
#[test]
fn the_help_of_a_work_offset_gives_the_range() {
    let said = |form: &str, work: &str| {
        let job = job("{\"line\":[1,0,0]}").replace("\"work\":54", &format!("\"work\":{work}"));
        support::render(form, &job).err().map(|diag| diag.help.unwrap_or_default())
    };
    let more = "if the control has more offsets, write the number of the last one into `MoreWork`";
    for (commands, work, help) in [
        (
            "",
            "154",
            "the work offsets 1 to 6, 54 to 59, 59.1 to 59.3: give one of these; or define further ones at the top of the form: `MoreWork 7 G54.1 P1`",
        ),
        (
            "Control fanuc\nMoreWork 7 G54.1 P1",
            "159",
            &format!("the work offsets 1 to 49, 54 to 158: give one of these; {more}"),
        ),
        (
            "MoreWork 7 G54.1 P1 48",
            "108",
            &format!("the work offsets 1 to 49, 54 to 107, 59.1 to 59.3: give one of these; {more}"),
        ),
        (
            "Control linuxcnc",
            "60",
            "the work offsets 1 to 6, 54 to 59, 59.1 to 59.3: give one of these; or define further ones at the top of the form: `MoreWork 7 G59.1`",
        ),
        ("Control grbl", "7", "the work offsets 1 to 6, 54 to 59: give one of these"),
        (
            "Control siemens\nMoreWork 5 G505",
            "200",
            &format!("the work offsets 1 to 49, 54 to 152: give one of these; {more}"),
        ),
    ] {
        let found = said(&mill(commands, ""), work);
        assert_eq!(found, Some(format!("this form prints {help}")), "{commands}, {work}");
    }
    let (fanuc, own) = (mill("Control fanuc\nMoreWork 7 G54.1 P1", ""), mill("MoreWork 7 G54.1 P1 300", ""));
    assert_eq!([said(&fanuc, "158"), said(&own, "200"), said(&own, "359")], [None, None, None]);
}

/// A tap turns the spindle in the tap's direction. Afterwards the spindle turns as before.
#[test]
fn a_tap_turns_the_spindle_its_own_way() {
    let tap = "{\"cycle\":{\"kind\":\"ltap\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[1,1,0]]}}";
    let turned = format!("{{\"spindle\":{{\"direction\":\"ccw\"}}}},{tap}");
    let lines = path_lines("", "", &turned);
    assert_eq!(lines[3..], ["G1 Z-1. F5.", "M3", "Z.1", "M4"]);
    assert_eq!(path_lines("", "", tap), lines);
    let after = format!("{tap},{{\"rapid\":[2,2,1]}}");
    assert_eq!(path_lines("", "", &after)[lines.len()], "S1000 M3");
    let ltap = "LTap\nG74 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    assert_eq!(path_lines("", ltap, tap)[0], "S1000 M4");
    // for a rigid tap, the control turns the spindle
    let rigid = path_lines("RigidTap? Y", ltap, &after);
    assert!(!rigid.contains(&"S1000 M4".to_owned()) && rigid.contains(&"S1000 M3".to_owned()), "{rigid:?}");
    let off = format!("{{\"spindle\":{{\"direction\":\"off\"}}}},{tap}");
    assert!(path_lines("", ltap, &off)[0].starts_with("PR032 the spindle does not turn"));
}

/// If a sequence switches off the spindle or the coolant, postform switches it on again before the next move.
#[test]
fn what_a_sequence_switches_is_put_back() {
    let lines = path_lines("", "EndRow\nM5 M9\nM0\nEnd", "{\"begin\":\"row\"},{\"end\":\"row\"},{\"line\":[1,0,1]}");
    assert_eq!(lines, ["M5 M9", "M0", "S1000 M3", "G1 X1. F10."]);
}

/// The parts of an arc share its time. A cycle can't have inverse time.
#[test]
fn inverse_time_is_that_of_the_whole_arc() {
    let inverse = |path: &str| job(path).replace("\"feed\":10", "\"feed\":10,\"feed_mode\":\"inverse_time\"");
    let arc = "{\"arc\":{\"to\":[2,0],\"center\":[1,0],\"direction\":\"cw\"},\"feed\":4}";
    let lines = program(&mill("ByQuadrants? Y", ""), &inverse(arc));
    assert_eq!(lines[5..7], ["G17 G2 X1. Y1. I1. J0 F8.", "X2. Y0 I0 J-1. F8."]);
    let hole = "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[1,1,0]]}}";
    assert!(program(&mill("", ""), &inverse(hole))[0].starts_with("PR006 a canned cycle"));
}

/// After a text, the height is unknown, so the tool moves up before it moves across.
#[test]
fn the_tool_goes_up_first_also_after_text() {
    let path = "{\"line\":[0,0,-1]},{\"text\":\"M1\"},\
                {\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[5,5,0]]}}";
    assert_eq!(path_lines("", DRILL, path)[1..5], ["M1", "S1000 M3", "G0 Z.1", "G81 X5. Y5. Z-1. R.1 F5."]);
}

/// A cut must not begin at a position to which a sequence moved the tool, whatever comes between.
#[test]
fn a_cut_begins_where_the_path_says() {
    let upon = "Upon [work]\nG0 G53 Z0\nG[work] X[h] Y[v]\nEnd";
    for between in ["{\"dwell\":1}", "{\"stop\":\"program\"}", "{\"text\":\"M1\"}", "{\"comment\":\"now\"}"] {
        let path = format!("{{\"work\":55}},{between},{{\"line\":[1,1]}}");
        assert!(path_lines("", upon, &path)[0].starts_with("PR012"), "{between}");
    }
    let lifts = "EndRow\nG0 Z9\nEnd";
    let row = "{\"begin\":\"row\"},{\"end\":\"row\"}";
    assert!(path_lines("", lifts, &format!("{row},{{\"line\":[1,1]}}"))[0].starts_with("PR012"));
    assert_eq!(path_lines("", lifts, &format!("{row},{{\"rapid\":[1,1,1]}}")), ["G0 Z9", "X1. Y1. Z1."]);
}

/// An Upon for the next tool must not move the current tool.
#[test]
fn a_tool_change_needs_no_upon_that_moves() {
    let upon = "Upon [work]\nG[work] X[h] Y[v]\nG43 H[lcomp] Z[d]\nEnd";
    let second =
        "{\"tool\":2,\"work\":55,\"spindle\":{\"speed\":1,\"direction\":\"cw\"},\"path\":[{\"rapid\":[3,3,1]}]}";
    let text = job("{\"rapid\":[1,0,1]}").replace("1]}]}]}", &format!("1]}}]}},{second}]}}"));
    assert_eq!(program(&mill("", upon), &text)[5..8], ["T2 M6", "S1 M3", "G0 G55 X3. Y3. Z1."]);
}

/// In a control's cycle, every axis word makes a hole, so the cycle is ended before an Upon prints.
#[test]
fn an_upon_stands_outside_the_cycle() {
    let upon = format!("{DRILL}\nUpon [vclear]\nM8 X[h] Y[v]\nEnd");
    let cycle = "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[1,1,0],[2,2,-0.3]]}}";
    let lines = path_lines("", &upon, cycle);
    let (cancel, upon) = (lines.iter().position(|l| l == "G80"), lines.iter().position(|l| l.starts_with("M8")));
    assert!(cancel.is_some() && cancel < upon, "{lines:?}");
}

/// Compensation ends before the tool changes, and begins at a known height.
#[test]
fn compensation_has_its_tool_and_height() {
    let second = "{\"tool\":2,\"spindle\":{\"speed\":1,\"direction\":\"cw\"},\"path\":[{\"rapid\":[3,3,1]}]}";
    let text = job("{\"infeed\":[1,0],\"side\":\"left\"}").replace("left\"}]}]}", &format!("left\"}}]}},{second}]}}"));
    assert!(program(&mill("", ""), &text)[0].starts_with("PR030 the tool changes"));
    let infeed = "InFeed\nG1 G[side] D[dcomp] X[h] Y[v] F[frate]\nEnd";
    let path = "{\"text\":\"G0 Z5\"},{\"infeed\":[1,0],\"side\":\"left\"}";
    assert!(path_lines("", infeed, path)[0].starts_with("PR017 the height is unknown"));
}

/// With inverse time, the feed word must be in the block of its move.
#[test]
fn inverse_time_needs_its_word_in_the_block() {
    let text = job("{\"line\":[1,0,1]}").replace("\"feed\":10", "\"feed\":10,\"feed_mode\":\"inverse_time\"");
    let form = mill("", "LineCode\nG1 X[h] Y[v] Z[d]\nEnd");
    assert!(program(&form, &text)[0].starts_with("PR017 in inverse time"));
}

/// Many controls stop spindle and coolant at a program stop, so both are printed again before the next cut.
#[test]
fn spindle_and_coolant_are_said_again_after_a_stop() {
    let path = "{\"coolant\":\"on\"},{\"line\":[1,0,1]},{\"stop\":\"program\"},{\"line\":[2,0,1]}";
    assert_eq!(path_lines("", "", path), ["M8", "G1 X1. F10.", "M0", "S1000 M3", "M8", "X2."]);
}

/// In the plane of a helix, each full turn ends exactly at its start, to the last digit. Otherwise a turn would be
/// printed as an arc of zero length.
#[test]
fn whole_turns_end_where_they_begin() {
    let path = r#"{"rapid":[3.25,3.78125,0.1]},{"arc":{"to":[3.25,3.78125,-0.6],"center":[3.75,3.78125],"direction":"cw","turns":5}}"#;
    let lines = path_lines("X->4.>4\nY->4.>4\nZ->4.>4\nI->4.>4\nJ->4.>4", "", path);
    let arcs: Vec<&String> = lines.iter().filter(|line| line.contains(" J")).collect();
    assert_eq!(arcs.len(), 6, "{lines:?}");
    assert!(arcs.iter().all(|line| !line.contains('X') && !line.contains('Y')), "{lines:?}");
}

/// After a full circle, the next full circle also prints its code, because controls need a code in a block without axis
/// words.
#[test]
fn a_whole_circle_says_its_code() {
    let circles = r#"{"rapid":[2,0,1]},{"arc":{"to":[2,0],"center":[1,0],"direction":"ccw"}},{"arc":{"to":[2,0],"center":[1.5,0],"direction":"ccw"}}"#;
    let lines = path_lines("", "", circles);
    assert_eq!(lines[1..], ["G17 G3 I-1. J0 F10.", "G3 I-.5 J0"]);
}

/// After G99 the tool is at R. Before a higher hole, the cycle must be ended and the tool raised.
#[test]
fn a_higher_hole_after_a_lower_one_is_approached_from_above() {
    let drill = "Drill\nG[retplane] G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    let holes = r#"{"rapid":[0,0,2]},{"cycle":{"kind":"drill","depth":0.5,"clear":0.1,"feed":5,"points":[[1,1,0],[2,1,0.5],[3,1,0],[4,1,0.2]]}}"#;
    let lines = path_lines("", drill, holes);
    let at = lines.iter().position(|line| line.contains("X4.")).unwrap();
    let before = &lines[at - 2..at];
    assert_eq!(before, ["G80", "G0 Z.3"], "{lines:?}");
}

/// A feed that its format rounds to zero is an error, in cycles as in moves.
#[test]
fn a_feed_that_prints_as_nothing_is_an_error() {
    let tap = "Tap\nG84 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    let path = r#"{"cycle":{"kind":"tap","rigid":false,"depth":0.5,"clear":0.1,"feed":0.0034,"points":[[1,1,0]]}}"#;
    let lines = path_lines("F >4.>2", tap, path);
    assert!(lines.len() == 1 && lines[0].starts_with("PR002"), "{lines:?}");
}

/// Changes that a cycle makes for itself are reversed after its end, because a block between its holes would be read as a hole.
#[test]
fn nothing_stands_between_the_holes_of_a_cycle() {
    let tap = "Tap\nG95 G84 X[h] Y[v] Z[d] R[vclear] F[pitch]\nEnd Cancel";
    let path = r#"{"cycle":{"kind":"tap","rigid":false,"depth":0.5,"clear":0.1,"feed":50,"points":[[1,1,0],[2,1,0]]}},{"line":[3,1,0]}"#;
    let lines = path_lines("", tap, path);
    let at = lines.iter().position(|line| line.starts_with("G95")).unwrap();
    assert_eq!(lines[at..], ["G95 G84 X1. Y1. Z-.5 R.1 F.05", "X2.", "G80", "G94", "G1 X3. Z0 F10."]);
}

/// A fixture number may be the parameter of a code, as in `G15 H2`. The number is always printed with this code. A code
/// with the same number then has another meaning.
#[test]
fn a_work_offset_is_said_with_its_code() {
    let form =
        mill("Work 1\nWorkDefault 1", "").replace("G0 G[work] X[h] Y[v] Z[d]", "G15 H[work] G56\nG0 X[h] Y[v] Z[d]");
    let lines = program(&form, &job(r#"{"work":2},{"rapid":[1,0,1]}"#).replace("\"work\":54", "\"work\":1"));
    assert_eq!(lines[3..], ["G15 H1 G56", "G0 X0 Y0 Z1.", "G15 H2", "G0 X1. Y0 Z1.", "M30"]);
}

/// If Cancel switches off the spindle or the coolant, postform switches it on again before the next cycle of the
/// control.
#[test]
fn a_cancel_in_the_middle_of_a_cycle_switches_nothing_for_good() {
    let form = mill("", RETURNS).replace("Cancel\nG80", "Cancel\nG80 M5");
    let holes = r#"{"cycle":{"kind":"drill","depth":1,"clear":0.1,"feed":5,"points":[[1,1,0],[2,1,2],[3,1,2]]}}"#;
    let lines = program(&form, &job(holes));
    let at = lines.iter().position(|line| line == "G80 M5").unwrap();
    assert_eq!(lines[at..at + 3], ["G80 M5", "S1000 M3", "G0 Z2.1"], "{lines:?}");
    let shifted = program(&form.replace("G80 M5", "G80 G91 G28 Z0"), &job(holes));
    assert!(shifted[0].starts_with("PR040"), "{shifted:?}");
}

/// If a form has its own word for work offsets, the word is printed again after another code that selects an offset.
#[test]
fn codes_of_work_offsets_beside_a_word_of_their_own() {
    let changes = "G0 G[work] X[h] Y[v] Z[d]";
    let start = |line: &str, sequences: &str| mill("Work 1\nWorkDefault 1", sequences).replace(changes, line);
    let own = |path: &str| job(path).replace("\"work\":54", "\"work\":3");
    let row = r#"{"begin":"row"},{"rapid":[1,0,1]},{"end":"row"}"#;
    let lines = program(&start("G154 P[work]\nG0 X[h] Y[v] Z[d]", "BeginRow\nG54\nEnd"), &own(row));
    assert_eq!(lines[5..], ["G54", "G154 P3", "G0 X1. Y0 Z1.", "M30"], "{lines:?}");
    // the code in the text is not a number of the form's own offset word
    let text = own(r#"{"text":"G54"},{"rapid":[1,0,1]}"#);
    let lines = program(&start("E[work] X[h] Y[v]\nG0 Z[d]", ""), &text);
    assert!(!lines.iter().any(|line| line.contains("E54")), "{lines:?}");
    // positions after the word are in the new offset
    let upon = start("G0 X[h] Y[v] Z[d]", "Upon [work]\nG15 H[work]\nEnd");
    let path = r#"{"work":2},{"rapid":[0,0,1]},{"line":[1,0,-1]}"#;
    let lines = program(&upon, &own(path));
    let at = lines.iter().position(|line| line == "G15 H2").unwrap();
    assert_eq!(lines[at..at + 3], ["G15 H2", "G0 X0 Y0 Z1.", "G1 X1. Z-1. F10."], "{lines:?}");
    // an argument of a macro does not select an offset
    let lines = path_lines(
        "",
        "BeginRow\nG65 P9810 W[work]\nEnd",
        r#"{"begin":"row"},{"work":55},{"rapid":[1,0,1]},{"end":"row"}"#,
    );
    assert_eq!(lines, ["G65 P9810 W54.", "G55", "S1000 M3", "G94", "G0 X1. Y0 Z1."]);
}

/// The control may skip words after a block delete slash, so their effect is unknown.
#[test]
fn block_delete_leaves_nothing_known() {
    let row = r#"{"begin":"row"},{"rapid":[1,0,1]},{"end":"row"}"#;
    let skipped = |words: &str| path_lines("", &format!("BeginRow\n{words}\nEnd"), row);
    assert!(skipped("/G91")[0].starts_with("PR040"));
    assert_eq!(skipped("/G55"), ["/G55", "G54", "G0 X1. Y0 Z1."]);
    assert_eq!(skipped("/M5"), ["/M5", "S1000 M3", "G0 X1."]);
    assert_eq!(skipped("/S500"), ["/S500", "S1000 M3", "G0 X1."]);
}

/// The slash of block delete is the first character of the block, before the block number. A number without a letter
/// stays before the slash, because the slash would take it for the number of a switch.
#[test]
fn block_delete_is_before_the_block_number() {
    let row = r#"{"begin":"row"},{"rapid":[1,0,1]},{"end":"row"}"#;
    for (numbers, words, block) in [
        ("Sequence#s N 10 10", "/M5", "/N40 M5"),
        ("Sequence#s N 10 10", "/2 M5", "/2 N40 M5"),
        ("Sequence#s N 10 10", "`/M5`", "/N40 M5"),
        ("Sequence#s - 10 10", "/M5", "40 /M5"),
        ("Sequence#s N 10 10\nReplace M5 M105", "`/M5` /M5", "/N40 M5 /M105"),
    ] {
        let lines = path_lines(numbers, &format!("BeginRow\n{words}\nEnd"), row);
        assert!(lines.iter().any(|line| line == block), "{words}: {lines:?}");
    }
    let text = path_lines("Sequence#s N 10 10", "", r#"{"text":"/M9"}"#);
    assert!(text.iter().any(|line| line == "/N40 M9"), "{text:?}");
}

/// postform refuses events that a reader must not push. If postform ignored a hole, the hole would be missing in the
/// part.
#[test]
fn events_that_can_not_be_are_faults_of_postform() {
    let checked = support::check(&mill("", DRILL));
    let compiled = compile(&checked.form);
    let mut renderer = Renderer::new(&compiled, Options::default());
    let head = "{\"start\":{\"program\":1,\"tools\":[{\"number\":1}]}}\n\
        {\"operation\":{\"tool\":1,\"spindle\":{\"speed\":9,\"direction\":\"cw\"},\"feed\":5}}\n{\"rapid\":[0,0,1]}\n";
    _ = read_lines(head.as_bytes(), &mut renderer); // cut off before its end
    let hole = || Event::Hole(Hole { at: Axes::new(&[1.0, 1.0, 0.0]), depth: None });
    let place = Place { line: 7, column: 1, ..Place::default() };
    let error = wrong(renderer.event(hole(), place));
    assert_eq!((error.code.name(), error.place.map(|place| *place)), ("PX001", Some(Location::at(7, 1))));
    renderer.push(Event::Finish, place).unwrap();
    assert_eq!(wrong(renderer.event(Event::Rapid(Axes::new(&[0.0; 3])), place)).code.name(), "PX001");
    assert_eq!(wrong(Summary::default().event(hole(), place)).code.name(), "PX001");
}

/// An oriented bore must stop the spindle at the requested angle; otherwise the tool would score the wall during the retract.
#[test]
fn an_oriented_bore_is_oriented_at_any_angle() {
    let bore = |orient: &str| {
        format!(
            "{{\"cycle\":{{\"kind\":\"bore\",\"depth\":0.5,\"clear\":0.1,\"feed\":5,{orient}\"points\":[[1,1,0]]}}}}"
        )
    };
    let form = "Bore\nG86 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    assert!(path_lines("", form, &bore("")).iter().any(|line| line.starts_with("G86")));
    for angle in ["0", "90"] {
        let lines = path_lines("", form, &bore(&format!("\"orient\":{angle},")));
        assert!(lines.iter().any(|line| line.starts_with(&format!("M19 R{angle}"))), "{angle}: {lines:?}");
        assert!(!lines.iter().any(|line| line.contains("G86")), "{angle}: {lines:?}");
    }
}

/// After holes of several heights, the tool is higher in the program than in the job. The next cut begins at the job's
/// height.
#[test]
fn a_cut_after_a_cycle_begins_at_the_jobs_height() {
    let cycle = "{\"cycle\":{\"kind\":\"drill\",\"depth\":0.5,\"clear\":0.1,\"return\":0.3,\"feed\":5,\
                 \"points\":[[0,0,0],[1,0,1],[2,0,0]]}}";
    let lines = path_lines("", RETURNS, &format!("{cycle},{{\"line\":[5,0,0]}}"));
    assert_eq!(lines[lines.len() - 3..], ["G80", "G0 Z.3", "G1 X5. Z0 F10."], "{lines:?}");
    // before a rapid, no other move is needed
    let lines = path_lines("", RETURNS, &format!("{cycle},{{\"rapid\":[5,0,2]}}"));
    assert_eq!(lines.iter().filter(|line| *line == "G0 Z.3").count(), 1, "only the way to the first hole: {lines:?}");
    // a cut after a rapid in X and Y also begins there
    let lines = path_lines("", RETURNS, &format!("{cycle},{{\"rapid\":[5,5]}},{{\"line\":[5,5,0]}}"));
    assert_eq!(lines[lines.len() - 4..], ["G80", "G0 X5. Y5.", "Z.3", "G1 Z0 F10."], "{lines:?}");
}

/// Without a return plane in the form, the tool stays low after a cycle. In another work offset it moves to the job's height.
#[test]
fn in_another_offset_the_tool_stays_at_the_jobs_height() {
    let form = "Drill\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel\nUpon [work]\nG[work]\nEnd";
    let cycle = "{\"cycle\":{\"kind\":\"drill\",\"depth\":0.5,\"clear\":0.1,\"return\":1.3,\"feed\":5,\"points\":[[0,0,-0.5]]}}";
    let lines = path_lines(
        "",
        form,
        &format!("{cycle},{{\"work\":55}},{{\"rapid\":[5,5]}},{{\"rapid\":[5,5,2]}},{{\"line\":[5,5,0]}}"),
    );
    let at = lines.iter().position(|line| line == "G55").unwrap_or_else(|| panic!("{lines:?}"));
    assert_eq!(lines[at + 1], "G0 X5. Y5. Z.8", "{lines:?}");
}

/// An operation with the same tool and another work offset begins at its first position, in whatever order its rapids give
/// the axes. The numbers of the last position in the work offset before are not used. The proof finds a rapid to them.
#[test]
fn in_another_work_offset_an_operation_begins_at_its_first_position() {
    let post = plain_post("haas.pf");
    let folder = Folder::new("first-position");
    folder.write("form.pf", &post);
    for (path, expected) in [
        (r#"{"rapid":[10,10]},{"rapid":[null,null,2]}"#, ["G55 X10. Y10.", "Z2."]),
        (r#"{"rapid":[null,null,2]},{"rapid":[10,10]}"#, ["G55 X10. Y10.", "Z2."]),
        (r#"{"rapid":[10]},{"rapid":[null,10,2]}"#, ["G55 X10. Y10.", "Z2."]),
    ] {
        let operation = |work: u32, path: &str| {
            format!(
                r#"{{"tool":1,"work":{work},"spindle":{{"speed":2000,"direction":"cw"}},"feed":100,"path":[{path}]}}"#
            )
        };
        let first = operation(54, r#"{"rapid":[0,0,20]},{"line":[0,0,-5]},{"line":[90,0,-5]}"#);
        let second = operation(55, &format!(r#"{path},{{"line":[10,10,-1]}},{{"rapid":[10,10,20]}}"#));
        let text = format!(
            r#"{{"postform":1,"program":1,"units":"mm","tools":[{{"number":1}}],"operations":[{first},{second}]}}"#
        );
        let lines = program(&post, &text);
        let words: Vec<&str> = lines.iter().map(|line| line.split_once(' ').map_or("", |(_, words)| words)).collect();
        let at = words.iter().position(|line| line.starts_with("G55")).unwrap_or_else(|| panic!("{lines:?}"));
        assert_eq!(words[at..at + 2], expected, "{path}: {lines:?}");
        folder.write("job.json", &text);
        folder.write("low.nc", lines.join("\n").replace(" Z2.", " Z-5.\nZ2."));
        let low = folder.run(&["verify", "job.json", "--form", "form.pf", "--nc", "low.nc"]);
        assert!(err(&low).contains("a rapid goes to X10 Y10 Z-5, which is below the job's rapids"), "{}", err(&low));
    }
}

/// A cycle directly after a change of the work offset. The height of the tool is a number of the offset before, so this
/// number does not decide whether the tool first moves up or across.
#[test]
fn a_cycle_in_another_work_offset_does_not_begin_at_a_height_of_the_offset_before() {
    let haas = plain_post("haas.pf");
    let bare = haas.replacen("\nUpon [work]\nG0 G53 Z0\nG[work] X[h] Y[v]\nEnd\n", "\n", 1);
    assert_ne!(bare, haas);
    let retracts = format!("{bare}\nWorkChange\nG0 G53 Z0\nG[work]\nEnd\n");
    let (above, unknown) = (["G55", "X5. Y5.", "Z2."], "PR017 the work offset changes before this move");
    let retracted = ["G0 G53 Z0", "G55", "X5. Y5.", "Z2."];
    let cut = r#"{"rapid":[0,0,20]},{"line":[0,0,-1]},{"line":[10,0,-1]}"#;
    for (form, end, expected) in [
        // up from 1 to 2 in the numbers, but down if the zero point of G55 is lower
        (&bare, r#",{"rapid":[10,0,1]}"#, Err(unknown)),
        (&bare, "", Err(unknown)),
        (&bare, r#",{"rapid":[10,0,20]}"#, Ok(&above[..])),
        // after the retract, the tool does not go down before it moves across
        (&retracts, r#",{"rapid":[10,0,1]}"#, Ok(&retracted[..])),
        (&retracts, "", Ok(&retracted[..])),
        (&retracts, r#",{"rapid":[10,0,20]}"#, Ok(&retracted[..])),
    ] {
        let cycle = r#"{"cycle":{"kind":"drill","depth":5,"clear":2,"feed":50,"points":[[5,5,0],[6,6,0]]}}"#;
        let keys = r#""spindle":{"speed":2000,"direction":"cw"},"feed":100"#;
        let first = format!(r#"{{"tool":1,"work":54,{keys},"path":[{cut}{end}"#);
        let head = r#"{"postform":1,"program":1,"units":"mm","tools":[{"number":1,"length_offset":1}],"operations":"#;
        for text in [
            format!(r#"{head}[{first},{{"work":55}},{cycle}]}}]}}"#),
            format!(r#"{head}[{first}]}},{{"tool":1,"work":55,{keys},"path":[{cycle}]}}]}}"#),
        ] {
            let lines = program(form, &text);
            let words: Vec<&str> =
                lines.iter().map(|line| line.split_once(' ').map_or("", |(_, words)| words)).collect();
            match expected {
                Err(message) => assert!(lines[0].starts_with(message), "{end}: {lines:?}"),
                Ok(blocks) => {
                    let at = words.iter().position(|words| *words == "G55").unwrap_or_else(|| panic!("{lines:?}"));
                    let from = at + 3 - blocks.len();
                    assert_eq!(words[from..from + blocks.len()], *blocks, "{end}: {lines:?}");
                }
            }
        }
    }
}

/// From the depth of a cut, the job goes to the height of a hole in another work offset. The program must not move across
/// at the depth of the cut, also if the number of the hole's height is lower.
#[test]
fn the_depth_of_a_cut_is_not_left_across_in_another_work_offset() {
    let folder = Folder::new("across-at-depth");
    folder.write("form.pf", plain_post("haas.pf"));
    let text = r#"{"postform":1,"program":1,"units":"mm","tools":[{"number":1}],"operations":[{"tool":1,"work":54,"spindle":{"speed":2000,"direction":"cw"},"feed":100,"path":[
        {"rapid":[0,0,20]},{"line":[0,0,-1]},{"line":[10,0,-1]},{"work":55},{"rapid":[5,5,-7]},{"line":[5,5,-9]},{"rapid":[5,5,20]}]}]}"#;
    folder.write("job.json", text);
    let printed = program(&plain_post("haas.pf"), text).join("\n");
    let number = printed.lines().find(|line| line.ends_with(" G0 G53 Z0")).unwrap().to_owned();
    for (between, message) in
        [("G55 X5. Y5. Z-7.", None), ("G55 X5. Y5.\nZ-7.", Some("crosses at Z-1 of the offset before"))]
    {
        let (before, after) = printed.split_once(&number).unwrap();
        let after = after.split_once(" Z-7.\n").unwrap().1;
        folder.write("program.nc", format!("{before}G0\n{between}\n{after}"));
        let verified = folder.run(&["verify", "job.json", "--form", "form.pf", "--nc", "program.nc"]);
        let found = err(&verified);
        assert_eq!(message.is_none(), verified.status.success(), "{between}: {found}");
        assert!(message.is_none_or(|message| found.contains(message)), "{between}: {found}");
    }
}

/// Some cycles are printed by the sequences of other cycles.
#[test]
fn some_cycles_are_made_as_others() {
    let forms = "Drill\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel\n\
        Custom1   Face\nG82 X[h] Y[v] Z[d] R[vclear] P[dwell] F[frate]\nEnd Cancel\n\
        Tap\nG84 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    let code = |cycle: &str| {
        let path = format!("{{\"cycle\":{{{cycle},\"clear\":0.1,\"feed\":5,\"points\":[[1,1,0]]}}}}");
        let lines = path_lines("RigidTap? Y", forms, &path);
        lines.iter().find(|line| line.contains("G8")).cloned().unwrap_or_else(|| format!("{lines:?}"))
    };
    let csink = "\"kind\":\"csink\",\"diameter\":0.5,\"angle\":90";
    assert_eq!(code("\"kind\":\"drill\",\"depth\":0.5,\"dwell\":2"), "G82 X1. Y1. Z-.5 R.1 P2 F5.");
    assert_eq!(code(csink), "G81 X1. Y1. Z-.25 R.1 F5.");
    assert_eq!(code("\"kind\":\"tap\",\"depth\":0.5,\"norevr\":true"), "G82 X1. Y1. Z-.5 R.1 P.5 F5.");
    assert_eq!(code("\"kind\":\"tap\",\"depth\":0.5,\"rapout\":true"), "G81 X1. Y1. Z-.5 R.1 F5.");
    let moves = code(&format!("{csink},\"hole_diameter\":0.2"));
    assert!(moves.starts_with('['), "moves: {moves}");
}

/// A facing cycle without a dwell uses the last dwell of an earlier cycle, or else the form's default. Pecks without a
/// depth use the default depths.
#[test]
fn what_a_cycle_leaves_out_is_known() {
    let cycle = |kind: &str, x: u8| {
        format!("{{\"cycle\":{{\"kind\":{kind},\"clear\":0.1,\"feed\":5,\"points\":[[{x},1,0]]}}}}")
    };
    let face = "Custom1   Face\nG82 X[h] Y[v] Z[d] R[vclear] P[dwell] F[frate]\nEnd Cancel";
    let alone = cycle("\"face\",\"depth\":0.5", 2);
    assert!(path_lines("", face, &alone).iter().any(|line| line.ends_with("P.5 F5.")));
    let after = format!("{},{alone}", cycle("\"ream\",\"depth\":0.5,\"dwell\":2", 1));
    assert!(path_lines("", face, &after).iter().any(|line| line.starts_with("G82") && line.ends_with("P2 F5.")));
    let pecks = path_lines("", "", &cycle("\"deep\",\"pecks\":[{\"to\":0.2},{\"to\":0.4}]", 1));
    assert!(pecks.iter().any(|line| line.starts_with("G1 Z-.4")), "{pecks:?}");
}

/// If the form has no word for the pecking mode of a tap, there is a note.
#[test]
fn how_a_tap_pecks_is_the_controls_setting() {
    let form = mill("RigidTap? Y", "Tap\nG84 X[h] Y[v] Z[d] R[vclear] Q[vbite] F[frate]\nEnd Cancel");
    let tap = "{\"cycle\":{\"kind\":\"tap\",\"mode\":\"deep\",\"step\":0.1,\"depth\":0.5,\"clear\":0.1,\"feed\":5,\
               \"points\":[[1,1,0]]}}";
    let notes = support::render(&form, &job(tap)).unwrap().notes;
    assert!(notes.iter().any(|note| note.code.name() == "PR021" && note.message.contains("`deep`")), "{notes:?}");
}

/// Each start of a thread is a separate tap, which begins a fraction of the lead lower than the one before.
#[test]
fn a_tap_of_several_starts_is_made_once_for_each() {
    let forms = "Tap\nG84 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    let tap = "{\"cycle\":{\"kind\":\"tap\",\"rigid\":true,\"starts\":2,\"depth\":0.5,\"clear\":0.2,\"feed\":100,\
               \"points\":[[1,1,0]]}}";
    let lines = path_lines("RigidTap? Y", forms, tap);
    let taps: Vec<&String> = lines.iter().filter(|line| line.contains("X1. Y1.") && line.contains('R')).collect();
    assert_eq!(taps, ["G84 X1. Y1. Z-.5 R.2 F100.", "X1. Y1. R.15"], "{lines:?}");
}

/// A cycle of the control that has several lines is also cancelled. Otherwise the next position would be a hole.
#[test]
fn a_cycle_on_several_lines_is_cancelled() {
    let cycle = "{\"cycle\":{\"kind\":\"drill\",\"depth\":0.5,\"clear\":0.1,\"feed\":5,\"points\":[[1,1,0],[2,2,0]]}}";
    let path = format!("{cycle},{{\"rapid\":[3,3,1]}}");
    let lines = path_lines("", "Drill\nG99\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel", &path);
    assert_eq!(lines[lines.len() - 2], "G80", "{lines:?}");
    // moves need no Cancel
    let lines = path_lines("", "Drill\nG0 X[h] Y[v]\nG1 Z[d] F[frate]\nG0 Z[rplane]\nEnd Cancel", &path);
    assert!(!lines.contains(&"G80".to_owned()), "{lines:?}");
}

/// LinuxCNC stops at a line that is too long, in the middle of the part. A long comment is continued in the next block.
#[test]
fn long_comments_keep_to_the_controls_line() {
    let text = "WORD ".repeat(80) + &"X".repeat(300);
    let path = format!("{{\"comment\":\"{text}\"}}");
    for (control, longest) in [("linuxcnc", 252), ("grbl", 80)] {
        let lines = path_lines(&format!("Control {control}\nSequence#s N 10 10"), "", &path);
        assert!(lines.iter().all(|line| line.len() <= longest), "{lines:?}");
        let all: String = lines.iter().filter_map(|line| line.split(['(', ')']).nth(1)).collect();
        assert_eq!(all.replace(' ', ""), text.replace(' ', ""));
    }
    assert_eq!(path_lines("", "", &path).iter().filter(|line| line.contains("WORD")).count(), 1);
}

/// An Upon for the bottom prints before a hole with another bottom, outside the control's cycle. An Upon that would
/// move to the bottom is left out.
#[test]
fn an_upon_of_the_bottom_prints_before_its_hole() {
    let points = "[[1,1,0],[2,2,0],[3,3,-0.2]]";
    let path =
        format!("{{\"cycle\":{{\"kind\":\"drill\",\"depth\":0.5,\"clear\":0.1,\"feed\":5,\"points\":{points}}}}}");
    let lines = path_lines("", &format!("Upon [d]\nM50\nEnd\n{DRILL}"), &path);
    let said: Vec<usize> = (0..lines.len()).filter(|&i| lines[i] == "M50").collect();
    assert!(said.len() >= 2, "{lines:?}");
    let next = lines[said[said.len() - 1]..].iter().find(|line| line.contains("G81"));
    assert!(next.unwrap().starts_with("G81 X3. Y3. Z-.7"), "{lines:?}");
    let moving = path_lines("", &format!("Upon [d]\nG1 Z[d] F1.\nEnd\n{DRILL}"), &path);
    assert!(!moving.iter().any(|line| line.starts_with("G1 Z-")), "{moving:?}");
}

/// Centre, radius and end angle define an arc completely. The next move prints its position.
#[test]
fn a_polar_arc_is_whole() {
    let path = "{\"line\":[0,0,0]},{\"arc\":{\"to\":[2,0],\"center\":[1,0],\"direction\":\"cw\"}},{\"line\":[0,0,0]}";
    let polar = "CwCode\nG11 I[hctr] J[vctr] R[arcrad] C[startang]\nG12 C[endang]\nEnd";
    let lines = path_lines("", polar, path);
    assert_eq!(lines[lines.len() - 3..lines.len() - 1], ["G11 I1. J0 R1. C180.", "G12 C0"], "{lines:?}");
    assert!(lines[lines.len() - 1].contains("X0 Y0"), "{lines:?}");
}

/// If a format would round the speed to zero, the spindle would not turn: this is an error.
#[test]
fn a_speed_does_not_vanish() {
    let slow = job("{\"line\":[1,0,1]}").replace("\"speed\":1000", "\"speed\":0.4");
    for form in [mill("", ""), mill("", "").replace("S[speed]", "S[speed*1]"), mill("", "").replace("S[speed] ", "")] {
        assert!(
            program(&form, &slow)[0].starts_with("PR002 [speed] is 0.4, but prints as 0"),
            "{:?}",
            program(&form, &slow)
        );
    }
    assert!(program(&mill("S >4.>1", ""), &slow).contains(&"S.4 M3".to_owned()));
    // a speed of 0 in the job is allowed
    let none = slow.replace("\"speed\":0.4", "\"speed\":0");
    assert!(program(&mill("", ""), &none).contains(&"S0 M3".to_owned()));
}

/// A cut with the spindle off has one warning for each operation.
#[test]
fn a_cut_with_the_spindle_off_is_told() {
    let notes = |path: &str| -> Vec<&'static str> {
        render(&mill("", ""), &job(path)).unwrap().notes.iter().map(|note| note.code.name()).collect()
    };
    let off = "{\"line\":[1,0,0]},{\"spindle\":{\"direction\":\"off\"}},";
    assert_eq!(notes(&format!("{off}{{\"rapid\":[2,0,1]}},{{\"line\":[2,0,0]}},{{\"line\":[3,0,0]}}")), ["PR055"]);
    assert_eq!(notes(&format!("{off}{{\"rapid\":[2,0,1]}}")), [""; 0]);
    let on = "{\"spindle\":{\"direction\":\"cw\"}},{\"line\":[3,0,0]}";
    assert_eq!(notes(&format!("{off}{on}")), [""; 0]);
}

/// An argument of a macro, or of a builder's code, is not the work offset, so the form's own word is printed before the positions.
#[test]
fn positions_count_from_the_offset_that_was_said() {
    for line in ["G65 P9000 W[work]", "M100 W[work]"] {
        let form = mill("", "").replace(
            "ToolChange\nT[tool] M6\nS[speed] M[direct]\nG0 G[work]",
            &format!("ToolChange\n{line}\nT[tool] M6\nG0"),
        );
        let form = form.replacen(
            &format!("1stToolChange\n{line}\nT[tool] M6\nG0"),
            "1stToolChange\nT[tool] M6\nG0 G[work]",
            1,
        );
        let second = "{\"tool\":2,\"work\":55,\"spindle\":{\"speed\":1000,\"direction\":\"cw\"},\"feed\":10,\"path\":[{\"rapid\":[1,0,1]},{\"line\":[2,0,0]}]}";
        let text = job("{\"line\":[1,0,0]}");
        let text = format!("{},{second}]}}", text.strip_suffix("]}").unwrap());
        let lines = program(&form, &text);
        let at = lines.iter().position(|line| line == "G55").unwrap_or_else(|| panic!("{lines:?}"));
        let place = lines.iter().position(|line| line == "G0 X1. Y0 Z1.").unwrap_or_else(|| panic!("{lines:?}"));
        assert!(at < place, "{lines:?}");
        // a macro may have left another work offset
        let again = lines[place..].iter().any(|line| line == "G55");
        assert_eq!(again, line.starts_with("G65"), "{lines:?}");
    }
}

/// `MoreWork` defines the words of fixtures for which `G[work]` has no code. Tool changes and separate blocks print them.
#[test]
fn more_work_names_further_offsets() {
    let path = "{\"line\":[1,0,0]},{\"work\":9},{\"rapid\":[1,0,1]},{\"work\":2},{\"rapid\":[2,0,1]}";
    let (more, last) = (mill("MoreWork 7 G54.1 P1", ""), mill("MoreWork 7 G54.1 P1\nMoreWork 9 G154 P1", ""));
    let printed = ["G0 G54 X0 Y0 Z1.", "G1 X1. Z0 F10.", "G54.1 P3", "G0 X1. Y0 Z1.", "G55", "X2. Y0 Z1.", "M30"];
    assert_eq!(program(&more, &job(path))[3..], printed);
    assert_eq!(program(&last, &job(path))[5], "G154 P1");
    let first = job("{\"line\":[1,0,0]}").replace("\"work\":54", "\"work\":8");
    assert_eq!(program(&more, &first)[3], "G0 G54.1 P2 X0 Y0 Z1.");
    // on a Siemens, G505 is the fifth offset
    let siemens = mill("Control siemens\nMoreWork 5 G505", "");
    assert_eq!(program(&siemens, &job(path))[5], "G509");
    // without `MoreWork`, or if the control lacks the code, the job is refused
    for commands in ["", "Control fanuc\nMoreWork 7 G400"] {
        let lines = program(&mill(commands, ""), &first);
        assert!(lines[0].starts_with("PR037"), "{commands}: {lines:?}");
    }
    // the last number ends the range: fixture 8 is P2, fixture 9 is after the last one
    let limited = mill("MoreWork 7 G54.1 P1 2", "");
    assert_eq!(program(&limited, &first)[3], "G0 G54.1 P2 X0 Y0 Z1.");
    assert!(program(&limited, &job(path))[0].starts_with("PR037"));
    for line in ["1 G54", "7 ¡1", "7 G54.1 ¡1", "7 54.1", "x G54", "7 G54.1 P", "7 G54.1 P1.x"] {
        let form = Source::from_text("form.pf", mill(&format!("MoreWork {line}"), ""));
        let error = Post::compile(form, &NoFiles).err().unwrap_or_else(|| panic!("{line} is taken"));
        assert!(error.findings().diags.iter().any(|diag| diag.code.name() == "PF302"), "{line}: {error}");
    }
}

/// A form may have several words for work offsets, and may print them after a text.
#[test]
fn a_form_has_several_words_for_its_offsets() {
    let more = "@if [work] > 59\nG54.1 P[work-59]\n@else\nG[work]\n@end\nG0 X[h] Y[v] Z[d]";
    let form = mill("", "").replace("G0 G[work] X[h] Y[v] Z[d]", more);
    let path = "{\"line\":[1,0,0]},{\"work\":9},{\"rapid\":[1,0,1]},{\"work\":2},{\"rapid\":[2,0,1]}";
    assert_eq!(
        program(&form, &job(path))[3..],
        ["G54", "G0 X0 Y0 Z1.", "G1 X1. Z0 F10.", "G54.1 P3", "G0 X1. Y0 Z1.", "G55", "X2. Y0 Z1.", "M30"]
    );
    let counted = format!(
        "Work 1\nWorkDefault 1\n{}",
        form.replace("> 59", "> 6").replace("-59]", "-6]").replace("G[work]", "G[work+53]")
    );
    assert_eq!(program(&counted, &job(path))[3..7], ["G54", "G0 X0 Y0 Z1.", "G1 X1. Z0 F10.", "G54.1 P3"]);
    let text = mill("", "WorkChange\n`PRESET `[work-53]\nEnd").replace("G0 G[work]", "`PRESET `[work-53]\nG0");
    let lines = program(&text, &job("{\"line\":[1,0,0]},{\"work\":55},{\"rapid\":[1,0,1]}"));
    assert_eq!(lines[3..], ["PRESET 1", "G0 X0 Y0 Z1.", "G1 X1. Z0 F10.", "PRESET 2", "G0 X1. Y0 Z1.", "M30"]);
}
