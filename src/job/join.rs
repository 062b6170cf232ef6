//! Joins several jobs to one job: the operations follow each other, and the head is the head of the first job.
//!
//! A state that one job leaves active must not change the meaning of the next job. Therefore the first operation of a
//! job must set every value again that an earlier job has set. Printed alone, the job would not have the values of
//! earlier jobs.

use std::collections::HashMap;

use super::held::{is_variable, missing_of_spindle};
use super::subs::Subs;
use crate::diag::{Code, Diag};
use crate::lang::Coolant;
use crate::toolpath::{Axes, Event, First, Flow, JobAxes, Place, Sink, Spindle, Start, Stop, Tool, ToolChange, key};

/// Passes on the events of several jobs as those of one job.
pub(super) struct Joining<'s> {
    sink: &'s mut dyn Sink,
    names: &'s [String],
    /// The number of the current job, from 1.
    part: u16,
    start: Option<Start>,
    /// Whether no operation of this job has begun yet.
    is_new: bool,
    held: Held,
    /// The tools by their numbers, with the jobs that used them first.
    tools: HashMap<u64, (Tool, u16)>,
    /// The jobs that contain the subprograms, by their numbers.
    subprograms: HashMap<u64, u16>,
    subs: Subs,
}

/// The state that the jobs so far have left active.
#[derive(Default)]
struct Held {
    /// Axes that were moved, as bits.
    axes: u8,
    work: Option<f64>,
    spindle: Spindle,
    coolant: Option<Coolant>,
    is_tilted: bool,
    is_compensated: bool,
    /// Whether a job contains text that is printed unchanged.
    has_text: bool,
    set: Vec<String>,
}

