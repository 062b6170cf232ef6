//! The requests of a milling job: cuts, holes, dwells and stops, in millimetres, computed from the document alone.

use serde_json::Value;

use super::{INCH, Place};
use crate::planner::Hole;

/// A request of the job.
#[derive(Clone, Debug, PartialEq)]
pub enum Want {
    /// A straight cut.
    Line,
    /// An arc: its plane, its centre in the plane (in the arc's axes), its direction, and the number of additional full
    /// turns.
    Arc { plane: &'static str, center: [f64; 2], ccw: bool, turns: f64 },
    /// A hole: its kind, the heights at which the feed begins and ends, and the height of the tool after the hole.
    Hole { kind: String, clear: f64, bottom: f64, out: f64 },
    /// A hole with its moves, from the second planner.
    Planned(Box<Hole>),
    /// A thread: start of its passes along the axis, radius of the crest at the end, signed depth, and lead.
    Thread { begin: f64, crest: f64, depth: f64, lead: f64 },
    /// A stop: 0 for M0, 1 for M1.
    Stop(f64),
    /// A dwell in seconds.
    Dwell(f64),
}

/// A request with the state in which it must be carried out.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// The request.
    pub want: Want,
    /// Start position; NaN if it is unknown.
    pub from: Place,
    /// End position. For a hole, this is the position over the hole.
    pub to: Place,
    /// The tool.
    pub tool: f64,
    /// The length register.
    pub length: f64,
    /// The work offset as the job contains it; the first is 54.
    pub work: f64,
    /// Spindle direction (3, 4 or 5) and speed.
    pub spindle: (f64, f64),
    /// Feed in millimetres, and its mode: 94 or 95.
    pub feed: (f64, f64),
    /// The least height of the job's path to the start.
    pub low: f64,
    /// Compensation: 40, 41 or 42.
    pub side: f64,
    /// Coolant: 1 is mist, 2 is flood, 3 is both. `None`: the coolant is not compared.
    pub coolant: Option<u8>,
}

struct Reader {
    unit: f64,
    at: Place,
    tool: f64,
    length: f64,
    work: f64,
    spindle: (f64, f64),
    feed: (f64, f64),
    low: f64,
    side: f64,
    list: Vec<Wanted>,
    /// Whether the tool left the hole beside the axis of the hole.
    jogged: bool,
    /// Subprograms by their numbers.
    subs: Vec<Value>,
    /// Whether the job is for a lathe or a wire EDM machine. Then every path is compared.
    lathe: bool,
    /// Whether the speed is a surface speed.
    surface: bool,
}

/// The list of requests. `None` if the job contains calls, custom cycles or text with codes that are not supported
/// here.
pub fn wants(job: &Value) -> Option<Vec<Wanted>> {
    let lathe = job.get("machine").is_some_and(|machine| machine == "lathe");
    let wire = job.get("machine").is_some_and(|machine| machine == "edm");
    let turned = lathe.then(|| super::lathe::as_mill(job)).or_else(|| wire.then(|| super::wire::as_mill(job)));
    let job = turned.as_ref().unwrap_or(job);
    if job.get("machine").is_some_and(|machine| machine != "mill") {
        return None;
    }
    let unit = if job["units"] == "mm" { 1.0 } else { INCH };
    let mut reader = Reader {
        unit,
        at: [f64::NAN, f64::NAN, f64::NAN, 0.0, 0.0, 0.0],
        tool: f64::NAN,
        length: f64::NAN,
        work: 54.0,
        spindle: (5.0, 0.0),
        feed: (f64::NAN, 94.0),
        low: f64::INFINITY,
        side: 40.0,
        list: Vec::new(),
        jogged: false,
        subs: job["subprograms"].as_array().cloned().unwrap_or_default(),
        lathe: lathe || wire,
        surface: false,
    };
    if lathe {
        reader.at[1] = 0.0;
    }
    for operation in job["operations"].as_array()? {
        reader.head(operation, job);
        for item in operation["path"].as_array()? {
            reader.item(item)?;
        }
    }
    Some(reader.list)
}

impl Reader {
    fn head(&mut self, operation: &Value, job: &Value) {
        if let Some(tool) = operation.get("tool").and_then(Value::as_f64).filter(|tool| *tool != self.tool) {
            self.tool = tool;
            let row =
                job["tools"].as_array().and_then(|tools| tools.iter().find(|row| row["number"].as_f64() == Some(tool)));
            self.length = row.and_then(|row| row.get("length_offset")).and_then(Value::as_f64).unwrap_or(tool);
            self.at[..3].fill(f64::NAN);
            if self.lathe {
                self.at[1] = 0.0;
            }
        }
        if let Some(work) = operation.get("work").and_then(Value::as_f64) {
            self.work(work);
        }
        match operation.get("feed_mode").and_then(Value::as_str) {
            Some("per_rev") => self.feed.1 = 95.0,
            Some(_) => self.feed.1 = 94.0,
            None => {}
        }
        if let Some(spindle) = operation.get("spindle") {
            self.spindle(spindle);
        }
        if let Some(feed) = operation.get("feed").and_then(Value::as_f64) {
            self.feed.0 = feed * self.unit;
        }
    }

