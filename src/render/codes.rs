//! What printed codes mean for what is known: modal groups, the frame of axis words, positions and increments.

use super::fault::{Done, fault_at};
use super::motion::MOVED;
use super::numbers::tenths;
use super::renderer::Renderer;
use crate::compile::Op;
use crate::control::{self, Frame, Group, Meaning};
use crate::diag::Code;
use crate::lang::{Machine, VarId};

/// Which axis words of a body stand in another frame than the job's positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shift {
    /// None.
    None,
    /// Those of the block that is open.
    Block,
    /// All from here on.
    Body,
}

impl Shift {
    /// The one that reaches farther.
    fn max_of(self, other: Shift) -> Shift {
        if self == Shift::Body { self } else { other }
    }
}

impl Renderer<'_> {
    /// What the form's control has of a code, given in tenths.
    pub(super) fn code_row(&self, letter: u8, tenths: i64) -> Option<&'static control::Row> {
        let tenths = u16::try_from(tenths).ok()?;
        self.shape.program.settings.codes().row(control::Code { letter, tenths })
    }

    /// What a code, given in tenths, means on the form's control. `None`: nobody knows.
    pub(super) fn meaning_of(&self, letter: u8, tenths: i64) -> Option<Meaning> {
        self.code_row(letter, tenths).map(|row| row.meaning)
    }

    /// Does a G code start a cycle of the form's control?
    pub(super) fn is_cycle(&self, value: f64) -> bool {
        self.meaning_of(b'G', tenths(value)).is_some_and(Meaning::is_cycle)
    }

    /// Does a G code say the plane of arcs?
    pub(super) fn is_plane(&self, value: f64) -> bool {
        self.group_of(b'G', tenths(value)) == Some(Group::Plane)
    }

    /// The modal group of a code, given in tenths.
    pub(super) fn group_of(&self, letter: u8, tenths: i64) -> Option<Group> {
        self.meaning_of(letter, tenths)?.group()
    }

    /// What a printed G or M code does to the registers.
    pub(super) fn printed_code(&mut self, letter: u8, value: f64) {
        let tenths = tenths(value);
        let lathe = self.shape.program.settings.machine == Machine::Lathe;
        let row = self.code_row(letter, tenths);
        let meaning = row.map(|row| row.meaning);
        if letter == b'M' {
            if meaning.is_some_and(Meaning::is_stop) || self.shape.program.settings.stop_code.contains(&value) {
                self.stopped();
            } else if meaning.is_some_and(|meaning| meaning.is_call() || meaning == Meaning::ToolChange) {
                self.forget_axes(); // a changer, and what is called, go where they like
                self.forget_motion();
            }
        }
        if letter == b'G' || letter == b'g' {
            match meaning.and_then(Meaning::frame) {
                Some(Frame::Block) => {
                    self.shifted = self.shifted.max_of(Shift::Block);
                    if meaning != Some(Meaning::Machine)
                        && !self.line_prints(|renderer, letter, _| renderer.shape.axis_bit(letter) != 0)
                    {
                        self.forget_axes();
                    }
                }
                // on a lathe G92 is a threading cycle
                Some(Frame::Shifts) if lathe => {}
                Some(Frame::Shifts) => self.shifted = Shift::Body,
                // on a lathe increments have letters of their own
                Some(Frame::Increments) if lathe => self.shifted = Shift::Body,
                // the same offset again; of G54.1 the P says which
                Some(Frame::Moves)
                    if self.registers.group(Group::Work) == Some(tenths)
                        && row.is_some_and(|row| row.words == control::Words::NONE) => {}
                Some(Frame::Moves) => self.forget_axes(),
                Some(Frame::MovesDepth) => self.depth_moved = true,
                None if !self.is_harmless(value, meaning) => {
                    self.forget_axes();
                    if self.calls(value) {
                        self.forget_motion();
                    }
                }
                _ => {}
            }
        }
        let settings = &self.shape.program.settings;
        let is_feed_mode = letter == b'G' && settings.feed_type.contains(&value);
        if is_feed_mode {
            self.served.feed_type = Some(value);
            self.switched = true;
        }
        match meaning.and_then(Meaning::group) {
            Some(group) => {
                match group {
                    Group::Plane => self.plane = value,
                    Group::Motion => self.in_motion = Some(tenths),
                    Group::Distance => self.distance = Some(tenths),
                    _ => {}
                }
                if matches!(group, Group::FeedMode | Group::Units) || is_feed_mode {
                    self.registers.forget(self.shape.letters[settings.feed_code].printed);
                }
                self.registers.set_group(group, tenths);
                self.served_code(group, value);
            }
            None if is_feed_mode => self.registers.forget(self.shape.letters[settings.feed_code].printed),
            None => {}
        }
    }

    /// May positions be kept after a G code without a modal group? Where the form's control runs it, where the form's
    /// commands name it, in a cycle, whose end forgets them, and beside axis words, which say where it goes.
    fn is_harmless(&self, value: f64, meaning: Option<Meaning>) -> bool {
        let known = meaning.is_some_and(|meaning| meaning != Meaning::Unsaid && !meaning.is_call());
        known
            || self.shape.program.settings.names_code(value)
            || self.cycle.is_some()
            || !self.calls(value) && self.line_prints(|renderer, letter, _| renderer.shape.axis_bit(letter) != 0)
    }

    /// Does a G code call a macro, or what the builder of the machine wrote?
    fn calls(&self, value: f64) -> bool {
        control::Code::of(b'G', value).is_some_and(|code| self.shape.program.settings.codes().calls(code))
    }

    /// Do axis words that are printed now stand in another frame than the job's positions?
    pub(super) fn is_elsewhere(&self) -> bool {
        self.shifted != Shift::None || !self.shape.program.settings.incremental && self.distance_is_wrong()
    }

    /// Does the line of the sequence that is being printed have such a word? Asked of its letter, and of its variable
    /// where it has one. Generated blocks have no line.
    pub(super) fn line_prints(&self, asked: impl Fn(&Self, u8, Option<VarId>) -> bool) -> bool {
        let (ops, Some(here)) = (&self.shape.program.ops, self.form) else { return false };
        if self.out.is_too_long() {
            return false; // the block is refused at its end, whatever it says
        }
        let is_line = |op: &Op| matches!(op, Op::Line { .. });
        let start = ops[..here].iter().rposition(is_line).map_or(0, |at| at + 1);
        ops[start..].iter().take_while(|op| !is_line(op)).any(|op| match *op {
            Op::Var { letter, var, .. } => asked(self, letter, Some(var)),
            Op::Literal { index, .. } => asked(self, self.shape.program.literals[index as usize].letter, None),
            _ => false,
        })
    }

    /// A word behind the slash of block delete: the control may read it or not, and nothing is known of what it says.
    #[cold]
    pub(super) fn may_be_skipped(&mut self, word: &str) {
        let mut chars = word.chars();
        let (Some(letter), Ok(value)) =
            (chars.next().and_then(|c| u8::try_from(c).ok()), chars.as_str().parse::<f64>())
        else {
            return;
        };
        if value.is_nan() || value.abs() >= 10_000.0 {
            return;
        }
        if letter == self.shape.program.settings.speed_code {
            self.served.speed = Some(value);
            self.switched = true;
        }
        if letter == b'G' || letter == b'M' {
            self.printed_code(letter, value);
            if let Some(group) = self.group_of(letter, tenths(value)) {
                self.registers.forget_group(group);
            }
        }
        self.displaced(self.shape.axis_bit(letter));
        self.registers.forget(letter);
    }

    /// These axes are somewhere else now. Positions stay what the job means by them; increments need to know more.
    pub(super) fn displaced(&mut self, axes: u8) {
        self.placed &= !axes;
        if self.shape.program.settings.incremental {
            self.position.given &= !axes;
            for axis in (0..MOVED.len()).filter(|axis| axes & 1 << axis != 0) {
                self.vars.put(MOVED[axis], None);
            }
        }
    }

    /// Which motion the control is in is unknown, as after a macro.
    pub(super) fn forget_motion(&mut self) {
        self.registers.forget_group(Group::Motion);
        self.in_motion = None;
    }

    /// Where the axes are is unknown.
    pub(super) fn forget_axes(&mut self) {
        self.displaced(0x3f);
        for letter in self.shape.axes.into_iter().chain(self.shape.program.settings.axes2) {
            self.registers.forget(self.shape.letters[letter].printed);
        }
    }

    /// Would the control read generated positions as increments, or the other way round?
    pub(super) fn distance_is_wrong(&self) -> bool {
        let settings = &self.shape.program.settings;
        let wrong = tenths(settings.inc_abs[usize::from(settings.incremental)]);
        self.distance == Some(wrong) && settings.machine != Machine::Lathe
    }

    /// In a form of increments a position is read as one, unless the control was told otherwise.
    #[cold]
    pub(super) fn check_position_word(&self, letter: u8, var: VarId) -> Done {
        let [increments, _] = self.shape.program.settings.inc_abs;
        if self.distance != Some(tenths(increments)) {
            return Ok(());
        }
        let message =
            format!("{}[{}] is a position, and the control is in G{increments}", char::from(letter), var.name());
        fault_at(Code::PR017, message, "print G90 before it, or the increment, as [hdist]", None)
    }

    /// The codes of a text outside comments: what they switch is known.
    pub(super) fn text_codes(&mut self, text: &str) -> Done {
        let bytes = text.as_bytes();
        let (mut at, mut depth) = (0, 0);
        while at < bytes.len() {
            let letter = bytes[at].to_ascii_uppercase();
            at += 1;
            match letter {
                b';' if depth == 0 => break,
                b'(' => depth += 1,
                b')' => depth -= 1,
                b'G' | b'M' | b'S' if depth == 0 => {
                    let end = at + bytes[at..].iter().take_while(|b| b.is_ascii_digit() || **b == b'.').count();
                    if let Ok(value) = text[at..end].parse::<f64>() {
                        if letter == b'S' {
                            self.served.speed = Some(value);
                            self.vars.set(VarId::Speed, value);
                        } else if self.changes_units(letter, value) {
                            let message = format!("the text changes the units of the program with G{value}");
                            return fault_at(
                                Code::PR017,
                                message,
                                "render with `--units`, and take the code out",
                                None,
                            );
                        } else {
                            self.printed_code(letter, value);
                            self.is_the_jobs(letter, value);
                        }
                    }
                    at = end;
                }
                _ => {}
            }
        }
        self.registers.forget_all();
        self.attention |= self.distance_is_wrong() || self.has_changes();
        Ok(())
    }

    /// What a text switches is what the job wants from there on; what its feeds count is not.
    fn is_the_jobs(&mut self, letter: u8, value: f64) {
        let var = match self.group_of(letter, tenths(value)) {
            Some(Group::Spindle) => VarId::Direct,
            Some(Group::Coolant) => VarId::Cool,
            Some(Group::Work) => match self.shape.program.work_word {
                None => VarId::Work,
                // G54 is none of the offsets that have a word of their own: nobody knows its number
                Some(word) if word.shares_its_codes => return self.vars.put(VarId::Work, None),
                Some(_) => return,
            },
            Some(Group::SpeedMode) => VarId::Speedtype,
            _ => return,
        };
        self.vars.set(var, value);
    }

    /// Is this a code of other units than the program's?
    fn changes_units(&self, letter: u8, value: f64) -> bool {
        self.group_of(letter, tenths(value)) == Some(Group::Units) && self.vars.get(VarId::Unitmode) != Some(value)
    }
}
