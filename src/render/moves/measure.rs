//! Lengths and times of moves, for forms that print these totals.

use crate::lang::VarId;
use crate::render::cx::Cx;
use crate::toolpath::Axes;

/// Adds the length and time of a straight move to the totals, for forms that print these totals.
#[cold]
pub fn measure(target: &Axes, cuts: bool, cx: &mut Cx<'_>) {
    let mut square = 0.0;
    for axis in 0..3 {
        if let (Some(from), Some(to)) = (cx.said.stand.position.get(axis), target.get(axis)) {
            square += (to - from) * (to - from);
        }
    }
    measured(square.sqrt(), target, cuts, cx);
}

/// Adds a move of this length to the totals. At a constant surface speed, the spindle has the speed that belongs to the
/// middle of the move. If the time of a cut is unknown, the total time is unknown too.
pub fn measured(length: f64, target: &Axes, cuts: bool, cx: &mut Cx<'_>) {
    let (shape, want) = (cx.shape, &mut *cx.want);
    want.set(VarId::Movelength, length);
    let Some(feed) = want.feed().filter(|_| cuts) else { return };
    let from = cx.said.stand.position;
    let radius = from.get(1).map(|from| (from + target.get(1).unwrap_or(from)).abs() / 2.0);
    let rpm = want.spindle(shape).rpm(radius, shape.units);
    want.add(VarId::Totalcutdist, length);
    let Some(minutes) = want.feed_mode().minutes(length, feed, rpm) else {
        want.forget(&[VarId::Movetime, VarId::Invtime, VarId::Totalcuttime]);
        return;
    };
    want.set(VarId::Movetime, minutes * 60.0);
    if minutes > 0.0 {
        want.set(VarId::Invtime, 1.0 / minutes);
    }
    want.add(VarId::Totalcuttime, minutes * 60.0);
}
