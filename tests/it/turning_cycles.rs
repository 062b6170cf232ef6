//! Turning cycles of lathes: the moves that the control makes for G70 to G75, G90 and G94.

use std::fmt::Write as _;
use std::io::Cursor;

use crate::support::control;
use postform::internals::nc::{Action, RunError, RunSettings, Simulator};
use proptest::prelude::*;

const HEAD: &str = "O1\nG21 G99 G97 S800 M3\nT0101\n";

/// Moves as `r` (rapid), `f` (feed) or `a` (arc) with radius and Z, or the refusal.
fn moves(control_name: &str, blocks: &str) -> Result<Vec<String>, String> {
    let program = format!("{HEAD}{blocks}\nM30\n");
    let mut run = Simulator::new(Cursor::new(program), RunSettings::new(control(control_name)));
    let mut items = Vec::new();
    loop {
        match run.step(&mut items) {
            Ok(true) => {}
            Ok(false) => break,
            Err(RunError::Refused(diag, line)) => return Err(format!("{} {line} {}", diag.code.name(), diag.message)),
            Err(RunError::Io(error)) => panic!("{error}"),
        }
    }
    let text = |what: &str, to: &[f64; 6]| {
        let short = |value: f64| format!("{}", (value * 1e4).round() / 1e4 + 0.0);
        format!("{what} {} {}", short(to[0]), short(to[2]))
    };
    let moves = items.iter().filter_map(|item| match &item.action {
        Action::Rapid { to, .. } => Some(text("r", to)),
        Action::Feed { to, .. } => Some(text("f", to)),
        Action::Arc(turn) => Some(text("a", &turn.to)),
        _ => None,
    });
    Ok(moves.collect())
}

#[track_caller]
fn makes(blocks: &str, expected: &[&str]) {
    assert_eq!(moves("fanuc-lathe", blocks).unwrap(), expected, "{blocks}");
}

#[test]
fn g90_and_g94_make_a_pass_and_come_back() {
    makes(
        "G0 X50. Z2.\nG90 X46. Z-20. F.2\nX42.\nG0 Z5.",
        &["r 25 2", "r 23 2", "f 23 -20", "f 25 -20", "r 25 2", "r 21 2", "f 21 -20", "f 25 -20", "r 25 2", "r 25 5"],
    );
    // R is the radius at the start of the cone minus the radius at its end
    makes("G0 X50. Z2.\nG90 X46. Z-20. R-3. F.2", &["r 25 2", "r 20 2", "f 23 -20", "f 25 -20", "r 25 2"]);
    makes("G0 X50. Z2.\nG94 X10. Z-1. F.2", &["r 25 2", "r 25 -1", "f 5 -1", "f 5 2", "r 25 2"]);
    makes("G0 X50. Z2.\nG94 U-40. W-3. R-2. F.2", &["r 25 2", "r 25 -3", "f 5 -1", "f 5 2", "r 25 2"]);
}

#[test]
fn g74_and_g75_peck() {
    makes(
        "G0 X0 Z2.\nG74 R1.\nG74 Z-6. Q3000 F.1",
        &["r 0 2", "f 0 -1", "r 0 0", "f 0 -4", "r 0 -3", "f 0 -6", "r 0 2"],
    );
    makes(
        "G0 X30. Z-10.\nG75 R.5\nG75 X26. Z-13. P1500 Q2000 F.1",
        &[
            "r 15 -10",
            "f 13.5 -10",
            "r 14 -10",
            "f 13 -10",
            "r 15 -10",
            "r 15 -12",
            "f 13.5 -12",
            "r 14 -12",
            "f 13 -12",
            "r 15 -12",
            "r 15 -13",
            "f 13.5 -13",
            "r 14 -13",
            "f 13 -13",
            "r 15 -13",
            "r 15 -10",
        ],
    );
    // a Haas has one G74 block with lengths; its retract is 0.05 inch, the factory setting
    let haas = moves("haas-lathe", "G0 X0 Z2.\nG74 Z-2. K3. F.1").unwrap();
    assert_eq!(haas, ["r 0 2", "f 0 -1", "r 0 0.27", "f 0 -2", "r 0 2"]);
}

