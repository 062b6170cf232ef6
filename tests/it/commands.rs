//! Tests the printed program for every command of forms that affects generated moves and blocks.

use crate::support::{job, mill, path_lines, program};

const CORNER: &str =
    "{\"line\":[1,0,0]},{\"arc\":{\"to\":[2,1],\"center\":[1,1],\"direction\":\"ccw\"}},{\"line\":[2,2,0]}";
/// Three quarters of a circle.
const LONG: &str = "{\"line\":[1,0,0]},{\"arc\":{\"to\":[0,-1],\"center\":[0,0],\"direction\":\"ccw\"}}";
const CIRCLE: &str = "{\"line\":[1,0,0]},{\"arc\":{\"to\":[1,0],\"center\":[0,0],\"direction\":\"cw\"}}";

fn arcs(head: &str, path: &str) -> Vec<String> {
    path_lines(head, "", path)[1..].to_vec()
}

#[test]
fn motion_words() {
    let head = "Rapid G00\nFeed G01\nCW 2\nCCW G03\nFeedCode E\nE >4.>2";
    let path =
        "{\"rapid\":[0,0,0.5]},{\"line\":[1,0,0]},{\"arc\":{\"to\":[2,1],\"center\":[1,1],\"direction\":\"ccw\"}}";
    assert_eq!(path_lines(head, "", path), ["G00 Z.5", "G01 X1. Z0 E10.", "G17 G03 X2. Y1. I0 J1."]);
    let numbers = "G 2\nM 2";
    assert_eq!(path_lines(numbers, "", "{\"rapid\":[0,0,0.5]}"), ["G00 Z.5"]);
    assert_eq!(program(&mill(numbers, ""), &job("{\"rapid\":[0,0,0.5]}"))[2], "S1000 M03");
    // in CW and CCW, the spindle code may come after the arc code; `[direct]` prints this spindle code
    let both = program(&mill("CW G2 M13\nCCW G3 M14", ""), &job(CORNER));
    assert_eq!(both[2], "S1000 M13");
    assert!(both.iter().any(|line| line.contains("G3 X2. Y1.")), "{both:?}");
}

#[test]
fn arc_centres_in_three_forms() {
    assert_eq!(arcs("CtrCode I J K", CORNER), ["G17 G3 X2. Y1. I0 J1.", "G1 Y2."]);
    assert_eq!(arcs("CtrCode R", CORNER), ["G17 G3 X2. Y1. R1.", "G1 Y2."]);
    assert_eq!(arcs("CtrIncremental? N", CORNER), ["G17 G3 X2. Y1. I1. J1.", "G1 Y2."]);
    // a positive radius means an arc of less than 180 degrees: a longer arc is split, or printed in the form's own
    // format for longer arcs
    assert_eq!(arcs("", LONG), ["G17 G3 X0 Y-1. I-1. J0"]);
    assert_eq!(arcs("CtrCode R", LONG), ["G17 G3 X-.7071 Y.7071 R1.", "X0 Y-1. R1."]);
    assert_eq!(arcs("CtrCode R\nCtrCode>180 R", LONG), ["G17 G3 X0 Y-1. R-1."]);
    assert_eq!(arcs("CtrCode R\nCtrCode>180 I J", LONG), ["G17 G3 X0 Y-1. I-1. J0"]);
    // a full circle can't be printed with a radius
    assert_eq!(arcs("", CIRCLE), ["G17 G2 I-1. J0"]);
    assert_eq!(arcs("CtrCode R", CIRCLE), ["G17 G2 X-1. R1.", "X1. R1."]);
    assert_eq!(arcs("CtrCode R\nCtrCode360 I J", CIRCLE), ["G17 G2 I-1. J0"]);
}

