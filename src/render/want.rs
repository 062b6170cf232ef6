//! The values that the job currently requests: variables, feed, conditions, tool. Events of the job change these values.
//! Printing sets only the values of the printed block and of the form, such as `[movelength]` and `[coolantoff]`.

use std::sync::Arc;

use super::ahead::{Item, default_work};
use super::coolant::{codes, codes_of};
use super::fault::{Done, fault};
use super::fixtures::{fixtures, help_for_fixtures};
use super::numbers::{ROUNDED, as_number, loses};
use super::properties::Properties;
use super::shape::Shape;
use super::texts::Texts;
use super::vars::Vars;
use crate::control;
use crate::control::Meaning;
use crate::diag::Code;
use crate::lang::{Machine, Origin, TextId, Unit, VARIABLES, VarId, work_code};
use crate::number::quantise;
use crate::sema::{Settings, Values};
use crate::suggest::did_you_mean;
use crate::toolpath::{Coolant, CycleKind, FeedMode, Spindle, SpindleTurn};

/// The values that the job currently requests.
#[derive(Clone, Debug)]
pub struct Want {
    vars: Vars,
    /// Names and comments.
    pub texts: Texts,
    /// Values of the form's properties.
    pub properties: Properties,
    /// Whether a condition or a variable changed, so that the next move must check whether the change is printed.
    pub changed: bool,
    /// The feed of moves, in program units.
    feed: Option<f64>,
    /// Feed of moves in units of the last decimal of F, if the rounding error is small.
    feed_units: Option<i64>,
    /// Unit of feeds.
    feed_mode: FeedMode,
    /// Current tool.
    pub tool: Option<f64>,
    /// The tools of the job in the order of their use, if the job lists them.
    pub tool_order: Option<Arc<[f64]>>,
    /// The current item of a list, while its lines print.
    pub item: Option<Item>,
    /// Tool changes so far.
    pub tool_changes: usize,
    /// Spindle limit from a prompt.
    pub most_rpm: Option<f64>,
    /// Whether an operation is open.
    pub in_operation: bool,
    /// Kinds of coolant that the job turned on.
    pub coolant: Coolant,
    /// Whether the job has set the coolant. If false, the form may turn coolant on.
    pub coolant_is_said: bool,
    /// Code that turns off another kind of coolant and is not printed yet.
    pub ends_coolant: Option<f64>,
    /// Whether cutter compensation is on.
    pub compensated: bool,
    /// Whether the current item of the job is a cut.
    pub cutting: bool,
    /// Whether the warning about a cut with the spindle off was given in this operation.
    pub standing_told: bool,
    /// The open canned cycle.
    pub cycle: Option<CycleKind>,
}

impl Want {
    /// Values before the first event of the job: the values of the form's commands.
    pub fn new(shape: &Shape) -> Want {
        let settings = &shape.program.settings;
        let mut want = Want {
            vars: Vars::default(),
            texts: Texts::default(),
            properties: Properties::new(settings, &shape.options.shop, &shape.options.properties),
            changed: true,
            feed: None,
            feed_units: None,
            feed_mode: FeedMode::PerMinute,
            tool: None,
            tool_order: None,
            item: None,
            tool_changes: 0,
            most_rpm: None,
            in_operation: false,
            coolant: Coolant::OFF,
            coolant_is_said: false,
            ends_coolant: None,
            compensated: false,
            cutting: false,
            standing_told: false,
            cycle: None,
        };
        want.set(VarId::Incmode, settings.inc_abs[usize::from(!settings.incremental)]);
        want.set(VarId::Coolantoff, settings.coolant[1]);
        want.set(VarId::Flush, settings.flush[1]);
        want.set(VarId::Speedtype, settings.speed_type[1]);
        want.set(VarId::Totalcutdist, 0.0);
        want.set(VarId::Totalcuttime, 0.0);
        want.set(VarId::Work, default_work(settings));
        want.set(VarId::Cool, settings.coolant[1]);
        want.set(VarId::Lasthole, 0.0);
        want.set_feed_mode(FeedMode::PerMinute, shape);
        want
    }

