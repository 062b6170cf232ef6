//! Compares a cut of one program with a cut of another program.

use super::begin::unsaid;
use super::cooled;
use super::cut::{ALL, Cut, Place, State, What, number, place, same, shown, turned_otherwise, without_turns};
use super::program::Program;
use super::tables::ORIENTED;
use super::ways::Compared;
use crate::control::{Control, ToolLength};
use crate::lang::{Coolant, additional_work};
use crate::nc::{Threading, axes_of};

/// How the numbers of registers and work offsets in two programs are compared. Two programs for the same control use
/// the same numbers.
#[derive(Clone, Copy)]
pub(super) struct Names {
    /// Whether work offsets are compared by their order. G54, `G15 H1` and datum 1 are each the first work offset of a
    /// control.
    pub by_order: bool,
    /// Whether both programs name length and diameter registers. On some controls the registers belong to the tool.
    registers: bool,
}

impl Names {
    pub fn of(a: &Control, b: &Control) -> Names {
        let own = |control: &Control| control.traits().tool_length == ToolLength::Tool;
        let by_order = a.rules() != b.rules();
        Names { by_order, registers: !by_order && own(a) == own(b) || !own(a) && !own(b) }
    }

    pub fn work(self, work: Option<f64>) -> Option<f64> {
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

    pub fn register(self, register: Option<f64>) -> Option<f64> {
        register.filter(|_| self.registers)
    }
}

/// Two positions as text: X, Y and Z, and other axes on which the positions differ.
pub(super) fn both_shown(a: &Place, b: &Place) -> [String; 2] {
    let apart = (3..8).filter(|&axis| a[axis] != b[axis]).map(|axis| 1 << axis).sum::<u8>();
    [a, b].map(|place| shown(place, 0b111 | apart))
}

/// The difference between the paths to a cut.
pub(super) fn leads_otherwise(way: Compared) -> Option<String> {
    match way {
        Compared::Same | Compared::AsGood { .. } | Compared::Turning => None,
        Compared::Lower(low) => {
            Some(format!("a rapid goes to {}, which is lower than in the old program", low.to.text()))
        }
        Compared::Elsewhere(to) => {
            Some(format!("the rapids near {} follow another path than in the old program", to.text()))
        }
        Compared::Turned(to, axes) => Some(format!(
            "before the tool is retracted, a rapid to {} turns the part otherwise than in the old program",
            shown(&to, 0b111 | axes)
        )),
    }
}

/// The first difference between two cuts.
pub(super) fn differs(cut: &Cut, found: &Cut, tolerance: f64, names: Names, program: &Program<'_>) -> Option<String> {
    let near = |a: f64, b: f64| (a - b).abs() <= tolerance.max(1e-9 * a.abs());
    if cut.unknown != found.unknown {
        let [new, old] = [found, cut].map(|cut: &Cut| match cut.unknown {
            0 => shown(&cut.from, 0b111),
            axes => format!("an unknown machine position of {}", unsaid(axes).unwrap_or_default()),
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
        let [new, old] = both_shown(&found.from, &cut.from);
        return Some(format!("a cut begins at {new}, but at {old} in the old program"));
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
        let [new, old] = both_shown(&b, &a);
        return Some(format!("a cut goes to {new}, but to {old} in the old program"));
    }
    let unknown = cut.unknown | cut.open;
    let turned = turned_otherwise([&cut.from, &a], [&found.from, &b]) & !unknown;
    if turned != 0 {
        let [new, old] = [found, cut].map(|cut| {
            let ends = [cut.from, cut.end()].map(|place| shown(&place, turned));
            format!("from {} to {}", ends[0], ends[1])
        });
        return Some(format!("a cut turns the part {new}, but {old} in the old program"));
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
    // without a code or a cycle for each kind of tap, the taps of a control are rigid
    let kind = |state: &State| (state.rigid.unwrap_or(true), state.into_tap);
    if taps && kind(&cut.state) != kind(&found.state) {
        return Some("only one program synchronizes a tap with the spindle".to_owned());
    }
    if let (true, Some(a), Some(b)) = (taps, cut.state.tap_start, found.state.tap_start)
        && without_turns(a - b).abs() > ORIENTED
    {
        let [a, b] = [a, b].map(number);
        return Some(format!("the thread of a tap starts at {b} degrees, but at {a} degrees in the old program"));
    }
    cutters([&cut.state, &found.state], tolerance).or_else(|| state(&cut.state, &found.state, names, program))
}

/// Compares the compensated tools whose diameter and orientation the programs give.
fn cutters([before, now]: [&State; 2], tolerance: f64) -> Option<String> {
    let near = |(a, b): (f64, f64)| (a - b).abs() <= tolerance;
    let same = match (before.cutter, now.cutter) {
        (Some(a), Some(b)) => a.into_iter().zip(b).all(near),
        (a, b) => a == b,
    };
    let text = |cutter: Option<[f64; 2]>| match cutter {
        None => "no diameter from the program".to_owned(),
        Some([diameter, 0.0]) => format!("a diameter of {}", number(diameter)),
        Some([diameter, orientation]) => format!("a diameter of {} and orientation {orientation}", number(diameter)),
    };
    (!same).then(|| {
        format!("the compensated tool has {}, but {} in the old program", text(now.cutter), text(before.cutter))
    })
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
    let is_cooled_alike = match (before.coolant, now.coolant) {
        (Some(a), Some(b)) => a.is_same(b),
        (a, b) => a.is_none() && b.is_none(),
    };
    if !is_cooled_alike {
        let text = |coolant: Option<Coolant>| coolant.map_or_else(|| "unknown".to_owned(), cooled::name);
        return Some(format!("the coolant is {}, but {} in the old program", text(now.coolant), text(before.coolant)));
    }
    (before.side != now.side).then(|| "cutter compensation is different".to_owned())
}
