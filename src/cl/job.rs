//! The job of a CL file. Collects all data of a tool change until the tool change is complete, and pushes the events.

use super::fault::{Done, fault};
use super::missing::{no_speed, no_tool, no_units};
use super::options::Options;
use super::report::{Notes, Report};
use super::tools::{Tools, Turning};
use super::words::Word;
use crate::diag::Code;
use crate::lang::Machine;
use crate::toolpath::{
    About, Axes, Coolant, CycleSpec, Event, FeedMode, Hold, Place, Sink, Start, StopKind, Tool, ToolChange, Units,
};

/// Tolerance for the distance of a turning tool from the plane of z and x, which allows for rounding.
const OFF_PLANE: f64 = 1e-4;
/// Maximum number of items between a tool change and the spindle statement after it.
const MOST_WAITING: usize = 4096;

/// An item that waits until the tool change before it is complete.
pub(super) enum Waiting {
    Rapid(Axes),
    Comment(String),
    /// Text that is printed unchanged as a block.
    Text(String),
    Stop,
}

/// The job as far as it was read.
pub(super) struct Job<'s> {
    hold: Hold<'s>,
    pub notes: Notes<'s>,
    pub tools: Tools,
    pub spindle: Turning,
    /// The job's name.
    pub name: Option<String>,
    /// The origin of the positions: the words of the first MSYS or MCS, and its line.
    pub setup: Option<(Vec<Word>, u64)>,
    units: Option<Units>,
    /// The units to assume if the file does not define them.
    assumed_units: Option<Units>,
    machine: Machine,
    started: bool,
    operations: u32,
    /// A tool change whose data are not complete yet.
    change: Option<(ToolChange, Place)>,
    waiting: Vec<(Waiting, Place)>,
    /// The feed that the sink has.
    feed: Option<f64>,
    /// Whether a cycle is open in the sink.
    in_cycle: bool,
    /// Whether the following items belong to a setup that is not selected. No events are pushed for these items.
    pub aside: bool,
    /// The tool that was loaded last.
    in_use: Option<Tool>,
    /// Whether the last operation has a work offset.
    has_work: bool,
    /// The texts between the beginning of a tool path and its MCS, which gives the setup of the tool path.
    heading: Option<Vec<(Waiting, Place)>>,
}

