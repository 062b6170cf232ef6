//! Arcs, cutter compensation, and the named parts of a path.

use super::axes::Axes;

/// Planes of arcs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Plane {
    /// First and second axis: G17.
    #[default]
    Xy,
    /// Depth and first axis: G18.
    Xz,
    /// Second and depth axis: G19.
    Yz,
}

impl Plane {
    /// The two axes of the plane in the order in which counter-clockwise is positive, and the axis across the plane.
    pub fn axes(self) -> ([usize; 2], usize) {
        match self {
            Plane::Xy => ([0, 1], 2),
            Plane::Xz => ([2, 0], 1),
            Plane::Yz => ([1, 2], 0),
        }
    }
}

/// Direction of an arc, seen from the positive end of the axis across the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Clockwise: G2.
    Cw,
    /// Counterclockwise: G3.
    Ccw,
}

/// An arc from the tool's position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// End of the arc.
    pub to: Axes,
    /// Centre of the arc as an absolute position. Its coordinate across the plane is ignored.
    pub center: Option<Axes>,
    /// Radius, instead of the centre: negative for the longer way round.
    pub radius: Option<f64>,
    /// Direction of the arc.
    pub direction: Direction,
    /// Plane of the arc.
    pub plane: Plane,
    /// Full turns before the arc stops at its end.
    pub turns: u32,
}

/// Side of the path where the tool is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left of the path: G41.
    Left,
    /// Right of the path: G42.
    Right,
}

/// The move that turns cutter compensation on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Infeed {
    /// End of the move.
    pub to: Axes,
    /// Side of the path where the tool will be.
    pub side: Side,
    /// Whether the move is a rapid.
    pub rapid: bool,
}

/// Named parts of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// The approach onto the contour.
    Leadin,
    /// The move off the contour.
    Leadout,
    /// The move down into the material.
    Plunge,
    /// The move up out of the material.
    Retract,
    /// The move across to the next pass.
    SideStep,
    /// The moves of one Z level.
    ZLevel,
    /// A pass of a pocket or of a surface.
    Row,
    /// Everything that a torch or a laser cuts without a rapid between. Jobs do not contain it.
    Cut,
}
