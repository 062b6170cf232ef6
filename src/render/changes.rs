//! Work offset, spindle, coolant and feed mode: what was printed of them, and blocks for changes that no sequence serves.

use super::fault::{Done, fault};
use super::numbers::tenths;
use super::renderer::Renderer;
use crate::compile::WorkWord;
use crate::control::Group;
use crate::diag::Code;
use crate::lang::{Machine, Origin, Unit, VARIABLES, VarId, VarSet, did_you_mean, work_code};
use crate::sema;
use crate::toolpath::{Coolant, FeedMode, Spindle, SpindleTurn};

/// The values that the program printed last; `None`: unknown.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Served {
    pub(super) work: Option<f64>,
    pub speed: Option<f64>,
    pub direct: Option<f64>,
    pub cool: Option<f64>,
    pub feed_type: Option<f64>,
    pub speed_type: Option<f64>,
    pub max: Option<f64>,
}

impl Served {
    /// The conditions that were printed.
    pub(super) fn known(&self) -> VarSet {
        let mut known = VarSet::default();
        for (var, _) in CONDITIONS.into_iter().zip(self.values()).filter(|(_, value)| value.is_some()) {
            known.insert(var);
        }
        known
    }

    /// In the order of [`CONDITIONS`].
    fn values(&self) -> [Option<f64>; 7] {
        [self.work, self.speed, self.direct, self.cool, self.feed_type, self.speed_type, self.max]
    }

    /// What holds after a subprogram that printed `later`.
    pub(super) fn then(&self, later: &Served) -> Served {
        Served {
            work: later.work.or(self.work),
            speed: later.speed.or(self.speed),
            direct: later.direct.or(self.direct),
            cool: later.cool.or(self.cool),
            feed_type: later.feed_type.or(self.feed_type),
            speed_type: later.speed_type.or(self.speed_type),
            max: later.max.or(self.max),
        }
    }
}

/// The variables of [`Served`].
pub(super) const CONDITIONS: [VarId; 7] =
    [VarId::Work, VarId::Speed, VarId::Direct, VarId::Cool, VarId::Feedtype, VarId::Speedtype, VarId::Maxrpm];

/// Those of the spindle.
const SPINDLE: VarSet = VarSet::of(&[VarId::Speed, VarId::Direct, VarId::Speedtype]);

