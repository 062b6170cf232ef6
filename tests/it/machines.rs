//! Subprograms, lathes, wire EDM and rotary axes: cases that the samples do not contain.

use crate::support::{job, mill, path_lines, program};

const SUBS: &str = "SubStart\nO[sub]\nEnd\nSubEnd\nM99\nEnd\nSubCall\nM98 P[sub] L[times]\nEnd";

fn with_subs(subs: &str, path: &str) -> String {
    job(path).replacen("\"operations\"", &format!("\"subprograms\":[{subs}],\"operations\""), 1)
}

fn sub(number: u32, path: &str) -> String {
    format!("{{\"number\":{number},\"path\":[{path}]}}")
}

const CALL: &str = "{\"call\":{\"sub\":7,\"times\":3}}";
const MOVE: &str = "{\"rapid\":[0,0,1]}";

#[test]
fn subprograms_stand_after_the_main_program_by_default() {
    let lines = program(&mill("", SUBS), &with_subs(&sub(7, MOVE), &format!("{CALL},{{\"rapid\":[1,1,1]}}")));
    assert_eq!(lines[4..], ["M98 P1 L3", "G0 X1. Y1. Z1.", "M30", "O1", "G0 X0 Y0 Z1.", "M99"]);
    let kept = program(&mill("RenumSubs? N", SUBS), &with_subs(&sub(7, MOVE), CALL));
    assert_eq!(kept[4..], ["M98 P7 L3", "M30", "O7", "G0 X0 Y0 Z1.", "M99"]);
}

/// Each subprogram calls the two before it. A check of every chain of calls would never end.
#[test]
fn shared_subprograms_are_looked_at_once() {
    let call = |number: u32| format!(",{{\"call\":{{\"sub\":{number}}}}}");
    let mut subs = vec![sub(2, MOVE), sub(3, MOVE)];
    subs.extend((4..=80).map(|n| sub(n, &format!("{MOVE}{}{}", call(n - 1), call(n - 2)))));
    let lines = program(&mill("", SUBS), &with_subs(&subs.join(","), &call(80)[1..]));
    assert_eq!(lines[4], "M98 P79 L1");
    assert!(lines.len() > 79 * 4, "{} lines", lines.len());
}

#[test]
fn a_call_is_known_to_move_the_tool() {
    let path = format!("{CALL},{{\"rapid\":[1]}}");
    let lines = program(&mill("", SUBS), &with_subs(&sub(7, MOVE), &path));
    assert_eq!(lines[4..6], ["M98 P1 L3", "G0 X1."]);
}

/// The subprograms are rendered before the operations. Changes in a subprogram do not apply in the main program before
/// the call.
#[test]
fn a_subprogram_changes_nothing_but_where_it_is_called() {
    let inside = "{\"work\":55},{\"coolant\":\"off\"},{\"spindle\":{\"speed\":500}},{\"rapid\":[0,0,1]}";
    let lines = program(&mill("", SUBS), &with_subs(&sub(7, inside), &format!("{CALL},{{\"rapid\":[1,1,1]}}")));
    // three runs that each begin in the same state
    assert_eq!(lines[4..10], ["M98 P1 L1", "G54", "S1000 M3", "M98 P1 L1", "G54", "S1000 M3"]);
    assert_eq!(lines[10..14], ["M98 P1 L1", "G54", "S1000 M3", "G0 X1. Y1. Z1."]);
    assert_eq!(lines[15..], ["O1", "G55", "S500", "M9", "G0 X0 Y0 Z1.", "M99"]);
    // a subprogram that calls another subprogram must contain the values to restore
    let nested = format!("{},{}", sub(7, "{\"call\":{\"sub\":8}}"), sub(8, inside));
    let form = mill("RenumSubs? N", SUBS);
    assert!(program(&form, &with_subs(&nested, CALL))[0].starts_with("PR033 subprogram 8 changes"));
    let own =
        "{\"work\":56},{\"coolant\":\"on\"},{\"spindle\":{\"speed\":700}},{\"call\":{\"sub\":8}},{\"rapid\":[0,0,2]}";
    let nested = format!("{},{}", sub(7, own), sub(8, inside));
    let lines = program(&form, &with_subs(&nested, &format!("{CALL},{{\"rapid\":[1,1,1]}}")));
    assert_eq!(lines[4..8], ["M98 P7 L1", "G54", "G97 S1000 M3", "M9"]);
    let at = lines.iter().position(|line| line == "O7").unwrap() + 1;
    assert_eq!(lines[at..at + 8], ["G56", "S700", "M8", "M98 P8 L1", "G56", "S700", "M8", "G0 X0 Y0 Z2."]);
    // a value that the subprogram does not change is not printed again
    let plain = program(&mill("", SUBS), &with_subs(&sub(7, MOVE), &format!("{CALL},{{\"rapid\":[1,1,1]}}")));
    assert_eq!(plain[4..6], ["M98 P1 L3", "G0 X1. Y1. Z1."]);
}

