//! Converts the commands of one operation's path to events.

use super::command::{Command, Return, Words};
use super::cycles::{Cycle, Drilling, kind_of};
use super::order::{Kind, Operation, Step};
use super::wrong;
use crate::control;
use crate::diag::{Code, Location};
use crate::toolpath::{
    Arc, Axes, Coolant, CycleKind, Direction, Event, FeedMode, Hold, Infeed, Place, Plane, Side, Sink, Spindle,
    SpindleTurn, Stop, StopKind, ToolChange,
};

type Done<T = ()> = Result<T, Stop>;

/// Letters of the six axes.
const AXES: &[u8; 6] = b"XYZABC";

/// The words that a command may have. `None`: jobs do not support the command, or it is a cycle (which checks its own words).
fn words_of(letter: u8, tenths: u16) -> Option<&'static [u8]> {
    Some(match (letter, tenths) {
        (b'G', 0 | 10) => b"XYZABCF", // the F of a rapid is ignored
        (b'G', 20 | 30) => b"XYZIJKRF",
        (b'G', 40) => b"P",
        (b'G', 400 | 410 | 420) => b"D", // the offset register comes from the tool
        (b'G', 170 | 180 | 190 | 800 | 900 | 980 | 990) | (b'M', 0 | 10 | 70 | 80 | 90) => b"",
        (b'M', 30 | 40 | 50) => b"S",
        _ => return None,
    })
}

/// Converts one step of a job. At the start of a step, the position of the tool is unknown.
pub(super) struct Convert<'a, 'h, 's> {
    label: &'a str,
    /// The operation; `None` if the step is a comment or a stop.
    operation: Option<&'a Operation>,
    hold: &'h mut Hold<'s>,
    place: Place,
    position: [Option<f64>; 6],
    feed: Option<f64>,
    returns: Return,
    plane: Plane,
    cycle: Option<Cycle>,
    side: Option<Side>,
    /// The change of cutter compensation at the next move: on at this side, or off.
    turning: Option<Option<Side>>,
    spindle: (Option<f64>, SpindleTurn),
    /// Whether a G code was printed as text. After such a G code, the meaning of later moves is unknown, so these moves
    /// are printed as text too.
    as_text: bool,
}

