//! `postform fmt`.

use std::io::Write as _;
use std::path::Path;

use postform::internals::fmt::format;
use postform::internals::source::Source;
use rayon::prelude::*;

use super::args::FmtArgs;
use super::files;
use super::output;
use super::report::count;
use super::say::message;
use super::{Ending, forms};

/// Lays out forms in place; `-` is a filter.
pub fn run(args: &FmtArgs) -> Result<Ending, String> {
    let paths = forms::named(&args.forms)?;
    if let [path] = paths.as_slice()
        && path == Path::new("-")
    {
        return filter(path, args.check);
    }
    if paths.iter().any(|path| path == Path::new("-")) {
        return Err("error: standard input is laid out alone: postform fmt -".into());
    }
    let results: Vec<_> = paths.par_iter().map(|path| one(path, args.check)).collect();
    let (mut changed, mut failed) = (0, false);
    for (path, result) in paths.iter().zip(results) {
        match result {
            Ok(false) => {}
            Ok(true) => {
                changed += 1;
                let word = if args.check { "would be laid out otherwise" } else { "laid out" };
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
        message(&format!("{changed} of {all}; `postform fmt` without --check lays them out"));
    }
    Ok(match (failed, args.check && changed > 0) {
        (true, _) => Ending::Failed,
        (_, true) => Ending::Findings,
        _ => Ending::Clean,
    })
}

/// Lays out one file. `true`: it was laid out otherwise.
fn one(path: &Path, check: bool) -> Result<bool, String> {
    let (before, after) = laid_out(path)?;
    let changes = before != after.as_bytes();
    if changes && !check {
        output::write_whole(path, after.as_bytes())?;
    }
    Ok(changes)
}

fn filter(path: &Path, check: bool) -> Result<Ending, String> {
    let (before, after) = laid_out(path)?;
    match check {
        true if before == after.as_bytes() => Ok(Ending::Clean),
        true => Ok(Ending::Findings),
        false => output::shown(|out| out.write_all(after.as_bytes())),
    }
}

/// A form before and after.
fn laid_out(path: &Path) -> Result<(Vec<u8>, String), String> {
    let bytes = files::read_form(path)?;
    let text = format(&Source::from_bytes(files::name(path), &bytes));
    Ok((bytes, text))
}
