//! Speeds and accelerations of the axes of a machine.

use super::corner::Corner;

/// The travel of each axis: X Y Z in millimetres, A B C in degrees.
pub type Way = [f64; 6];

/// Speeds and acceleration of an axis. An unknown value sets no limit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisRates {
    /// The rapid speed, in millimetres or degrees per second.
    pub rapid: Option<f64>,
    /// The fastest feed, in millimetres or degrees per second.
    pub feed: Option<f64>,
    /// The acceleration, in millimetres or degrees per second squared.
    pub acceleration: Option<f64>,
}

/// Speeds and accelerations of a machine, and the behaviour of its control.
#[derive(Clone, Debug, PartialEq)]
pub struct Rates {
    /// The axes X Y Z A B C.
    pub axes: [AxisRates; 6],
    /// The rule of the control for corners.
    pub corner: Corner,
    /// The number of blocks that the control plans ahead, at least 1.
    pub ahead: usize,
}

impl Rates {
    /// The length of a path to which the feed refers. The feed refers to the length of X Y Z if one of these axes
    /// moves, otherwise to the length of A B C.
    pub(super) fn length(&self, way: &Way) -> f64 {
        let linear = size(&way[..3]);
        if linear > 0.0 { linear } else { size(way) }
    }

    /// The speed of a move along a direction: a rapid, or a cut at `feed`. 0 or infinity: the speed is unknown.
    pub(super) fn speed(&self, along: &Way, feed: Option<f64>) -> f64 {
        match feed {
            None => self.along(along, |axis| axis.rapid),
            Some(feed) => feed.min(self.along(along, |axis| axis.feed.or(axis.rapid))),
        }
    }

    /// The greatest rate along a direction at which no axis exceeds its own rate; infinite if no axis has a limit.
    pub(super) fn along(&self, direction: &Way, of: impl Fn(&AxisRates) -> Option<f64>) -> f64 {
        let limits = self.axes.iter().zip(direction).filter(|(_, part)| **part != 0.0);
        limits.filter_map(|(axis, part)| Some(of(axis)? / part.abs())).fold(f64::INFINITY, f64::min)
    }
}

/// The length of a vector.
pub(super) fn size(of: &[f64]) -> f64 {
    of.iter().map(|part| part * part).sum::<f64>().sqrt()
}
