//! Separate fast code prints the later holes of a machine cycle if they print only their position. This code must give
//! the same result as the general code. With an angle of zero in each point, the general code prints the same job, and
//! the tests compare both programs.

use std::fmt::Write;
use std::fs;
use std::io::Cursor;

use postform::internals::nc::{Action, Item, RunSettings, Simulator};
use postform::{Job, NoFiles, Options, Post, Source, Verdict};
use proptest::prelude::*;

use crate::support::{control, root};

/// Drill sequences that the shipped forms do not have: words in another order, conditions on the hole, words that
/// depend on its position or number, values in comments, several lines.
const DRILLS: [&str; 15] = [
    "G[retplane] G81 X[h] Y[v] Z[d] R[vclear] F[frate]",
    "G81 Y[v] R[vclear] X[h] Z[d] F[frate]",
    "@if [h] > 20\n  G81 X[h] Y[v] Z[d] R[vclear] F[frate]\n@else\n  G82 X[h] Y[v] Z[d] R[vclear] P1 F[frate]\n@end",
    "@if [isfirsthole]\n  G81 X[h] Y[v] Z[d] R[vclear] F[frate]\n@else\n  G81 Y[v] X[h] Z[d] R[vclear] F[frate]\n@end",
    "@if [depth] > 3\n  G81 Y[v] X[h] Z[d] R[vclear] F[frate]\n@else\n  G81 X[h] Y[v] Z[d] R[vclear] F[frate]\n@end",
    "G81 X[h] Y[v] Z[d] R[vclear] F[frate] (AT [h] [v])",
    "G81 X[h] Y[v] Z[d] R[vclear] F[frate + h]",
    "G81 X[h] Y[v] Z[d] R[vclear] F[frate] P[block]",
    "G71 Z[rplane]\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]",
    "G81 X[h] Y[v] Z[d] R[vclear] F[frate]\n(NEXT)",
    "G81 X[h] Y[v] Z[d] R[vclear] F[frate] Q[hdist]",
    "G81 X[h] Y[v] Z[d] R[vclear] F[frate] S[lasth]",
    "G81 X[h] Y[v] Z[d] R[vclear] F[frate] K[lasthole]",
    "G81 X[h] Y[v] Z[d] R[vclear] F[frate]\nX[h] Y[v]",
    "G81 X[h] Y[v] Z[d] R[vclear] F[frate] C[depth]",
];

/// Cycles of a job, without their points.
const CYCLES: [&str; 8] = [
    r#""kind":"drill","depth":5,"clear":2,"feed":200"#,
    r#""kind":"drill","depth":5,"clear":2,"return":12,"feed":150"#,
    r#""kind":"face","depth":3,"clear":1,"feed":90,"dwell":0.5"#,
    r#""kind":"deep","depth":20,"clear":2,"step":3,"feed":80"#,
    r#""kind":"chipbreak","depth":20,"clear":2,"step":3,"feed":80"#,
    r#""kind":"tap","depth":6,"clear":3,"feed":900"#,
    r#""kind":"ream","depth":4,"clear":2,"feed":70"#,
    r#""kind":"bore","depth":4,"clear":2,"feed":70"#,
];

/// A point of a cycle: position and top.
#[derive(Clone, Debug)]
struct Point {
    at: [String; 2],
    top: i8,
}

fn point() -> impl Strategy<Value = Point> {
    let value = prop_oneof![
        3 => "-?[0-9]{1,2}\\.[0-9]{1,5}".prop_map(|text| number(&text)),
        2 => (0..4).prop_map(|whole: i32| (whole * 10).to_string()),
        1 => "[0-9]\\.[0-9]{3}5".prop_map(|text| number(&text)),
    ];
    let top = prop_oneof![8 => Just(0_i8), 1 => -4_i8..4];
    let at = [
        value.boxed(),
        prop_oneof![3 => "-?[0-9]{1,2}".prop_map(|text| number(&text)), 1 => Just("7".to_owned())].boxed(),
    ];
    (at, top).prop_map(|(at, top)| Point { at, top })
}

/// A number as JSON allows it, without unnecessary leading zeros.
fn number(text: &str) -> String {
    text.parse::<f64>().map(|value| value.to_string()).unwrap()
}

/// A job of these cycles. `fourth`: each point has an angle of zero.
fn job(cycles: &[(usize, Vec<Point>)], fourth: bool) -> String {
    let mut text = "{\"start\":{\"postform\":1,\"program\":1,\"units\":\"mm\",\"tools\":[{\"number\":1}]}}\n\
        {\"operation\":{\"tool\":1,\"work\":54,\"spindle\":{\"speed\":900,\"direction\":\"cw\"},\"feed\":700}}\n"
        .to_owned();
    let angle = if fourth { ",0" } else { "" };
    writeln!(text, "{{\"rapid\":[0,0,25{angle}]}}").unwrap();
    for (kind, points) in cycles {
        writeln!(text, "{{\"cycle\":{{{}}}}}", CYCLES[*kind]).unwrap();
        for Point { at: [x, y], top } in points {
            writeln!(text, "{{\"point\":[{x},{y},{top}{angle}]}}").unwrap();
        }
        writeln!(text, "{{\"cycle_end\":true}}\n{{\"rapid\":[0,0,25{angle}]}}").unwrap();
    }
    text + "{\"end\":true}\n"
}

