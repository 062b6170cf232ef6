//! What printed codes mean for what is known: modal groups, the frame of axis words, positions and increments.

use super::line::{Line, Shift};
use super::state::Said;
use crate::control::{Frame, Group, Meaning, Row, Words};
use crate::lang::{Machine, VarId};
use crate::render::numbers::tenths;
use crate::render::shape::Shape;
use crate::render::want::Want;

impl Said {
    /// A G or M code was printed in this line.
    pub fn code(&mut self, letter: u8, value: f64, line: Line, want: &Want, shape: &Shape) {
        let row = shape.code_row(letter, value);
        match letter {
            b'M' => self.m_code(value, row, want, shape),
            b'G' | b'g' => self.frame_code(value, row, line, want, shape),
            _ => {}
        }
        let settings = &shape.program.settings;
        let is_feed_mode = letter == b'G' && settings.feed_type.contains(&value);
        if is_feed_mode {
            self.conditions.put(VarId::Feedtype, Some(value));
            self.switched = true;
        }
        let group = row.and_then(|row| row.meaning.group());
        if is_feed_mode || matches!(group, Some(Group::FeedMode | Group::Units)) {
            self.forget(&shape.letters[settings.feed_code]);
        }
        let Some(group) = group else { return };
        match group {
            Group::Plane => self.plane = value,
            Group::Motion => self.motion = Some(tenths(value)),
            Group::Distance => self.distance = Some(tenths(value)),
            _ => {}
        }
        self.registers.set_group(group, tenths(value));
        self.condition_code(group, value, shape);
    }

    /// What an M code stops or moves.
    fn m_code(&mut self, value: f64, row: Option<&Row>, want: &Want, shape: &Shape) {
        let meaning = row.map(|row| row.meaning);
        if meaning.is_some_and(Meaning::is_stop) || shape.program.settings.stop_code.contains(&value) {
            self.stopped(want, shape);
        } else if meaning.is_some_and(|meaning| meaning.is_call() || meaning == Meaning::ToolChange) {
            self.forget_axes(shape); // a changer, and what is called, go where they like
            self.forget_motion();
        }
    }

    /// What a G code does to positions.
    fn frame_code(&mut self, value: f64, row: Option<&Row>, line: Line, want: &Want, shape: &Shape) {
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
                if self.registers.group(Group::Work) == Some(tenths(value))
                    && row.is_some_and(|row| row.words == Words::NONE) => {}
            Some(Frame::Moves) => self.forget_axes(shape),
            Some(Frame::MovesDepth) => self.depth_moved = true,
            None if !is_harmless(value, meaning, line, want, shape) => {
                self.forget_axes(shape);
                if shape.calls(value) {
                    self.forget_motion();
                }
            }
            _ => {}
        }
    }

    /// A word behind the slash of block delete: the control may read it or not, and nothing is known of what it says.
    #[cold]
    pub fn may_be_skipped(&mut self, word: &str, line: Line, want: &Want, shape: &Shape) {
        let mut chars = word.chars();
        let (Some(letter), Ok(value)) =
            (chars.next().and_then(|c| u8::try_from(c).ok()), chars.as_str().parse::<f64>())
        else {
            return;
        };
        if value.is_nan() || value.abs() >= 10_000.0 {
            return;
        }
        self.speed_word(letter, Some(value), shape);
        if letter == b'G' || letter == b'M' {
            self.code(letter, value, line, want, shape);
            if let Some(group) = shape.group_of(letter, value) {
                self.registers.forget_group(group);
            }
        }
        self.displaced(shape.axis_bit(letter), shape);
        self.registers.forget(letter);
    }
}

/// May positions be kept after a G code without a modal group? Where the form's control runs it, where the form's
/// commands name it, in a cycle, whose end forgets them, and beside axis words, which say where it goes.
fn is_harmless(value: f64, meaning: Option<Meaning>, line: Line, want: &Want, shape: &Shape) -> bool {
    let known =
        meaning.is_some_and(|meaning| !matches!(meaning, Meaning::Unsaid | Meaning::Probe) && !meaning.is_call());
    known || shape.program.settings.names_code(value) || want.in_cycle || !shape.calls(value) && line.prints_axes(shape)
}
