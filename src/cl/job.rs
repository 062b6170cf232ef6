//! The job that a CL file becomes: what is held back until a tool change is complete, and the events.

use super::fault::{Done, fault};
use super::missing::{no_speed, no_tool, no_units};
use super::options::Options;
use super::report::{Notes, Report};
use super::tools::{Tools, Turning};
use super::words::Word;
use crate::diag::Code;
use crate::lang::Machine;
use crate::toolpath::{
    About, Axes, Coolant, CycleSpec, Event, FeedMode, First, Hold, Place, Sink, Start, StopKind, Tool, ToolChange,
    Units,
};

/// How far from the plane of z and x a turning tool may be for rounding.
const OFF_PLANE: f64 = 1e-4;
/// Most items between a tool change and its spindle.
const MOST_WAITING: usize = 4096;

/// What stands before a tool change is complete.
pub(super) enum Waiting {
    Rapid(Axes),
    Comment(String),
    /// A block as it stands.
    Text(String),
    Stop,
}

/// The job so far.
pub(super) struct Job<'s> {
    hold: Hold<'s>,
    pub notes: Notes<'s>,
    pub tools: Tools,
    pub spindle: Turning,
    /// The job's name.
    pub name: Option<String>,
    /// Where positions count from: the first MSYS, and its line.
    pub setup: Option<(Vec<Word>, u64)>,
    units: Option<Units>,
    /// Units of a file that does not say them.
    assumed_units: Option<Units>,
    machine: Machine,
    started: bool,
    operations: u32,
    /// A tool change that is not complete.
    change: Option<(ToolChange, Place)>,
    waiting: Vec<(Waiting, Place)>,
    /// The feed that the sink has.
    feed: Option<f64>,
    /// The sink is in a cycle.
    in_cycle: bool,
    /// What comes belongs to a setup that is not read: no event of it is made.
    pub aside: bool,
    /// The tool that was loaded last.
    in_use: Option<Tool>,
}

impl<'s> Job<'s> {
    /// A job that has not begun.
    pub fn new(options: &Options, report: &'s mut Report, sink: &'s mut dyn Sink) -> Self {
        Job {
            hold: Hold::new(sink),
            notes: Notes::new(report, options.dialect),
            tools: Tools::new(options.tool.clone()),
            spindle: Turning::new(options.speed),
            name: None,
            setup: None,
            units: None,
            assumed_units: options.units,
            machine: Machine::Mill,
            started: false,
            operations: 0,
            change: None,
            waiting: Vec::new(),
            feed: None,
            in_cycle: false,
            aside: false,
            in_use: None,
        }
    }

    /// The job has begun, so plain motions need no further look.
    #[inline]
    pub fn has_started(&self) -> bool {
        self.started
    }

    /// UNITS of the file.
    pub fn set_units(&mut self, units: Units) -> Done {
        if self.units.is_some_and(|before| before != units) {
            return fault(Code::PL004, "the units change inside the file", "let the CAM system write one unit");
        }
        self.units = Some(units);
        Ok(())
    }

    /// The file's units; what is said in units of its own can't be converted before they are known.
    pub fn units(&self) -> Done<Units> {
        match self.units.or(self.assumed_units) {
            Some(units) => Ok(units),
            None => no_units(self, "the file has not said its units yet"),
        }
    }

    /// Are its units said or assumed?
    pub fn knows_units(&self) -> bool {
        self.units.or(self.assumed_units).is_some()
    }

    /// The option for a tool that the motion to come needs, and nobody loads.
    pub fn missing_tool(&self) -> Option<String> {
        let is_loaded = self.change.as_ref().map_or(self.operations > 0, |(change, _)| change.tool.is_some());
        if is_loaded { None } else { self.tools.number(self.operations == 0).err() }
    }

    /// The file is a lathe's: it has tools that turn.
    pub fn turning(&mut self) -> Done {
        if self.machine == Machine::Lathe {
            return Ok(());
        }
        if self.has_operation() {
            let help = "let the CAM system write milling and turning into files of their own";
            return fault(Code::PL004, "a turning tool after a milling tool", help);
        }
        self.leave_out_rapids();
        self.machine = Machine::Lathe;
        Ok(())
    }

    /// Is it a lathe, where the spindle turns the part?
    #[inline]
    pub fn turns_part(&self) -> bool {
        self.machine == Machine::Lathe
    }

