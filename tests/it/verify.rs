//! The proof that programs make the motions of their jobs: cycles in all forms, forms with a named mistake, programs
//! with a change, and jobs from programs.

use crate::support::control;
use std::io::Cursor;

use crate::support::{check, job_options, plain_post, wrong};
use postform::internals::compile::compile;
use postform::internals::control::Control;
use postform::internals::json::{read_document, read_lines};
use postform::internals::nc::{RunSettings, read_program};
use postform::internals::render::{Cycles, Options, Renderer};
use postform::internals::sema::Checked;
use postform::internals::verify::{Comparer, Equivalences, Expectation, Verdict};
use postform::toolpath::Sink;

/// A job for verification: a function that pushes its events into a sink.
pub type Job<'a> = &'a dyn Fn(&mut dyn Sink) -> bool;

pub fn document(text: &str) -> impl Fn(&mut dyn Sink) -> bool {
    move |sink| match read_document(text.as_bytes(), sink) {
        Ok(()) => true,
        Err(error) => {
            eprintln!("{error:?}");
            false
        }
    }
}

pub fn rendered(form: &Checked, job: Job<'_>, cycles: Cycles) -> String {
    assert!(!form.has_errors(), "{:?}", form.diags);
    let program = compile(&form.form);
    let mut renderer = Renderer::new(&program, Options { cycles, program: Some(1), ..Options::default() });
    assert!(job(&mut renderer), "the job renders: {}", String::from_utf8_lossy(renderer.text()));
    String::from_utf8(std::mem::take(renderer.text())).unwrap()
}

/// Runs a program by the rules of the form's control, and compares it with the job.
pub fn verified(form: &Checked, program: &str, job: Job<'_>) -> Verdict {
    let compiled = compile(&form.form);
    // the same settings as in `Post::verify`
    let settings = RunSettings {
        centers_absolute: !compiled.settings.centre_incremental,
        ..RunSettings::new(compiled.settings.control.unwrap_or_else(Control::usual))
    };
    let expectation = Expectation::of_form(&compiled.settings, false).typed(&compiled);
    let mut comparer = Comparer::new(Cursor::new(program.to_owned()), settings, expectation, None, false);
    let read = job(&mut comparer);
    let verdict = comparer.verdict().unwrap();
    assert!(read || !verdict.is_proven(), "the job is read to its end");
    verdict
}

pub fn post(name: &str) -> String {
    plain_post(name)
}

/// A tolerance of 0 does not mean the default tolerance.
#[test]
fn a_tolerance_of_zero_accepts_no_difference() {
    let part =
        |x: &str| format!("G21 G90\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z10.\nG1 Z-5. F100.\n{x}\nG0 Z50.\nM30\n");
    let is_proven = |x: &str, tolerance: Option<f64>| {
        let settings = RunSettings::new(control("fanuc"));
        let expectation = Expectation::of_control(&RunSettings::new(control("fanuc")));
        let mut comparer = Comparer::new(Cursor::new(part(x)), settings, expectation, tolerance, true);
        postform::Job::nc(&part("X50.")).read(&mut comparer).unwrap();
        comparer.verdict().unwrap().is_proven()
    };
    assert!(is_proven("X50.", Some(0.0)) && is_proven("X50.001", None));
    assert!(!is_proven("X50.001", Some(0.0)));
}

