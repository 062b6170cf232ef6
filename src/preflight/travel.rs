//! PM001: axes beyond their travel. What depends on an offset or a length that is not known is kept as extents.

use std::collections::BTreeMap;

use super::extent::Extent;
use super::place::{At, Base, Needs, Places};
use crate::control::Control;
use crate::diag::Code;
use crate::machine::{Axis, LETTERS, Machine, offsets};
use crate::verify::Finding;

/// How far beyond its travel an axis may come, in millimetres: less than a control shows.
const OVER: f64 = 1e-4;

/// What is known of the travels while a program runs.
#[derive(Debug)]
pub struct Travels<'m> {
    machine: &'m Machine,
    limits: [Option<[f64; 2]>; 6],
    /// How far each axis goes, by the offset and the length that it needs, and the tool in the spindle.
    pub extents: BTreeMap<(usize, Needs, Option<u32>), Extent>,
    /// Axes beyond their travel: by axis, which end, what the position needs, and the tool.
    beyond: BTreeMap<(usize, bool, Base, Option<u32>), Beyond>,
}

/// An axis beyond one end of its travel.
#[derive(Clone, Debug)]
struct Beyond {
    /// The farthest position, and the block that goes there.
    worst: f64,
    line: u64,
    block: String,
    /// The first line that goes beyond, and how many moves do.
    first: u64,
    times: u64,
}

impl<'m> Travels<'m> {
    pub fn new(machine: &'m Machine) -> Travels<'m> {
        let limits = std::array::from_fn(|axis| machine.axes[axis].as_ref().and_then(Axis::limits));
        Travels { machine, limits, extents: BTreeMap::new(), beyond: BTreeMap::new() }
    }

    /// A move to where the axes stand now; `ranges`: how far X, Y and Z go on it, of an arc.
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

    /// What was found, in the order of the program.
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
            "{who} needs {letter}{} in machine coordinates, and the travel ends at {letter}{}: {} {unit} short",
            shown(beyond.worst),
            shown(limit),
            shown(over)
        );
        if let Base::Work(needs) = base {
            let (longer, lower) = if above { ("shorter", "lower") } else { ("longer", "higher") };
            let offset = format!("{} {letter} {} {lower}", offsets::name(control, needs.work), shown(over));
            match needs.register {
                Some(register) if axis == 2 && register > 0 => {
                    message += &format!("; a tool {} {longer}, or {offset}, would do", shown(over));
                }
                _ => message += &format!("; {offset} would do"),
            }
        }
        if beyond.first != beyond.line {
            message += &format!("; beyond it from line {} on", beyond.first);
        }
        Finding {
            code: Code::PM001,
            message,
            help: "change the offset or the tool, set the part elsewhere, or take another machine",
            place: None,
            line: beyond.line,
            block: beyond.block.clone(),
            form: None,
            times: beyond.times,
        }
    }
}