    /// A position as events have it: on a lathe z, and x as a radius.
    #[inline]
    pub fn axes(&self, to: [f64; 3]) -> Done<Axes> {
        if !self.turns_part() {
            return Ok(Axes::new(&to));
        }
        if to[1].abs() > OFF_PLANE {
            let help = "let the CAM system turn in the plane of z and x";
            return fault(Code::PL004, format!("a turning tool at y {}", to[1]), help);
        }
        Ok(Axes::new(&[to[2], to[0]]))
    }

    /// What is printed where it stands, once the tool change before it is complete.
    pub fn wait(&mut self, waiting: Waiting) -> Done {
        if self.aside {
            return Ok(());
        }
        if self.started && self.change.is_none() {
            return self.push_waiting(&waiting, self.notes.place);
        }
        if self.waiting.len() == MOST_WAITING {
            let help = "put the spindle before them, or look whether this is a CL file";
            return fault(Code::PL004, format!("more than {MOST_WAITING} items before the spindle of a tool"), help);
        }
        self.waiting.push((waiting, self.notes.place));
        Ok(())
    }

    fn push_waiting(&mut self, waiting: &Waiting, place: Place) -> Done {
        self.close_holes()?;
        let event = match waiting {
            Waiting::Rapid(to) => Event::Rapid(*to),
            Waiting::Comment(text) => Event::Comment(text),
            Waiting::Text(text) => Event::Text(text),
            Waiting::Stop => Event::Stop(StopKind::Program),
        };
        self.hold.push(event, place)
    }

    /// An event that is no hole: the sink leaves its cycle for it.
    pub fn between(&mut self, event: Event<'_>) -> Done {
        self.close_holes()?;
        self.push(event)
    }

    /// An event; what waits for it goes first.
    #[inline]
    pub fn push(&mut self, event: Event<'_>) -> Done {
        if self.aside {
            return Ok(());
        }
        if self.change.is_some() || !self.started || self.operations == 0 {
            self.release()?;
        }
        self.hold.push(event, self.notes.place)
    }

    /// The sink goes into a cycle.
    pub fn open_holes(&mut self, spec: &CycleSpec) -> Done {
        self.push(Event::CycleBegin(spec))?;
        self.in_cycle = true;
        Ok(())
    }

    /// Is the sink in a cycle?
    pub fn holes_are_open(&self) -> bool {
        self.in_cycle
    }

    /// The sink leaves the cycle; it may go on after a motion that is none of its points.
    pub fn close_holes(&mut self) -> Done {
        if std::mem::take(&mut self.in_cycle) { self.push(Event::CycleEnd) } else { Ok(()) }
    }

    /// Begins the job and the operation: nothing more is to come that belongs before.
    #[cold]
    fn release(&mut self) -> Done {
        if !self.started {
            let Some(units) = self.units.or(self.assumed_units) else {
                return no_units(self, "the file does not say its units");
            };
            self.units = Some(units);
            let start = Start {
                program: None,
                name: self.name.clone(),
                about: About { part: self.name.clone(), ..About::default() },
                units,
                machine: self.machine,
                set: Vec::new(),
                tool_order: None,
            };
            self.hold.push(Event::Start(&start), self.notes.place)?;
            self.started = true;
        }
        if self.change.is_none() && self.operations == 0 {
            self.change = Some((self.operation(None), self.notes.place));
        }
        if let Some((mut change, place)) = self.change.take() {
            if change.tool.is_none() {
                let number = match self.tools.number(self.operations == 0) {
                    Ok(number) => number,
                    Err(option) => return no_tool(self, &option),
                };
                self.tools.goes_by_its_name();
                change.tool = Some(Tool { number, ..Tool::default() });
            }
            change.spindle = Some(self.spindle.in_force()).filter(|spindle| *spindle != Default::default());
            change.name = self.tools.operation.take();
            if let Some(tool) = &mut change.tool {
                tool.diameter = self.tools.diameter.filter(|_| self.machine == Machine::Mill);
                tool.name.clone_from(&self.tools.name);
                tool.comment = self.tools.said.take();
                if tool.name.is_none() {
                    tool.name.clone_from(&tool.comment);
                }
            }
            self.operations += 1;
            self.feed = None;
            self.hold.tool_change(change, place)?;
        }
        for (waiting, place) in std::mem::take(&mut self.waiting) {
            self.push_waiting(&waiting, place)?;
        }
        Ok(())
    }

