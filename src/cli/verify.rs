//! `postform verify`, and what `render --verify` asks.

use std::fs::File;
use std::io::{Seek, Write};
use std::path::Path;

use postform::diag::{Diag, Location, Severity};
use postform::nc::Settings;
use postform::render::{Options, Renderer, TraceLine};
use postform::toolpath::{Event, Flow, Place, ReadError, Sink, Stop, Units, flow};
use postform::verify::{Comparer, Counts, Expectation, Finding, Verdict};

use super::args::{ControlArgs, From, ReadArgs, VerifyArgs};
use super::config::Config;
use super::files::{self, Again, io_message};
use super::huge::Growth;
use super::prepare::{Prepared, prepare};
use super::report::{self, Reporter};
use super::say::say;
use super::spool::Spool;
use super::{Ending, output, render};

/// Text that waits before it is written.
const CHUNK: usize = 64 * 1024;

/// Compares a program with its job.
pub fn run(args: &VerifyArgs, colour: bool) -> Result<Ending, String> {
    let reporter = &Reporter::new(colour);
    let from = files::job_format(&args.job, &args.read)?;
    if args.job == Path::new("-") && args.nc.as_deref() == Some(Path::new("-")) {
        return Err("error: job and program can't both be standard input".into());
    }
    let config = Config::near(&args.job)?;
    let form = match args.nc {
        Some(_) => args.form.clone(), // a program is proven without a form, unless one is named
        None => args.form.clone().or(config.form),
    };
    let prepared = match &form {
        Some(form) => match prepare(form, &args.options, &args.job, reporter)? {
            Some(prepared) => Some(prepared),
            None => return Ok(Ending::Findings),
        },
        None => None,
    };
    let job = Job { again: Again::open(&args.job)?, from, read: &args.read, path: &args.job };
    let (program, name) = match (&args.nc, &prepared) {
        (Some(path), _) => (Again::open(path)?.into_file()?, files::name(path)),
        (None, Some(prepared)) => match rendered(&job, prepared, reporter)? {
            Ok(file) => (file, "the program".to_owned()),
            Err(ending) => return Ok(ending),
        },
        (None, None) => return Err("error: give --form, --nc, or both; or name a form in postform.toml".into()),
    };
    let by_config = config.control.filter(|_| prepared.is_none());
    let control = ControlArgs { control: args.control.control.or(by_config), ..args.control.clone() };
    let proof = Proof {
        job: &job,
        prepared: prepared.as_ref(),
        traced: args.nc.is_none(),
        control: &control,
        tolerance: args.tolerance,
        name,
        quiet: args.options.quiet,
    };
    let proven = proof.run(program, reporter)?;
    if let Some(text) = &proven.text {
        output::standard_output(|out| out.write_all(text.as_bytes()))?;
    }
    Ok(proven.ending)
}

/// A job that is read several times.
pub struct Job<'a> {
    /// Its text.
    pub again: Again,
    /// Its format.
    pub from: From,
    /// How it is read.
    pub read: &'a ReadArgs,
    /// Its name.
    pub path: &'a Path,
}

impl Job<'_> {
    fn read(&self, sink: &mut dyn Sink) -> Result<Result<(), ReadError>, String> {
        Ok(files::read_job(self.again.read()?, self.from, self.read, sink).0)
    }
}

/// What is to be proven.
pub struct Proof<'a> {
    /// The job.
    pub job: &'a Job<'a>,
    /// The form, where one is known.
    pub prepared: Option<&'a Prepared>,
    /// The form printed the program: each of its lines has a form line.
    pub traced: bool,
    /// How the program is run.
    pub control: &'a ControlArgs,
    /// How near places must be.
    pub tolerance: Option<f64>,
    /// What the program is called.
    pub name: String,
    /// Warnings of the run are not shown.
    pub quiet: bool,
}

/// How it came out.
pub struct Proven {
    /// The exit status.
    pub ending: Ending,
    /// The verdict in a sentence, unless the job itself is wrong.
    pub text: Option<String>,
}

