//! Cases in folders: jobs, and the programs expected of them.

use std::collections::HashSet;
use std::fs;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use postform::Format;
use postform::internals::render::Cycles;

use super::super::args::TestArgs;
use super::super::clock;
use super::super::config::{Config, shortened};
use super::super::diff::ignored;
use super::super::files::{self, io_message};
use super::super::packed::unpacked_name;
use super::case::{Case, Wanted};
use super::posts::Posts;

/// What was found.
#[derive(Default)]
pub struct Found {
    /// The cases, in the order of their paths.
    pub cases: Vec<Case>,
    /// What can't be a case, for people.
    pub problems: Vec<String>,
}

/// Folders below one another; deeper ones are left alone.
const DEEPEST: usize = 32;
/// The day on which programs are printed, unless [test] says another: nothing in them depends on the day of the test.
const DAY: &str = "2000-01-01T00:00";
/// So much of a JSON document tells whether it is a job.
const HEAD: u64 = 4096;

impl Found {
    /// Adds the cases of a folder and of those below it, or those of one job.
    ///
    /// # Errors
    /// A message: it can't be read, or its postform.toml says something that makes no sense.
    pub fn search(&mut self, path: &Path, posts: &mut Posts, args: &TestArgs) -> Result<(), String> {
        let meta = fs::metadata(path).map_err(|error| io_message("read", path, &error))?;
        if meta.is_file() {
            let files = listed(files::folder(path))?;
            let name = files::name(path);
            if files::is_form(path) {
                return Err(format!("error: {name} is a form\n  help: `postform test FOLDER --form {name}` tries it"));
            }
            if is_expected(path) {
                return Err(format!("error: {name} is an expected program: give its job, or its folder"));
            }
            return self.job(path, &files, posts, args);
        }
        self.folder(path, posts, args, DEEPEST)
    }

    fn folder(&mut self, folder: &Path, posts: &mut Posts, args: &TestArgs, deeper: usize) -> Result<(), String> {
        let entries = listed(folder)?;
        let expected = jobs_expected(&entries);
        let jobs: Vec<&PathBuf> = entries.iter().filter(|path| is_job(path, &expected)).collect();
        for (at, job) in jobs.iter().enumerate() {
            if let Some(other) = jobs[..at].iter().find(|other| other.file_stem() == job.file_stem()) {
                let (job, other) = (files::name(job), files::name(other));
                self.problems.push(format!(
                    "{job} and {other} would share their expected programs\n  help: give one another name"
                ));
                continue;
            }
            self.job(job, &entries, posts, args)?;
        }
        for path in entries.iter().filter(|path| is_expected(path)) {
            let stem = stem_of_expected(path);
            if !jobs.iter().any(|job| job.file_stem().is_some_and(|own| own.to_string_lossy() == stem)) {
                self.problems.push(format!("{} has no {stem} beside it: no job of that name", files::name(path)));
            }
        }
        for folder in below(&entries).filter(|_| deeper > 0) {
            self.folder(folder, posts, args, deeper - 1)?;
        }
        Ok(())
    }

    fn job(&mut self, job: &Path, beside: &[PathBuf], posts: &mut Posts, args: &TestArgs) -> Result<(), String> {
        let config = Config::near(job)?;
        let folder = files::folder(job);
        let stem = job.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let head = if stem == "job" { "expected.".to_owned() } else { format!("{stem}.expected.") };
        let own_form = folder.join("form.pf");
        let forms = posts.under(&config)?;
        let ignore = ignored(&config.test.ignore).map_err(|error| {
            in_file(&config, &format!("ignore under [test]: {}", error.trim_start_matches("error: ")))
        })?;
        let day = config.test.date.as_deref().unwrap_or(DAY);
        let clock =
            clock::parse(day).map_err(|why| in_file(&config, &format!("date = {day:?} under [test]: {why}")))?;
        if !(0.0..=1e3).contains(&config.test.tolerance) {
            let message = format!("tolerance = {} under [test]: it is 0 or more", config.test.tolerance);
            return Err(in_file(&config, &message));
        }
        let mut count = 0;
        let add = |found: &mut Found, form: usize, expected: PathBuf, cycles: Cycles, wanted: Wanted| {
            let (job, tolerance, require_proof) = (job.to_path_buf(), config.test.tolerance, config.require_proof);
            let is_new = !found.cases.iter().any(|case| case.expected == expected && case.form == form);
            if is_new {
                let clock = clock.clone();
                found.cases.push(Case { job, form, expected, cycles, wanted, ignore, tolerance, clock, require_proof });
            }
        };
        for path in beside {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let Some(rest) = name.strip_prefix(head.as_str()) else { continue };
            count += 1;
            let (rest, ending) = rest.rsplit_once('.').unwrap_or(("", rest));
            let wanted = if ending == "refused" { Wanted::Refusal } else { Wanted::Program };
            let (form_name, cycles) = match rest.strip_suffix(".moves") {
                Some(form) => (form, Cycles::Emulated),
                None => (rest, Cycles::Form),
            };
            let form = match form_name {
                "" => match posts.are_named() {
                    true => continue,
                    false if own_form.is_file() => Some(posts.entry(&own_form, config.test.post.as_deref())?),
                    false => forms.first().copied().filter(|_| forms.len() == 1),
                },
                _ => forms.iter().copied().find(|form| posts.get(*form).name == form_name),
            };
            match form {
                Some(form) => add(self, form, path.clone(), cycles, wanted),
                // the forms of the command line are those that are tried
                None if posts.are_named() => {}
                None => self.problems.push(no_form(path, form_name, &config)),
            }
        }
        if args.update && posts.are_named() {
            for &form in &forms {
                let expected = folder.join(format!("{head}{}.nc", posts.get(form).name));
                let is_there = |path: &PathBuf| beside.contains(path);
                if !is_there(&expected) && !is_there(&expected.with_extension("refused")) {
                    add(self, form, expected, Cycles::Form, Wanted::Nothing);
                    count += 1;
                }
            }
        }
        if count == 0 {
            let name = files::name(job);
            self.problems.push(format!(
                "{name} has no expected program beside it\n  help: `postform test --update --form FORM {name}` writes {head}FORM.nc"
            ));
        }
        Ok(())
    }
}