#[test]
fn a_call_says_how_often_and_where() {
    let once = SUBS.replace(" L[times]", "");
    let at = "{\"call\":{\"sub\":7,\"times\":2,\"at\":[5,6]}}";
    let lines = program(&mill("", &once), &with_subs(&sub(7, MOVE), at));
    assert_eq!(lines[4..7], ["G0 X5. Y6.", "M98 P1", "M98 P1"]);
    let says = SUBS.replace("M98 P[sub]", "G0 X[h] Y[v]\nM98 P[sub]");
    assert_eq!(program(&mill("", &says), &with_subs(&sub(7, MOVE), at))[4..6], ["G0 X5. Y6.", "M98 P1 L2"]);
}

/// Before a call, postform selects the XY plane. This plane is also active after the call.
#[test]
fn calls_are_made_in_the_first_plane_without_compensation() {
    let arc = "{\"arc\":{\"to\":[1,0,0],\"center\":[0,0,0],\"direction\":\"cw\",\"plane\":\"xz\"}}";
    let lines = program(&mill("", SUBS), &with_subs(&sub(7, MOVE), &format!("{arc},{CALL}")));
    assert_eq!(lines[5..7], ["G17", "M98 P1 L3"]);
    let compensated = format!("{{\"infeed\":[1,0],\"side\":\"left\"}},{CALL}");
    assert!(program(&mill("", SUBS), &with_subs(&sub(7, MOVE), &compensated))[0].starts_with("PR030 cutter"));
}

#[test]
fn calls_that_lead_nowhere_or_in_circles_are_errors() {
    let error = |subs: &str, path: &str| program(&mill("RenumSubs? N", SUBS), &with_subs(subs, path))[0].clone();
    assert_eq!(error("", CALL), "PR034 the job has no subprogram 7");
    assert_eq!(error(&sub(7, "{\"call\":{\"sub\":9}}"), CALL), "PR034 the job has no subprogram 9");
    let circle = format!("{},{}", sub(7, "{\"call\":{\"sub\":8}}"), sub(8, "{\"call\":{\"sub\":7}}"));
    assert!(error(&circle, MOVE).contains("calls itself"));
    assert!(error(&sub(7, CALL), MOVE).contains("calls itself"));
    assert!(error(&format!("{},{}", sub(7, MOVE), sub(7, MOVE)), MOVE).starts_with("PJ010"));
    let nested = format!("{},{}", sub(8, MOVE), sub(7, "{\"call\":{\"sub\":8,\"times\":2}}"));
    assert_eq!(
        program(&mill("", SUBS), &with_subs(&nested, CALL))[6..],
        ["O1", "G0 X0 Y0 Z1.", "M99", "O2", "M98 P1 L2", "M99"]
    );
    assert!(program(&mill("", ""), &with_subs(&sub(7, MOVE), MOVE))[0].contains("no sequence SubStart"));
}

#[test]
fn parts_of_a_path_close_in_order() {
    assert!(path_lines("", "", "{\"begin\":\"row\"},{\"begin\":\"leadin\"},{\"end\":\"row\"}")[0].starts_with("PJ011"));
    assert!(path_lines("", "", "{\"end\":\"row\"}")[0].starts_with("PJ011"));
}

