//! Finds the jobs in a folder.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use postform::Format;

use super::files::io_message;
use super::job_format::{beginning, format_of_name};
use super::packed::unpacked_name;

/// Maximum depth of subfolders. Deeper subfolders are skipped.
pub const DEEPEST: usize = 32;

/// The jobs in a folder and its subfolders, in the order of their paths; and the JSON files that do not begin like a job.
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
        if is_job(path, &expected) {
            jobs.push(path.clone());
        } else if path.is_file() && !is_expected(path) && format_of_name(path) == Some(Format::Json) {
            others.push(path.clone());
        }
    }
    for folder in below(&entries).filter(|_| deeper > 0) {
        collect(folder, deeper - 1, jobs, others)?;
    }
    Ok(())
}

/// The folders among these entries.
pub fn below(entries: &[PathBuf]) -> impl Iterator<Item = &PathBuf> {
    entries.iter().filter(|path| {
        let is_hidden = path.file_name().is_some_and(|name| name.as_encoded_bytes().starts_with(b"."));
        // a link to a folder could lead back to a folder above
        !is_hidden && path.symlink_metadata().is_ok_and(|meta| meta.is_dir())
    })
}

/// The entries of a folder, in the order of their names.
///
/// # Errors
/// A message: the folder can't be read.
pub fn listed(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let fail = |error: std::io::Error| io_message("read", folder, &error);
    let entries: Result<Vec<PathBuf>, _> =
        fs::read_dir(folder).map_err(fail)?.map(|entry| entry.map(|entry| entry.path())).collect();
    let mut entries = entries.map_err(fail)?;
    entries.sort();
    Ok(entries)
}

/// Whether the file is an expected result: a program or an error.
pub fn is_expected(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.starts_with("expected.") || name.contains(".expected.")
}

/// The name of the job of an expected program, without its extension.
pub fn stem_of_expected(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    name.split_once(".expected.").map_or("job".to_owned(), |(stem, _)| stem.to_owned())
}

/// The names of the jobs with expected programs in a folder, without their extensions.
pub fn jobs_expected(entries: &[PathBuf]) -> HashSet<String> {
    entries.iter().filter(|path| is_expected(path)).map(|path| stem_of_expected(path)).collect()
}

/// The name of a job without its extension, and without the `.gz` of a compressed job.
pub fn stem_of_job(path: &Path) -> String {
    let name = unpacked_name(path);
    name.as_deref().unwrap_or(path).file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// Whether the file is a job. A JSON file must look like a job, be called `job`, or have an expected program. An NC
/// program must be called `job`. A broken link counts as a job that can't be read.
pub fn is_job(path: &Path, expected: &HashSet<String>) -> bool {
    let is_there = path.is_file() || path.is_symlink() && !path.exists();
    if !is_there || is_expected(path) {
        return false;
    }
    let stem = stem_of_job(path);
    match format_of_name(path) {
        Some(Format::Nc) => stem == "job",
        Some(Format::Json) => stem == "job" || expected.contains(&stem) || looks_like_a_job(path),
        Some(_) => true,
        None => false,
    }
}

fn looks_like_a_job(path: &Path) -> bool {
    // a read error is reported when the job is read
    beginning(path).map_or(true, |head| String::from_utf8_lossy(&head).contains("\"postform\""))
}
