//! The duration of programs on axes that accelerate.
//!
//! The recorded seconds are those of Grbl 1.1's own planner (planner.c, stepper.c, mc_arc of motion_control.c, with a junction
//! deviation of 0.010 mm and an arc tolerance of 0.002 mm), run as a separate program.

use std::fmt::Write as _;
use std::io::Cursor;

use crate::support::control;
use crate::support::folder::{Folder, out};
use crate::support::root;
use postform::internals::machine::{AxisRates, Corner, Planner, Rates, read};
use postform::internals::nc::RunSettings;
use postform::internals::preflight::{Known, Times, preflight, preflight_by_block};
use proptest::prelude::*;

/// A router and a heavy machine. Each has an acceleration and a rapid rate for X and Y, then for Z.
const ROUTER: [[f64; 2]; 2] = [[500.0, 8000.0], [250.0, 3000.0]];
const HEAVY: [[f64; 2]; 2] = [[50.0, 3000.0], [20.0, 1000.0]];

fn machine([across, down]: [[f64; 2]; 2], more: &str) -> String {
    let axis = |name: char, [acceleration, rapid]: [f64; 2]| {
        format!("[axes.{name}]\nacceleration = {acceleration:?}\nrapid = {rapid:?}\n")
    };
    format!("control = \"grbl\"\n{}{}{}{more}", axis('X', across), axis('Y', across), axis('Z', down))
}

fn times(program: &str, file: &str) -> Times {
    let machine = read("m.toml", file, &|name| Err(format!("no {name}"))).unwrap_or_else(|wrong| panic!("{wrong}"));
    let control = machine.control.unwrap_or_else(|| control("grbl"));
    preflight(Cursor::new(program), RunSettings::new(control), &machine, &Known::default()).unwrap().times.unwrap()
}

/// The times of blocks: line and seconds.
fn block_times(program: &str, file: &str) -> Vec<(u32, f64)> {
    let machine = read("m.toml", file, &|name| Err(format!("no {name}"))).unwrap_or_else(|wrong| panic!("{wrong}"));
    let control = machine.control.unwrap_or_else(|| control("grbl"));
    let fitted =
        preflight_by_block(Cursor::new(program), RunSettings::new(control), &machine, &Known::default()).unwrap();
    fitted.block_times.into_iter().map(|block| (block.line, f64::from(block.seconds))).collect()
}

/// The times of the blocks add up to the time of the program, although the control plans several blocks ahead.
#[test]
fn the_times_of_blocks_add_up() {
    let linuxcnc = machine(ROUTER, "").replace("grbl", "linuxcnc");
    for file in [machine(ROUTER, ""), machine(HEAVY, "[tools]\nchange = 7\n"), linuxcnc] {
        for program in [square(), circle(), zigzag(), zigzag().replace("G4", "T1 M6\nG4")] {
            let program = if file.contains("linuxcnc") { program.replace("G21", "G64 P0.5\nG21") } else { program };
            let blocks = block_times(&program, &file);
            let sum: f64 = blocks.iter().map(|(_, seconds)| seconds).sum();
            let whole = times(&program, &file).whole();
            assert!((sum - whole).abs() < 1e-3 * whole, "{file}{program}: {sum} {whole}");
            assert!(blocks.len() > 4 && blocks.windows(2).all(|two| two[0].0 < two[1].0), "{blocks:?}");
        }
    }
}

/// If the axes stop after each move, the time of a block is the time that the block adds to the program.
#[test]
fn the_time_of_a_block_is_what_it_adds() {
    let linuxcnc = machine(HEAVY, "").replace("grbl", "linuxcnc");
    for file in [machine(HEAVY, ""), linuxcnc] {
        let stops = |line: &str| {
            if line.starts_with("G1") || line.starts_with("G0") { format!("{line}\nG4 P0.1") } else { line.to_owned() }
        };
        let lines: Vec<String> =
            zigzag().lines().flat_map(|line| stops(line).lines().map(str::to_owned).collect::<Vec<_>>()).collect();
        let blocks = block_times(&lines.join("\n"), &file);
        let until = |count: usize| times(&format!("{}\nM2\n", lines[..count].join("\n")), &file).whole();
        for (at, line) in lines
            .iter()
            .enumerate()
            .filter(|(_, line)| line.starts_with("G1") || line.starts_with("G4") || line.starts_with("G0"))
        {
            let own = blocks.iter().find(|(of, _)| *of as usize == at + 1).map_or(0.0, |(_, seconds)| *seconds);
            let added = until(at + 1) - until(at);
            assert!((own - added).abs() < 1e-4, "{file}{line}: {own} {added}");
        }
    }
}

