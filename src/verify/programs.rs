//! Compares the motions of the machine in two programs. If different codes make the same motions, the programs are
//! equal.

use std::io::{Read, Seek};

use super::cut::{ALL, Cut, Spin, State, What, number, place, same, same_dwell, shown};
use super::expectation::Expectation;
use super::folded::{begin_alike, hole, rounded_alike};
use super::passage::{Mark, TOO_LONG};
use super::program::{Doubt, Program};
use super::rapid_path::RapidPath;
use super::ways::{Compared, compare, leaves_low};
use crate::control::{Control, ToolLength};
use crate::lang::additional_work;
use crate::nc::{Cooling, RunError, RunSettings, Threading, axes_of};
use crate::toolpath::{StopKind, Units};

/// The first difference between the motions of two programs.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionDifference {
    /// Description of the difference.
    pub message: String,
    /// The line number and text of the block in the old and in the new program; the line is 0 if the program has ended.
    pub blocks: [(u64, String); 2],
}

/// The result of comparing the motions of two programs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motions {
    /// The first difference. The comparison ends at this difference.
    pub difference: Option<MotionDifference>,
    /// Number of paths between two cuts that differ, although the path of neither program is lower.
    pub ways: u64,
    /// Number of cuts before which the two programs have different codes that are not simulated.
    pub codes: u64,
    /// Number of holes with different pecks. Different pecks are allowed only if the programs are for different
    /// controls.
    pub pecks: u64,
    /// Number of feeds that differ by rounding. Rounding differences of feeds are allowed only if the programs are for
    /// different controls.
    pub feeds: u64,
    /// Number of cuts compared.
    pub cuts: u64,
}

/// The reason why motions can't be compared: program 0 (old) or 1 (new) can't be read, or the control of this program
/// refuses a block.
#[derive(Debug)]
pub struct NoMotion(pub usize, pub RunError);