/// Every kind of cycle that forms can print, with different depths and heights, and a return plane.
const CYCLES: &str = r#"{"postform":1,"program":7,"units":"mm","tools":[{"number":1,"diameter":6},{"number":2,"diameter":5},{"number":3,"diameter":5},{"number":4,"diameter":9}],"operations":[
{"tool":1,"work":54,"spindle":{"speed":1000,"direction":"cw"},"path":[
 {"rapid":[0,0,50]},
 {"cycle":{"kind":"drill","depth":10,"clear":2,"feed":100,"points":[[0,0,0],[10,0,0],{"at":[20,0,0],"depth":12}]}},
 {"cycle":{"kind":"drill","depth":10,"clear":2,"return":20,"feed":120,"points":[[0,10,0],[10,10,5],[20,10,-3]]}},
 {"rapid":[0,0,50]},
 {"cycle":{"kind":"face","depth":3,"clear":2,"feed":80,"dwell":0.5,"points":[[0,20,0],[10,20,0]]}},
 {"cycle":{"kind":"deep","depth":20,"clear":2,"feed":90,"step":6,"points":[[0,30,0],[10,30,0]]}},
 {"cycle":{"kind":"chipbreak","depth":20,"clear":2,"feed":90,"step":6,"return":10,"points":[[0,40,0],[10,40,0]]}},
 {"cycle":{"kind":"ream","depth":9,"clear":2,"feed":60,"points":[[0,50,0],[10,50,0]]}},
 {"cycle":{"kind":"bore","depth":9,"clear":2,"feed":60,"points":[[0,60,0],[10,60,0]]}},
 {"cycle":{"kind":"csink","depth":2,"clear":2,"feed":60,"points":[[0,70,0],[10,70,0]]}},
 {"cycle":{"kind":"thru","clear":2,"feed":60,"webs":[5,12,20],"points":[[0,80,0]]}},
 {"rapid":[0,80,50]}
]},
{"tool":3,"work":54,"spindle":{"speed":600,"direction":"ccw"},"path":[
 {"rapid":[0,0,50]},
 {"cycle":{"kind":"ltap","rigid":false,"depth":9,"clear":4,"feed":600,"points":[[0,90,0],[10,90,0]]}},
 {"rapid":[0,0,50]}
]},
{"tool":4,"work":54,"spindle":{"speed":700,"direction":"cw"},"path":[
 {"rapid":[0,0,50]},
 {"cycle":{"kind":"back","depth":10,"rapto":20,"orient":0,"offset":2,"clear":4,"feed":60,"points":[[0,95,0]]}},
 {"cycle":{"kind":"bore","depth":9,"orient":0,"offset":0.5,"clear":4,"feed":60,"points":[[0,97,0]]}},
 {"cycle":{"kind":"manual","clear":4,"points":[[0,99,0]]}},
 {"rapid":[0,0,50]}
]},
{"tool":2,"work":55,"spindle":{"speed":500,"direction":"cw"},"path":[
 {"rapid":[0,0,50]},
 {"cycle":{"kind":"tap","rigid":false,"depth":9,"clear":4,"feed":500,"points":[[0,0,0],[10,0,0]]}},
 {"rapid":[0,0,50]}
]}]}"#;

/// The same sequences in an advanced form: the first line sets up the cycle, then each hole has a position line.
fn advanced() -> String {
    let fanuc = post("fanuc.pf");
    let (before, after) = fanuc.split_once("Drill\n").unwrap();
    let (_, end) = after.split_once("EndCode").unwrap();
    let mut form = before.to_owned();
    for (name, code, words) in [
        ("Drill 1", 81, ""),
        ("Peck 1", 83, "Q[vbite] "),
        ("Chipbreak 1", 73, "Q[vbite] "),
        ("Bore 1", 86, ""),
        ("Ream 1", 85, ""),
        ("Tap 1", 84, ""),
    ] {
        form += &format!(
            "{name}\nG[retplane] G{code} X[h] Y[v] Z[d] R[vclear] {words}F[frate]\nX[h] Y[v] Z[d] R[vclear]\nEnd Cancel\n\n"
        );
    }
    form + "EndCode" + end
}

#[test]
fn cycles_in_all_forms_are_the_same_holes() {
    let without = plain();
    let (whole, plain) = (document(CYCLES), document(&without));
    let mut forms = vec![("advanced".to_owned(), advanced())];
    for name in ["fanuc.pf", "haas.pf", "linuxcnc.pf", "grbl.pf"] {
        forms.push((name.into(), post(name)));
    }
    // a tap with its feed per revolution (pitch)
    let per_turn = post("fanuc.pf").replace("M29 S[speed]", "G95 M29 S[speed]");
    let taps = |line: &str| line.contains("G84 ") || line.contains("G74 ");
    let by_pitch = |line: &str| if taps(line) { line.replace("F[frate]", "F[pitch]") } else { line.to_owned() };
    forms.push(("per turn".into(), per_turn.lines().map(by_pitch).collect::<Vec<_>>().join("\n")));
    for (name, text) in forms {
        let form = check(&text);
        // Grbl can't orient the spindle
        let job: Job<'_> = if name == "grbl.pf" { &plain } else { &whole };
        for cycles in [Cycles::Form, Cycles::Emulated] {
            let program = rendered(&form, job, cycles);
            let verdict = verified(&form, &program, job);
            assert!(!matches!(verdict, Verdict::Different(_)), "{name} {cycles:?}: {verdict:?}\n{program}");
            if cycles == Cycles::Emulated {
                // the program has exactly the planned moves; only a rapid may be in two parts, up first or down last
                let Verdict::Equivalent(other) = verdict else { panic!("{name}: {verdict:?}") };
                assert_eq!(other, Equivalences { ways: other.ways, ..Equivalences::default() }, "{name}");
            } else if name != "grbl.pf" {
                assert!(program.contains("G81") && program.contains("G83"), "{name} prints the control's cycles");
                // the control computes the pecks itself
                let Verdict::Equivalent(other) = verdict else { panic!("{name}: {verdict:?}") };
                assert!(other.pecks >= 2, "{name}: {other:?}");
            }
        }
    }
}

