//! Reads one request as JSON from standard input, and writes one answer as JSON to standard output.
//! `packages/npm/src/postform.ts` makes the requests.

use std::collections::HashMap;
use std::io::{Cursor, Read, Write};

use postform::diag::{Findings, Location};
use postform::internals::control;
use postform::internals::nc::{RunError, Simulator, json_line};
use postform::internals::report::row;
use postform::toolpath::Units;
use postform::{Clock, Control, Error, Format, Job, Options, Post, RunSettings, Source, Verdict};
use serde::Deserialize;
use serde_json::{Value, json};

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct Request {
    command: Command,
    form: Option<Text>,
    /// The forms that the form calls, by their names.
    #[serde(default)]
    files: HashMap<String, String>,
    job: Option<Text>,
    /// The program that is verified or run.
    program: Option<String>,
    /// The control that runs the program, by its name.
    control: Option<String>,
    /// Whether positions that depend on the position of the machine at the start are null.
    #[serde(default)]
    start_unknown: bool,
    #[serde(default)]
    options: Asked,
}

#[derive(Clone, Copy, Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Command {
    Lint,
    Render,
    Simulate,
    Verify,
}

#[derive(Deserialize)]
struct Text {
    name: String,
    text: String,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
struct Asked {
    properties: HashMap<String, Value>,
    set: HashMap<String, f64>,
    number: Option<u32>,
    units: Option<Unit>,
    assume_units: Option<Unit>,
    date: Option<String>,
    verify: Option<bool>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Unit {
    Mm,
    Inch,
}

impl From<Unit> for Units {
    fn from(unit: Unit) -> Units {
        match unit {
            Unit::Mm => Units::Mm,
            Unit::Inch => Units::Inch,
        }
    }
}

fn main() -> std::io::Result<()> {
    let mut input = String::new();
    std::io::stdin().read_to_string(&mut input)?;
    let answer = match serde_json::from_str(&input) {
        Ok(request) => answer(&request).unwrap_or_else(|error| failed(&error)),
        Err(error) => json!({ "error": error.to_string(), "findings": [] }),
    };
    std::io::stdout().write_all(answer.to_string().as_bytes())
}

fn failed(error: &Error) -> Value {
    json!({ "error": error.to_string(), "findings": rows(error.findings()) })
}

fn rows(findings: &Findings) -> Vec<Value> {
    findings.diags.iter().map(|diag| json!(row(diag, &findings.files))).collect()
}

/// Maximum number of bytes of actions as JSON. The values of these actions need several times as much memory.
const MOST_ACTIONS: usize = 100 << 20;

/// The actions of a machine that runs a program, its warnings, and the block that the control refuses.
fn simulate(request: &Request) -> Value {
    let named = request.control.as_deref().unwrap_or("fanuc");
    let Some(control) = Control::named(named) else {
        let error =
            format!("there is no control {named}; there are {}", control::names().collect::<Vec<_>>().join(", "));
        return json!({ "error": error, "findings": [] });
    };
    let units = request.options.units.map_or(Units::Mm, Units::from);
    let settings = RunSettings { units, places_unknown: request.start_unknown, ..RunSettings::new(control) };
    let mut simulator = Simulator::new(Cursor::new(request.program.as_deref().unwrap_or_default()), settings);
    let (mut items, mut actions, mut warnings) = (Vec::new(), vec![b'['], Vec::new());
    let refused = loop {
        items.clear();
        let step = simulator.step(&mut items);
        for item in &items {
            let before = actions.len();
            json_line(item, simulator.state(), request.start_unknown, &mut actions);
            if actions.len() > before {
                // the line end becomes the comma of the list
                actions.pop();
                actions.push(b',');
            }
        }
        warnings.extend(simulator.take_warnings());
        if actions.len() > MOST_ACTIONS {
            let error = format!(
                "the program makes more than {} MB of actions: run it with the command line",
                MOST_ACTIONS >> 20
            );
            return json!({ "error": error, "findings": [] });
        }
        match step {
            Ok(true) => {}
            Ok(false) => break None,
            Err(RunError::Refused(mut diag, line)) => {
                diag.place.get_or_insert_with(|| Box::new(Location::line(line)));
                break Some(json!(row(&diag, &[])));
            }
            Err(RunError::Io(error)) => return json!({ "error": error.to_string(), "findings": [] }),
        }
    };
    if actions.len() > 1 {
        actions.pop();
    }
    actions.push(b']');
    let warnings: Vec<Value> = warnings.iter().map(|diag| json!(row(diag, &[]))).collect();
    match serde_json::from_slice::<Value>(&actions) {
        Ok(actions) => json!({ "actions": actions, "warnings": warnings, "refused": refused }),
        Err(error) => json!({ "error": error.to_string(), "findings": [] }),
    }
}

fn answer(request: &Request) -> Result<Value, Error> {
    if request.command == Command::Simulate {
        return Ok(simulate(request));
    }
    let Some(form) = &request.form else { return Ok(json!({ "error": "give a form", "findings": [] })) };
    let files = |name: &str| match request.files.get(name) {
        Some(text) => Ok(Source::from_text(name, text.as_str())),
        None => Err("can't be found: give it in `files`".to_owned()),
    };
    let post = Post::compile(Source::from_text(form.name.as_str(), form.text.as_str()), &files);
    if request.command == Command::Lint {
        let findings = post.as_ref().map_or_else(|error| rows(error.findings()), |post| rows(post.findings()));
        return Ok(json!({ "findings": findings }));
    }
    let post = post?;
    let Some(text) = &request.job else { return Ok(json!({ "error": "give a job", "findings": [] })) };
    let asked = &request.options;
    let job = || -> Result<Job<'_>, Error> {
        let mut job = Job::open(&text.name, &text.text)?;
        job.reading.units = asked.assume_units.map(Units::from);
        Ok(job)
    };
    if let (Command::Verify, Some(program)) = (request.command, &request.program) {
        return Ok(json!({ "verdict": post.verify(job()?, program)?.to_string() }));
    }
    let mut options = Options::default();
    options.proof = options.proof.filter(|_| asked.verify != Some(false));
    options.program = asked.number;
    options.units = asked.units.map(Units::from);
    options.job_file = Format::of_name(&text.name).map(|_| text.name.clone());
    if let Some(date) = &asked.date {
        options.clock = Clock::parse(date);
        if options.clock.is_none() {
            let error = format!("date {date:?}: write a day, as 2026-03-31, or 2026-03-31T14:05");
            return Ok(json!({ "error": error, "findings": [] }));
        }
    }
    for (name, value) in &asked.properties {
        let value = match value {
            Value::Bool(flag) => if *flag { "yes" } else { "no" }.to_owned(),
            Value::String(text) => text.clone(),
            other => other.to_string(),
        };
        options.properties.push((name.clone(), value));
    }
    for (name, value) in &asked.set {
        options.set_value(name, *value)?;
    }
    let tried = post.tried(job()?, &options)?;
    let findings: Vec<Value> = tried.findings().iter().map(|diag| json!(row(diag, post.files()))).collect();
    Ok(json!({
        "program": tried.text(),
        "fileName": tried.file_name(),
        "verdict": tried.verdict().to_string(),
        "refused": matches!(tried.verdict(), Verdict::Different(_)),
        "findings": findings,
    }))
}
