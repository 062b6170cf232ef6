//! postform for the playground: it reads a request from standard input and writes a scene to standard output.
//!
//! A request consists of the length of the head (four bytes, little-endian), the head as JSON, and the files that the
//! head names, one after the other. The files of each form are its current text and its saved text. After the forms
//! follow the job, the program to compare with, and the program of the saved form.

use std::collections::HashMap;
use std::io::{self, Read, Write};

use postform::internals::diff;
use postform::internals::lint::Levels;
use postform::internals::scene::{At, Request, help, scene};
use postform::internals::sema::Limits;
use postform::{Files, Job, Options, Proof, Source};
use serde::Deserialize;
use serde_json::json;

#[derive(Deserialize)]
struct Head {
    /// The form, then the forms that it may call.
    forms: Vec<Form>,
    job: File,
    against: Option<File>,
    /// The program of the saved forms for the job, if the current texts of the forms differ from the saved texts.
    before: Option<File>,
    jobs: Vec<String>,
    /// Values of the form's properties.
    #[serde(default)]
    properties: Vec<(String, String)>,
    /// A location in a form. If there is a location, the answer is the help for this location, not a scene.
    at: Option<At>,
}

#[derive(Deserialize)]
struct Form {
    name: String,
    length: usize,
    saved: usize,
}

#[derive(Deserialize)]
struct File {
    name: String,
    length: usize,
}

/// Forms by their names.
struct Texts(HashMap<String, Source>);

impl Files for Texts {
    fn read(&self, name: &str) -> Result<Source, String> {
        self.0.get(name).cloned().ok_or_else(|| "can't be found: drop this file here too".to_owned())
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut input = Vec::new();
    io::stdin().lock().read_to_end(&mut input)?;
    let (length, rest) = input.split_at_checked(4).ok_or("no request")?;
    let length = u32::from_le_bytes(length.try_into()?) as usize;
    let (head, mut rest) = rest.split_at_checked(length).ok_or("the header is incomplete")?;
    let head: Head = serde_json::from_slice(head)?;
    let mut next = |length: usize| -> Result<&[u8], &str> {
        let (part, behind) = rest.split_at_checked(length).ok_or("a file is incomplete")?;
        rest = behind;
        Ok(part)
    };
    let (mut now, mut saved) = (Vec::new(), Vec::new());
    for form in &head.forms {
        now.push(Source::from_bytes(form.name.as_str(), next(form.length)?));
        saved.push(Source::from_bytes(form.name.as_str(), next(form.saved)?));
    }
    let job = next(head.job.length)?;
    let against = match &head.against {
        Some(file) => Some((file.name.as_str(), next(file.length)?)),
        None => None,
    };
    let before = match &head.before {
        Some(file) => Some(std::str::from_utf8(next(file.length)?)?),
        None => None,
    };
    let is_typed = now.iter().zip(&saved).any(|(now, saved)| now.text != saved.text);
    let form = now.first().cloned().ok_or("no form")?;
    let by_name = |forms: Vec<Source>| Texts(forms.into_iter().map(|form| (form.name.clone(), form)).collect());
    let (now, saved) = (by_name(now), by_name(saved));
    let mut job = Job::open(&head.job.name, job)?;
    let request = Request {
        form,
        files: &now,
        limits: Limits::default(),
        levels: &Levels::default(),
        job: Ok(job.again()),
        job_name: &head.job.name,
        options: Options::default(),
        properties: head.properties,
        proof: Proof::default(),
    };
    if let Some(at) = &head.at {
        io::stdout().lock().write_all(help(request, at).to_string().as_bytes())?;
        return Ok(());
    }
    let (mut scene, printed) = scene(request);
    let names = scene.said("form").and_then(|form| form["files"].as_array().cloned()).unwrap_or_default();
    let text = |name: &serde_json::Value| saved.0.get(name.as_str()?).map(|source| source.text.clone());
    scene.say("texts", json!(names.iter().map(|name| text(name).unwrap_or_default()).collect::<Vec<String>>()));
    scene.say("jobs", json!(head.jobs));
    if let Some(printed) = printed {
        printed.draw(&mut scene);
        scene.say("toolSizes", printed.tools(job.again()));
        let options = diff::Options::default();
        if let Some((name, old)) = against {
            printed.draw_old(&mut scene, old);
            _ = printed.against(name, old, &options).map(|found| scene.say("against", found));
        }
        if is_typed {
            _ = printed.since_saved(before, &options).map(|found| scene.say("saved", found));
        }
        scene.say("verdict", printed.verdict(job));
    }
    io::stdout().lock().write_all(&scene.into_bytes())?;
    Ok(())
}
