//! The position of the tool, and its certainty.

use super::angles::Angles;
use crate::render::shape::Shape;
use crate::span::Span;
use crate::toolpath::Axes;

/// The position of the tool.
#[derive(Clone, Debug, Default)]
pub struct Stand {
    /// The position in program units, as in the job. The position of an axis that is not given is unknown.
    pub position: Axes,
    /// Angles of the rotary axes.
    pub angles: Angles,
    /// Axes that the current sequence moved to a position of the job and did not move later. Cleared before each
    /// sequence.
    pub placed: u8,
    /// Axes that moved since the last target was set, so that their increments are unknown.
    pub(super) astray: u8,
    /// Height of the tool at the end of the last called subprogram, as long as no other height is known.
    pub left_at: Option<f64>,
    /// The position after a cycle and the job's height, if the control left the cycle at another height than the job's
    /// height. The next cut begins at the job's height.
    pub left_hole: Option<(Axes, f64)>,
    /// The work offset of the height in `position`, if the work offset has changed since and no item has given a height.
    height_of: Option<f64>,
    /// Whether the form moved the tool along the depth axis by its own words, as in `G53 Z0`, and no item has given a height
    /// since.
    pub is_retracted: bool,
    /// The sequence that moved the tool to typed positions. A rapid returns the tool to the job's positions.
    pub moved_by: Option<Span>,
    /// The axes along which the previous tool had a known position. The axes are kept from a tool change to the first
    /// cut by a line or an arc, because this cut also needs a known start along these axes.
    pub fresh_tool: Option<u8>,
}

impl Stand {
    /// The target of a job item in program units. An axis without a value in the item keeps its position.
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

    /// Moves the known position to the target. An axis without a value in the target keeps its position.
    #[inline]
    pub fn move_to(&mut self, target: &Axes) {
        for axis in 0..6 {
            if target.given & 1 << axis != 0 {
                self.position.values[axis] = target.values[axis];
            }
        }
        self.position.given |= target.given;
    }

    /// Records that a target was set along these axes: later increments are relative to this target.
    #[inline]
    pub fn aims(&mut self, axes: u8) {
        self.astray &= !axes;
    }

    /// Whether this axis has moved since the last target was set.
    pub fn is_astray(&self, axis: usize) -> bool {
        self.astray & 1 << axis != 0
    }

    /// Discards the position of the linear axes. The angles of the rotary axes stay known.
    pub fn forget_position(&mut self) {
        self.position = Axes::default();
        self.left_at = None;
    }

    /// Records that the work offset changes from `before` to `now`.
    pub fn changes_work(&mut self, before: Option<f64>, now: Option<f64>) {
        self.height_of = self.height_of.or(before).filter(|work| Some(*work) != now);
    }

    /// Whether the height in `position` is a number of another work offset.
    #[inline]
    pub fn is_of_other_work(&self) -> bool {
        self.height_of.is_some()
    }

    /// Whether the next height of an item decides where the tool is.
    #[inline]
    pub fn awaits_height(&self) -> bool {
        self.is_of_other_work() || self.is_retracted
    }

    /// Records that an item has moved the tool to a height of the active work offset.
    pub fn has_height(&mut self) {
        (self.height_of, self.is_retracted) = (None, false);
    }

    /// Takes the first position of an operation as the position in a new work offset. The numbers of the position in the
    /// work offset before have no meaning there.
    pub fn goes_to_first(&mut self, first: &Axes, shape: &Shape) {
        let linear = Axes { given: first.given & ((1 << shape.linear) - 1), ..*first };
        self.position = self.target(&linear, shape);
    }

    /// The angle of a rotary axis.
    pub fn angle(&self, axis: usize) -> Option<f64> {
        self.position.get(axis).or(self.angles.stands(axis))
    }
}
