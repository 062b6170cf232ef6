//! Lathes: converts a job to the form of a milling job, and runs programs of Fanuc's G code system A. Positions are
//! radius, 0 and Z.

use serde_json::{Value, json};

use super::machine::{Act, State, What, by_radius};
use super::scan::words;
use super::{INCH, Place};

/// The job with positions as X and Z, and with tools as T words contain them.
pub fn as_mill(job: &Value) -> Value {
    let mut job = job.clone();
    job["machine"] = json!("mill");
    let station = |number: f64| if number >= 100.0 { (number / 100.0).trunc() } else { number };
    for tool in job["tools"].as_array_mut().into_iter().flatten() {
        let number = tool["number"].as_f64().unwrap_or(0.0);
        if number >= 100.0 {
            tool["length_offset"] = json!(number % 100.0);
        }
        tool["number"] = json!(station(number));
    }
    for operation in job["operations"].as_array_mut().into_iter().flatten() {
        if let Some(number) = operation.get("tool").and_then(Value::as_f64) {
            operation["tool"] = json!(station(number));
        }
        operation["path"].as_array_mut().into_iter().flatten().for_each(item);
    }
    job
}

fn item(item: &mut Value) {
    for key in ["rapid", "line", "infeed", "outfeed"] {
        if let Some(at) = item.get_mut(key) {
            place(at);
        }
    }
    if let Some(arc) = item.get_mut("arc") {
        ["to", "center"]
            .into_iter()
            .filter_map(|key| arc.get(key).map(|_| key))
            .collect::<Vec<_>>()
            .into_iter()
            .for_each(|key| place(&mut arc[key]));
        arc["plane"] = json!("xz");
    }
    if let Some(points) = item.get_mut("cycle").and_then(|cycle| cycle["points"].as_array_mut()) {
        points.iter_mut().for_each(place);
    }
}

/// Converts [z, x] to [x, 0, z].
fn place(at: &mut Value) {
    let of = |axis: usize| at.get(axis).cloned().unwrap_or(Value::Null);
    *at = json!([of(1), null, of(0)]);
}

/// The factor for a speed. For a surface speed in a program in inches, the factor converts feet to metres per minute;
/// otherwise it is 1.
pub fn surface(is_surface: bool, scale: f64) -> f64 {
    if is_surface && scale == INCH { 0.3048 } else { 1.0 }
}

struct Lathe {
    scale: f64,
    /// Whether S is a surface speed.
    surface: bool,
    diameter: f64,
    at: Place,
    state: State,
    motion: f64,
    /// Position along the axis at which the active cycle ends.
    end: f64,
    taper: f64,
    first: [f64; 3],
    acts: Vec<Act>,
}

/// Runs a program.
///
/// # Errors
/// The line at which the machine stops, and the reason.
pub fn run(program: &str, by_diameter: bool, inch: bool) -> Result<Vec<Act>, (usize, String)> {
    let mut lathe = Lathe {
        scale: if inch { INCH } else { 1.0 },
        surface: false,
        diameter: if by_diameter { 2.0 } else { 1.0 },
        at: [f64::NAN, 0.0, f64::NAN, 0.0, 0.0, 0.0],
        state: State { direction: 5.0, side: (40.0, 0.0), feed: (f64::NAN, 94.0), work: 54.0, ..State::default() },
        motion: 0.0,
        end: f64::NAN,
        taper: 0.0,
        first: [0.0; 3],
        acts: Vec::new(),
    };
    for (number, line) in program.lines().enumerate() {
        let list = words(line).map_err(|error| (number + 1, error))?;
        if lathe.block(&list, number + 1).map_err(|error| (number + 1, error))? {
            return Ok(lathe.acts);
        }
    }
    Err((program.lines().count(), "the program has no end".into()))
}

impl Lathe {
    fn act(&mut self, line: usize, what: What, to: Place) {
        self.acts.push(Act { line, what, from: self.at, to, state: self.state });
        self.at = to;
    }

