//! The setup sheet: one page with everything that a machinist loads, touches off and checks before a job runs.

mod collect;
mod html;
mod markdown;

pub use collect::{Stops, of_job};
pub use html::html;
pub use markdown::markdown;

use std::io::{self, Read};

use serde::Serialize;
use sha2::{Digest, Sha256};

use crate::machine::Machine;
use crate::preflight::Times;

/// The contents of the sheet. As in the job, lengths are in `units`, and feeds are in units per minute or per revolution.
#[derive(Clone, Debug, Default, Serialize)]
pub struct SetupSheet {
    /// Name of the job.
    pub name: Option<String>,
    /// Name or number of the part.
    pub part: Option<String>,
    /// Material of the part.
    pub material: Option<String>,
    /// Number of the program.
    pub program: Option<u32>,
    /// The date of printing, set by the caller.
    pub date: Option<String>,
    /// The control of the program.
    pub control: String,
    /// The name of the form that printed the program.
    pub form: String,
    /// `mm` or `inch`.
    pub units: &'static str,
    /// Whether X in a lathe's program is a radius or a diameter. `None`: the job is for a mill.
    pub x: Option<&'static str>,
    /// The result of verifying the program against the job.
    pub verdict: String,
    /// The machine, and the results of the check whether the program fits into the machine, one sentence each.
    pub machine: Vec<String>,
    /// Work offsets, each with the extents of its cuts.
    pub works: Vec<Work>,
    /// Tools in the order of their first use.
    pub tools: Vec<ToolRow>,
    /// Operations in the order of the job.
    pub operations: Vec<OperationRow>,
    /// Program stops, each with the comment before it in the job.
    pub stops: Vec<StopRow>,
    /// Minutes of all cuts, without rapids, dwells and tool changes.
    pub minutes: Option<f64>,
    /// Times of the program on the machine, calculated with the machine's accelerations; `None`: the accelerations are
    /// unknown.
    #[serde(serialize_with = "seconds")]
    pub times: Option<Times>,
    /// SHA-256 hashes of the job, the form, all other files that were read, and the program, each with its file name.
    pub hashes: Vec<[String; 2]>,
    /// Pictures as SVG, each with a caption.
    #[serde(skip)]
    pub pictures: Vec<[String; 2]>,
}

impl SetupSheet {
    /// Adds a file with its SHA-256 hash, written as `sha256sum` prints it.
    ///
    /// # Errors
    /// The file can't be read.
    pub fn add_file(&mut self, name: String, mut content: impl Read) -> io::Result<()> {
        let (mut hash, mut part) = (Sha256::new(), vec![0; 1 << 16]);
        loop {
            let count = content.read(&mut part)?;
            if count == 0 {
                break;
            }
            hash.update(&part[..count]);
        }
        let digits = hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        self.hashes.push([name, digits]);
        Ok(())
    }

    /// Adds values from the machine's tool table: lengths, and names of tools for which the job has no name.
    pub fn take_tools(&mut self, machine: &Machine) {
        let Some(table) = &machine.tools else { return };
        let scale = if self.units == "inch" { 25.4 } else { 1.0 };
        for row in &mut self.tools {
            let entry = |number: f64| table.0.get(&(number as u32));
            row.length =
                row.length_register.and_then(entry).and_then(|entry| entry.length).map(|length| length / scale);
            row.name = row.name.take().or_else(|| entry(row.number)?.name.clone());
        }
    }

    /// Adds the time of the program on the machine, in total and for each tool.
    pub fn take_times(&mut self, times: &Times) {
        for row in &mut self.tools {
            let own = |(tool, _): &&(Option<u32>, f64)| tool.is_some_and(|tool| f64::from(tool) == row.number);
            row.seconds = times.tools.iter().find(own).map(|(_, seconds)| *seconds);
        }
        self.times = Some(times.clone());
    }
}

fn seconds<S: serde::Serializer>(times: &Option<Times>, serializer: S) -> Result<S::Ok, S::Error> {
    times.as_ref().map(Times::json).serialize(serializer)
}

/// A work offset.
#[derive(Clone, Debug, Serialize)]
pub struct Work {
    /// Name of the offset in the program.
    pub name: String,
    /// Least and greatest X, Y, Z of the cuts. On a lathe, X is a radius or a diameter, as in the program, and Y is
    /// `None`.
    pub cuts: [Option<[f64; 2]>; 3],
    /// Least and greatest X, Y, Z of cuts and rapids.
    pub moves: [Option<[f64; 2]>; 3],
}

