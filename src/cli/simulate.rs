//! `postform simulate`.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::path::Path;

use postform::diag::Diag;
use postform::nc::{Action, Item, RunError, Simulator, Tally};
use postform::number::quantise;
use postform::toolpath::{Direction, Plane, StopKind, Units};

use super::Ending;
use super::args::{MotionFormat, SimulateArgs};
use super::files::{self, io_message};
use super::report::Reporter;

/// How much text waits before it is written.
const CHUNK: usize = 64 * 1024;
/// Warnings that are shown; more are counted.
const MOST_WARNINGS: usize = 20;
/// Rapid rate of the time estimate, in millimetres a minute.
const RAPID_RATE: f64 = 10_000.0;

/// Runs a program and prints what the machine does.
pub fn run(args: &SimulateArgs, colour: bool) -> Ending {
    match try_run(args, colour) {
        Ok(ending) => ending,
        Err(message) => {
            eprintln!("{message}");
            Ending::Failed
        }
    }
}

fn try_run(args: &SimulateArgs, colour: bool) -> Result<Ending, String> {
    let settings = args.control.settings(None, args.units.units());
    let mut simulator = Simulator::new(files::open_program(&args.program)?, settings);
    let mut tally = Tally::new(settings.units);
    let mut warnings = Vec::new();
    let mut left_out = 0;
    let mut items = Vec::new();
    let mut text = Vec::with_capacity(CHUNK + 4096);
    let mut out = io::stdout().lock();
    let refused = loop {
        items.clear();
        let step = simulator.step(&mut items);
        for item in &items {
            if args.dry {
                tally.add(item);
            } else if args.format == MotionFormat::Json {
                json(item, &mut text);
            } else {
                line(item, simulator.text(), &mut text);
            }
        }
        let new = simulator.take_warnings();
        let room = MOST_WARNINGS.saturating_sub(warnings.len());
        left_out += new.len().saturating_sub(room);
        warnings.extend(new.into_iter().take(room));
        if text.len() >= CHUNK && !write(&mut out, &mut text)? {
            return Ok(Ending::Clean);
        }
        match step {
            Ok(true) => {}
            Ok(false) => break None,
            Err(RunError::Refused(diag, line)) => break Some((diag, line)),
            Err(RunError::Io(error)) => return Err(io_message("read", &args.program, &error)),
        }
    };
    if let Some((diag, line)) = refused.as_ref().filter(|_| args.format == MotionFormat::Json) {
        let row = serde_json::json!({ "line": line, "error": diag.code.name(), "message": diag.message });
        text.extend_from_slice(row.to_string().as_bytes());
        text.push(b'\n');
    }
    if args.dry {
        let summary = match args.format {
            MotionFormat::Text => describe(&tally, simulator.blocks()),
            MotionFormat::Json => counted(&tally, simulator.blocks()),
        };
        text.extend_from_slice(summary.as_bytes());
    }
    write(&mut out, &mut text)?;
    out.flush().or_else(ignore_closed)?;
    drop(out);
    let reporter = Reporter::new(colour);
    let name = files::name(&args.program);
    warnings.iter_mut().for_each(|diag| place(diag, &name));
    eprint!("{}", reporter.text(&warnings, &[]));
    if left_out > 0 {
        eprintln!("and {left_out} more warnings");
    }
    let Some((mut diag, _)) = refused else { return Ok(Ending::Clean) };
    place(&mut diag, &name);
    eprint!("{}", reporter.text(&[*diag], &[]));
    Ok(Ending::Findings)
}

/// The program's name before the place.
pub fn place(diag: &mut Diag, program: &str) {
    diag.place = Some(format!("{program}:{}", diag.place.take().unwrap_or_default()));
}

/// `false`: whoever read it has seen enough.
fn write(out: &mut impl Write, text: &mut Vec<u8>) -> Result<bool, String> {
    let written = out.write_all(text);
    text.clear();
    match written {
        Ok(()) => Ok(true),
        Err(error) => ignore_closed(error).map(|()| false),
    }
}

