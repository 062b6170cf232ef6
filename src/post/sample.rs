//! Prints a sample job with a form. The result shows how a fix of the form changes a program.

use std::sync::OnceLock;

use super::Post;
use super::options::Options;
use crate::compile::compile;
use crate::error::{Error, ErrorKind};
use crate::job::Job;
use crate::lang::{Machine, UnitChoice};
use crate::sema::{Checked, Settings};

/// A job with a complete part for the type of machine, in units that the form accepts. The job uses most sequences.
pub fn sample_job(settings: &Settings) -> &'static str {
    let (text, inch) = match settings.machine {
        Machine::Mill => (include_str!("../../samples/bracket/job.json"), true),
        Machine::Lathe => (include_str!("../../samples/lathe-part/job.json"), true),
        Machine::Edm => (include_str!("../../samples/wire/job.json"), false),
    };
    let wanted = match settings.units {
        UnitChoice::Both => inch,
        other => other == UnitChoice::Inch,
    };
    if wanted == inch {
        return text;
    }
    // only the name of the unit changes and the numbers stay, so the part becomes smaller or larger
    static OTHERS: [OnceLock<String>; 3] = [const { OnceLock::new() }; 3];
    let units = [r#""units": "mm""#, r#""units": "inch""#];
    OTHERS[settings.machine as usize]
        .get_or_init(|| text.replacen(units[usize::from(inch)], units[usize::from(!inch)], 1))
}

/// The program that a form prints for a job, or for the built-in job if none is given. The inner `Err` is the reason why
/// nothing can be printed. Blocks have no numbers, so an additional block does not change all later blocks.
///
/// # Errors
/// The job can't be read.
pub fn sample_program(checked: &Checked, job: Option<Job<'_>>) -> Result<Result<String, String>, Error> {
    if let Some(error) = checked.diags.iter().find(|diag| diag.is_error()) {
        return Ok(Err(format!("{}: {}", error.code.name(), error.message)));
    }
    let mut form = checked.form.clone();
    form.settings.numbers.letter = None;
    let sample = sample_job(&form.settings);
    let post = Post::of(compile(&form), Vec::new(), &checked.files);
    // prompts are answered, so that a program can be printed
    let mut options = Options { program: Some(1), proof: None, ..Options::default() };
    options.set = post.prompts().map(|ask| (ask.variable.to_owned(), ask.default.unwrap_or(1.0))).collect();
    match post.render(job.unwrap_or_else(|| Job::json(sample)), &options) {
        Ok(program) => Ok(Ok(program.into_text())),
        Err(error) if matches!(error.kind(), ErrorKind::Job | ErrorKind::Fault) => {
            let diag = error.findings().diags.iter().find(|diag| diag.is_error());
            Ok(Err(diag.map_or_else(|| error.to_string(), |diag| format!("{}: {}", diag.code.name(), diag.message))))
        }
        Err(error) => Err(error),
    }
}
