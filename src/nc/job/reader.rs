//! The second run: actions become events.

use super::cycles::{hole_of, is_same, spec_of};
use super::survey::Survey;
use super::{JobOptions, unsaid, warning};
use crate::diag::{Code, Diag};
use crate::lang::Machine;
use crate::nc::action::{Action, Cooling, Drilling, Item, Position, Rotation, Turn};
use crate::toolpath::{
    Arc, Axes, Coolant, CycleSpec, Event, FeedMode, First, Infeed, Place, Plane, Side, Sink, Spindle, SpindleTurn,
    Start, Tool, ToolChange,
};

/// What is switched on a machine, for comparison: what was said, and what is wanted now.
#[derive(Clone, Copy, PartialEq, Default)]
struct Switches {
    rotation: Option<Rotation>,
    speed: Option<f64>,
    css: Option<bool>,
    coolant: Option<Coolant>,
    work: Option<f64>,
}

/// Actions to events.
pub(super) struct Reader<'a> {
    survey: &'a Survey,
    options: &'a JobOptions,
    warnings: &'a mut Vec<Diag>,
    sink: &'a mut dyn Sink,
    place: Place,
    started: bool,
    /// Tool changes so far.
    changes: usize,
    tool: Option<f64>,
    /// An operation that begins with the next move.
    operation: bool,
    wanted: Switches,
    said: Switches,
    mode: FeedMode,
    plane: Plane,
    at: Position,
    /// Axes whose place a job knows.
    known: u8,
    /// The tool went to its reference point, at this line.
    home: Option<u64>,
    cycle: Option<(CycleSpec, Drilling)>,
    side: Option<Side>,
    turning: Option<Option<Side>>,
    rigid: bool,
    framed: bool,
    comments: Vec<String>,
}

