//! Tool controllers: a tool with its speed and feeds.

use std::io::{Read, Seek};

use super::archive::Archive;
use super::command::{self, Command};
use super::document::{Document, Object, Value};
use super::wrong;
use crate::diag::{Code, Diag};
use crate::toolpath::{Given, ReadError, SpindleTurn, Tool};

/// The largest change of a feed when a document is saved: feeds have six decimals in paths and sixteen in tool
/// controllers.
const SAVED: f64 = 1e-6;

/// A tool controller: a tool with its speed and feeds.
#[derive(Clone, Debug)]
pub(super) struct Controller {
    /// Label of the controller in FreeCAD.
    pub label: String,
    /// The tool.
    pub tool: Tool,
    /// Speed in revolutions per minute.
    pub speed: f64,
    /// Direction of the spindle.
    pub turn: SpindleTurn,
    /// Feeds for moves across and down, in millimetres per second.
    feeds: [f64; 2],
    /// The file in the archive with the tool change of the controller.
    path: Option<String>,
}

impl Controller {
    /// Finds the controller by its name.
    pub fn of(document: &Document, name: &str) -> Result<Controller, Box<Diag>> {
        let Some(object) = document.objects.get(name) else {
            return wrong(
                Code::PD001,
                format!("the document has no object `{name}`"),
                "save the document again in FreeCAD",
            );
        };
        let label = object.text("Label").unwrap_or(name).to_owned();
        let Some(number) = object.number("ToolNumber").filter(|number| *number >= 0.0) else {
            return wrong(
                Code::PD004,
                format!("the tool controller {label} has no tool number"),
                "give the tool controller a tool number in FreeCAD",
            );
        };
        let turn = match object.text("SpindleDir") {
            Some("Forward") => SpindleTurn::Cw,
            Some("Reverse") => SpindleTurn::Ccw,
            _ => SpindleTurn::Off,
        };
        let speed = object.number("SpindleSpeed").unwrap_or(0.0);
        if turn != SpindleTurn::Off && speed <= 0.0 {
            let help = "give the tool controller a spindle speed in FreeCAD; for a tool that does not turn set the \
                direction None";
            return wrong(Code::PD004, format!("the tool controller {label} has no spindle speed"), help);
        }
        let feeds = ["HorizFeed", "VertFeed"].map(|name| object.number(name).unwrap_or(0.0));
        let path = object.path().map(str::to_owned);
        Ok(Controller { tool: tool(document, object, number), label, speed, turn, feeds, path })
    }

    /// Compares direction and speed with the tool change that FreeCAD saved, and prints.
    ///
    /// FreeCAD 0.20 makes the tool change with the direction of the controller, FreeCAD 1.1 with the direction of the
    /// tool, and the two directions can differ. A document without this tool change is not compared.
    pub fn check_saved<R: Read + Seek>(&self, archive: &mut Archive<R>) -> Result<(), ReadError> {
        let (mut changes, mut turn, mut speed) = (false, SpindleTurn::Off, 0.0);
        let path = archive.member(&self.path)?;
        command::each(self.path.as_deref().unwrap_or_default(), path, |_, command| {
            if let Command::Code(code, words) = command {
                let given = words.get(b'S').unwrap_or(0.0);
                match (code.letter, code.tenths) {
                    (b'M', 60) => changes = true,
                    (b'M', 30) => (turn, speed) = (SpindleTurn::Cw, given),
                    (b'M', 40) => (turn, speed) = (SpindleTurn::Ccw, given),
                    _ => {}
                }
            }
            Ok(())
        })?;
        let same_speed = turn == SpindleTurn::Off || (speed - self.speed).abs() <= SAVED;
        if !changes || turn == self.turn && same_speed {
            return Ok(());
        }
        let text = |turn, speed| match turn {
            SpindleTurn::Cw => format!("Forward at {speed}"),
            SpindleTurn::Ccw => format!("Reverse at {speed}"),
            SpindleTurn::Off => "None".to_owned(),
        };
        wrong(
            Code::PD004,
            format!(
                "the tool controller {} has the spindle direction {}, but its tool change {}",
                self.label,
                text(self.turn, self.speed),
                text(turn, speed)
            ),
            "set SpindleDir of the tool controller and SpindleDirection of its tool to the same direction, recompute, and \
             save the document",
        )
    }

    /// Converts a feed of a path to millimetres per minute. If the path's feed is a rounded feed of the tool
    /// controller, the controller's exact feed is used. Any other feed is rounded to four decimals, because further
    /// decimals became inaccurate when the document was saved.
    pub fn feed(&self, saved: f64) -> f64 {
        match self.feeds.iter().find(|own| (**own - saved).abs() <= SAVED) {
            Some(own) => rounded(own * 60.0, 1e8),
            None => rounded(saved * 60.0, 1e4),
        }
    }
}

fn rounded(value: f64, units: f64) -> f64 {
    (value * units).round() / units
}

/// Properties that describe a tool bit, and their names in jobs. Lengths are in millimetres.
const DATA: [(&str, &str); 6] = [
    ("Length", "length"),
    ("CuttingEdgeHeight", "cutting_length"),
    ("ShankDiameter", "shank"),
    ("TipAngle", "tip_angle"),
    ("Flutes", "flutes"),
    ("Material", "material"),
];

/// The value of a property of the tool bit; `None` for 0, which FreeCAD stores for numbers that were not given.
fn data(bit: &Object, name: &str) -> Option<Given> {
    match bit.get(name)? {
        Value::Number(number) if *number > 0.0 => Some(Given::Number(*number)),
        Value::Text(text) if !text.trim().is_empty() => Some(Given::Text(text.clone())),
        _ => None,
    }
}

/// The tool of a controller. The tool is an object (a tool bit); in documents before FreeCAD 0.19, the tool is a value
/// in the controller itself.
fn tool(document: &Document, controller: &Object, number: f64) -> Tool {
    let positive = |value: Option<f64>| value.filter(|value| *value > 0.0);
    let mut tool = Tool { number, ..Tool::default() };
    if let Some(Value::Tool(old)) = controller.get("Tool") {
        tool.comment = Some(old.name.clone());
        (tool.diameter, tool.corner_radius) = (positive(old.diameter), positive(old.corner));
    } else if let Some((name, bit)) = controller.link("Tool").and_then(|name| document.objects.get_key_value(name)) {
        tool.comment = Some(bit.text("Label").unwrap_or(name).to_owned());
        (tool.diameter, tool.corner_radius) = (positive(bit.number("Diameter")), positive(bit.number("CornerRadius")));
    }
    if let Some(bit) = controller.link("Tool").and_then(|name| document.objects.get(name)) {
        tool.data = DATA.iter().filter_map(|(name, own)| Some(((*own).to_owned(), data(bit, name)?))).collect();
    }
    tool.comment = tool.comment.filter(|comment| !comment.trim().is_empty());
    tool.name.clone_from(&tool.comment);
    tool
}
