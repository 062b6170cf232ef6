//! Converts lathe programs to jobs: actions of the simulator become events. In a job, positions are Z and X, with X as a radius.

use super::fault::{Done, unsaid, warning};
use super::options::JobOptions;
use super::reader::MOST_WAITING;
use super::survey::Survey;
use super::switches::Switches;
use crate::diag::Diag;
use crate::lang::Machine;
use crate::nc::action::{Action, Item, Passes, Position, Turn};
use crate::source::text_of;
use crate::toolpath::{
    Arc, Axes, Coolant, Event, FeedMode, First, Infeed, Place, Plane, Side, Sink, Stop, Thread, Tool, ToolChange,
};

/// The axes X and Z of the machine, as bits.
const AXES: u8 = 0b101;
/// Divisor that splits a T word into the station and the offset. The offset is the last two digits.
const STATION: f64 = 100.0;

/// Converts actions of the simulator to events of a job.
pub(super) struct Turner<'a> {
    survey: &'a Survey,
    options: &'a JobOptions<'a>,
    warnings: &'a mut Vec<Diag>,
    sink: &'a mut dyn Sink,
    place: Place,
    started: bool,
    /// The active station, and the T word of the current operation.
    station: Option<f64>,
    tool: Option<f64>,
    /// Whether an operation begins with the next move.
    operation: bool,
    wanted: Switches,
    said: Switches,
    mode: FeedMode,
    /// Position of the tool on the axes for which the program has set a position.
    at: Axes,
    /// Whether the tool offset is off: the T word ends with 00.
    without: bool,
    /// Whether the tool is at the reference point and has not moved since it went there.
    home: bool,
    /// Whether the tool went to the reference point along X or Z only. A job can't contain a move home along only one
    /// axis.
    half_home: bool,
    /// Two sides of compensation: the side that is programmed now, and the side after the last move.
    side: [Option<Side>; 2],
    /// Whether the next actions are passes of a thread.
    in_thread: bool,
    comments: Vec<String>,
}

