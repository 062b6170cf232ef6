//! Holes in pecks: a control's cycle may make other pecks than the job, and the same hole.

use std::io::{BufRead, Seek};

use super::comparer::Sides;
use super::cut::{ACROSS, ALL, Cut, DEPTH, What, number, over, same};
use super::intended::Expected;
use crate::diag::{Code, Diag};

impl<R: BufRead + Seek> Sides<R> {
    /// The program's cuts in this hole, of which the first was met already.
    pub(super) fn compare_pecks(&mut self, hole: &Expected) -> Result<(), Box<Diag>> {
        let tolerance = self.tolerance;
        let mut pecks = std::mem::take(&mut self.pecks);
        let mut deepest = hole.plane;
        let mut dwell = 0.0;
        let mut identical = true;
        let mut count = 0;
        let mut line = 0;
        while let Some(found) = self.next()? {
            if count > 0 && !self.stays_in(hole, &found) {
                break;
            }
            line = found.line;
            let wanted = pecks.get(count);
            identical &= wanted.is_some_and(|wanted| is_same(wanted, &found, tolerance));
            count += 1;
            // a rapid in the hole stays where it was cut
            let lowest = self.program.way.iter().map(|rapid| rapid.to[DEPTH]).fold(f64::INFINITY, f64::min);
            if count > 1 && lowest < deepest - tolerance {
                let message = format!(
                    "a rapid goes to Z{} in the hole at {}, cut to Z{} so far",
                    number(lowest),
                    over(&hole.at),
                    number(deepest)
                );
                return self.differs(Code::PV009, line, message, "look at the clearance of the pecks");
            }
            match found.what {
                What::Dwell(seconds) => dwell = seconds,
                What::Arc(_) => break,
                What::Line { to } => {
                    let again = deepest <= hole.bottom + tolerance && found.from[DEPTH] >= hole.plane - tolerance;
                    if count > 1 && again && to[DEPTH] < found.from[DEPTH] {
                        let message = format!("the hole at {} is drilled twice", over(&hole.at));
                        return self.differs(
                            Code::PV003,
                            line,
                            message,
                            "look for a second position line in the cycle",
                        );
                    }
                    let first = pecks.first().copied();
                    if let Some(first) = first.filter(|_| pecks.iter().all(|peck| peck.feed == pecks[0].feed)) {
                        self.feeds(&first, &found)?;
                    }
                    if to[DEPTH] < deepest {
                        dwell = 0.0;
                        deepest = to[DEPTH];
                    }
                }
            }
            self.advance(&found);
        }
        let bottom = deepest;
        if (bottom - hole.bottom).abs() > tolerance {
            let message = format!(
                "the hole at {} is cut to Z{}, the job's to Z{}",
                over(&hole.at),
                number(bottom),
                number(hole.bottom)
            );
            return self.differs(Code::PV004, line, message, "print Z[d] at every hole where it changes");
        }
        let wanted = hole.dwell.unwrap_or(0.0);
        if (wanted - dwell).abs() > (0.01 * wanted).max(0.001) {
            let message = format!("the dwell at the bottom is {} s, the job's {} s", number(dwell), number(wanted));
            return self.differs(Code::PV010, line, message, "print P[dwell] in the cycle");
        }
        identical &= count == pecks.len();
        self.equivalences.pecks += u64::from(!identical);
        pecks.clear();
        self.pecks = pecks;
        Ok(())
    }

    /// Is the program's next cut in this hole too?
    fn stays_in(&self, hole: &Expected, found: &Cut) -> bool {
        let here = |place: &_| same(&hole.at, place, ACROSS, self.tolerance);
        let end = found.what.end(&found.from);
        // behind a change of tool it is another hole at this place
        self.program.before.is_none()
            && here(&found.from)
            && here(&end)
            && self.program.way.iter().all(|rapid| rapid.unknown == 0 && here(&rapid.to))
    }
}

fn is_same(wanted: &Cut, found: &Cut, tolerance: f64) -> bool {
    let ends = |cut: &Cut| cut.what.end(&cut.from);
    same(&wanted.from, &found.from, ALL, tolerance)
        && same(&ends(wanted), &ends(found), ALL, tolerance)
        && matches!(wanted.what, What::Dwell(_)) == matches!(found.what, What::Dwell(_))
}
