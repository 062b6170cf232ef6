//! Reads blocks, and runs those that control the program flow: labels, repeated parts, conditions.

use std::borrow::Cow;
use std::collections::HashMap;

use super::super::cursor::{Cursor, capitals};
use super::block::Words;
use super::{Path, is_parameter};
use crate::diag::Code;
use crate::nc::action::{Action, Item};
use crate::nc::fault::{Done, Fault, refuse};
use crate::nc::simulator::{RunError, Simulator};
use crate::nc::way::{Frame, Jump, Search, Spot};

/// Skips the number of a block.
pub fn skip_number(cursor: &mut Cursor<'_>) {
    if cursor.takes(b"/") {
        skip_number(cursor);
    } else {
        cursor.pass_digits();
    }
}

/// The line without its comment. Decimal commas become points.
fn plain(line: &[u8]) -> Cow<'_, [u8]> {
    let line = line.trim_ascii_end();
    if memchr::memchr2(b',', b';', line).is_none() {
        return Cow::Borrowed(line);
    }
    let mut quoted = false;
    let mut plain = Vec::with_capacity(line.len());
    for byte in line {
        match byte {
            b'"' => quoted = !quoted,
            b';' if !quoted => break,
            _ => {}
        }
        plain.push(if *byte == b',' && !quoted { b'.' } else { *byte });
    }
    Cow::Owned(plain)
}

/// The label that a line defines: `LBL 5` or `LBL "POCKET"`.
fn label(line: &[u8]) -> Option<String> {
    let line = plain(line);
    let mut cursor = Cursor::new(&line, 0);
    skip_number(&mut cursor);
    if cursor.takes_word("LBL") { name(&mut cursor) } else { None }
}

/// Reads the number or the name of a label.
fn name(cursor: &mut Cursor<'_>) -> Option<String> {
    match cursor.quoted() {
        Some(name) => Some(String::from_utf8_lossy(name).into_owned()),
        None => cursor.unsigned().map(|number| format!("{number}")),
    }
}

