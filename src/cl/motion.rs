//! Motions: GOTO, GODLTA, FROM, RAPID, the tool axis, shifts.

use super::arcs::Heading;
use super::reader::{Done, Reader, Waiting, fault};
use super::words::Word;
use crate::diag::Code;
use crate::toolpath::{Axes, Event, Infeed};

/// Components of a unit vector that differ by less are one.
const SAME: f64 = 1e-6;

impl Reader<'_> {
    /// GOTO/x,y,z[,i,j,k][,feed].
    #[inline]
    pub(super) fn goto(&mut self, values: &[f64]) -> Done {
        let (tail, feed) = match values.len() {
            3 => (None, None),
            4 => (None, Some(values[3])),
            6 => (Some(&values[3..6]), None),
            7 => (Some(&values[3..6]), Some(values[6])),
            count => {
                let help = "write x, y, z, then the tool axis i, j, k or the feed";
                return fault(Code::PL001, format!("GOTO with {count} numbers"), help);
            }
        };
        if let Some(axis) = tail {
            self.set_axis([axis[0], axis[1], axis[2]])?;
        }
        if let Some(feed) = feed {
            self.feed_on_goto(feed)?;
        }
        let mut to = [0.0; 3];
        for (i, value) in to.iter_mut().enumerate() {
            *value = values[i] + self.offset[i];
        }
        self.go(to)
    }

    pub(super) fn goto_words(&mut self, words: &[Word]) -> Done {
        match numbers(words) {
            Some(values) => self.goto(&values),
            None => {
                fault(Code::PL001, "GOTO takes numbers alone", "write x, y, z, then the tool axis i, j, k or the feed")
            }
        }
    }

    /// Goes to a position, by what is in force.
    #[inline]
    pub(super) fn go(&mut self, to: [f64; 3]) -> Done {
        let rapid = std::mem::take(&mut self.rapid) | std::mem::take(&mut self.rapid_after_cycle);
        self.point = Some(to);
        self.spindle_is_new = false;
        if let Some(arc) = self.arc.take() {
            return self.arc_to(&arc, to, rapid);
        }
        if self.cycle.is_active() && !rapid {
            return self.point(to);
        }
        if self.cycle.is_active() {
            self.close_holes()?;
        }
        let axes = Axes::new(&to);
        self.turn_heading(to);
        self.position = Some(to);
        if self.compensation.is_some() {
            return self.compensate(axes, rapid);
        }
        if rapid {
            // a tool's spindle may come after its first rapids
            if self.change.is_some() && self.spindle.speed.is_none() {
                return self.wait(Waiting::Rapid(axes));
            }
            return self.push(Event::Rapid(axes));
        }
        let feed = self.feed_to_say()?;
        self.push(Event::Line { to: axes, feed })
    }

    /// The heading after a straight motion, for arcs that do not say which way they turn.
    fn turn_heading(&mut self, to: [f64; 3]) {
        if self.report.dialect.and_then(super::Dialect::sense).is_none() {
            self.heading = self.position.and_then(|from| Heading::between(from, to)).or(self.heading);
        }
    }

    /// The motion that turns cutter compensation on or off.
    fn compensate(&mut self, to: Axes, rapid: bool) -> Done {
        let feed = if rapid { self.feed_to_say().ok().flatten() } else { self.feed_to_say()? };
        match self.compensation.take().flatten() {
            Some(side) => self.push(Event::Infeed { infeed: &Infeed { to, side, rapid }, feed }),
            None => self.push(Event::Outfeed { to, feed, rapid }),
        }
    }

    pub(super) fn godlta(&mut self, words: &[Word]) -> Done {
        let Some(from) = self.point else {
            return fault(Code::PL001, "GODLTA from an unknown position", "begin with a GOTO or FROM");
        };
        let values = numbers(words).unwrap_or_default();
        let delta = match values.as_slice() {
            [along] => self.axis.map(|component| component * along),
            [x, y, z] => [*x, *y, *z],
            [x, y, z, feed] => {
                self.feed_on_goto(*feed)?;
                [*x, *y, *z]
            }
            _ => return fault(Code::PL001, "GODLTA takes one, three or four numbers", "write dx, dy, dz"),
        };
        self.go([from[0] + delta[0], from[1] + delta[1], from[2] + delta[2]])
    }

    /// Where the tool is to begin with: no motion.
    pub(super) fn from(&mut self, words: &[Word]) -> Done {
        if self.cycle.is_active() {
            self.warn(Code::PC058, "FROM inside a cycle", "take it out, or end the cycle before");
        }
        match numbers(words).as_deref() {
            Some([x, y, z, axis @ ..]) => {
                if let [i, j, k, ..] = axis {
                    self.set_axis([*i, *j, *k])?;
                }
                self.position = Some([x + self.offset[0], y + self.offset[1], z + self.offset[2]]);
                self.point = self.position;
                Ok(())
            }
            _ => fault(Code::PL001, "FROM takes a position", "write x, y, z"),
        }
    }

    /// RAPID holds for one motion, which may stand in the same statement.
    pub(super) fn rapid(&mut self, words: &[Word]) -> Done {
        self.rapid = true;
        match words {
            [] => Ok(()),
            [Word::Name(goto), rest @ ..] if goto == "GOTO" => self.goto_words(rest),
            [word, ..] => fault(Code::PL002, format!("RAPID does not know `{word}`"), "write RAPID alone"),
        }
    }

    /// A tool axis other than the one so far is told, so that a machine that can't tilt refuses it.
    #[inline]
    pub(super) fn set_axis(&mut self, axis: [f64; 3]) -> Done {
        if axis == self.axis {
            return Ok(());
        }
        let length = axis.iter().map(|c| c * c).sum::<f64>().sqrt();
        if length < SAME {
            return fault(Code::PL001, "a tool axis without direction", "give i, j, k of a unit vector");
        }
        let unit = axis.map(|c| c / length);
        if unit.iter().zip(self.axis).all(|(a, b)| (a - b).abs() < SAME) {
            return Ok(());
        }
        self.axis = unit;
        self.close_holes()?;
        self.push(Event::Tilt(unit))
    }

    /// In files for three axes TLAXIS is information; elsewhere motions follow it.
    pub(super) fn tlaxis(&mut self, words: &[Word]) -> Done {
        match numbers(words).as_deref() {
            Some([i, j, k]) => self.set_axis([*i, *j, *k]),
            _ => fault(Code::PL001, "TLAXIS takes a vector", "write i, j, k"),
        }
    }

    /// TRANS adds to all positions, ORIGIN takes away.
    pub(super) fn shift(&mut self, words: &[Word], origin: bool) -> Done {
        match numbers(words).as_deref() {
            Some([x, y, z]) => {
                *(if origin { &mut self.origin } else { &mut self.trans }) = [*x, *y, *z];
                self.offset = [0, 1, 2].map(|axis| self.trans[axis] - self.origin[axis]);
                Ok(())
            }
            _ => fault(Code::PL001, "a shift takes three numbers", "write x, y, z"),
        }
    }
}

/// Words that are all numbers.
pub(super) fn numbers(words: &[Word]) -> Option<Vec<f64>> {
    words.iter().map(Word::number).collect()
}