/// A row of the tool list.
#[derive(Clone, Debug, Serialize)]
pub struct ToolRow {
    /// Number of the tool.
    pub number: f64,
    /// Name of the tool.
    pub name: Option<String>,
    /// Diameter of the tool.
    pub diameter: Option<f64>,
    /// Corner radius of the tool.
    pub corner_radius: Option<f64>,
    /// Length register of the tool.
    pub length_register: Option<f64>,
    /// Diameter register of the tool.
    pub diameter_register: Option<f64>,
    /// Length of the tool in the machine, in the job's units.
    pub length: Option<f64>,
    /// Comment about the tool in the job.
    pub comment: Option<String>,
    /// Further values of the tool, with their names in the job.
    pub data: serde_json::Map<String, serde_json::Value>,
    /// Names of the operations that use the tool.
    pub operations: Vec<String>,
    /// The lowest Z of the tool's cuts.
    pub lowest: Option<f64>,
    /// Minutes of the tool's cuts, calculated with the machine's accelerations if they are known.
    pub minutes: Option<f64>,
    /// Seconds on the machine from the tool change to this tool until the next tool change.
    pub seconds: Option<f64>,
}

impl ToolRow {
    /// The tool's registers as text, with the length of the tool in the machine.
    fn registers(&self) -> String {
        let length = self.length.map_or(String::new(), |length| format!(" = {}", short(length)));
        let of = |letter: char, register: Option<f64>| Some(format!("{letter}{}", short(register?)));
        let length = of('H', self.length_register).map(|register| register + &length);
        let both: Vec<String> = [length, of('D', self.diameter_register)].into_iter().flatten().collect();
        if both.is_empty() { "-".into() } else { both.join(", ") }
    }

    /// The tool's comment and further values, as text.
    fn remark(&self) -> String {
        let data = self.data.iter().map(|(name, value)| {
            let text = value.as_str().map(str::to_owned).or_else(|| value.as_f64().map(short));
            format!("{name} {}", text.unwrap_or_default())
        });
        let parts: Vec<String> = self.comment.clone().into_iter().chain(data).collect();
        if parts.is_empty() { "-".into() } else { parts.join(", ") }
    }
}

/// A row of the list of operations.
#[derive(Clone, Debug, Serialize)]
pub struct OperationRow {
    /// Name of the operation.
    pub name: Option<String>,
    /// Tool of the operation.
    pub tool: Option<f64>,
    /// Work offset of the operation.
    pub work: String,
    /// The spindle speed at the beginning of the operation: revolutions per minute, or a surface speed in its unit.
    pub speed: Option<f64>,
    /// If the speed is a surface speed: the limit of the spindle speed, or 0 without a limit. Otherwise `None`.
    pub surface: Option<f64>,
    /// The feed at the beginning of the operation.
    pub feed: Option<f64>,
    /// The unit of the feed: `per_minute`, `per_rev` or `inverse_time`.
    pub feed_mode: &'static str,
    /// Number of holes made by canned cycles in the operation.
    pub holes: u64,
    /// Length of the cuts of the operation.
    pub length: f64,
    /// The lowest Z of the cuts of the operation.
    pub lowest: Option<f64>,
    /// Minutes of the cuts of the operation, calculated with the machine's accelerations if they are known.
    pub minutes: Option<f64>,
}

impl OperationRow {
    fn speed_text(&self) -> String {
        match (self.surface, self.speed) {
            (Some(most), Some(speed)) if most > 0.0 => {
                format!("{} along the surface, at most {} rev/min", short(speed), short(most))
            }
            (Some(_), Some(speed)) => format!("{} along the surface", short(speed)),
            (_, speed) => maybe(speed),
        }
    }

    fn feed_text(&self) -> String {
        let unit = match self.feed_mode {
            "per_rev" => " a turn",
            "inverse_time" => " moves a minute",
            _ => "",
        };
        self.feed.map_or("-".into(), |feed| short(feed) + unit)
    }
}

/// A program stop.
#[derive(Clone, Debug, Serialize)]
pub struct StopRow {
    /// Whether the stop is optional: `M0` always stops, `M1` stops only if the operator has switched optional stops on.
    pub optional: bool,
    /// The tool in the spindle.
    pub tool: Option<f64>,
    /// The comment before the stop in the job.
    pub comment: Option<String>,
}

