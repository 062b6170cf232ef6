//! Tools and the spindle: what the file has said of them, for the tool change that comes.

use super::fault::{Done, fault};
use super::options::Assumed;
use crate::diag::Code;
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
    /// Tools that were named and not loaded.
    not_loaded: Vec<String>,
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

    /// The number of a tool that is not loaded; `None`: nobody says it, which the renderer tells.
    pub fn assumed(&mut self, first: bool) -> Done<Option<f64>> {
        let assumed = self.assumed.as_ref();
        let one = assumed.and_then(Assumed::one).filter(|_| first);
        let Some(name) = &self.name else { return Ok(one) };
        if !self.not_loaded.contains(name) {
            self.not_loaded.push(name.clone());
        }
        let number = one.or_else(|| assumed.and_then(|list| list.of(name)));
        let only = first && !matches!(assumed, Some(Assumed::Named(_)));
        if number.is_some() || only {
            return Ok(number);
        }
        let mut next = self.greatest;
        let all = self.not_loaded.iter().map(|name| {
            let number = assumed.and_then(|list| list.of(name)).unwrap_or_else(|| {
                next += 1.0;
                next
            });
            format!("{name}={number}")
        });
        let help = format!("say the number of each with `--assume-tool {}`", all.collect::<Vec<_>>().join(","));
        fault(Code::PJ006, format!("the file names the tool {name} and does not load it"), help)
    }
}

/// The spindle as the file has said it.
#[derive(Default)]
pub(super) struct Turning {
    /// What is in force.
    pub now: Spindle,
    /// The direction in which it turned last.
    last: Option<SpindleTurn>,
    /// It was said since the last motion, so perhaps for the tool that comes.
    pub is_new: bool,
}

impl Turning {
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
        let turns = self.now.turn.is_some_and(|turn| turn != SpindleTurn::Off) && self.now.css != Some(true);
        self.now.speed.filter(|&rpm| turns && rpm > 0.0)
    }
}
