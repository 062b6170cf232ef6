//! Two kinds of wrong verdicts must not occur: a correct program is reported as different, or a wrong program is
//! proven.

use std::fs;
use std::io::Cursor;

use crate::program_commands::{postform, text};
use crate::support::folder::{Folder, err, out};
use crate::support::{check, control, job_options, plain_post, root};
use crate::verify::{document, inches, post, rendered, verified};
use postform::internals::compile::compile;
use postform::internals::json::read_lines;
use postform::internals::nc::{RunSettings, read_program};
use postform::internals::render::{Cycles, Options as RenderOptions, Renderer};
use postform::internals::verify::{
    Batch, Comparer, Equivalences, Expectation, Kept, UNPROVEN, Verdict, prove_beside, tolerances,
};
use postform::toolpath::{Event, Flow, Place, Sink, Units};

/// A metric job with two tools.
pub fn mm(operations: &str) -> String {
    format!(
        r#"{{"postform":1,"program":7,"units":"mm","tools":[{{"number":1,"diameter":6}},{{"number":2,"diameter":5}}],"operations":[{operations}]}}"#
    )
}

/// An operation with the first tool.
pub fn one(path: &str) -> String {
    mm(&format!(
        r#"{{"tool":1,"work":54,"spindle":{{"speed":1000,"direction":"cw"}},"coolant":"flood","feed":100,"path":[{path}]}}"#
    ))
}

pub fn of_post(name: &str, job: &str) -> (String, Verdict) {
    of_form(&post(name), job)
}

fn of_form(form: &str, job: &str) -> (String, Verdict) {
    let form = check(form);
    let job = document(job);
    let program = rendered(&form, &job, Cycles::Form);
    let verdict = verified(&form, &program, &job);
    (program, verdict)
}

#[track_caller]
fn is_right(name: &str, (program, verdict): (String, Verdict)) {
    assert!(verdict.is_proven(), "{name}: {verdict:#?}\n{program}");
}

