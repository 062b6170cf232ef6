//! Two programs by what a machine does: another way to write the same motions is no difference.

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

/// The first difference of two programs' motions.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionDifference {
    /// What differs.
    pub message: String,
    /// Line and text of the blocks, old and new; line 0 where a program is over.
    pub blocks: [(u64, String); 2],
}

/// How the motions of two programs compare.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motions {
    /// The first difference, after which nothing is compared.
    pub difference: Option<MotionDifference>,
    /// Ways between cuts that go otherwise, and nowhere lower.
    pub ways: u64,
    /// Cuts before which other codes stand, of those that are not simulated.
    pub codes: u64,
    /// Holes with other pecks, of programs for different controls.
    pub pecks: u64,
    /// Feeds that differ by their last digits, of programs for different controls.
    pub feeds: u64,
    /// Cuts that were compared.
    pub cuts: u64,
}

/// Why motions can't be compared: a program (0 old, 1 new) that can't be read or that its control refuses.
#[derive(Debug)]
pub struct NoMotion(pub usize, pub RunError);

/// What two programs do, cut by cut; units, order of words and canned cycles do not matter.
///
/// # Errors
/// One of them can't be run.
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
            // in neither direction: going out higher is another motion, too
            let low = |a: usize, b: usize| leaves_low(&ways[a], &ways[b], tolerance).is_some();
            let same_way = ways[0].is(&ways[1], tolerance);
            let leaves_well = same_way || !low(0, 1) && !low(1, 0);
            // the end stops spindle and coolant, said or not
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
                (Some(cut), _) => format!("the new program is over, and a cut to {} is missing", end(&cut)),
                (None, Some(cut)) => format!("the old program is over, and the new one cuts to {}", end(&cut)),
                (None, None) => besides.unwrap_or_else(|| "the tool leaves the last cut on another way".to_owned()),
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
        let message = differs(cut, &alike, way, tolerance, names)
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
            let message = format!("a hole goes down to Z{}, before to Z{}", number(new), number(old));
            let blocks = [(lines[0], String::new()), (lines[1], String::new())];
            return Ok(Motions { difference: Some(MotionDifference { message, blocks }), ..motions });
        }
        let alike = before.len() == now.len() && before.iter().zip(&now).all(|(a, b)| (a - b).abs() <= tolerance);
        motions.pecks += u64::from(!alike);
    }
}

/// What the old way is to the new one, the other way round: where the old one is lower, the new one is elsewhere.
fn higher(other: Compared) -> Compared {
    match other {
        Compared::Lower(to, _) => Compared::Elsewhere(to),
        other => other,
    }
}

fn end(cut: &Cut) -> String {
    shown(&cut.end(), 0b111)
}

