//! Straight cuts, which a program may make in parts.

use std::io::{BufRead, Seek};

use super::comparer::Sides;
use super::cut::{ACROSS, ALL, Cut, DEPTH, Place, What, lies_between, number, over, same, shown, turn_as_far};
use super::intended::Expected;
use crate::diag::{Code, Diag};
use crate::toolpath::FeedMode;

impl<R: BufRead + Seek> Sides<R> {
    /// A straight cut, as one or in parts that lie on it.
    pub(super) fn line(&mut self, cut: &Cut, first: &Cut, hole: Option<&Expected>) -> Result<(), Box<Diag>> {
        let end = cut.what.end(&cut.from);
        let mut found = *first;
        let mut parts = 1;
        loop {
            let to = found.what.end(&found.from);
            let is_part = !same(&to, &end, ALL, self.tolerance) && lies_between(&cut.from, &to, &end, self.tolerance);
            if !is_part {
                break;
            }
            self.feeds(&in_parts(cut, &found), &found, hole.is_some_and(|hole| hole.is_tap))?;
            self.program.take();
            let next = self.next()?.filter(|next| {
                matches!(next.what, What::Line { .. })
                    && self.program.way.is_empty()
                    && self.program.stops.is_empty()
                    && lies_between(&to, &next.what.end(&next.from), &end, self.tolerance)
            });
            let Some(next) = next else {
                return self.ends(&cut.from, end, &found, hole);
            };
            found = next;
            parts += 1;
        }
        self.ends(&cut.from, end, &found, hole)?;
        self.feeds(&in_parts(cut, &found), &found, hole.is_some_and(|hole| hole.is_tap))?;
        self.equivalences.parts += u64::from(parts > 1);
        self.program.take();
        Ok(())
    }

    /// Both straight cuts end at one place.
    fn ends(&mut self, from: &Place, end: Place, found: &Cut, hole: Option<&Expected>) -> Result<(), Box<Diag>> {
        let is = found.what.end(&found.from);
        let line = found.line;
        if same(&end, &is, ALL, self.tolerance) {
            if turn_as_far([from, &end], [&found.from, &is]) {
                return Ok(());
            }
            let message = format!("the part turns the other way, or more often, on the way to {}", shown(&end, ALL));
            return self.differs(Code::PV001, line, message, "look at the travel of the rotary axis (`Limits`)");
        }
        if hole.is_some() && same(&end, &is, ACROSS, self.tolerance) {
            // out of the hole at feed, and farther than the job
            if is[DEPTH] > end[DEPTH] && end[DEPTH] > from[DEPTH] {
                self.equivalences.outs += 1;
                return Ok(());
            }
            let message = format!(
                "the hole at {} is cut to Z{}, the job's to Z{}",
                over(&end),
                number(is[DEPTH]),
                number(end[DEPTH])
            );
            return self.differs(Code::PV004, line, message, "print Z[d] at every hole where it changes");
        }
        let message = format!("a cut goes to {}, the job's to {}", shown(&is, 0b111), shown(&end, 0b111));
        self.differs(Code::PV001, line, message, "look at what the form prints for this move")
    }
}

/// The cut as one of its parts must be: in inverse time a part has a part of the time.
fn in_parts(cut: &Cut, part: &Cut) -> Cut {
    let length = |cut: &Cut| {
        let end = cut.what.end(&cut.from);
        (0..6).map(|axis| (end[axis] - cut.from[axis]).powi(2)).sum::<f64>().sqrt()
    };
    let share = length(part) / length(cut);
    match cut.mode {
        FeedMode::InverseTime => Cut { feed: cut.feed.map(|feed| feed / share), ..*cut },
        _ => *cut,
    }
}
