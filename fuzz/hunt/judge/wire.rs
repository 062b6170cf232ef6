//! Wire EDM: converts a job to the form of a milling job, and runs its programs. U is treated as a height, V as an
//! angle.

use serde_json::{Value, json};

use super::machine::{Act, State, What};
use super::scan::words;
use super::{INCH, Place};

/// Degrees for 1 mm of V. Angles are compared within 0.01 degrees.
const TURNED: f64 = 3.0;
/// The codes of the shipped form.
const ACTIONS: [(&str, f64); 4] = [("thread", 60.0), ("cut", 50.0), ("predrill", 66.0), ("submerge", 78.0)];

/// The code of an action.
pub fn code(action: &str) -> f64 {
    ACTIONS.iter().find(|(name, _)| *name == action).map_or(f64::NAN, |(_, code)| *code)
}

/// Whether the code is a stop or an action.
fn is_done(code: f64) -> bool {
    code < 2.0 || ACTIONS.iter().any(|(_, own)| *own == code)
}

/// The job with V as an angle.
pub fn as_mill(job: &Value) -> Value {
    let mut job = job.clone();
    let unit = if job["units"] == "inch" { INCH } else { 1.0 };
    job["machine"] = json!("mill");
    for operation in job["operations"].as_array_mut().into_iter().flatten() {
        for item in operation["path"].as_array_mut().into_iter().flatten() {
            for key in ["rapid", "line", "infeed", "outfeed"] {
                if let Some(v) = item.get_mut(key).and_then(|at| at.get_mut(3)) {
                    *v = json!(v.as_f64().unwrap_or(0.0) * unit * TURNED);
                }
            }
        }
    }
    job
}

/// Runs a program.
///
/// # Errors
/// The line at which the machine stops, and the reason.
pub fn run(program: &str, inch: bool) -> Result<Vec<Act>, (usize, String)> {
    let mut wire = Wire {
        scale: if inch { INCH } else { 1.0 },
        at: [f64::NAN, f64::NAN, f64::NAN, 0.0, 0.0, 0.0],
        state: State { direction: 5.0, side: (40.0, 0.0), feed: (f64::NAN, 94.0), work: 54.0, ..State::default() },
        motion: f64::NAN,
        absolute: true,
        acts: Vec::new(),
    };
    for (number, line) in program.lines().enumerate() {
        let list = words(line).map_err(|error| (number + 1, error))?;
        if wire.block(&list, number + 1).map_err(|error| (number + 1, error))? {
            return Ok(wire.acts);
        }
    }
    Err((program.lines().count(), "the program has no end".into()))
}

struct Wire {
    scale: f64,
    at: Place,
    state: State,
    motion: f64,
    absolute: bool,
    acts: Vec<Act>,
}

impl Wire {
    fn act(&mut self, line: usize, what: What, to: Place) {
        self.acts.push(Act { line, what, from: self.at, to, state: self.state });
        self.at = to;
    }

    /// Runs a block. Returns true at the end of the program.
    fn block(&mut self, list: &[(u8, f64)], line: usize) -> Result<bool, String> {
        let get = |letter: u8| list.iter().rfind(|(other, _)| *other == letter).map(|(_, number)| *number);
        let has = |letter: u8, number: f64| list.contains(&(letter, number));
        let mut dwell = false;
        for &(letter, number) in list {
            match (letter, number) {
                (b'G', 0.0..=3.0) => self.motion = number,
                (b'G', 4.0) => dwell = true,
                (b'G', 20.0) => self.scale = INCH,
                (b'G', 21.0) => self.scale = 1.0,
                (b'G', 40.0..=42.0) => self.state.side = (number, 0.0),
                (b'G', 54.0..60.0) => {
                    if self.state.work != number {
                        self.at[..3].fill(f64::NAN);
                    }
                    self.state.work = number;
                }
                (b'G', 90.0) => self.absolute = true,
                (b'G', 91.0) => self.absolute = false,
                (b'G', 94.0) => self.state.feed.1 = number,
                (b'G', other) => return Err(format!("G{other}")),
                (b'F', feed) => self.state.feed.0 = feed * self.scale,
                (b'M', 0.0 | 1.0 | 2.0 | 30.0) => {}
                // spindle and coolant codes of a mill are ignored
                (b'M', 3.0..=5.0 | 7.0..=9.0 | 19.0) => {}
                (b'M', code) if ACTIONS.iter().any(|(_, own)| *own == code) => {}
                (b'M', other) => return Err(format!("M{other}")),
                _ => {}
            }
        }
        let at = self.at;
        if dwell {
            let seconds = get(b'P').ok_or("G4 without P")? / 1000.0;
            self.act(line, What::Dwell(seconds), at);
        } else {
            self.moves(&get, line)?;
        }
        for &(_, code) in list.iter().filter(|(letter, code)| *letter == b'M' && is_done(*code)) {
            let at = self.at;
            self.act(line, What::Stop(code), at);
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
        for (axis, letter) in b"XYUV".iter().enumerate() {
            let Some(number) = get(*letter) else { continue };
            let number = number * self.scale * if axis == 3 { TURNED } else { 1.0 };
            to[axis] = if self.absolute { number } else { to[axis] + number };
        }
        let centre = [b'I', b'J'].map(get);
        let named = b"XYUV".iter().any(|letter| get(*letter).is_some());
        let arcs = centre.iter().any(Option::is_some) && matches!(self.motion, 2.0 | 3.0);
        if !named && !arcs {
            return Ok(());
        }
        if self.motion != 0.0 && self.state.feed.0.is_nan() {
            return Err("no feed".into());
        }
        match self.motion {
            0.0 => self.act(line, What::Rapid, to),
            1.0 => self.act(line, What::Feed, to),
            2.0 | 3.0 => {
                let [i, j] = centre.map(|number| number.unwrap_or(0.0) * self.scale);
                let center = [self.at[0] + i, self.at[1] + j];
                let ccw = self.motion == 3.0;
                self.act(line, What::Arc { plane: 17.0, center, ccw, turns: 0.0 }, to);
            }
            _ => return Err("axis words without a motion".into()),
        }
        Ok(())
    }
}
