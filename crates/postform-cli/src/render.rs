//! `postform render`.

use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use postform::diag::Severity;
use postform::internals::lint::Changed;
use postform::internals::post::Part;
use postform::internals::render::TraceLine;
use postform::internals::source::Source;
use postform::internals::verify::Verdict;
use postform::{Error, ErrorKind, Proven};

use super::Ending;
use super::args::RenderArgs;
use super::beside::{self, Printed};
use super::config::Config;
use super::files::{self, io_message};
use super::forms::FormFile;
use super::identity::Identity;
use super::machine;
use super::output::Target;
use super::poll;
use super::prepare::prepare;
use super::progress::Progress;
use super::report::{Reporter, place_in, stopped};
use super::say::{message, say};
use super::spool::Spool;
use super::verdict::Sides;
use super::verify::in_a_file;

/// Renders a job to its output, with --watch anew when a file of it is changed.
pub fn run(args: &RenderArgs, colour: bool) -> Result<Ending, String> {
    if args.watch { poll::repeat(|| inputs(args), || print(args, colour)) } else { print(args, colour) }
}

/// The job, the form and those that it calls, and what they follow.
fn inputs(args: &RenderArgs) -> Vec<PathBuf> {
    let config = Config::near(&args.job).unwrap_or_default();
    let form = args.form.clone().or(config.form);
    let mut paths: Vec<PathBuf> = config.path.into_iter().chain([args.job.clone()]).chain(form.clone()).collect();
    if let Some(file) = form.and_then(|form| FormFile::read(&form, postform::Limits::default()).ok()) {
        file.analyse(&Changed::new());
        paths.extend(file.paths());
    }
    paths
}

fn print(args: &RenderArgs, colour: bool) -> Result<Ending, String> {
    let reporter = Reporter::new(colour);
    files::check_format(&args.job, &args.read)?;
    let config = Config::near(&args.job)?;
    let form = args.form.clone().or(config.form.clone());
    let Some(form) = form else {
        let help = "give --form, or name one in a postform.toml in the folder of the job or above: form = \"fanuc.pf\"";
        return Err(format!("error: which form?\n  help: {help}"));
    };
    let Some(mut prepared) = prepare(&form, &args.options, &args.job, &reporter)? else {
        return Ok(Ending::Findings);
    };
    distinct(args)?;
    let machine = machine::of_prepared(&args.machine, &form, &mut prepared, &config)?;
    if machine.is_some() && args.stream {
        return Err("error: with --stream the program is out before it is known whether it fits into the machine\n  help: render without --stream".into());
    }
    let error = |error: Error| format!("error: {error}");
    if args.stream && prepared.post.reads_ahead(&prepared.options).map_err(error)? {
        let or = prepared.post.reads_once_with().map(|set| format!(", or with --set {set}")).unwrap_or_default();
        return Err(format!(
            "error: {} says what lies ahead in the job, which must be read to its end first\n  help: render without --stream{or}",
            files::name(&form)
        ));
    }
    let again = prepared.post.may_read_twice(&prepared.options).map_err(error)? && !args.stream;
    let mut job = files::job(&args.job, &args.read, again)?;
    let mut output = Output {
        target: if is_folder(&args.output) {
            Target::open_in(&args.output)?
        } else {
            Target::open(&args.output, args.stream)?
        },
        trace: args.trace.as_deref().map(|path| Target::open(path, false)).transpose()?,
        files: prepared.post.files(),
        trace_failed: false,
    };
    let mut options = prepared.options.clone();
    options.trace = args.trace.is_some();
    options.one_pass = args.stream;
    let proof = (!args.no_verify && !args.stream).then(|| args.control.proof(None));
    let progress = Progress::new();
    let kept = |error: &io::Error| io_message("write", Path::new("the program"), error);
    let mut program = machine.as_ref().map(|_| Spool::new()).transpose().map_err(|error| kept(&error))?;
    let mut take = |part: Part<'_>| {
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
    if !args.read.reading().select.is_all() && !args.options.quiet {
        message("a part of the job is taken: its other operations are not in the program");
    }
    let mut notes = match &printed {
        Ok(rendered) => rendered.notes.clone(),
        Err(error) => error.findings().diags.iter().filter(|diag| !diag.is_error()).cloned().collect(),
    };
    let file_name = printed.as_ref().map(|rendered| rendered.file_name.clone()).unwrap_or_default();
    let name = files::name(&args.job);
    notes.iter_mut().for_each(|diag| place_in(&name, diag));
    let denied = args.options.denies_warnings() && notes.iter().any(|diag| diag.severity == Severity::Warning);
    notes.retain(|diag| args.options.shows(diag));
    say(&reporter.text(&notes, prepared.post.files()));
    if let Err(error) = printed {
        return match (error.kind(), error.io()) {
            (ErrorKind::Output, Some(error)) => output.failed(args, error),
            _ => stopped(error, &args.job, &reporter, prepared.post.files()),
        };
    }
    if denied {
        message("nothing was printed: --deny warnings");
        return Ok(Ending::Findings);
    }
    if let Some((proof, proven)) = proven {
        let sides = Sides { job: &args.job, program: "the program", files: prepared.post.files() };
        let proven = in_a_file(proven, &mut job, &prepared, proof, &sides, &reporter)?;
        let required = args.require_proof || config.require_proof;
        let told = Told { required, quiet: args.options.quiet, form: &form };
        match told.verdict(proven, &sides, &reporter)? {
            Ending::Clean => {}
            ending => return Ok(ending),
        }
    } else if args.stream && !args.options.quiet {
        message("not verified: with --stream the program is out before it is known what it does");
    }
    if let (Some(machine), Some(program)) = (&machine, program) {
        let program = program.into_file().map_err(|error| kept(&error))?;
        let (post, proof) = (&prepared.post, args.control.proof(None));
        let made = (&mut job, &prepared.options);
        let (fitted, fitting) = machine::of_post(post, machine, made, &proof, (program, "the program"))?;
        let stops = fitted.has_errors() && !args.no_verify;
        if !args.options.quiet || stops {
            fitting.show(&fitted, (Some(&args.job), post.files()), &reporter);
            say(&(fitting.sentences(&fitted) + &fitting.sentence(&fitted)));
        }
        if stops {
            message("nothing was printed: --no-verify prints it all the same");
            return Ok(Ending::Findings);
        }
    }
    if is_folder(&args.output) {
        let path = args.output.join(file_name);
        output.target = output.target.named(&path)?;
        if !args.options.quiet {
            message(&format!("{} is written", files::output_name(&path)));
        }
    }
    output.finish(args)
}

