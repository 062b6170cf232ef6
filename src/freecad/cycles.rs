//! Canned cycles of a path. A path has a command for every hole, with rapids before it. The commands of similar holes
//! are combined into one cycle.

use super::command::{Return, Words};
use super::order::Operation;
use super::wrong;
use crate::diag::{Code, Diag};
use crate::toolpath::{Axes, CycleKind, CycleSpec, Hole, Place};

/// Tolerance within which two heights are equal. Paths have six decimals.
const SAME: f64 = 1e-6;

/// The kind of cycle for a G code. The code is given in tenths.
pub(super) fn kind_of(tenths: u16) -> Option<CycleKind> {
    Some(match tenths {
        730 => CycleKind::Chipbreak,
        740 => CycleKind::LTap,
        810 => CycleKind::Drill,
        820 => CycleKind::Face,
        830 => CycleKind::Deep,
        840 => CycleKind::Tap,
        850 => CycleKind::Ream,
        _ => return None,
    })
}

/// One hole, as its command describes it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drilling {
    kind: CycleKind,
    /// Position of the hole in X and Y, in mm.
    pub at: [f64; 2],
    bottom: f64,
    /// Height of the R plane.
    r: f64,
    /// Height to which the tool returns after the hole.
    pub level: f64,
    peck: Option<f64>,
    dwell: Option<f64>,
    /// The feed in millimetres per minute.
    feed: f64,
    /// The spindle speed in revolutions per minute, if the hole is tapped.
    pub speed: Option<f64>,
}

impl Drilling {
    /// Reads the command of a hole. `position`: the position of the tool before the hole.
    pub fn read(
        kind: CycleKind,
        words: &Words,
        position: &[Option<f64>; 6],
        returns: Return,
        operation: &Operation,
    ) -> Result<Drilling, Box<Diag>> {
        let help = "recompute the operation in FreeCAD";
        if let Some(letter) = words.beyond(if kind.is_tap() { b"XYZRFSPQ" } else { b"XYZRFPQ" }) {
            return wrong(
                Code::PD003,
                format!("a cycle with a word {letter}"),
                "cycles of FreeCAD do not use this word: remove it",
            );
        }
        let [Some(x), Some(y), Some(bottom), Some(r)] =
            [words.get(b'X').or(position[0]), words.get(b'Y').or(position[1]), words.get(b'Z'), words.get(b'R')]
        else {
            return wrong(Code::PD003, "a cycle without X, Y, Z and R", help);
        };
        let level = match (words.returns.unwrap_or(returns), position[2]) {
            (Return::Clearance, _) => r,
            (Return::Before, Some(z)) => z.max(r),
            (Return::Before, None) => {
                return wrong(Code::PD003, "a cycle with G98, but the height before it is unknown", help);
            }
        };
        if bottom > r {
            return wrong(Code::PD003, format!("a cycle whose bottom Z{bottom} is above its R{r}"), help);
        }
        let Some(f) = words.get(b'F').filter(|f| *f > 0.0) else {
            let help = format!("give {} a feed in FreeCAD", operation.controller.label);
            return wrong(Code::PD004, "a cycle without a feed", help);
        };
        // in a tap, F is the pitch; if it were used as a feed, the tap would break
        let (feed, speed) = match (kind.is_tap(), words.get(b'S').filter(|s| *s > 0.0)) {
            (false, _) => (operation.controller.feed(f), None),
            (true, Some(speed)) => (f * speed, Some(speed)),
            (true, None) => {
                let help = "use Tapping of FreeCAD 1.1: its F is the pitch and its S the speed";
                return wrong(Code::PD003, "a tap without a speed S: its F may be a feed or a pitch", help);
            }
        };
        let above = |letter| words.get(letter).filter(|value| *value > 0.0);
        let pecks = matches!(kind, CycleKind::Deep | CycleKind::Chipbreak);
        if pecks && above(b'Q').is_none() {
            return wrong(Code::PD003, "a peck cycle without its step Q", "give the operation a peck depth");
        }
        let peck = above(b'Q').filter(|_| pecks || kind.is_tap());
        Ok(Drilling { kind, at: [x, y], bottom, r, level, peck, dwell: words.get(b'P'), feed, speed })
    }

    /// The cycle that begins with this hole. The point of a hole is its top, where the operation begins to cut. In FreeCAD all
    /// holes of an operation have the same top.
    fn spec(&self, top: f64) -> CycleSpec {
        let mut spec = CycleSpec::new(self.kind);
        spec.clear = Some(self.r - top);
        spec.depth = Some(top - self.bottom);
        spec.return_height = Some(self.level - top);
        spec.feed = Some(self.feed);
        spec.step = self.peck;
        if self.kind.is_tap() && self.peck.is_some() {
            spec.mode = Some(CycleKind::Chipbreak);
        }
        spec.dwell = self.dwell.filter(|&seconds| seconds > 0.0 || self.kind == CycleKind::Face);
        spec
    }

    fn hole(&self, top: f64, first: &Drilling) -> Hole {
        let at = Axes::new(&[self.at[0], self.at[1], top]);
        Hole { at, depth: (self.bottom != first.bottom).then_some(top - self.bottom) }
    }
}

/// An open cycle, to which more holes can be added.
#[derive(Debug)]
pub(super) struct Cycle {
    first: Drilling,
    last: [f64; 2],
    top: f64,
    /// Rapids since the last hole, with the positions after them. These rapids belong to the cycle if they lead to the
    /// cycle's next hole.
    pub pending: Vec<(Axes, [Option<f64>; 6], Place)>,
}

impl Cycle {
    /// Begins a cycle with its first hole.
    pub fn begin(first: Drilling, top: Option<f64>) -> (Cycle, CycleSpec, Hole) {
        let top = top.filter(|top| (first.bottom..=first.r).contains(top)).unwrap_or(first.r);
        let cycle = Cycle { first, last: first.at, top, pending: Vec::new() };
        (cycle, first.spec(top), first.hole(top, &first))
    }

    /// Adds a hole if it belongs to this cycle. A hole belongs to the cycle if its words are equal and the rapids
    /// before the hole only lead to the hole. A rapid above the return height avoids an obstacle, so the hole after
    /// such a rapid does not belong to the cycle.
    pub fn add(&mut self, next: &Drilling) -> Option<Hole> {
        let key = |d: &Drilling| (d.kind, [d.r, d.level, d.feed], [d.peck, d.dwell, d.speed]);
        let leads = |position: &[Option<f64>; 6]| {
            let at = [position[0], position[1]];
            let over = |place: [f64; 2]| at == place.map(Some);
            position[2].is_some_and(|z| (z - self.first.level).abs() <= SAME) && (over(self.last) || over(next.at))
        };
        let is_same = key(&self.first) == key(next)
            && next.bottom <= self.top
            && self.pending.iter().all(|(_, position, _)| leads(position));
        is_same.then(|| {
            self.pending.clear();
            self.last = next.at;
            next.hole(self.top, &self.first)
        })
    }
}
