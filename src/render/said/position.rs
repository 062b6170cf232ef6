//! Where the tool stands, and how certain that is.

use super::angles::Angles;
use crate::render::shape::Shape;
use crate::span::Span;
use crate::toolpath::Axes;

/// Where the tool stands.
#[derive(Clone, Debug, Default)]
pub struct Stand {
    /// Position in program units, as the job means it; axes not given are unknown.
    pub position: Axes,
    /// Where the rotary axes stand.
    pub angles: Angles,
    /// Axes that a sequence brought to a position of the job, and nothing moved since; cleared before the sequence.
    pub placed: u8,
    /// Axes that something moved since the last target was set: nobody knows an increment of them.
    pub(super) astray: u8,
    /// The height at which the subprogram called last left the tool, while nothing else tells one.
    pub left_at: Option<f64>,
    /// Where the control left a cycle, and the other height at which the job did: a cut begins there.
    pub left_hole: Option<(Axes, f64)>,
    /// The sequence that took the tool away from its place by numbers of its own; a rapid brings it back.
    pub moved_by: Option<Span>,
    /// While the tool has made no cut by a line or an arc since its change: the axes along which the tool before it had a place. The
    /// first cut must have a beginning along these too.
    pub fresh_tool: Option<u8>,
}

impl Stand {
    /// An item's target in program units, with the axes that it keeps.
    #[inline]
    pub fn target(&self, to: &Axes, shape: &Shape) -> Axes {
        let mut target = self.position;
        for axis in 0..6 {
            if to.given & 1 << axis != 0 {
                let scale = if axis < shape.linear { shape.scale } else { 1.0 };
                target.values[axis] = to.values[axis] * scale;
            }
        }
        target.given |= to.given;
        target
    }

    /// The tool is there now; axes that the target does not give stay.
    #[inline]
    pub fn move_to(&mut self, target: &Axes) {
        for axis in 0..6 {
            if target.given & 1 << axis != 0 {
                self.position.values[axis] = target.values[axis];
            }
        }
        self.position.given |= target.given;
    }

    /// A target was set along these axes: increments count from here.
    #[inline]
    pub fn aims(&mut self, axes: u8) {
        self.astray &= !axes;
    }

    /// Did something move this axis since the last target was set?
    pub fn is_astray(&self, axis: usize) -> bool {
        self.astray & 1 << axis != 0
    }

    /// Nobody knows where the linear axes are. The part stays turned as it is.
    pub fn forget_position(&mut self) {
        self.position = Axes::default();
        self.left_at = None;
    }

    /// Where a rotary axis stands.
    pub fn angle(&self, axis: usize) -> Option<f64> {
        self.position.get(axis).or(self.angles.stands(axis))
    }
}
