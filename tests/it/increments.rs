//! `Incremental? Y`: an increment is printed only from a position that the control certainly has.

use crate::support::{job, mill, path_lines, program};

fn increments(sequences: &str, path: &str) -> Vec<String> {
    path_lines("Incremental? Y", sequences, path)
}

#[test]
fn increments_count_from_what_the_tool_change_printed() {
    assert_eq!(increments("", "{\"line\":[1,0,1]},{\"line\":[1,2,0.5]}"), ["G1 X1. F10.", "Y2. Z-.5"]);
    // this tool change does not print the height, so the height is unknown
    let low = mill("Incremental? Y", "").replace(" Z[d]", "");
    assert!(program(&low, &job("{\"line\":[1,0,0]}"))[0].starts_with("PR001 an increment of Z"));
}

#[test]
fn nothing_is_known_after_what_moves_the_frame_or_the_tool() {
    for item in ["{\"work\":55}", "{\"text\":\"G28 X0\"}"] {
        let lines = increments("", &format!("{{\"line\":[1,0,1]}},{item},{{\"line\":[2,0,1]}}"));
        assert!(lines[0].starts_with("PR001 an increment of X"), "{item}: {lines:?}");
    }
}

#[test]
fn a_cycle_that_prints_positions_is_printed_as_moves() {
    let path = "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[1,1,0]]}}";
    let drill = "Drill\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    let moves = ["G0 X1. Y1.", "Z-.9", "G1 Z-1.1 F5.", "G0 Z1.1"];
    assert_eq!(increments(drill, path), moves);
    // a form may print G90 itself
    let own = drill.replace("G81", "G90 G81");
    assert_eq!(increments(&own, path)[2], "G90 G81 X1. Y1. Z-1. R.1 F5.");
}

#[test]
fn a_control_left_in_the_other_distance_mode_is_an_error() {
    let path = "{\"work\":55},{\"rapid\":[1,0,1]}";
    let leaves = "Upon [work]\nG[work] G91 G28 Z0\nEnd";
    assert!(path_lines("", leaves, path)[0].starts_with("PR040 the control is in G91"));
    let mends = leaves.replace("Z0\n", "Z0\nG90\n");
    assert_eq!(path_lines("", &mends, path), ["G55 G91 G28 Z0", "G90", "G0 X1. Y0 Z1."]);
}

#[test]
fn compensation_keeps_the_height_that_increments_led_to() {
    let own = "RapidCode\nG0 X[hdist] Y[vdist] Z[ddist]\nEnd\nInFeed\nG1 G[side] D[dcomp] X[hdist] Y[vdist] F[frate]\nEnd\n\
               OutFeed\nG1 G40 X[hdist] Y[vdist] F[frate]\nEnd";
    let path = r#"{"rapid":[0,0,-0.1]},{"infeed":[0,1],"side":"left"},{"outfeed":[1,1]}"#;
    assert_eq!(increments(own, path), ["G0 Z-1.1", "G1 G41 D21 X0 Y1. F10.", "G1 G40 X1. Y0 F10."]);
    let down = increments(own, r#"{"infeed":[0,1,0],"side":"left"}"#);
    assert!(down[0].starts_with("PR017"), "{down:?}");
}

#[test]
fn a_cycle_may_say_g90_for_its_positions() {
    let drill = "Drill\nG90 G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    let form = format!("Cancel\nG80 G91\nEnd\n{drill}");
    let form = mill("Incremental? Y", "").replace("Cancel\nG80\nEnd", &form);
    let path =
        r#"{"cycle":{"kind":"drill","depth":1,"clear":0.1,"feed":5,"points":[[1,1,0],[2,1,0]]}},{"rapid":[0,0,1]}"#;
    let lines = program(&form, &job(path));
    let at = lines.iter().position(|line| line.starts_with("G90")).unwrap();
    assert_eq!(lines[at..at + 3], ["G90 G81 X1. Y1. Z-1. R.1 F5.", "X2.", "G80 G91"], "{lines:?}");
}

#[test]
fn a_higher_hole_after_g90_is_not_approached_by_an_increment() {
    let drill = "Drill\nG90 G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    let path = r#"{"cycle":{"kind":"drill","depth":1,"clear":0.1,"feed":5,"points":[[1,1,2],[2,1,5]]}}"#;
    let lines = increments(drill, path);
    assert!(lines[0].starts_with("PR040"), "{lines:?}");
}

/// An Upon moves to the position that it prints. The rest of the move counts from that position.
#[test]
fn increments_count_from_what_an_upon_printed() {
    let rapid = "RapidCode\nG0 X[hdist] Y[vdist] Z[ddist]\nEnd";
    let upon = |words: &str| format!("Upon [work]\nG91 G28 Z0\nG90 G[work] G0 {words}\nG91\nEnd\n{rapid}");
    let path = r#"{"rapid":[0,0,2]},{"work":55},{"rapid":[1,2,1]},{"rapid":[2,2,1]}"#;
    let lines = increments(&upon("X[h] Y[v] Z[d]"), path);
    assert_eq!(lines, ["G0 Z1.", "G91 G28 Z0", "G90 G55 G0 X1. Y2. Z1.", "G91", "X1."]);
    let without = increments(&upon("X[h] Y[v]"), path);
    assert!(without[0].starts_with("PR001 [ddist] has no value here"), "{without:?}");
    // without the Upon, the position in the new work offset is unknown
    let bare = increments(rapid, path);
    assert!(bare[0].starts_with("PR001 [hdist] has no value here"), "{bare:?}");
}
