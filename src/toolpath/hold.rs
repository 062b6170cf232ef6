//! Holds a tool change back until the first move of the path is known, because the tool change may print its position.

use super::axes::Axes;
use super::cycle::{CycleSpec, Hole};
use super::event::{Call, Event};
use super::job_axes::JobAxes;
use super::operation::{First, ToolChange};
use super::start::Given;
use super::tool::Spindle;
use super::{Flow, Place, Sink, Stop, flow};
use crate::diag::{Code, Diag};

/// The largest number of items that may come before the first move of an operation.
const MOST_HELD: usize = 4096;

/// A filter between a reader and its sink. The filter holds back tool changes.
pub struct Hold<'s> {
    sink: &'s mut dyn Sink,
    change: Option<(ToolChange, Place)>,
    waiting: Vec<(Waiting, Place)>,
    /// The axes that a tool change of this machine may print, as bits.
    axes: u8,
    /// The axis along which the tool enters a hole, as a bit.
    depth: u8,
    /// The first position of the path: for each axis, the first value in the rapids so far. The position is complete if
    /// all axes are given.
    first: Axes,
    /// The number of the tool in the spindle.
    tool: Option<f64>,
    /// Whether the held tool change loads another tool.
    changes: bool,
}

/// An event before the first move, as an owned copy.
enum Waiting {
    Plain(Event<'static>),
    Comment(String),
    Text(String),
    Set(String, Given),
    Cycle(Box<CycleSpec>),
}

impl Waiting {
    /// Copies an event that can be held back. `None`: the tool change must come before this event.
    fn of(event: &Event<'_>) -> Option<Waiting> {
        Some(match *event {
            Event::CycleBegin(spec) => Waiting::Cycle(Box::new(spec.clone())),
            Event::Comment(text) => Waiting::Comment(text.to_owned()),
            Event::Text(text) => Waiting::Text(text.to_owned()),
            Event::Set(name, value) => Waiting::Set(name.to_owned(), value.clone()),
            Event::Tilt(axis) => Waiting::Plain(Event::Tilt(axis)),
            Event::Begin(section) => Waiting::Plain(Event::Begin(section)),
            Event::End(section) => Waiting::Plain(Event::End(section)),
            Event::CycleEnd => Waiting::Plain(Event::CycleEnd),
            Event::Edm(action) => Waiting::Plain(Event::Edm(action)),
            Event::Dwell(seconds) => Waiting::Plain(Event::Dwell(seconds)),
            Event::Stop(kind) => Waiting::Plain(Event::Stop(kind)),
            Event::Feed(feed) => Waiting::Plain(Event::Feed(feed)),
            Event::Spindle(spindle) => Waiting::Plain(Event::Spindle(spindle)),
            Event::Coolant(coolant) => Waiting::Plain(Event::Coolant(coolant)),
            _ => return None,
        })
    }

    /// Whether postform prints nothing for this event before the tool change. Comments, rapids, and changes of feed,
    /// spindle or coolant print nothing.
    fn prints_nothing(&self) -> bool {
        matches!(
            self,
            Waiting::Comment(_)
                | Waiting::Plain(Event::Rapid(_) | Event::Feed(_) | Event::Spindle(_) | Event::Coolant(_))
        )
    }
}

impl<'s> Hold<'s> {
    /// A filter that passes its events on to `sink`.
    pub fn new(sink: &'s mut dyn Sink) -> Self {
        Hold {
            sink,
            change: None,
            waiting: Vec::new(),
            axes: 0b111,
            depth: 0b100,
            first: Axes::default(),
            tool: None,
            changes: false,
        }
    }

    /// Holds a tool change back. The filter sets `first` of the tool change.
    ///
    /// # Errors
    /// The sink fails at an earlier event that was held back.
    pub fn tool_change(&mut self, change: ToolChange, place: Place) -> Result<(), Stop> {
        self.release(First::Nothing)?;
        self.changes = change.changes_to(self.tool).is_some();
        self.tool = change.tool.as_ref().map(|tool| tool.number).or(self.tool);
        self.change = Some((change, place));
        Ok(())
    }

