//! Expressions and conditions: calculated values, the lines that print, and errors.

use crate::support::{check, job, mill, path_lines, program, render, render_checked};
use postform::internals::render::Options;

/// The error codes of a form, each once.
fn codes(form: &str) -> Vec<&'static str> {
    let mut codes: Vec<_> =
        check(form).diags.iter().filter(|diag| diag.is_error()).map(|diag| diag.code.name()).collect();
    codes.dedup();
    codes
}

/// A form whose first tool change prints these lines before all others.
fn form(head: &str, lines: &str) -> String {
    mill(head, "").replacen("1stToolChange\n", &format!("1stToolChange\n{lines}\n"), 1)
}

/// The output of these lines at X0 Y0 Z1, S1000 M3, tool 1, work offset 54.
fn lines(lines: &str) -> Vec<String> {
    let printed = program(&form("", lines), &job("{\"line\":[1,1,0]}"));
    match printed.iter().position(|line| line == "T1 M6") {
        Some(end) => printed[1..end].to_vec(),
        None => printed,
    }
}

#[test]
fn expressions_print_their_value() {
    let table = [
        ("Q[d+1]", "Q2."),
        ("Q[d-.25]", "Q.75"),
        ("Q[ (d+3) / 2 ]", "Q2."),
        ("Q[-d]", "Q-1."),
        ("Q[d - -d*2]", "Q3."),
        ("Q[7/2]", "Q3.5"),
        ("S[speed*1.5]", "S1500"),
        ("Q[min(d, 0.5, 9)] Q[max(d, 0.5)]", "Q.5 Q1."),
        ("Q[abs(-d)+round(2.5)+floor(-.5)+ceil(.2)]", "Q4."),
        ("`Q200=`[d*2]` Q201=`[-d]", "Q200=2 Q201=-1"),
        ("(CLEAR [d*2] OF [d])", "(CLEAR 2 OF 1)"),
        ("(WHAT [vclear+1])", "(WHAT -)"),
        ("H[tool+10]", "H11"),
        ("Q[((((((((((((((((((((((((((((((((d))))))))))))))))))))))))))))))))]", "Q1."),
    ];
    for (line, printed) in table {
        assert_eq!(lines(line), [printed], "{line}");
    }
}

#[test]
fn a_calculated_word_is_modal_like_its_letter() {
    let head = "ModalLetters X Y Z F S Q";
    let sequences = "LineCode\nG1 X[h] Y[v] Z[d] Q[d*2] F[frate]\nEnd\n";
    let path = "{\"line\":[1,0,1]},{\"line\":[2,0,1]},{\"line\":[3,0,2]}";
    assert_eq!(path_lines(head, sequences, path), ["G1 X1. Q2. F10.", "X2.", "X3. Z2. Q4."]);
}

/// If a form limits the spindle speed by a calculation, the job's speed is not printed again.
#[test]
fn a_speed_that_the_form_limits_stays() {
    let text = mill("", "").replace("S[speed] M", "S[min(speed,800)] M");
    let printed = program(&text, &job("{\"line\":[1,1,0]}"));
    let speeds: Vec<_> = printed.iter().filter(|line| line.contains('S')).collect();
    assert_eq!(speeds, ["S800 M3"]);
}

/// A calculated word may print a condition, such as the work offset. postform then prints no other word for this
/// condition.
#[test]
fn a_calculated_condition_is_said() {
    let offsets = [
        ("G15 H[work-53]", vec!["G15 H1 G0 X0 Y0 Z1.", "G1 X1. Y1. Z0 F10.", "G15 H3", "G0 X1. Y1. Z2.", "G1 Y2. Z0"]),
        (
            "`G54.1` P[work-50]",
            vec!["G54.1 P4 G0 X0 Y0 Z1.", "G1 X1. Y1. Z0 F10.", "G54.1 P6", "G0 X1. Y1. Z2.", "G1 Y2. Z0"],
        ),
        ("G[work+0]", vec!["G54 G0 X0 Y0 Z1.", "G1 X1. Y1. Z0 F10.", "G56", "G0 X1. Y1. Z2.", "G1 Y2. Z0"]),
    ];
    for (word, lines) in offsets {
        let text = mill("", "").replace("G0 G[work] X", &format!("{word} G0 X"));
        let path = "{\"line\":[1,1,0]},{\"work\":56},{\"rapid\":[1,1,2]},{\"line\":[1,2,0]}";
        let printed = program(&text, &job(path));
        assert_eq!(printed[3..printed.len() - 1], lines, "{word}");
    }
    let text = mill("", "").replace("M[direct]", "M[direct+0]");
    let printed = program(&text, &job("{\"line\":[1,1,0]}"));
    assert_eq!(printed.iter().filter(|line| line.ends_with(" M3")).count(), 1, "{printed:?}");
}

