//! `postform render`.

mod many;
mod name;
mod output;
mod print;
mod split;

use std::path::{Path, PathBuf};

use postform::internals::lint::Changed;
use postform::internals::machine::Machine;

use super::Ending;
use super::args::RenderArgs;
use super::config::Config;
use super::files;
use super::forms::FormFile;
use super::identity::Identity;
use super::machine;
use super::poll;
use super::prepare::{Prepared, prepare};
use super::report::Reporter;
use print::Task;

/// Renders a job to its output, or several jobs into a folder; with --watch, again whenever one of its files changes.
pub fn run(args: &RenderArgs, colour: bool) -> Result<Ending, String> {
    if args.out_dir.is_some() {
        return many::run(args, colour);
    }
    let of_folder = [
        (args.split.is_some(), "--split"),
        (args.changed, "--changed"),
        (args.name.is_some(), "--name"),
        (args.at_a_time.is_some(), "--jobs"),
    ];
    if let Some((_, option)) = of_folder.iter().find(|(is_given, _)| *is_given) {
        return Err(format!(
            "error: {option} needs a folder for the programs\n  help: give --out-dir FOLDER in place of -o"
        ));
    }
    let jobs = if args.join { joined(args)? } else { args.jobs.clone() };
    let jobs: Vec<&Path> = jobs.iter().map(PathBuf::as_path).collect();
    if jobs.len() > 1 && !args.join {
        if let Some(form) = jobs.iter().find(|job| files::is_form(job)) {
            let name = files::name(form);
            return Err(format!(
                "error: {name} is a form, not a job\n  help: print a job with it: `postform render JOB --form {name}`"
            ));
        }
        let help = "give --out-dir FOLDER, or --join to make one program of them";
        return Err(format!("error: several jobs need a folder for their programs\n  help: {help}"));
    }
    if args.watch {
        poll::repeat(|| inputs(&jobs, args), || one(&jobs, args, colour))
    } else {
        one(&jobs, args, colour)
    }
}

/// The jobs to join; folders are replaced by the jobs in them. One of the jobs may be standard input.
fn joined(args: &RenderArgs) -> Result<Vec<PathBuf>, String> {
    let is_input = |job: &PathBuf| job.as_path() == Path::new("-");
    if args.jobs.iter().filter(|job| is_input(job)).count() > 1 {
        return Err("error: standard input (-) is given more than once".into());
    }
    let expanded = args.jobs.iter().map(|job| match is_input(job) {
        true => Ok(vec![job.clone()]),
        false => super::many::jobs(std::slice::from_ref(job)),
    });
    Ok(expanded.collect::<Result<Vec<_>, String>>()?.concat())
}

/// The files to watch: the jobs, the form, called forms, postform.toml, and all files that were read before, such as the
/// machine and the control.
fn inputs(jobs: &[&Path], args: &RenderArgs) -> Vec<PathBuf> {
    let config = jobs.first().and_then(|job| Config::near(job).ok()).unwrap_or_default();
    let form = args.form.clone().or(config.form);
    let jobs = jobs.iter().map(|job| job.to_path_buf());
    let mut paths: Vec<PathBuf> = config.path.into_iter().chain(jobs).chain(form.clone()).collect();
    if let Some(file) = form.and_then(|form| FormFile::read(&form, postform::Limits::default()).ok()) {
        file.analyse(&Changed::new());
        paths.extend(file.paths());
    }
    paths.extend(crate::inputs::all());
    paths
}

/// Renders one job, or joined jobs. The form and the machine of the first job are used.
fn one(jobs: &[&Path], args: &RenderArgs, colour: bool) -> Result<Ending, String> {
    let reporter = Reporter::new(colour);
    let Some(job) = jobs.first() else { return Err("error: there is no job".into()) };
    jobs.iter().try_for_each(|job| files::check_format(job, &args.read))?;
    let config = Config::near(job)?;
    let form = form_of(job, args, &config)?;
    let Some(ready) = Ready::of(&form, job, args, &reporter)? else { return Ok(Ending::Findings) };
    distinct(args)?;
    let task = Task { jobs, output: &args.output, name: None, called: "the program", part: None, number: None };
    print::print(&task, &ready, args, &reporter)
}

/// The form that prints a job.
///
/// # Errors
/// A message: neither the command line nor postform.toml contains a form.
fn form_of(job: &Path, args: &RenderArgs, config: &Config) -> Result<PathBuf, String> {
    args.form.clone().or(config.form.clone()).ok_or_else(|| {
        format!(
            "error: no form is given to print {}\n  help: give --form, or name a form in a postform.toml in the \
             folder of the job or above: form = \"fanuc.pf\"",
            files::name(job)
        )
    })
}

/// A form that can print, and its machine.
struct Ready {
    form: PathBuf,
    prepared: Prepared,
    machine: Option<Machine>,
    /// Whether a program is printed only if it is proven.
    required: bool,
}

impl Ready {
    /// `None`: the form has errors, which have been shown.
    fn of(form: &Path, job: &Path, args: &RenderArgs, reporter: &Reporter) -> Result<Option<Ready>, String> {
        let Some(mut prepared) = prepare(form, &args.options, job, reporter)? else { return Ok(None) };
        let machine = machine::of_prepared(&args.machine, form, &mut prepared)?;
        let required = args.require_proof || prepared.config.require_proof;
        Ok(Some(Ready { form: form.to_path_buf(), prepared, machine, required }))
    }
}

/// Checks that the program and the source map are different files.
fn distinct(args: &RenderArgs) -> Result<(), String> {
    let outputs = [Some(&args.output), args.trace.as_ref()].map(|path| Some((path?, Identity::of_output(path?)?)));
    if let [Some((program, a)), Some((trace, b))] = &outputs
        && a == b
        // the user explicitly requested both on standard output
        && [program, trace].iter().any(|path| path.as_os_str() != "-")
    {
        return Err("error: the program and the source map can't be the same file".into());
    }
    Ok(())
}