const PROFILE: &str = "N10 G0 X20.\nG1 Z-10. F.1\nG2 X30. Z-15. R5.\nG1 X40. Z-30.\nN20 X50.\n";

#[test]
fn g71_cuts_in_passes_and_g70_follows_the_profile() {
    let found = moves(
        "fanuc-lathe",
        &format!("G0 X52. Z2.\nG71 U6. R1.\nG71 P10 Q20 U.4 W.1 F.25\n{PROFILE}G70 P10 Q20\nG0 X100."),
    )
    .unwrap();
    let passes = [
        "r 26 2",
        "r 26.2 2.1", // the start, then the start moved by the finishing allowance
        "r 20.2 2.1",
        "f 20.2 -29.9",
        "r 21.2 -28.9",
        "r 21.2 2.1", // 6 deep, with a retract at 45 degrees
        "r 14.2 2.1",
        "f 14.2 -14.799",
        "r 15.2 -13.799",
        "r 15.2 2.1", // up to the arc
        "r 10.2 2.1",
        "f 10.2 -9.9",
        "a 15.2 -14.9",
        "f 20.2 -29.9",
        "f 25.2 -29.9",
        "r 26 2", // along the profile
        "r 10 2",
        "f 10 -10",
        "a 15 -15",
        "f 20 -30",
        "f 25 -30",
        "r 26 2", // the finish
        "r 50 2", // the block after the profile
    ];
    assert_eq!(found, passes);
    // a Haas has one G71 block, with the depth as D
    let haas = moves("haas-lathe", &format!("G0 X52. Z2.\nG71 P10 Q20 U.4 W.1 D6. F.25\n{PROFILE}G0 X100.")).unwrap();
    assert_eq!(haas.len(), passes.len() - 6);
    assert_eq!(haas[4], "r 21.47 -28.63");
}

#[test]
fn g72_cuts_along_x_and_g73_follows_the_profile_nearer_each_time() {
    makes(
        "G0 X52. Z1.\nG72 W2. R.5\nG72 P10 Q20 F.2\nN10 G0 Z-4.\nG1 X30. F.1\nX20. Z-1.\nN20 Z0",
        &[
            "r 26 1",
            "r 26 -1",
            "f 10 -1",
            "r 10.5 -0.5",
            "r 26 -0.5",
            "r 26 -3",
            "f 13.3333 -3",
            "r 13.8333 -2.5",
            "r 26 -2.5",
            "r 26 -4",
            "f 15 -4",
            "f 10 -1",
            "f 10 0",
            "r 26 1",
        ],
    );
    makes(
        "G0 X52. Z2.\nG73 U4. W2. R3\nG73 P10 Q20 U.2 W.1 F.2\nN10 G0 X20. Z0\nG1 Z-10. F.1\nN20 X30.",
        &[
            "r 26 2",
            "r 30.1 4.1",
            "r 14.1 2.1",
            "f 14.1 -7.9",
            "f 19.1 -7.9",
            "r 28.1 3.1",
            "r 12.1 1.1",
            "f 12.1 -8.9",
            "f 17.1 -8.9",
            "r 26.1 2.1",
            "r 10.1 0.1",
            "f 10.1 -9.9",
            "f 15.1 -9.9",
            "r 26 2",
        ],
    );
}

