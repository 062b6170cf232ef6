//! Test cases in folders: jobs and their expected programs.

use std::fs;
use std::path::{Path, PathBuf};

use postform::internals::render::Cycles;

use super::super::args::TestArgs;
use super::super::clock;
use super::super::config::{Config, shortened};
use super::super::diff::ignored;
use super::super::files::{self, io_message};
use super::super::folders::{
    DEEPEST, below, is_expected, is_job, jobs_expected, listed, stem_of_expected, stem_of_job,
};
use super::case::{Case, Wanted};
use super::posts::Posts;

/// The result of the search.
#[derive(Default)]
pub struct Found {
    /// The cases, in the order of their paths.
    pub cases: Vec<Case>,
    /// Files that can't be a case, with the reason.
    pub problems: Vec<String>,
}

/// The date with which programs are printed, unless [test] sets another one: tests must not depend on the current date.
const DAY: &str = "2000-01-01T00:00";

impl Found {
    /// Adds the cases of a folder and its subfolders, or those of one job.
    ///
    /// # Errors
    /// A message: the path can't be read, or its postform.toml contains a value that makes no sense.
    pub fn search(&mut self, path: &Path, posts: &mut Posts, args: &TestArgs) -> Result<(), String> {
        let meta = fs::metadata(path).map_err(|error| io_message("read", path, &error))?;
        if meta.is_file() {
            let files = listed(files::folder(path))?;
            let name = files::name(path);
            if files::is_form(path) {
                return Err(format!(
                    "error: {name} is a form\n  help: `postform test FOLDER --form {name}` tests the form"
                ));
            }
            if is_expected(path) {
                return Err(format!("error: {name} is an expected program: give the job or the folder instead"));
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
            if let Some(other) = jobs[..at].iter().find(|other| stem_of_job(other) == stem_of_job(job)) {
                let (job, other) = (files::name(job), files::name(other));
                self.problems.push(format!(
                    "{job} and {other} would have the same expected programs\n  help: rename one of them"
                ));
                continue;
            }
            self.job(job, &entries, posts, args)?;
        }
        for path in entries.iter().filter(|path| is_expected(path)) {
            let stem = stem_of_expected(path);
            if !jobs.iter().any(|job| stem_of_job(job) == stem) {
                self.problems.push(format!("{} has no job: there is no {stem} in its folder", files::name(path)));
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
        let stem = stem_of_job(job);
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
            let message = format!("tolerance = {} under [test]: it must be 0 or more", config.test.tolerance);
            return Err(in_file(&config, &message));
        }
        let mut count = 0;
        let add = |found: &mut Found, form: usize, expected: PathBuf, cycles: Cycles, wanted: Wanted| {
            let (job, tolerance) = (job.to_path_buf(), config.test.tolerance);
            let is_new = !found.cases.iter().any(|case| case.expected == expected && case.form == form);
            if is_new {
                let clock = clock.clone();
                found.cases.push(Case { job, form, expected, cycles, wanted, ignore, tolerance, clock });
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
                    false if own_form.is_file() => Some(posts.entry(&own_form, &config)?),
                    false => forms.first().copied().filter(|_| forms.len() == 1),
                },
                _ => forms.iter().copied().find(|form| posts.get(*form).name == form_name),
            };
            match form {
                Some(form) => add(self, form, path.clone(), cycles, wanted),
                // with forms on the command line, only these forms are tested
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
                "{name} has no expected program in its folder\n  help: `postform test --update --form FORM {name}` \
                 writes {head}FORM.nc"
            ));
        }
        Ok(())
    }
}

fn no_form(expected: &Path, form: &str, config: &Config) -> String {
    let name = files::name(expected);
    if form.is_empty() {
        return format!("{name}: there is no form.pf in its folder, and [test] does not name exactly one form");
    }
    let file = config.path.clone().map_or("a postform.toml".to_owned(), |path| files::name(&shortened(path)));
    format!(
        "{name}: there is no form called {form}\n  help: add its file to forms under [test] in {file}, or give it \
         with --form"
    )
}

fn in_file(config: &Config, error: &str) -> String {
    let file = config.path.as_deref().map(files::name).unwrap_or_default();
    format!("error: {file}: {error}")
}
