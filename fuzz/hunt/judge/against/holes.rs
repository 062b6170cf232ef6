//! Holes of a job. The program makes each hole by a cycle of the control or by moves, from the clearance to the bottom.

use super::{Judge, shown};
use crate::judge::{Act, Want, Wanted, What, near, turned};

/// Maximum height above the bottom at which a last peck begins, in millimetres: 0.1 inch, and an allowance for
/// rounding.
const BACK: f64 = 2.6;

impl Judge<'_> {
    pub(super) fn hole(&mut self, wanted: &Wanted) -> Option<String> {
        let Want::Hole { kind, clear, bottom, out: plane } = &wanted.want else { return None };
        let within = self.within;
        let over =
            |act: &Act| (0..2).all(|axis| near(act.to[axis], wanted.to[axis], within)) && turned(&act.to, &wanted.to);
        let Some(act) = self.next() else { return Some(format!("the hole at {} is missing", shown(&wanted.to))) };
        if !over(&act) {
            return Some(format!(
                "line {}: a cut to {}, the hole is at {}",
                act.line,
                shown(&act.to),
                shown(&wanted.to)
            ));
        }
        if let Some(difference) = self.way(wanted, self.find().unwrap_or(self.at)).or_else(|| self.state(wanted, &act))
        {
            return Some(difference);
        }
        // greatest height of the tool before the hole
        let ways = self.acts[..self.find().unwrap_or(self.at)].iter().filter(|act| act.what == What::Rapid);
        let came = ways.map(|act| act.to[2]).filter(|height| height.is_finite()).fold(*plane, f64::max);
        if let What::Hole { code, r, z, .. } = act.what {
            self.take();
            let right = near(r, *clear, self.within) && near(z, *bottom, self.within);
            if !right {
                return Some(format!(
                    "line {}: G{code} from {r:.4} to {z:.4}, the job's hole from {clear:.4} to {bottom:.4}",
                    act.line
                ));
            }
            let known: &[f64] = match kind.as_str() {
                "drill" | "csink" | "face" => &[81.0, 82.0],
                // a form may print a pecking cycle for a chip-breaking cycle, and the reverse
                "deep" | "chipbreak" => &[83.0, 73.0, 81.0, 82.0],
                "tap" => &[84.0, 81.0, 82.0],
                "ltap" => &[74.0, 81.0, 82.0],
                "bore" => &[85.0, 86.0, 76.0, 89.0, 82.0],
                "ream" => &[85.0, 89.0],
                "back" => &[87.0],
                _ => &[],
            };
            if !known.contains(&code) {
                return Some(format!("line {}: G{code} for {kind}", act.line));
            }
            return self.feed(wanted, &act);
        }
        // single moves: down to the bottom, and out again if the cycle feeds out
        let back = kind == "back";
        let begins = if back { f64::NAN } else { *clear };
        if !back && !near(act.from[2], begins, self.within) {
            return Some(format!("line {}: the hole is begun at {:.4}, not {clear:.4}", act.line, act.from[2]));
        }
        let mut act = act;
        loop {
            if act.what != What::Feed || !over(&act) {
                return Some(format!("line {}: {} before the bottom {bottom:.4}", act.line, shown(&act.to)));
            }
            self.take();
            if near(act.to[2], *bottom, self.within) {
                // a last peck may be shorter than the last digit; a feed that begins higher belongs to the next hole
                let pecks = matches!(kind.as_str(), "deep" | "chipbreak");
                let again = |act: &Act| {
                    act.what == What::Feed
                        && over(act)
                        && near(act.to[2], *bottom, within)
                        && act.to[2] < act.from[2]
                        && act.from[2] < bottom + BACK
                };
                match self.next().filter(|act| pecks && again(act)) {
                    Some(next) => act = next,
                    None => break,
                }
                continue;
            }
            if !back && act.to[2] < bottom - self.within {
                return Some(format!("line {}: too deep, {:.4} for {bottom:.4}", act.line, act.to[2]));
            }
            match self.next() {
                Some(next) => act = next,
                None => return Some(format!("the hole at {} stops short", shown(&wanted.to))),
            }
        }
        let feeds_out = matches!(kind.as_str(), "ream" | "tap" | "ltap");
        let out = if feeds_out { self.next() } else { None };
        if let Some(out) = out.filter(|out| over(out) && near(out.from[2], *bottom, self.within) && out.to[2] > *bottom)
        {
            // with G98, LinuxCNC's own taps feed out to the height at which the series of holes began
            let is_between = out.to[2] >= clear - self.within && out.to[2] <= came + self.within;
            if !is_between {
                return Some(format!("line {}: out to {:.4}, not {clear:.4}", out.line, out.to[2]));
            }
            self.take();
        }
        // a dwell at the bottom may come from the form and not from the job
        while self
            .acts
            .get(self.at)
            .is_some_and(|act| matches!(act.what, What::Dwell(_)) && near(act.from[2], *bottom, within))
        {
            self.at += 1;
        }
        None
    }
}
