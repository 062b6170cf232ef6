//! A proof beside the renderer, in one pass: events and text come as they are made, and neither is held.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::io::{self, BufRead, Read, Seek, SeekFrom};
use std::rc::Rc;

use super::comparer::Comparer;
use super::expectation::Expectation;
use super::finding::Verdict;
use super::report::Counts;
use crate::diag::Diag;
use crate::nc::RunSettings;
use crate::toolpath::{Arc, Call, CycleSpec, Event, Infeed, Place, Sink, Start, Thread, ToolChange};

/// What a renderer takes and makes, in its order: one event of the job, or some bytes of the program.
#[derive(Clone, Debug)]
pub enum Part {
    /// An event, with its place in the job.
    Event(Kept, Place),
    /// Bytes that the events so far came to; a block may be in two of them.
    Text(Vec<u8>),
}

/// An event that outlives its reader, so that it can go to another thread.
#[derive(Clone, Debug)]
pub struct Kept(Own);

#[derive(Clone, Debug)]
enum Own {
    Start(Box<Start>),
    ToolChange(Box<ToolChange>),
    Arc(Arc, Option<f64>),
    Infeed(Infeed, Option<f64>),
    Cycle(Box<CycleSpec>),
    Comment(Box<str>),
    Text(Box<str>),
    Set(Box<str>, f64),
    Call(Call),
    Thread(Box<Thread>),
    Plain(Event<'static>),
}

impl From<&Event<'_>> for Kept {
    fn from(event: &Event<'_>) -> Kept {
        Kept(match *event {
            Event::Start(start) => Own::Start(Box::new(start.clone())),
            Event::ToolChange(change) => Own::ToolChange(Box::new(change.clone())),
            Event::Arc { arc, feed } => Own::Arc(*arc, feed),
            Event::Infeed { infeed, feed } => Own::Infeed(*infeed, feed),
            Event::CycleBegin(spec) => Own::Cycle(Box::new(spec.clone())),
            Event::Comment(text) => Own::Comment(text.into()),
            Event::Text(text) => Own::Text(text.into()),
            Event::Set(name, value) => Own::Set(name.into(), value),
            Event::SubCall(call) => Own::Call(*call),
            Event::Thread(thread) => Own::Thread(Box::new(*thread)),
            Event::Rapid(to) => Own::Plain(Event::Rapid(to)),
            Event::Line { to, feed } => Own::Plain(Event::Line { to, feed }),
            Event::Outfeed { to, feed, rapid } => Own::Plain(Event::Outfeed { to, feed, rapid }),
            Event::Tilt(axis) => Own::Plain(Event::Tilt(axis)),
            Event::Begin(section) => Own::Plain(Event::Begin(section)),
            Event::End(section) => Own::Plain(Event::End(section)),
            Event::Hole(hole) => Own::Plain(Event::Hole(hole)),
            Event::CycleEnd => Own::Plain(Event::CycleEnd),
            Event::Dwell(seconds) => Own::Plain(Event::Dwell(seconds)),
            Event::Stop(kind) => Own::Plain(Event::Stop(kind)),
            Event::Feed(feed) => Own::Plain(Event::Feed(feed)),
            Event::Work(work) => Own::Plain(Event::Work(work)),
            Event::Spindle(spindle) => Own::Plain(Event::Spindle(spindle)),
            Event::Coolant(coolant) => Own::Plain(Event::Coolant(coolant)),
            Event::SubStart(number) => Own::Plain(Event::SubStart(number)),
            Event::SubEnd => Own::Plain(Event::SubEnd),
            Event::Edm(action) => Own::Plain(Event::Edm(action)),
            Event::Finish => Own::Plain(Event::Finish),
        })
    }
}

impl Kept {
    /// The event as it was.
    pub fn event(&self) -> Event<'_> {
        match &self.0 {
            Own::Start(start) => Event::Start(start),
            Own::ToolChange(change) => Event::ToolChange(change),
            Own::Arc(arc, feed) => Event::Arc { arc, feed: *feed },
            Own::Infeed(infeed, feed) => Event::Infeed { infeed, feed: *feed },
            Own::Cycle(spec) => Event::CycleBegin(spec),
            Own::Comment(text) => Event::Comment(text),
            Own::Text(text) => Event::Text(text),
            Own::Set(name, value) => Event::Set(name, *value),
            Own::Call(call) => Event::SubCall(call),
            Own::Thread(thread) => Event::Thread(thread),
            Own::Plain(event) => event.clone(),
        }
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

/// Proves a program while it is made. `parts` may be the end of a channel: it is asked for no more than is compared next,
/// and not at all once the verdict is known. Before the program says its units they are the job's if `of_job`, else those
/// of `settings`.
///
/// A program that calls or repeats parts of itself is not proven: only a file can be gone back in.
///
/// # Errors
/// None that `parts` does not have: text in memory can always be read.
pub fn prove_beside(
    parts: impl Iterator<Item = Part>,
    settings: RunSettings,
    expectation: Expectation,
    tolerance: Option<f64>,
    of_job: bool,
) -> io::Result<Outcome> {
    let queue = Rc::new(RefCell::new(Queue { parts, events: VecDeque::new(), texts: VecDeque::new() }));
    let text = Text { queue: Rc::clone(&queue), chunk: Vec::new(), at: 0 };
    let mut comparer = Comparer::new(text, settings, expectation, tolerance);
    loop {
        let next = queue.borrow_mut().event();
        let Some((kept, place)) = next else { break };
        if let (Event::Start(start), true) = (kept.event(), of_job) {
            comparer.begin_in(start.units);
        }
        if comparer.event(kept.event(), place).is_break() {
            break;
        }
    }
    let (counts, warnings) = (comparer.counts(), comparer.warnings());
    Ok(Outcome { verdict: comparer.verdict()?, counts, warnings })
}

/// What came and was not needed yet.
struct Queue<I> {
    parts: I,
    events: VecDeque<(Kept, Place)>,
    texts: VecDeque<Vec<u8>>,
}

impl<I: Iterator<Item = Part>> Queue<I> {
    /// Takes the next part in; `false`: there is none.
    fn pull(&mut self) -> bool {
        match self.parts.next() {
            Some(Part::Event(kept, place)) => self.events.push_back((kept, place)),
            Some(Part::Text(text)) => self.texts.push_back(text),
            None => return false,
        }
        true
    }

    fn event(&mut self) -> Option<(Kept, Place)> {
        while self.events.is_empty() && self.pull() {}
        self.events.pop_front()
    }

    fn text(&mut self) -> Option<Vec<u8>> {
        while self.texts.is_empty() && self.pull() {}
        self.texts.pop_front()
    }
}

/// The program as it comes.
struct Text<I> {
    queue: Rc<RefCell<Queue<I>>>,
    chunk: Vec<u8>,
    at: usize,
}

impl<I: Iterator<Item = Part>> BufRead for Text<I> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        while self.at == self.chunk.len() {
            let Some(chunk) = self.queue.borrow_mut().text() else { return Ok(&[]) };
            (self.chunk, self.at) = (chunk, 0);
        }
        Ok(&self.chunk[self.at..])
    }

    fn consume(&mut self, amount: usize) {
        self.at += amount;
    }
}

impl<I: Iterator<Item = Part>> Read for Text<I> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.fill_buf()?.read(buffer)?;
        self.consume(count);
        Ok(count)
    }
}

impl<I> Seek for Text<I> {
    fn seek(&mut self, _: SeekFrom) -> io::Result<u64> {
        Err(io::ErrorKind::Unsupported.into())
    }
}
