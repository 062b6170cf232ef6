//! `postform lint`.

mod fix;
mod github;
pub mod json;
mod sample;
mod sarif;

use std::io::Write;
use std::path::Path;

use postform::diag::{Diag, Severity};
use postform::lint::{Changed, Found, lint};
use postform::sema::Checked;
use postform::source::Source;
use rayon::prelude::*;

use super::args::{Format, LintArgs};
use super::colour::Colour;
use super::config::Config;
use super::forms::{self, FormFile};
use super::report::{Reporter, count};
use super::say::{message, say};
use super::{Ending, output};

/// What was found in a form.
pub struct Linted {
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
pub fn run(args: &LintArgs, colour: Colour) -> Result<Ending, String> {
    let mut unread = 0;
    let mut said = |text: String| {
        message(&text);
        unread += 1;
    };
    let files: Vec<_> = forms::named(&args.forms)?.par_iter().map(|path| read(path, args)).collect();
    let files = forms::wholes(files.into_iter().filter_map(|file| file.map_err(&mut said).ok()).collect());
    // forms may share a file that they call: fixes are made one after the other
    let results: Vec<Result<Linted, String>> = match args.fix || args.unsafe_fixes {
        true => files.into_iter().map(|file| one(file, args)).collect(),
        false => files.into_par_iter().map(|file| one(file, args)).collect(),
    };
    let linted: Vec<Linted> = results.into_iter().filter_map(|result| result.map_err(&mut said).ok()).collect();
    let counts = Counts { unread, ..counts(&linted) };
    let mut text = String::new();
    for form in &linted {
        match args.format {
            Format::Pretty => text += &form.story,
            _ => say(&form.story),
        }
    }
    match args.format {
        Format::Pretty => {
            let reporter = Reporter::new(colour.on_stdout());
            let shown = linted.par_iter().map(|form| reporter.text(&form.diags, &form.files));
            text.extend(shown.collect::<Vec<_>>());
            text += &summary(&linted, counts, args);
        }
        Format::Json => text = output::json(&json::report(&linted, counts)),
        Format::Github => linted.iter().for_each(|form| text += &github::annotations(form)),
        Format::Sarif => text = output::json(&sarif::log(&linted, unread == 0)),
    }
    output::standard_output(|out| out.write_all(text.as_bytes()))?;
    Ok(match (unread, counts.errors + counts.warnings) {
        (0, 0) => Ending::Clean,
        (0, _) => Ending::Findings,
        _ => Ending::Failed,
    })
}

/// The text of a form, with the limits that hold for it.
fn read(path: &Path, args: &LintArgs) -> Result<FormFile, String> {
    FormFile::read(path, args.limits.or(Config::near(path)?.limits).unwrap_or_default())
}

/// One form: mended if that is asked for, and looked at.
fn one(mut file: FormFile, args: &LintArgs) -> Result<Linted, String> {
    let levels = Config::near(&file.path)?.levels;
    if args.fix || args.unsafe_fixes {
        return fix::run(&mut file, &levels, args);
    }
    let checked = file.analyse(&Changed::new());
    let found = lint(&checked, &levels);
    Ok(Linted::new(checked, found))
}

impl Linted {
    fn new(checked: Checked, found: Found) -> Linted {
        let files = if found.diags.is_empty() { Vec::new() } else { checked.files };
        Linted { files, diags: found.diags, suppressed: found.suppressed, story: String::new(), mended: 0 }
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
