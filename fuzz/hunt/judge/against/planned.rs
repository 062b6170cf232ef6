//! Holes by the second planner. A program makes each hole by a cycle of the control, or by exactly the moves that the
//! words of CYCLE request.

use super::{Judge, shown};
use crate::judge::{Act, Wanted, What, near, same};
use crate::planner::{Height, Hole, Kind, Move, Turn};

impl Judge<'_> {
    pub(super) fn planned(&mut self, wanted: &Wanted, hole: &Hole) -> Option<String> {
        if hole.kind == Kind::Manual {
            return self.by_hand(wanted, hole);
        }
        // RAPTO leads to the bottom, so no feed move remains
        if near(begins(hole).from, hole.bottom, 1e-9) {
            return None;
        }
        let Some(act) = self.next() else { return Some(format!("the hole at {} is missing", shown(&wanted.to))) };
        if !self.over(&act, hole.over) {
            return Some(format!(
                "line {}: a cut to {}, the hole is at {}",
                act.line,
                shown(&act.to),
                shown(&wanted.to)
            ));
        }
        let until = self.find().unwrap_or(self.at);
        if let Some(difference) = self.way(wanted, until).or_else(|| self.state(wanted, &act)) {
            return Some(difference);
        }
        match act.what {
            What::Hole { .. } => {
                let difference = self.built_in(wanted, hole, &act);
                self.take();
                difference
            }
            _ => self.by_moves(wanted, hole),
        }
    }

    fn over(&self, act: &Act, over: [f64; 2]) -> bool {
        (0..2).all(|axis| near(act.to[axis], over[axis], self.within))
    }

    /// The tool must be over the hole at its clearance, and the program must stop there.
    fn by_hand(&mut self, wanted: &Wanted, hole: &Hole) -> Option<String> {
        while let Some(act) = self.acts.get(self.at) {
            self.at += 1;
            match act.what {
                What::Stop(_) if self.over(act, hole.over) && act.to[2] >= hole.clear - self.within => {
                    self.low = f64::INFINITY;
                    return None;
                }
                // a stop may also be the stop for changing the tool by hand
                What::Stop(_) | What::Rapid | What::Dwell(_) | What::Orient(_) | What::Tool => {}
                What::Feed if same(&act.from, &act.to, self.within) => {}
                _ => break,
            }
        }
        Some(format!("the stop over {} is missing", shown(&wanted.to)))
    }

    fn built_in(&self, wanted: &Wanted, hole: &Hole, act: &Act) -> Option<String> {
        let What::Hole { code, r, z, q, p, .. } = act.what else { return None };
        let line = act.line;
        if !hole.built_in && !hole.rigid {
            return Some(format!("line {line}: G{code} after CYCLE/AUTO,OFF"));
        }
        let codes: &[f64] = match (hole.kind, hole.inverse) {
            (Kind::Drill, _) => &[81.0, 82.0],
            (Kind::Face, _) => &[82.0],
            (Kind::Sink, _) => &[81.0, 82.0],
            (Kind::Tap, true) => &[74.0],
            (Kind::Tap, false) => &[84.0, 74.0],
            (Kind::Bore, _) => &[85.0, 86.0, 76.0, 89.0],
            (Kind::BoreBack, _) => &[87.0],
            (Kind::Ream, _) => &[85.0, 89.0],
            // a form may print a pecking cycle for a chip-breaking cycle, and the reverse
            (Kind::Deep | Kind::Chips, _) => &[83.0, 73.0],
            (Kind::Thru | Kind::Manual, _) => &[],
        };
        if !codes.contains(&code) {
            return Some(format!("line {line}: G{code} for {:?}", hole.kind));
        }
        let begins = begins(hole);
        if !begins.holds(r, self.within) || !near(z, hole.bottom, self.within) {
            return Some(format!(
                "line {line}: G{code} from {r:.4} to {z:.4}, the hole from {:.4} to {:.4}",
                begins.to, hole.bottom
            ));
        }
        let dwells = match hole.dwell {
            None => near(p, 0.0, 1e-6),
            Some(None) => true,
            Some(Some(seconds)) => near(p, seconds, 0.0011 + 0.01 * seconds),
        };
        if !dwells {
            return Some(format!("line {line}: G{code} dwells {p} s, not {:?}", hole.dwell));
        }
        let strokes = hole.moves.iter().filter(|part| matches!(part, Move::Feed(..))).count();
        if matches!(code, 83.0 | 73.0) && strokes > 1 && (q.is_nan() || q <= 0.0) {
            return Some(format!("line {line}: G{code} without pecks"));
        }
        if hole.ratio != 1.0 && matches!(hole.kind, Kind::Tap | Kind::Ream) {
            return Some(format!("line {line}: G{code} feeds out as it feeds in, RATIO is {}", hole.ratio));
        }
        self.feed(wanted, act)
    }

    /// Compares the start, the end and the feed of each stroke, and the dwells, orientations and jogs between strokes.
    fn by_moves(&mut self, wanted: &Wanted, hole: &Hole) -> Option<String> {
        let mut turn = None;
        let mut begins = Height { from: hole.clear, to: hole.clear };
        // the requests since the last stroke
        let mut asked: Vec<Move> = Vec::new();
        let mut is_first = true;
        for part in &hole.moves {
            match *part {
                Move::Rapid(_, height) => {
                    begins = height;
                    asked.push(*part);
                }
                Move::Spindle(way) => {
                    turn = Some(way);
                    asked.push(*part);
                }
                // the extra rapid of RAPTO may already reach the end of this feed
                Move::Feed(to, _) if (begins.from - to).abs() < 1e-9 => {}
                Move::Feed(to, feed) => {
                    let Some(at) = self.find() else {
                        return Some(format!("the hole at {} stops short", shown(&wanted.to)));
                    };
                    let act = self.acts[at];
                    // some controls feed out of a tap to the return level of G98
                    let ends = Height { from: to, to: if to == hole.clear { hole.plane } else { to } };
                    if let Some(difference) = self.between(hole, &asked, at, is_first) {
                        return Some(difference);
                    }
                    let right = act.what == What::Feed
                        && self.over(&act, hole.over)
                        && begins.holds(act.from[2], self.within)
                        && ends.holds(act.to[2], self.within);
                    if !right {
                        return Some(format!(
                            "line {}: {:?} from {:.4} to {:.4}, the hole's from {:.4} to {to:.4}",
                            act.line, act.what, act.from[2], act.to[2], begins.from
                        ));
                    }
                    let own = Wanted { feed: (feed, 94.0), ..wanted.clone() };
                    if let Some(difference) = self.feed(&own, &act) {
                        return Some(difference);
                    }
                    if turn.is_some_and(|turn| code(turn) != act.state.direction) && !hole.rigid {
                        return Some(format!("line {}: M{} under {turn:?}", act.line, act.state.direction));
                    }
                    self.take();
                    (begins, is_first) = (Height { from: to, to }, false);
                    asked.clear();
                }
                Move::Dwell(_) | Move::Orient(_) => asked.push(*part),
                Move::Stop => {}
            }
        }
        // moves after the last stroke, up to the next cut
        let until = self.find().unwrap_or(self.acts.len());
        if hole.kind == Kind::Tap || hole.kind == Kind::Ream {
            return None;
        }
        let difference = self.between(hole, &asked, until, false);
        let out =
            self.acts[self.at..until].iter().find(|act| act.what == What::Rapid && leaves(act, hole, self.within));
        let lowest = out.map_or(f64::INFINITY, |act| act.from[2]);
        // a dwell of the hole is not a dwell after the hole
        let is_own = |act: &Act| matches!(act.what, What::Dwell(_)) && near(act.from[2], hole.bottom, self.within);
        self.at += self.acts[self.at..until].iter().take_while(|act| is_own(act)).count();
        difference.or_else(|| {
            (lowest < hole.plane.min(hole.clear) - self.within)
                .then(|| format!("leaves the hole at {lowest:.4}, not {:.4}", hole.plane))
        })
    }

    /// Compares everything from the last stroke up to a cut: dwells, orientations, jogs, the spindle, and the greatest
    /// height.
    fn between(&self, hole: &Hole, asked: &[Move], until: usize, is_first: bool) -> Option<String> {
        let acts = &self.acts[self.at..until];
        let line = acts.first().map_or(0, |act| act.line);
        if !is_first {
            let own: f64 =
                acts.iter().filter_map(|act| if let What::Dwell(s) = act.what { Some(s) } else { None }).sum();
            let dwells: Vec<Option<f64>> =
                asked.iter().filter_map(|part| if let Move::Dwell(s) = part { Some(*s) } else { None }).collect();
            let known: f64 = dwells.iter().flatten().sum();
            let is_right = match dwells.as_slice() {
                [] => hole.kind != Kind::Tap || own < 1e-6,
                list if list.contains(&None) => true,
                _ => own >= known - (0.0011 + 0.01 * known),
            };
            if !is_right {
                return Some(format!("line {line}: dwells {own} s at the hole, not {known}"));
            }
            let stops = |asked: &Move| *asked == Move::Spindle(Turn::Off);
            let first_up = acts.iter().find(|act| act.what == What::Rapid && act.to[2] > act.from[2]);
            if asked.iter().any(stops) && first_up.is_some_and(|act| act.state.direction != 5.0) {
                return Some(format!("line {line}: out with the spindle turning"));
            }
            // checks the height of a full retract
            let heights =
                asked.iter().filter_map(|part| if let Move::Rapid(_, h) = part { Some(h.from) } else { None });
            let top = heights.fold(f64::NEG_INFINITY, f64::max);
            let inside = acts.iter().take_while(|act| !leaves(act, hole, self.within));
            let reached =
                inside.filter(|act| act.what == What::Rapid).map(|act| act.to[2]).fold(f64::NEG_INFINITY, f64::max);
            if top.is_finite() && until < self.acts.len() && reached < top.min(hole.clear) - self.within {
                return Some(format!("line {line}: up to {reached:.4}, not {top:.4}"));
            }
        }
        let turns = asked.iter().filter(|part| matches!(part, Move::Orient(_))).count();
        if turns > acts.iter().filter(|act| matches!(act.what, What::Orient(_))).count() {
            return Some(format!("line {line}: the spindle is not oriented"));
        }
        // the positions beside the hole, in order
        let mut ends = acts.iter().filter(|act| act.what == What::Rapid).map(|act| act.to);
        for part in asked {
            let Move::Rapid(over, height) = part else { continue };
            let beside = (0..2).any(|axis| !near(over[axis], hole.over[axis], self.within));
            if beside
                && over.iter().all(|number| !number.is_nan())
                && !ends.any(|end| {
                    (0..2).all(|axis| near(end[axis], over[axis], self.within)) && height.holds(end[2], self.within)
                })
            {
                return Some(format!("line {line}: not beside the hole at {over:?}, {:.4}", height.from));
            }
        }
        None
    }
}

/// The height at which the first stroke begins.
fn begins(hole: &Hole) -> Height {
    let clear = Height { from: hole.clear, to: hole.clear };
    let first = hole.moves.iter().position(|part| matches!(part, Move::Feed(..))).unwrap_or(0);
    hole.moves[..first]
        .iter()
        .rev()
        .find_map(|part| if let Move::Rapid(_, height) = part { Some(*height) } else { None })
        .filter(|_| hole.kind != Kind::BoreBack)
        .unwrap_or(clear)
}

/// Whether the act leaves the hole and the positions beside it.
fn leaves(act: &Act, hole: &Hole, within: f64) -> bool {
    let beside = hole.moves.iter().any(|part| {
        matches!(part, Move::Rapid(over, _) if (0..2).all(|axis| over[axis].is_nan() || near(over[axis], act.to[axis], within)))
    });
    let over = (0..2).all(|axis| near(act.to[axis], hole.over[axis], within));
    !over && !beside
}

fn code(turn: Turn) -> f64 {
    match turn {
        Turn::Clockwise => 3.0,
        Turn::Counterclockwise => 4.0,
        Turn::Off => 5.0,
    }
}
