//! From objects of a job to events, with the checks that need more than one key.

use super::objects::{
    ArcObject, CallObject, CycleObject, EndWord, ItemObject, JobHead, Object, OperationHead, SpindleObject,
    SubprogramHead, ThreadObject, ToolObject,
};
use super::values::{Number, PeckMode, SpeedMode};
use crate::diag::{Code, Diag};
use crate::toolpath::event::*;
use crate::toolpath::{Hold, Place, Sink};

type Done = Result<(), Box<Diag>>;

fn fault<T>(code: Code, message: impl Into<String>, help: impl Into<String>) -> Result<T, Box<Diag>> {
    Err(Box::new(Diag::new(code, message).help(help)))
}

/// Takes the parts of a job in order and pushes events.
pub struct Builder<'s> {
    hold: Hold<'s>,
    /// The place of what comes next; readers keep line and column.
    pub place: Place,
    tools: Vec<Tool>,
    tool_needed: bool,
    tool: Option<f64>,
    in_cycle: bool,
    in_subprogram: bool,
}

impl<'s> Builder<'s> {
    /// Pushes to `sink`.
    pub fn new(sink: &'s mut dyn Sink) -> Self {
        Builder {
            hold: Hold::new(sink),
            place: Place::default(),
            tools: Vec::new(),
            tool_needed: true,
            tool: None,
            in_cycle: false,
            in_subprogram: false,
        }
    }

    fn push(&mut self, event: Event<'_>) -> Done {
        self.hold.event(event, self.place)
    }

    /// The head of the job.
    pub fn start(&mut self, head: JobHead) -> Done {
        if head.version.is_some_and(|v| v.0 != 1.0) {
            return fault(Code::PJ003, "this version reads jobs with \"postform\": 1", "write \"postform\": 1");
        }
        for tool in head.tools.unwrap_or_default() {
            let tool = tool_of(tool)?;
            if self.tools.iter().any(|t| t.number == tool.number && t.turret == tool.turret) {
                let message = format!("two tools have the number {}", tool.number);
                return fault(Code::PJ010, message, "give each tool a number of its own");
            }
            self.tools.push(tool);
        }
        let machine = head.machine.map_or(Default::default(), |m| m.0);
        self.tool_needed = machine != crate::lang::Machine::Edm;
        let start = Start {
            program: head.program.map(|p| whole("program", p)).transpose()?,
            name: head.name,
            units: head.units.map_or(Units::Inch, |u| u.0),
            machine,
            set: head.set.unwrap_or_default().0,
            tool_order: head.tool_order.map(|order| order.iter().map(|n| n.0).collect()),
        };
        self.push(Event::Start(&start))
    }

    /// A subprogram begins. Subprograms stand before the operations that call them.
    pub fn subprogram(&mut self, head: SubprogramHead) -> Done {
        self.leave_cycle("a subprogram")?;
        if self.in_subprogram || self.place.operation > 0 {
            let help = "end it first; subprograms stand one after the other, before the operations";
            return fault(Code::PJ005, "a subprogram inside another part of the job", help);
        }
        let Some(number) = head.number else {
            return fault(Code::PJ004, "a subprogram without a number", "give each subprogram a \"number\"");
        };
        let number = whole("number", number)?;
        self.place.subprogram += 1;
        self.place.item = 0;
        self.in_subprogram = true;
        self.push(Event::SubStart(number))
    }

    /// The open subprogram ends.
    pub fn subprogram_end(&mut self) -> Done {
        self.leave_cycle("the end of a subprogram")?;
        if !self.in_subprogram {
            return fault(Code::PJ005, "the end of a subprogram that did not begin", "take it out");
        }
        self.in_subprogram = false;
        self.push(Event::SubEnd)
    }