/// Compares the motions of two programs, cut by cut. The programs may use different units, another order of words, or
/// canned cycles instead of single moves.
///
/// # Errors
/// One of the programs can't be run.
pub fn compare_motions(
    programs: [(impl Read + Seek, RunSettings); 2],
    units: Units,
    tolerance: f64,
) -> Result<Motions, NoMotion> {
    let [mut a, mut b] = programs.map(|(input, settings)| {
        let expectation = Expectation { tools: false, units_due: false, ..Expectation::default() };
        let mut program = Program::new(input, settings, &expectation);
        program.want(units);
        program
    });
    b.share_tool_names(&a);
    let names = Names::of(a.control(), b.control());
    let mut ways = [RapidPath::default(), RapidPath::default()];
    let mut motions = Motions::default();
    loop {
        let x = a.run_to_cut().map_err(|error| NoMotion(0, error))?.cloned();
        let y = b.run_to_cut().map_err(|error| NoMotion(1, error))?.cloned();
        for (number, program) in [&a, &b].into_iter().enumerate() {
            if program.doubt() == Some(Doubt::TooLong) {
                return Err(NoMotion(number, RunError::Io(std::io::Error::other(TOO_LONG))));
            }
        }
        let lines = [&x, &y].map(|cut| cut.as_ref().map_or(0, |cut| cut.line));
        let blocks = |a: &Program<'_>, b: &Program<'_>| [(lines[0], a.text()), (lines[1], b.text())];
        let starts = [a.start(), b.start()];
        for (way, (program, start)) in ways.iter_mut().zip([(&a, starts[0]), (&b, starts[1])]) {
            way.set(Some(start), &program.passage.rapids, tolerance);
            way.join(tolerance);
        }
        motions.codes += u64::from(a.passage.codes != b.passage.codes);
        let (Some(cut), Some(found)) = (&x, &y) else {
            // check both directions, because a higher path after the last cut also counts as another motion
            let low = |a: usize, b: usize| leaves_low(&ways[a], &ways[b], tolerance).is_some();
            let same_way = ways[0].is(&ways[1], tolerance);
            let leaves_well = same_way || !low(0, 1) && !low(1, 0);
            // the end of a program stops spindle and coolant anyway, so their codes are not compared
            let besides = astray(&a, &b, tolerance)
                .or_else(|| pauses(&a, &b, tolerance))
                .or_else(|| turrets(&a, &b))
                .or_else(|| homes(&a, &b, names))
                .or_else(|| standing(&a, &b));
            if x.is_none() && y.is_none() && leaves_well && besides.is_none() {
                motions.ways += u64::from(!same_way);
                return Ok(motions);
            }
            let message = match (x, y) {
                (Some(cut), _) => format!("the new program ends before a cut to {}", end(&cut)),
                (None, Some(cut)) => format!("the new program cuts to {} after the end of the old program", end(&cut)),
                (None, None) => besides.unwrap_or_else(|| "the path after the last cut is different".to_owned()),
            };
            let difference = Some(MotionDifference { message, blocks: blocks(&a, &b) });
            return Ok(Motions { difference, ..motions });
        };
        let known = starts.iter().all(|start| start.unknown == 0);
        let [left, right] = &mut ways;
        let way = match left.is(right, tolerance) {
            true => Compared::Same,
            false => match compare(left, right, known, tolerance) {
                Compared::AsGood { .. } => higher(compare(right, left, known, tolerance)),
                other => other,
            },
        };
        motions.ways += u64::from(matches!(way, Compared::AsGood { .. }));
        motions.cuts += 1;
        let folds = names.by_order && begin_alike(cut, found, tolerance);
        let mut alike = found.clone();
        if folds {
            alike.what = cut.what;
        }
        if names.by_order && rounded_alike(cut.feed, found.feed) {
            motions.feeds += u64::from(found.feed != cut.feed);
            alike.feed = cut.feed;
        }
        if names.by_order && rounded_alike(cut.state.speed, found.state.speed) && cut.state.speed != found.state.speed {
            alike.state = State { speed: cut.state.speed, ..*found.state }.into();
        }
        let message = differs(cut, &alike, way, tolerance, names, &a)
            .or_else(|| astray(&a, &b, tolerance))
            .or_else(|| pauses(&a, &b, tolerance))
            .or_else(|| switching(&a, &b, names))
            .or_else(|| turrets(&a, &b))
            .or_else(|| homes(&a, &b, names))
            .or_else(|| standing(&a, &b));
        if let Some(message) = message {
            let difference = Some(MotionDifference { message, blocks: blocks(&a, &b) });
            return Ok(Motions { difference, ..motions });
        }
        if !folds {
            a.take();
            b.take();
            continue;
        }
        let before = hole(&mut a, cut, tolerance).map_err(|error| NoMotion(0, error))?;
        let now = hole(&mut b, found, tolerance).map_err(|error| NoMotion(1, error))?;
        let [old, new] = [&before, &now].map(|depths| depths.iter().copied().fold(f64::INFINITY, f64::min));
        if (old - new).abs() > tolerance {
            let message = format!("a hole goes to Z{}, but to Z{} in the old program", number(new), number(old));
            let blocks = [(lines[0], String::new()), (lines[1], String::new())];
            return Ok(Motions { difference: Some(MotionDifference { message, blocks }), ..motions });
        }
        let alike = before.len() == now.len() && before.iter().zip(&now).all(|(a, b)| (a - b).abs() <= tolerance);
        motions.pecks += u64::from(!alike);
    }
}

/// Converts the result of the comparison of the old path with the new path. If the old path is lower, the paths are
/// different.
fn higher(other: Compared) -> Compared {
    match other {
        Compared::Lower(low) => Compared::Elsewhere(low.to.to),
        other => other,
    }
}

fn end(cut: &Cut) -> String {
    shown(&cut.end(), 0b111)
}

