//! Reads a line as a block: words, values and comments. Checks that the codes of the block may be used together.

use super::block::Block;
use super::codes::{Group, bit, g_code, group, letters, m_code, m_group, takes_axes, why_not_run};
use super::digits::Number;
use super::expression::Reader;
use super::fault::{Done, Fault, quoted, refuse, twice};
use super::flow::Flow;
use super::parameters::Parameters;
use super::scan::{Kind, tokens, tokens_from};
use super::settings::RunSettings;
use crate::control::{self, Control, Meaning, Turns};
use crate::diag::Code;

impl Block {
    /// Reads a line.
    ///
    /// # Errors
    /// The control can't read the line, or refuses it before it runs.
    pub fn read(&mut self, line: &[u8], parameters: &mut Parameters, settings: &RunSettings) -> Done {
        let control = settings.control;
        self.clear();
        if self.read_plain(line, control).is_some() {
            return Ok(());
        }
        self.open_comments = control.traits().open_comments;
        let mut stream = tokens(line);
        loop {
            stream.skip_blanks();
            if let Some((letter, number, start)) = stream.word() {
                check_case(line, start, control)?;
                self.number(letter, number, start, control)?;
                continue;
            }
            let Some(token) = stream.next() else { break };
            check_case(line, token.start, control)?;
            match token.kind {
                Kind::Word(b'O' | b':', _) if !self.is_empty => {
                    return Err(Fault::at(
                        Code::PN015,
                        token.start,
                        "words before an O word",
                        "write the O word in a separate block",
                    ));
                }
                Kind::Word(b'O' | b':', number) => {
                    let mut reader = Reader::new(line, stream);
                    self.flow = Some(Flow::read(format!("{}", number.value), &mut reader, parameters)?);
                    self.is_empty = false;
                    for token in tokens_from(line, token.start) {
                        if matches!(token.kind, Kind::Comment | Kind::Remark) {
                            self.mark(line, token.kind, token.start, token.end, control)?;
                        }
                    }
                    return Ok(());
                }
                Kind::Word(letter, number) => {
                    self.number(letter, number, token.start, control)?;
                }
                Kind::Blank => {}
                Kind::LineEnd if line[token.start] == b'\r' && token.end == token.start + 1 => {}
                Kind::LineEnd => break,
                Kind::Letter(_) | Kind::Symbol(b'#') | Kind::Name => {
                    return self.read_values(
                        line,
                        Reader::new(line, tokens_from(line, token.start)),
                        parameters,
                        control,
                    );
                }
                _ => self.mark(line, token.kind, token.start, token.end, control)?,
            }
        }
        self.plain = self.is_plain();
        self.check(control)
    }

    /// Reads the rest of a line, from its first expression on.
    #[cold]
    fn read_values(
        &mut self,
        line: &[u8],
        mut reader: Reader<'_>,
        parameters: &mut Parameters,
        control: &'static Control,
    ) -> Done {
        while let Some(token) = reader.next() {
            check_case(line, token.start, control)?;
            match token.kind {
                Kind::LineEnd => break,
                Kind::Word(letter, number) => {
                    self.number(letter, number, token.start, control)?;
                }
                Kind::Letter(b'O') => {
                    let name = match reader.next() {
                        Some(name) if name.kind == Kind::Quoted => {
                            String::from_utf8_lossy(reader.text(name)).to_ascii_lowercase()
                        }
                        _ => return unreadable(line, token.start, token.end),
                    };
                    self.flow = Some(Flow::read(name, &mut reader, parameters)?);
                    self.is_empty = false;
                    return Ok(());
                }
                Kind::Letter(letter) => {
                    let value = reader.word_value(letter, parameters)?;
                    self.word(letter, value, false, token.start, control)?;
                }
                Kind::Symbol(b'#') => {
                    let target = reader.target(parameters)?;
                    if !reader.takes(b'=') {
                        let help = "to set a parameter, write #1=2";
                        return Err(Fault::at(Code::PN014, token.start, "a parameter without `=`", help));
                    }
                    let value = reader.assigned_value(parameters)?;
                    self.settings.push((target, value));
                    self.is_empty = false;
                }
                Kind::Name => {
                    let text = String::from_utf8_lossy(reader.text(token)).into_owned();
                    return Err(unknown_name(&text, self.comment.is_some(), token.start, control));
                }
                _ => self.mark(line, token.kind, token.start, token.end, control)?,
            }
        }
        let beside = self.settings.len() > 1 || self.given & !bit(b'N') != 0 || self.has_g || self.has_m();
        if !self.settings.is_empty() && beside && !parameters.language().is_linuxcnc {
            let help = "write the assignment in a block of its own";
            return refuse(Code::PN016, "an assignment beside other words or assignments", help);
        }
        self.check(control)?;
        for (target, value) in self.settings.drain(..) {
            parameters.set(target, value)?;
        }
        Ok(())
    }

