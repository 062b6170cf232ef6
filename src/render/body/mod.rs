//! One run of a sequence: its operations, word by word. What holds only during it begins and ends here.

mod formula;
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

/// Which words of a line print.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Every word: ordinary sequences, the first hole of a machine cycle.
    All,
    /// A motion sequence: codes and variables only when changed.
    Motion,
    /// The sequence of an arc: as a motion sequence, but centre words always print.
    ArcMotion,
    /// A later hole of a machine cycle: variables that changed, or both position words.
    NextHole {
        /// The position is printed, because nothing changed.
        position: bool,
    },
    /// A hole of an emulated or advanced cycle.
    Hole,
}

/// Variables that no control keeps from arc to arc.
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

/// Variables whose value is how far an axis moves.
const INCREMENTS: VarSet = VarSet::of(&MOVED);

/// Variables whose value is a position of the axis that prints them; a dwell or a distance is none.
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

/// Variables of feeds, speeds, pecks and dwells: rounded to nothing, they would stop the machine, never end, or not be.
const FEEDS: VarSet =
    VarSet::of(&[VarId::Frate, VarId::Plunge, VarId::Pitch, VarId::Vbite, VarId::Dwell, VarId::Speed]);

/// Runs a whole sequence in which every word prints.
pub fn run_all(routine: &Routine, writer: &mut Writer<'_>) -> Done {
    run(routine, Mode::All, writer)
}

/// Runs a whole sequence; each line is a block.
pub fn run(routine: &Routine, mode: Mode, writer: &mut Writer<'_>) -> Done {
    run_part(routine, routine.ops.clone(), mode, writer)
}

/// Runs the first operations of a sequence.
pub fn run_part(routine: &Routine, ops: Range<usize>, mode: Mode, writer: &mut Writer<'_>) -> Done {
    writer.said.begin_sequence();
    go_on(routine, ops, mode, writer)
}

/// Runs further operations of the same sequence.
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
    // looked at before the next move: until then another sequence may put it right
    if writer.said.take_switched() {
        writer.said.differs |=
            writer.said.is_misread(shape, writer.want) || !writer.said.lacks(writer.want, shape).is_empty();
    }
    Ok(())
}

/// Does what the directives of a sequence set before the lines that a cycle repeats: they count at every hole.
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

/// A sequence while it runs.
struct Body<'r> {
    writer: Writer<'r>,
    mode: Mode,
    /// Where the operations of the line begin that is printed.
    line: usize,
    /// The operation that is done.
    at: usize,
    /// A cycle may drop the unchanged words of the line.
    drops: bool,
    /// What the line printed since its last word with a letter of its own: text, and values in it.
    text: Vec<u8>,
    /// The operations of the comment that was printed last.
    comment: std::ops::Range<usize>,
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

    /// The line whose words are printed. A block that is too long is refused at its end, whatever it says.
    fn line(&self) -> Line {
        if self.writer.out.is_too_long() { Line::NONE } else { Line::at(self.line) }
    }

    /// Prints an operation. What is no word with a letter is kept, so that the whole text of the line can be read.
    fn operation(&mut self, op: Op, at: usize) -> Done {
        if matches!(op, Op::Var { .. } | Op::Literal { .. } | Op::Formula { .. }) {
            self.read_text();
            return self.print_operation(op, at);
        }
        let from = self.writer.out.length();
        self.print_operation(op, at)?;
        // what a comment says, no control reads
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
            return Ok(()); // the centre along the axis across the plane
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
            // another length register alone moves the depth as G43 does
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

    /// Positions after the word of another work offset count from there.
    fn counts_from(&mut self, letter: u8, var: VarId, value: f64) {
        if var == VarId::Work
            && self.writer.shape.program.work.says(self.at)
            && self.writer.shape.letters[letter].kind != LetterKind::GCode
            && !self.writer.said.conditions.holds(VarId::Work, value)
        {
            self.writer.said.forget_axes(self.writer.shape);
        }
    }

    /// A word with this variable was printed. The work offset is said by some of the words that print it.
    fn condition_word(&mut self, letter: u8, var: VarId, value: f64) {
        if var != VarId::Work || self.writer.shape.program.work.says(self.at) {
            self.writer.said.condition_word(letter, var, value, self.line(), self.writer.want, self.writer.shape);
        }
    }

    /// A word with its value. The control holds it from here; what an axis holds depends on what it counts from.
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

    /// May a word be left out, because the control holds it already? Of its variable, where its value is not calculated.
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
                        // an increment is no position: it may go when it is none
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

    /// A word of packed parameters: as the form has them, or as the job sets them, in as many digits.
    fn packed_word(&mut self, info: &Letter, digits: &str, glued: bool) -> Done {
        let text = match self.writer.want.get(VarId::Tparams) {
            Some(value) => format!("{value:0width$}", width = digits.len()),
            None => digits.to_owned(),
        };
        if text.len() != digits.len() || !text.bytes().all(|digit| digit.is_ascii_digit()) {
            let message = format!("[tparams] is {text}, its word has {} digits", digits.len());
            return fault(Code::PR002, message, "give a whole number of that many digits");
        }
        let word = self.writer.out.word(glued);
        word.push(info.printed);
        word.extend_from_slice(text.as_bytes());
        Ok(())
    }

    /// The value a variable prints, or none where its word is optional.
    fn value_of(&self, var: VarId, letter: u8) -> Done<Option<f64>> {
        if let Some(value) = self.now(letter).get(var) {
            return Ok(Some(value));
        }
        match var {
            VarId::Maxrpm if rpm_as_limit(self.writer.shape, self.writer.want).is_some() => {
                return Ok(rpm_as_limit(self.writer.shape, self.writer.want));
            }
            VarId::Block => return Ok(Some(self.writer.out.number() as f64)),
            // a two-axis job has no upper guide
            VarId::H2 | VarId::V2 if self.writer.shape.linear == 4 => return Ok(None),
            // a cycle without dwell drops the word
            VarId::Dwell if self.writer.want.cycle.is_some() => return Ok(None),
            _ => {}
        }
        if ahead::is_reach(var)
            && let Some(survey) = &self.writer.shape.options.survey
            && !ahead::sums(self.writer.want.item, survey).in_one_frame()
        {
            let message = format!("[{}] in a job of several work offsets", var.name());
            return fault(
                Code::PR052,
                message,
                "print it inside `@for work`, for each of them, or ask before it: `@if [hmin]`",
            );
        }
        no_value(var)
    }

    /// The values of variables for a word of this letter.
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

    /// A word as typed; its value goes into the registers.
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
            // a literal position may stand in another frame
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

    /// In a form of increments a position is read as one, unless the control was told otherwise.
    #[cold]
    fn check_position_word(&self, letter: u8, var: VarId) -> Done {
        let [increments, _] = self.writer.shape.program.settings.inc_abs;
        if !self.writer.said.is_in_distance(increments) {
            return Ok(());
        }
        let message =
            format!("{}[{}] is a position, and the control is in G{increments}", char::from(letter), var.name());
        fault(Code::PR040, message, "print G90 before it, or the increment, as [hdist]")
    }
}
