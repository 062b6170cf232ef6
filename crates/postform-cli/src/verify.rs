//! `postform verify`.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::io::{self, Seek as _, Write};
use std::path::{Path, PathBuf};

use postform::diag::Severity;
use postform::internals::nc::control_of_name;
use postform::internals::post::Part;
use postform::internals::preflight::Known;
use postform::internals::verify::Verdict;
use postform::toolpath::Units;
use postform::{Error, Job, Proof, Proven};

use super::args::{ControlArgs, UnitsArg, VerifyArgs, VerifyFormat};
use super::beside::{self, Printed};
use super::config::Config;
use super::files::{self, io_message};
use super::machine::{self, Fitting};
use super::prepare::{Prepared, prepare};
use super::rendered::{denied, rendered};
use super::report::{Reporter, stopped};
use super::spool::Spool;
use super::stock::{self, Milling};
use super::verdict::Sides;
use super::{Ending, many, output};

/// Compares a program with its job; for several jobs, compares each with the program that a form prints.
pub fn run(args: &VerifyArgs, colour: bool) -> Result<Ending, String> {
    let reporter = &Reporter::new(colour);
    if let Some(job) = many::single(&args.jobs) {
        if job == Path::new("-") && args.nc.as_deref() == Some(Path::new("-")) {
            return Err("error: job and program can't both be standard input".into());
        }
        files::check_format(job, &args.read).map_err(|why| turned_around(why, job, args))?;
        let config = Config::near(job)?;
        let form = form_of(args, &config);
        let prepared = match &form {
            Some(form) => match prepare(form, &args.options, job, reporter)? {
                Some(prepared) => Some(prepared),
                None => return Ok(Ending::Findings),
            },
            None => None,
        };
        let (text, ending) = tried(job, args, form.as_deref().zip(prepared.as_ref()), &config, reporter)?;
        output::standard_output(|out| out.write_all(text.as_bytes()))?;
        return Ok(ending);
    }
    if args.nc.is_some() {
        return Err("error: --nc takes one job".into());
    }
    // forms by their path and the postform.toml of the job
    let mut forms: HashMap<(PathBuf, Option<PathBuf>), Prepared> = HashMap::new();
    let mut items = Vec::new();
    let jobs = many::jobs(&args.jobs)?;
    files::check_formats(&jobs, &args.read)?;
    for job in jobs {
        let config = Config::near(&job)?;
        let form = form_of(args, &config).ok_or_else(no_form)?;
        if let Entry::Vacant(entry) = forms.entry((form.clone(), config.path.clone())) {
            let prepared = prepare(&form, &args.options, &job, reporter)?;
            let Some(prepared) = prepared else { return Ok(Ending::Findings) };
            entry.insert(prepared);
        }
        items.push((job, form, config));
    }
    many::run(
        args.at_a_time,
        items,
        |(job, ..)| files::name(job),
        "job",
        |(job, form, config)| {
            let prepared = forms.get(&(form.clone(), config.path.clone())).map(|prepared| prepared.for_job(job));
            tried(job, args, Some(form.as_path()).zip(prepared.as_ref()), config, reporter)
        },
    )
}

/// Adds the correct call to the error for a program with `--job JOB`.
fn turned_around(why: String, program: &Path, args: &VerifyArgs) -> String {
    match args.read.job_name.as_deref().filter(|job| args.nc.is_none() && Path::new(job).is_file()) {
        Some(job) => {
            let [job, program] = [Path::new(job), program].map(files::name);
            format!("{why}\n  help: `postform verify {job} --nc {program}` compares a program with its job")
        }
        None => why,
    }
}

/// The form for a job's program. An existing program is proven with a form only if the command line names a form.
fn form_of(args: &VerifyArgs, config: &Config) -> Option<PathBuf> {
    args.form.clone().or_else(|| config.form.clone().filter(|_| args.nc.is_none()))
}

