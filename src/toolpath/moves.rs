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
    /// The two axes of the plane, and the axis perpendicular to the plane. The two axes are in the order in which
    /// counter-clockwise is positive.
    pub fn axes(self) -> ([usize; 2], usize) {
        match self {
            Plane::Xy => ([0, 1], 2),
            Plane::Xz => ([2, 0], 1),
            Plane::Yz => ([1, 2], 0),
        }
    }
}

/// Direction of an arc, seen from the positive end of the axis that is perpendicular to the plane.
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
    /// Centre of the arc as an absolute position. The coordinate of the centre perpendicular to the plane is ignored.
    pub center: Option<Axes>,
    /// Radius, if it is given instead of the centre. A negative radius means the longer arc.
    pub radius: Option<f64>,
    /// Direction of the arc.
    pub direction: Direction,
    /// Plane of the arc.
    pub plane: Plane,
    /// Number of additional full turns.
    pub turns: u32,
}

/// The side of the path on which the tool moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left of the path: G41.
    Left,
    /// Right of the path: G42.
    Right,
}

impl Side {
    /// The side in words: `left` or `right`.
    pub fn name(self) -> &'static str {
        match self {
            Side::Left => "left",
            Side::Right => "right",
        }
    }
}

/// The move that turns cutter compensation on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Infeed {
    /// End of the move.
    pub to: Axes,
    /// Side of the path on which the tool moves after this move.
    pub side: Side,
    /// Whether the move is a rapid.
    pub rapid: bool,
}

/// Kinds of named parts of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// The lead-in: the approach to the contour.
    Leadin,
    /// The lead-out: the move away from the contour.
    Leadout,
    /// The move down into the material.
    Plunge,
    /// The move up out of the material.
    Retract,
    /// The move across to the next pass.
    SideStep,
    /// All moves at one Z level.
    ZLevel,
    /// A pass of a pocket or of a surface.
    Row,
    /// Everything that a torch or a laser cuts between two rapids. Jobs do not contain this section; postform adds it.
    Cut,
}
