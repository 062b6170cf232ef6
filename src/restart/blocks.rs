//! Writes the blocks of the new program: the head, the blocks that restore the modal state, the approach, and the rest.

use super::entry::{Entry, Found};
use super::{Asked, Refused, Way, refuse};
use crate::control::{Code, Control, Meaning, ToolLength};
use crate::machine::offsets;
use crate::nc::Rotation;
use crate::toolpath::{FeedMode, Plane, Units};

/// Returns the text of the new program, the number of its lines before the first line copied from the old program, and
/// the notes for the operator.
pub fn program(
    text: &[u8],
    control: &Control,
    found: &Found,
    asked: &Asked,
    way: Way,
) -> Result<(Vec<u8>, u64, Vec<String>), Refused> {
    let lines: Vec<&[u8]> = text.split_inclusive(|byte| *byte == b'\n').collect();
    let crlf = lines.first().is_some_and(|line| line.ends_with(b"\r\n"));
    let head = (found.head as usize).min(lines.len());
    let (own, notes) = blocks(control, found, asked, way)?;
    let mut new = Vec::with_capacity(text.len());
    lines[..head].iter().for_each(|line| new.extend_from_slice(line));
    if !new.is_empty() && !new.ends_with(b"\n") {
        new.push(b'\n');
    }
    for block in &own {
        new.extend_from_slice(block.as_bytes());
        new.extend_from_slice(if crlf { b"\r\n" } else { b"\n" });
    }
    let rest = (found.entry.line as usize - 1).max(head);
    lines[rest.min(lines.len())..].iter().for_each(|line| new.extend_from_slice(line));
    Ok((new, (head + own.len()) as u64, notes))
}

