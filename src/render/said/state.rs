//! What is known of the control, and how it becomes known and unknown.

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

/// What kind of move printed last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LastMove {
    /// No move that counts.
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

/// What the control holds now.
#[derive(Clone, Debug)]
pub struct Said {
    pub(super) registers: Registers,
    /// Work offset, spindle, coolant, feed mode.
    pub conditions: Conditions,
    /// What the form said of its own.
    pub own: Own,
    /// The code that ended a kind of coolant, while nothing has begun one since.
    pub coolant_ended: Option<f64>,
    /// The kinds of coolant that are on beside the first.
    pub beside: Beside,
    /// Where the tool stands.
    pub stand: Stand,
    /// What the form itself has set.
    pub kept: Kept,
    /// The names of tools that words have printed.
    pub names: Names,
    /// The value of each Upon's variable when it was used last.
    pub upon_used: Vec<Option<f64>>,
    /// The plane that the control is in: what was printed last, also before a tool change. `None`: unknown.
    pub(super) plane: Option<Code>,
    /// The distance code that the control is in: what was printed last, also before a tool change.
    pub(super) distance: Option<Code>,
    /// The motion that the control is in: also where the next move says it again.
    pub(super) motion: Option<Code>,
    /// What kind of move printed last.
    pub last_move: LastMove,
    /// The frame in which axis words of the running sequence stand.
    pub(super) shift: Shift,
    /// The open block changed the frame of the depth axis.
    pub(super) depth_moved: bool,
    /// The open block runs what is written elsewhere, as a macro.
    pub(super) calls: bool,
    /// A code or value that switches something was printed, and nobody looked yet whether the job wants it so.
    pub(super) switched: bool,
    /// The control may not hold what the job wants: the next move must look.
    pub differs: bool,
    /// What the open subprogram does. `None`: in the main program.
    pub sub: Option<Spins>,
}

/// What a subprogram does to a spindle that only its caller knows.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spins {
    /// It stops, or calls one that does: spindle and coolant may stand, whoever calls it.
    pub stops: bool,
    /// It taps right-hand threads itself: in a floating holder that needs the spindle clockwise, and a rigid tap leaves it so
    /// or standing.
    pub taps: bool,
}