/// A job with everything that a form may print wrong.
const PART: &str = r#"{"postform":1,"program":7,"units":"mm","tools":[{"number":3},{"number":4}],"operations":[
{"tool":3,"work":54,"spindle":{"speed":1000,"direction":"cw"},"coolant":"flood","path":[
 {"rapid":[0,0,50]},{"rapid":[0,0,2]},{"line":[0,0,-1],"feed":100},{"line":[30,0,-1],"feed":300},
 {"arc":{"to":[40,10],"center":[30,10],"direction":"ccw"}},{"line":[40,20,-1]},{"dwell":0.5},{"rapid":[40,20,50]},
 {"rapid":[0,0,50]},{"rapid":[0,0,-2]},{"infeed":[5,5],"side":"right","feed":200},{"line":[5,20]},
 {"outfeed":[0,25]},{"rapid":[0,25,50]},{"stop":"program"},
 {"cycle":{"kind":"drill","depth":10,"clear":2,"return":20,"feed":100,"points":[[0,0,0],[10,0,0],{"at":[20,0,0],"depth":12.25}]}}
]},
{"tool":4,"work":55,"spindle":{"speed":800,"direction":"cw"},"path":[
 {"rapid":[0,0,50]},
 {"cycle":{"kind":"face","depth":3,"clear":2,"feed":80,"dwell":0.5,"points":[[0,20,0],[10,20,0]]}},
 {"rapid":[0,0,50]},{"rapid":[7,7,2]},{"line":[7,7,-1],"feed":12.6},{"rapid":[7,7,50]}
]}]}"#;

#[test]
fn broken_forms_are_caught_by_name() {
    let job = document(PART);
    let good = post("fanuc.pf");
    let form = check(&good);
    let program = rendered(&form, &job, Cycles::Form);
    assert!(!matches!(verified(&form, &program, &job), Verdict::Different(_)), "{program}");
    let drill = "G[retplane] G81 X[h] Y[v] Z[d] R[vclear] F[frate]\n";
    let tool = "T[tool] M6\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nG43 H[lcomp] Z[d] M[cool]";
    let broken = [
        ("another R plane", drill, "G[retplane] G81 X[h] Y[v] Z[d] R[rplane] F[frate]\n", "PV005"),
        ("digits of the depth cut off", "Z->4.>4", "Z->4.>1", "PV004"),
        ("the return plane is not reached", drill, "G99 G81 X[h] Y[v] Z[d] R[vclear] F[frate]\n", "PV009"),
        ("digits of the feed cut off", "F >5.>4", "F >5.>0", "PV006"),
        (
            "the hole is left at feed",
            drill,
            "G0 X[h] Y[v] Z[rplane]\nZ[vclear]\nG1 Z[d] F[frate]\nZ[rplane]\n",
            "PV008",
        ),
        ("X and Y exchanged", drill, "G[retplane] G81 X[v] Y[h] Z[d] R[vclear] F[frate]\n", "PV002"),
        (
            "a second position line that drills again",
            drill,
            "G[retplane] G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nG[retplane] X[h] Y[v] Z[d] R[vclear]\n",
            "PV003",
        ),
        ("G80 missing", "Cancel\nG80\n", "Cancel\nM9\n", "PV013"),
        ("the dwell in another unit", "Dwell G4 P ms", "Dwell G4 P s", "PV010"),
        ("tool length offset missing", "G43 H[lcomp] Z[d] M[cool]", "Z[d] M[cool]", "PV014"),
        (
            "always the first tool",
            tool,
            "T3 M6\nG[work] G0 X[h] Y[v] S[speed] M[direct]\nG43 H[lcomp] Z[d] M[cool]",
            "PV012",
        ),
        ("the spindle the other way", "ArcPlane G17 G18 G19", "Spindle 4 3 5\nArcPlane G17 G18 G19", "PV011"),
        ("compensation on the other side", "G1 G[side] D[dcomp]", "G1 G41 D[dcomp]", "PV018"),
        ("arcs the other way", "ArcPlane G17 G18 G19", "CCW G2\nArcPlane G17 G18 G19", "PV001"),
        ("cuts at rapid", "ArcPlane G17 G18 G19", "Feed G0\nArcPlane G17 G18 G19", "PV007"),
        (
            "rapids at feed, and the first without one",
            "ArcPlane G17 G18 G19",
            "Rapid G1\nArcPlane G17 G18 G19",
            "PV015",
        ),
        ("a move too many at the end", "EndCode\nM9", "EndCode\nG1 Z-5. F100.\nM9", "PV016"),
        (
            "a rapid down and across before the tool change",
            "G91 G28 Z0 M5\nG90\nT[tool]",
            "G0 Z1.\nX0 Y0 M5\nT[tool]",
            "PV009",
        ),
        ("no program stop", "ArcPlane G17 G18 G19", "StopCode 9 1\nArcPlane G17 G18 G19", "PV019"),
    ];
    for (what, from, to, code) in broken {
        assert!(good.contains(from), "{what}: the form has it");
        let form = check(&good.replacen(
            from,
            to,
            if what.contains("tool length")
                || what.contains("always")
                || what.contains("spindle")
                || what.contains("speed")
            {
                2
            } else {
                1
            },
        ));
        let program = rendered(&form, &job, Cycles::Form);
        let Verdict::Different(findings) = verified(&form, &program, &job) else {
            panic!("{what} is not found\n{program}");
        };
        let codes: Vec<&str> = findings.iter().map(|finding| finding.code.name()).collect();
        assert!(codes.contains(&code), "{what}: {code} wanted\n{findings:#?}\n{program}");
        let finding = findings.iter().find(|finding| finding.code.name() == code).unwrap();
        assert!(!finding.help.is_empty());
        // the block is shown as in the program
        let line = finding.line as usize;
        assert!(line == 0 || program.lines().nth(line - 1) == Some(finding.block.as_str()), "{what}: {finding:?}");
    }
}

