//! Sequences for blocks that are otherwise generated: operations, comments, stops, dwells, changes of conditions.

use crate::support::{mill, program};

/// A job of these operations: tool, further keys, path after the first rapid.
fn job(operations: &[(u32, &str, &str)]) -> String {
    let operations = operations.iter().map(|(tool, keys, path)| {
        format!("{{\"tool\":{tool},\"feed\":10,{keys}\"path\":[{{\"rapid\":[0,0,1]}},{path}]}}")
    });
    format!(
        "{{\"postform\":1,\"units\":\"inch\",\"tools\":[{{\"number\":1}},{{\"number\":2}}],\"operations\":[{}]}}",
        operations.collect::<Vec<_>>().join(",")
    )
}

const TURNS: &str = "\"work\":54,\"spindle\":{\"speed\":1000,\"direction\":\"cw\"},";
const LINE: &str = "{\"line\":[1,0,0]}";

/// The blocks after the first tool change, up to the end.
fn path(sequences: &str, job: &str) -> Vec<String> {
    let printed = program(&mill("", sequences), job);
    match printed.iter().position(|line| line.starts_with("G0 G54")) {
        Some(at) => printed[at + 1..printed.len() - 1].to_vec(),
        None => printed,
    }
}

#[test]
fn operations_begin_and_end() {
    let named = |name: &str| format!("{TURNS}\"name\":\"{name}\",");
    let job = job(&[(1, &named("face"), LINE), (1, &named("slot"), LINE), (2, &named("drill"), LINE)]);
    let sequences = "Operation\n(BEGIN [opname] WITH [tool])\nEnd\nEndOperation\n(END [opname] WITH [tool])\nEnd";
    assert_eq!(
        path(sequences, &job),
        [
            "(BEGIN FACE WITH 1)",
            "G1 X1. Z0 F10.",
            "(END FACE WITH 1)",
            "(BEGIN SLOT WITH 1)",
            "G0 X0 Z1.",
            "G1 X1. Z0",
            "(END SLOT WITH 1)",
            "T2 M6",
            "S1000 M3",
            "G0 G54 X0 Y0 Z1.",
            "(BEGIN DRILL WITH 2)",
            "G1 X1. Z0 F10.",
            "(END DRILL WITH 2)",
        ]
    );
}

#[test]
fn an_operation_that_says_its_comment_says_it_alone() {
    let keys = format!("{TURNS}\"comment\":\"rough\",");
    let sequences = "Operation\n(NOW [optext])\nEnd";
    let printed = program(&mill("", sequences), &job(&[(1, &keys, LINE)]));
    assert_eq!(printed.iter().filter(|line| line.contains("ROUGH")).collect::<Vec<_>>(), ["(NOW ROUGH)"]);
}

#[test]
fn comments_stops_and_dwells_are_the_forms_own() {
    let items =
        "{\"comment\":\"look\"},{\"stop\":\"program\"},{\"stop\":\"optional\"},{\"dwell\":2.5},{\"line\":[1,0,1]}";
    let job = job(&[(1, TURNS, items)]);
    let sequences = "CommentLine\n`MSG(\"`[text]`\")`\nEnd\nStop\nM0 (STOP)\nEnd\nOptStop\n`M01 P1`\nEnd\nDwellBlock\nG4 X[dwell]\nEnd";
    let printed = path(sequences, &job);
    for line in ["MSG(\"look\")", "M0 (STOP)", "M01 P1", "G4 X2.5"] {
        assert!(printed.contains(&line.to_owned()), "{line}: {printed:?}");
    }
    // one Stop sequence prints both kinds of stops
    let printed = path("Stop\nM[stop] (HALT)\nEnd", &job);
    assert!(printed.contains(&"M0 (HALT)".to_owned()) && printed.contains(&"M1 (HALT)".to_owned()), "{printed:?}");
    // if the sequence does not print the dwell, a generated block prints it
    let printed = path("DwellBlock\n(WAIT)\nEnd", &job);
    let at = printed.iter().position(|line| line == "(WAIT)").unwrap();
    assert_eq!(printed[at + 1], "G4 P2.5");
}

