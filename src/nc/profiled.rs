//! Data of the blocks of turning cycles.

/// Data of the first blocks of the cycles. It stays in force until another first block.
#[derive(Clone, Copy, Debug, Default)]
pub struct FirstBlocks {
    /// Depth of a pass of G71, and its retract.
    pub turn: [Option<f64>; 2],
    /// Depth of a pass of G72, and its retract.
    pub face: [Option<f64>; 2],
    /// Distance of the first pass of G73 from the profile along X and Z, and the number of passes.
    pub pattern: [Option<f64>; 3],
    /// Retract of G74 and G75 after a peck.
    pub back: Option<f64>,
    /// A chamfer or rounded corner that the next block must leave.
    pub corner: Option<Corner>,
}

/// A chamfer or rounded corner that was cut, and the required direction of the next block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// The axis along which the next block moves.
    pub axis: usize,
    /// Distance from the corner to the end of the chamfer along that axis, with its sign.
    pub by: f64,
}

/// A cycle that follows a profile of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profiled {
    /// The number of the profile's first block.
    pub first: f64,
    /// The number of its last block.
    pub last: f64,
    /// How the profile is cut.
    pub how: How,
}

/// How a profile is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum How {
    /// The blocks of the profile are run once.
    Finish,
    /// Passes along an axis.
    Passes {
        /// Whether the passes are along X instead of Z.
        across: bool,
        /// Depth of a pass.
        depth: f64,
        /// Retract after each pass.
        back: f64,
        /// Allowance for the finish: radius and Z.
        left: [f64; 2],
    },
    /// The whole profile, several times.
    Pattern {
        /// Distance of the first pass from the profile: radius and Z.
        outside: [f64; 2],
        /// Number of passes.
        count: u32,
        /// Allowance for the finish: radius and Z.
        left: [f64; 2],
    },
}
