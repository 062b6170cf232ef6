//! `--fix` and `--unsafe-fixes`: forms mended in place.

use std::path::{Path, PathBuf};

use postform::diag::Diag;
use postform::lint::{Findings, edited, edits_of, fixes_of, lint};
use postform::sema::Checked;
use similar::TextDiff;

use super::super::args::{LimitsArg, LintArgs};
use super::super::config::Config;
use super::super::files::{self, io_message};
use super::super::forms::{self, Changed};
use super::super::output::Target;
use super::{Linted, sample};

/// Most rounds: a fix may make place for another one, but never for ever.
const MOST_ROUNDS: usize = 50;

/// A form that is to be mended.
#[derive(Clone, Copy)]
pub struct Form<'a> {
    /// Where it is.
    pub path: &'a Path,
    /// What is in it.
    pub bytes: &'a [u8],
    /// What holds for it.
    pub config: &'a Config,
    /// Its limits.
    pub limits: LimitsArg,
}

/// Mends a form: safe fixes with `--fix`, all with `--fix --unsafe-fixes`. What unsafe ones change in a program is shown
/// before anything is written.
pub fn mend(form: Form, args: &LintArgs, original: Checked, found: Findings) -> Result<Linted, String> {
    if form.path == Path::new("-") {
        return Err("error: fixes change files, and standard input is none".into());
    }
    let mut work = Work { form, changed: Changed::new(), mended: 0 };
    let as_it_was = Findings { diags: found.diags.clone(), suppressed: found.suppressed };
    let (mut checked, mut found) = work.run(false, original, found);
    let mut told = String::new();
    if args.unsafe_fixes {
        let asked: Vec<String> = fixes_of(&found.diags, true).into_iter().map(|diag| line_of(diag, &checked)).collect();
        if !asked.is_empty() {
            let old = sample::printed(&checked, args.job.as_deref());
            (checked, found) = work.run(true, checked, found);
            told = story(form.path, &asked, old, sample::printed(&checked, args.job.as_deref()), args);
        }
    }
    if !args.fix {
        let original = forms::with_changes(form.path, form.bytes, form.limits, &Changed::new());
        return Ok(Linted { story: told, ..Linted::new(original, as_it_was) });
    }
    write(form.path, &checked, &work.changed)?;
    Ok(Linted { story: told, mended: work.mended, ..Linted::new(checked, found) })
}

/// A form while it is mended, in memory.
struct Work<'a> {
    form: Form<'a>,
    changed: Changed,
    mended: usize,
}

impl Work<'_> {
    /// Makes fixes until none is left. Returns the form after them, and what is found in it.
    fn run(&mut self, unsafe_too: bool, mut checked: Checked, mut found: Findings) -> (Checked, Findings) {
        for _ in 0..MOST_ROUNDS {
            let fixes = fixes_of(&found.diags, unsafe_too);
            if fixes.is_empty() {
                break;
            }
            self.mended += fixes.len();
            for (file, source) in checked.files.iter().enumerate() {
                let edits = edits_of(&fixes, file as u32);
                if !edits.is_empty() {
                    self.changed.insert(source.name.clone(), edited(&source.text, &edits));
                }
            }
            checked = forms::with_changes(self.form.path, self.form.bytes, self.form.limits, &self.changed);
            found = lint(&checked, &self.form.config.levels);
        }
        (checked, found)
    }
}

/// `form.pf:12: write the digit (PF206)`
fn line_of(diag: &Diag, checked: &Checked) -> String {
    let title = diag.fix.as_ref().map_or("", |fix| &fix.title);
    let place = diag.labels.first().and_then(|label| {
        let source = checked.files.get(label.span.file as usize)?;
        Some(format!("{}:{}: ", source.name, source.line_column(label.span.start).0))
    });
    format!("{}{title} ({})", place.unwrap_or_default(), diag.code.name())
}

/// What the fixes are, and what they change in a program.
fn story(
    path: &Path,
    asked: &[String],
    old: Result<String, String>,
    new: Result<String, String>,
    args: &LintArgs,
) -> String {
    let done = if args.fix { "made" } else { "that --fix --unsafe-fixes would make" };
    let fixes = if asked.len() == 1 { "1 unsafe fix".to_owned() } else { format!("{} unsafe fixes", asked.len()) };
    let mut text = format!("{}: {fixes} {done}:\n", files::name(path));
    for line in asked {
        text += &format!("  {line}\n");
    }
    let job = args.job.as_ref().map_or("the sample job".to_owned(), |job| files::name(job));
    match (old, new) {
        (Ok(old), Ok(new)) if old == new => text += &format!("the program of {job} stays the same\n"),
        (Ok(old), Ok(new)) => {
            let diff = TextDiff::from_lines(&old, &new);
            let diff = diff.unified_diff().context_radius(2).header("before", "after").to_string();
            text += &format!("the program of {job}:\n{diff}");
        }
        (Err(why), Ok(new)) => text += &format!("{job} could not be printed ({why}); now it is\n{new}"),
        (_, Err(why)) => text += &format!("{job} can't be printed after it: {why}\n"),
    }
    text.push('\n');
    text
}

/// Writes the files that were changed, each whole or not at all.
fn write(form: &Path, checked: &Checked, changed: &Changed) -> Result<(), String> {
    for (file, source) in checked.files.iter().enumerate() {
        let Some(text) = changed.get(&source.name) else { continue };
        let path: PathBuf = forms::place(form, file, source);
        let fail = |error| io_message("write", &path, &error);
        let mut target = Target::open(&path, false)?;
        target.write(text.as_bytes()).map_err(fail)?;
        target.complete().map_err(fail)?;
    }
    Ok(())
}