fn differs(cut: &Cut, found: &Cut, way: Compared, tolerance: f64, names: Names) -> Option<String> {
    let near = |a: f64, b: f64| (a - b).abs() <= tolerance.max(1e-9 * a.abs());
    if cut.unknown != found.unknown {
        let [new, old] = [found, cut].map(|cut: &Cut| match cut.unknown {
            0 => shown(&cut.from, 0b111),
            _ => "a position that only the machine knows".to_owned(),
        });
        return Some(format!("a cut begins at {new}, before at {old}"));
    }
    if cut.open != found.open {
        return Some("a cut goes to a position that only the machine knows in one of them".to_owned());
    }
    if cut.home != found.home {
        return Some("a cut goes to a position of the machine in one of them".to_owned());
    }
    if !same(&cut.from, &found.from, ALL, tolerance) {
        return Some(format!("a cut begins at {}, before at {}", shown(&found.from, 0b111), shown(&cut.from, 0b111)));
    }
    match way {
        Compared::Same | Compared::AsGood { .. } | Compared::Turning => {}
        Compared::Lower(to, _) => return Some(format!("a rapid goes to {}, lower than before", shown(&to, 0b111))),
        Compared::Elsewhere(to) => return Some(format!("the rapids about {} go another way", shown(&to, 0b111))),
    }
    match (cut.what, found.what) {
        (What::Arc(a), What::Arc(b)) => {
            let [first, second, _] = axes_of(a.plane);
            let centre = near(a.center[first], b.center[first]) && near(a.center[second], b.center[second]);
            if (a.plane, a.direction, a.turns) != (b.plane, b.direction, b.turns) || !centre {
                return Some(format!("another arc to {}", shown(&place(&b.to), 0b111)));
            }
        }
        (What::Line { .. }, What::Line { .. }) => {}
        _ => return Some("a straight cut became an arc, or the other way round".to_owned()),
    }
    let (a, b) = (cut.end(), found.end());
    if !same(&a, &b, ALL, tolerance) {
        return Some(format!("a cut goes to {}, before to {}", shown(&b, 0b111), shown(&a, 0b111)));
    }
    match (cut.lead, found.lead) {
        (None, None) => {}
        (Some(a), Some(b)) if (a - b).abs() <= 1e-6 * a.abs() + tolerance => {}
        (Some(a), Some(b)) => return Some(format!("the lead of a thread is {}, before {}", number(b), number(a))),
        _ => return Some("a cut follows the spindle, as a thread does, in one of them".to_owned()),
    }
    if cut.lead.is_some() && cut.state.thread != found.state.thread {
        let text = |words: Threading| {
            format!(
                "at {} degrees, flanks of {}, {} leads to leave",
                number(words.start),
                number(words.flanks),
                number(words.pull_out)
            )
        };
        return Some(format!("a thread begins {}, before {}", text(found.state.thread), text(cut.state.thread)));
    }
    if cut.mode != found.mode {
        return Some("feeds count otherwise: per minute, per turn or inverse time".to_owned());
    }
    if let (Some(a), Some(b)) = (cut.feed, found.feed)
        && (a - b).abs() > 1e-6 * a.abs() + tolerance
    {
        return Some(format!("the feed is {}, before {}", number(b), number(a)));
    }
    let taps = cut.by_cycle && found.by_cycle && !names.by_order;
    if taps && (cut.state.rigid, cut.state.into_tap) != (found.state.rigid, found.state.into_tap) {
        return Some(
            "a tap follows the spindle (M29), or goes in as the spindle turned before, in one of them".to_owned(),
        );
    }
    state(&cut.state, &found.state, names)
}

/// How two programs name registers and work offsets: those of one control by the same numbers.
#[derive(Clone, Copy)]
struct Names {
    /// Work offsets count by their order: G54, `G15 H1` and datum 1 are the first.
    by_order: bool,
    /// Both name registers of lengths and diameters. On some controls they are the tool's own.
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
            // the first one, until a program says another
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

fn state(before: &State, now: &State, names: Names) -> Option<String> {
    let pairs = [
        ("the tool", before.tool, now.tool),
        ("the length register", names.register(before.length), names.register(now.length)),
        ("the diameter register", names.register(before.diameter), names.register(now.diameter)),
        ("the work offset", names.work(before.work), names.work(now.work)),
        ("the spindle speed", before.speed, now.speed),
    ];
    let text = |value: Option<f64>| value.map_or("none".to_owned(), |value| number(value).to_string());
    // a surface speed in other units has other last digits
    let differ = |a: Option<f64>, b: Option<f64>| match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() > 1e-6 * a.abs(),
        (a, b) => a != b,
    };
    if let Some((name, a, b)) = pairs.into_iter().find(|(_, a, b)| differ(*a, *b)) {
        return Some(format!("{name} is {}, before {}", text(b), text(a)));
    }
    if before.css != now.css {
        let counts = |css| if css { "at the surface (G96)" } else { "turns (G97)" };
        return Some(format!("the speed of the spindle counts {}, before {}", counts(now.css), counts(before.css)));
    }
    if before.limit != now.limit {
        return Some(format!("the highest speed of the spindle is {}, before {}", text(now.limit), text(before.limit)));
    }
    if before.rotation != now.rotation {
        return Some("the spindle turns otherwise".to_owned());
    }
    if before.coolant != now.coolant {
        let text = |coolant: Option<Cooling>| coolant.map_or("unknown", Cooling::name);
        return Some(format!("the coolant is {}, before {}", text(now.coolant), text(before.coolant)));
    }
    (before.side != now.side).then(|| "cutter compensation is otherwise".to_owned())
}