impl Simulator<'_> {
    /// Reads the lines of a block: a line that ends with `~` continues on the next line. Also checks whether a rounding
    /// or chamfer follows.
    pub(in crate::nc) fn read_klartext_lines(&mut self) -> Result<bool, RunError> {
        self.klartext.begin = self.at;
        if !self.read_line()? {
            return Ok(false);
        }
        if self.line.trim_ascii_end().ends_with(b"~") {
            let mut whole = Vec::new();
            loop {
                let text = self.line.trim_ascii_end();
                let goes_on = text.ends_with(b"~");
                whole.extend_from_slice(&plain(text.strip_suffix(b"~").unwrap_or(text)));
                whole.push(b' ');
                if whole.len() > 1 << 16 {
                    let help = "check for a `~` too many";
                    return Err(self.refused(Fault::new(Code::PN001, "a block of more than 65536 bytes", help)));
                }
                if !goes_on {
                    break;
                }
                if !self.read_line()? {
                    let help = "write the lines that continue the block";
                    return Err(self.refused(Fault::new(Code::PN010, "the program ends after `~`", help)));
                }
            }
            self.line = whole;
        }
        self.klartext.ahead = None;
        if self.corner_follows()? {
            self.read_corner()?;
        }
        Ok(true)
    }

    /// Whether the next block is a rounding or chamfer.
    fn corner_follows(&mut self) -> Result<bool, RunError> {
        // the next line is usually in the buffer already
        let found = is_corner(self.input.buffer());
        if let Some(found) = found {
            return Ok(found);
        }
        let (back, text) = (self.at, std::mem::take(&mut self.line));
        let more = self.read_line()?;
        let found = more && is_corner(&self.line).unwrap_or(false);
        self.line = text;
        self.rewind(back)?;
        Ok(found)
    }

    /// Reads the rounding or chamfer that follows, and the block after it.
    fn read_corner(&mut self) -> Result<(), RunError> {
        let (back, text) = (self.at, self.line.clone());
        let mut ahead = [Vec::new(), Vec::new()];
        for block in &mut ahead {
            loop {
                if !self.read_line()? {
                    break;
                }
                *block = plain(&self.line).into_owned();
                let is_text = block.trim_ascii().is_empty() || block.contains(&b'*');
                if !is_text {
                    break;
                }
            }
        }
        self.klartext.ahead = Some(ahead);
        self.line = text;
        self.rewind(back)
    }

    /// Goes back to an earlier position in the input. Going back does not count as a jump of the program.
    fn rewind(&mut self, back: Spot) -> Result<(), RunError> {
        let offset = i128::from(back.byte) - i128::from(self.at.byte);
        self.input.seek_relative(i64::try_from(offset).unwrap_or(0))?;
        self.at = back;
        Ok(())
    }

    /// Reads the line into the block. If the line contains nothing to run, returns where the program continues.
    pub(in crate::nc) fn read_klartext(&mut self, items: &mut Vec<Item>) -> Done<Option<Jump>> {
        self.block.clear();
        let line = std::mem::take(&mut self.line);
        let jump = self.klartext_line(&line, items);
        let statement = self.klartext.left_out.take().map(Action::LeftOutWord);
        items.extend(statement.map(|action| Item { line: self.at.line, by_cycle: false, action }));
        self.line = line;
        jump
    }

    fn klartext_line(&mut self, line: &[u8], items: &mut Vec<Item>) -> Done<Option<Jump>> {
        let text = plain(line);
        let end = line.trim_ascii_end().len();
        if let Some(at) = memchr::memchr(b';', line) {
            self.block.comment = Some((at + 1, end.max(at + 1)));
        }
        let mut cursor = Cursor::new(&text, 0);
        let deleted = cursor.peek() == Some(b'/');
        skip_number(&mut cursor);
        if (cursor.takes(b"/") || deleted) && self.deletes(items) {
            return Ok(Some(Jump::On));
        }
        if cursor.is_over() {
            return Ok(self.block.comment.is_none().then_some(Jump::On));
        }
        if cursor.takes(b"*") {
            // a block that begins with `*` is the heading of a section
            let start = cursor.at().min(line.len());
            self.block.comment = Some((start, end.max(start)));
            return Ok(None);
        }
        self.blocks += 1;
        self.klartext_block(&mut cursor)
    }

    fn klartext_block(&mut self, cursor: &mut Cursor<'_>) -> Done<Option<Jump>> {
        let begin = cursor.at();
        let Some(word) = cursor.letters() else { return Err(cursor.unreadable()) };
        let word = capitals(word);
        let mut words = Words { own: &mut self.klartext, state: &self.state, block: &mut self.block };
        match word.as_ref() {
            "BEGIN" => {
                if words.own.begun {
                    let help = "put each program into a separate file";
                    return refuse(Code::PN010, "a second program begins before the first one ends", help);
                }
                words.own.begun = true;
                let unit = cursor.rest().trim_ascii_end().to_ascii_uppercase();
                if !unit.ends_with(b" MM") && !unit.ends_with(b" INCH") {
                    return refuse(
                        Code::PN007,
                        "BEGIN PGM without MM or INCH",
                        "write MM or INCH at the end of the line",
                    );
                }
                words.units(unit.ends_with(b" INCH"))?;
            }
            "END" => {
                items_end(&mut self.block, self.state.settings.control)?;
            }
            "BLK" => return Ok(Some(Jump::On)),
            "L" => words.path(Path::Line, cursor)?,
            "LP" => words.path(Path::Polar, cursor)?,
            "C" => words.path(Path::Arc, cursor)?,
            "CR" => words.path(Path::Radius, cursor)?,
            "CP" => words.path(Path::PolarArc, cursor)?,
            "CC" => {
                words.circle_center(cursor)?;
                return Ok(Some(Jump::On));
            }
            "RND" | "CHF" => words.rounding(cursor)?,
            "M" => {
                *cursor = cursor.from(begin);
                words.switches(cursor)?;
            }
            "STOP" => {
                words.block.m_word(0.0, begin, words.state.settings.control)?;
                words.switches(cursor)?;
            }
            "TOOL" if cursor.takes_word("CALL") => words.tool_call(cursor)?,
            "TOOL" if cursor.takes_word("DEF") => {
                words.next_tool(cursor)?;
                return Ok(Some(Jump::On));
            }
            "CYCL" if cursor.takes_word("CALL") => words.cycle_call(cursor)?,
            "CYCL" if cursor.takes_word("DEF") => words.cycle_definition(cursor)?,
            "TRANS" if cursor.takes_word("DATUM") => {
                if cursor.takes_word("RESET") {
                    words.datum_reset()?;
                } else if cursor.takes_word("AXIS") {
                    words.datum(cursor)?;
                } else {
                    return Err(cursor.unreadable());
                }
            }
            "PLANE" => {
                words.plane(cursor)?;
                return Ok(Some(Jump::On));
            }
            "FUNCTION" if cursor.takes_word("DWELL") => {
                cursor.takes(b"TIME");
                let seconds = words.value(cursor)?;
                if !cursor.is_over() {
                    return Err(cursor.unreadable());
                }
                words.dwell(seconds)?;
            }
            "LBL" => {
                let label = name(cursor);
                if label.is_none() || !cursor.is_over() {
                    return Err(cursor.unreadable());
                }
                if label.as_deref() == Some("0") && matches!(self.frames.last(), Some(Frame::Call { .. })) {
                    return self.return_from("LBL 0").map(Some);
                }
                return Ok(Some(Jump::On));
            }
            "CALL" if cursor.takes_word("LBL") => return self.call_label(cursor).map(Some),
            "FN" => return self.function(cursor).map(Some),
            "Q" | "QL" | "QR" => {
                *cursor = cursor.from(begin);
                let name = parameter(cursor)?;
                cursor.needs(b"=")?;
                let value = words.value(cursor)?;
                if !cursor.is_over() {
                    return Err(cursor.unreadable());
                }
                words.own.values.insert(name, value);
                return Ok(Some(Jump::On));
            }
            _ => {
                let message = format!("`{word}` is unknown");
                return Err(Fault::at(
                    Code::PN016,
                    begin,
                    message,
                    "run the program without the word, or write moves instead",
                ));
            }
        }
        self.block.is_empty = false;
        Ok(None)
    }

    /// Runs `CALL LBL 1`, or `CALL LBL 1 REP 3`, which runs the part between the label and this block 3 more times.
    fn call_label(&mut self, cursor: &mut Cursor<'_>) -> Done<Jump> {
        let Some(label) = name(cursor) else { return Err(cursor.unreadable()) };
        if !cursor.takes_word("REP") && !cursor.takes(b"REP") {
            if !cursor.is_over() {
                return Err(cursor.unreadable());
            }
            return Ok(Jump::Search(Search::Call(label, Vec::new(), 1)));
        }
        let words = Words { own: &mut self.klartext, state: &self.state, block: &mut self.block };
        let begin = cursor.at();
        let times = words.operand(cursor)?;
        // older controls write the number of repeats, and the number that is left: `REP 3/3`
        let left = if cursor.takes(b"/") { cursor.unsigned() } else { Some(times) };
        if left != Some(times) || !cursor.is_over() {
            let help = "write one number: REP 3, or the same number twice: REP 3/3";
            return Err(Fault::at(Code::PN001, begin, "the number of repeats can't be read", help));
        }
        if times.fract() != 0.0 || !(0.0..=65_534.0).contains(&times) {
            return refuse(Code::PN018, format!("REP {times} is not a number of repeats"), "write 1 to 65534");
        }
        let line = self.at.line;
        match self.klartext.repeats.last_mut() {
            Some((own, 0)) if *own == line => {
                self.klartext.repeats.pop();
                return Ok(Jump::On);
            }
            Some((own, left)) if *own == line => *left -= 1,
            _ if times == 0.0 => return Ok(Jump::On),
            _ => self.klartext.repeats.push((line, times as u32 - 1)),
        }
        Ok(Jump::Search(Search::Label(label, None)))
    }

    /// Runs a function: `FN 1: Q2 = +Q1 + +5` or `FN 9: IF +Q1 EQU +Q2 GOTO LBL 5`.
    fn function(&mut self, cursor: &mut Cursor<'_>) -> Done<Jump> {
        let begin = cursor.at();
        let Some(number) = cursor.unsigned().filter(|number| number.fract() == 0.0) else {
            return Err(cursor.from(begin).unreadable());
        };
        cursor.needs(b":")?;
        let number = number as u16;
        if (9..=12).contains(&number) {
            return self.condition(number, cursor);
        }
        if !matches!(number, 0..=8 | 13) {
            let message = format!("FN {number} is not supported");
            return Err(Fault::at(Code::PN016, begin, message, "run the program without it"));
        }
        let name = parameter(cursor)?;
        cursor.needs(b"=")?;
        let words = Words { own: &mut self.klartext, state: &self.state, block: &mut self.block };
        let operand = |cursor: &mut Cursor<'_>| words.operand(cursor);
        let both = |cursor: &mut Cursor<'_>, between: &str| -> Done<(f64, f64)> {
            let first = operand(cursor)?;
            let is_word = between.as_bytes()[0].is_ascii_alphabetic();
            if !if is_word { cursor.takes_word(between) } else { cursor.takes(between.as_bytes()) } {
                return Err(cursor.unreadable());
            }
            Ok((first, operand(cursor)?))
        };
        let of = |cursor: &mut Cursor<'_>, function: &str, apply: fn(f64) -> f64| -> Done<f64> {
            if !cursor.takes_word(function) {
                return Err(cursor.unreadable());
            }
            operand(cursor).map(apply)
        };
        let value = match number {
            0 => operand(cursor)?,
            1 => both(cursor, "+").map(|(a, b)| a + b)?,
            2 => both(cursor, "-").map(|(a, b)| a - b)?,
            3 => both(cursor, "*").map(|(a, b)| a * b)?,
            4 => both(cursor, "DIV").map(|(a, b)| a / b)?,
            5 => of(cursor, "SQRT", f64::sqrt)?,
            6 => of(cursor, "SIN", |x| x.to_radians().sin())?,
            7 => of(cursor, "COS", |x| x.to_radians().cos())?,
            8 => both(cursor, "LEN").map(|(a, b)| a.hypot(b))?,
            // the angle is from 0 to 360
            _ => both(cursor, "ANG").map(|(a, b)| a.atan2(b).to_degrees().rem_euclid(360.0))?,
        };
        if !value.is_finite() {
            return refuse(Code::PN014, format!("the result is {value}, not a number"), "check for a division by zero");
        }
        if !cursor.is_over() {
            return Err(cursor.unreadable());
        }
        self.klartext.values.insert(name, value);
        Ok(Jump::On)
    }

    fn condition(&mut self, number: u16, cursor: &mut Cursor<'_>) -> Done<Jump> {
        let words = Words { own: &mut self.klartext, state: &self.state, block: &mut self.block };
        if !cursor.takes_word("IF") {
            return Err(cursor.unreadable());
        }
        let first = words.operand(cursor)?;
        let named = ["EQU", "NE", "GT", "LT"][usize::from(number - 9)];
        if !cursor.takes_word(named) {
            return Err(cursor.unreadable());
        }
        let second = words.operand(cursor)?;
        if !cursor.takes_word("GOTO") || !cursor.takes_word("LBL") {
            return Err(cursor.unreadable());
        }
        let label = name(cursor).filter(|_| cursor.is_over());
        let Some(label) = label else { return Err(cursor.unreadable()) };
        let is_so = match number {
            9 => first == second,
            10 => first != second,
            11 => first > second,
            _ => first < second,
        };
        Ok(if is_so { Jump::Search(Search::Label(label, None)) } else { Jump::On })
    }

    /// Searches for the target of a jump, and jumps there.
    pub(in crate::nc) fn search_klartext(&mut self, search: Search) -> Result<(), RunError> {
        if self.klartext.labels.is_none() {
            let (back, farthest, text) = (self.at, self.farthest, self.line.clone());
            self.go(Spot { byte: 0, line: 0 })?;
            let mut labels = HashMap::new();
            while self.read_line()? {
                if let Some(label) = label(&self.line).filter(|label| label != "0") {
                    let at = self.at;
                    labels.entry(label).and_modify(|(_, twice)| *twice = true).or_insert((at, false));
                }
            }
            self.klartext.labels = Some(labels);
            self.go(back)?;
            (self.farthest, self.line) = (farthest, text);
        }
        let (label, calls) = match search {
            Search::Call(label, ..) => (label, true),
            Search::Label(label, _) => (label, false),
            Search::Part(_) => return Ok(()),
        };
        let found = self.klartext.labels.as_ref().and_then(|labels| labels.get(&label)).copied();
        let Some((start, false)) = found else {
            let (message, help) = match found {
                Some(_) => (format!("LBL {label} is twice in the program"), "give one of them another number"),
                None => (format!("there is no LBL {label}"), "check the spelling"),
            };
            return Err(self.refused(Fault::new(Code::PN015, message, help)));
        };
        if calls {
            let frame = Frame::Call { label, back: self.at, start, times: 1, arguments: false };
            if let Err(fault) = self.push(frame) {
                return Err(self.refused(fault));
            }
        }
        self.go(start)
    }
}

