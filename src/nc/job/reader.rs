//! The second run of a program that is read as a job: converts actions to events of the job.

use super::behind::Behind;
use super::fault::{Done, unsaid, warning};
use super::moves::Moves;
use super::options::JobOptions;
use super::pattern::Pattern;
use super::survey::Survey;
use super::switches::Switches;
use crate::control::{Meaning, ToolLength};
use crate::diag::Diag;
use crate::lang::{Machine, additional_work};
use crate::nc::action::{Action, Item, Position, ROTARY, Turn};
use crate::source::text_of;
use crate::toolpath::{Arc, Axes, Event, FeedMode, First, Infeed, Place, Plane, Side, Sink, StopKind};

/// An item that waits for the first move of an operation.
pub(super) enum Waiting {
    Comment(String),
    /// A dwell in seconds.
    Dwell(f64),
    Stop(StopKind),
}

/// A tool whose height is known only at the machine, because it moved to the reference point.
#[derive(Clone, Copy)]
pub(super) struct AtHome {
    pub(super) line: u64,
    /// The switches of the machine when the tool moved there.
    pub(super) switches: Switches,
    /// Whether the job contains the move home.
    pub(super) is_said: bool,
    /// X and Y of the tool in the job. `None`: unknown.
    pub(super) across: Option<[f64; 2]>,
}

/// Maximum number of waiting items. Comments above this number are left out.
pub(super) const MOST_WAITING: usize = 1000;

/// Converts actions of the simulator to events of a job.
pub(super) struct Reader<'a> {
    pub(super) survey: &'a Survey,
    pub(super) options: &'a JobOptions<'a>,
    pub(super) warnings: &'a mut Vec<Diag>,
    sink: &'a mut dyn Sink,
    pub(super) place: Place,
    started: bool,
    /// Number of tool changes so far.
    pub(super) changes: usize,
    pub(super) tool: Option<f64>,
    /// Whether an operation begins with the next move.
    pub(super) operation: bool,
    pub(super) wanted: Switches,
    pub(super) said: Switches,
    pub(super) mode: FeedMode,
    plane: Plane,
    pub(super) at: Position,
    /// Position as the simulator calculates it. Axes whose position is known only at the machine are measured from 0.
    counted: Position,
    /// Bit mask of the axes whose position in the job is known.
    pub(super) known: u8,
    /// The move to the reference point. `None`: the tool is not there, or it has moved down since.
    pub(super) home: Option<AtHome>,
    pub(super) cycle: Option<Pattern>,
    /// The moves of the current hole.
    pub(super) moves: Option<Moves>,
    pub(super) side: Option<Side>,
    pub(super) turning: Option<Option<Side>>,
    pub(super) rigid: bool,
    pub(super) framed: bool,
    /// The last comment and its line.
    pub(super) remark: (u64, String),
    /// The comment in the block of the tool change.
    pub(super) tool_name: Option<String>,
    /// The shift of G52 and G92 at the first move. The field `shift` is the change of this shift since the first move.
    pub(super) frame: [f64; 3],
    /// Bit mask of the axes along which the shift of G92 was unknown at the first move.
    pub(super) lost: u8,
    pub(super) shift: [f64; 3],
    /// Items that the next operation will contain.
    pub(super) waiting: Vec<Waiting>,
}