impl<'s> Joining<'s> {
    pub fn new(sink: &'s mut dyn Sink, names: &'s [String]) -> Joining<'s> {
        Joining {
            sink,
            names,
            part: 0,
            start: None,
            is_new: false,
            held: Held::default(),
            tools: HashMap::new(),
            subprograms: HashMap::new(),
            subs: Subs::default(),
        }
    }

    /// Begins the next job.
    pub fn next(&mut self) {
        self.part = self.part.saturating_add(1);
        self.is_new = self.part > 1;
    }

    fn name(&self, part: u16) -> &str {
        self.names.get(usize::from(part).saturating_sub(1)).map_or("the job", String::as_str)
    }

    /// The error that the job can't follow an earlier job.
    fn wrong(&self, earlier: u16, why: &str, help: &'static str, place: Place) -> Stop {
        let message = format!("{} can't follow {}: {why}", self.name(self.part), self.name(earlier));
        Diag::new(Code::PJ014, message).help(help).place(place).into()
    }

    /// Handles the head of a job: only the first head is passed on.
    fn start(&mut self, own: &Start, place: Place) -> Flow {
        let Some(first) = &self.start else {
            // the list contains only the tools of this job
            let head = Start { tool_order: None, ..own.clone() };
            self.start = Some(head.clone());
            return self.sink.event(Event::Start(&head), place);
        };
        let wrong = if first.units != own.units {
            let why = format!("its units are {}, not {}", own.units.name(), first.units.name());
            Some(self.wrong(1, &why, "export both jobs in the same units", place))
        } else if first.machine != own.machine {
            Some(self.wrong(1, "it is for another type of machine", "join jobs for the same machine", place))
        } else if first.set != own.set {
            let why = "its `set` for the whole program contains other values";
            Some(self.wrong(1, why, "give all jobs the same `set`, or set values in the operations", place))
        } else {
            None
        };
        wrong.map_or(Flow::Continue(()), Flow::Break)
    }

    /// Handles the beginning of an operation. The first operation of a job must set every state that earlier jobs left
    /// active.
    fn change(&mut self, change: &ToolChange, place: Place) -> Flow {
        let mut own = change.clone();
        if std::mem::take(&mut self.is_new) {
            if let Err(wrong) = self.is_complete(change, place) {
                return Flow::Break(*wrong);
            }
            // alone, the job would begin with a tool change, which retracts the tool, and without coolant
            own.reloads = true;
            if self.held.coolant.is_some_and(|coolant| coolant != Coolant::OFF) && own.coolant.is_none() {
                own.coolant = Some(Coolant::OFF);
            }
            if std::mem::take(&mut self.held.is_tilted) {
                self.sink.event(Event::Tilt([0.0, 0.0, 1.0]), place)?;
            }
        }
        if let Some(tool) = &change.tool
            && let Err(wrong) = self.is_same_tool(tool, place)
        {
            return Flow::Break(*wrong);
        }
        self.held.work = own.work.or(self.held.work);
        self.held.coolant = own.coolant.or(self.held.coolant);
        self.spindle(own.spindle.unwrap_or_default());
        own.set.iter().for_each(|(name, _)| self.sets(name));
        match &own.first {
            First::Rapid(to) => self.held.axes |= to.given,
            First::Hole(_, hole) => self.held.axes |= hole.at.given,
            First::Cut | First::Nothing => {}
        }
        self.sink.event(Event::ToolChange(&own), place)
    }

    fn is_complete(&self, change: &ToolChange, place: Place) -> Result<(), Box<Stop>> {
        let held = &self.held;
        let spindle = change.spindle.unwrap_or_default();
        let missing = if change.work.is_none() && held.work.is_some() {
            Some("work offset")
        } else {
            missing_of_spindle(spindle, held.spindle)
        };
        let mut help = "give it in the first operation of the job, or print the jobs separately";
        let why = if let Some(missing) = missing {
            format!("its first operation does not give its {missing}: the value of the job before would stay active")
        } else if let Some(name) = held.set.iter().find(|name| !change.set.iter().any(|(own, _)| own == *name)) {
            format!("its first operation does not set `{name}`: the value of the job before would stay active")
        } else if held.has_text {
            help = "make the job with text the last one, or print the jobs separately";
            "a job before it contains text for the program, whose effect is unknown".to_owned()
        } else if held.is_compensated {
            help = "turn the compensation off at the end of that job";
            "the job before ends with cutter compensation on".to_owned()
        } else if let Some(axis) = self.missing_axis(change) {
            format!(
                "its first move is not a rapid or a hole that gives {axis}: the position of the job before would apply"
            )
        } else {
            return Ok(());
        };
        Err(Box::new(self.wrong(self.part - 1, &why, help, place)))
    }

    /// An axis that the first move must contain but does not contain.
    fn missing_axis(&self, change: &ToolChange) -> Option<char> {
        let axes = JobAxes::of(self.start.as_ref()?.machine);
        let given = match &change.first {
            First::Rapid(Axes { given, .. }) => *given,
            First::Hole(_, hole) => hole.at.given,
            First::Cut | First::Nothing => 0,
        };
        let missing = (axes.first | self.held.axes) & !given;
        axes.names.into_iter().enumerate().find(|(axis, _)| missing & 1 << axis != 0).map(|(_, axis)| axis)
    }

    /// Checks that this tool number means the same tool in all jobs so far.
    fn is_same_tool(&mut self, tool: &Tool, place: Place) -> Result<(), Box<Stop>> {
        let data =
            |tool: &Tool| [tool.diameter, tool.corner_radius, tool.length_offset, tool.diameter_offset, tool.turret];
        match self.tools.get(&key(tool.number)) {
            None => _ = self.tools.insert(key(tool.number), (tool.clone(), self.part)),
            Some((known, part)) if *part != self.part && data(known) != data(tool) => {
                let why = format!("its tool {} has another diameter, corner radius or offset", tool.number);
                let help = "number the tools of all jobs alike, as they are in the machine";
                return Err(Box::new(self.wrong(*part, &why, help, place)));
            }
            Some(_) => {}
        }
        Ok(())
    }

    fn spindle(&mut self, spindle: Spindle) {
        self.held.spindle = spindle.after(self.held.spindle);
    }

    fn sets(&mut self, name: &str) {
        if is_variable(name) && !self.held.set.iter().any(|known| known == name) {
            self.held.set.push(name.to_owned());
        }
    }

    /// Updates the state that stays active after an event.
    fn follow(&mut self, event: &Event<'_>) {
        self.held.axes |= event.target().map_or(0, |to| to.given);
        match event {
            Event::Text(_) => self.held.has_text = true,
            Event::Infeed { .. } => self.held.is_compensated = true,
            Event::Outfeed { .. } => self.held.is_compensated = false,
            Event::SubCall(call) => {
                let effect = self.subs.effect(call.sub);
                self.held.axes |= effect.axes | call.at.given;
                self.held.has_text |= effect.has_text;
            }
            Event::Work(work) => self.held.work = Some(*work),
            Event::Spindle(spindle) => self.spindle(*spindle),
            Event::Coolant(coolant) => self.held.coolant = Some(*coolant),
            Event::Tilt(axis) => self.held.is_tilted = *axis != [0.0, 0.0, 1.0],
            Event::Set(name, _) => self.sets(name),
            _ => {}
        }
    }
}

impl Sink for Joining<'_> {
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        let place = Place { part: self.part, ..place };
        match &event {
            Event::Start(start) => return self.start(start, place),
            Event::ToolChange(change) => return self.change(change, place),
            Event::Finish if usize::from(self.part) < self.names.len() => return Flow::Continue(()),
            Event::SubStart(number) => match self.subprograms.get(&key(*number)) {
                Some(&part) if part != self.part => {
                    let why = format!("both have a subprogram {number}");
                    let help = "number the subprograms of all jobs differently";
                    return Flow::Break(self.wrong(part, &why, help, place));
                }
                _ => _ = self.subprograms.insert(key(*number), self.part),
            },
            Event::SubCall(call) => {
                if let Some(&part) = self.subprograms.get(&key(call.sub)).filter(|part| **part != self.part) {
                    let why = format!("it calls subprogram {}, which only an earlier job contains", call.sub);
                    return Flow::Break(self.wrong(part, &why, "add the subprogram to the job that calls it", place));
                }
            }
            _ => {}
        }
        if !self.subs.define(&event, |_| true) {
            self.follow(&event);
        }
        self.sink.event(event, place)
    }
}