    /// The value of a variable, if the variable has a value.
    #[inline]
    pub fn get(&self, var: VarId) -> Option<f64> {
        self.vars.get(var)
    }

    /// Gives a variable a value.
    #[inline]
    pub fn set(&mut self, var: VarId, value: f64) {
        self.vars.set(var, value);
    }

    /// Sets or clears the value of a variable.
    pub fn put(&mut self, var: VarId, value: Option<f64>) {
        self.vars.put(var, value);
    }

    /// Adds to the value of a variable.
    pub fn add(&mut self, var: VarId, value: f64) {
        if let Some(sum) = self.get(var) {
            self.set(var, sum + value);
        }
    }

    /// Clears the values of these variables.
    pub fn forget(&mut self, vars: &[VarId]) {
        for &var in vars {
            self.vars.put(var, None);
        }
    }

    /// Values of all variables.
    pub fn values(&self) -> &Vars {
        &self.vars
    }

    /// Restores saved values.
    pub fn restore(&mut self, vars: Vars) {
        self.vars = vars;
    }

    /// Sets a condition; the next move must check whether the condition is printed.
    pub fn set_condition(&mut self, var: VarId, value: f64) {
        self.vars.set(var, value);
        self.changed = true;
    }

    // ---- feeds

    /// The feed of moves, in program units.
    #[inline]
    pub fn feed(&self) -> Option<f64> {
        self.feed
    }

    /// The feed of moves in units of the last decimal of F, if the rounding error is small.
    #[inline]
    pub fn feed_units(&self) -> Option<i64> {
        self.feed_units
    }

    /// The unit of feeds.
    pub fn feed_mode(&self) -> FeedMode {
        self.feed_mode
    }

    /// With inverse time, every feed block prints its own feed.
    #[inline]
    pub fn inverse_time(&self) -> bool {
        self.feed_mode == FeedMode::InverseTime
    }

    /// Sets the feed of a move, which also applies to the following moves. If the move has no feed, the previous feed
    /// is kept. A move without any feed is an error.
    #[inline]
    pub fn take_feed(&mut self, feed: Option<f64>, shape: &Shape) -> Done {
        if let Some(feed) = feed {
            self.set_feed(feed, shape);
        }
        if self.feed.is_none() {
            return fault(Code::PR011, "the move has no feed", "give a `feed` here, or for the whole operation");
        }
        Ok(())
    }

    /// Sets a feed of the job, for the following moves.
    #[inline]
    pub fn set_feed(&mut self, feed: f64, shape: &Shape) {
        let feed = if self.inverse_time() { feed } else { feed * shape.scale };
        self.keep_feed(Some(feed), shape);
    }

    /// Sets a feed in program units, for the following moves.
    pub fn keep_feed(&mut self, feed: Option<f64>, shape: &Shape) {
        let info = &shape.letters[shape.program.settings.feed_code];
        self.feed = feed;
        // a feed that loses too much by rounding is checked at each move
        self.feed_units = feed.and_then(|feed| {
            quantise(feed, info.format.dec.count)
                .filter(|units| !loses(feed, as_number(*units, info.format.dec.count), ROUNDED))
        });
        self.vars.put(VarId::Frate, feed);
    }

    /// Sets the unit of the following feeds.
    pub fn set_feed_mode(&mut self, mode: FeedMode, shape: &Shape) {
        let [minute, rev, inverse] = shape.program.settings.feed_type;
        self.feed_mode = mode;
        let code = match mode {
            FeedMode::PerMinute => minute,
            FeedMode::PerRev => rev,
            FeedMode::InverseTime => inverse,
        };
        self.set_condition(VarId::Feedtype, code);
    }

    // ---- conditions

    /// Sets the work offset: a fixture number below 50, or a code; see [`work_code`].
    pub fn set_work(&mut self, work: f64, shape: &Shape) -> Done {
        match self.code_of_work(work, shape) {
            Ok(code) => {
                self.set_condition(VarId::Work, code);
                Ok(())
            }
            Err(message) => {
                let printed = fixtures(|work| self.code_of_work(work, shape).is_ok());
                fault(Code::PR037, message, help_for_fixtures(&printed, shape.program))
            }
        }
    }

