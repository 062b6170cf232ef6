//! `postform render`.

use std::io;
use std::path::Path;

use postform::diag::{Diag, Severity};
use postform::render::{Options, Renderer, TraceLine};
use postform::source::Source;
use postform::toolpath::{Event, Flow, Place, ReadError, Sink, Stop, flow};

use super::Ending;
use super::args::RenderArgs;
use super::config::Config;
use super::files::{self, Again, io_message};
use super::huge::Growth;
use super::identity::Identity;
use super::output::Target;
use super::prepare::prepare;
use super::progress::Progress;
use super::report::Reporter;
use super::say::{message, say};
use super::verify::{Job, Proof};

/// How much text waits before it is written.
const CHUNK: usize = 64 * 1024;

/// Renders a job to its output.
pub fn run(args: &RenderArgs, colour: bool) -> Result<Ending, String> {
    let reporter = Reporter::new(colour);
    let from = files::job_format(&args.job, &args.read)?;
    let config = Config::near(&args.job)?;
    let form = args.form.clone().or(config.form);
    let Some(form) = form else {
        let help = "give --form, or name one in a postform.toml in the folder of the job or above: form = \"fanuc.pf\"";
        return Err(format!("error: which form?\n  help: {help}"));
    };
    let Some(prepared) = prepare(&form, &args.options, &args.job, &reporter)? else {
        return Ok(Ending::Findings);
    };
    let options = Options { trace: args.trace.is_some(), ..prepared.options.clone() };
    let inputs = prepared.inputs.iter().chain(&config.path).chain([&args.job]);
    keep_inputs(args, &inputs.filter_map(|path| Identity::of_input(path)).collect::<Vec<_>>())?;
    let job = match args.verify {
        true => Some(Job { again: Again::open(&args.job)?, from, read: &args.read, path: &args.job }),
        false => None,
    };
    let input = match &job {
        Some(job) => job.again.read()?,
        None => files::open(&args.job)?,
    };
    let growth = Growth::new(args.options.huge);
    let input = growth.of(input);
    let mut writer = Writer {
        renderer: Renderer::new(&prepared.program, options),
        target: Target::open(&args.output, args.stream)?,
        trace: args.trace.as_deref().map(|path| Target::open(path, false)).transpose()?,
        files: &prepared.files,
        growth,
        failure: None,
        progress: Some(Progress::new()),
    };
    let (read, report) = files::read_job(input, from, &args.read, &mut writer);
    writer.progress = None;
    let mut notes = report.warnings;
    notes.extend_from_slice(writer.renderer.notes());
    let name = files::name(&args.job);
    notes.iter_mut().for_each(|diag| place_in(&name, diag));
    let denied = args.options.denies_warnings() && notes.iter().any(|diag| diag.severity == Severity::Warning);
    notes.retain(|diag| args.options.shows(diag));
    say(&reporter.text(&notes, &prepared.files));
    if let Some((is_trace, error)) = writer.failure.take() {
        let path = if is_trace { args.trace.as_deref() } else { None };
        return output_failed(path.unwrap_or(&args.output), &error);
    }
    match read {
        Ok(()) | Err(ReadError::Stopped) => {}
        Err(ReadError::Io(error)) => return Err(io_message("read", &args.job, &error)),
        Err(ReadError::Job(mut diag)) => {
            let ending = Ending::of(&diag);
            place_in(&name, &mut diag);
            say(&reporter.text(&[*diag], &prepared.files));
            return Ok(ending);
        }
    }
    if denied {
        message("nothing was printed: --deny warnings");
        return Ok(Ending::Findings);
    }
    let Some(job) = job else { return writer.finish(args) };
    if writer.drain().is_err() {
        return writer.finish(args);
    }
    let program = writer.target.written().map_err(|error| io_message("write", &args.output, &error))?;
    let Some(program) = program else { return Err("error: a program that is streamed can't be verified".into()) };
    let proof = Proof {
        job: &job,
        prepared: Some(&prepared),
        traced: true,
        control: &args.control,
        tolerance: None,
        name: "the program".into(),
        quiet: args.options.quiet,
    };
    let proven = proof.run(program, &reporter)?;
    if !args.options.quiet || proven.ending != Ending::Clean {
        say(&proven.text.unwrap_or_default());
    }
    match proven.ending {
        Ending::Clean => writer.finish(args),
        ending => {
            message("nothing was printed");
            Ok(ending)
        }
    }
}

/// An output must not replace what it is made of, nor the other output.
fn keep_inputs(args: &RenderArgs, inputs: &[Identity]) -> Result<(), String> {
    let outputs = [Some(&args.output), args.trace.as_ref()].map(|path| Some((path?, Identity::of_output(path?)?)));
    for (path, identity) in outputs.iter().flatten() {
        if inputs.contains(identity) {
            return Err(format!("error: {} is an input: choose another output", files::output_name(path)));
        }
    }
    if let [Some((program, a)), Some((trace, b))] = &outputs
        && a == b
        // both as text to standard output is what was asked for
        && [program, trace].iter().any(|path| path.as_os_str() != "-")
    {
        return Err("error: program and source map can't be one file".into());
    }
    Ok(())
}

/// The job's name before a place in it.
pub fn place_in(job: &str, diag: &mut Diag) {
    diag.place.get_or_insert_default().file = Some(job.to_owned());
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

/// Between reader and output: renders, and writes as text comes.
struct Writer<'p> {
    renderer: Renderer<'p>,
    target: Target,
    trace: Option<Target>,
    files: &'p [Source],
    growth: Growth,
    failure: Option<(bool, io::Error)>,
    progress: Option<Progress>,
}

impl Sink for Writer<'_> {
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        self.renderer.event(event, place)?;
        let length = self.renderer.text().len();
        if length < CHUNK {
            return Flow::Continue(());
        }
        flow(self.growth.print(length, place))?;
        flow(self.drain().map_err(|()| Stop::Enough))
    }
}

impl Writer<'_> {
    /// Writes what waits. `Err`: it failed, and `failure` says how.
    fn drain(&mut self) -> Result<(), ()> {
        if let Some(progress) = &mut self.progress {
            progress.lines(self.renderer.lines());
        }
        let text = self.renderer.text();
        if let Err(error) = self.target.write(text) {
            self.failure = Some((false, error));
            return Err(());
        }
        text.clear();
        if let (Some(lines), Some(target)) = (self.renderer.trace(), &mut self.trace) {
            let mut text = Vec::new();
            for line in lines.drain(..) {
                trace_line(&line, self.files, &mut text);
            }
            if let Err(error) = target.write(&text) {
                self.failure = Some((true, error));
                return Err(());
            }
        }
        Ok(())
    }

    /// The job was read to its end.
    fn finish(mut self, args: &RenderArgs) -> Result<Ending, String> {
        if self.drain().is_err() {
            let (is_trace, error) = self.failure.unwrap_or_else(|| (false, io::Error::other("unknown")));
            let path = if is_trace { args.trace.as_deref() } else { None };
            return output_failed(path.unwrap_or(&args.output), &error);
        }
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