fn lathe(head: &str, sequences: &str) -> String {
    format!(
        "Machine Lathe\n{head}\nStartCode\n%0\nEnd\n1stToolChange\nT[tool]\nS[speed] M[direct]\nEnd\nToolChange\nT[tool]\nEnd\n\
         EndCode\nM30\nEnd\n{sequences}\n"
    )
}

/// The lines between tool change and end. The tool starts at Z 0.2, radius 0.5.
fn turned(head: &str, sequences: &str, path: &str) -> Vec<String> {
    let text = job(path).replace("[0,0,1]", "[0.2,0.5]").replace("\"units\"", "\"machine\":\"lathe\",\"units\"");
    let lines = program(&lathe(head, sequences), &text.replace("\"work\":54,", ""));
    if lines.len() < 4 { lines } else { lines[3..lines.len() - 1].to_vec() }
}

#[test]
fn x_is_a_diameter_on_a_lathe() {
    assert_eq!(turned("", "", "{\"line\":[-1,0.5]},{\"line\":[-1,0.75]}"), ["G0 Z.2 X1.", "G1 Z-1. F10.", "X1.5"]);
    assert_eq!(turned("ByDiameter? N", "", "{\"line\":[-1,0.5]}"), ["G0 Z.2 X.5", "G1 Z-1. F10."]);
    let arc = "{\"arc\":{\"to\":[0.1,0.6],\"center\":[0.1,0.5],\"direction\":\"cw\"}}";
    assert_eq!(turned("", "", arc), ["G0 Z.2 X1.", "G3 Z.1 X1.2 K-.1 I0 F10."].map(|l| l.replace("G3", "G2")));
}

#[test]
fn the_second_turret_works_from_the_other_side() {
    let text = job("{\"line\":[-1,0.5]}")
        .replace("[0,0,1]", "[0.2,0.5]")
        .replace("\"units\"", "\"machine\":\"lathe\",\"units\"")
        .replace("\"work\":54,", "")
        .replace("\"diameter_offset\":21", "\"turret\":2");
    assert_eq!(program(&lathe("RevTurret2? Y", ""), &text)[3], "G0 Z.2 X-1.");
    assert_eq!(program(&lathe("", ""), &text)[3], "G0 Z.2 X1.");
}

const THREAD: &str = "{\"thread\":{\"from\":[0.2,0.5],\"to\":[-1],\"pitch\":0.1,\"depth\":0.08,\"passes\":4}}";

#[test]
fn threads_take_the_best_way_that_the_form_has() {
    let auto = "AutoThread\nG76 X[v] Z[h] P[depth] Q[peck1] F[frate]\nEnd";
    let can = "CanThread 1\nG92 X[v] Z[h] F[frate]\nX[v]\nEnd";
    assert_eq!(turned("Thread G33", &format!("{auto}\n{can}"), THREAD)[1..], ["G76 X.84 Z-1. P.08 Q.04 F.1"]);
    assert_eq!(turned("Thread G33", can, THREAD)[1..], ["G92 X.92 Z-1. F.1", "X.8869", "X.8614", "X.84"]);
    assert_eq!(turned("Thread G33", "", THREAD)[1..], ["G33 X.92 Z-1. I0 F.1", "X.8869", "X.8614", "X.84"]);
    assert!(turned("", "", THREAD)[0].starts_with("PR008"));
}

#[test]
fn full_passes_print_approach_cut_clear_and_return() {
    let two = THREAD.replace("\"passes\":4", "\"passes\":1");
    let lines = turned("Thread G33\nThreadPasses full", "", &two);
    assert_eq!(lines[1..], ["X.84", "G33 X.84 Z-1. I0 F.1", "G0 X1.", "Z.2"]);
}

