//! Converts the objects of a job to events. Checks the rules that concern more than one key.

use std::collections::{HashMap, HashSet};

use super::convert::{arc_of, call_of, fault, not_negative, positive, spec_of, spindle_of, thread_of, tool_of, whole};
use super::objects::{CycleObject, EndWord, ItemObject, JobHead, Object, OperationHead, SubprogramHead};
use super::values::{Number, Position};
use crate::diag::Code;
use crate::toolpath::{
    About, Axes, Event, Hold, Hole, Infeed, LastDwell, Place, Sink, Start, Stop, Tool, ToolChange, key,
};

type Done = Result<(), Stop>;

/// The largest number of tools that a message lists.
const MOST_NAMED: usize = 20;

/// Receives the parts of a job in the order of the job and pushes the events of each part.
pub struct Builder<'s> {
    hold: Hold<'s>,
    /// The location of the next event. Readers set the line and column of this location.
    pub place: Place,
    /// The tools in the order of the job.
    tools: Vec<Tool>,
    /// For each tool number, the index of the first tool with this number.
    by_number: HashMap<u64, usize>,
    /// Tool numbers, each with its turret position. Each pair of number and turret position may occur only once.
    listed: HashSet<(u64, Option<u64>)>,
    tool_needed: bool,
    tool: Option<f64>,
    dwell: LastDwell,
    in_cycle: bool,
    in_subprogram: bool,
}

impl<'s> Builder<'s> {
    /// A builder that pushes events to `sink`.
    pub fn new(sink: &'s mut dyn Sink) -> Self {
        Builder {
            hold: Hold::new(sink),
            place: Place::default(),
            tools: Vec::new(),
            by_number: HashMap::new(),
            listed: HashSet::new(),
            tool_needed: true,
            tool: None,
            dwell: LastDwell::default(),
            in_cycle: false,
            in_subprogram: false,
        }
    }

    fn push(&mut self, event: Event<'_>) -> Done {
        self.hold.push(event, self.place)
    }

    /// Pushes the head of the job.
    pub fn start(&mut self, head: JobHead) -> Done {
        if head.version.is_some_and(|v| v.0 != 1.0) {
            return fault(Code::PJ003, "this version reads jobs with \"postform\": 1", "write \"postform\": 1");
        }
        for tool in head.tools.unwrap_or_default() {
            let tool = tool_of(tool)?;
            if !self.listed.insert((key(tool.number), tool.turret.map(key))) {
                let message = format!("two tools have the number {}", tool.number);
                return fault(Code::PJ010, message, "give each tool a different number");
            }
            self.by_number.entry(key(tool.number)).or_insert(self.tools.len());
            self.tools.push(tool);
        }
        let Some(units) = head.units else {
            let help = "write \"units\": \"mm\" or \"units\": \"inch\"";
            return fault(Code::PJ004, "the job has no units", help);
        };
        let machine = head.machine.map_or(Default::default(), |m| m.0);
        self.tool_needed = machine != crate::lang::Machine::Edm;
        let start = Start {
            program: head.program.map(|p| whole("program", p)).transpose()?,
            name: head.name,
            about: About { part: head.part, material: head.material, customer: head.customer, author: head.author },
            units: units.0,
            machine,
            set: head.set.unwrap_or_default().0,
            tool_order: head.tool_order.map(|order| order.iter().map(|n| n.0).collect()),
        };
        self.push(Event::Start(&start))
    }

    /// Begins a subprogram. Subprograms must come before the operations.
    pub fn subprogram(&mut self, head: SubprogramHead) -> Done {
        self.leave_cycle("a subprogram")?;
        if self.in_subprogram || self.place.operation > 0 {
            let help = "end the other part first; write the subprograms one after the other, before the operations";
            return fault(Code::PJ011, "a subprogram inside another part of the job", help);
        }
        let Some(number) = head.number else {
            return fault(Code::PJ004, "a subprogram without a number", "give each subprogram a \"number\"");
        };
        let number = whole("number", number)?;
        self.place.subprogram = self.place.subprogram.saturating_add(1);
        self.place.item = 0;
        self.in_subprogram = true;
        self.push(Event::SubStart(number))
    }

    /// Ends the open subprogram.
    pub fn subprogram_end(&mut self) -> Done {
        self.leave_cycle("the end of a subprogram")?;
        if !self.in_subprogram {
            return fault(Code::PJ011, "the end of a subprogram that did not begin", "take it out");
        }
        self.in_subprogram = false;
        self.push(Event::SubEnd)
    }