#[test]
fn quadrants_planes_helices() {
    assert_eq!(arcs("ByQuadrants? Y", LONG), ["G17 G3 X0 Y1. I-1. J0", "X-1. Y0 I0 J-1.", "X0 Y-1. I1. J0"]);
    let xz =
        "{\"line\":[1,0,0]},{\"arc\":{\"to\":[0,null,1],\"center\":[0,null,0],\"direction\":\"cw\",\"plane\":\"xz\"}}";
    assert_eq!(arcs("", xz), ["G18 G2 X0 Z1. I-1. K0"]);
    let yz =
        "{\"line\":[0,1,0]},{\"arc\":{\"to\":[null,0,1],\"center\":[null,0,0],\"direction\":\"ccw\",\"plane\":\"yz\"}}";
    assert_eq!(arcs("", yz), ["G19 G3 Y0 Z1. J-1. K0"]);
    // the control lacks this plane: the arc becomes lines within the tolerance
    let chords = arcs("ArcPlane G17\nTolerance 0.1", xz);
    assert_eq!(chords, ["X.7071 Z.7071", "X0 Z1."]);
    let helix = "{\"line\":[1,0,0]},{\"arc\":{\"to\":[1,0,-0.5],\"center\":[0,0],\"direction\":\"ccw\",\"turns\":1}}";
    assert_eq!(arcs("", helix), ["G17 G3 Z-.25 I-1. J0", "Z-.5 I-1. J0"]);
    let flat = arcs("Helical? N\nTolerance 0.3", helix);
    assert_eq!(flat.len(), 8, "{flat:?}");
    assert_eq!(flat[7], "X1. Y0 Z-.5");
}

#[test]
fn radii_that_are_too_small_or_large_become_lines() {
    assert_eq!(arcs("MinRad 2\nTolerance 0.3", CORNER), ["X2. Y1.", "Y2."]);
    assert_eq!(arcs("MaxRad 0.5\nTolerance 0.3", CORNER), ["X2. Y1.", "Y2."]);
}

#[test]
fn arcs_restate_their_code_where_the_form_wants_it() {
    let two = "{\"line\":[0,0,0]},{\"arc\":{\"to\":[2,0],\"center\":[1,0],\"direction\":\"cw\"}},\
               {\"arc\":{\"to\":[4,0],\"center\":[3,0],\"direction\":\"cw\"}}";
    assert_eq!(arcs("ArcWithSame? N", two), ["G17 G2 X2. I1. J0", "G2 X4. I1. J0"]);
    assert_eq!(arcs("ModalGs 0 1 17", two), ["G17 G2 X2. I1. J0", "G2 X4. I1. J0"]);
    assert_eq!(arcs("CW G1\nArcWithLine? N", two)[0], "G17 G1 X2. I1. J0");
    assert_eq!(arcs("CW G1", two)[0], "G17 X2. I1. J0");
    assert_eq!(arcs("CircDir DR- DR+", two)[0], "G17 G2 X2. I1. J0 DR-");
    assert_eq!(arcs("2ndCircleCode M99", two)[..2], ["G17 G2 X2.", "M99 I1. J0"]);
}

#[test]
fn increments_add_up_without_a_rest() {
    let path = "{\"line\":[0.33334,0,1]},{\"line\":[0.66668,0,1]},{\"line\":[1,0,1]},{\"line\":[1,0,1]}";
    assert_eq!(path_lines("Incremental? Y", "", path), ["G1 X.3333 F10.", "X.3334", "X.3333"]);
    // an increment of zero prints no move, even if the tool change leaves the printed values unknown
    let form = mill("Incremental? Y", "").replacen("Z[d]", "Z[d] G91", 1);
    assert_eq!(
        program(&form, &job("{\"rapid\":[0,0,1]},{\"rapid\":[0,0,2]}"))[3..5],
        ["G0 G54 X0 Y0 Z1. G91", "G0 Z1."]
    );
}

#[test]
fn modality() {
    let path = "{\"line\":[1,0,1]},{\"line\":[2,0,1]}";
    assert_eq!(path_lines("Modality? N", "", path), ["G1 X1. Y0 Z1. F10.", "G1 X2. Y0 Z1. F10."]);
    assert_eq!(path_lines("ModalLetters Y Z F", "", path), ["G1 X1. F10.", "X2."]);
    assert_eq!(path_lines("ModalLetters X Z", "", path), ["G1 X1. Y0 F10.", "X2. Y0 F10."]);
    assert_eq!(path_lines("ModalGs 0", "", path), ["G1 X1. F10.", "G1 X2."]);
    let forced = path_lines("Force Y", "", "{\"rapid\":[1,0,1]},{\"line\":[2,0,1]},{\"line\":[3,0,1]}");
    assert_eq!(forced, ["G0 Y0", "X1.", "G1 X2. Y0 F10.", "X3."]);
}

