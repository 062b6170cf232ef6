//! Programs with the results of Grbl 1.1h's own parser. The simulator must make the same motions, and stop at the same
//! refused block.

use std::fs;
use std::io::Cursor;

use crate::support::{check_file, control, job, render_checked, render_sample, root, sample_form, samples};
use postform::internals::control::Control;
use postform::internals::nc::{Action, Item, Position, Rotation, RunError, RunSettings, Simulator, Turn};
use postform::toolpath::{Coolant, Direction, FeedMode, Plane, Units};
use serde_json::Value;

/// An action, in millimetres and machine coordinates.
#[derive(Clone, Debug, PartialEq)]
enum Done {
    Rapid([f64; 3]),
    /// End and feed; true: G93 (inverse time).
    Feed([f64; 3], f64, bool),
    /// End, centre relative to the start, angle in degrees (negative: clockwise), feed.
    Arc([f64; 3], [f64; 3], f64, f64, bool),
    Dwell(f64),
    Pause,
    End,
    /// The state of spindle and coolant after a line.
    Spindle(Rotation, f64),
    Coolant(bool, bool),
}

fn is_near(ours: f64, theirs: f64) -> bool {
    (ours - theirs).abs() <= 0.001 + 1e-6 * theirs.abs()
}

impl Done {
    fn is(&self, other: &Done) -> bool {
        let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| is_near(*a, *b));
        match (self, other) {
            (Done::Rapid(a), Done::Rapid(b)) => near(a, b),
            // the feed of a probe was not recorded
            (Done::Feed(a, ..), Done::Feed(b, g, _)) if g.is_nan() => near(a, b),
            (Done::Feed(a, f, m), Done::Feed(b, g, n)) => near(a, b) && is_near(*f, *g) && m == n,
            (Done::Arc(a, c, s, f, m), Done::Arc(b, d, t, g, n)) => {
                near(a, b) && near(c, d) && (s - t).abs() <= 0.05 && is_near(*f, *g) && m == n
            }
            (Done::Dwell(a), Done::Dwell(b)) => is_near(*a, *b),
            (Done::Spindle(a, s), Done::Spindle(b, t)) => a == b && is_near(*s, *t),
            (a, b) => a == b,
        }
    }
}

/// The actions with their lines; and the refused line, if there is one, with Grbl's error number.
type Ended = (Vec<(u64, Done)>, Option<(u64, u64)>);

/// The state of a run between two lines.
struct Run {
    simulator: Simulator<'static>,
    scale: f64,
    at: [f64; 3],
    /// The program zero at the end of the previous line.
    frame: [f64; 3],
    mode: FeedMode,
    spindle: Done,
    coolant: (bool, bool),
    done: Vec<(u64, Done)>,
}

impl Run {
    fn new(program: &str, control: &'static Control) -> Run {
        Run {
            simulator: Simulator::new(Cursor::new(program.as_bytes().to_vec()), RunSettings::new(control)),
            scale: 1.0,
            at: [0.0; 3],
            frame: [0.0; 3],
            mode: FeedMode::PerMinute,
            spindle: spindle(Rotation::Stop, 0.0),
            coolant: (false, false),
            done: Vec::new(),
        }
    }

    /// Runs all lines. Returns the actions and the refused line.
    fn all(mut self) -> Ended {
        loop {
            let mut items = Vec::new();
            let step = self.simulator.step(&mut items);
            self.take(&items);
            match step {
                Ok(true) => {}
                Ok(false) => return (self.done, None),
                Err(RunError::Refused(diag, line)) => {
                    let number = diag.message.split("error:").nth(1).and_then(|rest| rest.split(')').next());
                    return (self.done, Some((line, number.and_then(|n| n.parse().ok()).unwrap_or(0))));
                }
                Err(RunError::Io(error)) => panic!("{error}"),
            }
        }
    }

