//! A test case: the program that a form prints for a job, compared with the expected one.

use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use postform::diag::Diag;
use postform::internals::diff::{self, Edit, Ignore, Summary, compare};
use postform::internals::post::Part;
use postform::internals::render::{Clock, Cycles, TraceLine};
use postform::internals::trace::Trace;
use postform::{Error, Finding, Format, Job, Options, Verdict};

use super::super::args::ReadArgs;
use super::super::beside::{self, Printed};
use super::super::diff::{Side, unified};
use super::super::files::{self, io_message};
use super::super::machine;
use super::super::output::write_whole;
use super::super::report::{Reporter, place_in};
use super::posts::{Posts, Ready};

/// Number of blocks shown around a difference.
const CONTEXT: usize = 2;

/// A job, a form, and the expected result.
pub struct Case {
    /// The job's file.
    pub job: PathBuf,
    /// The form, by its number.
    pub form: usize,
    /// The file of the expected program, or of the expected error code.
    pub expected: PathBuf,
    /// Whether cycles are printed by the form's sequences or as moves.
    pub cycles: Cycles,
    /// The kind of the expected result.
    pub wanted: Wanted,
    /// Ignored differences.
    pub ignore: Ignore,
    /// Largest allowed difference of numbers.
    pub tolerance: f64,
    /// The date with which the program is printed.
    pub clock: Clock,
}

/// The kind of the expected result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// A program.
    Program,
    /// An error, by its code.
    Refusal,
    /// The expected result is unknown: the result of this run is written as the expected one.
    Nothing,
}

/// The program that a form printed.
pub struct Program {
    /// The text of the program.
    pub text: Vec<u8>,
    trace: Vec<TraceLine>,
    verdict: Verdict,
}

/// The reason why there is no program, or why the program differs from its job.
pub struct Refused {
    /// The errors, or the differences from the job.
    pub diags: Vec<Diag>,
    /// The message, if there are no findings.
    pub message: String,
}

impl Refused {
    fn by(error: &Error) -> Refused {
        let diags = error.findings().diags.iter().filter(|diag| diag.is_error()).cloned().collect();
        Refused { diags, message: error.to_string() }
    }
}

/// The outcome of a case.
pub struct Tried {
    /// The case.
    pub case: Case,
    /// The result.
    pub end: End,
    /// The reason why the program is not proven; `None`: it is proven, or there is no program.
    pub unproven: Option<String>,
    /// The lines of the form that printed, each by its file and its first byte.
    pub printed: Vec<(u32, u32)>,
}

/// The kind of result of a case.
pub enum End {
    /// The program or error is as expected.
    Passed,
    /// A different program: the text for people, and the first different line of the expected program, from 1.
    Differs { text: String, line: usize },
    /// There is no program, or the program is wrong: the reason, for people.
    Failed(String),
    /// The expected result was written: the reason, for people, and the file.
    Written { text: String, file: PathBuf },
}

impl End {
    /// The word in reports.
    pub fn name(&self) -> &'static str {
        match self {
            End::Passed => "passed",
            End::Differs { .. } => "differs",
            End::Failed(_) => "failed",
            End::Written { .. } => "written",
        }
    }

    /// Whether the result is acceptable.
    pub fn is_right(&self) -> bool {
        matches!(self, End::Passed | End::Written { .. })
    }
}

impl Case {
    /// A case without an expected result.
    pub fn new(job: PathBuf, expected: PathBuf) -> Case {
        let (ignore, tolerance) = (Ignore::default(), 0.0);
        let clock = Clock { date: "2000-01-01".into(), time: "00:00".into() };
        let (cycles, wanted) = (Cycles::Form, Wanted::Nothing);
        Case { job, form: 0, expected, cycles, wanted, ignore, tolerance, clock }
    }

    /// Prints the program of the case and compares it with the expected result. `update`: a different result is written
    /// as the expected one.
    pub fn tried(self, posts: &Posts, reporter: &Reporter, update: bool, colour: bool) -> Tried {
        let entry = posts.get(self.form);
        let ready = match &entry.ready {
            Ok(ready) => ready,
            Err(why) => {
                let end = End::Failed(why.trim_start_matches("error: ").to_owned());
                return Tried { case: self, end, unproven: None, printed: Vec::new() };
            }
        };
        let printed = match self.print(ready) {
            Ok(printed) => printed,
            Err(why) => return Tried { case: self, end: End::Failed(why), unproven: None, printed: Vec::new() },
        };
        let lines = printed.as_ref().map(|program| program.trace.as_slice()).unwrap_or_default();
        let spans = lines.iter().filter_map(|line: &TraceLine| line.form.map(|span| (span.file, span.start)));
        let mut spans: Vec<(u32, u32)> = spans.collect();
        spans.sort_unstable();
        spans.dedup();
        let unproven = match printed.as_ref().map(|program| &program.verdict) {
            Ok(Verdict::NotProven(why)) => Some(why.why.clone()),
            _ => None,
        };
        let end = self.compared(printed, ready, reporter, update, colour).unwrap_or_else(End::Failed);
        Tried { case: self, end, unproven, printed: spans }
    }

