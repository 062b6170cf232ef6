//! Blocks that control the program flow: labels, conditions, loops, subprograms.

use super::super::cursor::{Cursor, capitals};
use super::super::formula::is_equal;
use super::block::{EQUAL, Words};
use super::head::{Head, head, number, section, without_comment};
use super::ways::{Kind, Repeat, Saved, Siemens, Variable};
use crate::diag::Code;
use crate::nc::action::{Action, Item};
use crate::nc::fault::{Done, Fault, refuse};
use crate::nc::simulator::Simulator;
use crate::nc::state::{Modes, State};
use crate::nc::way::{Jump, Search};

impl Simulator<'_> {
    /// Reads the line into the block. If the line contains nothing to run, returns where the program continues.
    pub(in crate::nc) fn read_siemens(&mut self, items: &mut Vec<Item>) -> Done<Option<Jump>> {
        self.block.clear();
        self.siemens.at_depth(self.frames.len());
        self.restore()?;
        if section(&self.line).is_some() {
            return self.section_begins();
        }
        let (_, comment) = without_comment(&self.line);
        self.block.comment = comment;
        let mut line = std::mem::take(&mut self.line);
        let result = self.siemens_line(without_comment(&line).0, items);
        std::mem::swap(&mut self.line, &mut line);
        let words = self.siemens.left_out.drain(..).map(Action::LeftOutWord);
        items.extend(words.map(|action| Item { line: self.at.line, by_cycle: false, action }));
        let jump = result?;
        if jump.is_none() && self.block.is_empty && self.block.comment.is_none() {
            return Ok(Some(Jump::On));
        }
        self.blocks += 1;
        Ok(jump)
    }

    /// Runs the first line of a section. A subprogram that runs into this section ends here. A main program must not
    /// run into this section.
    fn section_begins(&mut self) -> Done<Option<Jump>> {
        let is_proc = !self.line.trim_ascii_start().starts_with(b"%");
        if let (true, Some(arguments)) = (is_proc, self.siemens.arguments.take()) {
            return self.bind(&arguments).map(|()| Some(Jump::On));
        }
        if self.blocks == 0 {
            return Ok(Some(Jump::On));
        }
        if self.frames.is_empty() {
            let help = "a program ends with M30, M2 or M17";
            return refuse(Code::PN010, "the end of the program is missing, so it runs into the next program", help);
        }
        self.return_from("a subprogram").map(Some)
    }

    /// Assigns the arguments of the call to the names in `PROC NAME(REAL A, REAL B)`.
    fn bind(&mut self, arguments: &[Option<f64>]) -> Done {
        let line = self.line.clone();
        let mut cursor = Cursor::new(without_comment(&line).0, head(&line).start);
        cursor.name();
        cursor.name();
        let mut arguments = arguments.iter();
        if cursor.takes(b"(") {
            while !cursor.takes(b")") {
                let (Some(kind), Some(name)) = (cursor.name(), cursor.name()) else { return Err(cursor.unreadable()) };
                let Some(kind) = Kind::named(kind) else {
                    let message = format!("an argument of type {} is not supported", String::from_utf8_lossy(kind));
                    return refuse(Code::PN016, message, "give the subprogram numbers");
                };
                let name = String::from_utf8_lossy(name).to_ascii_uppercase();
                let value = arguments.next().copied().flatten().unwrap_or(0.0);
                if let Some(own) = self.siemens.variables.last_mut() {
                    own.insert(name, Variable { kind, value: kind.holds(value) });
                }
                cursor.takes(b",");
                if cursor.is_over() {
                    return Err(cursor.unreadable());
                }
            }
        }
        if arguments.next().is_some() {
            let message = "a call has more arguments than the PROC line of the subprogram";
            return refuse(Code::PN018, message, "leave the additional arguments out");
        }
        while !cursor.is_over() {
            let begin = cursor.at();
            match cursor.name().map(capitals).as_deref() {
                Some("SAVE") => self.siemens.saved.push((self.frames.len(), self.state.saved())),
                // these change only the display, and stops between blocks
                Some("DISPLOF" | "DISPLON" | "SBLOF" | "SBLON" | "ACTBLOCNO") => {}
                _ => return Err(cursor.from(begin).unreadable()),
            }
        }
        Ok(())
    }

    /// At the end of a subprogram with `SAVE`, restores the modes that were active at its beginning. Modes that other
    /// parts of the control depend on are not restored: a change of these modes is refused.
    fn restore(&mut self) -> Done {
        while let Some((_, saved)) = self.siemens.saved.pop_if(|(depth, _)| *depth > self.frames.len()) {
            let now = self.state.saved();
            let kept = |saved: &Saved| {
                let Modes { plane, units, feed_mode, .. } = saved.modes;
                (plane, units, feed_mode, saved.shift, saved.work, saved.side)
            };
            if kept(&now) != kept(&saved) {
                let message = "a subprogram with SAVE changes a plane, units, a feed mode, a frame or a compensation";
                let help = "restore the codes at the end of the subprogram, and remove SAVE";
                return refuse(Code::PN016, message, help);
            }
            self.state.modes = saved.modes;
        }
        Ok(())
    }

    fn siemens_line(&mut self, line: &[u8], items: &mut Vec<Item>) -> Done<Option<Jump>> {
        let mut cursor = Cursor::new(line, 0);
        if cursor.takes(b"/") {
            if cursor.peek().is_some_and(|byte| byte.is_ascii_digit()) {
                cursor.unsigned();
            }
            if self.deletes(items) {
                return Ok(Some(Jump::On));
            }
        }
        let mut cursor = number(line).1;
        if cursor.is_words() {
            self.block.is_empty = false;
            let mut words = Words { own: &mut self.siemens, state: &self.state, block: &mut self.block };
            return words.read(&mut cursor).map(|()| None);
        }
        let head = head(line);
        cursor = cursor.from(head.start);
        if head.is("ENDLABEL") && self.siemens.repeats_at(self.frames.len()) {
            if !cursor.is_over() {
                let help = "write ENDLABEL: in a separate line";
                return refuse(Code::PN016, "ENDLABEL with a statement in its line is not supported", help);
            }
            return Ok(Some(self.next_round()));
        }
        if cursor.is_over() {
            return Ok(None);
        }
        if head.word.is_empty() {
            return Err(cursor.unreadable());
        }
        self.block.is_empty = false;
        if let Some(jump) = self.siemens_way(&head, &mut cursor)? {
            return Ok(Some(jump));
        }
        if cursor.is_over() {
            return Ok(None);
        }
        let begin = cursor.at();
        let mut words = Words { own: &mut self.siemens, state: &self.state, block: &mut self.block };
        // a modal cycle, `MCALL CYCLE81(..)`, or a single one, `CYCLE81(..)`
        let modal = cursor.takes_word("MCALL");
        if modal && cursor.is_over() {
            words.own.modal = None;
            return Ok(None);
        }
        let at = cursor.at();
        let name = cursor.name().map(capitals).unwrap_or_default();
        match name.as_ref() {
            _ if name.starts_with("CYCLE") => match words.cycle(&name, &mut cursor)? {
                Some(call) if modal => words.own.modal = Some(call),
                Some(call) => words.block.call = Some(call),
                // CYCLE800 without arguments ends a tilted plane, which is refused at its beginning
                None if name == "CYCLE800" && [&b""[..], b"()"].contains(&cursor.rest().trim_ascii()) => {
                    return Ok(None);
                }
                // CYCLE832 only sets the smoothing of the path
                None if name == "CYCLE832" => {
                    // the kind of machining may be a name of the control: `CYCLE832(0.05,_ROUGH,1)`
                    if cursor.takes(b"(") {
                        cursor.pass_brackets()?;
                    }
                    words.own.left_out.push(capitals(line[at..cursor.at()].trim_ascii()).into());
                }
                None => {
                    let message = format!("{name} is not supported");
                    return Err(Fault::at(
                        Code::PN016,
                        at,
                        message,
                        "run the program without the cycle, or write the moves of the cycle",
                    ));
                }
            },
            "HOLES1" | "HOLES2" if !modal => words.pattern(name == "HOLES2", &mut cursor)?,
            "TRANS" | "ATRANS" if !modal => words.translate(name == "ATRANS", &mut cursor)?,
            _ if modal => {
                let message = format!("`MCALL {name}` is not supported");
                return Err(Fault::at(Code::PN016, at, message, "MCALL takes CYCLE81 to CYCLE89 and CYCLE840"));
            }
            _ => {
                cursor = Cursor::new(line, begin);
                return words.read(&mut cursor).map(|()| None);
            }
        }
        if cursor.is_over() { Ok(None) } else { Err(cursor.unreadable()) }
    }

    /// Runs statements that control the program flow or set variables. `None`: the line is another statement.
    fn siemens_way(&mut self, head: &Head<'_>, cursor: &mut Cursor<'_>) -> Done<Option<Jump>> {
        let begin = cursor.at();
        let words = Words { own: &mut self.siemens, state: &self.state, block: &mut self.block };
        cursor.name();
        let jump = match head.word.as_ref() {
            "IF" => {
                let is_so = words.value(cursor)? != 0.0;
                match cursor.is_over() {
                    true => self.opens(is_so),
                    false if is_so => return goes_to(cursor).map(Some),
                    false => Jump::On,
                }
            }
            "GOTO" | "GOTOF" | "GOTOB" => {
                *cursor = cursor.from(begin);
                return goes_to(cursor).map(Some);
            }
            "ELSE" | "ENDIF" | "ENDWHILE" | "ENDFOR" | "ENDLOOP" | "UNTIL" => {
                if head.word == "ENDIF" || head.word == "UNTIL" && words.value(cursor)? != 0.0 {
                    return Ok(Some(Jump::On));
                }
                let Some(to) = words.own.ends.get(&self.at.line).copied() else {
                    let help = "jump to the line where the loop or condition begins";
                    return refuse(Code::PN015, format!("{} has no beginning", head.word), help);
                };
                if head.word == "ENDFOR" {
                    words.own.next_round = Some(to.line + 1);
                }
                Jump::To(to)
            }
            "WHILE" => {
                let is_so = words.value(cursor)? != 0.0;
                self.opens(is_so)
            }
            "LOOP" => self.opens(true),
            "REPEAT" if cursor.is_over() => self.opens(true),
            "REPEAT" => return self.repeats(cursor).map(Some),
            "FOR" => self.counts(cursor)?,
            "RET" => return self.return_from("RET").map(Some),
            "DEF" => words.defines(begin, cursor)?,
            "MSG" => {
                cursor.needs(b"(")?;
                let start = cursor.at() + 1;
                if let Some(text) = cursor.quoted() {
                    words.block.comment = Some((start, start + text.len()));
                }
                cursor.needs(b")")?;
                return if cursor.is_over() { Ok(None) } else { Err(cursor.unreadable()) };
            }
            "WORKPIECE" | "GROUP_BEGIN" | "GROUP_END" => Jump::On,
            // sets a variable: `R1=5`, `NAME=5`
            name if cursor.peek() == Some(b'=')
                && !cursor.rest().starts_with(b"==")
                && is_variable(name, words.own) =>
            {
                words.sets(name, cursor)?
            }
            name if is_call(name, cursor, line_name(name)) => words.calls(name, cursor)?,
            _ => {
                *cursor = cursor.from(begin);
                return Ok(None);
            }
        };
        if matches!(jump, Jump::On | Jump::To(_)) && !cursor.is_over() {
            return if head.word == "IF" || head.word == "WORKPIECE" || head.word.starts_with("GROUP") {
                Ok(Some(jump))
            } else {
                Err(cursor.unreadable())
            };
        }
        Ok(Some(jump))
    }

    /// Runs FOR: sets the variable and decides whether another round begins.
    fn counts(&mut self, cursor: &mut Cursor<'_>) -> Done<Jump> {
        let words = Words { own: &mut self.siemens, state: &self.state, block: &mut self.block };
        let Some(name) = cursor.name() else { return Err(cursor.unreadable()) };
        let name = String::from_utf8_lossy(name).to_ascii_uppercase();
        cursor.needs(b"=")?;
        let first = words.value(cursor)?;
        if !cursor.takes_word("TO") {
            return Err(cursor.unreadable());
        }
        let last = words.value(cursor)?;
        let goes_on = words.own.next_round.take() == Some(self.at.line);
        let value = if goes_on { words.own.value(&name).unwrap_or(first) + 1.0 } else { first };
        if !words.own.set(&name, value) {
            let help = "write DEF INT for the variable before the loop";
            return refuse(Code::PN014, format!("`{name}` is not defined"), help);
        }
        Ok(self.opens(value <= last || is_equal(value, last, EQUAL)))
    }

    /// Handles a line that opens a part of the program: the part is run or skipped.
    fn opens(&self, enters: bool) -> Jump {
        match self.siemens.parts.get(&self.at.line) {
            Some(_) if enters => Jump::On,
            Some(part) => Jump::To(part.middle.unwrap_or(part.end)),
            None => Jump::Search(Search::Part(enters)),
        }
    }

    /// Runs `REPEAT LABEL P=3`: the lines between the label and this line are run 3 more times.
    fn repeats(&mut self, cursor: &mut Cursor<'_>) -> Done<Jump> {
        let Some(label) = cursor.name() else { return Err(cursor.unreadable()) };
        let label = String::from_utf8_lossy(label).to_ascii_uppercase();
        let words = Words { own: &mut self.siemens, state: &self.state, block: &mut self.block };
        let mut times = 1.0;
        if !cursor.is_over() {
            if !cursor.takes_word("P") || !cursor.takes(b"=") {
                let help = "write REPEAT LABEL P=3 after the part that is repeated";
                return refuse(Code::PN016, "REPEAT of a part between two labels is not supported", help);
            }
            times = words.value(cursor)?;
        }
        if times.fract() != 0.0 || !(0.0..=1e6).contains(&times) {
            return refuse(Code::PN018, format!("P={times} is not a number of repeats"), "write a whole number");
        }
        if self.siemens.repeats.last().is_none_or(|repeat| repeat.after != self.at) {
            let (after, depth) = (self.at, self.frames.len());
            self.siemens.repeats.push(Repeat { label, after, depth, left: times as u32 });
        }
        Ok(self.next_round())
    }

    /// Runs the part of the last `REPEAT` once more, or continues after this `REPEAT`.
    fn next_round(&mut self) -> Jump {
        match self.siemens.repeats.last_mut() {
            Some(Repeat { left: 0, .. }) | None => {
                Jump::To(self.siemens.repeats.pop().map_or(self.at, |repeat| repeat.after))
            }
            Some(Repeat { label, left, .. }) => {
                *left -= 1;
                Jump::Search(Search::Label(label.clone(), Some(false)))
            }
        }
    }
}

