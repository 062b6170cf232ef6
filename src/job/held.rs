//! The state that stays active from operation to operation. A selection adds this state to the operation after operations
//! that are left out.

use super::left_out_text::{Left, Other};
use crate::control::Control;
use crate::lang::{Coolant, VarId};
use crate::toolpath::{Given, Spindle, SpindleTurn, ToolChange};

/// Whether a `set` with this name sets a variable. A value of a property applies only to its own operation.
pub(super) fn is_variable(name: &str) -> bool {
    VarId::parse(name.trim_matches(['[', ']'])).is_some()
}

/// The spindle data that an operation must give, so that no earlier value stays active.
pub(super) fn missing_of_spindle(own: Spindle, before: Spindle) -> Option<&'static str> {
    let turns = |spindle: Spindle| spindle.turn.is_some_and(|turn| turn != SpindleTurn::Off);
    if turns(before) && own.turn.is_none() {
        Some("direction of the spindle")
    } else if turns(before) && own.speed.is_none() && turns(own) {
        Some("spindle speed")
    } else if before.max.is_some() && own.css == Some(true) && own.max.is_none() {
        Some("highest spindle speed (`max`)")
    } else {
        None
    }
}

/// The tool axis at the beginning of a job.
pub(super) const UPRIGHT: [f64; 3] = [0.0, 0.0, 1.0];

/// Values that stay in force from operation to operation.
pub(super) struct Held {
    pub tilt: [f64; 3],
    pub is_compensated: bool,
    /// A left-out text or call with an unknown effect.
    pub unknown: Option<String>,
    /// A text with another effect on spindle or coolant, which ends with the tool.
    until_tool: Option<String>,
    pub tool: Option<f64>,
    pub spindle: Option<Spindle>,
    pub coolant: Option<Coolant>,
    pub work: Option<f64>,
    pub set: Vec<(String, Given)>,
}

impl Default for Held {
    fn default() -> Held {
        Held {
            tilt: UPRIGHT,
            is_compensated: false,
            unknown: None,
            until_tool: None,
            tool: None,
            spindle: None,
            coolant: None,
            work: None,
            set: Vec::new(),
        }
    }
}

impl Held {
    /// The state that can't be added to the next operation, if any.
    pub fn lost(&self) -> Option<String> {
        let text = self.unknown.as_ref().or(self.until_tool.as_ref());
        let text = text.map(|text| format!("the effect of {text} on this operation is unknown"));
        text.or_else(|| self.is_compensated.then(|| "cutter compensation stays on".to_owned()))
    }

    /// Keeps the values that stay in force after the operation. Spindle and coolant end at the change to another tool.
    pub fn operation(&mut self, change: &ToolChange) {
        if let Some(tool) = change.changes_to(self.tool) {
            self.tool = Some(tool.number);
            (self.spindle, self.coolant, self.until_tool) = (None, None, None);
        }
        if let Some(own) = change.spindle {
            self.spindle(own.of_operation());
        }
        self.coolant = change.coolant.or(self.coolant);
        self.work = change.work.or(self.work);
        change.set.iter().for_each(|(name, value)| self.set(name, value));
    }

    /// Keeps a change of the spindle.
    pub fn spindle(&mut self, own: Spindle) {
        self.spindle = Some(own.after(self.spindle.unwrap_or_default()));
    }

    /// Keeps the value of a variable.
    pub fn set(&mut self, name: &str, value: &Given) {
        if !is_variable(name) {
            return;
        }
        self.set.retain(|(known, _)| known != name);
        self.set.push((name.to_owned(), value.clone()));
    }

    /// Keeps the state that a text item leaves active. `is_selected`: the program contains the text.
    pub fn text(&mut self, text: &str, control: &Control, is_selected: bool) {
        let Left { spindle, coolant, other } = Left::by(text, control);
        if spindle != Spindle::default() {
            self.spindle(spindle);
        }
        self.coolant = coolant.or(self.coolant);
        match other {
            Other::None => {}
            Other::UntilTool => self.until_tool = Some(format!("the text `{text}`")),
            Other::Unknown if is_selected => {}
            Other::Unknown => self.unknown = Some(format!("the text `{text}`")),
        }
    }
}
