//! Owned copies of events.

use super::{Arc, Call, CycleSpec, Event, Given, Infeed, Start, Thread, ToolChange};

/// An owned copy of an event. The copy can be kept or sent to another thread.
#[derive(Clone, Debug)]
pub struct Kept(Own);

/// Events with much data are boxed, because most events are straight moves and a copy should be small.
#[derive(Clone, Debug)]
enum Own {
    Start(Box<Start>),
    ToolChange(Box<ToolChange>),
    Arc(Box<Arc>, Option<f64>),
    Infeed(Infeed, Option<f64>),
    Cycle(Box<CycleSpec>),
    Comment(Box<str>),
    Text(Box<str>),
    Set(Box<str>, Box<Given>),
    Call(Box<Call>),
    Thread(Box<Thread>),
    Plain(Event<'static>),
}

impl From<&Event<'_>> for Kept {
    fn from(event: &Event<'_>) -> Kept {
        Kept(match *event {
            Event::Start(start) => Own::Start(Box::new(start.clone())),
            Event::ToolChange(change) => Own::ToolChange(Box::new(change.clone())),
            Event::Arc { arc, feed } => Own::Arc(Box::new(*arc), feed),
            Event::Infeed { infeed, feed } => Own::Infeed(*infeed, feed),
            Event::CycleBegin(spec) => Own::Cycle(Box::new(spec.clone())),
            Event::Comment(text) => Own::Comment(text.into()),
            Event::Text(text) => Own::Text(text.into()),
            Event::Set(name, value) => Own::Set(name.into(), Box::new(value.clone())),
            Event::SubCall(call) => Own::Call(Box::new(*call)),
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
            Event::Home => Own::Plain(Event::Home),
            Event::Finish => Own::Plain(Event::Finish),
        })
    }
}

impl Kept {
    /// The event as a borrowed value.
    pub fn event(&self) -> Event<'_> {
        match &self.0 {
            Own::Start(start) => Event::Start(start),
            Own::ToolChange(change) => Event::ToolChange(change),
            Own::Arc(arc, feed) => Event::Arc { arc, feed: *feed },
            Own::Infeed(infeed, feed) => Event::Infeed { infeed, feed: *feed },
            Own::Cycle(spec) => Event::CycleBegin(spec),
            Own::Comment(text) => Event::Comment(text),
            Own::Text(text) => Event::Text(text),
            Own::Set(name, value) => Event::Set(name, value),
            Own::Call(call) => Event::SubCall(call),
            Own::Thread(thread) => Event::Thread(thread),
            Own::Plain(event) => event.clone(),
        }
    }
}
