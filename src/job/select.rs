//! Selects operations of a job by their tools. The selection begins with a given tool, ends with a given tool, contains
//! only given tools, or excludes given tools.
//!
//! Some values of a left-out operation stay in force: work offset and set values, and spindle and coolant if the tool stays the
//! same. These values are added to the next operation that is selected. That operation starts at the position that the tool would have
//! reached.

use crate::diag::{Code, Diag};
use crate::lang::Coolant;
use crate::toolpath::{Axes, Event, First, Flow, Given, Hole, Place, Sink, Spindle, Start, ToolChange};

/// The selected operations, by their tools, their numbers or their work offsets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// Skips all operations before the first operation with this tool.
    pub from: Option<u32>,
    /// Skips all operations after the operations with this tool.
    pub until: Option<u32>,
    /// Selects only operations with these tools; an empty list selects all operations.
    pub only: Vec<u32>,
    /// Skips operations with these tools.
    pub skip: Vec<u32>,
    /// Selects only the operation with this number, counted from 1.
    pub operation: Option<u64>,
    /// Selects only operations that begin in this work offset; `Some(None)`: operations before the job's first work
    /// offset.
    pub work: Option<Option<f64>>,
}

impl Selection {
    /// Whether all operations are selected.
    pub fn is_all(&self) -> bool {
        *self == Selection::default()
    }
}

/// Progress of a selection through the job.
#[derive(Clone, Copy, Default)]
struct Progress {
    /// Number of operations so far.
    count: u64,
    begun: bool,
    /// Whether an operation with the last tool has begun.
    reached: bool,
    over: bool,
}

impl Progress {
    /// Whether the next operation is selected, given its tool and work offset.
    fn takes(&mut self, selection: &Selection, tool: Option<f64>, work: Option<f64>) -> bool {
        self.count += 1;
        self.takes_tool(selection, tool)
            && selection.operation.is_none_or(|operation| operation == self.count)
            && selection.work.is_none_or(|wanted| wanted == work)
    }

    fn takes_tool(&mut self, selection: &Selection, tool: Option<f64>) -> bool {
        let is = |number: u32| tool == Some(f64::from(number));
        self.begun |= selection.from.is_none_or(is);
        let is_last = selection.until.is_some_and(is);
        self.over |= self.reached && !is_last;
        self.reached |= is_last;
        let named = selection.only.is_empty() || selection.only.iter().any(|number| is(*number));
        self.begun && !self.over && named && !selection.skip.iter().any(|number| is(*number))
    }
}

/// Passes only the selected operations on.
pub(super) struct Selecting<'s> {
    sink: &'s mut dyn Sink,
    selection: &'s Selection,
    progress: Progress,
    /// Whether the current operation is selected. Items before the first operation are always selected.
    takes: bool,
    /// Whether an operation was left out after the last selected operation.
    left_out: bool,
    /// Whether the next move is the first after a left-out operation, so that its missing axes are filled in.
    fills: bool,
    /// Whether a subprogram is open. A subprogram is always kept, because any operation may call it.
    in_subprogram: bool,
    held: Held,
    /// The position, with only the axes that are known.
    at: Axes,
    tools: Vec<f64>,
    taken: u64,
}

/// Values that stay in force from operation to operation.
#[derive(Default)]
struct Held {
    tool: Option<f64>,
    spindle: Option<Spindle>,
    coolant: Option<Coolant>,
    work: Option<f64>,
    set: Vec<(String, Given)>,
}

