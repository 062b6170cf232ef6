//! `--fix` and `--unsafe-fixes`: fix forms in place.

use std::fmt::Write as _;
use std::ops::Range;
use std::path::Path;

use postform::diag::Diag;
use postform::internals::lint::{Changed, Fixed, Levels, fix, lint};
use postform::internals::post::sample_program;
use postform::internals::sema::Checked;
use postform::internals::terminal::escaped_lines;
use similar::{Algorithm, DiffTag, capture_diff_slices, group_diff_ops};

use super::super::args::{LintArgs, ReadArgs};
use super::super::callers;
use super::super::files;
use super::super::forms::FormFile;
use super::super::output;
use super::Linted;

/// Fixes a form: safe fixes with `--fix`, all with `--fix --unsafe-fixes`. The effect of unsafe fixes on a program is
/// shown before anything is written. If the effect can't be shown, the unsafe fixes are not applied.
pub fn run(file: &FormFile, levels: &Levels, args: &LintArgs) -> Result<Linted, String> {
    if file.path == Path::new("-") {
        return Err("error: fixes change files: standard input can't be fixed".into());
    }
    let original = file.analyse(&Changed::new());
    let fixed = |unsafe_too| fix(levels, unsafe_too, &mut |changed| file.analyse(changed));
    let safe = fixed(false);
    let (fixed, story) = match args.unsafe_fixes {
        true => chosen(&original, safe, fixed(true), args)?,
        false => (safe, String::new()),
    };
    if !args.fix {
        let found = lint(&original, levels);
        return Ok(Linted { story, ..Linted::new(original, found) });
    }
    if !callers::is_form(&file.path)? {
        let name = files::name(&file.path);
        let why = format!("error: {name} does not end in .pf, and no form calls it: it is not changed");
        return Err(format!("{why}\n  help: the names of forms end in .pf"));
    }
    for (name, text) in &fixed.changed {
        output::write_whole(&file.place(name), text.as_bytes())?;
    }
    Ok(Linted { story, fixed: fixed.made.len(), ..Linted::new(fixed.checked, fixed.findings) })
}

/// All fixes, or only the safe fixes if the effect of the unsafe fixes can't be shown; and a text about the fixes.
fn chosen(original: &Checked, safe: Fixed, all: Fixed, args: &LintArgs) -> Result<(Fixed, String), String> {
    let unseen: Vec<&Diag> = all.made.iter().filter(|diag| diag.fix.as_ref().is_some_and(|fix| !fix.safe)).collect();
    if unseen.is_empty() {
        return Ok((safe, String::new()));
    }
    let printed = |form: &Checked| {
        let job = args.job.as_deref().map(|path| files::job(path, &ReadArgs::default(), false)).transpose()?;
        sample_program(form, job).map_err(|error| error.to_string())
    };
    let (old, new) = (printed(original)?, printed(&all.checked)?);
    let done = match (&new, args.fix) {
        (Err(_), _) => "not made",
        (_, true) => "made",
        (_, false) => "(made by --fix --unsafe-fixes)",
    };
    let fixes = if unseen.len() == 1 { "1 unsafe fix".to_owned() } else { format!("{} unsafe fixes", unseen.len()) };
    let mut story = format!("{}: {} {done}:\n", original.files[0].name, fixes);
    for diag in unseen {
        story += &format!("  {}\n", line_of(diag, original));
    }
    let job = args.job.as_ref().map_or("the sample job".to_owned(), |job| files::name(job));
    story += &match (old, &new) {
        (Ok(old), Ok(new)) if old == *new => format!("the program of {job} stays the same\n"),
        (Ok(old), Ok(new)) => {
            format!("the program of {job}:\n{}", escaped_lines(&unified(&old, new)))
        }
        (Err(why), Ok(new)) => {
            format!("{job} could not be printed ({why}); after the fixes it prints\n{}", escaped_lines(new))
        }
        (_, Err(why)) => format!("the effect of these fixes is unknown: with them {job} can't be printed ({why})\n"),
    };
    story.push('\n');
    Ok((if new.is_ok() { all } else { safe }, story))
}

/// The changes in a program, as a unified diff with two lines around each change.
fn unified(old: &str, new: &str) -> String {
    let [old, new]: [Vec<&str>; 2] = [old, new].map(|text| text.lines().collect());
    let range = |range: Range<usize>| match range.len() {
        0 => format!("{},0", range.start),
        1 => format!("{}", range.start + 1),
        count => format!("{},{count}", range.start + 1),
    };
    let mut text = "--- before\n+++ after\n".to_owned();
    for group in group_diff_ops(capture_diff_slices(Algorithm::Myers, &old, &new), 2) {
        let [Some(first), Some(last)] = [group.first(), group.last()] else { continue };
        let is_in = range(first.old_range().start..last.old_range().end);
        _ = writeln!(text, "@@ -{is_in} +{} @@", range(first.new_range().start..last.new_range().end));
        for op in &group {
            let is_same = op.tag() == DiffTag::Equal;
            for line in &old[op.old_range()] {
                _ = writeln!(text, "{}{line}", if is_same { ' ' } else { '-' });
            }
            for line in new[op.new_range()].iter().filter(|_| !is_same) {
                _ = writeln!(text, "+{line}");
            }
        }
    }
    text
}

/// `form.pf:12: write the digit (PF206)`
fn line_of(diag: &Diag, original: &Checked) -> String {
    let title = diag.fix.as_ref().map_or("", |fix| &fix.title);
    let place = diag.labels.first().and_then(|label| {
        let source = original.files.get(label.span.file as usize)?;
        Some(format!("{}:{}: ", source.name, source.line(label.span.start) + 1))
    });
    format!("{}{title} ({})", place.unwrap_or_default(), diag.code.name())
}
