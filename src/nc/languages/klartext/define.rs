//! Reads blocks that define something: `TOOL CALL`, `CYCL DEF`, `TRANS DATUM`.

use std::collections::BTreeMap;

use super::super::cursor::{Cursor, capitals};
use super::Path;
use super::block::Words;
use super::cycles::Cycle;
use crate::control::Meaning;
use crate::diag::Code;
use crate::nc::codes::bit;
use crate::nc::fault::{Done, Fault, once, refuse, twice};

/// The parameters of cycles that are feeds, which may be `AUTO`.
const FEEDS: [u16; 4] = [206, 207, 208, 253];

/// The feeds of cycles that may be `MAX`, a rapid.
const FAST_FEEDS: [u16; 2] = [208, 253];

impl Words<'_> {
    /// Reads `TOOL CALL 5 Z S2000 F300 DL+0.1`. Without a tool, the block only sets the speed.
    pub fn tool_call(&mut self, cursor: &mut Cursor<'_>) -> Done {
        let tool = match cursor.peek() {
            Some(b'"') => {
                let Some(name) = cursor.quoted() else { return Err(cursor.unreadable()) };
                Some(self.state.tool_names.word(name))
            }
            Some(byte) if byte.is_ascii_digit() => cursor.unsigned(),
            Some(b'Q' | b'q') => Some(self.number(cursor)?),
            _ => None,
        };
        if let Some(tool) = tool {
            self.block.put(b'T', tool);
            self.block.put(b'H', tool);
            self.block.m_word(6.0, 0, self.state.settings.control)?;
        }
        let (mut axis, mut feed) = (None, None);
        while !cursor.is_over() {
            let begin = cursor.at();
            let rest = cursor.rest().to_ascii_uppercase();
            let skip = |count: usize, cursor: &mut Cursor<'_>| *cursor = cursor.from(begin + count);
            match (rest.first(), rest.get(1)) {
                (Some(b'Z'), None | Some(b' ')) => {
                    skip(1, cursor);
                    once(&mut axis, (), "Z", begin)?;
                }
                (Some(b'X' | b'Y'), None | Some(b' ')) => {
                    let message = "a tool along X or Y is not supported";
                    return Err(Fault::at(Code::PN016, begin, message, "write TOOL CALL with Z"));
                }
                (Some(b'D'), Some(b'L' | b'R')) => {
                    let skipped = if rest.starts_with(b"DR2") { 3 } else { 2 };
                    skip(skipped, cursor);
                    if self.number(cursor)? != 0.0 {
                        let name = String::from_utf8_lossy(&rest[..skipped]).into_owned();
                        let message = format!("{name} of a tool call changes the length or the radius of the tool");
                        return Err(Fault::at(Code::PN016, begin, message, "enter the value in the tool table"));
                    }
                }
                (Some(b'S'), _) => {
                    skip(1, cursor);
                    let speed = self.number(cursor)?;
                    self.block.word(b'S', speed, false, begin, self.state.settings.control)?;
                }
                (Some(b'F'), _) => {
                    skip(1, cursor);
                    // this feed stays active until the next one, as the feed of a positioning block
                    if self.feed(cursor)? {
                        return Err(cursor.unreadable());
                    }
                    once(&mut feed, (), "F", begin)?;
                    self.own.tool_feed = self.own.feed;
                }
                _ => return Err(cursor.unreadable()),
            }
        }
        Ok(())
    }

    /// Reads a definition: `CYCL DEF 200 DRILLING ~ Q200=2 ..`, `CYCL DEF 7.1 X+10`, or `CYCL DEF 247 .. Q339=2`.
    pub fn cycle_definition(&mut self, cursor: &mut Cursor<'_>) -> Done {
        let begin = cursor.at();
        let Some(number) = cursor.unsigned() else { return Err(cursor.unreadable()) };
        let (cycle, part) = (number.trunc() as u16, (number.fract() * 10.0).round() as u16);
        let unknown = |what: &str| {
            let message = format!("CYCL DEF {number} is not supported{what}");
            Err(Fault::at(
                Code::PN016,
                begin,
                message,
                "run the program without the cycle, or write the cycle as moves",
            ))
        };
        if Cycle::is_known(cycle) {
            let cycle = Cycle { number: cycle, words: self.parameters(cursor)? };
            cycle.check()?;
            self.own.cycle = Some(cycle);
            self.own.calls_always = false;
            return Ok(());
        }
        match (cycle, part) {
            (247, _) => {
                let words = self.parameters(cursor)?;
                if let Some(word) = words.keys().find(|word| **word != 339) {
                    let message = format!("Q{word} in CYCL DEF 247 is not supported");
                    return Err(Fault::at(Code::PN016, begin, message, "write only Q339, the number of the datum"));
                }
                let datum = words.get(&339).copied().unwrap_or(0.0);
                if datum.fract() != 0.0 || !(1.0..=999.0).contains(&datum) {
                    let message = format!("datum {datum} is not supported");
                    return Err(Fault::at(Code::PN016, begin, message, "use datum 1 to 999"));
                }
                self.block.work = Some(datum);
                // a new datum resets the shift of cycle 7
                if self.state.shift() != &[0.0; 6] {
                    self.datum_reset()?;
                }
            }
            (7 | 9 | 10 | 11 | 32, 0) => {}
            (7, _) if cursor.peek() == Some(b'#') => return unknown(": a row of a datum table"),
            (7, _) => self.datum(cursor)?,
            (9, _) => {
                let seconds = self.named_value(cursor)?;
                self.dwell(seconds)?;
            }
            // a rotation or scaling is accepted only with the value that changes nothing
            (10 | 11, _) => {
                let neutral = if cycle == 10 { 0.0 } else { 1.0 };
                if self.named_value(cursor)? != neutral {
                    return unknown(": it turns or scales the frame");
                }
            }
            // the tolerance of the path
            (32, _) => {
                let text = capitals(cursor.rest().trim_ascii()).into_owned();
                self.own.left_out = Some(format!("CYCL DEF {number} {text}").into());
            }
            _ => return unknown(""),
        }
        Ok(())
    }

    /// Reads the value after a name, at the end of a line: `SCL 0.5`, `ROT+30`, `V.ZEIT 2`, `DWELL Q5`.
    fn named_value(&self, cursor: &mut Cursor<'_>) -> Done<f64> {
        loop {
            let begin = cursor.at();
            match cursor.letters() {
                // a parameter
                Some([b'Q' | b'q', ..]) => {
                    *cursor = cursor.from(begin);
                    break;
                }
                Some(_) if cursor.rest().get(1).is_none_or(|next| !next.is_ascii_digit()) => {
                    cursor.takes(b".");
                }
                Some(_) => {}
                None => break,
            }
        }
        let value = self.number(cursor)?;
        if cursor.is_over() { Ok(value) } else { Err(cursor.unreadable()) }
    }

    /// Reads `TOOL DEF 5`, which brings the next tool to its position for the tool change.
    pub fn next_tool(&mut self, cursor: &mut Cursor<'_>) -> Done {
        if cursor.unsigned().is_none() && cursor.quoted().or_else(|| cursor.name()).is_none() {
            return Err(cursor.unreadable());
        }
        if cursor.is_over() {
            return Ok(());
        }
        let message = "L and R of TOOL DEF set the length and the radius of the tool, which is not simulated";
        let help = "enter the values in the tool table, and write TOOL DEF without them";
        Err(Fault::at(Code::PN016, cursor.at(), message, help))
    }

    /// Sets the words of a dwell in seconds.
    pub fn dwell(&mut self, seconds: f64) -> Done {
        if seconds < 0.0 {
            return refuse(Code::PN018, format!("a dwell of {seconds} s"), "write the time without the minus");
        }
        self.code(Meaning::Dwell)?;
        self.block.put(b'P', seconds);
        Ok(())
    }

    /// Reads parameters such as `Q200=2 Q201=-20`. Text before the first parameter is the name of the cycle.
    fn parameters(&mut self, cursor: &mut Cursor<'_>) -> Done<BTreeMap<u16, f64>> {
        let mut words = BTreeMap::new();
        while !cursor.is_over() {
            let begin = cursor.at();
            // the name of the cycle is before the first parameter, and no `=` follows it
            let astray = !words.is_empty() || cursor.peek() == Some(b'=');
            let Some(name) = cursor.name() else {
                if astray {
                    return Err(cursor.unreadable());
                }
                *cursor = cursor.from(begin + 1);
                continue;
            };
            let name = String::from_utf8_lossy(name).to_ascii_uppercase();
            let number = name.strip_prefix('Q').and_then(|number| number.parse::<u16>().ok());
            let Some(number) = number.filter(|_| cursor.takes(b"=")) else {
                if astray {
                    return Err(cursor.from(begin).unreadable());
                }
                continue;
            };
            let value = if cursor.takes_word("MAX") {
                if !FAST_FEEDS.contains(&number) {
                    return refuse(Code::PN018, format!("MAX as the value of {name}"), "write a number");
                }
                f64::INFINITY
            } else if FEEDS.contains(&number) && cursor.takes_word("AUTO") {
                self.own
                    .tool_feed
                    .map_or_else(|| refuse(Code::PN008, "AUTO, but TOOL CALL has no feed", "write the feed"), Ok)?
            } else {
                self.number(cursor)?
            };
            if words.insert(number, value).is_some() {
                return twice(&name, begin);
            }
            self.own.values.insert(name, value);
        }
        Ok(words)
    }

    /// Reads a shift of the datum: `CYCL DEF 7.1 X+10`, or `TRANS DATUM AXIS X+10 Y+5`.
    pub fn datum(&mut self, cursor: &mut Cursor<'_>) -> Done {
        self.code(Meaning::Frame)?;
        let shift = *self.state.shift();
        while !cursor.is_over() {
            let begin = cursor.at();
            let Some((axis, value, by)) = self.axis(cursor)? else { return Err(cursor.unreadable()) };
            let letter = self.state.control.axes()[axis];
            if self.block.has(bit(letter)) {
                return twice(char::from(letter), begin);
            }
            self.block.put(letter, if by { shift[axis] + value } else { value });
        }
        if self.block.has_axes() { Ok(()) } else { Err(cursor.unreadable()) }
    }

    /// Runs `TRANS DATUM RESET`, which sets the shift of the datum to zero.
    pub fn datum_reset(&mut self) -> Done {
        self.code(Meaning::Frame)?;
        for letter in self.state.control.axes() {
            self.block.put(*letter, 0.0);
        }
        Ok(())
    }

    /// Reads M codes in a block without a path: `M5`, `STOP M9`.
    pub fn switches(&mut self, cursor: &mut Cursor<'_>) -> Done {
        self.path(Path::Line, cursor)
    }

    /// Sets the units that `BEGIN PGM NAME MM` contains.
    pub fn units(&mut self, inch: bool) -> Done {
        self.own.inch = inch;
        self.code(if inch { Meaning::Inch } else { Meaning::Mm })
    }
}