/// A number with at most four decimals and without trailing zeros.
fn short(value: f64) -> String {
    format!("{}", (value * 1e4).round() / 1e4 + 0.0)
}

fn range(of: Option<[f64; 2]>) -> String {
    of.map_or("-".into(), |[least, greatest]| format!("{} to {}", short(least), short(greatest)))
}

fn maybe(value: Option<f64>) -> String {
    value.map_or("-".into(), short)
}

/// A time in minutes, as text.
fn time(minutes: Option<f64>) -> String {
    minutes.map_or("not known".into(), crate::nc::clock)
}

/// A table with its column titles. The HTML page and the Markdown text both use this table.
struct Table {
    title: &'static str,
    head: Vec<&'static str>,
    rows: Vec<Vec<String>>,
}

/// The tables of the sheet.
fn tables(sheet: &SetupSheet) -> Vec<Table> {
    let text = |text: &Option<String>| text.clone().unwrap_or_else(|| "-".into());
    let axes: &[usize] = if sheet.x.is_some() { &[0, 2] } else { &[0, 1, 2] };
    let works = sheet.works.iter().map(|work| {
        let mut row = vec![work.name.clone()];
        row.extend(axes.iter().map(|axis| range(work.cuts[*axis])));
        row.push(range(work.moves[2]));
        row
    });
    let mut of_works = vec!["offset"];
    of_works.extend(axes.iter().map(|axis| ["X of cuts", "Y of cuts", "Z of cuts"][*axis]));
    of_works.push("Z of all moves");
    let tools = sheet.tools.iter().map(|tool| {
        vec![
            format!("T{}", short(tool.number)),
            text(&tool.name),
            maybe(tool.diameter),
            tool.registers(),
            maybe(tool.lowest),
            time(tool.seconds.map(|seconds| seconds / 60.0).or(tool.minutes)),
            tool.operations.join(", "),
            tool.remark(),
        ]
    });
    let operations = sheet.operations.iter().enumerate().map(|(at, operation)| {
        vec![
            (at + 1).to_string(),
            text(&operation.name),
            operation.tool.map_or("-".into(), |tool| format!("T{}", short(tool))),
            operation.work.clone(),
            operation.speed_text(),
            operation.feed_text(),
            operation.holes.to_string(),
            maybe(operation.lowest),
            time(operation.minutes),
        ]
    });
    let stops = sheet.stops.iter().map(|stop| {
        vec![
            if stop.optional { "M1, if optional stop is on" } else { "M0" }.to_owned(),
            stop.tool.map_or("-".into(), |tool| format!("T{}", short(tool))),
            text(&stop.comment),
        ]
    });
    let mut tables = vec![
        Table { title: "Work offsets", head: of_works, rows: works.collect() },
        Table {
            title: "Tools",
            head: vec!["tool", "name", "diameter", "registers", "lowest Z", "time", "operations", "remark"],
            rows: tools.collect(),
        },
        Table {
            title: "Operations",
            head: vec!["", "name", "tool", "offset", "rev/min", "feed", "holes", "lowest Z", "time"],
            rows: operations.collect(),
        },
    ];
    if !sheet.stops.is_empty() {
        tables.push(Table { title: "Stops", head: vec!["stop", "tool", "what to do"], rows: stops.collect() });
    }
    tables
}

/// The lines at the head of the sheet.
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
    let units = sheet.units.to_owned();
    say("units", Some(sheet.x.map_or(units.clone(), |x| format!("{units}; X counts {x}"))));
    say("date", sheet.date.clone());
    match &sheet.times {
        Some(times) => {
            say("time", Some(format!("{}; the time of an operation is the time of its cuts", times.sentence())))
        }
        None => {
            let feeds =
                if sheet.minutes.is_some() { " at programmed feeds, without rapids and tool changes" } else { "" };
            say("time of the cuts", Some(format!("{}{feeds}", time(sheet.minutes))));
        }
    }
    say("proof", Some(sheet.verdict.clone()));
    for (at, sentence) in sheet.machine.iter().enumerate() {
        let what = if at == 0 { "machine" } else { "" };
        facts.push([what.into(), sentence.clone()]);
    }
    facts
}

/// The title of the sheet.
fn title(sheet: &SetupSheet) -> String {
    sheet.name.clone().or_else(|| sheet.part.clone()).unwrap_or_else(|| "Setup sheet".into())
}