#[test]
fn more_starts_begin_a_pitch_further_back_and_tapers_are_radii() {
    let two = THREAD.replace("\"passes\":4", "\"passes\":1,\"starts\":2");
    let lines = turned("Thread G33", "", &two);
    assert_eq!(lines[1..], ["G33 X.84 Z-1. I0 F.2", "G0 Z.3 X1.", "G33 X.84 Z-1. I0 F.2"]);
    let taper = THREAD.replace("\"to\":[-1]", "\"to\":[-1,0.45]");
    assert_eq!(turned("Thread G33", "", &taper)[1], "G33 X.82 Z-1. I.05 F.1");
    // the radius of a tapered thread is the radius at the end; each further start begins farther back on the cone
    let cone = THREAD.replace("\"to\":[-1]", "\"to\":[-1],\"taper\":0.12,\"starts\":2").replace("4", "1");
    let lines = turned("Thread G33", "", &cone);
    assert_eq!(lines[1..], ["G33 X.6 Z-1. I.12 F.2", "G0 Z.3 X1.", "G33 X.6 Z-1. I.13 F.2"]);
    let both = taper.replace("\"pitch\"", "\"taper\":0.07,\"pitch\"");
    assert!(turned("Thread G33", "", &both)[0].starts_with("PR031 the ends of the thread differ"));
    let inner = THREAD.replace("0.08", "-0.08");
    assert_eq!(turned("Thread G33", "", &inner)[1..2], ["G33 X1.08 Z-1. I0 F.1"]);
}

/// Every value of a thread is printed as a word or in the packed parameters; otherwise it is an error.
#[test]
fn a_thread_cycle_loses_none_of_its_parameters() {
    let auto = "P 010060\nAutoThread\nG76 P[tparams]\nG76 X[v] Z[h] K[depth] F[frate]\nEnd";
    let asked = |extra: &str| turned("", auto, &THREAD.replace("\"pitch\"", &format!("{extra},\"pitch\"")));
    assert_eq!(asked("\"angle\":60")[1], "G76 P010060");
    assert!(asked("\"angle\":29")[0].starts_with("PR017 the thread cycle does not print the angle"));
    assert!(asked("\"chamfer\":5")[0].starts_with("PR017 the thread cycle does not print the chamfer"));
    assert!(asked("\"taper\":0.1")[0].starts_with("PR017 the thread cycle does not print the taper"));
    let set = format!(
        "{{\"set\":{{\"tparams\":20529}}}},{}",
        THREAD.replace("\"pitch\"", "\"angle\":29,\"chamfer\":5,\"pitch\"")
    );
    assert_eq!(turned("", auto, &set)[1], "G76 P020529");
    let chamfer = THREAD.replace("\"pitch\"", "\"chamfer\":5,\"pitch\"");
    assert!(turned("Thread G33", "", &chamfer)[0].starts_with("PR031 passes made of single moves"));
}

#[test]
fn a_changed_limit_of_the_spindle_is_printed_or_refused() {
    let form = lathe("", "").replace("S[speed] M[direct]\nEnd", "G50 S[maxrpm]\nG[speedtype] S[speed] M[direct]\nEnd");
    let text = |next: &str| {
        job(&format!("{{\"spindle\":{next}}},{{\"line\":[-1,0.5]}}"))
            .replace("[0,0,1]", "[0.2,0.5]")
            .replace("\"units\"", "\"machine\":\"lathe\",\"units\"")
            .replace("\"work\":54,", "")
            .replace("\"speed\":1000", "\"speed\":100,\"mode\":\"css\",\"max\":2000")
    };
    assert_eq!(program(&form, &text("{\"speed\":90}"))[2..6], ["G50 S2000", "G96 S100 M3", "G0 Z.2 X1.", "S90 M3"]);
    assert!(program(&form, &text("{\"max\":1500}"))[0].starts_with("PR038 the spindle is limited to 1500"));
}

#[test]
fn threads_need_a_lathe_and_a_turning_spindle() {
    assert!(path_lines("", "", THREAD)[0].starts_with("PR008"));
    let stopped = format!("{{\"spindle\":{{\"direction\":\"off\"}}}},{THREAD}");
    assert!(turned("Thread G33", "", &stopped)[0].starts_with("PR032"));
}

