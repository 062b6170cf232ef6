//! Finds the operations that FreeCAD would post, in the order in which FreeCAD would post them.

use super::choose::Job;
use super::document::{Document, Object, Value};
use super::tools::Controller;
use super::{Report, wrong};
use crate::diag::{Code, Diag};
use crate::toolpath::{Coolant, SpindleTurn, StopKind};

/// One step of a job.
#[derive(Clone, Debug)]
pub(super) struct Step {
    /// Label of the step in FreeCAD.
    pub label: String,
    /// What the step is.
    pub kind: Kind,
    /// The file in the archive with the path of the step.
    pub path: Option<String>,
}

/// Kinds of steps.
#[derive(Clone, Debug)]
pub(super) enum Kind {
    /// An operation with a tool, and its work offset as a code (54 to 59.9).
    Operation(Box<Operation>, f64),
    /// A comment.
    Comment(String),
    /// A stop.
    Stop(StopKind),
}

/// An operation.
#[derive(Clone, Debug)]
pub(super) struct Operation {
    /// The tool controller of the operation: its tool, speed and feeds.
    pub controller: Controller,
    /// Coolant of the operation. Coolant is turned on before the operation and turned off after the operation.
    pub coolant: Coolant,
    /// The top of the operation's holes, where it begins to cut.
    pub top: Option<f64>,
    /// Whether the user wrote the commands of the operation. A user's command that jobs do not support is printed as
    /// written.
    pub typed: bool,
    /// The comment that the user gave the operation.
    pub comment: Option<String>,
}

/// The numbers of all tools in the order of their use.
pub(super) fn tools(steps: &[Step]) -> Vec<f64> {
    let mut tools = Vec::new();
    for step in steps {
        if let Kind::Operation(operation, _) = &step.kind {
            let number = operation.controller.tool.number;
            if tools.last() != Some(&number) {
                tools.push(number);
            }
        }
    }
    tools
}

/// The tool controllers of the operations, each once, in the order of their use.
pub(super) fn controllers(steps: &[Step]) -> impl Iterator<Item = &Controller> {
    let mut labels = std::collections::HashSet::new();
    steps.iter().filter_map(move |step| match &step.kind {
        Kind::Operation(operation, _) => {
            let controller = &operation.controller;
            labels.insert((controller.label.as_str(), controller.tool.number.to_bits())).then_some(controller)
        }
        _ => None,
    })
}

/// All steps of a job, in the order in which FreeCAD posts them.
pub(super) fn steps(document: &Document, job: &Job<'_>, report: &mut Report) -> Result<Vec<Step>, Box<Diag>> {
    let operations = operations(document, job, report)?;
    let fixtures = fixtures(job)?;
    let order = job.object.text("OrderOutputBy").unwrap_or("Fixture");
    if job.object.yes("SplitOutput") == Some(true) {
        let message = format!(
            "Split Output of the job makes one program per {}, but postform makes one program",
            order.to_lowercase()
        );
        let help = "switch Split Output off in the job's Output tab";
        report.warnings.push(Diag::new(Code::PD005, message).help(help));
    }
    if fixtures.len() > 1 {
        report.facts.push(format!("{} work offsets, ordered by {}", fixtures.len(), order.to_lowercase()));
    }
    let groups: Vec<&[Step]> = match order {
        "Operation" => operations.chunks(1).collect(),
        "Tool" => by_tool(&operations, document.version.starts_with("0.")),
        "Fixture" => vec![&operations],
        other => {
            let help = "choose Fixture, Tool or Operation in the job's Output tab";
            return wrong(Code::PD003, format!("an unknown order of output: {other}"), help);
        }
    };
    let mut steps = Vec::new();
    for group in groups {
        for &fixture in &fixtures {
            steps.extend(group.iter().cloned().map(|mut step| {
                if let Kind::Operation(_, work) = &mut step.kind {
                    *work = fixture;
                }
                step
            }));
        }
    }
    Ok(steps)
}

/// Groups steps that use the same tool. Steps without a tool stay in the current group. In 0.20 a tool is identified by its
/// number; in 1.1 by its number, speed and direction.
fn by_tool(steps: &[Step], number_only: bool) -> Vec<&[Step]> {
    let key = |step: &Step| match &step.kind {
        Kind::Operation(operation, _) => {
            let Controller { tool, speed, turn, .. } = &operation.controller;
            Some((tool.number, if number_only { (0.0, SpindleTurn::Off) } else { (*speed, *turn) }))
        }
        _ => None,
    };
    let mut runs = Vec::new();
    let (mut from, mut tool) = (0, None);
    for (i, step) in steps.iter().enumerate() {
        let Some(next) = key(step) else { continue };
        if tool.is_some_and(|tool| tool != next) {
            runs.push(&steps[from..i]);
            from = i;
        }
        tool = Some(next);
    }
    runs.push(&steps[from..]);
    runs
}