/// A value that a list counts can be used after the list.
#[test]
fn what_a_list_sets_is_asked_behind_it() {
    let asked = "@set val1 = 0\n@for tool\n@if [tool] > 0\n@set val1 = [val1]+1\n@end\n@end\n([val1] TOOLS)\n@if [val1] > 1\n(MANY)\n@else\n(ONE)\n@end";
    let text = mill("", "").replacen("%0\n", &format!("%0\n{asked}\n"), 1);
    let one = job("{\"line\":[1,1,0]}");
    let two = one.replace(
        "\"operations\":[",
        "\"operations\":[{\"tool\":2,\"spindle\":{\"speed\":500,\"direction\":\"cw\"},\"feed\":9,\"path\":[{\"rapid\":[0,0,1]},{\"line\":[0,0,0]}]},",
    );
    assert_eq!(program(&text, &one)[1..3], ["(1 TOOLS)", "(ONE)"]);
    assert_eq!(program(&text, &two)[1..3], ["(2 TOOLS)", "(MANY)"]);
}

/// The conditions of a sequence can't use a value that an Upon sets, because they are evaluated before the Upon prints.
#[test]
fn what_an_upon_sets_is_not_asked_before_it() {
    let upon = |set: &str, asks: &str| {
        let own = format!("Upon [work]\n@set {set} = [work]\n([{set}])\nEnd\nOptStop\n{asks}\nM1\nEnd");
        codes(&mill("Property note number 0 What is noted", &own))
    };
    for set in ["val1", "note"] {
        assert_eq!(upon(set, &format!("@if [{set}] = 55\n(IS 55)\n@end")), ["PF707"]);
        assert_eq!(upon(set, &format!("@set val2 = [{set}]+1")), ["PF707"]);
        assert_eq!(upon(set, &format!("([{set}])\n@if [val3] = 55\n(IS 55)\n@end")), [""; 0]);
    }
}

/// Blanks before a directive are indentation. Other indented text that begins with `@` is a comment.
#[test]
fn an_indented_directive_is_one() {
    assert_eq!(lines("@set val1 = 1\n  @set val1 = 2\n([val1])\n\t@set val1 = 3\n([val1])"), ["(2)", "(3)"]);
    assert_eq!(lines("  @if [tool] = 1\n    (ONE)\n  @end\n  @see the manual"), ["(ONE)"]);
}

/// `@set` with a variable that has no value is an error, so that a value of another cycle is not used.
#[test]
fn what_is_set_of_no_value_is_an_error() {
    let drill = |set: &str| {
        let form = format!("Drill\n{set}\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\n(W [val1])\nG80\nEnd");
        let hole = "{\"cycle\":{\"kind\":\"drill\",\"depth\":2,\"clear\":0.1,\"feed\":10,\"points\":[[1,1,0]]}}";
        path_lines("", &form, hole)
    };
    assert!(drill("@set val1 = [dwell]*1000")[0].starts_with("PR001"), "{:?}", drill("@set val1 = [dwell]*1000"));
    assert!(drill("@set val1 = 7\n@if [dwell]\n@set val1 = [dwell]*1000\n@end").contains(&"(W 7)".to_owned()));
}