#[test]
fn what_is_not_certain_is_refused() {
    let cases = [
        (
            "G71 U2. R1.\nG71 P10 Q20 F.2\nN10 G0 X20.\nG1 Z-5.\nX16. Z-10.\nN20 X40.",
            "PN016 6 G71: the profile goes back along X",
        ),
        ("G71 P10 Q20 F.2\nN10 G0 X20.\nN20 G1 Z-5.", "PN007 5 G71 without the depth of a pass"),
        ("G71 U2.\nG71 P10 Q20 F.2\nN10 G0 X20.\nN20 G1 Z-5.", "PN007 6 G71 without the retract of a pass"),
        ("G71 U2. R1.\nG71 P10 Q30 F.2\nN10 G0 X20.\nN20 G1 Z-5.", "PN018 6 the profile's block N30 does not follow"),
        ("G71 U2. R1.\nG71 P10 Q20 R1. F.2\nN10 G0 X20.\nN20 G1 Z-5.", "PN016 6 G71 with R"),
        ("G71 U2. R1.\nG71 P10 Q20 F.2\nN10 G0 X20.\nG0 Z-3.\nN20 G1 Z-5.", "PN016 9 a cut after a rapid inside"),
        (
            "G71 U2. R1.\nG71 P10 Q20 F.2\nN10 G0 X20.\nM8\nT0202\nN20 G1 Z-5.",
            "PN016 8 a profile may contain only moves",
        ),
        ("G71 U2 R1.\nG71 P10 Q20 F.2\nN10 G0 X20.\nN20 G1 Z-5.", "PN017 5 U2 has no point"),
        ("G71 U2. R1.\nG71 P10 Q20 F.2\nN10 G0 X20.\nG1 Z-5.\nN20 X51.", "PN018 6 G71: the profile goes farther out"),
        ("G74 Z-6. Q3000 F.1", "PN007 5 G74 without the retract after a peck"),
        ("G74 R1.\nG74 X10. Z-6. Q3000 R.5 F.1", "PN016 6 G74 with a relief"),
        ("G70 P10 Q20", "PN018 5 the profile's block N10"),
    ];
    for (blocks, refused) in cases {
        let outcome = moves("fanuc-lathe", &format!("G0 X50. Z2.\n{blocks}"));
        assert!(outcome.as_ref().is_err_and(|message| message.starts_with(refused)), "{blocks}: {outcome:?}");
    }
}

/// A profile of steps: length along the cuts, height across, and shape: straight, a quarter arc, or a shoulder.
fn steps() -> impl Strategy<Value = Vec<(u32, u32, u8)>> {
    prop::collection::vec((1u32..60, 1u32..40, 0u8..4), 1..7)
}

