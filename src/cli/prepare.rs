//! A form made ready for jobs.

use std::path::{Path, PathBuf};

use postform::compile::Program;
use postform::diag::Diag;
use postform::lint::{Changed, ready};
use postform::render::{Cycles, Options};
use postform::source::Source;

use super::args::{CyclesArg, RenderOptions, SinkArg};
use super::config::Config;
use super::files::{self, io_message};
use super::forms::FormFile;
use super::report::Reporter;
use super::say::{message, say};
use super::{prompt, report};

/// A form, checked and compiled, with the answers to its prompts.
pub struct Prepared {
    /// The form.
    pub program: Program,
    /// Its text, and that of forms it calls.
    pub files: Vec<Source>,
    /// How jobs are rendered.
    pub options: Options,
    /// Programs may be far longer than their jobs.
    pub huge: bool,
    /// Warnings keep a program from being printed.
    pub denies: bool,
    /// The files that it was made of, the configuration among them.
    pub inputs: Vec<PathBuf>,
}

/// Reads a form, shows its findings and asks its prompts. `None`: it has errors, which were shown.
pub fn prepare(form: &Path, args: &RenderOptions, job: &Path, reporter: &Reporter) -> Result<Option<Prepared>, String> {
    let mut set = prompt::answers(&args.set)?;
    let standard_input = Path::new("-");
    if form == standard_input && job == standard_input {
        return Err("error: form and job can't both be standard input".into());
    }
    let config = Config::near(form)?;
    let mut file = FormFile::read(form, args.limits.or(config.limits).unwrap_or_default())?;
    let checked = file.analyse(&Changed::new());
    let (program, found) = match ready(&checked, &config.levels) {
        Ok(form) => (Some(form.program), form.warnings),
        Err(found) => (None, found),
    };
    let (errors, warnings): (Vec<Diag>, Vec<Diag>) = found.into_iter().partition(Diag::is_error);
    say(&reporter.text(&errors, &checked.files));
    let shown: Vec<Diag> = warnings.iter().filter(|diag| args.shows(diag)).cloned().collect();
    let name = files::name(form);
    let asked = if form == standard_input { "-" } else { name.as_str() };
    say(&report::brief(&shown, &checked.files, asked));
    let denied = if args.denies_warnings() { warnings.len() } else { 0 };
    let stops = [(errors.len(), "error"), (denied, "warning")];
    let stops: Vec<String> = stops.iter().filter(|(n, _)| *n > 0).map(|(n, what)| report::count(*n, what)).collect();
    let (Some(program), true) = (program, stops.is_empty()) else {
        message(&format!("{name}: {}, nothing was printed", stops.join(", ")));
        return Ok(None);
    };
    prompt::ask(&program, &mut set, job == standard_input)
        .map_err(|error| io_message("read", Path::new("standard input"), &error))?;
    let options = Options {
        cycles: match args.cycles {
            CyclesArg::Form => Cycles::Form,
            CyclesArg::Emulated => Cycles::Emulated,
        },
        units: args.units.map(|units| units.units()),
        set,
        program: args.program,
        sink_as_printed: args.csink_depth == SinkArg::Printed,
        trace: false,
    };
    let inputs = file.paths().map(Path::to_path_buf).chain(config.path).collect();
    Ok(Some(Prepared {
        program,
        files: checked.files,
        options,
        huge: args.huge,
        denies: args.denies_warnings(),
        inputs,
    }))
}
