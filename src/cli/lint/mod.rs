//! `postform lint`.

mod fix;
mod github;
pub mod json;
mod sample;
mod sarif;

use std::collections::HashSet;
use std::io::Write;
use std::path::{Path, PathBuf};

use postform::diag::{Diag, Severity};
use postform::lint::{Findings, lint};
use postform::sema::Checked;
use postform::source::Source;

use super::args::{Format, LintArgs};
use super::colour::Colour;
use super::config::Config;
use super::report::{Reporter, count};
use super::{Ending, files, forms, output, parallel};

/// What was found in a form.
pub struct Linted {
    /// Where the form is.
    path: PathBuf,
    /// The files that it calls.
    calls: Vec<PathBuf>,
    /// The form, and those that it calls; none where nothing was found.
    pub files: Vec<Source>,
    /// What was found.
    pub diags: Vec<Diag>,
    /// How many findings its comments allow.
    suppressed: usize,
    /// What was done to its files.
    story: String,
    /// How many fixes were made.
    mended: usize,
}

/// How many findings there are of each severity.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Errors.
    pub errors: usize,
    /// Warnings.
    pub warnings: usize,
    /// Notes.
    pub notes: usize,
    /// Findings that comments of the forms allow.
    pub suppressed: usize,
    /// Forms that could not be read.
    pub unread: usize,
}

/// Every finding of every form.
pub fn run(args: &LintArgs, colour: Colour) -> Ending {
    match try_run(args, colour) {
        Ok(ending) => ending,
        Err(message) => {
            eprintln!("{message}");
            Ending::Failed
        }
    }
}

fn try_run(args: &LintArgs, colour: Colour) -> Result<Ending, String> {
    let paths = forms::named(&args.forms)?;
    // forms may share a file that they call: fixes are made one after the other
    let results: Vec<Result<Linted, String>> = match args.fix || args.unsafe_fixes {
        true => paths.iter().map(|path| one(path, args)).collect(),
        false => parallel::map(&paths, |path| one(path, args)),
    };
    let mut unread = 0;
    let mut linted = Vec::with_capacity(results.len());
    for result in results {
        match result {
            Ok(result) => linted.push(result),
            Err(message) => {
                eprintln!("{message}");
                unread += 1;
            }
        }
    }
    leave_parts(&mut linted, &args.forms);
    let counts = Counts { unread, ..counts(&linted) };
    let mut text = String::new();
    for form in &linted {
        match args.format {
            Format::Pretty => text += &form.story,
            _ => eprint!("{}", form.story),
        }
    }
    match args.format {
        Format::Pretty => {
            let reporter = Reporter::new(colour.on_stdout());
            let shown = parallel::map(&linted, |form| reporter.text(&form.diags, &form.files));
            text.extend(shown);
            text += &summary(&linted, counts, args);
        }
        Format::Json => text = format!("{:#}\n", json::report(&linted, counts)),
        Format::Github => linted.iter().for_each(|form| text += &github::annotations(form)),
        Format::Sarif => text = format!("{:#}\n", sarif::log(&linted, unread == 0)),
    }
    output::standard_output(|out| out.write_all(text.as_bytes()))?;
    Ok(match (unread, counts.errors + counts.warnings) {
        (0, 0) => Ending::Clean,
        (0, _) => Ending::Findings,
        _ => Ending::Failed,
    })
}

/// A file that a form of a folder calls is a part of that form, and is not looked at alone unless it is named.
fn leave_parts(linted: &mut Vec<Linted>, named: &[PathBuf]) {
    let parts: HashSet<PathBuf> = linted.iter().flat_map(|form| form.calls.iter().cloned()).collect();
    if !parts.is_empty() {
        linted.retain(|form| {
            let is_part = form.path.canonicalize().is_ok_and(|path| parts.contains(&path));
            named.contains(&form.path) || !is_part
        });
    }
}

/// One form: read, mended if that is asked for, and looked at.
fn one(path: &Path, args: &LintArgs) -> Result<Linted, String> {
    let config = Config::near(path)?;
    let limits = args.limits.or(config.limits).unwrap_or_default();
    let bytes = files::read_form(path)?;
    let checked = forms::with_changes(path, &bytes, limits, &forms::Changed::new());
    let found = lint(&checked, &config.levels);
    if args.fix || args.unsafe_fixes {
        return fix::mend(fix::Form { path, bytes: &bytes, config: &config, limits }, args, checked, found);
    }
    Ok(Linted::new(path, checked, found))
}

impl Linted {
    fn new(path: &Path, checked: Checked, found: Findings) -> Linted {
        let called = checked.files.iter().skip(1);
        let calls = called.filter_map(|source| Path::new(&source.name).canonicalize().ok()).collect();
        let files = if found.diags.is_empty() { Vec::new() } else { checked.files };
        Linted {
            path: path.to_path_buf(),
            calls,
            files,
            diags: found.diags,
            suppressed: found.suppressed,
            story: String::new(),
            mended: 0,
        }
    }
}

fn counts(linted: &[Linted]) -> Counts {
    let mut counts = Counts::default();
    for form in linted {
        counts.suppressed += form.suppressed;
        for diag in &form.diags {
            match diag.severity {
                Severity::Error => counts.errors += 1,
                Severity::Warning => counts.warnings += 1,
                Severity::Note => counts.notes += 1,
            }
        }
    }
    counts
}

/// The last lines for people.
fn summary(linted: &[Linted], counts: Counts, args: &LintArgs) -> String {
    if linted.is_empty() {
        return String::new(); // nothing was read, which was said
    }
    let (errors, warnings) = (count(counts.errors, "error"), count(counts.warnings, "warning"));
    let mut text = format!("{errors}, {warnings}, {}", count(counts.notes, "note"));
    if counts.unread > 0 {
        text += &format!("; {} not read", count(counts.unread, "form"));
    }
    if counts.suppressed > 0 {
        text += &format!("; {} more allowed by comments", counts.suppressed);
    }
    let mended: usize = linted.iter().map(|form| form.mended).sum();
    if args.fix {
        text += &format!("; {mended} mended");
    }
    text.push('\n');
    let fixes = || linted.iter().flat_map(|form| &form.diags).filter_map(|diag| diag.fix.as_ref());
    let safe = fixes().filter(|fix| fix.safe).count();
    let others = fixes().count() - safe;
    if safe > 0 && !args.fix {
        text += &format!("--fix can mend {safe} of them and changes no program\n");
    }
    if others > 0 && !args.unsafe_fixes {
        text += &format!("--unsafe-fixes shows what mending {others} of them would change in a program\n");
    }
    text
}
