//! Adds the program, the origins of its lines and its motions to a scene.

use serde_json::{Value, json};

use super::pack::Scene;
use crate::diag::Diag;
use crate::nc::clock;
use crate::picture::Picture;
use crate::render::TraceLine;
use crate::source::Source;

/// The value for a line that was not printed by a line of the form.
const GENERATED: i32 = -1;
/// An origin stores the line in this number of bits, and the file in the bits above.
const LINE_BITS: u32 = 20;

/// Adds the text of the program.
pub fn text(scene: &mut Scene, of: &str, text: &str) {
    scene.bytes(format!("{of}text"), text.as_bytes().to_vec());
}

/// Adds the origin of each line: its form line and its job item. A job item consists of operation, item, point and line
/// of the job. A subprogram is stored as an operation with the highest bit set.
pub fn origins(scene: &mut Scene, trace: &[TraceLine], files: &[Source], text: &str) {
    let lines = memchr::memchr_iter(b'\n', text.as_bytes()).count();
    let mut forms = vec![GENERATED; lines];
    let mut items = vec![[0_u32; 4]; lines];
    for traced in trace {
        let Some(at) = (traced.line as usize).checked_sub(1).filter(|&at| at < lines) else { continue };
        if let Some((span, source)) = traced.form.and_then(|span| Some((span, files.get(span.file as usize)?))) {
            forms[at] = ((span.file as i32) << LINE_BITS) | source.line(span.start) as i32;
        }
        let place = &traced.place;
        let operation = if place.subprogram > 0 { u32::from(place.subprogram) | 1 << 31 } else { place.operation };
        items[at] = [operation, place.item as u32, place.point, place.line as u32];
    }
    scene.section("lineForm".into(), forms.into_iter().map(i32::to_le_bytes));
    scene.section("lineItem".into(), items.into_iter().flatten().map(u32::to_le_bytes));
}

/// Adds the motions of the program. Coordinates are relative to the middle of the picture, because small numbers keep
/// more decimals in 32 bits.
pub fn picture(scene: &mut Scene, of: &str, picture: &Picture) {
    let strips = picture.strips();
    let [least, greatest] = strips.extents;
    let middle: [f64; 3] = std::array::from_fn(|axis| f64::midpoint(least[axis], greatest[axis]));
    let near = |at: [f64; 3]| std::array::from_fn::<f32, 3, _>(|axis| (at[axis] - middle[axis]) as f32);
    let points = std::iter::once(strips.start).chain(strips.pieces.iter().map(|piece| piece.to));
    scene.section(format!("{of}points"), points.flat_map(near).map(f32::to_le_bytes));
    let moves = &picture.moves;
    // the index of the first piece of each move; after the last move, the total number of pieces
    let mut first = Vec::with_capacity(moves.len() + 1);
    for (at, piece) in strips.pieces.iter().enumerate() {
        if first.len() <= piece.of as usize {
            first.push(at as u32);
        }
    }
    first.push(strips.pieces.len() as u32);
    scene.section(format!("{of}first"), first.into_iter().map(u32::to_le_bytes));
    scene.section(format!("{of}moveLine"), moves.iter().map(|found| found.line.to_le_bytes()));
    // one byte for each move: its kind, whether a cycle makes it, and the axes whose position the program does not contain
    let kind = |found: &crate::picture::Move| {
        let unknown = (0..3).filter(|&axis| found.to[axis].is_nan()).map(|axis| 32 << axis).sum::<u8>();
        [found.kind as u8 | u8::from(found.by_cycle) << 4 | unknown]
    };
    scene.section(format!("{of}moveKind"), moves.iter().map(kind));
    tools(scene, format!("{of}moveTool"), picture, moves.iter().map(|found| found.tool));
    if !picture.turned.is_empty() {
        // the points above are positions on the part; these are the positions of the axes
        let ends = moves.iter().flat_map(|found| found.to).map(f64::to_le_bytes);
        scene.section(format!("{of}ends"), ends);
    }
    let seconds = picture.minutes.iter().map(|minutes| (minutes * 60.0).to_le_bytes());
    scene.section(format!("{of}moveTime"), seconds);
    let holes = &picture.holes;
    let ends = holes.iter().flat_map(|hole| hole.on_part().map(near));
    scene.section(format!("{of}holes"), ends.flatten().map(f32::to_le_bytes));
    scene.section(format!("{of}holeLine"), holes.iter().map(|hole| hole.line.to_le_bytes()));
    tools(scene, format!("{of}holeTool"), picture, holes.iter().map(|hole| hole.tool));
    let changes = &picture.changes;
    scene.section(format!("{of}changeLine"), changes.iter().map(|change| change.line.to_le_bytes()));
    scene.section(format!("{of}changeRegister"), changes.iter().map(|change| [change.register as u8]));
    scene.section(format!("{of}changeValue"), changes.iter().map(|change| change.value.to_le_bytes()));
    scene.say(&format!("{of}picture"), head(picture, middle, strips.extents, strips.ceiling));
}

/// Adds indexes in the list of tools. Each index has one byte if all indexes fit into one byte, otherwise two bytes.
fn tools(scene: &mut Scene, name: String, picture: &Picture, indexes: impl ExactSizeIterator<Item = u16>) {
    if picture.tools.len() <= 256 {
        scene.section(name, indexes.map(|index| [index as u8]));
    } else {
        scene.section(name, indexes.map(u16::to_le_bytes));
    }
}

fn head(picture: &Picture, middle: [f64; 3], extents: [[f64; 3]; 2], ceiling: f64) -> Value {
    let said = |diag: &Diag, line: Option<u64>| json!({ "line": line, "code": diag.code.name(), "message": diag.message, "help": diag.help });
    let line_of = |diag: &Diag| diag.place.as_ref().and_then(|place| place.line);
    let mut head = json!({
        "units": picture.units.name(),
        "letters": picture.letters,
        "tools": picture.tools,
        "middle": middle,
        "extents": extents,
        "ceiling": ceiling,
        "blocks": picture.blocks,
        "minutes": picture.tally.minutes(),
        "time": clock(picture.tally.minutes()),
        "view": picture.usual_view().name(),
        "warnings": picture.warnings.iter().map(|diag| said(diag, line_of(diag))).collect::<Vec<Value>>(),
        "refused": picture.refused.as_ref().map(|(diag, line)| said(diag, Some(*line))),
    });
    if !picture.tool_names.is_empty() {
        head["toolNames"] = picture.tool_names.iter().map(|name| Value::from(&**name)).collect();
    }
    head
}
