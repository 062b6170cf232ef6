//! How fast the axes of a machine are.

use super::corner::Corner;

/// How far each axis moves: X Y Z in millimetres, A B C in degrees.
pub type Way = [f64; 6];

/// How fast an axis is. What is not known sets no limit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisRates {
    /// Its rapid, in millimetres or degrees a second.
    pub rapid: Option<f64>,
    /// Its fastest feed, in millimetres or degrees a second.
    pub feed: Option<f64>,
    /// Its acceleration, in millimetres or degrees a second squared.
    pub acceleration: Option<f64>,
}

/// How fast a machine is.
#[derive(Clone, Debug, PartialEq)]
pub struct Rates {
    /// X Y Z A B C.
    pub axes: [AxisRates; 6],
    /// How fast it goes around corners.
    pub corner: Corner,
    /// Over how many blocks its control plans; at least 1.
    pub ahead: usize,
}

impl Rates {
    /// The length of a way along which feeds count: that of the linear axes, where they move.
    pub(super) fn length(&self, way: &Way) -> f64 {
        let linear = size(&way[..3]);
        if linear > 0.0 { linear } else { size(way) }
    }

    /// The speed of a move in this direction: a rapid, or a cut at this feed. 0 or infinite: nothing says it.
    pub(super) fn speed(&self, along: &Way, feed: Option<f64>) -> f64 {
        match feed {
            None => self.along(along, |axis| axis.rapid),
            Some(feed) => feed.min(self.along(along, |axis| axis.feed.or(axis.rapid))),
        }
    }

    /// The greatest rate along a direction at which no axis has more than its own; infinite where none sets a limit.
    pub(super) fn along(&self, direction: &Way, of: impl Fn(&AxisRates) -> Option<f64>) -> f64 {
        let limits = self.axes.iter().zip(direction).filter(|(_, part)| **part != 0.0);
        limits.filter_map(|(axis, part)| Some(of(axis)? / part.abs())).fold(f64::INFINITY, f64::min)
    }
}

/// The length of a vector.
pub(super) fn size(of: &[f64]) -> f64 {
    of.iter().map(|part| part * part).sum::<f64>().sqrt()
}