fn square() -> String {
    "G21 G90 G94\nG0 X0 Y0 Z0\nG1 X50 F3000\nY50\nX0\nY0\nM2\n".into()
}

/// A circle as 200 lines, a circle by G2, and a small circle.
fn circle() -> String {
    let mut text = String::from("G21 G90 G94\nG0 X0 Y0 Z0\nG0 X20 Y0\n");
    for part in 1..=200 {
        let (sine, cosine) = (std::f64::consts::TAU * f64::from(part) / 200.0).sin_cos();
        _ = writeln!(text, "G1 X{:.4} Y{:.4} F6000", 20.0 * cosine, 20.0 * sine);
    }
    text + "G2 X20 Y0 I-20 J0 F6000\nG3 X20 Y0 I-1 J0 F2000\nM2\n"
}

/// Corners of 90 degrees. After every twenty there is a slow move down, a dwell and a rapid.
fn zigzag() -> String {
    let mut text = String::from("G21 G90 G94\nG0 X0 Y0 Z0\nG0 X0 Y0 Z5\n");
    for step in 0..60 {
        _ = writeln!(text, "G1 X{} Y{} F4000", (step + 1) * 2, if step % 2 == 0 { 2 } else { 0 });
        if step % 20 == 19 {
            text += "G0 Z2\nG4 P0.5\nG1 Z1 F200\nG0 Z5\n";
        }
    }
    text + "M2\n"
}

#[test]
fn times_are_those_of_grbls_planner() {
    let recorded = [(square(), [4.3525, 7.8452]), (circle(), [3.6225, 11.2841]), (zigzag(), [11.0994, 30.9006])];
    for (program, seconds) in recorded {
        for (axes, seconds) in [ROUTER, HEAVY].into_iter().zip(seconds) {
            let own = times(&program, &machine(axes, "")).whole();
            assert!((own - seconds).abs() < 2e-4, "{own} instead of {seconds}:\n{}", &program[..80]);
        }
    }
}

/// Programs and their times in each mode, from LinuxCNC 2.9's own simulator. A time is a number of periods of the servo
/// thread, from the first motion to the last. X and Y have 500 mm/s2 and 8000 mm/min, Z has 250 mm/s2 and 3000 mm/min.
/// A period is 1 ms. The simulator ends each stop with a whole period, so the times differ by a few periods.
#[test]
fn times_are_those_of_linuxcncs_simulator() {
    let folder = root().join("tests/data/times");
    let table = std::fs::read_to_string(folder.join("linuxcnc.tsv")).unwrap();
    let mut lines = table.lines().map(|line| line.split('\t').collect::<Vec<_>>());
    let modes = lines.next().unwrap();
    let file = machine(ROUTER, "").replace("grbl", "linuxcnc");
    let mut wrong = Vec::new();
    let mut count = 0;
    for row in lines {
        let text = std::fs::read_to_string(folder.join(row[0])).unwrap();
        for (mode, seconds) in modes.iter().zip(&row).skip(1) {
            let seconds: f64 = seconds.parse().unwrap();
            let program = format!("G21 G90\nG0 X0 Y0 Z0\n{mode}\n{text}\nM2\n");
            let own = times(&program, &file).whole();
            count += 1;
            if (own - seconds).abs() > (seconds * 0.03).max(0.02) {
                wrong.push(format!("{} {mode}: {own:.3} instead of {seconds}", row[0]));
            }
        }
    }
    assert!(count > 90 && wrong.is_empty(), "{count} {wrong:#?}");
}