/// If a tool change has no G0 and the last tool ended at feed, the new tool goes to its first hole at feed.
#[test]
fn a_hole_that_is_reached_at_feed_is_a_rapid_at_feed() {
    let job = document(
        r#"{"postform":1,"program":7,"units":"mm","tools":[{"number":3},{"number":4}],"operations":[
{"tool":3,"work":54,"spindle":{"speed":1000,"direction":"cw"},"path":[{"rapid":[0,0,2]},{"line":[0,0,-1],"feed":100},{"line":[9,0,2]}]},
{"tool":4,"work":54,"spindle":{"speed":800,"direction":"cw"},"path":[
 {"cycle":{"kind":"drill","depth":10,"clear":2,"return":20,"feed":100,"points":[[0,20,0],[10,20,0]]}}]}]}"#,
    );
    let later = "\nToolChange\nM9\nG91 G28 Z0 M5\nG90\nT[tool] M6\nG[work] ";
    let good = post("fanuc.pf");
    let form = check(&good.replacen(&format!("{later}G0 "), later, 1));
    let verdict = verified(&form, &rendered(&form, &job, Cycles::Form), &job);
    let Verdict::Different(findings) = verdict else { panic!("{verdict:?}") };
    let first = &findings[0];
    assert_eq!((first.code.name(), first.help), ("PV008", "print the rapid code (G0) for this move"));
    assert!(first.message.starts_with("a feed move goes to the hole at X0 Y20"), "{}", first.message);
}

/// Changes in programs, each of which would damage a part or a machine.
#[test]
fn changed_programs_are_caught_and_rewritten_ones_are_not() {
    let job = document(PART);
    let form = check(&post("fanuc.pf"));
    let program = rendered(&form, &job, Cycles::Form);
    let verdict = |from: &str, to: &str| {
        assert!(program.contains(from), "{from}\n{program}");
        verified(&form, &program.replacen(from, to, 1), &job)
    };
    let code = |from: &str, to: &str| match verdict(from, to) {
        Verdict::Different(findings) => findings[0].code.name(),
        other => panic!("{from} -> {to}: {other:?}\n{program}"),
    };
    assert_eq!(code("Z-12.25", "Z-2.25"), "PV004");
    assert_eq!(code("X20.", "X21."), "PV002");
    assert_eq!(code("X40. Y10.", "X40. Y10.5"), "PV001");
    assert_eq!(code("X40. Y10.", "X40. Y12."), "PV015", "the ends of the arc lie on no circle");
    assert_eq!(code("F300.", "F3000."), "PV006");
    assert_eq!(code("G0 Z50.", "Z50."), "PV008");
    assert_eq!(code("M30\n%\n", ""), "PV015");
    assert_eq!(code("F300.\n", "F300.\nX31.\n"), "PV001");
    assert_eq!(code("\nN", "\n\u{1}N"), "PV015");
    // other spellings with the same effect
    assert!(!matches!(verdict("X40. Y10.", "Y10.00 X40.000"), Verdict::Different(_)));
    assert!(!matches!(verdict("G80\n", "G80\nG80 (again)\n"), Verdict::Different(_)));
    let lower = program.to_lowercase();
    assert!(!matches!(verified(&form, &lower, &job), Verdict::Different(_)));
}

/// If an old program is read as a job and another form prints this job, the new program makes the same motions.
#[test]
fn programs_become_jobs() {
    let fanuc = check(&post("fanuc.pf"));
    // M29 makes the tap rigid, which linuxcnc.pf refuses; a program does not contain the diameters that grbl.pf prints
    for (text, posts) in [(plain(), &["haas.pf"][..]), (without_tap(), &["linuxcnc.pf"])] {
        becomes_a_job(&fanuc, &text, posts);
    }
}

/// The job without oriented operations, because a job from a program can't contain them.
fn plain() -> String {
    let (first, rest) = CYCLES.split_once(",\n{\"tool\":3").unwrap();
    let (_, last) = rest.split_once(",\n{\"tool\":2").unwrap();
    format!("{first},\n{{\"tool\":2{last}")
}

