//! Writes the blocks of the new program: the head, the blocks that restore the modal state, the approach, and the rest.

use super::entry::{Entry, Found};
use super::{AXES, Asked, Refused, Way, refuse};
use crate::control::{Code, Control, Meaning, ToolLength};
use crate::machine::offsets;
use crate::nc::{Rotation, coolant_of};
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
    let mut written = Written { control, found, entry: &found.entry, blocks: Vec::new(), notes: Vec::new() };
    written.all(asked, way)?;
    let Written { blocks: own, notes, .. } = written;
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

/// The blocks that restore the modal state and make the approach.
struct Written<'a> {
    control: &'a Control,
    found: &'a Found,
    entry: &'a Entry,
    blocks: Vec<String>,
    /// Notes for the operator.
    notes: Vec<String>,
}

impl Written<'_> {
    fn all(&mut self, asked: &Asked, way: Way) -> Result<(), Refused> {
        let comment = format!("RESTART AT LINE {}", self.entry.line);
        let is_bare = is_bare(self.control) && !self.control.is_lathe();
        self.blocks.push(if is_bare { format!("; {comment}") } else { format!("({comment})") });
        self.modes();
        self.retract(asked.clear)?;
        self.tool();
        if self.entry.switches.work {
            self.blocks.push(offsets::name(self.control, self.entry.standing.work));
        }
        match way.turning {
            true => self.spindle(),
            false => self.blocks.extend(self.code(Meaning::SpindleOff)),
        }
        self.coolant();
        if !self.control.is_lathe() && way.across {
            self.approach()?;
        }
        self.entry();
        self.notes();
        Ok(())
    }

    /// The code of the control with this meaning.
    fn code(&self, meaning: Meaning) -> Option<String> {
        self.control.first(meaning).map(|row| row.code.to_string())
    }

    fn rapid(&self) -> String {
        self.code(Meaning::Rapid).unwrap_or_else(|| "G0".into())
    }

    /// The modal codes before the retract.
    fn modes(&mut self) {
        let Entry { standing, said, .. } = self.entry;
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
        let modes =
            [units, plane, Meaning::SideOff, Meaning::CycleEnd, Meaning::LengthOff, Meaning::Absolute, feed_mode];
        for group in modes.chunks(4) {
            // on a lathe, the turret position selects the length: no code is needed
            // a mode that the program never sets is left out, because its value depends on the machine
            let is_said = |meaning: &&Meaning| match **meaning {
                Meaning::LengthOff => !self.control.is_lathe(),
                own if own == units => said.units,
                own if own == feed_mode => said.feed_mode,
                _ => true,
            };
            let words: Vec<String> = group.iter().filter(is_said).filter_map(|meaning| self.code(*meaning)).collect();
            if !words.is_empty() {
                self.blocks.push(words.join(" "));
            }
        }
    }

    /// The retract to the machine zero, or to the height of `--clear-z`.
    fn retract(&mut self, clear: Option<f64>) -> Result<(), Refused> {
        if let Some(clear) = clear.filter(|_| !self.control.is_lathe()) {
            return self.retract_to(clear);
        }
        let home = Code { letter: b'G', tenths: 280 };
        let home = self.control.row(home).filter(|row| row.meaning == Meaning::Reference);
        let up = match self.control.is_lathe() {
            true => home.map(|row| vec![format!("{} U0", row.code), format!("{} W0", row.code)]),
            false => self.code(Meaning::Machine).map(|machine| vec![format!("{} {machine} Z0.", self.rapid())]),
        };
        let Some(up) = up else {
            return refuse(
                format!("{} has no code for a retract to the machine zero", self.control.name()),
                "give a height above all obstacles: --clear-z 50",
            );
        };
        if self.control.is_lathe() {
            let note = "the program first goes home along X: if the tool is in a bore or behind a shoulder, move it \
                        out by hand before the start";
            self.notes.push(note.to_owned());
        }
        if is_bare(self.control) {
            let note = "G53 uses machine coordinates: home the machine first, or give a height with --clear-z";
            self.notes.push(note.to_owned());
        }
        self.blocks.extend(up);
        Ok(())
    }

    fn retract_to(&mut self, clear: f64) -> Result<(), Refused> {
        if self.code(Meaning::Machine).and(self.code(Meaning::ToolChange)).is_some() {
            return refuse(
                "--clear-z is a height of the tool tip, but the tool in the spindle is unknown",
                "leave --clear-z out: then the tool retracts to the machine zero with G53",
            );
        }
        if let Some(height) = self.entry.height.filter(|height| clear < *height) {
            return refuse(
                format!("--clear-z {} is below {}, the height of the rapids", number(clear), number(height)),
                "give a height above all obstacles",
            );
        }
        if self.entry.switches.work {
            self.blocks.push(offsets::name(self.control, self.entry.standing.work));
        }
        self.blocks.push(format!("{} Z{}", self.rapid(), number(clear)));
        Ok(())
    }

    /// The tool, and the tool that an earlier block has preselected.
    fn tool(&mut self) {
        let standing = &self.entry.standing;
        let changes_later = self.entry.height.is_none();
        if let Some(tool) = standing.tool.filter(|_| !changes_later) {
            match self.code(Meaning::ToolChange) {
                Some(change) => self.blocks.push(format!("T{tool} {change}")),
                None => {
                    let note = format!("put T{tool} into the spindle first: the control has no tool change code");
                    self.notes.push(note);
                }
            }
        }
        let next = standing.named_tool.filter(|next| Some(*next) != standing.tool && *next != 0.0);
        self.blocks.extend(next.filter(|_| !self.control.is_lathe()).map(|next| format!("T{next}")));
    }

    fn spindle(&mut self) {
        let Entry { standing, switches, .. } = self.entry;
        if let (Some(limit), Some(word)) = (switches.limit, self.code(Meaning::SpeedLimit)) {
            self.blocks.push(format!("{word} S{}", whole(limit)));
        }
        let mode = if switches.surface.is_some() { Meaning::SurfaceSpeed } else { Meaning::Revolutions };
        let mode = self.code(mode).filter(|_| self.control.is_lathe() || switches.surface.is_some());
        let turn = match standing.rotation {
            Rotation::Cw => self.code(Meaning::SpindleCw),
            Rotation::Ccw => self.code(Meaning::SpindleCcw),
            Rotation::Stop => self.code(Meaning::SpindleOff),
        };
        let speed = (standing.speed > 0.0).then(|| format!("S{}", whole(standing.speed)));
        let words: Vec<String> = mode.into_iter().chain(speed).chain(turn).collect();
        if !words.is_empty() {
            self.blocks.push(words.join(" "));
        }
    }

    /// The coolant. The blocks of the head may have turned the coolant on.
    fn coolant(&mut self) {
        let coolant = self.entry.switches.coolant;
        let on: Vec<Meaning> = [Meaning::Flood, Meaning::Mist, Meaning::Through]
            .into_iter()
            .filter(|meaning| coolant_of(*meaning).is_some_and(|kind| coolant.holds(kind)))
            .collect();
        let codes = if on.is_empty() { vec![Meaning::CoolantOff] } else { on };
        let words: Vec<String> = codes.into_iter().filter_map(|meaning| self.code(meaning)).collect();
        self.blocks.extend(words);
    }

    /// The move in X and Y, the tool length, and the move down to the height of the entry.
    fn approach(&mut self) -> Result<(), Refused> {
        let Entry { standing, switches, height, .. } = self.entry;
        let rapid = self.rapid();
        // every axis whose position the program has given, also at 0: the machine may have stopped at any position
        let across: Vec<String> = [0, 1, 3, 4, 5]
            .into_iter()
            .filter(|axis| standing.unknown & 1 << axis == 0)
            .map(|axis| format!("{}{}", AXES[axis], number(standing.position[axis])))
            .collect();
        if !across.is_empty() {
            self.blocks.push(format!("{rapid} {}", across.join(" ")));
        }
        let Some(height) = height else { return Ok(()) };
        let down = format!("Z{}", number(*height));
        let Some(register) = switches.length.filter(|register| *register != 0.0) else {
            self.blocks.push(format!("{rapid} {down}"));
            return Ok(());
        };
        let meaning = if register < 0.0 { Meaning::LengthMinus } else { Meaning::LengthOn };
        let register = format!("H{}", register.abs());
        let block = match (self.control.traits().tool_length, self.code(meaning)) {
            (ToolLength::CodeAndRegister | ToolLength::Code, Some(word)) => format!("{word} {register} {down}"),
            (ToolLength::Register, _) => format!("{register} {down}"),
            _ => {
                return refuse(
                    format!("the code that turns a tool length on is unknown for {}", self.control.name()),
                    "begin at a tool change: --tool",
                );
            }
        };
        self.blocks.push(block);
        Ok(())
    }

    /// The move at feed to the depth of the entry, and the modal states that the old program has there.
    fn entry(&mut self) {
        let Entry { standing, depth, .. } = self.entry;
        if let (Some(depth), Some(cut)) = (depth, self.code(Meaning::Line)) {
            self.blocks.push(format!("{cut} Z{} F{}", number(*depth), number(standing.feed)));
            self.notes.push(format!(
                "the tool feeds down to Z{} beside the finished cuts: check that there is room",
                number(*depth)
            ));
        }
        if !standing.absolute {
            self.blocks.extend(self.code(Meaning::Increments));
        }
        if standing.feed > 0.0 && standing.feed_mode != FeedMode::InverseTime {
            self.blocks.push(format!("F{}", number(standing.feed)));
        }
        let returns = if standing.to_initial { Meaning::ToInitial } else { Meaning::ToR };
        self.blocks.extend(self.code(returns).filter(|_| !self.control.is_lathe()));
    }

    fn notes(&mut self) {
        let (line, asked) = (self.entry.line, self.found.asked);
        if line < asked {
            self.notes.push(format!(
                "the program begins at line {line}, where the tool is clear, not at line {asked}: the blocks between \
                 are run again"
            ));
        }
        let codes = self.found.codes.iter();
        self.notes
            .extend(codes.map(|(line, code)| {
                format!("{code} of line {line} is not run again: enter it by hand if you need it")
            }));
    }
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
