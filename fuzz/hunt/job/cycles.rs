//! Canned cycles of all kinds for random jobs.

use serde_json::{Map, Value, json};

use super::pen::Pen;

const KINDS: &[&str] = &[
    "drill",
    "drill",
    "drill",
    "face",
    "tap",
    "tap",
    "ltap",
    "bore",
    "bore",
    "back",
    "ream",
    "deep",
    "deep",
    "chipbreak",
    "chipbreak",
    "thru",
    "csink",
    "manual",
];
const CUSTOMS: [&str; 3] = ["custom1", "custom2", "custom3"];

/// Adds a cycle with its points. The tool is above the last point afterwards.
pub fn cycle(pen: &mut Pen<'_>) {
    let customs: Vec<&str> = (0..3).filter(|&i| pen.customs[i]).map(|i| CUSTOMS[i]).collect();
    let kind = match !customs.is_empty() && pen.random.once_in(4) {
        true => pen.random.pick(&customs),
        false => pen.random.pick(KINDS),
    };
    let mut cycle = Map::new();
    let mut put = |key: &str, value: Value| _ = cycle.insert(key.to_owned(), value);
    put("kind", json!(kind));
    let clear = pen.positive(0.05, 0.3);
    let depth = pen.positive(0.1, 1.2);
    put("clear", json!(clear));
    if kind != "manual" && pen.random.once_in(3) {
        let above = pen.positive(0.05, 1.5);
        put("return", json!(pen.round(clear + above)));
    }
    if !matches!(kind, "manual" | "thru" | "csink") {
        put("depth", json!(depth));
    }
    if kind != "manual" {
        put("feed", json!(pen.feed()));
    }
    if matches!(kind, "drill" | "face" | "bore" | "ream" | "deep" | "chipbreak" | "csink") && pen.random.once_in(4) {
        put("dwell", json!(pen.random.pick(&[0.1, 0.25, 0.5, 1.0, 2.0, 0.333])));
    }
    match kind {
        "deep" | "chipbreak" => pecks(pen, &mut put, depth, kind == "chipbreak"),
        "tap" | "ltap" => tap(pen, &mut put),
        "bore" if pen.random.once_in(3) => {
            put("orient", json!(pen.random.pick(&[0.0, 0.0, 45.0, 90.0, 180.0, 270.0])));
            if pen.random.once_in(2) {
                put("offset", json!(pen.positive(0.005, 0.05)));
            }
            if pen.random.once_in(4) {
                put("jog", json!(pen.positive(0.005, 0.05)));
            }
        }
        "back" => {
            let below = pen.positive(0.05, 0.5);
            put("rapto", json!(pen.round(depth + below)));
            put("orient", json!(pen.random.pick(&[0.0, 90.0, 180.0])));
            put("offset", json!(pen.positive(0.02, 0.2)));
        }
        "thru" => {
            let mut webs = vec![pen.positive(0.1, 0.3)];
            for _ in 0..pen.random.below(3) {
                for _ in 0..2 {
                    let next = webs[webs.len() - 1] + pen.positive(0.1, 0.4);
                    webs.push(pen.round(next));
                }
            }
            put("webs", json!(webs));
        }
        "csink" => {
            put("diameter", json!(pen.positive(0.2, 0.8)));
            put("angle", json!(pen.random.pick(&[60.0, 82.0, 90.0, 100.0, 120.0])));
        }
        "ream" if pen.random.once_in(3) => put("ratio", json!(pen.random.pick(&[0.5, 1.5, 2.0]))),
        _ => {}
    }
    if pen.random.once_in(12) {
        put("emulate", json!(true));
    }
    if kind == "drill" && pen.random.once_in(10) {
        put("rapto", json!(pen.round(clear * 0.5)));
    }
    let points = points(pen, kind, clear, depth);
    put("points", json!(points));
    pen.put(json!({ "cycle": cycle }));
}

fn pecks(pen: &mut Pen<'_>, put: &mut impl FnMut(&str, Value), depth: f64, chips: bool) {
    match pen.random.below(6) {
        0 => {
            let mut list = Vec::new();
            let mut to = 0.0;
            while to < depth {
                to = (pen.round(to + depth / 3.0 + pen.unit * 0.01)).min(depth);
                let mut peck = json!({ "to": to });
                if pen.random.once_in(3) {
                    peck["feed"] = json!(pen.feed());
                }
                list.push(peck);
            }
            put("pecks", json!(list));
        }
        1 => {
            let step = pen.positive(0.1, 0.4);
            put("step", json!(step));
            let part = pen.random.between(0.5, 1.5);
            put("first_step", json!(pen.round(step * part).max(step * 0.5)));
        }
        2 => {
            let step = pen.positive(0.1, 0.4);
            put("step", json!(step));
            put("decr", json!(pen.round(step * 0.2)));
            put("min_step", json!(pen.positive(0.02, 0.05)));
        }
        3 => {
            put("step", json!(pen.positive(0.05, 0.5)));
            put("step_from", json!("point"));
        }
        _ => put("step", json!(pen.positive(0.05, 0.5))),
    }
    if pen.random.once_in(4) {
        put("back", json!(pen.positive(0.01, 0.08)));
    }
    if chips && pen.random.once_in(6) {
        put("times", json!(1 + pen.random.below(4)));
    }
}

fn tap(pen: &mut Pen<'_>, put: &mut impl FnMut(&str, Value)) {
    match pen.random.below(5) {
        0 => put("rigid", json!(true)),
        1 => {}
        _ => put("rigid", json!(false)),
    }
    match pen.random.below(14) {
        0 => put("norevr", json!(true)),
        1 => put("rapout", json!(true)),
        2 => put("dwell", json!(0.5)),
        3 => put("ratio", json!(1.5)),
        _ => {}
    }
}

fn points(pen: &mut Pen<'_>, kind: &str, clear: f64, depth: f64) -> Vec<Value> {
    let count = 1 + pen.random.below(4);
    let deeper = !matches!(kind, "manual" | "thru" | "csink" | "back");
    // all points at one height, or on steps of the part
    let stepped = pen.random.once_in(3);
    let mut top = if pen.random.once_in(3) { pen.length(-0.5, 0.5) } else { 0.0 };
    let mut list = Vec::new();
    for number in 0..count {
        if stepped && number > 0 {
            top = pen.length(-0.5, 0.5);
        }
        let mut across = pen.across();
        if pen.random.once_in(4) {
            across[0] = pen.at[0];
        }
        let place = if number > 0 && !stepped && pen.random.once_in(4) {
            json!(across)
        } else {
            json!([across[0], across[1], top])
        };
        pen.at = [across[0], across[1], pen.round(top + clear)];
        list.push(match deeper && pen.random.once_in(6) {
            true => json!({ "at": place, "depth": pen.round(depth * 1.25).max(depth) }),
            false => place,
        });
        pen.moves += 1;
    }
    list
}
