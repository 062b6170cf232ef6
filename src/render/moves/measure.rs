//! Lengths and times of moves, for forms that print these totals.

use crate::lang::VarId;
use crate::render::said::Said;
use crate::render::want::Want;
use crate::toolpath::{Axes, FeedMode};

/// Adds the length and time of a move to the totals, for forms that print these totals.
#[cold]
pub fn measure(target: &Axes, cuts: bool, want: &mut Want, said: &Said) {
    let mut square = 0.0;
    for axis in 0..3 {
        if let (Some(from), Some(to)) = (said.stand.position.get(axis), target.get(axis)) {
            square += (to - from) * (to - from);
        }
    }
    measured(square.sqrt(), cuts, want);
}

/// Adds a move of this length to the totals.
pub fn measured(length: f64, cuts: bool, want: &mut Want) {
    want.set(VarId::Movelength, length);
    let Some(feed) = want.feed().filter(|_| cuts) else { return };
    let minutes = match want.feed_mode() {
        FeedMode::PerMinute => length / feed,
        FeedMode::PerRev => length / (feed * want.get(VarId::Speed).unwrap_or(0.0)),
        FeedMode::InverseTime => 1.0 / feed,
    };
    if !minutes.is_finite() {
        return;
    }
    want.set(VarId::Movetime, minutes * 60.0);
    if minutes > 0.0 {
        want.set(VarId::Invtime, 1.0 / minutes);
    }
    want.add(VarId::Totalcutdist, length);
    want.add(VarId::Totalcuttime, minutes * 60.0);
}