impl State {
    /// The modes that `SAVE` keeps.
    fn saved(&self) -> Saved {
        Saved { modes: self.modes.clone(), shift: *self.shift(), work: self.place.work, side: self.tool.side }
    }
}

/// Reads a jump such as `GOTOF LABEL`.
fn goes_to(cursor: &mut Cursor<'_>) -> Done<Jump> {
    let Some(word) = cursor.name() else { return Err(cursor.unreadable()) };
    let forwards = match String::from_utf8_lossy(word).to_ascii_uppercase().as_str() {
        "GOTOF" => Some(true),
        "GOTOB" => Some(false),
        "GOTO" => None,
        _ => return Err(cursor.unreadable()),
    };
    let Some(label) = cursor.name() else { return Err(cursor.unreadable()) };
    if !cursor.is_over() {
        return Err(cursor.unreadable());
    }
    let label = String::from_utf8_lossy(label).to_ascii_uppercase();
    let number = label.strip_prefix('N').and_then(|number| number.parse::<u32>().ok());
    Ok(Jump::Search(Search::Label(number.map_or(label, |number| format!("N{number}")), forwards)))
}

fn is_variable(name: &str, own: &Siemens) -> bool {
    own.value(name).is_some() || name.strip_prefix('R').is_some_and(|number| number.parse::<u32>().is_ok())
}

