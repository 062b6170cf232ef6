//! The planes and the feed of a cycle, and the steps of a plan (docs/cycles.md).

use super::problem::Problem;
use crate::diag::Code;
use crate::toolpath::{CycleKind, CycleSpec};

/// Values that the form supplies if the cycle does not give them, in the units of the cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[allow(missing_docs)]
pub struct Defaults {
    pub clear: f64,
    pub step: Option<f64>,
    pub min_step: f64,
    pub back_deep: f64,
    pub back_chipbreak: f64,
    pub back_thru: f64,
    pub dwell: f64,
    pub dwell_at_steps: bool,
    pub dwell_at_retracts: bool,
    pub orient: f64,
    pub jog: f64,
    pub sink_clear: Option<f64>,
    /// Whether the depth of countersinks follows the formula printed in GENER's manual, tan(l / 2) k / 2.
    pub sink_as_printed: bool,
    /// Whether taps that only a control can make are planned too. Their plans are for comparison, not for printing.
    pub rigid: bool,
}

/// One step of a plan; heights are distances above the point, along the tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// Rapid to a height over the point.
    Rapid(f64),
    /// Rapid to a height, offset from the point by x and y.
    RapidAside(f64, f64, f64),
    /// Feed to a height.
    Feed(f64, f64),
    /// Dwell in seconds.
    Dwell(f64),
    /// Stop the spindle.
    SpindleStop,
    /// Start the spindle with the direction and speed from before the cycle.
    SpindleStart,
    /// Reverse the spindle, with its speed multiplied by this factor.
    SpindleReverse(f64),
    /// Orient the spindle to an angle.
    Orient(f64),
    /// Stop the program for the operator.
    ProgramStop,
}

/// The cycle's planes and feed, with the defaults filled in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// The height at which the feed begins, measured from the point.
    pub clear: f64,
    /// Height of the bottom relative to the point, usually negative.
    pub bottom: f64,
    /// The feed.
    pub feed: f64,
    /// The dwell at the bottom in seconds.
    pub dwell: Option<f64>,
    /// Feed per revolution, if the spindle speed is known.
    pub lead: Option<f64>,
}

impl Plan {
    /// The planes and the feed of a cycle at a point. If the point has no depth, the depth of the cycle applies.
    ///
    /// # Errors
    /// The depth or the feed is missing, or the depth is above the clearance.
    pub fn of(
        spec: &CycleSpec,
        own_depth: Option<f64>,
        defaults: &Defaults,
        rpm: Option<f64>,
    ) -> Result<Plan, Problem> {
        let clear = spec.clear.unwrap_or(defaults.clear);
        let sink = sink_depth(spec, defaults);
        one_depth(spec, own_depth, sink)?;
        let depth = own_depth.or_else(|| spec.deepest()).or(sink);
        let depth = match (depth, spec.kind) {
            (Some(depth), _) => depth,
            (None, CycleKind::Manual) => -clear,
            (None, _) => return Err(Problem::new(Code::PC002, "the cycle has no depth", "give `depth`")),
        };
        if clear + depth < 0.0 {
            let message = format!(
                "the bottom of the hole ({} below the point) is above the clearance plane ({} above the point)",
                rounded(depth),
                rounded(clear)
            );
            let help = if depth < 0.0 {
                "`depth` counts down from the point: write the number without the minus"
            } else {
                "give a deeper `depth` or a higher `clear`"
            };
            return Err(Problem::new(Code::PC003, message, help));
        }
        let feed = match (spec.feed, spec.kind) {
            (Some(feed), _) => feed,
            (None, CycleKind::Manual) => 0.0,
            (None, _) => return Err(Problem::new(Code::PC005, "the cycle has no feed", "give `feed`")),
        };
        let dwell = match (spec.dwell, spec.revs) {
            (None, Some(revs)) => match rpm.filter(|&rpm| rpm > 0.0) {
                Some(rpm) => Some(60.0 * revs / rpm),
                None => {
                    let help = "give the operation a spindle speed, or `dwell` in seconds";
                    return Err(Problem::new(
                        Code::PC009,
                        "a dwell in revolutions, but the spindle does not turn",
                        help,
                    ));
                }
            },
            (None, None) => (spec.kind == CycleKind::Face || spec.norevr).then_some(defaults.dwell),
            (seconds, _) => seconds,
        };
        let lead = rpm.filter(|&rpm| rpm > 0.0).map(|rpm| feed / rpm);
        Ok(Plan { clear, bottom: -depth, feed, dwell, lead })
    }
}

/// Checks that the depth of a hole is the depth that its other options give: the last of the webs, or the depth of the
/// countersink, which a job may give rounded. After the given pecks, a hole may be deeper.
fn one_depth(spec: &CycleSpec, own_depth: Option<f64>, sink: Option<f64>) -> Result<(), Problem> {
    const ROUNDED: f64 = 1e-3;
    let rows = [("`webs`", spec.webs.last().copied(), 1e-6), ("`diameter` and `angle`", sink, ROUNDED)];
    let Some(depth) = own_depth.or(spec.depth) else { return Ok(()) };
    let other = rows.iter().find_map(|&(name, other, part)| Some((name, other?, part)));
    match other.filter(|(_, other, part)| (depth - other).abs() > part * other.abs()) {
        None => Ok(()),
        Some((name, other, _)) => {
            let message = format!("the hole has a depth of {depth}, but its {name} give {}", rounded(other));
            Err(Problem::new(Code::PC016, message, format!("remove `depth`, or {name}")))
        }
    }
}

/// A calculated length for a message, without the last digits, which are not exact.
pub fn rounded(length: f64) -> f64 {
    const PARTS: f64 = 1e6;
    (length * PARTS).round() / PARTS
}

/// Depth of a countersink: by its geometry (k / 2) / tan(l / 2), or by the formula printed in GENER's manual.
fn sink_depth(spec: &CycleSpec, defaults: &Defaults) -> Option<f64> {
    let (diameter, angle) = (spec.diameter?, spec.angle?);
    let tangent = (angle.to_radians() / 2.0).tan();
    let depth = if defaults.sink_as_printed { tangent * diameter / 2.0 } else { diameter / 2.0 / tangent };
    (spec.kind == CycleKind::Csink).then_some(depth)
}
