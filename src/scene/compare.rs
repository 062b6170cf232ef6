//! Compares the program with an old program, and with the program that the last saved form prints.

use std::io::Cursor;

use serde_json::{Value, json};

use super::pack::Scene;
use super::program;
use crate::diff::{Comparison, Options, Program, compare};
use crate::nc::RunSettings;
use crate::picture::draw;
use crate::source::text_of;
use crate::terminal::escaped;

/// Maximum number of hunks that are shown.
const MOST: usize = 10_000;

/// Adds the text and the motions of an old program to the scene.
pub fn draw_old(scene: &mut Scene, old: &[u8], settings: RunSettings) {
    program::text(scene, "old/", &text_of(old));
    if let Ok(picture) = draw(Cursor::new(old), settings) {
        program::picture(scene, "old/", &picture);
    }
}

/// The lines that differ from an old program. `None`: one of the programs is too long to compare.
pub fn against(name: &str, old: &[u8], new: &str, options: &Options) -> Option<Value> {
    let mut value = hunks(&compared(old, new, options)?);
    value["name"] = json!(escaped(name));
    Some(value)
}

/// The lines that differ from the program that the last saved form prints. `before` is `None` if the last saved form
/// prints no program.
pub fn saved(before: Option<&str>, new: &str, options: &Options) -> Option<Value> {
    match before {
        Some(before) => Some(hunks(&compared(before.as_bytes(), new, options)?)),
        None => Some(json!({ "stopped": true, "hunks": [], "blocks": 0 })),
    }
}

fn compared(old: &[u8], new: &str, options: &Options) -> Option<Comparison> {
    let [old, new] = [old, new.as_bytes()].map(|text| Program::new(text.to_vec()).ok());
    Some(compare(&old?, &new?, options))
}

/// The differences as ranges of lines, counted from 0: lines of the old program, then lines of the new program.
fn hunks(found: &Comparison) -> Value {
    let rows = found.hunks.iter().take(MOST);
    let rows: Vec<[usize; 4]> = rows.map(|hunk| [hunk.old.start, hunk.old.end, hunk.new.start, hunk.new.end]).collect();
    let blocks: usize = found.hunks.iter().map(|hunk| hunk.old.len().max(hunk.new.len())).sum();
    json!({ "hunks": rows, "blocks": blocks })
}