fn without_tap() -> String {
    let (first, _) = CYCLES.split_once(",\n{\"tool\":3").unwrap();
    format!("{first}]}}")
}

fn becomes_a_job(fanuc: &Checked, text: &str, posts: &[&str]) {
    let source = document(text);
    let old = rendered(fanuc, &source, Cycles::Form);
    let options = job_options(RunSettings::new(control("fanuc")));
    let mut warnings = Vec::new();
    let seen = std::cell::RefCell::new(0);
    let job = |sink: &mut dyn Sink| {
        let mut warnings = Vec::new();
        let read = read_program(Cursor::new(old.clone()), &options, &mut warnings, sink);
        *seen.borrow_mut() = warnings.len();
        read.is_ok()
    };
    let mut summary = postform::toolpath::Summary::default();
    read_program(Cursor::new(old.clone()), &options, &mut warnings, &mut summary).unwrap();
    let kinds: Vec<(&str, u64)> = summary.holes.iter().map(|(kind, count)| (kind.name(), *count)).collect();
    let all = [("drill", 8), ("face", 2), ("deep", 2), ("chipbreak", 2), ("ream", 2), ("bore", 2), ("tap", 2)];
    assert_eq!(kinds, all[..kinds.len()]);
    assert!(kinds.len() >= 6);
    let again = Equivalences { pecks: 4, ..Equivalences::default() };
    assert_eq!(verified(fanuc, &old, &job), Verdict::Equivalent(again));
    for name in posts {
        let form = check(&post(name));
        let new = rendered(&form, &job, Cycles::Form);
        let against_old = verified(&form, &new, &job);
        assert!(!matches!(against_old, Verdict::Different(_)), "{name}: {against_old:?}\n{new}");
        let against_source = verified(&form, &new, &source);
        assert!(!matches!(against_source, Verdict::Different(_)), "{name}: {against_source:?}\n{new}");
    }
}

/// A job with one tool in inches.
pub fn inches(tool: &str, path: &str) -> String {
    format!(
        r#"{{"postform":1,"program":7,"units":"inch","tools":[{{"number":1,"length_offset":1}},{{"number":2,"diameter_offset":12}}],
        "operations":[{{"tool":{tool},"work":54,"spindle":{{"speed":3000,"direction":"cw"}},"coolant":"flood","feed":20,"path":[{path}]}}]}}"#
    )
}

