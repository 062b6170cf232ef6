//! Rapids on the way to a cut that begins at its depth.

use super::cut::{ACROSS, Rapid, same};
use super::rapid_path::{across, highest};
use super::ways::{ROUNDED_ACROSS, is_over};
use crate::nc::ROTARY;

/// The end of the program's first rapid across, after a change of tool or work offset, that is at the depth of a cut which
/// does not go down: the job comes to its first position at this depth, and stays there until the cut. The part may be
/// anywhere beside this position, so only the job's own rapids may be that low. A rapid that goes straight down while only
/// a rotary axis gets its angle is not across.
pub(super) fn arrives_at_depth(job: &[Rapid], program: &[Rapid], tolerance: f64) -> Option<Rapid> {
    let depth = job.last().map(Rapid::height).filter(|height| height.is_finite())?;
    let (linear, rounded) = (ACROSS & !ROTARY, ROUNDED_ACROSS * tolerance);
    let moves = |a: &Rapid, b: &Rapid| !same(&a.to, &b.to, linear, rounded) || (a.unknown ^ b.unknown) & linear != 0;
    let low = |(a, b): &(&Rapid, &Rapid)| {
        moves(a, b) && a.height().min(b.height()) <= depth + tolerance && !is_over(a, b, job, tolerance)
    };
    let stays = highest(job) <= depth + tolerance;
    across(program, rounded).find(low).filter(|_| stays).map(|(_, to)| *to)
}