    /// Records a token that is not a word, such as a comment.
    fn mark(&mut self, line: &[u8], kind: Kind, start: usize, end: usize, control: &'static Control) -> Done {
        match kind {
            Kind::Comment => {
                if control.is_linuxcnc() && line[start + 1..end].contains(&b'(') {
                    return Err(Fault::at(Code::PN001, start, "a comment in a comment", "remove the inner `(`"));
                }
                self.comment.get_or_insert((start + 1, end - 1));
            }
            Kind::Remark if control.traits().semicolon_ends_block => {
                let next = tokens_from(line, start + 1).find(|token| token.kind != Kind::Blank);
                match next.map(|token| (token.kind, token)) {
                    Some((kind @ (Kind::Comment | Kind::OpenComment | Kind::Remark), token)) => {
                        return self.mark(line, kind, token.start, token.end, control);
                    }
                    // other text is no block that the control could run
                    Some((Kind::Word(..) | Kind::Letter(_) | Kind::Symbol(b'#') | Kind::Delete, token)) => {
                        return after_end(line, token.start, end, control);
                    }
                    _ => _ = self.comment.get_or_insert((start + 1, end)),
                }
            }
            Kind::Remark => _ = self.comment.get_or_insert((start + 1, end)),
            Kind::OpenComment if self.open_comments => _ = self.comment.get_or_insert((start + 1, end)),
            Kind::OpenComment => {
                return Err(Fault::at(
                    Code::PN001,
                    start,
                    "a comment without its `)`",
                    "close the comment on this line",
                ));
            }
            Kind::Delete => self.deleted = true,
            Kind::Percent => self.percent = true,
            Kind::Symbol(b',') => {
                let rest = line[start + 1..].trim_ascii_start().first().map_or(' ', |byte| char::from(*byte));
                let message = format!("`,{}` is not simulated", rest.to_ascii_uppercase());
                let help = "remove the word; program a chamfer (`,C`), a rounding (`,R`) or an angle (`,A`) as moves";
                return Err(Fault::at(Code::PN016, start, message, help));
            }
            Kind::Symbol(b'/') => {
                let message = "a `/` inside a block is not run: controls may skip the whole block, or only its rest";
                let help = "write the `/` first in the block, as `/N20 M8`; write a division in square brackets";
                return Err(Fault::at(Code::PN016, start, message, help));
            }
            _ => return unreadable(line, start, end),
        }
        Ok(())
    }

    /// Adds a word whose value is a number as written, without an expression.
    #[inline]
    fn number(&mut self, letter: u8, number: Number, column: usize, control: &'static Control) -> Done {
        if number.point && control.traits().no_point.has(letter) {
            return Err(with_point(letter, number.value, column));
        }
        self.word(letter, number.value, !number.point, column, control)
    }

    #[inline]
    pub(super) fn word(
        &mut self,
        letter: u8,
        value: f64,
        whole: bool,
        column: usize,
        control: &'static Control,
    ) -> Done {
        self.is_empty &= letter == b'N';
        match letter {
            b'G' => self.g_word(value, column, control),
            b'M' => self.m_word(value, column, control),
            b'@' | b'^' if control.is_linuxcnc() => {
                let slot = usize::from(letter == b'^');
                match self.polar[slot].replace(value) {
                    None => Ok(()),
                    Some(_) => twice(char::from(letter), column),
                }
            }
            b'$' if control.is_linuxcnc() => {
                if value != 0.0 {
                    let message = format!("spindle {value}: only spindle 0 is simulated");
                    return Err(Fault::at(Code::PN016, column, message, "run the program without the other spindles"));
                }
                self.spindle = true;
                Ok(())
            }
            b'A'..=b'Z' => {
                let at = bit(letter);
                if self.given & at != 0 {
                    if letter == b'T' && control.traits().next_beside_change && self.next_tool.is_none() {
                        self.next_tool = Some(value);
                        return Ok(());
                    }
                    return twice(char::from(letter), column);
                }
                let own = match control.traits().turns {
                    Turns::Tool => 0,
                    Turns::Part => letters("UW"),
                    Turns::Nothing => letters("UV"),
                };
                if at & letters("UVW") & !own != 0 || !control.reads(letter) {
                    return Err(lacks_word(letter, column, control));
                }
                self.given |= at;
                self.values[usize::from(letter - b'A')] = value;
                if whole {
                    self.whole |= at;
                }
                Ok(())
            }
            _ => {
                let message = format!("`{}` is not a word of this control", char::from(letter));
                Err(Fault::at(Code::PN001, column, message, "take it out"))
            }
        }
    }