impl<'a> Turner<'a> {
    pub fn new(
        survey: &'a Survey,
        options: &'a JobOptions<'a>,
        warnings: &'a mut Vec<Diag>,
        sink: &'a mut dyn Sink,
        mode: FeedMode,
    ) -> Result<Turner<'a>, Stop> {
        if survey.rotary != 0 {
            let help = "remove the moves of C, A and B: the job of a lathe has only Z and X";
            return unsaid(1, "the program turns a rotary axis", help);
        }
        Ok(Turner {
            survey,
            options,
            warnings,
            sink,
            place: Place::default(),
            started: false,
            station: None,
            tool: None,
            operation: true,
            wanted: Switches::default(),
            said: Switches::default(),
            mode,
            at: Axes::default(),
            without: false,
            home: false,
            half_home: false,
            side: [None; 2],
            in_thread: false,
            comments: Vec::new(),
        })
    }

    /// Handles an action of a block with the text `block`.
    pub fn take(&mut self, item: &Item, block: &[u8]) -> Done {
        self.place.line = item.line;
        self.place.column = 1;
        let line = item.line;
        if item.by_cycle && self.in_thread {
            return Ok(()); // the whole thread is one event, so its passes are skipped
        }
        self.in_thread = false;
        match &item.action {
            Action::Rapid { to, .. } | Action::Feed { to, .. } | Action::Arc(Turn { to, .. }) if to[1] != 0.0 => {
                unsaid(line, "a move along Y", "remove the Y word: the job of a lathe has only Z and X")
            }
            Action::Rapid { astray, .. } if astray & AXES != 0 => {
                let help = "write the position by X and Z, or go there by G53";
                unsaid(line, "an increment from an unknown machine position", help)
            }
            Action::Rapid { to, machine, .. } => self.rapid(to, *machine),
            Action::Feed { lead: Some(_), .. } => {
                unsaid(line, "a single pass of a thread", "write the thread as G76 in two blocks")
            }
            Action::Feed { home: 1.., .. } => {
                unsaid(line, "a cut to a position in machine coordinates", "write G0 with G53")
            }
            Action::Feed { to, feed, .. } => {
                self.cut_begins()?;
                let to = axes(to, AXES);
                if self.goes(to) { self.straight(to, Some(*feed)) } else { Ok(()) }
            }
            Action::Arc(turn) => self.arc(turn),
            Action::Passes(passes) => self.thread(passes),
            Action::Hole(_) => unsaid(line, "a canned cycle of a lathe", "write the cycle as single moves"),
            Action::Dwell(seconds) => self.between(Event::Dwell(*seconds)),
            Action::Stop(kind) => self.between(Event::Stop(*kind)),
            Action::Tool(station) => {
                self.station = Some(*station);
                Ok(())
            }
            Action::Length(Some(register)) => self.tool_change(*register),
            Action::Length(None) => {
                (self.without, self.at) = (true, Axes::default());
                Ok(())
            }
            Action::Spindle(rotation, speed) => {
                (self.wanted.rotation, self.wanted.speed) = (Some(*rotation), Some(*speed));
                Ok(())
            }
            Action::SurfaceSpeed(speed) => {
                self.wanted.css = Some(speed.is_some());
                Ok(())
            }
            Action::SpeedLimit(limit) => {
                self.wanted.limit = Some(*limit);
                Ok(())
            }
            Action::Coolant(cooling) => {
                if !self.wanted.cool(*cooling) {
                    let message = "flood and mist are on at once, but the job contains only the coolant that was \
                                   turned on later";
                    self.warnings.push(warning(line, message, "let the form print the other coolant"));
                }
                Ok(())
            }
            Action::Work(code) => {
                self.wanted.work = Some(*code);
                Ok(())
            }
            Action::FeedMode(mode) => {
                self.operation |= *mode != self.mode;
                self.mode = *mode;
                Ok(())
            }
            Action::Compensation(side) => {
                self.side[0] = side.map(|on| on.side);
                Ok(())
            }
            Action::Plane(plane) if *plane != Plane::Xz => unsaid(line, "another plane than ZX", "write G18"),
            Action::Frame => unsaid(line, "a frame that moves", "take G50 with X or Z, G52 and G92 out"),
            Action::Orient(_) => unsaid(line, "a stop of the spindle at an angle", "a job of a lathe has none"),
            Action::Comment(start, end) => {
                let text = text_of(block.get(*start..*end).unwrap_or_default());
                self.comment(text.trim())
            }
            Action::Plane(_)
            | Action::Threading(_)
            | Action::Units(_)
            | Action::CycleOff
            | Action::End
            | Action::LeftOut(..)
            | Action::LeftOutWord(_)
            | Action::BlockDelete => Ok(()),
        }
    }

    /// Ends the job at the end of the program.
    pub fn finish(&mut self) -> Done {
        self.start()?;
        self.push(Event::Finish)
    }

    fn push(&mut self, event: Event<'_>) -> Done {
        self.sink.push(event, self.place)
    }

    fn start(&mut self) -> Done {
        if std::mem::replace(&mut self.started, true) {
            return Ok(());
        }
        self.push(Event::Start(&self.survey.start(Machine::Lathe)?))
    }

    /// If the station or the offset changes, an operation begins at the next move.
    fn tool_change(&mut self, register: f64) -> Done {
        let Some(station) = self.station else { return Ok(()) };
        let word = station * STATION + register;
        // the turret may index at any position; after that, positions are those of the new tool
        (self.without, self.at) = (false, Axes::default());
        if self.tool == Some(word) {
            return Ok(());
        }
        if self.side != [None; 2] {
            return unsaid(
                self.place.line,
                "the tool changes under compensation",
                "end the compensation with G40 and a move before the tool change",
            );
        }
        (self.tool, self.operation) = (Some(word), true);
        (self.home, self.half_home) = (false, false);
        self.said = Switches::default();
        Ok(())
    }

    /// Adds the events before a move: the beginning of an operation, the move home, and the changed switches of the
    /// machine.
    fn move_begins(&mut self, first: First) -> Done {
        if self.half_home {
            let help = "send it home along both axes (G28 U0 W0), or write its position in X and Z";
            return unsaid(self.place.line, "the tool goes home along only X or Z, and then moves on", help);
        }
        self.start()?;
        if std::mem::take(&mut self.operation) {
            self.begin_operation(first)?;
        } else if std::mem::take(&mut self.home) {
            self.place.item += 1;
            self.push(Event::Home)?;
        }
        self.switch()?;
        self.place.item += 1;
        Ok(())
    }

    fn begin_operation(&mut self, first: First) -> Done {
        let Some(number) = self.tool.or(self.options.tool) else {
            let help = "give the tool with `--assume-tool NUMBER`: a T word with its offset, as 101";
            return unsaid(self.place.line, "the program moves before it loads a tool", help);
        };
        self.place.operation += 1;
        self.place.item = 0;
        // if the same tool continues with another feed mode, the move home is a separate event
        let goes_home = std::mem::take(&mut self.home);
        let change = ToolChange {
            tool: Some(Tool { number, ..Tool::default() }),
            spindle: Some(self.wanted.spindle()),
            coolant: Some(self.wanted.coolant.unwrap_or(Coolant::OFF)),
            work: self.wanted.work,
            feed_mode: Some(self.mode),
            first: if goes_home { First::Nothing } else { first },
            ..ToolChange::default()
        };
        self.said = self.wanted;
        self.push(Event::ToolChange(&change))?;
        for text in std::mem::take(&mut self.comments) {
            self.push(Event::Comment(&text))?;
        }
        if goes_home { self.push(Event::Home) } else { Ok(()) }
    }

    fn switch(&mut self) -> Done {
        let said = std::mem::replace(&mut self.said, self.wanted);
        said.changes(self.wanted).try_for_each(|event| self.push(event))
    }

    fn rapid(&mut self, to: &Position, machine: u8) -> Done {
        let unknown = machine & AXES;
        if unknown == AXES {
            if self.side != [None; 2] {
                let help = "end compensation with G40 and a move before";
                return unsaid(self.place.line, "the tool goes home under compensation", help);
            }
            self.at = Axes::default();
            (self.home, self.half_home) = (true, false);
            return Ok(());
        }
        if self.without {
            let message =
                "a rapid without the tool's offset (T with 00 after the station) becomes a move home in the job";
            self.warnings.push(warning(self.place.line, message, "check the home position in the form"));
            (self.home, self.half_home) = (true, false);
            return Ok(());
        }
        let to = axes(to, AXES & !unknown);
        if self.at.given & !to.given != 0 {
            (self.at, self.half_home) = (to, true);
            return Ok(());
        }
        if !self.goes(to) {
            return Ok(());
        }
        self.move_begins(First::Rapid(to))?;
        self.straight(to, None)
    }

    /// Sets the end of a straight move. Returns `false` if the move changes nothing.
    fn goes(&mut self, to: Axes) -> bool {
        let [wanted, on] = self.side;
        let stays = to == self.at && wanted == on && !self.home;
        self.at = to;
        !stays
    }

    /// Adds a straight move. A move without a feed is a rapid. The first move after G41, G42 or G40 also turns
    /// compensation on or off.
    fn straight(&mut self, to: Axes, feed: Option<f64>) -> Done {
        let rapid = feed.is_none();
        let [wanted, on] = self.side;
        self.side[1] = wanted;
        match (on, wanted, feed) {
            (None, Some(side), _) => self.push(Event::Infeed { infeed: &Infeed { to, side, rapid }, feed }),
            (Some(_), None, _) => self.push(Event::Outfeed { to, feed, rapid }),
            (Some(on), Some(side), _) if on != side => {
                let help = "end the compensation with G40 and a move before this block";
                unsaid(self.place.line, "compensation changes its side", help)
            }
            (.., Some(_)) => self.push(Event::Line { to, feed }),
            (.., None) => self.push(Event::Rapid(to)),
        }
    }

    /// Begins a cut. The program must have set the position of the tool.
    fn cut_begins(&mut self) -> Done {
        if self.at.given != 0b11 || self.home {
            let help = "write a rapid with X and Z before the cut";
            return unsaid(self.place.line, "a cut begins at an unknown machine position", help);
        }
        self.move_begins(First::Cut)
    }

    fn arc(&mut self, turn: &Turn) -> Done {
        self.cut_begins()?;
        if self.side[0] != self.side[1] {
            let help = "turn the compensation on and off by straight moves";
            return unsaid(self.place.line, "compensation is switched on an arc", help);
        }
        self.at = axes(&turn.to, AXES);
        let [x, _, z] = turn.center;
        let arc = Arc {
            to: self.at,
            center: Some(Axes::new(&[z, x])),
            radius: None,
            direction: turn.direction,
            plane: Plane::Xy,
            turns: turn.turns,
        };
        self.push(Event::Arc { arc: &arc, feed: Some(turn.feed) })
    }

    fn thread(&mut self, passes: &Passes) -> Done {
        if self.at.given != 0b11 || self.home {
            let help = "write a rapid with X and Z before the thread";
            return unsaid(self.place.line, "a thread begins at an unknown machine position", help);
        }
        self.move_begins(First::Nothing)?;
        self.in_thread = true;
        if passes.allowance > 0.0 || passes.last > 0 {
            let message = "a job has no last passes of a thread (R and the first digits of P in G76's first block)";
            self.warnings.push(warning(self.place.line, message, "let the form print them"));
        }
        let [from, to] = [passes.from, passes.to].map(|[radius, z]| Axes::new(&[z, radius]));
        let taper = Some(passes.taper).filter(|taper| *taper != 0.0);
        let thread = Thread {
            from,
            to,
            pitch: passes.lead,
            depth: passes.depth,
            first_depth: Some(passes.first),
            min_depth: Some(passes.least).filter(|least| *least > 0.0),
            taper,
            angle: None,
            passes: None,
            chamfer: None,
            starts: None,
        };
        self.push(Event::Thread(&thread))
    }

    /// Adds an event at the current position of the tool.
    fn between(&mut self, event: Event<'_>) -> Done {
        let half_home = std::mem::take(&mut self.half_home);
        if half_home {
            let message =
                "a move home along only X or Z before a stop or a dwell becomes a complete move home in the job";
            self.warnings.push(warning(self.place.line, message, "check the home position in the form"));
            self.home = true;
        }
        self.move_begins(First::Nothing)?;
        self.half_home = half_home;
        self.push(event)
    }

    fn comment(&mut self, text: &str) -> Done {
        if text.is_empty() {
            return Ok(());
        }
        if self.operation {
            if self.comments.len() < MOST_WAITING {
                self.comments.push(text.to_owned());
            }
            return Ok(());
        }
        self.push(Event::Comment(text))
    }
}

/// Converts a machine position to axes of a job: Z, and X as a radius. `given`: as bits, which of X and Z are known.
fn axes(to: &Position, given: u8) -> Axes {
    let mut axes = Axes::default();
    if given & 0b100 != 0 {
        axes.set(0, to[2]);
    }
    if given & 0b001 != 0 {
        axes.set(1, to[0]);
    }
    axes
}
