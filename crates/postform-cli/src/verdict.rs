//! The result of a proof, as text for people.

use std::path::Path;

use postform::diag::{Diag, Severity};
use postform::internals::source::Source;
use postform::internals::verify::{Finding, Verdict};
use postform::{Error, ErrorKind, Proven};

use super::Ending;
use super::report::{self, Reporter, place_in, place_in_jobs, stopped};
use super::say::say;

/// The two sides of a proof.
pub struct Sides<'a> {
    /// The job, or the joined jobs.
    pub jobs: &'a [&'a Path],
    /// The name of the program.
    pub program: &'a str,
    /// The form's files, if there is a form.
    pub files: &'a [Source],
}

impl Sides<'_> {
    /// Shows the warnings of a proof and returns the proof. If the proof failed, shows the error and returns the end of
    /// the command.
    ///
    /// # Errors
    /// A message: job or program can't be read.
    pub fn tried(
        &self,
        proven: Result<Proven, Error>,
        quiet: bool,
        reporter: &Reporter,
    ) -> Result<Result<Proven, Ending>, String> {
        let mut warnings = match &proven {
            Ok(proven) => proven.warnings.clone(),
            Err(error) => error.findings().diags.iter().filter(|diag| !diag.is_error()).cloned().collect(),
        };
        if !quiet {
            warnings.iter_mut().for_each(|diag| place_in(self.program, diag));
            say(&reporter.text(&warnings, &[]));
        }
        match proven {
            Ok(proven) => Ok(Ok(proven)),
            Err(error) => {
                let program = [Path::new(self.program)];
                let failed = if error.kind() == ErrorKind::Program { &program } else { self.jobs };
                stopped(error, failed, reporter, &[]).map(Err)
            }
        }
    }

    /// Shows findings with three locations: the job item, the form line, the program block.
    pub fn show(&self, findings: &[Finding], severity: Severity, reporter: &Reporter) {
        let diags: Vec<Diag> = findings.iter().map(|finding| self.diag(finding, severity)).collect();
        say(&reporter.text(&diags, self.files));
    }

    /// Shows findings in one line each, like the findings of a form; `command` shows the findings that are left out.
    pub fn brief(&self, findings: &[Finding], command: &str) {
        let diags = findings.iter().map(|finding| {
            let mut diag = self.diag(finding, Severity::Note);
            diag.message.truncate(diag.message.find('\n').unwrap_or(diag.message.len()));
            diag
        });
        say(&report::brief(&diags.collect::<Vec<_>>(), self.files, command));
    }

    fn diag(&self, finding: &Finding, severity: Severity) -> Diag {
        let mut diag = finding.diag(self.program);
        diag.severity = severity;
        place_in_jobs(self.jobs, &mut diag);
        diag
    }

    /// The verdict in a sentence.
    pub fn sentence(&self, proven: &Proven) -> String {
        let Sides { program, jobs, .. } = self;
        let job = report::names(jobs);
        let counts = proven.counts;
        let compared =
            format!("{}, {}", report::count(counts.cuts as usize, "cut"), report::count(counts.holes as usize, "hole"));
        match &proven.verdict {
            Verdict::Identical => format!("identical: {program} makes the motions of {job} ({compared})\n"),
            Verdict::Equivalent(other) => {
                format!("equivalent: {program} makes the cuts of {job} ({compared}): {other}\n")
            }
            Verdict::Different(findings) => {
                let found = report::count(findings.len(), "finding");
                format!("different: {program} does not make the motions of {job}: {found}\n")
            }
            other => format!("{other}\n"),
        }
    }

    /// The verdict as JSON for other programs.
    pub fn document(&self, proven: &Proven) -> serde_json::Value {
        postform::internals::report::proof(
            &proven.verdict,
            proven.counts,
            [&report::names(self.jobs), self.program],
            self.files,
        )
    }
}
