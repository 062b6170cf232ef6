//! Milling jobs.

use serde_json::{Map, Value, json};

use super::cycles::cycle;
use super::pen::Pen;
use super::rotary::turn;
use super::subprograms::{call, subprograms};
use super::{Kind, Takes};
use crate::random::Random;

const SECTIONS: &[&str] = &["leadin", "leadout", "plunge", "retract", "sidestep", "zlevel", "row"];

/// Adds tools and operations to a job.
pub fn fill(job: &mut Value, kind: Kind, inch: bool, takes: Takes, random: &mut Random) {
    let tools: Vec<Value> = (1..=4).map(|number| tool(number, inch, random)).collect();
    let mut pen = Pen::new(inch, random);
    (pen.customs, pen.home, pen.codes, pen.works) = (takes.customs, takes.home, takes.codes, takes.works);
    let mut angle = 0.0;
    let subs = if kind == Kind::Subprograms { subprograms(&mut pen) } else { Vec::new() };
    let wanted = 6 + pen.random.below(29);
    let mut operations = Vec::new();
    let mut tool = 0;
    while pen.moves < wanted && operations.len() < 6 {
        let before = pen.moves;
        let share = 3 + pen.random.below(wanted);
        let mut head = operation(&mut pen, &mut tool);
        let work = if head.contains_key("work") { head["work"].clone() } else { json!(54) };
        begin(&mut pen, kind, &mut angle);
        while pen.moves < before + share && pen.moves < wanted {
            piece(&mut pen, kind, &mut angle, subs.len(), &work);
            if pen.home && pen.random.once_in(8) {
                let [x, y, _] = pen.at;
                let high = pen.length(1.0, 2.0);
                pen.rapid([x, y, high]);
                pen.put(json!({ "home": true }));
                begin(&mut pen, kind, &mut angle);
            }
        }
        if pen.random.once_in(2) {
            let [x, y, _] = pen.at;
            let high = pen.length(1.0, 2.0);
            pen.rapid([x, y, high]);
        }
        let path = std::mem::take(&mut pen.path);
        head.insert("path".into(), json!(path));
        operations.push(Value::Object(head));
    }
    job["tools"] = json!(tools);
    if !subs.is_empty() {
        job["subprograms"] = json!(subs);
    }
    job["operations"] = json!(operations);
}

fn tool(number: u32, inch: bool, random: &mut Random) -> Value {
    let unit = if inch { 1.0 } else { 25.0 };
    let mut tool = json!({ "number": number, "diameter": random.pick(&[0.125, 0.25, 0.5]) * unit });
    if random.once_in(3) {
        tool["length_offset"] = json!(u64::from(number) + 10 * random.below(2) as u64);
    }
    if random.once_in(3) {
        tool["diameter_offset"] = json!(number + 20);
    }
    if random.once_in(4) {
        tool["comment"] = json!("end mill");
    }
    tool
}

fn operation(pen: &mut Pen<'_>, tool: &mut usize) -> Map<String, Value> {
    let mut head = Map::new();
    let mut put = |key: &str, value: Value| _ = head.insert(key.to_owned(), value);
    if pen.random.once_in(4) {
        put("name", json!("pocket"));
    }
    // sometimes the same tool again
    let same = *tool > 0 && pen.random.once_in(4);
    if !same {
        *tool = 1 + *tool % 4;
    }
    if !same || pen.random.once_in(2) {
        put("tool", json!(*tool));
    }
    if pen.random.below(3) > 0 {
        let more: &[i32] = if pen.works { &[54, 55, 1, 2, 7, 9] } else { &[54, 54, 55, 56, 1, 2] };
        put("work", json!(pen.random.pick(more)));
    }
    if !same || pen.random.once_in(3) {
        let speed = 200 + 50 * pen.random.below(60);
        let direction = if pen.random.once_in(6) { "ccw" } else { "cw" };
        put("spindle", json!({ "speed": speed, "direction": direction }));
    }
    if pen.random.once_in(2) {
        put("coolant", json!(pen.random.pick(&["on", "flood", "mist", "off"])));
    }
    if pen.random.once_in(12) {
        pen.per_turn = !pen.per_turn;
    }
    put("feed_mode", json!(if pen.per_turn { "per_rev" } else { "per_minute" }));
    put("feed", json!(pen.feed()));
    if pen.random.once_in(3) {
        put("plunge", json!(pen.feed()));
    }
    if pen.random.once_in(6) {
        put("comment", json!("next"));
    }
    head
}