#[test]
fn inverse_time_says_the_feed_of_every_block() {
    let text = job("{\"line\":[1,0,1]},{\"line\":[2,0,1]}")
        .replace("\"feed\":10", "\"feed\":10,\"feed_mode\":\"inverse_time\"");
    assert_eq!(program(&mill("", ""), &text)[4..7], ["G93", "G1 X1. F10.", "X2. F10."]);
}

#[test]
fn rapids_split_under_vrapid() {
    let path = "{\"rapid\":[1,1,2]},{\"rapid\":[2,2,0.5]},{\"rapid\":[3,2,0.5]}";
    assert_eq!(path_lines("VRapid G00", "", path), ["G00 Z2.", "X1. Y1.", "X2. Y2.", "Z.5", "X3."]);
    assert_eq!(path_lines("VRapid G1", "", path), ["G1 Z2.", "G0 X1. Y1.", "X2. Y2.", "G1 Z.5", "G0 X3."]);
}

#[test]
fn depth_restarts_after_a_tool_change() {
    assert_eq!(path_lines("ZRestart? Y", "", "{\"line\":[1,0,1]}"), ["G0 Z1.", "G1 X1. F10."]);
}

#[test]
fn block_numbers() {
    let lines = |head: &str| program(&mill(head, ""), &job("{\"line\":[1,0,1]}"));
    assert_eq!(
        lines("Sequence#s N 10 5"),
        ["%", "N10 T1 M6", "N15 S1000 M3", "N20 G0 G54 X0 Y0 Z1.", "N25 G1 X1. F10.", "N30 M30"]
    );
    assert_eq!(
        lines("Sequence#s N 1 1\nN 3\nFirst#? N\nLast#? N")[1..],
        ["T1 M6", "N001 S1000 M3", "N002 G0 G54 X0 Y0 Z1.", "N003 G1 X1. F10.", "M30"]
    );
    // when the block number exceeds its width, the numbering starts again
    assert_eq!(lines("Sequence#s N 8 1\nN >1")[1..4], ["N8 T1 M6", "N9 S1000 M3", "N8 G0 G54 X0 Y0 Z1."]);
    assert_eq!(lines("Sequence#s N 10 10\nSpaces? N")[1], "N10T1M6");
    let own = mill("Sequence#s N 10 10", "").replacen("T[tool] M6", "N[block] T[tool] M6", 1);
    assert_eq!(program(&own, &job("{\"line\":[1,0,1]}"))[1..3], ["N10 T1 M6", "N20 S1000 M3"]);
}

#[test]
fn blocks_and_their_text() {
    let lines = |head: &str| program(&mill(head, ""), &job("{\"line\":[0.5,0,1]}"));
    assert_eq!(lines("Spaces? N")[3..5], ["G0G54X0Y0Z1.", "G1X.5F10."]);
    assert_eq!(lines("Spaces 8")[4], "G1      X.5     F10.");
    assert_eq!(lines("Spaces 1 6 20")[4], "G1   X.5           F10.");
    assert_eq!(lines("Leading0s? Y")[4], "G1 X0.5 F10.");
    assert_eq!(lines("EOB ;")[4], "G1 X.5 F10.;");
    assert_eq!(lines("Replace G1 G01\nReplace \" F\" F")[4], "G01 X.5F10.");
    assert_eq!(lines("Rename X U")[4], "G1 U.5 F10.");
    assert_eq!(lines("Dummy F")[4], "G1 X.5 10.");
    assert_eq!(lines("RevSigns X")[4], "G1 X-.5 F10.");
    assert_eq!(lines("Mod (POST 7)")[0], "(POST 7)");
}

#[test]
fn rename_lets_one_letter_have_two_formats() {
    let form = mill("Rename q Q\nq ->34\nQ ->3.>4", "BeginRow\nQ[plunge] q[plunge]\nEnd");
    let lines = program(&form, &job("{\"begin\":\"row\"},{\"end\":\"row\"}"));
    assert_eq!(lines[4], "Q10. Q100000");
}

#[test]
fn spindle_coolant_and_offsets_are_those_of_the_form() {
    let form = mill("Spindle M13 M14 M5\nCoolant 50 9 51\nLComp 50\nDComp 60", "").replacen(
        "S[speed] M[direct]",
        "S[speed] M[direct] M[cool] H[lcomp] D[dcomp]",
        1,
    );
    let text = job("{\"line\":[1,0,1]}")
        .replace("\"feed\":10", "\"feed\":10,\"coolant\":\"mist\"")
        .replace(",\"diameter_offset\":21", "");
    assert_eq!(program(&form, &text)[2], "S1000 M13 M51 H51 D61");
    let off = job("{\"line\":[1,0,1]}");
    assert_eq!(program(&form, &off)[2], "S1000 M13 M9 H51 D21");
}

