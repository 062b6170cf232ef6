//! Runs a command for each of many jobs: the list of jobs, and the output about them.

use std::io::Write as _;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use super::each::each_in_order;
use super::folders::jobs_in;
use super::progress::Progress;
use super::report::count;
use super::say::{kept, message, say};
use super::{Ending, files, output};

/// Maximum number of failed jobs named in the last line.
const MOST_NAMED: usize = 10;

/// The job in the arguments, if the arguments name a single file.
pub fn single(paths: &[PathBuf]) -> Option<&Path> {
    match paths {
        [path] if !path.is_dir() => Some(path),
        _ => None,
    }
}

/// The jobs in the arguments: files, and all jobs in folders and their subfolders.
///
/// # Errors
/// A message: a folder can't be read or contains no job, or one of several jobs is standard input.
pub fn jobs(paths: &[PathBuf]) -> Result<Vec<PathBuf>, String> {
    let mut jobs = Vec::new();
    for path in paths {
        if path == Path::new("-") {
            return Err("error: standard input can't be one of several jobs".into());
        }
        if !path.is_dir() {
            jobs.push(path.clone());
            continue;
        }
        let (found, others) = jobs_in(path)?;
        for other in others.iter().take(MOST_NAMED) {
            message(&format!("left out: {} is not a job: a job begins with \"postform\"", files::name(other)));
        }
        if others.len() > MOST_NAMED {
            message(&format!("left out: {} more", others.len() - MOST_NAMED));
        }
        if found.is_empty() {
            return Err(format!("error: there is no job in {}", files::name(path)));
        }
        jobs.extend(found);
    }
    Ok(jobs)
}

/// Works on each item, several at a time. The text that `work` returns goes to standard output. The messages of `work`
/// go to standard error. Both are in the order of the items. A failing item does not stop the others; the last line of
/// the output contains the `name` of the failing item.
///
/// # Errors
/// Standard output can't be written.
pub fn run<T: Send>(
    threads: Option<NonZeroUsize>,
    items: Vec<T>,
    name: impl Fn(&T) -> String + Sync,
    what: &str,
    work: impl Fn(&T) -> Result<(String, Ending), String> + Sync,
) -> Result<Ending, String> {
    let total = items.len();
    let progress = Progress::of(total as u64);
    let (mut failed, mut worst, mut written) = (Vec::new(), Ending::Clean, Ok(()));
    let one = |item: T| {
        let (done, messages) = kept(|| {
            work(&item).unwrap_or_else(|error| {
                message(&error);
                (String::new(), Ending::Failed)
            })
        });
        (name(&item), done, messages)
    };
    each_in_order(threads, items, one, |(name, (text, ending), messages): (String, (String, Ending), String)| {
        progress.hidden(|| {
            say(&messages);
            if written.is_ok() && !text.is_empty() {
                written = output::standard_output(|out| out.write_all(text.as_bytes()));
            }
        });
        progress.one();
        if ending == Ending::Broken {
            worst = Ending::Broken;
        } else if ending != Ending::Clean && worst == Ending::Clean {
            worst = Ending::Findings;
        }
        if ending != Ending::Clean {
            failed.push(name);
        }
    });
    drop(progress);
    written?;
    let mut sentence = count(total, what);
    if failed.is_empty() {
        sentence += ", none failed";
    } else {
        let names = failed.iter().take(MOST_NAMED).map(String::as_str).collect::<Vec<_>>().join(", ");
        let more = failed.len().saturating_sub(MOST_NAMED);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        sentence += &format!(", {} failed: {names}{more}", failed.len());
    }
    message(&sentence);
    Ok(worst)
}
