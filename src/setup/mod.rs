//! The setup sheet: what a machinist loads, touches off and looks at before a job runs, on one page.

mod collect;
mod html;
mod markdown;

pub use collect::{Stops, of_job};
pub use html::html;
pub use markdown::markdown;

use serde::Serialize;
use sha2::{Digest, Sha256};

/// What the page says. Lengths are in `units`, feeds in units a minute or a turn, as the job counts them.
#[derive(Clone, Debug, Default, Serialize)]
pub struct SetupSheet {
    /// Name of the job.
    pub name: Option<String>,
    /// Name or number of the part.
    pub part: Option<String>,
    /// What it is made of.
    pub material: Option<String>,
    /// Number of the program.
    pub program: Option<u32>,
    /// The day of printing, as the caller says it.
    pub date: Option<String>,
    /// The control for which the program is.
    pub control: String,
    /// The form that prints it.
    pub form: String,
    /// `mm` or `inch`.
    pub units: &'static str,
    /// What the proof of the program says.
    pub verdict: String,
    /// The machine, and whether the program fits into it: a sentence each.
    pub machine: Vec<String>,
    /// Work offsets, with how far cuts reach in them.
    pub works: Vec<Work>,
    /// Tools in the order of their first use.
    pub tools: Vec<ToolRow>,
    /// Operations in their order.
    pub operations: Vec<OperationRow>,
    /// Where the program stops, with the comment before it in the job.
    pub stops: Vec<StopRow>,
    /// Minutes of all cuts at their programmed feeds; without rapids, dwells and tool changes.
    pub minutes: Option<f64>,
    /// SHA-256 of job, form, control, machine and program.
    pub hashes: Vec<[String; 2]>,
    /// Pictures as SVG, with what they show.
    #[serde(skip)]
    pub pictures: Vec<[String; 2]>,
}

impl SetupSheet {
    /// Adds a file by the digits that `sha256sum` prints of it.
    pub fn add_file(&mut self, name: String, bytes: &[u8]) {
        let digits = Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
        self.hashes.push([name, digits]);
    }
}

/// A work offset.
#[derive(Clone, Debug, Serialize)]
pub struct Work {
    /// As the program calls it.
    pub name: String,
    /// Least and greatest X, Y, Z of the cuts.
    pub cuts: [Option<[f64; 2]>; 3],
    /// Of cuts and rapids.
    pub moves: [Option<[f64; 2]>; 3],
}

/// A tool.
#[derive(Clone, Debug, Serialize)]
pub struct ToolRow {
    /// Its number.
    pub number: f64,
    /// Its name.
    pub name: Option<String>,
    /// Its diameter.
    pub diameter: Option<f64>,
    /// Radius of its corner.
    pub corner_radius: Option<f64>,
    /// Register of its length.
    pub length_register: Option<f64>,
    /// Register of its diameter.
    pub diameter_register: Option<f64>,
    /// What the job says of it.
    pub comment: Option<String>,
    /// Names of its operations.
    pub operations: Vec<String>,
    /// Its lowest cut.
    pub lowest: Option<f64>,
    /// Minutes of its cuts at their programmed feeds.
    pub minutes: Option<f64>,
}

/// An operation.
#[derive(Clone, Debug, Serialize)]
pub struct OperationRow {
    /// Its name.
    pub name: Option<String>,
    /// Its tool.
    pub tool: Option<f64>,
    /// Its work offset.
    pub work: String,
    /// The speed of the spindle when it begins.
    pub speed: Option<f64>,
    /// The feed when it begins.
    pub feed: Option<f64>,
    /// Holes of its cycles.
    pub holes: u64,
    /// Length of its cuts.
    pub length: f64,
    /// Its lowest cut.
    pub lowest: Option<f64>,
    /// Minutes of its cuts at their programmed feeds.
    pub minutes: Option<f64>,
}

/// A stop.
#[derive(Clone, Debug, Serialize)]
pub struct StopRow {
    /// `M0` stops, `M1` stops where the operator wants it.
    pub optional: bool,
    /// The tool that is in the spindle.
    pub tool: Option<f64>,
    /// The comment before it in the job.
    pub comment: Option<String>,
}

