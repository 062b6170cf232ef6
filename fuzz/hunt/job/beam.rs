//! Jobs for a torch or a laser: contours at one height, with a rapid before each contour.

use serde_json::{Map, Value, json};

use super::pen::Pen;
use crate::random::Random;

/// Adds tools and operations to a job.
pub fn fill(job: &mut Value, inch: bool, works: bool, random: &mut Random) {
    let mut pen = Pen::new(inch, random);
    // many CAM systems write no heights for such jobs
    let heights = pen.random.below(3) > 0;
    let (high, low) = (pen.length(0.2, 1.0), pen.length(-0.2, 0.0));
    let wanted = 6 + pen.random.below(29);
    let mut operations = Vec::new();
    while pen.moves < wanted && operations.len() < 4 {
        let (before, share) = (pen.moves, 3 + pen.random.below(wanted));
        let mut head = Map::new();
        if operations.is_empty() || pen.random.once_in(3) {
            head.insert("tool".into(), json!(1 + pen.random.below(2)));
        }
        head.insert("feed".into(), json!(pen.feed()));
        if pen.random.once_in(2) {
            head.insert("spindle".into(), json!({ "speed": 100 + 50 * pen.random.below(15), "direction": "cw" }));
        }
        if pen.random.once_in(2) {
            let more: &[i32] = if works { &[54, 55, 1, 2, 7, 9] } else { &[54, 55, 56, 1, 2] };
            head.insert("work".into(), json!(pen.random.pick(more)));
        }
        while pen.moves < before + share && pen.moves < wanted {
            contour(&mut pen, heights.then_some([high, low]));
        }
        head.insert("path".into(), json!(std::mem::take(&mut pen.path)));
        operations.push(Value::Object(head));
    }
    job["tools"] = json!([{ "number": 1, "name": "45A", "diameter": 0.05 }, { "number": 2 }]);
    job["operations"] = json!(operations);
}

/// A position; it includes the height if the job has heights.
fn at(x: f64, y: f64, z: Option<f64>) -> Value {
    z.map_or_else(|| json!([x, y]), |z| json!([x, y, z]))
}

fn contour(pen: &mut Pen<'_>, heights: Option<[f64; 2]>) {
    let [x, y] = pen.across();
    let [high, low] = [0, 1].map(|which| heights.map(|heights| heights[which]));
    pen.put(json!({ "rapid": at(x, y, high) }));
    pen.at = [x, y, low.unwrap_or(0.0)];
    pen.moves += 1;
    // moves down at rapid, at feed, or in the first cut
    match pen.random.below(3) {
        0 if low.is_some() => pen.put(json!({ "rapid": at(x, y, low) })),
        1 if low.is_some() => pen.feeding(json!({ "line": at(x, y, low) }), false),
        _ => {}
    }
    let leads = pen.random.once_in(3);
    for number in 0..1 + pen.random.below(5) {
        if leads && number == 0 {
            pen.put(json!({ "begin": "leadin" }));
        }
        if number == 0 || pen.random.once_in(2) {
            let [x, y] = pen.across();
            pen.feeding(json!({ "line": at(x, y, low) }), false);
            (pen.at[0], pen.at[1]) = (x, y);
            pen.moves += 1;
        } else {
            arc(pen, low);
        }
        if leads && number == 0 {
            pen.put(json!({ "end": "leadin" }));
        }
    }
    match pen.random.below(5) {
        0 => {
            let [x, y, _] = pen.at;
            pen.put(json!({ "rapid": at(x, y, high) }));
        }
        1 => pen.put(json!({ "comment": "next part" })),
        _ => {}
    }
}

fn arc(pen: &mut Pen<'_>, low: Option<f64>) {
    let from = pen.at;
    pen.arc(false);
    let [x, y, _] = pen.at;
    pen.at[2] = from[2];
    // the arc stays at one height
    if let Some(arc) = pen.path.last_mut().and_then(|item| item.get_mut("arc")) {
        arc["to"] = at(x, y, low);
        if let Some([x, y]) = arc["center"].as_array().map(|center| [&center[0], &center[1]].map(Value::clone)) {
            arc["center"] = json!([x, y]);
        }
    }
}