    /// Begins an operation.
    pub fn operation(&mut self, head: OperationHead) -> Done {
        self.leave_cycle("an operation")?;
        if self.in_subprogram {
            return fault(Code::PJ011, "an operation inside a subprogram", "end the subprogram first");
        }
        self.place.subprogram = 0;
        self.place.operation += 1;
        self.place.item = 0;
        let number = head.tool.map(|n| n.0).or(self.tool);
        let tool = match number {
            None if self.tool_needed => {
                return fault(Code::PJ006, "the operation has no tool", "give the tool's number, as \"tool\": 1");
            }
            None => None,
            Some(number) => match self.by_number.get(&key(number)) {
                Some(&at) => Some(self.tools[at].clone()),
                None => {
                    let known: Vec<_> = self.tools.iter().take(MOST_NAMED).map(|t| t.number.to_string()).collect();
                    let more = if self.tools.len() > MOST_NAMED { " and others" } else { "" };
                    let help = match known.len() {
                        0 => "list the tools under \"tools\", before the operations".to_owned(),
                        _ => format!("add the tool to \"tools\", or use one of {}{more}", known.join(", ")),
                    };
                    return fault(Code::PJ006, format!("tool {number} is not among the job's tools"), help);
                }
            },
        };
        self.tool = number;
        let change = ToolChange {
            name: head.name,
            tool,
            spindle: head.spindle.map(|s| spindle_of(&s)).transpose()?,
            coolant: head.coolant.map(|c| c.0),
            work: head.work.map(|w| not_negative("work", w)).transpose()?,
            feed: head.feed.map(|f| positive("feed", f)).transpose()?,
            plunge: head.plunge.map(|f| positive("plunge", f)).transpose()?,
            feed_mode: head.feed_mode.map(|m| m.0),
            comment: head.comment,
            set: head.set.map_or_else(Vec::new, |set| set.0),
            ..ToolChange::default()
        };
        self.hold.tool_change(change, self.place)
    }

    /// Pushes an item of a path, except a cycle.
    pub fn item(&mut self, item: &ItemObject) -> Done {
        self.leave_cycle("an item")?;
        self.in_operation()?;
        let feed = item.feed.map(|f| positive("feed", f)).transpose()?;
        check_one(item)?;
        if let Some(to) = item.rapid {
            self.push(Event::Rapid(moving("rapid", to)?))
        } else if let Some(to) = item.line {
            self.push(Event::Line { to: moving("line", to)?, feed })
        } else if let Some(arc) = &item.arc {
            let arc = arc_of(arc)?;
            self.push(Event::Arc { arc: &arc, feed })
        } else if let (Some(to), Some(side)) = (item.infeed, item.side) {
            self.push(Event::Infeed { infeed: &Infeed { to: moving("infeed", to)?, side: side.0, rapid: false }, feed })
        } else if let Some(to) = item.outfeed {
            self.push(Event::Outfeed { to: moving("outfeed", to)?, feed, rapid: false })
        } else if let Some(thread) = &item.thread {
            let thread = thread_of(thread)?;
            self.push(Event::Thread(&thread))
        } else if let Some(call) = &item.call {
            let call = call_of(call)?;
            self.push(Event::SubCall(&call))
        } else if let Some(feed) = feed {
            self.push(Event::Feed(feed))
        } else {
            self.between_moves(item)
        }
    }

    /// Pushes an item that is not a move.
    fn between_moves(&mut self, item: &ItemObject) -> Done {
        if let Some(section) = item.begin {
            return self.push(Event::Begin(section.0));
        }
        match item.end {
            Some(EndWord::Section(section)) => return self.push(Event::End(section)),
            Some(EndWord::Job) => {
                return fault(Code::PJ003, "`end` is true inside a path", "name the part of the path that ends");
            }
            None => {}
        }
        if let Some(action) = item.edm {
            return self.push(Event::Edm(action.0));
        }
        if let Some(home) = item.home {
            if !home {
                return fault(
                    Code::PJ003,
                    "`home` is false, so the item does nothing",
                    "remove the item, or write true",
                );
            }
            return self.push(Event::Home);
        }
        if let Some(seconds) = item.dwell {
            return self.push(Event::Dwell(not_negative("dwell", seconds)?));
        }
        if let Some(kind) = item.stop {
            return self.push(Event::Stop(kind.0));
        }
        if let Some(text) = &item.comment {
            return self.push(Event::Comment(text));
        }
        if let Some(text) = &item.text {
            if text.contains(['\n', '\r']) {
                return fault(Code::PJ003, "`text` contains more than one line", "make a separate item of each block");
            }
            return self.push(Event::Text(text));
        }
        if let Some(work) = item.work {
            return self.push(Event::Work(not_negative("work", work)?));
        }
        if let Some(spindle) = &item.spindle {
            return self.push(Event::Spindle(spindle_of(spindle)?));
        }
        if let Some(coolant) = item.coolant {
            return self.push(Event::Coolant(coolant.0));
        }
        for (name, value) in item.set.iter().flat_map(|set| &set.0) {
            self.push(Event::Set(name, value))?;
        }
        Ok(())
    }