/// `@set` runs after the line before it, so `[block]` is then the number of the next block.
#[test]
fn a_number_is_set_behind_its_line() {
    let text = mill("Sequence#s N 1 1", "").replacen(
        "1stToolChange\n",
        "1stToolChange\n(A)\n@set val1 = [block]\n([val1])\n",
        1,
    );
    let printed = program(&text, &job("{\"line\":[1,1,0]}"));
    assert_eq!(printed[1..3], ["N1 (A)", "N2 (2)"]);
}

/// On a lathe, one word selects station and offset register. This word may be calculated.
#[test]
fn a_calculated_word_says_which_tool() {
    let form = "Machine Lathe\n1stToolChange\nT[tool*101]\nG97 S[speed] M[direct]\nEnd";
    assert!(check(form).diags.iter().all(|diag| diag.code.name() != "PF429"), "{:?}", check(form).diags);
}

/// Every arc prints its centre, even if the centre word is calculated.
#[test]
fn a_calculated_centre_is_no_place_that_stays() {
    let sequences = "CwCode\nG2 X[h] Y[v] I[ival*1] J[jval*1] F[frate]\nEnd\n";
    let arc = |x: u32| format!("{{\"arc\":{{\"to\":[{x},0,1],\"center\":[{},0,1],\"direction\":\"cw\"}}}}", x - 1);
    let lines = path_lines("ModalLetters X Y Z F S I J", sequences, &format!("{},{}", arc(2), arc(4)));
    assert_eq!(lines, ["G2 X2. I1. J0 F10.", "X4. I1. J0"]);
}

/// Text that touches a value would be read as part of the number. This applies to variables and to calculations.
#[test]
fn nothing_stands_beside_a_calculated_value() {
    for word in ["G5[tool+3]", "G5[tool]", "X-[h-7]", "X-[h]"] {
        assert_eq!(codes(&form("", word)), ["PF001"], "{word}");
    }
}

#[test]
fn a_calculated_position_is_one_that_the_control_counts_otherwise() {
    let sequences = "LineCode\nG1 X[h+10] Y[v] Z[d] F[frate]\nEnd\n";
    let path = "{\"line\":[1,0,1]},{\"line\":[1,1,1]}";
    assert_eq!(path_lines("", sequences, path), ["G1 X11. F10.", "X11. Y1."]);
}

#[test]
fn heights_are_distances() {
    let drill = "Drill 1\n`CYCL DEF 200 Q200=`[vclear-pointd]` Q201=`[-depth]` Q203=`[pointd]` Q204=`[rplane-pointd]` Q206=`[frate]\n\
                 L X[h] Y[v] M99\nEnd\n";
    let path = "{\"cycle\":{\"kind\":\"drill\",\"depth\":2,\"clear\":0.1,\"return\":1,\"feed\":10,\"points\":[[1,1,0],[2,1,0],[2,2,-0.5]]}}";
    let printed = path_lines("", drill, path);
    let cycle = |top: &str, back: &str| format!("CYCL DEF 200 Q200=.1 Q201=-2 Q203={top} Q204={back} Q206=10");
    assert_eq!(
        printed,
        [
            cycle("0", "1"),
            "L X1. Y1. M99".into(),
            "L X2. Y1. M99".into(),
            "G0 Y2.".into(),
            "Z1.".into(),
            cycle("-.5", "1.5"),
            "L X2. Y2. M99".into()
        ]
    );
}

#[test]
fn a_division_by_zero_is_an_error_with_its_place() {
    for (lines, place) in [
        ("Q[1/(d-1)]", "Q[1/(d-1)]"),
        ("(A REMARK [1/(d-1)])", "[1/(d-1)]"),
        ("@set val1 = 1/([d]-1)", "val1 = 1/([d]-1)"),
        ("@if 1/([d]-1) > 2\nM1\n@end", "@if 1/([d]-1) > 2"),
    ] {
        let form = form("", lines);
        let error = render(&form, &job("{\"line\":[1,1,0]}")).unwrap_err();
        assert_eq!((error.code.name(), error.message.as_str()), ("PR051", "a division by zero"), "{lines}");
        let shown: Vec<&str> = error.labels.iter().map(|label| &form[label.span.range()]).collect();
        assert!(["d-1", "[d]-1"].contains(&shown[0].trim_matches(['(', ')'])), "{shown:?}");
        assert_eq!(shown[1], place, "{lines}");
    }
}

