//! Holes in pecks: a control's cycle may make other pecks than the job, and the same hole.

use std::io::{BufRead, Seek};

use super::comparer::Sides;
use super::cut::{ACROSS, ALL, Cut, DEPTH, What, number, over, same, same_dwell};
use super::intended::Expected;
use crate::diag::{Code, Diag};

/// How much longer a control's pecks may be than the job's.
const MOST: f64 = 1.5;

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
        let (mut strokes, mut longest, mut out) = (0, 0.0f64, true);
        while let Some(found) = self.next()? {
            // at the bottom, what is not of the same block's cycle is another hole, or another item of the job
            let same_block = found.by_cycle && found.line == line;
            let feeds_down = found.what.end(&found.from)[DEPTH] < found.from[DEPTH];
            let again = count > 0 && deepest <= hole.bottom + tolerance && feeds_down && !same_block;
            if count > 0 && (!self.stays_in(hole, &found) || again) {
                break;
            }
            line = found.line;
            let wanted = pecks.get(count);
            identical &= wanted.is_some_and(|wanted| is_same(wanted, &found, tolerance));
            count += 1;
            // a rapid in the hole stays where it was cut
            let heights = || self.program.way.iter().map(|rapid| rapid.to[DEPTH]);
            let lowest = heights().fold(f64::INFINITY, f64::min);
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
                    if strokes > 0 && to[DEPTH] < deepest - tolerance {
                        out &= heights().any(|height| height >= hole.plane - tolerance);
                    }
                    let first = pecks[0];
                    if pecks.iter().all(|peck| peck.feed == first.feed || !peck.what.feeds()) {
                        self.feeds(&first, &found, hole.is_tap)?;
                    }
                    if to[DEPTH] < deepest {
                        strokes += 1;
                        longest = longest.max(deepest - to[DEPTH]);
                        dwell = 0.0;
                        deepest = to[DEPTH];
                    }
                }
            }
            self.program.take();
        }
        self.check_pecks(&pecks, hole, [strokes as f64, longest], out, line)?;
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
        if !same_dwell(wanted, dwell) {
            let message = format!("the dwell at the bottom is {} s, the job's {} s", number(dwell), number(wanted));
            return self.differs(Code::PV010, line, message, "print P[dwell] in the cycle");
        }
        identical &= count == pecks.len();
        self.equivalences.pecks += u64::from(!identical);
        pecks.clear();
        self.pecks = pecks;
        Ok(())
    }

    /// Other pecks are as good, but pecks they must be, out of the hole between them where the job's are.
    fn check_pecks(
        &mut self,
        pecks: &[Cut],
        hole: &Expected,
        [strokes, longest]: [f64; 2],
        out: bool,
        line: u64,
    ) -> Result<(), Box<Diag>> {
        let mut deepest = hole.plane;
        let (mut wanted, mut wanted_longest) = (0.0, 0.0f64);
        for peck in pecks {
            let to = peck.what.end(&peck.from)[DEPTH];
            if to < deepest {
                wanted += 1.0;
                wanted_longest = wanted_longest.max(deepest - to);
                deepest = to;
            }
        }
        let help = "print Q[vbite] with G83 or G73, as the job's kind is";
        if wanted > 1.0 && (strokes < 2.0 || longest > MOST * wanted_longest) {
            let message = format!(
                "the hole at {} is cut {} at once, the job pecks by {}",
                over(&hole.at),
                number(longest),
                number(wanted_longest)
            );
            return self.differs(Code::PV023, line, message, help);
        }
        if wanted > 1.0 && hole.retracts && !out {
            let message =
                format!("between pecks the tool stays in the hole at {}, the job brings it out", over(&hole.at));
            return self.differs(Code::PV023, line, message, help);
        }
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
