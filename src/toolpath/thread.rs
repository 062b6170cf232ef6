//! A thread on a lathe.

use super::axes::Axes;

/// A thread on a lathe. The positions of the thread are z, and x as a radius. Lengths are in the job's units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thread {
    /// Start of the thread: z, and the radius of the crest.
    pub from: Axes,
    /// End of the thread: z, and the radius of the crest.
    pub to: Axes,
    /// Distance between two crests.
    pub pitch: f64,
    /// Height of the thread, measured on the radius. The height of an internal thread, which is cut outward, is
    /// negative.
    pub depth: f64,
    /// Depth of the first cut, on the radius.
    pub first_depth: Option<f64>,
    /// Depth of the smallest cut, on the radius.
    pub min_depth: Option<f64>,
    /// Radius at the start minus the radius at the end of the thread.
    pub taper: Option<f64>,
    /// Angle between the flanks, in degrees.
    pub angle: Option<f64>,
    /// Number of passes.
    pub passes: Option<f64>,
    /// Length of the runout, in the unit that the control uses.
    pub chamfer: Option<f64>,
    /// Number of starts.
    pub starts: Option<f64>,
}
