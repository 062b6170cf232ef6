//! One run of a sequence: executes its operations word by word. State in this module lasts for one run only.

mod formula;
pub mod next_hole;
mod text;

use crate::control;
use crate::render::cx::Writer;
use std::ops::Range;

use super::ahead;
use super::fault::{Done, fault};
use super::no_value::no_value;
use super::numbers::quantised;
use super::said::Line;
use super::texts::{self, Text};
use super::unnumbered::last_line;
use super::values::{Now, property_text, rpm_as_limit};
use super::vars::MOVED;
use super::words::check_feed;
use super::work_words::more_work_words;
use crate::compile::{Letter, LetterKind, Op, Routine};
use crate::diag::{Code, Diag};
use crate::lang::{TextId, VarId, VarSet};
use crate::number::quantise;

/// Which words of a line are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Every word: used for ordinary sequences and for the first hole of a machine cycle.
    All,
    /// For a motion sequence: codes and variables are printed only if they changed.
    Motion,
    /// For an arc sequence: like a motion sequence, but centre words are always printed.
    ArcMotion,
    /// For a later hole of a machine cycle: variables are printed if they changed. If no variable changed, both
    /// position words are printed.
    NextHole {
        /// Whether both position words are printed, because no word changed.
        position: bool,
    },
    /// For a hole of an emulated or advanced cycle.
    Hole,
}

/// Variables that are never modal: no control keeps their values from one arc to the next.
const ARC_WORDS: VarSet = VarSet::of(&[
    VarId::Ival,
    VarId::Jval,
    VarId::Kval,
    VarId::Arcrad,
    VarId::Hctr,
    VarId::Vctr,
    VarId::Startang,
    VarId::Endang,
    VarId::Sweep,
]);

/// Variables that hold the distance an axis moves.
const INCREMENTS: VarSet = VarSet::of(&MOVED);

/// Variables that hold an axis position and are printed with the letter of that axis. Dwells and distances are not
/// positions.
const POSITIONS: VarSet = VarSet::of(&[
    VarId::H,
    VarId::V,
    VarId::D,
    VarId::H2,
    VarId::V2,
    VarId::Lasth,
    VarId::Lastv,
    VarId::Lastd,
    VarId::Rotangle,
    VarId::Lastrotangle,
    VarId::Rplane,
    VarId::Vclear,
    VarId::Pointd,
]);

/// Variables of feeds, speeds, pecks and dwells. If such a value were rounded to zero, the machine would stop, peck
/// without end, or skip the dwell.
const FEEDS: VarSet =
    VarSet::of(&[VarId::Frate, VarId::Plunge, VarId::Pitch, VarId::Vbite, VarId::Dwell, VarId::Speed]);

/// Runs a whole sequence and prints every word.
pub fn run_all(routine: &Routine, writer: &mut Writer<'_>) -> Done {
    run(routine, Mode::All, writer)
}

/// Runs a whole sequence and prints one block for each line.
pub fn run(routine: &Routine, mode: Mode, writer: &mut Writer<'_>) -> Done {
    run_part(routine, routine.ops.clone(), mode, writer)
}

/// Runs the first operations of a sequence.
pub fn run_part(routine: &Routine, ops: Range<usize>, mode: Mode, writer: &mut Writer<'_>) -> Done {
    writer.said.begin_sequence();
    go_on(routine, ops, mode, writer)
}

