//! Reads blocks, and runs those that control the program flow: labels, jumps, subprograms, variables.

use std::borrow::Cow;
use std::collections::HashMap;

use super::super::cursor::{Cursor, capitals};
use super::block::{Said, Words};
use crate::diag::Code;
use crate::nc::action::Item;
use crate::nc::fault::{Done, Fault, refuse};
use crate::nc::simulator::{RunError, Simulator};
use crate::nc::way::{Frame, Jump, Search, Spot};

/// Words with `=` that are no variables: speeds of a spindle for driven tools, and of the axis of the workpiece spindle.
const OF_MACHINE: [&str; 3] = ["QA", "SA", "SB"];

/// The columns of the first comment of a line. A comment without a closing bracket ends at the end of the line.
fn comment(line: &[u8]) -> Option<(usize, usize)> {
    let open = memchr::memchr(b'(', line)?;
    let close = line[open..].iter().position(|byte| *byte == b')').map(|at| open + at);
    Some((open + 1, close.unwrap_or(line.trim_ascii_end().len())))
}

/// The line, with spaces in place of its comments.
fn plain(line: &[u8]) -> Cow<'_, [u8]> {
    if memchr::memchr(b'(', line).is_none() {
        return Cow::Borrowed(line.trim_ascii_end());
    }
    let mut inside = false;
    let blank = |byte: &u8| {
        inside |= *byte == b'(';
        let shown = if inside { b' ' } else { *byte };
        inside &= *byte != b')';
        shown
    };
    let mut plain: Vec<u8> = line.iter().map(blank).collect();
    plain.truncate(plain.trim_ascii_end().len());
    Cow::Owned(plain)
}

/// The name of the program that begins at this line: `O100`, without other words.
fn program(line: &[u8]) -> Option<String> {
    memchr::memchr2(b'O', b'o', line)?; // most lines have no O
    let line = plain(line);
    let line = line.trim_ascii();
    let is_name =
        line.len() > 1 && line[0].eq_ignore_ascii_case(&b'O') && line[1..].iter().all(u8::is_ascii_alphanumeric);
    is_name.then(|| String::from_utf8_lossy(line).to_ascii_uppercase())
}

/// Reads the name of a block: `N10` or `NLOOP`, up to the next space. Leading zeros of a number are dropped.
fn block_name(cursor: &mut Cursor<'_>) -> Option<String> {
    let name = capitals(pass_block_name(cursor)?);
    let number = name.get(1..)?.parse::<u32>().ok();
    Some(number.map_or_else(|| name.to_string(), |number| format!("N{number}")))
}

/// Skips the name of a block, and returns it as written.
fn pass_block_name<'l>(cursor: &mut Cursor<'l>) -> Option<&'l [u8]> {
    let rest = cursor.rest();
    if !rest.first()?.eq_ignore_ascii_case(&b'N') {
        return None;
    }
    // a number may be followed by a word without a space, as in `N10G0`; names include words such as NCYL
    let length = match rest[1..].iter().take_while(|byte| byte.is_ascii_digit()).count() {
        0 => rest.iter().take_while(|byte| byte.is_ascii_alphanumeric()).count(),
        numbered => 1 + numbered,
    };
    let name = &rest[..length];
    if [b"NCYL", b"NOEX"].iter().any(|word| name.eq_ignore_ascii_case(*word)) {
        return None;
    }
    *cursor = cursor.from(cursor.at() + length);
    Some(name)
}

