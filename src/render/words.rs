//! Printing words: values through letter formats, registers, and the operations of a sequence.

use std::ops::Range;

use super::codes::Shift;
use super::fault::{Done, fault_at};
use super::motion::MOVED;
use super::numbers::{as_number, quantised, tenths};
use super::renderer::Renderer;
use crate::compile::{Letter, LetterKind, Op, Routine};
use crate::diag::Code;
use crate::lang::{VarId, VarSet};
use crate::number::quantise;

/// Which words of a line print.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    /// Every word: ordinary sequences, the first hole of a machine cycle.
    All,
    /// A motion sequence: codes and variables only when changed.
    Motion,
    /// The same for an arc: its centre words always print.
    ArcMotion,
    /// A later hole of a machine cycle: variables that changed, or both position words.
    NextHole {
        /// Nothing changed: print the position.
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
const INCREMENTS: VarSet = VarSet::of(&[VarId::Hdist, VarId::Vdist, VarId::Ddist]);

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

/// Variables of feeds, pecks and dwells: rounded to nothing, they would stop the machine, never end, or not be.
const FEEDS: VarSet = VarSet::of(&[VarId::Frate, VarId::Plunge, VarId::Pitch, VarId::Vbite, VarId::Dwell]);

impl Renderer<'_> {
    /// Runs a whole sequence in which every word prints.
    pub(super) fn run_block(&mut self, routine: &Routine) -> Done {
        self.shifted = Shift::None;
        self.run(routine.ops.clone(), Mode::All)
    }

    /// Runs operations; each line is a block.
    pub(super) fn run(&mut self, ops: Range<usize>, mode: Mode) -> Done {
        let mut line = ops.start;
        let mut drops = false;
        for i in ops {
            self.form = Some(i);
            if let Op::Line { droppable } = self.shape.program.ops[i] {
                self.end_line(line);
                (line, drops) = (i, droppable);
                continue;
            }
            self.word(i, mode, drops)
                .map_err(|diag| Box::new(diag.at(self.shape.program.spans[i], "printed from here")))?;
        }
        self.end_line(line);
        self.form = None;
        // looked at before the next move: until then another sequence may put it right
        if std::mem::take(&mut self.switched) {
            self.attention |= self.distance_is_wrong() || self.has_changes();
        }
        Ok(())
    }

    /// Runs one operation.
    fn word(&mut self, i: usize, mode: Mode, drops: bool) -> Done {
        let program = self.shape.program;
        match program.ops[i] {
            Op::Line { .. } => {}
            Op::Var { letter, var, glued } => self.var_word(letter, var, glued, mode, drops)?,
            Op::Value { var, glued } | Op::Remark { var, glued } => {
                if !matches!(mode, Mode::NextHole { .. }) {
                    let said = matches!(program.ops[i], Op::Value { .. });
                    self.bare_word(var, glued, said)?;
                }
            }
            Op::Literal { index, glued } => self.literal_word(index as usize, glued, mode),
            Op::Text { index, glued } => {
                if !matches!(mode, Mode::NextHole { .. }) {
                    let text = &program.texts[index as usize];
                    self.out.text(text, glued);
                    if let Some(word) = text.strip_prefix('/') {
                        self.may_be_skipped(word);
                    }
                }
            }
        }
        Ok(())
    }

    /// Ends a line of a sequence, whose operations begin at `line`.
    fn end_line(&mut self, line: usize) {
        if self.shifted == Shift::Block {
            self.shifted = Shift::None;
        }
        if self.depth_moved {
            self.depth_moved = false;
            self.registers.forget(self.shape.letters[self.shape.axes[self.shape.depth]].printed);
        }
        if self.out.has_words() {
            let form = Some(self.shape.program.spans[line]);
            let number = self.shape.program.settings.number_last || Some(line) != self.last_line();
            self.out.finish(number, form);
        }
    }

    fn var_word(&mut self, letter: u8, var: VarId, glued: bool, mode: Mode, line_drops: bool) -> Done {
        let info = &self.shape.letters[letter];
        if var == VarId::Tparams
            && let Some((_, digits)) = self.shape.letters.packed.iter().find(|(l, _)| *l == letter)
        {
            return self.packed_word(info, digits, glued);
        }
        if mode == Mode::ArcMotion && ARC_WORDS.has(var) && self.vars.get(var).is_none() {
            return Ok(()); // the centre along the axis across the plane
        }
        let Some(value) = self.value_of(var, letter)? else { return Ok(()) };
        if info.kind == LetterKind::Axis && self.shape.program.settings.incremental && POSITIONS.has(var) {
            self.check_position_word(letter, var)?;
        }
        if var == VarId::Work
            && self.shape.program.work_word.is_some_and(|word| word.letter == letter)
            && !self.has_work(value)
        {
            self.forget_axes(); // the positions behind it count in the new offset
        }
        let units = quantised(info, value)?;
        let decimals = info.format.dec.count;
        if FEEDS.has(var) {
            self.check_feed(info, var, value, units)?;
        }
        let drop = match mode {
            Mode::All => false,
            Mode::Motion | Mode::ArcMotion => {
                let arc_word = mode == Mode::ArcMotion && (ARC_WORDS.has(var) || b"IJKR".contains(&info.printed));
                !arc_word
                    && match info.kind {
                        LetterKind::GCode | LetterKind::MCode => self.code_drops(info.printed, value),
                        // an increment is no position: it may go when it is none
                        _ if INCREMENTS.has(var) => units == 0,
                        _ => info.modal && self.registers.holds(info.printed, units, decimals),
                    }
                    && !(self.inverse_time() && letter == self.shape.program.settings.feed_code)
            }
            Mode::NextHole { position } => {
                let is_position = matches!(var, VarId::H | VarId::V);
                self.shape.program.settings.modality && !(position && is_position) && self.holds(info, units, value)
            }
            Mode::Hole => line_drops && self.holds(info, units, value),
        };
        if drop {
            return Ok(());
        }
        self.out.letter(info, units, glued)?;
        match info.kind {
            LetterKind::GCode | LetterKind::MCode => self.printed_code(info.printed, value),
            LetterKind::Axis => {
                let is_position = POSITIONS.has(var);
                if is_position {
                    self.placed |= self.shape.axis_bit(letter);
                }
                if self.is_elsewhere() || !is_position {
                    self.registers.forget(info.printed);
                } else {
                    self.registers.set(info.printed, units, decimals);
                }
            }
            _ => self.registers.set(info.printed, units, decimals),
        }
        match var {
            VarId::D => self.depth_moved = false,
            // another length register alone moves the depth as G43 does
            VarId::Lcomp if !self.line_prints(|_, _, var| var == Some(VarId::D)) => self.depth_moved = true,
            _ => {}
        }
        self.served_by(letter, var, value);
        if Some(info.printed) == self.shape.program.settings.numbers.letter || var == VarId::Block {
            self.out.prints_number();
        }
        Ok(())
    }

    /// A word of packed parameters: as the form has them, or as the job sets them, in as many digits.
    fn packed_word(&mut self, info: &Letter, digits: &str, glued: bool) -> Done {
        let text = match self.vars.get(VarId::Tparams) {
            Some(value) => format!("{value:0width$}", width = digits.len()),
            None => digits.to_owned(),
        };
        if text.len() != digits.len() || !text.bytes().all(|digit| digit.is_ascii_digit()) {
            let message = format!("[tparams] is {text}, its word has {} digits", digits.len());
            return fault_at(Code::PR002, message, "give a whole number of that many digits", None);
        }
        let out = self.out.word(glued);
        out.push(info.printed);
        out.extend_from_slice(text.as_bytes());
        Ok(())
    }

    /// Does a register hold this already?
    fn holds(&self, info: &Letter, units: i64, value: f64) -> bool {
        match info.kind {
            LetterKind::GCode | LetterKind::MCode => {
                let tenths = tenths(value);
                self.group_of(info.printed, tenths).is_some_and(|group| self.registers.group(group) == Some(tenths))
            }
            _ => self.registers.holds(info.printed, units, info.format.dec.count),
        }
    }

    /// May a motion block drop this code?
    pub(super) fn code_drops(&self, letter: u8, value: f64) -> bool {
        let settings = &self.shape.program.settings;
        let tenths = tenths(value);
        settings.modality
            && settings.modal_codes.contains(&value)
            && self.group_of(letter, tenths).is_some_and(|group| self.registers.group(group) == Some(tenths))
    }

    /// The value a variable prints, or none where its word is optional.
    fn value_of(&mut self, var: VarId, letter: u8) -> Done<Option<f64>> {
        let known = match var {
            VarId::Rotangle | VarId::Lastrotangle => self.angle_of(var, letter).or(self.vars.get(var)),
            _ => self.vars.get(var),
        };
        if let Some(value) = known {
            return Ok(Some(value));
        }
        match var {
            // revolutions are their own limit
            VarId::Maxrpm if self.vars.get(VarId::Speedtype) == Some(self.shape.program.settings.speed_type[1]) => {
                return Ok(self.vars.get(VarId::Speed));
            }
            VarId::Block => return Ok(Some(self.out.number() as f64)),
            // a two-axis job has no upper guide
            VarId::H2 | VarId::V2 if self.shape.linear == 4 => return Ok(None),
            // a cycle without dwell drops the word
            VarId::Dwell if self.cycle.is_some() => return Ok(None),
            _ => {}
        }
        let help = match var {
            VarId::Nexttool => "list the tools ahead under `tool_order`: a stream can't look for them".to_owned(),
            VarId::Program => "give the job a `program`, or say it with `--program NUMBER`".to_owned(),
            VarId::H | VarId::V | VarId::D => "begin the operation with a rapid that gives all coordinates".to_owned(),
            _ if MOVED.contains(&var) => {
                "nobody knows where the tool is: print its position in the sequence that moved it, or changed the offset"
                    .to_owned()
            }
            _ if var.row().origin == crate::lang::Origin::Job => {
                format!("give it with `--set {}=VALUE` or under \"set\" in the job", var.name())
            }
            _ => format!("it stands for: {}; let the job say it, or take the word out of the form", var.row().meaning),
        };
        let message = format!("[{}] has no value here", var.name());
        fault_at(Code::PR001, message, help, None)
    }

    /// A value without a letter; `said`: outside a comment, so that the control reads it.
    fn bare_word(&mut self, var: VarId, glued: bool, said: bool) -> Done {
        let value = match self.value_of(var, b' ') {
            Ok(Some(value)) => value,
            Ok(None) => return Ok(()),
            Err(_) if !said => {
                self.out.word(glued).push(b'-'); // a comment says what is known
                return Ok(());
            }
            Err(diag) => return Err(diag),
        };
        self.out.bare(value, &self.shape.letters.bare, glued)?;
        if said {
            if var == VarId::Block {
                self.out.prints_number();
            }
            self.served_by(b' ', var, value);
        }
        Ok(())
    }

    /// A word as typed; its value goes into the registers.
    fn literal_word(&mut self, index: usize, glued: bool, mode: Mode) {
        let literal = &self.shape.program.literals[index];
        let info = &self.shape.letters[literal.letter];
        let drop = match mode {
            Mode::All | Mode::Hole => false,
            Mode::Motion | Mode::ArcMotion => {
                matches!(info.kind, LetterKind::GCode | LetterKind::MCode)
                    && self.code_drops(info.printed, literal.value)
            }
            Mode::NextHole { .. } => true,
        };
        if drop {
            return;
        }
        let out = self.out.word(glued);
        if info.printed == literal.letter && !info.dummy {
            out.extend_from_slice(literal.text.as_bytes());
        } else {
            if !info.dummy {
                out.push(info.printed);
            }
            out.extend_from_slice(&literal.text.as_bytes()[1..]);
        }
        match info.kind {
            LetterKind::GCode | LetterKind::MCode => self.printed_code(info.printed, literal.value),
            // a literal position may stand in another frame
            LetterKind::Axis => {
                self.registers.forget(info.printed);
                self.displaced(self.shape.axis_bit(literal.letter));
            }
            LetterKind::Other => match quantise(literal.value, info.format.dec.count) {
                Some(units) => self.registers.set(info.printed, units, info.format.dec.count),
                None => self.registers.forget(info.printed),
            },
        }
        if Some(info.printed) == self.shape.program.settings.numbers.letter {
            self.out.prints_number();
        }
        if literal.letter == self.shape.program.settings.speed_code {
            self.served.speed = Some(literal.value);
            self.switched = true;
        }
    }

    /// A feed must not vanish in the digits of its format; where it loses more than a hundredth of itself, that is said.
    #[inline]
    pub(super) fn check_feed(&mut self, info: &Letter, var: VarId, value: f64, units: i64) -> Done {
        const SAID_FROM: f64 = 0.01;
        let printed = as_number(units, info.format.dec.count);
        if (printed.abs() - value.abs()).abs() <= value.abs() * SAID_FROM {
            return Ok(());
        }
        self.lost_digits(info, var, value, printed)
    }

    #[cold]
    fn lost_digits(&mut self, info: &Letter, var: VarId, value: f64, printed: f64) -> Done {
        let (name, format) = (var.name(), &info.format);
        if printed == 0.0 {
            let message = format!("[{name}] is {value} and prints as 0 in the format `{format}`");
            return fault_at(Code::PR002, message, "give the letter more decimals", None);
        }
        const MOST: usize = 5; // one letter's format is the cause of all
        if self.out.notes().iter().filter(|note| note.code == Code::PR025).count() == MOST {
            return Ok(());
        }
        let percent = (printed.abs() / value.abs() - 1.0) * 100.0;
        let letter = char::from(info.printed);
        let message = format!("[{name}] is {value:.5} and prints as {letter}{printed}: {percent:+.1} %");
        self.out.note(Code::PR025, message, "give the letter more decimals, or the job a feed that the format can say");
        Ok(())
    }
}
