//! How controls move through corners between blocks.

/// The rule of a control for corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Corner {
    /// The speed in a corner is the speed on an arc at this distance from the corner, in millimetres: `$11` of Grbl.
    Deviation(f64),
    /// The rule of LinuxCNC's trajectory planner, with this path mode at the beginning.
    Linuxcnc(PathMode),
}

/// The accuracy of the path, named by the codes of LinuxCNC.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathMode {
    /// G61: the path passes exactly through the corners.
    Exact,
    /// G61.1: each block ends with a stop.
    Stop,
    /// G64: corners are rounded; P is the tolerance in millimetres.
    Blend(Option<f64>),
}
