//! Compares a program with its job by the judge's own rules. The program must make every cut of the job with the same
//! tool, between the same positions. The program must make no other cut, and no rapid may move in X or Y lower than the
//! job's path does.

mod arcs;
mod holes;
mod planned;

use super::{Act, INCH, Place, Want, Wanted, What, near, same};
use crate::planner::Kind;

/// The first difference, in words; `None`: the program matches its job. `within`: tolerance in millimetres.
pub fn difference(wants: &[Wanted], acts: &[Act], within: f64) -> Option<String> {
    let judge = Judge { acts, at: 0, within, low: f64::INFINITY, low_line: 0, allowed: f64::INFINITY };
    judge.follow(wants, &mut 64)
}

fn cuts(what: &What) -> bool {
    matches!(what, What::Feed | What::Arc { .. } | What::Hole { .. } | What::Thread(_))
}

/// Whether the item has the same request and the same final height as the previous item.
fn again(before: &Wanted, wanted: &Wanted) -> bool {
    before.want == wanted.want && before.to[2] == wanted.to[2]
}

fn shown(place: &Place) -> String {
    let list: Vec<String> = place.iter().map(|number| format!("{:.4}", number)).collect();
    list.join(" ")
}

#[derive(Clone, Copy)]
struct Judge<'a> {
    acts: &'a [Act],
    at: usize,
    within: f64,
    /// Lowest height of a rapid in X or Y since the last cut, and its line.
    low: f64,
    low_line: usize,
    /// Lowest height of the job's path to cuts that are too short for the digits of the program.
    allowed: f64,
}