/// A folder, in which the program gets the name that form and job give it.
fn is_folder(output: &Path) -> bool {
    output.is_dir() || output.to_string_lossy().ends_with(['/', std::path::MAIN_SEPARATOR])
}

/// What is said of a proof.
struct Told<'a> {
    /// What is not proven is not printed.
    required: bool,
    /// Only what keeps the program from being printed is said.
    quiet: bool,
    form: &'a Path,
}

impl Told<'_> {
    /// Says the verdict; `Clean`: the program may be printed.
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
                let command = format!("postform verify {} --form {}", files::name(sides.job), files::name(self.form));
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

/// One output must not replace the other.
fn distinct(args: &RenderArgs) -> Result<(), String> {
    let outputs = [Some(&args.output), args.trace.as_ref()].map(|path| Some((path?, Identity::of_output(path?)?)));
    if let [Some((program, a)), Some((trace, b))] = &outputs
        && a == b
        // both as text to standard output is what was asked for
        && [program, trace].iter().any(|path| path.as_os_str() != "-")
    {
        return Err("error: program and source map can't be one file".into());
    }
    Ok(())
}

/// Who closes standard output has seen enough; what was named must be whole.
fn output_failed(path: &Path, error: &io::Error) -> Result<Ending, String> {
    match error.kind() {
        io::ErrorKind::BrokenPipe if path == Path::new("-") => Ok(Ending::Clean),
        io::ErrorKind::BrokenPipe => {
            message(&format!("error: {} was closed by its reader before all was written", files::output_name(path)));
            Ok(Ending::Findings)
        }
        _ => Err(io_message("write", path, error)),
    }
}

/// Where the program goes, and its source map.
struct Output<'p> {
    target: Target,
    trace: Option<Target>,
    files: &'p [Source],
    /// The source map could not be written, not the program.
    trace_failed: bool,
}

impl Output<'_> {
    fn write(&mut self, part: &Part<'_>) -> io::Result<()> {
        self.target.write(part.text)?;
        let Some(target) = &mut self.trace else { return Ok(()) };
        let mut text = Vec::new();
        for line in part.trace {
            trace_line(line, self.files, &mut text);
        }
        target.write(&text).inspect_err(|_| self.trace_failed = true)
    }

    fn failed(&self, args: &RenderArgs, error: &io::Error) -> Result<Ending, String> {
        let path = args.trace.as_deref().filter(|_| self.trace_failed);
        output_failed(path.unwrap_or(&args.output), error)
    }

    /// The program is complete.
    fn finish(self, args: &RenderArgs) -> Result<Ending, String> {
        // the map first: a program without its map is whole, a map without its program is not
        if let (Some(trace), Some(path)) = (self.trace, &args.trace)
            && let Err(error) = trace.complete()
        {
            return output_failed(path, &error);
        }
        match self.target.complete() {
            Ok(()) => Ok(Ending::Clean),
            Err(error) => output_failed(&args.output, &error),
        }
    }
}

/// One line of the source map.
fn trace_line(line: &TraceLine, files: &[Source], out: &mut Vec<u8>) {
    let form = line.form.and_then(|span| {
        let source = files.get(span.file as usize)?;
        Some(serde_json::json!({ "file": source.name, "line": source.line(span.start) + 1 }))
    });
    let place = &line.place;
    let job = serde_json::json!({ "line": place.line, "column": place.column, "path": place.path() });
    let row = serde_json::json!({ "line": line.line, "form": form, "job": job });
    out.extend_from_slice(row.to_string().as_bytes());
    out.push(b'\n');
}
