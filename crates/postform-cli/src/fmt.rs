//! `postform fmt`.

use std::io::Write as _;
use std::path::Path;

use postform::Limits;
use postform::diag::{Code, Diag};
use postform::internals::fmt::format;
use postform::internals::lint::Changed;
use postform::internals::source::Source;

use super::args::FmtArgs;
use super::callers;
use super::each::each;
use super::files;
use super::forms::FormFile;
use super::output;
use super::report::count;
use super::say::message;
use super::{Ending, forms};

/// Formats forms in place. For `-`, formats standard input and prints the result.
pub fn run(args: &FmtArgs) -> Result<Ending, String> {
    let paths = forms::named(&args.forms)?;
    if let [path] = paths.as_slice()
        && path == Path::new("-")
    {
        return filter(path, args.check);
    }
    if paths.iter().any(|path| path == Path::new("-")) {
        return Err("error: `-` (standard input) must be the only argument: postform fmt -".into());
    }
    let results = each(paths.iter().collect(), |path| one(path, args));
    let (mut changed, mut left_out, mut failed) = (0, 0, false);
    for (path, result) in paths.iter().zip(results) {
        match result {
            Ok(Laid::AsItWas) => {}
            Ok(Laid::LeftOut(why)) => {
                message(&why);
                left_out += 1;
            }
            Ok(Laid::Otherwise) => {
                changed += 1;
                let word = if args.check { "would be formatted" } else { "formatted" };
                message(&format!("{}: {word}", files::name(path)));
            }
            Err(text) => {
                message(&text);
                failed = true;
            }
        }
    }
    if args.check && changed > 0 {
        let all = count(paths.len(), "form");
        message(&format!("{changed} of {all} would change; `postform fmt` without --check formats them"));
    }
    Ok(match (failed, left_out > 0 || args.check && changed > 0) {
        (true, _) => Ending::Failed,
        (_, true) => Ending::Findings,
        _ => Ending::Clean,
    })
}

/// The result for a file.
enum Laid {
    AsItWas,
    Otherwise,
    /// The file stays unchanged; the text is the reason.
    LeftOut(String),
}

/// Codes of findings about lines that make no sense. A file with such a line is perhaps not a form.
const UNREAD: [Code; 5] = [Code::PF001, Code::PF002, Code::PF007, Code::PF201, Code::PF301];

/// Formats one file.
fn one(path: &Path, args: &FmtArgs) -> Result<Laid, String> {
    let name = files::name(path);
    if !args.force && !callers::is_form(path)? {
        let help = format!("the names of forms end in .pf; to format the file anyway: postform fmt --force {name}");
        let why = format!("error: {name} does not end in .pf, and no form calls it: it is not changed");
        return Ok(Laid::LeftOut(format!("{why}\n  help: {help}")));
    }
    let file = FormFile::read(path, Limits::Extended)?;
    if !args.force
        && let Some(unread) = unread(&file)
    {
        return Ok(Laid::LeftOut(format!(
            "{unread}\n  help: {name} is not changed until every line of it can be read"
        )));
    }
    let after = format(&file.source());
    if file.bytes() == after.as_bytes() {
        return Ok(Laid::AsItWas);
    }
    if !args.check {
        output::write_whole(path, after.as_bytes())?;
    }
    Ok(Laid::Otherwise)
}

/// The message about the first line that makes no sense, in the file itself and not in a called form.
fn unread(file: &FormFile) -> Option<String> {
    let checked = file.analyse(&Changed::new());
    let own = |diag: &&Diag| diag.labels.first().is_some_and(|label| label.span.file == 0);
    let unread = checked.diags.iter().filter(own).find(|diag| diag.is_error() && UNREAD.contains(&diag.code))?;
    Some(unread.line(&checked.files))
}

fn filter(path: &Path, check: bool) -> Result<Ending, String> {
    let (before, after) = laid_out(path)?;
    match check {
        true if before == after.as_bytes() => Ok(Ending::Clean),
        true => Ok(Ending::Findings),
        false => output::shown(|out| out.write_all(after.as_bytes())),
    }
}

/// A form before and after formatting.
fn laid_out(path: &Path) -> Result<(Vec<u8>, String), String> {
    let bytes = files::read_form(path)?;
    let text = format(&Source::from_bytes(files::name(path), &bytes));
    Ok((bytes, text))
}
