//! Reads statements with their modal values, and lists the resulting steps.

use super::cycle::{Cycle, Dwell, Kind, Return};
use super::feed::{is_feed, per_minute};
use super::hole::{At, Hole, hole};
use super::statement::{Minor, Statement, statements};
use super::{Point, Turn};

/// A step that a file requests.
#[derive(Clone, Debug)]
pub enum Does {
    /// A rapid to a point.
    Rapid(Point),
    /// A straight cut to a point.
    Line(Point),
    /// An arc about an axis through the centre: its end, its centre, its axis.
    Arc(Point, Point, Point),
    /// A point of a cycle.
    Hole(Hole),
    /// A dwell in seconds.
    Dwell(f64),
    /// A stop: 0 or 1.
    Stop(f64),
}

/// A step, with the state in which it is made.
#[derive(Clone, Debug)]
pub struct Step {
    /// The step.
    pub does: Does,
    /// The tool, and the number of tools that were loaded before.
    pub tool: (f64, usize),
    /// The direction and speed of the spindle.
    pub spindle: (Turn, f64),
    /// The feed outside cycles, in millimetres per minute.
    pub feed: f64,
}

#[derive(Clone, Copy)]
enum Override {
    Auto,
    On,
    Off,
    Above(f64),
}

struct Reader {
    unit: f64,
    at: Point,
    tool: (f64, usize),
    spindle: (Turn, f64),
    /// FEDRAT: the word and its number.
    feed: Option<(String, f64)>,
    rapid: bool,
    arc: Option<(Point, Point)>,
    steps: Vec<Step>,
    /// The active cycle; `last` is the last cycle, which may have ended.
    cycle: Option<Cycle>,
    last: Option<Cycle>,
    /// The return plane of the active cycle; `None` before its first point.
    plane: Option<Option<f64>>,
    /// The RETURN of the active cycle.
    out: Override,
    clear: Option<f64>,
    dwell: Option<Dwell>,
    built_in: bool,
    /// CYCLE/RETURN.
    returns: Override,
}

/// The steps that a CL file requests.
///
/// # Errors
/// A statement that this reader does not know, or a value that its texts do not define.
pub fn plan(text: &str) -> Result<Vec<Step>, String> {
    let mut reader = Reader {
        unit: 1.0,
        at: [f64::NAN; 3],
        tool: (f64::NAN, 0),
        spindle: (Turn::Off, 0.0),
        feed: None,
        rapid: false,
        arc: None,
        steps: Vec::new(),
        cycle: None,
        last: None,
        plane: None,
        out: Override::Auto,
        clear: None,
        dwell: None,
        built_in: true,
        returns: Override::Auto,
    };
    for statement in statements(text) {
        reader.statement(&statement).ok_or_else(|| format!("{statement:?}"))?;
    }
    Ok(reader.steps)
}

impl Reader {
    fn put(&mut self, does: Does) {
        // a feed per revolution depends on the spindle speed
        let feed = self.feed.as_ref().and_then(|(word, value)| per_minute(word, *value, self.unit, self.spindle.1));
        self.steps.push(Step { does, tool: self.tool, spindle: self.spindle, feed: feed.unwrap_or(f64::NAN) });
    }

    fn statement(&mut self, statement: &Statement) -> Option<()> {
        let numbers = statement.numbers();
        let first = numbers.first().copied();
        match statement.major.as_str() {
            "PARTNO" | "PPRINT" | "COOLNT" | "FINI" => {}
            "UNITS" => self.unit = if statement.has("INCHES") { 25.4 } else { 1.0 },
            "LOADTL" => {
                self.tool = (first?, self.tool.1 + 1);
                self.at = [f64::NAN; 3];
                (self.cycle, self.plane) = (None, None);
            }
            "SPINDL" => self.spindle(statement, first),
            "FEDRAT" => self.fedrat(statement, first?),
            "RAPID" => self.rapid = true,
            "DELAY" => self.put(Does::Dwell(first?)),
            "STOP" => self.put(Does::Stop(0.0)),
            "OPSTOP" => self.put(Does::Stop(1.0)),
            "MOVARC" => {
                let point = |from: usize| [numbers[from], numbers[from + 1], numbers[from + 2]];
                let center = point(0).map(|number| number * self.unit);
                self.arc = Some((center, point(3)));
            }
            "GOTO" | "GODLTA" => {
                let [x, y, z] = numbers[..] else { return None };
                let mut to = [x, y, z].map(|number| number * self.unit);
                if statement.major == "GODLTA" {
                    (0..3).for_each(|axis| to[axis] += self.at[axis]);
                }
                self.go(to)?;
            }
            "CYCLE" => self.cycle(statement)?,
            _ => return None,
        }
        Some(())
    }

