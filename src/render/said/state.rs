//! The known state of the control, and the functions that update or discard it.

use super::conditions::Conditions;
use super::form_values::Own;
use super::line::Shift;
use super::more_coolants::Beside;
use super::position::Stand;
use super::registers::Registers;
use crate::compile::{Letter, LetterKind};
use crate::control::{Code, Group, Meaning};
use crate::lang::{Machine, VarId};
use crate::number::quantise;
use crate::render::form_sets::Kept;
use crate::render::shape::Shape;
use crate::render::texts::Names;
use crate::render::want::Want;
use crate::sema;
use crate::toolpath::Axes;

/// Kind of the last printed move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LastMove {
    /// No relevant move.
    None,
    /// A rapid.
    Rapid,
    /// A line.
    Line,
    /// A clockwise arc.
    Cw,
    /// A counter-clockwise arc.
    Ccw,
}

/// The known state of the control.
#[derive(Clone, Debug)]
pub struct Said {
    pub(super) registers: Registers,
    /// Work offset, spindle, coolant, feed mode.
    pub conditions: Conditions,
    /// Values that words of the form set in place of the job's values.
    pub own: Own,
    /// Code that turned off a kind of coolant; forgotten when another code turns a kind of coolant on.
    pub coolant_ended: Option<f64>,
    /// Additional kinds of coolant that are on, besides the first kind.
    pub beside: Beside,
    /// Position of the tool.
    pub stand: Stand,
    /// Values that the form set with `@set`.
    pub kept: Kept,
    /// Tool names that were printed as words.
    pub names: Names,
    /// For each Upon sequence: the value of its variable when the sequence was last used.
    pub upon_used: Vec<Option<f64>>,
    /// Current plane of the control, as last printed. A tool change does not reset the plane. `None`: unknown.
    pub(super) plane: Option<Code>,
    /// Current distance mode of the control, as last printed. A tool change does not reset the distance mode.
    pub(super) distance: Option<Code>,
    /// Current motion of the control. The motion is kept even if the next move must print the motion code again.
    pub(super) motion: Option<Code>,
    /// Kind of the last printed move.
    pub last_move: LastMove,
    /// Frame of the axis words in the current sequence.
    pub(super) shift: Shift,
    /// Whether the open block changed the frame of the depth axis.
    pub(super) depth_moved: bool,
    /// Whether the open block runs external code, such as a macro.
    pub(super) calls: bool,
    /// Whether a printed code or value switched something that was not compared with the job's request yet.
    pub(super) switched: bool,
    /// Whether the control's state may differ from the job's request, so that the next move must check the state.
    pub differs: bool,
    /// Whether the tool has gone home, and the sequence AfterHome is not printed yet.
    pub from_home: bool,
    /// Effects of the open subprogram on the spindle. `None`: in the main program.
    pub sub: Option<Spins>,
}

/// Effects of a subprogram on the spindle, if only the caller of the subprogram sets the spindle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spins {
    /// Whether the subprogram, or a subprogram that it calls, contains a stop. After a stop, spindle and coolant may be
    /// off.
    pub stops: bool,
    /// Whether the subprogram itself taps right-hand threads. For right-hand threads, a floating holder needs a
    /// clockwise spindle. A rigid tap leaves the spindle clockwise or stopped.
    pub taps: bool,
}

impl Said {
    /// The state before the first block. `upons`: number of Upon sequences.
    pub fn new(upons: usize) -> Said {
        Said {
            registers: Registers::default(),
            conditions: Conditions::default(),
            own: Own::default(),
            coolant_ended: None,
            beside: Beside::OFF,
            stand: Stand::default(),
            kept: Kept::default(),
            names: Names::default(),
            upon_used: vec![None; upons],
            plane: Some(Code::g(17)),
            distance: None,
            motion: None,
            last_move: LastMove::None,
            shift: Shift::None,
            depth_moved: false,
            calls: false,
            switched: false,
            differs: false,
            from_home: false,
            sub: None,
        }
    }

    // ---- letters and groups

    /// Records the printed value of a letter.
    #[inline]
    pub fn word(&mut self, info: &Letter, units: i64) {
        self.registers.set(info.printed, units, info.format.dec.count);
    }

    /// Whether this is the last printed value of the letter.
    #[inline]
    pub fn holds(&self, info: &Letter, units: i64) -> bool {
        self.registers.holds(info.printed, units, info.format.dec.count)
    }

    /// The last printed value of the letter, with its decimals.
    pub fn register(&self, info: &Letter) -> Option<(i64, u8)> {
        self.registers.get(info.printed)
    }

