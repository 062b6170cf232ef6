//! Tools and the spindle: what the file has said of them, for the tool change that comes.

use super::options::{Assumed, AssumedSpeed};
use crate::toolpath::{Coolant, Spindle, SpindleTurn};

/// Tools of a file.
#[derive(Default)]
pub(super) struct Tools {
    /// Numbers of tools that the file does not load.
    assumed: Option<Assumed>,
    /// The diameter that CUTTER or TLDATA said last.
    pub diameter: Option<f64>,
    /// The tool in use, as TOOL PATH names it.
    pub name: Option<String>,
    /// The operation that begins, as TOOL PATH names it.
    pub operation: Option<String>,
    /// What TPRINT says of the tool that comes.
    pub said: Option<String>,
    /// Tools that were named and not loaded.
    not_loaded: Vec<String>,
    /// The number that was loaded last.
    pub loaded: Option<f64>,
    /// The greatest number that was loaded.
    pub greatest: f64,
    /// The coolant, which stays from tool to tool.
    pub coolant: Option<Coolant>,
}

impl Tools {
    /// Before any tool.
    pub fn new(assumed: Option<Assumed>) -> Self {
        Tools { assumed, ..Tools::default() }
    }

    /// The number of a tool that is not loaded. `first`: no tool was before it.
    ///
    /// # Errors
    /// The option that says it.
    pub fn number(&self, first: bool) -> Result<f64, String> {
        let assumed = self.assumed.as_ref();
        let one = assumed.and_then(Assumed::one).filter(|_| first);
        let named = |name: &String| assumed.and_then(|list| list.of(name));
        if let Some(number) = one.or_else(|| self.name.as_ref().and_then(named)) {
            return Ok(number);
        }
        if self.name.is_none() {
            return Err("--assume-tool 1".into());
        }
        let mut next = self.greatest;
        let new = self.name.iter().filter(|name| !self.not_loaded.contains(name));
        let all = self.not_loaded.iter().chain(new).map(|name| {
            let number = named(name).unwrap_or_else(|| {
                next += 1.0;
                next
            });
            format!("{name}={number}")
        });
        Err(format!("--assume-tool {}", all.collect::<Vec<_>>().join(",")))
    }

    /// The tool in use was not loaded, and has a number all the same.
    pub fn goes_by_its_name(&mut self) {
        let new = self.name.iter().filter(|name| !self.not_loaded.contains(name)).cloned().collect::<Vec<_>>();
        self.not_loaded.extend(new);
    }
}

/// The spindle as the file has said it.
#[derive(Default)]
pub(super) struct Turning {
    /// What is in force.
    pub now: Spindle,
    /// The direction in which it turned last.
    last: Option<SpindleTurn>,
    /// The spindle was said since the last motion, so perhaps for the tool that comes.
    pub is_new: bool,
    /// What turns a tool for which the file says nothing.
    assumed: Option<Spindle>,
}

impl Turning {
    /// Before any SPINDL.
    pub fn new(assumed: Option<AssumedSpeed>) -> Self {
        Turning { assumed: assumed.map(AssumedSpeed::spindle), ..Turning::default() }
    }

    /// What is in force: as said, else as assumed.
    pub fn in_force(&self) -> Spindle {
        match self.assumed {
            Some(assumed) if self.says_no_speed() => {
                Spindle { speed: assumed.speed, turn: self.now.turn.or(assumed.turn), ..self.now }
            }
            _ => self.now,
        }
    }

    /// Nothing says how fast it turns, nor that it stands.
    #[inline]
    pub fn says_no_speed(&self) -> bool {
        self.now.speed.is_none() && self.now.turn != Some(SpindleTurn::Off)
    }

    /// Is there a speed to cut with, or does it stand as it was told?
    #[inline]
    pub fn is_known(&self) -> bool {
        !self.says_no_speed() || self.assumed.is_some()
    }

    /// The direction that SPINDL/ON asks for.
    pub fn direction(&self) -> SpindleTurn {
        self.last.unwrap_or(SpindleTurn::Cw)
    }

    /// What a SPINDL statement says; the rest stays.
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

    /// Revolutions a minute, where it turns at a fixed speed.
    pub fn rpm(&self) -> Option<f64> {
        let now = self.in_force();
        let turns = now.turn.is_some_and(|turn| turn != SpindleTurn::Off) && now.css != Some(true);
        now.speed.filter(|&rpm| turns && rpm > 0.0)
    }
}
