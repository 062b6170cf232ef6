//! Tool controllers: a tool with its speed and feeds.

use super::document::{Document, Object, Value};
use super::wrong;
use crate::diag::{Code, Diag};
use crate::toolpath::{Given, SpindleTurn, Tool};

/// Most by which saving changes a feed: paths hold six decimals, controllers sixteen.
const SAVED: f64 = 1e-6;

/// A tool controller.
#[derive(Clone, Debug)]
pub(super) struct Controller {
    /// The name that the user sees.
    pub label: String,
    /// The tool.
    pub tool: Tool,
    /// Revolutions per minute.
    pub speed: f64,
    /// Which way the spindle turns.
    pub turn: SpindleTurn,
    /// Feeds across and down, millimetres a second.
    feeds: [f64; 2],
}

impl Controller {
    /// The controller of that name.
    pub fn of(document: &Document, name: &str) -> Result<Controller, Box<Diag>> {
        let Some(object) = document.objects.get(name) else {
            return wrong(Code::PD001, format!("the document has no object `{name}`"), "save it again in FreeCAD");
        };
        let label = object.text("Label").unwrap_or(name).to_owned();
        let Some(number) = object.number("ToolNumber").filter(|number| *number >= 0.0) else {
            return wrong(Code::PD004, format!("the tool controller {label} has no tool number"), "give it one");
        };
        let turn = match object.text("SpindleDir") {
            Some("Forward") => SpindleTurn::Cw,
            Some("Reverse") => SpindleTurn::Ccw,
            _ => SpindleTurn::Off,
        };
        let speed = object.number("SpindleSpeed").unwrap_or(0.0);
        if turn != SpindleTurn::Off && speed <= 0.0 {
            let help = "give it one in FreeCAD; a tool that does not turn has the direction None";
            return wrong(Code::PD004, format!("the tool controller {label} has no spindle speed"), help);
        }
        let feeds = ["HorizFeed", "VertFeed"].map(|name| object.number(name).unwrap_or(0.0));
        Ok(Controller { tool: tool(document, object, number), label, speed, turn, feeds })
    }

    /// A feed of a path in millimetres a minute: the controller's own where the path has it rounded, else rounded to four
    /// decimals, which saving has spoilt beyond.
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

/// Properties of a tool bit that are for people, and how jobs call them. Lengths are millimetres.
const DATA: [(&str, &str); 6] = [
    ("Length", "length"),
    ("CuttingEdgeHeight", "cutting_length"),
    ("ShankDiameter", "shank"),
    ("TipAngle", "tip_angle"),
    ("Flutes", "flutes"),
    ("Material", "material"),
];

/// A property that says something: FreeCAD has 0 for numbers that nobody gave.
fn data(bit: &Object, name: &str) -> Option<Given> {
    match bit.get(name)? {
        Value::Number(number) if *number > 0.0 => Some(Given::Number(*number)),
        Value::Text(text) if !text.trim().is_empty() => Some(Given::Text(text.clone())),
        _ => None,
    }
}

/// The tool of a controller: a tool bit, or a value inside the controller as documents before 0.19 have it.
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
