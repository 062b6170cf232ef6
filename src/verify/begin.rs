//! Where a cut begins: the program has one, of the same kind, from the same place.

use std::io::{BufRead, Seek};

use super::comparer::Sides;
use super::cut::{ACROSS, ALL, Cut, DEPTH, Rapid, What, number, over, same, shown};
use super::intended::Expected;
use crate::diag::{Code, Diag};

impl<R: BufRead + Seek> Sides<R> {
    /// The program's next cut, whose way, beginning and state are as they must be.
    pub fn meet(&mut self, cut: &Cut, hole: Option<&Expected>) -> Result<Cut, Box<Diag>> {
        while self.next()?.is_some_and(|found| self.enters_again(cut, &found)) {
            self.equivalences.entries += 1;
            self.program.take();
        }
        let Some(found) = self.next()? else {
            return match hole {
                Some(hole) => {
                    let message = format!("the hole at {} is not drilled: the program is over", over(&hole.at));
                    self.differs(Code::PV002, 0, message, "look at the cycle, and at what ends it")
                }
                None => {
                    let end = cut.what.end(&cut.from);
                    let to = shown(&end, 0b111);
                    let tolerance = self.tolerance;
                    let by_rapid = |rapid: &Rapid| rapid.unknown == 0 && same(&rapid.to, &end, ALL, tolerance);
                    if cut.what.feeds() && self.program.way.iter().any(by_rapid) {
                        let message = format!("a rapid goes to {to}, where the job cuts");
                        return self.differs(Code::PV007, 0, message, "print the feed code (G1) for this move");
                    }
                    let message = format!("the program is over, and the cut to {to} is missing");
                    self.differs(Code::PV017, 0, message, "look at what the form prints for this move")
                }
            };
        };
        self.kinds(cut, &found)?;
        self.begins(cut, &found, hole)?;
        self.compare_ways(found.line)?;
        self.states(cut, &found, hole.is_some_and(|hole| hole.is_tap))?;
        Ok(found)
    }

    /// After the tool was taken out, as to unwind an axis: straight down again to where the cut goes on.
    fn enters_again(&mut self, cut: &Cut, found: &Cut) -> bool {
        let What::Line { to } = found.what else { return false };
        let here = self.start.is_some_and(|start| same(&start.to, &cut.from, ALL, self.tolerance))
            || self.program.way.iter().any(|rapid| rapid.unknown & 1 << DEPTH != 0);
        let height_known = found.unknown & 1 << DEPTH == 0;
        if !here || found.unknown & ACROSS != 0 || !same(&cut.from, &to, ALL, self.tolerance) {
            return false;
        }
        let [_, program] = &mut self.ways;
        program.set(Some(self.program.start()), &self.program.way, self.tolerance);
        let above = !height_known || found.from[DEPTH] > to[DEPTH];
        same(&found.from, &to, ACROSS, self.tolerance) && above && program.stays_above(to[DEPTH])
    }

    fn kinds(&mut self, cut: &Cut, found: &Cut) -> Result<(), Box<Diag>> {
        let help = "look at the dwell of the cycle or block";
        match (cut.what, found.what) {
            (What::Dwell(seconds), What::Line { .. } | What::Arc(_)) => {
                let message = format!("the dwell of {} s is missing", number(seconds));
                self.differs(Code::PV010, found.line, message, help)
            }
            (What::Line { .. } | What::Arc(_), What::Dwell(seconds)) => {
                let message = format!("a dwell of {} s that the job does not have", number(seconds));
                self.differs(Code::PV010, found.line, message, help)
            }
            _ => Ok(()),
        }
    }

    /// Both cuts begin at one place.
    fn begins(&mut self, cut: &Cut, found: &Cut, hole: Option<&Expected>) -> Result<(), Box<Diag>> {
        let tolerance = self.tolerance;
        let unknown = found.unknown & !cut.unknown & ALL;
        if unknown == 0 && same(&cut.from, &found.from, ALL, tolerance) {
            return Ok(());
        }
        let end = cut.what.end(&cut.from);
        let angles = (3..6).filter(|&axis| cut.from[axis] != found.from[axis]).map(|axis| 1 << axis).sum::<u8>();
        let (wanted, is) = (shown(&cut.from, 0b111 | angles), shown(&found.from, 0b111 | angles));
        let line = found.line;
        // the rapid went where the cut goes
        let cuts_by_rapid = |rapid: &Rapid| rapid.unknown == 0 && same(&rapid.to, &end, ALL, tolerance);
        if cut.what.feeds() && self.program.way.iter().any(cuts_by_rapid) && !same(&end, &cut.from, ALL, tolerance) {
            let message = format!("a rapid goes to {}, where the job cuts", shown(&end, 0b111));
            return self.differs(Code::PV007, line, message, "print the feed code (G1) for this move");
        }
        let found_end = found.what.end(&found.from);
        if self.way.iter().any(|rapid| same(&rapid.to, &found_end, ALL, tolerance)) && found.what.feeds() {
            let message = format!("a feed move goes to {}, where the job has a rapid", shown(&found_end, 0b111));
            return self.differs(Code::PV008, line, message, "print the rapid code (G0) for this move");
        }
        if found.by_cycle && hole.is_none() {
            let place = over(&found.from);
            let message =
                format!("the canned cycle is still in force: it drills at {place}, where the job has no hole");
            return self.differs(Code::PV013, line, message, "end the cycle: print G80 in Cancel, and `End Cancel`");
        }
        let Some(hole) = hole else {
            let message = format!("a cut begins at {is}, the job's at {wanted}");
            return self.differs(Code::PV001, line, message, "look at what the form prints for the moves before it");
        };
        if !same(&hole.at, &found.from, ACROSS, tolerance) {
            let at = over(&hole.at);
            if self.last_hole.is_some_and(|last| same(&last.at, &found.from, ACROSS, tolerance)) {
                let message = format!("the hole at {} is drilled twice", over(&found.from));
                return self.differs(Code::PV003, line, message, "look for a second position line in the cycle");
            }
            let message = format!("the hole at {at} is not drilled: the next cut begins at {is}");
            return self.differs(Code::PV002, line, message, "print [h] and [v] in the cycle's position line");
        }
        if unknown & 1 << DEPTH != 0 {
            let message =
                format!("the hole at {} is drilled from a height that only the machine knows", over(&hole.at));
            return self.differs(Code::PV005, line, message, "print [d] before the cycle");
        }
        let message = format!(
            "the feed begins at Z{}, the job's clearance plane is Z{}",
            number(found.from[DEPTH]),
            number(cut.from[DEPTH])
        );
        self.differs(Code::PV005, line, message, "print R[vclear] in the cycle, at every hole where it changes")
    }
}