    /// An operation that says its coolant alone.
    fn operation(&self, tool: Option<Tool>) -> ToolChange {
        ToolChange {
            name: None,
            tool,
            spindle: None,
            coolant: self.tools.coolant,
            work: None,
            feed: None,
            plunge: None,
            feed_mode: self.turns_part().then_some(FeedMode::PerRev),
            comment: None,
            set: Vec::new(),
            first: First::Nothing,
        }
    }

    /// Begins the change to another tool: the change before it is complete, whatever was done with that tool; one that
    /// is only named gives way. A waiting change to the same tool goes on.
    pub fn begin_change(&mut self, tool: Option<Tool>) -> Done {
        if let (Some((change, _)), Some(tool)) = (&mut self.change, &tool)
            && let Some(before) = change.tool.as_mut().filter(|before| before.number == tool.number)
        {
            before.length_offset = tool.length_offset.or(before.length_offset);
            return Ok(());
        }
        if !self.aside && self.change.as_ref().is_some_and(|(change, _)| change.tool.is_some()) {
            self.release()?;
        }
        self.in_use.clone_from(&tool);
        if tool.is_some() && self.operations == 0 {
            self.leave_out_rapids();
        }
        self.change = Some((self.operation(tool), self.notes.place));
        Ok(())
    }

    /// The setup that is read begins: with the tool that is there, unless another one is being loaded.
    pub fn begin_setup(&mut self) {
        self.aside = false;
        if self.change.is_none()
            && let Some(tool) = self.in_use.clone()
        {
            self.change = Some((self.operation(Some(tool)), self.notes.place));
        }
    }

    /// Rapids before the first tool go to where it is loaded, which is the machine's to know.
    fn leave_out_rapids(&mut self) {
        let is_rapid = |waiting: &(Waiting, Place)| matches!(waiting.0, Waiting::Rapid(_));
        let count = self.waiting.iter().filter(|waiting| is_rapid(waiting)).count();
        let Some((_, place)) = self.waiting.iter().find(|waiting| is_rapid(waiting)) else { return };
        let message = if count == 1 {
            "a rapid before the first tool is left out".to_owned()
        } else {
            format!("{count} rapids before the first tool, from line {} on, are left out", place.line)
        };
        let help = "the machine goes to its tool change by itself; put LOADTL before what it shall do besides";
        self.notes.warn_at(*place, Code::PL008, message, help);
        self.waiting.retain(|waiting| !is_rapid(waiting));
    }

    /// Nothing moved so far that is part of the job.
    pub fn is_unmoved(&self) -> bool {
        self.operations == 0 && !self.waiting.iter().any(|(waiting, _)| matches!(waiting, Waiting::Rapid(_)))
    }

    /// Is a tool change waiting to be complete?
    #[inline]
    pub fn changes(&self) -> bool {
        self.change.is_some()
    }

    /// Has a tool been loaded, or anything moved?
    pub fn has_operation(&self) -> bool {
        self.operations > 0 || self.change.is_some()
    }

    /// COOLNT: with the tool change that waits, else as an event.
    pub fn coolant(&mut self, coolant: Coolant) -> Done {
        self.tools.coolant = Some(coolant);
        match &mut self.change {
            Some((change, _)) => change.coolant = Some(coolant),
            None if self.operations > 0 => return self.between(Event::Coolant(coolant)),
            None => {}
        }
        Ok(())
    }

    /// A feed for the motion that comes, where the sink does not have it yet.
    #[inline]
    pub fn feed_to_say(&mut self, feed: f64) -> Option<f64> {
        if self.change.is_some() {
            return Some(feed); // an operation that is about to begin forgets the feed
        }
        if self.feed == Some(feed) {
            return None;
        }
        self.feed = Some(feed);
        Some(feed)
    }

    /// Is there a speed to cut with?
    #[inline]
    pub fn turns(&self) -> Done {
        if self.spindle.is_known() { Ok(()) } else { no_speed(self) }
    }

    /// The end of the file.
    pub fn finish(&mut self) -> Done {
        if !self.has_operation() && self.is_unmoved() {
            return fault(Code::PJ009, "the file has no motion", "look whether this is a CL file");
        }
        if std::mem::take(&mut self.aside) {
            self.change = None; // for what is not read
            self.waiting.clear();
        }
        self.push(Event::Finish)
    }
}