impl Judge<'_> {
    /// Compares all items of the job in order. `left`: number of alternatives that may still be tried.
    fn follow(mut self, wants: &[Wanted], left: &mut u32) -> Option<String> {
        for (number, wanted) in wants.iter().enumerate() {
            let one_way = match wanted.want {
                Want::Line => true,
                Want::Arc { .. } => arcs::turn(wanted) < std::f64::consts::PI,
                _ => false,
            };
            if one_way && same(&wanted.from, &wanted.to, self.within) && wanted.from[3..] == wanted.to[3..] {
                // the move is shorter than the last digit, so the program may leave out the move
                let is_part = |act: Act| {
                    matches!(act.what, What::Feed | What::Arc { .. })
                        && same(&act.from, &wanted.from, 2.0 * self.within)
                        && same(&act.to, &wanted.to, 2.0 * self.within)
                };
                let mut made = self;
                while *left > 0 && made.next().is_some_and(is_part) {
                    *left -= 1;
                    made.take();
                    made.follow(&wants[number + 1..], left)?;
                }
                self.allowed = self.allowed.min(wanted.low);
            } else if let Some(difference) = self.meet(wanted, number > 0 && again(&wants[number - 1], wanted)) {
                return Some(difference);
            } else if matches!(wanted.want, Want::Arc { .. }) {
                // a short arc at this end is either a part of this arc that is shorter than the last digit, or the next
                // arc
                let mut made = self;
                while *left > 0
                    && made.acts.get(made.at).is_some_and(|act| {
                        arcs::is_short(act)
                            && [&act.from, &act.to].iter().all(|end| same(end, &wanted.to, 2.0 * self.within))
                    })
                {
                    *left -= 1;
                    made.take();
                    made.follow(&wants[number + 1..], left)?;
                }
            }
        }
        self.next().map(|act| format!("line {}: a cut that the job does not have, to {}", act.line, shown(&act.to)))
    }

    /// The index of the program's next cut.
    fn find(&self) -> Option<usize> {
        (self.at..self.acts.len()).find(|&at| {
            // a feed move of zero length cuts nothing
            let act = &self.acts[at];
            let nothing = match act.what {
                What::Feed => same(&act.from, &act.to, 1e-9),
                What::Hole { r, z, .. } => near(r, z, 1e-9),
                _ => false,
            };
            cuts(&act.what) && !nothing
        })
    }

    fn next(&self) -> Option<Act> {
        self.find().map(|at| self.acts[at])
    }

    /// Marks everything up to and including the next cut as compared.
    fn take(&mut self) {
        self.at = self.find().map_or(self.acts.len(), |at| at + 1);
        self.low = f64::INFINITY;
        self.allowed = f64::INFINITY;
    }

    /// The lowest height of a rapid in X or Y before `until`, and its line.
    fn crossing(&self, until: usize) -> (f64, usize) {
        let mut lowest = (self.low, self.low_line);
        for act in &self.acts[self.at..until] {
            // in a program without tool words, the tool is changed by hand at a stop
            let by_hand = act.state.tool == 0.0 && matches!(act.what, What::Stop(_));
            if act.what == What::Tool || by_hand {
                lowest = (f64::INFINITY, 0);
            }
            let across = (0..2).any(|axis| !near(act.from[axis], act.to[axis], self.within));
            let low = act.from[2].min(act.to[2]);
            if act.what == What::Rapid && across && low < lowest.0 {
                lowest = (low, act.line);
            }
        }
        lowest
    }

    /// Compares one item of the job. `again`: the job has the same item just before.
    fn meet(&mut self, wanted: &Wanted, again: bool) -> Option<String> {
        match &wanted.want {
            Want::Stop(_) | Want::Dwell(_) => self.pass(wanted),
            Want::Line => self.line(wanted),
            Want::Arc { .. } => self.arc(wanted),
            Want::Hole { .. } => self.hole(wanted),
            Want::Planned(hole) => self.planned(wanted, hole),
            Want::Thread { .. } => self.thread(wanted, again),
        }
    }

    /// Finds a stop or dwell before the next cut.
    fn pass(&mut self, wanted: &Wanted) -> Option<String> {
        let mut at = self.at;
        let mut too_low = None;
        while let Some(act) = self.acts.get(at) {
            let found = match (&wanted.want, act.what) {
                (Want::Stop(kind), What::Stop(is)) => *kind == is,
                (Want::Dwell(seconds), What::Dwell(is)) => near(*seconds, is, 0.0011),
                _ => false,
            };
            if found {
                // in a program without tool words, this may be the stop for changing the tool by hand
                let low = if act.state.tool == 0.0 { None } else { self.way(wanted, at) };
                if low.is_none() {
                    (self.low, self.allowed) = (f64::INFINITY, f64::INFINITY);
                    self.at = at + 1;
                    return None;
                }
                // this may be a stop of the form, and the stop of the job comes later
                too_low = too_low.or(low);
            }
            if cuts(&act.what) && !same(&act.from, &act.to, self.within) {
                break;
            }
            at += 1;
        }
        if too_low.is_some() {
            return too_low;
        }
        Some(format!("{:?} is missing before line {}", wanted.want, self.acts.get(at).map_or(0, |act| act.line)))
    }

    fn state(&self, wanted: &Wanted, act: &Act) -> Option<String> {
        let state = &act.state;
        let line = act.line;
        if state.tool != wanted.tool && state.tool != 0.0 && wanted.tool != 0.0 {
            return Some(format!("line {line}: tool {} for {}", state.tool, wanted.tool));
        }
        if state.length.is_some_and(|length| !wanted.length.is_nan() && length != wanted.length) {
            return Some(format!("line {line}: length register {:?} for {}", state.length, wanted.length));
        }
        let work = if state.work < 50.0 { state.work + 53.0 } else { state.work };
        // a job without a work offset uses the form's default
        if !wanted.work.is_nan() && work != wanted.work {
            return Some(format!("line {line}: work offset {work} for {}", wanted.work));
        }
        let is_tap = match &wanted.want {
            Want::Hole { kind, .. } => kind.ends_with("tap"),
            Want::Planned(hole) => hole.kind == Kind::Tap,
            _ => false,
        };
        if !is_tap && !wanted.spindle.0.is_nan() && state.direction != wanted.spindle.0 {
            return Some(format!("line {line}: spindle M{} for M{}", state.direction, wanted.spindle.0));
        }
        if wanted.spindle.0 != 5.0 && (state.speed - wanted.spindle.1).abs() > 0.01 * wanted.spindle.1 + 0.5 {
            return Some(format!("line {line}: S{} for S{}", state.speed, wanted.spindle.1));
        }
        // more coolant than the job requests is allowed
        let lacks = |coolant: u8| coolant != 0 && state.coolant == 0 || coolant & 2 > state.coolant & 2;
        if wanted.coolant.is_some_and(lacks) {
            return Some(format!("line {line}: coolant {} for {:?}", state.coolant, wanted.coolant));
        }
        // a feed per revolution may be printed as a feed per minute
        if state.feed.1 != wanted.feed.1 && state.feed.1 != 94.0 && !is_tap {
            return Some(format!("line {line}: G{} for G{}", state.feed.1, wanted.feed.1));
        }
        None
    }

    fn feed(&self, wanted: &Wanted, act: &Act) -> Option<String> {
        let by = match (act.state.feed.1 == 95.0, wanted.feed.1 == 95.0) {
            (false, true) => wanted.spindle.1,
            (true, false) => 1.0 / wanted.spindle.1,
            _ => 1.0,
        };
        let (is, should) = (act.state.feed.0, wanted.feed.0 * by);
        // the feed of a cut that only turns the part is in degrees, but the reader of the job scales all feeds
        let turns = (0..3).all(|axis| near(act.from[axis], act.to[axis], self.within));
        let factors: &[f64] = if turns { &[1.0, INCH, 1.0 / INCH] } else { &[1.0] };
        // rounding by the form's last digit is allowed
        let is_near = |factor: &f64| (is - should * factor).abs() <= 0.011 * should * factor + 0.006;
        let off = !factors.iter().any(is_near);
        off.then(|| format!("line {}: feed {is:.4} for {should:.4}", act.line))
    }

    /// Checks that the path to this item was not lower than the path in the job.
    fn way(&self, wanted: &Wanted, until: usize) -> Option<String> {
        let (low, line) = self.crossing(until);
        let allowed = wanted.low.min(self.allowed);
        (low < allowed - self.within.max(0.01) && !allowed.is_infinite())
            .then(|| format!("line {line}: a rapid crosses at {low:.4}, the job's way is at {allowed:.4}"))
    }

    fn begins(&self, wanted: &Wanted, act: &Act) -> Option<String> {
        let known = wanted.from.iter().all(|number| !number.is_nan());
        (known && !same(&act.from, &wanted.from, self.within)).then(|| {
            format!("line {}: a cut begins at {}, the job's at {}", act.line, shown(&act.from), shown(&wanted.from))
        })
    }

    /// Compares all passes of a thread.
    fn thread(&mut self, wanted: &Wanted, again: bool) -> Option<String> {
        let Want::Thread { begin, crest, depth, lead } = wanted.want else { return None };
        let inward = if depth < 0.0 { 1.0 } else { -1.0 };
        let (mut reached, mut passes) = (0.0f64, 0);
        while let Some(act) = self.next() {
            let What::Thread(is) = act.what else { break };
            let along = near(act.from[2], begin, self.within) && near(act.to[2], wanted.to[2], self.within);
            let depth_of = (act.to[0] - crest) * inward;
            // this pass belongs to the next thread, which may have a larger diameter
            let others = (is - lead).abs() > 0.003 * lead || !near(depth_of, depth.abs(), 2.0 * self.within);
            if (!along || others) && passes > 0 && near(reached, depth.abs(), 2.0 * self.within) {
                break;
            }
            if !along {
                return Some(format!("line {}: a pass from {} to {}", act.line, shown(&act.from), shown(&act.to)));
            }
            if (is - lead).abs() > 0.003 * lead {
                return Some(format!("line {}: a lead of {is:.4} for {lead:.4}", act.line));
            }
            if let Some(difference) = self.state(wanted, &act).filter(|text| !text.contains(": G9")) {
                return Some(difference);
            }
            reached = reached.max(depth_of);
            passes += 1;
            self.take();
        }
        if passes == 0 && again {
            return None; // the passes of this thread were compared with those of the equal thread before it
        }
        if passes == 0 || !near(reached, depth.abs(), 2.0 * self.within) {
            return Some(format!("a thread {reached:.4} deep in {passes} passes, the job's {:.4}", depth.abs()));
        }
        None
    }

    /// Skips feed moves straight down to the start of the cut, after the tool was taken out.
    fn enter_again(&mut self, wanted: &Wanted) {
        while self.next().is_some_and(|act| {
            let above = act.from[2].is_nan() || act.from[2] > act.to[2];
            act.what == What::Feed
                && above
                && same(&act.to, &wanted.from, self.within)
                && (0..2).all(|axis| near(act.from[axis], act.to[axis], self.within))
                && !same(&act.from, &wanted.from, self.within)
                && !same(&act.to, &wanted.to, self.within)
        }) {
            self.take();
        }
    }

    fn line(&mut self, wanted: &Wanted) -> Option<String> {
        self.enter_again(wanted);
        let Some(act) = self.next() else { return Some(format!("the cut to {} is missing", shown(&wanted.to))) };
        if let Some(difference) = self
            .begins(wanted, &act)
            .or_else(|| self.way(wanted, self.find().unwrap_or(self.at)))
            .or_else(|| self.state(wanted, &act))
        {
            return Some(difference);
        }
        let mut act = act;
        let mut swept = [0.0; 3];
        loop {
            (0..3).for_each(|axis| swept[axis] += act.to[axis + 3] - act.from[axis + 3]);
            if act.what != What::Feed {
                return Some(format!("line {}: {:?} for a straight cut to {}", act.line, act.what, shown(&wanted.to)));
            }
            if let Some(difference) = self.feed(wanted, &act) {
                return Some(difference);
            }
            self.take();
            if same(&act.to, &wanted.to, self.within) {
                // an angle is unknown if the form sends this axis home and no job turns it
                let off = |axis: &usize| {
                    !swept[*axis].is_nan() && !near(swept[*axis], wanted.to[axis + 3] - wanted.from[axis + 3], 0.01)
                };
                let off = wanted.from[3..].iter().all(|angle| !angle.is_nan()) && (0..3).any(|axis| off(&axis));
                return off
                    .then(|| format!("line {}: turned by {swept:?} on the way to {}", act.line, shown(&wanted.to)));
            }
            if !between(&wanted.from, &act.to, &wanted.to, self.within) {
                return Some(format!(
                    "line {}: a cut to {}, the job's to {}",
                    act.line,
                    shown(&act.to),
                    shown(&wanted.to)
                ));
            }
            match self.next() {
                Some(next) => act = next,
                None => return Some(format!("the cut to {} stops short", shown(&wanted.to))),
            }
        }
    }
}

/// Whether `b` is on the straight line from `a` to `c`.
fn between(a: &Place, b: &Place, c: &Place, within: f64) -> bool {
    let length: f64 = (0..3).map(|axis| (c[axis] - a[axis]).powi(2)).sum();
    let along: f64 = (0..3).map(|axis| (b[axis] - a[axis]) * (c[axis] - a[axis])).sum::<f64>() / length;
    (-1e-6..=1.0 + 1e-6).contains(&along)
        && (0..3).all(|axis| near(a[axis] + along * (c[axis] - a[axis]), b[axis], within))
}