    /// Handles the actions of a line. The frame at the end of the line applies to the moves, except to moves before a
    /// change of the frame.
    fn take(&mut self, items: &[Item]) {
        let (mut turning, mut coolant, line) = (self.spindle.clone(), self.coolant, self.simulator.line());
        let frame = self.frame();
        let is_frame = |item: &Item| matches!(item.action, Action::Frame | Action::Work(_));
        let reframed = items.iter().rposition(is_frame);
        for (i, item) in items.iter().enumerate() {
            // G92.1 and M2 change the frame after the move
            let before = reframed.is_some_and(|at| i < at);
            let frame = if before { self.frame } else { frame };
            match &item.action {
                Action::Units(units) => self.scale = if *units == Units::Inch { 25.4 } else { 1.0 },
                Action::FeedMode(mode) => self.mode = *mode,
                Action::Rapid { to, .. } => {
                    let to = self.place(to, frame);
                    self.done.push((line, Done::Rapid(to)));
                }
                Action::Feed { to, feed, .. } => {
                    let (to, feed, inverse) =
                        (self.place(to, frame), self.feed(*feed), self.mode == FeedMode::InverseTime);
                    self.done.push((line, Done::Feed(to, feed, inverse)));
                }
                Action::Arc(turn) => self.arc(turn, frame, line),
                Action::Dwell(seconds) => self.done.push((line, Done::Dwell(*seconds))),
                Action::Stop(_) => self.done.push((line, Done::Pause)),
                Action::End => {
                    (turning, coolant) = (spindle(Rotation::Stop, 0.0), (false, false));
                    (self.spindle, self.coolant) = (turning.clone(), coolant);
                    self.done.push((line, Done::End));
                }
                Action::Spindle(rotation, speed) => turning = spindle(*rotation, *speed),
                Action::Coolant(Coolant::FLOOD) => coolant.0 = true,
                Action::Coolant(Coolant::MIST) => coolant.1 = true,
                Action::Coolant(_) => coolant = (false, false),
                _ => {}
            }
        }
        self.frame = self.frame();
        let at = *self.simulator.state().position();
        self.place(&at, self.frame);
        if turning != self.spindle {
            self.spindle = turning.clone();
            self.done.push((line, turning));
        }
        if coolant != self.coolant {
            self.coolant = coolant;
            self.done.push((line, Done::Coolant(coolant.0, coolant.1)));
        }
    }

    /// The position of the program zero in millimetres.
    fn frame(&self) -> [f64; 3] {
        let zero = self.simulator.state().in_machine_coordinates(&[0.0; 6]);
        let inch = self.simulator.state().units() == Units::Inch;
        [0, 1, 2].map(|axis| zero[axis] * if inch { 25.4 } else { 1.0 })
    }

    fn place(&mut self, to: &Position, frame: [f64; 3]) -> [f64; 3] {
        self.at = [0, 1, 2].map(|axis| to[axis] * self.scale + frame[axis]);
        self.at
    }

    fn feed(&self, feed: f64) -> f64 {
        if self.mode == FeedMode::InverseTime { feed } else { feed * self.scale }
    }

    fn arc(&mut self, turn: &Turn, frame: [f64; 3], line: u64) {
        let from = self.at;
        let center = [0, 1, 2].map(|axis| turn.center[axis] * self.scale + frame[axis]);
        let to = self.place(&turn.to, frame);
        let axes = match turn.plane {
            Plane::Xy => [0, 1, 2],
            Plane::Xz => [2, 0, 1],
            Plane::Yz => [1, 2, 0],
        };
        let mut offset = [0, 1, 2].map(|axis| center[axis] - from[axis]);
        offset[axes[2]] = 0.0;
        let angle = |at: &[f64]| (at[axes[1]] - center[axes[1]]).atan2(at[axes[0]] - center[axes[0]]).to_degrees();
        let sign = if turn.direction == Direction::Ccw { 1.0 } else { -1.0 };
        let part = (sign * (angle(&to) - angle(&from))).rem_euclid(360.0);
        let sweep = if (1e-4..=360.0 - 1e-4).contains(&part) { part } else { 360.0 };
        let inverse = self.mode == FeedMode::InverseTime;
        self.done.push((line, Done::Arc(to, offset, sign * sweep, self.feed(turn.feed), inverse)));
    }
}