/// Continues with further operations of the same sequence.
pub fn go_on(routine: &Routine, ops: Range<usize>, mode: Mode, writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    let begin = ops.start;
    let mut left_out = routine.left_out.as_deref().unwrap_or_default();
    let mut body =
        Body { writer: writer.lend(), mode, line: begin, at: begin, drops: false, text: Vec::new(), comment: 0..0 };
    let mut i = ops.start;
    loop {
        while let [first, rest @ ..] = left_out
            && first.start <= i
        {
            (i, left_out) = (i.max(first.end), rest);
        }
        if i >= ops.end {
            break;
        }
        match shape.program.ops[i] {
            Op::Line { droppable } => {
                body.end_line();
                (body.line, body.drops) = (i, droppable);
            }
            Op::Comment { words } if body.comment_is_empty(i, words as usize) => i += words as usize,
            op => {
                if let Op::Comment { words } = op {
                    body.comment = i..i + 1 + words as usize;
                }
                body.at = i;
                let mark = body.writer.out.mark();
                let span = shape.program.spans[i];
                body.operation(op, i).map_err(|diag| Box::new(diag.at(span, "printed from here")))?;
                if let Some(from) = mark {
                    body.writer.out.trace_word(from, span);
                }
            }
        }
        i += 1;
    }
    body.end_line();
    // the check is before the next move, because another sequence may restore the job's value until then
    if writer.said.take_switched() {
        writer.said.differs |=
            writer.said.is_misread(shape, writer.want) || !writer.said.lacks(writer.want, shape).is_empty();
    }
    Ok(())
}

/// Executes the `@set` directives that precede the repeated lines of a cycle: these directives apply at every hole.
pub fn run_sets(routine: &Routine, writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    let (line, mode) = (routine.ops.start, Mode::Hole);
    let mut body = Body { writer: writer.lend(), mode, line, at: line, drops: false, text: Vec::new(), comment: 0..0 };
    for i in routine.steps_in(routine.ops.start..routine.repeat) {
        if let Op::Set { index } = shape.program.ops[i] {
            let at = |diag: Box<Diag>| Box::new(diag.at(shape.program.spans[i], "printed from here"));
            body.set(index).map_err(at)?;
        }
    }
    Ok(())
}

/// A sequence during its run.
struct Body<'r> {
    writer: Writer<'r>,
    mode: Mode,
    /// The first operation of the line that is being printed.
    line: usize,
    /// The operation that is being executed.
    at: usize,
    /// Whether the sequence is a cycle that may leave out unchanged words of this line.
    drops: bool,
    /// The text and the values without a letter that were printed after the line's last word with a letter.
    text: Vec<u8>,
    /// The operations of the comment that was printed last.
    comment: Range<usize>,
}

