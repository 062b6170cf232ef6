//! Finds the work offsets and tool lengths with which a program fits into a machine. The result contains an allowed
//! range for each of these values that the machine's file does not contain.

use std::collections::BTreeMap;

use super::extent::Extent;
use super::place::Needs;
use super::travel::Travels;
use crate::control::Control;
use crate::diag::Code;
use crate::machine::{Axis, LETTERS, Machine, offsets};
use crate::nc::FIRST_NAMED_TOOL;
use crate::verify::Finding;

/// The unknown value of a row, which may be the sum of an offset and a length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Unknown {
    Offset(usize),
    Length(i32),
    Sum(usize, i32),
}

/// An unknown offset or length, and its allowed range.
#[derive(Clone, Debug)]
struct Row {
    axis: usize,
    unknown: Unknown,
    /// The least and the greatest allowed value. If the least is above the greatest, no value is allowed.
    between: [f64; 2],
    /// Lines of the program with the extreme positions that limit the range.
    lines: [u64; 2],
}

/// The values with which a program fits into its machine.
#[derive(Clone, Debug)]
pub struct Fit {
    name: String,
    rows: Vec<Row>,
    extents: Vec<(usize, Needs, Option<u32>, Extent)>,
    /// The checks that were left out, one sentence each.
    pub not_checked: Vec<String>,
}

impl Fit {
    pub(super) fn of(machine: &Machine, travels: &Travels<'_>) -> Fit {
        let mut rows: BTreeMap<(usize, Unknown), Row> = BTreeMap::new();
        let limits = |axis: usize| machine.axes[axis].as_ref().and_then(Axis::limits);
        for ((axis, needs, _), extent) in &travels.extents {
            let Some([least, greatest]) = limits(*axis) else { continue };
            let unknown = match (needs.offset_unknown, needs.register.filter(|_| needs.length_unknown)) {
                (true, Some(register)) => Unknown::Sum(needs.work, register),
                (true, None) => Unknown::Offset(needs.work),
                (false, Some(register)) => Unknown::Length(register),
                (false, None) => continue,
            };
            let between = [least - extent.least.0, greatest - extent.greatest.0];
            let row = rows.entry((*axis, unknown)).or_insert(Row {
                axis: *axis,
                unknown,
                between: [f64::NEG_INFINITY, f64::INFINITY],
                lines: [0; 2],
            });
            if between[0] > row.between[0] {
                (row.between[0], row.lines[0]) = (between[0], extent.least.1);
            }
            if between[1] < row.between[1] {
                (row.between[1], row.lines[1]) = (between[1], extent.greatest.1);
            }
        }
        let extents =
            travels.extents.iter().map(|((axis, needs, tool), extent)| (*axis, *needs, *tool, *extent)).collect();
        Fit { name: machine.name.clone(), rows: rows.into_values().collect(), extents, not_checked: Vec::new() }
    }

    /// The findings for rows in which no value is allowed.
    pub(super) fn findings(&self, machine: &Machine, control: &Control) -> Vec<Finding> {
        let impossible = self.rows.iter().filter(|row| row.between[0] > row.between[1] + 1e-4);
        impossible
            .map(|row| {
                let over = machine.at(row.axis, row.between[0] - row.between[1]);
                Finding {
                    code: Code::PM001,
                    message: format!(
                        "no value of {} is possible, because line {} needs at least {} and line {} at most {}: the \
                         travel of {} is {over} too short",
                        self.what(row, control),
                        row.lines[0],
                        machine.at(row.axis, row.between[0]),
                        row.lines[1],
                        machine.at(row.axis, row.between[1]),
                        LETTERS[row.axis],
                    ),
                    help: "the program is longer than the travel: turn the part, or use another machine",
                    place: None,
                    line: row.lines[1],
                    block: String::new(),
                    form: None,
                    times: 1,
                }
            })
            .collect()
    }

    /// The allowed ranges, one sentence each: `this program fits if G54 Z lies between -318.2 and -121`.
    pub fn sentences(&self, machine: &Machine, control: &Control) -> Vec<String> {
        let possible = self.rows.iter().filter(|row| row.between[0] <= row.between[1]);
        possible
            .map(|row| {
                let [least, greatest] = row.between.map(|value| machine.at(row.axis, value));
                let verb = if matches!(row.unknown, Unknown::Sum(..)) { "lie" } else { "lies" };
                format!("this program fits if {} {verb} between {least} and {greatest}", self.what(row, control))
            })
            .collect()
    }