#[test]
fn conditions_choose_lines() {
    let holds = |condition: &str| {
        let printed = lines(&format!("@if {condition}\n  M100\n@else\n  M200\n@end"));
        match printed.as_slice() {
            [line] => line == "M100",
            other => panic!("{condition}: {other:?}"),
        }
    };
    for condition in [
        "[speed] = 1000",
        "[speed] <> 999",
        "[speed] > 999 and [speed] < 1001",
        "[speed]>=1000 and [speed]<=1000",
        "[direct] = cw",
        "not [direct] = ccw",
        "[cool] = off",
        "([speed] = 1 or [tool] = 1) and [work] = 54",
        "[speed] = 1 or [speed] = 1000 and [tool] = 1",
        "[speed]",
        "not [vclear]",
        "not [vclear] > 0",
        "[isfirsttool]",
        "[isfirsttool] = yes",
        "not [lasthole]",
        "[speed/2] = 500",
        "[speed]/2 = 500",
        "max([speed], 3000) = 3000",
        "[progname] = \"\"",
        "not [progname]",
        "[control] like \"*\"",
        "[unitmode] = inch",
    ] {
        assert!(holds(condition), "{condition}");
    }
    for condition in ["[vclear] > 0", "[vclear] <= 0", "[direct] = ccw", "[progname]", "[tool] > 1", "[lasthole]"] {
        assert!(!holds(condition), "{condition}");
    }
}

#[test]
fn numbers_are_compared_as_they_print() {
    // 12.7 mm are 0.49999999999999994 inches
    let text = form("Units both", "@if [toold] = 0.5 and [toold] >= .5 and not [toold] < 0.5 and not [toold] <> 1/2\nM1\n@end\n\
                     Q[floor(toold*2)] R[ceil(toold*2)] P[round(toold)]\n@if [toold] < .5001 and [toold] > .4999\nM2\n@end")
        .replace("StartCode\n%0\n", "StartCode\n%0\nG[unitmode]\n");
    let job = job("{\"line\":[1,1,0]}")
        .replace("\"inch\"", "\"mm\"")
        .replace("\"number\":1,", "\"number\":1,\"diameter\":12.7,");
    let inches = Options { units: Some(postform::toolpath::Units::Inch), ..Options::default() };
    let printed = render_checked(&check(&text), job.as_bytes(), false, inches).unwrap().text;
    let lines: Vec<&str> = printed.lines().collect();
    assert_eq!(lines[2..5], ["M1", "Q1. R1. P1", "M2"], "{printed}");
    // a clearance of 0.2 above a point at height 0.1
    let drill = "Drill\n@if [vclear] = 0.3\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\n@else\nG82 X[h] Y[v] Z[d] R[vclear] F[frate]\n@end\nEnd Cancel\n";
    let path = "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.2,\"feed\":5,\"points\":[[1,0,0.1]]}}";
    assert!(path_lines("", drill, path).iter().any(|line| line.starts_with("G81")));
    // a divisor that is only a rounding error counts as zero
    let drill = "Drill\nG81 X[h] Y[v] Z[d] R[vclear] Q[1/(vclear-0.3)] F[frate]\nEnd Cancel\n";
    assert_eq!(path_lines("", drill, path), ["PR051 a division by zero"]);
}

#[test]
fn branches_lie_in_each_other() {
    let text = "@if [tool] = 1\n  M1\n  @if [speed] > 5000\n    M2\n  @elif [speed] > 500\n    M3\n  @else\n    M4\n  @end\n  M5\n@elif [tool] = 1\nM6\n@end\nM7";
    assert_eq!(lines(text), ["M1", "M3", "M5", "M7"]);
    // after the last @end, indented text is a comment again
    assert_eq!(lines("@if [tool] = 2\n   M1\n@end\n  M2\nM3"), ["M3"]);
    assert_eq!(lines("@if [tool] = 1 # the first\n\tM1 # and so on\n@END # over"), ["M1"]);
}