    /// An operation begins.
    pub fn operation(&mut self, head: OperationHead) -> Done {
        self.leave_cycle("an operation")?;
        if self.in_subprogram {
            return fault(Code::PJ005, "an operation inside a subprogram", "end the subprogram first");
        }
        self.place.subprogram = 0;
        self.place.operation += 1;
        self.place.item = 0;
        let number = head.tool.map(|n| n.0).or(self.tool);
        let tool = match number {
            None if self.tool_needed => {
                return fault(Code::PJ006, "the operation has no tool", "give its number, as \"tool\": 1");
            }
            None => None,
            Some(number) => match self.tools.iter().find(|t| t.number == number) {
                Some(tool) => Some(tool.clone()),
                None => {
                    let known: Vec<_> = self.tools.iter().map(|t| t.number.to_string()).collect();
                    let help = match known.len() {
                        0 => "list the tools under \"tools\", before the operations".to_owned(),
                        _ => format!("add it to \"tools\", or take one of {}", known.join(", ")),
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
            first: First::Nothing,
        };
        self.hold.tool_change(change, self.place)
    }

    /// An item of a path that is no cycle.
    pub fn item(&mut self, item: &ItemObject) -> Done {
        self.leave_cycle("an item")?;
        self.in_operation()?;
        let feed = item.feed.map(|f| positive("feed", f)).transpose()?;
        // which kind it is: the feed and side that go with a move do not count
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
            item.dwell.is_some(),
            item.stop.is_some(),
            item.comment.is_some(),
            item.text.is_some(),
            feed.is_some() && !moves,
            item.work.is_some(),
            item.spindle.is_some(),
            item.coolant.is_some(),
            item.set.is_some(),
        ];
        match kinds.iter().filter(|&&k| k).count() {
            1 => {}
            0 => {
                let help = format!("give one of {}", ItemObject::KEYS.join(", "));
                return fault(Code::PJ004, "the path item says nothing", help);
            }
            _ => return fault(Code::PJ005, "the path item says more than one thing", "make an item of each"),
        }
        if item.side.is_some() != item.infeed.is_some() {
            return fault(
                Code::PJ005,
                "`side` and `infeed` go together",
                "write {\"infeed\": [1, 2], \"side\": \"left\"}",
            );
        }
        if let Some(to) = item.rapid {
            return self.push(Event::Rapid(to.0));
        }
        if let Some(to) = item.line {
            return self.push(Event::Line { to: to.0, feed });
        }
        if let Some(arc) = &item.arc {
            let arc = arc_of(arc)?;
            return self.push(Event::Arc { arc: &arc, feed });
        }
        if let (Some(to), Some(side)) = (item.infeed, item.side) {
            return self.push(Event::Infeed { infeed: &Infeed { to: to.0, side: side.0 }, feed });
        }
        if let Some(to) = item.outfeed {
            return self.push(Event::Outfeed { to: to.0, feed });
        }
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
        if let Some(thread) = &item.thread {
            let thread = thread_of(thread)?;
            return self.push(Event::Thread(&thread));
        }
        if let Some(action) = item.edm {
            return self.push(Event::Edm(action.0));
        }
        if let Some(call) = &item.call {
            let call = call_of(call)?;
            return self.push(Event::SubCall(&call));
        }
        if let Some(seconds) = item.dwell {
            let seconds = not_negative("dwell", seconds)?;
            return self.push(Event::Dwell(seconds));
        }
        if let Some(kind) = item.stop {
            return self.push(Event::Stop(kind.0));
        }
        if let Some(text) = &item.comment {
            return self.push(Event::Comment(text));
        }
        if let Some(text) = &item.text {
            if text.contains(['\n', '\r']) {
                return fault(Code::PJ003, "`text` holds more than one line", "make an item of each block");
            }
            return self.push(Event::Text(text));
        }
        if let Some(feed) = feed {
            return self.push(Event::Feed(feed));
        }
        if let Some(work) = item.work {
            let work = not_negative("work", work)?;
            return self.push(Event::Work(work));
        }
        if let Some(spindle) = &item.spindle {
            let spindle = spindle_of(spindle)?;
            return self.push(Event::Spindle(spindle));
        }
        if let Some(coolant) = item.coolant {
            return self.push(Event::Coolant(coolant.0));
        }
        for (name, value) in item.set.iter().flat_map(|set| &set.0) {
            self.push(Event::Set(name, *value))?;
        }
        Ok(())
    }

    /// The two items that make up most of every job, without an object between.
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

    /// A cycle begins.
    pub fn cycle_begin(&mut self, cycle: &CycleObject) -> Done {
        self.leave_cycle("a cycle")?;
        self.in_operation()?;
        let spec = spec_of(cycle)?;
        self.in_cycle = true;
        self.place.point = 0;
        self.push(Event::CycleBegin(&spec))
    }

    /// A point of the open cycle.
    pub fn hole(&mut self, hole: Hole) -> Done {
        if !self.in_cycle {
            return fault(Code::PJ005, "a point outside a cycle", "begin the cycle first, as {\"cycle\": {...}}");
        }
        self.place.point += 1;
        self.push(Event::Hole(hole))
    }

    /// The open cycle ends.
    pub fn cycle_end(&mut self) -> Done {
        if !self.in_cycle {
            return fault(Code::PJ005, "the end of a cycle that did not begin", "take it out");
        }
        if self.place.point == 0 {
            return fault(Code::PJ004, "the cycle has no points", "give its points, as \"points\": [[1, 1, 0]]");
        }
        self.in_cycle = false;
        self.place.point = 0;
        self.push(Event::CycleEnd)
    }

    /// The job ends.
    pub fn finish(&mut self) -> Done {
        self.leave_cycle("the end")?;
        if self.in_subprogram {
            return fault(Code::PJ005, "the job ends inside a subprogram", "end the subprogram first");
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
                Code::PJ005,
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

fn positive(name: &str, Number(value): Number) -> Result<f64, Box<Diag>> {
    if value > 0.0 {
        return Ok(value);
    }
    fault(Code::PJ003, format!("`{name}` is {value}"), format!("`{name}` must be above zero"))
}

fn not_negative(name: &str, Number(value): Number) -> Result<f64, Box<Diag>> {
    if value >= 0.0 {
        return Ok(value);
    }
    fault(Code::PJ003, format!("`{name}` is {value}"), format!("`{name}` can't be negative"))
}

fn whole(name: &str, number: Number) -> Result<f64, Box<Diag>> {
    let value = not_negative(name, number)?;
    if value.fract() == 0.0 && value < 1e9 {
        return Ok(value);
    }
    fault(Code::PJ003, format!("`{name}` is {value}"), format!("`{name}` must be a whole number below 1000000000"))
}

fn tool_of(object: ToolObject) -> Result<Tool, Box<Diag>> {
    let Some(number) = object.number else {
        return fault(Code::PJ004, "a tool without a number", "give each tool a \"number\"");
    };
    Ok(Tool {
        number: whole("number", number)?,
        diameter: object.diameter.map(|n| not_negative("diameter", n)).transpose()?,
        corner_radius: object.corner_radius.map(|n| not_negative("corner_radius", n)).transpose()?,
        length_offset: object.length_offset.map(|n| whole("length_offset", n)).transpose()?,
        diameter_offset: object.diameter_offset.map(|n| whole("diameter_offset", n)).transpose()?,
        turret: object.turret.map(|n| whole("turret", n)).transpose()?,
        comment: object.comment,
    })
}

fn spindle_of(object: &SpindleObject) -> Result<Spindle, Box<Diag>> {
    Ok(Spindle {
        speed: object.speed.map(|n| not_negative("speed", n)).transpose()?,
        turn: object.direction.map(|d| d.0),
        css: object.mode.map(|m| m.0 == SpeedMode::Css),
        max: object.max.map(|n| positive("max", n)).transpose()?,
    })
}

fn arc_of(object: &ArcObject) -> Result<Arc, Box<Diag>> {
    let Some(to) = object.to else {
        return fault(Code::PJ004, "an arc without `to`", "say where it ends");
    };
    let Some(direction) = object.direction else {
        return fault(Code::PJ004, "an arc without `direction`", "write \"direction\": \"cw\" or \"ccw\"");
    };
    if object.center.is_some() == object.radius.is_some() {
        return fault(Code::PJ005, "an arc has either `center` or `radius`", "give one of them");
    }
    if object.radius.is_some_and(|r| r.0 == 0.0) {
        return fault(Code::PJ003, "`radius` is 0", "give the arc's radius");
    }
    let turns = object.turns.map_or(Ok(0.0), |n| whole("turns", n))?;
    if turns > 10_000.0 {
        return fault(Code::PJ003, format!("`turns` is {turns}"), "an arc has at most 10000 turns");
    }
    Ok(Arc {
        to: to.0,
        center: object.center.map(|c| c.0),
        radius: object.radius.map(|r| r.0),
        direction: direction.0,
        plane: object.plane.map_or(Plane::Xy, |p| p.0),
        turns: turns as u32,
    })
}

fn thread_of(object: &ThreadObject) -> Result<Thread, Box<Diag>> {
    let (Some(from), Some(to), Some(pitch), Some(depth)) = (object.from, object.to, object.pitch, object.depth) else {
        return fault(Code::PJ004, "a thread needs `from`, `to`, `pitch` and `depth`", "give all four");
    };
    if depth.0 == 0.0 {
        return fault(Code::PJ003, "`depth` is 0", "give the height of the thread");
    }
    let above_zero = |name, n: Option<Number>| n.map(|n| positive(name, n)).transpose();
    let count = |name, n: Option<Number>| n.map(|n| whole(name, n).and_then(|n| positive(name, Number(n)))).transpose();
    let starts = count("starts", object.starts)?;
    if starts.is_some_and(|starts| starts > 100.0) {
        return fault(Code::PJ003, "`starts` is above 100", "a thread has a few starts");
    }
    Ok(Thread {
        from: from.0,
        to: to.0,
        pitch: positive("pitch", pitch)?,
        depth: depth.0,
        first_depth: above_zero("first_depth", object.first_depth)?,
        min_depth: object.min_depth.map(|n| not_negative("min_depth", n)).transpose()?,
        taper: object.taper.map(|n| n.0),
        angle: object.angle.map(|n| not_negative("angle", n)).transpose()?,
        passes: count("passes", object.passes)?,
        chamfer: object.chamfer.map(|n| not_negative("chamfer", n)).transpose()?,
        starts,
    })
}

fn call_of(object: &CallObject) -> Result<Call, Box<Diag>> {
    let Some(sub) = object.sub else {
        return fault(Code::PJ004, "a call without `sub`", "give the number of the subprogram");
    };
    let times = object.times.map_or(Ok(1.0), |n| whole("times", n))?;
    if times == 0.0 {
        return fault(Code::PJ003, "`times` is 0", "take the call out, or let it run once");
    }
    Ok(Call {
        sub: whole("sub", sub)?,
        times,
        at: object.at.unwrap_or_default().0,
        work: object.work.map(|w| not_negative("work", w)).transpose()?,
    })
}

fn spec_of(object: &CycleObject) -> Result<CycleSpec, Box<Diag>> {
    let Some(kind) = object.kind else {
        return fault(Code::PJ004, "a cycle without `kind`", "write \"kind\": \"drill\"");
    };
    let plain = |n: Option<Number>| n.map(|n| n.0);
    let above_zero = |name, n: Option<Number>| n.map(|n| positive(name, n)).transpose();
    let from_zero = |name, n: Option<Number>| n.map(|n| not_negative(name, n)).transpose();
    let mut pecks = Vec::new();
    for peck in object.pecks.iter().flatten() {
        let Some(to) = peck.to else {
            return fault(Code::PJ004, "a peck without `to`", "say how deep it goes");
        };
        pecks.push(Peck { to: to.0, feed: above_zero("feed", peck.feed)? });
    }
    Ok(CycleSpec {
        depth: plain(object.depth),
        clear: plain(object.clear),
        return_height: plain(object.return_height),
        feed: above_zero("feed", object.feed)?,
        plunge: above_zero("plunge", object.plunge)?,
        step: above_zero("step", object.step)?,
        first_step: above_zero("first_step", object.first_step)?,
        back: from_zero("back", object.back)?,
        dwell: from_zero("dwell", object.dwell)?,
        revs: from_zero("revs", object.revs)?,
        rapto: from_zero("rapto", object.rapto)?,
        orient: plain(object.orient),
        offset: from_zero("offset", object.offset)?,
        ratio: above_zero("ratio", object.ratio)?,
        starts: above_zero("starts", object.starts)?,
        rigid: object.rigid,
        times: above_zero("times", object.times)?,
        decr: from_zero("decr", object.decr)?,
        min_step: from_zero("min_step", object.min_step)?,
        diameter: above_zero("diameter", object.diameter)?,
        angle: above_zero("angle", object.angle)?,
        hole_diameter: above_zero("hole_diameter", object.hole_diameter)?,
        webs: object.webs.iter().flatten().map(|n| n.0).collect(),
        pecks,
        mode: object.mode.map(|m| match m.0 {
            PeckMode::Deep => CycleKind::Deep,
            PeckMode::Chipbreak => CycleKind::Chipbreak,
        }),
        norevr: object.norevr.unwrap_or(false),
        rapout: object.rapout.unwrap_or(false),
        jog: from_zero("jog", object.jog)?,
        ..CycleSpec::new(kind.0)
    })
}
