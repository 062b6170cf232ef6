//! Selects operations of a job by their tools. The selection begins with a given tool, ends with a given tool, contains
//! only given tools, or excludes given tools.
//!
//! Some values of a left-out operation stay in force: work offset, tool axis and set values, and spindle and coolant if the
//! tool stays the same. These values are added to the next operation that is selected. That operation starts at the
//! position that the tool would have reached. It begins with a tool change, even if its tool is in the spindle: the tool is
//! retracted from the end of the last operation in the program. If a state of a left-out operation can't be added, the
//! operation after it is refused. It is also refused if it begins at a height to which the tool does not come down by a
//! rapid in the whole program.

use std::collections::BTreeSet;
use std::fmt::Display;

use super::descent::Descent;
use super::held::{Held, UPRIGHT, is_variable};
use super::left_out_text::{Left, Other};
use super::subs::Subs;
use crate::control::Control;
use crate::diag::{Code, Diag};
use crate::lang::Machine;
use crate::toolpath::{
    Axes, Call, Event, First, Flow, Hold, Hole, JobAxes, Place, Sink, Start, Stop, ToolChange, flow,
};

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
    /// Selects only the operation with this number, counted from 1 among the operations whose tools are selected.
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

    /// All tools that the selection names.
    fn tools(&self) -> impl Iterator<Item = u32> {
        self.from.into_iter().chain(self.until).chain(self.only.iter().copied()).chain(self.skip.iter().copied())
    }
}

/// The correction for an operation that can't be printed alone.
const INCLUDE: &str = "include the operation before it too";

/// Progress of a selection through the job.
#[derive(Clone, Copy, Default)]
struct Progress {
    /// Number of operations so far whose tools are selected.
    count: u64,
    begun: bool,
    /// Whether an operation with the last tool has begun.
    reached: bool,
    over: bool,
}