#[test]
fn old_text_with_an_at_sign_stays_text() {
    assert_eq!(lines("@714\n`@if`"), ["@714", "@if"]);
}

#[test]
fn what_is_set_holds_to_the_end() {
    let sequences = "LineCode\n@set val2 = [val2]*2\nG1 X[h] Y[v] Z[d] F[frate] Q[val2]\nEnd\n";
    let head = "Ask val2 \"Q\" 1\nModalLetters X Y Z F S";
    let path = "{\"line\":[1,0,1]},{\"line\":[2,0,1]},{\"line\":[3,0,1]}";
    assert_eq!(path_lines(head, sequences, path), ["G1 X1. F10. Q2.", "X2. Q4.", "X3. Q8."]);
    // a condition after it uses the new value
    let text = "@set val1 = 3\n@if [val1] = 3\nM3\n@end\n@set val1 = [val1]+1\n@if [val1] = 4\nM4\n@end\n(IS [val1])";
    assert_eq!(lines(text), ["M3", "M4", "(IS 4)"]);
}

const CYCLE: &str = "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[1,0,0],[2,0,0],\
                     {\"at\":[3,0,0],\"depth\":3},{\"at\":[4,0,0],\"depth\":3},[5,0,0]]}}";

#[test]
fn a_hole_of_another_branch_begins_the_cycle_anew() {
    let drill = "Drill\n@if [depth] > 2\n  G83 X[h] Y[v] Z[d] R[vclear] Q.5 F[frate]\n@else\n  G81 X[h] Y[v] Z[d] R[vclear] F[frate]\n@end\nEnd Cancel\n";
    assert_eq!(
        path_lines("", drill, CYCLE),
        [
            "G0 X1.",
            "Z.1",
            "G81 X1. Y0 Z-1. R.1 F5.",
            "X2.",
            "G80",
            "G0 X3.",
            "Z.1",
            "G83 X3. Y0 Z-3. R.1 Q.5 F5.",
            "X4.",
            "G80",
            "G0 X5.",
            "Z.1",
            "G81 X5. Y0 Z-1. R.1 F5.",
            "G80",
        ]
    );
}

/// Three holes. The second and the third are lower than the first.
const STEPPED: &str =
    "{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[1,0,0],[2,0,-2],[3,0,-2]]}}";

/// The blocks of these holes that begin with `Q`, `C` or `P`, and the blocks `G80`.
fn of_stepped_holes(head: &str, drill: &str) -> Vec<String> {
    let mut printed = path_lines(head, &format!("Drill{drill}\nEnd Cancel\n"), STEPPED);
    printed.retain(|line| line.starts_with(['Q', 'C', 'P']) || line == "G80");
    printed
}

#[test]
fn a_cycle_begins_anew_where_its_counted_lines_would_print_another_value() {
    const HOLE: &str = "G81 X[h] Y[v] Z[d] R[vclear] F[frate]";
    let top = "Property top number 0 Top";
    for (head, begins) in [
        ("", "`Q203=`[pointd]"),
        ("", "@set val1 = [pointd]\n`Q203=`[val1]"),
        ("", "@set val1 = [pointd]\n@set val2 = [val1]\n`Q203=`[val2*1]"),
        (top, "@set top = [pointd]\n`Q203=`[top]"),
        // with another letter than in the repeated lines
        ("", "`Q203=`[d+1]"),
    ] {
        let printed = of_stepped_holes(head, &format!(" 1\n{begins}\n{HOLE}"));
        assert_eq!(printed, ["Q203=0", "G80", "Q203=-2", "G80"], "{begins}");
    }
    // `@set` after the lines that print the value
    let printed = of_stepped_holes("Ask val1 \"Q\" 7", &format!(" 1\n`Q203=`[val1]\n@set val1 = 8\n{HOLE}"));
    assert_eq!(printed, ["Q203=7", "G80", "Q203=8", "G80"]);
}

