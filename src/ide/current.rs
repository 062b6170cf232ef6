//! The current job: a job that is printed with the form in the editor.

use std::io::Cursor;

use super::Document;
use crate::diag::Diag;
use crate::error::Error;
use crate::job::Job;
use crate::lang::VarId;
use crate::post::{Followed, Options, Proof, Proven, Seen, sample_job};
use crate::render::TraceLine;
use crate::span::Span;
use crate::trace::Trace;
use crate::verify::Verdict;

/// A job that was printed with a form.
#[derive(Debug)]
pub struct Current {
    /// Name of the job, as it is displayed.
    pub name: String,
    text: String,
    /// Offset of each line of the text.
    starts: Vec<usize>,
    trace: Trace,
    seen: Vec<Seen>,
    notes: Vec<Diag>,
    stopped: Option<Error>,
    proven: Option<Proven>,
}

/// The blocks that a line of the form printed.
#[derive(Clone, Debug, PartialEq)]
pub struct Printed<'a> {
    /// Number of blocks.
    pub times: usize,
    /// The first blocks. Each block has its line in the program, from 1, and its text.
    pub first: Vec<(u64, &'a str)>,
}

impl Document {
    /// Prints a job with the form and verifies the program. `None`: the form has errors. If the job does not answer a prompt,
    /// the default of the prompt is used, or 1, so that a program can be printed.
    pub fn print(&self, name: &str, mut job: Job<'_>) -> Option<Current> {
        let post = self.post()?;
        let mut options = Options { shop_properties: self.properties.clone(), ..Options::default() };
        let mut followed = post.follow(job.again(), &options).ok()?;
        if followed.stopped.is_some() {
            // values of the job are kept; only missing values are added
            let set = post.prompts().map(|ask| (ask.variable.to_owned(), ask.default.unwrap_or(1.0))).collect();
            let answered = Options { program: Some(1), set, ..options.clone() };
            let again = post.follow(job.again(), &answered).ok().filter(|again| again.stopped.is_none());
            if let Some(again) = again {
                (options, followed) = (answered, again);
            }
        }
        let Followed { program, seen, stopped, .. } = followed;
        let proof = Proof::default();
        let proven = match stopped {
            None => post.verify_with(job.again(), Cursor::new(program.text()), &options, &proof).ok(),
            Some(_) => None,
        };
        let notes = program.notes().to_vec();
        let trace = Trace::new(program.trace().to_vec());
        let text = program.into_text();
        let starts = std::iter::once(0).chain(memchr::memchr_iter(b'\n', text.as_bytes()).map(|at| at + 1)).collect();
        Some(Current { name: name.to_owned(), text, starts, trace, seen, notes, stopped, proven })
    }

    /// Prints the built-in job with the form. The editor shows this job if the user names no other job.
    pub fn print_sample(&self) -> Option<Current> {
        let text = sample_job(&self.checked.form.settings);
        self.print("the sample job", Job::json(text))
    }
}

impl Current {
    /// The text of the program, as far as it was printed.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The text of a line of the program. Lines are counted from 1.
    pub fn block(&self, line: u64) -> &str {
        let at = (line as usize).saturating_sub(1);
        let Some(&start) = self.starts.get(at) else { return "" };
        self.text[start..].lines().next().unwrap_or("")
    }

    /// Number of lines of the program.
    pub fn lines(&self) -> usize {
        self.text.lines().count()
    }

    /// The form line and job item that printed a line of the program. Lines are counted from 1.
    pub fn origin(&self, line: u64) -> Option<&TraceLine> {
        self.trace.line(line)
    }

    /// The source map between program, form and job.
    pub fn trace(&self) -> &Trace {
        &self.trace
    }

    /// Warnings and notes about the job and its output.
    pub fn notes(&self) -> &[Diag] {
        &self.notes
    }

    /// The error that stopped the program before the end of the job, if any.
    pub fn stopped(&self) -> Option<&Error> {
        self.stopped.as_ref()
    }

    /// The verdict on the motions of the program; `None` if the program is not complete or the job can't be read.
    pub fn verdict(&self) -> Option<&Verdict> {
        self.proven.as_ref().map(|proven| &proven.verdict)
    }

    /// The result of printing the job in a few words, such as `119 blocks, proven`.
    pub fn outcome(&self) -> String {
        let blocks = match self.lines() {
            1 => "1 block".to_owned(),
            lines => format!("{lines} blocks"),
        };
        let first = |error: &Error| {
            let diag = error.findings().diags.iter().find(|diag| diag.is_error());
            diag.map_or_else(|| error.to_string(), |diag| format!("{}: {}", diag.code.name(), diag.message))
        };
        match (&self.stopped, self.verdict()) {
            (Some(error), _) => format!("stops after {blocks}: {}", first(error)),
            (None, Some(Verdict::Identical | Verdict::Equivalent(_))) => format!("{blocks}, proven"),
            (None, Some(Verdict::Different(found))) => {
                let why = found.first().map_or("", |finding| finding.message.as_str());
                format!("{blocks}, different from the job: {why}")
            }
            (None, Some(Verdict::NotProven(unproven))) => format!("{blocks}, not proven: {}", unproven.why),
            (None, _) => format!("{blocks}, not proven"),
        }
    }

    /// The number of blocks that the form lines in a span printed, and the first `most` of these blocks.
    pub fn printed(&self, span: Span, most: usize) -> Printed<'_> {
        let lines: Vec<u64> = self.trace.printed_by_form(span).collect();
        let first = lines.iter().take(most).map(|&line| (line, self.block(line))).collect();
        Printed { times: lines.len(), first }
    }

    /// The first block that a line of the form printed.
    pub fn seen(&self, line: Span) -> Option<&Seen> {
        self.seen.iter().find(|seen| touches(seen.form, line))
    }

    /// All lines of the form that printed a block.
    pub fn all_seen(&self) -> &[Seen] {
        &self.seen
    }

    /// The value of a variable when the first line in a span printed its first block, in the program's units.
    pub fn value(&self, within: Span, var: VarId) -> Option<f64> {
        self.seen(within)?.values.iter().find(|(own, _)| *own == var).map(|(_, value)| *value)
    }
}

fn touches(line: Span, span: Span) -> bool {
    line.file == span.file && line.start <= span.end && span.start <= line.end
}

#[cfg(test)]
mod tests {
    use super::super::document::tests::haas;
    use super::*;

    const JOB: &str = include_str!("../../samples/bracket/job.json");

    #[test]
    fn a_line_knows_what_it_printed() {
        let (document, offset) = haas("G[retplane] G81", "|G[retplane] G81");
        let current = document.print("bracket", Job::json(JOB)).unwrap();
        let line = Span { file: 0, start: offset, end: offset + 1 };
        let printed = current.printed(line, 1);
        assert!(printed.times > 1, "each hole is a block");
        let (number, block) = printed.first[0];
        assert!(block.contains("G81") && current.block(number) == block);
        assert_eq!(current.origin(number).and_then(|origin| origin.form).map(|form| form.start), Some(offset));
        assert!(current.value(line, VarId::Vclear).is_some());
        assert!(current.outcome().ends_with(" blocks, proven"), "{}", current.outcome());
    }

    #[test]
    fn a_form_with_errors_prints_nothing_and_a_wrong_job_stops_it() {
        assert!(haas("X[h]", "X[hh]").0.print_sample().is_none());
        let current = haas("", "").0.print("cut", Job::json(&JOB[..JOB.len() / 2])).unwrap();
        assert!(current.stopped().is_some() && current.outcome().starts_with("stops after "), "{}", current.outcome());
    }
}
