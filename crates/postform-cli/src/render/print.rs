//! Prints a job to its output, and proves it.

use std::io::{self, Write as _};
use std::path::Path;

use postform::diag::Severity;
use postform::internals::post;
use postform::internals::verify::Verdict;
use postform::{Error, ErrorKind, Job, Proven};

use super::super::Ending;
use super::super::args::RenderArgs;
use super::super::beside::{self, Printed};
use super::super::files::{self, io_message};
use super::super::machine;
use super::super::progress::Progress;
use super::super::report::{Reporter, names, place_in_jobs, stopped};
use super::super::say::{message, say};
use super::super::spool::Spool;
use super::super::verdict::Sides;
use super::super::verify::in_a_file;
use super::Ready;
use super::output::Output;
use super::split::Part;

/// A program to print.
pub struct Task<'a> {
    /// The job, or the jobs to join.
    pub jobs: &'a [&'a Path],
    /// The output of the program: a file, a folder, or `-`.
    pub output: &'a Path,
    /// The file name in the output folder. `None`: the form determines the name.
    pub name: Option<&'a str>,
    /// The name of the program in messages.
    pub called: &'a str,
    /// The part of the job to print. `None`: the selection in the options.
    pub part: Option<Part>,
    /// The program number. `None`: the number comes from the command line, else from the job.
    pub number: Option<u32>,
}

/// Prints a job.
///
/// # Errors
/// A message: a file can't be read or written, or the options make no sense together.
pub fn print(task: &Task<'_>, ready: &Ready, args: &RenderArgs, reporter: &Reporter) -> Result<Ending, String> {
    let Ready { prepared, machine, .. } = ready;
    let prepared = &prepared.for_job(task.jobs[0]);
    if machine.is_some() && args.stream {
        return Err("error: --stream writes the program before postform can check that it fits into the machine\n  \
                    help: render without --stream"
            .into());
    }
    let error = |error: Error| format!("error: {error}");
    if args.stream && prepared.post.reads_ahead(&prepared.options).map_err(error)? {
        let or = prepared.post.reads_once_with().map(|set| format!(", or with --set {set}")).unwrap_or_default();
        return Err(format!(
            "error: {} prints values from later in the job, so the whole job must be read first\n  help: render \
             without --stream{or}",
            files::name(&ready.form)
        ));
    }
    let again = prepared.post.may_read_twice(&prepared.options).map_err(error)? && !args.stream;
    let mut job = job_of(task.jobs, args, again)?;
    if let Some(part) = task.part {
        part.select(&mut job.reading);
    }
    let mut output =
        Output::open((task.output, task.name), args.trace.as_deref(), args.stream, (prepared.post.files(), task.jobs))?;
    let mut options = prepared.options.clone();
    options.program = task.number.or(options.program);
    options.trace = args.trace.is_some();
    options.one_pass = args.stream;
    let proof = (!args.no_verify && !args.stream).then(|| args.control.proof(None, prepared.config.control));
    let progress = Progress::new();
    let kept = |error: &io::Error| io_message("write", Path::new("the program"), error);
    let mut program = machine.as_ref().map(|_| Spool::new()).transpose().map_err(|error| kept(&error))?;
    let mut take = |part: post::Part<'_>| {
        progress.lines(part.lines);
        program.as_mut().map_or(Ok(()), |program| program.write_all(part.text))?;
        output.write(&part)
    };
    let (printed, proven) = match &proof {
        Some(proof) => {
            let Printed { rendered, proven } = beside::print(&prepared.post, job.again(), &options, proof, &mut take)?;
            (rendered, Some((proof, proven)))
        }
        None => (prepared.post.render_parts(job.again(), &options, &mut take), None),
    };
    drop(progress);
    let mut notes = match &printed {
        Ok(rendered) => rendered.notes.clone(),
        Err(error) => error.findings().diags.iter().filter(|diag| !diag.is_error()).cloned().collect(),
    };
    let (file_name, left_out) =
        printed.as_ref().map_or((String::new(), 0), |rendered| (rendered.file_name.clone(), rendered.left_out));
    // the operations in the other parts of a job are not left out
    if left_out > 0 && !task.part.is_some_and(Part::selects_operations) && !args.options.quiet {
        message("only a part of the job is printed: its other operations are not in the program");
    }
    notes.iter_mut().for_each(|diag| place_in_jobs(task.jobs, diag));
    let denied = args.options.denies_warnings() && notes.iter().any(|diag| diag.severity == Severity::Warning);
    notes.retain(|diag| args.options.shows(diag));
    say(&reporter.text(&notes, prepared.post.files()));
    if let Err(error) = printed {
        return match (error.kind(), error.io()) {
            (ErrorKind::Output, Some(error)) => output.failed(error),
            _ => stopped(error, task.jobs, reporter, prepared.post.files()),
        };
    }
    if denied {
        message("nothing was printed, because of --deny warnings");
        return Ok(Ending::Findings);
    }
    if let Some((proof, proven)) = proven {
        let sides = Sides { jobs: task.jobs, program: task.called, files: prepared.post.files() };
        let proven = in_a_file(proven, &mut job, prepared, proof, &sides, reporter)?;
        let told = Told { required: ready.required, quiet: args.options.quiet, form: &ready.form };
        match told.verdict(proven, &sides, reporter)? {
            Ending::Clean => {}
            ending => return Ok(ending),
        }
    } else if args.stream && !args.options.quiet {
        message("not verified: --stream writes the program before it can be verified");
    }
    if let (Some(machine), Some(program)) = (machine, program) {
        let program = program.into_file().map_err(|error| kept(&error))?;
        let (post, proof) = (&prepared.post, args.control.proof(None, prepared.config.control));
        let made = (&mut job, &prepared.options);
        let (fitted, fitting) = machine::of_post(post, machine, made, &proof, (program, task.called))?;
        let stops = fitted.has_errors() && !args.no_verify;
        if !args.options.quiet || stops {
            fitting.show(&fitted, (task.jobs, post.files()), reporter);
            say(&(fitting.sentences(&fitted) + &fitting.sentence(&fitted)));
        }
        if stops {
            message("nothing was printed: --no-verify prints the program anyway");
            return Ok(Ending::Findings);
        }
    }
    if let Some(path) = output.name(task.name.unwrap_or(&file_name))?
        && !args.options.quiet
        && task.name.is_none()
    {
        message(&format!("{} is written", files::output_name(&path)));
    }
    output.finish()
}

