//! What turning cycles say: data of their blocks.

/// What the first blocks of the cycles said: it stays until another says otherwise.
#[derive(Clone, Copy, Debug, Default)]
pub struct FirstBlocks {
    /// Depth of a pass of G71, and how far it goes back.
    pub turn: [Option<f64>; 2],
    /// The same of G72.
    pub face: [Option<f64>; 2],
    /// How far the first pass of G73 lies outside along X and Z, and how many passes there are.
    pub pattern: [Option<f64>; 3],
    /// How far G74 and G75 go back after a peck.
    pub back: Option<f64>,
    /// A chamfer or rounded corner that the next block leaves.
    pub corner: Option<Corner>,
}

/// A chamfer or a rounded corner that was cut, and what the next block has to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// The axis along which the next block moves.
    pub axis: usize,
    /// From the corner to where the chamfer ends along it, with its sign.
    pub by: f64,
}

/// A cycle that follows a profile of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profiled {
    /// Numbers of the profile's first block and its last.
    pub first: f64,
    /// The last.
    pub last: f64,
    /// How it is made.
    pub how: How,
}

/// How a profile is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum How {
    /// Its blocks are run.
    Finish,
    /// In passes along an axis.
    Passes {
        /// Along X, not along Z.
        across: bool,
        /// Depth of a pass.
        depth: f64,
        /// How far each pass goes back.
        back: f64,
        /// What is left for the finish: radius and Z.
        left: [f64; 2],
    },
    /// As a whole, so many times.
    Pattern {
        /// How far the first one lies outside: radius and Z.
        outside: [f64; 2],
        /// How often.
        count: u32,
        /// What is left for the finish: radius and Z.
        left: [f64; 2],
    },
}