impl Renderer<'_> {
    /// A word with this variable was printed.
    #[inline]
    pub(super) fn served_by(&mut self, letter: u8, var: VarId, value: f64) {
        let served = match var {
            VarId::Work => return self.served_work(letter, value),
            VarId::Speed => &mut self.served.speed,
            VarId::Direct => &mut self.served.direct,
            VarId::Cool => &mut self.served.cool,
            VarId::Feedtype => &mut self.served.feed_type,
            VarId::Speedtype => &mut self.served.speed_type,
            VarId::Maxrpm => &mut self.served.max,
            _ if letter == self.shape.program.settings.speed_code => &mut self.served.speed,
            _ => return,
        };
        *served = Some(value);
        self.switched = true;
    }

    /// The work offset was printed by the letter that it has, and not as the argument of something else.
    fn served_work(&mut self, letter: u8, value: f64) {
        let own = self.shape.program.work_word.map_or(b'G', |word| word.letter);
        if own == letter || own == self.shape.letters[letter].printed {
            self.served.work = Some(value);
            self.switched = true;
        }
    }

    /// A code of this group was printed.
    pub(super) fn served_code(&mut self, group: Group, value: f64) {
        self.switched |= !matches!(group, Group::Motion | Group::Return);
        match group {
            Group::Work => match self.shape.program.work_word {
                None => self.served.work = Some(value),
                Some(word) if word.shares_its_codes => self.served.work = None,
                // G56 of an Okuma is a length
                Some(_) => {}
            },
            Group::Spindle => self.served.direct = Some(value),
            Group::Coolant => self.served.cool = Some(value),
            Group::FeedMode => self.served.feed_type = Some(value),
            Group::SpeedMode => self.served.speed_type = Some(value),
            _ => {}
        }
    }

    /// Variables whose change nothing printed yet: the next move counts as using them.
    pub(super) fn pending(&self) -> VarSet {
        let mut set = VarSet::default();
        for (var, served) in CONDITIONS.into_iter().zip(self.served.values()) {
            if self.vars.get(var).is_some_and(|value| served != Some(value)) {
                set.insert(var);
            }
        }
        if self.shape.program.switches_spindle { set.without(SPINDLE) } else { set }
    }

    /// Was this work offset the last one printed?
    pub(super) fn has_work(&self, work: f64) -> bool {
        self.served.work == Some(work)
    }

    /// Is something not as the job has it?
    pub(super) fn has_changes(&self) -> bool {
        !self.pending().is_empty()
    }

    /// Is the work offset all that nothing printed yet?
    pub(super) fn only_work_waits(&self) -> bool {
        self.pending().without(VarSet::of(&[VarId::Work])).is_empty()
    }

    /// Changes that nothing printed yet, each as a block of its own.
    pub(super) fn pending_changes(&mut self) -> Done {
        self.upons(self.pending())?;
        if let Some(work) = self.vars.get(VarId::Work)
            && self.served.work != Some(work)
        {
            self.work_block(work)?;
        }
        if let Some(max) = self.vars.get(VarId::Maxrpm)
            && self.served.max != Some(max)
        {
            let message = format!("the spindle is limited to {max} from here, and nothing prints it");
            let help =
                "the form prints [maxrpm] at a tool change: give the limit there, for the whole time of the tool";
            return fault(Code::PR017, message, help);
        }
        self.check_own_limit()?;
        self.pending_spindle()?;
        if let Some(cool) = self.vars.get(VarId::Cool)
            && self.served.cool != Some(cool)
        {
            self.code_word(&sema::Code::plain(b'M', cool))?;
            self.out.end_block();
            self.served.cool = Some(cool);
        }
        if let Some(feed_type) = self.vars.get(VarId::Feedtype)
            && self.served.feed_type != Some(feed_type)
        {
            self.code_word(&sema::Code::plain(b'G', feed_type))?;
            self.out.end_block();
            self.served.feed_type = Some(feed_type);
        }
        Ok(())
    }

    /// Speed and direction of the spindle that nothing printed yet, unless the form's own sequences say when it turns.
    fn pending_spindle(&mut self) -> Done {
        let settings = &self.shape.program.settings;
        let [cw, ccw, off] = settings.spindle;
        if self.shape.program.switches_spindle {
            return Ok(());
        }
        let speed = self.vars.get(VarId::Speed);
        let direct = self.vars.get(VarId::Direct);
        let turns = direct.is_some_and(|code| code == cw || code == ccw);
        let speed_type = self.vars.get(VarId::Speedtype);
        let other_mode = self.served.speed_type != speed_type;
        if direct != Some(off)
            && (turns || speed.is_some())
            && (self.served.direct != direct || self.served.speed != speed || other_mode)
        {
            if let Some(mode) = speed_type.filter(|_| other_mode) {
                self.code_word(&sema::Code::plain(b'G', mode))?;
                self.served.speed_type = Some(mode);
            }
            if let Some(speed) = speed {
                self.letter_word(settings.speed_code, speed)?;
                self.served.speed = Some(speed);
            }
            if let Some(direct) = direct {
                self.code_word(&sema::Code::plain(b'M', direct))?;
            }
            self.out.end_block();
        } else if direct == Some(off) && self.served.direct != Some(off) {
            self.code_word(&sema::Code::plain(b'M', off))?;
            self.out.end_block();
        }
        Ok(())
    }

    /// A tool without a limit of its own printed its revolutions as one: it holds for no more, and for no surface speed.
    fn check_own_limit(&self) -> Done {
        let Some(limit) = self.served.max.filter(|_| self.vars.get(VarId::Maxrpm).is_none()) else { return Ok(()) };
        let surface = self.vars.get(VarId::Speedtype) == Some(self.shape.program.settings.speed_type[0]);
        if !surface && self.vars.get(VarId::Speed).is_none_or(|speed| speed <= limit) {
            return Ok(());
        }
        let message = format!("the tool change limited the spindle to its first speed, {limit}");
        fault(Code::PR017, message, "give the operation's spindle its `max`")
    }

    /// The work offset, where something that does not print it is about to print a position.
    pub(super) fn work_before(&mut self) -> Done {
        match self.vars.get(VarId::Work) {
            Some(work) if self.served.work != Some(work) => {
                self.work_block(work)?;
                self.served_upons(VarId::Work, work);
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// What the speed counts, where something that does not print it is about to print the speed.
    pub(super) fn speed_mode_before(&mut self) -> Done {
        let Some(mode) = self.vars.get(VarId::Speedtype).filter(|mode| self.served.speed_type != Some(*mode)) else {
            return Ok(());
        };
        self.code_word(&sema::Code::plain(b'G', mode))?;
        self.out.end_block();
        self.served.speed_type = Some(mode);
        Ok(())
    }

    /// The work offset as the form prints it.
    fn work_block(&mut self, work: f64) -> Done {
        match self.shape.program.work_word {
            Some(WorkWord { code, letter, .. }) => {
                if let Some(code) = code {
                    self.code_word(&sema::Code::plain(b'G', code.value()))?;
                }
                self.letter_word(letter, work)?;
                self.forget_axes();
            }
            None if self.is_no_work(work) => {
                let message = format!("the work offset changes to {work}, and the form nowhere prints [work]");
                return fault(Code::PR017, message, "print `G[work]` in the tool changes, or add `Upon [work]`");
            }
            None => self.code_word(&sema::Code::plain(b'G', work))?,
        }
        self.out.end_block();
        self.served.work = Some(work);
        Ok(())
    }

    /// A change of the work offset inside an operation.
    pub(super) fn change_work(&mut self, work: f64) -> Done {
        self.close_cycle()?;
        self.set_work(work)
    }

    /// Is it no code of a work offset of the form's control?
    fn is_no_work(&self, work: f64) -> bool {
        self.group_of(b'G', tenths(work)) != Some(Group::Work)
    }

    /// A fixture number below 50, or a code: see [`work_code`].
    pub(super) fn set_work(&mut self, work: f64) -> Done {
        let first = self.shape.program.settings.work;
        let Some(code) = work_code(first, work) else {
            let message = format!("the work offset {work} is a code, and this form counts its offsets from {first}");
            return fault(Code::PR017, message, "give the number of the fixture, from 1, or a code from 54 to 59");
        };
        if self.shape.program.work_word.is_none()
            && self.is_no_work(code)
            && self.shape.program.settings.machine == Machine::Mill
        {
            let message = format!("the work offset {work} would be G{code}, which is none");
            return fault(Code::PR017, message, "give the code itself, as 59.1, or a fixture number from 1 to 6");
        }
        self.vars.set(VarId::Work, code);
        self.attention = true;
        Ok(())
    }

    /// A change of the spindle.
    pub(super) fn change_spindle(&mut self, spindle: &Spindle) -> Done {
        self.close_cycle()?;
        self.set_spindle(spindle)
    }

    pub(super) fn set_spindle(&mut self, spindle: &Spindle) -> Done {
        let settings = &self.shape.program.settings;
        if let Some(css) = spindle.css {
            self.vars.set(VarId::Speedtype, settings.speed_type[usize::from(!css)]);
        }
        if let Some(speed) = spindle.speed {
            let surface = self.vars.get(VarId::Speedtype) == Some(settings.speed_type[0]);
            self.vars.set(VarId::Speed, if surface { speed * self.surface_scale() } else { speed });
        }
        if let Some(turn) = spindle.turn {
            let code = match turn {
                SpindleTurn::Cw => settings.spindle[0],
                SpindleTurn::Ccw => settings.spindle[1],
                SpindleTurn::Off => settings.spindle[2],
            };
            self.vars.set(VarId::Direct, code);
        }
        if let Some(max) = spindle.max {
            self.vars.set(VarId::Maxrpm, max);
            if !self.shape.program.printed.has(VarId::Maxrpm) {
                let message = format!("the spindle is limited to {max}, and the form nowhere prints [maxrpm]");
                return fault(Code::PR017, message, "print it, as `G50 S[maxrpm]`, before the spindle starts");
            }
        }
        self.attention = true;
        Ok(())
    }

    /// Factor from the job's surface speed to the program's: feet a minute with inches, metres with millimetres.
    fn surface_scale(&self) -> f64 {
        const METRES_A_FOOT: f64 = 0.3048;
        match self.shape.scale {
            scale if scale > 1.0 => METRES_A_FOOT,
            scale if scale < 1.0 => 1.0 / METRES_A_FOOT,
            _ => 1.0,
        }
    }

    /// A change of the coolant.
    pub(super) fn change_coolant(&mut self, coolant: Coolant) -> Done {
        self.close_cycle()?;
        self.set_coolant(coolant);
        Ok(())
    }

    pub(super) fn set_coolant(&mut self, coolant: Coolant) {
        let [on, off, mist] = self.shape.program.settings.coolant;
        let code = match coolant {
            Coolant::On => on,
            Coolant::Mist => mist,
            Coolant::Off => off,
        };
        self.vars.set(VarId::Cool, code);
        self.attention = true;
    }

    pub(super) fn set_feed_mode(&mut self, mode: FeedMode) {
        let [minute, rev, inverse] = self.shape.program.settings.feed_type;
        self.feed_mode = mode;
        let code = match mode {
            FeedMode::PerMinute => minute,
            FeedMode::PerRev => rev,
            FeedMode::InverseTime => inverse,
        };
        self.vars.set(VarId::Feedtype, code);
        self.attention = true;
    }

    /// A change of the feed for the moves that follow.
    pub(super) fn change_feed(&mut self, feed: f64) -> Done {
        self.set_feed(feed);
        Ok(())
    }

    /// A value for a variable of the form.
    pub(super) fn change_variable(&mut self, name: &str, value: f64) -> Done {
        self.close_cycle()?;
        let var = settable(name)?;
        self.set_variable(var, self.in_program_units(var, value));
        Ok(())
    }

    /// A variable's value in program units.
    pub(super) fn in_program_units(&self, var: VarId, value: f64) -> f64 {
        if matches!(var.row().unit, Unit::Length | Unit::Feed) { value * self.shape.scale } else { value }
    }

    pub(super) fn set_variable(&mut self, var: VarId, value: f64) {
        if var == VarId::Block {
            self.out.set_number(value as i64);
        } else {
            self.vars.set(var, value);
        }
        self.attention = true;
    }
}

/// A variable that a job may set.
pub(super) fn settable(name: &str) -> Done<VarId> {
    let jobs = || VARIABLES.iter().filter(|v| v.origin == Origin::Job).map(|v| v.name);
    match VarId::parse(name.trim_matches(['[', ']'])) {
        Some(var) if var.row().origin == Origin::Job => Ok(var),
        Some(var) => fault(
            Code::PR016,
            format!("[{}] comes from the toolpath and can't be set", var.name()),
            "take it out; val1 to val10 are free",
        ),
        None => {
            let help = did_you_mean(name, jobs()).unwrap_or_else(|| "val1 to val10 are free".into());
            fault(Code::PR016, format!("`{name}` is no variable"), help)
        }
    }
}