/// Whether a name can be the name of a subprogram: it begins with two letters, such as `POCKET`, or it is L with a
/// number.
fn line_name(name: &str) -> bool {
    let is_numbered =
        name.strip_prefix('L').is_some_and(|number| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()));
    let letters = name.bytes().take(2).filter(|byte| byte.is_ascii_alphabetic() || *byte == b'_').count();
    is_numbered || letters == 2
}

/// Whether a name calls a subprogram. A call is the name without further words, or the name with its arguments.
fn is_call(name: &str, cursor: &Cursor<'_>, is_name: bool) -> bool {
    let own = ["CYCLE", "HOLES", "TRANS", "ATRANS", "MCALL", "SUPA"];
    let rest = cursor.rest();
    let alone = rest.is_empty() || rest[0] == b'(' || rest[0].eq_ignore_ascii_case(&b'P');
    let is_known = super::block::is_harmless(name) || super::block::not_run(name).is_some();
    is_name && alone && !is_known && !own.iter().any(|known| name.starts_with(known))
}

/// Reads the number of calls of a subprogram, such as `P3` after the call.
fn calls(cursor: &mut Cursor<'_>) -> f64 {
    if cursor.takes(b"P") || cursor.takes(b"p") { cursor.unsigned().unwrap_or(-1.0) } else { 1.0 }
}