impl Said {
    /// A control to which nothing was said; this many Upon sequences watch.
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
            sub: None,
        }
    }

    // ---- letters and groups

    /// A letter printed this value.
    #[inline]
    pub fn word(&mut self, info: &Letter, units: i64) {
        self.registers.set(info.printed, units, info.format.dec.count);
    }

    /// Is this what the letter printed last?
    #[inline]
    pub fn holds(&self, info: &Letter, units: i64) -> bool {
        self.registers.holds(info.printed, units, info.format.dec.count)
    }

    /// What the letter printed last, with its decimals.
    pub fn register(&self, info: &Letter) -> Option<(i64, u8)> {
        self.registers.get(info.printed)
    }

    /// Does the control hold this value of a letter already, a code in its modal group?
    pub fn holds_value(&self, info: &Letter, units: i64, value: f64) -> bool {
        match info.kind {
            LetterKind::GCode | LetterKind::MCode => {
                Code::of(info.printed, value).is_some_and(|code| self.registers.holds_code(code))
            }
            _ => self.holds(info, units),
        }
    }

    /// May a motion block drop this code, because it is in force in its modal group?
    #[inline]
    pub fn code_drops(&self, code: Code, shape: &Shape) -> bool {
        let settings = &shape.program.settings;
        settings.modality && self.registers.holds_code(code) && settings.modal_codes.contains(&code)
    }

    /// Is this motion code the one in force, so that the next move need not say it?
    pub fn motion_in_force(&self, code: &sema::Code) -> bool {
        self.registers.group(Group::Motion) == Some(code.code)
    }

    /// Is the control in this motion, also where the next move says it again?
    pub fn is_in_motion(&self, code: &sema::Code) -> bool {
        self.motion == Some(code.code)
    }

    /// Is the control in this plane?
    pub fn is_in_plane(&self, plane: Code) -> bool {
        self.plane == Some(plane)
    }

    /// Is the control in the distance code of this number?
    pub fn is_in_distance(&self, number: f64) -> bool {
        self.distance.is_some_and(|code| code.value() == number)
    }

    /// Would the control read generated positions as increments, or the other way round?
    pub fn distance_is_wrong(&self, shape: &Shape) -> bool {
        let settings = &shape.program.settings;
        let wrong = settings.inc_abs[usize::from(settings.incremental)];
        self.is_in_distance(wrong) && settings.machine != Machine::Lathe
    }

    /// Would the control read generated positions or feeds in other units, or as diameters? The code that it is in.
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

    /// Would the control read generated positions otherwise than they are meant?
    pub fn is_misread(&self, shape: &Shape, want: &Want) -> bool {
        self.distance_is_wrong(shape) || self.misread_by(shape, want).is_some()
    }

    /// Would the control read the centre words of generated arcs as something else? The code that it is in.
    pub fn centres_misread_by(&self, shape: &Shape) -> Option<Code> {
        let wrong = if shape.program.settings.centre_incremental {
            Meaning::CentresAbsolute
        } else {
            Meaning::CentresIncremental
        };
        self.registers.group(Group::ArcDistance).filter(|&code| shape.meaning_of(code) == Some(wrong))
    }

    /// Does a target differ on one of these axes from what was printed?
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

    /// May the control lack what the job wants, so that something must be done before the next move?
    #[inline]
    pub fn is_unsettled(&self, want: &Want) -> bool {
        want.changed || self.differs
    }

    // ---- what becomes unknown

    /// The letter's value is unknown.
    #[inline]
    pub fn forget(&mut self, info: &Letter) {
        self.registers.forget(info.printed);
    }

    /// The letters of `Force` print again.
    pub fn force(&mut self, shape: &Shape) {
        for &letter in &shape.program.settings.force {
            self.forget(&shape.letters[letter]);
        }
    }

    /// The letter of the depth axis says its next position again.
    pub fn forget_depth(&mut self, shape: &Shape) {
        self.forget(&shape.letters[shape.axes[shape.depth]]);
    }

    /// No letter is known; codes stay.
    pub fn forget_letters(&mut self) {
        self.registers.forget_letters();
    }

    /// Neither letters nor modal groups are known.
    pub fn forget_words(&mut self) {
        self.registers.forget_all();
    }

    /// The next move says its motion code again; the control is still in that motion.
    pub fn say_motion_again(&mut self) {
        self.registers.forget_group(Group::Motion);
    }

    /// Which motion the control is in is unknown, as after a macro.
    pub fn forget_motion(&mut self) {
        self.say_motion_again();
        self.motion = None;
    }

    /// The tool is somewhere else on these axes now. Positions stay what the job means by them; increments need to know
    /// more.
    pub fn displaced(&mut self, axes: u8, shape: &Shape) {
        self.stand.placed &= !axes;
        if shape.program.settings.incremental {
            self.stand.position.given &= !axes;
            self.stand.astray |= axes;
        }
    }

    /// Where the axes are is unknown.
    pub fn forget_axes(&mut self, shape: &Shape) {
        self.displaced(0x3f, shape);
        for letter in shape.axes.into_iter().chain(shape.program.settings.axes2) {
            self.forget(&shape.letters[letter]);
        }
    }

    /// Nobody knows where the tool is, nor how it came there.
    pub fn forget_place(&mut self) {
        self.stand.forget_position();
        self.motion = None;
        self.last_move = LastMove::None;
    }

    /// Nobody knows anything of letters, modal groups, the tool and the part, as where a subprogram begins or ends.
    pub fn forget_where(&mut self) {
        self.forget_words();
        self.stand.angles.forget();
        self.forget_place();
    }

    /// Forgets what belongs to a tool that leaves: speed, direction and the spindle's limit are the next one's; no
    /// letter keeps its value.
    pub fn forget_tool(&mut self) {
        self.stand.angles.keep(&self.stand.position);
        self.stand.forget_position();
        self.forget_words();
        for var in [VarId::Speed, VarId::Direct, VarId::Maxrpm] {
            self.conditions.put(var, None);
        }
    }

    // ---- one sequence

    /// A sequence begins: its axis words stand in the job's frame.
    pub fn begin_sequence(&mut self) {
        self.shift = Shift::None;
    }

    /// A block of a sequence or of the job's text ends.
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

    /// The frame of the depth axis changed in the open block, or its position was printed since.
    pub fn set_depth_moved(&mut self, moved: bool) {
        self.depth_moved = moved;
    }

    /// Do axis words that are printed now stand in another frame than the job's positions?
    pub fn is_elsewhere(&self, shape: &Shape) -> bool {
        self.shift != Shift::None || !shape.program.settings.incremental && self.distance_is_wrong(shape)
    }

    /// Was something switched since this was last asked?
    pub fn take_switched(&mut self) -> bool {
        std::mem::take(&mut self.switched)
    }

    // ---- the part

    /// The rotary axes that a target turns.
    pub fn turned_axes(&self, target: &Axes, shape: &Shape) -> impl Iterator<Item = usize> {
        shape.rotary().filter(move |&axis| target.get(axis).is_some() && target.get(axis) != self.stand.angle(axis))
    }

    /// Does a target turn the part?
    #[inline]
    pub fn turns(&self, target: &Axes, shape: &Shape) -> bool {
        self.turned_axes(target, shape).next().is_some()
    }
}