    #[inline]
    pub(super) fn g_word(&mut self, value: f64, column: usize, control: &'static Control) -> Done {
        let code = (value * 10.0 + 0.5) as u16;
        let code = if (value * 10.0 - f64::from(code)).abs() < 1e-3 { code } else { u16::MAX };
        let Some(row) = g_code(control, code) else { return unknown_g(value, code, column, control) };
        self.has_g = true;
        let rules = control.rules();
        let its_group = group(row, rules);
        self.takes_axes |= takes_axes(row, rules);
        self.note_harmless(row);
        self.has_modes |= !matches!(its_group, Group::Motion | Group::Cycle);
        let group = its_group as usize;
        // on LinuxCNC, G80 has no effect in a block with another motion
        if control.is_linuxcnc() && its_group == Group::Motion {
            match self.g[group].map(|before| before.meaning) {
                Some(_) if row.meaning == Meaning::CycleEnd => return Ok(()),
                Some(Meaning::CycleEnd) => self.g[group] = None,
                _ => {}
            }
        }
        // codes of group `Other` have no effect in the simulator, so a block may contain several of them
        if let Some(before) = self.g[group].filter(|_| its_group != Group::Other) {
            let message = format!(
                "{} and {} are of one group: a block takes one of them",
                before.code,
                control::Code { letter: b'G', tenths: code }
            );
            return Err(Fault::at(
                Code::PN004,
                column,
                message,
                "write the codes in two blocks, or remove one of the codes",
            ));
        }
        self.g[group] = Some(row);
        Ok(())
    }

    pub(super) fn m_word(&mut self, value: f64, column: usize, control: &'static Control) -> Done {
        let code = value.round();
        let refuse = |message: String, help: &'static str| Err(Fault::at(Code::PN003, column, message, help));
        if (value - code).abs() > 1e-4 || !(0.0..=999.0).contains(&code) {
            return refuse(format!("there is no code M{value}"), "use M0 to M999");
        }
        let Some(row) = m_code(control, code as u16) else {
            let name = control::Code::m(code as u16);
            return match why_not_run(control, name) {
                Some(why) => not_run(name, &why, column),
                None => refuse(
                    format!("{name} is unknown"),
                    "remove the code, or add it to the control's file: the file does not have it",
                ),
            };
        };
        if !self.put_m(code as u16, row) {
            return refuse(format!("M{code} is one M code too many in the block"), "write two blocks");
        }
        Ok(())
    }

    /// Checks that the codes and words of the block may be used together.
    fn check(&self, control: &'static Control) -> Done {
        if self.has_m() {
            self.check_m(control)?;
        }
        if let Some(row) = self.harmless.filter(|_| self.has_axes()) {
            let message = format!("the axis words may belong to {}, and not to a move", row.code);
            let help = "write the move in another block; if the code never uses axis words, add `beside_moves = true` to \
                        its row in the control's file";
            return refuse(Code::PN016, message, help);
        }
        if self.has_modes {
            self.check_values()?;
        }
        if control.is_linuxcnc() && self.has(letters("FL")) {
            for letter in [b'F', b'L'] {
                if self.get(letter).is_some_and(|value| value < 0.0) {
                    let letter = char::from(letter);
                    return refuse(Code::PN018, format!("a negative {letter}"), "write the value without the minus");
                }
            }
        }
        Ok(())
    }

    /// Some codes have a known meaning only for some values of a word. Refuses such a code if the word has another
    /// value.
    fn check_values(&self) -> Done {
        for row in self.g.iter().flatten().filter(|row| !row.only.is_empty()) {
            if !row.only.iter().any(|&(letter, value)| self.get(letter) == Some(value)) {
                let message = format!("{} with these words is not supported", row.code);
                return refuse(Code::PN016, message, "run the program without this code");
            }
        }
        Ok(())
    }