    /// Passes the held tool change on. If no earlier rapid has given a position, `first` becomes the first move of the
    /// tool change.
    fn release(&mut self, first: First) -> Result<(), Stop> {
        let said = std::mem::take(&mut self.first);
        if let Some((mut change, place)) = self.change.take() {
            change.first = if said.given == 0 { first } else { First::Rapid(said) };
            self.sink.push(Event::ToolChange(&change), place)?;
        }
        for (waiting, place) in self.waiting.drain(..) {
            let event = match &waiting {
                Waiting::Plain(event) => event.clone(),
                Waiting::Comment(text) => Event::Comment(text),
                Waiting::Text(text) => Event::Text(text),
                Waiting::Set(name, value) => Event::Set(name, value),
                Waiting::Cycle(spec) => Event::CycleBegin(spec),
            };
            self.sink.push(event, place)?;
        }
        Ok(())
    }

    /// Records the target of a rapid. For each axis, the first position is kept. The height of a new tool is unknown
    /// until a rapid gives a height. Until a rapid gives a height, the last rapid across counts, because the tool goes
    /// down at the end of this rapid. Returns the target, with the axes that only the rapids before it give if these
    /// rapids are removed.
    fn reaches(&mut self, to: &Axes) -> Axes {
        let mut target = *to;
        if self.is_way() && self.first.given & to.given & !self.depth != 0 {
            self.first.given &= !to.given;
            self.forget_ways();
            for axis in (0..6).filter(|&axis| self.first.given & 1 << axis != 0) {
                target.set(axis, self.first.values[axis]);
            }
        }
        let new = to.given & !self.first.given;
        for axis in (0..6).filter(|axis| new & 1 << axis != 0) {
            self.first.set(axis, to.values[axis]);
        }
        target
    }

    /// Whether the held tool change loads another tool and no rapid so far gives a height.
    fn is_way(&self) -> bool {
        self.changes && self.depth != 0 && self.first.given & self.depth == 0
    }

    /// Removes rapids without a height, because the tool change goes directly to a later position.
    fn forget_ways(&mut self) {
        let (depth, changes) = (self.depth, self.changes);
        let is_way = |w: &Waiting| matches!(w, Waiting::Plain(Event::Rapid(to)) if changes && to.given & depth == 0);
        self.waiting.retain(|(waiting, _)| !is_way(waiting));
    }

    /// Passes the held tool change on, and then this event.
    fn release_before(&mut self, event: Event<'_>, place: Place, first: First) -> Result<(), Stop> {
        self.release(first)?;
        self.sink.push(event, place)
    }

    #[cold]
    fn held(&mut self, event: Event<'_>, place: Place) -> Result<(), Stop> {
        match event {
            // earlier rapids gave positions in the previous work offset, so the tool moves to these positions in that
            // offset
            Event::Work(_) if self.first.given != 0 && !self.is_way() => {
                self.release_before(event, place, First::Nothing)
            }
            Event::Work(work) => {
                self.change_in(work);
                Ok(())
            }
            // spindle events and settings before any other event are merged into the tool change
            Event::Spindle(spindle) if self.prints_nothing() => {
                self.change_with(spindle);
                Ok(())
            }
            Event::Set(name, value) if self.prints_nothing() => {
                if let Some((change, _)) = &mut self.change {
                    change.set.push((name.to_owned(), value.clone()));
                }
                Ok(())
            }
            Event::Rapid(to) => {
                // CAM systems give the height and the position across in either order, so wait for both
                let to = self.reaches(&to);
                if self.axes & !self.first.given == 0 || to.given & !self.axes != 0 {
                    return self.release_before(Event::Rapid(to), place, First::Nothing);
                }
                self.wait(Waiting::Plain(Event::Rapid(to)), place)
            }
            Event::Hole(hole) => {
                let first = self.first_hole(hole);
                self.release_before(event, place, first)
            }
            Event::Thread(thread) => {
                if self.first.given != 0 {
                    self.reaches(&Axes { given: thread.from.given & self.axes & !self.first.given, ..thread.from });
                }
                self.release_before(event, place, First::Rapid(thread.from))
            }
            Event::Line { .. } | Event::Arc { .. } | Event::Infeed { .. } | Event::Outfeed { .. } => {
                self.release_before(event, place, First::Cut)
            }
            Event::SubCall(call) if self.first.given == 0 => self.first_call(call, place),
            _ => match Waiting::of(&event) {
                Some(waiting) => self.wait(waiting, place),
                None => self.release_before(event, place, First::Nothing),
            },
        }
    }

