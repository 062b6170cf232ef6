//! Actions as lines of text.

use postform::internals::nc::{Action, Item, RunSettings, Simulator, plane_name, stop_name, turn_name};
use postform::internals::number::quantise;
use postform::internals::source::text_of;
use postform::internals::terminal::escaped;

/// The display of positions.
#[derive(Clone, Copy)]
pub struct Shown {
    /// Unknown positions are shown as `?`.
    pub unknown: bool,
    /// For lathes only: the factor by which a radius is multiplied to get the X of programs. Y is then left out.
    pub across: Option<f64>,
    /// Axes, in the order of a position.
    axes: &'static Axes,
}

/// Axes of a machine.
#[derive(Debug)]
struct Axes {
    /// The letters of the axes in the text, in the order of a position.
    letters: [&'static [u8]; 6],
    /// Number of leading axes that are always shown; the others are shown only if they are not 0.
    always: usize,
}

const USUAL: Axes = Axes { letters: [b"X", b" Y", b" Z", b" A", b" B", b" C"], always: 3 };
/// X Y of the lower guide, U V of the upper guide.
const WIRE: Axes = Axes { letters: [b"X", b" Y", b" U", b" V", b" A", b" B"], always: 4 };

impl Shown {
    /// The display for a program with these run settings.
    pub fn of(settings: &RunSettings) -> Shown {
        let by_diameter = settings.by_diameter.unwrap_or(true);
        let across = settings.control.is_lathe().then_some(if by_diameter { 2.0 } else { 1.0 });
        Shown {
            unknown: settings.places_unknown,
            across,
            axes: if settings.control.is_wire() { &WIRE } else { &USUAL },
        }
    }
}

/// A line that is written from its end to its beginning, because digits are produced in this order. No text is copied
/// twice.
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

    fn position(&mut self, to: &[f64; 6], unknown: u8, across: Option<f64>, axes: &Axes) {
        for axis in (axes.always..6).rev() {
            if to[axis] != 0.0 {
                self.word(axes.letters[axis], to[axis]);
            }
        }
        for (axis, letter) in axes.letters[..axes.always].iter().copied().enumerate().rev() {
            match (axis, across) {
                (1, Some(_)) => {}
                _ if unknown & 1 << axis != 0 => {
                    self.byte(b'?');
                    self.text(letter);
                }
                (0, Some(times)) => self.word(letter, to[0] * times),
                _ => self.word(letter, to[axis]),
            }
        }
    }

    /// The axes at a machine position. The axes are written before the position, because the line is written backwards.
    fn in_machine(&mut self, bits: u8, axes: &Axes) {
        self.text(b" in machine coordinates)");
        let named = (0..6).rev().filter(|axis| bits & 1 << axis != 0);
        named.for_each(|axis| self.text(axes.letters[axis].trim_ascii_start()));
        self.text(b"  (");
    }

    /// The line number and the name of the action, before the rest.
    fn head(&mut self, line: u64, what: &[u8]) {
        // the column is padded only if text follows
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
pub fn line(item: &Item, run: &Simulator<'_>, Shown { unknown, across, axes }: Shown, out: &mut Vec<u8>) {
    let hidden = |machine: u8| if unknown { machine } else { 0 };
    let mut text = Backwards::new();
    text.byte(b'\n');
    let what = match &item.action {
        Action::Rapid { to, machine, .. } => {
            if *machine != 0 && !unknown {
                text.in_machine(*machine, axes);
            }
            text.position(to, hidden(*machine), across, axes);
            "rapid"
        }
        Action::Feed { to, feed, lead, machine, home } => {
            if *home != 0 && !unknown {
                text.in_machine(*home, axes);
            }
            match lead {
                Some(lead) => text.word(b" lead ", *lead),
                None => text.word(b" F", *feed),
            }
            text.position(to, hidden(*machine), across, axes);
            "feed"
        }
        Action::Arc(turn) => {
            if turn.turns > 0 {
                text.word(b", whole turns before: ", f64::from(turn.turns));
            }
            text.text(plane_name(turn.plane).as_bytes());
            text.text(b" in ");
            if axes.always == 3 {
                text.word(b" Z", turn.center[2]);
            }
            if across.is_none() {
                text.word(b" Y", turn.center[1]);
            }
            text.word(b"  centre X", turn.center[0] * across.unwrap_or(1.0));
            text.word(b" F", turn.feed);
            text.position(&turn.to, hidden(turn.machine), across, axes);
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
        Action::Orient(angle) => number_line(&mut text, angle.unwrap_or(0.0), "orient"),
        Action::Tool(tool) => match run.state().tool_name(*tool) {
            Some(name) => name_line(&mut text, &escaped(&name), "tool"),
            None => number_line(&mut text, *tool, "tool"),
        },
        Action::Work(value) => number_line(&mut text, *value, "work"),
        Action::Stop(kind) => name_line(&mut text, stop_name(*kind), "stop"),
        Action::Coolant(kind) => name_line(&mut text, kind.name(), "coolant"),
        Action::Units(units) => name_line(&mut text, units.name(), "units"),
        Action::End => "end",
        Action::Comment(start, end) => {
            text.byte(b' ');
            text.head(item.line, b"comment");
            let comment = text_of(run.text().get(*start..*end).unwrap_or_default());
            out.extend_from_slice(&text.bytes[text.at..text.bytes.len() - 1]);
            out.extend_from_slice(escaped(comment.trim()).as_bytes());
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