fn no_form() -> String {
    "error: give --form or --nc or both, or name a form in postform.toml".into()
}

/// The verdict on a job's program, as text for standard output.
fn tried(
    job_path: &Path,
    args: &VerifyArgs,
    form: Option<(&Path, &Prepared)>,
    config: &Config,
    reporter: &Reporter,
) -> Result<(String, Ending), String> {
    let prepared = form.map(|(_, prepared)| prepared);
    let named = form.map(|(form, prepared)| (form, &prepared.post));
    let config = prepared.map_or(config, |prepared| &prepared.config);
    let machine = machine::named(&args.machine, named, config)?;
    let of_machine = machine.as_ref().and_then(|machine| machine.control);
    let by_name = || control_of_name(args.nc.as_deref()?);
    let by_config = of_machine.or(config.control).or_else(by_name).filter(|_| prepared.is_none());
    let control = ControlArgs { control: args.control.control.or(by_config), ..args.control.clone() };
    let mut proof = control.proof(args.tolerance, config.control);
    proof.units = args.options.units.map(UnitsArg::units);
    // the job of a printed program may be read twice: for the survey, or to print the program again into a file
    let twice = args.nc.is_none() || args.stock.is_some();
    let mut job = files::job(job_path, &args.read, twice)?;
    let name = args.nc.as_deref().map_or("the program".to_owned(), files::name);
    let files = prepared.map_or(&[][..], |prepared| prepared.post.files());
    let sides = Sides { jobs: &[job_path], program: &name, files };
    let (tried, program) = match (&args.nc, prepared) {
        (Some(path), prepared) => {
            let file = files::seekable(path)?;
            let program = file.try_clone().map_err(|error| io_message("read", path, &error))?;
            let proven = match prepared {
                Some(prepared) => prepared.post.verify_with(job.again(), file, &prepared.options, &proof),
                None => proof.verify(job.again(), file),
            };
            (sides.tried(proven, args.options.quiet, reporter)?, Some(program))
        }
        (None, Some(prepared)) => {
            let runs_again = machine.is_some() || args.stock.is_some();
            let mut spool = runs_again.then(Spool::new).transpose().map_err(|error| spooled(&error))?;
            let mut take = |part: Part<'_>| spool.as_mut().map_or(Ok(()), |spool| spool.write_all(part.text));
            let tried = of_form(&mut job, prepared, &proof, &sides, (args.options.quiet, &mut take), reporter)?;
            (tried, spool.map(Spool::into_file).transpose().map_err(|error| spooled(&error))?)
        }
        (None, None) => return Err(no_form()),
    };
    let proven = match tried {
        Ok(proven) => proven,
        Err(ending) => return Ok((String::new(), ending)),
    };
    let mut in_stock = None;
    if let (Some(block), Some(program)) = (args.stock, &program) {
        let form = prepared.map(|prepared| (&prepared.post, &prepared.options));
        let milling = Milling { block, program: &name, form, control: &control, proof: &proof };
        let mut program = program.try_clone().map_err(|error| spooled(&error))?;
        program.rewind().map_err(|error| spooled(&error))?;
        let checked = milling.checked(&mut job, program)?;
        if args.format == VerifyFormat::Text {
            milling.show(&checked, (job_path, files), reporter);
        }
        in_stock = Some((checked, milling));
    }
    let mut on_machine = None;
    if let (Some(machine), Some(program)) = (&machine, program) {
        let (fitted, fitting) = match prepared {
            Some(Prepared { post, options, .. }) => {
                machine::of_post(post, machine, (&mut job, options), &proof, (program, &name))?
            }
            None => {
                let settings = control.settings(None, args.options.units.map_or(Units::Mm, UnitsArg::units));
                let fitting = Fitting { machine, settings, known: Known::default(), program: &name };
                (fitting.fitted(program)?, fitting)
            }
        };
        if args.format == VerifyFormat::Text {
            fitting.show(&fitted, (&[job_path], files), reporter);
        }
        on_machine = Some((fitted, fitting));
    }
    let fits = on_machine.as_ref().is_none_or(|(fitted, _)| fitted.fits())
        && in_stock.as_ref().is_none_or(|(checked, _)| checked.is_clean());
    let text = match args.format {
        VerifyFormat::Text => {
            match &proven.verdict {
                Verdict::Different(findings) => sides.show(findings, Severity::Error, reporter),
                Verdict::NotProven(unproven) => sides.show(&unproven.notes, Severity::Note, reporter),
                _ => {}
            }
            let of_machine =
                on_machine.map(|(fitted, fitting)| fitting.sentences(&fitted) + &fitting.sentence(&fitted));
            let of_stock = in_stock.map(|(checked, milling)| milling.sentence(&checked));
            sides.sentence(&proven) + &of_stock.unwrap_or_default() + &of_machine.unwrap_or_default()
        }
        VerifyFormat::Json => {
            let mut document = sides.document(&proven);
            if let Some((checked, _)) = in_stock {
                document["stock"] = stock::document(&checked, files);
            }
            if let Some((fitted, fitting)) = on_machine {
                document["machine"] = fitting.document(&fitted);
            }
            if many::single(&args.jobs).is_some() { output::json(&document) } else { output::json_line(&document) }
        }
    };
    let ending = if proven.verdict.is_proven() && fits { Ending::Clean } else { Ending::Findings };
    // if there are several jobs, --quiet shows only the jobs that fail
    let hidden = args.options.quiet
        && ending == Ending::Clean
        && args.format == VerifyFormat::Text
        && many::single(&args.jobs).is_none();
    Ok((if hidden { String::new() } else { text }, ending))
}