    /// The program of the form, proven while it is printed. The outer `Err`: the job can't be read.
    pub fn print(&self, ready: &Ready) -> Result<Result<Program, Refused>, String> {
        let read = ReadArgs::default();
        let mut job = files::job(&self.job, &read, true).map_err(|why| why.trim_start_matches("error: ").to_owned())?;
        let mut options = ready.options.clone();
        options.cycles = self.cycles;
        options.clock = Some(self.clock.clone());
        options.job_file = self.job.file_name().map(|name| name.to_string_lossy().into_owned());
        if !has_number(&mut job, ready) {
            options.program = Some(1);
        }
        let (mut text, mut trace) = (Vec::new(), Vec::new());
        let mut take = |part: Part<'_>| {
            text.extend_from_slice(part.text);
            trace.extend_from_slice(part.trace);
            Ok(())
        };
        let Printed { rendered, proven } = beside::print(&ready.post, job.again(), &options, &ready.proof, &mut take)?;
        if let Err(error) = rendered {
            return Ok(Err(Refused::by(&error)));
        }
        // a program that calls or repeats parts of itself is proven from a file
        let proven = proven.and_then(|proven| match &proven.verdict {
            Verdict::NotProven(why) if why.in_a_file => {
                ready.post.verify_with(job.again(), Cursor::new(text.as_slice()), &options, &ready.proof)
            }
            _ => Ok(proven),
        });
        let mut proven = match proven.and_then(|proven| ready.post.located(proven, job.again(), &options)) {
            Ok(proven) => proven,
            Err(error) => return Ok(Err(Refused::by(&error))),
        };
        if let Verdict::Different(findings) = &mut proven.verdict {
            let diag = |finding: &Finding| finding.diag("the program");
            return Ok(Err(Refused { diags: findings.iter().map(diag).collect(), message: String::new() }));
        }
        if let Some(refused) = self.on_machine(ready, (&mut job, &options), &text)? {
            return Ok(Err(refused));
        }
        Ok(Ok(Program { text, trace, verdict: proven.verdict }))
    }

    /// The errors of a program that does not fit into the machine.
    fn on_machine(
        &self,
        ready: &Ready,
        made: (&mut Job<'_>, &Options),
        program: &[u8],
    ) -> Result<Option<Refused>, String> {
        let Some(machine) = &ready.machine else { return Ok(None) };
        let name = "the program";
        let (fitted, _) = machine::of_post(&ready.post, machine, made, &ready.proof, (Cursor::new(program), name))?;
        let diags = fitted.findings.iter().map(|finding| machine::diag(finding, name, &[&self.job]));
        let diags: Vec<Diag> = diags.filter(Diag::is_error).collect();
        Ok((!diags.is_empty()).then_some(Refused { diags, message: String::new() }))
    }

    fn compared(
        &self,
        printed: Result<Program, Refused>,
        ready: &Ready,
        reporter: &Reporter,
        update: bool,
        colour: bool,
    ) -> Result<End, String> {
        match printed {
            Ok(program) => self.program(&program, ready, update, colour),
            Err(error) => self.refusal(&error, ready, reporter, update),
        }
    }

    fn program(&self, program: &Program, ready: &Ready, update: bool, colour: bool) -> Result<End, String> {
        if let (Verdict::NotProven(why), true) = (&program.verdict, ready.require_proof) {
            return Ok(End::Failed(format!(
                "the program is not proven, and postform.toml requires a proof: {}",
                why.why
            )));
        }
        let write = |why: String| {
            let target = match self.wanted {
                Wanted::Refusal => self.expected.with_extension("nc"),
                _ => self.expected.clone(),
            };
            write_whole(&target, &program.text)?;
            if target != self.expected {
                fs::remove_file(&self.expected).map_err(|error| io_message("remove", &self.expected, &error))?;
            }
            Ok(End::Written { text: why, file: target })
        };
        match self.wanted {
            Wanted::Nothing => return write(String::new()),
            Wanted::Refusal => {
                let code = self.code()?;
                let why = format!("a program is printed, but {code} was expected");
                return if update { write(why) } else { Ok(End::Failed(why)) };
            }
            Wanted::Program => {}
        }
        let bytes = files::read_regular(&self.expected)?;
        let old = side(&self.expected, bytes)?;
        let new = Side {
            name: format!(
                "the program of {} for {}",
                files::name(Path::new(&ready.post.files()[0].name)),
                files::name(&self.job)
            ),
            trace: Some((Trace::new(program.trace.clone()), ready.post.files().to_vec())),
            control: ready.post.control(),
            ..side(&self.expected, program.text.clone())?
        };
        let options = diff::Options { ignore: self.ignore, tolerance: self.tolerance };
        let mut comparison = compare(&old.program, &new.program, &options);
        if comparison.is_same() {
            return Ok(End::Passed);
        }
        // programs are shown without block numbers, because one additional block changes all later numbers
        let unnumbered = diff::Options { ignore: Ignore { numbers: true, ..self.ignore }, ..options };
        let unspaced = diff::Options { ignore: Ignore { numbers: true, spaces: true, ..self.ignore }, ..options };
        let without = compare(&old.program, &new.program, &unnumbered);
        let mut note = "";
        if compare(&old.program, &new.program, &unspaced).is_same() {
            let blanks = without.is_same();
            note = if blanks { "only block numbers differ\n" } else { "only spaces or line ends differ\n" };
        } else if !without.is_same() {
            comparison = without;
        }
        let first = comparison.edits().next().copied();
        let line = first.map_or(0, |edit| match edit {
            Edit::Removed(line) | Edit::Changed(line, _) | Edit::Moved(line, _) => line,
            Edit::Added(_) => comparison.hunks.first().map_or(0, |hunk| hunk.old.start),
        });
        let summary = Summary::of(&comparison, &old.program, &new.program, &self.ignore);
        let text = unified(&old, &new, &comparison, &summary, CONTEXT, &options, colour) + note;
        if update { write(text) } else { Ok(End::Differs { text, line: line + 1 }) }
    }

    fn refusal(&self, error: &Refused, ready: &Ready, reporter: &Reporter, update: bool) -> Result<End, String> {
        let mut diags = error.diags.clone();
        let codes: Vec<&str> = diags.iter().map(|diag| diag.code.name()).collect();
        let first = codes.first().copied().unwrap_or("an error").to_owned();
        let mut expected = String::new();
        if self.wanted == Wanted::Refusal {
            let code = self.code()?;
            if codes.contains(&code.as_str()) && may_be_expected(&code) {
                return Ok(End::Passed);
            }
            expected = match codes.contains(&code.as_str()) {
                true => {
                    format!("{code} can't be an expected result: the form or the machine does not cause this error\n")
                }
                false => format!("{code} was expected, but {first} was reported\n"),
            };
        }
        diags.iter_mut().for_each(|diag| place_in(&files::name(&self.job), diag));
        let shown =
            if diags.is_empty() { format!("{}\n", error.message) } else { reporter.text(&diags, ready.post.files()) };
        if self.wanted == Wanted::Program || !update || !may_be_expected(&first) {
            return Ok(End::Failed(expected + &shown));
        }
        let target = self.expected.with_extension("refused");
        write_whole(&target, format!("{first}\n").as_bytes())?;
        Ok(End::Written { text: expected + &shown, file: target })
    }

    /// The expected error code.
    fn code(&self) -> Result<String, String> {
        let text = fs::read_to_string(&self.expected).map_err(|error| io_message("read", &self.expected, &error))?;
        let code = text.split_whitespace().next().unwrap_or_default();
        if code.is_empty() {
            return Err(format!("{} contains no code such as PR010", files::name(&self.expected)));
        }
        Ok(code.to_owned())
    }
}

/// The codes of errors that can be expected results, by their first letters: errors of rendering (PR), a tap that only a
/// control can make (PC021), and a program that does not fit into the machine (PM). All other errors are mistakes in the
/// job or the form.
const EXPECTED: [&str; 3] = ["PR", "PC021", "PM"];

/// Whether this error can be an expected result.
pub fn may_be_expected(code: &str) -> bool {
    EXPECTED.iter().any(|first| code.starts_with(first))
}

/// Whether the job has a program number. A JSON job without a number has forgotten it; in other formats, a job may lack
/// the number.
fn has_number(job: &mut Job<'_>, ready: &Ready) -> bool {
    matches!(job.format(), Format::Json | Format::JsonLines)
        || !matches!(ready.post.file_name(job.again(), &ready.options), Ok((_, None)))
}

fn side(path: &Path, bytes: Vec<u8>) -> Result<Side, String> {
    let program = diff::Program::new(bytes).map_err(|_| format!("{} is larger than 4 GB", files::name(path)))?;
    Ok(Side { name: files::name(path), program, control: None, trace: None })
}
