//! The tools and the spindle, as far as the file has defined them, for the next tool change.

use super::options::{Assumed, AssumedSpeed};
use crate::toolpath::{Coolant, Spindle, SpindleTurn};

/// A property of a tool. A property that was set after the last motion may be for the next tool.
#[derive(Default)]
pub(super) struct Property<T> {
    value: Option<T>,
    is_new: bool,
}

impl<T> Property<T> {
    /// The value for the current tool.
    pub fn get(&self) -> Option<&T> {
        self.value.as_ref()
    }

    /// Sets the value for the current or the next tool.
    pub fn set(&mut self, value: Option<T>) {
        (self.value, self.is_new) = (value, true);
    }

    /// Removes the value of the previous tool.
    fn begin_tool(&mut self) {
        if !self.is_new {
            self.value = None;
        }
    }
}

/// The tools of a file.
#[derive(Default)]
pub(super) struct Tools {
    /// Numbers to assume for tools that the file does not load.
    assumed: Option<Assumed>,
    /// Diameter from the last CUTTER or TLDATA.
    pub diameter: Property<f64>,
    /// Name of the current tool, from TOOL PATH.
    pub name: Property<String>,
    /// Name of the next operation, from TOOL PATH.
    pub operation: Option<String>,
    /// Text of TPRINT, which describes the next tool.
    pub said: Option<String>,
    /// The names of tools that were named but not loaded.
    not_loaded: Vec<String>,
    /// Number of the last loaded tool.
    pub loaded: Option<f64>,
    /// Whether the next tool is changed even if it is in the spindle.
    pub is_forced: bool,
    /// Greatest number of all loaded tools.
    pub greatest: f64,
    /// The current coolant. The coolant stays active after a tool change.
    pub coolant: Option<Coolant>,
}

impl Tools {
    /// The state before the first tool.
    pub fn new(assumed: Option<Assumed>) -> Self {
        Tools { assumed, ..Tools::default() }
    }

    /// Handles the beginning of a motion: the properties so far are those of the current tool.
    #[inline]
    pub fn begin_motion(&mut self) {
        (self.diameter.is_new, self.name.is_new) = (false, false);
    }

    /// Handles the change to another tool.
    pub fn begin_tool(&mut self) {
        self.diameter.begin_tool();
        self.name.begin_tool();
    }

    /// The number of a tool that the file does not load. `first`: whether the tool is the first one.
    ///
    /// # Errors
    /// The number is unknown. The error is the option that gives the number.
    pub fn number(&self, first: bool) -> Result<f64, String> {
        let assumed = self.assumed.as_ref();
        let one = assumed.and_then(Assumed::one).filter(|_| first);
        let named = |name: &String| assumed.and_then(|list| list.of(name));
        if let Some(number) = one.or_else(|| self.name.get().and_then(named)) {
            return Ok(number);
        }
        if self.name.get().is_none() {
            return Err("--assume-tool 1".into());
        }
        let mut next = self.greatest;
        let new = self.name.get().filter(|name| !self.not_loaded.contains(name));
        let all = self.not_loaded.iter().chain(new).map(|name| {
            let number = named(name).unwrap_or_else(|| {
                next += 1.0;
                next
            });
            format!("{name}={number}")
        });
        Err(format!("--assume-tool {}", all.collect::<Vec<_>>().join(",")))
    }

    /// Records that the current tool was only named, and that its number is known.
    pub fn goes_by_its_name(&mut self) {
        if let Some(name) = self.name.get().filter(|name| !self.not_loaded.contains(name)) {
            self.not_loaded.push(name.clone());
        }
    }
}

/// The spindle as the file has defined it so far.
#[derive(Default)]
pub(super) struct Turning {
    /// The current values from the file.
    pub now: Spindle,
    /// The direction in which the spindle turned last.
    last: Option<SpindleTurn>,
    /// Whether the spindle was set after the last motion. A new setting may be for the next tool.
    pub is_new: bool,
    /// The values for a tool whose spindle the file does not define.
    assumed: Option<Spindle>,
}

impl Turning {
    /// The state before the first SPINDL.
    pub fn new(assumed: Option<AssumedSpeed>) -> Self {
        Turning { assumed: assumed.map(AssumedSpeed::spindle), ..Turning::default() }
    }

    /// The active values: the values from the file, otherwise the assumed values.
    pub fn in_force(&self) -> Spindle {
        match self.assumed {
            Some(assumed) if self.says_no_speed() => {
                Spindle { speed: assumed.speed, turn: self.now.turn.or(assumed.turn), ..self.now }
            }
            _ => self.now,
        }
    }

    /// Whether the file gives no speed although the spindle is not switched off.
    #[inline]
    pub fn says_no_speed(&self) -> bool {
        self.now.speed.is_none() && self.now.turn != Some(SpindleTurn::Off)
    }

    /// Whether the speed is given or assumed, or the spindle is switched off.
    #[inline]
    pub fn is_known(&self) -> bool {
        !self.says_no_speed() || self.assumed.is_some()
    }

    /// The direction for SPINDL/ON: the last direction, or clockwise.
    pub fn direction(&self) -> SpindleTurn {
        self.last.unwrap_or(SpindleTurn::Cw)
    }

    /// Applies a SPINDL statement. Values that the statement does not give stay unchanged.
    pub fn say(&mut self, said: Spindle) {
        self.now = Spindle {
            speed: said.speed.or(self.now.speed),
            turn: said.turn.or(self.now.turn),
            css: said.css.or(self.now.css),
            max: said.max.or(self.now.max),
        };
        self.last = self.now.turn.filter(|turn| *turn != SpindleTurn::Off).or(self.last);
        self.is_new = true;
    }

    /// Revolutions per minute, if the spindle turns at a fixed speed.
    pub fn rpm(&self) -> Option<f64> {
        let now = self.in_force();
        let turns = now.turn.is_some_and(|turn| turn != SpindleTurn::Off) && now.css != Some(true);
        now.speed.filter(|&rpm| turns && rpm > 0.0)
    }
}