    /// The form's code for a work offset of the job.
    ///
    /// # Errors
    /// A message: the form does not print this offset.
    fn code_of_work(&self, work: f64, shape: &Shape) -> Result<f64, String> {
        let settings = &shape.program.settings;
        let first = settings.work;
        let Some(code) = work_code(first, work) else {
            return Err(format!("the work offset {work} is a code, but this form counts its offsets from {first}"));
        };
        let words = &shape.program.work;
        if let Some(last) = words.beyond(code) {
            return Err(format!("the work offset {work} is after the last one of `MoreWork`, with the number {last}"));
        }
        let of_work = OfWork { work: code, properties: &self.properties };
        let is_said = match words.ways.is_empty() {
            true => !is_no_work(code, shape),
            false => words.way(&of_work, settings.codes()).is_some(),
        };
        if !is_said && settings.machine == Machine::Mill && settings.control().lists_work() {
            return Err(format!("the form has no word for the work offset {work}"));
        }
        Ok(code)
    }

    /// Clears speed and direction, as a tool change does. The limit becomes that of the whole job.
    pub fn clear_spindle(&mut self, shape: &Shape) {
        for var in [VarId::Speed, VarId::Direct] {
            self.put(var, None);
        }
        self.put(VarId::Maxrpm, self.most_rpm);
        self.set(VarId::Speedtype, shape.program.settings.speed_type[1]);
    }

    /// Sets speed, direction, limit and speed mode.
    pub fn put_spindle(&mut self, spindle: &Spindle, shape: &Shape) {
        let settings = &shape.program.settings;
        if let Some(css) = spindle.css {
            self.set(VarId::Speedtype, settings.speed_type[usize::from(!css)]);
        }
        if let Some(speed) = spindle.speed {
            self.set(VarId::Speed, if self.is_surface(shape) { speed * surface_scale(shape) } else { speed });
        }
        if let Some(turn) = spindle.turn {
            let code = match turn {
                SpindleTurn::Cw => settings.spindle[0],
                SpindleTurn::Ccw => settings.spindle[1],
                SpindleTurn::Off => settings.spindle[2],
            };
            self.set(VarId::Direct, code);
        }
        if let Some(max) = spindle.max {
            self.set(VarId::Maxrpm, max);
        }
    }

    /// Whether the speed is a surface speed.
    pub fn is_surface(&self, shape: &Shape) -> bool {
        self.get(VarId::Speedtype) == Some(shape.program.settings.speed_type[0])
    }

    /// The spindle, without its direction. The speed is in the unit of the program.
    pub fn spindle(&self, shape: &Shape) -> Spindle {
        let [speed, max] = [VarId::Speed, VarId::Maxrpm].map(|var| self.get(var));
        Spindle { speed, max, css: Some(self.is_surface(shape)), turn: None }
    }

    /// Changes the spindle for the blocks that follow.
    ///
    /// # Errors
    /// The control has no surface speed, or the form does not print the limit of the spindle.
    pub fn set_spindle(&mut self, spindle: &Spindle, shape: &Shape) -> Done {
        if spindle.css == Some(true) {
            shape.needs(Meaning::SurfaceSpeed)?;
        }
        self.put_spindle(spindle, shape);
        if let Some(max) = spindle.max
            && !shape.program.printed.has(VarId::Maxrpm)
        {
            let message = format!("the spindle is limited to {max}, but the form does not print [maxrpm]");
            return fault(Code::PR038, message, "print it, as `G50 S[maxrpm]`, before the spindle starts");
        }
        self.changed = true;
        Ok(())
    }

    /// Makes `[coolantoff]` the code that turns off the current coolant.
    pub fn ends_what_is_on(&mut self, shape: &Shape) {
        let settings = &shape.program.settings;
        let own = codes(self.coolant.first(), settings).and_then(|codes| codes.own_off);
        self.set(VarId::Coolantoff, own.unwrap_or(settings.coolant[1]));
    }