    fn work(&mut self, work: f64) {
        self.work = if work < 50.0 { work + 53.0 } else { work };
    }

    fn spindle(&mut self, spindle: &Value) {
        if let Some(mode) = spindle.get("mode") {
            self.surface = mode == "css";
        }
        if let Some(speed) = spindle.get("speed").and_then(Value::as_f64) {
            self.spindle.1 = speed * super::lathe::surface(self.surface, self.unit);
            if self.spindle.0 == 5.0 && spindle.get("direction").is_none() {
                self.spindle.0 = 3.0;
            }
        }
        match spindle.get("direction").and_then(Value::as_str) {
            Some("cw") => self.spindle.0 = 3.0,
            Some("ccw") => self.spindle.0 = 4.0,
            Some(_) => self.spindle.0 = 5.0,
            None => {}
        }
    }

    /// A position of the job, including angles.
    fn target(&self, position: &Value) -> Place {
        let mut to = self.at;
        for (axis, place) in to.iter_mut().enumerate() {
            if let Some(number) = position.get(axis).and_then(Value::as_f64) {
                *place = if axis < 3 { number * self.unit } else { number };
            }
        }
        to
    }

    fn put(&mut self, want: Want, to: Place) {
        let back = matches!(&want, Want::Hole { kind, .. } if kind == "back");
        let low =
            if back || self.jogged || self.lathe { f64::NEG_INFINITY } else { self.low.min(self.at[2]).min(to[2]) };
        self.jogged = false;
        self.list.push(Wanted {
            want,
            from: self.at,
            to,
            tool: self.tool,
            length: self.length,
            work: self.work,
            spindle: self.spindle,
            feed: self.feed,
            low,
            side: self.side,
            coolant: None,
        });
        self.at = to;
        self.low = f64::INFINITY;
    }

    fn item(&mut self, item: &Value) -> Option<()> {
        if let Some(feed) = item.get("feed").and_then(Value::as_f64) {
            self.feed.0 = feed * self.unit;
        }
        if let Some(to) = item.get("rapid") {
            self.low = self.low.min(self.at[2]);
            self.at = self.target(to);
            self.low = self.low.min(self.at[2]);
        } else if item.get("home").is_some() {
            self.at[..3].fill(f64::NAN);
        } else if let Some(to) = item.get("line") {
            let to = self.target(to);
            self.put(Want::Line, to);
        } else if let Some(to) = item.get("infeed") {
            self.side = if item["side"] == "right" { 42.0 } else { 41.0 };
            let to = self.target(to);
            self.put(Want::Line, to);
        } else if let Some(to) = item.get("outfeed") {
            self.side = 40.0;
            let to = self.target(to);
            self.put(Want::Line, to);
        } else if let Some(arc) = item.get("arc") {
            self.arc(arc)?;
        } else if let Some(cycle) = item.get("cycle") {
            self.cycle(cycle)?;
        } else if let Some(work) = item.get("work").and_then(Value::as_f64) {
            self.work(work);
        } else if let Some(spindle) = item.get("spindle") {
            self.spindle(spindle);
        } else if let Some(stop) = item.get("stop") {
            let at = self.at;
            self.put(Want::Stop(if stop == "optional" { 1.0 } else { 0.0 }), at);
        } else if let Some(seconds) = item.get("dwell").and_then(Value::as_f64) {
            let at = self.at;
            self.put(Want::Dwell(seconds), at);
        } else if let Some(action) = item.get("edm").and_then(Value::as_str) {
            let at = self.at;
            self.put(Want::Stop(super::wire::code(action)), at);
        } else if let Some(call) = item.get("call") {
            self.call(call)?;
        } else if let Some(thread) = item.get("thread") {
            self.thread(thread)?;
        } else if let Some(text) = item.get("text").and_then(Value::as_str) {
            // these items do not move the tool: a comment, an optional stop, coolant, a dwell of 0 s
            if text == "M1" {
                let at = self.at;
                self.put(Want::Stop(1.0), at);
            }
            return (text.starts_with('(') || ["M1", "M8", "G4 P0"].contains(&text)).then_some(());
        }
        Some(())
    }

    /// Runs a subprogram as often as it is called. After each run, the caller's state is restored.
    fn call(&mut self, call: &Value) -> Option<()> {
        let number = call["sub"].as_f64();
        let path = self.subs.iter().find(|sub| sub["number"].as_f64() == number)?["path"].as_array()?.clone();
        let of_caller = self.work;
        if let Some(work) = call.get("work").and_then(Value::as_f64) {
            self.work(work);
        }
        if let Some(at) = call.get("at") {
            self.low = self.low.min(self.at[2]);
            self.at = self.target(at);
            self.low = self.low.min(self.at[2]);
        }
        let kept = (self.work, self.spindle, self.feed);
        for _ in 0..call.get("times").and_then(Value::as_u64).unwrap_or(1) {
            for item in &path {
                self.item(item)?;
            }
            (self.work, self.spindle, self.feed) = kept;
        }
        self.work = of_caller;
        Some(())
    }

