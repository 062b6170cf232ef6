//! Compares what two programs do between two cuts: stops, dwells, frames, changes of the spindle, machine positions.

use super::beside::{AtMachine, Mark};
use super::cut::{ALL, Rapid, Spin, number, same, same_dwell};
use super::measured::{self, Across, Between, Frames, Level, Other, Zero};
use super::passage::Standing;
use super::program::Program;
use super::program_cuts::{Names, both_shown};
use super::tables::ANGLE;
use crate::lang::Machine;
use crate::toolpath::StopKind;

/// The first difference between two cuts, apart from the rapids and the rotation of the spindle.
pub(super) fn between(old: &Program<'_>, new: &Program<'_>, names: Names, tolerance: f64) -> Option<String> {
    astray(old, new, tolerance)
        .or_else(|| frames(old, new, tolerance))
        .or_else(|| tool_data(old, new))
        .or_else(|| entries(old, new, tolerance))
        .or_else(|| pauses(old, new, tolerance))
        .or_else(|| turrets(old, new))
        .or_else(|| homes(old, new, names))
        .or_else(|| machine_positions(old, new, names, tolerance))
        .or_else(|| units(old, new, names))
        .or_else(|| standing(old, new))
}

/// Compares the targets of incremental moves from machine positions. Incremental moves of both programs must start from
/// the same position.
fn astray(old: &Program<'_>, new: &Program<'_>, tolerance: f64) -> Option<String> {
    let (a, b) = (&old.passage.astray, &new.passage.astray);
    let alike = a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(&a.1, &b.1, ALL, tolerance));
    let message = "before this cut, incremental moves from an unknown machine position go to another position";
    (!alike).then(|| message.to_owned())
}

/// Compares the heights at which the tool first moves across in another work offset. The new program must be at least
/// as high. The number of the height is known only in the offset before.
fn entries(old: &Program<'_>, new: &Program<'_>, tolerance: f64) -> Option<String> {
    let pairs = old.passage.entries().zip(new.passage.entries()).filter(|(_, now)| now.crosses());
    pairs.into_iter().find_map(|(before, now)| {
        let [was, is] = lower(before.height, now.height, tolerance)?;
        Some(format!("the work offset changes with the tool at {is}, but at {was} in the old program"))
    })
}

/// The heights of the tool in the old and in the new program, if the tool is lower in the new program. Numbers of
/// heights are compared only in the same work offset.
fn lower(old: Option<Standing>, new: Option<Standing>, tolerance: f64) -> Option<[String; 2]> {
    let (was, is) = (old?, new?);
    let text = |height: f64| if height.is_finite() { format!("Z{}", number(height)) } else { "home".to_owned() };
    (was.work == is.work && is.height < was.height - tolerance).then(|| [was, is].map(|standing| text(standing.height)))
}

/// Compares the coordinate frames (G52, G92, G10, TRANS, TRANS DATUM) from which both programs measure positions.
fn frames(old: &Program<'_>, new: &Program<'_>, tolerance: f64) -> Option<String> {
    if !old.moves_zero && !new.moves_zero {
        return None;
    }
    let [before, now] = [old.zero(), new.zero()];
    if (before.set, before.unknown) != (now.set, now.unknown) {
        return Some("only one program sets the work offset, or shifts it from an unknown machine position".to_owned());
    }
    if (before.angle - now.angle).abs() > ANGLE {
        let [now, before] = [now, before].map(|zero| number(zero.angle));
        return Some(format!("the work offset is rotated by {now} degrees, but by {before} in the old program"));
    }
    (!same(&before.at, &now.at, ALL, tolerance)).then(|| {
        let [now, before] = both_shown(&now.at, &before.at);
        let is_given = |program: &&Program<'_>| program.frames().is_some_and(|frames| frames.level.length == Some(0.0));
        let by_length = [old, new].iter().any(is_given);
        let with = if by_length { ", with the length of G43.1," } else { "" };
        format!("the zero of the program{with} is shifted to {now}, but to {before} in the old program")
    })
}