/// Programs of the Haas post, changed in one place. Each change would damage a part or a tool.
#[test]
fn one_change_is_never_too_small() {
    let form = check(&post("haas.pf"));
    let circle = r#"{"rapid":[2,0,1]},{"line":[2,0,-0.1]},{"arc":{"to":[2,0],"center":[1,0],"direction":"ccw"}},{"rapid":[2,0,1]}"#;
    let helix = r#"{"rapid":[2,0,1]},{"line":[2,0,0]},{"arc":{"to":[2,0,-0.1],"center":[1,0],"direction":"ccw"}},{"line":[3,0,-0.1]},{"rapid":[3,0,1]}"#;
    let holes = r#"{"rapid":[1,1,2]},{"cycle":{"kind":"drill","depth":0.5,"clear":0.1,"feed":5,"points":[[1,1,0]]}},{"rapid":[1,1,1]},{"rapid":[3,3,1]},
        {"cycle":{"kind":"ream","depth":0.4,"clear":0.1,"feed":5,"points":[[3,3,0]]}},{"rapid":[3,3,1]}"#;
    let deep = r#"{"rapid":[1,1,2]},{"cycle":{"kind":"deep","depth":1,"clear":0.1,"return":0.5,"feed":5,"step":0.25,"points":[[1,1,0],[2,1,0]]}},{"rapid":[3,3,1]}"#;
    let bore = r#"{"rapid":[1,1,2]},{"cycle":{"kind":"bore","depth":0.5,"clear":0.1,"feed":5,"orient":0,"offset":0.02,"points":[[1,1,0]]}},{"rapid":[1,1,2]}"#;
    let stop = r#"{"rapid":[2,0,1]},{"line":[2,0,-0.1]},{"rapid":[2,0,1]},{"stop":"program"},{"rapid":[3,0,1]},{"line":[3,0,-0.1]},{"rapid":[3,0,1]}"#;
    let sides = r#"{"rapid":[2,0,1]},{"rapid":[2,0,-0.1]},{"infeed":[2,1],"side":"left"},{"line":[2,2]},{"outfeed":[3,2]},{"rapid":[3,2,1]}"#;
    let tap = r#"{"rapid":[1,1,2]},{"cycle":{"kind":"tap","depth":0.5,"clear":0.2,"feed":150,"points":[[1,1,0]]}},{"rapid":[1,1,2]}"#;
    let mutations = [
        ("1", circle, "G0 Z1.\n", "G0 X-9. Y9.\n", "PV009"),
        ("1", circle, "G0 Z1.\n", "G0 Z-5.\n", "PV009"),
        ("1", circle, "H1", "H7", "PV014"),
        ("1", circle, "G43", "G44", "PV014"),
        ("1", circle, "G1 Z-.1", "G49\nG1 Z-.1", "PV014"),
        ("1", circle, "G43", "G52 Z-1.\nG43", "PV021"),
        ("1", circle, "G43", "G10 L2 P1 X0 Y0 Z-5.\nG43", "PV021"),
        ("1", circle, "S3000 M3", "S3000", "PV011"),
        ("1", circle, "T1 M6", "T1", "PV012"),
        ("1", circle, "T1 M6", "T1 M6\nG0 G54 X-5. Y-5.\nG43 H1 Z-3.", "PV009"),
        ("1", circle, "G20 ", "", "PV022"),
        ("1", circle, "I-1. J0", "I-.9998 J.02", "PV001"),
        ("1", circle, "G17 G3", "M1\nG17 G3", "PV019"),
        ("1", circle, "M30", "M99", "PV016"),
        ("1", circle, "G43 H1 Z1.", "Z1.\nG43 H1", "PV014"),
        ("1", circle, "G43 H1 Z1.", "G43 H9 Z1.\nG43 H1", "PV014"),
        ("1", circle, "G43 H1 Z1.", "G43 H1 Z1.\nG55 Z.5\nG54 Z1.", "PV001"),
        ("1", circle, "S3000 M3", "G96 S3000 M3", "PV011"),
        ("1", circle, "G17 G3", "G0 X3.\nX2.\nG17 G3", "PV001"),
        ("1", circle, "G17 G3", "G0 A360.\nG17 G3", "PV001"),
        ("1", sides, "G1 G41", "G18 G1 G41", "PV018"),
        ("1", helix, "G17 G3 Z-.1 I-1. J0", "G1 Z-.1", "PV001"),
        ("1", holes, "N110 Z.1", "N110 Z-.45", "PV009"),
        ("1", deep, "G98 G83", "G98 G73", "PV023"),
        ("1", deep, "Q.25", "Q25.", "PV023"),
        ("1", bore, "M19 R0", "(M19)", "PV011"),
        ("1", stop, "S3000 M3\nN100 M8\nN110", "\nN110", "PV011"),
        ("2", sides, "D12", "D11", "PV018"),
        ("2", sides, "G41", "G42", "PV018"),
        ("1", tap, "F150.", "F151.", "PV006"),
    ];
    for (tool, path, from, to, code) in mutations {
        let text = inches(tool, path);
        let job = document(&text);
        let program = rendered(&form, &job, Cycles::Form);
        let right = verified(&form, &program, &job);
        assert!(!matches!(right, Verdict::Different(_)), "{right:?}\n{program}");
        assert!(program.contains(from), "`{from}` in\n{program}");
        let changed = program.replacen(from, to, 1);
        let Verdict::Different(findings) = verified(&form, &changed, &job) else {
            panic!("{from} -> {to} is not found\n{changed}");
        };
        let codes: Vec<&str> = findings.iter().map(|finding| finding.code.name()).collect();
        assert!(codes.contains(&code), "{from} -> {to}: {code} wanted\n{findings:#?}\n{changed}");
    }
}