#[test]
fn a_lathe_drills_along_z() {
    let cycle =
        "{\"rapid\":[0.2,0]},{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[0,0]]}}";
    let lines = turned("", "Drill\nG81 Z[d] R[vclear] F[frate]\nEnd Cancel\nCancel\nG80\nEnd", cycle);
    assert_eq!(lines[2..], ["Z.1", "G81 Z-1. R.1 F5.", "G80"]);
}

#[test]
fn a_wire_takes_compensation_in_one_block_on_four_axes() {
    let form = "Machine EDM\nStartCode\n%0\nEnd\nEndCode\nM2\nEnd\nInFeed\nG[side]\nG1 X[h] Y[v]\nEnd";
    let text = |infeed: &str| {
        format!(
            "{{\"machine\":\"edm\",\"units\":\"inch\",\"operations\":[{{\"feed\":2,\"path\":[{{\"rapid\":[0,0]}},{{\"infeed\":{infeed},\"side\":\"left\"}}]}}]}}"
        )
    };
    assert_eq!(program(form, &text("[1,0]"))[1..4], ["G0 X0 Y0", "F2.", "G41"]);
    assert!(program(form, &text("[1,0,1,0]"))[0].starts_with("PR008"));
    assert!(path_lines("", "", "{\"edm\":\"cut\"}")[0].starts_with("PR008"));
}

#[test]
fn rotary_travel_needs_an_unwind() {
    let path = "{\"line\":[0,0,1,300]},{\"line\":[0,0,1,400]}";
    assert!(path_lines("Limits A -360 360", "", path)[0].starts_with("PR007"));
    assert_eq!(path_lines("", "", path), ["G1 A300. F10.", "A400."]);
    // there is no whole turn to remove, so unwinding would not help
    let unwind = "Unwind\nG0 Z5\nA[lastrotangle]\nEnd";
    assert!(path_lines("Limits A -360 360", unwind, path)[0].starts_with("PR007"));
    let far = "{\"line\":[0,0,1,360]},{\"line\":[0,0,1,400]},{\"line\":[0,0,1,450]}";
    let lines = path_lines("Limits A -360 360", unwind, far);
    assert_eq!(lines[1..], ["G0 Z5", "A0", "G1 X0 Y0 Z1. A40. F10.", "A90."]);
}

#[test]
fn a_lathe_drills_beside_its_axis_only_where_the_tool_goes() {
    let cycle = "{\"rapid\":[0.2,0]},{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"clear\":0.1,\"feed\":5,\"points\":[[0,0],[0,0.5]]}}";
    let lines = turned("", "Drill\nG81 Z[d] R[vclear] F[frate]\nEnd Cancel\nCancel\nG80\nEnd", cycle);
    assert_eq!(lines[2..], ["Z.1", "G81 Z-1. R.1 F5.", "G80", "G0 X1.", "G81 Z-1. R.1 F5.", "G80"]);
}

/// For a turret on the other side of the axis, arcs and compensation are mirrored.
#[test]
fn a_mirrored_turret_turns_arcs_round() {
    let arc = "{\"arc\":{\"to\":[0.1,0.6],\"center\":[0.1,0.5],\"direction\":\"cw\"}}";
    let text = job(arc)
        .replace("[0,0,1]", "[0.2,0.5]")
        .replace("\"units\"", "\"machine\":\"lathe\",\"units\"")
        .replace("\"work\":54,", "")
        .replace("\"diameter_offset\":21", "\"turret\":2");
    assert_eq!(program(&lathe("RevTurret2? Y", ""), &text)[4], "G3 Z.1 X-1.2 K-.1 I0 F10.");
}

/// The surface speed of a tool does not apply to the next tool.
#[test]
fn constant_surface_speed_ends_with_its_tool() {
    let says = "ToolChange\nT[tool]\nG[speedtype] S[speed] M[direct]\nEnd\nEndCode";
    let form = lathe("", "").replace("ToolChange\nT[tool]\nEnd\nEndCode", says);
    let second = "{\"tool\":2,\"spindle\":{\"speed\":900,\"direction\":\"cw\"},\"path\":[{\"rapid\":[1,1]}]}";
    let text = job("{\"line\":[-1,0.5]}")
        .replace("[0,0,1]", "[0.2,0.5]")
        .replace("\"units\"", "\"machine\":\"lathe\",\"units\"")
        .replace("\"work\":54,", "")
        .replace("\"speed\":1000", "\"speed\":100,\"mode\":\"css\"")
        .replace("0.5]}]}]}", &format!("0.5]}}]}},{second}]}}"));
    assert!(program(&form, &text).contains(&"G97 S900 M3".to_owned()), "{:?}", program(&form, &text));
}