impl<'s> Job<'s> {
    /// A new job.
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
            has_work: false,
            heading: None,
        }
    }

    /// Whether the job has begun. After the beginning, plain motions need no further checks.
    #[inline]
    pub fn has_started(&self) -> bool {
        self.started
    }

    /// Handles a UNITS statement. The units must be those of the values before it, which may be the assumed units.
    pub fn set_units(&mut self, units: Units) -> Done {
        if self.units.is_some_and(|before| before != units) {
            let help = "put UNITS at the beginning of the file, and let the CAM system write one unit";
            return fault(Code::PL004, "these units differ from the units of the statements before them", help);
        }
        self.units = Some(units);
        Ok(())
    }

    /// The file's units, for the conversion of a value. From then on, the units stay the same. The function fails if the units
    /// are unknown, because values with an explicit unit can't be converted then.
    pub fn units(&mut self) -> Done<Units> {
        match self.units.or(self.assumed_units) {
            Some(units) => Ok(*self.units.insert(units)),
            None => no_units(self, "the units of the file are not known yet"),
        }
    }

    /// Whether the units are given in the file or assumed.
    pub fn knows_units(&self) -> bool {
        self.units.or(self.assumed_units).is_some()
    }

    /// The option that gives the number of the tool, if a motion follows and no tool is loaded.
    pub fn missing_tool(&self) -> Option<String> {
        let is_loaded = self.change.as_ref().map_or(self.operations > 0, |(change, _)| change.tool.is_some());
        if is_loaded { None } else { self.tools.number(self.operations == 0).err() }
    }

    /// Sets that the file is for a lathe, because the file has turning tools.
    pub fn turning(&mut self) -> Done {
        if self.machine == Machine::Lathe {
            return Ok(());
        }
        if self.has_operation() {
            let help = "let the CAM system write milling and turning into separate files";
            return fault(Code::PL004, "a turning tool after a milling tool", help);
        }
        self.leave_out_rapids();
        self.machine = Machine::Lathe;
        Ok(())
    }

    /// Whether the machine is a lathe. The spindle of a lathe turns the part.
    #[inline]
    pub fn turns_part(&self) -> bool {
        self.machine == Machine::Lathe
    }

    /// Converts a position for events. On a lathe, the position is z, and a radius as x.
    #[inline]
    pub fn axes(&self, to: [f64; 3]) -> Done<Axes> {
        if !self.turns_part() {
            return Ok(Axes::new(&to));
        }
        if to[1].abs() > OFF_PLANE {
            let help = "let the CAM system turn in the ZX plane";
            return fault(Code::PL004, format!("a turning tool at y {}", to[1]), help);
        }
        Ok(Axes::new(&[to[2], to[0]]))
    }

    /// Keeps an item until the tool change before it is complete. If no tool change waits, pushes the item.
    pub fn wait(&mut self, waiting: Waiting) -> Done {
        match &mut self.heading {
            Some(heading) => {
                heading.push((waiting, self.notes.place));
                Ok(())
            }
            None => self.wait_at(waiting, self.notes.place),
        }
    }

    /// Keeps the texts after this point until [`Job::end_heading`].
    pub fn begin_heading(&mut self) {
        self.heading.get_or_insert_default();
    }

    /// Pushes the texts since the beginning of a tool path. The setup of the tool path is known by now.
    pub fn end_heading(&mut self) -> Done {
        self.heading.take().into_iter().flatten().try_for_each(|(text, place)| self.wait_at(text, place))
    }

    fn wait_at(&mut self, waiting: Waiting, place: Place) -> Done {
        if self.aside {
            return Ok(());
        }
        if self.started && self.change.is_none() {
            return self.push_waiting(&waiting, place);
        }
        if self.waiting.len() == MOST_WAITING {
            let help = "put SPINDL before them, or check that this is a CL file";
            return fault(Code::PL004, format!("more than {MOST_WAITING} items before SPINDL of a tool"), help);
        }
        self.waiting.push((waiting, place));
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

    /// Closes the cycle in the sink and pushes an event that is not a hole.
    pub fn between(&mut self, event: Event<'_>) -> Done {
        self.close_holes()?;
        self.push(event)
    }

    /// Pushes an event. Items that wait are pushed first.
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

    /// Opens a cycle in the sink.
    pub fn open_holes(&mut self, spec: &CycleSpec) -> Done {
        self.push(Event::CycleBegin(spec))?;
        self.in_cycle = true;
        Ok(())
    }

    /// Whether a cycle is open in the sink.
    pub fn holes_are_open(&self) -> bool {
        self.in_cycle
    }

    /// Closes the cycle in the sink. The cycle may be opened again after a motion that is not a point of the cycle.
    pub fn close_holes(&mut self) -> Done {
        if std::mem::take(&mut self.in_cycle) { self.push(Event::CycleEnd) } else { Ok(()) }
    }

    /// Begins the job and the operation. All their data must be known by now.
    #[cold]
    fn release(&mut self) -> Done {
        if !self.started {
            let Some(units) = self.units.or(self.assumed_units) else {
                return no_units(self, "the file does not give its units");
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
            if change.spindle.is_none_or(|spindle| spindle.speed.is_none()) {
                self.notes.without_speed = Some((place.line, self.notes.place.line));
            }
            change.name = self.tools.operation.take();
            if let Some(tool) = &mut change.tool {
                tool.diameter = self.tools.diameter.get().copied().filter(|_| self.machine == Machine::Mill);
                tool.name = self.tools.name.get().cloned();
                tool.comment = self.tools.said.take();
                if tool.name.is_none() {
                    tool.name.clone_from(&tool.comment);
                }
            }
            let has_work = change.work.is_some();
            if self.operations > 0 && has_work != self.has_work {
                let help = "in the CAM system, give each setup the number of its work offset";
                let message = "some tool paths of the file have a work offset (ZERO), and others have none";
                return fault(Code::PL004, message, help);
            }
            self.has_work = has_work;
            self.operations += 1;
            self.feed = None;
            self.hold.tool_change(change, place)?;
        }
        for (waiting, place) in std::mem::take(&mut self.waiting) {
            self.push_waiting(&waiting, place)?;
        }
        Ok(())
    }

    /// A new operation with this tool and the current coolant.
    fn operation(&self, tool: Option<Tool>) -> ToolChange {
        ToolChange {
            tool,
            coolant: self.tools.coolant,
            feed_mode: self.turns_part().then_some(FeedMode::PerRev),
            ..ToolChange::default()
        }
    }

    /// Completes the previous tool change and begins the change to another tool. If the previous tool was only named
    /// and not loaded, the new change replaces the previous change. If a change to the same tool is waiting, the
    /// waiting change continues.
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

    /// Begins the selected setup. Unless another tool is being loaded, the setup uses the current tool.
    pub fn begin_setup(&mut self) {
        self.aside = false;
        if self.change.is_none()
            && let Some(tool) = self.in_use.clone()
        {
            self.change = Some((self.operation(Some(tool)), self.notes.place));
        }
    }

    /// Removes a tool change that has no motion, because the setup after it loads its own tool.
    pub fn drop_change(&mut self) {
        self.change = None;
    }

    /// Removes rapids before the first tool. These rapids lead to the tool change position, which only the machine
    /// defines.
    fn leave_out_rapids(&mut self) {
        let is_rapid = |waiting: &(Waiting, Place)| matches!(waiting.0, Waiting::Rapid(_));
        let count = self.waiting.iter().filter(|waiting| is_rapid(waiting)).count();
        let Some((_, place)) = self.waiting.iter().find(|waiting| is_rapid(waiting)) else { return };
        let message = if count == 1 {
            "a rapid before the first tool is left out".to_owned()
        } else {
            format!("{count} rapids before the first tool, from line {} on, are left out", place.line)
        };
        let help = "the machine moves to its tool change position by itself; put LOADTL before the first rapid that \
                    must be printed";
        self.notes.warn_at(*place, Code::PL008, message, help);
        self.waiting.retain(|waiting| !is_rapid(waiting));
    }

    /// Whether the job has no motion so far.
    pub fn is_unmoved(&self) -> bool {
        self.operations == 0 && !self.waiting.iter().any(|(waiting, _)| matches!(waiting, Waiting::Rapid(_)))
    }

    /// Handles the beginning of a motion: the statements before the motion are not for the next tool.
    #[inline]
    pub fn begin_motion(&mut self) {
        self.spindle.is_new = false;
        self.tools.begin_motion();
    }

    /// Whether a tool change is waiting to be completed.
    #[inline]
    pub fn changes(&self) -> bool {
        self.change.is_some()
    }

    /// Whether a tool was loaded or a motion was pushed.
    pub fn has_operation(&self) -> bool {
        self.operations > 0 || self.change.is_some()
    }

    /// Handles COOLNT. If a tool change is waiting, the coolant becomes part of the tool change; otherwise the coolant
    /// becomes an event.
    pub fn coolant(&mut self, coolant: Coolant) -> Done {
        self.tools.coolant = Some(coolant);
        match &mut self.change {
            Some((change, _)) => change.coolant = Some(coolant),
            None if self.operations > 0 => return self.between(Event::Coolant(coolant)),
            None => {}
        }
        Ok(())
    }

    /// Handles the work offset of the tool change that is waiting.
    pub fn work_offset(&mut self, number: f64) -> Done {
        match &mut self.change {
            Some((change, _)) => change.work = Some(number),
            None => {
                let help = "put it after the LOADTL of its tool path";
                return fault(Code::PL004, "a work offset inside a tool path", help);
            }
        }
        Ok(())
    }

    /// Handles the beginning of a tool path in a file in which each tool path gives its coolant, except for no coolant.
    pub fn begin_section(&mut self) -> Done {
        self.tools.coolant = self.tools.coolant.map(|_| Coolant::OFF);
        self.end_heading()
    }

    /// The register of the current tool's diameter, if the file gives it with the tool.
    pub fn diameter_register(&self) -> Option<f64> {
        self.in_use.as_ref().and_then(|tool| tool.diameter_offset)
    }

    /// The feed for the next motion. `None`: the sink already has this feed.
    #[inline]
    pub fn feed_to_say(&mut self, feed: f64) -> Option<f64> {
        if self.change.is_some() {
            return Some(feed); // the sink forgets the feed at a new operation
        }
        if self.feed == Some(feed) {
            return None;
        }
        self.feed = Some(feed);
        Some(feed)
    }

    /// Checks that the spindle speed for a cut is known.
    #[inline]
    pub fn turns(&self) -> Done {
        if self.spindle.is_known() { Ok(()) } else { no_speed(self) }
    }

    /// Handles the end of the file.
    pub fn finish(&mut self) -> Done {
        self.end_heading()?;
        if !self.has_operation() && self.is_unmoved() {
            return fault(Code::PJ009, "the file has no motion", "check that this is a CL file");
        }
        if std::mem::take(&mut self.aside) {
            self.change = None; // the tool change belongs to a setup that is not selected
            self.waiting.clear();
        }
        self.push(Event::Finish)
    }
}
