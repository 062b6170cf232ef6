//! PM001: axes beyond their travel. For positions that depend on an unknown offset or length, the extents are recorded.

use std::collections::BTreeMap;

use super::extent::Extent;
use super::place::{At, Base, Needs, Places};
use crate::control::Control;
use crate::diag::Code;
use crate::machine::{Axis, LETTERS, Machine, offsets};
use crate::verify::Finding;

/// How far an axis may be beyond its travel, in millimetres: less than the resolution of a control's display.
const OVER: f64 = 1e-4;

/// The ranges of the axes that a running program has used so far.
#[derive(Debug)]
pub struct Travels<'m> {
    machine: &'m Machine,
    limits: [Option<[f64; 2]>; 6],
    /// The range of each axis. The key also contains the offset and the length on which the range depends, and the tool
    /// in the spindle.
    pub extents: BTreeMap<(usize, Needs, Option<u32>), Extent>,
    /// Moves of axes beyond their travel. The key is the axis, the end of the travel, the base of the position, and the
    /// tool.
    beyond: BTreeMap<(usize, bool, Base, Option<u32>), Beyond>,
}

/// An axis beyond one end of its travel.
#[derive(Clone, Debug)]
struct Beyond {
    /// The farthest position, and the block that moves to it.
    worst: f64,
    line: u64,
    block: String,
    /// The first line beyond the limit, and the number of moves beyond it.
    first: u64,
    times: u64,
}

impl<'m> Travels<'m> {
    pub fn new(machine: &'m Machine) -> Travels<'m> {
        let limits = std::array::from_fn(|axis| machine.axes[axis].as_ref().and_then(Axis::limits));
        Travels { machine, limits, extents: BTreeMap::new(), beyond: BTreeMap::new() }
    }

    /// Adds a move to the current positions. `ranges`: the least and the greatest X, Y and Z of an arc.
    pub fn moved(
        &mut self,
        places: &Places<'_>,
        ranges: Option<[[f64; 2]; 3]>,
        tool: Option<u32>,
        (line, block): (u64, &[u8]),
    ) {
        for (axis, At { value, base }) in places.at.iter().copied().enumerate() {
            let Some(limits) = self.limits[axis] else { continue };
            let range = ranges.and_then(|ranges| ranges.get(axis).copied()).unwrap_or([value, value]);
            if let Base::Work(needs) = base {
                let extent = self.extents.entry((axis, needs, tool)).or_insert_with(|| Extent::of(range, line));
                extent.reach(range, line);
            }
            let known = match base {
                Base::Unknown => false,
                Base::Machine => true,
                Base::Work(needs) => !needs.offset_unknown && !needs.length_unknown,
            };
            if !known {
                continue;
            }
            for (above, over) in [(false, limits[0] - range[0]), (true, range[1] - limits[1])] {
                if over > OVER {
                    self.found((axis, above, base, tool), range[usize::from(above)], line, block);
                }
            }
        }
    }

    fn found(&mut self, key: (usize, bool, Base, Option<u32>), at: f64, line: u64, block: &[u8]) {
        let above = key.1;
        let entry = self.beyond.entry(key).or_insert_with(|| Beyond {
            worst: if above { f64::NEG_INFINITY } else { f64::INFINITY },
            line,
            block: String::new(),
            first: line,
            times: 0,
        });
        entry.times += 1;
        if if above { at > entry.worst } else { at < entry.worst } {
            (entry.worst, entry.line) = (at, line);
            entry.block = String::from_utf8_lossy(block).trim().to_owned();
        }
    }

    /// The findings, in the order of the program.
    pub fn findings(&self, control: &Control) -> Vec<Finding> {
        let mut findings: Vec<Finding> =
            self.beyond.iter().map(|(key, beyond)| self.finding(*key, beyond, control)).collect();
        findings.sort_by_key(|finding| finding.line);
        findings
    }

    fn finding(
        &self,
        (axis, above, base, tool): (usize, bool, Base, Option<u32>),
        beyond: &Beyond,
        control: &Control,
    ) -> Finding {
        let limits = self.limits[axis].unwrap_or_default();
        let limit = limits[usize::from(above)];
        let over = (beyond.worst - limit).abs();
        let shown = |value: f64| self.machine.at(axis, value);
        let letter = LETTERS[axis];
        let who = tool.map_or("the program".to_owned(), |tool| format!("T{tool}"));
        let unit = if axis < 3 { self.machine.units.name() } else { "degrees" };
        let mut message = format!(
            "{who} needs {letter}{} in machine coordinates, but the travel ends at {letter}{}: {} {unit} too short",
            shown(beyond.worst),
            shown(limit),
            shown(over)
        );
        if let Base::Work(needs) = base {
            let (longer, lower) = if above { ("shorter", "lower") } else { ("longer", "higher") };
            let offset = format!("{} {letter} {} {lower}", offsets::name(control, needs.work), shown(over));
            match needs.register {
                Some(register) if axis == 2 && register > 0 => {
                    message += &format!("; it fits with a tool {} {longer}, or with {offset}", shown(over));
                }
                _ => message += &format!("; it fits with {offset}"),
            }
        }
        if beyond.first != beyond.line {
            message += &format!("; beyond the travel from line {} on", beyond.first);
        }
        Finding {
            code: Code::PM001,
            message,
            help: "change the offset or the tool, move the part, or use another machine",
            place: None,
            line: beyond.line,
            block: beyond.block.clone(),
            form: None,
            times: beyond.times,
        }
    }
}
