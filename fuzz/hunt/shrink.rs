//! Finds a small job with the same fault: parts of the document are removed as long as the fault stays.

use serde_json::Value;

/// Removes parts that are not needed for the fault. `fails` is called at most 1000 times.
pub fn shrunk(job: &Value, fails: &mut dyn FnMut(&Value) -> bool) -> Value {
    let mut best = job.clone();
    let mut tries = 1000;
    loop {
        let before = best.to_string().len();
        for size in [16, 8, 4, 2, 1] {
            let mut paths = Vec::new();
            places(&best, &mut Vec::new(), &mut paths);
            // from the end, so that the paths of earlier parts stay valid
            for path in paths.into_iter().rev() {
                let mut from = count(&best, &path);
                while from > 0 && tries > 0 {
                    from = from.saturating_sub(size);
                    let mut other = best.clone();
                    if remove(&mut other, &path, from, size) {
                        tries -= 1;
                        if fails(&other) {
                            best = other;
                        }
                    }
                }
            }
        }
        if tries == 0 || best.to_string().len() >= before {
            return best;
        }
    }
}

/// Paths of all lists and objects.
fn places(value: &Value, path: &mut Vec<String>, out: &mut Vec<Vec<String>>) {
    let children: Vec<(String, &Value)> = match value {
        Value::Array(list) if list.iter().any(|item| !item.is_number() && !item.is_null()) || list.len() > 6 => {
            list.iter().enumerate().map(|(i, v)| (i.to_string(), v)).collect()
        }
        Value::Object(map) => map.iter().map(|(key, v)| (key.clone(), v)).collect(),
        _ => return,
    };
    out.push(path.clone());
    for (key, child) in children {
        path.push(key);
        places(child, path, out);
        path.pop();
    }
}

fn at<'v>(value: &'v mut Value, path: &[String]) -> Option<&'v mut Value> {
    path.iter().try_fold(value, |value, key| match value {
        Value::Array(list) => list.get_mut(key.parse::<usize>().ok()?),
        Value::Object(map) => map.get_mut(key),
        _ => None,
    })
}

fn count(value: &Value, path: &[String]) -> usize {
    let mut value = value.clone();
    match at(&mut value, path) {
        Some(Value::Array(list)) => list.len(),
        Some(Value::Object(map)) => map.len(),
        _ => 0,
    }
}

fn remove(value: &mut Value, path: &[String], from: usize, size: usize) -> bool {
    match at(value, path) {
        Some(Value::Array(list)) if from < list.len() => {
            list.drain(from..(from + size).min(list.len()));
            true
        }
        Some(Value::Object(map)) if size == 1 && from < map.len() => {
            let key = map.keys().nth(from).cloned().unwrap_or_default();
            if ["operations", "path", "lines", "name", "kind", "postform", "units", "program"].contains(&key.as_str()) {
                return false;
            }
            map.shift_remove(&key).is_some()
        }
        _ => false,
    }
}
