//! Wire EDM jobs. X and Y are the position of the lower guide, U and V the position of the upper guide.

use serde_json::{Value, json};

use super::pen::Pen;
use crate::random::Random;

/// Adds operations to a job; there are no tools.
pub fn fill(job: &mut Value, inch: bool, random: &mut Random) {
    let mut pen = Pen::new(inch, random);
    let tapered = pen.random.once_in(2);
    let wanted = 6 + pen.random.below(29);
    let mut operations = Vec::new();
    while pen.moves < wanted && operations.len() < 5 {
        let before = pen.moves;
        let share = 3 + pen.random.below(wanted);
        let place = place(&mut pen, tapered);
        pen.put(json!({ "rapid": place }));
        if pen.random.once_in(3) {
            pen.put(json!({ "edm": "submerge" }));
        }
        let item = json!({ "edm": pen.random.pick(&["thread", "thread", "predrill"]) });
        pen.put(item);
        opening(&mut pen, tapered, before + share, wanted);
        pen.put(json!({ "edm": "cut" }));
        let path = std::mem::take(&mut pen.path);
        let feed = pen.feed();
        operations.push(json!({ "feed": feed, "set": { "power": 1 + pen.random.below(9) }, "path": path }));
    }
    job["machine"] = json!("edm");
    job["operations"] = json!(operations);
}

fn place(pen: &mut Pen<'_>, tapered: bool) -> Value {
    let [x, y] = pen.across();
    pen.at = [x, y, 0.0];
    match tapered {
        true => json!([x, y, pen.length(-0.2, 0.2), pen.length(-0.2, 0.2)]),
        false => json!([x, y]),
    }
}

fn opening(pen: &mut Pen<'_>, tapered: bool, until: usize, wanted: usize) {
    let leads = pen.random.once_in(2);
    if leads {
        pen.put(json!({ "begin": "leadin" }));
    }
    let first = place(pen, tapered);
    let compensated = pen.random.once_in(2);
    match compensated {
        true => {
            let item = json!({ "infeed": first, "side": pen.random.pick(&["left", "right"]) });
            pen.put(item);
        }
        false => pen.put(json!({ "line": first })),
    }
    if leads {
        pen.put(json!({ "end": "leadin" }));
    }
    pen.moves += 2;
    while pen.moves < until && pen.moves < wanted {
        match pen.random.below(6) {
            0 if !tapered => {
                pen.arc(false);
                if let Some(arc) = pen.path.last_mut().and_then(|item| item.get_mut("arc")) {
                    for key in ["to", "center"] {
                        if let Some(list) = arc.get_mut(key).and_then(Value::as_array_mut) {
                            list.truncate(2);
                        }
                    }
                    arc.as_object_mut().map(|arc| arc.remove("turns"));
                }
            }
            1 if pen.random.once_in(4) => pen.put(json!({ "stop": "optional" })),
            2 if pen.random.once_in(4) => {
                let item = json!({ "feed": pen.feed() });
                pen.put(item);
            }
            _ => {
                let to = place(pen, tapered);
                pen.feeding(json!({ "line": to }), false);
                pen.moves += 1;
            }
        }
    }
    if compensated {
        let to = place(pen, tapered);
        pen.feeding(json!({ "outfeed": to }), false);
    }
}