proptest! {
    /// No pass is nearer to the profile than the allowance, no pass is deeper than allowed, and the last pass follows
    /// the profile.
    #[test]
    fn passes_leave_the_profile(steps in steps(), depth in 3u32..60, left in 0u32..8, inside: bool, across: bool) {
        // depth and allowance are in tenths; the second coordinate of a point is along the passes
        let out = if inside { -1.0 } else { 1.0 };
        let (depth, left) = (f64::from(depth) / 10.0, f64::from(left) / 10.0);
        let begin = [if inside { 60.0 } else { 30.0 }, 0.0];
        let mut at: [f64; 2] = begin;
        // points on the path of the profile
        let mut path = vec![[at[0], 2.0], at];
        let mut blocks = String::new();
        let word = |letter: char, value: f64| format!("{letter}{:.4}", if letter == 'X' { value * 2.0 } else { value });
        let point = |at: [f64; 2]| {
            let [x, z] = if across { [at[1], at[0]] } else { at };
            format!("{} {}", word('X', x), word('Z', z))
        };
        let shifted = |at: [f64; 2]| if across { [at[0], at[1] + 200.0] } else { at };
        _ = writeln!(blocks, "G1 {}", point(shifted(at)));
        for (along, away, how) in &steps {
            let (along, away) = (f64::from(*along) / 10.0, f64::from(*away) / 10.0);
            let to = match how {
                0 => [at[0], at[1] - along],
                1 => [at[0] + out * away, at[1]],
                2 => [at[0] + out * away, at[1] - along],
                _ => [at[0] + out * away, at[1] - away],
            };
            if *how == 3 {
                // a quarter arc about a point beside its start
                let centre = [to[0], at[1]];
                for part in 1..=40 {
                    let (sine, cosine) = (std::f64::consts::FRAC_PI_2 * f64::from(part) / 40.0).sin_cos();
                    path.push([centre[0] - out * away * cosine, centre[1] - away * sine]);
                }
                let code = if inside == across { "G2" } else { "G3" };
                _ = writeln!(blocks, "{code} {} R{away:.4}", point(shifted(to)));
            } else {
                path.push(to);
                _ = writeln!(blocks, "G1 {}", point(shifted(to)));
            }
            at = to;
        }
        let start = shifted([at[0] + out * 1.0, 2.0]);
        let first = shifted(begin);
        let (code, letter, own) = if across { ("G72", 'W', 'Z') } else { ("G71", 'U', 'X') };
        let half = |value: f64| if across { value } else { value * 2.0 };
        let program = format!(
            "G0 {}\n{code} {letter}{depth:.4} R.5\n{code} P10 Q20 {letter}{:.4} F.2\nN10 G0 {}\n{blocks}N20 G1 {}",
            point(start), half(out * left), word(own, first[0]), point(shifted(at)),
        );
        let made = moves("fanuc-lathe", &program);
        let made = made.map_err(|refused| TestCaseError::fail(format!("{refused}\n{program}")))?;
        let offset = if across { 200.0 } else { 0.0 };
        let ends: Vec<(bool, [f64; 2])> = made
            .iter()
            .map(|line| {
                let mut parts = line.split(' ');
                let is_rapid = parts.next() == Some("r");
                let [x, z]: [f64; 2] = std::array::from_fn(|_| parts.next().unwrap().parse().unwrap());
                (is_rapid, if across { [z, x - offset] } else { [x, z] })
            })
            .collect();
        // the least allowed first coordinate for a given second coordinate; at a shoulder, the smaller value
        let nearest = |second: f64| {
            let mut value = f64::NEG_INFINITY;
            for pair in path.windows(2) {
                let [[a0, a1], [b0, b1]] = [pair[0], pair[1]];
                if second <= a1 + 1e-4 && second >= b1 - 1e-4 {
                    let share = if a1 == b1 { 0.0 } else { ((a1 - second) / (a1 - b1)).clamp(0.0, 1.0) };
                    // at a shoulder, the tool is next to the shoulder, so the inner end of the shoulder counts
                    let here = (a0 + (b0 - a0) * share) * out;
                    value = if value == f64::NEG_INFINITY { here } else { value.min(here) };
                }
            }
            value
        };
        let mut levels = vec![(start[0] + out * left) * out];
        // an arc is part of the profile itself, and only its ends are in the list
        let straight = ends.windows(2).zip(&made[1..]).filter(|(_, line)| !line.starts_with('a'));
        for (pair, _) in straight {
            let ([a, b], is_rapid) = ([pair[0].1, pair[1].1], pair[1].0);
            if !is_rapid && a[0] == b[0] {
                levels.push(a[0] * out);
            }
            for part in 0..=20 {
                let share = f64::from(part) / 20.0;
                let here = [a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share];
                let least = nearest(here[1]) + left;
                prop_assert!(
                    here[0] * out >= least - 5e-2,
                    "{here:?} is nearer than {least}\n{program}\n{made:#?}"
                );
            }
        }
        let floor = (begin[0] + out * left) * out;
        levels.push(floor);
        levels.sort_by(f64::total_cmp);
        for pair in levels.windows(2).filter(|pair| pair[0] >= floor - 1e-6) {
            prop_assert!(pair[1] - pair[0] <= depth + 1e-3, "{pair:?}\n{program}\n{made:#?}");
        }
        // the last cut ends at the end of the profile, moved by the allowance
        let cuts: Vec<[f64; 2]> = ends.iter().rev().skip(1).take_while(|(rapid, _)| !rapid).map(|(_, to)| *to).collect();
        let end = [at[0] + out * left, at[1]];
        prop_assert!((cuts[0][0] - end[0]).abs() < 1e-3 && (cuts[0][1] - end[1]).abs() < 1e-3, "{cuts:?} {end:?}\n{program}");
    }
}