/// The first position of an operation: in one item, in parts, or as its first hole.
fn begin(pen: &mut Pen<'_>, kind: Kind, angle: &mut f64) {
    let [x, y] = pen.across();
    let high = pen.length(0.5, 2.0);
    match pen.random.below(8) {
        0 if kind != Kind::Rotary => {
            pen.put(json!({ "rapid": [x, y] }));
            pen.put(json!({ "rapid": [null, null, high] }));
            pen.moves += 2;
        }
        1 if kind != Kind::Rotary => {
            pen.put(json!({ "rapid": [null, null, high] }));
            pen.put(json!({ "rapid": [x, y] }));
            pen.moves += 2;
        }
        2 if kind != Kind::Rotary => return cycle(pen),
        _ => {
            let place = match kind {
                Kind::Rotary => json!([x, y, high, *angle]),
                _ => json!([x, y, high]),
            };
            pen.put(json!({ "rapid": place }));
            pen.moves += 1;
        }
    }
    pen.at = [x, y, high];
}

/// Adds a few items that belong together.
fn piece(pen: &mut Pen<'_>, kind: Kind, angle: &mut f64, subs: usize, work: &Value) {
    match (kind, pen.random.below(4)) {
        (Kind::Rotary, 0) => return turn(pen, angle),
        (Kind::Subprograms, 0) => return call(pen, subs, work),
        _ => {}
    }
    match pen.random.below(16) {
        0..5 => contour(pen),
        5..10 => cycle(pen),
        10 => compensated(pen),
        11 => wander(pen),
        12 => restless(pen),
        _ => change(pen),
    }
}

pub(super) fn contour(pen: &mut Pen<'_>) {
    let [x, y] = pen.across();
    let high = pen.length(0.3, 1.0);
    if pen.at[2] < high {
        let [x, y, _] = pen.at;
        pen.rapid([x, y, high]);
    }
    let high = pen.at[2];
    pen.rapid([x, y, high]);
    let low = pen.length(0.05, 0.2);
    if pen.random.once_in(2) {
        pen.rapid([x, y, low]);
    }
    let sections = pen.random.once_in(4);
    let section = pen.random.pick(SECTIONS);
    if sections {
        pen.put(json!({ "begin": section }));
    }
    let depth = pen.length(-0.5, 0.0);
    pen.line([x, y, depth], false);
    if sections {
        pen.put(json!({ "end": section }));
    }
    for _ in 0..1 + pen.random.below(5) {
        match pen.random.below(6) {
            0 | 1 => pen.arc(false),
            2 => pen.arc(true),
            3 => {
                let to = [pen.length(-4.0, 4.0), pen.at[1], pen.at[2]];
                pen.line(to, false);
            }
            _ => {
                let [x, y] = pen.across();
                let z = if pen.random.once_in(4) { pen.length(-0.5, 0.0) } else { pen.at[2] };
                pen.line([x, y, z], false);
            }
        }
        if pen.random.once_in(10) {
            change(pen);
        }
    }
    out(pen);
}

/// Moves the tool out of the part, at rapid or at feed.
pub(super) fn out(pen: &mut Pen<'_>) {
    let [x, y, _] = pen.at;
    let high = pen.length(0.1, 1.0).max(pen.at[2]);
    match pen.random.below(4) {
        0 => pen.line([x, y, high], false),
        _ => pen.rapid([x, y, high]),
    }
}