    fn what(&self, row: &Row, control: &Control) -> String {
        let letter = LETTERS[row.axis];
        let register = |register: i32| match control.is_lathe() {
            true => format!("{letter} of tool offset {register}"),
            // the tool is called by a name that the machine's table does not have
            false if f64::from(register) >= FIRST_NAMED_TOOL => "the length of the tool".to_owned(),
            false => format!("the length H{}", register.unsigned_abs()),
        };
        match row.unknown {
            Unknown::Offset(work) => format!("{} {letter}", offsets::name(control, work)),
            Unknown::Length(of) => register(of),
            Unknown::Sum(work, of) => {
                format!("{} {letter} and {} together", offsets::name(control, work), register(of))
            }
        }
    }

    /// The extents of the program as a table in text.
    pub fn table(&self, machine: &Machine, control: &Control) -> String {
        let mut lines = vec![["axis", "offset", "tool", "from", "to", "travel"].map(str::to_owned)];
        for (axis, needs, tool, extent) in &self.extents {
            let [least, greatest] = machine.axes[*axis].as_ref().and_then(Axis::limits).unwrap_or_default();
            let mark = if needs.offset_unknown || needs.length_unknown { " + ?" } else { "" };
            let at = |value: f64| format!("{}{mark}", machine.at(*axis, value));
            lines.push([
                LETTERS[*axis].to_string(),
                offsets::name(control, needs.work),
                tool.map_or("-".into(), |tool| format!("T{tool}")),
                at(extent.least.0),
                at(extent.greatest.0),
                format!("{} to {}", machine.at(*axis, least), machine.at(*axis, greatest)),
            ]);
        }
        let widths: Vec<usize> =
            (0..6).map(|column| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0)).collect();
        let mut text = format!("machine coordinates of {}, {}\n", self.name, machine.units.name());
        for line in &lines {
            let cells: Vec<String> =
                line.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}", width = *width)).collect();
            text += cells.join("  ").trim_end();
            text.push('\n');
        }
        text
    }

    /// The same table as JSON. Lengths are in the units of the machine's file; a side without a limit is `null`.
    pub fn json(&self, machine: &Machine, control: &Control) -> serde_json::Value {
        let value = |axis: usize, value: f64| machine.at(axis, value).parse::<f64>().ok();
        let limits = |axis: usize| {
            let limits = machine.axes[axis].as_ref().and_then(Axis::limits).unwrap_or_default();
            limits.map(|limit| value(axis, limit))
        };
        let extents: Vec<serde_json::Value> = self
            .extents
            .iter()
            .map(|(axis, needs, tool, extent)| {
                serde_json::json!({
                    "axis": LETTERS[*axis], "work": offsets::name(control, needs.work), "tool": tool,
                    "register": needs.register,
                    "offset_known": !needs.offset_unknown, "length_known": !needs.length_unknown,
                    "from": value(*axis, extent.least.0), "from_line": extent.least.1,
                    "to": value(*axis, extent.greatest.0), "to_line": extent.greatest.1,
                    "travel": limits(*axis),
                })
            })
            .collect();
        let needs: Vec<serde_json::Value> = self
            .rows
            .iter()
            .map(|row| {
                let (work, register) = match row.unknown {
                    Unknown::Offset(work) => (Some(work), None),
                    Unknown::Length(register) => (None, Some(register)),
                    Unknown::Sum(work, register) => (Some(work), Some(register)),
                };
                serde_json::json!({
                    "axis": LETTERS[row.axis], "work": work.map(|work| offsets::name(control, work)),
                    "register": register,
                    "from": value(row.axis, row.between[0]), "to": value(row.axis, row.between[1]),
                    "possible": row.between[0] <= row.between[1],
                })
            })
            .collect();
        serde_json::json!({
            "machine": self.name, "units": machine.units.name(), "extents": extents, "needs": needs,
            "not_checked": self.not_checked,
        })
    }
}