impl<'s> Selecting<'s> {
    pub fn new(sink: &'s mut dyn Sink, selection: &'s Selection) -> Selecting<'s> {
        Selecting {
            sink,
            selection,
            progress: Progress::default(),
            takes: true,
            left_out: false,
            fills: false,
            in_subprogram: false,
            held: Held::default(),
            at: Axes::default(),
            tools: Vec::new(),
            taken: 0,
        }
    }

    /// Handles the beginning of an operation.
    fn change(&mut self, change: &ToolChange, place: Place) -> Flow {
        let tool = change.tool.as_ref().map(|tool| tool.number);
        if let Some(tool) = tool.filter(|tool| !self.tools.contains(tool)) {
            self.tools.push(tool);
        }
        self.hold(change);
        self.takes = self.progress.takes(self.selection, tool, self.held.work);
        if !self.takes {
            self.left_out = true;
            return Flow::Continue(());
        }
        self.taken += 1;
        if !std::mem::take(&mut self.left_out) {
            return self.sink.event(Event::ToolChange(change), place);
        }
        let held = &self.held;
        let mut change = ToolChange {
            spindle: held.spindle,
            coolant: held.coolant,
            work: held.work,
            set: held.set.clone(),
            ..change.clone()
        };
        match &mut change.first {
            First::Rapid(to) => *to = self.filled(*to),
            First::Hole(_, hole) => hole.at = self.filled(hole.at),
            First::Cut => {
                let name = change.name.as_deref().map(|name| format!(" `{name}`")).unwrap_or_default();
                let message = format!(
                    "the operation{name} begins with a cut from the last position of an operation that is left out"
                );
                let help = "include the operation before it too";
                return Flow::Break(Diag::new(Code::PR060, message).help(help).place(place).into());
            }
            First::Nothing => {}
        }
        self.fills = true;
        self.sink.event(Event::ToolChange(&change), place)
    }

    /// Keeps the values that stay in force after the operation. Spindle and coolant end at the change to another tool.
    fn hold(&mut self, change: &ToolChange) {
        let held = &mut self.held;
        let tool = change.tool.as_ref().map(|tool| tool.number);
        if tool.is_some() && tool != held.tool {
            *held = Held { tool, spindle: None, coolant: None, ..std::mem::take(held) };
        }
        held.spindle = change.spindle.map(|own| turned(own, held.spindle)).or(held.spindle);
        held.coolant = change.coolant.or(held.coolant);
        held.work = change.work.or(held.work);
        change.set.iter().for_each(|(name, value)| self.set(name, value));
    }

    fn set(&mut self, name: &str, value: &Given) {
        self.held.set.retain(|(known, _)| known != name);
        self.held.set.push((name.to_owned(), value.clone()));
    }

    /// A position whose missing axes are filled in with the known position.
    fn filled(&self, to: Axes) -> Axes {
        let mut full = to;
        for axis in 0..6 {
            if let (None, Some(value)) = (to.get(axis), self.at.get(axis)) {
                full.set(axis, value);
            }
        }
        full
    }

    fn goes(&mut self, to: &Axes) {
        for axis in 0..6 {
            if let Some(value) = to.get(axis) {
                self.at.set(axis, value);
            }
        }
    }

    /// Updates the values that stay in force after an event.
    fn follow(&mut self, event: &Event<'_>) {
        match event {
            Event::Rapid(to) | Event::Line { to, .. } | Event::Outfeed { to, .. } => self.goes(to),
            Event::Arc { arc, .. } => self.goes(&arc.to),
            Event::Infeed { infeed, .. } => self.goes(&infeed.to),
            Event::Hole(Hole { at, .. }) => {
                self.goes(at);
                self.at.given &= !0b100; // the retract height depends on the cycle
            }
            Event::SubCall(_) | Event::Home | Event::Thread(_) | Event::Edm(_) => self.at = Axes::default(),
            Event::Work(work) => {
                self.held.work = Some(*work);
                self.at = Axes::default();
            }
            Event::Spindle(spindle) => self.held.spindle = Some(turned(*spindle, self.held.spindle)),
            Event::Coolant(coolant) => self.held.coolant = Some(*coolant),
            Event::Set(name, value) => self.set(name, value),
            _ => {}
        }
    }

    /// The head, without the tools that are left out.
    fn start(&mut self, start: &Start, place: Place) -> Flow {
        let Some(order) = &start.tool_order else { return self.sink.event(Event::Start(start), place) };
        let mut progress = Progress::default();
        let mut taken = order.clone();
        taken.retain(|tool| progress.takes_tool(self.selection, Some(*tool)));
        // with a selection by number or work offset, the tools are unknown until the operations are read
        let is_known = self.selection.operation.is_none() && self.selection.work.is_none();
        self.sink.event(Event::Start(&Start { tool_order: is_known.then_some(taken), ..start.clone() }), place)
    }
}

impl Sink for Selecting<'_> {
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        match event {
            Event::Start(start) => return self.start(start, place),
            Event::ToolChange(change) => return self.change(change, place),
            Event::SubStart(_) => self.in_subprogram = true,
            Event::Finish if self.taken == 0 && !self.tools.is_empty() => {
                let tools: Vec<String> = self.tools.iter().map(|tool| format!("T{tool}")).collect();
                let message = format!("no operation is selected: the job has {}", tools.join(", "));
                return Flow::Break(Diag::new(Code::PJ006, message).help("select tools of the job").into());
            }
            _ => {}
        }
        let passes = self.takes || self.in_subprogram || matches!(event, Event::Finish);
        if !self.in_subprogram {
            // missing axes of the move are filled in from the position before it
            let filled = match &event {
                Event::Rapid(to) if self.fills => Some(Event::Rapid(self.filled(*to))),
                Event::Hole(hole) if self.fills => Some(Event::Hole(Hole { at: self.filled(hole.at), ..*hole })),
                _ => None,
            };
            self.follow(&event);
            if let Some(filled) = filled {
                self.fills &= !passes;
                return if passes { self.sink.event(filled, place) } else { Flow::Continue(()) };
            }
        }
        if matches!(event, Event::SubEnd) {
            self.in_subprogram = false;
        }
        if passes { self.sink.event(event, place) } else { Flow::Continue(()) }
    }
}

/// A spindle state; values that are missing are taken from the spindle state before.
fn turned(own: Spindle, before: Option<Spindle>) -> Spindle {
    let Some(before) = before else { return own };
    Spindle {
        speed: own.speed.or(before.speed),
        turn: own.turn.or(before.turn),
        css: own.css.or(before.css),
        max: own.max.or(before.max),
    }
}
