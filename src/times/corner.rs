//! The behaviour of controls in corners.

/// The rule of a control for corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Corner {
    /// As on an arc around the corner whose distance from the corner is this value, in millimetres: Grbl's `$11`.
    Deviation(f64),
    /// As in LinuxCNC's trajectory planner, which begins in this mode.
    Linuxcnc(PathMode),
}

/// The accuracy of the path, by the codes of LinuxCNC.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathMode {
    /// G61: the path passes exactly through the corners.
    Exact,
    /// G61.1: each block ends with a stop.
    Stop,
    /// G64: corners are rounded; P is the tolerance in millimetres.
    Blend(Option<f64>),
}