impl Body<'_> {
    /// Ends a line of the sequence.
    fn end_line(&mut self) {
        self.read_text();
        self.writer.said.end_block(self.writer.want, self.writer.shape);
        if self.writer.out.has_words() {
            let number = self.writer.shape.program.settings.number_last
                || Some(self.line) != last_line(self.writer.shape, self.writer.want, self.writer.said);
            self.writer.out.finish(number, Some(self.writer.shape.program.spans[self.line]));
        }
    }

    /// The line whose words are printed. For a block that is already too long, the line is [`Line::NONE`], because such
    /// a block is an error anyway.
    fn line(&self) -> Line {
        if self.writer.out.is_too_long() { Line::NONE } else { Line::at(self.line) }
    }

    /// Prints an operation. Text without a letter is collected so that the text of the whole line can be analysed.
    fn operation(&mut self, op: Op, at: usize) -> Done {
        if matches!(op, Op::Var { .. } | Op::Literal { .. } | Op::Formula { .. }) {
            self.read_text();
            return self.print_operation(op, at);
        }
        let from = self.writer.out.length();
        self.print_operation(op, at)?;
        // the control ignores comments
        if self.writer.out.length() > from && !self.comment.contains(&at) {
            self.text.extend_from_slice(self.writer.out.block_from(from));
        }
        Ok(())
    }

    fn print_operation(&mut self, op: Op, at: usize) -> Done {
        let next_hole = matches!(self.mode, Mode::NextHole { .. });
        match op {
            Op::Line { .. } => {}
            Op::List { index } => self.list(index as usize)?,
            Op::Var { letter, var, glued } => self.var_word(letter, var, glued)?,
            Op::Literal { index, glued } => self.literal_word(index as usize, glued),
            Op::Set { index } => {
                self.end_line();
                self.set(index)?;
            }
            Op::Formula { letter, index, glued } => self.formula_word(letter, index, glued)?,
            Op::Value { .. }
            | Op::Remark { .. }
            | Op::Text { .. }
            | Op::Quote { .. }
            | Op::TextVar { .. }
            | Op::PropertyText { .. }
            | Op::ValueFormula { .. }
            | Op::RemarkFormula { .. }
                if next_hole => {}
            Op::ValueFormula { index, glued } => self.bare_formula(index, glued)?,
            Op::RemarkFormula { index, glued } => {
                let value = self.calculated(index, b' ');
                self.remark(value, glued)?;
            }
            Op::Comment { .. } => {}
            Op::Quote { index, glued } => {
                self.writer.out.quote(&self.writer.shape.program.texts[index as usize], glued)
            }
            Op::TextVar { var, in_comment, glued } => {
                let behind = in_comment.then(|| texts::typed_behind(at, self.writer.shape));
                let text = Text { name: &var, width: var.width, text: self.writer.want.texts.get(var.id) };
                if var.id == TextId::Toolname && !in_comment {
                    self.writer.said.names.tool(&text, self.writer.out)?;
                }
                texts::print(&text, behind, glued, self.writer.shape, self.writer.out);
            }
            Op::PropertyText { row, in_comment, glued } => {
                let behind = in_comment.then(|| texts::typed_behind(at, self.writer.shape));
                let name = format!("[{}]", self.writer.shape.program.settings.properties[usize::from(row)].name);
                let text = Text { name: &name, width: 0, text: property_text(row, self.writer.want, self.writer.said) };
                texts::print(&text, behind, glued, self.writer.shape, self.writer.out);
            }
            Op::Value { var, glued } => self.bare_word(var, glued)?,
            Op::Remark { var, glued } => self.remark(self.value_of(var, b' '), glued)?,
            Op::Text { index, glued } => {
                self.writer.out.text(&self.writer.shape.program.texts[index as usize], glued);
            }
        }
        Ok(())
    }

    fn var_word(&mut self, letter: u8, var: VarId, glued: bool) -> Done {
        let (shape, settings) = (self.writer.shape, &self.writer.shape.program.settings);
        let info = &shape.letters[letter];
        if var == VarId::Tparams
            && let Some((_, digits)) = shape.letters.packed.iter().find(|(l, _)| *l == letter)
        {
            return self.packed_word(info, digits, glued);
        }
        if self.mode == Mode::ArcMotion && ARC_WORDS.has(var) && self.writer.want.get(var).is_none() {
            return Ok(()); // the centre coordinate along the axis perpendicular to the plane has no value
        }
        let Some(value) = self.value_of(var, letter)? else { return Ok(()) };
        if info.kind == LetterKind::Axis && settings.incremental && POSITIONS.has(var) {
            self.check_position_word(letter, var)?;
        }
        self.counts_from(letter, var, value);
        if var == VarId::Work && info.kind == LetterKind::GCode && more_work_words(value, &mut self.writer)? {
            self.condition_word(letter, var, value);
            return Ok(());
        }
        let units = quantised(info, value)?;
        if FEEDS.has(var) {
            check_feed(info, var, value, units, self.writer.want, self.writer.out)?;
        }
        if self.drops_word(letter, Some(var), value, units) {
            return Ok(());
        }
        self.print(letter, value, units, glued)?;
        if info.kind == LetterKind::Axis {
            let is_position = POSITIONS.has(var);
            if is_position {
                self.writer.said.stand.placed |= shape.axis_bit(letter);
            }
            if self.writer.said.is_elsewhere(shape) || !is_position {
                self.writer.said.forget(info);
            } else {
                self.writer.said.word(info, units);
            }
        }
        match var {
            VarId::D => self.writer.said.set_depth_moved(false),
            // a new length register without a position moves the depth axis, as G43 does
            VarId::Lcomp if !self.line().prints(shape, |_, var| var == Some(VarId::D)) => {
                self.writer.said.set_depth_moved(true);
            }
            _ => {}
        }
        self.condition_word(letter, var, value);
        if var == VarId::Block {
            self.writer.out.prints_number();
        }
        Ok(())
    }

    /// If a word selects another work offset, later axis positions refer to that offset. The known positions then
    /// become invalid.
    fn counts_from(&mut self, letter: u8, var: VarId, value: f64) {
        if var == VarId::Work
            && self.writer.shape.program.work.says(self.at)
            && self.writer.shape.letters[letter].kind != LetterKind::GCode
            && !self.writer.said.conditions.holds(VarId::Work, value)
        {
            self.writer.said.forget_axes(self.writer.shape);
        }
    }

    /// Records that a word with this variable was printed. Not every word that prints `[work]` selects the work offset.
    fn condition_word(&mut self, letter: u8, var: VarId, value: f64) {
        if var != VarId::Work || self.writer.shape.program.work.says(self.at) {
            self.writer.said.condition_word(letter, var, value, self.line(), self.writer.want, self.writer.shape);
        }
    }

    /// Prints a word and records its value as known to the control. The value of an axis word is recorded by the
    /// caller, because the frame of the word must be considered.
    fn print(&mut self, letter: u8, value: f64, units: i64, glued: bool) -> Done {
        let info = &self.writer.shape.letters[letter];
        self.writer.out.letter(info, units, glued)?;
        match info.kind {
            LetterKind::GCode | LetterKind::MCode => {
                self.writer.said.code_word(info, value, self.line(), self.writer.want, self.writer.shape);
            }
            LetterKind::Axis => {}
            LetterKind::Other => self.writer.said.word(info, units),
        }
        if Some(info.printed) == self.writer.shape.program.settings.numbers.letter {
            self.writer.out.prints_number();
        }
        Ok(())
    }

    /// Whether the word may be left out because the control already has its value. `var` is `None` for a calculated
    /// value.
    fn drops_word(&self, letter: u8, var: Option<VarId>, value: f64, units: i64) -> bool {
        let is = |set: VarSet| var.is_some_and(|var| set.has(var));
        let settings = &self.writer.shape.program.settings;
        let info = &self.writer.shape.letters[letter];
        match self.mode {
            Mode::All => false,
            Mode::Motion | Mode::ArcMotion => {
                let arc_word = self.mode == Mode::ArcMotion && (is(ARC_WORDS) || b"IJKR".contains(&info.printed));
                !arc_word
                    && match info.kind {
                        LetterKind::GCode | LetterKind::MCode => control::Code::of(info.printed, value)
                            .is_some_and(|code| self.writer.said.code_drops(code, self.writer.shape)),
                        // an increment is not a position: it is left out if it is zero
                        _ if is(INCREMENTS) => units == 0,
                        _ => info.modal && self.writer.said.holds(info, units),
                    }
                    && !(self.writer.want.inverse_time() && letter == settings.feed_code)
            }
            Mode::NextHole { position } => {
                let is_position = matches!(var, Some(VarId::H | VarId::V));
                settings.modality && !(position && is_position) && self.writer.said.holds_value(info, units, value)
            }
            Mode::Hole => self.drops && self.writer.said.holds_value(info, units, value),
        }
    }

    /// Prints a word of packed parameters: the form's digits, or the job's value with the same number of digits.
    fn packed_word(&mut self, info: &Letter, digits: &str, glued: bool) -> Done {
        let text = match self.writer.want.get(VarId::Tparams) {
            Some(value) => format!("{value:0width$}", width = digits.len()),
            None => digits.to_owned(),
        };
        if text.len() != digits.len() || !text.bytes().all(|digit| digit.is_ascii_digit()) {
            let message = format!("[tparams] is {text}, but its word has {} digits", digits.len());
            return fault(Code::PR002, message, "give a whole number with as many digits as the word");
        }
        let word = self.writer.out.word(glued);
        word.push(info.printed);
        word.extend_from_slice(text.as_bytes());
        Ok(())
    }

    /// The value of a variable; `None` if the variable has no value and its word is optional.
    fn value_of(&self, var: VarId, letter: u8) -> Done<Option<f64>> {
        if let Some(value) = self.now(letter).get(var) {
            return Ok(Some(value));
        }
        match var {
            VarId::Maxrpm if rpm_as_limit(self.writer.shape, self.writer.want).is_some() => {
                return Ok(rpm_as_limit(self.writer.shape, self.writer.want));
            }
            VarId::Block => return Ok(Some(self.writer.out.number() as f64)),
            // a job with two axes has no upper guide
            VarId::H2 | VarId::V2 if self.writer.shape.linear == 4 => return Ok(None),
            // in a cycle without a dwell the word is left out
            VarId::Dwell if self.writer.want.cycle.is_some() => return Ok(None),
            _ => {}
        }
        if ahead::is_reach(var)
            && let Some(survey) = &self.writer.shape.options.survey
            && !ahead::sums(self.writer.want.item, survey).in_one_frame()
        {
            let message = format!("[{}] in a job with several work offsets", var.name());
            return fault(
                Code::PR052,
                message,
                "print the value inside `@for work`, for each work offset, or test it first: `@if [hmin]`",
            );
        }
        no_value(var)
    }

    /// The sources of the current values for a word with this letter. The letter selects the rotary axis of an angle.
    fn now(&self, letter: u8) -> Now<'_, '_> {
        let block = Some(self.writer.out.number());
        Now {
            shape: self.writer.shape,
            want: self.writer.want,
            said: self.writer.said,
            letter,
            block,
            set: &self.writer.said.kept,
        }
    }

    /// Prints a typed word and records its value in the registers.
    fn literal_word(&mut self, index: usize, glued: bool) {
        let shape = self.writer.shape;
        let literal = &shape.program.literals[index];
        let info = &shape.letters[literal.letter];
        let drop = match self.mode {
            Mode::All | Mode::Hole => false,
            Mode::Motion | Mode::ArcMotion => literal.code.is_some_and(|code| self.writer.said.code_drops(code, shape)),
            Mode::NextHole { .. } => true,
        };
        if drop {
            return;
        }
        let word = self.writer.out.word(glued);
        if info.printed == literal.letter && !info.dummy {
            word.extend_from_slice(literal.text.as_bytes());
        } else {
            if !info.dummy {
                word.push(info.printed);
            }
            word.extend_from_slice(&literal.text.as_bytes()[1..]);
        }
        match info.kind {
            LetterKind::GCode | LetterKind::MCode => {
                self.writer.said.code_word(info, literal.value, self.line(), self.writer.want, shape);
            }
            // the position of a typed word may be in another frame
            LetterKind::Axis => {
                self.writer.said.forget(info);
                self.writer.said.displaced(shape.axis_bit(literal.letter), shape);
            }
            LetterKind::Other => match quantise(literal.value, info.format.dec.count) {
                Some(units) => self.writer.said.word(info, units),
                None => self.writer.said.forget(info),
            },
        }
        if Some(info.printed) == shape.program.settings.numbers.letter {
            self.writer.out.prints_number();
        }
        self.writer.said.speed_word(literal.letter, literal.value, self.line(), self.writer.want, shape);
    }

    /// In a form with incremental moves, a sequence may print a position only while the control is not in incremental mode.
    #[cold]
    fn check_position_word(&self, letter: u8, var: VarId) -> Done {
        let [increments, _] = self.writer.shape.program.settings.inc_abs;
        if !self.writer.said.is_in_distance(increments) {
            return Ok(());
        }
        let message =
            format!("{}[{}] is a position, but the control is in G{increments}", char::from(letter), var.name());
        fault(Code::PR040, message, "print G90 before the position, or print the increment, as [hdist]")
    }
}
