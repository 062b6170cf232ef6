//! A proof beside the renderer, in one pass: events and text come as they are made, and neither is held.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::io::{self, BufRead, Read, Seek, SeekFrom};
use std::rc::Rc;

use super::comparer::Comparer;
use super::expectation::Expectation;
use super::kept::Kept;
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
/// and not at all once the verdict is known. Before the program says its units they are the job's if `of_job`, else those
/// of `settings`.
///
/// A program that calls or repeats parts of itself is not proven: only a file can be gone back in
/// ([`Unproven::in_a_file`](super::Unproven::in_a_file)).
///
/// # Errors
/// None: text in memory can always be read.
pub fn prove_beside(
    batches: impl Iterator<Item = Batch>,
    settings: RunSettings,
    expectation: Expectation,
    tolerance: Option<f64>,
    of_job: bool,
) -> io::Result<Outcome> {
    let queue = Queue { batches, events: VecDeque::new(), texts: VecDeque::new(), traces: VecDeque::new() };
    let queue = Rc::new(RefCell::new(queue));
    let text = Text { queue: Rc::clone(&queue), chunk: Vec::new(), at: 0 };
    let mut comparer = Comparer::new(text, settings, expectation, tolerance);
    let mut found = 0;
    'job: loop {
        let next = queue.borrow_mut().events();
        let Some(events) = next else { break };
        for (kept, place) in &events {
            let event = kept.event();
            if let (Event::Start(start), true) = (&event, of_job) {
                comparer.begin_in(start.units);
            }
            let flow = comparer.event(event, *place);
            if comparer.found() > found {
                found = comparer.found();
                let queue = queue.borrow();
                comparer.locate(|line| queue.origin(line));
            }
            if flow.is_break() {
                break 'job;
            }
        }
    }
    let (counts, warnings) = (comparer.counts(), comparer.warnings());
    Ok(Outcome { verdict: comparer.verdict()?, counts, warnings })
}

/// How many events wait for the text that they came to.
const MOST_WAITING: usize = 1 << 16;

/// Why a program is proven only where it can be gone back in, which has an end.
fn only_a_file(why: &'static str) -> io::Error {
    io::Error::new(io::ErrorKind::Unsupported, why)
}

/// What came and was not needed yet.
struct Queue<I> {
    batches: I,
    events: VecDeque<Vec<(Kept, Place)>>,
    texts: VecDeque<Vec<u8>>,
    /// Where the lines of the texts came from: of those that wait, of the one that is run and of the one before it.
    traces: VecDeque<Vec<TraceLine>>,
}

impl<I: Iterator<Item = Batch>> Queue<I> {
    /// Takes the next batch in; `false`: there is none.
    fn pull(&mut self) -> bool {
        let Some(batch) = self.batches.next() else { return false };
        if !batch.events.is_empty() {
            self.events.push_back(batch.events);
        }
        if !batch.text.is_empty() {
            self.texts.push_back(batch.text);
            self.traces.push_back(batch.trace);
        }
        true
    }

    /// The next events, as many as came at once.
    fn events(&mut self) -> Option<Vec<(Kept, Place)>> {
        while self.events.is_empty() && self.pull() {}
        self.events.pop_front()
    }

    fn text(&mut self) -> io::Result<Option<Vec<u8>>> {
        while self.texts.is_empty() && self.pull() {
            if self.events.iter().map(Vec::len).sum::<usize>() > MOST_WAITING {
                return Err(only_a_file("the program prints nothing for a long part of the job"));
            }
        }
        let Some(text) = self.texts.pop_front() else { return Ok(None) };
        while self.traces.len() > self.texts.len() + 2 {
            self.traces.pop_front();
        }
        Ok(Some(text))
    }

    /// Where a line came from that was run not long ago.
    fn origin(&self, line: u64) -> Option<TraceLine> {
        let lines = self.traces.iter().find(|lines| lines.last().is_some_and(|last| last.line >= line))?;
        lines.iter().find(|traced| traced.line == line).copied()
    }
}

/// The program as it comes.
struct Text<I> {
    queue: Rc<RefCell<Queue<I>>>,
    chunk: Vec<u8>,
    at: usize,
}

impl<I: Iterator<Item = Batch>> BufRead for Text<I> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        while self.at == self.chunk.len() {
            let Some(chunk) = self.queue.borrow_mut().text()? else { return Ok(&[]) };
            (self.chunk, self.at) = (chunk, 0);
        }
        Ok(&self.chunk[self.at..])
    }

    fn consume(&mut self, amount: usize) {
        self.at += amount;
    }
}

impl<I: Iterator<Item = Batch>> Read for Text<I> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.fill_buf()?.read(buffer)?;
        self.consume(count);
        Ok(count)
    }
}

impl<I> Seek for Text<I> {
    fn seek(&mut self, _: SeekFrom) -> io::Result<u64> {
        Err(only_a_file("the program calls or repeats parts of itself"))
    }
}
