//! Data for the cycles of a lathe that follow a profile, and for corners.

/// Data from the first block of a cycle with two blocks. The data is kept until the next first block.
#[derive(Clone, Copy, Debug, Default)]
pub struct FirstBlocks {
    /// Depth of a pass of G71, and retract after it.
    pub turn: [Option<f64>; 2],
    /// Depth of a pass of G72, and retract after it.
    pub face: [Option<f64>; 2],
    /// Distance of the first pass of G73 from the profile along X and Z, and the number of passes.
    pub pattern: [Option<f64>; 3],
    /// Retract after each peck of G74 and G75.
    pub back: Option<f64>,
    /// A chamfer or rounded corner that was just cut. The next block must continue from this corner.
    pub corner: Option<Corner>,
}

/// A chamfer or rounded corner that was just cut, and the direction in which the next block must move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// The axis along which the next block must move.
    pub axis: usize,
    /// Distance with sign from the corner to the end of the chamfer, along the axis of the next block's move.
    pub by: f64,
}

/// A cycle that cuts along a profile, which is a part of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profiled {
    /// The block number of the first block of the profile.
    pub first: f64,
    /// The block number of the last block of the profile.
    pub last: f64,
    /// The kind of cuts.
    pub how: How,
}

/// The kind of cuts along a profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum How {
    /// The finish: the blocks of the profile are run once.
    Finish,
    /// Roughing passes along an axis.
    Passes {
        /// Whether the passes are along X instead of Z.
        across: bool,
        /// Depth of a pass.
        depth: f64,
        /// Distance of the retract after each pass.
        back: f64,
        /// Allowance that the finish removes: on the radius, and along Z.
        left: [f64; 2],
    },
    /// Roughing along the whole profile, several times.
    Pattern {
        /// Distance of the first pass from the profile: on the radius, and along Z.
        outside: [f64; 2],
        /// Number of passes.
        count: u32,
        /// Allowance that the finish removes: on the radius, and along Z.
        left: [f64; 2],
    },
}