fn ignore_closed(error: io::Error) -> Result<(), String> {
    if error.kind() == io::ErrorKind::BrokenPipe {
        return Ok(());
    }
    Err(io_message("write", Path::new("standard output"), &error))
}

fn plane_name(plane: Plane) -> &'static str {
    match plane {
        Plane::Xy => "xy",
        Plane::Xz => "zx",
        Plane::Yz => "yz",
    }
}

fn turn_name(direction: Direction) -> &'static str {
    if direction == Direction::Cw { "cw" } else { "ccw" }
}

fn stop_name(kind: StopKind) -> &'static str {
    if kind == StopKind::Program { "program" } else { "optional" }
}

/// A line that is written from its end to its beginning: digits come that way, and nothing is copied twice.
struct Backwards {
    bytes: [u8; 320],
    at: usize,
}

impl Backwards {
    fn new() -> Backwards {
        Backwards { bytes: [0; 320], at: 320 }
    }

    #[inline]
    fn byte(&mut self, byte: u8) {
        self.at -= 1;
        self.bytes[self.at] = byte;
    }

    #[inline]
    fn text(&mut self, text: &[u8]) {
        self.at -= text.len();
        self.bytes[self.at..][..text.len()].copy_from_slice(text);
    }

    #[inline]
    fn whole(&mut self, mut value: u64) {
        loop {
            self.byte(b'0' + (value % 10) as u8);
            value /= 10;
            if value == 0 {
                return;
            }
        }
    }

    /// A word: its letter, and a number with up to five decimals.
    #[inline]
    fn word(&mut self, letter: &[u8], value: f64) {
        match quantise(value, 5) {
            Some(units) => {
                let size = units.unsigned_abs();
                let mut part = (size % 100_000) as u32;
                if part > 0 {
                    let mut decimals = 5;
                    while part.is_multiple_of(10) {
                        part /= 10;
                        decimals -= 1;
                    }
                    for _ in 0..decimals {
                        self.byte(b'0' + (part % 10) as u8);
                        part /= 10;
                    }
                    self.byte(b'.');
                }
                self.whole(size / 100_000);
                if units < 0 {
                    self.byte(b'-');
                }
            }
            None => self.text(format!("{value:e}").as_bytes()),
        }
        self.text(letter);
    }

    fn position(&mut self, to: &[f64; 6]) {
        for (letter, value) in [b" C", b" B", b" A"].iter().zip(to[3..].iter().rev()) {
            if *value != 0.0 {
                self.word(*letter, *value);
            }
        }
        self.word(b" Z", to[2]);
        self.word(b" Y", to[1]);
        self.word(b"X", to[0]);
    }

    /// The line's number and what is done, before the rest.
    fn head(&mut self, line: u64, what: &[u8]) {
        // the line end alone needs no column
        if self.at < self.bytes.len() - 1 {
            self.text(&b"        "[what.len()..]);
        }
        self.text(what);
        self.text(b"  ");
        let before = self.at;
        self.whole(line);
        let width = before - self.at;
        self.text(&b"      "[width.min(6)..]);
    }
}

