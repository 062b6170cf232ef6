//! The findings and counts of a comparison so far.

use super::finding::Finding;
use super::verdict::{Equivalences, Unproven};
use crate::diag::{Code, Diag};
use crate::toolpath;

/// The numbers of cuts and holes that were compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Number of cuts of the job outside holes.
    pub cuts: u64,
    /// Number of holes.
    pub holes: u64,
}

/// A difference to report. The report may already have a difference with the same cause.
pub(super) struct Difference<'a> {
    pub code: Code,
    pub help: &'static str,
    pub message: &'a dyn Fn() -> String,
    /// The program's line and its text.
    pub line: u64,
    pub block: &'a dyn Fn() -> String,
    pub place: toolpath::Place,
}

/// Findings, equivalences and counts.
#[derive(Debug, Default)]
pub(super) struct Report {
    pub findings: Vec<Finding>,
    pub allowed: Equivalences,
    pub counts: Counts,
    /// The job's item.
    pub place: toolpath::Place,
    pub unproven: Option<Unproven>,
    /// The fault in the job that ended the comparison.
    pub wrong: Option<Box<Diag>>,
    /// Whether the job was compared to its end.
    pub finished: bool,
}

impl Report {
    /// Whether the verdict is already known.
    pub fn is_decided(&self) -> bool {
        !self.findings.is_empty() || self.unproven.is_some()
    }

    /// The reason why the program is not proven. If the comparison did not reach the job's end, the program is not
    /// proven.
    pub fn unproven(&mut self) -> Option<Unproven> {
        if self.unproven.is_some() || self.finished {
            return self.unproven.take();
        }
        let (why, help) = match self.wrong.take() {
            Some(diag) => (diag.message, diag.help.unwrap_or_default()),
            None => ("the comparison stopped before the end of the job".into(), String::new()),
        };
        Some(Unproven { why, help, place: Some(self.place), ..Unproven::default() })
    }

    /// Adds a difference. If the report has a difference with the same cause, only the count of this difference
    /// increases.
    pub fn add(&mut self, difference: &Difference<'_>) {
        let known = self.findings.iter_mut();
        let Difference { code, help, line, place, .. } = *difference;
        match known.into_iter().find(|finding| finding.code == code && finding.help == help) {
            Some(finding) => finding.times += 1,
            None => {
                let (message, block) = ((difference.message)(), (difference.block)());
                let place = Some(place);
                self.findings.push(Finding { code, message, help, place, line, block, form: None, times: 1 });
            }
        }
    }
}
