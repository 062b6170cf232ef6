//! Runs programs in the simulator and in LinuxCNC's interpreter, and gives both results in the same form.
#![allow(dead_code)]

use std::ffi::OsStr;
use std::fs;
use std::io::Cursor;
use std::path::Path;
use std::process::{Command, Output};
use std::sync::Mutex;

use postform::internals::nc::{Action, Item, Rotation, RunError, RunSettings, Simulator};

/// Writes files, and runs LinuxCNC's interpreter on them. Only one interpreter runs at a time, because it keeps its
/// tool table in the home folder.
pub fn rs274(files: &[(&Path, &str)], arguments: &[&OsStr]) -> Output {
    static ONE: Mutex<()> = Mutex::new(());
    let _one = ONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    for (path, text) in files {
        fs::write(path, text).unwrap();
    }
    let home = env!("CARGO_TARGET_TMPDIR");
    Command::new("rs274").args(arguments).env("HOME", home).current_dir(home).output().unwrap()
}

/// An action of the machine, from the simulator or the interpreter.
#[derive(Clone, Debug, PartialEq)]
pub enum Call {
    Rapid([f64; 6]),
    Feed([f64; 6]),
    /// End, centre in the plane, number of turns (negative: clockwise).
    Arc([f64; 6], [f64; 2], i32),
    Dwell(f64),
    Spindle(Rotation),
    Orient,
    Stop,
    OptionalStop,
}

impl Call {
    /// Whether two actions are equal within the four decimals that the interpreter prints.
    pub fn is(&self, other: &Call) -> bool {
        let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 6e-5);
        match (self, other) {
            (Call::Rapid(a), Call::Rapid(b)) | (Call::Feed(a), Call::Feed(b)) => near(a, b),
            (Call::Arc(a, c, n), Call::Arc(b, d, m)) => near(a, b) && near(c, d) && n == m,
            (Call::Dwell(a), Call::Dwell(b)) => (a - b).abs() < 6e-5,
            (a, b) => a == b,
        }
    }
}

/// The end of a program: the refused line, if there is one.
pub type Ended = Result<(), u64>;

/// The actions of the simulator for a program.
pub fn simulated(program: &[u8], settings: RunSettings) -> (Vec<Call>, Ended, Vec<Item>) {
    let mut simulator = Simulator::new(Cursor::new(program), settings);
    let mut items = Vec::new();
    let ended = loop {
        match simulator.step(&mut items) {
            Ok(true) => {}
            Ok(false) => break Ok(()),
            Err(RunError::Refused(_, line)) => break Err(line),
            Err(RunError::Io(error)) => panic!("{error}"),
        }
    };
    let mut calls = Vec::new();
    let mut spindle = Rotation::Stop;
    for item in &items {
        calls.push(match &item.action {
            Action::Rapid { to, .. } => Call::Rapid(*to),
            Action::Feed { to, .. } => Call::Feed(*to),
            Action::Arc(turn) => {
                let [first, second] = match turn.plane {
                    postform::toolpath::Plane::Xy => [0, 1],
                    postform::toolpath::Plane::Xz => [2, 0],
                    postform::toolpath::Plane::Yz => [1, 2],
                };
                let turns = turn.turns as i32 + 1;
                let is_ccw = turn.direction == postform::toolpath::Direction::Ccw;
                Call::Arc(turn.to, [turn.center[first], turn.center[second]], if is_ccw { turns } else { -turns })
            }
            Action::Dwell(seconds) => Call::Dwell(*seconds),
            Action::Spindle(rotation, _) if *rotation != spindle => {
                spindle = *rotation;
                Call::Spindle(spindle)
            }
            Action::Orient(_) => Call::Orient,
            Action::Stop(postform::toolpath::StopKind::Program) => Call::Stop,
            Action::Stop(_) => Call::OptionalStop,
            _ => continue,
        });
    }
    (calls, ended, items)
}

/// The canonical calls of LinuxCNC's interpreter.
pub fn interpreted(canon: &str) -> Vec<Call> {
    let text = match canon.rfind("PROGRAM_END") {
        Some(end) => &canon[..canon[..end].rfind("SET_FEED_MODE").unwrap_or(end)],
        None => canon,
    };
    let mut calls = Vec::new();
    let mut spindle = Rotation::Stop;
    let mut plane = [0, 1, 2];
    let mut at = [0.0; 6];
    for line in text.lines() {
        let Some((name, rest)) = line.split_once('(') else { continue };
        let name = name.rsplit(' ').next().unwrap();
        let numbers: Vec<f64> = rest.split([',', ')']).filter_map(|n| n.trim().parse().ok()).collect();
        let six = |list: &[f64]| {
            let mut to = [0.0; 6];
            to[..list.len().min(6)].copy_from_slice(&list[..list.len().min(6)]);
            to
        };
        let turn = |now: &mut Rotation, to: Rotation| {
            let changed = *now != to;
            *now = to;
            changed.then_some(Call::Spindle(to))
        };
        let call = match name {
            "STRAIGHT_TRAVERSE" => Some(Call::Rapid(six(&numbers))),
            "STRAIGHT_FEED" => Some(Call::Feed(six(&numbers))),
            "ARC_FEED" => {
                let mut to = [0.0; 6];
                to[plane[0]] = numbers[0];
                to[plane[1]] = numbers[1];
                to[plane[2]] = numbers[5];
                to[3..].copy_from_slice(&numbers[6..9]);
                Some(Call::Arc(to, [numbers[2], numbers[3]], numbers[4] as i32))
            }
            "SELECT_PLANE" => {
                plane = if rest.contains("XZ") {
                    [2, 0, 1]
                } else if rest.contains("YZ") {
                    [1, 2, 0]
                } else {
                    [0, 1, 2]
                };
                None
            }
            "DWELL" => Some(Call::Dwell(numbers[0])),
            "START_SPINDLE_CLOCKWISE" => turn(&mut spindle, Rotation::Cw),
            "START_SPINDLE_COUNTERCLOCKWISE" => turn(&mut spindle, Rotation::Ccw),
            "STOP_SPINDLE_TURNING" => turn(&mut spindle, Rotation::Stop),
            "ORIENT_SPINDLE" => Some(Call::Orient),
            "PROGRAM_STOP" => Some(Call::Stop),
            "OPTIONAL_PROGRAM_STOP" => Some(Call::OptionalStop),
            _ => None,
        };
        if let Some(Call::Rapid(to) | Call::Feed(to) | Call::Arc(to, ..)) = &call {
            at = *to;
        }
        calls.extend(call);
        if name == "RIGID_TAP" {
            // one call moves in, moves back out, and restores the spindle
            let mut to = at;
            to[..3].copy_from_slice(&numbers[..3]);
            let turns = [Call::Spindle(spindle.reversed()), Call::Feed(at), Call::Spindle(spindle)];
            calls.extend([Call::Feed(to)].into_iter().chain(turns));
        }
    }
    calls
}

/// The first difference between two programs, for a message.
pub fn difference(ours: &[Call], theirs: &[Call]) -> Option<String> {
    let at = (0..ours.len().max(theirs.len())).find(|&i| match (ours.get(i), theirs.get(i)) {
        (Some(a), Some(b)) => !a.is(b),
        _ => true,
    })?;
    Some(format!("call {at}: ours {:?}, theirs {:?}", ours.get(at), theirs.get(at)))
}
