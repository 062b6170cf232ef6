//! Writes actions as JSON Lines.

use super::action::{Action, Item};
use super::state::State;
use crate::toolpath::{Direction, Plane, StopKind};

/// Writes an action as a JSON object and a line end. Some actions, such as comments, are not written. `state`: the
/// state of the control after the block, which has the names of tools. If `unknown` is
/// set, unknown positions are written as null.
pub fn json_line(item: &Item, state: &State, unknown: bool, out: &mut Vec<u8>) {
    let hidden = |machine: u8| if unknown { machine } else { 0 };
    let start = out.len();
    out.extend_from_slice(b"{\"line\":");
    out.extend_from_slice(itoa::Buffer::new().format(item.line).as_bytes());
    match &item.action {
        Action::Rapid { to, machine, .. } => {
            list(b",\"rapid\":[", to, hidden(*machine), out);
            if *machine != 0 && !unknown {
                in_machine(*machine, out);
            }
        }
        Action::Feed { to, feed, lead, machine, home } => {
            list(b",\"feed\":[", to, hidden(*machine), out);
            if *home != 0 && !unknown {
                in_machine(*home, out);
            }
            match lead {
                Some(lead) => number(b",\"lead\":", *lead, out),
                None => number(b",\"f\":", *feed, out),
            }
        }
        Action::Arc(turn) => {
            list(b",\"arc\":[", &turn.to, hidden(turn.machine), out);
            list(b",\"center\":[", &turn.center, 0, out);
            name(b",\"plane\":\"", plane_name(turn.plane), out);
            name(b",\"turn\":\"", turn_name(turn.direction), out);
            if turn.turns > 0 {
                number(b",\"turns\":", f64::from(turn.turns), out);
            }
            number(b",\"f\":", turn.feed, out);
        }
        Action::Dwell(seconds) => number(b",\"dwell\":", *seconds, out),
        Action::Spindle(rotation, speed) => {
            name(b",\"spindle\":\"", rotation.name(), out);
            number(b",\"s\":", *speed, out);
        }
        Action::Orient(angle) => number(b",\"orient\":", angle.unwrap_or(0.0), out),
        Action::Stop(kind) => name(b",\"stop\":\"", stop_name(*kind), out),
        Action::End => name(b",\"stop\":\"", "end", out),
        Action::Tool(tool) => match state.tool_name(*tool) {
            Some(called) => {
                out.extend_from_slice(b",\"tool\":");
                out.extend_from_slice(serde_json::Value::from(&*called).to_string().as_bytes());
            }
            None => number(b",\"tool\":", *tool, out),
        },
        Action::Coolant(kind) => name(b",\"coolant\":\"", kind.name(), out),
        Action::Units(units) => name(b",\"units\":\"", units.name(), out),
        Action::Work(code) => number(b",\"work\":", *code, out),
        _ => {
            out.truncate(start);
            return;
        }
    }
    out.extend_from_slice(b"}\n");
}

/// Writes the letters of the axes that are at a machine position.
fn in_machine(axes: u8, out: &mut Vec<u8>) {
    out.extend_from_slice(b",\"machine\":\"");
    out.extend((0..6).filter(|axis| axes & 1 << axis != 0).map(|axis| b"xyzabc"[axis]));
    out.push(b'"');
}

/// Writes a list of numbers. Numbers whose bit in `unknown` is set are written as null.
fn list(before: &[u8], values: &[f64], unknown: u8, out: &mut Vec<u8>) {
    out.extend_from_slice(before);
    for (i, value) in values.iter().enumerate() {
        let comma: &[u8] = if i == 0 { b"" } else { b"," };
        if unknown & 1 << i == 0 {
            number(comma, *value, out);
        } else {
            out.extend_from_slice(comma);
            out.extend_from_slice(b"null");
        }
    }
    out.push(b']');
}

/// Writes a number with enough digits to read back the same double.
fn number(before: &[u8], value: f64, out: &mut Vec<u8>) {
    out.extend_from_slice(before);
    if value.fract() == 0.0 && value.abs() < 1e15 {
        out.extend_from_slice(itoa::Buffer::new().format(value as i64).as_bytes());
    } else {
        out.extend_from_slice(zmij::Buffer::new().format_finite(value).as_bytes());
    }
}

fn name(before: &[u8], value: &str, out: &mut Vec<u8>) {
    out.extend_from_slice(before);
    out.extend_from_slice(value.as_bytes());
    out.push(b'"');
}

/// Name of a plane: the letters of its axes in the order of the plane.
pub fn plane_name(plane: Plane) -> &'static str {
    match plane {
        Plane::Xy => "xy",
        Plane::Xz => "zx",
        Plane::Yz => "yz",
    }
}

/// Name of the direction of an arc.
pub fn turn_name(direction: Direction) -> &'static str {
    if direction == Direction::Cw { "cw" } else { "ccw" }
}

/// Name of a stop.
pub fn stop_name(kind: StopKind) -> &'static str {
    if kind == StopKind::Program { "program" } else { "optional" }
}
