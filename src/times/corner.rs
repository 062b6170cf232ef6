//! How controls go around corners.

/// The rule of a control for corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Corner {
    /// As if an arc went around it that leaves the corner by so much, in millimetres: Grbl's `$11`.
    Deviation(f64),
    /// As LinuxCNC's trajectory planner does, which begins in this mode.
    Linuxcnc(PathMode),
}

/// How exactly a path is followed, by the codes of LinuxCNC.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathMode {
    /// G61: corners are met exactly.
    Exact,
    /// G61.1: each block ends with a stop.
    Stop,
    /// G64: corners are rounded, within a tolerance in millimetres where P gives one.
    Blend(Option<f64>),
}