/// The recorded actions of Grbl, with the state of spindle and coolant after each line.
fn recorded(case: &Value) -> Vec<(u64, Done)> {
    let mut list: Vec<(u64, Done)> = Vec::new();
    let mut switches: Vec<(u64, Done)> = Vec::new();
    let mut line = 0;
    for action in case["actions"].as_array().unwrap() {
        let three = |key: &str| [0, 1, 2].map(|axis| action[key][axis].as_f64().unwrap());
        let number = |key: &str| action[key].as_f64().unwrap();
        let inverse = action["mode"] == "inverse";
        let now = action["line"].as_u64().unwrap();
        if now != line {
            list.append(&mut switches);
            line = now;
        }
        let done = match action["do"].as_str().unwrap() {
            "rapid" => Done::Rapid(three("to")),
            "feed" => Done::Feed(three("to"), number("f"), inverse),
            "probe" => Done::Feed(three("to"), f64::NAN, inverse),
            "arc" => {
                let sign = if action["dir"] == "cw" { -1.0 } else { 1.0 };
                let mut offset = three("offset");
                offset[["G19", "G18", "G17"].iter().position(|plane| action["plane"] == *plane).unwrap()] = 0.0;
                Done::Arc(three("to"), offset, sign * number("sweep"), number("f"), inverse)
            }
            "dwell" => Done::Dwell(number("s")),
            "pause" => Done::Pause,
            "end" => Done::End,
            "spindle" => {
                switches.retain(|(_, done)| !matches!(done, Done::Spindle(..)));
                let rotation = match action["dir"].as_str().unwrap() {
                    "cw" => Rotation::Cw,
                    "ccw" => Rotation::Ccw,
                    _ => Rotation::Stop,
                };
                switches.push((now, spindle(rotation, action["rpm"].as_f64().unwrap_or(0.0))));
                continue;
            }
            "coolant" => {
                switches.retain(|(_, done)| !matches!(done, Done::Coolant(..)));
                switches.push((now, Done::Coolant(action["flood"] == true, action["mist"] == true)));
                continue;
            }
            "tool" => continue,
            other => panic!("{other}"),
        };
        list.push((now, done));
    }
    list.append(&mut switches);
    list
}

/// A stopped spindle has speed 0.
fn spindle(rotation: Rotation, speed: f64) -> Done {
    Done::Spindle(rotation, if rotation == Rotation::Stop { 0.0 } else { speed })
}

/// A control like Grbl with mist coolant, which some builds of Grbl have.
fn with_mist() -> &'static Control {
    let text = "name = \"mist\"\nlike = \"grbl\"\n[coolant]\nmist = true\n";
    Box::leak(Box::new(Control::read("mist.toml", text).unwrap()))
}

/// The difference between a case and the simulator, if there is one.
fn difference(case: &Value, control: &'static Control) -> Option<String> {
    let (ours, refused) = Run::new(case["program"].as_str().unwrap(), control).all();
    let error = &case["error"];
    let expected = error["code"].as_u64().map(|code| (error["line"].as_u64().unwrap(), code));
    if refused != expected {
        return Some(format!("refused {refused:?} instead of {expected:?}"));
    }
    let theirs = recorded(case);
    let same = |(a, b): (&(u64, Done), &(u64, Done))| a.0 == b.0 && a.1.is(&b.1);
    let at = ours.iter().zip(&theirs).position(|pair| !same(pair)).unwrap_or(ours.len().min(theirs.len()));
    (ours.len() != theirs.len() || at < ours.len())
        .then(|| format!("action {at}: {:?} instead of {:?}", ours.get(at), theirs.get(at)))
}

