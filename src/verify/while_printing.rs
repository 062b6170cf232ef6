//! A proof beside the renderer, in one pass: events and text come as they are made, and neither is held.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::io::{self, Read, Seek, SeekFrom};
use std::rc::Rc;

use super::comparer::Comparer;
use super::expectation::Expectation;
use super::owned_event::Kept;
use super::report::Counts;
use super::verdict::Verdict;
use crate::diag::Diag;
use crate::nc::RunSettings;
use crate::render::TraceLine;
use crate::toolpath::{Event, Place, Sink};

/// What a renderer took and what it made of it, as far as both had come.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// Events, with their places in the job.
    pub events: Vec<(Kept, Place)>,
    /// Bytes of the program; a block may be in two batches.
    pub text: Vec<u8>,
    /// Which form line and which item of the job printed each line that ends in this text; may be left out.
    pub trace: Vec<TraceLine>,
}

impl AsRef<Batch> for Batch {
    fn as_ref(&self) -> &Batch {
        self
    }
}

impl Batch {
    /// Empties it, to be filled again.
    pub(crate) fn clear(&mut self) {
        self.events.clear();
        self.text.clear();
        self.trace.clear();
    }
}

/// How a proof came out.
#[derive(Clone, Debug)]
#[must_use]
pub struct Outcome {
    /// Does the program do what its job asks for?
    pub verdict: Verdict,
    /// How much was compared.
    pub counts: Counts,
    /// Warnings of the control.
    pub warnings: Vec<Diag>,
}

/// Proves a program while it is made. `batches` may be the end of a channel: it is asked for no more than is compared next,
/// and not at all once the verdict is known; each is dropped when it is compared. Before the program says its units they are
/// the job's if `of_job`, else those of `settings`.
///
/// A program that calls or repeats parts of itself is not proven: only a file can be gone back in
/// ([`Unproven::in_a_file`](super::Unproven::in_a_file)).
///
/// # Errors
/// None: text in memory can always be read.
pub fn prove_beside<B: AsRef<Batch>>(
    batches: impl Iterator<Item = B>,
    settings: RunSettings,
    expectation: Expectation,
    tolerance: Option<f64>,
    of_job: bool,
) -> io::Result<Outcome> {
    let queue =
        Queue { batches, events: VecDeque::new(), texts: VecDeque::new(), traces: VecDeque::new(), unread: false };
    let queue = Rc::new(RefCell::new(queue));
    let text = Text { queue: Rc::clone(&queue), batch: None, at: 0 };
    let mut comparer = Comparer::new(text, settings, expectation, tolerance);
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
            if let (Event::Start(start), true) = (&event, of_job) {
                comparer.begin_in(start.units);
            }
            let flow = comparer.event(event, *place);
            if comparer.found() > found {
                found = locate(&mut comparer);
            }
            if flow.is_break() {
                break 'job;
            }
        }
        // what stands between two cuts is run as it comes, not held until the job's next cut
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

/// How many batches of text wait for the job's next cut.
const MOST_TEXTS: usize = 4;

/// How many events wait for the text that they came to.
const MOST_WAITING: usize = 1 << 16;

/// Why a program is proven only where it can be gone back in, which has an end.
fn only_a_file(why: &'static str) -> io::Error {
    io::Error::new(io::ErrorKind::Unsupported, why)
}

/// What came and was not needed yet.
struct Queue<I: Iterator> {
    batches: I,
    /// Batches whose events wait.
    events: VecDeque<Rc<I::Item>>,
    /// Batches whose text waits.
    texts: VecDeque<Rc<I::Item>>,
    /// Where the lines of the texts came from: of those that wait, of the one that is run and of the one before it.
    traces: VecDeque<Rc<I::Item>>,
    /// No more text is read: the control refused a block, which is said at the job's next cut.
    unread: bool,
}

impl<I: Iterator<Item: AsRef<Batch>>> Queue<I> {
    /// Text is not needed any more.
    fn drop_texts(&mut self) {
        self.unread = true;
        self.texts.clear();
    }

    /// Takes the next batch in; `false`: there is none.
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
                return Err(only_a_file("the program prints nothing for a long part of the job"));
            }
        }
        let Some(batch) = self.texts.pop_front() else { return Ok(None) };
        while self.traces.len() > self.texts.len() + 2 {
            self.traces.pop_front();
        }
        Ok(Some(batch))
    }

    /// Where a line came from that was run not long ago.
    fn origin(&self, line: u64) -> Option<TraceLine> {
        let mut traces = self.traces.iter().map(|batch| &(**batch).as_ref().trace);
        let lines = traces.find(|lines| lines.last().is_some_and(|last| last.line >= line))?;
        lines.iter().find(|traced| traced.line == line).copied()
    }
}

/// The program as it comes.
struct Text<I: Iterator> {
    queue: Rc<RefCell<Queue<I>>>,
    /// The batch that is read.
    batch: Option<Rc<I::Item>>,
    /// How much of its text was read.
    at: usize,
}

impl<I: Iterator<Item: AsRef<Batch>>> Text<I> {
    /// What is there of the text.
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
        Err(only_a_file("the program calls or repeats parts of itself"))
    }
}