#[test]
fn numbers_of_subprograms_are_not_the_programs_own() {
    let text = with_subs(&sub(100, MOVE), "{\"call\":{\"sub\":100}}");
    assert!(program(&mill("RenumSubs? N", SUBS), &text)[0].starts_with("PJ010 the subprogram 100"));
    let first = text.replace("\"program\":100", "\"program\":1");
    assert!(program(&mill("", SUBS), &first).contains(&"M98 P2 L1".to_owned()));
}

#[test]
fn threads_are_approached_from_their_own_side() {
    let inner = THREAD.replace("0.08", "-0.08").replace("[0.2,0.5]", "[0.2,0.4]");
    let found = turned("Thread G33", "", &inner).concat();
    assert!(found.starts_with("PR031 the tool is at the radius 0.5, outside the crest of an inner thread"), "{found}");
    let outer = THREAD.replace("[0.2,0.5]", "[0.2,0.6]");
    let found = turned("Thread G33", "", &outer).concat();
    assert!(found.starts_with("PR031 the tool is at the radius 0.5, inside the crest of an outer thread"), "{found}");
}

/// A vertical wire has no words for its upper guide. For a tilted wire, the form prints these words, even in the block
/// that turns on compensation.
#[test]
fn a_leaning_wire_leans_from_its_lead_in() {
    let form =
        "Machine EDM\nStartCode\n%0\nEnd\nEndCode\nM2\nEnd\nInFeed\nG1 G[side] X[h] Y[v] U[h2] V[v2] F[frate]\nEnd";
    let text = |axes: &str| {
        format!(
            "{{\"machine\":\"edm\",\"units\":\"inch\",\"operations\":[{{\"feed\":2,\"path\":[{{\"rapid\":[0,0]}},{{\"infeed\":{axes},\"side\":\"left\"}}]}}]}}"
        )
    };
    assert_eq!(program(form, &text("[5,0]"))[2], "G1 G41 X5. Y0 F2.");
    assert_eq!(program(form, &text("[5,0,4,1]"))[2], "G1 G41 X5. Y0 U4. V1. F2.");
}

/// A speed in revolutions needs no limit. A surface speed without a limit is an error.
#[test]
fn revolutions_need_no_limit() {
    let form = lathe("", "").replace("S[speed] M[direct]\nEnd", "G50 S[maxrpm]\nG[speedtype] S[speed] M[direct]\nEnd");
    let text = job("{\"line\":[-1,0.5]}")
        .replace("[0,0,1]", "[0.2,0.5]")
        .replace("\"units\"", "\"machine\":\"lathe\",\"units\"")
        .replace("\"work\":54,", "");
    assert_eq!(program(&form, &text)[2..4], ["G50 S1000", "G97 S1000 M3"]);
    let surface = text.replace("\"speed\":1000", "\"speed\":100,\"mode\":\"css\"");
    assert!(program(&form, &surface)[0].starts_with("PR001 [maxrpm]"));
    // later speeds must not exceed this limit either, because the control keeps it
    for later in ["{\"speed\":2000}", "{\"speed\":100,\"mode\":\"css\"}"] {
        let path = format!("{{\"rapid\":[0.2,0.5]}},{{\"spindle\":{later}}},");
        let faster = text.replace("{\"rapid\":[0.2,0.5]},", &path);
        assert!(program(&form, &faster)[0].starts_with("PR038 the tool change limited"), "{later}");
    }
}