impl Proof<'_> {
    /// Runs the program and compares; differences are shown.
    pub fn run(&self, program: File, reporter: &Reporter) -> Result<Proven, String> {
        let form = self.prepared.map(|prepared| &prepared.program.settings);
        let units = self.prepared.and_then(|prepared| prepared.options.units).unwrap_or(Units::Mm);
        let control = self.control.settings(form.and_then(|form| form.control), units);
        let settings = Settings { centers_absolute: form.is_some_and(|form| !form.centre_incremental), ..control };
        let sink_as_printed = self.prepared.is_some_and(|prepared| prepared.options.sink_as_printed);
        let expectation = form.map_or_else(Expectation::default, |form| Expectation::of_form(form, sink_as_printed));
        let comparer = Comparer::new(files::buffered(program), settings, expectation, self.tolerance);
        let mut comparer = Started { comparer, known: self.prepared.is_none_or(|p| p.options.units.is_none()) };
        let read = self.job.read(&mut comparer)?;
        let counts = comparer.comparer.counts();
        if !self.quiet {
            let mut warnings = comparer.comparer.warnings();
            warnings.iter_mut().for_each(|diag| self.place_in_program(diag));
            say(&reporter.text(&warnings, &[]));
        }
        let verdict = comparer.comparer.verdict().map_err(|error| io_message("read", Path::new(&self.name), &error))?;
        let job = files::name(self.job.path);
        if let Err(error) = read
            && !matches!(error, ReadError::Stopped)
            && !matches!(verdict, Verdict::Different(_))
        {
            let ReadError::Job(mut diag) = error else {
                let ReadError::Io(error) = error else { return Err("error: the job can't be read".into()) };
                return Err(io_message("read", self.job.path, &error));
            };
            let ending = Ending::of(&diag);
            render::place_in(&job, &mut diag);
            say(&reporter.text(&[*diag], &[]));
            return Ok(Proven { ending, text: None });
        }
        let ending = if let Verdict::Different(findings) = &verdict {
            self.show(findings, reporter)?;
            Ending::Findings
        } else {
            Ending::Clean
        };
        Ok(Proven { ending, text: Some(sentence(&verdict, &self.name, &job, counts)) })
    }

    fn place_in_program(&self, diag: &mut Diag) {
        diag.place.get_or_insert_default().file = Some(self.name.clone());
    }

    /// Findings from three sides: the job's item, the form's line, the program's block.
    fn show(&self, findings: &[Finding], reporter: &Reporter) -> Result<(), String> {
        let job = files::name(self.job.path);
        for finding in findings {
            let traced = match self.prepared.filter(|_| self.traced && finding.line > 0) {
                Some(prepared) => printed_by(self.job, prepared, finding.line)?,
                None => None,
            };
            let place = finding.place.or(traced.as_ref().map(|line| line.place));
            let block = match finding.line {
                0 => String::new(),
                line => format!("\n{}, line {line}: {}", self.name, finding.block),
            };
            let mut diag = Diag::new(finding.code, &finding.message).help(finding.help);
            diag.message += &postform::diag::escaped_lines(&block);
            diag.place = Some(place.map(Location::from).unwrap_or_default());
            diag.place.get_or_insert_default().program_line = Some(finding.line).filter(|line| *line > 0);
            render::place_in(&job, &mut diag);
            if let Some(span) = traced.and_then(|line| line.form) {
                diag = diag.at(span, "prints this block");
            }
            let files = self.prepared.map_or(&[][..], |prepared| &prepared.files);
            say(&reporter.text(&[diag], files));
        }
        Ok(())
    }
}

/// Before the first event, the program counts in the job's units unless it was rendered in others.
struct Started<R> {
    comparer: Comparer<R>,
    known: bool,
}

impl<R: std::io::BufRead + Seek> Sink for Started<R> {
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        if let (Event::Start(start), true) = (&event, self.known) {
            self.comparer.begin_in(start.units);
        }
        self.comparer.event(event, place)
    }
}

/// The verdict for people.
fn sentence(verdict: &Verdict, program: &str, job: &str, counts: Counts) -> String {
    let compared =
        format!("{}, {}", report::count(counts.cuts as usize, "cut"), report::count(counts.holes as usize, "hole"));
    match verdict {
        Verdict::Identical => format!("identical: {program} makes the motions of {job} ({compared})\n"),
        Verdict::Equivalent(other) => {
            let list = [
                (other.pecks, "with other pecks", "hole"),
                (other.ways, "in another order of axes or higher", "way"),
                (other.arcs, "made of parts", "arc"),
                (other.parts, "made of parts", "straight cut"),
                (other.outs, "left at feed farther up", "hole"),
                (other.entries, "left and entered again", "cut"),
                (other.slow, "at feed that turn compensation on or off", "rapid"),
            ];
            let list: Vec<String> = list
                .iter()
                .filter(|(number, ..)| *number > 0)
                .map(|(number, how, what)| format!("{} {how}", report::count(*number as usize, what)))
                .collect();
            format!("equivalent: {program} cuts what {job} asks for ({compared}): {}\n", list.join(", "))
        }
        Verdict::Different(findings) => {
            format!(
                "different: {program} does not do what {job} asks for: {}\n",
                report::count(findings.len(), "finding")
            )
        }
    }
}