/// The jobs in a folder and in those below it, in the order of their paths; and the JSON files that do not begin as jobs do.
///
/// # Errors
/// A message: a folder can't be read.
pub fn jobs_in(folder: &Path) -> Result<(Vec<PathBuf>, Vec<PathBuf>), String> {
    let (mut jobs, mut others) = (Vec::new(), Vec::new());
    collect(folder, DEEPEST, &mut jobs, &mut others)?;
    Ok((jobs, others))
}

fn collect(folder: &Path, deeper: usize, jobs: &mut Vec<PathBuf>, others: &mut Vec<PathBuf>) -> Result<(), String> {
    let entries = listed(folder)?;
    let expected = jobs_expected(&entries);
    for path in &entries {
        // a compressed job is one; a link to nothing is one that can't be read
        let unpacked = unpacked_name(path);
        let is_there = path.is_file() || path.is_symlink() && !path.exists();
        if is_job(path, &expected) || unpacked.is_some_and(|name| is_there && is_named_as_job(&name)) {
            jobs.push(path.clone());
        } else if is_there && !is_expected(path) && Format::of_name(&path.to_string_lossy()) == Some(Format::Json) {
            others.push(path.clone());
        }
    }
    for folder in below(&entries).filter(|_| deeper > 0) {
        collect(folder, deeper - 1, jobs, others)?;
    }
    Ok(())
}

/// Is it called as jobs are? A program is one by its name `job` alone.
fn is_named_as_job(name: &Path) -> bool {
    match Format::of_name(&name.to_string_lossy()) {
        Some(Format::Nc) => name.file_stem().is_some_and(|stem| stem == "job"),
        format => format.is_some(),
    }
}

/// The folders among what stands in one.
fn below(entries: &[PathBuf]) -> impl Iterator<Item = &PathBuf> {
    entries.iter().filter(|path| {
        let is_hidden = path.file_name().is_some_and(|name| name.as_encoded_bytes().starts_with(b"."));
        // a link to a folder could lead back
        !is_hidden && path.symlink_metadata().is_ok_and(|meta| meta.is_dir())
    })
}

/// What stands in a folder, in the order of the names.
fn listed(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let fail = |error: std::io::Error| io_message("read", folder, &error);
    let entries: Result<Vec<PathBuf>, _> =
        fs::read_dir(folder).map_err(fail)?.map(|entry| entry.map(|entry| entry.path())).collect();
    let mut entries = entries.map_err(fail)?;
    entries.sort();
    Ok(entries)
}

/// Is it the program, or the error, that is expected of a job?
fn is_expected(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.starts_with("expected.") || name.contains(".expected.")
}

/// The name of the job to which an expected program belongs, without its ending.
fn stem_of_expected(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    name.split_once(".expected.").map_or("job".to_owned(), |(stem, _)| stem.to_owned())
}

/// The names of the jobs of which a folder has expected programs, without their endings.
fn jobs_expected(entries: &[PathBuf]) -> HashSet<String> {
    entries.iter().filter(|path| is_expected(path)).map(|path| stem_of_expected(path)).collect()
}

/// Is the file a job? JSON must look like one, unless it is called `job` or has expected programs; an NC program is one if it is
/// called `job`.
fn is_job(path: &Path, expected: &HashSet<String>) -> bool {
    if !path.is_file() || is_expected(path) {
        return false;
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let is_called_so = stem == "job" || expected.contains(stem.as_ref());
    match Format::of_name(&path.to_string_lossy()) {
        Some(Format::Nc) => stem == "job",
        Some(Format::Json) => is_called_so || looks_like_a_job(path),
        Some(_) => true,
        None => false,
    }
}

fn looks_like_a_job(path: &Path) -> bool {
    let mut head = Vec::new();
    let read = fs::File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    // what can't be read is said where it is read
    read.is_err() || String::from_utf8_lossy(&head).contains("\"postform\"")
}

fn no_form(expected: &Path, form: &str, config: &Config) -> String {
    let name = files::name(expected);
    if form.is_empty() {
        return format!("{name}: there is no form.pf beside it, and no one form under [test]");
    }
    let file = config.path.clone().map_or("a postform.toml".to_owned(), |path| files::name(&shortened(path)));
    format!(
        "{name}: there is no form called {form}\n  help: add its file to forms under [test] in {file}, or name it by --form"
    )
}

fn in_file(config: &Config, error: &str) -> String {
    let file = config.path.as_deref().map(files::name).unwrap_or_default();
    format!("error: {file}: {error}")
}
