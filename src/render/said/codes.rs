//! Effects of printed codes on the known state: modal groups, frame of axis words, positions and increments.

use super::line::{Line, Shift};
use super::state::Said;
use crate::compile::Letter;
use crate::control::{AxisWords, Code, Frame, Group, Meaning, Row, Words};
use crate::lang::{Machine, VarId};
use crate::render::shape::Shape;
use crate::render::want::Want;

impl Said {
    /// Records a printed letter with its number, which together may be a code.
    #[inline]
    pub fn code_word(&mut self, info: &Letter, value: f64, line: Line, want: &Want, shape: &Shape) {
        if let Some(code) = Code::of(info.printed, value) {
            self.code(code, line, want, shape);
        }
    }

    /// Records that a G or M code was printed.
    pub fn code(&mut self, code: Code, line: Line, want: &Want, shape: &Shape) {
        let row = shape.code_row(code);
        if row.is_some_and(|row| row.stops_spindle) {
            self.spindle_stopped(want, shape);
        }
        // the effects of the job's own subprograms are known
        self.calls |= row.is_some_and(|row| runs_elsewhere(code, row, shape))
            && !line.prints(shape, |_, var| var == Some(VarId::Sub));
        if code.letter == b'M' && self.beside_code(code.value(), want, shape) {
            self.switched = true;
            return;
        }
        self.switching_code(code, row, line, want, shape);
        // an unknown M code is taken to switch something; an unknown G code may move the machine
        if code.letter == b'G' || row.is_some() {
            self.frame_code(code, row, line, want, shape);
        }
        let settings = &shape.program.settings;
        let is_feed_mode = code.letter == b'G' && settings.feed_type.contains(&code.value());
        if is_feed_mode {
            self.conditions.put(VarId::Feedtype, Some(code.value()));
            self.switched = true;
        }
        let group = row.and_then(|row| row.meaning.group());
        if is_feed_mode || matches!(group, Some(Group::FeedMode | Group::Units)) {
            self.forget(&shape.letters[settings.feed_code]);
        }
        let Some(group) = group else { return };
        match group {
            Group::Plane => self.plane = Some(code),
            Group::Motion => self.motion = Some(code),
            Group::Distance => self.distance = Some(code),
            _ => {}
        }
        self.registers.set_group(group, code);
        self.condition_code(group, code.value(), line, want, shape);
    }

    /// Handles a code that switches spindle or coolant, stops the program, changes the tool, or calls a subprogram.
    fn switching_code(&mut self, code: Code, row: Option<&Row>, line: Line, want: &Want, shape: &Shape) {
        let meaning = row.map(|row| row.meaning);
        self.spindle_code(meaning, line, want, shape);
        if code.letter == b'M' {
            self.coolant_code(code.value(), line, want, shape);
        }
        let own_stop = code.letter == b'M' && shape.program.settings.stop_code.contains(&code.value());
        if own_stop || meaning.is_some_and(Meaning::is_stop) {
            self.stopped(want, shape);
        } else if meaning.is_some_and(|meaning| meaning.is_call() || meaning.changes_tool()) {
            self.moves_itself(shape); // a tool changer, macro or subprogram may move to any position
            self.forget_motion();
        }
    }

    /// Handles a code that stops the spindle at an angle, or starts it with coolant. Such a code has the effect of the
    /// variables `[direct]` and `[cool]`.
    fn spindle_code(&mut self, meaning: Option<Meaning>, line: Line, want: &Want, shape: &Shape) {
        let settings = &shape.program.settings;
        let (direct, cool) = match meaning {
            Some(Meaning::Orient) => (None, None),
            Some(Meaning::SpindleCwCoolant) => (Some(settings.spindle[0]), Some(settings.coolant[0])),
            Some(Meaning::SpindleCcwCoolant) => (Some(settings.spindle[1]), Some(settings.coolant[0])),
            _ => return,
        };
        self.conditions.put(VarId::Direct, direct);
        if let Some(cool) = cool {
            self.coolant_said(cool, line, want, shape);
        }
        self.switched = true;
    }

