//! Prepares a form for jobs.

use std::path::Path;

use postform::diag::{Diag, Severity};
use postform::{Options, Post};

use super::args::{LimitsArg, RenderOptions};
use super::config::Config;
use super::files::{self, io_message};
use super::forms::FormFile;
use super::report::Reporter;
use super::say::{message, say};
use super::{clock, prompt, report};

/// A form without errors, with the answers to its prompts.
#[derive(Clone)]
pub struct Prepared {
    /// The compiled form.
    pub post: Post,
    /// The options for printing jobs.
    pub options: Options,
    /// Whether warnings are errors, so that no program is printed.
    pub denies: bool,
    /// The settings for the job and the form.
    pub config: Config,
}

impl Prepared {
    /// The form for another job with the same settings.
    pub fn for_job(&self, job: &Path) -> Prepared {
        let mut own = self.clone();
        own.options.job_file = job_file(job);
        own
    }
}

/// Reads a form, shows its findings and prompts for its variables. `None`: the form has errors, which have been shown.
pub fn prepare(form: &Path, args: &RenderOptions, job: &Path, reporter: &Reporter) -> Result<Option<Prepared>, String> {
    let mut options = args.options();
    let standard_input = Path::new("-");
    if form == standard_input && job == standard_input {
        return Err("error: form and job can't both be standard input".into());
    }
    let config = Config::of_program(job, form)?;
    let limits = args.limits.map(LimitsArg::limits).or(config.limits).unwrap_or_default();
    let file = FormFile::read(form, limits)?.of_post(args.post.as_deref())?;
    let (post, found) = match Post::compile_with(file.source(), &file, limits, &config.levels) {
        Ok(post) => (Some(post.clone()), post.findings().clone()),
        Err(error) => (None, error.into_findings()),
    };
    // only lint shows notes
    let (files, found) = (found.files, found.diags.into_iter().filter(|diag| diag.severity > Severity::Note));
    let (errors, warnings): (Vec<Diag>, Vec<Diag>) = found.partition(Diag::is_error);
    say(&reporter.text(&errors, &files));
    let shown: Vec<Diag> = warnings.iter().filter(|diag| args.shows(diag)).cloned().collect();
    let name = files::name(form);
    let asked = if form == standard_input { "-" } else { name.as_str() };
    say(&report::brief(&shown, &files, &format!("postform lint {asked}")));
    let denied = if args.denies_warnings() { warnings.len() } else { 0 };
    let stops = [(errors.len(), "error"), (denied, "warning")];
    let stops: Vec<String> = stops.iter().filter(|(n, _)| *n > 0).map(|(n, what)| report::count(*n, what)).collect();
    let (Some(post), true) = (post, stops.is_empty()) else {
        message(&format!("{name}: {}, nothing was printed", stops.join(", ")));
        return Ok(None);
    };
    config.check_properties(form, post.properties())?;
    options.shop_properties = config.shop_properties();
    prompt::answers(&args.set, post.properties(), &mut options)?;
    if post.says_time() && options.clock.is_none() {
        options.clock = Some(clock::now()?);
    }
    options.job_file = job_file(job);
    prompt::ask(&post, &mut options, args.ask, job == standard_input)
        .map_err(|error| io_message("read", Path::new("standard input"), &error))?;
    Ok(Some(Prepared { post, options, denies: args.denies_warnings(), config }))
}

/// The value of `[jobfile]`: the name of the job's file, without its folder. Standard input has no name.
fn job_file(job: &Path) -> Option<String> {
    job.file_name().filter(|_| job != Path::new("-")).map(|name| name.to_string_lossy().into_owned())
}
