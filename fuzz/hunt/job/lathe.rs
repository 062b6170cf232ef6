//! Turning jobs. Positions are Z and X; X is a radius.

use serde_json::{Map, Value, json};

use super::pen::Pen;
use crate::random::Random;

/// Adds tools and operations to a job.
pub fn fill(job: &mut Value, inch: bool, random: &mut Random) {
    let mut pen = Pen::new(inch, random);
    let tools: Vec<Value> = [1, 2, 303]
        .map(|number| match number {
            1 => json!({ "number": 1, "length_offset": 1 }),
            number => json!({ "number": number }),
        })
        .to_vec();
    let wanted = 6 + pen.random.below(29);
    let mut operations = Vec::new();
    while pen.moves < wanted && operations.len() < 5 {
        let before = pen.moves;
        let share = 3 + pen.random.below(wanted);
        let mut head = Map::new();
        head.insert("tool".into(), json!([1, 2, 303][operations.len() % 3]));
        pen.per_turn = pen.random.below(4) > 0;
        let css = pen.random.once_in(2);
        let mut spindle = json!({ "direction": pen.random.pick(&["cw", "cw", "ccw"]) });
        spindle["speed"] = json!(if css { 200 } else { 800 + 100 * pen.random.below(10) });
        spindle["mode"] = json!(if css { "css" } else { "rpm" });
        spindle["max"] = json!(2500);
        head.insert("spindle".into(), spindle);
        head.insert("feed_mode".into(), json!(if pen.per_turn { "per_rev" } else { "per_minute" }));
        head.insert("feed".into(), json!(pen.feed()));
        if pen.random.once_in(2) {
            head.insert("coolant".into(), json!("on"));
        }
        let place = outside(&mut pen);
        pen.rapid(place);
        while pen.moves < before + share && pen.moves < wanted {
            piece(&mut pen, css);
        }
        let path: Vec<Value> = std::mem::take(&mut pen.path).into_iter().map(flat).collect();
        head.insert("path".into(), json!(path));
        operations.push(Value::Object(head));
    }
    job["machine"] = json!("lathe");
    job["tools"] = json!(tools);
    job["operations"] = json!(operations);
}

/// A position outside the part: Z and radius.
fn outside(pen: &mut Pen<'_>) -> [f64; 3] {
    [pen.length(0.05, 0.5), pen.length(1.2, 2.0), 0.0]
}

/// Converts an item to positions of two numbers, and its arcs to at most one turn.
fn flat(mut item: Value) -> Value {
    let two = |value: Option<&mut Value>| {
        if let Some(list) = value.and_then(Value::as_array_mut) {
            list.truncate(2);
        }
    };
    ["rapid", "line"].into_iter().for_each(|key| two(item.get_mut(key)));
    if let Some(arc) = item.get_mut("arc").and_then(Value::as_object_mut) {
        ["to", "center"].into_iter().for_each(|key| two(arc.get_mut(key)));
        arc.remove("turns");
    }
    item
}

fn piece(pen: &mut Pen<'_>, css: bool) {
    match pen.random.below(10) {
        0..5 => turn(pen),
        5 | 6 if !css => thread(pen),
        7 => drill(pen),
        8 => pen.put(json!({ "dwell": 0.5 })),
        _ => change(pen),
    }
}

/// A cut with its approach and retract: the tool moves from outside the part to the cut, along the cut, and out.
fn turn(pen: &mut Pen<'_>) {
    let start = outside(pen);
    pen.rapid(start);
    let radius = pen.length(0.3, 1.0);
    pen.line([start[0], radius, 0.0], true);
    for _ in 0..1 + pen.random.below(4) {
        if pen.random.once_in(3) {
            pen.arc(false);
            continue;
        }
        let to = [pen.length(-3.0, 0.0), pen.length(0.3, 1.2), 0.0];
        pen.line(to, false);
    }
    let [z, _, _] = pen.at;
    let out = pen.length(1.3, 2.0);
    pen.line([z, out, 0.0], false);
    pen.rapid([start[0], out, 0.0]);
}

fn thread(pen: &mut Pen<'_>) {
    let start = outside(pen);
    pen.rapid(start);
    let crest = pen.length(0.4, 1.0);
    let end = pen.length(-1.5, -0.3);
    let pitch = pen.positive(0.03, 0.12);
    let depth = pen.positive(0.03, 0.08);
    let mut thread = json!({ "from": [start[0], crest], "to": [end, crest], "pitch": pitch, "depth": depth });
    match pen.random.below(3) {
        0 => thread["passes"] = json!(2 + pen.random.below(5)),
        _ => {
            thread["first_depth"] = json!(pen.round(depth * 0.5).max(depth * 0.3));
            thread["min_depth"] = json!(depth * 0.1);
        }
    }
    pen.put(json!({ "thread": thread }));
    pen.moves += 4;
    let place = outside(pen);
    pen.rapid(place);
}

fn drill(pen: &mut Pen<'_>) {
    let start = outside(pen);
    pen.rapid(start);
    let kind = pen.random.pick(&["drill", "deep", "chipbreak", "face", "bore", "ream"]);
    let mut cycle =
        json!({ "kind": kind, "depth": pen.positive(0.2, 1.0), "clear": pen.positive(0.05, 0.2), "feed": pen.feed() });
    if matches!(kind, "deep" | "chipbreak") {
        cycle["step"] = json!(pen.positive(0.1, 0.4));
    }
    cycle["points"] = json!([[0, 0]]);
    pen.put(json!({ "cycle": cycle }));
    pen.moves += 1;
    let place = outside(pen);
    pen.put(json!({ "rapid": [place[0], 0] }));
    pen.put(json!({ "rapid": [place[0], place[1]] }));
    pen.at = place;
}

fn change(pen: &mut Pen<'_>) {
    match pen.random.below(5) {
        0 => pen.put(json!({ "stop": "program" })),
        1 => pen.put(json!({ "comment": "look" })),
        2 => {
            let item = json!({ "feed": pen.feed() });
            pen.put(item);
        }
        3 => {
            let item = json!({ "coolant": pen.random.pick(&["on", "off"]) });
            pen.put(item);
        }
        _ => {
            let item = json!({ "spindle": { "max": 1800 + 100 * pen.random.below(9) } });
            pen.put(item);
        }
    }
}
