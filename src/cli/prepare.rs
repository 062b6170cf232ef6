//! A form made ready for jobs.

use std::path::{Path, PathBuf};

use postform::compile::{Program, compile};
use postform::diag::Severity;
use postform::lint::{Changed, sort};
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
    let mut checked = file.analyse(&Changed::new());
    sort(&mut checked.diags);
    let shown: Vec<_> = checked.diags.iter().filter(|diag| diag.severity > Severity::Note).cloned().collect();
    say(&reporter.text(&shown, &checked.files));
    if checked.has_errors() {
        let count = checked.diags.iter().filter(|d| d.is_error()).count();
        message(&format!("{}: {}, nothing was printed", files::name(form), report::count(count, "error")));
        return Ok(None);
    }
    let program = compile(&checked.form);
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
    Ok(Some(Prepared { program, files: checked.files, options, inputs }))
}