/// One action as a line of text.
fn line(item: &Item, block: &[u8], out: &mut Vec<u8>) {
    let mut text = Backwards::new();
    text.byte(b'\n');
    let what = match &item.action {
        Action::Rapid { to, machine } => {
            if *machine != 0 {
                text.text(b" in machine coordinates)");
                (0..6).rev().filter(|axis| machine & 1 << axis != 0).for_each(|axis| text.byte(b"XYZABC"[axis]));
                text.text(b"  (");
            }
            text.position(to);
            "rapid"
        }
        Action::Feed { to, feed, lead } => {
            match lead {
                Some(lead) => text.word(b" lead ", *lead),
                None => text.word(b" F", *feed),
            }
            text.position(to);
            "feed"
        }
        Action::Arc(turn) => {
            if turn.turns > 0 {
                text.word(b", whole turns before: ", f64::from(turn.turns));
            }
            text.text(plane_name(turn.plane).as_bytes());
            text.text(b" in ");
            text.word(b" Z", turn.center[2]);
            text.word(b" Y", turn.center[1]);
            text.word(b"  centre X", turn.center[0]);
            text.word(b" F", turn.feed);
            text.position(&turn.to);
            turn_name(turn.direction)
        }
        Action::Dwell(seconds) => {
            text.text(b" s");
            text.word(b"", *seconds);
            "dwell"
        }
        Action::Spindle(rotation, speed) => {
            text.word(b" S", *speed);
            text.text(rotation.name().as_bytes());
            "spindle"
        }
        Action::Orient(value) => number_line(&mut text, *value, "orient"),
        Action::Tool(value) => number_line(&mut text, *value, "tool"),
        Action::Work(value) => number_line(&mut text, *value, "work"),
        Action::Stop(kind) => name_line(&mut text, stop_name(*kind), "stop"),
        Action::Coolant(kind) => name_line(&mut text, kind.name(), "coolant"),
        Action::Units(units) => name_line(&mut text, units.name(), "units"),
        Action::End => "end",
        Action::Comment(start, end) => {
            text.byte(b' ');
            text.head(item.line, b"comment");
            let comment = String::from_utf8_lossy(block.get(*start..*end).unwrap_or_default());
            out.extend_from_slice(&text.bytes[text.at..text.bytes.len() - 1]);
            out.extend_from_slice(postform::diag::escaped(comment.trim()).as_bytes());
            out.push(b'\n');
            return;
        }
        _ => return,
    };
    text.head(item.line, what.as_bytes());
    out.extend_from_slice(&text.bytes[text.at..]);
}

