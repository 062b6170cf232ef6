//! `postform verify`, and what `render --verify` asks.

use std::fs::File;
use std::io::Write;
use std::path::Path;

use postform::diag::{Diag, Location, Severity};
use postform::render::TraceLine;
use postform::verify::{Counts, Finding, Verdict};
use postform::{ErrorKind, Job, Options};

use super::args::{ControlArgs, VerifyArgs};
use super::config::Config;
use super::files::{self, Again, io_message};
use super::prepare::{Prepared, prepare};
use super::report::{self, Reporter, place_in, stopped};
use super::say::say;
use super::spool::Spool;
use super::{Ending, output};

/// Compares a program with its job.
pub fn run(args: &VerifyArgs, colour: bool) -> Result<Ending, String> {
    let reporter = &Reporter::new(colour);
    files::check_format(&args.job, &args.read)?;
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
    let mut job = files::job(&args.job, &args.read, true)?;
    let (program, name) = match (&args.nc, &prepared) {
        (Some(path), _) => (Again::open(path)?.into_file()?, files::name(path)),
        (None, Some(prepared)) => match rendered(&mut job, &args.job, prepared, false, reporter)? {
            Ok((file, _)) => (file, "the program".to_owned()),
            Err(ending) => return Ok(ending),
        },
        (None, None) => return Err("error: give --form, --nc, or both; or name a form in postform.toml".into()),
    };
    let by_config = config.control.filter(|_| prepared.is_none());
    let control = ControlArgs { control: args.control.control.or(by_config), ..args.control.clone() };
    let proof = Proof {
        job: &args.job,
        prepared: prepared.as_ref(),
        traced: args.nc.is_none(),
        proof: control.proof(args.tolerance),
        name,
        quiet: args.options.quiet,
    };
    let proven = proof.run(&mut job, program, reporter)?;
    if let Some(text) = &proven.text {
        output::standard_output(|out| out.write_all(text.as_bytes()))?;
    }
    Ok(proven.ending)
}

/// What is to be proven.
pub struct Proof<'a> {
    /// The job's path.
    pub job: &'a Path,
    /// The form, where one is known.
    pub prepared: Option<&'a Prepared>,
    /// The form printed the program: each of its lines has a form line.
    pub traced: bool,
    /// How the program is run.
    pub proof: postform::Proof,
    /// What the program is called.
    pub name: String,
    /// Warnings of the run are not shown.
    pub quiet: bool,
}

/// How a proof came out.
pub struct Proven {
    /// The exit status.
    pub ending: Ending,
    /// The verdict in a sentence, unless the job itself is wrong.
    pub text: Option<String>,
}