    /// Whether the control already has this value of a letter. If the letter and the value are a code: whether the code
    /// is active in its modal group.
    pub fn holds_value(&self, info: &Letter, units: i64, value: f64) -> bool {
        match info.kind {
            LetterKind::GCode | LetterKind::MCode => {
                Code::of(info.printed, value).is_some_and(|code| self.registers.holds_code(code))
            }
            _ => self.holds(info, units),
        }
    }

    /// Whether a motion block may leave out this code because the code is active in its modal group.
    #[inline]
    pub fn code_drops(&self, code: Code, shape: &Shape) -> bool {
        let settings = &shape.program.settings;
        settings.modality && self.registers.holds_code(code) && settings.modal_codes.contains(&code)
    }

    /// Whether this motion code is active, so that the next move need not print it.
    pub fn motion_in_force(&self, code: &sema::Code) -> bool {
        self.registers.group(Group::Motion) == Some(code.code)
    }

    /// Whether this motion code is active on the control. The result is `true` even if the next move must print the
    /// code again.
    pub fn is_in_motion(&self, code: &sema::Code) -> bool {
        self.motion == Some(code.code)
    }

    /// Whether this plane is active on the control.
    pub fn is_in_plane(&self, plane: Code) -> bool {
        self.plane == Some(plane)
    }

    /// Whether the control is in the distance mode of this number (G90, G91).
    pub fn is_in_distance(&self, number: f64) -> bool {
        self.distance.is_some_and(|code| code.value() == number)
    }

    /// Whether the control would read generated positions as increments, or generated increments as positions. The
    /// result is always `false` on a lathe.
    pub fn distance_is_wrong(&self, shape: &Shape) -> bool {
        let settings = &shape.program.settings;
        let wrong = settings.inc_abs[usize::from(settings.incremental)];
        self.is_in_distance(wrong) && settings.machine != Machine::Lathe
    }

    /// The active code that makes the control misread generated positions or feeds: in other units, or as diameters.
    /// `None`: no such code is active.
    pub fn misread_by(&self, shape: &Shape, want: &Want) -> Option<Code> {
        let settings = &shape.program.settings;
        let inch = want.get(VarId::Unitmode) == Some(settings.inch_mm[0]);
        let units = self.registers.group(Group::Units);
        let others =
            units.filter(|&code| shape.meaning_of(code) == Some(if inch { Meaning::Mm } else { Meaning::Inch }));
        let diameters = || {
            let code = self.registers.group(Group::Diameter).filter(|_| settings.machine == Machine::Mill)?;
            (shape.meaning_of(code) == Some(Meaning::Diameter)).then_some(code)
        };
        others.or_else(diameters)
    }

    /// Whether the control would misread generated positions.
    pub fn is_misread(&self, shape: &Shape, want: &Want) -> bool {
        self.distance_is_wrong(shape) || self.misread_by(shape, want).is_some()
    }

    /// The active code that makes the control misread the centre words of generated arcs. `None`: no such code is
    /// active.
    pub fn centres_misread_by(&self, shape: &Shape) -> Option<Code> {
        let wrong = if shape.program.settings.centre_incremental {
            Meaning::CentresAbsolute
        } else {
            Meaning::CentresIncremental
        };
        self.registers.group(Group::ArcDistance).filter(|&code| shape.meaning_of(code) == Some(wrong))
    }

    /// Whether the target differs from the last printed value along any of these axes.
    pub fn differs_from(&self, target: &Axes, axes: u8, shape: &Shape) -> bool {
        (0..6).any(|axis| {
            let bit = 1 << axis;
            if axes & target.given & bit == 0 {
                return false;
            }
            let info = &shape.letters[shape.axes[axis]];
            let value = target.values[axis] * shape.scales[axis];
            quantise(if info.reversed { -value } else { value }, info.format.dec.count)
                .is_none_or(|units| !self.holds(info, units))
        })
    }

    /// Whether the control's state may differ from the state that the job requires. The renderer then prints the
    /// missing changes before the next move.
    #[inline]
    pub fn is_unsettled(&self, want: &Want) -> bool {
        want.changed || self.differs
    }

    // ---- state that becomes unknown

    /// Forgets the value of a letter.
    #[inline]
    pub fn forget(&mut self, info: &Letter) {
        self.registers.forget(info.printed);
    }

    /// Forgets the values of the letters in `Force`, so that words with these letters are printed again.
    pub fn force(&mut self, shape: &Shape) {
        for &letter in &shape.program.settings.force {
            self.forget(&shape.letters[letter]);
        }
    }