/// Variables that a profile computes are computed once, although the profile is read for the passes and run for the finish.
#[test]
fn a_profile_computes_once() {
    let blocks =
        "G0 X52. Z2.\n#1=10.\nG71 U6. R1.\nG71 P10 Q20 F.2\nN10 G0 X20.\n#1=[#1+5.]\nG1 Z-#1\nN20 X50.\nG70 P10 Q20";
    let found = moves("fanuc-lathe", blocks).unwrap();
    let depths = |from: &str| found.iter().filter(|line| line.starts_with(from) && line.ends_with(" -15")).count();
    assert!(depths("f 10 ") == 2 && !found.iter().any(|line| line.ends_with(" -20")), "{found:#?}");
}

#[test]
fn chamfers_and_rounded_corners() {
    // I is in the direction of the next block along X, as a radius; the corner point itself is not reached
    makes(
        "G0 X20. Z2.\nG1 Z-20. I3. F.2\nX50. K-2.\nZ-40.",
        &["r 10 2", "f 10 -17", "f 13 -20", "f 23 -20", "f 25 -22", "f 25 -40"],
    );
    // the rounded corner equals a G2 or G3 with the same radius
    let corner = |blocks: &str| moves("fanuc-lathe", &format!("G0 X20. Z2.\n{blocks}")).unwrap();
    assert_eq!(
        corner("G1 Z-20. R3. F.2\nX50. R-2.\nZ-40."),
        corner("G1 Z-17. F.2\nG2 X26. Z-20. R3.\nG1 X46.\nG3 X50. Z-22. R2.\nG1 Z-40."),
    );
    // increments start at the corner point
    assert_eq!(
        corner("G1 Z-20. R3. F.2\nU30. (TO X50)\nW-5."),
        ["r 10 2", "f 10 -17", "a 13 -20", "f 25 -20", "f 25 -25"]
    );
    // comments and empty blocks are allowed in between
    assert_eq!(corner("G1 Z-20. R3. F.2\n(STEP)\nN5\nX50."), ["r 10 2", "f 10 -17", "a 13 -20", "f 25 -20"]);
}

#[test]
fn arcs_of_rounded_corners_turn_as_the_cut_does() {
    let arcs = |blocks: &str| {
        let program = format!("{HEAD}G0 X20. Z2.\n{blocks}\nM30\n");
        let mut run = Simulator::new(Cursor::new(program), RunSettings::new(control("fanuc-lathe")));
        let (mut items, mut arcs) = (Vec::new(), Vec::new());
        while run.step(&mut items).unwrap() {}
        for item in items {
            if let Action::Arc(turn) = item.action {
                arcs.push((turn.to, turn.center, turn.direction));
            }
        }
        arcs
    };
    for (short, long) in [
        ("G1 Z-20. R3. F.2\nX50. R-2.\nZ-40.", "G1 Z-17. F.2\nG2 X26. Z-20. R3.\nG1 X46.\nG3 X50. Z-22. R2.\nG1 Z-40."),
        ("G1 Z-20. R-3. F.2\nX4. R2.\nZ-4.", "G1 Z-17. F.2\nG3 X14. Z-20. R3.\nG1 X8.\nG3 X4. Z-18. R2.\nG1 Z-4."),
    ] {
        assert_eq!(arcs(short), arcs(long), "{short}");
    }
}

