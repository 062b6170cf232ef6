//! A lathe of G code system A, according to its maker's manuals: the motions of each block.
//!
//! It shares no code with postform. It follows FANUC's operator's manuals for lathes, B-64304EN (0i-D) and B-64484EN (31i-B),
//! and Haas's lathe operator's manual (96-8910, and the pages of haascnc.com). A case that these manuals leave open is
//! [`Stopped::Unsure`].

use std::collections::HashMap;

use super::corner::Corner;
pub use super::lexer::Words;
use super::lexer::{Block, Line, parse};

/// Radius and Z, in the program's units. NaN: only the machine has the value.
pub type Point = [f64; 2];

/// The kind of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A rapid.
    Rapid,
    /// A straight cut.
    Feed,
    /// A straight cut whose feed is the lead of a thread.
    Thread,
    /// An arc about a centre; true: counter-clockwise.
    Arc(Point, bool),
    /// A dwell in seconds. For a stop: minus the number of its M code, minus 1.
    Dwell(f64),
}

/// A motion, with the state during it.
#[derive(Clone, Copy, Debug)]
pub struct Move {
    /// The line of the program, from 1.
    pub line: usize,
    /// The kind of the motion.
    pub kind: Kind,
    /// Start position.
    pub from: Point,
    /// End position.
    pub to: Point,
    /// The feed; 0 at rapid.
    pub feed: f64,
    /// Whether the feed is per revolution.
    pub per_rev: bool,
    /// Direction of the spindle: 3, 4 or 5.
    pub spindle: f64,
    /// The spindle speed; true: a surface speed.
    pub speed: (f64, bool),
    /// The spindle limit, or 0.
    pub limit: f64,
    /// The active T word.
    pub tool: f64,
    /// Compensation: 40, 41 or 42.
    pub side: f64,
    /// The work offset: 54 to 59.
    pub work: f64,
    /// Coolant: 8 or 9.
    pub coolant: f64,
    /// The angle at which a thread begins, in thousandths of a degree.
    pub angle: f64,
}

impl Move {
    /// The state at the beginning.
    pub const BEGIN: Move = Move {
        line: 0,
        kind: Kind::Rapid,
        from: [0.0; 2],
        to: [0.0; 2],
        feed: 0.0,
        per_rev: false,
        spindle: 5.0,
        speed: (0.0, false),
        limit: 0.0,
        tool: 0.0,
        side: 40.0,
        work: 54.0,
        coolant: 9.0,
        angle: 0.0,
    };
}

/// The reason why a program is not run to its end.
#[derive(Clone, Debug, PartialEq)]
pub enum Stopped {
    /// An alarm that the manual describes.
    Alarm(String),
    /// The manuals do not define the case, or this executor does not support it.
    Unsure(String),
}

pub(super) fn alarm<T>(why: &str) -> Result<T, Stopped> {
    Err(Stopped::Alarm(why.to_owned()))
}

pub(super) fn unsure<T>(why: &str) -> Result<T, Stopped> {
    Err(Stopped::Unsure(why.to_owned()))
}

/// A machine that runs a program.
pub struct Machine<'p> {
    pub(super) haas: bool,
    pub(super) lines: &'p [Line],
    variables: HashMap<u32, f64>,
    /// Length of the least increment.
    pub(super) unit: f64,
    pub(super) at: Point,
    pub(super) now: Move,
    pub(super) feed: f64,
    /// The active code of group 01; NaN after a cycle that may have changed it.
    pub(super) motion: f64,
    /// X, Z and R of G90, G92 and G94, which stay active.
    pub(super) box_words: [Option<f64>; 3],
    /// U or W, and R, of the first block of G71 to G75.
    pub(super) first: HashMap<u32, [Option<f64>; 3]>,
    /// Whether the previous pass of G92 contained an angle.
    pub(super) thread_turned: bool,
    /// From the first block of G76: finishing passes, angle, least cut, allowance.
    pub(super) thread: Option<[f64; 4]>,
    pub(super) moves: Vec<Move>,
    pub(super) on_corner: bool,
    /// The corner that the previous block cut.
    corner: Option<Corner>,
}

/// Runs a program from its beginning to its end.
///
/// # Errors
/// The reason for a stop.
pub fn run(text: &str, haas: bool, inch: bool) -> Result<Vec<Move>, Stopped> {
    run_noting(text, haas, inch).map(|(moves, _)| moves)
}

