//! A proof that runs in parallel with the renderer, in one pass. Events and text are compared as soon as the renderer
//! produces them, and are not kept in memory.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::io::{self, Read, Seek, SeekFrom};
use std::rc::Rc;

use super::comparer::Comparer;
use super::expectation::Expectation;
use super::report::Counts;
use super::verdict::Verdict;
use crate::diag::Diag;
use crate::nc::RunSettings;
use crate::render::TraceLine;
use crate::toolpath::{Kept, Place, Sink};

/// A batch of events that the renderer processed, and the text that it printed for these events.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// Events, each with its location in the job.
    pub events: Vec<(Kept, Place)>,
    /// Bytes of the program. A block may extend over two batches.
    pub text: Vec<u8>,
    /// For each line that ends in this text: the form line and the item of the job. May be empty.
    pub trace: Vec<TraceLine>,
}

impl AsRef<Batch> for Batch {
    fn as_ref(&self) -> &Batch {
        self
    }
}

impl Batch {
    /// Empties the batch for reuse.
    pub(crate) fn clear(&mut self) {
        self.events.clear();
        self.text.clear();
        self.trace.clear();
    }
}

/// The result of a proof.
#[derive(Clone, Debug)]
#[must_use]
pub struct Outcome {
    /// The verdict on the program.
    pub verdict: Verdict,
    /// Counts of what was compared.
    pub counts: Counts,
    /// Warnings of the control.
    pub warnings: Vec<Diag>,
}

/// Proves a program while it is printed. `batches` may be the receiving end of a channel. A batch is requested only
/// when the comparison needs it. No batch is requested after the verdict is known. Each batch is dropped as soon as it
/// is compared. Until the program sets its units, it is read in the job's units if `of_job`, otherwise in the units of
/// `settings`.
///
/// A program that calls or repeats parts of itself is not proven, because only a file can be read again
/// ([`Unproven::in_a_file`](super::Unproven::in_a_file)).
///
/// # Errors
/// Never fails: text in memory can always be read.
pub fn prove_beside<B: AsRef<Batch>>(
    batches: impl Iterator<Item = B>,
    settings: RunSettings,
    expectation: Expectation,
    tolerance: Option<f64>,
    in_units_of_job: bool,
) -> io::Result<Outcome> {
    let queue =
        Queue { batches, events: VecDeque::new(), texts: VecDeque::new(), traces: VecDeque::new(), unread: false };
    let queue = Rc::new(RefCell::new(queue));
    let text = Text { queue: Rc::clone(&queue), batch: None, at: 0 };
    let mut comparer = Comparer::new(text, settings, expectation, tolerance, in_units_of_job);
    let mut found = 0;
    let locate = |comparer: &mut Comparer<'_>| {
        let queue = queue.borrow();
        comparer.locate(|line| queue.origin(line));
        comparer.found()
    };
    'job: loop {
        let next = queue.borrow_mut().events();
        let Some(batch) = next else { break };
        for (kept, place) in &(*batch).as_ref().events {
            let event = kept.event();
            let flow = comparer.event(event, *place);
            if comparer.found() > found {
                found = locate(&mut comparer);
            }
            if flow.is_break() {
                break 'job;
            }
        }
        // run the text between two cuts when it arrives, without waiting for the job's next cut
        comparer.run_on(&|| queue.borrow().texts.len() > MOST_TEXTS);
        if comparer.found() > found {
            found = locate(&mut comparer);
        }
        if comparer.is_stuck() {
            queue.borrow_mut().drop_texts();
        }
    }
    let (counts, warnings) = (comparer.counts(), comparer.warnings());
    Ok(Outcome { verdict: comparer.verdict()?, counts, warnings })
}

/// Number of text batches that may wait for the job's next cut.
const MOST_TEXTS: usize = 4;

/// The largest number of events that wait for the text printed for these events.
const MOST_WAITING: usize = 1 << 16;

/// The error for a program that can be proven only from a file, because the input must have an end and allow seeking.
fn only_a_file(why: &'static str) -> io::Error {
    io::Error::new(io::ErrorKind::Unsupported, why)
}

/// Batches that were received and are still in use.
struct Queue<I: Iterator> {
    batches: I,
    /// Batches whose events are still to be compared.
    events: VecDeque<Rc<I::Item>>,
    /// Batches whose text is still to be run.
    texts: VecDeque<Rc<I::Item>>,
    /// Batches with the origins of lines: the batch that is being run, the batch before this one, and all later
    /// batches.
    traces: VecDeque<Rc<I::Item>>,
    /// Whether the rest of the text is ignored because the control refused a block. The refusal is reported at the job's next cut.
    unread: bool,
}

impl<I: Iterator<Item: AsRef<Batch>>> Queue<I> {
    /// Drops all text that waits to be run, because the comparison no longer needs it.
    fn drop_texts(&mut self) {
        self.unread = true;
        self.texts.clear();
    }

    /// Receives the next batch. Returns `false` if there is no further batch.
    fn pull(&mut self) -> bool {
        let Some(batch) = self.batches.next().map(Rc::new) else { return false };
        let Batch { events, text, .. } = (*batch).as_ref();
        if !events.is_empty() {
            self.events.push_back(Rc::clone(&batch));
        }
        if !text.is_empty() && !self.unread {
            self.texts.push_back(Rc::clone(&batch));
            self.traces.push_back(batch);
        }
        true
    }

    /// The next batch with events.
    fn events(&mut self) -> Option<Rc<I::Item>> {
        while self.events.is_empty() && self.pull() {}
        self.events.pop_front()
    }

    /// The next batch with text.
    fn text(&mut self) -> io::Result<Option<Rc<I::Item>>> {
        while self.texts.is_empty() && self.pull() {
            if self.events.iter().map(|batch| (**batch).as_ref().events.len()).sum::<usize>() > MOST_WAITING {
                return Err(only_a_file("the form prints nothing for a long part of the job"));
            }
        }
        let Some(batch) = self.texts.pop_front() else { return Ok(None) };
        while self.traces.len() > self.texts.len() + 2 {
            self.traces.pop_front();
        }
        Ok(Some(batch))
    }

    /// For a line that was run recently: the form line that printed it, and the item of the job.
    fn origin(&self, line: u64) -> Option<TraceLine> {
        let mut traces = self.traces.iter().map(|batch| &(**batch).as_ref().trace);
        let lines = traces.find(|lines| lines.last().is_some_and(|last| last.line >= line))?;
        lines.iter().find(|traced| traced.line == line).copied()
    }
}

/// The program's text, read while the renderer prints it.
struct Text<I: Iterator> {
    queue: Rc<RefCell<Queue<I>>>,
    /// The batch that is being read.
    batch: Option<Rc<I::Item>>,
    /// Number of bytes of the batch that were already read.
    at: usize,
}

impl<I: Iterator<Item: AsRef<Batch>>> Text<I> {
    /// The part of the batch that is not read yet.
    fn rest(&self) -> &[u8] {
        self.batch.as_ref().map_or(&[], |batch| &(**batch).as_ref().text[self.at..])
    }
}

impl<I: Iterator<Item: AsRef<Batch>>> Read for Text<I> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        while self.rest().is_empty() {
            self.batch = None;
            let Some(next) = self.queue.borrow_mut().text()? else { return Ok(0) };
            (self.batch, self.at) = (Some(next), 0);
        }
        let count = self.rest().read(buffer)?;
        self.at += count;
        Ok(count)
    }
}

impl<I: Iterator> Seek for Text<I> {
    fn seek(&mut self, _: SeekFrom) -> io::Result<u64> {
        Err(only_a_file("the program contains calls or repeats"))
    }
}