pub(super) fn compensated(pen: &mut Pen<'_>) {
    let [x, y] = pen.across();
    let high = pen.length(0.5, 1.0).max(pen.at[2]);
    let [x0, y0, _] = pen.at;
    pen.rapid([x0, y0, high]);
    pen.rapid([x, y, high]);
    let depth = pen.length(-0.5, -0.05);
    pen.line([x, y, depth], false);
    let side = pen.random.pick(&["left", "right"]);
    let mut to = pen.across();
    let mut item = json!({ "infeed": to, "side": side });
    item["feed"] = json!(pen.feed());
    pen.put(item);
    (pen.at[0], pen.at[1]) = (to[0], to[1]);
    for _ in 0..1 + pen.random.below(3) {
        to = pen.across();
        let z = pen.at[2];
        pen.line([to[0], to[1], z], false);
    }
    to = pen.across();
    pen.feeding(json!({ "outfeed": to }), false);
    (pen.at[0], pen.at[1]) = (to[0], to[1]);
    pen.moves += 2;
    out(pen);
}

/// Random rapids and cuts, in the air and in the part.
fn wander(pen: &mut Pen<'_>) {
    for _ in 0..1 + pen.random.below(4) {
        let to = [pen.length(-4.0, 4.0), pen.length(-4.0, 4.0), pen.length(-0.5, 1.0)];
        if pen.random.once_in(2) { pen.rapid(to) } else { pen.line(to, false) }
    }
}

/// Very short moves, and moves to the current position.
fn restless(pen: &mut Pen<'_>) {
    for _ in 0..1 + pen.random.below(4) {
        let mut to = pen.at;
        let axis = pen.random.below(3);
        let by = pen.random.pick(&[0.0, 1e-5, 4e-5, 1e-4, 3e-4, 1e-3, 1e-2]) * pen.unit;
        let sign = pen.random.pick(&[-1.0, 1.0]);
        to[axis] = ((to[axis] + sign * by) * 1e6).round() / 1e6 + 0.0;
        if pen.random.once_in(3) { pen.rapid(to) } else { pen.line(to, false) }
    }
}

/// Adds an item that is not a move.
fn change(pen: &mut Pen<'_>) {
    match pen.random.below(14) {
        0 => {
            let item = json!({ "dwell": pen.random.pick(&[0.1, 0.5, 1.0, 2.5]) });
            pen.put(item);
        }
        1 => pen.put(json!({ "stop": "program" })),
        2 => pen.put(json!({ "stop": "optional" })),
        3 => pen.put(json!({ "comment": "look here" })),
        4 => {
            let item = json!({ "feed": pen.feed() });
            pen.put(item);
        }
        5 | 6 => another_work(pen),
        7 => {
            let item = json!({ "coolant": pen.random.pick(&["on", "flood", "mist", "off"]) });
            pen.put(item);
        }
        8 => {
            let item = json!({ "spindle": { "speed": 300 + 25 * pen.random.below(80) } });
            pen.put(item);
        }
        9 => {
            let item = json!({ "spindle": { "direction": pen.random.pick(&["cw", "cw", "ccw"]) } });
            pen.put(item);
        }
        10 => {
            let item = json!({ "set": { "val1": pen.random.below(9) } });
            pen.put(item);
        }
        11 => {
            let text = pen.random.pick(&["(AS IT STANDS)", "M1", "M8", "G4 P0"]);
            // without G codes, the control reads only texts that begin with M
            if pen.codes || text.starts_with('M') {
                pen.put(json!({ "text": text }));
            }
        }
        _ => {
            let high = pen.length(1.0, 2.0);
            let [x, y] = pen.across();
            pen.rapid([x, y, high]);
        }
    }
}

/// Moves up, selects another work offset, and moves over its part.
fn another_work(pen: &mut Pen<'_>) {
    let [x, y, _] = pen.at;
    let high = pen.length(1.0, 2.0);
    if pen.random.below(4) > 0 {
        pen.rapid([x, y, high]);
    }
    let more: &[i32] = if pen.works { &[54, 56, 57, 1, 3, 7, 8] } else { &[54, 55, 56, 57, 1, 2, 3] };
    let item = json!({ "work": pen.random.pick(more) });
    pen.put(item);
    let [x, y] = pen.across();
    pen.put(json!({ "rapid": [x, y, high] }));
    pen.moves += 1;
    pen.at = [x, y, high];
}
