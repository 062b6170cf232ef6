//! Writes the paths of random jobs. The pen follows the tool position, so that arcs and heights make sense.

use serde_json::{Value, json};

use crate::random::Random;

/// Writes path items.
pub struct Pen<'r> {
    /// The source of random numbers.
    pub random: &'r mut Random,
    /// A large length for a part: 1 inch or 25 mm.
    pub unit: f64,
    /// Number of decimals in the job.
    decimals: i32,
    /// The position of the tool.
    pub at: [f64; 3],
    /// The items so far.
    pub path: Vec<Value>,
    /// Number of moves and holes so far.
    pub moves: usize,
    /// Whether feeds are per revolution.
    pub per_turn: bool,
    /// For each custom cycle: whether the form has it.
    pub customs: [bool; 3],
    /// Whether the form can send the tool home.
    pub home: bool,
    /// Whether the text may contain comments and codes of a Fanuc.
    pub codes: bool,
    /// Whether the form has more than six work offsets.
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

    /// A number rounded to the job's decimals.
    pub fn round(&self, value: f64) -> f64 {
        let by = 10f64.powi(self.decimals);
        (value * by).round() / by + 0.0
    }

    /// A random length between two lengths in inches, rounded to the job's decimals. It may be negative if `low` is
    /// negative.
    pub fn length(&mut self, low: f64, high: f64) -> f64 {
        let value = self.random.between(low * self.unit, high * self.unit);
        self.round(value)
    }

    /// A random length that is not zero.
    pub fn positive(&mut self, low: f64, high: f64) -> f64 {
        let least = 10f64.powi(-self.decimals);
        self.length(low, high).max(least)
    }

    /// A random feed.
    pub fn feed(&mut self) -> f64 {
        let feed = match self.per_turn {
            true => self.random.between(0.002, 0.02) * self.unit,
            false => self.random.between(1.0, 40.0) * self.unit,
        };
        let by = if self.per_turn { 1e4 } else { self.random.pick(&[1.0, 1.0, 10.0]) };
        (feed * by).round().max(1.0) / by
    }

    /// Adds an item.
    pub fn put(&mut self, item: Value) {
        self.path.push(item);
    }

    /// Adds an item, sometimes with a feed.
    pub fn feeding(&mut self, mut item: Value, always: bool) {
        if always || self.random.once_in(4) {
            item["feed"] = json!(self.feed());
        }
        self.put(item);
    }

    /// A random position in X and Y.
    pub fn across(&mut self) -> [f64; 2] {
        [self.length(-4.0, 4.0), self.length(-4.0, 4.0)]
    }

    /// Adds a rapid. Sometimes it contains only the axes that change.
    pub fn rapid(&mut self, to: [f64; 3]) {
        let item = self.position(to);
        self.put(json!({ "rapid": item }));
        self.moves += 1;
        self.at = to;
    }

    /// Adds a straight cut.
    pub fn line(&mut self, to: [f64; 3], always: bool) {
        let item = self.position(to);
        self.feeding(json!({ "line": item }), always);
        self.moves += 1;
        self.at = to;
    }

    /// A position for a job, with all axes or without the unchanged axes.
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

    /// Adds an arc from the tool's position, in one of the planes.
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
        // quarters and halves of a circle end on round numbers; other ends have all digits of a double
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
