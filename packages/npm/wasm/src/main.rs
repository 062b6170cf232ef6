//! One request: JSON on standard input. One answer: JSON on standard output. `packages/npm/src/index.ts` has both.

use std::collections::HashMap;
use std::io::{Read, Write};

use postform::diag::Findings;
use postform::internals::report::row;
use postform::toolpath::Units;
use postform::{Clock, Error, Format, Job, Options, Post, Source, Verdict};
use serde::Deserialize;
use serde_json::{Value, json};

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct Request {
    command: Command,
    form: Text,
    /// Forms that it calls, by their names.
    #[serde(default)]
    files: HashMap<String, String>,
    job: Option<Text>,
    /// The program that is verified.
    program: Option<String>,
    #[serde(default)]
    options: Asked,
}

#[derive(Clone, Copy, Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Command {
    Lint,
    Render,
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

fn answer(request: &Request) -> Result<Value, Error> {
    let files = |name: &str| match request.files.get(name) {
        Some(text) => Ok(Source::from_text(name, text.as_str())),
        None => Err("can't be found: give it in `files`".to_owned()),
    };
    let post = Post::compile(Source::from_text(request.form.name.as_str(), request.form.text.as_str()), &files);
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