#[test]
fn what_a_cycle_sets_is_set_at_every_hole() {
    let head = "Ask val1 \"Q\" 0";
    for drill in [
        " 1\n@set val1 = [val1]+1\nG81 Z-1 R1 F[frate] K0\n`C`[val1] X[h] Y[v] Z[d] R[vclear] F[frate]",
        " 1\nG81 Z-1 R1 F[frate] K0\n@set val1 = [val1]+1\n`C`[val1] X[h] Y[v] Z[d] R[vclear] F[frate]",
    ] {
        let printed = of_stepped_holes(head, drill);
        let counts: Vec<&str> = printed.iter().filter_map(|line| line.split(' ').next()).collect();
        assert_eq!(counts, ["C1", "C2", "C3", "G80"], "{drill}");
    }
}

#[test]
fn a_cycle_of_one_line_begins_anew_where_a_value_without_a_letter_changes() {
    for value in ["[pointd]", "[pointd*1]", "[val1]"] {
        let drill = format!("\n@set val1 = [pointd]\n`Q203=`{value} G81 X[h] Y[v] Z[d] R[vclear] F[frate]");
        assert_eq!(
            of_stepped_holes("", &drill),
            ["Q203=0 G81 X1. Y0 Z-1. R.1 F5.", "G80", "Q203=-2 G81 X2. Y0 Z-3. R-1.9 F5.", "G80"],
            "{value}"
        );
    }
}

#[test]
fn counted_lines_are_counted_along_each_branch() {
    let drill = "Drill 1\n@if [depth] > 2\n  G83 Z[d] R[vclear] Q.5 F[frate] K0\n@else\n  G81 Z[d] R[vclear] F[frate] K0\n@end\nX[h] Y[v]\nEnd Cancel\n";
    let printed = path_lines("", drill, CYCLE);
    assert_eq!(
        printed.iter().filter(|line| line.starts_with("G81") || line.starts_with("G83")).count(),
        3,
        "{printed:?}"
    );
    assert_eq!(printed.iter().filter(|line| line.starts_with('X')).count(), 5, "{printed:?}");
    assert_eq!(codes(&mill("", "Drill 2\n@if [depth] > 2\nG83\nG4\n@else\nG81\n@end\nEnd")), ["PF401"]);
}

#[test]
fn a_branch_that_does_not_say_the_hole_is_refused() {
    let drill = "Drill\n@if [depth] > 2\nG83 X[h] Y[v] R[vclear] Q.5 F[frate]\n@else\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\n@end\nEnd Cancel\n";
    let printed = path_lines("", drill, CYCLE);
    assert_eq!(printed, ["PR017 a branch of the sequence does not print the depth: [d]"]);
}

#[test]
fn first_and_last_holes_are_known() {
    let drill = "Drill\n@if [isfirsthole]\nM61\n@elif [lasthole]\nM63\n@else\nM62\n@end\nG0 X[h] Y[v] Z[vclear]\nG1 Z[d] F[frate]\nG0 Z[rplane]\nEnd\n";
    let printed = path_lines("", drill, CYCLE);
    let codes: Vec<&str> = printed.iter().map(String::as_str).filter(|line| line.starts_with('M')).collect();
    assert_eq!(codes, ["M61", "M62", "M62", "M62", "M63"]);
}

#[test]
fn the_last_tool_is_known_whether_the_job_lists_them_or_not() {
    let text = form("", "@if [islasttool]\nM99\n@else\nM98\n@end");
    let listed = job("{\"line\":[1,1,0]}").replacen("\"units\"", "\"tool_order\":[1],\"units\"", 1);
    assert!(program(&text, &listed).contains(&"M99".to_owned()));
    assert!(program(&text, &job("{\"line\":[1,1,0]}")).contains(&"M99".to_owned()));
}

#[test]
fn what_a_branch_does_not_print_is_generated() {
    let sequences = "LineCode\n@if [h] > 1\nG1 X[h] Y[v] Z[d] F[frate]\n@else\nG1 X[h] Y[v] Z[d]\n@end\nEnd\n";
    let path = "{\"line\":[1,0,1]},{\"line\":[2,0,1],\"feed\":20}";
    assert_eq!(path_lines("", sequences, path), ["F10.", "G1 X1.", "X2. F20."]);
}