fn printed(form: &str, job: &str) -> Result<String, String> {
    let post = Post::compile(Source::from_text("form.pf", form), &NoFiles).map_err(|error| error.to_string())?;
    let mut options = Options::default();
    options.proof = None;
    let program = post.render(Job::json_lines(job), &options);
    program.map(|program| program.text().to_owned()).map_err(|error| error.to_string())
}

/// The form with this text instead of its Drill sequence.
fn with_drill(form: &str, lines: &str) -> String {
    let from = form.find("\nDrill\n").unwrap() + "\nDrill\n".len();
    let to = from + form[from..].find("\nEnd").unwrap();
    format!("{}{lines}{}", &form[..from], &form[to..])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn holes_with_a_fourth_axis_that_rests_print_like_those_without(
        cycles in prop::collection::vec((prop_oneof![2 => 0..2_usize, 1 => 0..CYCLES.len()], prop::collection::vec(point(), 1..20)), 1..4),
        form in prop::sample::select(vec!["fanuc", "haas", "linuxcnc", "mach3", "centroid", "fadal"]),
        drill in prop::sample::select(DRILLS.to_vec()),
    ) {
        let text = fs::read_to_string(root().join(format!("postforms/{form}.pf"))).unwrap();
        let text = with_drill(&text, drill);
        let plain = printed(&text, &job(&cycles, false));
        let angled = printed(&text, &job(&cycles, true));
        // removes the block numbers and the angle; the first move prints the angle in a separate block, so some other
        // words are removed, too
        let cuts = |text: String| -> Vec<String> {
            let is_kept = |word: &&str| !word.starts_with(['N', 'A', 'P']) && *word != "G0";
            let words = |line: &str| line.split(' ').filter(is_kept).collect::<Vec<_>>().join(" ");
            text.lines().map(words).filter(|line| !line.is_empty()).collect()
        };
        prop_assert_eq!(plain.map(cuts).map_err(|_| "error"), angled.map(cuts).map_err(|_| "error"));
    }
}

/// Holes at the same position still drill. The same applies to a hole that differs only in digits that the form does
/// not print. Each block has both words.
#[test]
fn a_hole_at_the_same_position_prints_both_words() {
    let form = fs::read_to_string(root().join("postforms/linuxcnc.pf")).unwrap();
    let points = ["10,20", "30,20", "30,20", "30.000001,20", "30,40"];
    let points: Vec<Point> = points
        .iter()
        .map(|at| at.split_once(',').unwrap())
        .map(|(x, y)| Point { at: [x.to_owned(), y.to_owned()], top: 0 })
        .collect();
    let program = printed(&form, &job(&[(0, points)], false)).unwrap();
    let lines: Vec<&str> = program.lines().skip_while(|line| !line.contains("G81")).take(5).collect();
    assert_eq!(lines, ["G99 G81 X10. Y20. Z-5. R2. F200.", "X30.", "X30. Y20.", "X30. Y20.", "Y40."]);
}

/// All sequences of the property test above can be printed, so the test compares programs and not errors.
#[test]
fn the_sequences_print() {
    let form = fs::read_to_string(root().join("postforms/fanuc.pf")).unwrap();
    let points: Vec<Point> =
        ["10", "30", "30", "50"].map(|x| Point { at: [x.to_owned(), "20".to_owned()], top: 0 }).to_vec();
    for drill in DRILLS {
        let program = printed(&with_drill(&form, drill), &job(&[(0, points.clone())], false));
        assert!(program.is_ok(), "{drill}: {program:?}");
    }
}

