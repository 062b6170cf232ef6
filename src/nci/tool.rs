//! Tools and operations: the records before a tool change, and the tool change itself.

use super::records::Record;
use super::wrong;
use crate::diag::{Code, Diag};
use crate::lang::Coolant;
use crate::toolpath::{FeedMode, Spindle, SpindleTurn, Tool, ToolChange};

/// The values of the tool from the records before its tool change.
#[derive(Clone, Debug, Default)]
pub struct Ahead {
    /// The number of the tool that has these values; `None` until the tool change.
    pub number: Option<f64>,
    /// The diameter of the tool.
    pub diameter: Option<f64>,
    /// The corner radius of the tool.
    pub corner: Option<f64>,
    /// The name of the tool.
    pub name: Option<String>,
    /// The comment of the operation.
    pub comment: Option<String>,
}

impl Ahead {
    /// Completes the values for the change to the tool `number`. An operation with the same tool as before keeps the values of
    /// this tool; another tool has only its own values.
    pub fn completed(self, number: f64, before: Ahead) -> Ahead {
        let before = if before.number == Some(number) { before } else { Ahead::default() };
        Ahead {
            number: Some(number),
            diameter: self.diameter.or(before.diameter),
            corner: self.corner.or(before.corner),
            name: self.name.or(before.name),
            comment: self.comment,
        }
    }
}

/// The coolant for a number in the file.
///
/// # Errors
/// The number is unknown.
pub fn coolant(number: f64, line: u64) -> Result<Coolant, Box<Diag>> {
    match number {
        0.0 => Ok(Coolant::OFF),
        1.0 => Ok(Coolant::FLOOD),
        2.0 => Ok(Coolant::MIST),
        3.0 => Ok(Coolant::THROUGH),
        other => {
            let help = "0 is off, 1 flood, 2 mist, 3 through the tool";
            Err(wrong(Code::PI003, format!("coolant {other}, whose meaning is unknown"), help, line))
        }
    }
}

/// A tool change (record 1001 or 1002), or another operation with the same tool (record 1000).
///
/// # Errors
/// A value is missing, or is invalid on a mill.
pub fn change(record: &Record, values: &[f64], ahead: &Ahead) -> Result<ToolChange, Box<Diag>> {
    let whole = |at: usize, what: &str| -> Result<f64, Box<Diag>> {
        let value = values[at - 1];
        if value >= 0.0 && value.fract() == 0.0 && value <= f64::from(u32::MAX) {
            return Ok(value);
        }
        let message = format!("the {what} of a tool change is {value}");
        Err(wrong(Code::PI001, message, "write a whole number, 0 or more", record.line + 1))
    };
    let number = whole(4, "tool")?;
    if number == 0.0 {
        return Err(wrong(
            Code::PI002,
            "a tool change to tool 0",
            "give the tool its number in Mastercam",
            record.line,
        ));
    }
    let register = |at: usize, what: &str| whole(at, what).map(|register| (register > 0.0).then_some(register));
    let speed = values[7];
    let turn = match speed {
        0.0 => SpindleTurn::Off,
        speed if speed < 0.0 => SpindleTurn::Ccw,
        _ => SpindleTurn::Cw,
    };
    let spindle = Spindle { speed: (speed != 0.0).then_some(speed.abs()), turn: Some(turn), ..Spindle::default() };
    let tool = Tool {
        number,
        diameter: ahead.diameter.filter(|diameter| *diameter > 0.0),
        corner_radius: ahead.corner.filter(|radius| *radius > 0.0),
        length_offset: register(6, "length register")?,
        diameter_offset: register(5, "diameter register")?,
        name: ahead.name.clone().filter(|name| !name.is_empty() && name != "Undefined"),
        ..Tool::default()
    };
    Ok(ToolChange {
        name: ahead.comment.clone(),
        tool: Some(tool),
        spindle: Some(spindle),
        coolant: Some(coolant(values[9], record.line)?),
        feed_mode: Some(FeedMode::PerMinute),
        comment: ahead.comment.clone(),
        ..ToolChange::default()
    })
}