#[test]
fn wrong_expressions_are_refused() {
    let table = [
        ("Q[d+]", "PF703"),
        ("Q[+d]", "PF703"),
        ("Q[d++1]", "PF703"),
        ("Q[(d+1]", "PF703"),
        ("Q[d+1)]", "PF703"),
        ("Q[d*/2]", "PF703"),
        ("Q[sqrt(d)]", "PF703"),
        ("Q[abs(d, 1)]", "PF703"),
        ("Q[max()]", "PF703"),
        ("Q[1+2,3]", "PF703"),
        ("Q[d+1e3]", "PF703"),
        ("Q[dd+1]", "PF202"),
        ("Q[taper+1]", "PF604"),
        ("Q[toolname+1]", "PF704"),
        ("Q[d+1 = 2]", "PF704"),
        ("Q[not (d=1)]", "PF704"),
        ("Q[d/0]", "PF705"),
        ("Q[d/(1-1)]", "PF705"),
        ("@if [h]/0 = 1\nM1\n@end", "PF705"),
        ("@if\nM1\n@end", "PF703"),
        ("@if [h\nM1\n@end", "PF703"),
        ("@if [h] == 1\nM1\n@end", "PF703"),
        ("@if h = 1\nM1\n@end", "PF706"),
        ("@if [cool] = trough\nM1\n@end", "PF706"),
        ("@if [tool] = one\nM1\n@end", "PF706"),
        ("@if through\nM1\n@end", "PF706"),
        ("@if [tool] = \"1\"\nM1\n@end", "PF704"),
        ("@if [toolname] > 1\nM1\n@end", "PF704"),
        ("@if [tool] like \"1*\"\nM1\n@end", "PF704"),
        ("@if [toolname] like [progname]\nM1\n@end", "PF704"),
        ("@if [tool]+1\nM1\n@end", "PF704"),
        ("@if ([tool] = 1) > 1\nM1\n@end", "PF704"),
        ("@if [tool] = 1", "PF707"),
        ("@end", "PF707"),
        ("@else\nM1", "PF707"),
        ("@elif [tool] = 1\nM1", "PF707"),
        ("@if [tool] = 1\nM1\n@else\nM2\n@else\nM3\n@end", "PF707"),
        ("@if [tool] = 1\nM1\n@else\nM2\n@elif [tool] = 2\nM3\n@end", "PF707"),
        ("@if [tool] = 1\nM1\n@else if [tool] = 2\nM2\n@end", "PF707"),
        ("@if [tool] = 1\nM1\n@end if", "PF707"),
        ("@iff [tool] = 1\nM1", "PF707"),
        ("@while [tool] = 1\nM1", "PF707"),
        ("@for tools\nM1\n@end", "PF707"),
        ("@set h = 1", "PF707"),
        ("@set speed = 1", "PF707"),
        ("@set vall = 1", "PF707"),
        ("@set val1 1", "PF707"),
        ("@set val1 =", "PF703"),
        ("@set val1 = [toolname]", "PF704"),
    ];
    for (text, code) in table {
        let found = codes(&form("", text));
        assert!(found.contains(&code), "{text}: {found:?}");
    }
    let deep = format!("{}M1\n{}", "@if [tool] = 1\n".repeat(9), "@end\n".repeat(9));
    assert_eq!(codes(&form("", deep.trim_end())), ["PF707"]);
    let wide = "@if [tool] = 1\nM1\n@end\n".repeat(129);
    assert!(codes(&form("", wide.trim_end())).contains(&"PF707"));
    let bracketed = format!("Q[{}d{}]", "(".repeat(33), ")".repeat(33));
    assert_eq!(codes(&form("", &bracketed)), ["PF703"]);
    assert_eq!(codes(&form("", &format!("Q[{}d]", "1+".repeat(300)))), ["PF703"]);
}

