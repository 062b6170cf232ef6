//! Canned cycles. Record 81 begins a cycle with its first hole, and each record 100 is another hole.

use super::records::Record;
use super::wrong;
use crate::diag::{Code, Diag};
use crate::toolpath::{Axes, CycleKind, CycleSpec, Hole};

/// Tolerance for the distance between a hole's bottom and its upper point, measured across the tool.
const STRAIGHT: f64 = 1e-6;

/// A hole with the data of its cycle. Heights are absolute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drilling {
    kind: CycleKind,
    /// Position in X and Y.
    pub at: [f64; 2],
    bottom: f64,
    /// Height of the tool before and after the hole.
    pub initial: f64,
    /// Height where the feed begins.
    r: f64,
    /// Top of the stock.
    top: f64,
    dwell: f64,
    /// The feed. If the feed is 0 or less, the previous feed stays active.
    pub feed: f64,
    first_peck: f64,
    peck: f64,
    /// The values between the pecks and the heights: probably the peck clearance and the retract after a chip.
    between: [f64; 2],
    /// The control flag, if the hole has one.
    pub flag: Option<f64>,
}

/// The open cycle, represented by its last hole.
pub struct Open(pub Drilling);

impl Open {
    /// Reads another hole of the cycle (record 100).
    ///
    /// # Errors
    /// A value is missing or invalid.
    pub fn next(&self, record: &Record) -> Result<Drilling, Box<Diag>> {
        let values = record.values(11)?;
        let (lower, upper) = ends(&values[1..4], &values[8..11], values.get(12), record)?;
        let (initial, r, dwell, feed) = (values[4], values[5], values[6], values[7]);
        let own = Drilling {
            at: [lower[0], lower[1]],
            bottom: lower[2],
            initial,
            r,
            dwell,
            feed,
            flag: values.get(11).copied(),
            ..self.0
        };
        own.checked(upper, record)
    }

    /// Whether a hole belongs to the open cycle. The depths of the holes may differ.
    pub fn takes(&self, hole: &Drilling) -> bool {
        let without = |hole: &Drilling| Drilling { at: [0.0; 2], bottom: 0.0, flag: None, ..*hole };
        let feed = if hole.feed > 0.0 { hole.feed } else { self.0.feed };
        without(&self.0) == without(&Drilling { feed, ..*hole })
    }
}

impl Drilling {
    /// Reads the first hole of a cycle (record 81).
    ///
    /// # Errors
    /// A value is missing or invalid, or belongs to a cycle that is not supported.
    pub fn read(record: &Record) -> Result<Drilling, Box<Diag>> {
        let values = record.values(17)?;
        let kind = match values[0] {
            0.0 if values[4] > 0.0 => CycleKind::Face,
            0.0 => CycleKind::Drill,
            1.0 => CycleKind::Deep,
            2.0 => CycleKind::Chipbreak,
            3.0 => CycleKind::Tap,
            4.0 => CycleKind::Ream,
            5.0 => CycleKind::Bore,
            other => {
                let help = "only 0 to 5 (drill, peck, chip break, tap, ream, bore) are supported; let Mastercam \
                    write long code";
                return Err(wrong(Code::PI003, format!("a cycle of type {other}"), help, record.line));
            }
        };
        if values[13] != 0.0 && kind == CycleKind::Bore {
            let help = "let Mastercam write long code";
            return Err(wrong(Code::PI003, "a bore whose tool shifts", help, record.line));
        }
        let (lower, upper) = ends(&values[1..4], &values[14..17], values.get(18), record)?;
        let drilling = Drilling {
            kind,
            at: [lower[0], lower[1]],
            bottom: lower[2],
            initial: values[10],
            r: values[11],
            top: values[12],
            dwell: values[4],
            feed: values[5],
            first_peck: values[6],
            peck: values[7],
            between: [values[8], values[9]],
            flag: values.get(17).copied(),
        };
        drilling.checked(upper, record)
    }

    /// Checks the order of the heights.
    fn checked(self, upper: [f64; 3], record: &Record) -> Result<Drilling, Box<Diag>> {
        let is_right = self.bottom < self.top && self.top <= self.r && self.r <= self.initial;
        if !is_right || (upper[2] - self.initial).abs() > STRAIGHT {
            let message = format!(
                "the heights of a hole are not in descending order: {}, {}, {}, {}",
                self.initial, self.r, self.top, self.bottom
            );
            let help = "the order is initial height, R plane, top of the stock, bottom";
            return Err(wrong(Code::PI001, message, help, record.line));
        }
        Ok(self)
    }

    /// The cycle that begins with this hole. `feed` is the active feed before the cycle.
    ///
    /// # Errors
    /// The feed or the peck is missing.
    pub fn spec(&self, feed: Option<f64>, record: &Record) -> Result<CycleSpec, Box<Diag>> {
        let mut spec = CycleSpec::new(self.kind);
        let Some(feed) = Some(self.feed).filter(|feed| *feed > 0.0).or(feed) else {
            return Err(wrong(
                Code::PI002,
                "a cycle without a feed",
                "give the operation a feed in Mastercam",
                record.line,
            ));
        };
        spec.feed = Some(feed);
        spec.clear = Some(self.r - self.top);
        spec.depth = Some(self.top - self.bottom);
        spec.return_height = Some(self.initial - self.top);
        spec.dwell = (self.dwell > 0.0).then_some(self.dwell);
        if matches!(self.kind, CycleKind::Deep | CycleKind::Chipbreak) {
            let step = if self.peck > 0.0 { self.peck } else { self.first_peck };
            if step <= 0.0 {
                return Err(wrong(Code::PI002, "a cycle with pecks of 0", "give the operation its pecks", record.line));
            }
            spec.step = Some(step);
            spec.first_step = Some(self.first_peck).filter(|first| *first > 0.0 && *first != step);
        }
        Ok(spec)
    }

    /// A message if the cycle has a value that is not read, because no public document gives its meaning.
    pub fn unread(&self) -> Option<String> {
        let (place, value, meaning) = match self.kind {
            CycleKind::Deep => (9, self.between[0], "the peck clearance"),
            CycleKind::Chipbreak => (10, self.between[1], "the retract after a chip"),
            _ => return None,
        };
        (value != 0.0).then(|| format!("value {place} of record 81, probably {meaning}, is ignored: it is {value}"))
    }

    /// The hole as an event.
    pub fn hole(&self) -> Hole {
        Hole { at: Axes::new(&[self.at[0], self.at[1], self.top]), depth: Some(self.top - self.bottom) }
    }
}

/// The bottom and the upper point of a hole. The hole must be parallel to Z.
fn ends(
    lower: &[f64],
    upper: &[f64],
    swapped: Option<&f64>,
    record: &Record,
) -> Result<([f64; 3], [f64; 3]), Box<Diag>> {
    let [lower, upper] = [lower, upper].map(|point| [point[0], point[1], point[2]]);
    let (lower, upper) = if swapped.is_some_and(|swapped| *swapped == 1.0) { (upper, lower) } else { (lower, upper) };
    if (lower[0] - upper[0]).abs() > STRAIGHT || (lower[1] - upper[1]).abs() > STRAIGHT || lower[2] >= upper[2] {
        let help = "a job has three axes: drill along Z";
        return Err(wrong(Code::PI003, "a hole that is not along Z", help, record.line));
    }
    Ok((lower, upper))
}
