//! The same for each of many jobs: which jobs they are, and what is shown of them.

use std::io::Write as _;
use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use super::each::each_in_order;
use super::folders::jobs_in;
use super::progress::Progress;
use super::report::count;
use super::say::{kept, message, say};
use super::{Ending, files, output};

/// Failed jobs that the last line names.
const MOST_NAMED: usize = 10;

/// The job that arguments name, where it is one and no folder.
pub fn single(paths: &[PathBuf]) -> Option<&Path> {
    match paths {
        [path] if !path.is_dir() => Some(path),
        _ => None,
    }
}

/// The jobs that arguments name: files, and in folders all jobs in them and below.
///
/// # Errors
/// A message: a folder can't be read, or has no job; or one of several is standard input.
pub fn jobs(paths: &[PathBuf]) -> Result<Vec<PathBuf>, String> {
    let mut jobs = Vec::new();
    for path in paths {
        if path == Path::new("-") {
            return Err("error: standard input is no job of several".into());
        }
        if !path.is_dir() {
            jobs.push(path.clone());
            continue;
        }
        let (found, others) = jobs_in(path)?;
        for other in others.iter().take(MOST_NAMED) {
            message(&format!("left out: {} has no \"postform\" at its beginning, as jobs have", files::name(other)));
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

/// Works on each item, several at a time. What `work` returns as text is written to standard output, its messages to standard
/// error, in the order of the items. An item that fails stops no other; `name` is what the last line calls it.
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
            let done = catch_unwind(AssertUnwindSafe(|| work(&item))).unwrap_or(Ok((String::new(), Ending::Broken)));
            done.unwrap_or_else(|error| {
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