const ACCELERATIONS: [f64; 3] = [500.0, 300.0, 100.0];

/// The greatest acceleration along a direction.
fn limit(way: [f64; 3]) -> f64 {
    let length = way.iter().map(|part| part * part).sum::<f64>().sqrt();
    (0..3).map(|axis| ACCELERATIONS[axis] * length / way[axis].abs()).fold(f64::INFINITY, f64::min)
}

/// The time in seconds, computed from the formulas alone, in two passes over all legs. The speed is limited by the
/// corners and by the legs before and after.
fn two_passes(ways: &[([f64; 3], f64)], deviation: f64) -> f64 {
    let length = |way: &[f64; 3]| way.iter().map(|part| part * part).sum::<f64>().sqrt();
    let mut speeds = vec![0.0f64; ways.len() + 1];
    for at in 1..ways.len() {
        let [(before, slow), (after, fast)] = [ways[at - 1], ways[at]];
        let [before, after] = [before, after].map(|way| way.map(|part| part / length(&way)));
        let turn: f64 = (0..3).map(|axis| before[axis] * after[axis]).sum();
        // half of the angle between the legs
        let sine = ((1.0 + turn) / 2.0).sqrt();
        let inwards = std::array::from_fn(|axis| after[axis] - before[axis]);
        let corner = match turn {
            turn if turn > 0.999_999 => f64::INFINITY,
            turn if turn < -0.999_999 => 0.0,
            _ => limit(inwards) * deviation * sine / (1.0 - sine),
        };
        speeds[at] = corner.sqrt().min(slow).min(fast);
    }
    let reach = |speed: f64, way: &[f64; 3]| (speed * speed + 2.0 * limit(*way) * length(way)).sqrt();
    for at in 0..ways.len() {
        speeds[at + 1] = speeds[at + 1].min(reach(speeds[at], &ways[at].0));
    }
    for at in (0..ways.len()).rev() {
        speeds[at] = speeds[at].min(reach(speeds[at + 1], &ways[at].0));
    }
    let mut seconds = 0.0;
    for (at, (way, feed)) in ways.iter().enumerate() {
        let (from, to, length, acceleration) = (speeds[at], speeds[at + 1], length(way), limit(*way));
        let peak = feed.min(((2.0 * acceleration * length + from * from + to * to) / 2.0).sqrt());
        let ramps = (2.0 * peak * peak - from * from - to * to) / (2.0 * acceleration);
        seconds += (2.0 * peak - from - to) / acceleration + (length - ramps).max(0.0) / peak;
    }
    seconds
}

proptest! {
    #[test]
    fn a_planner_that_sees_all_is_as_fast_as_two_passes(
        ways in prop::collection::vec((prop::array::uniform3(-20i32..=20), 1u32..=2000), 1..60),
    ) {
        let ways: Vec<([f64; 3], f64)> = ways
            .into_iter()
            .filter(|(way, _)| *way != [0; 3])
            .map(|(way, feed)| (way.map(|part| f64::from(part) / 10.0), f64::from(feed) / 10.0))
            .collect();
        let mut axes = [AxisRates { rapid: Some(1e6), feed: None, acceleration: None }; 6];
        (0..3).for_each(|axis| axes[axis].acceleration = Some(ACCELERATIONS[axis]));
        let mut planner = Planner::new(Rates { axes, corner: Corner::Deviation(0.01), ahead: 1000 });
        for ([x, y, z], feed) in &ways {
            planner.cut(&[*x, *y, *z, 0.0, 0.0, 0.0], *feed);
        }
        let (own, other) = (planner.take().cutting, two_passes(&ways, 0.01));
        prop_assert!((own - other).abs() < 1e-9 * other.max(1.0), "{own} {other}");
    }

    /// A control that plans fewer blocks ahead is never faster.
    #[test]
    fn less_ahead_is_not_faster(ways in prop::collection::vec((-20i32..=20, -20i32..=20), 1..80), ahead in 1usize..20) {
        let axes = [AxisRates { rapid: Some(100.0), feed: None, acceleration: Some(300.0) }; 6];
        let seconds = |ahead: usize| {
            let mut planner = Planner::new(Rates { axes, corner: Corner::Deviation(0.01), ahead });
            for (x, y) in &ways {
                planner.rapid(&[f64::from(*x) / 50.0, f64::from(*y) / 50.0, 0.0, 0.0, 0.0, 0.0]);
            }
            planner.take().rapid
        };
        let (all, some, one) = (seconds(1000), seconds(ahead), seconds(1));
        prop_assert!(all <= some + 1e-9 && some <= one + 1e-9, "{all} {some} {one}");
    }
}