fn differs(
    cut: &Cut,
    found: &Cut,
    way: Compared,
    tolerance: f64,
    names: Names,
    program: &Program<'_>,
) -> Option<String> {
    let near = |a: f64, b: f64| (a - b).abs() <= tolerance.max(1e-9 * a.abs());
    if cut.unknown != found.unknown {
        let [new, old] = [found, cut].map(|cut: &Cut| match cut.unknown {
            0 => shown(&cut.from, 0b111),
            _ => "an unknown machine position".to_owned(),
        });
        return Some(format!("a cut begins at {new}, but at {old} in the old program"));
    }
    if cut.open != found.open {
        return Some("only one program cuts to an unknown machine position".to_owned());
    }
    if cut.home != found.home {
        return Some("only one program cuts to a position in machine coordinates".to_owned());
    }
    if !same(&cut.from, &found.from, ALL, tolerance) {
        return Some(format!(
            "a cut begins at {}, but at {} in the old program",
            shown(&found.from, 0b111),
            shown(&cut.from, 0b111)
        ));
    }
    match way {
        Compared::Same | Compared::AsGood { .. } | Compared::Turning => {}
        Compared::Lower(low) => {
            let to = low.to.to;
            return Some(format!("a rapid goes to {}, which is lower than in the old program", shown(&to, 0b111)));
        }
        Compared::Elsewhere(to) => {
            return Some(format!("the rapids near {} follow another path than in the old program", shown(&to, 0b111)));
        }
    }
    match (cut.what, found.what) {
        (What::Arc(a), What::Arc(b)) => {
            let [first, second, _] = axes_of(a.plane);
            let centre = near(a.center[first], b.center[first]) && near(a.center[second], b.center[second]);
            if (a.plane, a.direction, a.turns) != (b.plane, b.direction, b.turns) || !centre {
                return Some(format!("the arc to {} is different", shown(&place(&b.to), 0b111)));
            }
        }
        (What::Line { .. }, What::Line { .. }) => {}
        _ => return Some("a straight cut became an arc, or an arc became a straight cut".to_owned()),
    }
    let (a, b) = (cut.end(), found.end());
    if !same(&a, &b, ALL, tolerance) {
        return Some(format!("a cut goes to {}, but to {} in the old program", shown(&b, 0b111), shown(&a, 0b111)));
    }
    match (cut.lead, found.lead) {
        (None, None) => {}
        (Some(a), Some(b)) if (a - b).abs() <= 1e-6 * a.abs() + tolerance => {}
        (Some(a), Some(b)) => {
            return Some(format!("the lead of a thread is {}, but {} in the old program", number(b), number(a)));
        }
        _ => return Some("only one program synchronizes a cut with the spindle, as for a thread".to_owned()),
    }
    if cut.lead.is_some() && cut.state.thread != found.state.thread {
        let text = |words: Threading| {
            format!(
                "at {} degrees, with flanks of {} degrees and a runout of {} leads",
                number(words.start),
                number(words.flanks),
                number(words.pull_out)
            )
        };
        return Some(format!(
            "a thread begins {}, but {} in the old program",
            text(found.state.thread),
            text(cut.state.thread)
        ));
    }
    if cut.mode != found.mode {
        return Some("the feed mode is different (per minute, per revolution or inverse time)".to_owned());
    }
    if let (Some(a), Some(b)) = (cut.feed, found.feed)
        && (a - b).abs() > 1e-6 * a.abs() + tolerance
    {
        return Some(format!("the feed is {}, but {} in the old program", number(b), number(a)));
    }
    let taps = cut.by_cycle && found.by_cycle && !names.by_order;
    if taps && (cut.state.rigid, cut.state.into_tap) != (found.state.rigid, found.state.into_tap) {
        return Some("only one program synchronizes a tap with the spindle (M29)".to_owned());
    }
    state(&cut.state, &found.state, names, program)
}

/// How the numbers of registers and work offsets in two programs are compared. Two programs for the same control use
/// the same numbers.
#[derive(Clone, Copy)]
struct Names {
    /// Whether work offsets are compared by their order. G54, `G15 H1` and datum 1 are each the first work offset of a
    /// control.
    by_order: bool,
    /// Whether both programs name length and diameter registers. On some controls the registers belong to the tool.
    registers: bool,
}

