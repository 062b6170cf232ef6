//! What draws the paths of random jobs: it knows where the tool is, so that arcs and heights make sense.

use serde_json::{Value, json};

use crate::random::Random;

/// Writes path items.
pub struct Pen<'r> {
    /// Where the numbers come from.
    pub random: &'r mut Random,
    /// A length that is large for a part: an inch, or 25 mm.
    pub unit: f64,
    /// Decimals of the job's numbers.
    decimals: i32,
    /// Where the tool is.
    pub at: [f64; 3],
    /// The items so far.
    pub path: Vec<Value>,
    /// Moves and holes so far.
    pub moves: usize,
    /// Feeds are per revolution.
    pub per_turn: bool,
    /// Cycles that only the form knows.
    pub customs: [bool; 3],
    /// The form knows the way home.
    pub home: bool,
    /// Text with the comments and codes of a Fanuc.
    pub codes: bool,
    /// The form has more than six work offsets.
    pub works: bool,
}

impl<'r> Pen<'r> {
    /// Begins a job.
    pub fn new(inch: bool, random: &'r mut Random) -> Pen<'r> {
        let decimals = if inch { random.pick(&[2, 3, 4, 4, 4, 6]) } else { random.pick(&[0, 1, 2, 3, 3, 3, 5]) };
        let unit = if inch { 1.0 } else { 25.0 };
        Pen {
            random,
            unit,
            decimals,
            at: [0.0; 3],
            path: Vec::new(),
            moves: 0,
            per_turn: false,
            customs: [false; 3],
            home: false,
            codes: true,
            works: false,
        }
    }

    /// A number with the job's decimals.
    pub fn round(&self, value: f64) -> f64 {
        let by = 10f64.powi(self.decimals);
        (value * by).round() / by + 0.0
    }

    /// A length between so many inches, with the job's decimals; of either sign where `low` is negative.
    pub fn length(&mut self, low: f64, high: f64) -> f64 {
        let value = self.random.between(low * self.unit, high * self.unit);
        self.round(value)
    }

    /// A length that is not zero.
    pub fn positive(&mut self, low: f64, high: f64) -> f64 {
        let least = 10f64.powi(-self.decimals);
        self.length(low, high).max(least)
    }

    /// A feed.
    pub fn feed(&mut self) -> f64 {
        let feed = match self.per_turn {
            true => self.random.between(0.002, 0.02) * self.unit,
            false => self.random.between(1.0, 40.0) * self.unit,
        };
        let by = if self.per_turn { 1e4 } else { self.random.pick(&[1.0, 1.0, 10.0]) };
        (feed * by).round().max(1.0) / by
    }

    /// Puts an item down.
    pub fn put(&mut self, item: Value) {
        self.path.push(item);
    }

    /// With a feed beside it, now and then.
    pub fn feeding(&mut self, mut item: Value, always: bool) {
        if always || self.random.once_in(4) {
            item["feed"] = json!(self.feed());
        }
        self.put(item);
    }

    /// A place across.
    pub fn across(&mut self) -> [f64; 2] {
        [self.length(-4.0, 4.0), self.length(-4.0, 4.0)]
    }

    /// A rapid; sometimes it says only what changes.
    pub fn rapid(&mut self, to: [f64; 3]) {
        let item = self.position(to);
        self.put(json!({ "rapid": item }));
        self.moves += 1;
        self.at = to;
    }

    /// A straight cut.
    pub fn line(&mut self, to: [f64; 3], always: bool) {
        let item = self.position(to);
        self.feeding(json!({ "line": item }), always);
        self.moves += 1;
        self.at = to;
    }

    /// A place as a job may write it: whole, or without what stays.
    pub fn position(&mut self, to: [f64; 3]) -> Value {
        if !self.random.once_in(3) {
            return json!(to);
        }
        let mut list: Vec<Value> =
            (0..3).map(|axis| if to[axis] == self.at[axis] { Value::Null } else { json!(to[axis]) }).collect();
        while list.last().is_some_and(Value::is_null) && list.len() > 1 {
            list.pop();
        }
        if list.iter().all(Value::is_null) { json!(to) } else { json!(list) }
    }

    /// An arc from where the tool is, in one of the planes.
    pub fn arc(&mut self, planes: bool) {
        let plane = if planes { self.random.pick(&["xy", "xy", "xy", "xz", "yz"]) } else { "xy" };
        let [first, second, third] = match plane {
            "xz" => [2, 0, 1],
            "yz" => [1, 2, 0],
            _ => [0, 1, 2],
        };
        let radius = self.positive(0.05, 1.5);
        let angle = self.random.between(0.0, std::f64::consts::TAU);
        let mut center = self.at;
        center[first] = self.round(center[first] + radius * angle.cos());
        center[second] = self.round(center[second] + radius * angle.sin());
        let from = [self.at[first] - center[first], self.at[second] - center[second]];
        let radius = from[0].hypot(from[1]);
        let mut to = self.at;
        // quarters and halves end on round numbers; any other end is as exact as the digits of a double
        let turned = match self.random.below(8) {
            0 => [-from[1], from[0]],
            1 => [-from[0], -from[1]],
            2 => [from[1], -from[0]],
            3 => from,
            _ => {
                let angle = self.random.between(0.0, std::f64::consts::TAU);
                [radius * angle.cos(), radius * angle.sin()]
            }
        };
        let digits = |value: f64| (value * 1e7).round() / 1e7 + 0.0;
        to[first] = digits(center[first] + turned[0]);
        to[second] = digits(center[second] + turned[1]);
        if self.random.once_in(6) {
            let shift = self.length(-0.2, 0.2);
            to[third] = self.round(self.at[third] + shift);
        }
        let direction = self.random.pick(&["cw", "ccw"]);
        let mut arc = json!({ "to": to, "center": center, "direction": direction });
        if plane != "xy" {
            arc["plane"] = json!(plane);
        } else if self.random.once_in(4) && to != self.at && radius > 1e-3 * self.unit {
            let cross = from[0] * turned[1] - from[1] * turned[0];
            let short = (cross > 0.0) == (direction == "ccw");
            arc["radius"] = json!(if short { radius } else { -radius });
            arc.as_object_mut().map(|arc| arc.remove("center"));
        }
        if self.random.once_in(12) && plane == "xy" && arc.get("center").is_some() {
            arc["turns"] = json!(1 + self.random.below(3));
        }
        self.feeding(json!({ "arc": arc }), false);
        self.moves += 1;
        self.at = to;
    }
}
