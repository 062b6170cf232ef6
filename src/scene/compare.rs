//! What changed: against a program of before, and since the form was saved.

use std::io::Cursor;

use serde_json::{Value, json};

use super::pack::Scene;
use super::{Request, made, program};
use crate::diag::escaped;
use crate::diff::{Comparison, Options, Program, compare};
use crate::nc::RunSettings;
use crate::picture::draw;

/// Hunks that are shown.
const MOST: usize = 10_000;

/// A program of before: its text, its path, and which lines changed.
pub fn against(scene: &mut Scene, name: &str, old: &[u8], new: &str, settings: RunSettings, options: &Options) {
    let Some(found) = compared(old, new, options) else { return };
    program::text(scene, "old/", old);
    if let Ok(picture) = draw(Cursor::new(old), settings) {
        program::picture(scene, "old/", &picture);
    }
    let mut value = hunks(&found);
    value["name"] = json!(escaped(name));
    scene.say("against", value);
}

/// What the form as saved prints, beside what it prints now.
pub fn saved(scene: &mut Scene, mut saved: Request<'_>, new: &str, options: &Options) {
    let Ok(before) = made(&mut saved) else {
        return scene.say("saved", json!({ "stopped": true, "hunks": [], "blocks": 0 }));
    };
    let Some(found) = compared(before.program.text().as_bytes(), new, options) else { return };
    scene.say("saved", hunks(&found));
}

fn compared(old: &[u8], new: &str, options: &Options) -> Option<Comparison> {
    let [old, new] = [old, new.as_bytes()].map(|text| Program::new(text.to_vec()).ok());
    Some(compare(&old?, &new?, options))
}

/// Ranges of lines from 0: of the old program, and of the new one.
fn hunks(found: &Comparison) -> Value {
    let rows = found.hunks.iter().take(MOST);
    let rows: Vec<[usize; 4]> = rows.map(|hunk| [hunk.old.start, hunk.old.end, hunk.new.start, hunk.new.end]).collect();
    let blocks: usize = found.hunks.iter().map(|hunk| hunk.old.len().max(hunk.new.len())).sum();
    json!({ "hunks": rows, "blocks": blocks })
}
