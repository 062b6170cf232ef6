//! Actions as lines of text.

use postform::internals::nc::{Action, Item, RunSettings, Simulator, Turn, plane_name, stop_name, turn_name};
use postform::internals::number::{Digits, Lead, LetterFormat, Point, Printing, Sign, quantise};
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
    numbers: Printing,
}

/// Axes of a machine.
#[derive(Debug)]
struct Axes {
    /// The letters of the axes, in the order of a position.
    letters: &'static [u8; 6],
    /// Number of leading axes that are always shown; the others are shown only if they are not 0.
    always: usize,
}

const USUAL: Axes = Axes { letters: b"XYZABC", always: 3 };
/// X Y of the lower guide, U V of the upper guide.
const WIRE: Axes = Axes { letters: b"XYUVAB", always: 4 };

/// Numbers in the text: up to five decimals, and a point only before a fraction.
const NUMBERS: LetterFormat = LetterFormat {
    sign: Sign::Minus,
    int: Digits { count: 13, fixed: false },
    point: Point::BeforeFraction,
    dec: Digits { count: DECIMALS, fixed: false },
};
const DECIMALS: u8 = 5;

impl Shown {
    /// The display for a program with these run settings.
    pub fn of(settings: &RunSettings) -> Shown {
        let by_diameter = settings.by_diameter.unwrap_or(true);
        let across = settings.control.is_lathe().then_some(if by_diameter { 2.0 } else { 1.0 });
        Shown {
            unknown: settings.places_unknown,
            across,
            axes: if settings.control.is_wire() { &WIRE } else { &USUAL },
            numbers: Printing::new(NUMBERS),
        }
    }
}

/// The text of one action, which is appended to the output.
struct Line<'a> {
    out: &'a mut Vec<u8>,
    shown: &'a Shown,
}

impl Line<'_> {
    fn text(&mut self, text: &[u8]) {
        self.out.extend_from_slice(text);
    }

    /// The line number, which ends at the sixth column or further to the right, and the name of the action. The name
    /// of an action with values is followed by blanks up to the column of the values.
    fn head(&mut self, line: u64, what: &str, has_values: bool) {
        let mut digits = [b' '; 20];
        let (mut rest, mut at) = (line, digits.len());
        while rest > 0 || at == digits.len() {
            at -= 1;
            digits[at] = b'0' + (rest % 10) as u8;
            rest /= 10;
        }
        self.text(&digits[at.min(digits.len() - 6)..]);
        self.text(b"  ");
        self.text(what.as_bytes());
        if has_values {
            self.text(&b"        "[what.len()..]);
        }
    }

    /// Text and a number.
    fn number(&mut self, before: &str, value: f64) {
        self.text(before.as_bytes());
        self.word(Lead::default(), value);
    }

    #[inline]
    fn word(&mut self, lead: Lead, value: f64) {
        let units = quantise(value, DECIMALS);
        if units.is_none_or(|units| self.shown.numbers.write(self.out, lead, units, true).is_err()) {
            lead.write(self.out);
            self.text(format!("{value:e}").as_bytes());
        }
    }

    fn position(&mut self, to: &[f64; 6], machine: u8) {
        let Shown { unknown, across, axes, .. } = *self.shown;
        for (axis, letter) in axes.letters.iter().copied().enumerate() {
            let is_left_out = if axis < axes.always { axis == 1 && across.is_some() } else { to[axis] == 0.0 };
            if is_left_out {
                continue;
            }
            let mut lead = Lead::default();
            if axis > 0 {
                lead.push(b' ');
            }
            lead.push(letter);
            if unknown && machine & 1 << axis != 0 && axis < axes.always {
                lead.write(self.out);
                self.text(b"?");
            } else {
                self.word(lead, if axis == 0 { to[0] * across.unwrap_or(1.0) } else { to[axis] });
            }
        }
    }

    /// The axes at a machine position, unless unknown positions are shown as `?`.
    fn in_machine(&mut self, bits: u8) {
        if bits != 0 && !self.shown.unknown {
            self.text(b"  (");
            let letters = self.shown.axes.letters;
            self.out.extend((0..6).filter(|axis| bits & 1 << axis != 0).map(|axis| letters[axis]));
            self.text(b" in machine coordinates)");
        }
    }

    fn arc(&mut self, turn: &Turn) {
        let Shown { across, axes, .. } = *self.shown;
        self.position(&turn.to, turn.machine);
        self.number(" F", turn.feed);
        self.number("  centre X", turn.center[0] * across.unwrap_or(1.0));
        if across.is_none() {
            self.number(" Y", turn.center[1]);
        }
        if axes.always == 3 {
            self.number(" Z", turn.center[2]);
        }
        self.text(b" in ");
        self.text(plane_name(turn.plane).as_bytes());
        if turn.turns > 0 {
            self.number(", whole turns before: ", f64::from(turn.turns));
        }
    }
}

/// The name of an action in the text. `None`: the text does not show actions of this kind.
fn name_of(action: &Action) -> Option<&'static str> {
    Some(match action {
        Action::Rapid { .. } => "rapid",
        Action::Feed { .. } => "feed",
        Action::Arc(turn) => turn_name(turn.direction),
        Action::Dwell(_) => "dwell",
        Action::Spindle(..) => "spindle",
        Action::Orient(_) => "orient",
        Action::Tool(_) => "tool",
        Action::Work(_) => "work",
        Action::Stop(_) => "stop",
        Action::Coolant(_) => "coolant",
        Action::Units(_) => "units",
        Action::End => "end",
        Action::Comment(..) => "comment",
        _ => return None,
    })
}

/// Appends one action as a line of text.
pub fn line(item: &Item, run: &Simulator<'_>, shown: &Shown, out: &mut Vec<u8>) {
    let Some(what) = name_of(&item.action) else { return };
    let mut text = Line { out, shown };
    text.head(item.line, what, !matches!(item.action, Action::End));
    match &item.action {
        Action::Rapid { to, machine, .. } => {
            text.position(to, *machine);
            text.in_machine(*machine);
        }
        Action::Feed { to, feed, lead, machine, home } => {
            text.position(to, *machine);
            match lead {
                Some(lead) => text.number(" lead ", *lead),
                None => text.number(" F", *feed),
            }
            text.in_machine(*home);
        }
        Action::Arc(turn) => text.arc(turn),
        Action::Dwell(seconds) => {
            text.number("", *seconds);
            text.text(b" s");
        }
        Action::Spindle(rotation, speed) => {
            text.text(rotation.name().as_bytes());
            text.number(" S", *speed);
        }
        Action::Orient(angle) => text.number("", angle.unwrap_or(0.0)),
        Action::Tool(tool) => match run.state().tool_name(*tool) {
            Some(name) => text.text(escaped(&name).as_bytes()),
            None => text.number("", *tool),
        },
        Action::Work(value) => text.number("", *value),
        Action::Stop(kind) => text.text(stop_name(*kind).as_bytes()),
        Action::Coolant(kind) => text.text(kind.name().as_bytes()),
        Action::Units(units) => text.text(units.name().as_bytes()),
        Action::Comment(start, end) => {
            text.text(b" ");
            let comment = text_of(run.text().get(*start..*end).unwrap_or_default());
            text.text(escaped(comment.trim()).as_bytes());
        }
        _ => {}
    }
    text.text(b"\n");
}