/// Compares the frames of the rapids: the work offset, the zero, the tool length and the cutter compensation.
/// `before`: the frames at the last cut of both programs. `next`: whether both programs have reached a next cut.
pub(super) fn frames_of_rapids(
    [old, new]: [&Program<'_>; 2],
    before: [Option<&Frames>; 2],
    next: bool,
    names: Names,
    tolerance: f64,
) -> Option<String> {
    if [old, new].iter().all(|program| program.passage.measured.is_empty()) {
        return None;
    }
    let (a, b) = (&old.passage.rapids, &new.passage.rapids);
    let alike = |(a, b): (&Rapid, &Rapid)| a.unknown == b.unknown && same(&a.to, &b.to, ALL & !a.unknown, tolerance);
    let same_rapids = a.len() == b.len() && a.iter().zip(b).all(alike);
    let [left, right] = [(old, before[0]), (new, before[1])].map(|(program, before)| Between {
        measured: &program.passage.measured,
        before,
        next: program.frames().filter(|_| next).map(|frames| &**frames),
    });
    let across =
        |frame: &Across| Across { work: names.work(frame.work), diameter: names.register(frame.diameter), ..*frame };
    let level = |frame: &Level| Level { work: names.work(frame.work), length: names.register(frame.length), ..*frame };
    let other = measured::differs(
        &left,
        &right,
        same_rapids,
        |a, b| across(a).is(&across(b), tolerance),
        |a, b| level(a).is(&level(b), tolerance),
    )?;
    let [before, now] = match other {
        Other::Across(pair) => pair.map(|frame| frame.map(|frame| frame.text())),
        Other::Level(pair) => pair.map(|frame| {
            frame.map(|frame| frame.text(&frame.tool.map_or("none".to_owned(), |tool| new.tool_text(tool))))
        }),
    };
    Some(match (before, now) {
        (Some(before), Some(now)) => {
            format!("the rapids here are made with {now}, but with {before} in the old program")
        }
        (_, Some(now)) => format!("only the new program makes rapids here with {now}"),
        (before, None) => format!("only the old program makes rapids here with {}", before.unwrap_or_default()),
    })
}

/// Compares whether the programs set their units. A program without a code for units runs in the units of the machine,
/// which may be other units than those of the other program.
fn units(old: &Program<'_>, new: &Program<'_>, names: Names) -> Option<String> {
    let message = || match new.sets_units {
        true => "the new program sets its units, but the old program has no code for units".to_owned(),
        false => "the new program has no code for units, but the old program sets its units".to_owned(),
    };
    (!names.by_order && old.sets_units != new.sets_units).then(message)
}

/// Compares the ends of the programs. M99 in a main program starts the program again.
pub(super) fn endings(old: &Program<'_>, new: &Program<'_>) -> Option<String> {
    let (before, now) = (old.ending(), new.ending());
    (before != now).then(|| format!("the new program {now}, but the old program {before}"))
}

/// Compares the work offsets that the programs leave in the control. A program may set an offset that it does not use
/// itself, for the program after it.
pub(super) fn offsets_left(old: &Program<'_>, new: &Program<'_>, names: Names, tolerance: f64) -> Option<String> {
    if names.by_order || !old.moves_zero && !new.moves_zero {
        return None;
    }
    let alike = |(a, b): &(Zero, Zero)| {
        a.set == b.set && (a.angle - b.angle).abs() <= ANGLE && same(&a.at, &b.at, ALL, tolerance)
    };
    let (index, (before, now)) = old.offsets().zip(new.offsets()).enumerate().find(|(_, pair)| !alike(pair))?;
    let name = match index {
        0 => "the offset of all work offsets".to_owned(),
        _ if new.control().counts_work() => format!("work offset {index}"),
        7..=9 => format!("G59.{}", index - 6),
        10.. => format!("G54.1 P{}", index - 9),
        _ => format!("G{}", index + 53),
    };
    if before.set != now.set {
        return Some(format!("the programs set {name} for other axes, or only one program sets it"));
    }
    if (before.angle - now.angle).abs() > ANGLE {
        let [now, before] = [now, before].map(|zero| number(zero.angle));
        return Some(format!("the program rotates {name} by {now} degrees, but by {before} in the old program"));
    }
    let [now, before] = both_shown(&now.at, &before.at);
    Some(format!("the program sets {name} to {now}, but to {before} in the old program"))
}

/// Compares the tool data that the programs set by G10, such as the length in a register.
fn tool_data(old: &Program<'_>, new: &Program<'_>) -> Option<String> {
    if old.passage.tool_data == new.passage.tool_data {
        return None;
    }
    let text = |program: &Program<'_>| {
        let word = |&(letter, value): &(u8, f64)| format!("{}{}", char::from(letter), number(value));
        listed(&program.passage.tool_data.iter().map(word).collect::<Vec<_>>())
    };
    let (before, now) = (text(old), text(new));
    (before != now)
        .then(|| format!("the tool data set by G10 before this cut are {now}, but {before} in the old program"))
}

