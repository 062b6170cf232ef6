//! Reads tool tables: those of LinuxCNC, CSV files, and lists of G10 as Haas and Fanuc print them.

use std::collections::BTreeMap;

/// The tools of a machine by their numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ToolTable(pub BTreeMap<u32, Entry>);

impl ToolTable {
    /// The length in a register. The register has the number of its tool. If the register is negative, the length is
    /// negated.
    pub fn length(&self, register: i32) -> Option<f64> {
        let length = self.0.get(&register.unsigned_abs())?.length?;
        Some(if register < 0 { -length } else { length })
    }
}

/// The values of one tool, in millimetres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Entry {
    /// Length from the gauge line to the tip. G43 adds this value.
    pub length: Option<f64>,
    /// Diameter of the tool.
    pub diameter: Option<f64>,
    /// Name of the tool in the shop.
    pub name: Option<String>,
    /// Offset of the tip from the spindle axis along X and Y. Only tables of LinuxCNC contain this offset.
    pub aside: [f64; 2],
}

/// An error in a table: the number of the line from 1, and the reason.
pub type Wrong = (usize, String);

/// Reads a table. The format of the table is recognised from its text. `scale`: the number of millimetres in a unit of
/// the table.
///
/// # Errors
/// The line of the first error, and the reason.
pub fn read(text: &str, scale: f64) -> Result<ToolTable, Wrong> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines =
        text.lines().enumerate().map(|(at, line)| (at + 1, line.trim())).filter(|(_, line)| !line.is_empty());
    let is_g10 = |line: &str| line.to_ascii_uppercase().replace(' ', "").contains("G10L1");
    let is_linuxcnc = |line: &str| {
        let mut words = line.split(';').next().unwrap_or_default().split_ascii_whitespace();
        words.next().is_some_and(|word| word.starts_with(['T', 't']) && word[1..].parse::<u32>().is_ok())
    };
    if text.lines().any(is_g10) {
        return g10(text, scale);
    }
    let first = lines.clone().find(|(_, line)| !line.starts_with(';'));
    match first {
        None => Ok(ToolTable::default()),
        Some((_, line)) if is_linuxcnc(line) => linuxcnc(lines, scale),
        Some(_) => csv(&mut lines, scale),
    }
}

/// Reads a table of LinuxCNC, with lines such as `T5 P5 D10 Z123.4 ;end mill`.
fn linuxcnc<'t>(lines: impl Iterator<Item = (usize, &'t str)>, scale: f64) -> Result<ToolTable, Wrong> {
    let mut table = ToolTable::default();
    for (at, line) in lines {
        let (words, remark) = line.split_once(';').unwrap_or((line, ""));
        let (mut number, mut entry) = (None, Entry::default());
        for word in words.split_ascii_whitespace() {
            let mut chars = word.chars();
            let letter = chars.next().map_or(' ', |letter| letter.to_ascii_uppercase());
            let value = chars.as_str();
            let length = || value.parse().ok().filter(|value: &f64| value.is_finite()).map(|value| value * scale);
            let wrong = || (at, format!("`{word}` can't be in a tool table"));
            match letter {
                'T' => number = Some(value.parse::<u32>().map_err(|_| wrong())?),
                'Z' => entry.length = Some(length().ok_or_else(wrong)?),
                'D' => entry.diameter = Some(length().ok_or_else(wrong)?),
                'X' => entry.aside[0] = length().ok_or_else(wrong)?,
                'Y' => entry.aside[1] = length().ok_or_else(wrong)?,
                // pockets, other axes, angles and orientation are checked but not used
                'P' | 'A' | 'B' | 'C' | 'U' | 'V' | 'W' | 'I' | 'J' | 'Q' => {
                    length().ok_or_else(wrong)?;
                }
                _ => return Err(wrong()),
            }
        }
        let remark = remark.trim();
        entry.name = Some(remark.to_owned()).filter(|name| !name.is_empty());
        match number {
            Some(number) => put(&mut table, number, entry, at)?,
            None if words.trim().is_empty() => {}
            None => return Err((at, "a line of a tool table without T".into())),
        }
    }
    Ok(table)
}

/// Reads a table whose first line names the columns, such as `number,length,diameter,name`. The separator may also be a semicolon or a
/// tab.
fn csv(lines: &mut dyn Iterator<Item = (usize, &str)>, scale: f64) -> Result<ToolTable, Wrong> {
    let mut table = ToolTable::default();
    let Some((at, head)) = lines.next() else { return Ok(table) };
    let between = [';', '\t', ','].into_iter().find(|mark| head.contains(*mark)).unwrap_or(',');
    let cells = |line: &str| line.split(between).map(|cell| unquoted(cell.trim()).to_owned()).collect::<Vec<_>>();
    let head: Vec<String> = cells(head).iter().map(|cell| cell.to_ascii_lowercase()).collect();
    let column = |names: &[&str]| head.iter().position(|cell| names.contains(&cell.as_str()));
    let Some(number) = column(&["number", "tool", "t", "no", "nr"]) else {
        let message = "not a tool table: its first line has no column `number`; write number,length,diameter,name";
        return Err((at, message.into()));
    };
    let (length, diameter) = (column(&["length", "z", "h", "height"]), column(&["diameter", "d", "dia"]));
    let name = column(&["name", "description", "comment", "remark"]);
    for (at, line) in lines {
        let cells = cells(line);
        let cell = |column: Option<usize>| column.and_then(|column| cells.get(column)).filter(|cell| !cell.is_empty());
        let value = |column: Option<usize>, what: &str| match cell(column) {
            None => Ok(None),
            Some(text) => {
                // a table with semicolons may have decimal commas, as in 12,5
                let text = if between == ',' { text.clone() } else { text.replace(',', ".") };
                let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
                value.map(|value| Some(value * scale)).ok_or_else(|| (at, format!("`{text}` is not a {what}")))
            }
        };
        let Some(text) = cell(Some(number)) else { return Err((at, "a tool without a number".into())) };
        let digits = text.trim_start_matches(['T', 't']);
        let number = digits.parse::<u32>().map_err(|_| (at, format!("`{text}` is not a tool number")))?;
        let entry = Entry {
            length: value(length, "length")?,
            diameter: value(diameter, "diameter")?,
            name: cell(name).cloned(),
            ..Entry::default()
        };
        put(&mut table, number, entry, at)?;
    }
    Ok(table)
}