    /// A thread with one start. The end of the thread may be given without a radius.
    fn thread(&mut self, thread: &Value) -> Option<()> {
        let number = |key: &str| thread.get(key).and_then(Value::as_f64).map(|number| number * self.unit);
        let at =
            |key: &str, axis: usize| thread[key].get(axis).and_then(Value::as_f64).map(|number| number * self.unit);
        let (begin, from) = (at("from", 0)?, at("from", 1)?);
        let end = at("to", 0)?;
        let crest = at("to", 1).unwrap_or(from - number("taper").unwrap_or(0.0));
        if thread.get("starts").is_some() {
            return None;
        }
        let want = Want::Thread { begin, crest, depth: number("depth")?, lead: number("pitch")? };
        let mut to = self.at;
        to[2] = end;
        self.at[2] = begin;
        self.put(want, to);
        self.at[2] = begin;
        Some(())
    }

    fn arc(&mut self, arc: &Value) -> Option<()> {
        let to = self.target(&arc["to"]);
        let plane = match arc.get("plane").and_then(Value::as_str) {
            Some("xz") => "xz",
            Some("yz") => "yz",
            _ => "xy",
        };
        let [first, second] = axes(plane);
        let ccw = arc["direction"] == "ccw";
        let center = match arc.get("center") {
            Some(center) => [center[first].as_f64()? * self.unit, center[second].as_f64()? * self.unit],
            None => {
                let radius = arc["radius"].as_f64()? * self.unit;
                let from = [self.at[first], self.at[second]];
                super::machine::by_radius(from, [to[first], to[second]], radius, ccw)?
            }
        };
        let turns = arc.get("turns").and_then(Value::as_f64).unwrap_or(0.0);
        self.put(Want::Arc { plane, center, ccw, turns }, to);
        Some(())
    }

    fn cycle(&mut self, cycle: &Value) -> Option<()> {
        let kind = cycle["kind"].as_str()?.to_owned();
        if kind.starts_with("custom") || cycle.get("rapto").is_some_and(|_| kind != "back") {
            return None;
        }
        let number = |key: &str| cycle.get(key).and_then(Value::as_f64).map(|number| number * self.unit);
        let clear = number("clear").unwrap_or(if self.unit == 1.0 { 3.0 } else { 0.1 * INCH });
        let webs = cycle
            .get("webs")
            .and_then(Value::as_array)
            .and_then(|webs| webs.last()?.as_f64())
            .map(|web| web * self.unit);
        let pecks = cycle.get("pecks").and_then(Value::as_array).and_then(|pecks| pecks.last()?["to"].as_f64());
        let sink = number("diameter").zip(cycle.get("angle").and_then(Value::as_f64));
        let sink = sink.map(|(diameter, angle)| diameter / 2.0 / (angle / 2.0).to_radians().tan());
        let depth = number("depth").or(webs).or(pecks.map(|peck| peck * self.unit)).or(sink).unwrap_or(0.0);
        let above = number("return");
        let before = self.feed;
        if let Some(feed) = number("feed") {
            self.feed.0 = feed;
        }
        let mut first = None;
        let mut place = self.at;
        place[2] = f64::NAN;
        for point in cycle["points"].as_array()? {
            let at = point.get("at").unwrap_or(point);
            for (axis, place) in place.iter_mut().enumerate() {
                if let Some(number) = at.get(axis).and_then(Value::as_f64) {
                    *place = if axis < 3 { number * self.unit } else { number };
                }
            }
            let own = point.get("depth").and_then(Value::as_f64).map_or(depth, |depth| depth * self.unit);
            let top = place[2];
            // without a return plane, the tool returns to the clearance of each hole
            let plane = above.map(|above| *first.get_or_insert(top + above));
            let clear = top + clear;
            let out = plane.map_or(clear, |plane| plane.max(clear));
            let mut to = place;
            to[2] = out;
            let want = match kind.as_str() {
                "manual" => Want::Stop(0.0),
                _ => Want::Hole { kind: kind.clone(), clear, bottom: top - own, out },
            };
            let jogs = cycle.get("orient").is_some() || kind == "back";
            self.low = self.low.min(clear);
            if kind == "manual" {
                to[2] = clear;
                self.low = f64::NEG_INFINITY;
            }
            self.put(want, to);
            self.jogged = jogs;
        }
        self.feed = before;
        Some(())
    }
}

/// The axes of a plane, in the order in which angles increase.
pub(super) fn axes(plane: &str) -> [usize; 2] {
    match plane {
        "xz" => [2, 0],
        "yz" => [1, 2],
        _ => [0, 1],
    }
}