fn number_line(text: &mut Backwards, value: f64, what: &'static str) -> &'static str {
    text.word(b"", value);
    what
}

fn name_line(text: &mut Backwards, name: &str, what: &'static str) -> &'static str {
    text.text(name.as_bytes());
    what
}

/// One action as a JSON object.
fn json(item: &Item, out: &mut Vec<u8>) {
    let start = out.len();
    out.extend_from_slice(b"{\"line\":");
    out.extend_from_slice(itoa::Buffer::new().format(item.line).as_bytes());
    match &item.action {
        Action::Rapid { to, machine } => {
            list(b",\"rapid\":[", to, out);
            if *machine != 0 {
                out.extend_from_slice(b",\"machine\":\"");
                out.extend((0..6).filter(|axis| machine & 1 << axis != 0).map(|axis| b"xyzabc"[axis]));
                out.push(b'"');
            }
        }
        Action::Feed { to, feed, lead } => {
            list(b",\"feed\":[", to, out);
            match lead {
                Some(lead) => number(b",\"lead\":", *lead, out),
                None => number(b",\"f\":", *feed, out),
            }
        }
        Action::Arc(turn) => {
            list(b",\"arc\":[", &turn.to, out);
            list(b",\"center\":[", &turn.center, out);
            name(b",\"plane\":\"", plane_name(turn.plane), out);
            name(b",\"turn\":\"", turn_name(turn.direction), out);
            if turn.turns > 0 {
                number(b",\"turns\":", f64::from(turn.turns), out);
            }
            number(b",\"f\":", turn.feed, out);
        }
        Action::Dwell(seconds) => number(b",\"dwell\":", *seconds, out),
        Action::Spindle(rotation, speed) => {
            name(b",\"spindle\":\"", rotation.name(), out);
            number(b",\"s\":", *speed, out);
        }
        Action::Orient(angle) => number(b",\"orient\":", *angle, out),
        Action::Stop(kind) => name(b",\"stop\":\"", stop_name(*kind), out),
        Action::End => name(b",\"stop\":\"", "end", out),
        Action::Tool(number_of) => number(b",\"tool\":", *number_of, out),
        Action::Coolant(kind) => name(b",\"coolant\":\"", kind.name(), out),
        Action::Units(units) => name(b",\"units\":\"", units.name(), out),
        Action::Work(code) => number(b",\"work\":", *code, out),
        _ => {
            out.truncate(start);
            return;
        }
    }
    out.extend_from_slice(b"}\n");
}

fn list(before: &[u8], values: &[f64], out: &mut Vec<u8>) {
    out.extend_from_slice(before);
    for (i, value) in values.iter().enumerate() {
        number(if i == 0 { b"" } else { b"," }, *value, out);
    }
    out.push(b']');
}

/// A number so that it reads back as the same double.
fn number(before: &[u8], value: f64, out: &mut Vec<u8>) {
    out.extend_from_slice(before);
    if value.fract() == 0.0 && value.abs() < 1e15 {
        out.extend_from_slice(itoa::Buffer::new().format(value as i64).as_bytes());
    } else {
        out.extend_from_slice(zmij::Buffer::new().format_finite(value).as_bytes());
    }
}

fn name(before: &[u8], value: &str, out: &mut Vec<u8>) {
    out.extend_from_slice(before);
    out.extend_from_slice(value.as_bytes());
    out.push(b'"');
}

/// The summary as a machinist reads it.
fn describe(tally: &Tally, blocks: u64) -> String {
    let mut text = String::new();
    let unit = tally.units.name();
    let [rapids, feeds, arcs] = tally.moves;
    _ = writeln!(text, "blocks    {blocks}");
    _ = writeln!(text, "moves     {rapids} rapid, {feeds} straight, {arcs} arcs");
    _ = writeln!(text, "holes     {}", tally.holes);
    _ = writeln!(text, "tools     {}", tally.tools);
    if let Some(extents) = &tally.extents {
        for (axis, (least, greatest)) in ["X", "Y", "Z"].iter().zip(extents) {
            _ = writeln!(text, "{axis} at feed {} to {} {unit}", short(*least), short(*greatest));
        }
    }
    let [rapid, feed] = tally.distances;
    _ = writeln!(text, "distance  {} {unit} at rapid, {} {unit} at feed", short(rapid), short(feed));
    let rate = rapid_rate(tally.units);
    let minutes = [tally.cutting, tally.dwelling, rapid / rate];
    _ = writeln!(
        text,
        "time      {}: cutting {}, dwells {}, rapids {} at {} {unit}/min, without tool changes",
        clock(minutes.iter().sum()),
        clock(minutes[0]),
        clock(minutes[1]),
        clock(minutes[2]),
        short(rate)
    );
    if tally.timeless > 0 {
        _ = writeln!(
            text,
            "          {} feed moves not counted: their feed follows a spindle without speed",
            tally.timeless
        );
    }
    text
}

/// The summary as JSON.
fn counted(tally: &Tally, blocks: u64) -> String {
    let [rapids, feeds, arcs] = tally.moves;
    let rapid = tally.distances[0];
    let row = serde_json::json!({
        "blocks": blocks, "units": tally.units.name(), "rapids": rapids, "feeds": feeds, "arcs": arcs,
        "holes": tally.holes, "tools": tally.tools,
        "extents": tally.extents.map(|extents| extents.map(|(least, greatest)| [least, greatest])),
        "distance": { "rapid": rapid, "feed": tally.distances[1] },
        "minutes": { "cutting": tally.cutting, "dwells": tally.dwelling, "rapids": rapid / rapid_rate(tally.units) },
    });
    format!("{row}\n")
}

fn rapid_rate(units: Units) -> f64 {
    if units == Units::Inch { RAPID_RATE / 25.0 } else { RAPID_RATE }
}

fn short(value: f64) -> String {
    format!("{}", (value * 1e4).round() / 1e4 + 0.0)
}

/// Minutes as 1:02:03.
fn clock(minutes: f64) -> String {
    let seconds = (minutes * 60.0).round() as u64;
    let (hours, rest) = (seconds / 3600, seconds % 3600);
    if hours > 0 {
        format!("{hours}:{:02}:{:02}", rest / 60, rest % 60)
    } else {
        format!("{}:{:02}", rest / 60, rest % 60)
    }
}