impl Simulator<'_> {
    /// Reads the line into the block. If the line contains nothing to run, returns where the program continues.
    pub(in crate::nc) fn read_osp(&mut self, items: &mut Vec<Item>) -> Done<Option<Jump>> {
        self.block.clear();
        self.osp.at_depth(self.frames.len());
        if self.is_transfer_line()? {
            return Ok(Some(Jump::On));
        }
        self.block.comment = comment(&self.line);
        let line = std::mem::take(&mut self.line);
        let jump = self.osp_line(&plain(&line), items);
        self.line = line;
        jump
    }

    /// Whether the line belongs to the transfer of the file, and not to the program: `$NAME.MIN%` before the first block,
    /// or `%`.
    ///
    /// # Errors
    /// Another line begins with `$`. On some controls it continues the block before.
    fn is_transfer_line(&self) -> Done<bool> {
        let line = self.line.trim_ascii();
        if !line.starts_with(b"$") {
            return Ok(line == b"%");
        }
        if self.blocks == 0 && line.ends_with(b"%") {
            return Ok(true);
        }
        let help = "write the words of this line in the line before it, and remove this line";
        refuse(Code::PN016, "a line that begins with `$` may continue the block before it: it is not simulated", help)
    }

    /// Reads a line without its comments.
    fn osp_line(&mut self, line: &[u8], items: &mut Vec<Item>) -> Done<Option<Jump>> {
        if program(line).is_some() {
            return match self.frames.last() {
                Some(Frame::Call { .. }) => {
                    refuse(Code::PN015, "the subprogram has no end", "end the subprogram with RTS")
                }
                _ => Ok(Some(Jump::On)),
            };
        }
        let mut cursor = Cursor::new(line, 0);
        let mut deleted = cursor.takes(b"/");
        pass_block_name(&mut cursor);
        deleted |= cursor.takes(b"/");
        if deleted && self.deletes(items) {
            return Ok(Some(Jump::On));
        }
        if cursor.is_over() {
            return Ok(self.block.comment.is_none().then_some(Jump::On));
        }
        self.blocks += 1;
        if !cursor.is_words()
            && let Some(jump) = self.osp_way(&mut cursor)?
        {
            return Ok(Some(jump));
        }
        let mut words = Words { own: &mut self.osp, state: &self.state, block: &mut self.block, said: Said::default() };
        words.read(&mut cursor)?;
        let block = &self.block;
        let nothing =
            block.given == 0 && !block.has_g && !block.has_m() && block.call.is_none() && block.work.is_none();
        Ok((nothing && block.comment.is_none()).then_some(Jump::On))
    }

    /// Runs statements that control the program flow or set a variable. `None`: the block contains other words.
    fn osp_way(&mut self, cursor: &mut Cursor<'_>) -> Done<Option<Jump>> {
        let begin = cursor.at();
        let Some(name) = cursor.name() else { return Err(cursor.unreadable()) };
        let name = capitals(name);
        let words = Words { own: &mut self.osp, state: &self.state, block: &mut self.block, said: Said::default() };
        let jump = match name.as_ref() {
            "IF" => {
                let is_so = words.value(cursor)? != 0.0;
                cursor.takes_word("GOTO");
                let Some(label) = block_name(cursor) else { return Err(cursor.unreadable()) };
                if is_so { Jump::Search(Search::Label(label, None)) } else { Jump::On }
            }
            "GOTO" => {
                let Some(label) = block_name(cursor) else { return Err(cursor.unreadable()) };
                Jump::Search(Search::Label(label, None))
            }
            "RTS" => {
                if !matches!(self.frames.last(), Some(Frame::Call { .. })) {
                    return refuse(Code::PN015, "RTS in a main program", "end the main program with M2 or M30");
                }
                return self.return_from("RTS").map(Some);
            }
            "CALL" => {
                let Some(program) = cursor.name() else { return Err(cursor.unreadable()) };
                let program = String::from_utf8_lossy(program).to_ascii_uppercase();
                let (mut arguments, mut times) = (HashMap::new(), 1.0);
                while !cursor.is_over() {
                    let Some(name) = cursor.name() else { return Err(cursor.unreadable()) };
                    let name = String::from_utf8_lossy(name).to_ascii_uppercase();
                    if let Some(count) = name.strip_prefix('Q').and_then(|count| count.parse::<f64>().ok()) {
                        times = count;
                        continue;
                    }
                    cursor.needs(b"=")?;
                    arguments.insert(name, words.value(cursor)?);
                }
                if times.fract() != 0.0 || !(0.0..=9999.0).contains(&times) {
                    return refuse(Code::PN018, format!("Q{times} is not a number of calls"), "write Q1 to Q9999");
                }
                words.own.arguments = arguments;
                Jump::Search(Search::Call(program, Vec::new(), times as u32))
            }
            name if OF_MACHINE.contains(&name) && cursor.peek() == Some(b'=') => {
                let message = format!("`{name}` is a word of machines with a driven tool: it is not simulated");
                return Err(Fault::at(
                    Code::PN016,
                    begin,
                    message,
                    "give the variable another name, or remove the word",
                ));
            }
            // `VC1=..` and `LOOP=..` set variables; words of one letter are axes or other words
            name if name.len() > 1 && cursor.peek() == Some(b'=') && name != "FA" && !is_word(name) => {
                let common = name.strip_prefix("VC").is_some_and(|number| number.parse::<u16>().is_ok());
                if name.starts_with('V') && !common {
                    let message = format!("`{name}` is a variable of the machine");
                    return Err(Fault::at(
                        Code::PN016,
                        begin,
                        message,
                        "positions after this block are unknown: run the program without the variable",
                    ));
                }
                cursor.takes(b"=");
                let value = words.value(cursor)?;
                let kept = if common { Some(&mut words.own.common) } else { words.own.local.last_mut() };
                if let Some(kept) = kept {
                    kept.insert(name.to_owned(), value);
                }
                Jump::On
            }
            name if name.starts_with('V') && cursor.peek() == Some(b'[') => {
                let message = format!("`{name}` is a variable of the machine");
                return Err(Fault::at(
                    Code::PN016,
                    begin,
                    message,
                    "positions after this block are unknown: run the program without the variable",
                ));
            }
            _ => {
                *cursor = cursor.from(begin);
                return Ok(None);
            }
        };
        if cursor.is_over() { Ok(Some(jump)) } else { Err(cursor.unreadable()) }
    }

    /// Searches for the target of a jump, and jumps there.
    pub(in crate::nc) fn search_osp(&mut self, search: Search) -> Result<(), RunError> {
        if self.osp.labels.is_none() {
            let (back, farthest, text) = (self.at, self.farthest, self.line.clone());
            self.go(Spot { byte: 0, line: 0 })?;
            let (mut labels, mut inside) = (HashMap::new(), String::new());
            let mut before = self.at;
            while self.read_line()? {
                if let Some(name) = program(&self.line) {
                    labels.entry((name.clone(), String::new())).or_insert(self.at);
                    inside = name;
                } else {
                    let text = plain(&self.line);
                    let mut cursor = Cursor::new(&text, 0);
                    cursor.takes(b"/");
                    if let Some(name) = block_name(&mut cursor) {
                        labels.entry((inside.clone(), name)).or_insert(before);
                    }
                }
                before = self.at;
            }
            self.osp.labels = Some(labels);
            self.go(back)?;
            (self.farthest, self.line) = (farthest, text);
        }
        let labels = self.osp.labels.as_ref();
        let found = |program: &str, label: &str| {
            labels.and_then(|labels| labels.get(&(program.to_owned(), label.to_owned()))).copied()
        };
        let here = self.frames.iter().rev().find_map(|frame| match frame {
            Frame::Call { label, .. } => Some(label.clone()),
            _ => None,
        });
        let (spot, missing) = match &search {
            Search::Label(label, _) => {
                // the main program may have no name
                let spot = match &here {
                    Some(program) => found(program, label),
                    None => labels.and_then(|labels| {
                        let own = labels.iter().filter(|((_, name), _)| name == label).map(|(_, spot)| *spot);
                        own.min_by_key(|spot| spot.line)
                    }),
                };
                (spot, format!("there is no block {label}"))
            }
            Search::Call(_, _, 0) | Search::Part(_) => return Ok(()),
            Search::Call(program, ..) => (found(program, ""), format!("there is no subprogram {program} in this file")),
        };
        let Some(start) = spot else {
            let code = if matches!(search, Search::Label(..)) { Code::PN015 } else { Code::PN016 };
            return Err(self.refused(Fault::new(
                code,
                missing,
                "check the spelling, or add the block or subprogram to the file",
            )));
        };
        if let Search::Call(label, _, times) = search {
            let frame = Frame::Call { label, back: self.at, start, times, arguments: false };
            if let Err(fault) = self.push(frame) {
                return Err(self.refused(fault));
            }
        }
        self.go(start)
    }
}

/// Whether a name is not a variable, but one of the letters G, M, N and O with a number.
fn is_word(name: &str) -> bool {
    let bytes = name.as_bytes();
    matches!(bytes[0], b'G' | b'M' | b'N' | b'O') && bytes[1..].iter().all(u8::is_ascii_digit)
}
