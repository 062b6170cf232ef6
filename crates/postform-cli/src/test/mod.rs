//! `postform test`: compares the programs that forms print with the expected ones.

mod case;
mod cases;
mod coverage;
mod find;
mod posts;
mod report;
mod standard;

use std::path::{Path, PathBuf};

use super::Ending;
use super::args::{TestArgs, TestFormat};
use super::colour::Colour;
use super::each::each_on;
use super::output;
use super::progress::Progress;
use super::report::Reporter;
use super::say::message;
use case::Tried;
use find::Found;
use posts::Posts;

/// Prints every case and compares it with the expected result.
pub fn run(args: &TestArgs, colour: Colour) -> Result<Ending, String> {
    if let Some(form) = &args.new {
        let folders = folders(args);
        let [folder] = folders.as_slice() else { return Err("error: --new takes one folder".to_owned()) };
        return standard::write(form, args.post.as_deref(), folder);
    }
    let mut posts = Posts::named(args)?;
    let mut found = Found::default();
    for path in folders(args) {
        found.search(&path, &mut posts, args)?;
    }
    if args.coverage && matches!(args.format, TestFormat::Junit | TestFormat::Github) {
        return Err("error: --coverage needs --format pretty or json".to_owned());
    }
    if found.cases.is_empty() && found.problems.is_empty() {
        return Err(nothing(args));
    }
    let reporter = Reporter::new(colour.on_stderr());
    let progress = Progress::of(found.cases.len() as u64);
    let shows = colour.on_stdout() && args.format == TestFormat::Pretty;
    let tried: Vec<Tried> = each_on(args.jobs, found.cases, |case| {
        let tried = case.tried(&posts, &reporter, args.update, shows);
        progress.one();
        tried
    });
    drop(progress);
    let covered = args.coverage.then(|| coverage::of(&posts, &tried));
    let report =
        report::Report { tried: &tried, problems: &found.problems, posts: &posts, covered: covered.as_deref() };
    let text = match args.format {
        TestFormat::Pretty => report.pretty(),
        TestFormat::Json => report.json(),
        TestFormat::Junit => report.junit(),
        TestFormat::Github => report.github(),
    };
    output::standard_output(|out| std::io::Write::write_all(out, text.as_bytes()))?;
    if args.format != TestFormat::Pretty {
        message(&report.sentence());
    }
    Ok(if report.is_clean() { Ending::Clean } else { Ending::Findings })
}

fn folders(args: &TestArgs) -> Vec<PathBuf> {
    if !args.paths.is_empty() {
        return args.paths.clone();
    }
    let usual = Path::new("tests");
    vec![if usual.is_dir() || args.new.is_some() { usual } else { Path::new(".") }.to_path_buf()]
}

fn nothing(args: &TestArgs) -> String {
    let names: Vec<String> = folders(args).iter().map(|path| super::files::name(path)).collect();
    if let Some(form) = args.forms.first() {
        let form = super::files::name(form);
        return format!(
            "error: no job in {0} has an expected program of {form}\n  help: `postform test --update --form {form} {0}` writes them",
            names.join(" ")
        );
    }
    format!(
        "error: there are no cases in {}\n  help: a case is a job (such as job.json) and its expected program in the \
         same folder; NAME.pf must print expected.NAME.nc; `postform test --new FORM` writes the standard cases, \
         `postform test --update --form FORM FOLDER` writes the expected programs of the jobs in a folder",
        names.join(", ")
    )
}