impl<'a> Reader<'a> {
    pub fn new(
        survey: &'a Survey,
        options: &'a JobOptions,
        warnings: &'a mut Vec<Diag>,
        sink: &'a mut dyn Sink,
    ) -> Reader<'a> {
        Reader {
            survey,
            options,
            warnings,
            sink,
            place: Place::default(),
            started: false,
            changes: 0,
            tool: None,
            operation: true,
            wanted: Switches::default(),
            said: Switches::default(),
            mode: FeedMode::PerMinute,
            plane: Plane::Xy,
            at: [0.0; 6],
            known: 0,
            home: None,
            cycle: None,
            side: None,
            turning: None,
            rigid: false,
            framed: false,
            comments: Vec::new(),
        }
    }

    /// Takes an action; `block` is the text of its line.
    pub fn take(&mut self, item: &Item, block: &[u8]) -> Result<(), Box<Diag>> {
        self.place.line = item.line;
        self.place.column = 1;
        if item.by_cycle {
            // the cycle says its moves; where it leaves the tool is where the next move begins
            if let Action::Rapid { to, .. } | Action::Feed { to, .. } = &item.action {
                self.at = *to;
                self.known |= 0b111;
            }
            return Ok(());
        }
        match &item.action {
            Action::Rapid { to, machine } => self.rapid(to, *machine),
            Action::Feed { lead: Some(_), .. } => {
                unsaid(item.line, "a thread that follows the spindle", "a mill's job has no such move")
            }
            Action::Feed { to, feed, .. } => {
                if *to == self.at && self.turning.is_none() {
                    return Ok(());
                }
                self.cut_begins()?;
                let axes = self.axes(to);
                self.at = *to;
                self.known |= 0b111;
                let feed = Some(*feed);
                match self.turning.take() {
                    Some(Some(side)) => {
                        let infeed = Infeed { to: axes, side, rapid: false };
                        self.push(Event::Infeed { infeed: &infeed, feed })
                    }
                    Some(None) => self.push(Event::Outfeed { to: axes, feed, rapid: false }),
                    None => self.push(Event::Line { to: axes, feed }),
                }
            }
            Action::Arc(turn) => self.arc(turn),
            Action::Hole(hole) => self.hole(hole),
            Action::CycleOff => self.end_cycle(),
            Action::Dwell(seconds) => self.between(Event::Dwell(*seconds)),
            Action::Stop(kind) => self.between(Event::Stop(*kind)),
            Action::Tool(number) => self.tool_change(*number),
            Action::Spindle(rotation, speed) => {
                self.wanted.rotation = Some(*rotation);
                self.wanted.speed = Some(*speed);
                Ok(())
            }
            Action::SurfaceSpeed(speed) => {
                self.wanted.css = Some(speed.is_some());
                Ok(())
            }
            Action::Coolant(cooling) => {
                let both = [Some(Coolant::On), Some(Coolant::Mist)];
                let wanted = if *cooling == Cooling::Flood { Coolant::On } else { Coolant::Mist };
                if *cooling != Cooling::Off
                    && both.contains(&self.wanted.coolant)
                    && self.wanted.coolant != Some(wanted)
                {
                    let message = "flood and mist at once: a job has one of them, the later";
                    self.warnings.push(warning(item.line, message, "print the other by the form"));
                }
                self.wanted.coolant = Some(match cooling {
                    Cooling::Flood => Coolant::On,
                    Cooling::Mist => Coolant::Mist,
                    Cooling::Off => Coolant::Off,
                });
                Ok(())
            }
            Action::Work(code) if *code > 1540.0 => {
                let message = format!("the work offset G54.1 P{}", code - 1540.0);
                unsaid(item.line, message, "a job names G54 to G59.3")
            }
            Action::Work(code) => {
                self.wanted.work = Some(*code);
                Ok(())
            }
            Action::FeedMode(mode) => {
                self.mode = *mode;
                self.operation = true; // a job's operation has one
                Ok(())
            }
            Action::Compensation(Some((_, None))) => unsaid(
                item.line,
                "compensation by a diameter in the block (G41.1, G42.1)",
                "use a register, D with G41 or G42",
            ),
            Action::Compensation(Some(_)) if self.plane != Plane::Xy => {
                unsaid(item.line, "cutter compensation outside G17", "a job's compensation is in XY")
            }
            Action::Compensation(side) => self.compensation(side.map(|(side, _)| side)),
            Action::Plane(plane) => {
                self.plane = *plane;
                Ok(())
            }
            Action::LeftOut(b'M', 290) => {
                self.rigid = true;
                Ok(())
            }
            Action::Frame if self.place.operation > 0 => {
                let help = "write the places in one frame: a job has no G10, G52 or G92";
                unsaid(item.line, "the program moves its coordinate frame between its moves", help)
            }
            Action::Frame => {
                if !std::mem::replace(&mut self.framed, true) {
                    let message = "the program sets its work offsets (G10, G52 or G92), which a job can't say";
                    let help = "set them at the machine: positions are those that the program writes";
                    self.warnings.push(warning(item.line, message, help));
                }
                Ok(())
            }
            Action::Orient(_) => {
                unsaid(item.line, "M19, a stop of the spindle at an angle", "only a bore of a job does it")
            }
            Action::Comment(start, end) => {
                let text = block.get(*start..*end).unwrap_or_default();
                self.comment(String::from_utf8_lossy(text).trim())
            }
            Action::Units(_) | Action::Length(_) | Action::End | Action::LeftOut(..) => Ok(()),
        }
    }

    /// The program is over.
    pub fn finish(&mut self) -> Result<(), Box<Diag>> {
        self.end_cycle()?;
        self.start()?;
        self.push(Event::Finish)
    }

    fn push(&mut self, event: Event<'_>) -> Result<(), Box<Diag>> {
        self.sink.event(event, self.place)
    }

    fn start(&mut self) -> Result<(), Box<Diag>> {
        if std::mem::replace(&mut self.started, true) {
            return Ok(());
        }
        let Some(units) = self.survey.units else {
            let mut diag = Diag::new(Code::PL005, "the program does not say its units: it has no G20 or G21")
                .help("say them with `--assume-units inch` or `mm`");
            diag.place = Some("1:1".into());
            return Err(Box::new(diag));
        };
        let start = Start {
            program: self.survey.program,
            name: None,
            units,
            machine: Machine::Mill,
            set: Vec::new(),
            tool_order: None,
        };
        self.push(Event::Start(&start))
    }

    /// A target with the axes that a job knows.
    fn axes(&self, to: &Position) -> Axes {
        let rotary = self.survey.rotary & 0b11_1000;
        Axes { values: *to, given: 0b111 | rotary }
    }

    /// Before a move: the operation that it begins, and what was switched.
    fn move_begins(&mut self, first: First) -> Result<(), Box<Diag>> {
        self.start()?;
        if std::mem::take(&mut self.operation) {
            self.begin_operation(first)?;
        }
        self.switch()
    }

    fn begin_operation(&mut self, first: First) -> Result<(), Box<Diag>> {
        let Some(number) = self.tool.or(self.options.tool) else {
            return unsaid(
                self.place.line,
                "the program moves before it loads a tool",
                "say which with `--assume-tool NUMBER`",
            );
        };
        let registers = self.survey.registers.get(self.changes).copied().unwrap_or_default();
        let wanted = self.wanted;
        self.place.operation += 1;
        self.place.item = 0;
        let change = ToolChange {
            name: None,
            tool: Some(Tool {
                number,
                length_offset: registers.length,
                diameter_offset: registers.diameter,
                ..Tool::default()
            }),
            spindle: Some(self.spindle()),
            coolant: Some(wanted.coolant.unwrap_or(Coolant::Off)),
            work: wanted.work,
            feed: None,
            plunge: None,
            feed_mode: Some(self.mode),
            comment: None,
            first,
        };
        self.said = wanted;
        self.push(Event::ToolChange(&change))?;
        for text in std::mem::take(&mut self.comments) {
            self.push(Event::Comment(&text))?;
        }
        Ok(())
    }

    fn spindle(&self) -> Spindle {
        Spindle {
            // a standing spindle's zero is no speed
            speed: self.wanted.speed.filter(|&speed| speed > 0.0 || self.turns()),
            turn: Some(match self.wanted.rotation {
                Some(Rotation::Cw) => SpindleTurn::Cw,
                Some(Rotation::Ccw) => SpindleTurn::Ccw,
                Some(Rotation::Stop) | None => SpindleTurn::Off,
            }),
            css: self.wanted.css,
            max: None,
        }
    }

    fn turns(&self) -> bool {
        matches!(self.wanted.rotation, Some(Rotation::Cw | Rotation::Ccw))
    }

    /// What was switched since the last move.
    fn switch(&mut self) -> Result<(), Box<Diag>> {
        if self.said == self.wanted {
            return Ok(());
        }
        let (said, wanted) = (self.said, self.wanted);
        self.said = wanted;
        if (said.rotation, said.speed, said.css) != (wanted.rotation, wanted.speed, wanted.css) {
            self.push(Event::Spindle(self.spindle()))?;
        }
        if let Some(coolant) = wanted.coolant.filter(|_| said.coolant != wanted.coolant) {
            self.push(Event::Coolant(coolant))?;
        }
        match wanted.work.filter(|_| said.work != wanted.work) {
            Some(work) => self.push(Event::Work(work)),
            None => Ok(()),
        }
    }

    fn rapid(&mut self, to: &Position, machine: u8) -> Result<(), Box<Diag>> {
        self.end_cycle()?;
        let machine = machine & 0b111;
        // a place of the machine: a form goes there by itself, before a tool change and at the end
        self.at = *to;
        if machine & 0b100 != 0 {
            self.known &= !machine;
            self.home.get_or_insert(self.place.line);
            return Ok(());
        }
        self.known = 0b111 & !machine;
        if machine != 0 {
            return Ok(()); // the height is known, the place not yet
        }
        let axes = self.axes(to);
        let new_tool = self.operation && self.tool_is_new();
        if let Some(line) = self.home.take().filter(|_| !new_tool) {
            self.homeward(line, *to)?;
            let across = Axes { values: *to, given: axes.given & !0b100 };
            self.push(Event::Rapid(across))?;
        }
        self.move_begins(First::Rapid(axes))?;
        self.step();
        match self.turning.take() {
            Some(Some(side)) => {
                let infeed = Infeed { to: axes, side, rapid: true };
                self.push(Event::Infeed { infeed: &infeed, feed: None })
            }
            Some(None) => self.push(Event::Outfeed { to: axes, feed: None, rapid: true }),
            None => self.push(Event::Rapid(axes)),
        }
    }

    /// To the reference point in the middle of a tool's work: as high as the program ever goes.
    fn homeward(&mut self, line: u64, to: Position) -> Result<(), Box<Diag>> {
        let message = "the way to the reference point has no place in a job";
        let help = "it becomes a rapid to the highest Z that the program says: look whether that clears the clamps";
        if !self.warnings.iter().any(|w| w.message == message) {
            self.warnings.push(warning(line, message, help));
        }
        let mut above = Axes { values: to, given: 0b100 };
        above.values[2] = self.survey.top;
        self.move_begins(First::Rapid(above))?;
        self.step();
        self.push(Event::Rapid(above))
    }

    /// Does the operation that begins load another tool?
    fn tool_is_new(&self) -> bool {
        self.place.operation == 0 || self.changes > 0 && self.said == Switches::default()
    }

    fn step(&mut self) {
        self.place.item += 1;
    }

    /// Before a cut, the tool must stand where a job knows it.
    fn cut_begins(&mut self) -> Result<(), Box<Diag>> {
        self.end_cycle()?;
        if self.home.is_some() || self.known & 0b111 != 0b111 {
            let help = "write a rapid with X, Y and Z before it";
            return unsaid(self.place.line, "a cut begins at a place that only the machine knows", help);
        }
        self.move_begins(First::Cut)?;
        self.step();
        Ok(())
    }

    fn arc(&mut self, turn: &Turn) -> Result<(), Box<Diag>> {
        self.cut_begins()?;
        if self.turning.take().is_some() {
            let help = "turn it on and off by straight moves";
            return unsaid(self.place.line, "cutter compensation is switched on an arc", help);
        }
        let arc = Arc {
            to: self.axes(&turn.to),
            center: Some(Axes::new(&turn.center)),
            radius: None,
            direction: turn.direction,
            plane: turn.plane,
            turns: turn.turns,
        };
        self.at = turn.to;
        self.push(Event::Arc { arc: &arc, feed: Some(turn.feed) })
    }

    fn hole(&mut self, hole: &Drilling) -> Result<(), Box<Diag>> {
        if hole.plane != Plane::Xy {
            let help = "program its moves: a job's cycles go along Z";
            return unsaid(self.place.line, "a canned cycle outside G17", help);
        }
        // a rigid tap turns the spindle its own way
        match hole.code {
            840 if !self.turns() => self.wanted.rotation = Some(Rotation::Cw),
            740 if self.wanted.rotation != Some(Rotation::Ccw) => self.wanted.rotation = Some(Rotation::Ccw),
            _ => {}
        }
        let first = match &self.cycle {
            Some((_, first)) if is_same(first, hole) && self.said == self.wanted => *first,
            _ => {
                self.end_cycle()?;
                if let Some(line) = self.home.take().filter(|_| !self.operation) {
                    return unsaid(line, "a cycle begins at the reference point", "write a rapid with Z before it");
                }
                let spec = spec_of(hole, self.rigid, self.place.line)?;
                self.rigid = false;
                let point = hole_of(hole, hole, self.axes(&hole.at).given);
                self.move_begins(First::Hole(Box::new(spec.clone()), point))?;
                self.step();
                self.place.point = 0;
                self.push(Event::CycleBegin(&spec))?;
                self.cycle = Some((spec, *hole));
                *hole
            }
        };
        self.place.point += 1;
        let point = hole_of(hole, &first, self.axes(&hole.at).given);
        self.push(Event::Hole(point))
    }

    fn end_cycle(&mut self) -> Result<(), Box<Diag>> {
        if self.cycle.take().is_none() {
            return Ok(());
        }
        self.place.point = 0;
        self.push(Event::CycleEnd)
    }

    /// What is done where the tool stands.
    fn between(&mut self, event: Event<'_>) -> Result<(), Box<Diag>> {
        self.end_cycle()?;
        if self.operation && (self.place.operation == 0 || self.tool_is_new()) {
            // the tool change of the form has its own stops and waits
            let message = "a stop or dwell before a tool's first move is left out";
            self.warnings.push(warning(self.place.line, message, "print it in the form's tool change"));
            return Ok(());
        }
        if let Some(line) = self.home.take() {
            // the operator finds the tool there
            self.homeward(line, self.at)?;
        }
        self.move_begins(First::Nothing)?;
        self.step();
        self.push(event)
    }

    fn tool_change(&mut self, number: f64) -> Result<(), Box<Diag>> {
        self.end_cycle()?;
        if self.side.is_some() || self.turning.is_some() {
            return unsaid(
                self.place.line,
                "the tool changes under cutter compensation",
                "end it with G40 and a move before",
            );
        }
        self.changes += 1;
        self.operation = true;
        self.wanted.rotation = Some(Rotation::Stop);
        self.said = Switches::default();
        if self.tool.replace(number) == Some(number) && self.place.operation > 0 {
            // no form prints a change to the tool that is there
            self.said.rotation = Some(Rotation::Stop);
        } else {
            self.home = None;
        }
        Ok(())
    }

    fn compensation(&mut self, side: Option<Side>) -> Result<(), Box<Diag>> {
        if side == self.side && self.turning.is_none() {
            return Ok(());
        }
        self.turning = if side == self.side && self.turning.is_some() { None } else { Some(side) };
        self.side = side;
        Ok(())
    }

    fn comment(&mut self, text: &str) -> Result<(), Box<Diag>> {
        const MOST: usize = 200;
        if text.is_empty() {
            return Ok(());
        }
        if self.operation {
            if self.comments.len() < MOST {
                self.comments.push(text.to_owned());
            }
            return Ok(());
        }
        self.end_cycle()?;
        self.push(Event::Comment(text))
    }
}
