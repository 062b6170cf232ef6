//! `postform fmt`.

use std::io::Write as _;
use std::path::Path;

use postform::fmt::format;
use postform::source::Source;

use super::args::FmtArgs;
use super::files;
use super::output;
use super::report::count;
use super::{Ending, forms, parallel};

/// Lays out forms in place; `-` is a filter.
pub fn run(args: &FmtArgs) -> Ending {
    match try_run(args) {
        Ok(ending) => ending,
        Err(message) => {
            eprintln!("{message}");
            Ending::Failed
        }
    }
}

fn try_run(args: &FmtArgs) -> Result<Ending, String> {
    let paths = forms::named(&args.forms)?;
    if let [path] = paths.as_slice()
        && path == Path::new("-")
    {
        return filter(path, args.check);
    }
    if paths.iter().any(|path| path == Path::new("-")) {
        return Err("error: standard input is laid out alone: postform fmt -".into());
    }
    let results = parallel::map(&paths, |path| one(path, args.check));
    let (mut changed, mut failed) = (0, false);
    for (path, result) in paths.iter().zip(results) {
        match result {
            Ok(false) => {}
            Ok(true) => {
                changed += 1;
                let word = if args.check { "would be laid out otherwise" } else { "laid out" };
                eprintln!("{}: {word}", files::name(path));
            }
            Err(message) => {
                eprintln!("{message}");
                failed = true;
            }
        }
    }
    if args.check && changed > 0 {
        eprintln!("{} of {}; `postform fmt` without --check lays them out", changed, count(paths.len(), "form"));
    }
    Ok(match (failed, args.check && changed > 0) {
        (true, _) => Ending::Failed,
        (_, true) => Ending::Findings,
        _ => Ending::Clean,
    })
}

/// Lays out one file. `true`: it was laid out otherwise.
fn one(path: &Path, check: bool) -> Result<bool, String> {
    let bytes = files::read_form(path)?;
    let text = format(&Source::from_bytes(files::name(path), &bytes));
    if text.as_bytes() == bytes {
        return Ok(false);
    }
    if !check {
        output::write_whole(path, text.as_bytes())?;
    }
    Ok(true)
}

fn filter(path: &Path, check: bool) -> Result<Ending, String> {
    let bytes = files::read_form(path)?;
    let text = format(&Source::from_bytes(files::name(path), &bytes));
    if check {
        return Ok(if text.as_bytes() == bytes { Ending::Clean } else { Ending::Findings });
    }
    output::standard_output(|out| out.write_all(text.as_bytes()))?;
    Ok(Ending::Clean)
}