/// The job rendered into a file that nobody sees. `Err` within: it can't be, which was shown.
fn rendered(job: &Job, prepared: &Prepared, reporter: &Reporter) -> Result<Result<File, Ending>, String> {
    Ok(spooled(job, prepared, reporter, false)?.map(|(file, _)| file))
}

/// The same, with where each line came from. `None`: it can't be.
pub fn rendered_with_trace(
    job: &Job,
    prepared: &Prepared,
    reporter: &Reporter,
) -> Result<Option<(File, Vec<TraceLine>)>, String> {
    Ok(spooled(job, prepared, reporter, true)?.ok())
}

fn spooled(
    job: &Job,
    prepared: &Prepared,
    reporter: &Reporter,
    trace: bool,
) -> Result<Result<(File, Vec<TraceLine>), Ending>, String> {
    let fail = |error: std::io::Error| io_message("write", Path::new("the program"), &error);
    let growth = Growth::new(prepared.huge);
    let input = growth.of(job.again.read()?);
    let mut sink = Printed {
        renderer: Renderer::new(&prepared.program, Options { trace, ..prepared.options.clone() }),
        file: Spool::new().map_err(fail)?,
        growth,
        failure: None,
    };
    let (read, report) = files::read_job(input, job.from, job.read, &mut sink);
    if read.is_ok() {
        sink.drain();
    }
    if let Some(error) = sink.failure.take() {
        return Err(fail(error));
    }
    match read {
        Ok(()) | Err(ReadError::Stopped) => {}
        Err(ReadError::Io(error)) => return Err(io_message("read", job.path, &error)),
        Err(ReadError::Job(mut diag)) => {
            let ending = Ending::of(&diag);
            render::place_in(&files::name(job.path), &mut diag);
            say(&reporter.text(&[*diag], &prepared.files));
            return Ok(Err(ending));
        }
    }
    let mut denied = report.warnings;
    denied.extend_from_slice(sink.renderer.notes());
    denied.retain(|diag| diag.severity == Severity::Warning);
    if prepared.denies && !denied.is_empty() {
        denied.iter_mut().for_each(|diag| render::place_in(&files::name(job.path), diag));
        say(&reporter.text(&denied, &prepared.files));
        return Ok(Err(Ending::Findings));
    }
    let lines = sink.renderer.trace().map(std::mem::take).unwrap_or_default();
    Ok(Ok((sink.file.into_file().map_err(fail)?, lines)))
}

struct Printed<'p> {
    renderer: Renderer<'p>,
    file: Spool,
    growth: Growth,
    failure: Option<std::io::Error>,
}

impl Printed<'_> {
    fn drain(&mut self) {
        let text = self.renderer.text();
        if let Err(error) = self.file.write_all(text) {
            self.failure = Some(error);
        }
        text.clear();
    }
}

impl Sink for Printed<'_> {
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        self.renderer.event(event, place)?;
        let length = self.renderer.text().len();
        if length >= CHUNK {
            flow(self.growth.print(length, place))?;
            self.drain();
        }
        match &self.failure {
            Some(_) => Flow::Break(Stop::Enough),
            None => Flow::Continue(()),
        }
    }
}

/// Form line and job item of a program line, by rendering again.
fn printed_by(job: &Job, prepared: &Prepared, line: u64) -> Result<Option<TraceLine>, String> {
    struct Finder<'p> {
        renderer: Renderer<'p>,
        line: u64,
        found: Option<TraceLine>,
    }
    impl Finder<'_> {
        fn look(&mut self) {
            self.renderer.text().clear();
            if let Some(lines) = self.renderer.trace() {
                self.found = self.found.or(lines.iter().find(|traced| traced.line == self.line).copied());
                lines.clear();
            }
        }
    }
    impl Sink for Finder<'_> {
        fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
            let done = self.renderer.event(event, place);
            self.look();
            match self.found {
                Some(_) => Flow::Break(Stop::Enough),
                None => done,
            }
        }
    }
    let options = Options { trace: true, ..prepared.options.clone() };
    let mut finder = Finder { renderer: Renderer::new(&prepared.program, options), line, found: None };
    _ = job.read(&mut finder)?; // it was read to its end before
    finder.look();
    Ok(finder.found)
}