/// Reads the name of a parameter.
fn parameter(cursor: &mut Cursor<'_>) -> Done<String> {
    let begin = cursor.at();
    let name = cursor.name().map(|name| String::from_utf8_lossy(name).to_ascii_uppercase());
    match name {
        Some(name) if is_parameter(&name) => Ok(name),
        _ => Err(cursor.from(begin).unreadable()),
    }
}

/// Reads the plane of a block. Whether the plane is not tilted: `RESET`, or `SPATIAL` with three angles of zero.
fn is_level(cursor: &mut Cursor<'_>) -> bool {
    cursor.takes_word("RESET")
        || cursor.takes_word("SPATIAL")
            && [&b"SPA"[..], b"SPB", b"SPC"].iter().all(|word| cursor.takes(word) && cursor.signed() == Some(0.0))
}

impl Words<'_> {
    /// Runs `PLANE` with a plane that is not tilted. TURN and MOVE turn the rotary axes to 0, which is run only if the
    /// axes are at 0 already.
    fn plane(&self, cursor: &mut Cursor<'_>) -> Done {
        if !is_level(cursor) {
            let help = "program the part without a tilted plane";
            return refuse(Code::PN016, "a tilted plane is not simulated", help);
        }
        let turns = cursor.takes_word("TURN") || cursor.takes_word("MOVE");
        if turns && cursor.is_next(b"MB") {
            let help = "write PLANE without MB, and the height of the tool in a block with L";
            return refuse(Code::PN016, "PLANE with MB, which retracts the tool, is not simulated", help);
        }
        let turned = self.state.position()[3..].iter().any(|angle| *angle != 0.0);
        if turns && (turned || self.state.at_machine() & 0b11_1000 != 0) {
            let help = "write the positions of the rotary axes in a block with L, and PLANE with STAY";
            return refuse(Code::PN016, "PLANE with TURN or MOVE turns rotary axes that are not at 0", help);
        }
        Ok(())
    }
}

/// Whether the first line of a text is a rounding or chamfer. `None`: the text does not contain the whole line.
fn is_corner(text: &[u8]) -> Option<bool> {
    let line = match memchr::memchr(b'\n', text) {
        Some(end) => &text[..end],
        None if text.len() >= 64 => text,
        None => return None,
    };
    let mut cursor = Cursor::new(line, 0);
    skip_number(&mut cursor);
    Some(cursor.is_next(b"RND") || cursor.is_next(b"CHF"))
}

/// Ends the program at `END PGM`, like M30.
fn items_end(block: &mut crate::nc::block::Block, control: &'static crate::control::Control) -> Done {
    block.m_word(30.0, 0, control)
}