/// Correct programs that look unusual: consecutive circles, rounding that leaves a gap, parts of a cut, a plunge into a hole.
#[test]
fn right_programs_are_not_called_wrong() {
    let paths = [
        r#"{"rapid":[2,0,1]},{"arc":{"to":[2,0],"center":[1,0],"direction":"ccw"}},{"arc":{"to":[2,0],"center":[1.5,0],"direction":"ccw"}},{"rapid":[2,0,2]}"#,
        r#"{"rapid":[2,-0.00004,1]},{"line":[2,-0.00004,-0.1]},{"arc":{"to":[2,-0.00004],"center":[1,0],"direction":"ccw"}},{"rapid":[2,0,2]}"#,
        r#"{"rapid":[2.00004,0.00004,1]},{"line":[2.00004,0.00004,-0.1]},{"arc":{"to":[2.00004,0.00004],"center":[1,0],"direction":"cw"}},{"rapid":[2,0,2]}"#,
        r#"{"rapid":[1,1,2]},{"cycle":{"kind":"deep","depth":0.5,"clear":0.1,"feed":5,"step":0.2,"points":[[1,1,0]]}},{"rapid":[1,1,1]},{"line":[1,1,-0.2],"feed":10},{"line":[2,1,-0.2]},{"rapid":[2,1,1]}"#,
        r#"{"rapid":[1,1,2]},{"cycle":{"kind":"deep","depth":0.5,"clear":0.1,"feed":5,"step":0.2,"points":[[1,1,0]]}},{"cycle":{"kind":"ream","depth":0.5,"clear":0.1,"feed":5,"points":[[1,1,0]]}}"#,
    ];
    let more = [
        r#"{"rapid":[0,0,1]},{"line":[1.0931,1.03565,-0.1]},{"arc":{"to":[1.06185,1.0669],"center":[1.06185,1.03565],"direction":"ccw"}},{"rapid":[1.06185,1.0669,1]}"#,
        r#"{"rapid":[0,0,1]},{"line":[1,1,-0.1]},{"rapid":[1,1,-0.1]},{"dwell":1},{"line":[2,1,-0.1]},{"rapid":[2,1,1]}"#,
        r#"{"rapid":[0,0,2]},{"cycle":{"kind":"drill","depth":0.5,"clear":0.1,"return":0.5,"feed":5,"points":[[1,1,0]]}},{"rapid":[2,2,1]},{"work":54},{"cycle":{"kind":"drill","depth":0.5,"clear":0.1,"return":0.8,"feed":5,"points":[[3,1,0]]}},{"rapid":[2,2,2]}"#,
        r#"{"rapid":[0,0,1]},{"cycle":{"kind":"chipbreak","depth":0.9,"clear":0.3,"feed":5,"step":0.2,"points":[[1,1,0]]}},{"cycle":{"kind":"deep","depth":1.4,"clear":0.05,"feed":2,"step":0.1,"points":[[1,1,0]]}},{"rapid":[0,0,1]}"#,
        r#"{"rapid":[0,0,2]},{"cycle":{"kind":"drill","depth":0.5,"clear":0.1,"feed":5,"points":[[1,1,0],[2,1,0.5],[3,1,0],[4,1,0.2]]}},{"rapid":[0,0,2]}"#,
        r#"{"rapid":[3.25,3.78125,0.1]},{"arc":{"to":[3.25,3.78125,-0.6],"center":[3.75,3.78125],"direction":"cw","turns":5}},{"rapid":[3.75,3.78125,1]}"#,
    ];
    for name in ["haas.pf", "fanuc.pf", "linuxcnc.pf"] {
        let form = check(&post(name));
        for path in paths.into_iter().chain(more) {
            let text = inches("1", path);
            let job = document(&text);
            let program = rendered(&form, &job, Cycles::Form);
            let verdict = verified(&form, &program, &job);
            assert!(!matches!(verdict, Verdict::Different(_)), "{name}: {verdict:?}\n{program}");
        }
    }
    let form = check(&post("haas.pf"));
    let text = inches("1", r#"{"rapid":[0,0,1]},{"line":[0,0,-0.1]},{"line":[3,0,-0.1]},{"rapid":[3,0,1]}"#);
    let job = document(&text);
    let program = rendered(&form, &job, Cycles::Form);
    let parts = verified(&form, &program.replacen("X3.", "X1.\nX2.5\nX3.", 1), &job);
    assert_eq!(parts, Verdict::Equivalent(Equivalences { parts: 1, ..Equivalences::default() }));
    assert!(matches!(verified(&form, &program.replacen("X3.", "X2.5", 1), &job), Verdict::Different(_)));
}

/// Taps as CAM systems write them: rigid with a dwell on a Fanuc and a Haas, with G33.1 on LinuxCNC.
#[test]
fn taps_with_a_dwell_and_by_the_spindle_are_the_jobs() {
    let job = |words: &str| {
        format!(
            r#"{{"postform":1,"program":7,"units":"mm","tools":[{{"number":1,"diameter":6}}],"operations":[
            {{"tool":1,"work":54,"spindle":{{"speed":500,"direction":"cw"}},"path":[{{"rapid":[0,0,50]}},
            {{"cycle":{{"kind":"tap","depth":9,"clear":4,"feed":500{words},"points":[[0,0,0],[10,0,0],[10,5,-2]]}}}},{{"rapid":[0,0,50]}}]}}]}}"#
        )
    };
    for name in ["fanuc.pf", "haas.pf", "haas-4axis.pf"] {
        let (text, form) = (job(r#","dwell":1"#), check(&post(name)));
        let job = document(&text);
        let program = rendered(&form, &job, Cycles::Form);
        assert!(program.contains(if name == "fanuc.pf" { " P1000 " } else { " P1. " }), "{program}");
        assert!(
            matches!(verified(&form, &program, &job), Verdict::Identical | Verdict::Equivalent(_)),
            "{name}\n{program}"
        );
    }
    let rigid = "Tap\nG0 X[h] Y[v]\nZ[vclear]\nG33.1 Z[d] K[pitch]\nG0 Z[rplane]\nEnd\n\nLTap";
    let text = post("linuxcnc.pf").replacen(
        "Tap\nG[retplane] G84 X[h] Y[v] Z[d] R[vclear] P0 F[frate]\nEnd Cancel\n\nLTap",
        rigid,
        1,
    );
    assert!(text.contains("G33.1"));
    let (form, text) =
        (check(&text.replace("Control linuxcnc", "Control linuxcnc\nRigidTap? Y")), job(r#","rigid":true"#));
    let job = document(&text);
    let program = rendered(&form, &job, Cycles::Form);
    assert!(
        matches!(verified(&form, &program, &job), Verdict::Identical | Verdict::Equivalent(_)),
        "{:?}\n{program}",
        verified(&form, &program, &job)
    );
    let wrong = program.replacen("K1.", "K1.5", 1);
    assert!(wrong != program && matches!(verified(&form, &wrong, &job), Verdict::Different(_)), "{wrong}");
}

#[test]
fn a_hole_outside_a_cycle_is_a_fault_of_postform() {
    let settings = RunSettings::new(control("fanuc"));
    let mut comparer = Comparer::new(Cursor::new(String::new()), settings, Expectation::default(), None, false);
    let hole = postform::toolpath::Hole { at: postform::toolpath::Axes::new(&[1.0, 1.0, 0.0]), depth: None };
    let error = wrong(comparer.event(postform::toolpath::Event::Hole(hole), Default::default()));
    assert_eq!(error.code.name(), "PX001");
}

/// For a tap against the spindle direction, the spindle is reversed before the tap and restored after it.
#[test]
fn a_tap_against_the_spindle_goes_in_its_own_way() {
    let text = r#"{"postform":1,"program":7,"units":"mm","tools":[{"number":1,"diameter":6}],"operations":[
        {"tool":1,"work":54,"spindle":{"speed":600,"direction":"cw"},"feed":100,"path":[{"rapid":[0,0,50]},
        {"cycle":{"kind":"ltap","depth":9,"clear":4,"feed":600,"points":[[0,90,0],[10,90,0]]}},
        {"rapid":[0,0,50]},{"line":[5,0,40]},{"rapid":[5,0,60]}]}]}"#;
    let job = document(text);
    for name in ["fanuc.pf", "haas.pf", "linuxcnc.pf"] {
        let form = check(&post(name));
        let program = rendered(&form, &job, Cycles::Form);
        let verdict = verified(&form, &program, &job);
        assert!(!matches!(verdict, Verdict::Different(_)), "{name}: {verdict:?}\n{program}");
    }
}

/// After a cycle, the control returns to the height at which the cycle began. In the job, the tool returns to the
/// height of the last hole. A cut after the cycle shows the difference.
#[test]
fn a_cut_after_holes_of_several_heights_is_the_jobs() {
    let text = r#"{"start":{"units":"mm","program":1,"tools":[{"number":1,"length_offset":1,"diameter":10,"diameter_offset":1}]}}
{"operation":{"tool":1,"work":55,"feed":100,"spindle":{"speed":1000,"direction":"cw"},"coolant":"off"}}
{"cycle":{"kind":"ream","clear":1,"depth":8,"feed":60,"return":8}}
{"point":[0,2.5,-5]}
{"point":[0,0,5]}
{"point":[-3.25,0.001,0]}
{"cycle_end":true}
{"line":[100,1,0]}
{"cycle":{"kind":"deep","clear":5,"depth":8,"feed":60,"step":3}}
{"point":[10,0.001,5]}
{"cycle_end":true}
{"end":true}
"#;
    let job = |sink: &mut dyn Sink| read_lines(text.as_bytes(), sink).is_ok();
    for name in ["fanuc.pf", "haas.pf", "linuxcnc.pf"] {
        let form = check(&post(name));
        let program = rendered(&form, &job, Cycles::Form);
        let verdict = verified(&form, &program, &job);
        assert!(!matches!(verdict, Verdict::Different(_)), "{name}: {verdict:?}\n{program}");
    }
}

/// The control may run a block that postform does not run. Such a block ends the proof, but is not a difference.
#[test]
fn what_is_not_run_is_not_called_different() {
    let form = check(&post("haas.pf"));
    let text = inches("1", r#"{"rapid":[2,0,1]},{"line":[2,0,-0.1]},{"rapid":[2,0,1]}"#);
    let job = document(&text);
    let program = rendered(&form, &job, Cycles::Form);
    for block in ["#500=[#500+1]", "#3006=1(CHECK)", "#5221=1.", "M98 P8000", "G65 P9023 Z-1.", "G0 X#700"] {
        let changed = program.replacen("M30", &format!("{block}\nM30"), 1);
        let Verdict::NotProven(unproven) = verified(&form, &changed, &job) else { panic!("{block}\n{changed}") };
        assert!(unproven.why.contains(&format!("in `N120 {block}`")) || unproven.why.contains(block), "{unproven:?}");
        assert!(unproven.line > 0, "{unproven:?}");
    }
}