/// Checks that the programs of these posts for these jobs are proven.
#[track_caller]
fn all_are_right(jobs: &[(&str, String)], posts: &[&str]) {
    let mut wrong = String::new();
    for (name, job) in jobs {
        for post in posts {
            let (program, verdict) = of_post(post, job);
            if !verdict.is_proven() {
                wrong += &format!("{name}, {post}: {verdict:?}\n{program}\n");
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

/// Correct programs of the posts that earlier versions reported as different.
#[test]
fn right_programs_are_proven() {
    let jobs = [
        (
            "a cut that vanishes in the digits",
            one(
                r#"{"rapid":[10.00004,10.00003,25]},{"rapid":[10.00004,10.00003,5]},{"line":[10,10,5]},{"line":[20,10,5]},{"rapid":[20,10,25]}"#,
            ),
        ),
        (
            "many short cuts",
            one(
                r#"{"rapid":[0,0,25]},{"line":[0,0,0]},{"line":[0.0004,0,0]},{"line":[0.0008,0,0]},{"line":[0.0012,0,0]},{"line":[0.0016,0,0]},{"line":[0.002,0,0]},{"line":[5,0,0]},{"rapid":[5,0,25]}"#,
            ),
        ),
        (
            "a short cut before a hole",
            one(
                r#"{"rapid":[0,0,25]},{"line":[0.00004,0,25]},{"cycle":{"kind":"drill","depth":3,"clear":1,"feed":60,"points":[[1,1,0]]}}"#,
            ),
        ),
        (
            "a last peck shorter than the tolerance",
            one(
                r#"{"rapid":[10,10,25]},{"cycle":{"kind":"deep","depth":9.00161,"clear":3,"return":25,"feed":382.27,"first_step":8,"step":2,"points":[[10,10,0]]}}"#,
            ),
        ),
        (
            "a first step just short of the depth",
            one(
                r#"{"rapid":[0,0,96.1]},{"cycle":{"kind":"deep","clear":4.5,"feed":250.1,"depth":8.1,"step":14,"first_step":12.598,"points":[[22,59,6]]}}"#,
            ),
        ),
        (
            "an offset that only positions",
            mm(
                r#"{"tool":1,"work":55,"spindle":{"speed":1000,"direction":"cw"},"feed":10,"path":[{"rapid":[0,0,20]},{"work":56},{"rapid":[1,1,20]},{"line":[1,2,20]},{"rapid":[1,1,20]}]}"#,
            ),
        ),
        (
            "a tool that only positions",
            mm(
                r#"{"tool":1,"work":54,"spindle":{"speed":1500,"direction":"cw"},"path":[{"rapid":[5,-1,20]}]},{"tool":2,"work":54,"spindle":{"speed":1500,"direction":"cw"},"path":[{"cycle":{"kind":"drill","depth":3,"clear":1,"feed":10,"points":[[1,1,0]]}}]}"#,
            ),
        ),
        (
            "a dwell after a reamed hole",
            one(
                r#"{"rapid":[0,0,25]},{"cycle":{"kind":"face","clear":2,"depth":8,"feed":60,"points":[[0.001,0,0]]}},{"cycle":{"kind":"ream","clear":2,"depth":8,"feed":60,"points":[[-1,1,0]]}},{"dwell":1.5},{"line":[1,0,-1],"feed":32}"#,
            ),
        ),
        (
            "a dwell between rapids",
            one(
                r#"{"rapid":[0,0,20]},{"line":[0,0,-1]},{"dwell":3},{"rapid":[0,0,20]},{"rapid":[1,1,20]},{"dwell":2},{"rapid":[1,1,10]},{"line":[1,1,-1]},{"rapid":[1,1,20]}"#,
            ),
        ),
        (
            "offsets there and back",
            mm(
                r#"{"tool":1,"work":54,"spindle":{"speed":1500,"direction":"ccw"},"coolant":"off","path":[{"cycle":{"kind":"deep","clear":2,"depth":8,"feed":60,"step":3,"return":8,"points":[[10,10,0]]}}]},
            {"tool":2,"work":55,"spindle":{"speed":1000,"direction":"cw"},"coolant":"flood","path":[{"cycle":{"kind":"chipbreak","clear":1,"depth":8,"feed":60,"step":3,"return":8,"dwell":1,"points":[[0.001,-3.25,0]]}},{"work":56},{"work":55},{"rapid":[0,0,20]},{"cycle":{"kind":"chipbreak","clear":5,"depth":8,"feed":60,"step":3,"dwell":1,"points":[[2.5,0,0]]}}]}"#,
            ),
        ),
        (
            "a feed up from a deep hole",
            one(
                r#"{"rapid":[0,0,25]},{"cycle":{"kind":"deep","depth":9,"clear":1,"feed":317,"step":3,"points":[[1,1,0]]}},{"line":[1,1,8],"feed":726.2},{"rapid":[1,1,25]}"#,
            ),
        ),
        (
            "a left tap with a return plane",
            one(
                r#"{"rapid":[0,0,25]},{"cycle":{"kind":"ltap","depth":9,"clear":2,"return":20,"feed":500,"points":[[1,1,0],[4,1,0]]}},{"rapid":[4,1,25]}"#,
            ),
        ),
        (
            "a stop, then a short cut",
            one(
                r#"{"rapid":[0,0,25]},{"line":[0,0,1]},{"rapid":[0,0,25]},{"stop":"optional"},{"rapid":[3,3,5]},{"line":[3.001,3,5]},{"line":[9,3,5]},{"rapid":[9,3,25]}"#,
            ),
        ),
        ("a stop that is typed", one(r#"{"rapid":[0,0,25]},{"line":[0,0,1]},{"text":"M1"},{"rapid":[0,0,25]}"#)),
        (
            "a stop right after the change of tool",
            mm(
                r#"{"tool":1,"work":54,"spindle":{"speed":1500,"direction":"cw"},"feed":50,"path":[{"rapid":[0,0,20]},{"line":[0,0,1]},{"rapid":[0,0,20]}]},
            {"tool":2,"work":54,"spindle":{"speed":1500,"direction":"cw"},"feed":50,"path":[{"rapid":[5,5,20]},{"stop":"program"},{"rapid":[6,6,20]},{"line":[6,6,1]},{"rapid":[6,6,20]}]}"#,
            ),
        ),
        (
            "a short cut after a hole, and another feed after it",
            one(
                r#"{"cycle":{"kind":"ream","depth":9,"clear":2,"feed":60,"points":[[10,10,0]]}},{"line":[9.999,10,2]},{"line":[9.999,40,5],"feed":200},{"rapid":[9.999,40,25]}"#,
            ),
        ),
        (
            "a rapid that vanishes between short cuts",
            one(
                r#"{"rapid":[0,0,25]},{"line":[9,0,5]},{"rapid":[9.0004,0,5]},{"line":[9.0029,0,5]},{"line":[9.0029,0,1],"feed":50},{"rapid":[9.0029,0,25]}"#,
            ),
        ),
        (
            "a stop after a cut that vanishes",
            one(
                r#"{"rapid":[0,0,25]},{"line":[9,-3.07856,5]},{"line":[9,-3.07846,5]},{"stop":"optional"},{"line":[9,-3.07796,5]},{"rapid":[9,0,25]}"#,
            ),
        ),
        (
            "a helix whose circle no digits show",
            one(
                r#"{"rapid":[1.00014,2.00013,25]},{"arc":{"to":[1.00018,2.00009,5],"radius":2.1,"direction":"ccw"}},{"rapid":[1,2,25]}"#,
            ),
        ),
        (
            "a rapid down that is steep",
            one(
                r#"{"rapid":[0,0,25]},{"line":[-2.9749,-1.8626,20.5123]},{"rapid":[-2.9747,-1.8624,2.0496]},{"rapid":[30,40,25]},{"line":[30,40,5]},{"rapid":[30,40,25]}"#,
            ),
        ),
        (
            "a hole whose clearance is above the return plane",
            one(
                r#"{"rapid":[0,0,25]},{"cycle":{"kind":"drill","depth":9,"clear":3,"return":12,"feed":60,"points":[[10,10,0],[20,10,13],[30,10,4],[40,10,-8]]}},{"rapid":[50,50]},{"line":[50,50,2]},{"rapid":[50,50,25]}"#,
            ),
        ),
        (
            "a tap whose clearance is above the return plane",
            one(
                r#"{"rapid":[0,0,25]},{"cycle":{"kind":"tap","depth":9,"clear":3,"return":12,"feed":600,"points":[[10,10,0],[20,10,13],[30,10,4],[40,10,-8]]}},{"rapid":[40,10,25]}"#,
            ),
        ),
        (
            "a cut that no digits show between two rapids after the last hole",
            one(
                r#"{"rapid":[0,0.001,1]},{"cycle":{"kind":"drill","depth":0.9,"clear":0.1,"return":0.48,"feed":6,"points":[[0,0.001,0]]}},{"rapid":[0,0,-0.098]},{"line":[0,0.00001,-0.098]},{"rapid":[0,0.00001,-0.099]}"#,
            )
            .replace("\"mm\"", "\"inch\""),
        ),
        (
            "a short rapid, and a steep one to a hole",
            one(
                r#"{"rapid":[3.303748,2.414227,0.889611]},{"rapid":[3.302748,2.414227,0.889611]},{"cycle":{"kind":"drill","return":0.961747,"depth":0.3,"clear":0.1,"feed":7,"points":[[-2.96535,3.032355,0]]}}"#,
            )
            .replace("\"mm\"", "\"inch\""),
        ),
        (
            "a dwell before a cut that is hardly longer than the one that no digits show",
            one(
                r#"{"rapid":[-1.01,2.84,0.51]},{"rapid":[null,null,0.9]},{"line":[-1.01,2.84,0.90001]},{"rapid":[null,2.8401]},{"dwell":0.5},{"line":[-1.01,2.84,0.90001]}"#,
            )
            .replace("\"mm\"", "\"inch\""),
        ),
        (
            "the shortest cut that digits show, after a tap",
            one(
                r#"{"rapid":[1.9187,-2.6443,1]},{"cycle":{"kind":"tap","depth":0.8797,"clear":0.1,"feed":50,"points":[[1.9187,-2.6443,-0.4383],[2.025,-0.1778,-0.4509]]}},{"line":[2.0251]},{"rapid":[2.0251,-0.1778,1.5602]}"#,
            )
            .replace("\"mm\"", "\"inch\""),
        ),
        (
            "a cut that no digits show, a short rapid and a short cut",
            one(
                r#"{"rapid":[0,0,30]},{"line":[97.75,-76,25.1]},{"line":[97.75,-75.99975,25.1]},{"rapid":[97.75,-75.99975,25.0975]},{"line":[97.7475,-75.99975,25.0975]}"#,
            ),
        ),
        (
            "mist on a machine without it",
            one(r#"{"rapid":[0,0,25]},{"coolant":"mist"},{"line":[0,0,1]},{"rapid":[0,0,25]}"#),
        ),
    ];
    all_are_right(&jobs, &["fanuc.pf", "haas.pf", "linuxcnc.pf", "grbl.pf"]);
    let oriented = [(
        "a back bore beside the last one, where that one was left",
        one(
            r#"{"rapid":[51,-61,25]},{"cycle":{"kind":"back","depth":5,"clear":3,"feed":450,"rapto":11,"orient":90,"offset":1,"points":[[51,-61,0],[51,-62,0]]}}"#,
        ),
    )];
    all_are_right(&oriented, &["fanuc.pf", "haas.pf", "linuxcnc.pf"]);
}

/// Correct paths on a lathe: cuts that are not longer than the last digit, and cuts that continue straight through a
/// corner.
#[test]
fn right_ways_of_lathes_are_proven() {
    let job = |path: &str| {
        format!(
            r#"{{"postform":1,"program":7,"units":"inch","machine":"lathe","tools":[{{"number":1}}],"operations":[{{"tool":1,"spindle":{{"direction":"cw","speed":1000}},"feed":0.004,"path":[{path}]}}]}}"#
        )
    };
    let hole = |clear: &str| {
        format!(r#"{{"cycle":{{"kind":"ream","depth":0.9,"clear":{clear},"feed":0.0063,"points":[[0,0]]}}}}"#)
    };
    let jobs = [
        ("down by less than the digits", format!(r#"{{"rapid":[0.116,1.4489]}},{}"#, hole("0.1159"))),
        (
            "straight on through a corner",
            format!(r#"{{"rapid":[0.4085,1.9906]}},{{"rapid":[0.3338,1.5213]}},{}"#, hole("0.0918")),
        ),
        (
            "a corner that only digits make",
            r#"{"rapid":[0.467043,1.313765]},{"line":[0.467043,1.3]},{"rapid":[0.368854,1.495519]},{"rapid":[0.254877,1.707079]}"#.to_owned(),
        ),
    ];
    all_are_right(&jobs.map(|(name, path)| (name, job(&path))), &["fanuc-lathe.pf", "haas-lathe.pf"]);
}

/// If two threads follow each other, the passes of the second thread belong to the second thread.
#[test]
fn right_threads_are_proven() {
    let job = |path: &str| {
        format!(
            r#"{{"postform":1,"program":1,"units":"mm","machine":"lathe","tools":[{{"number":1}}],"operations":[{{"tool":1,"spindle":{{"direction":"cw","speed":500,"max":1000}},"feed":0.3,"path":[{{"rapid":[2,42]}},{path}]}}]}}"#
        )
    };
    let thread = |radius: u32, passes: &str| {
        format!(r#"{{"thread":{{"from":[2,{radius}],"to":[-26,{radius}],"pitch":2,"depth":1,{passes}}}}}"#)
    };
    let (whole, four) = (r#""first_depth":1"#, r#""passes":4"#);
    let jobs = [
        ("one farther out", format!("{},{}", thread(11, whole), thread(22, four))),
        ("one whose depth is the crest of the first", format!("{},{}", thread(11, whole), thread(12, whole))),
        ("the same once more", format!("{},{}", thread(11, whole), thread(11, whole))),
        (
            "the same once more, from elsewhere",
            format!("{},{{\"rapid\":[10,48]}},{}", thread(11, four), thread(11, four)),
        ),
        ("a stop before the same", format!("{},{{\"stop\":\"program\"}},{}", thread(11, four), thread(11, four))),
    ];
    // each pass is a separate block, as on a control without a thread cycle
    let passes = include_str!("../data/forms/lathe-radius.pf");
    for (name, path) in &jobs {
        is_right(name, of_post("haas-lathe.pf", &job(path)));
        is_right(name, of_form(passes, &job(path)));
    }
}

/// A helix with a very small radius. A form with radius words divides the helix, because rounding would move its
/// centre.
#[test]
fn a_steep_helix_in_parts_is_proven() {
    let helix = r#"{"rapid":[1,1,1]},{"rapid":[0.9621,-0.05,0.1]},{"line":[0.9620692,-0.05,-0.1432692]},{"arc":{"to":[0.96283,-0.0500907,-0.2],"center":[0.91,-0.49,-0.1432692],"direction":"cw"}}"#;
    let job = one(helix).replace("\"mm\"", "\"inch\"");
    let (program, verdict) = of_form(include_str!("../data/forms/radius-words.pf"), &job);
    assert!(program.contains("R.4431"), "{program}");
    is_right("a steep helix", (program, verdict));
}

/// Forms of shops: a dwell for the spindle, renamed axes, a move home before the next tool.
#[test]
fn right_programs_of_other_forms_are_proven() {
    let fanuc = post("fanuc.pf");
    let path = r#"{"rapid":[0,0,25]},{"line":[0,0,1]},{"line":[9,0,1]},{"rapid":[9,0,25]}"#;
    let spin_up = fanuc.replacen("S[speed] M[direct]\n", "S[speed] M[direct]\nG4 P3000\n", 2);
    let (program, verdict) = of_form(&spin_up, &one(path));
    assert_eq!(verdict, Verdict::Equivalent(Equivalences { dwells: 1, ..Equivalences::default() }), "{program}");

    // the form has its own feed: from 0.2 to 2 times the job's feed of 100
    for (word, printed) in [("F150.", "F150."), ("F200.", "F200."), ("F20.", "F20."), ("F[frate*2]", "F200.")] {
        let typed = fanuc.replacen("EndCode", &format!("LineCode\nG1 X[h] Y[v] Z[d] {word}\nEnd\n\nEndCode"), 1);
        let (program, verdict) = of_form(&typed, &one(path));
        let feeds = matches!(verdict, Verdict::Equivalent(Equivalences { feeds: 2, .. }));
        assert!(feeds && program.contains(printed), "{verdict:?}\n{program}");
    }
    for word in ["F202.", "F19.", "F[frate*2.1]", "F[frate*100]"] {
        let typed = fanuc.replacen("EndCode", &format!("LineCode\nG1 X[h] Y[v] Z[d] {word}\nEnd\n\nEndCode"), 1);
        assert!(matches!(of_form(&typed, &one(path)).1, Verdict::Different(_)), "{word}");
    }
    let faster =
        |by: &str| of_form(&fanuc.replace("S[speed] M[direct]", &format!("S[speed*{by}] M[direct]")), &one(path)).1;
    assert!(matches!(faster("2"), Verdict::Equivalent(_)) && matches!(faster("2.1"), Verdict::Different(_)));

    // one form limits the speed, another form reduces the feeds: both changes belong to the form and are counted
    let limited = fanuc.replace("S[speed] M[direct]", "S[min(speed,800)] M[direct]");
    let (program, verdict) = of_form(&limited, &one(path));
    let speeds = matches!(verdict, Verdict::Equivalent(Equivalences { speeds: 2, .. }));
    assert!(speeds && program.contains("S800"), "{verdict:?}\n{program}");
    let slower = fanuc.replacen("EndCode", "LineCode\nG1 X[h] Y[v] Z[d] F[frate*0.5]\nEnd\n\nEndCode", 1);
    let (program, verdict) = of_form(&slower, &one(path));
    let feeds = matches!(verdict, Verdict::Equivalent(Equivalences { feeds: 2, .. }));
    assert!(feeds && program.contains("F50."), "{verdict:?}\n{program}");
    // with another speed, a tap would cut another thread
    let tap = one(
        r#"{"rapid":[0,0,25]},{"cycle":{"kind":"tap","depth":9,"clear":2,"feed":1250,"points":[[1,1,0]]}},{"rapid":[1,1,25]}"#,
    );
    let limited = fanuc.replace("S[speed]", "S[min(speed,800)]");
    assert!(matches!(of_form(&limited, &tap).1, Verdict::Different(_)), "{:?}", of_form(&limited, &tap));

    let home = fanuc.replacen(
        "Upon [work]\nG91 G28 Z0\nG90\nG[work] G0 X[h] Y[v]\nG43 H[lcomp] Z[d]\nEnd",
        "Upon [work]\nG[work]\nEnd",
        1,
    );
    assert_ne!(home, fanuc);
    let offsets = mm(
        r#"{"tool":1,"work":54,"spindle":{"speed":900,"direction":"cw"},"feed":50,"path":[{"rapid":[0,0,20]},{"line":[0,0,1]},{"rapid":[0,0,20]}]},
        {"tool":2,"work":55,"spindle":{"speed":900,"direction":"cw"},"path":[{"rapid":[5,5,20]},{"cycle":{"kind":"deep","depth":9,"clear":2,"feed":60,"step":4,"points":[[5,5,0]]}}]}"#,
    );
    is_right("another offset with another tool", of_form(&home, &offsets));

    // the last part of an arc is shorter than the last digit; a full circle in the other direction follows
    let unusual = |name: &str| std::fs::read_to_string(root().join(format!("tests/data/forms/{name}.pf"))).unwrap();
    let inch = |path: &str| {
        format!(
            r#"{{"postform":1,"program":5,"units":"inch","tools":[{{"number":1}}],"operations":[{{"tool":1,"work":54,"spindle":{{"speed":1000,"direction":"cw"}},"feed":35,"path":[{path}]}}]}}"#
        )
    };
    let arcs = inch(
        r#"{"rapid":[2.1991,0.974,1.2191]},{"line":[-1.6529,3.6587,-0.25]},{"arc":{"to":[-1.6310425,3.6577622,-0.25],"radius":0.25383784193850994,"direction":"ccw"}},{"arc":{"to":[-1.6310425,3.6577622,-0.25],"center":[-1.9185,3.4783,-0.25],"direction":"cw"}}"#,
    );
    is_right("a circle after the rest of an arc", of_form(&unusual("spin-up"), &arcs));
    // two cuts of about one digit, along X and along Y; only one of them is printed
    let across = inch(
        r#"{"rapid":[93.788,84.085,46.211]},{"line":[93.78775,84.085,46.211]},{"rapid":[93.78775,84.086,46.211]},{"line":[93.78775,84.0835,46.211]},{"rapid":[68.733,82.644,46.211]},{"line":[68.733,82.644,-1.199]}"#,
    )
    .replacen("\"units\":\"inch\"", "\"units\":\"mm\"", 1);
    is_right("a cut across one that no digits show", of_form(&unusual("metric"), &across));
    // after the move home, the tool moves down and then across. The start is unknown. This control keeps the tool
    // length at home
    let home = inch(
        r#"{"rapid":[0.7375,-2.0667,1.6584]},{"home":true},{"rapid":[null,null,1.0876]},{"rapid":[0.6466,-2.2204,1.6921]},{"line":[-3.1394,-1.7077,-0.3154]}"#,
    );
    let keeps = unusual("no-return-plane").replace("Control fanuc", "Control linuxcnc");
    let keeps = keeps.replace("AfterHome\nG0 X[h] Y[v]\nG43 H[lcomp] Z[d]\nEnd\n", "");
    is_right("down after home", of_form(&keeps, &home));
    // after the hole, the tool is higher than in the job; it moves back down for a cut that is shorter than the last
    // digit
    let tapped = inch(
        r#"{"rapid":[1.0698,1.7598,0.8441]},{"cycle":{"kind":"tap","clear":0.2746,"depth":0.7718,"feed":18.9,"points":[[-0.7609,0.351,-0.2594]]}},{"line":[-0.7609,0.351,0.01521]},{"rapid":[-0.7609,0.351,1.7092]}"#,
    );
    is_right("back to where the job left the hole", of_form(&unusual("no-return-plane"), &tapped));

    let rotary = plain_post("haas-4axis.pf");
    let renamed = format!("Rename A B\n{rotary}");
    let turned = one(
        r#"{"rapid":[0,0,100,0]},{"rapid":[0,0,2,0]},{"line":[9,0,2,0]},{"rapid":[9,0,100,0]},{"rapid":[9,0,100,90]},{"line":[9,0,2,90]},{"rapid":[9,0,100,90]}"#,
    );
    let (program, verdict) = of_form(&renamed, &turned);
    assert!(program.contains("B90."), "{program}");
    is_right("an axis by another name", (program, verdict));
}

/// If postform reads a program as a job, the same program is proven for this job.
#[test]
fn programs_are_identical_to_themselves() {
    let head = "%\nO1\nG20 G17 G40 G49 G80 G90\nT1 M6\nG0 G54 X0. Y-3.9 S1000 M3\nG43 H1 Z1.\n";
    let bodies = [
        ("a short cut after a long one", "G1 Z-2.5933 F10.\nY-3.8216\nZ-2.5934\nY-.133\nG0 Z1.\n"),
        (
            "a hole that returns to R before one that does not",
            "G99 G81 X1. Y1. Z-.5 R.1 F10.\nG98 X2. Y1. Z-.6 R.2\nG80\nG0 Z1.\n",
        ),
        ("a cycle that begins below its R plane", "Z.05\nG98 G81 X1. Y1. Z-.5 R.1 F10.\nX2.\nG80\nG0 Z1.\n"),
    ];
    for (name, body) in bodies {
        let program = format!("{head}{body}M30\n%\n");
        let settings = RunSettings::new(control("fanuc"));
        let mut comparer = Comparer::new(Cursor::new(program.clone()), settings, Expectation::default(), None, false);
        let options = job_options(settings);
        let read = read_program(Cursor::new(program.clone()), &options, &mut Vec::new(), &mut comparer);
        let verdict = comparer.verdict().unwrap();
        assert!(verdict.is_proven(), "{name}: {read:?} {verdict:#?}");
    }
}

/// Correct programs, changed in one place. Earlier versions reported each changed program as identical or equivalent.
#[test]
fn wrong_programs_are_different() {
    let back = r#"{"rapid":[0,0,2]},{"cycle":{"kind":"back","depth":0.5,"rapto":0.9,"clear":0.1,"feed":5,"orient":90,"offset":0.05,"points":[[1,1,0]]}},{"rapid":[null,null,2]},{"line":[3,3,1.9]},{"rapid":[3,3,2]}"#;
    let bore = r#"{"rapid":[0,0,2]},{"cycle":{"kind":"bore","depth":0.5,"clear":0.1,"feed":5,"orient":90,"offset":0.05,"points":[[1,1,0]]}},{"rapid":[1,1,2]}"#;
    let deep = r#"{"rapid":[1,1,2]},{"cycle":{"kind":"deep","emulate":true,"depth":1,"clear":0.1,"feed":5,"step":0.4,"points":[[1,1,0]]}},{"rapid":[1,1,2]}"#;
    let pecks = r#"{"rapid":[1,1,2]},{"cycle":{"kind":"deep","emulate":true,"depth":1,"clear":0.1,"feed":5,"pecks":[{"to":0.4,"feed":5},{"to":0.7,"feed":4},{"to":1,"feed":3}],"points":[[1,1,0]]}},{"rapid":[1,1,2]}"#;
    // each peck begins above the bottom of the previous peck, so its first part is not in the material
    let chips = pecks.replace("deep", "chipbreak").replace("\"clear\"", "\"back\":0.05,\"clear\"");
    let chips = chips.as_str();
    let gap = r#"{"rapid":[0,0,2]},{"line":[0,0,-1]},{"dwell":3},{"rapid":[0,0,2]},{"rapid":[1,1,2]},{"dwell":2},{"rapid":[1,1,1]},{"line":[1,1,-1]},{"rapid":[1,1,2]}"#;
    let stop = r#"{"rapid":[0,0,2]},{"line":[0,0,-1]},{"line":[2,2,-1]},{"rapid":[2,2,2]},{"stop":"program"},{"rapid":[3,3,2]},{"line":[3,3,1.5]},{"rapid":[3,3,2]}"#;
    let optional = r#"{"rapid":[0,0,2]},{"line":[0,0,-1]},{"rapid":[0,0,2]},{"stop":"optional"},{"rapid":[3,3,2]},{"line":[3,3,1.5]},{"rapid":[3,3,2]}"#;
    let tap = r#"{"rapid":[1,1,2]},{"cycle":{"kind":"tap","depth":0.5,"clear":0.2,"feed":150,"points":[[1,1,0]]}},{"rapid":[1,1,2]}"#;
    let tapped = r#"{"rapid":[1,1,2]},{"cycle":{"kind":"tap","depth":0.5,"clear":0.2,"feed":150,"points":[[1,1,0]]}},{"rapid":[1,1,2]},{"line":[2,1,2]},{"rapid":[2,1,3]}"#;
    let offsets = r#"{"rapid":[0,0,2]},{"line":[0,0,-1]},{"rapid":[0,0,2]},{"work":55},{"rapid":[3,3,2]},{"line":[3,3,1.5]},{"rapid":[3,3,2]}"#;
    let air = r#"{"rapid":[1,1,2]},{"rapid":[2,2,2]}"#;
    let mutations = [
        ("fanuc.pf", back, "G1 Z-.5", "G1 Z.5", "PV004"),
        ("fanuc.pf", back, "G1 Z-.5", "G1 Z-.1", "PV004"),
        ("haas.pf", bore, "M19 R90.", "M5", "PV011"),
        ("haas.pf", bore, "M19 R90.", "M19", "PV011"),
        ("haas.pf", bore, "M19 R90.", "M19 R270.", "PV011"),
        ("linuxcnc.pf", back, "M19 R90.", "M19 R45.", "PV011"),
        ("haas.pf", deep, "G1 Z-.7", "M5\nG1 Z-.7", "PV011"),
        ("haas.pf", deep, "G1 Z-.7", "G43 H5\nG1 Z-.7", "PV014"),
        ("haas.pf", pecks, "F4.", "F40.", "PV006"),
        ("haas.pf", pecks, "F3.", "F30.", "PV006"),
        ("haas.pf", chips, "F5.", "F4.", "PV006"),
        ("haas.pf", chips, "F4.", "F5.", "PV006"),
        ("haas.pf", gap, "G4 P2.", "G4 P20.", "PV010"),
        ("haas.pf", gap, "G4 P2.\n", "(none)\n", "PV010"),
        ("haas.pf", gap, "G4 P3.\n", "(none)\n", "PV010"),
        ("haas.pf", stop, "G0 Z2.\nN90 M0\n", "M0\nN90 G0 Z2.\n", "PV019"),
        ("haas.pf", optional, "M1\n", "(none)\n", "PV019"),
        ("haas.pf", stop, "M8\n", "M9\n", "PV024"),
        ("fanuc.pf", tap, "M29 S3000", "S3000", "PV011"),
        ("fanuc.pf", air, "G20 ", "", "PV022"),
        ("haas.pf", deep, "G1 Z-.3", "G1 Y1.2 Z-.3", "PV001"),
        ("haas.pf", stop, "X2. Y2.\n", "X1. Y1.\nM5\nX2. Y2.\n", "PV011"),
        ("haas.pf", stop, "G43 H1 Z2. M8", "G43 H1 Z-3. M8\nZ2.", "PV009"),
        ("fanuc.pf", stop, "G43 H1", "H1", "PV014"),
        ("haas.pf", tapped, "S3000 M3", "S3000 M5", "PV011"),
        ("grbl.pf", offsets, "G55 X3. Y3.\nZ2.\n", "Z2.\nG55 X3. Y3.\n", "PV001"),
        ("fanuc.pf", offsets, "G55 G0 X3. Y3.\nN100 G43 H1 Z2.\n", "G0 Z2.\nG55 X3. Y3.\n", "PV001"),
        ("haas.pf", stop, "M30\n", "(none)\n", "PV015"),
    ];
    let mut quiet = String::new();
    for (name, path, from, to, code) in mutations {
        let form = check(&post(name));
        let text = inches("1", path);
        let job = document(&text);
        let program = rendered(&form, &job, Cycles::Form);
        let right = verified(&form, &program, &job);
        assert!(right.is_proven(), "{name}: {right:?}\n{program}");
        if !program.contains(from) {
            quiet += &format!("`{from}` is not in\n{program}");
            continue;
        }
        let changed = program.replacen(from, to, 1);
        let Verdict::Different(findings) = verified(&form, &changed, &job) else {
            quiet += &format!("{from} -> {to} is not found\n{changed}");
            continue;
        };
        if findings.iter().all(|finding| finding.code.name() != code) {
            quiet += &format!("{from} -> {to}: {code} wanted\n{findings:?}\n{changed}");
        }
    }
    assert!(quiet.is_empty(), "{quiet}");
}

/// The proof finds a low rapid in a work offset without cuts.
#[test]
fn low_rapids_of_other_offsets_are_found() {
    let job = r#"{"postform":1,"program":1,"units":"inch","tools":[{"number":1,"diameter":0.5}],"operations":[{"tool":1,"work":54,"spindle":{"speed":1000,"direction":"cw"},"feed":10,"path":[{"rapid":[0,0,2]},{"work":55},{"rapid":[2,2,2]},{"line":[2,2,-1]},{"rapid":[2,2,2]}]}]}"#;
    let form = check(&post("grbl.pf"));
    let job = document(job);
    let program = rendered(&form, &job, Cycles::Form);
    assert!(verified(&form, &program, &job).is_proven(), "{program}");
    let low = program.replacen("G0 G53 Z0\n", "G0 Z-3.\n", 1);
    assert_ne!(low, program);
    assert!(matches!(verified(&form, &low, &job), Verdict::Different(_)), "{low}");
}

/// Only a program without any difference is identical. Allowed differences are counted.
#[test]
fn what_is_otherwise_is_counted() {
    let form = check(&post("haas.pf"));
    let text = inches(
        "1",
        r#"{"rapid":[0,0,2]},{"line":[0,0,-1]},{"rapid":[0,0,2]},{"rapid":[1,1,2]},{"line":[1,1,-1]},{"rapid":[1,1,2]}"#,
    );
    let job = document(&text);
    let program = rendered(&form, &job, Cycles::Form);
    assert_eq!(verified(&form, &program, &job), Verdict::Identical, "{program}");
    let counted = |from: &str, to: &str, expected: Equivalences| {
        assert!(program.contains(from), "{from}\n{program}");
        let changed = program.replacen(from, to, 1);
        assert_eq!(verified(&form, &changed, &job), Verdict::Equivalent(expected), "{changed}");
    };
    let none = Equivalences::default;
    counted("X1. Y1.\n", "Z3.\nX1. Y1.\nZ2.\n", Equivalences { ways: 1, ..none() });
    // M1 of a Haas stops the spindle and the coolant
    counted("X1. Y1.\n", "M1\nM3\nM8\nX1. Y1.\n", Equivalences { stops: 1, ..none() });
    counted("X1. Y1.\n", "G4 P1.\nX1. Y1.\n", Equivalences { dwells: 1, ..none() });
    let (head, tail) = program.rsplit_once("Z2.\n").unwrap();
    let longer = format!("{head}Z2.\nX5. Y5.\n{tail}");
    assert_eq!(verified(&form, &longer, &job), Verdict::Equivalent(Equivalences { tails: 1, ..none() }), "{longer}");
}

/// Differences with the same cause are one finding with a count.
#[test]
fn differences_of_one_cause_are_counted() {
    let form = check(&post("haas.pf"));
    let text = inches(
        "1",
        r#"{"rapid":[0,0,2]},{"cycle":{"kind":"drill","depth":0.5,"clear":0.1,"feed":5,"points":[[1,1,0],[2,1,0],[3,1,0],[4,1,0]]}},{"rapid":[0,0,2]}"#,
    );
    let job = document(&text);
    let program = rendered(&form, &job, Cycles::Form);
    let changed = program.replacen("F5.", "F50.", 1).replacen("Z-.5", "Z-.25", 1);
    let Verdict::Different(findings) = verified(&form, &changed, &job) else { panic!("{changed}") };
    let told: Vec<(&str, u64)> = findings.iter().map(|finding| (finding.code.name(), finding.times)).collect();
    assert_eq!(told, [("PV006", 4), ("PV004", 4)], "{findings:#?}");
}

/// A code that the control's file does not define is no difference, but nothing is proven after it.
#[test]
fn unknown_codes_are_not_proven() {
    let form = check(&post("fanuc.pf"));
    let text = inches("1", r#"{"rapid":[0,0,2]},{"line":[0,0,-1]},{"rapid":[0,0,2]}"#);
    let job = document(&text);
    let program = rendered(&form, &job, Cycles::Form);
    let changed = program.replacen("G1 Z-1.", "G201 P1\nG1 Z-1.", 1);
    let Verdict::NotProven(unproven) = verified(&form, &changed, &job) else { panic!("{changed}") };
    assert_eq!(unproven.why, "G201 is unknown for fanuc");
    assert!(unproven.from().starts_with(" from N") && unproven.line > 0, "{unproven:?}");
    // LinuxCNC has only the codes of its control file, and refuses all other codes
    let form = check(&post("linuxcnc.pf"));
    let program = rendered(&form, &job, Cycles::Form);
    let changed = program.replacen("G1 Z-1.", "G201 P1\nG1 Z-1.", 1);
    assert!(matches!(verified(&form, &changed, &job), Verdict::Different(_)), "{changed}");
}

/// If a form has no control, its programs are reported as not proven, and never as different, because the rules of the
/// control are unknown.
#[test]
fn forms_without_a_control_are_not_proven() {
    let run = |more: &[&str]| {
        let form = "samples/bore-emulated/form.pf";
        let words = [&["verify", "samples/bore-emulated/job.json", "--form", form], more].concat();
        let output = postform(&words);
        (output.status.code(), text(&output.stdout))
    };
    let (status, said) = run(&[]);
    assert!(said.contains("not proven: ") && said.contains("the form has no `Control`"), "{said}");
    assert_eq!(status, Some(1));
    assert!(run(&["--control", "fanuc"]).1.starts_with("different: "));
}

/// Holes of custom cycles are proven only if they have the depth of the job.
#[test]
fn custom_cycles_are_holes() {
    let custom = "Custom1\nG0 X[h] Y[v]\nZ[vclear]\nG1 Z[d] F[frate]\nG0 Z[rplane]\nEnd\n\nEndCode";
    let (before, after) =
        post("fanuc.pf").split_once("Custom1   Face").map(|(a, b)| (a.to_owned(), b.to_owned())).unwrap();
    let form = format!("{before}{}", after.split_once("\n\n").unwrap().1).replacen("EndCode", custom, 1);
    let job = one(
        r#"{"rapid":[0,0,25]},{"cycle":{"kind":"custom1","depth":3,"clear":1,"feed":60,"points":[[1,1,0],[2,1,0]]}},{"rapid":[2,1,25]}"#,
    );
    let (program, verdict) = of_form(&form, &job);
    assert!(matches!(verdict, Verdict::Equivalent(Equivalences { custom: 2, .. })), "{verdict:?}\n{program}");
    let (form, job) = (check(&form), document(&job));
    let changed = program.replacen("G1 Z-3.", "G1 Z-2.", 1);
    assert!(matches!(verified(&form, &changed, &job), Verdict::NotProven(_)), "{changed}");
}

/// Correct programs of unusual forms that earlier versions reported as different.
#[test]
fn right_programs_of_unusual_forms_are_proven() {
    let inch = |path: &str| one(path).replace("\"mm\"", "\"inch\"");
    let jobs = [
        (
            "a cycle that dwells where the job's does not, and cuts of one digit there and back after it",
            "custom",
            one(
                r#"{"rapid":[96.17,10.88,25]},{"cycle":{"kind":"custom3","depth":9,"clear":2,"feed":60,"points":[[96.17,10.88,0]]}},{"line":[96.16975,10.88,2]},{"rapid":[96.16875,10.88,2]},{"line":[96.17125,10.88,2]},{"rapid":[null,null,25]}"#,
            ),
        ),
        (
            "a dwell over a tapped hole, before another tool",
            "no-return-plane",
            mm(
                r#"{"tool":1,"spindle":{"speed":1100,"direction":"cw"},"path":[{"cycle":{"kind":"tap","depth":7,"clear":2,"feed":90,"points":[[-50,-71,3],[-55,-4,-5]]}},{"dwell":0.5}]},
            {"tool":2,"spindle":{"speed":2050,"direction":"ccw"},"path":[{"rapid":[-45,-60,38]}]}"#,
            ),
        ),
        (
            "a cut that no digits show after a tapped hole that the control leaves higher",
            "no-return-plane",
            inch(
                r#"{"rapid":[-1.4705,-2.0917,0.1]},{"cycle":{"kind":"tap","depth":1.1526,"clear":0.1,"feed":38,"points":[[-1.4705,-2.0917,0],[0.4748,0.0388,-0.4308]]}},{"line":[0.47476]},{"rapid":[0.47476,0.0388,1.4344]}"#,
            ),
        ),
        (
            "a steep helix whose circle hardly any digits show, by radius words",
            "radius-words",
            inch(
                r#"{"rapid":[-1.3013,-0.759,1.6713]},{"line":[0.0938,0.5800134,-0.3429]},{"arc":{"to":[0.093687,0.579913,-0.3558],"center":[0.0449,0.6349,-0.3429],"direction":"cw"}},{"rapid":[null,null,1]}"#,
            ),
        ),
    ];
    let mut wrong = String::new();
    for (name, form, job) in jobs {
        let text = fs::read_to_string(root().join(format!("tests/data/forms/{form}.pf"))).unwrap();
        let (program, verdict) = of_form(&text, &job);
        if !verdict.is_proven() {
            wrong += &format!("{name}: {verdict:?}\n{program}\n");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

/// docs/verify.md lists the allowances, tolerances and reasons that the code contains.
#[test]
fn docs_list_what_is_proven() {
    let page = fs::read_to_string(root().join("docs/verify.md")).unwrap();
    for (name, about) in Equivalences::ABOUT {
        assert!(
            page.contains(&format!("| {name} | {} |", about.trim())),
            "docs/verify.md has no `| {name} | {about} |`"
        );
    }
    for [quantity, near] in tolerances() {
        assert!(page.contains(&format!("| {quantity} | {near} |")), "docs/verify.md has no `| {quantity} | {near} |`");
    }
    for why in UNPROVEN {
        assert!(page.contains(&format!("- {why}\n")), "docs/verify.md has no `- {why}`");
    }
}

/// Real programs and paths that earlier versions reported as different.
#[test]
fn findings_of_others_stay_found() {
    let lines = r#"{"start":{"units":"mm","program":1,"tools":[{"number":1,"length_offset":1}]}}
{"operation":{"tool":1,"work":54,"feed":100,"spindle":{"speed":1500,"direction":"cw"}}}
{"rapid":[5,-1,20]}
{"cycle":{"kind":"manual","clear":4}}
{"point":[1,1,0]}
{"cycle_end":true}
{"cycle":{"kind":"drill","depth":3,"clear":1,"feed":10}}
{"point":[1,1,0]}
{"cycle_end":true}
{"end":true}
"#;
    let job = |sink: &mut dyn Sink| read_lines(lines.as_bytes(), sink).is_ok();
    for name in ["fanuc.pf", "haas.pf"] {
        let form = check(&post(name));
        let program = rendered(&form, &job, Cycles::Form);
        let verdict = verified(&form, &program, &job);
        assert!(verdict.is_proven(), "{name}: {verdict:?}\n{program}");
    }
}

/// The verdict is the same if the proof runs during printing and gets events and text in small pieces.
#[test]
fn a_proof_beside_the_renderer_is_the_same() {
    struct Tap<'p> {
        renderer: Renderer<'p>,
        batches: Vec<Batch>,
    }
    impl Sink for Tap<'_> {
        fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
            self.batches.push(Batch { events: vec![(Kept::from(&event), place)], ..Batch::default() });
            self.renderer.event(event, place)?;
            let text = std::mem::take(self.renderer.text());
            self.batches.extend(text.chunks(7).map(|piece| Batch { text: piece.to_vec(), ..Batch::default() }));
            Flow::Continue(())
        }
    }
    for name in ["fanuc.pf", "haas.pf", "linuxcnc.pf"] {
        let form = check(&post(name));
        let compiled = compile(&form.form);
        let bracket = fs::read_to_string(root().join("samples/bracket/job.json")).unwrap();
        let job = document(&bracket);
        let renderer = Renderer::new(&compiled, RenderOptions::default());
        let mut tap = Tap { renderer, batches: Vec::new() };
        assert!(job(&mut tap));
        let text: Vec<u8> = tap.batches.iter().flat_map(|batch| &batch.text).copied().collect();
        let settings = RunSettings::new(compiled.settings.control());
        let expectation = || Expectation::of_form(&compiled.settings, false).typed(&compiled);
        let beside =
            |batches: Vec<Batch>| prove_beside(batches.into_iter(), settings, expectation(), None, true).unwrap();
        let outcome = beside(tap.batches.clone());
        assert!(outcome.verdict.is_proven() && outcome.counts.holes == 20, "{name}: {outcome:?}");
        assert_eq!(outcome.verdict, verified(&form, std::str::from_utf8(&text).unwrap(), &job), "{name}");
        // changes a digit between the renderer and the proof
        let wrong = |batch: Batch| {
            let text = batch.text.iter().map(|&byte| if byte == b'5' { b'6' } else { byte }).collect();
            Batch { text, ..batch }
        };
        assert!(!beside(tap.batches.into_iter().map(wrong).collect()).verdict.is_proven());
    }
}

/// The proof needs no more memory if a long part of the job prints nothing.
#[test]
fn a_proof_beside_the_renderer_holds_no_long_job() {
    let form = check(&post("fanuc.pf"));
    let compiled = compile(&form.form);
    let bracket = fs::read_to_string(root().join("samples/bracket/job.json")).unwrap();
    struct Events(Vec<(Kept, Place)>);
    impl Sink for Events {
        fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
            self.0.push((Kept::from(&event), place));
            Flow::Continue(())
        }
    }
    let mut events = Events(Vec::new());
    assert!(document(&bracket)(&mut events));
    let cut = events.0.iter().find(|(kept, _)| matches!(kept.event(), Event::Line { .. })).unwrap().clone();
    let head = Batch { events: events.0, text: b"%\nG20\n".to_vec(), ..Batch::default() };
    let mut taken = 0;
    let more = std::iter::repeat_with(|| {
        taken += 1;
        assert!(taken < 1000, "it goes on reading");
        Batch { events: vec![cut.clone(); 1000], ..Batch::default() }
    });
    let settings = RunSettings::new(compiled.settings.control());
    let expectation = Expectation::of_form(&compiled.settings, false).typed(&compiled);
    let outcome = prove_beside(std::iter::once(head).chain(more), settings, expectation, None, true).unwrap();
    assert!(matches!(&outcome.verdict, Verdict::NotProven(why) if why.in_a_file), "{:?}", outcome.verdict);
}

/// The number of moves between two cuts of a program is limited too, and text after a refused block is not kept.
#[test]
fn a_proof_holds_no_long_way_of_the_program() {
    let form = check(&post("fanuc.pf"));
    let text = one(r#"{"rapid":[0,0,25]},{"line":[0,0,1]},{"line":[9,0,1]},{"rapid":[9,0,25]}"#);
    let job = document(&text);
    let program = rendered(&form, &job, Cycles::Form);
    for block in ["M0\n", "G4 P500\n", "G0 Z50.\nG0 Z1.\n"] {
        let many = program.replacen("X9.\n", &format!("{}G1 X9.\n", block.repeat(300_000)), 1);
        let Verdict::NotProven(unproven) = verified(&form, &many, &job) else { panic!("{block}") };
        assert_eq!(unproven.why, "too many rapids, stops and dwells between two cuts");
    }
    // each change of the work offset is compared with every other change
    let there = r#"{"work":55},{"rapid":[0,0,50]},{"work":54},{"rapid":[0,0,50]},"#.repeat(2000);
    let job =
        one(&format!(r#"{{"rapid":[0,0,25]}},{{"line":[0,0,1]}},{{"rapid":[0,0,50]}},{there}{{"line":[0,0,40]}}"#));
    assert!(matches!(of_post("fanuc.pf", &job).1, Verdict::NotProven(_)));
}

/// If the planner refuses a cycle of the job, the proof ends there, and the rest is not proven. A control may still
/// drill such a cycle.
#[test]
fn a_job_that_is_not_compared_to_its_end_is_not_proven() {
    let job = one(
        r#"{"rapid":[0,0,25]},{"cycle":{"kind":"deep","depth":100,"clear":2,"return":2,"feed":50,"step":0.005,"points":[[0,0,0]]}}"#,
    );
    let folder = tempfile::tempdir().unwrap();
    let [file, out] = ["job.json", "out.nc"].map(|name| folder.path().join(name).display().to_string());
    fs::write(&file, job).unwrap();
    let told = postform(&["render", &file, "--form", "postforms/fanuc.pf", "-o", &out]);
    let said = text(&told.stderr);
    assert!(said.contains("not proven") && said.contains("more than 10000 pecks in one hole"), "{said}");
    assert_eq!(told.status.code(), Some(0), "{said}");
    assert!(fs::read_to_string(&out).unwrap().contains("G83"));
    let told = postform(&["verify", &file, "--form", "postforms/fanuc.pf", "--nc", &out]);
    assert!(text(&told.stderr).contains("PC028"), "{}", text(&told.stderr));
    assert_eq!(told.status.code(), Some(1));
    // events that stop before the end of the job
    let mut comparer = Comparer::new(
        Cursor::new("%\nM30\n%\n"),
        RunSettings::new(control("fanuc")),
        Expectation::of_control(&RunSettings::new(control("fanuc"))),
        None,
        false,
    );
    let short = one(r#"{"rapid":[0,0,25]}"#);
    let job = document(&short);
    struct Cut<'a>(&'a mut Comparer<'static>);
    impl Sink for Cut<'_> {
        fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
            if matches!(event, Event::Start(_)) { self.0.event(event, place) } else { Flow::Continue(()) }
        }
    }
    assert!(job(&mut Cut(&mut comparer)));
    assert!(matches!(comparer.verdict().unwrap(), Verdict::NotProven(_)));
}

/// A back bore may be the first hole of a tool, when the job has not yet given its position.
#[test]
fn a_back_bore_may_come_first() {
    let job = one(
        r#"{"rapid":[null,null,19.22]},{"cycle":{"kind":"back","depth":11.09,"feed":128.9,"rapto":20.76,"points":[[-61.4,43.38,2.15]]}},{"rapid":[-61.4,43.38,30]}"#,
    );
    let form = fs::read_to_string(root().join("tests/data/forms/advanced.pf")).unwrap();
    let (program, verdict) = of_form(&form, &job);
    assert!(verdict.is_proven(), "{verdict:?}\n{program}");
    // without the move away from the wall, the tool moves straight down
    let (form, job) = (check(&form), document(&job));
    let down = program.lines().filter(|line| !line.contains("X-61.9")).collect::<Vec<_>>().join("\n");
    assert!(matches!(verified(&form, &down, &job), Verdict::Different(_)), "{down}");
}

/// On a machine without tool changes, the first M0 may be a stop of the job. It must not be taken for a tool change.
#[test]
fn a_stop_of_the_job_is_not_the_first_tool_change() {
    let job = one(
        r#"{"rapid":[0,0,25]},{"cycle":{"kind":"manual","clear":4,"points":[[1,1,0],[5,1,0]]}},{"rapid":[5,1,25]}"#,
    );
    let (program, verdict) = of_post("grbl.pf", &job);
    assert!(verdict.is_proven(), "{verdict:?}\n{program}");
    let (form, job) = (check(&post("grbl.pf")), document(&job));
    let changed = program.replacen("M0\n", "", 1);
    assert!(matches!(verified(&form, &changed, &job), Verdict::Different(_)), "{changed}");
}

/// A stop or a dwell before the first cut belongs to the form, even before the first tool and after a move home.
#[test]
fn stops_before_the_first_cut_are_the_forms() {
    let fanuc = post("fanuc.pf");
    let cut = one(r#"{"rapid":[0,0,5]},{"line":[0,0,-1]},{"line":[9,0,-1]},{"rapid":[9,0,5]}"#);
    let line = "G[unitmode] G17 G40 G49 G80 G90\n";
    for own in ["M1\n", "G4 P2000\nM0\n", "G91 G28 Z0\nG90\nM0\n"] {
        let form = fanuc.replacen(line, &format!("{line}{own}"), 1);
        assert_ne!(form, fanuc);
        is_right(own, of_form(&form, &cut));
    }
    // a stop or dwell after the cut has begun
    let (program, _) = of_form(&fanuc, &cut);
    let (form, job) = (check(&fanuc), document(&cut));
    for own in ["M1", "G4 P2000"] {
        let changed = program.replacen("X9.\n", &format!("X9.\n{own}\n"), 1);
        assert_ne!(changed, program);
        assert!(matches!(verified(&form, &changed, &job), Verdict::Different(_)), "{changed}");
    }
}

/// If a form moves up after G49, as the manual does, the finding explains what to print instead.
#[test]
fn up_without_the_length_is_explained() {
    let form = post("fanuc.pf");
    let job = mm(&format!(
        "{},{}",
        r#"{"tool":1,"work":54,"spindle":{"speed":1000,"direction":"cw"},"feed":100,"path":[{"rapid":[0,0,5]},{"line":[9,0,5]}]}"#,
        r#"{"tool":2,"work":54,"spindle":{"speed":1000,"direction":"cw"},"feed":100,"path":[{"rapid":[0,0,5]},{"line":[9,0,5]}]}"#
    ));
    let (program, _) = of_form(&form, &job);
    let at = program.find("T2").unwrap_or_default();
    let line = program[..at].rfind('\n').map_or(0, |end| end + 1);
    let manual = format!("{}G49 G0 Z0\n{}", &program[..line], &program[line..]);
    let found = verified(&check(&form), &manual, &document(&job));
    assert!(format!("{found:?}").contains("`G91 G28 Z0`"), "{found:#?}\n{manual}");
}

/// A tool change that loads another tool, no tool or another length register is one finding: the finding about the moves
/// before the cuts and the finding about the cuts have the same help.
#[test]
fn a_wrong_tool_change_is_one_finding() {
    let form = check(&post("fanuc.pf"));
    let path = r#""work":54,"spindle":{"speed":1000,"direction":"cw"},"feed":100,"path":[{"rapid":[0,0,5]},{"line":[0,0,-1]},{"rapid":[0,0,5]}]"#;
    let text = mm(&format!(r#"{{"tool":1,{path}}},{{"tool":2,{path}}}"#));
    let job = document(&text);
    let program = rendered(&form, &job, Cycles::Form);
    for (from, to, message) in [
        (
            "T2 M6",
            "T5 M6",
            "before this cut tool 5 is loaded for moves in work offset 54, but the job has tool 2 there",
        ),
        ("G43 H2", "G43 H7", "before this cut the tool moves in work offset 54 with H7, but the job has H2 there"),
    ] {
        assert!(program.contains(from), "{program}");
        let Verdict::Different(found) = verified(&form, &program.replace(from, to), &job) else { panic!("{to}") };
        let messages: Vec<&str> = found.iter().map(|finding| finding.message.as_str()).collect();
        assert_eq!(messages, [message], "{to}");
    }
    let Verdict::Different(found) = verified(&form, &program.replace(" M6", ""), &job) else { panic!("no M6") };
    assert_eq!(found.len(), 1, "{found:#?}");
    assert_eq!(found[0].message, "no tool is loaded, but the job has tool 1 here");
}

/// A form may drill a hole in pecks, and dwell at each peck.
#[test]
fn drilled_holes_may_be_pecked() {
    let drill = "Drill\nG[retplane] G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel";
    let rule = "Drill\n@if [depth] > 15\nG[retplane] G83 X[h] Y[v] Z[d] R[vclear] Q5. F[frate]\n@else\nG[retplane] G81 X[h] Y[v] Z[d] R[vclear] F[frate]\n@end\nEnd Cancel";
    let form = post("fanuc.pf").replacen(drill, rule, 1);
    assert!(form.contains("Q5."));
    let job = |depth: u32| {
        one(&format!(
            r#"{{"rapid":[0,0,25]}},{{"cycle":{{"kind":"drill","depth":{depth},"clear":2,"return":20,"feed":50,"points":[[1,1,0],[5,1,0]]}}}},{{"rapid":[5,1,25]}}"#
        ))
    };
    assert_eq!(of_form(&form, &job(15)).1, Verdict::Identical);
    let (program, verdict) = of_form(&form, &job(21));
    assert_eq!(verdict, Verdict::Equivalent(Equivalences { pecks: 2, ..Equivalences::default() }), "{program}");
    let text = job(21);
    let (checked, job) = (check(&form), document(&text));
    for (from, to) in [("Z-21.", "Z-20."), ("F50.", "F90."), ("X5.", "X6.")] {
        let changed = program.replacen(from, to, 1);
        assert!(changed != program && matches!(verified(&checked, &changed, &job), Verdict::Different(_)), "{changed}");
    }
    // dwells at the pecks do not count as the dwell at the bottom
    let deep = one(
        r#"{"rapid":[0,0,25]},{"cycle":{"kind":"deep","emulate":true,"depth":8,"step":4,"dwell":0.5,"clear":3,"feed":100,"points":[[10,10,0]]}},{"rapid":[10,10,25]}"#,
    );
    for at in ["steps", "retracts", "steps retracts"] {
        let form = post("linuxcnc.pf").replacen("Control linuxcnc", &format!("Control linuxcnc\nCycleDwellAt {at}"), 1);
        is_right(at, of_form(&form, &deep));
    }
}

/// For a tap in a floating holder, the spindle must already turn. For a rigid tap, the control turns the spindle.
#[test]
fn floating_taps_want_the_spindle_turning() {
    let text = post("fanuc.pf");
    let (before, after) = text.split_once("Tap 2\n").unwrap();
    let after = after.split_once("End Cancel\n").unwrap().1;
    let tap = "Tap\nG[retplane] G84 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel\n";
    let floats = format!("{before}{tap}{after}").replace("RigidTap? Y", "RigidTap? N");
    let job = |rigid: &str| {
        one(&format!(
            r#"{{"rapid":[0,0,20]}},{{"cycle":{{"kind":"tap"{rigid},"depth":10,"clear":5,"feed":1000,"points":[[10,10,0],[20,10,0]]}}}},{{"rapid":[0,0,20]}}"#
        ))
    };
    let verdict = |form: &str, rigid: &str, word: &str| {
        let (text, form) = (job(rigid), check(form));
        let job = document(&text);
        let program = rendered(&form, &job, Cycles::Form);
        let at = program.rfind("Z5.\n").unwrap() + 4; // above the first hole
        verified(&form, &format!("{}{word}{}", &program[..at], &program[at..]), &job)
    };
    let (own, haas) = (r#","rigid":false"#, post("haas.pf"));
    assert!(verdict(&floats, own, "").is_proven() && verdict(&floats, own, "M4\nM3\n").is_proven());
    for word in ["M5\n", "M4\n"] {
        let Verdict::Different(found) = verdict(&floats, own, word) else { panic!("{word}") };
        assert!(found.iter().all(|found| found.code.name() == "PV011"), "{found:?}");
        // with M29, or without it on a Haas, the control turns the spindle
        assert!(verdict(&haas, own, word).is_proven() && verdict(&text, "", word).is_proven());
    }
}

/// On a Fanuc, a parameter decides whether G84 alone is rigid. Lint reports a rigid tap without M29. The proof reports it
/// if the job asks for a rigid tap, unless a control file says that G84 alone is rigid.
#[test]
fn a_rigid_tap_of_a_fanuc_needs_m29_or_a_control_file() {
    let folder = Folder::new("rigid-without-code");
    let page = fs::read_to_string(root().join("docs/rules/PF446.md")).unwrap();
    let file = page.split_once("```toml\n").and_then(|(_, rest)| rest.split_once("```")).unwrap().0;
    folder.write("my-fanuc.toml", file);
    let form = plain_post("fanuc.pf").replace("M29 S[speed]\n", "").replace("Tap 2\n", "Tap 1\n");
    folder.write("alone.pf", &form);
    folder.write("own.pf", form.replace("Control fanuc", "Control my-fanuc.toml"));
    folder.write("floats.pf", form.replace("RigidTap? Y", "RigidTap? N"));
    let path = r#"{"rapid":[0,0,20]},{"cycle":{"kind":"tap","rigid":true,"depth":10,"clear":5,"feed":1000,"points":[[0,0,0]]}},{"rapid":[0,0,20]}"#;
    folder.write("rigid.json", one(path));
    folder.write("silent.json", one(&path.replace(r#""rigid":true,"#, "")));
    let said = |form: &str, job: &str| {
        let lint = out(&folder.run(&["lint", form]));
        let verify = folder.run(&["verify", job, "--form", form]);
        (lint.matches("the form's tap is rigid").count(), out(&verify) + &err(&verify))
    };
    let (lint, verdict) = said("alone.pf", "rigid.json");
    assert!(lint == 2 && verdict.contains("PV011") && verdict.contains("has no M29"), "{lint} {verdict}");
    let (lint, verdict) = said("alone.pf", "silent.json");
    assert!(lint == 2 && verdict.contains("identical"), "{lint} {verdict}");
    let (lint, verdict) = said("own.pf", "rigid.json");
    assert!(lint == 0 && verdict.contains("identical"), "{lint} {verdict}");
    let (lint, refusal) = said("floats.pf", "rigid.json");
    assert!(lint == 0 && refusal.contains("PC021") && refusal.contains("print `M29 S[speed]`"), "{lint} {refusal}");
}

/// If the control pecks a tap, the tap ends with the cycle. A feed move up after the cycle is the next cut.
#[test]
fn a_feed_after_a_pecking_tap_is_the_next_cut() {
    let job = one(
        r#"{"rapid":[0,0,20]},{"cycle":{"kind":"tap","rigid":true,"mode":"deep","step":4,"depth":10,"clear":5,"feed":1000,"points":[[10,10,0]]}},{"line":[10,10,15]},{"line":[20,10,15]},{"rapid":[0,0,20]}"#,
    );
    is_right("up after the tap", of_post("fanuc.pf", &job));
}

/// The speed of an operation is in revolutions unless it has a mode, even after a surface speed.
#[test]
fn a_speed_without_its_mode_counts_revolutions() {
    let job = r#"{"postform":1,"program":7,"units":"mm","machine":"lathe","tools":[{"number":1},{"number":3}],"operations":[
        {"tool":1,"work":54,"spindle":{"speed":180,"direction":"cw","mode":"css","max":2500},"feed_mode":"per_rev","feed":0.2,"path":[{"rapid":[2,16]},{"rapid":[2,12]},{"line":[-30,12]},{"rapid":[2,18]}]},
        {"tool":3,"work":54,"spindle":{"speed":600,"direction":"cw"},"feed_mode":"per_rev","feed":0.1,"path":[{"rapid":[5,0]},{"line":[-30,0]},{"rapid":[5,0]},{"rapid":[5,20]}]}]}"#;
    for post in ["fanuc-lathe.pf", "haas-lathe.pf"] {
        let (program, verdict) = of_post(post, job);
        assert!(program.contains("G97 S600"), "{program}");
        is_right(post, (program, verdict));
    }
}

/// A typed feed in a sequence applies to the cuts which that sequence prints, and to no other cut.
#[test]
fn a_typed_feed_counts_where_its_sequence_prints() {
    let form = check(&post("fanuc.pf").replacen(
        "InFeed\nG1 G[side] D[dcomp] X[h] Y[v] F[frate]",
        "InFeed\nG1 G[side] D[dcomp] X[h] Y[v] F150.",
        1,
    ));
    let plain = one(r#"{"rapid":[0,0,25]},{"line":[0,0,1]},{"line":[9,0,1]},{"rapid":[9,0,25]}"#);
    let infeed = one(
        r#"{"rapid":[0,0,25]},{"line":[0,0,1]},{"infeed":[9,0],"side":"left"},{"line":[9,9,1]},{"outfeed":[0,9]},{"rapid":[0,9,25]}"#,
    );
    let feeds = |text: &str, from: &str, to: &str| {
        let job = document(text);
        let program = rendered(&form, &job, Cycles::Form);
        let changed = program.replace(from, to);
        assert!(changed != program || from == to, "{program}");
        verified(&form, &changed, &job)
    };
    assert!(feeds(&infeed, "", "").is_proven() && feeds(&plain, "", "").is_proven());
    // another cut of the same job, and a job without infeeds
    assert!(matches!(feeds(&infeed, "Y9. F100.", "Y9."), Verdict::Different(_)));
    assert!(matches!(feeds(&plain, "F100.", "F150."), Verdict::Different(_)));
}

/// If the last peck is shorter than one unit of the last printed digit, it has its own feed.
#[test]
fn the_feed_of_a_short_last_peck_is_its_own() {
    let job = one(
        r#"{"rapid":[0,0,20]},{"cycle":{"kind":"deep","depth":12.258,"clear":5,"feed":500,"pecks":[{"to":3,"feed":500},{"to":7.2,"feed":500},{"to":12.257,"feed":80},{"to":12.258,"feed":80}],"points":[[10,10,0]]}},{"rapid":[0,0,20]}"#,
    );
    is_right("pecks with feeds", of_post("fanuc.pf", &job));
}

/// G43 without H uses the length of the tool in the spindle, not the length of a preselected tool.
#[test]
fn a_length_without_its_register_is_that_of_the_tool_in_the_spindle() {
    let form = check(&post("linuxcnc.pf"));
    let path = r#"{"rapid":[0,0,20]},{"line":[0,0,-1]},{"rapid":[0,0,20]}"#;
    let other = one(path).replacen(r#""number":1,"#, r#""number":1,"length_offset":2,"#, 1);
    let verdict = |text: &str, from: &str| {
        let job = document(text);
        let program = rendered(&form, &job, Cycles::Form);
        assert!(verified(&form, &program, &job).is_proven() && program.contains(from), "{program}");
        verified(&form, &program.replacen(from, "T2\nG43\n", 1), &job)
    };
    assert!(verdict(&one(path), "G43 H1\n").is_proven());
    let Verdict::Different(found) = verdict(&other, "G43 H2\n") else { panic!("H1 for H2") };
    assert!(found.iter().all(|found| found.code.name() == "PV014"), "{found:?}");
}

/// If a job lacks a value, the form's default for the units of the job applies, whatever the units of the program are.
#[test]
fn defaults_are_those_of_the_jobs_units_in_any_program() {
    let posts = ["fanuc.pf", "haas.pf", "linuxcnc.pf", "grbl.pf"];
    for (job_units, program_units) in [("mm", Units::Inch), ("inch", Units::Mm)] {
        for (cycle, posts) in [
            (r#""kind":"drill","depth":10"#, &posts[..]),
            (r#""kind":"thru","webs":[3,6,10]"#, &posts[..]),
            (r#""kind":"back","depth":10,"rapto":20,"orient":30"#, &posts[..3]),
        ] {
            let path = format!(
                r#"{{"rapid":[0,0,30]}},{{"cycle":{{{cycle},"feed":60,"points":[[10,10,0]]}}}},{{"rapid":[0,0,30]}}"#
            );
            let text = one(&path).replace("\"units\":\"mm\"", &format!("\"units\":\"{job_units}\""));
            let job = document(&text);
            for name in posts {
                let form = check(&post(name));
                let program = compile(&form.form);
                let options =
                    RenderOptions { units: Some(program_units), program: Some(1), ..RenderOptions::default() };
                let mut renderer = Renderer::new(&program, options);
                assert!(job(&mut renderer));
                let printed = String::from_utf8(std::mem::take(renderer.text())).unwrap();
                let verdict = verified(&form, &printed, &job);
                assert!(verdict.is_proven(), "{name} {job_units}: {verdict:?}\n{printed}");
            }
        }
    }
}