impl<'a> Reader<'a> {
    /// Whether length and radius belong to the tool itself. Programs for such a control contain no register for the
    /// tool.
    fn tool_is_its_own(&self) -> bool {
        self.options.settings.control.traits().tool_length == ToolLength::Tool
    }

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
            counted: [0.0; 6],
            known: ROTARY,
            home: None,
            cycle: None,
            moves: None,
            side: None,
            turning: None,
            rigid: false,
            framed: false,
            remark: (0, String::new()),
            tool_name: None,
            frame: [0.0; 3],
            lost: 0,
            shift: [0.0; 3],
            waiting: Vec::new(),
        }
    }

    /// Handles an action of a block with the text `block`. `behind` is the state of the machine after the block.
    pub fn take(&mut self, item: &Item, block: &[u8], behind: Behind) -> Done {
        let shifted = self.shifted(&item.action).map(|action| Item { action, ..*item });
        let item = shifted.as_ref().unwrap_or(item);
        self.action(item, block, behind)?;
        if let Action::Rapid { to, .. } | Action::Feed { to, .. } | Action::Arc(Turn { to, .. }) = &item.action {
            self.counted = *to;
        }
        Ok(())
    }

    fn action(&mut self, item: &Item, block: &[u8], behind: Behind) -> Done {
        self.place.line = item.line;
        self.place.column = 1;
        if item.by_cycle {
            if let Some(moves) = &mut self.moves
                && let Err(lost) = moves.take(&item.action, self.wanted.speed)
            {
                return unsaid(item.line, lost.message(&moves.hole), lost.help());
            }
            // the event of the cycle contains these moves; the next move begins at their end
            if let Action::Rapid { to, .. } | Action::Feed { to, .. } = &item.action {
                self.at = *to;
                self.known |= 0b111;
            }
            return Ok(());
        }
        self.settle_way(&item.action)?;
        match &item.action {
            Action::Rapid { to, machine, astray, .. } if astray & 0b111 == 0 => self.rapid(to, *machine),
            Action::Rapid { .. } => {
                let help = "write the position under G90, or go there by G53";
                unsaid(item.line, "an increment from an unknown machine position", help)
            }
            Action::Feed { lead: Some(_), .. } => {
                unsaid(item.line, "a thread that is synchronized with the spindle", "the job of a mill has no threading")
            }
            Action::Feed { home: 1.., .. } => {
                let help = "write G0 with G53; the position of a probe touch is known only at the machine";
                unsaid(item.line, "a feed move goes to an unknown machine position", help)
            }
            Action::Feed { to, feed, .. } => self.feed(to, *feed, behind.unknown),
            Action::Arc(turn) => self.arc(turn, behind.unknown),
            Action::Hole(hole) => {
                self.is_turned(behind.unknown)?;
                self.hole(hole)
            }
            Action::CycleOff => Ok(()), // the next action shows whether the cycle really ends
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
                self.coolant(*cooling);
                Ok(())
            }
            Action::Work(code) => self.work(*code, item.line),
            Action::FeedMode(mode) => {
                self.mode = *mode;
                self.operation = true; // an operation of a job has only one feed mode
                Ok(())
            }
            Action::Compensation(Some(on)) if on.cutter.register().is_none() && !self.tool_is_its_own() => {
                let message = "compensation with a diameter in the block (G41.1, G42.1)";
                unsaid(item.line, message, "use a register, D with G41 or G42")
            }
            Action::Compensation(Some(_)) if self.plane != Plane::Xy => {
                unsaid(item.line, "cutter compensation outside G17", "a job's compensation is in XY")
            }
            Action::Compensation(side) => self.compensation(side.map(|on| on.side)),
            Action::Plane(plane) => {
                self.plane = *plane;
                Ok(())
            }
            Action::LeftOut(_, Meaning::RigidAhead) => {
                self.rigid = true;
                Ok(())
            }
            Action::Frame => self.frame(behind),
            Action::Orient(_) => {
                unsaid(item.line, "M19, a stop of the spindle at an angle", "in a job only a boring cycle orients the spindle")
            }
            Action::Comment(start, end) => {
                let text = block.get(*start..*end).unwrap_or_default();
                self.comment(text_of(text).trim())
            }
            Action::Units(_)
            | Action::Length(_)
            | Action::End
            | Action::LeftOut(..)
            | Action::LeftOutWord(_)
            | Action::Threading(_)
            | Action::Passes(_) // threads of lathes, which a mill does not have
            | Action::BlockDelete
            | Action::SpeedLimit(_) => Ok(()),
        }
    }

    /// Selects a work offset. In a job, G54.1 P1 has the number 7.
    fn work(&mut self, code: f64, line: u64) -> Done {
        let additional = code - additional_work(0.0);
        if additional > 43.0 {
            let message = format!("the work offset G54.1 P{additional}");
            return unsaid(line, message, "the work offsets of a job are 1 to 49: G54.1 P1 is 7");
        }
        if additional <= 0.0 && code >= 50.0 && self.options.settings.control.counts_work() {
            return unsaid(line, format!("the work offset {code}"), "the work offsets of a job are 1 to 49");
        }
        let work = if additional > 0.0 { additional + 6.0 } else { code };
        if self.wanted.work.replace(work).is_some_and(|before| before != work) {
            self.known &= ROTARY; // the position in the new offset is unknown until the next move
        }
        Ok(())
    }

    fn feed(&mut self, to: &Position, feed: f64, unknown: u8) -> Done {
        let stays = self.counted_from_start(to, unknown) == self.at && self.known & 0b111 == 0b111;
        if stays && self.turning.is_none() {
            return Ok(());
        }
        self.cut_begins()?;
        let to = &self.counted_from_start(to, unknown);
        let axes = self.axes(to);
        self.at = *to;
        self.known |= 0b111;
        self.moves(axes, Some(feed))
    }

    /// Ends the job at the end of the program.
    pub fn finish(&mut self) -> Done {
        self.end_cycle()?;
        self.start()?;
        if self.waiting.iter().any(|waiting| matches!(waiting, Waiting::Stop(_))) {
            let message = "a stop after the last tool change, without later moves, is left out";
            self.warnings.push(warning(self.place.line, message, "print the stop in the sequence EndCode"));
        }
        self.push(Event::Finish)
    }

    pub(super) fn push(&mut self, event: Event<'_>) -> Done {
        self.sink.push(event, self.place)
    }

    fn start(&mut self) -> Done {
        if std::mem::replace(&mut self.started, true) {
            return Ok(());
        }
        self.push(Event::Start(&self.survey.start(Machine::Mill)?))
    }

    /// The target of a move, with the axes that the job uses.
    pub(super) fn axes(&self, to: &Position) -> Axes {
        Axes { values: *to, given: self.used() }
    }

    /// The axes that the job uses, as bits.
    pub(super) fn used(&self) -> u8 {
        0b111 | self.survey.rotary & ROTARY
    }

    /// Adds the events before a move: the beginning of an operation, and the changed switches of the machine.
    pub(super) fn move_begins(&mut self, first: First) -> Done {
        self.start()?;
        if std::mem::take(&mut self.operation) {
            self.begin_operation(first)?;
        }
        self.switch()
    }

    pub(super) fn rapid(&mut self, to: &Position, machine: u8) -> Done {
        if self.leads_on(to, machine) {
            return Ok(());
        }
        self.end_cycle()?;
        let used = self.used();
        let machine = machine & used;
        // a move to a machine position adds no event yet: forms print it before a tool change and at the end
        self.at = *to;
        if machine & 0b100 != 0 {
            self.known = used & !machine;
            self.goes_home();
            return Ok(());
        }
        self.known = used & !machine;
        if machine != 0 {
            return Ok(()); // the height is known now, but another axis is still unknown
        }
        let axes = self.axes(to);
        let new_tool = self.operation && self.tool_is_new();
        if let Some(home) = self.home.take().filter(|_| !new_tool) {
            self.move_above(home, axes)?;
        }
        self.move_begins(First::Rapid(axes))?;
        self.step();
        self.moves(axes, None)
    }

    /// Adds a straight move. A move without a feed is a rapid. The first move after G41, G42 or G40 also turns
    /// compensation on or off.
    fn moves(&mut self, to: Axes, feed: Option<f64>) -> Done {
        let rapid = feed.is_none();
        match (self.turning.take(), feed) {
            (Some(Some(side)), feed) => self.push(Event::Infeed { infeed: &Infeed { to, side, rapid }, feed }),
            (Some(None), feed) => self.push(Event::Outfeed { to, feed, rapid }),
            (None, Some(_)) => self.push(Event::Line { to, feed }),
            (None, None) => self.push(Event::Rapid(to)),
        }
    }

    pub(super) fn step(&mut self) {
        self.place.item += 1;
    }

    /// Checks before a cut that the position of the tool is known.
    fn cut_begins(&mut self) -> Done {
        self.end_cycle()?;
        let unknown = self.used() & !self.known;
        self.is_turned(unknown)?;
        if self.home.is_some() || unknown != 0 {
            if let Some(start) = self.options.start {
                return self.cut_from(start);
            }
            let help = "write a rapid with X, Y and Z before the cut, or give the position of the tool with \
                `--assume-start X,Y,Z`";
            return unsaid(self.place.line, "a cut begins at an unknown machine position", help);
        }
        self.move_begins(First::Cut)?;
        self.step();
        Ok(())
    }

    /// Checks before a cut or a hole that none of the unknown axes is a rotary axis of the job.
    fn is_turned(&self, unknown: u8) -> Done {
        if unknown & self.used() & ROTARY == 0 {
            return Ok(());
        }
        let help = "write the angle after the work offset or the move home, before the cut";
        unsaid(self.place.line, "a cut begins at an unknown angle of a rotary axis", help)
    }

    /// Handles a cut that begins at an unknown machine position. Axes without a position in the program are assumed to
    /// be at the start position of the options.
    fn cut_from(&mut self, start: [f64; 3]) -> Done {
        let message = "a cut begins at an unknown machine position";
        let help = "the cut is assumed to begin at the position of `--assume-start`: check that the tool clears the \
                    clamps on its way";
        self.warnings.push(warning(self.place.line, message, help));
        let unknown = if self.home.take().is_some() { self.known & 0b011 } else { self.known };
        for axis in (0..3).filter(|axis| unknown & 1 << axis == 0) {
            self.at[axis] = start[axis];
        }
        self.known = self.used();
        let axes = self.axes(&self.at);
        self.move_begins(First::Rapid(axes))?;
        self.step();
        self.push(Event::Rapid(axes))?;
        self.step();
        Ok(())
    }

    /// Corrects a position for axes that the program has not positioned since the assumed start position. The axes
    /// without a position are measured from the assumed start position.
    fn counted_from_start(&self, to: &Position, unknown: u8) -> Position {
        let mut to = *to;
        if self.options.start.is_some() {
            for axis in (0..3).filter(|axis| unknown & 1 << axis != 0) {
                to[axis] += self.at[axis] - self.counted[axis];
            }
        }
        to
    }

    fn arc(&mut self, turn: &Turn, unknown: u8) -> Done {
        self.cut_begins()?;
        let center = std::array::from_fn(|axis| turn.center[axis] + self.at[axis] - self.counted[axis]);
        let turn = &Turn { to: self.counted_from_start(&turn.to, unknown), center, ..*turn };
        if self.turning.take().is_some() {
            let help = "turn the compensation on and off by straight moves";
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

    /// Adds an event at the current position of the tool.
    fn between(&mut self, event: Event<'_>) -> Done {
        self.end_cycle()?;
        if self.operation && (self.place.operation == 0 || self.tool_is_new()) {
            // the event must come after the tool change that the form prints
            return match event {
                Event::Stop(kind) => self.wait(Waiting::Stop(kind)),
                Event::Dwell(seconds) => self.wait(Waiting::Dwell(seconds)),
                _ => Ok(()),
            };
        }
        self.stay_home()?;
        self.move_begins(First::Nothing)?;
        self.step();
        self.push(event)
    }

    fn compensation(&mut self, side: Option<Side>) -> Done {
        if side == self.side && self.turning.is_none() {
            return Ok(());
        }
        self.turning = if side == self.side && self.turning.is_some() { None } else { Some(side) };
        self.side = side;
        Ok(())
    }

    fn comment(&mut self, text: &str) -> Done {
        if text.is_empty() {
            return Ok(());
        }
        self.remark = (self.place.line, text.to_owned());
        if self.operation {
            return self.wait(Waiting::Comment(text.to_owned()));
        }
        self.end_cycle()?;
        self.push(Event::Comment(text))
    }

    /// Stores an item until the next operation begins.
    fn wait(&mut self, waiting: Waiting) -> Done {
        if self.waiting.len() < MOST_WAITING {
            self.waiting.push(waiting);
        } else if !matches!(waiting, Waiting::Comment(_)) {
            let message = format!("more than {MOST_WAITING} stops, dwells and comments before a tool's first move");
            return unsaid(self.place.line, message, "remove the ones that are not needed");
        }
        Ok(())
    }
}