/// Like [`run`]. Also returns whether a cut of G71 or G72 is at the height of a corner of its profile, where rounding decides.
///
/// # Errors
/// The reason for a stop.
pub fn run_noting(text: &str, haas: bool, inch: bool) -> Result<(Vec<Move>, bool), Stopped> {
    let lines = parse(text)?;
    let mut machine = Machine {
        haas,
        lines: &lines,
        variables: HashMap::new(),
        unit: if inch { 0.0001 } else { 0.001 },
        at: [f64::NAN; 2],
        now: Move::BEGIN,
        feed: f64::NAN,
        motion: 0.0,
        box_words: [None; 3],
        first: HashMap::new(),
        thread_turned: false,
        thread: None,
        moves: Vec::new(),
        on_corner: false,
        corner: None,
    };
    machine.all()?;
    Ok((machine.moves, machine.on_corner))
}

impl Machine<'_> {
    fn all(&mut self) -> Result<(), Stopped> {
        let (mut at, mut steps) = (0, 0);
        // for each call: the line to return to, the first line of the subprogram, and the remaining runs
        let mut calls: Vec<(usize, usize, u32)> = Vec::new();
        loop {
            steps += 1;
            if steps > 20_000 {
                return alarm("endless");
            }
            let Some(line) = self.lines.get(at) else { return alarm("no end") };
            self.now.line = line.number;
            if self.corner.is_some() && !matches!(line.block, Block::Words(_)) {
                return unsure("another block after a corner");
            }
            match &line.block {
                Block::Set(variable, value) => {
                    let value = value.of(&self.variables)?;
                    self.variables.insert(*variable, value);
                }
                Block::While(left, less, right, number) => {
                    let (a, b) = (left.of(&self.variables)?, right.of(&self.variables)?);
                    let goes = match less.as_str() {
                        "LT" => a < b,
                        "LE" => a <= b,
                        "GT" => a > b,
                        _ => a >= b,
                    };
                    if !goes {
                        let end = self.lines.iter().skip(at).position(|line| line.block == Block::End(*number));
                        let Some(end) = end else { return alarm("WHILE without END") };
                        at += end;
                    }
                }
                Block::End(number) => {
                    let is_begin = |line: &Line| matches!(&line.block, Block::While(.., other) if other == number);
                    let Some(begin) = self.lines[..at].iter().rposition(is_begin) else { return alarm("END alone") };
                    at = begin;
                    continue;
                }
                Block::Program(_) if at > 0 && self.lines[..at].iter().any(|line| line.has_words()) => {
                    return alarm("runs into another program");
                }
                Block::Program(_) => {}
                Block::Words(words) => {
                    let list: Vec<(char, f64, bool)> = words
                        .iter()
                        .map(|(letter, value, pointed)| Ok((*letter, value.of(&self.variables)?, *pointed)))
                        .collect::<Result<_, Stopped>>()?;
                    let words = Words { list };
                    if self.corner.is_some() && (words.is('M', 98.0) || words.is('M', 99.0)) {
                        return alarm("a corner that the next block does not leave");
                    }
                    if words.is('M', 98.0) {
                        let Some(program) = words.get('P') else { return alarm("M98 without P") };
                        // B-64304EN 13.3: in P, the count comes before the four digits of the number
                        let counted = !self.haas && program >= 10_000.0;
                        if counted && words.get('L').is_some() {
                            return unsure("M98 with two counts");
                        }
                        let (number, count) =
                            if counted { (program % 10_000.0, (program / 10_000.0).floor()) } else { (program, 1.0) };
                        let begin = self.lines.iter().position(|line| line.block == Block::Program(number as u32));
                        let Some(begin) = begin else { return alarm("no such program") };
                        let times = words.get('L').unwrap_or(count) as u32;
                        if times > 0 {
                            calls.push((at, begin + 1, times - 1));
                            at = begin + 1;
                            continue;
                        }
                    } else if words.is('M', 99.0) {
                        let Some((from, begin, again)) = calls.pop() else { return unsure("M99 of the main program") };
                        if again > 0 {
                            calls.push((from, begin, again - 1));
                            at = begin;
                            continue;
                        }
                        at = from;
                    } else if let Some(next) = self.block(&words, at)? {
                        at = next;
                        continue;
                    }
                    if words.is('M', 30.0) || words.is('M', 2.0) {
                        return Ok(());
                    }
                }
            }
            at += 1;
        }
    }

    pub(super) fn go(&mut self, kind: Kind, to: Point) -> Result<(), Stopped> {
        let cuts = matches!(kind, Kind::Feed | Kind::Thread | Kind::Arc(..));
        if cuts && self.feed.is_nan() {
            return alarm("no feed");
        }
        if cuts && self.feed.is_infinite() {
            return unsure("the feed after a finish");
        }
        if cuts && self.feed <= 0.0 {
            return alarm("a feed of zero");
        }
        if cuts && (self.at.iter().any(|value| value.is_nan()) || to.iter().any(|value| value.is_nan())) {
            return unsure("a cut from where only the machine knows");
        }
        let feed = if cuts { self.feed } else { 0.0 };
        self.moves.push(Move { kind, from: self.at, to, feed, ..self.now });
        self.at = to;
        Ok(())
    }

    /// Runs a block. Returns the next line to run; `None`: the following line.
    fn block(&mut self, words: &Words, at: usize) -> Result<Option<usize>, Stopped> {
        if words.list.is_empty() {
            return Ok(None);
        }
        let (mut once, mut stop) = (None, None);
        for &(letter, value, _) in &words.list {
            match (letter, value) {
                ('G', 20.0 | 21.0) => {
                    let unit = if value == 20.0 { 0.0001 } else { 0.001 };
                    if unit != self.unit {
                        return unsure("other units");
                    }
                }
                ('G', 18.0 | 80.0) => {}
                ('G', 40.0..=42.0) => self.now.side = value,
                ('G', 54.0..=59.0) if value == self.now.work => {}
                // the position in the other work offset is unknown
                ('G', 54.0..=59.0) => (self.now.work, self.at) = (value, [f64::NAN; 2]),
                ('G', 96.0 | 97.0) => self.now.speed.1 = value == 96.0,
                ('G', 98.0 | 99.0) => self.now.per_rev = value == 99.0,
                ('G', 0.0..=3.0 | 32.0) => (self.motion, self.box_words) = (value, [None; 3]),
                ('G', 90.0 | 92.0 | 94.0) => {
                    // the manuals do not define whether R stays active if the code of a tapered pass is repeated
                    // without R
                    let again = self.motion == value && (words.any(['X', 'U']) || words.any(['Z', 'W']));
                    if again && self.box_words[2].is_some() && words.get('R').is_none() {
                        return unsure("the code of a tapered pass again, without R");
                    }
                    self.thread_turned &= self.motion == value;
                    // B-64304EN 4.1: X, Z and R stay active until a code of group 00 other than G4, or any code of
                    // group 01, also the active code. HUST's H6D-T manual (3-41) for the same system agrees
                    if self.motion != value {
                        if [90.0, 92.0, 94.0].contains(&self.motion) {
                            return unsure("one canned cycle after another");
                        }
                        self.box_words = [None; 3];
                    }
                    self.motion = value;
                }
                ('G', 4.0 | 28.0 | 50.0 | 70.0..=76.0) if once.is_none() => once = Some(value),
                ('G', 4.0 | 28.0 | 50.0 | 70.0..=76.0) => return unsure("two codes of group 00"),
                ('G', _) => return unsure(&format!("G{value}")),
                ('T', _) => self.now.tool = value,
                ('S', _) if !words.is('G', 50.0) => self.now.speed.0 = value,
                ('F', _) => self.feed = value,
                ('M', 3.0..=5.0) => self.now.spindle = value,
                ('M', 0.0 | 1.0) => stop = Some(value),
                ('M', 8.0 | 9.0) => self.now.coolant = value,
                ('M', 2.0 | 30.0) => {}
                ('M', _) => return unsure(&format!("M{value}")),
                _ => {}
            }
        }
        let corner = self.corner.take();
        if corner.is_some()
            && (once.is_some() || words.list.iter().any(|(letter, ..)| ['T', 'S', 'M'].contains(letter)))
        {
            return alarm("a corner that the next block does not leave");
        }
        if let Some(code) = stop {
            let alone = words.list.iter().all(|(letter, ..)| ['M', 'N'].contains(letter));
            return if alone {
                self.go(Kind::Dwell(-1.0 - code), self.at).map(|()| None)
            } else {
                unsure("a stop and more")
            };
        }
        let Some(once) = once else {
            self.motion(words, corner)?;
            return Ok(None);
        };
        match once {
            // B-64304EN 3.x: X or U is in seconds, and P is in milliseconds. Haas, G04: P with a decimal point is in
            // seconds; otherwise P is in milliseconds
            4.0 => {
                let said = words.list.iter().find(|(letter, ..)| ['X', 'U', 'P'].contains(letter));
                let Some(&(letter, value, pointed)) = said else { return alarm("G4 without its time") };
                let seconds = match letter {
                    'P' if !(self.haas && pointed) => value / 1000.0,
                    'P' => value,
                    _ if pointed => value,
                    _ => value / 1000.0,
                };
                self.go(Kind::Dwell(seconds), self.at)?;
            }
            28.0 => {
                self.box_words = [None; 3];
                let to = self.position(words);
                if to.iter().zip(&self.at).any(|(a, b)| (a - b).abs() > 1e-9) {
                    self.go(Kind::Rapid, to)?;
                }
                let (x, z) = (words.any(['X', 'U']), words.any(['Z', 'W']));
                if !x && !z {
                    return unsure("G28 alone");
                }
                let home = |goes: bool, at: f64| if goes { f64::NAN } else { at };
                self.go(Kind::Rapid, [home(x, self.at[0]), home(z, self.at[1])])?;
            }
            50.0 => match words.get('S') {
                Some(limit) if !words.any(['X', 'Z']) && !words.any(['U', 'W']) => {
                    (self.now.limit, self.box_words) = (limit, [None; 3]);
                }
                _ => return unsure("G50 of a position"),
            },
            _ => {
                let next = self.repetitive(once as u32, words, at)?;
                // the manuals do not define the active code of group 01 after a repetitive cycle
                self.motion = f64::NAN;
                self.box_words = [None; 3];
                return Ok(next);
            }
        }
        Ok(None)
    }

    /// The position from X, Z, U and W. U and W are increments from the tool's position.
    pub(super) fn position(&self, words: &Words) -> Point {
        self.position_from(words, self.at)
    }

    pub(super) fn position_from(&self, words: &Words, at: Point) -> Point {
        let length = |letter| words.length(letter, self.unit);
        let x = length('X').map(|x| x / 2.0).or(length('U').map(|u| at[0] + u / 2.0));
        let z = length('Z').or(length('W').map(|w| at[1] + w));
        [x.unwrap_or(at[0]), z.unwrap_or(at[1])]
    }

    fn motion(&mut self, words: &Words, corner: Option<Corner>) -> Result<(), Stopped> {
        let moves = words.any(['X', 'Z']) || words.any(['U', 'W']);
        let circle = self.motion == 2.0 || self.motion == 3.0;
        if !moves {
            if corner.is_some() {
                return alarm("a corner that the next block does not leave");
            }
            if circle && (words.any(['I', 'K']) || words.get('R').is_some()) {
                return unsure("an arc without its end");
            }
            return Ok(());
        }
        let to = self.position_from(words, corner.map_or(self.at, |corner| corner.at));
        if let Some(corner) = corner {
            corner.is_left(words, self.motion, to)?;
        }
        match self.motion {
            0.0 => self.go(Kind::Rapid, to),
            1.0 => match self.cornered(words, self.at, to)? {
                Some((parts, corner)) => {
                    for (kind, to) in parts {
                        self.go(kind, to)?;
                    }
                    self.corner = Some(corner);
                    Ok(())
                }
                None => self.go(Kind::Feed, to),
            },
            2.0 | 3.0 => {
                let kind = self.arc(words, self.at, to, self.motion == 3.0)?;
                self.go(kind, to)
            }
            // B-64304EN 3.4: F of G32 is the lead along the axis that moves farther
            32.0 => self.thread_at(words, to),
            90.0 | 92.0 | 94.0 => self.box_cycle(words, to),
            _ => unsure("the motion code after a cycle"),
        }
    }

    /// A thread. B-64304EN 5.4: Q is the start angle of the thread for this block only, in units of 0.001 degrees
    /// without a decimal point.
    pub(super) fn thread_at(&mut self, words: &Words, to: Point) -> Result<(), Stopped> {
        if words.any(['I', 'K']) || words.get('R').is_some() && self.motion == 32.0 {
            return unsure("a thread with I, K or R");
        }
        self.now.angle = words.get('Q').unwrap_or(0.0);
        let end = self.go(Kind::Thread, to);
        self.now.angle = 0.0;
        end
    }

    /// An arc. I and K are relative to the start of the arc, and I is a radius. R is the radius of an arc of up to half
    /// a turn.
    pub(super) fn arc(&self, words: &Words, from: Point, to: Point, ccw: bool) -> Result<Kind, Stopped> {
        let length = |letter| words.length(letter, self.unit);
        let center = if let Some(radius) = length('R') {
            let (dx, dz) = (to[0] - from[0], to[1] - from[1]);
            let chord = dx.hypot(dz);
            let high = radius * radius - chord * chord / 4.0;
            if high < -1e-3 * chord || chord < 1e-9 {
                return alarm("R too small");
            }
            // counter-clockwise with Z to the right and X up: the centre is to the left of the chord
            let side = high.max(0.0).sqrt() * if ccw == (radius > 0.0) { 1.0 } else { -1.0 };
            [(from[0] + to[0]) / 2.0 + side * dz / chord, (from[1] + to[1]) / 2.0 - side * dx / chord]
        } else if words.any(['I', 'K']) {
            [from[0] + length('I').unwrap_or(0.0), from[1] + length('K').unwrap_or(0.0)]
        } else {
            return unsure("an arc without its centre");
        };
        let away = |point: Point| (point[0] - center[0]).hypot(point[1] - center[1]);
        if (away(from) - away(to)).abs() > 10.0 * self.unit {
            return alarm("ends off its circle");
        }
        Ok(Kind::Arc(center, ccw))
    }
}