/// The ends and feeds of a program's cuts, up to a block that the control refuses.
fn cuts(program: &[u8]) -> Vec<[f64; 4]> {
    let mut simulator = Simulator::new(Cursor::new(program), RunSettings::new(control("linuxcnc")));
    let mut items: Vec<Item> = Vec::new();
    while matches!(simulator.step(&mut items), Ok(true)) {}
    let cut = |item: &Item| match item.action {
        Action::Feed { to: [x, y, z, ..], feed, .. } => Some([x, y, z, feed]),
        _ => None,
    };
    items.iter().filter_map(cut).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    /// Separate fast code also compares holes. This code must find a program that cuts at another position or with
    /// another feed.
    #[test]
    fn a_hole_at_another_position_is_found(
        cycles in prop::collection::vec((0..3_usize, prop::collection::vec(point(), 1..12)), 1..3),
        which in 0_usize..10_000,
        digit in b'0'..=b'9',
    ) {
        let form = fs::read_to_string(root().join("postforms/linuxcnc.pf")).unwrap();
        let job = job(&cycles, false);
        let right = printed(&form, &job).unwrap();
        let post = Post::compile(Source::from_text("linuxcnc.pf", &form), &NoFiles).unwrap();
        let mut wrong = right.clone().into_bytes();
        let begin = right.find(" G8").unwrap();
        let digits: Vec<usize> = (begin..wrong.len()).filter(|&at| wrong[at].is_ascii_digit()).collect();
        wrong[digits[which % digits.len()]] = digit;
        let [is, wanted] = [&wrong[..], right.as_bytes()].map(cuts);
        let far = |(a, b): (&[f64; 4], &[f64; 4])| {
            (0..3).any(|axis| (a[axis] - b[axis]).abs() > 0.01) || (a[3] - b[3]).abs() > b[3] * 0.02
        };
        let differs = is.len() != wanted.len() || is.iter().zip(&wanted).any(far);
        let verdict = post.verify(Job::json_lines(&job), std::str::from_utf8(&wrong).unwrap()).unwrap();
        let passes = matches!(verdict, Verdict::Identical | Verdict::Equivalent(_));
        prop_assert!(!(differs && passes), "{verdict:?} for {}", String::from_utf8_lossy(&wrong));
        // the right program has the cuts of the job
        let verdict = post.verify(Job::json_lines(&job), &right).unwrap();
        let passes = matches!(verdict, Verdict::Identical | Verdict::Equivalent(_));
        prop_assert!(passes, "{verdict:?} for {right}");
    }
}

/// Blocks that come between two holes, or instead of one.
const BETWEEN: [&str; 22] = [
    "X1. Y1.",
    "X30.",
    "Y20. Z-6.",
    "X1. R3.",
    "F50.",
    "M5",
    "M9",
    "S500 M3",
    "G4 P1.",
    "M0",
    "G55",
    "G91",
    "G90",
    "G98",
    "G99",
    "G80",
    "G0 Z30.",
    "G0 X5.",
    "G1 X5. F100.",
    "G82 X3. Z-5. R2. P1. F200.",
    "G92 X1.",
    "G20",
];

/// Whether a block has only a position.
fn is_position(block: &str) -> bool {
    let words = || block.split(' ').filter(|word| !word.starts_with('N'));
    words().count() > 0 && words().all(|word| word.starts_with(['X', 'Y']))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Holes whose blocks have only a position are compared by separate fast code. With a comment in each of these
    /// blocks, the general code compares them; both must give the same verdict, with the same findings.
    #[test]
    fn a_program_with_comments_is_proven_like_one_without(
        cycles in prop::collection::vec((0..CYCLES.len(), prop::collection::vec(point(), 1..12)), 1..3),
        form in prop::sample::select(vec!["linuxcnc", "fanuc", "haas", "mach3"]),
        wrong in prop::option::of((0_usize..10_000, b'0'..=b'9')),
        between in prop::option::of((0_usize..100, prop::sample::select(BETWEEN.to_vec()))),
        left_out in prop::option::weighted(0.2, 0_usize..100),
    ) {
        let form = fs::read_to_string(root().join(format!("postforms/{form}.pf"))).unwrap();
        let job = job(&cycles, false);
        let post = Post::compile(Source::from_text("form.pf", &form), &NoFiles).unwrap();
        let mut program = printed(&form, &job).unwrap().into_bytes();
        let begin = program.windows(3).position(|text| text.starts_with(b" G8") || text.starts_with(b" G7")).unwrap();
        // changes one digit
        let digits: Vec<usize> = (begin..program.len()).filter(|&at| program[at].is_ascii_digit()).collect();
        if let Some((which, digit)) = wrong {
            program[digits[which % digits.len()]] = digit;
        }
        let program = String::from_utf8(program).unwrap();
        let mut lines: Vec<&str> = program.lines().collect();
        let holes: Vec<usize> = (0..lines.len()).filter(|&at| is_position(lines[at])).collect();
        if let (Some(which), false) = (left_out, holes.is_empty()) {
            lines.remove(holes[which % holes.len()]);
        }
        if let (Some((which, block)), false) = (between, holes.is_empty()) {
            lines.insert(holes[which % holes.len()], block);
        }
        let verdict = |comment: &str| {
            let line = |line: &&str| format!("{line}{}\n", if is_position(line) { comment } else { "" });
            let program: String = lines.iter().map(line).collect();
            format!("{:?}", post.verify(Job::json_lines(&job), &program).unwrap()).replace(" (c)", "")
        };
        prop_assert_eq!(verdict(""), verdict(" (c)"), "{}\n{}", job, lines.join("\n"));
    }
}