/// The message for an error that occurs while the program is stored.
fn spooled(error: &io::Error) -> String {
    io_message("write", Path::new("the program"), error)
}

/// Receives the parts of a program as they are printed.
type Take<'a> = &'a mut dyn FnMut(Part<'_>) -> io::Result<()>;

/// The program that a form prints for the job.
fn of_form(
    job: &mut Job<'_>,
    prepared: &Prepared,
    proof: &Proof,
    sides: &Sides<'_>,
    (quiet, take): (bool, Take<'_>),
    reporter: &Reporter,
) -> Result<Result<Proven, Ending>, String> {
    let (post, options) = (&prepared.post, &prepared.options);
    let Printed { rendered, proven } = beside::print(post, job.again(), options, proof, take)?;
    match rendered {
        Ok(rendered) if denied(&rendered.notes, sides.jobs, prepared, reporter) => Ok(Err(Ending::Findings)),
        Ok(_) => {
            let proven = in_a_file(proven, job, prepared, proof, sides, reporter)?;
            sides.tried(proven, quiet, reporter)
        }
        Err(error) => stopped(error, sides.jobs, reporter, post.files()).map(Err),
    }
}

/// Prints the program again into a file if the proof requires random access to the program. The job must be readable
/// again.
pub fn in_a_file(
    proven: Result<Proven, Error>,
    job: &mut Job<'_>,
    prepared: &Prepared,
    proof: &Proof,
    sides: &Sides<'_>,
    reporter: &Reporter,
) -> Result<Result<Proven, Error>, String> {
    let needs_a_file = |proven: &Proven| matches!(&proven.verdict, Verdict::NotProven(why) if why.in_a_file);
    if job.is_stream() || !proven.as_ref().is_ok_and(needs_a_file) {
        return Ok(proven);
    }
    let Ok((file, _)) = rendered(job, sides.jobs, prepared, false, reporter)? else { return Ok(proven) };
    let (post, options) = (&prepared.post, &prepared.options);
    let proven = post.verify_with(job.again(), file, options, proof);
    Ok(proven.and_then(|proven| post.located(proven, job.again(), options)))
}