    fn check_m(&self, control: &'static Control) -> Done {
        let mut seen = 0u16;
        for (at, (code, row)) in self.m().enumerate() {
            if at > 0 && control.traits().one_m {
                let message = format!("M{code} is the second M code of the block, but {} takes one", control.name());
                return refuse(Code::PN004, message, "write the M codes in two blocks");
            }
            let group = m_group(row);
            let at = 1 << group;
            if group > 0 && seen & at != 0 {
                let help = "write the M codes in two blocks";
                return refuse(Code::PN004, format!("M{code} and another M code of the same group in one block"), help);
            }
            seen |= at;
        }
        Ok(())
    }
}

/// The fault for a word that the simulator does not read on this control.
#[cold]
fn lacks_word(letter: u8, column: usize, control: &'static Control) -> Box<Fault> {
    let message = format!("the word {} is not simulated for {}", char::from(letter), control.name());
    let help = match control.traits().turns {
        Turns::Tool => "remove it: the axes are X Y Z A B C",
        Turns::Part => "remove it: U and W are increments along X and Z",
        Turns::Nothing => "remove it: X and Y move the lower guide, U and V the upper guide",
    };
    Fault::at(Code::PN016, column, message, help)
}

/// Statements of Fanuc macros, which the simulator does not run.
const STATEMENTS: [&str; 13] =
    ["IF", "THEN", "GOTO", "WHILE", "DO", "END", "POPEN", "PCLOS", "DPRNT", "BPRNT", "SETVN", "ACTVN", "SETSVN"];

/// The fault for a name that is not a word of the control.
#[cold]
fn unknown_name(text: &str, after_comment: bool, column: usize, control: &'static Control) -> Box<Fault> {
    if STATEMENTS.contains(&text.to_ascii_uppercase().as_str()) {
        let help = "run the program without this statement: its effect depends on the control";
        return Fault::at(Code::PN016, column, format!("the statement `{text}` is not simulated"), help);
    }
    let help = if after_comment {
        "a comment ends at its first `)`: remove the inner brackets"
    } else {
        "check the spelling, or name the control with `--control`: some controls read whole words (siemens, \
         heidenhain, okuma)"
    };
    Fault::at(Code::PN016, column, format!("`{text}` is not a word of {}", control.name()), help)
}

#[cold]
fn unknown_g(value: f64, code: u16, column: usize, control: &'static Control) -> Done {
    let name = control::Code { letter: b'G', tenths: code };
    match why_not_run(control, name) {
        Some(why) => not_run(name, &why, column),
        None => {
            let message = format!("G{value} is not a code of this control ({})", control.name());
            Err(Fault::at(
                Code::PN003,
                column,
                message,
                "check the code, or name the control of the program: `--control`, for a job `--job-control`",
            ))
        }
    }
}

/// Refuses a code with a known meaning that the simulator does not run.
#[cold]
fn not_run<T>(code: control::Code, why: &str, column: usize) -> Done<T> {
    Err(Fault::at(Code::PN016, column, format!("{code} is not supported: {why}"), "run the program without this code"))
}

/// Refuses a word in small letters on a control that may not read it.
#[inline]
fn check_case(line: &[u8], start: usize, control: &'static Control) -> Done {
    if !line[start].is_ascii_lowercase() || control.traits().small_letters {
        return Ok(());
    }
    let message = format!("`{}` is a small letter, which {} may refuse", char::from(line[start]), control.name());
    let help = "write words in capital letters; if your control reads small letters, write `small_letters = true` under \
                [text] in a control file of your own";
    Err(Fault::at(Code::PN016, start, message, help))
}

/// Refuses text behind a `;` that ends the block.
#[cold]
fn after_end<T>(line: &[u8], start: usize, end: usize, control: &'static Control) -> Done<T> {
    let (text, name) = (quoted(line, start, end), control.name());
    let message = format!("`{text}` is after a `;`, which ends the block on {name}: it may be run as another block");
    let help = "write it on a line of its own, or as a comment in brackets; if `;` begins a comment on your control, \
                write `semicolon = \"comment\"` under [text] in a control file of your own";
    Err(Fault::at(Code::PN016, start, message, help))
}

#[cold]
fn unreadable<T>(line: &[u8], start: usize, end: usize) -> Done<T> {
    Err(Fault::unreadable(line, start, &quoted(line, start, end)))
}

/// The error for a decimal point where the control takes whole numbers.
#[cold]
fn with_point(letter: u8, value: f64, column: usize) -> Box<Fault> {
    let letter = char::from(letter);
    let message =
        format!("the number of {letter} has a decimal point, but the control takes {letter} only without one");
    let help = format!(
        "write {letter}{} without a point; if a parameter of the control allows the point, leave {letter} out of `no_point` \
         under [numbers] in a control file",
        value.round()
    );
    Fault::at(Code::PN018, column, message, help)
}