/// A number without needless zeros, for people.
fn short(value: f64) -> String {
    format!("{}", (value * 1e4).round() / 1e4 + 0.0)
}

fn range(of: Option<[f64; 2]>) -> String {
    of.map_or("-".into(), |[least, greatest]| format!("{} to {}", short(least), short(greatest)))
}

fn maybe(value: Option<f64>) -> String {
    value.map_or("-".into(), short)
}

/// Minutes as people say them.
fn time(minutes: Option<f64>) -> String {
    minutes.map_or("not known".into(), crate::nc::clock)
}

/// A table with its head: what both kinds of page show.
struct Table {
    title: &'static str,
    head: Vec<&'static str>,
    rows: Vec<Vec<String>>,
}

/// The tables of the page.
fn tables(sheet: &SetupSheet) -> Vec<Table> {
    let text = |text: &Option<String>| text.clone().unwrap_or_else(|| "-".into());
    let works = sheet.works.iter().map(|work| {
        let mut row = vec![work.name.clone()];
        row.extend(work.cuts.iter().map(|cuts| range(*cuts)));
        row.push(range(work.moves[2]));
        row
    });
    let tools = sheet.tools.iter().map(|tool| {
        vec![
            format!("T{}", short(tool.number)),
            text(&tool.name),
            maybe(tool.diameter),
            tool.length_register.map_or("-".into(), |register| format!("H{}", short(register))),
            maybe(tool.lowest),
            time(tool.minutes),
            tool.operations.join(", "),
            text(&tool.comment),
        ]
    });
    let operations = sheet.operations.iter().enumerate().map(|(at, operation)| {
        vec![
            (at + 1).to_string(),
            text(&operation.name),
            operation.tool.map_or("-".into(), |tool| format!("T{}", short(tool))),
            operation.work.clone(),
            maybe(operation.speed),
            maybe(operation.feed),
            operation.holes.to_string(),
            maybe(operation.lowest),
            time(operation.minutes),
        ]
    });
    let stops = sheet.stops.iter().map(|stop| {
        vec![
            if stop.optional { "M1, where you want it" } else { "M0" }.to_owned(),
            stop.tool.map_or("-".into(), |tool| format!("T{}", short(tool))),
            text(&stop.comment),
        ]
    });
    let mut tables = vec![
        Table {
            title: "Work offsets",
            head: vec!["offset", "X of cuts", "Y of cuts", "Z of cuts", "Z of all moves"],
            rows: works.collect(),
        },
        Table {
            title: "Tools",
            head: vec!["tool", "name", "diameter", "length", "lowest Z", "time", "operations", "remark"],
            rows: tools.collect(),
        },
        Table {
            title: "Operations",
            head: vec!["", "name", "tool", "offset", "speed", "feed", "holes", "lowest Z", "time"],
            rows: operations.collect(),
        },
    ];
    if !sheet.stops.is_empty() {
        tables.push(Table { title: "Stops", head: vec!["stop", "tool", "what to do"], rows: stops.collect() });
    }
    tables
}

/// The lines at the head of the page.
fn facts(sheet: &SetupSheet) -> Vec<[String; 2]> {
    let mut facts = Vec::new();
    let mut say = |what: &str, value: Option<String>| {
        if let Some(value) = value {
            facts.push([what.to_owned(), value]);
        }
    };
    say("part", sheet.part.clone());
    say("material", sheet.material.clone());
    say("program", sheet.program.map(|number| format!("O{number}")));
    say("control", Some(sheet.control.clone()));
    say("form", Some(sheet.form.clone()));
    say("units", Some(sheet.units.into()));
    say("date", sheet.date.clone());
    say(
        "time of the cuts",
        Some(format!("{} at programmed feeds, without rapids and tool changes", time(sheet.minutes))),
    );
    say("proof", Some(sheet.verdict.clone()));
    for (at, sentence) in sheet.machine.iter().enumerate() {
        let what = if at == 0 { "machine" } else { "" };
        facts.push([what.into(), sentence.clone()]);
    }
    facts
}

/// The title of the page.
fn title(sheet: &SetupSheet) -> String {
    sheet.name.clone().or_else(|| sheet.part.clone()).unwrap_or_else(|| "Setup sheet".into())
}