    /// Handles a code that the form defines for a kind of coolant, whatever this code means on the control.
    fn coolant_code(&mut self, code: f64, line: Line, want: &Want, shape: &Shape) {
        let kinds = &shape.program.settings.coolant_kinds;
        let begins = kinds.iter().any(|kind| kind.on == code);
        let ends = kinds.iter().any(|kind| kind.off == Some(code));
        let own = |cool: f64| kinds.iter().any(|kind| kind.on == cool && kind.off == Some(code));
        let [on, off, mist] = shape.program.settings.coolant;
        let ends_last = self.conditions.get(VarId::Cool) == Some(off) && want.get(VarId::Cool) == Some(code);
        // a code that turns off one kind leaves another kind on
        if begins || ends && (ends_last || self.conditions.get(VarId::Cool).is_some_and(own)) {
            self.coolant_said(code, line, want, shape);
            self.switched = true;
        }
        // the job changed the kind of coolant, and the form has already turned off the old kind
        let is_needed = self.coolant_ended == want.ends_coolant;
        if begins || [on, mist].contains(&code) && !is_needed {
            self.coolant_ended = None;
        } else if ends {
            self.coolant_ended = Some(code);
        }
    }

    /// Handles the effect of a G code on positions.
    fn frame_code(&mut self, code: Code, row: Option<&Row>, line: Line, want: &Want, shape: &Shape) {
        let meaning = row.map(|row| row.meaning);
        let lathe = shape.program.settings.machine == Machine::Lathe;
        match meaning.and_then(Meaning::frame) {
            Some(Frame::Block) => {
                self.shift = self.shift.max_of(Shift::Block);
                if meaning != Some(Meaning::Machine) && !line.prints_axes(shape) {
                    self.moves_itself(shape);
                }
            }
            // on a lathe G92 is a threading cycle
            Some(Frame::Shifts) if lathe => {}
            Some(Frame::Shifts) => self.shift = Shift::Body,
            // on a lathe increments have letters of their own
            Some(Frame::Increments) if lathe => self.shift = Shift::Body,
            // the code selects the active offset again; for G54.1, the word P would determine the offset
            Some(Frame::Moves)
                if self.registers.group(Group::Work) == Some(code)
                    && row.is_some_and(|row| row.words == Words::NONE) => {}
            Some(Frame::Moves) => {
                self.forget_axes(shape);
                self.axis_words_are_data(meaning);
            }
            Some(Frame::MovesDepth) => {
                self.depth_moved = true;
                self.axis_words_are_data(meaning);
            }
            // the code moves by itself, or its effect is unknown
            None if !is_harmless(code, meaning, want, shape) => {
                self.shift = self.shift.max_of(Shift::Block);
                self.moves_itself(shape);
                self.forget_motion();
            }
            _ => {}
        }
    }

    /// If the axis words in the block of this code are data, records that these words are not positions of the job.
    fn axis_words_are_data(&mut self, meaning: Option<Meaning>) {
        if meaning.is_some_and(|meaning| meaning.axes() == AxisWords::Data) {
            self.shift = self.shift.max_of(Shift::Block);
        }
    }
}

/// Whether known positions stay valid after a G code without a modal group. The positions stay valid if the form's
/// control defines the code, or if the form's commands name the code. In a cycle the positions stay valid too, because
/// the end of the cycle discards the positions anyway.
fn is_harmless(code: Code, meaning: Option<Meaning>, want: &Want, shape: &Shape) -> bool {
    let known =
        meaning.is_some_and(|meaning| !matches!(meaning, Meaning::Unsaid | Meaning::Probe) && !meaning.is_call());
    known || shape.program.settings.names_code(code) || want.cycle.is_some()
}

/// Whether a code runs external code: a macro, a subprogram, or a code that the control's file lists without a meaning.
/// A code without a meaning does not count if the form's commands name the code.
fn runs_elsewhere(code: Code, row: &Row, shape: &Shape) -> bool {
    let settings = &shape.program.settings;
    let unsaid = row.meaning == Meaning::Unsaid;
    row.meaning.is_call() || unsaid && settings.control.is_some() && !settings.names_code(code)
}