impl Progress {
    /// Whether the next operation is selected, given its tool and work offset.
    fn takes(&mut self, selection: &Selection, tool: Option<f64>, work: Option<f64>) -> bool {
        let takes_tool = self.takes_tool(selection, tool);
        self.count += u64::from(takes_tool);
        takes_tool
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
    /// Holds a tool change back until its first move is filled in.
    sink: Hold<'s>,
    selection: &'s Selection,
    /// The control that defines the codes in text items.
    control: &'static Control,
    progress: Progress,
    /// Whether the current operation is selected. Items before the first operation are always selected.
    takes: bool,
    /// Whether an operation was left out after the last selected operation.
    left_out: bool,
    /// Whether the next move is the first after a left-out operation, so that its missing axes are filled in.
    fills: bool,
    /// The name of the current operation.
    name: Option<String>,
    /// The subprograms, and whether they contain text with an unknown effect. A subprogram is always kept, because any
    /// operation may call it.
    subs: Subs,
    held: Held,
    /// The linear axes of the machine, as bits.
    linear: u8,
    /// The axis along which the tool enters a hole, as a bit.
    depth: u8,
    /// The position at the end of the last selected operation.
    passed_at: Axes,
    /// The tool axis of the events that were passed on.
    passed_tilt: [f64; 3],
    /// The position, with only the axes that are known.
    at: Axes,
    /// How the tool comes to its height, on a mill.
    descent: Descent,
    is_mill: bool,
    /// Rotary axes that a subprogram of a left-out operation turned to an unknown angle, as bits.
    turned: u8,
    tools: Vec<f64>,
    taken: u64,
    /// Number of operations that were left out.
    pub skipped: u64,
}

impl<'s> Selecting<'s> {
    pub fn new(sink: &'s mut dyn Sink, selection: &'s Selection, control: &'static Control) -> Selecting<'s> {
        Selecting {
            sink: Hold::new(sink),
            selection,
            control,
            progress: Progress::default(),
            takes: true,
            left_out: false,
            fills: false,
            name: None,
            subs: Subs::default(),
            held: Held::default(),
            linear: 0b111,
            depth: 0b100,
            passed_at: Axes::default(),
            passed_tilt: UPRIGHT,
            at: Axes::default(),
            descent: Descent::default(),
            is_mill: true,
            turned: 0,
            tools: Vec::new(),
            taken: 0,
            skipped: 0,
        }
    }

    /// Handles the beginning of an operation.
    fn change(&mut self, change: &ToolChange, place: Place) -> Flow {
        let tool = change.tool.as_ref().map(|tool| tool.number);
        if let Some(tool) = tool.filter(|tool| !self.tools.contains(tool)) {
            self.tools.push(tool);
        }
        if self.takes {
            self.passed_at = if self.fills { self.passed_at } else { self.at };
        }
        let frame = (self.held.tool, self.held.work);
        if change.changes_to(self.held.tool).is_some() {
            self.descent = Descent::default();
        }
        self.held.operation(change);
        if frame != (self.held.tool, self.held.work) {
            self.forgets(self.linear);
            self.descent = Descent::default();
        }
        self.name.clone_from(&change.name);
        self.takes = self.progress.takes(self.selection, tool, self.held.work);
        if !self.takes {
            (self.left_out, self.fills) = (true, false);
            self.skipped += 1;
            return Flow::Continue(());
        }
        self.taken += 1;
        if !std::mem::take(&mut self.left_out) {
            return self.sink.event(Event::ToolChange(change), place);
        }
        if let Some(lost) = self.held.lost() {
            return Flow::Break(self.not_alone(
                &format!("follows an operation that is left out: {lost}"),
                INCLUDE,
                place,
            ));
        }
        if matches!(change.first, First::Cut) {
            let why = "begins with a cut from the last position of an operation that is left out";
            return Flow::Break(self.not_alone(why, INCLUDE, place));
        }
        let held = &self.held;
        let properties = change.set.iter().filter(|(name, _)| !is_variable(name));
        let change = ToolChange {
            spindle: held.spindle,
            coolant: held.coolant,
            // otherwise nothing retracts the tool from its last position in the program
            reloads: true,
            work: held.work,
            set: held.set.iter().chain(properties).cloned().collect(),
            ..change.clone()
        };
        self.fills = true;
        flow(self.sink.tool_change(change, place))
    }

    /// The error that the current operation can't be printed without the operations that are left out.
    fn not_alone(&self, why: &str, help: &str, place: Place) -> Stop {
        let name = self.name.as_deref().map(|name| format!(" `{name}`")).unwrap_or_default();
        let message = format!("the operation{name} {why}");
        Diag::new(Code::PR060, message).help(help).place(place).into()
    }

    /// The first move of an operation after a left-out operation, with the missing axes filled in. `filled`: space for a
    /// call.
    fn first_move<'e>(&self, event: Event<'e>, filled: &'e mut Call, place: Place) -> Result<Event<'e>, Stop> {
        let (event, given) = match event {
            Event::Rapid(to) => (Event::Rapid(self.filled(to)), to.given),
            Event::Hole(hole) => (Event::Hole(Hole { at: self.filled(hole.at), ..hole }), hole.at.given),
            Event::SubCall(call) if call.at.given != 0 => {
                *filled = Call { at: self.filled(call.at), ..*call };
                (Event::SubCall(filled), call.at.given)
            }
            event => (event, 0),
        };
        let is_filled = matches!(event, Event::Rapid(_) | Event::Hole(_)) || given != 0;
        let other = |axis: &usize| !is_filled && self.at.get(*axis) != self.passed_at.get(*axis);
        let unknown = |axis: &usize| self.turned & !given & 1 << axis != 0;
        let rotary = (0..6).filter(|axis| self.linear & 1 << axis == 0);
        let Some(axis) = rotary.filter(|axis| other(axis) || unknown(axis)).map(|axis| b"XYZABC"[axis]).next() else {
            return Ok(event);
        };
        let axis = char::from(axis);
        let why =
            format!("does not give {axis} at its first position, but an operation that is left out turns this axis");
        Err(self.not_alone(&why, INCLUDE, place))
    }

    /// Checks that the tool may come down to the first position of an operation after a left-out operation.
    fn comes_down(&self, event: &Event<'_>, place: Place) -> Flow {
        let at = match event {
            Event::Rapid(to) => to,
            Event::SubCall(call) if call.at.given != 0 => &call.at,
            _ => return Flow::Continue(()),
        };
        let (mut descent, height) = (self.descent, at.get(2));
        descent.rapid(height);
        let Some(height) = height.filter(|_| self.is_mill && !descent.is_clear) else { return Flow::Continue(()) };
        let why = format!(
            "begins at Z{height}, where the last cut of an operation that is left out leaves the tool: the whole program \
             does not come down to this height by a rapid"
        );
        let lowest = descent.lowest.map_or("a clearance height".to_owned(), |lowest| format!("Z{lowest} or higher"));
        let help = format!(
            "raise the tool to {lowest} by a rapid, at the end of the operation before it or at the beginning of this one; \
             or include the operation before it too"
        );
        Flow::Break(self.not_alone(&why, &help, place))
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
        self.turned &= !to.given;
        for axis in 0..6 {
            if let Some(value) = to.get(axis) {
                self.at.set(axis, value);
            }
        }
    }

    /// Discards the positions of these axes.
    fn forgets(&mut self, axes: u8) {
        self.at.given &= !axes;
    }

    /// Updates the values that stay in force after an event.
    fn follow(&mut self, event: &Event<'_>) {
        self.descent.follow(event);
        if let Some(to) = event.target() {
            self.goes(&to);
        }
        match event {
            Event::Infeed { .. } => self.held.is_compensated = true,
            Event::Outfeed { .. } => self.held.is_compensated = false,
            Event::Hole(_) => self.forgets(self.depth), // the retract height depends on the cycle
            Event::SubCall(call) => self.calls(call),
            Event::Home | Event::Thread(_) | Event::Edm(_) => self.forgets(self.linear),
            Event::Tilt(axis) => self.held.tilt = *axis,
            Event::Text(text) => self.held.text(text, self.control, self.takes),
            Event::Work(work) if self.held.work != Some(*work) => {
                self.held.work = Some(*work);
                self.forgets(self.linear);
            }
            Event::Spindle(spindle) => self.held.spindle(*spindle),
            Event::Coolant(coolant) => self.held.coolant = Some(*coolant),
            Event::Set(name, value) => self.held.set(name, value),
            _ => {}
        }
    }

    /// Updates the state after a call: the tool is at an unknown position, and the axes that the subprogram turns have an
    /// unknown angle.
    fn calls(&mut self, call: &Call) {
        let effect = self.subs.effect(call.sub);
        if effect.has_text && !self.takes {
            self.held.unknown = Some(format!("the text in subprogram {}", call.sub));
        }
        self.goes(&call.at);
        self.forgets(self.linear | effect.axes);
        if !self.takes {
            self.turned |= effect.axes & !self.linear;
        }
    }

    /// Passes an event on. A changed tool axis is passed on before the next move.
    fn pass(&mut self, event: Event<'_>, place: Place) -> Flow {
        let moves = event.moves() || matches!(event, Event::Home);
        if moves && self.held.tilt != self.passed_tilt {
            self.passed_tilt = self.held.tilt;
            self.sink.event(Event::Tilt(self.held.tilt), place)?;
        }
        self.sink.event(event, place)
    }

    /// Checks at the end of the job that the job has all tools of the selection, and that an operation was selected.
    fn selects_operations(&self) -> Flow {
        let has = |tool: u32| self.tools.contains(&f64::from(tool));
        let unknown: BTreeSet<u32> = self.selection.tools().filter(|tool| !has(*tool)).collect();
        let what = if !unknown.is_empty() {
            format!("the job has no {}", listed(unknown))
        } else if self.taken == 0 && self.skipped > 0 {
            "no operation is selected".to_owned()
        } else {
            return Flow::Continue(());
        };
        let tools = if self.tools.is_empty() { "none".to_owned() } else { listed(&self.tools) };
        let diag = Diag::new(Code::PJ006, format!("{what}: the tools of the job are {tools}"));
        Flow::Break(diag.help("select tools of the job").into())
    }

    /// The head, without the tools that are left out.
    fn start(&mut self, start: &Start, place: Place) -> Flow {
        let axes = JobAxes::of(start.machine);
        (self.linear, self.depth) = (axes.linear, axes.depth_bit());
        self.is_mill = start.machine == Machine::Mill;
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
            Event::Finish => self.selects_operations()?,
            _ => {}
        }
        let control = self.control;
        if self.subs.define(&event, |text| Left::by(text, control).other == Other::Unknown) {
            return self.sink.event(event, place);
        }
        // an operation after a left-out operation begins at the position before it
        let mut call = Call { sub: 0.0, times: 0.0, at: Axes::default(), work: None };
        let event = match self.fills && event.moves() {
            true => match self.first_move(event, &mut call, place) {
                Ok(event) => event,
                Err(stop) => return Flow::Break(stop),
            },
            false => event,
        };
        if self.fills {
            self.comes_down(&event, place)?;
        }
        self.follow(&event);
        if !self.takes && !matches!(event, Event::Finish) || matches!(event, Event::Tilt(_)) {
            return Flow::Continue(());
        }
        self.fills &= !event.moves();
        self.pass(event, place)
    }
}

/// Tools in a message: `T1, T2`.
fn listed(tools: impl IntoIterator<Item = impl Display>) -> String {
    tools.into_iter().map(|tool| format!("T{tool}")).collect::<Vec<_>>().join(", ")
}
