//! The motions that postform computes for a program, compared with those of the executor.

use std::io::Cursor;

use postform::internals::control::Control;
use postform::internals::nc::{Action, Rotation, RunError, RunSettings, Simulator, Unpointed};
use postform::internals::verify::{Motions, compare_motions};
use postform::toolpath::{Coolant, Direction, FeedMode, Side, StopKind, Units};

use super::executor::{Kind, Move, Point};

/// The settings with which postform runs a program.
pub fn settings(control: &str, inch: bool) -> RunSettings {
    let control = Control::named(control).expect("a control");
    let units = if inch { Units::Inch } else { Units::Mm };
    RunSettings { units, unpointed: Unpointed::Increments, ..RunSettings::new(control) }
}

/// The motions that postform computes for a program.
///
/// # Errors
/// The refused line, with code and message.
pub fn moves(text: &str, settings: RunSettings) -> Result<Vec<Move>, (usize, String)> {
    let mut simulator = Simulator::new(Cursor::new(text.as_bytes()), settings);
    let mut now = Move::BEGIN;
    let (mut list, mut items, mut at) = (Vec::new(), Vec::new(), [f64::NAN; 2]);
    loop {
        items.clear();
        let step = simulator.step(&mut items);
        for item in &items {
            now.line = item.line as usize;
            let here = at;
            let mut go = |kind: Kind, to: Point, feed: f64, now: &Move| {
                list.push(Move { kind, from: at, to, feed, ..*now });
                at = to;
            };
            let position = |to: &[f64; 6], machine: u8| {
                let known = |axis: usize, value: f64| if machine & 1 << axis != 0 { f64::NAN } else { value };
                [known(0, to[0]), known(2, to[2])]
            };
            match &item.action {
                Action::Rapid { to, machine, astray, .. } => go(Kind::Rapid, position(to, machine | astray), 0.0, &now),
                Action::Feed { to, feed, lead: None, machine, .. } => {
                    go(Kind::Feed, position(to, *machine), *feed, &now)
                }
                Action::Feed { to, lead: Some(lead), machine, .. } => {
                    // postform's action does not contain the angle
                    go(Kind::Thread, position(to, *machine), *lead, &Move { angle: f64::NAN, ..now });
                }
                Action::Arc(turn) => {
                    let center = [turn.center[0], turn.center[2]];
                    // postform gives directions as seen along Y of a right-handed system, with Z to the right and X up
                    let ccw = turn.direction == Direction::Ccw;
                    go(Kind::Arc(center, ccw), position(&turn.to, turn.machine), turn.feed, &now);
                }
                Action::Dwell(seconds) => go(Kind::Dwell(*seconds), here, 0.0, &now),
                Action::Spindle(rotation, speed) => {
                    now.spindle = match rotation {
                        Rotation::Cw => 3.0,
                        Rotation::Ccw => 4.0,
                        Rotation::Stop => 5.0,
                    };
                    now.speed.0 = *speed;
                }
                Action::SurfaceSpeed(speed) => now.speed.1 = speed.is_some(),
                Action::SpeedLimit(limit) => now.limit = *limit,
                Action::FeedMode(mode) => now.per_rev = *mode == FeedMode::PerRev,
                Action::Tool(tool) => now.tool = *tool * 100.0 + now.tool % 100.0,
                Action::Length(register) => {
                    now.tool = (now.tool / 100.0).floor() * 100.0 + register.unwrap_or(0.0);
                }
                Action::Coolant(cooling) => now.coolant = if *cooling == Coolant::OFF { 9.0 } else { 8.0 },
                Action::Stop(kind) => {
                    let code = if *kind == StopKind::Optional { 1.0 } else { 0.0 };
                    go(Kind::Dwell(-1.0 - code), here, 0.0, &now);
                }
                Action::Work(work) => now.work = *work,
                Action::Compensation(side) => {
                    now.side = match side.map(|compensation| compensation.side) {
                        None => 40.0,
                        Some(Side::Left) => 41.0,
                        Some(Side::Right) => 42.0,
                    };
                }
                _ => {}
            }
        }
        match step {
            Ok(true) => {}
            Ok(false) => return Ok(list),
            Err(RunError::Refused(diag, line)) => {
                return Err((line as usize, format!("{} {}", diag.code.name(), diag.message)));
            }
            Err(RunError::Io(error)) => return Err((0, error.to_string())),
        }
    }
}

/// Compares the motions of two programs with postform.
///
/// # Errors
/// A message: one of the programs is refused.
pub fn compared(old: &str, new: &str, settings: RunSettings) -> Result<Motions, String> {
    let programs = [old, new].map(|text| (Cursor::new(text.to_owned()), settings));
    compare_motions(programs, settings.units, 1e-6).map_err(|error| match error.1 {
        RunError::Refused(diag, line) => format!("line {line}: {}", diag.message),
        RunError::Io(error) => error.to_string(),
    })
}