/// The work offsets of a job as codes, for example 54 for G54.
fn fixtures(job: &Job<'_>) -> Result<Vec<f64>, Box<Diag>> {
    let names = job.object.texts("Fixtures");
    if names.is_empty() {
        let help =
            "tick G54 or another work offset in the job's Output tab: without a work offset FreeCAD posts nothing";
        return wrong(Code::PD004, format!("the job {} has no work offset", job.label), help);
    }
    let code = |name: &String| {
        let code = name.strip_prefix('G').and_then(|code| code.parse::<f64>().ok());
        match code.filter(|code| (54.0..60.0).contains(code)) {
            Some(code) => Ok(code),
            None => {
                wrong(Code::PD003, format!("a work offset that a job can't contain: {name}"), "choose G54 to G59.9")
            }
        }
    };
    names.iter().map(code).collect()
}

/// The active operations, in the order in which they were created.
fn operations(document: &Document, job: &Job<'_>, report: &mut Report) -> Result<Vec<Step>, Box<Diag>> {
    let group = job.object.link("Operations").and_then(|name| document.objects.get(name));
    let Some(group) = group else {
        return wrong(
            Code::PD001,
            format!("the job {} has no list of operations", job.label),
            "save the document again in FreeCAD",
        );
    };
    let (mut steps, mut inactive) = (Vec::new(), Vec::new());
    for name in group.links("Group") {
        let Some(object) = document.objects.get(name) else {
            return wrong(
                Code::PD001,
                format!("the document has no object `{name}`"),
                "save the document again in FreeCAD",
            );
        };
        let label = object.text("Label").unwrap_or(name).to_owned();
        if document.inherited(name, "Active") == Some(&Value::Yes(false)) {
            inactive.push(label);
            continue;
        }
        let kind = match bare(object) {
            Some(kind) => kind,
            None => operation(document, name, object, &label)?,
        };
        let path = object.path().filter(|_| matches!(kind, Kind::Operation(..))).map(str::to_owned);
        steps.push(Step { label, kind, path });
    }
    if !inactive.is_empty() {
        report.facts.push(format!("left out because they are not active: {}", inactive.join(", ")));
    }
    if !steps.iter().any(|step| matches!(step.kind, Kind::Operation(..))) {
        let help = "add an operation in FreeCAD, or make one active";
        return wrong(Code::PD002, format!("the job {} has no active operation", job.label), help);
    }
    Ok(steps)
}

/// Returns the kind of an object that is a comment or a stop. The class of an object shows its kind. Without a class,
/// the object must have the property of a comment or a stop, and none of the properties of an operation with a tool.
fn bare(object: &Object) -> Option<Kind> {
    let plain = object.class().is_none() && object.get("CoolantMode").is_none() && object.get("Base").is_none();
    if object.class() == Some("Stop") || plain && object.get("Stop").is_some() {
        let optional = object.text("Stop") == Some("Optional");
        return Some(Kind::Stop(if optional { StopKind::Optional } else { StopKind::Program }));
    }
    if object.class() == Some("Comment") || plain && object.get("Comment").is_some() {
        return Some(Kind::Comment(object.text("Comment").unwrap_or_default().to_owned()));
    }
    None
}

fn operation(document: &Document, name: &str, object: &Object, label: &str) -> Result<Kind, Box<Diag>> {
    if let Some(Value::Placement(placement)) = object.get("Placement")
        && !placement.is_identity()
    {
        let [x, y, z] = placement.position;
        let help = "set position and angle of the operation's Placement to 0 in its Data tab, and move the model \
                    instead; for another direction of the tool, make a job of its own";
        return wrong(
            Code::PD003,
            format!("the operation {label} has a Placement (X{x} Y{y} Z{z}) that moves or turns its path"),
            help,
        );
    }
    let controller = match document.inherited(name, "ToolController") {
        Some(Value::Link(link)) if !link.is_empty() => Controller::of(document, link)?,
        _ => {
            let help = "choose a tool controller in the operation, or make the operation inactive";
            return wrong(Code::PD004, format!("the operation {label} has no tool controller"), help);
        }
    };
    let coolant = match document.inherited(name, "CoolantMode") {
        None => Coolant::OFF,
        Some(Value::Text(mode)) => match mode.as_str() {
            "None" => Coolant::OFF,
            "Flood" => Coolant::FLOOD,
            "Mist" => Coolant::MIST,
            other => {
                let help = "choose None, Flood or Mist";
                return wrong(
                    Code::PD003,
                    format!("the operation {label}: a coolant that a job can't contain: {other}"),
                    help,
                );
            }
        },
        Some(_) => {
            return wrong(
                Code::PD001,
                format!("the operation {label}: its CoolantMode is not a text"),
                "save it again",
            );
        }
    };
    let top = match document.inherited(name, "StartDepth") {
        Some(Value::Number(top)) => Some(*top),
        _ => None,
    };
    let comment = object.text("Comment").filter(|text| !text.trim().is_empty()).map(str::to_owned);
    let typed = object.class() == Some("ObjectCustom") || object.get("Gcode").is_some();
    Ok(Kind::Operation(Box::new(Operation { controller, coolant, top, typed, comment }), 0.0))
}
