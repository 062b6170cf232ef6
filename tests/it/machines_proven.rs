//! Programs for lathes, with rotary axes and with subprograms. Correct programs must be proven. No kind of wrong
//! program may be proven.

use std::fs;

use crate::support::root;
use postform::internals::verify::Verdict;
use postform::{Job, NoFiles, Options, Post, Source};

/// The file of the form, a text of its program, its replacement, and the expected finding.
type Change<'t> = (&'t str, &'t str, &'t str, &'t str);

fn form(name: &str) -> String {
    let folder = if root().join("postforms").join(name).exists() { "postforms" } else { "tests/data/forms" };
    fs::read_to_string(root().join(folder).join(name)).unwrap()
}

/// Checks that the program of each form is proven, and that each changed program is reported as different.
#[track_caller]
fn changes_are_found(job: &str, changes: &[Change<'_>]) {
    let mut options = Options::default();
    options.program = Some(1);
    let mut wrong = String::new();
    for (name, from, to, code) in changes {
        let post = Post::compile(Source::from_text(*name, form(name)), &NoFiles).unwrap();
        let right = post.render(Job::json(job), &options).unwrap();
        let program = right.text();
        if !right.verdict().is_proven() {
            wrong += &format!("{name}: {:#?}\n{program}", right.verdict());
            break;
        }
        if !program.contains(from) {
            wrong += &format!("{name}: `{from}` is not in\n{program}");
            continue;
        }
        let changed = program.replacen(from, to, 1);
        match post.verify(Job::json(job), &changed).unwrap() {
            Verdict::Different(findings) if findings.iter().any(|finding| finding.code.name() == *code) => {}
            verdict => wrong += &format!("{name}: {from} -> {to}: {code} wanted\n{verdict:#?}\n{changed}"),
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn lathes() {
    let part = fs::read_to_string(root().join("samples/lathe-part/job.json")).unwrap();
    changes_are_found(
        &part,
        &[
            ("fanuc-lathe.pf", "X.75\n", "X.7\n", "PV001"),
            ("fanuc-lathe.pf", "G1 Z-1. F.008", "G1 Z-1.1 F.008", "PV001"),
            ("fanuc-lathe.pf", "G3 Z-1.125", "G2 Z-1.125", "PV001"),
            ("fanuc-lathe.pf", "G1 X1.2\n", "(none)\n", "PV001"),
            ("fanuc-lathe.pf", "G1 X1.2\n", "M0\nG1 X1.2\n", "PV019"),
            ("fanuc-lathe.pf", "G0 Z.1 X1.1\n", "G0 Z-.5 X1.1\nZ.1\n", "PV001"),
            ("fanuc-lathe.pf", "F.008", "F.08", "PV006"),
            ("fanuc-lathe.pf", "G99\n", "G98\n", "PV006"),
            ("fanuc-lathe.pf", "G96 S400", "G96 S40", "PV011"),
            ("fanuc-lathe.pf", "G96 S400", "G97 S400", "PV011"),
            ("fanuc-lathe.pf", "G97 S600 M3", "G97 S600 M4", "PV011"),
            ("fanuc-lathe.pf", "G50 S2500", "G50 S5000", "PV011"),
            ("fanuc-lathe.pf", "T0303", "T0505", "PV012"),
            ("fanuc-lathe.pf", "T0101", "T0102", "PV014"),
            ("fanuc-lathe.pf", "T0303", "T0300", "PV014"),
            ("fanuc-lathe.pf", "M8\n", "M9\n", "PV024"),
            ("fanuc-lathe.pf", "Z-.9 R0 P383", "Z-.8 R0 P383", "PV017"),
            ("fanuc-lathe.pf", "X.6734 Z-.9", "X.7 Z-.9", "PV004"),
            ("fanuc-lathe.pf", "P383", "P283", "PV023"),
            ("fanuc-lathe.pf", "G76 X.6734", "T0303\nG76 X.6734", "PV015"),
            ("fanuc-lathe.pf", "F.0625", "F.1", "PV006"),
            ("fanuc-lathe.pf", "G1 Z-.9\n", "G1 Z-.8\n", "PV004"),
            ("haas-lathe.pf", "X.6734\n", "(none)\n", "PV004"),
            ("haas-lathe.pf", "G92 X.726", "G92 X.686", "PV023"),
            ("haas-lathe.pf", "I0 F.0625", "I.1 F.0625", "PV017"),
            ("lathe-radius.pf", "X.45\nZ.2\nX.358\n", "Z.2\nX.358\n", "PV009"),
            ("lathe-radius.pf", "G32 X.363 Z-.9 I0", "G1 X.363 Z-.9", "PV017"),
        ],
    );
}

/// Lathes of G code system A have G98 and G99 for the feed mode. G95 belongs to system B; on a Haas it is a tap with a
/// live tool.
#[test]
fn lathes_have_no_mills_feed_per_revolution() {
    let part = fs::read_to_string(root().join("samples/lathe-part/job.json")).unwrap();
    let mut options = Options::default();
    options.program = Some(1);
    for name in ["fanuc-lathe.pf", "haas-lathe.pf"] {
        let post = Post::compile(Source::from_text(name, form(name)), &NoFiles).unwrap();
        let right = post.render(Job::json(&part), &options).unwrap();
        let changed = right.text().replacen("G99", "G95", 1);
        let verdict = post.verify(Job::json(&part), &changed).unwrap();
        assert!(!verdict.is_proven() && changed != right.text(), "{name}: {verdict}");
        assert!(verdict.to_string().contains("G95"), "{name}: {verdict}");
    }
}

#[test]
fn wires() {
    let slanted = fs::read_to_string(root().join("samples/wire/job.json")).unwrap();
    let form = "wire-edm.pf";
    changes_are_found(
        &slanted,
        &[
            (form, "M60\n", "(none)\n", "PV025"),
            (form, "M60\n", "M50\n", "PV025"),
            (form, "M66\nM60\n", "M60\nM66\n", "PV025"),
            (form, "M50\n", "(none)\n", "PV025"),
            (form, "G0 X0 Y0 U0 V0\nM78\nM66\nM60\n", "M78\nM66\nM60\nG0 X0 Y0 U0 V0\n", "PV025"),
            (form, "U4.5 V0", "U4.6 V0", "PV001"),
            (form, "V9.5", "V-9.5", "PV001"),
            (form, "G0 X0 Y0 U0 V0", "G0 X0 Y0", "PV001"),
            (form, "Y10. V10.", "V10.\nY10.", "PV001"),
            (form, "G41", "G42", "PV018"),
            (form, "G1 G40", "G1", "PV018"),
            (form, "F3.", "F30.", "PV006"),
            (form, "M1\n", "(none)\n", "PV019"),
            (form, "G0 X0", "G1 X0", "PV015"),
        ],
    );
    let upright = r#"{"postform":1,"program":7,"units":"mm","machine":"edm","operations":[{"feed":3,"path":[{"rapid":[0,0]},{"edm":"thread"},
        {"line":[5,0]},{"arc":{"to":[10,5],"center":[5,5],"direction":"ccw"}},{"line":[10,20]},{"edm":"cut"},{"rapid":[30,0]},{"edm":"thread"},
        {"line":[35,0]},{"edm":"cut"}]}]}"#;
    changes_are_found(
        upright,
        &[
            (form, "J5.", "J5.1", "PV015"),
            (form, "G3 X10. Y5.", "G2 X10. Y5.", "PV001"),
            (form, "G3 X10. Y5.", "G3 X10. Y5. U5.", "PV001"),
            (form, "G0 X30. Y0", "G0 X31. Y0", "PV001"),
            (form, "G0 X30. Y0", "G0 X30.\nY0", "PV001"),
            (form, "G0 X30. Y0", "G0 X30. Y0 U1.", "PV001"),
            (form, "G1 X35.", "G1 X35. V.5", "PV001"),
        ],
    );
}

