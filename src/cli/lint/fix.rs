//! `--fix` and `--unsafe-fixes`: forms mended in place.

use std::path::Path;

use postform::diag::Diag;
use postform::lint::{Findings, edited, edits_of, fixes_of, lint};
use postform::sema::Checked;
use similar::TextDiff;

use super::super::args::{LimitsArg, LintArgs};
use super::super::config::Config;
use super::super::files;
use super::super::forms::{self, Changed};
use super::super::output;
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
    let mut work = Work { form, changed: Changed::new(), made: Vec::new() };
    let (mut checked, mut after) = work.run(false, &original, &found.diags);
    let mut told = String::new();
    if args.unsafe_fixes {
        let before = checked.as_ref().unwrap_or(&original);
        let old = sample::printed(before, args.job.as_deref());
        let safe = work.made.len();
        let diags = after.as_ref().map_or(&found.diags, |found| &found.diags).clone();
        let (mended, left) = work.run(true, before, &diags);
        if let Some(mended) = mended {
            let new = sample::printed(&mended, args.job.as_deref());
            told = story(form.path, &work.made[safe..], old, new, args);
            (checked, after) = (Some(mended), left);
        }
    }
    if !args.fix {
        return Ok(Linted { story: told, ..Linted::new(form.path, original, found) });
    }
    let (checked, found) = (checked.unwrap_or(original), after.unwrap_or(found));
    write(form.path, &checked, &work.changed)?;
    Ok(Linted { story: told, mended: work.made.len(), ..Linted::new(form.path, checked, found) })
}

/// A form while it is mended, in memory.
struct Work<'a> {
    form: Form<'a>,
    changed: Changed,
    /// The fixes so far, in words.
    made: Vec<String>,
}

impl Work<'_> {
    /// Makes fixes until none is left. Returns the form after them and what is found in it, if any was made.
    fn run(&mut self, unsafe_too: bool, form: &Checked, found: &[Diag]) -> (Option<Checked>, Option<Findings>) {
        let (mut checked, mut after): (Option<Checked>, Option<Findings>) = (None, None);
        for _ in 0..MOST_ROUNDS {
            let current = checked.as_ref().unwrap_or(form);
            let fixes = fixes_of(after.as_ref().map_or(found, |found| &found.diags), unsafe_too);
            if fixes.is_empty() {
                break;
            }
            self.made.extend(fixes.iter().map(|diag| line_of(diag, current)));
            for (file, source) in current.files.iter().enumerate() {
                let edits = edits_of(&fixes, file as u32);
                if !edits.is_empty() {
                    self.changed.insert(source.name.clone(), edited(&source.text, &edits));
                }
            }
            let next = forms::with_changes(self.form.path, self.form.bytes, self.form.limits, &self.changed);
            after = Some(lint(&next, &self.form.config.levels));
            checked = Some(next);
        }
        (checked, after)
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
        output::write_whole(&forms::place(form, file, source), text.as_bytes())?;
    }
    Ok(())
}
