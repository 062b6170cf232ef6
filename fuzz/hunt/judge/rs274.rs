//! LinuxCNC's own interpreter as a second judge. The interpreter runs as a separate program, if it is installed.

use std::fs;
use std::path::Path;
use std::process::Command;

use super::machine::{Act, State, What};
use super::{INCH, Place};

/// Height of the work zero in machine coordinates, in millimetres; the home position is above the work zero.
const BELOW: f64 = -500.0;

/// The acts of the interpreter for a program; `None` if the interpreter is not installed. The files of the interpreter
/// are written to `folder`.
pub fn interpreted(program: &str, folder: &Path) -> Option<Result<Vec<Act>, String>> {
    let [path, table, parameters] = ["judged.ngc", "judged.tbl", "judged.var"].map(|name| folder.join(name));
    let tools: String = (1..60).map(|n| format!("T{n} P{n} Z0 D0.0001\n")).collect();
    fs::write(&path, program)
        .and_then(|()| fs::write(&table, tools))
        .and_then(|()| fs::write(&parameters, offsets()))
        .ok()?;
    let output = Command::new("rs274")
        .args([
            "-v".as_ref(),
            parameters.as_os_str(),
            "-t".as_ref(),
            table.as_os_str(),
            "-g".as_ref(),
            path.as_os_str(),
        ])
        .env("HOME", folder)
        .current_dir(folder)
        .output()
        .ok()?;
    let calls = String::from_utf8_lossy(&output.stdout).into_owned();
    if !calls.contains("PROGRAM_END()") {
        return Some(Err(String::from_utf8_lossy(&output.stderr).trim().to_owned()));
    }
    Some(Ok(acts(&calls)))
}

/// The parameter file of the interpreter: all values are zero except the heights of the work offsets.
fn offsets() -> String {
    let mut text = String::new();
    let axes = |text: &mut String, first: u32, z: f64| {
        for axis in 0..9 {
            *text += &format!("{} {}\n", first + axis, if axis == 2 { z } else { 0.0 });
        }
    };
    axes(&mut text, 5161, 0.0);
    axes(&mut text, 5181, 0.0);
    text += "5210 0\n";
    axes(&mut text, 5211, 0.0);
    text += "5220 1\n";
    for system in 0..9 {
        axes(&mut text, 5221 + 20 * system, BELOW);
        text += &format!("{} 0\n", 5230 + 20 * system);
    }
    text
}

/// Converts the canonical calls of the interpreter to acts.
fn acts(calls: &str) -> Vec<Act> {
    let mut scale = 1.0;
    let mut at: Place = [f64::NAN, f64::NAN, f64::NAN, 0.0, 0.0, 0.0];
    let mut state = State { direction: 5.0, side: (40.0, 0.0), feed: (f64::NAN, 94.0), work: 54.0, ..State::default() };
    let mut plane = 17.0;
    let mut pitch = 0.0;
    let mut acts = Vec::new();
    for line in calls.lines() {
        let Some((head, rest)) = line.split_once('(') else { continue };
        let name = head.rsplit(' ').next().unwrap_or("");
        let numbers: Vec<f64> = rest.split([',', ')', ' ']).filter_map(|n| n.trim().parse().ok()).collect();
        let number = |at: usize| numbers.get(at).copied().unwrap_or(0.0);
        let mut to = at;
        let what = match name {
            "USE_LENGTH_UNITS" => {
                scale = if rest.contains("INCHES") { INCH } else { 1.0 };
                continue;
            }
            "STRAIGHT_TRAVERSE" | "STRAIGHT_FEED" => {
                for (axis, place) in to.iter_mut().enumerate() {
                    *place = number(axis) * if axis < 3 { scale } else { 1.0 };
                }
                if name == "STRAIGHT_FEED" { What::Feed } else { What::Rapid }
            }
            "ARC_FEED" => {
                let [first, second, third] = match plane {
                    18.0 => [2, 0, 1],
                    19.0 => [1, 2, 0],
                    _ => [0, 1, 2],
                };
                to[first] = number(0) * scale;
                to[second] = number(1) * scale;
                to[third] = number(5) * scale;
                let turns = number(4);
                What::Arc {
                    plane,
                    center: [number(2) * scale, number(3) * scale],
                    ccw: turns > 0.0,
                    turns: turns.abs() - 1.0,
                }
            }
            "SELECT_PLANE" => {
                plane = if rest.contains("XZ") {
                    18.0
                } else if rest.contains("YZ") {
                    19.0
                } else {
                    17.0
                };
                continue;
            }
            "START_SPEED_FEED_SYNC" => {
                pitch = number(0) * scale;
                continue;
            }
            // down in step with the spindle, and back up to the start
            "RIGID_TAP" => {
                for (axis, place) in to.iter_mut().enumerate().take(3) {
                    *place = number(axis) * scale;
                }
                let state = State { feed: (pitch * state.speed, 94.0), ..state };
                acts.push(Act { line: 0, what: What::Feed, from: at, to, state });
                acts.push(Act { line: 0, what: What::Feed, from: to, to: at, state });
                continue;
            }
            "ORIENT_SPINDLE" => {
                state.direction = 5.0;
                What::Orient(number(1))
            }
            "DWELL" => What::Dwell(number(0)),
            "PROGRAM_STOP" => What::Stop(0.0),
            "OPTIONAL_PROGRAM_STOP" => What::Stop(1.0),
            "PROGRAM_END" => What::End,
            "CHANGE_TOOL" => {
                state.tool = number(0);
                at[2] = f64::NAN;
                to = at;
                What::Tool
            }
            "SET_FEED_RATE" => {
                state.feed.0 = number(0) * scale;
                continue;
            }
            "SET_FEED_MODE" => {
                state.feed.1 = if number(1) == 1.0 { 95.0 } else { 94.0 };
                continue;
            }
            "SET_SPINDLE_SPEED" => {
                state.speed = number(1);
                continue;
            }
            "MIST_ON" | "MIST_OFF" => {
                state.coolant = (state.coolant & 2) | u8::from(name == "MIST_ON");
                continue;
            }
            "FLOOD_ON" | "FLOOD_OFF" => {
                state.coolant = (state.coolant & 1) | (2 * u8::from(name == "FLOOD_ON"));
                continue;
            }
            "START_SPINDLE_CLOCKWISE" => {
                state.direction = 3.0;
                continue;
            }
            "START_SPINDLE_COUNTERCLOCKWISE" => {
                state.direction = 4.0;
                continue;
            }
            "STOP_SPINDLE_TURNING" => {
                state.direction = 5.0;
                continue;
            }
            "SET_G5X_OFFSET" => {
                state.work = 53.0 + number(0);
                continue;
            }
            _ => continue,
        };
        acts.push(Act { line: 0, what, from: at, to, state });
        at = to;
    }
    acts
}