#[test]
fn work_offsets_count_from_the_first_code() {
    let work = |number: &str| job("{\"line\":[1,0,1]}").replace("\"work\":54", &format!("\"work\":{number}"));
    assert!(program(&mill("", ""), &work("2"))[3].starts_with("G0 G55 "));
    assert!(program(&mill("", ""), &work("57"))[3].starts_with("G0 G57 "));
    assert!(program(&mill("", ""), &work("59.1"))[3].starts_with("G0 G59.1 "));
    let without = job("{\"line\":[1,0,1]}").replace("\"work\":54,", "");
    assert!(program(&mill("WorkDefault 56", ""), &without)[3].starts_with("G0 G56 "));
}

#[test]
fn dwells_stops_and_compensation() {
    assert_eq!(
        path_lines("", "", "{\"dwell\":0.25},{\"stop\":\"optional\"},{\"stop\":\"program\"}"),
        ["G4 P.25", "M1", "S1000 M3", "M0"]
    );
    assert_eq!(
        path_lines("Dwell G04 X ms\nStopCode 10 11", "", "{\"dwell\":0.25},{\"stop\":\"optional\"}"),
        ["G04 X250.", "M11"]
    );
    let path = "{\"infeed\":[1,0],\"side\":\"right\"},{\"line\":[2,0]},{\"outfeed\":[3,0]}";
    assert_eq!(path_lines("CDC 141 142 140\nCDCCode H", "", path), ["G1 G142 X1. H21 F10.", "X2.", "G140 X3."]);
}

#[test]
fn prompted_variables_need_an_answer() {
    let form = mill("Ask val1 \"Fixture height\"\nAsk val2 \"Clearance\" 2.5", "BeginRow\nR[val1] Q[val2]\nEnd");
    let path = "{\"begin\":\"row\"},{\"end\":\"row\"}";
    assert_eq!(program(&form, &job(path)), ["PR015 [val1] needs an answer: Fixture height"]);
    let answered = job(path).replacen("\"program\":100", "\"program\":100,\"set\":{\"val1\":3}", 1);
    assert_eq!(program(&form, &answered)[4], "R3. Q2.5");
    let changed = job(&format!("{{\"set\":{{\"val2\":7}}}},{path}")).replacen(
        "\"program\":100",
        "\"program\":100,\"set\":{\"val1\":3}",
        1,
    );
    assert_eq!(program(&form, &changed)[4], "R3. Q7.");
}

#[test]
fn the_next_tool_comes_from_the_list_of_tools() {
    let form = mill("", "").replace("T[tool] M6", "T[tool] M6 (next [nexttool], first [tool1])");
    let two = |order: &str| {
        job("{\"line\":[1,0,1]}")
            .replacen("\"operations\"", &format!("{order}\"operations\""), 1)
            .replace("[1,0,1]}]}", "[1,0,1]}]},{\"tool\":2,\"path\":[{\"rapid\":[0,0,1]}],\"x\":0}")
            .replace(",\"x\":0", "")
            .replace("{\"tool\":2,", "{\"tool\":2,\"spindle\":{\"speed\":1,\"direction\":\"cw\"},")
    };
    let lines = program(&form, &two("\"tool_order\":[1,2],"));
    assert_eq!(lines[1], "T1 M6 (next 2, first 1)");
    assert_eq!(lines[5], "T2 M6 (next 1, first 1)");
    // a job without `tool_order` is read twice
    assert_eq!(program(&form, &two(""))[1], "T1 M6 (next 2, first 1)");
    let word = form.replace("(next [nexttool], first [tool1])", "H[nexttool]");
    assert_eq!(program(&word, &two(""))[1], "T1 M6 H2");
    assert!(program(&form, &two("\"tool_order\":[2,1],"))[0].starts_with("PJ012"));
    assert!(program(&form, &two("\"tool_order\":[1,2,1],"))[0].starts_with("PJ012"));
}