impl Proof<'_> {
    /// Runs the program and compares; differences are shown.
    pub fn run(&self, job: &mut Job<'_>, program: File, reporter: &Reporter) -> Result<Proven, String> {
        let program = files::buffered(program);
        let proven = match self.prepared {
            Some(prepared) => prepared.post.verify_with(job.again(), program, &prepared.options, &self.proof),
            None => self.proof.verify(job.again(), program),
        };
        let mut warnings = match &proven {
            Ok(proven) => proven.warnings.clone(),
            Err(error) => error.findings().diags.iter().filter(|diag| !diag.is_error()).cloned().collect(),
        };
        if !self.quiet {
            warnings.iter_mut().for_each(|diag| place_in(&self.name, diag));
            say(&reporter.text(&warnings, &[]));
        }
        let proven = match proven {
            Ok(proven) => proven,
            Err(error) => {
                let failed = if error.kind() == ErrorKind::Program { Path::new(&self.name) } else { self.job };
                return Ok(Proven { ending: stopped(error, failed, reporter, &[])?, text: None });
            }
        };
        let ending = match &proven.verdict {
            Verdict::Different(findings) => {
                self.show(job, findings, Severity::Error, reporter)?;
                Ending::Findings
            }
            Verdict::NotProven(unproven) => {
                self.show(job, &unproven.notes, Severity::Note, reporter)?;
                Ending::Findings
            }
            _ => Ending::Clean,
        };
        let text = sentence(&proven.verdict, &self.name, &files::name(self.job), proven.counts);
        Ok(Proven { ending, text: Some(text) })
    }

    /// Findings from three sides: the job's item, the form's line, the program's block.
    fn show(
        &self,
        job: &mut Job<'_>,
        findings: &[Finding],
        severity: Severity,
        reporter: &Reporter,
    ) -> Result<(), String> {
        let name = files::name(self.job);
        let lines: Vec<u64> = findings.iter().map(|finding| finding.line).collect();
        let origins = match self.prepared.filter(|_| self.traced) {
            Some(prepared) => prepared.post.origins(job.again(), &prepared.options, &lines),
            None => Ok(vec![None; lines.len()]),
        };
        let origins = origins.map_err(|error| format!("error: {error}"))?;
        for (finding, traced) in findings.iter().zip(origins) {
            let place = finding.place.or(traced.as_ref().map(|line| line.place));
            let block = match finding.line {
                0 => String::new(),
                line => format!("\n{}, line {line}: {}", self.name, finding.block),
            };
            let mut diag = Diag::new(finding.code, &finding.message).help(finding.help);
            diag.severity = severity;
            if finding.times > 1 {
                diag.message += &format!(" ({} times)", finding.times);
            }
            diag.message += &postform::diag::escaped_lines(&block);
            let mut location = place.map(Location::from).unwrap_or_default();
            location.program_line = Some(finding.line).filter(|line| *line > 0);
            diag.place = Some(location);
            place_in(&name, &mut diag);
            if let Some(span) = traced.and_then(|line| line.form) {
                diag = diag.at(span, "prints this block");
            }
            let files = self.prepared.map_or(&[][..], |prepared| prepared.post.files());
            say(&reporter.text(&[diag], files));
        }
        Ok(())
    }
}

/// The verdict for people.
fn sentence(verdict: &Verdict, program: &str, job: &str, counts: Counts) -> String {
    let compared =
        format!("{}, {}", report::count(counts.cuts as usize, "cut"), report::count(counts.holes as usize, "hole"));
    match verdict {
        Verdict::Identical => format!("identical: {program} makes the motions of {job} ({compared})\n"),
        Verdict::Equivalent(other) => {
            let list: Vec<String> = other
                .counts()
                .filter(|(number, ..)| *number > 0)
                .map(|(number, what, how)| format!("{} {how}", report::count(number as usize, what)))
                .collect();
            format!("equivalent: {program} cuts what {job} asks for ({compared}): {}\n", list.join(", "))
        }
        Verdict::Different(findings) => {
            format!(
                "different: {program} does not do what {job} asks for: {}\n",
                report::count(findings.len(), "finding")
            )
        }
        Verdict::NotProven(unproven) => {
            format!("not proven: {program} against {job} ({compared}): {}{}\n", unproven.from(), unproven.why)
        }
        _ => String::new(),
    }
}

/// The job rendered into a file that nobody sees; `trace`: with where each line came from. `Err` within: it can't be, which was
/// shown.
pub fn rendered(
    job: &mut Job<'_>,
    path: &Path,
    prepared: &Prepared,
    trace: bool,
    reporter: &Reporter,
) -> Result<Result<(File, Vec<TraceLine>), Ending>, String> {
    let fail = |error: &std::io::Error| io_message("write", Path::new("the program"), error);
    let mut file = Spool::new().map_err(|error| fail(&error))?;
    let mut lines = Vec::new();
    let mut options: Options = prepared.options.clone();
    options.trace = trace;
    let printed = prepared.post.render_parts(job.again(), &options, &mut |part| {
        lines.extend_from_slice(part.trace);
        file.write_all(part.text)
    });
    let rendered = match printed {
        Ok(rendered) => rendered,
        Err(error) => {
            return match (error.kind(), error.io()) {
                (ErrorKind::Output, Some(error)) => Err(fail(error)),
                _ => stopped(error, path, reporter, prepared.post.files()).map(Err),
            };
        }
    };
    let mut denied = rendered.notes;
    denied.retain(|diag| diag.severity == Severity::Warning);
    if prepared.denies && !denied.is_empty() {
        denied.iter_mut().for_each(|diag| place_in(&files::name(path), diag));
        say(&reporter.text(&denied, prepared.post.files()));
        return Ok(Err(Ending::Findings));
    }
    Ok(Ok((file.into_file().map_err(|error| fail(&error))?, lines)))
}