#[test]
fn wrong_branches_are_refused() {
    let table = [
        ("Drill\n@if [dwell]\nG82 X[h] Y[v] Z[d] F[frate]\n@else\nG0 X[h] Y[v]\nG1 Z[d] F[frate]\n@end\nEnd", "PF709"),
        ("Drill\n@if [dwell]\nG82 X[h] Y[v] Z[d] F[frate]\n@end\nEnd", "PF709"),
        ("LineCode\n@if [frate] > 1\nG1 X[h] Y[v] Z[d] F[frate]\n@end\nEnd", "PF709"),
    ];
    for (sequence, code) in table {
        assert_eq!(codes(&mill("", sequence)), [code], "{sequence}");
    }
}

#[test]
fn a_condition_that_never_changes_is_a_warning() {
    let checked = check(&form("", "@if 1 > 2 or \"a\" = \"a\"\nM1\n@end"));
    let warning = checked.diags.iter().find(|diag| diag.code.name() == "PF708").unwrap();
    assert_eq!(warning.message, "a condition that is always true");
}

/// Each directive is processed only once, so even deeply nested directives take little time.
#[test]
fn directives_that_lie_too_deep_cost_no_time() {
    for (open, levels) in [("@if [val1]", 30), ("@if [val1]", 20_000), ("@for tool", 20_000), ("@iff [val1]", 20_000)] {
        let text = format!("{}M1\n{}", format!("{open}\n").repeat(levels), "@end\n".repeat(levels));
        assert!(codes(&form("", &text)).contains(&"PF707"), "{open} {levels}");
    }
}

/// If a line of the form sets a different value than the job, the job's value is printed again before the next cut. An
/// equal value is not printed twice.
#[test]
fn what_a_line_sets_is_said_again_as_the_job_wants_it() {
    let between = |head: &str, tool: [&str; 2], row: &str, items: &str| {
        let form = mill(head, &format!("BeginRow\n{row}\nEnd")).replace(tool[0], tool[1]);
        let path = format!("{items}{{\"begin\":\"row\"}},{{\"line\":[1,0,1]}},{{\"end\":\"row\"}}");
        let printed = program(&form, &job(&path));
        let at = printed.iter().position(|line| line.starts_with("G0 ")).unwrap();
        printed[at + 1..printed.len() - 1].join(" | ")
    };
    let same = ["T[tool]", "T[tool]"];
    let off = "{\"spindle\":{\"direction\":\"off\"}},{\"rapid\":[1,1,1]},";
    let table = [
        ("", same, "S300", "", "S300 | S1000 M3 | "),
        ("", same, "S[300+0]", "", "S300 | S1000 M3 | "),
        ("", same, "S[speed]", "", "S1000 | "),
        // the form's own speed applies until a line prints the job's speed
        ("", ["S[speed] M", "S700 M"], "S[speed]", "", "S1000 | "),
        ("", same, "M5", "", "M5 | S1000 M3 | "),
        ("", same, "M4", "", "M4 | S1000 M3 | "),
        ("", same, "G55", "", "G55 | G54 | "),
        ("", ["G[work]", "G54.1 P[work]"], "G54.1 P2", "", "G54.1 P2 | G54.1 P54 | "),
        ("Control haas", same, "M88", "", "M88 | S1000 M3 | "),
        ("Control haas", same, "M88", off, "M5 | G0 X1. Y1. | M88 | G1 Y0 F10."),
        // the dwell uses the letter of the speed, so the speed is unknown after it
        ("Dwell G4 S s", same, "(ROW)", "{\"dwell\":2},", "G4 S2 | (ROW) | S1000 M3 | "),
        ("Dwell G4 P s", same, "(ROW)", "{\"dwell\":2},", "G4 P2 | (ROW) | "),
    ];
    for (head, tool, row, items, printed) in table {
        let lines = between(head, tool, row, items);
        let after = lines.strip_prefix(printed).unwrap_or_else(|| panic!("{row} {items}: {lines}"));
        assert!(!after.contains(['S', 'M']), "{row} {items}: {lines}");
    }
}
