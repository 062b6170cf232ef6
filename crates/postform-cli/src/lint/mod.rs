//! `postform lint`.

mod fix;

use std::io::Write;
use std::path::{Path, PathBuf};

use postform::diag::{Findings, Severity};
use postform::internals::lint::{Changed, Found, lint};
use postform::internals::report as reports;
use postform::internals::sema::Checked;

use super::args::{Format, LimitsArg, LintArgs};
use super::colour::Colour;
use super::config::Config;
use super::each::each;
use super::files;
use super::forms::{self, FormFile};
use super::poll;
use super::report::{Reporter, count};
use super::say::{message, say};
use super::{Ending, output};

/// The findings of lint in a form, and the fixes that were applied.
pub struct Linted {
    /// The findings. If there are no findings, the value does not contain the form's text.
    findings: Findings,
    /// The changes of the form's files, in words.
    story: String,
    /// The number of applied fixes.
    fixed: usize,
}

/// Shows every finding of every form; with --watch, again whenever a form changes.
pub fn run(args: &LintArgs, colour: Colour) -> Result<Ending, String> {
    if let Some(job) = args.job.as_deref().filter(|_| !args.unsafe_fixes || args.forms.is_empty()) {
        let name = files::name(job);
        let form = args.forms.first().map_or("FORM".to_owned(), |form| files::name(form));
        return Err(format!(
            "error: --job is only used with --unsafe-fixes and a form: `postform lint --unsafe-fixes --job {name} {form}` shows \
             how the fixes change the program of the job\n  help: `postform check {name}` checks the job; `postform verify \
             {name} --form {form}` prints the job with the form and proves the program"
        ));
    }
    if args.watch { poll::repeat(|| inputs(args), || report(args, colour)) } else { report(args, colour) }
}

/// The files and folders to watch: the forms, folders in which other forms may appear, called forms, and postform.toml.
fn inputs(args: &LintArgs) -> Vec<PathBuf> {
    let mut paths = args.forms.clone();
    for form in forms::named(&args.forms).unwrap_or_default() {
        paths.extend(Config::near(&form).ok().and_then(|config| config.path));
        if let Ok(file) = read(&form, args) {
            file.analyse(&Changed::new());
            paths.extend(file.paths());
        }
    }
    paths
}

fn report(args: &LintArgs, colour: Colour) -> Result<Ending, String> {
    let mut unread = 0;
    let mut said = |text: String| {
        message(&text);
        unread += 1;
    };
    let files: Vec<_> = each(forms::named(&args.forms)?, |path| read(&path, args));
    let files = forms::wholes(files.into_iter().filter_map(|file| file.map_err(&mut said).ok()).collect());
    // forms may share a called file, so fixes are applied one form after the other
    let results: Vec<Result<Linted, String>> = match args.fix || args.unsafe_fixes {
        true => files.into_iter().map(|file| one(file, args)).collect(),
        false => each(files, |file| one(file, args)),
    };
    let linted: Vec<Linted> = results.into_iter().filter_map(|result| result.map_err(&mut said).ok()).collect();
    let all = || linted.iter().map(|form| &form.findings);
    let number = |severity| all().map(|form| form.count(severity)).sum::<usize>();
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
            text.extend(each(linted.iter().collect(), |form: &Linted| {
                reporter.text(&form.findings.diags, &form.findings.files)
            }));
            text += &summary(&linted, unread, args);
        }
        Format::Json => text = output::json(&reports::json(all(), unread)),
        Format::Github => all().for_each(|form| text += &reports::github(form)),
        Format::Sarif => text = output::json(&reports::sarif(all(), unread == 0)),
    }
    output::standard_output(|out| out.write_all(text.as_bytes()))?;
    Ok(match (unread, number(Severity::Error) + number(Severity::Warning)) {
        (0, 0) => Ending::Clean,
        (0, _) => Ending::Findings,
        _ => Ending::Failed,
    })
}

/// Reads a form, with the limits from the options or postform.toml.
fn read(path: &Path, args: &LintArgs) -> Result<FormFile, String> {
    let limits = args.limits.map(LimitsArg::limits).or(Config::near(path)?.limits).unwrap_or_default();
    FormFile::read(path, limits)?.of_post(args.post.as_deref())
}

/// Fixes one form if requested, and checks it.
fn one(file: FormFile, args: &LintArgs) -> Result<Linted, String> {
    let levels = Config::near(&file.path)?.levels;
    if args.fix || args.unsafe_fixes {
        return fix::run(&file, &levels, args);
    }
    let checked = file.analyse(&Changed::new());
    let found = lint(&checked, &levels);
    Ok(Linted::new(checked, found))
}

impl Linted {
    fn new(checked: Checked, found: Found) -> Linted {
        let files = if found.diags.is_empty() { Vec::new() } else { checked.files };
        let findings = Findings { files, diags: found.diags, suppressed: found.suppressed };
        Linted { findings, story: String::new(), fixed: 0 }
    }
}

/// The summary lines for people.
fn summary(linted: &[Linted], unread: usize, args: &LintArgs) -> String {
    if linted.is_empty() {
        return String::new(); // no form was read, and the error has been reported
    }
    let all = [Severity::Error, Severity::Warning, Severity::Note].map(|severity| {
        let number = linted.iter().map(|form| form.findings.count(severity)).sum();
        count(number, severity.name())
    });
    let mut text = all.join(", ");
    if unread > 0 {
        text += &format!("; {} not read", count(unread, "form"));
    }
    let suppressed: usize = linted.iter().map(|form| form.findings.suppressed).sum();
    if suppressed > 0 {
        text += &format!("; {suppressed} more allowed by comments");
    }
    let fixed: usize = linted.iter().map(|form| form.fixed).sum();
    if args.fix {
        text += &format!("; {fixed} fixed");
    }
    text.push('\n');
    let fixes = || linted.iter().flat_map(|form| &form.findings.diags).filter_map(|diag| diag.fix.as_ref());
    let safe = fixes().filter(|fix| fix.safe).count();
    let others = fixes().count() - safe;
    if safe > 0 && !args.fix {
        text += &format!("--fix can fix {safe} of the findings without changing a program\n");
    }
    if others > 0 && !args.unsafe_fixes {
        text += &format!("--unsafe-fixes shows how the fixes of {others} of the findings would change a program\n");
    }
    text
}