impl Names {
    fn of(a: &Control, b: &Control) -> Names {
        let own = |control: &Control| control.traits().tool_length == ToolLength::Tool;
        let by_order = a.rules() != b.rules();
        Names { by_order, registers: !by_order && own(a) == own(b) || !own(a) && !own(b) }
    }

    fn work(self, work: Option<f64>) -> Option<f64> {
        let additional = additional_work(0.0);
        match work {
            work if !self.by_order => work,
            // without a code, the first work offset is active
            None => Some(1.0),
            Some(code) if code > additional => Some(code - additional + 6.0),
            Some(code) if code > 59.0 => Some((code - 59.0) * 10.0 + 6.0),
            Some(code) if code >= 54.0 => Some(code - 53.0),
            counted => counted,
        }
    }

    fn register(self, register: Option<f64>) -> Option<f64> {
        register.filter(|_| self.registers)
    }
}

fn state(before: &State, now: &State, names: Names, program: &Program<'_>) -> Option<String> {
    if before.tool != now.tool {
        let text = |tool: Option<f64>| tool.map_or("none".to_owned(), |tool| program.tool_text(tool));
        return Some(format!("the tool is {}, but {} in the old program", text(now.tool), text(before.tool)));
    }
    let pairs = [
        ("the length register", names.register(before.length), names.register(now.length)),
        ("the diameter register", names.register(before.diameter), names.register(now.diameter)),
        ("the work offset", names.work(before.work), names.work(now.work)),
        ("the spindle speed", before.speed, now.speed),
    ];
    let text = |value: Option<f64>| value.map_or("none".to_owned(), |value| number(value).to_string());
    // a surface speed that is converted from other units is rounded differently
    let differ = |a: Option<f64>, b: Option<f64>| match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() > 1e-6 * a.abs(),
        (a, b) => a != b,
    };
    if let Some((name, a, b)) = pairs.into_iter().find(|(_, a, b)| differ(*a, *b)) {
        return Some(format!("{name} is {}, but {} in the old program", text(b), text(a)));
    }
    if before.css != now.css {
        let counts = |css| if css { "a surface speed (G96)" } else { "in revolutions (G97)" };
        return Some(format!(
            "the spindle speed is {}, but {} in the old program",
            counts(now.css),
            counts(before.css)
        ));
    }
    if before.limit != now.limit {
        return Some(format!(
            "the speed limit of the spindle is {}, but {} in the old program",
            text(now.limit),
            text(before.limit)
        ));
    }
    if before.rotation != now.rotation {
        return Some("the spindle direction is different".to_owned());
    }
    if before.coolant != now.coolant {
        let text = |coolant: Option<Cooling>| coolant.map_or("unknown", Cooling::name);
        return Some(format!("the coolant is {}, but {} in the old program", text(now.coolant), text(before.coolant)));
    }
    (before.side != now.side).then(|| "cutter compensation is different".to_owned())
}

/// Compares the targets of incremental moves from machine positions. Incremental moves of both programs must start from
/// the same position.
fn astray(old: &Program<'_>, new: &Program<'_>, tolerance: f64) -> Option<String> {
    let (a, b) = (&old.passage.astray, &new.passage.astray);
    let alike = a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(&a.1, &b.1, ALL, tolerance));
    let message = "before this cut, incremental moves from an unknown machine position go to another position";
    (!alike).then(|| message.to_owned())
}