/// A wire moves home in its plane, because no axis can move it away from the part.
#[test]
fn a_wire_that_goes_home() {
    let text = form("wire-edm.pf") + "\nMoveHome\nG91 G28 X0 Y0\nG90\nEnd\n";
    let post = Post::compile(Source::from_text("home.pf", text), &NoFiles).unwrap();
    let job = r#"{"postform":1,"program":7,"units":"mm","machine":"edm","operations":[{"feed":3,"path":[{"rapid":[0,0]},{"edm":"thread"},
        {"line":[5,0]},{"edm":"cut"},{"home":true},{"rapid":[30,0]},{"edm":"thread"},{"line":[35,0]},{"edm":"cut"}]}]}"#;
    let printed = post.render(Job::json(job), &Options::default()).unwrap();
    assert!(printed.verdict().is_proven(), "{:#?}\n{}", printed.verdict(), printed.text());
    let stays = printed.text().replacen("G28 X0 Y0", "", 1);
    let found = post.verify(Job::json(job), &stays).unwrap();
    assert!(matches!(&found, Verdict::Different(list) if list[0].code.name() == "PV001"), "{found:#?}");
}

#[test]
fn rotary_axes() {
    let job = r#"{"postform":1,"program":7,"units":"inch","tools":[{"number":1}],"operations":[{"tool":1,"work":54,
        "spindle":{"speed":3000,"direction":"cw"},"coolant":"flood","feed":20,"path":[{"rapid":[0,0,3,0]},{"rapid":[0,0,1.2,0]},
        {"line":[2,0,1,90]},{"rapid":[2,0,3,90]},{"rapid":[2,0,3,180]},
        {"cycle":{"kind":"drill","depth":0.5,"clear":0.1,"return":2,"feed":5,"points":[[1,1,1,180],[2,1,1,270]]}},
        {"rapid":[0,0,3,270]},{"line":[0,0,1,350]},{"line":[1,0,1,700]},{"line":[2,0,1,900]},{"rapid":[2,0,3,900]}]}]}"#;
    changes_are_found(
        job,
        &[
            ("haas-4axis.pf", "A180.\n", "A170.\n", "PV002"),
            ("haas-4axis.pf", "A350.", "A340.", "PV001"),
            ("haas-4axis.pf", "A700.", "A-20.", "PV001"),
            ("haas-4axis.pf", "A270.\n", "(none)\n", "PV002"),
            ("haas-4axis.pf", "X2. Z1. A90. F20.", "X2. Z1. A90. F200.", "PV006"),
            ("rename.pf", "B350.", "B340.", "PV001"),
        ],
    );
}