#[test]
fn changes_of_conditions_are_the_forms_own() {
    let items =
        "{\"spindle\":{\"speed\":500}},{\"coolant\":\"on\"},{\"line\":[1,0,1]},{\"work\":55},{\"rapid\":[0,0,2]}";
    let job = job(&[(1, TURNS, items)]);
    let sequences = "SpindleChange\n(NEW SPEED) S[speed]\nEnd\nCoolantChange\nM[cool] (COOLANT)\nEnd\nWorkChange\nG[work] (OFFSET)\nEnd";
    let printed = path(sequences, &job);
    for line in ["(NEW SPEED) S500", "M8 (COOLANT)", "G55 (OFFSET)"] {
        assert_eq!(printed.iter().filter(|own| *own == line).count(), 1, "{line}: {printed:?}");
    }
    // the sequence does not print the coolant code, so postform generates the code once after the sequence
    let printed = path("CoolantChange\n(COOLANT)\nEnd", &job);
    let at = printed.iter().position(|line| line == "(COOLANT)").unwrap();
    assert_eq!(printed[at + 1], "M8", "{printed:?}");
    let feeds = job_with_feed_mode();
    assert!(path("FeedModeChange\nG[feedtype] (FEED)\nEnd", &feeds).contains(&"G95 (FEED)".to_owned()));
}

fn job_with_feed_mode() -> String {
    let per_rev = format!("{TURNS}\"feed_mode\":\"per_rev\",").replace("\"feed\":10,", "");
    job(&[(1, TURNS, LINE), (1, &per_rev, LINE)])
}

#[test]
fn numbers_may_have_no_letter_and_lines_another_end() {
    let text = mill("Sequence#s - 0 1\nLineEnd crlf", "");
    let printed = crate::support::render(&text, &job(&[(1, TURNS, LINE)])).unwrap().text;
    let lines: Vec<&str> = printed.split("\r\n").collect();
    assert_eq!(lines[..3], ["%", "0 T1 M6", "1 S1000 M3"]);
    assert!(printed.ends_with("\r\n") && !printed.replace("\r\n", "").contains(['\r', '\n']));
}

/// A comment that the selected branch does not print is generated, even if another branch prints it.
#[test]
fn a_comment_that_only_another_branch_says_is_not_lost() {
    let keys = format!("{TURNS}\"name\":\"slot\",\"comment\":\"mind the clamp\",");
    let sequences = "Operation\n@if [opname] like \"rough*\"\n  (R [optext])\n@else\n  (X)\n@end\nEnd";
    let printed = program(&mill("", sequences), &job(&[(1, &keys, LINE)]));
    let comments: Vec<_> = printed.iter().filter(|line| line.starts_with('(')).collect();
    assert_eq!(comments, ["(MIND THE CLAMP)", "(X)"]);
}

/// Only the form defines the home position. After a move home, the position is unknown, so every axis is printed again.
#[test]
fn home_is_a_place_of_the_machine() {
    let home = |form: &str, items: &str| path(form, &job(&[(1, TURNS, items)]));
    let goes = "MoveHome\nG91 G28 Z0\nG90\nEnd";
    let path = format!("{LINE},{{\"rapid\":[1,0,1]}},{{\"home\":true}},{{\"rapid\":[1,0,1]}},{LINE}");
    assert_eq!(home(goes, &path), ["G1 X1. Z0 F10.", "G0 Z1.", "G91 G28 Z0", "G90", "X1. Y0 Z1.", "G1 Z0"]);
    // changes that wait for the next move are printed before the move home
    let off = format!("{LINE},{{\"rapid\":[1,0,1]}},{{\"spindle\":{{\"direction\":\"off\"}}}},{{\"home\":true}}");
    assert_eq!(home(goes, &off)[1..], ["G0 Z1.", "M5", "G91 G28 Z0", "G90"]);
    // a cut directly after a move home has no known start
    let cut = format!("{LINE},{{\"home\":true}},{{\"line\":[0,0,0]}}");
    assert!(home(goes, &cut)[0].starts_with("PR012 the operation begins with a cut"), "{:?}", home(goes, &cut));
    assert!(home("", &path)[0].starts_with("PR008 the tool goes home here"), "{:?}", home("", &path));
    assert!(home(goes, "{\"home\":false}")[0].starts_with("PJ003 `home` is false"));
}