/// Where increments from places of the machine lead: both count from the same place.
fn astray(old: &Program<'_>, new: &Program<'_>, tolerance: f64) -> Option<String> {
    let (a, b) = (&old.passage.astray, &new.passage.astray);
    let alike = a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(&a.1, &b.1, ALL, tolerance));
    let message = "increments from a position that only the machine knows lead elsewhere on the way here";
    (!alike).then(|| message.to_owned())
}

/// Stops and dwells between two cuts.
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
        return Some(format!("stops on the way here: {}, before {}", listed(&now), listed(&before)));
    }
    let pairs = || old.passage.waits.iter().zip(&new.passage.waits);
    let same = old.passage.waits.len() == new.passage.waits.len()
        && pairs().all(|(a, b)| same_dwell(a.what, b.what) && in_cut(old, a) == in_cut(new, b));
    (!same).then(|| format!("dwells on the way here: {}, before {}", listed(&waits(new)), listed(&waits(old))))
}

/// What the spindle does on the ways.
fn switching(old: &Program<'_>, new: &Program<'_>, names: Names) -> Option<String> {
    let turns = |program: &Program<'_>| -> Vec<String> {
        program.passage.turns.iter().map(|turn| turn.name().to_owned()).collect()
    };
    let (before, now) = (turns(old), turns(new));
    // how it turns at the cut is compared there: a cycle of one control stops it where another's goes on
    if names.by_order && before.last() == now.last() {
        return None;
    }
    (before != now).then(|| format!("the spindle on the way here: {}, before {}", listed(&now), listed(&before)))
}

/// Where the turret of a lathe turns: at home along X, Z, both or neither.
fn turrets(old: &Program<'_>, new: &Program<'_>) -> Option<String> {
    let text = |axes: Option<&u8>| match axes {
        None => "at no tool change",
        Some(0) => "at a position of the program",
        Some(0b001) => "at home along X alone",
        Some(0b100) => "at home along Z alone",
        Some(_) => "at home",
    };
    let (before, now) = (&old.passage.turrets, &new.passage.turrets);
    let differ = (0..before.len().max(now.len())).find(|at| before.get(*at) != now.get(*at))?;
    Some(format!("the turret turns {}, before {}", text(now.get(differ)), text(before.get(differ))))
}

/// The tool goes home along fewer axes: a height, or a lathe's X and Z. Homes of controls of other languages are not compared.
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
        .then(|| format!("the tool no longer goes home along {} on the way here", axes.join(" and ")))
}

/// At which angles the spindle stands while the tool moves at rapid.
fn standing(old: &Program<'_>, new: &Program<'_>) -> Option<String> {
    let angles = |program: &Program<'_>| -> Vec<String> {
        let stands = program.passage.rapids.iter().filter_map(|rapid| match rapid.spin? {
            Spin::At(angle) => Some(format!("{} degrees", number(angle))),
            Spin::Oriented => Some("an angle of the control's".to_owned()),
            Spin::Turns(_) => None,
        });
        let mut list: Vec<String> = stands.collect();
        list.dedup();
        list
    };
    let (before, now) = (angles(old), angles(new));
    let text = |list: &[String]| if list.is_empty() { "no angle".to_owned() } else { listed(list) };
    (before != now)
        .then(|| format!("the spindle stands on the way here at {}, before at {}", text(&now), text(&before)))
}

fn listed(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}
