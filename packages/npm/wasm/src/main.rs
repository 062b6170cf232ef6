//! One request: JSON on standard input. One answer: JSON on standard output. `packages/npm/src/index.ts` has both.

use std::collections::HashMap;
use std::io::{Cursor, Read, Write};

use postform::diag::Findings;
use postform::internals::render::Clock;
use postform::internals::report::row;
use postform::toolpath::Units;
use postform::{Error, Format, Job, Options, Post, Proof, Source, Verdict};
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
    options.proof = None;
    options.program = asked.number;
    options.units = asked.units.map(Units::from);
    options.job_file = Format::of_name(&text.name).map(|_| text.name.clone());
    options.clock = asked.date.as_deref().map(|date| {
        let (date, time) = date.split_once('T').unwrap_or((date, ""));
        Clock { date: date.to_owned(), time: time.to_owned() }
    });
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
    let mut program = Vec::new();
    let rendered = post.render_to(job()?, &options, &mut program)?;
    let mut findings: Vec<Value> = rendered.notes.iter().map(|diag| json!(row(diag, post.files()))).collect();
    let mut answer = json!({ "program": String::from_utf8_lossy(&program), "fileName": rendered.file_name, "verdict": "not verified" });
    if asked.verify != Some(false) {
        let proven = post.verify_with(job()?, Cursor::new(&program), &options, &Proof::default())?;
        let found = match &proven.verdict {
            Verdict::Different(found) => found.as_slice(),
            Verdict::NotProven(unproven) => &unproven.notes,
            _ => &[],
        };
        findings.extend(found.iter().map(|found| json!(row(&found.diag("the program"), post.files()))));
        answer["verdict"] = proven.verdict.to_string().into();
        answer["refused"] = matches!(proven.verdict, Verdict::Different(_)).into();
    }
    answer["findings"] = findings.into();
    Ok(answer)
}