#[test]
fn corners_that_nothing_leaves_are_refused() {
    let refused = |blocks: &str, message: &str| {
        let text = moves("fanuc-lathe", &format!("G0 X20. Z2.\n{blocks}")).unwrap_err();
        assert!(text.contains(message), "{blocks}: {text}");
    };
    refused(
        "G1 Z-20. R3. F.2\nG0 X50.",
        "PN006 6 a chamfer or rounded corner, but the next block does not move along the other axis",
    );
    refused("G1 Z-20. R3. F.2\nX50. Z-30.", "does not move along the other axis");
    refused("G1 Z-20. R3. F.2\nG4 P100", "does not move along the other axis");
    refused("G1 Z-20. R3. F.2", "does not move along the other axis");
    refused(
        "G1 Z-20. R3. F.2\nX10.",
        "PN018 6 the block after a chamfer or rounded corner moves in the opposite direction",
    );
    refused("G1 Z-20. R3. F.2\nX24.", "or is too short");
    refused("G1 Z0. R3. F.2\nX50.", "a cut of 2 is shorter than its chamfer or rounded corner of 3");
    refused("G1 Z-20. K3. F.2\nX50.", "PN009 5 K in a cut that is not along X");
    refused("G1 X30. Z-20. R3. F.2\nX50.", "R in a cut that is not along one axis");
    refused("G1 Z-20. R3. I3. F.2\nX50.", "PN004 5 a cut with two of I, K and R");
    refused("G28 U0 W0\nG1 Z-20. R3. F.2\nX50.", "from an unknown machine position");
}

#[track_caller]
fn is_refused(control: &str, blocks: &str, message: &str) {
    let text = moves(control, blocks).unwrap_err();
    assert!(text.contains(message), "{blocks}: {text}");
}

#[test]
fn lengths_of_threads_without_a_point_are_asked_for() {
    for blocks in [
        "G0 X40. Z2.\nG92 X39000 Z-20. F2.",
        "G0 X40. Z2.\nG92 X39. Z-20000 F2.",
        "G0 X40. Z2.\nG92 U-1000 Z-20. F2.",
        "G0 X40. Z2.\nG92 X39. Z-20. R-500 F2.",
        "G0 X40. Z2.\nG76 P010060 Q50 R.02\nG76 X38000 Z-20. P1000 Q600 F2.",
        "G0 X40. Z2.\nG76 P010060 Q50 R20\nG76 X38. Z-20. P1000 Q600 F2.",
        "G0 X40. Z2.\nG32 Z-20000 F2.",
    ] {
        is_refused("fanuc-lathe", blocks, "PN017");
    }
    // P and Q of G76 count the smallest increments of the control; Q of a G92 thread is an angle
    assert!(moves("fanuc-lathe", "G0 X40. Z2.\nG76 P010060 Q50 R.02\nG76 X38. Z-20. P1000 Q600 F2.").is_ok());
    assert!(moves("fanuc-lathe", "G0 X40. Z2.\nG92 X39. Z-20. Q180000 F2.").is_ok());
}

#[test]
fn a_pass_keeps_what_its_code_written_again_does_not_say() {
    makes(
        "G0 X44. Z5.\nG92 X40. Z-20. F2.\nG92 X39.\nX38.",
        &[
            "r 22 5",
            "r 20 5",
            "f 20 -20",
            "r 22 -20",
            "r 22 5",
            "r 19.5 5",
            "f 19.5 -20",
            "r 22 -20",
            "r 22 5",
            "r 19 5",
            "f 19 -20",
            "r 22 -20",
            "r 22 5",
        ],
    );
    // a pass does not keep the words of the previous pass if it has another code, or follows a code that ends the
    // passes
    let head = "G0 X44. Z5.\nG90 X40. Z-20. F.2\n";
    for end in ["G92 X39.", "G94 Z-3.", "G28 U0 W0\nX39.", "G0 X44. Z5.\nG90 X39."] {
        is_refused("fanuc-lathe", &format!("{head}{end}"), "PN007");
    }
    is_refused("fanuc-lathe", "G0 X44. Z5.\nG92 X40. F2.", "G92 has no Z");
    is_refused(
        "fanuc-lathe",
        "G0 X44. Z5.\nG90 X40. Z-20. R-1. F.2\nG90 X39.",
        "G90 is written again after a tapered pass",
    );
    // a dwell does not end the passes
    assert!(moves("fanuc-lathe", &format!("{head}G4 P500\nX39.")).is_ok());
}

