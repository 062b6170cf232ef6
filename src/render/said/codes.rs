//! What printed codes mean for what is known: modal groups, the frame of axis words, positions and increments.

use super::line::{Line, Shift};
use super::state::Said;
use crate::compile::Letter;
use crate::control::{AxisWords, Code, Frame, Group, Meaning, Row, Words};
use crate::lang::{Machine, VarId};
use crate::render::shape::Shape;
use crate::render::want::Want;

impl Said {
    /// A letter and its number were printed in this line: they may be a code.
    #[inline]
    pub fn code_word(&mut self, info: &Letter, value: f64, line: Line, want: &Want, shape: &Shape) {
        if let Some(code) = Code::of(info.printed, value) {
            self.code(code, line, want, shape);
        }
    }

    /// A G or M code was printed in this line.
    pub fn code(&mut self, code: Code, line: Line, want: &Want, shape: &Shape) {
        let row = shape.code_row(code);
        if row.is_some_and(|row| row.stops_spindle) {
            self.spindle_stopped(want, shape);
        }
        // of a subprogram of the job it is known what it does
        self.calls |= row.is_some_and(|row| runs_elsewhere(code, row, shape))
            && !line.prints(shape, |_, var| var == Some(VarId::Sub));
        if code.letter == b'M' && self.beside_code(code.value(), want, shape) {
            self.switched = true;
            return;
        }
        self.switching_code(code, row, line, want, shape);
        // an unknown M code switches something of the machine; an unknown G code may move it
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

    /// What a code stops, starts or calls.
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
            self.forget_axes(shape); // a changer, and what is called, go where they like
            self.forget_motion();
        }
    }

    /// A code that stops the spindle at an angle, or turns it with coolant, as `[direct]` and `[cool]` would.
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

    /// A code of the form's kinds of coolant, whatever the control takes it for.
    fn coolant_code(&mut self, code: f64, line: Line, want: &Want, shape: &Shape) {
        let kinds = &shape.program.settings.coolant_kinds;
        let begins = kinds.iter().any(|kind| kind.on == code);
        let ends = kinds.iter().any(|kind| kind.off == Some(code));
        let own = |cool: f64| kinds.iter().any(|kind| kind.on == cool && kind.off == Some(code));
        // what ends one kind leaves another on
        if begins || ends && self.conditions.get(VarId::Cool).is_some_and(own) {
            self.coolant_said(code, line, want, shape);
            self.switched = true;
        }
        if begins || ends {
            self.coolant_ended = Some(code).filter(|_| !begins);
        }
    }

    /// What a G code does to positions.
    fn frame_code(&mut self, code: Code, row: Option<&Row>, line: Line, want: &Want, shape: &Shape) {
        let meaning = row.map(|row| row.meaning);
        let lathe = shape.program.settings.machine == Machine::Lathe;
        match meaning.and_then(Meaning::frame) {
            Some(Frame::Block) => {
                self.shift = self.shift.max_of(Shift::Block);
                if meaning != Some(Meaning::Machine) && !line.prints_axes(shape) {
                    self.forget_axes(shape);
                }
            }
            // on a lathe G92 is a threading cycle
            Some(Frame::Shifts) if lathe => {}
            Some(Frame::Shifts) => self.shift = Shift::Body,
            // on a lathe increments have letters of their own
            Some(Frame::Increments) if lathe => self.shift = Shift::Body,
            // the same offset again; of G54.1 the P says which
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
            // it moves by itself, or its effect is unknown
            None if !is_harmless(code, meaning, want, shape) => {
                self.shift = self.shift.max_of(Shift::Block);
                self.forget_axes(shape);
                self.forget_motion();
            }
            _ => {}
        }
    }

    /// After such a code the axis words of the block are no places.
    fn axis_words_are_data(&mut self, meaning: Option<Meaning>) {
        if meaning.is_some_and(|meaning| meaning.axes() == AxisWords::Data) {
            self.shift = self.shift.max_of(Shift::Block);
        }
    }
}

/// May positions be kept after a G code without a modal group? Where the form's control runs it, where the form's
/// commands name it, and in a cycle, whose end forgets them.
fn is_harmless(code: Code, meaning: Option<Meaning>, want: &Want, shape: &Shape) -> bool {
    let known =
        meaning.is_some_and(|meaning| !matches!(meaning, Meaning::Unsaid | Meaning::Probe) && !meaning.is_call());
    known || shape.program.settings.names_code(code) || want.cycle.is_some()
}

/// Does a code run what is written elsewhere: a macro, a subprogram, what the control's file knows and does not run?
fn runs_elsewhere(code: Code, row: &Row, shape: &Shape) -> bool {
    let settings = &shape.program.settings;
    let unsaid = row.meaning == Meaning::Unsaid;
    row.meaning.is_call() || unsaid && settings.control.is_some() && !settings.names_code(code)
}