/// A sequence may move the tool away before a hole. The hole moves the tool back, so a cut can follow the cycle.
#[test]
fn a_cut_follows_holes_after_an_upon_that_moves() {
    let form = fs::read_to_string(root().join("postforms/haas.pf")).unwrap();
    let form = form.replace(
        "\nCancel\nG80\n",
        "\nUpon Every [cool]\nG0 G53 Z0\nM[cool]\nEnd\n\nCancel\n@if [h] < 3\n  G80 M9\n@else\n  G80\n@end\n",
    );
    let point = |x: &str, top: i8| Point { at: [x.to_owned(), "1".to_owned()], top };
    let points = vec![point("1", 0), point("2", 5), point("3", 5), point("4", 5)];
    let job = job(&[(0, points)], false).replace("\"feed\":700", "\"feed\":700,\"coolant\":\"flood\"");
    let cut = "{\"cycle_end\":true}\n{\"line\":[4,1,6]}\n";
    let program = printed(&form, &job.replace("{\"cycle_end\":true}\n", cut)).unwrap();
    assert!(program.contains("X3.\n") && program.contains("X4.\n"), "{program}");
}

/// A cycle begins over the last hole of another cycle, which has a higher return height. Even if the form can't return
/// to this height, the program is printed and proven, because there is no rapid between the holes.
#[test]
fn a_cycle_goes_on_over_the_last_hole_of_another_one() {
    let form = fs::read_to_string(root().join("postforms/haas.pf")).unwrap();
    let form = with_drill(&form, "G81 X[h] Y[v] Z[d] R[vclear] F[frate]");
    let point = |x: &str| format!("{{\"point\":[{x},1,0]}}\n");
    let cycle = |more: &str, points: [&str; 3]| {
        let points: String = points.map(point).concat();
        format!(
            "{{\"cycle\":{{\"kind\":\"drill\",\"clear\":2,\"feed\":200,{more}}}}}\n{points}{{\"cycle_end\":true}}\n"
        )
    };
    let begin = job(&[], false).replace("{\"end\":true}\n", "");
    let [first, second] = [("\"depth\":5,\"return\":12", ["1", "2", "3"]), ("\"depth\":7", ["3", "4", "5"])]
        .map(|(more, points)| cycle(more, points));
    let job = format!("{begin}{first}{second}{{\"rapid\":[0,0,30]}}\n{{\"end\":true}}\n");
    let program = printed(&form, &job).unwrap();
    let blocks: Vec<&str> = program.lines().filter_map(|line| Some(line.split_once(' ')?.1)).collect();
    let second = blocks.iter().position(|block| block.contains("Z-7.")).unwrap();
    assert_eq!(blocks[second + 1..second + 4], ["X4.", "X5.", "G80"], "{program}");
    let post = Post::compile(Source::from_text("form.pf", &form), &NoFiles).unwrap();
    let verdict = post.verify(Job::json_lines(&job), &program).unwrap();
    assert!(matches!(verdict, Verdict::Identical | Verdict::Equivalent(_)), "{verdict:?}\n{program}");
}

/// If a block between two holes of a cycle changes a state, the proof finds the change at the next hole, even if the
/// position of this hole is right.
#[test]
fn a_change_between_two_holes_is_found() {
    let form = fs::read_to_string(root().join("postforms/linuxcnc.pf")).unwrap();
    let post = Post::compile(Source::from_text("linuxcnc.pf", &form), &NoFiles).unwrap();
    let points = ["10", "30", "50", "70", "90"].map(|x| Point { at: [x.to_owned(), "20".to_owned()], top: 0 });
    let job = job(&[(0, points.to_vec())], false).replace("\"feed\":700", "\"feed\":700,\"coolant\":\"flood\"");
    let right = printed(&form, &job).unwrap();
    assert_eq!(right.matches("X70.\n").count(), 1, "{right}");
    let changes = [
        ("M5", "PV011"),
        ("S700", "PV011"),
        ("M4", "PV011"),
        ("M9", "PV024"),
        ("F50.", "PV006"),
        ("G55", "PV012"),
        ("G43 H7", "PV014"),
        ("G43 H7\nG43 H1\nM5\nM3", "none"),
    ];
    for (block, code) in changes {
        let wrong = right.replace("X70.\n", &format!("{block}\nX70.\n"));
        let found = match post.verify(Job::json_lines(&job), &wrong).unwrap() {
            Verdict::Different(findings) => findings.iter().map(|finding| finding.code.name()).collect::<Vec<_>>(),
            _ => vec!["none"],
        };
        assert!(found.contains(&code), "{block}: {found:?}\n{wrong}");
    }
}