/// Returns the blocks that restore the modal state and make the approach, and the notes for the operator.
fn blocks(control: &Control, found: &Found, asked: &Asked, way: Way) -> Result<(Vec<String>, Vec<String>), Refused> {
    let Entry { line, standing, switches, said, height, depth } = &found.entry;
    let code = |meaning: Meaning| control.first(meaning).map(|row| row.code.to_string());
    let mut notes = Vec::new();
    let comment = format!("RESTART AT LINE {line}");
    let comment = if control.is_lathe() || !is_bare(control) { format!("({comment})") } else { format!("; {comment}") };
    let mut blocks = vec![comment];
    // modal codes
    let units = if standing.units == Units::Inch { Meaning::Inch } else { Meaning::Mm };
    let plane = match standing.plane {
        Plane::Xy => Meaning::PlaneXy,
        Plane::Xz => Meaning::PlaneXz,
        Plane::Yz => Meaning::PlaneYz,
    };
    let feed_mode = match standing.feed_mode {
        FeedMode::PerMinute => Meaning::PerMinute,
        FeedMode::PerRev => Meaning::PerRev,
        FeedMode::InverseTime => Meaning::InverseTime,
    };
    let modes = [units, plane, Meaning::SideOff, Meaning::CycleEnd, Meaning::LengthOff, Meaning::Absolute, feed_mode];
    for group in modes.chunks(4) {
        // on a lathe, the turret position selects the length: no code is needed
        // a mode that the program never sets is left out, because its value depends on the machine
        let is_said = |meaning: &&Meaning| match **meaning {
            Meaning::LengthOff => !control.is_lathe(),
            own if own == units => said.units,
            own if own == feed_mode => said.feed_mode,
            _ => true,
        };
        let words: Vec<String> = group.iter().filter(is_said).filter_map(|meaning| code(*meaning)).collect();
        if !words.is_empty() {
            blocks.push(words.join(" "));
        }
    }
    // retract to machine zero
    let up = if control.is_lathe() {
        let home = Code { letter: b'G', tenths: 280 };
        control.row(home).filter(|row| row.meaning == Meaning::Reference).map(|row| {
            notes.push(
                "the program first goes home along X: if the tool is in a bore or behind a shoulder, move it out by \
                 hand before the start"
                    .to_owned(),
            );
            vec![format!("{} U0", row.code), format!("{} W0", row.code)]
        })
    } else {
        let rapid = code(Meaning::Rapid);
        code(Meaning::Machine).zip(rapid).map(|(machine, rapid)| vec![format!("{rapid} {machine} Z0.")])
    };
    match (up, asked.clear) {
        (_, Some(clear)) if !control.is_lathe() => {
            if code(Meaning::Machine).and(code(Meaning::ToolChange)).is_some() {
                return refuse(
                    "--clear-z is a height of the tool tip, but the tool in the spindle is unknown",
                    "leave --clear-z out: then the tool retracts to the machine zero with G53",
                );
            }
            if let Some(height) = height.filter(|height| clear < *height) {
                return refuse(
                    format!("--clear-z {} is below {}, the height of the rapids", number(clear), number(height)),
                    "give a height above all obstacles",
                );
            }
            if switches.work {
                blocks.push(offsets::name(control, standing.work));
            }
            let rapid = code(Meaning::Rapid).unwrap_or_else(|| "G0".into());
            blocks.push(format!("{rapid} Z{}", number(clear)));
        }
        (Some(up), _) => {
            if is_bare(control) {
                notes.push(
                    "G53 uses machine coordinates: home the machine first, or give a height with --clear-z".to_owned(),
                );
            }
            blocks.extend(up);
        }
        (None, _) => {
            return refuse(
                format!("{} has no code for a retract to the machine zero", control.name()),
                "give a height above all obstacles: --clear-z 50",
            );
        }
    }
    let changes_later = height.is_none();
    let tool = standing.tool.filter(|_| !changes_later);
    if let Some(tool) = tool {
        if control.first(Meaning::ToolChange).is_some() {
            let change = code(Meaning::ToolChange).unwrap_or_default();
            blocks.push(format!("T{tool} {change}"));
        } else {
            notes.push(format!("put T{tool} into the spindle first: the control has no tool change code"));
        }
    }
    // the tool that an earlier block has preselected
    if let Some(next) = standing.named_tool.filter(|next| Some(*next) != standing.tool && *next != 0.0)
        && !control.is_lathe()
    {
        blocks.push(format!("T{next}"));
    }
    if switches.work {
        blocks.push(offsets::name(control, standing.work));
    }
    if way.turning {
        spindle(control, found, &mut blocks);
    } else {
        blocks.extend(code(Meaning::SpindleOff));
    }
    for (is_on, meaning) in
        [(switches.flood, Meaning::Flood), (switches.mist, Meaning::Mist), (switches.through, Meaning::Through)]
    {
        if let Some(word) = code(meaning).filter(|_| is_on) {
            blocks.push(word);
        }
    }
    // the blocks of the head may have turned the coolant on
    if !(switches.flood || switches.mist || switches.through) {
        blocks.extend(code(Meaning::CoolantOff));
    }
    if !control.is_lathe() && way.across {
        way_in(control, &found.entry, &mut blocks)?;
    }
    if let (Some(depth), Some(cut)) = (depth, code(Meaning::Line)) {
        blocks.push(format!("{cut} Z{} F{}", number(*depth), number(standing.feed)));
        notes.push(format!(
            "the tool feeds down to Z{} beside the finished cuts: check that there is room",
            number(*depth)
        ));
    }
    if !standing.absolute {
        blocks.extend(code(Meaning::Increments));
    }
    if standing.feed > 0.0 && standing.feed_mode != FeedMode::InverseTime {
        blocks.push(format!("F{}", number(standing.feed)));
    }
    let returns = if standing.to_initial { Meaning::ToInitial } else { Meaning::ToR };
    blocks.extend(code(returns).filter(|_| !control.is_lathe()));
    if found.entry.line < found.asked {
        notes.push(format!(
            "the program begins at line {line}, where the tool is clear, not at line {}: the blocks between are run \
             again",
            found.asked
        ));
    }
    for (line, code) in &found.codes {
        notes.push(format!("{code} of line {line} is not run again: enter it by hand if you need it"));
    }
    Ok((blocks, notes))
}