    fn spindle(&mut self, statement: &Statement, speed: Option<f64>) {
        self.spindle.1 = speed.unwrap_or(self.spindle.1);
        for minor in &statement.minors {
            match minor {
                Minor::Word(word) if word == "CLW" => self.spindle.0 = Turn::Clockwise,
                Minor::Word(word) if word == "CCLW" => self.spindle.0 = Turn::Counterclockwise,
                Minor::Word(word) if word == "OFF" => self.spindle.0 = Turn::Off,
                _ => {}
            }
        }
    }

    fn fedrat(&mut self, statement: &Statement, value: f64) {
        // "Any FEDRAT coded during a cycle will be diagnosed with a warning and ignored"
        if self.cycle.is_some() {
            return;
        }
        let word = statement.minors.iter().find_map(|minor| match minor {
            Minor::Word(word) if is_feed(word) => Some(word.clone()),
            _ => None,
        });
        self.feed = Some((word.unwrap_or_else(|| "PERMIN".into()), value));
        self.rapid = false;
    }

    fn go(&mut self, to: Point) -> Option<()> {
        let rapid = std::mem::replace(&mut self.rapid, false);
        if let Some((center, axis)) = self.arc.take() {
            self.put(Does::Arc(to, center, axis));
        } else if rapid {
            self.put(Does::Rapid(to));
        } else if let Some(cycle) = self.cycle.clone() {
            return self.hole(&cycle, to);
        } else {
            self.put(Does::Line(to));
        }
        self.at = to;
        Some(())
    }

    fn hole(&mut self, cycle: &Cycle, point: Point) -> Option<()> {
        let clear = self.clear?;
        let plane = match self.plane {
            Some(plane) => plane,
            None => match self.out {
                Override::Auto => match cycle.out {
                    None => None,
                    Some(Return::Clearance) => Some(point[2] + clear * self.unit),
                    Some(Return::Above(above)) => Some(point[2] + above * self.unit),
                },
                // "the current tool position at the start of the cycle": before the first point, as for a control's G98
                Override::On => Some(self.at[2]),
                Override::Off => None,
                Override::Above(above) => Some(point[2] + above * self.unit),
            },
        };
        self.plane = Some(plane);
        let seconds = |dwell: Dwell| match dwell {
            Dwell::Seconds(seconds) => seconds,
            Dwell::Revolutions(turns) => 60.0 * turns / self.spindle.1,
        };
        let faces = cycle.kind == Kind::Face || cycle.is("NOREVR");
        let dwell = match (cycle.dwell, faces) {
            (Some(dwell), _) => Some(Some(seconds(dwell))),
            (None, true) => Some(self.dwell.map(seconds)),
            (None, false) => None,
        };
        let at = At { point, unit: self.unit, clear, plane, turn: self.spindle.0, dwell, built_in: self.built_in };
        let feed = |number: usize| {
            let (word, value) = cycle.feed_of(number)?;
            per_minute(&word, value, self.unit, self.spindle.1)
        };
        let hole = hole(cycle, &at, &feed)?;
        self.at = [hole.over[0], hole.over[1], hole.plane];
        // "Multiple starts will cause the cycle to be output multiple times"
        let starts = cycle.starts.unwrap_or(1.0).max(1.0);
        for start in 0..starts as usize {
            let lead = hole.feed / self.spindle.1;
            self.put(Does::Hole(hole.lower(lead * start as f64 / starts)));
        }
        if starts > 1.0 {
            self.put(Does::Rapid(self.at));
        }
        Some(())
    }

    fn cycle(&mut self, statement: &Statement) -> Option<()> {
        let word = |at: usize| match statement.minors.get(at) {
            Some(Minor::Word(word)) => word.as_str(),
            _ => "",
        };
        match word(0) {
            "OFF" | "NOMORE" => {
                self.cycle = None;
                self.plane = None;
                self.rapid = true;
                return Some(());
            }
            "AUTO" => {
                self.built_in = word(1) == "ON";
                return Some(());
            }
            "RETURN" => {
                self.returns = match (word(1), statement.minors.get(1).and_then(Minor::number)) {
                    ("ON", _) => Override::On,
                    ("OFF", _) => Override::Off,
                    ("AUTO", _) => Override::Auto,
                    (_, Some(above)) => Override::Above(above),
                    _ => return None,
                };
                return Some(());
            }
            _ => {}
        }
        let cycle = match word(0) {
            "ON" => self.last.as_ref()?.again(statement)?,
            _ => Cycle::read(statement)?,
        };
        self.clear = cycle.clear.or(self.clear);
        self.dwell = cycle.dwell.or(self.dwell);
        self.out = self.returns;
        self.plane = None;
        self.rapid = false;
        self.last = Some(cycle.clone());
        self.cycle = Some(cycle);
        Some(())
    }
}