    /// Runs a block. Returns true at the end of the program.
    fn block(&mut self, list: &[(u8, f64)], line: usize) -> Result<bool, String> {
        let get = |letter: u8| list.iter().rfind(|(other, _)| *other == letter).map(|(_, number)| *number);
        let has = |letter: u8, number: f64| list.contains(&(letter, number));
        let [home, machine, limit, dwell] = [28.0, 53.0, 50.0, 4.0].map(|code| has(b'G', code));
        let mut said = None;
        for &(letter, number) in list {
            match (letter, number) {
                (b'G', 96.0 | 97.0) => self.surface = number == 96.0,
                (b'G', 0.0 | 1.0 | 2.0 | 3.0 | 32.0 | 76.0) => self.motion = number,
                (b'G', 92.0) => (self.motion, self.taper) = (number, 0.0),
                (b'G', 20.0) => self.scale = INCH,
                (b'G', 21.0) => self.scale = 1.0,
                (b'G', 40.0..=42.0) => self.state.side = (number, 0.0),
                (b'G', 98.0) => self.state.feed.1 = 94.0,
                (b'G', 99.0) => self.state.feed.1 = 95.0,
                (b'G', 4.0 | 18.0 | 28.0 | 50.0 | 53.0 | 54.0 | 80.0) => {}
                (b'G', other) => return Err(format!("G{other}")),
                (b'T', word) => {
                    (self.state.tool, self.state.length) = ((word / 100.0).trunc(), Some(word % 100.0));
                    (self.at[0], self.at[2]) = (f64::NAN, f64::NAN);
                    let at = self.at;
                    self.act(line, What::Tool, at);
                }
                (b'S', speed) if !limit => said = Some(speed),
                (b'F', feed) => self.state.feed.0 = feed * self.scale,
                (b'M', 3.0..=5.0) => self.state.direction = number,
                (b'M', 8.0) => self.state.coolant |= 2,
                (b'M', 9.0) => self.state.coolant = 0,
                (b'M', 0.0 | 1.0 | 2.0 | 30.0) => {}
                (b'M', other) => return Err(format!("M{other}")),
                _ => {}
            }
        }
        if let Some(speed) = said {
            self.state.speed = speed * surface(self.surface, self.scale);
        }
        let at = self.at;
        if dwell {
            let seconds = get(b'U').or(get(b'X')).or(get(b'P').map(|p| if p >= 50.0 { p / 1000.0 } else { p }));
            self.act(line, What::Dwell(seconds.ok_or("G4 without its time")?), at);
        } else if home || machine {
            let mut to = at;
            let gone = |letters: [u8; 2]| letters.iter().any(|&letter| get(letter).is_some());
            if gone([b'U', b'X']) {
                to[0] = f64::NAN;
            }
            if gone([b'W', b'Z']) {
                to[2] = f64::NAN;
            }
            self.act(line, What::Rapid, to);
        } else {
            self.moves(&get, line)?;
        }
        for code in [0.0, 1.0] {
            if has(b'M', code) {
                let at = self.at;
                self.act(line, What::Stop(code), at);
            }
        }
        let ends = has(b'M', 30.0) || has(b'M', 2.0);
        if ends {
            let at = self.at;
            self.act(line, What::End, at);
        }
        Ok(ends)
    }

    fn moves(&mut self, get: &dyn Fn(u8) -> Option<f64>, line: usize) -> Result<(), String> {
        let mut to = self.at;
        if let Some(x) = get(b'X') {
            to[0] = x * self.scale / self.diameter;
        }
        if let Some(z) = get(b'Z') {
            to[2] = z * self.scale;
        }
        if self.motion == 76.0 && get(b'X').is_none() && get(b'Z').is_none() {
            if let (Some(p), Some(q)) = (get(b'P'), get(b'Q')) {
                self.first = [(p / 10_000.0).trunc(), q * self.scale * 1e-4, get(b'R').unwrap_or(0.0) * self.scale];
            }
            return Ok(());
        }
        let circle = matches!(self.motion, 2.0 | 3.0) && (get(b'I').is_some() || get(b'K').is_some());
        if get(b'X').is_none() && get(b'Z').is_none() && !circle {
            return Ok(());
        }
        if self.motion != 0.0 && self.state.feed.0.is_nan() {
            return Err("no feed".into());
        }
        let lead = self.state.feed.0;
        match self.motion {
            0.0 => self.act(line, What::Rapid, to),
            1.0 => self.act(line, What::Feed, to),
            2.0 | 3.0 => {
                let ccw = self.motion == 3.0;
                let (from, end) = ([self.at[2], self.at[0]], [to[2], to[0]]);
                let center = match get(b'R') {
                    Some(radius) => by_radius(from, end, radius * self.scale, ccw).ok_or("no such arc")?,
                    None => [
                        from[0] + get(b'K').unwrap_or(0.0) * self.scale,
                        from[1] + get(b'I').unwrap_or(0.0) * self.scale,
                    ],
                };
                self.act(line, What::Arc { plane: 18.0, center, ccw, turns: 0.0 }, to);
            }
            32.0 => self.act(line, What::Thread(lead), to),
            code => {
                match get(b'Z') {
                    Some(_) => self.end = to[2],
                    None => to[2] = self.end,
                }
                if let Some(taper) = get(b'R').or(get(b'I')) {
                    self.taper = taper * self.scale;
                }
                let taper = if code == 76.0 { get(b'R').unwrap_or(0.0) * self.scale } else { self.taper };
                let begin = self.at;
                for radius in self.passes(code, begin, to, get)? {
                    let mut at = begin;
                    at[0] = radius + taper;
                    self.act(line, What::Rapid, at);
                    (at[0], at[2]) = (radius, to[2]);
                    self.act(line, What::Thread(lead), at);
                    at[0] = begin[0];
                    self.act(line, What::Rapid, at);
                    self.act(line, What::Rapid, begin);
                }
            }
        }
        Ok(())
    }

    fn passes(&self, code: f64, begin: Place, to: Place, get: &dyn Fn(u8) -> Option<f64>) -> Result<Vec<f64>, String> {
        if code == 92.0 {
            return Ok(vec![to[0]]);
        }
        let count = |letter: u8| get(letter).map(|number| number * self.scale * 1e-4);
        let (depth, cut) = count(b'P').zip(count(b'Q')).ok_or("G76 without P or Q")?;
        if depth <= 0.0 || cut <= 0.0 {
            return Err("G76 without a depth".into());
        }
        let inward = if begin[0] >= to[0] { -1.0 } else { 1.0 };
        let crest = to[0] - inward * depth;
        let (mut list, mut reached, mut n) = (Vec::new(), 0.0f64, 0.0f64);
        while reached < depth - self.first[2] - 1e-9 && list.len() < 2000 {
            n += 1.0;
            reached = (cut * n.sqrt()).max(reached + self.first[1]).min(depth - self.first[2]);
            list.push(crest + inward * reached);
        }
        let again = if self.first[2] > 0.0 { self.first[0].max(1.0) } else { self.first[0] - 1.0 };
        (0..again.max(0.0) as usize).for_each(|_| list.push(to[0]));
        Ok(list)
    }
}