/// Adds the blocks that start the spindle.
fn spindle(control: &Control, found: &Found, blocks: &mut Vec<String>) {
    let Entry { standing, switches, .. } = &found.entry;
    let code = |meaning: Meaning| control.first(meaning).map(|row| row.code.to_string());
    if let (Some(limit), Some(word)) = (switches.limit, code(Meaning::SpeedLimit)) {
        blocks.push(format!("{word} S{}", whole(limit)));
    }
    let mode = if switches.surface.is_some() { Meaning::SurfaceSpeed } else { Meaning::Revolutions };
    let mode = code(mode).filter(|_| control.is_lathe() || switches.surface.is_some());
    let turn = match standing.rotation {
        Rotation::Cw => code(Meaning::SpindleCw),
        Rotation::Ccw => code(Meaning::SpindleCcw),
        Rotation::Stop => code(Meaning::SpindleOff),
    };
    let speed = (standing.speed > 0.0).then(|| format!("S{}", whole(standing.speed)));
    let words: Vec<String> = mode.into_iter().chain(speed).chain(turn).collect();
    if !words.is_empty() {
        blocks.push(words.join(" "));
    }
}

/// Adds the move in X and Y, the tool length, and the move down to the height of the entry.
fn way_in(control: &Control, entry: &Entry, blocks: &mut Vec<String>) -> Result<(), Refused> {
    let Entry { standing, switches, height, .. } = entry;
    let code = |meaning: Meaning| control.first(meaning).map(|row| row.code.to_string());
    let rapid = code(Meaning::Rapid).unwrap_or_else(|| "G0".into());
    let mut across: Vec<String> = (0..2)
        .filter(|axis| standing.unknown & 1 << axis == 0)
        .map(|axis| format!("{}{}", ["X", "Y"][axis], number(standing.position[axis])))
        .collect();
    let turned = (3..6).filter(|axis| standing.position[*axis] != 0.0);
    across.extend(turned.map(|axis| format!("{}{}", ["A", "B", "C"][axis - 3], number(standing.position[axis]))));
    if !across.is_empty() {
        blocks.push(format!("{rapid} {}", across.join(" ")));
    }
    let Some(height) = height else { return Ok(()) };
    let down = format!("Z{}", number(*height));
    let Some(register) = switches.length.filter(|register| *register != 0.0) else {
        blocks.push(format!("{rapid} {down}"));
        return Ok(());
    };
    let meaning = if register < 0.0 { Meaning::LengthMinus } else { Meaning::LengthOn };
    let register = format!("H{}", register.abs());
    match (control.traits().tool_length, code(meaning)) {
        (ToolLength::CodeAndRegister | ToolLength::Code, Some(word)) => {
            blocks.push(format!("{word} {register} {down}"));
        }
        (ToolLength::Register, _) => blocks.push(format!("{register} {down}")),
        _ => {
            return refuse(
                format!("the code that turns a tool length on is unknown for {}", control.name()),
                "begin at a tool change: --tool",
            );
        }
    }
    Ok(())
}

/// Whether a comment begins with a semicolon on this control, as on Grbl.
fn is_bare(control: &Control) -> bool {
    control.rules() == crate::control::Rules::Grbl
}

/// A number as programs contain it: with a decimal point and without trailing zeros.
fn number(value: f64) -> String {
    let text = format!("{:.6}", value);
    let text = text.trim_end_matches('0');
    if text == "-0." { "0.".into() } else { text.to_owned() }
}

fn whole(value: f64) -> String {
    if value.fract() == 0.0 { format!("{value}") } else { number(value) }
}