/// The job of a task.
fn job_of(jobs: &[&Path], args: &RenderArgs, again: bool) -> Result<Job<'static>, String> {
    if let [job] = jobs {
        return files::job(job, &args.read, again);
    }
    let open = |job: &&Path| Ok(files::job(job, &args.read, again)?.named(&files::name(job)));
    let mut joined = Job::join(jobs.iter().map(open).collect::<Result<_, String>>()?);
    joined.reading.select = args.read.select.selection();
    Ok(joined)
}

/// The output about a proof.
struct Told<'a> {
    /// Whether a program is printed only if it is proven.
    required: bool,
    /// Only errors that prevent printing are shown.
    quiet: bool,
    form: &'a Path,
}

impl Told<'_> {
    /// Shows the verdict; `Clean`: the program may be printed.
    fn verdict(&self, proven: Result<Proven, Error>, sides: &Sides<'_>, reporter: &Reporter) -> Result<Ending, String> {
        let proven = match sides.tried(proven, self.quiet, reporter)? {
            Ok(proven) => proven,
            Err(ending) => return Ok(ending),
        };
        let prints = match &proven.verdict {
            Verdict::Different(findings) => {
                sides.show(findings, Severity::Error, reporter);
                false
            }
            Verdict::NotProven(unproven) if !self.quiet || self.required => {
                let command = format!("postform verify {} --form {}", names(sides.jobs), files::name(self.form));
                sides.brief(&unproven.notes, &command);
                !self.required
            }
            _ => true,
        };
        if !self.quiet || !prints {
            say(&sides.sentence(&proven));
        }
        if prints {
            return Ok(Ending::Clean);
        }
        message("nothing was printed");
        Ok(Ending::Findings)
    }
}