/// The kind of a difference between two runs, most serious first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Position or shape of a cut.
    Cut,
    /// Number of cuts.
    Count,
    /// Start of a cut.
    Entry,
    /// Feed, or its unit.
    Feed,
    /// Tool, angle of a thread, compensation, work offset, coolant, or direction or value of the spindle speed.
    State,
    /// The unit of the speed: revolutions, or surface speed.
    Surface,
    /// The spindle limit.
    Limit,
    /// Dwells.
    Dwell,
    /// Rapids.
    Way,
}

/// The state of a motion. The tool includes its offset number.
fn state(one: &Move) -> [f64; 5] {
    [one.spindle, one.tool, one.side, one.work, one.coolant]
}

fn near(a: f64, b: f64, within: f64) -> bool {
    a.is_nan() && b.is_nan() || (a - b).abs() <= within
}

fn at_one(a: Point, b: Point, within: f64) -> bool {
    near(a[0], b[0], within) && near(a[1], b[1], within)
}

/// Whether the move is a cut of zero length.
pub fn is_point(one: &Move) -> bool {
    matches!(one.kind, Kind::Feed | Kind::Thread) && at_one(one.from, one.to, 1e-5)
}

fn is_cut(one: &Move) -> bool {
    // an arc that ends at its start is a full circle
    matches!(one.kind, Kind::Arc(..)) || matches!(one.kind, Kind::Feed | Kind::Thread) && !is_point(one)
}

/// Rapids between cuts, without those of zero length.
fn ways(list: &[Move]) -> Vec<(Vec<Point>, Vec<f64>)> {
    let mut ways = vec![(Vec::new(), Vec::new())];
    for one in list {
        if is_cut(one) {
            ways.push((Vec::new(), Vec::new()));
            continue;
        }
        let Some((way, dwells)) = ways.last_mut() else { continue };
        match one.kind {
            Kind::Dwell(seconds) => dwells.push(seconds),
            _ if at_one(one.from, one.to, 1e-5) => {}
            _ => way.push(one.to),
        }
    }
    ways
}

/// The most serious difference; `None`: both lists have the same effect.
pub fn difference(mine: &[Move], other: &[Move], within: f64) -> Option<(Class, String)> {
    let [a, b] = [mine, other].map(|list| list.iter().filter(|one| is_cut(one)).collect::<Vec<_>>());
    let mut found: Option<(Class, String)> = None;
    let mut say = |class: Class, what: String| {
        if found.as_ref().is_none_or(|(other, _)| class < *other) {
            found = Some((class, what));
        }
    };
    for (x, y) in a.iter().zip(&b) {
        let show = || format!("{}\n   not {}", shown(y), shown(x));
        let like = match (x.kind, y.kind) {
            (Kind::Arc(center, ccw), Kind::Arc(other, also)) => ccw == also && at_one(center, other, 5.0 * within),
            (one, two) => std::mem::discriminant(&one) == std::mem::discriminant(&two),
        };
        if !like || !at_one(x.to, y.to, within) {
            say(Class::Cut, show());
            break;
        }
        if !at_one(x.from, y.from, within) {
            say(Class::Entry, show());
        } else if !near(x.feed, y.feed, 1e-9 + 1e-6 * x.feed) || x.kind != Kind::Thread && x.per_rev != y.per_rev {
            say(Class::Feed, show());
        } else if state(x) != state(y)
            || (x.angle - y.angle).abs() > 1e-9
            || !(x.speed.0.is_nan() || x.speed.0 == y.speed.0)
        {
            say(Class::State, show());
        } else if x.speed.1 != y.speed.1 {
            say(Class::Surface, show());
        } else if x.limit != y.limit {
            say(Class::Limit, show());
        }
    }
    if a.len() != b.len() {
        say(Class::Count, format!("{} cuts, not {}", b.len(), a.len()));
    }
    for ((x, y), n) in ways(mine).iter().zip(&ways(other)).zip(0..) {
        if x.1.len() != y.1.len() || x.1.iter().zip(&y.1).any(|(a, b)| !near(*a, *b, 1e-9)) {
            say(Class::Dwell, format!("before cut {n}: dwells {:?}, not {:?}", y.1, x.1));
        }
        if x.0.len() != y.0.len() || x.0.iter().zip(&y.0).any(|(a, b)| !at_one(*a, *b, within)) {
            let line = a.get(n).map_or(0, |cut| cut.line);
            say(Class::Way, format!("before cut {n}, of line {line}: {:?}\n   not {:?}", y.0, x.0));
        }
    }
    found
}

/// A motion as one line of text.
pub fn shown(one: &Move) -> String {
    let Move { line, kind, from, to, feed, per_rev, spindle, speed, tool, limit, side, work, coolant, angle } = one;
    let unit = if *per_rev { "rev" } else { "min" };
    format!(
        "line {line} {kind:?} r{:.4} z{:.4} -> r{:.4} z{:.4} F{feed}/{unit} M{spindle} S{speed:?} T{tool} limit {limit} G{side} G{work} M{coolant} Q{angle}",
        from[0], from[1], to[0], to[1]
    )
}
