//! Lines, arcs and rapids, with their feeds, cutter compensation and coolant.

use super::convert::{Convert, Done};
use super::records::Record;
use super::tool::coolant;
use super::wrong;
use crate::diag::Code;
use crate::toolpath::{Arc, Axes, Direction, Event, Infeed, Plane, Side};

/// The feed value with which the file marks a rapid.
const RAPID: f64 = -2.0;
/// The feed value of a move that uses the previous feed.
const UNCHANGED: f64 = -1.0;
/// How far the components of a tool axis may differ from those of Z.
const UPRIGHT: f64 = 1e-6;
/// How far the end of an arc may be away from the circle, as a fraction of the radius. Files have six decimals, often in single
/// precision.
const ROUND: f64 = 1e-3;

/// The kind of a move: feed or rapid.
#[derive(Clone, Copy)]
enum Pace {
    Rapid,
    Feed(f64),
}

impl Pace {
    fn feed(self) -> Option<f64> {
        match self {
            Pace::Rapid => None,
            Pace::Feed(feed) => Some(feed),
        }
    }
}

impl Convert<'_, '_> {
    /// The kind of a move, which depends on its feed value.
    fn pace(&mut self, value: f64, record: &Record) -> Done<Pace> {
        if value == RAPID {
            return Ok(Pace::Rapid);
        }
        if value > 0.0 {
            self.feed = Some(value);
        } else if value != UNCHANGED {
            let help = "a number above 0 is a feed per minute, -1 the feed before, -2 a rapid: check that the file \
                is not for a lathe";
            return Err(wrong(Code::PI003, format!("a feed of {value}"), help, record.line));
        }
        match self.feed {
            Some(feed) => Ok(Pace::Feed(feed)),
            None => {
                Err(wrong(Code::PI002, "a cut without a feed", "give the operation a feed in Mastercam", record.line))
            }
        }
    }

    /// How a move changes compensation. `None`: the compensation does not change.
    fn turns(&mut self, value: f64, record: &Record) -> Done<Option<Option<Side>>> {
        let to = match value {
            0.0 => return Ok(None),
            40.0 | 140.0 => None,
            41.0 => Some(Side::Left),
            42.0 => Some(Side::Right),
            value if value >= 1000.0 => {
                let help = "remove the canned text from the operation: its output depends on Mastercam's post";
                let message = format!("canned text {} at a move", (value / 1000.0).trunc());
                return Err(wrong(Code::PI003, message, help, record.line));
            }
            value => {
                let help = "0 is no change, 40 off, 41 left, 42 right";
                return Err(wrong(Code::PI003, format!("compensation {value}"), help, record.line));
            }
        };
        if to == self.side {
            return Ok(None);
        }
        if to.is_some() && self.side.is_some() {
            let help = "switch it off between them";
            return Err(wrong(Code::PI003, "compensation changes from one side to the other", help, record.line));
        }
        self.side = to;
        Ok(Some(to))
    }

    /// Reads the control flag of a move. The sixth digit of the flag is the coolant.
    pub(super) fn flag(&mut self, value: Option<&f64>, record: &Record) -> Done {
        let digit = (value.copied().unwrap_or(0.0).abs() / 100_000.0).trunc() % 10.0;
        if digit < 1.0 {
            return Ok(());
        }
        let now = coolant(digit - 1.0, record.line)?;
        if self.coolant == Some(now) {
            return Ok(());
        }
        self.coolant = Some(now);
        self.push(Event::Coolant(now))
    }

    pub(super) fn line(&mut self, record: &Record) -> Done {
        self.begun(record)?;
        self.end_cycle()?;
        let values = record.values(5)?;
        let turns = self.turns(values[0], record)?;
        self.flag(values.get(5), record)?;
        self.moves([values[1], values[2], values[3]], values[4], turns, record)
    }