    /// Sets the coolant: one kind, several, or none. `[coolantoff]` becomes the code that turns off the previous kind
    /// of coolant, or the first of several previous kinds.
    pub fn set_coolant(&mut self, coolant: Coolant, shape: &Shape) -> Done {
        let settings = &shape.program.settings;
        let off = settings.coolant[1];
        let before = self.coolant.first();
        let ends = codes(before, settings).and_then(|codes| codes.own_off).unwrap_or(off);
        for kind in coolant.others() {
            codes_of(kind, settings)?;
        }
        let first = coolant.first();
        let code = if first == Coolant::OFF { ends } else { codes_of(first, settings)?.on };
        self.set(VarId::Coolantoff, ends);
        if first != before {
            // a new kind turns off the previous kind only if neither has its own "off" code
            let has_own_off = |kind| codes(kind, settings).is_some_and(|codes| codes.own_off.is_some());
            let stays = has_own_off(before) || has_own_off(first);
            let ended = stays && before != Coolant::OFF && code != ends && !coolant.holds(before);
            self.ends_coolant = Some(ends).filter(|_| ended);
        }
        (self.coolant, self.coolant_is_said) = (coolant, true);
        self.set_condition(VarId::Cool, code);
        Ok(())
    }

    /// Handles a tool change for which the job sets no coolant. The job's coolant is off after the tool change, and the
    /// form may turn coolant on.
    pub fn coolant_unsaid(&mut self, shape: &Shape) -> Done {
        self.set_coolant(Coolant::OFF, shape)?;
        self.coolant_is_said = false;
        Ok(())
    }
}

/// Values for the calculated word of a work offset.
struct OfWork<'w> {
    work: f64,
    properties: &'w Properties,
}

impl Values for OfWork<'_> {
    fn number(&self, var: VarId) -> Option<f64> {
        (var == VarId::Work).then_some(self.work)
    }

    fn text(&self, _: TextId) -> &str {
        ""
    }

    fn coolant(&self) -> Coolant {
        Coolant::OFF
    }

    fn property(&self, row: u16) -> f64 {
        self.properties.get(row).number()
    }

    fn property_text(&self, row: u16) -> &str {
        self.properties.get(row).text()
    }
}

/// Factor from the job's surface speed to the program's surface speed: feet per minute with inches, metres per minute
/// with millimetres.
fn surface_scale(shape: &Shape) -> f64 {
    const METRES_A_FOOT: f64 = 0.3048;
    match shape.scale {
        scale if scale > 1.0 => METRES_A_FOOT,
        scale if scale < 1.0 => 1.0 / METRES_A_FOOT,
        _ => 1.0,
    }
}

/// Whether the form's control has no work offset code with this number.
pub fn is_no_work(number: f64, shape: &Shape) -> bool {
    !control::Code::of(b'G', number).is_some_and(|code| shape.program.settings.codes().selects_work(code))
}

/// A variable's value in program units.
pub fn in_program_units(var: VarId, value: f64, shape: &Shape) -> f64 {
    if matches!(var.row().unit, Unit::Length | Unit::Feed) { value * shape.scale } else { value }
}

/// The variable of this name, if a job may set it.
pub fn settable(name: &str, settings: &Settings) -> Done<VarId> {
    let own = || settings.properties.iter().map(|property| property.name.as_str());
    let jobs = || VARIABLES.iter().filter(|v| v.origin == Origin::Job).map(|v| v.name).chain(own());
    match VarId::parse(name.trim_matches(['[', ']'])) {
        Some(var) if var.row().origin == Origin::Job => Ok(var),
        // a wire has no tool that could define it
        Some(VarId::Dcomp) if settings.machine == Machine::Edm => Ok(VarId::Dcomp),
        Some(var) => fault(
            Code::PR016,
            format!("[{}] comes from the toolpath and can't be set", var.name()),
            "remove it, or use val1 to val10",
        ),
        None => {
            let help = did_you_mean(name, jobs()).unwrap_or_else(|| {
                format!("declare it in the form, as `Property {name} number 0 ..`, or use val1 to val10")
            });
            fault(Code::PR016, format!("`{name}` is not a variable"), help)
        }
    }
}