    /// Whether postform prints nothing for any of the waiting events.
    fn prints_nothing(&self) -> bool {
        self.waiting.iter().all(|(waiting, _)| waiting.prints_nothing())
    }

    /// Sets the work offset of the tool change. The first position is then a position in this work offset. The tool
    /// must not go to a position of the previous offset.
    fn change_in(&mut self, work: f64) {
        if self.first.given != 0 {
            // a new tool moves directly to its position in the last work offset
            self.first = Axes::default();
            self.forget_ways();
        }
        if let Some((change, _)) = &mut self.change {
            change.work = Some(work);
        }
    }

    /// Merges a spindle event into the tool change.
    fn change_with(&mut self, spindle: Spindle) {
        if let Some((change, _)) = &mut self.change {
            change.spindle = Some(spindle.after(change.spindle.unwrap_or_default()));
        }
    }

    /// The first move for a path that begins with a hole of the waiting cycle.
    fn first_hole(&mut self, hole: Hole) -> First {
        let spec = self.waiting.iter().find_map(|(waiting, _)| match waiting {
            Waiting::Cycle(spec) => Some(spec.clone()),
            _ => None,
        });
        if self.first.given & self.depth != 0 {
            // the position above the hole, at the height of an earlier rapid
            self.reaches(&Axes { given: hole.at.given & self.axes & !self.depth, ..hole.at });
        } else {
            self.first = Axes::default();
            self.forget_ways(); // the tool change moves directly above the hole
        }
        spec.map_or(First::Cut, |spec| First::Hole(spec, hole))
    }

    /// Handles a path that begins with a call of a subprogram. The tool change moves to the position of the call, in
    /// the work offset of the call. Afterwards the work offset of the operation is set again.
    fn first_call(&mut self, call: &Call, place: Place) -> Result<(), Stop> {
        let own = self
            .change
            .as_mut()
            .filter(|_| call.work.is_some())
            .map(|(change, _)| std::mem::replace(&mut change.work, call.work));
        let lost = own == Some(None); // only the renderer knows the active work offset
        let first = if call.at.given == 0 || lost { First::Nothing } else { First::Rapid(call.at) };
        self.release_before(Event::SubCall(call), place, first)?;
        match own.flatten() {
            Some(work) => self.sink.push(Event::Work(work), place),
            None => Ok(()),
        }
    }

    fn wait(&mut self, waiting: Waiting, place: Place) -> Result<(), Stop> {
        if self.waiting.len() == MOST_HELD {
            let message = format!("more than {MOST_HELD} items before the operation's first move");
            return Err(Diag::new(Code::PJ013, message).help("put the first rapid before these items").into());
        }
        self.waiting.push((waiting, place));
        Ok(())
    }
}

impl Sink for Hold<'_> {
    #[inline]
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        if self.change.is_some() {
            return flow(self.held(event, place));
        }
        match &event {
            Event::Start(start) => {
                let axes = JobAxes::of(start.machine);
                (self.axes, self.depth) = (axes.first, axes.depth_bit());
            }
            // the first move of this tool change is known already
            Event::ToolChange(change) => self.tool = change.tool.as_ref().map(|tool| tool.number).or(self.tool),
            _ => {}
        }
        self.sink.event(event, place)
    }
}