/// Compares stops and dwells between two cuts, and the height of the tool there. The new program must be at least as
/// high.
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
    if !same {
        let [now, before] = [new, old].map(|program| listed(&waits(program)));
        return Some(format!("the dwells before this cut are {now}, but {before} in the old program"));
    }
    let [before, now] = [&old.passage, &new.passage];
    let stops = before.stops.iter().zip(&now.stops);
    let lower_stop = stops.map(|(a, b)| (stop(b.what), lower(before.height_at(a), now.height_at(b), tolerance)));
    let lower_wait = pairs().map(|(a, b)| ("a dwell", lower(before.height_at(a), now.height_at(b), tolerance)));
    lower_stop.chain(lower_wait).find_map(|(what, heights)| {
        let [was, is] = heights?;
        Some(format!("at {what} before this cut, the tool is at {is}, but at {was} in the old program"))
    })
}

/// Compares the changes of the spindle's rotation between two cuts.
pub(super) fn switching(old: &Program<'_>, new: &Program<'_>, names: Names) -> Option<String> {
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
    let counts = if old.machine() == Machine::Lathe { 0b101 } else { 0b100 };
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

/// Compares the machine positions and reference points along each axis for which both programs have them.
fn machine_positions(old: &Program<'_>, new: &Program<'_>, names: Names, tolerance: f64) -> Option<String> {
    let near = |(a, b): (&AtMachine, &AtMachine)| {
        (a.point, a.length) == (b.point, b.length) && (a.at - b.at).abs() <= tolerance
    };
    let alike = |a: &[AtMachine], b: &[AtMachine]| a.len() == b.len() && a.iter().zip(b).all(near);
    let [before, now] = [old, new].map(|program| &program.passage.machine);
    let axis = (0..6).find(|&axis| {
        let (a, b) = (&before[axis], &now[axis]);
        !a.is_empty() && !b.is_empty() && !alike(a, b)
    })?;
    let text = |places: &[Vec<AtMachine>; 6]| {
        let name = ["X", "Y", "Z", "A", "B", "C"][axis];
        let words = places[axis].iter().map(|AtMachine { at, point, length }| match (point, length) {
            (0, None) => format!("{name}{}", number(*at)),
            (0, Some(register)) => format!("{name}{} with D{} active", number(*at), number(*register)),
            (point, _) => format!("{name} of reference point {}", point + 1),
        });
        listed(&words.collect::<Vec<_>>())
    };
    let message =
        || format!("before this cut, the machine positions are {}, but {} in the old program", text(now), text(before));
    (!names.by_order).then(message)
}

/// Compares the angles at which the spindle is stopped during rapids, and at the cut.
fn standing(old: &Program<'_>, new: &Program<'_>) -> Option<String> {
    let angles = |program: &Program<'_>| -> Vec<String> {
        let spins = program.passage.rapids.iter().filter_map(|rapid| rapid.spin).chain([program.spin()]);
        let stands = spins.filter_map(|spin| match spin {
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

/// Compares the rotation of the spindle while the tool leaves the last cut. The cycles of only some controls stop the
/// spindle there.
pub(super) fn leaving(old: &Program<'_>, new: &Program<'_>, names: Names) -> Option<String> {
    let turns = |program: &Program<'_>| match program.passage.rapids.first()?.spin? {
        Spin::Turns(rotation) => Some(rotation.name()),
        Spin::At(_) | Spin::Oriented => None,
    };
    let (before, now) = (turns(old)?, turns(new)?);
    (!names.by_order && before != now)
        .then(|| format!("the spindle leaves the last cut with {now}, but with {before} in the old program"))
}

fn listed(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}