impl<'a, 'h, 's> Convert<'a, 'h, 's> {
    /// Begins a step of the job.
    pub fn begin(step: &'a Step, place: Place, hold: &'h mut Hold<'s>) -> Done<Convert<'a, 'h, 's>> {
        let operation = match &step.kind {
            Kind::Operation(operation, _) => Some(operation.as_ref()),
            _ => None,
        };
        let spindle = operation.map_or((None, SpindleTurn::Off), |operation| {
            let controller = &operation.controller;
            (Some(controller.speed).filter(|_| controller.turn != SpindleTurn::Off), controller.turn)
        });
        match &step.kind {
            Kind::Operation(operation, work) => {
                let change = ToolChange {
                    name: Some(step.label.clone()),
                    tool: Some(operation.controller.tool.clone()),
                    spindle: Some(Spindle { speed: spindle.0, turn: Some(spindle.1), ..Spindle::default() }),
                    coolant: Some(operation.coolant),
                    work: Some(*work),
                    feed_mode: Some(FeedMode::PerMinute),
                    comment: Some(step.label.clone()),
                    ..ToolChange::default()
                };
                hold.tool_change(change, place)?;
                if let Some(comment) = &operation.comment {
                    hold.push(Event::Comment(comment), place)?;
                }
            }
            Kind::Comment(text) => hold.push(Event::Comment(text), place)?,
            Kind::Stop(kind) => hold.push(Event::Stop(*kind), place)?,
        }
        Ok(Convert {
            label: &step.label,
            operation,
            hold,
            place,
            position: [None; 6],
            feed: None,
            returns: Return::Before,
            plane: Plane::Xy,
            cycle: None,
            side: None,
            turning: None,
            spindle,
            as_text: false,
        })
    }

    /// Converts the command on a line of the path.
    pub fn take(&mut self, line: u64, command: &Command<'_>) -> Done {
        self.place.item = line;
        let taken = match command {
            Command::Comment(text) => self.comment(text),
            Command::Code(code, words) if self.is_text(*code, words) => self.text(*code, words),
            Command::Code(code, words) => self.code(code.letter, code.tenths, words).map_err(|mut stop| {
                if let Stop::Wrong(diag) = &mut stop {
                    diag.message = format!("{code}: {}", diag.message);
                }
                stop
            }),
        };
        // add the location to an error of the sink
        let (place, label) = (self.place, self.label);
        taken.map_err(|stop| {
            stop.placed(|| Location::default().step(format!("{place}, operation `{label}`, line {line} of its path")))
        })
    }

    /// Handles the end of the path.
    pub fn end(&mut self) -> Done {
        self.end_cycle()?;
        if self.side.is_some() || self.turning.is_some() {
            let message = format!("the operation {} ends under cutter compensation", self.label);
            return wrong(Code::PD003, message, "end the compensation with G40 and a move");
        }
        Ok(())
    }

    fn push(&mut self, event: Event<'_>) -> Done {
        self.hold.push(event, self.place)
    }

    /// Whether this is a command that the user wrote and that jobs do not support. A tool change and an end of the program are always
    /// errors.
    fn is_text(&self, code: control::Code, words: &Words) -> bool {
        let Some(Operation { typed: true, .. }) = self.operation else { return false };
        match (code.letter, code.tenths) {
            (b'M', 20 | 60 | 300) => false,
            _ if self.as_text => true,
            (b'G', tenths) if kind_of(tenths).is_some() => false,
            (letter, tenths) => words_of(letter, tenths).is_none_or(|known| words.beyond(known).is_some()),
        }
    }

    /// Prints a command that the user wrote as text.
    fn text(&mut self, code: control::Code, words: &Words) -> Done {
        let Some(operation) = self.operation else { return Ok(()) };
        self.as_text |= code.letter == b'G';
        self.position = [None; 6];
        self.between(Event::Text(&words.block(code, |feed| operation.controller.feed(feed))))
    }

    fn code(&mut self, letter: u8, tenths: u16, words: &Words) -> Done {
        if let Some(known) = words_of(letter, tenths) {
            self.only(words, known)?;
        }
        match (letter, tenths) {
            (b'G', 0) => self.rapid(words),
            (b'G', 10) => self.line(words),
            (b'G', 20) => self.arc(words, Direction::Cw),
            (b'G', 30) => self.arc(words, Direction::Ccw),
            (b'G', 40) => match words.get(b'P').filter(|seconds| *seconds >= 0.0) {
                Some(seconds) => self.between(Event::Dwell(seconds)),
                None => wrong(Code::PD003, "a dwell without its seconds P", "write the dwell as `G4 P0.5`"),
            },
            (b'G', 170 | 180 | 190) => {
                self.plane = [Plane::Xy, Plane::Xz, Plane::Yz][usize::from(tenths / 10 - 17)];
                Ok(())
            }
            (b'G', 400 | 410 | 420) => {
                self.compensation([None, Some(Side::Left), Some(Side::Right)][usize::from(tenths / 10 - 40)])
            }
            (b'G', 800) => self.end_cycle(),
            (b'G', 900) => Ok(()), // positions are already absolute
            (b'G', 980 | 990) => {
                self.returns = if tenths == 980 { Return::Before } else { Return::Clearance };
                Ok(())
            }
            (b'G', tenths) if kind_of(tenths).is_some() => match kind_of(tenths) {
                Some(kind) => self.hole(kind, words),
                None => Ok(()),
            },
            (b'M', 0) => self.between(Event::Stop(StopKind::Program)),
            (b'M', 10) => self.between(Event::Stop(StopKind::Optional)),
            (b'M', 30 | 40 | 50) => {
                let turn = [SpindleTurn::Cw, SpindleTurn::Ccw, SpindleTurn::Off][usize::from(tenths / 10 - 3)];
                self.spin(words.get(b'S').filter(|speed| *speed > 0.0).or(self.spindle.0), turn)
            }
            (b'M', 70 | 80 | 90) => {
                let coolant = [Coolant::MIST, Coolant::FLOOD, Coolant::OFF][usize::from(tenths / 10 - 7)];
                self.between(Event::Coolant(coolant))
            }
            _ => {
                let help = "a path may contain moves, cycles, dwells, stops, spindle and coolant: remove the command";
                wrong(Code::PD003, "a command that a job can't contain", help)
            }
        }
    }

    /// Reports a word that the conversion would lose.
    fn only(&self, words: &Words, known: &[u8]) -> Done {
        match words.beyond(known) {
            Some(letter) => {
                let help = "remove the word from the path; postform does not skip words";
                wrong(Code::PD003, format!("a word {letter} that a job can't contain"), help)
            }
            None => Ok(()),
        }
    }

    fn comment(&mut self, text: &str) -> Done {
        // a path begins with the name of its operation, in which FreeCAD removed the parentheses
        let bare = |text: &str| text.replace(['(', ')', ' '], "");
        if text.is_empty() || self.place.item == 1 && bare(text) == bare(self.label) {
            return Ok(());
        }
        self.between(Event::Comment(text))
    }

    /// Ends an open cycle and pushes an event that is not a move.
    fn between(&mut self, event: Event<'_>) -> Done {
        self.end_cycle()?;
        self.push(event)
    }

    fn spin(&mut self, speed: Option<f64>, turn: SpindleTurn) -> Done {
        if turn != SpindleTurn::Off && speed.is_none() {
            let help = match self.operation {
                Some(operation) => {
                    format!("give {} a spindle speed in FreeCAD, or write `M3 S1000`", operation.controller.label)
                }
                None => "write the speed as `M3 S1000`".to_owned(),
            };
            return wrong(Code::PD004, "the spindle turns without a speed", help);
        }
        self.spindle = (speed, turn);
        self.between(Event::Spindle(Spindle { speed, turn: Some(turn), ..Spindle::default() }))
    }

    /// The target axes of a command. Also updates the position of the tool.
    fn target(&mut self, words: &Words) -> Axes {
        let mut to = Axes::default();
        for (axis, letter) in AXES.iter().enumerate() {
            if let Some(value) = words.get(*letter) {
                to.set(axis, value);
                self.position[axis] = Some(value);
            }
        }
        to
    }

    fn rapid(&mut self, words: &Words) -> Done {
        let to = self.target(words);
        if to.given == 0 {
            return Ok(());
        }
        if let Some(cycle) = &mut self.cycle {
            cycle.pending.push((to, self.position, self.place));
            return Ok(());
        }
        match self.turning.take() {
            Some(Some(side)) => self.push(Event::Infeed { infeed: &Infeed { to, side, rapid: true }, feed: None }),
            Some(None) => self.push(Event::Outfeed { to, feed: None, rapid: true }),
            None => self.push(Event::Rapid(to)),
        }
    }

    /// The feed of a cut in millimetres per minute. If the command has no feed, the last feed applies.
    fn feed(&mut self, words: &Words) -> Done<Option<f64>> {
        let Some(operation) = self.operation else { return Ok(None) };
        if let Some(feed) = words.get(b'F') {
            self.feed = Some(operation.controller.feed(feed));
        }
        match self.feed.filter(|feed| *feed > 0.0) {
            Some(feed) => Ok(Some(feed)),
            None => {
                let help = format!("give {} its feeds in FreeCAD and make the path again", operation.controller.label);
                wrong(Code::PD004, "a cut without a feed", help)
            }
        }
    }

    fn line(&mut self, words: &Words) -> Done {
        self.end_cycle()?;
        let to = self.target(words);
        if to.given == 0 {
            return self.feed(words).map(drop);
        }
        let feed = self.feed(words)?;
        match self.turning.take() {
            Some(Some(side)) => self.push(Event::Infeed { infeed: &Infeed { to, side, rapid: false }, feed }),
            Some(None) => self.push(Event::Outfeed { to, feed, rapid: false }),
            None => self.push(Event::Line { to, feed }),
        }
    }

    fn arc(&mut self, words: &Words, direction: Direction) -> Done {
        self.end_cycle()?;
        if self.turning.is_some() {
            let help = "turn the compensation on and off by straight moves";
            return wrong(Code::PD003, "cutter compensation is switched on an arc", help);
        }
        let (first, second, third) = match self.plane {
            Plane::Xy => (0, 1, 2),
            Plane::Xz => (0, 2, 1),
            Plane::Yz => (1, 2, 0),
        };
        if let Some(radius) = words.get(b'R') {
            return self.arc_by_radius(words, radius, direction);
        }
        let offset = |axis: usize| words.get(b"IJK"[axis]).unwrap_or(0.0);
        if offset(third) != 0.0 || (offset(first), offset(second)) == (0.0, 0.0) {
            let help = "give the centre by I and J from the start of the arc (in G17)";
            return wrong(Code::PD003, "an arc whose centre is not in its plane", help);
        }
        let mut center = Axes::default();
        for axis in [first, second] {
            let Some(from) = self.position[axis] else {
                return wrong(Code::PD003, "an arc from an unknown position", "begin the path with a rapid");
            };
            center.set(axis, from + offset(axis));
        }
        self.target(words);
        let mut to = Axes::default();
        for axis in 0..3 {
            if let Some(value) = self.position[axis] {
                to.set(axis, value);
            }
        }
        let feed = self.feed(words)?;
        let arc = Arc { to, center: Some(center), radius: None, direction, plane: self.plane, turns: 0 };
        self.push(Event::Arc { arc: &arc, feed })
    }

    /// Converts an arc that is given by its radius. Users write arcs with a radius; FreeCAD itself writes centres.
    fn arc_by_radius(&mut self, words: &Words, radius: f64, direction: Direction) -> Done {
        if words.beyond(b"XYZRF").is_some() {
            return wrong(Code::PD003, "an arc with a radius and a centre", "give I and J, or R, but not both");
        }
        let to = self.target(words);
        let feed = self.feed(words)?;
        let arc = Arc { to, center: None, radius: Some(radius), direction, plane: self.plane, turns: 0 };
        self.push(Event::Arc { arc: &arc, feed })
    }

    fn compensation(&mut self, side: Option<Side>) -> Done {
        self.end_cycle()?;
        if side != self.side || self.turning.is_some() {
            self.turning = Some(side).filter(|_| side != self.side || side.is_some());
            self.side = side;
        }
        Ok(())
    }

    fn hole(&mut self, kind: CycleKind, words: &Words) -> Done {
        let Some(operation) = self.operation else { return Ok(()) };
        if self.plane != Plane::Xy {
            return wrong(Code::PD003, "a cycle outside G17", "drill along Z");
        }
        let drilling = Drilling::read(kind, words, &self.position, self.returns, operation)?;
        let hole = match self.cycle.as_mut().and_then(|cycle| cycle.add(&drilling)) {
            Some(hole) => hole,
            None => {
                self.end_cycle()?;
                if let Some(turn) = kind.inwards().filter(|turn| (drilling.speed, *turn) != self.spindle) {
                    self.spin(drilling.speed, turn)?;
                }
                let (cycle, spec, hole) = Cycle::begin(drilling, operation.top);
                self.place.point = 0;
                self.push(Event::CycleBegin(&spec))?;
                self.cycle = Some(cycle);
                hole
            }
        };
        self.place.point += 1;
        self.push(Event::Hole(hole))?;
        self.position[..3].copy_from_slice(&[Some(drilling.at[0]), Some(drilling.at[1]), Some(drilling.level)]);
        Ok(())
    }

    /// Ends an open cycle, and then pushes the rapids that followed the cycle's last hole.
    fn end_cycle(&mut self) -> Done {
        let Some(cycle) = self.cycle.take() else { return Ok(()) };
        self.place.point = 0;
        self.push(Event::CycleEnd)?;
        for (to, _, place) in cycle.pending {
            self.hold.push(Event::Rapid(to), place)?;
        }
        Ok(())
    }
}