/// Other actions take the times in the machine's file. If a time is unknown, the actions are counted and reported.
#[test]
fn dwells_tool_changes_and_the_spindle_take_their_time() {
    let file = format!("{}[spindle]\nspeed = [0, 8000]\nacceleration = 4\n[tools]\nchange = 5\n", machine(ROUTER, ""));
    let file = file.replace("grbl", "linuxcnc");
    let program = "G21 G90 G94\nG4 P1.5\nT1 M6\nS4000 M3\nS8000\nM5\nM4 S2000\nT2 M6\nM3 S1000\nM2\n";
    let times = times(program, &file);
    // the time of the first start is part of the tool change (chip to chip); the control does not wait for the spindle
    // to stop
    assert_eq!((times.dwells, times.changes, times.spindle), (1.5, 10.0, 2.0 + 1.0));
    assert_eq!(times.tools, [(None, 1.5), (Some(1), 5.0 + 3.0), (Some(2), 5.0)]);
}

/// Moves to and from machine positions have a time if the machine's file contains the offsets and reference points.
#[test]
fn the_way_home_counts_where_it_is_known() {
    let file = machine(ROUTER, "[reference]\nG28 = [0, 0, 0]\n[offsets]\nG54 = [-300, -200, -100]\n");
    let program = "G21 G90 G94 G54\nG53 G0 X0 Y0 Z0\nG0 Z50\nG28 G91 Z0\nM2\n";
    let known = times(program, &file);
    let way = |length: f64, acceleration: f64, speed: f64| length / speed + speed / acceleration;
    // the first move has no time, because its start is unknown; then 50 mm down, and up
    assert_eq!(known.unplaced, 1);
    assert!((known.rapid - 2.0 * way(50.0, 250.0, 50.0)).abs() < 1e-9, "{known:?}");
    let unknown = times(program, &machine(ROUTER, ""));
    assert_eq!((unknown.rapid, unknown.unplaced), (0.0, 3), "{unknown:?}");
}

#[test]
fn a_header_has_the_time_with_accelerations() {
    let folder = Folder::new("times");
    folder.write("job.json", std::fs::read(root().join("samples/plate/job.json")).unwrap());
    let form = std::fs::read_to_string(root().join("postforms/linuxcnc.pf")).unwrap();
    folder.write("post.pf", form.replacen("StartCode\n%0\n", "StartCode\n%0\n(CUTTING [cuttime])\n", 1));
    folder.write("fast.toml", machine([[5000.0, 30000.0]; 2], ""));
    folder.write("slow.toml", machine([[5.0, 30000.0]; 2], ""));
    let minutes = |more: &[&str]| {
        let run = folder.run(&[&["render", "job.json", "--form", "post.pf", "--no-verify", "--quiet"], more].concat());
        let text = out(&run);
        let line = text.lines().find(|line| line.contains("CUTTING")).unwrap_or_else(|| panic!("{text}"));
        line.split(' ').next_back().unwrap().trim_end_matches(')').parse::<f64>().unwrap()
    };
    let (programmed, fast, slow) =
        (minutes(&[]), minutes(&["--machine", "fast.toml"]), minutes(&["--machine", "slow.toml"]));
    assert!(programmed < fast && fast < programmed * 1.05 && slow > fast * 1.1, "{programmed} {fast} {slow}");
}
