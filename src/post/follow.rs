//! Prints a job and records what each line of the form prints. Editors use this record.

use std::collections::HashMap;
use std::sync::Arc;

use super::Post;
use super::options::Options;
use super::program::{Program, Rendered};
use super::reading::read_for;
use crate::error::Error;
use crate::job::Job;
use crate::lang::{VARIABLES, VarId};
use crate::render::{self, Renderer, TraceLine, TraceWord};
use crate::span::Span;
use crate::toolpath::{Event, Flow, Place, Sink};
use crate::verify::Verdict;

/// A program, and what each line of the form printed.
#[derive(Debug)]
pub struct Followed {
    /// The program as far as it was printed, with its source map.
    pub program: Program,
    /// The lines of the form that printed, in the order of the program.
    pub seen: Vec<Seen>,
    /// The error that ended the program before the end of the job, if any.
    pub stopped: Option<Error>,
}

/// A line of the form and the first block that it printed.
#[derive(Clone, Debug)]
pub struct Seen {
    /// The line of the form.
    pub form: Span,
    /// The line of the program, from 1.
    pub line: u64,
    /// What the words of the line printed, in their order.
    pub words: Vec<TraceWord>,
    /// The values of variables in the program's units. Variables without a value are not in the list.
    pub values: Vec<(VarId, f64)>,
}

impl Post {
    /// Prints a job and records what each line of the form prints. If an error ends the program, the part before the
    /// error is kept, because the author of a form needs this part.
    ///
    /// # Errors
    /// An option is invalid.
    pub(crate) fn follow(&self, mut job: Job<'_>, options: &Options) -> Result<Followed, Error> {
        let mut asked = render::Options { trace: true, words: true, ..options.for_renderer(&self.0.program.settings)? };
        if self.may_read_twice(options)? {
            job.hold()?;
            let only_order = !self.reads_ahead(options)?;
            asked.survey = Some(Arc::new(self.surveyed(&mut job, options, only_order).1));
        }
        let mut follower = Follower {
            renderer: Renderer::new(&self.0.program, asked),
            text: Vec::new(),
            trace: Vec::new(),
            seen: Vec::new(),
            known: HashMap::new(),
        };
        let read = read_for(Some(&self.0.program.settings), &mut job, &mut follower);
        follower.look();
        let report = job.take_report();
        let (mut notes, left_out) = (report.warnings, report.left_out);
        notes.extend_from_slice(follower.renderer.notes());
        let (lines, file_name) = (follower.renderer.lines(), follower.renderer.file_name());
        let rendered = Rendered { notes, left_out, lines, file_name };
        let text = String::from_utf8_lossy(&follower.text).into_owned();
        let verdict = Verdict::not_asked_for();
        let program = Program { text, rendered, trace: follower.trace, verdict };
        Ok(Followed { program, seen: follower.seen, stopped: read.err() })
    }
}

struct Follower<'p> {
    renderer: Renderer<'p>,
    text: Vec<u8>,
    trace: Vec<TraceLine>,
    seen: Vec<Seen>,
    /// For each line of the form, its index in `seen`.
    known: HashMap<Span, usize>,
}

impl Follower<'_> {
    /// Records what was printed since the last call of this function.
    fn look(&mut self) {
        if self.renderer.text().is_empty() {
            return;
        }
        self.text.append(self.renderer.text());
        let lines = self.renderer.trace().map(std::mem::take).unwrap_or_default();
        let mut words = self.renderer.words().map(std::mem::take).unwrap_or_default();
        for line in &lines {
            let Some(form) = line.form.filter(|form| !self.known.contains_key(form)) else { continue };
            let own = |word: &TraceWord| word.line == line.line && within(word.form, form);
            let (mut own, rest): (Vec<_>, Vec<_>) = words.into_iter().partition(own);
            words = rest;
            // if the line ran before without printing a block, its words from that run come first and are removed
            own.reverse();
            own.sort_by_key(|word| word.form.start);
            own.dedup_by_key(|word| word.form);
            self.known.insert(form, self.seen.len());
            let held = |row: &'static crate::lang::Variable| Some((row.id, self.renderer.value(row.id)?));
            let values = VARIABLES.iter().filter_map(held).collect();
            self.seen.push(Seen { form, line: line.line, words: own, values });
        }
        self.trace.extend(lines);
    }
}

fn within(word: Span, line: Span) -> bool {
    word.file == line.file && line.start <= word.start && word.end <= line.end
}

impl Sink for Follower<'_> {
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        self.renderer.event(event, place)?;
        self.look();
        Flow::Continue(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::post::NoFiles;
    use crate::source::Source;

    const FORM: &str = include_str!("../../postforms/haas.pf");
    const JOB: &str = include_str!("../../samples/bracket/job.json");

    #[test]
    fn what_a_line_came_to_is_what_the_program_says() {
        let post = Post::compile(Source::from_text("haas.pf", FORM), &NoFiles).unwrap();
        let followed = post.follow(Job::json(JOB), &Options::default()).unwrap();
        let plain = post.render(Job::json(JOB), &Options::default()).unwrap();
        assert_eq!(followed.program.text(), plain.text());
        assert!(followed.stopped.is_none());
        let lines: Vec<&str> = plain.text().lines().collect();
        assert!(followed.seen.len() > 20);
        for seen in &followed.seen {
            let block = lines[seen.line as usize - 1];
            for word in &seen.words {
                assert!(block.contains(&word.text), "{block}: {word:?}");
            }
        }
        let drill = followed.seen.iter().find(|seen| FORM[seen.form.range()].contains("G81")).unwrap();
        let words: Vec<&str> = drill.words.iter().map(|word| word.text.as_str()).collect();
        assert_eq!(words.join(" "), lines[drill.line as usize - 1].split_once(' ').unwrap().1);
        assert!(drill.values.iter().any(|(var, _)| *var == VarId::Vclear));
    }

    #[test]
    fn what_was_printed_before_an_error_is_kept() {
        let post = Post::compile(Source::from_text("haas.pf", FORM), &NoFiles).unwrap();
        let cut = &JOB[..JOB.len() * 2 / 3];
        let followed = post.follow(Job::json(cut), &Options::default()).unwrap();
        assert!(followed.stopped.is_some() && followed.program.text().lines().count() > 5);
    }
}