#[test]
fn cycles_of_passes_begin_in_the_program() {
    for cycle in [
        "G71 U2. R1.\nG71 P10 Q20 F.2\nN10 G0 X20.\nN20 G1 Z-9.",
        "G70 P10 Q20\nN10 G0 X20.\nN20 G1 Z-9.",
        "G74 R1.\nG74 Z-10. Q3000 F.2",
        "G75 R1.\nG75 X10. P3000 F.2",
        "G76 P010060 Q50 R.02\nG76 X38. Z-20. P1000 Q600 F2.",
    ] {
        is_refused("fanuc-lathe", &format!("G28 U0 W0\nG0 X40.\n{cycle}"), "begins at an unknown machine position");
    }
}

#[test]
fn a_depth_that_divides_exactly_makes_no_pass_at_the_bottom() {
    for left in ["0", ".2", ".4", ".6"] {
        let blocks = format!("G0 X48. Z4.\nG71 U2. R.25\nG71 P50 Q100 U{left} F.3\nN50 G0 X20.\nN60 G1 Z0.\nN100 X48.");
        let passes = moves("fanuc-lathe", &blocks).unwrap().iter().filter(|step| step.starts_with('f')).count();
        assert_eq!(passes, 6 + 2, "U{left}");
    }
}

#[test]
fn what_manuals_leave_open_is_refused() {
    let cycle = "G0 X50. Z2.\nG71 U2. R1.\nG71 P10 Q20 F.2\n";
    let blocks = format!("{cycle}N10 G0 X20. Z1.\nN20 G1 Z-9.");
    is_refused("fanuc-lathe", &blocks, "the first block of the profile moves along X and Z");
    is_refused("fanuc-lathe", &format!("{cycle}N10 G0 X20.\nN20 G1 Z-9.\nX60."), "PN006");
    let pattern = "G0 X50. Z2.\nG73 U5. W5. R1\nG73 P10 Q20 F.2\nN10 G0 X20.\nN20 G1 Z-9.";
    is_refused("fanuc-lathe", pattern, "G73 with one pass");
}

#[test]
fn sizes_have_no_sign() {
    for blocks in [
        "G0 X50. Z2.\nG71 U-2. R1.",
        "G0 X50. Z2.\nG71 U2. R-1.",
        "G0 X0 Z2.\nG74 R-1.",
        "G0 X0 Z2.\nG74 R1.\nG74 Z-9. Q-3000 F.1",
        "G0 X40. Z2.\nG76 P010060 Q50 R-.02",
        "G0 X40. Z2.\nG76 P010007 Q50 R.02",
    ] {
        is_refused("fanuc-lathe", blocks, "PN018");
    }
    // a Haas has only one block
    is_refused("haas-lathe", "G0 X50. Z2.\nG71 U2. R1.", "PN007");
}

#[test]
fn a_chamfer_may_be_as_long_as_its_cut() {
    makes("G0 X50. Z2.\nG1 X50.4 K-.2 F.2\nZ-9.", &["r 25 2", "f 25.2 1.8", "f 25.2 -9"]);
    makes("G0 X4.6 Z.3\nG1 X3.92 K-.02 F.15\nZ.28", &["r 2.3 0.3", "f 1.98 0.3", "f 1.96 0.28"]);
    // the block after the corner must contain nothing else
    is_refused("fanuc-lathe", "G0 X20. Z2.\nG1 Z-20. R3. F.2\nG55 X50.", "does not move along the other axis");
    is_refused("fanuc-lathe", "G0 X20. Z2.\nG1 Z-20. R3. F.2\nT0202 X50.", "does not move along the other axis");
}
