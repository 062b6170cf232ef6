//! Arcs of a job. The program makes each arc as one arc or in parts, and all parts must be on the arc.

use std::f64::consts::{PI, TAU};

use super::{Judge, shown};
use crate::judge::wants::axes;
use crate::judge::{Act, Place, Want, Wanted, What, near, same};

/// The angle of the job's arc; 0 for a straight cut.
pub(super) fn turn(wanted: &Wanted) -> f64 {
    let Want::Arc { plane, center, ccw, turns } = &wanted.want else { return 0.0 };
    let [first, second] = axes(plane);
    let angle = |place: &Place| (place[second] - center[1]).atan2(place[first] - center[0]);
    let closed = [first, second].iter().all(|axis| near(wanted.from[*axis], wanted.to[*axis], 1e-9));
    let turn = (angle(&wanted.to) - angle(&wanted.from)).rem_euclid(TAU);
    let part = match (closed, *ccw) {
        (true, _) => TAU,
        (false, true) => turn,
        (false, false) => TAU - turn,
    };
    part + turns * TAU
}

/// Whether the act is an arc of less than half a turn.
pub(super) fn is_short(act: &Act) -> bool {
    let What::Arc { plane, center, ccw, turns } = act.what else { return false };
    let [first, second] = axes(match plane {
        18.0 => "xz",
        19.0 => "yz",
        _ => "xy",
    });
    let angle = |place: &Place| (place[second] - center[1]).atan2(place[first] - center[0]);
    let turn = (angle(&act.to) - angle(&act.from)).rem_euclid(TAU);
    turns == 0.0 && turn != 0.0 && (turn < PI) == ccw
}

impl Judge<'_> {
    pub(super) fn arc(&mut self, wanted: &Wanted) -> Option<String> {
        let Want::Arc { plane, center, ccw, .. } = &wanted.want else { return None };
        let [first, second] = axes(plane);
        let third = 3 - first - second;
        let angle = |place: &Place| (place[second] - center[1]).atan2(place[first] - center[0]);
        let radius = |place: &Place| (place[second] - center[1]).hypot(place[first] - center[0]);
        let swept = |from: &Place, to: &Place, ccw: bool| {
            let turn = (angle(to) - angle(from)).rem_euclid(TAU);
            if ccw { turn } else { TAU - turn }
        };
        let size = radius(&wanted.from);
        let whole = turn(wanted);
        // largest distance of chords from the arc, and the tolerance as an angle
        let loose = self.within + 0.03;
        let slack = (4.0 * self.within + 0.001) / size.max(1e-6) + 1e-6;
        if whole * size <= 2.0 * self.within {
            // the arc is too short for the digits of the program; only its height counts
            let reach = size * 2.0 + loose + (wanted.to[third] - wanted.from[third]).abs();
            while let Some(act) = self.next().filter(|act| {
                !same(&act.from, &wanted.to, self.within)
                    && act.what != What::Rapid
                    && [&act.from, &act.to].iter().all(|end| is_near(end, &wanted.to, reach))
            }) {
                self.take();
                if same(&act.to, &wanted.to, self.within) {
                    break; // the next act is another cut
                }
            }
            return None;
        }
        let Some(act) = self.next() else { return Some(format!("the arc to {} is missing", shown(&wanted.to))) };
        if let Some(difference) = self
            .begins(wanted, &act)
            .or_else(|| self.way(wanted, self.find().unwrap_or(self.at)))
            .or_else(|| self.state(wanted, &act))
        {
            return Some(difference);
        }
        let mut done = 0.0;
        let mut act = act;
        loop {
            let part = match act.what {
                What::Feed => {
                    let turn = (angle(&act.to) - angle(&act.from)).rem_euclid(TAU);
                    // a chord covers less than half a turn
                    let turn = if turn > TAU / 2.0 { turn - TAU } else { turn };
                    if *ccw { turn } else { -turn }
                }
                What::Arc { plane: is, center: about, ccw: way, turns } => {
                    let code = match *plane {
                        "xz" => 18.0,
                        "yz" => 19.0,
                        _ => 17.0,
                    };
                    let full =
                        near(act.from[first], act.to[first], 1e-9) && near(act.from[second], act.to[second], 1e-9);
                    let middle = middle(&act, [first, second], about, way, full);
                    let off = ((middle[1] - center[1]).hypot(middle[0] - center[0]) - size).abs();
                    if is != code || way != *ccw || off > loose {
                        return Some(format!("line {}: {:?} for {:?}", act.line, act.what, wanted.want));
                    }
                    (if full { TAU } else { swept(&act.from, &act.to, *ccw) }) + turns * TAU
                }
                _ => return Some(format!("line {}: {:?} for an arc", act.line, act.what)),
            };
            if let Some(difference) = self.feed(wanted, &act).filter(|_| act.state.feed.1 != 93.0) {
                return Some(difference);
            }
            self.take();
            done += part;
            if (radius(&act.to) - size).abs() > loose {
                return Some(format!("line {}: {} is not on the arc", act.line, shown(&act.to)));
            }
            let ends = done >= whole - slack && same(&act.to, &wanted.to, self.within);
            let height = wanted.from[third] + (wanted.to[third] - wanted.from[third]) * (done / whole);
            // for a steep helix, rounding in the plane changes the expected height
            let digits = 0.05 + 2.0 * self.within / (size * whole);
            if !ends && !near(act.to[third], height, loose + digits * (wanted.to[third] - wanted.from[third]).abs()) {
                return Some(format!("line {}: {} is not as high as the helix", act.line, shown(&act.to)));
            }
            if ends {
                return (done > whole + slack)
                    .then(|| format!("line {}: the arc goes on for {done}, not {whole}", act.line));
            }
            if done > whole + slack {
                return Some(format!(
                    "line {}: the arc ends at {}, not {}",
                    act.line,
                    shown(&act.to),
                    shown(&wanted.to)
                ));
            }
            match self.next() {
                Some(next) => act = next,
                None => return Some(format!("the arc to {} stops short", shown(&wanted.to))),
            }
        }
    }
}

/// The point in the middle of an arc, in its plane.
fn middle(act: &Act, [first, second]: [usize; 2], about: [f64; 2], ccw: bool, full: bool) -> [f64; 2] {
    let angle = |place: &Place| (place[second] - about[1]).atan2(place[first] - about[0]);
    let turn = (angle(&act.to) - angle(&act.from)).rem_euclid(TAU);
    let turn = match (full, ccw) {
        (true, _) => TAU,
        (false, true) => turn,
        (false, false) => turn - TAU,
    };
    let radius = (act.from[second] - about[1]).hypot(act.from[first] - about[0]);
    let at = angle(&act.from) + turn / 2.0;
    [about[0] + radius * at.cos(), about[1] + radius * at.sin()]
}

fn is_near(end: &Place, place: &Place, reach: f64) -> bool {
    (0..3).all(|axis| near(end[axis], place[axis], reach))
}