/// An action on the wire is printed or refused. Without the action, the wire would be dragged to the next start hole.
#[test]
fn wire_actions_need_their_sequences() {
    let form = |sequences: &str| format!("Machine EDM\nStartCode\n%0\nEnd\nEndCode\nM2\nEnd\n{sequences}");
    for (action, id) in
        [("thread", "EdmThread"), ("cut", "EdmCut"), ("predrill", "EdmPreDrillThread"), ("submerge", "SubmergeTank")]
    {
        let text = format!(
            "{{\"machine\":\"edm\",\"units\":\"inch\",\"operations\":[{{\"feed\":2,\"path\":[{{\"rapid\":[0,0]}},{{\"edm\":\"{action}\"}}]}}]}}"
        );
        assert!(program(&form(""), &text)[0].starts_with("PR008"), "{action}");
        assert_eq!(program(&form(&format!("{id}\nM50\nEnd")), &text)[2], "M50", "{action}");
    }
}

/// The thread cycle is cancelled, because the next rapid would otherwise be a pass.
#[test]
fn a_thread_cycle_is_cancelled() {
    let cycles = ["AutoThread\nG76 X[v] Z[h] P[depth] Q[peck1] F[frate]", "CanThread 1\nG92 X[v] Z[h] F[frate]\nX[v]"];
    for cycle in cycles {
        let lines = turned("", &format!("{cycle}\nEnd Cancel\nCancel\nG80\nEnd"), THREAD);
        assert_eq!(lines.last().map(String::as_str), Some("G80"), "{lines:?}");
    }
}

/// If the form has a Between sequence, the program begins with the subprograms.
#[test]
fn between_means_subprograms_first() {
    let form = mill("", &format!("{SUBS}\nBetween\nM17\nEnd"));
    let lines = program(&form, &with_subs(&sub(1, "{\"rapid\":[0,0,1]}"), "{\"call\":{\"sub\":1}}"));
    let at = |what: &str| lines.iter().position(|line| line == what);
    assert!(at("M17").is_some() && at("M17") < at("T1 M6") && at("M99") < at("M17"), "{lines:?}");
}

/// If the tool change prints the speed mode, no other block prints the mode. Otherwise a separate block prints the mode
/// together with its speed.
#[test]
fn a_surface_speed_is_not_said_without_its_speed() {
    let text = job("{\"line\":[-1,0.5]}")
        .replace("[0,0,1]", "[0.2,0.5]")
        .replace("\"units\"", "\"machine\":\"lathe\",\"units\"")
        .replace("\"work\":54,", "")
        .replace("\"speed\":1000", "\"speed\":100,\"mode\":\"css\"");
    let typed = "@if [speedtype] = css\nG96 S[speed] M[direct]\n@else\nG97 S[speed] M[direct]\n@end\nEnd\nToolChange";
    let form = lathe("", "").replace("S[speed] M[direct]\nEnd\nToolChange", typed);
    assert_eq!(program(&form, &text)[1..3], ["T1", "G96 S100 M3"]);
    assert_eq!(program(&lathe("", ""), &text)[1..4], ["G96 S100", "T1", "S100 M3"]);
}

/// A wire machine has no tools, so the job gives the offset register.
#[test]
fn a_wire_without_a_tool_has_its_offset_from_the_job() {
    let form = "Machine EDM\nStartCode\n%0\nEnd\nInFeed\nG1 G[side] D[dcomp] X[h] Y[v] F[frate]\nEnd\nOutFeed\nG1 G40 X[h] Y[v] F[frate]\nEnd\nEndCode\nM2\nEnd\n";
    let job = r#"{"postform":1,"units":"inch","machine":"edm","set":{"dcomp":7},"operations":[{"work":54,"feed":2,"path":[{"rapid":[0,0]},{"infeed":[1,0],"side":"left"},{"line":[2,0]},{"outfeed":[3,0]}]}]}"#;
    assert!(program(form, job).contains(&"G1 G41 D7 X1. Y0 F2.".to_owned()), "{:?}", program(form, job));
    let none = program(form, &job.replace("\"set\":{\"dcomp\":7},", ""));
    assert!(none[0].starts_with("PR001 [dcomp]"), "{none:?}");
}