impl Words<'_> {
    /// Runs DEF: defines variables of one type. `begin`: the column of DEF.
    fn defines(self, begin: usize, cursor: &mut Cursor<'_>) -> Done<Jump> {
        let Some(name) = cursor.name() else { return Err(cursor.unreadable()) };
        let Some(kind) = Kind::named(name) else {
            let message = format!("variables of type {} are not supported", String::from_utf8_lossy(name));
            return Err(Fault::at(Code::PN016, begin, message, "use REAL, INT or BOOL"));
        };
        loop {
            let Some(name) = cursor.name() else { return Err(cursor.unreadable()) };
            let name = String::from_utf8_lossy(name).to_ascii_uppercase();
            let value = if cursor.takes(b"=") { self.value(cursor)? } else { 0.0 };
            if let Some(own) = self.own.variables.last_mut() {
                own.insert(name, Variable { kind, value: kind.holds(value) });
            }
            if !cursor.takes(b",") {
                return Ok(Jump::On);
            }
        }
    }

    /// Sets variables: one block may set several.
    fn sets(self, name: &str, cursor: &mut Cursor<'_>) -> Done<Jump> {
        cursor.takes(b"=");
        let value = self.value(cursor)?;
        self.own.set(name, value);
        while let Some(name) = cursor.name() {
            let name = String::from_utf8_lossy(name).to_ascii_uppercase();
            cursor.needs(b"=")?;
            let value = self.value(cursor)?;
            if !self.own.set(&name, value) {
                let message = format!("`{name}` is unknown in a block that sets a variable");
                return refuse(Code::PN016, message, "write the word in a separate block");
            }
        }
        Ok(Jump::On)
    }

    /// Calls a subprogram by its name.
    fn calls(self, name: &str, cursor: &mut Cursor<'_>) -> Done<Jump> {
        let arguments = self.arguments(cursor)?;
        let times = if cursor.takes_word("P") && cursor.takes(b"=") { self.value(cursor)? } else { calls(cursor) };
        if !cursor.is_over() {
            return Err(cursor.unreadable());
        }
        if times.fract() != 0.0 || !(0.0..=9999.0).contains(&times) {
            return refuse(Code::PN018, format!("P={times} is not a number of calls"), "write P1 to P9999");
        }
        Ok(Jump::Search(Search::Call(name.to_owned(), arguments, times as u32)))
    }
}