    /// Forgets the last value of the depth axis, so that the next depth position is printed even if it is equal.
    pub fn forget_depth(&mut self, shape: &Shape) {
        self.forget(&shape.letters[shape.axes[shape.depth]]);
    }

    /// Forgets the values of all letters, but keeps the known codes.
    pub fn forget_letters(&mut self) {
        self.registers.forget_letters();
    }

    /// Forgets the values of all letters, and the codes of all modal groups.
    pub fn forget_words(&mut self) {
        self.registers.forget_all();
    }

    /// Makes the next move print its motion code again. The control's motion stays known.
    pub fn say_motion_again(&mut self) {
        self.registers.forget_group(Group::Motion);
    }

    /// Forgets the motion of the control, as after a macro.
    pub fn forget_motion(&mut self) {
        self.say_motion_again();
        self.motion = None;
    }

    /// Records that the form moved the tool along these axes, with words other than the job's positions.
    pub fn displaced(&mut self, axes: u8, shape: &Shape) {
        self.stand.is_retracted |= axes & shape.depth_bit() != 0;
        self.lose_start(axes, shape);
    }

    /// Records that words other than the job's positions may have moved the tool along these axes. The job's positions
    /// stay valid, but the start of increments is now unknown.
    pub fn lose_start(&mut self, axes: u8, shape: &Shape) {
        self.stand.placed &= !axes;
        if shape.program.settings.incremental {
            self.stand.position.given &= !axes;
            self.stand.astray |= axes;
        }
    }

    /// Records that the form moved the tool to a position that only the control knows, for example by a macro.
    pub fn moves_itself(&mut self, shape: &Shape) {
        self.stand.is_retracted = true;
        self.forget_axes(shape);
    }

    /// Records that the axis positions are unknown.
    pub fn forget_axes(&mut self, shape: &Shape) {
        self.lose_start(0x3f, shape);
        for letter in shape.axes.into_iter().chain(shape.program.settings.axes2) {
            self.forget(&shape.letters[letter]);
        }
    }

    /// Forgets the tool's position and the last motion.
    pub fn forget_place(&mut self) {
        self.stand.forget_position();
        self.motion = None;
        self.last_move = LastMove::None;
    }

    /// Forgets the values of letters, the codes of modal groups, and the positions of tool and part, as at the begin or
    /// end of a subprogram.
    pub fn forget_where(&mut self) {
        self.forget_words();
        self.stand.angles.forget();
        self.forget_place();
    }

    /// Forgets the values of the tool that is removed: speed, direction, spindle limit, and all letters.
    pub fn forget_tool(&mut self) {
        self.stand.angles.keep(&self.stand.position);
        self.stand.forget_position();
        self.forget_words();
        for var in [VarId::Speed, VarId::Direct, VarId::Maxrpm] {
            self.conditions.put(var, None);
        }
    }

    // ---- one sequence

    /// Begins a sequence: its axis words are in the job's frame.
    pub fn begin_sequence(&mut self) {
        self.shift = Shift::None;
    }

    /// Ends a block of a sequence or of the job's text.
    pub fn end_block(&mut self, want: &Want, shape: &Shape) {
        if std::mem::take(&mut self.calls) {
            self.called(want, shape);
        }
        if self.shift == Shift::Block {
            self.shift = Shift::None;
        }
        if std::mem::take(&mut self.depth_moved) {
            self.forget_depth(shape);
        }
    }

    /// Sets whether the open block changed the frame of the depth axis and printed no depth position after the change.
    pub fn set_depth_moved(&mut self, moved: bool) {
        self.depth_moved = moved;
    }

    /// Whether the axis words that are printed now use another coordinate frame than the positions of the job.
    pub fn is_elsewhere(&self, shape: &Shape) -> bool {
        self.shift != Shift::None || !shape.program.settings.incremental && self.distance_is_wrong(shape)
    }

    /// Whether anything was switched since the last call of this function.
    pub fn take_switched(&mut self) -> bool {
        std::mem::take(&mut self.switched)
    }

    // ---- the part

    /// The rotary axes that a target turns.
    pub fn turned_axes(&self, target: &Axes, shape: &Shape) -> impl Iterator<Item = usize> {
        shape.rotary().filter(move |&axis| target.get(axis).is_some() && target.get(axis) != self.stand.angle(axis))
    }

    /// Whether a target turns the part.
    #[inline]
    pub fn turns(&self, target: &Axes, shape: &Shape) -> bool {
        self.turned_axes(target, shape).next().is_some()
    }
}
