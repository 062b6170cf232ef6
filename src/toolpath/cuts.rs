//! Prepares jobs for a torch or a laser: adds the begin and end of each cut, and removes a depth axis that the form ignores.

use super::axes::Axes;
use super::event::Event;
use super::moves::{Arc, Infeed, Plane, Section};
use super::operation::{First, ToolChange};
use super::place::Place;
use super::sink::{Flow, Sink, Stop};
use crate::diag::{Code, Diag};

/// The depth axis, as a bit.
const DEPTH: u8 = 0b100;
/// Tolerance within which two heights are equal, in the job's units.
const SAME_HEIGHT: f64 = 1e-6;

/// A sink that adds the begin and end of cuts and passes all events on. A cut lasts from the first feed move to the
/// next rapid. The cut is a part of the path ([`Section::Cut`]) and includes the lead-in and lead-out.
pub struct Cuts<'s> {
    sink: &'s mut dyn Sink,
    /// Whether the form ignores the depth axis.
    is_flat: bool,
    /// Whether the tool is in a cut.
    is_on: bool,
    /// Other parts that began or ended since the last move. Each entry contains whether the part began, its section,
    /// and its location in the job.
    parts: Vec<(bool, Section, Place)>,
    /// Position of the tool.
    at: Axes,
    /// The height of all cuts; `None`: not known yet.
    height: Option<f64>,
}