#[test]
fn called_forms_are_part_of_the_form() {
    let main = mill("Call common.pf", "");
    let mut asked = 0;
    let checked = postform::internals::sema::analyse(
        postform::internals::source::Source::from_text("main.pf", main),
        Default::default(),
        &mut |name| {
            asked += 1;
            assert_eq!(name, "common.pf");
            Ok(postform::internals::source::Source::from_text(name, "Drill\nG81 X[h] Y[v]\nEnd\n"))
        },
    );
    assert_eq!((checked.diags.as_slice(), asked), (&[][..], 1));
    assert!(checked.form.sequences.contains_key(&postform::internals::lang::SequenceId::Drill));
}

#[test]
fn sections_print_before_and_after_their_moves() {
    let path = "{\"begin\":\"zlevel\"},{\"begin\":\"row\"},{\"line\":[1,0,0]},{\"end\":\"row\"},{\"end\":\"zlevel\"}";
    let sequences = "BeginZLevel\n(LEVEL)\nEnd\nBeginRow\n(ROW)\nEnd\nEndRow\n(/ROW)\nEnd";
    assert_eq!(path_lines("", sequences, path), ["(LEVEL)", "(ROW)", "G1 X1. Z0 F10.", "(/ROW)"]);
}

#[test]
fn moves_are_measured_for_forms_that_print_them() {
    let path = "{\"line\":[3,4,1]},{\"begin\":\"row\"},{\"end\":\"row\"}";
    let lines = path_lines("", "BeginRow\n(L[movelength] T[movetime] SUM[totalcutdist])\nEnd", path);
    assert_eq!(lines[1], "(L5 T30 SUM5)");
}

/// A form for both units has different default values for inches and millimetres.
#[test]
fn defaults_of_cycles_are_those_of_the_jobs_units() {
    let form = mill("Units both", "").replace("%0\n", "%0\nG[unitmode]\n");
    let cycle = job("{\"cycle\":{\"kind\":\"drill\",\"depth\":5,\"feed\":5,\"points\":[[1,1,0]]}}");
    let cycle = cycle.replace("[0,0,1]", "[0,0,9]");
    let clear = |form: &str, units: &str| {
        let lines = program(form, &cycle.replace("\"units\":\"inch\"", &format!("\"units\":\"{units}\"")));
        let cut = lines.iter().position(|line| line.starts_with("G1 Z")).unwrap_or_else(|| panic!("{lines:?}"));
        lines[cut - 1].clone()
    };
    assert_eq!([clear(&form, "inch"), clear(&form, "mm")], ["Z.1", "Z3."]);
    // a value in the form is in inches
    assert_eq!(clear(&form.replace("Units both", "Units both\nCycleClear 0.2"), "mm"), "Z5.08");
}

/// In the oldest forms, every number is in brackets.
#[test]
fn numbers_in_brackets() {
    let plain = mill("Rapid G00", "");
    let old = [("Rapid G00", "Rapid G<00>"), ("%0", "%<0>"), ("M6", "M<6>"), ("G0 ", "G<0> "), ("M30", "M<30>")]
        .iter()
        .fold(plain.clone(), |text, (from, to)| text.replace(from, to));
    let path = job("{\"rapid\":[0,0,0.5]}");
    assert_eq!(program(&old, &path), program(&plain, &path));
}

/// The program number may come from a prompt if the job has none.
#[test]
fn the_program_number_may_be_asked_for() {
    let form = mill("Ask program# \"Program number\" 77", "").replacen("%0\n", "%0\nO[program#]\n", 1);
    let text = job("{\"rapid\":[0,0,2]}");
    assert_eq!(program(&form, &text)[1], "O100");
    assert_eq!(program(&form, &text.replacen("\"program\":100,", "", 1))[1], "O77");
}

/// Each `Replace` may double the length of a block. A block that becomes too long for the control is refused at that
/// point.
#[test]
fn replaced_blocks_stay_short() {
    let doubled = |rows: usize| path_lines(&"Replace G GG\n".repeat(rows), "", "{\"line\":[1,0,0]}");
    assert_eq!(doubled(5), [format!("{}1 X1. Z0 F10.", "G".repeat(32))]);
    let refused = doubled(28);
    assert!(refused[0].starts_with("PR027 a block of 40"), "{refused:?}");
    // LinuxCNC stops at a block that is too long, in the middle of the part
    let text = format!("{{\"text\":\"({})\"}}", "A".repeat(300));
    assert!(path_lines("", "", &text)[0].starts_with('('));
    assert!(path_lines("Control linuxcnc", "", &text)[0].starts_with("PR027 a block of 302 characters"));
}