#[test]
fn programs_do_what_grbl_does() {
    let text = fs::read_to_string(root().join("tests/data/grbl/cases.json")).unwrap();
    let cases: Vec<Value> = serde_json::from_str(&text).unwrap();
    let (grbl, mist) = (Control::named("grbl").unwrap(), with_mist());
    let wrong: Vec<String> = cases
        .iter()
        .filter_map(|case| {
            let control = if case["build"] == "m7" { mist } else { grbl };
            let difference = difference(case, control)?;
            Some(format!("{} ({}): {difference}\n{}", case["id"], case["note"], case["program"]))
        })
        .collect();
    println!("{} of {} programs agree with Grbl", cases.len() - wrong.len(), cases.len());
    assert!(wrong.is_empty(), "{} of {} differ\n{}", wrong.len(), cases.len(), wrong.join("\n"));
    assert!(cases.len() >= 449);
}

/// The Grbl post prints the samples. If it can't print a sample, the error must be an error of the job.
#[test]
fn grbl_takes_every_sample_that_its_post_prints() {
    let form = root().join("postforms/grbl.pf");
    let mut taken = 0;
    for folder in samples() {
        // a form for a lathe has other axes
        let mill = sample_form(&folder)
            .is_none_or(|form| check_file(&form).form.settings.machine == postform::internals::lang::Machine::Mill);
        let Some(rendered) = mill.then(|| render_sample(&folder, &form).ok()).flatten() else { continue };
        let (_, refused) = Run::new(&rendered.text, Control::named("grbl").unwrap()).all();
        assert_eq!(refused, None, "{}\n{}", folder.display(), rendered.text);
        taken += 1;
    }
    assert!(taken >= 40, "{taken}");
}

/// If Grbl has no code for an item of the job, the error explains the alternative.
#[test]
fn what_grbl_lacks_is_an_error_of_the_job() {
    let form = check_file(&root().join("postforms/grbl.pf"));
    let rendered =
        |text: &str| render_checked(&form, text.as_bytes(), false, postform::internals::render::Options::default());
    let start = r#"{"rapid":[0,0,5]},{"rapid":[0,0,-1]}"#;
    let bore = r#"{"cycle":{"kind":"bore","depth":1,"orient":0,"offset":0.1,"clear":1,"feed":5,"points":[[1,1,0]]}}"#;
    let tap = r#"{"cycle":{"kind":"tap","rigid":true,"depth":1,"clear":1,"feed":5,"points":[[1,1,0]]}}"#;
    let per_turn = job(start).replacen(r#""tool""#, r#""feed_mode":"per_rev","tool""#, 2);
    let cases = [
        (job(&format!(r#"{start},{{"infeed":[1,1],"side":"left","feed":5}}"#)), "cutter compensation"),
        (job(&format!("{start},{bore}")), "a stop of the spindle at an angle"),
        (job(&format!("{start},{tap}")), "a rigid tap"),
        (job(&format!(r#"{start},{{"rapid":[0,0,5,90]}}"#)), "no axis A"),
        (per_turn, "a feed per revolution"),
    ];
    for (text, what) in cases {
        let diag = rendered(&text).unwrap_err();
        assert!(diag.message.contains(what) && diag.help.is_some(), "{what}: {diag:?}\n{text}");
    }
    assert!(rendered(&job(start)).is_ok());
}

/// Grbl accepts a program without an end code, and the spindle keeps turning. The simulator gives a warning.
#[test]
fn a_spindle_without_an_end_is_told() {
    let warned = |program: &str| {
        let mut simulator = Simulator::new(Cursor::new(program.to_owned()), RunSettings::new(control("grbl")));
        let mut items = Vec::new();
        while simulator.step(&mut items).unwrap() {}
        simulator.take_warnings().iter().map(|diag| diag.code.name().to_owned()).collect::<Vec<String>>()
    };
    assert_eq!(warned("G21\nS1000 M3\nG1 X1 F100\n"), ["PN037"]);
    assert!(warned("G21\nS1000 M3\nG1 X1 F100\nM5\n").is_empty());
    assert!(warned("G21\nS1000 M3\nG1 X1 F100\nM2\n").is_empty());
}