    /// Pushes a rapid or a line without creating an item object first. Most items of a job are rapids or lines.
    #[inline]
    pub fn simple_move(&mut self, to: Axes, feed: Option<f64>, rapid: bool) -> Done {
        if self.in_cycle || (self.place.operation == 0 && !self.in_subprogram) {
            self.leave_cycle("an item")?;
            self.in_operation()?;
        }
        if let Some(feed) = feed {
            positive("feed", Number(feed))?;
        }
        self.push(if rapid { Event::Rapid(to) } else { Event::Line { to, feed } })
    }

    /// Begins a cycle.
    pub fn cycle_begin(&mut self, cycle: &CycleObject) -> Done {
        self.leave_cycle("a cycle")?;
        self.in_operation()?;
        let mut spec = spec_of(cycle)?;
        self.dwell.fill(&mut spec);
        self.in_cycle = true;
        self.place.point = 0;
        self.push(Event::CycleBegin(&spec))
    }

    /// Pushes one point of the open cycle.
    pub fn hole(&mut self, hole: Hole) -> Done {
        if !self.in_cycle {
            return fault(Code::PJ011, "a point outside a cycle", "begin the cycle first, as {\"cycle\": {...}}");
        }
        self.place.point += 1;
        if hole.at.given == 0 {
            let help = "remove the point, or write the position of its hole, as [1, 1, 0]";
            return fault(Code::PJ003, "a point gives no axis, so its hole has no position", help);
        }
        self.push(Event::Hole(hole))
    }

    /// Ends the open cycle.
    pub fn cycle_end(&mut self) -> Done {
        if !self.in_cycle {
            return fault(Code::PJ011, "the end of a cycle that did not begin", "take it out");
        }
        if self.place.point == 0 {
            return fault(
                Code::PJ004,
                "the cycle has no points",
                "give the cycle's points, as \"points\": [[1, 1, 0]]",
            );
        }
        self.in_cycle = false;
        self.place.point = 0;
        self.push(Event::CycleEnd)
    }

    /// Ends the job.
    pub fn finish(&mut self) -> Done {
        self.leave_cycle("the end")?;
        if self.in_subprogram {
            return fault(Code::PJ011, "the job ends inside a subprogram", "end the subprogram first");
        }
        if self.place.operation == 0 {
            return fault(Code::PJ009, "the job has no operations", "give at least one operation");
        }
        self.place = Place { line: self.place.line, column: self.place.column, ..Place::default() };
        self.push(Event::Finish)
    }

    fn leave_cycle(&self, what: &str) -> Done {
        if self.in_cycle {
            return fault(
                Code::PJ011,
                format!("{what} inside a cycle"),
                "end the cycle first with {\"cycle_end\": true}",
            );
        }
        Ok(())
    }

    fn in_operation(&self) -> Done {
        if self.place.operation == 0 && !self.in_subprogram {
            return fault(
                Code::PJ006,
                "a path item before any operation, so without a tool",
                "begin an operation first",
            );
        }
        Ok(())
    }
}

/// The position of a move, which gives at least one axis.
fn moving(key: &str, to: Position) -> Result<Axes, Stop> {
    if to.0.given == 0 {
        let help = "remove the item, or write a position, as [1, 2.5, null]";
        return fault(Code::PJ003, format!("`{key}` gives no axis, so the item does nothing"), help);
    }
    Ok(to.0)
}

/// Checks that an item has exactly one main key. A feed or side that belongs to a move is not a main key.
fn check_one(item: &ItemObject) -> Done {
    let moves = item.line.is_some() || item.arc.is_some() || item.infeed.is_some() || item.outfeed.is_some();
    let kinds = [
        item.rapid.is_some(),
        item.line.is_some(),
        item.arc.is_some(),
        item.infeed.is_some(),
        item.outfeed.is_some(),
        item.begin.is_some(),
        item.end.is_some(),
        item.call.is_some(),
        item.thread.is_some(),
        item.edm.is_some(),
        item.home.is_some(),
        item.dwell.is_some(),
        item.stop.is_some(),
        item.comment.is_some(),
        item.text.is_some(),
        item.feed.is_some() && !moves,
        item.work.is_some(),
        item.spindle.is_some(),
        item.coolant.is_some(),
        item.set.is_some(),
    ];
    match kinds.iter().filter(|&&kind| kind).count() {
        1 if item.side.is_some() != item.infeed.is_some() => {
            let help = "write {\"infeed\": [1, 2], \"side\": \"left\"}";
            fault(Code::PJ005, "`side` and `infeed` must be given together", help)
        }
        1 => Ok(()),
        0 => {
            let help = format!("give one of {}", ItemObject::KEYS.join(", "));
            fault(Code::PJ004, "the path item is empty", help)
        }
        _ => fault(Code::PJ005, "the path item contains more than one action", "make a separate item of each action"),
    }
}
