//! Writes a job as an APT CL file.

use std::fmt::Write;

use serde_json::{Value, json};

use crate::text::list;

/// The job without everything that a CL file can't express, and with all axes in each position. The CL text of
/// [`written`] describes this job.
pub fn for_cl(job: &Value) -> Value {
    let mut job = job.clone();
    let operations = job["operations"].as_array_mut().map(std::mem::take).unwrap_or_default();
    if let Some(tools) = job.get_mut("tools").and_then(Value::as_array_mut) {
        *tools = (1..=4).map(|number| json!({ "number": number })).collect();
    }
    let mut said = Vec::new();
    let mut feed = json!(10.0);
    for (number, mut operation) in operations.into_iter().enumerate() {
        let mut at: [Option<f64>; 3] = [None; 3];
        if let Some(head) = operation.as_object_mut() {
            head.retain(|key, _| {
                matches!(key.as_str(), "tool" | "spindle" | "coolant" | "feed" | "feed_mode" | "path")
            });
            head.insert("tool".into(), json!(number % 4 + 1));
            if !head.contains_key("spindle") {
                head.insert("spindle".into(), json!({ "speed": 900, "direction": "cw" }));
            }
        }
        let path = operation["path"].as_array_mut().map(std::mem::take).unwrap_or_default();
        let mut items = Vec::new();
        if let Some(first) = operation.get("feed") {
            feed = first.clone();
        }
        let at_first = feed.clone();
        for mut item in path {
            if ["begin", "end", "work", "text", "set", "call", "infeed", "outfeed"]
                .iter()
                .any(|key| item.get(key).is_some())
            {
                continue;
            }
            if let Some(new) = item.get("feed") {
                feed = new.clone();
            }
            if item.get("home").is_some() {
                at = [None; 3];
            }
            for key in ["rapid", "line"] {
                if let Some(to) = item.get_mut(key) {
                    whole(to, &mut at);
                }
            }
            let unknown = |at: &[Option<f64>; 3]| at.iter().any(Option::is_none);
            if item.get("rapid").is_some() || item.get("line").is_some() {
                if unknown(&at) {
                    continue;
                }
            } else if let Some(arc) = item.get_mut("arc") {
                if unknown(&at) || arc.get("center").is_none() || arc.get("turns").is_some() {
                    continue;
                }
                let from = at;
                whole(&mut arc["to"], &mut at);
                let level = arc.get("plane").is_none() && from[2] == at[2] && from != at;
                if !level {
                    at = from;
                    continue;
                }
            } else if item.get_mut("cycle").is_some_and(|cycle| !hold(cycle, &mut at)) {
                continue;
            }
            items.push(item);
        }
        // in a CL file, a tool change needs a motion after it
        if items.iter().any(|item| item.get("rapid").is_some() || item.get("line").is_some()) {
            let path = json!(items);
            if let Some(head) = operation.as_object_mut() {
                head.insert("feed".into(), at_first);
                head.remove("path");
                head.insert("path".into(), path);
            }
            said.push(operation);
        }
    }
    job["operations"] = json!(said);
    job
}

/// Fills the missing axes of a position from the current position of the tool.
fn whole(to: &mut Value, at: &mut [Option<f64>; 3]) {
    for (axis, place) in at.iter_mut().enumerate() {
        if let Some(value) = to.get(axis).and_then(Value::as_f64) {
            *place = Some(value);
        }
    }
    if at.iter().all(Option::is_some) {
        *to = json!(at);
    }
}

/// Converts a cycle to one that CYCLE can express. Returns false if this is not possible.
fn hold(cycle: &mut Value, at: &mut [Option<f64>; 3]) -> bool {
    if ["emulate", "step_from", "offset_y"].iter().any(|key| cycle.get(key).is_some()) {
        return false;
    }
    let kind = cycle["kind"].as_str().unwrap_or("").to_owned();
    if kind.starts_with("custom") {
        return false;
    }
    if matches!(kind.as_str(), "deep" | "chipbreak")
        && (cycle.get("pecks").is_some() || cycle.get("first_step").is_some())
    {
        return false;
    }
    if let Some(cycle) = cycle.as_object_mut() {
        if cycle.contains_key("step") {
            cycle.insert("step_from".into(), json!("point"));
        }
        // CLEAR and RETURN are written in every cycle; the options of a tap are written in the statement of the tap
        if matches!(kind.as_str(), "tap" | "ltap") && !cycle.contains_key("rigid") {
            cycle.insert("rigid".into(), json!(true));
        }
        if kind == "face" && !cycle.contains_key("dwell") {
            cycle.insert("dwell".into(), json!(0.5));
        }
    }
    let clear = cycle["clear"].as_f64().unwrap_or(0.0);
    let Some(points) = cycle.get_mut("points").and_then(Value::as_array_mut) else { return false };
    let mut place = [None; 3];
    for point in points {
        if let Some(own) = point.get("at") {
            *point = own.clone();
        }
        whole(point, &mut place);
        if place.iter().any(Option::is_none) {
            return false;
        }
    }
    *at = [place[0], place[1], place[2].map(|z| z + clear)];
    true
}

fn three(value: &Value) -> String {
    (0..3).map(|axis| value[axis].as_f64().map_or_else(|| "0".into(), |v| v.to_string())).collect::<Vec<_>>().join(",")
}

