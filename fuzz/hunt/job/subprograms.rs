//! Random subprograms and their calls.

use serde_json::{Value, json};

use super::cycles::cycle;
use super::mill::{compensated, contour};
use super::pen::Pen;

/// Subprogram paths; each begins and ends at a high position.
pub fn subprograms(pen: &mut Pen<'_>) -> Vec<Value> {
    let mut subs = Vec::new();
    for number in 1..=1 + pen.random.below(2) {
        let [x, y] = pen.across();
        let high = pen.length(1.0, 2.0);
        pen.put(json!({ "rapid": [x, y, high] }));
        pen.at = [x, y, high];
        let first = json!({ "feed": pen.feed() });
        pen.put(first);
        for _ in 0..1 + pen.random.below(2) {
            match pen.random.below(4) {
                0 => cycle(pen),
                1 => compensated(pen),
                _ => {
                    let item = json!({ "feed": pen.feed() });
                    pen.put(item);
                    contour(pen);
                }
            }
        }
        let [x, y, _] = pen.at;
        pen.rapid([x, y, high]);
        let path = std::mem::take(&mut pen.path);
        subs.push(json!({ "number": number, "path": path }));
    }
    subs
}

pub fn call(pen: &mut Pen<'_>, subs: usize, work: &Value) {
    let [x, y, _] = pen.at;
    let high = pen.length(1.0, 2.0);
    pen.rapid([x, y, high]);
    let mut call = json!({ "sub": 1 + pen.random.below(subs) });
    if pen.random.once_in(3) {
        call["times"] = json!(1 + pen.random.below(3));
    }
    if pen.random.once_in(2) {
        call["at"] = json!(pen.across());
    }
    if pen.random.once_in(3) {
        call["work"] = if pen.random.once_in(2) { work.clone() } else { json!(pen.random.pick(&[54, 55, 56])) };
    }
    pen.put(json!({ "call": call }));
    pen.moves += 2;
    let [x, y] = pen.across();
    pen.put(json!({ "rapid": [x, y, high] }));
    pen.at = [x, y, high];
}