/// Compares stops and dwells between two cuts.
fn pauses(old: &Program<'_>, new: &Program<'_>, tolerance: f64) -> Option<String> {
    let stop = |kind: StopKind| if kind == StopKind::Program { "M0" } else { "M1" };
    let stops = |program: &Program<'_>| -> Vec<String> {
        program.passage.stops.iter().map(|made| stop(made.what).to_owned()).collect()
    };
    let in_cut = |program: &Program<'_>, wait: &Mark<f64>| program.passage.in_cut(wait, tolerance);
    let waits = |program: &Program<'_>| -> Vec<String> {
        let place = |wait: &Mark<f64>| if in_cut(program, wait) { " in the cut" } else { "" };
        program.passage.waits.iter().map(|wait| format!("{} s{}", number(wait.what), place(wait))).collect()
    };
    let (before, now) = (stops(old), stops(new));
    if before != now {
        return Some(format!(
            "the stops before this cut are {}, but {} in the old program",
            listed(&now),
            listed(&before)
        ));
    }
    let pairs = || old.passage.waits.iter().zip(&new.passage.waits);
    let same = old.passage.waits.len() == new.passage.waits.len()
        && pairs().all(|(a, b)| same_dwell(a.what, b.what) && in_cut(old, a) == in_cut(new, b));
    (!same).then(|| {
        format!(
            "the dwells before this cut are {}, but {} in the old program",
            listed(&waits(new)),
            listed(&waits(old))
        )
    })
}

/// Compares the changes of the spindle's rotation between two cuts.
fn switching(old: &Program<'_>, new: &Program<'_>, names: Names) -> Option<String> {
    let turns = |program: &Program<'_>| -> Vec<String> {
        program.passage.turns.iter().map(|turn| turn.name().to_owned()).collect()
    };
    let (before, now) = (turns(old), turns(new));
    // the rotation at the cut is compared elsewhere, because the cycles of only some controls stop the spindle
    if names.by_order && before.last() == now.last() {
        return None;
    }
    (before != now).then(|| {
        format!(
            "the changes of the spindle before this cut are {}, but {} in the old program",
            listed(&now),
            listed(&before)
        )
    })
}

/// Compares the positions at which a lathe's turret indexes: X at home, Z at home, both, or neither.
fn turrets(old: &Program<'_>, new: &Program<'_>) -> Option<String> {
    let text = |axes: Option<&u8>| match axes {
        None => "at no tool change",
        Some(0) => "at a position from the program",
        Some(0b001) => "at home only along X",
        Some(0b100) => "at home only along Z",
        Some(_) => "at home",
    };
    let (before, now) = (&old.passage.turrets, &new.passage.turrets);
    let differ = (0..before.len().max(now.len())).find(|at| before.get(*at) != now.get(*at))?;
    Some(format!("the turret turns {}, but {} in the old program", text(now.get(differ)), text(before.get(differ))))
}

/// Checks that the new program moves home each axis that the old program moves home. Only Z is checked, on a lathe X
/// and Z. If the controls have different languages, the check is left out.
fn homes(old: &Program<'_>, new: &Program<'_>, names: Names) -> Option<String> {
    let counts = if old.control().is_lathe() { 0b101 } else { 0b100 };
    let lost = old.passage.homes & !new.passage.homes & counts;
    let axes: Vec<String> = ["X", "Y", "Z"]
        .iter()
        .enumerate()
        .filter(|(axis, _)| lost & 1 << axis != 0)
        .map(|(_, name)| (*name).to_owned())
        .collect();
    (!axes.is_empty() && !names.by_order)
        .then(|| format!("the tool no longer goes home along {} before this cut", axes.join(" and ")))
}

/// Compares the angles at which the spindle is stopped during rapids.
fn standing(old: &Program<'_>, new: &Program<'_>) -> Option<String> {
    let angles = |program: &Program<'_>| -> Vec<String> {
        let stands = program.passage.rapids.iter().filter_map(|rapid| match rapid.spin? {
            Spin::At(angle) => Some(format!("{} degrees", number(angle))),
            Spin::Oriented => Some("the control's own angle".to_owned()),
            Spin::Turns(_) => None,
        });
        let mut list: Vec<String> = stands.collect();
        list.dedup();
        list
    };
    let (before, now) = (angles(old), angles(new));
    let text = |list: &[String]| if list.is_empty() { "no angle".to_owned() } else { listed(list) };
    (before != now).then(|| {
        format!("the spindle angle before this cut is {}, but {} in the old program", text(&now), text(&before))
    })
}

fn listed(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}