    /// Handles a straight move whose tool axis is given by a second point.
    pub(super) fn with_axis(&mut self, record: &Record) -> Done {
        self.begun(record)?;
        self.end_cycle()?;
        let values = record.values(7)?;
        let axis = [values[3] - values[0], values[4] - values[1], values[5] - values[2]];
        let length = axis.iter().map(|part| part * part).sum::<f64>().sqrt();
        if length == 0.0 || (axis[2] / length - 1.0).abs() > UPRIGHT {
            let help = "a job has three axes: write the operation with the tool along Z";
            return Err(wrong(Code::PI003, "a motion with a tilted tool (record 11)", help, record.line));
        }
        self.flag(values.get(8), record)?;
        self.moves([values[0], values[1], values[2]], values[6], None, record)
    }

    fn moves(&mut self, to: [f64; 3], pace: f64, turns: Option<Option<Side>>, record: &Record) -> Done {
        let pace = self.pace(pace, record)?;
        let is_cut = matches!(pace, Pace::Feed(_));
        if is_cut && self.position.is_none() {
            let help = "begin the operation with a rapid";
            return Err(wrong(Code::PI003, "the first motion after a tool change is a cut", help, record.line));
        }
        self.position = Some(to);
        let to = Axes::new(&to);
        match (turns, pace) {
            (None, Pace::Rapid) => self.push(Event::Rapid(to)),
            (None, Pace::Feed(feed)) => self.push(Event::Line { to, feed: Some(feed) }),
            (Some(Some(side)), pace) => {
                let infeed = Infeed { to, side, rapid: !is_cut };
                self.push(Event::Infeed { infeed: &infeed, feed: pace.feed() })
            }
            (Some(None), pace) => self.push(Event::Outfeed { to, feed: pace.feed(), rapid: !is_cut }),
        }
    }

    pub(super) fn arc(&mut self, record: &Record) -> Done {
        self.begun(record)?;
        self.end_cycle()?;
        let values = record.values(8)?;
        let plane = match values[0] {
            0.0 => Plane::Xy,
            1.0 => Plane::Yz,
            2.0 => {
                let help = "let the operation write lines here: the direction of such an arc is not certain";
                return Err(wrong(Code::PI003, "an arc in the XZ plane", help, record.line));
            }
            value => {
                let help = "0 is XY, 1 YZ, 2 XZ";
                return Err(wrong(Code::PI003, format!("an arc in plane {value}"), help, record.line));
            }
        };
        if self.turns(values[1], record)?.is_some() {
            let help = "switch compensation by a straight move: give the contour a lead in line";
            return Err(wrong(Code::PI003, "compensation is switched on an arc", help, record.line));
        }
        let Some(from) = self.position else {
            let help = "begin the operation with a rapid";
            return Err(wrong(Code::PI003, "the first motion after a tool change is an arc", help, record.line));
        };
        let Pace::Feed(feed) = self.pace(values[7], record)? else {
            return Err(wrong(Code::PI003, "an arc at the rapid rate", "give it a feed", record.line));
        };
        self.flag(values.get(8), record)?;
        let ([first, second], across) = plane.axes();
        let (mut to, mut center) = ([0.0; 3], Axes::default());
        (to[first], to[second], to[across]) = (values[2], values[3], values[6]);
        center.set(first, values[4]);
        center.set(second, values[5]);
        let radius = |point: &[f64; 3]| (point[first] - values[4]).hypot(point[second] - values[5]);
        let (begin, end) = (radius(&from), radius(&to));
        if (begin - end).abs() > ROUND * begin.max(end) || begin == 0.0 {
            let message = format!("the start of an arc is {begin:.4} from its centre, its end {end:.4}");
            return Err(wrong(
                Code::PI001,
                message,
                "the file may be from another version of Mastercam: please send it to us",
                record.line,
            ));
        }
        let closes = to[first] == from[first] && to[second] == from[second];
        let is_full = values.get(9).is_some_and(|full| *full != 0.0);
        if closes != is_full && (closes || values.len() > 9) {
            let help = "a full circle must end where it begins, and its tenth value must not be 0";
            return Err(wrong(Code::PI001, "an arc that is not clearly a full circle", help, record.line));
        }
        let direction = if record.code == 2 { Direction::Cw } else { Direction::Ccw };
        let arc = Arc { to: Axes::new(&to), center: Some(center), radius: None, direction, plane, turns: 0 };
        self.position = Some(to);
        self.push(Event::Arc { arc: &arc, feed: Some(feed) })
    }
}
