//! Prints usual cuts. A usual cut is a straight cut after another straight cut, and needs only position words and no
//! other checks. Most moves of long jobs are usual cuts. The cut is printed in one pass. Checks are left out if the
//! form and the known state already determine their results. The general code of [`super::line`] would print the same
//! block for a usual cut.

use crate::number::nearest;
use crate::render::cx::Cx;
use crate::render::fault::Done;
use crate::render::numbers::quantised;
use crate::render::said::{LastMove, Said};
use crate::render::shape::{ROTARY_BITS, Shape};
use crate::render::want::Want;
use crate::render::words::feed_word;
use crate::toolpath::Axes;

/// The factor of each axis from the position to the printed units. `None`: a cut to this position is not usual.
#[inline]
pub fn is_plain(to: &Axes, shape: &Shape, want: &Want, said: &Said) -> Option<[f64; 3]> {
    let stand = &said.stand;
    let is_usual = said.last_move == LastMove::Line
        && !said.is_unsettled(want)
        && stand.left_hole.is_none()
        && stand.moved_by.is_none()
        && stand.fresh_tool.is_none()
        && (to.given | stand.position.given) & ROTARY_BITS == 0
        && said.motion_in_force(&shape.program.settings.feed);
    shape.plain_factors.filter(|_| is_usual)
}

/// Prints a usual cut.
#[inline]
pub fn plain_line(to: &Axes, feed: Option<f64>, factors: [f64; 3], cx: &mut Cx<'_>) -> Done {
    let Cx { shape, want, said, out } = cx;
    want.take_feed(feed, shape)?;
    let position = &mut said.stand.position;
    let mut changed = false;
    for axis in 0..3 {
        if to.given & 1 << axis != 0 {
            position.values[axis] = to.values[axis] * shape.scale;
        }
    }
    position.given |= to.given;
    let (values, given) = (position.values, position.given);
    for axis in 0..3 {
        if given & 1 << axis == 0 {
            continue;
        }
        let info = &shape.letters[shape.axes[axis]];
        let units = match nearest(values[axis] * factors[axis]) {
            Some(units) => units,
            None => quantised(info, values[axis] * shape.scales[axis]).inspect_err(|_| out.clear_block())?,
        };
        if !said.holds(info, units) {
            out.letter(info, units, false)?;
            said.word(info, units);
            changed = true;
        }
    }
    if changed {
        feed_word(&mut cx.writer())?;
        cx.out.end_block();
    }
    Ok(())
}