#[test]
fn subprograms() {
    let job = r#"{"postform":1,"program":7,"units":"inch","tools":[{"number":1}],"subprograms":[{"number":1,"path":[{"rapid":[0,0,1]},{"feed":8},
        {"line":[0,0,-0.1]},{"line":[1,0,-0.1]},{"cycle":{"kind":"drill","depth":0.5,"clear":0.1,"feed":5,"points":[[2,0,0]]}},{"coolant":"off"},
        {"rapid":[0,0,1]}]}],"operations":[{"tool":1,"work":54,"spindle":{"speed":3000,"direction":"cw"},"coolant":"flood","feed":20,
        "path":[{"rapid":[0,0,1]},{"call":{"sub":1,"times":2}},{"rapid":[3,3,1]},{"line":[3,3,-0.5]},{"rapid":[3,3,1]},
        {"call":{"sub":1,"at":[4,4],"work":55}},{"rapid":[5,5,1]},{"line":[5,5,0.5]},{"rapid":[5,5,1]}]}]}"#;
    changes_are_found(
        job,
        &[
            ("subprograms.pf", "M98 P2 L1\n", "(none)\n", "PV001"),
            ("subprograms.pf", "M98 P2 L1\n", "M98 P2 L2\n", "PV001"),
            ("subprograms.pf", "G1 Z-.1 F8.", "G1 Z-.2 F8.", "PV001"),
            ("subprograms.pf", "F8.", "F80.", "PV006"),
            ("subprograms.pf", "Z-.5 R.1", "Z-.6 R.1", "PV004"),
            ("subprograms.pf", "M8\n", "(none)\n", "PV024"),
            ("subprograms.pf", "N270 G55", "N270 G56", "PV012"),
            ("subprograms.pf", "N80 M9\n", "N80 M5\n", "PV011"),
            ("fadal-subs.pf", "M98 P2 L1\n", "(none)\n", "PV001"),
            ("fadal-subs.pf", "F8.", "F80.", "PV006"),
            ("fadal-subs.pf", "X1.\n", "X1.5\n", "PV001"),
        ],
    );
}
