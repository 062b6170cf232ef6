//! The sample job on which the effect of an unsafe fix is shown.

use std::path::Path;

use postform::compile::compile;
use postform::lang::Machine;
use postform::render::{Options, Renderer};
use postform::sema::Checked;
use postform::toolpath::ReadError;

use super::super::args::ReadArgs;
use super::super::files;

/// A whole part for each type of machine: what most sequences print is in it.
fn built_in(machine: Machine) -> &'static str {
    match machine {
        Machine::Mill => include_str!("../../../samples/bracket/job.json"),
        Machine::Lathe => include_str!("../../../samples/lathe-part/job.json"),
        Machine::Edm => include_str!("../../../samples/wire/job.json"),
    }
}

/// What a form prints for a job, the built-in one where none is given; the inner `Err`: why it prints nothing. Blocks have no
/// numbers, so that one block more is not another number in all that follow.
///
/// # Errors
/// A message: the job can't be read.
pub fn printed(checked: &Checked, job: Option<&Path>) -> Result<Result<String, String>, String> {
    if let Some(error) = checked.diags.iter().find(|diag| diag.is_error()) {
        return Ok(Err(format!("{}: {}", error.code.name(), error.message)));
    }
    let mut form = checked.form.clone();
    form.settings.numbers.letter = None;
    let program = compile(&form);
    // questions are answered, so that something is printed
    let set = program.settings.prompts.iter().map(|prompt| (prompt.var, prompt.default.unwrap_or(1.0))).collect();
    let options = Options { program: Some(1), set, ..Options::default() };
    let mut renderer = Renderer::new(&program, options);
    let read = match job {
        None => postform::toolpath::json::read_document(built_in(program.settings.machine).as_bytes(), &mut renderer),
        Some(path) => {
            let args = ReadArgs::default();
            let from = files::job_format(path, &args)?;
            files::read_job(files::open(path)?, from, &args, &mut renderer).0
        }
    };
    match read {
        Ok(()) | Err(ReadError::Stopped) => Ok(Ok(String::from_utf8_lossy(renderer.text()).into_owned())),
        Err(ReadError::Job(diag)) => Ok(Err(format!("{}: {}", diag.code.name(), diag.message))),
        Err(ReadError::Io(error)) => Err(error.to_string()),
    }
}
