//! A program in an unnamed temporary file, for a comparison or for random access.

use std::fs::File;
use std::io::Write;
use std::path::Path;

use postform::diag::{Diag, Severity};
use postform::internals::render::TraceLine;
use postform::{ErrorKind, Job, Options};

use super::Ending;
use super::files::io_message;
use super::prepare::Prepared;
use super::report::{Reporter, place_in_jobs, stopped};
use super::say::say;
use super::spool::Spool;

/// Renders the job into an unnamed temporary file; `trace`: also returns the origin of each line. The inner `Err`:
/// rendering failed, and the reason has been shown.
pub fn rendered(
    job: &mut Job<'_>,
    jobs: &[&Path],
    prepared: &Prepared,
    trace: bool,
    reporter: &Reporter,
) -> Result<Result<(File, Vec<TraceLine>), Ending>, String> {
    let fail = |error: &std::io::Error| io_message("write", Path::new("the program"), error);
    let mut file = Spool::new().map_err(|error| fail(&error))?;
    let mut lines = Vec::new();
    let mut options: Options = prepared.options.clone();
    options.trace = trace;
    let printed = prepared.post.render_parts(job.again(), &options, &mut |part| {
        lines.extend_from_slice(part.trace);
        file.write_all(part.text)
    });
    let rendered = match printed {
        Ok(rendered) => rendered,
        Err(error) => {
            return match (error.kind(), error.io()) {
                (ErrorKind::Output, Some(error)) => Err(fail(error)),
                _ => stopped(error, jobs, reporter, prepared.post.files()).map(Err),
            };
        }
    };
    if denied(&rendered.notes, jobs, prepared, reporter) {
        return Ok(Err(Ending::Findings));
    }
    Ok(Ok((file.into_file().map_err(|error| fail(&error))?, lines)))
}

/// Shows the warnings of job and renderer if warnings are denied. Returns whether there are denied warnings.
pub fn denied(notes: &[Diag], jobs: &[&Path], prepared: &Prepared, reporter: &Reporter) -> bool {
    let warnings = notes.iter().filter(|diag| diag.severity == Severity::Warning);
    let mut notes: Vec<Diag> = warnings.cloned().collect();
    if !prepared.denies || notes.is_empty() {
        return false;
    }
    notes.iter_mut().for_each(|diag| place_in_jobs(jobs, diag));
    say(&reporter.text(&notes, prepared.post.files()));
    true
}