/// A cell without quotation marks around it. A single mark, such as an inch mark, is kept.
fn unquoted(cell: &str) -> &str {
    cell.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).unwrap_or(cell)
}

/// Reads lengths from lines such as `G10 L10 P5 R123.4`. `L12` is skipped, because the list does not show whether the
/// value is a radius or a diameter. `L11` and `L13` are wear. The wear of a length is added to the length.
fn g10(text: &str, scale: f64) -> Result<ToolTable, Wrong> {
    let mut table = ToolTable::default();
    let mut wear: BTreeMap<u32, f64> = BTreeMap::new();
    for (at, line) in text.lines().enumerate().map(|(at, line)| (at + 1, line)) {
        let line = line.split(['(', ';']).next().unwrap_or_default().to_ascii_uppercase().replace(' ', "");
        let value = |letter: char| -> Option<f64> {
            let (_, rest) = line.split_once(letter)?;
            let end = rest.find(|c: char| !matches!(c, '0'..='9' | '.' | '-' | '+')).unwrap_or(rest.len());
            rest.get(..end)?.parse().ok()
        };
        if !line.contains("G10L1") {
            continue;
        }
        let (Some(l), Some(p), Some(r)) = (value('L'), value('P'), value('R')) else {
            return Err((at, "G10 of a tool without L, P or R".into()));
        };
        if p.fract() != 0.0 || !(1.0..=9999.0).contains(&p) {
            return Err((at, format!("P{p} is not a tool number")));
        }
        let number = p as u32;
        match l as u32 {
            1 | 10 => table.0.entry(number).or_default().length = Some(r * scale),
            11 => _ = wear.insert(number, r * scale),
            _ => {}
        }
    }
    for (number, wear) in wear {
        if let Some(length) = table.0.get_mut(&number).and_then(|entry| entry.length.as_mut()) {
            *length += wear;
        }
    }
    Ok(table)
}

fn put(table: &mut ToolTable, number: u32, entry: Entry, at: usize) -> Result<(), Wrong> {
    match table.0.insert(number, entry) {
        None => Ok(()),
        Some(_) => Err((at, format!("T{number} is in the table twice"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(number: u32, length: f64, diameter: Option<f64>, name: Option<&str>) -> (u32, Entry) {
        (number, Entry { length: Some(length), diameter, name: name.map(str::to_owned), ..Entry::default() })
    }

    #[test]
    fn tables_are_read_by_what_they_show() {
        let linuxcnc = "; mm\nT1 P1 D10 Z50.5 ;end mill\nT12 P2 Z+80 D6.\n";
        let expected = [row(1, 50.5, Some(10.0), Some("end mill")), row(12, 80.0, Some(6.0), None)];
        assert_eq!(read(linuxcnc, 1.0).unwrap(), ToolTable(expected.into()));
        let csv = "Number;Length;Diameter;Name\r\nT5;123,4;10;\"Drill 10\"\r\n";
        assert_eq!(read(csv, 1.0).unwrap(), ToolTable([row(5, 123.4, Some(10.0), Some("Drill 10"))].into()));
        let g10 = "%\nG90 G10 L10 P3 R4.\nG10 L11 P3 R-.01\nG10 L12 P3 R.25\n%\n";
        assert_eq!(read(g10, 25.4).unwrap(), ToolTable([row(3, 4.0 * 25.4 - 0.254, None, None)].into()));
        assert_eq!(read("", 1.0).unwrap(), ToolTable::default());
    }

    #[test]
    fn a_wrong_line_is_named() {
        let table = [
            ("T1 Zx\n", 1, "`Zx`"),
            ("T1 Z1\nT1 Z2\n", 2, "twice"),
            ("number,length\n1,2\n2,nan\n", 3, "`nan`"),
            ("a,b\n1,2\n", 1, "number"),
            ("number,length\n1,4\"\n", 2, "`4\"` is not a length"),
            ("number\n\u{a1}\n", 2, "`\u{a1}`"),
            ("G10 L10 P1\n", 1, "without"),
            ("T1 \u{a1}5\n", 1, "`\u{a1}5`"),
        ];
        for (text, line, part) in table {
            let (at, message) = read(text, 1.0).unwrap_err();
            assert!(at == line && message.contains(part), "{text}: {at} {message}");
        }
    }
}