/// The CL file of a job.
pub fn cl(job: &Value) -> String {
    let job = for_cl(job);
    let mm = job["units"] == json!("mm");
    let mut text = format!("PARTNO/7\nUNITS/{}\n", if mm { "MM" } else { "INCHES" });
    for operation in list(&job, "operations") {
        let per_turn = operation.get("feed_mode").is_some_and(|mode| mode == "per_rev");
        let unit = match (mm, per_turn) {
            (true, true) => "MMPR",
            (true, false) => "MMPM",
            (false, true) => "IPR",
            (false, false) => "IPM",
        };
        _ = writeln!(text, "LOADTL/{}", operation["tool"]);
        spindle(&mut text, &operation["spindle"]);
        if let Some(coolant) = operation.get("coolant") {
            _ = writeln!(text, "COOLNT/{}", coolant.as_str().unwrap_or("").to_uppercase());
        }
        _ = writeln!(text, "FEDRAT/{},{unit}", operation["feed"]);
        let mut feed = &operation["feed"];
        for item in list(operation, "path") {
            if let Some(new) = item.get("feed") {
                feed = new;
                _ = writeln!(text, "FEDRAT/{feed},{unit}");
            }
            if let Some(to) = item.get("rapid") {
                _ = writeln!(text, "RAPID\nGOTO/{}", three(to));
            } else if let Some(to) = item.get("line") {
                _ = writeln!(text, "GOTO/{}", three(to));
            } else if let Some(arc) = item.get("arc") {
                let up = if arc["direction"] == json!("ccw") { 1 } else { -1 };
                let radius = (0..2)
                    .map(|axis| arc["to"][axis].as_f64().unwrap_or(0.0) - arc["center"][axis].as_f64().unwrap_or(0.0));
                let radius = radius.fold(0.0, f64::hypot);
                _ = writeln!(text, "MOVARC/{},0,0,{up},{radius}\nGOTO/{}", three(&arc["center"]), three(&arc["to"]));
            } else if let Some(cycle) = item.get("cycle") {
                cycle_words(&mut text, cycle, unit);
                // otherwise the next motion would be a rapid
                _ = writeln!(text, "FEDRAT/{feed},{unit}");
            } else if item.get("home").is_some() {
                text += "GOHOME\n";
            } else if let Some(seconds) = item.get("dwell") {
                _ = writeln!(text, "DELAY/{seconds}");
            } else if let Some(stop) = item.get("stop") {
                text += if stop == &json!("program") { "STOP\n" } else { "OPSTOP\n" };
            } else if let Some(comment) = item.get("comment") {
                _ = writeln!(text, "PPRINT/{}", comment.as_str().unwrap_or(""));
            } else if let Some(coolant) = item.get("coolant") {
                _ = writeln!(text, "COOLNT/{}", coolant.as_str().unwrap_or("").to_uppercase());
            } else if let Some(change) = item.get("spindle") {
                spindle(&mut text, change);
            }
        }
    }
    text + "FINI\n"
}

fn spindle(text: &mut String, spindle: &Value) {
    let turn = spindle.get("direction").map(|way| if way == &json!("ccw") { "CCLW" } else { "CLW" });
    let words: Vec<String> =
        spindle.get("speed").map(|speed| format!("{speed},RPM")).into_iter().chain(turn.map(str::to_owned)).collect();
    _ = writeln!(text, "SPINDL/{}", words.join(","));
}

fn cycle_words(text: &mut String, cycle: &Value, unit: &str) {
    let kind = cycle["kind"].as_str().unwrap_or("");
    let mut words = match kind {
        "chipbreak" => "BRKCHP".to_owned(),
        "back" => "BORE,BACK".to_owned(),
        "ltap" => "TAP".to_owned(),
        kind => kind.to_uppercase(),
    };
    if let Some(webs) = cycle.get("webs").and_then(Value::as_array) {
        words += &format!(",DEPTH,{}", webs.iter().map(Value::to_string).collect::<Vec<_>>().join(","));
    }
    let pairs = [
        ("depth", "DEPTH"),
        ("step", "STEP"),
        ("feed", unit),
        ("clear", "CLEAR"),
        ("return", "RETURN"),
        ("rapto", "RAPTO"),
        ("dwell", "DWELL"),
        ("decr", "DECR"),
        ("min_step", "MINSTP"),
        ("times", "TIMES"),
        ("ratio", "RATIO"),
        ("orient", "ORIENT"),
        ("offset", "OFSETL"),
        ("jog", "BACK"),
        ("back", "BACK"),
        ("diameter", "DIAMET"),
        ("angle", "TLANGL"),
    ];
    for (key, word) in pairs {
        if let Some(value) = cycle.get(key) {
            words += &format!(",{word},{value}");
        }
    }
    match cycle.get("rigid") {
        Some(Value::Bool(true)) => words += ",RIGID",
        Some(_) => words += ",FLOAT",
        None => {}
    }
    for (key, word) in [("norevr", ",NOREVR"), ("rapout", ",RAPOUT")] {
        if cycle.get(key).is_some() {
            words += word;
        }
    }
    if kind == "ltap" {
        words += ",INVERS";
    }
    _ = writeln!(text, "CYCLE/{words}");
    for point in list(cycle, "points") {
        _ = writeln!(text, "GOTO/{}", three(point));
    }
    text.push_str("CYCLE/OFF\n");
}