impl<'s> Cuts<'s> {
    /// A sink that passes its events on to `sink`. `is_flat`: the form ignores the depth axis.
    pub fn new(sink: &'s mut dyn Sink, is_flat: bool) -> Cuts<'s> {
        Cuts { sink, is_flat, is_on: false, parts: Vec::new(), at: Axes::default(), height: None }
    }

    /// Pushes the waiting parts and the begin or end of a cut. If a cut and another part begin at the same move, the
    /// cut begins first. If both end at the same move, the cut ends last.
    fn switch(&mut self, begins: bool, place: Place) -> Result<(), Stop> {
        let parts = std::mem::take(&mut self.parts);
        let ended = parts.iter().position(|(begins, ..)| *begins).unwrap_or(parts.len());
        let (before, after) = if begins { parts.split_at(0) } else { parts.split_at(ended) };
        self.tell(before)?;
        if begins != std::mem::replace(&mut self.is_on, begins) {
            let cut = if begins { Event::Begin(Section::Cut) } else { Event::End(Section::Cut) };
            self.sink.push(cut, place)?;
        }
        self.tell(after)
    }

    fn tell(&mut self, parts: &[(bool, Section, Place)]) -> Result<(), Stop> {
        for &(begins, section, at) in parts {
            self.sink.push(if begins { Event::Begin(section) } else { Event::End(section) }, at)?;
        }
        Ok(())
    }

    /// The position for the form: without the depth axis if the form ignores it.
    fn flat(&self, to: Axes) -> Axes {
        if self.is_flat { Axes { given: to.given & !DEPTH, ..to } } else { to }
    }

    /// Moves the tool. Returns whether the tool moves along an axis that the form prints.
    fn goes(&mut self, to: &Axes) -> bool {
        let counted = self.flat(*to);
        let moves = (0..6).any(|axis| counted.get(axis).is_some_and(|value| self.at.get(axis) != Some(value)));
        for axis in 0..6 {
            if let Some(value) = to.get(axis) {
                self.at.set(axis, value);
            }
        }
        moves
    }

    /// Handles a rapid, which ends the cut. A rapid along only an ignored depth axis is not passed on.
    fn rapid(&mut self, to: Axes, place: Place) -> Result<(), Stop> {
        self.switch(false, place)?;
        let moves = self.goes(&to);
        if moves || !self.is_flat { self.sink.push(Event::Rapid(self.flat(to)), place) } else { Ok(()) }
    }

    /// Begins a cut at a feed move. Returns `false` if the tool moves only along an ignored depth axis.
    fn cuts(&mut self, to: &Axes, place: Place) -> Result<bool, Stop> {
        if !self.goes(to) && self.is_flat {
            return Ok(false);
        }
        if self.is_flat {
            self.same_height()?;
        }
        self.switch(true, place)?;
        Ok(true)
    }

    fn same_height(&mut self) -> Result<(), Stop> {
        let Some(depth) = self.at.get(2) else { return Ok(()) };
        let height = *self.height.get_or_insert(depth);
        if (height - depth).abs() <= SAME_HEIGHT {
            return Ok(());
        }
        let message = format!("the job cuts at Z{depth} and at Z{height}, but the form ignores Z");
        wrong(message, "cut at one height, or remove `Ignore Z` from the form and print Z")
    }

    fn arc(&mut self, arc: &Arc, feed: Option<f64>, place: Place) -> Result<(), Stop> {
        if self.is_flat && arc.plane != Plane::Xy {
            return wrong(
                "an arc outside XY, but the form ignores Z".into(),
                "cut in XY, or remove `Ignore Z` from the form and print Z",
            );
        }
        // a full circle is a cut too, although it ends where it begins
        self.goes(&arc.to);
        if self.is_flat {
            self.same_height()?;
        }
        self.switch(true, place)?;
        let arc = Arc { to: self.flat(arc.to), ..*arc };
        self.sink.push(Event::Arc { arc: &arc, feed }, place)
    }

    fn tool_change(&mut self, change: &ToolChange, place: Place) -> Result<(), Stop> {
        self.switch(false, place)?;
        let first = match &change.first {
            First::Hole(..) => return no_holes(),
            First::Rapid(to) => First::Rapid(self.flat(*to)),
            other => other.clone(),
        };
        self.sink.push(Event::ToolChange(&ToolChange { first, ..change.clone() }), place)
    }

    fn take(&mut self, event: Event<'_>, place: Place) -> Result<(), Stop> {
        match event {
            Event::Begin(section) => {
                self.parts.push((true, section, place));
                Ok(())
            }
            Event::End(section) => {
                self.parts.push((false, section, place));
                Ok(())
            }
            Event::Rapid(to) => self.rapid(to, place),
            Event::Line { to, feed } if self.cuts(&to, place)? => {
                self.sink.push(Event::Line { to: self.flat(to), feed }, place)
            }
            // the feed of the line applies from here on
            Event::Line { feed: Some(feed), .. } => self.sink.push(Event::Feed(feed), place),
            Event::Line { .. } => Ok(()),
            Event::Arc { arc, feed } => self.arc(arc, feed, place),
            Event::Infeed { infeed, feed } => {
                if infeed.rapid {
                    self.switch(false, place)?;
                    self.goes(&infeed.to);
                } else {
                    self.cuts(&infeed.to, place)?;
                }
                let infeed = Infeed { to: self.flat(infeed.to), ..*infeed };
                self.sink.push(Event::Infeed { infeed: &infeed, feed }, place)
            }
            Event::Outfeed { to, feed, rapid } => {
                if rapid {
                    self.switch(false, place)?;
                    self.goes(&to);
                } else {
                    self.cuts(&to, place)?;
                }
                self.sink.push(Event::Outfeed { to: self.flat(to), feed, rapid }, place)
            }
            Event::ToolChange(change) => self.tool_change(change, place),
            Event::CycleBegin(_) | Event::Hole(_) => no_holes(),
            Event::Work(_) | Event::Home | Event::Stop(_) | Event::SubCall(_) | Event::SubStart(_) | Event::SubEnd => {
                self.switch(false, place)?;
                self.sink.push(event, place)
            }
            Event::Finish => {
                self.switch(false, place)?;
                self.sink.push(event, place)
            }
            other => self.sink.push(other, place),
        }
    }
}

fn wrong<T>(message: String, help: &str) -> Result<T, Stop> {
    Err(Diag::new(Code::PR058, message).help(help).into())
}

fn no_holes<T>() -> Result<T, Stop> {
    wrong("a torch or a laser can't make holes with cycles".into(), "cut the hole as a circle, or remove the cycle")
}

impl Sink for Cuts<'_> {
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        super::sink::flow(self.take(event, place))
    }
}
