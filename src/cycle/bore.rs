//! Boring with a retract while the spindle is stopped, boring with a move off the wall at a known spindle angle, and
//! boring from below.

use super::plan::{Defaults, Plan, Step};
use super::problem::Problem;
use crate::diag::Code;
use crate::toolpath::CycleSpec;

/// Feeds down, then retracts: with the spindle stopped, or with the spindle oriented and the tool moved off the wall.
pub(super) fn bore(
    spec: &CycleSpec,
    plan: &Plan,
    top: f64,
    defaults: &Defaults,
    steps: &mut Vec<Step>,
) -> Result<(), Problem> {
    steps.push(Step::Feed(plan.bottom, plan.feed));
    steps.extend(plan.dwell.map(Step::Dwell));
    match spec.orient.map(|orient| orient.angle(defaults.orient)) {
        None => steps.extend([Step::SpindleStop, Step::Rapid(top), Step::SpindleStart]),
        Some(angle) => {
            let (x, y) = aside(spec, angle, defaults);
            steps.extend([
                Step::Orient(angle),
                Step::RapidAside(plan.bottom + spec.jog.unwrap_or(0.0), -x, -y),
                Step::RapidAside(top, -x, -y),
                Step::Rapid(top),
                Step::SpindleStart,
            ]);
        }
    }
    Ok(())
}

/// The tool goes down beside the axis of the hole, moves to the axis, cuts upward from below, and goes out on the same
/// path.
pub(super) fn back_bore(
    spec: &CycleSpec,
    plan: &Plan,
    top: f64,
    defaults: &Defaults,
    steps: &mut Vec<Step>,
) -> Result<(), Problem> {
    let Some(below) = spec.rapto else {
        let message =
            "a back bore without `rapto`: the distance from the point down to the start of the upward cut is missing";
        return Err(Problem::new(Code::PC012, message, "give `rapto`"));
    };
    if -below > plan.bottom {
        let message = format!(
            "the cut of a back bore ends {} below the point, but begins only {below} below the point",
            -plan.bottom
        );
        return Err(Problem::new(Code::PC014, message, "give a smaller `depth`, or a deeper `rapto`"));
    }
    let angle = spec.orient.map_or(defaults.orient, |orient| orient.angle(defaults.orient));
    let (x, y) = aside(spec, angle, defaults);
    let lift = spec.jog.unwrap_or(0.0);
    steps.extend([Step::Orient(angle), Step::RapidAside(plan.clear, -x, -y), Step::RapidAside(-below, -x, -y)]);
    steps.extend([Step::Rapid(-below), Step::SpindleStart, Step::Feed(plan.bottom, plan.feed)]);
    steps.extend(plan.dwell.map(Step::Dwell));
    steps.extend([
        Step::Orient(angle),
        Step::RapidAside(plan.bottom - lift, -x, -y),
        Step::RapidAside(top, -x, -y),
        Step::Rapid(top),
        Step::SpindleStart,
    ]);
    Ok(())
}

/// The move off the wall: the offset that the cycle gives, or the cycle's jog in the direction of the spindle angle.
fn aside(spec: &CycleSpec, angle: f64, defaults: &Defaults) -> (f64, f64) {
    if let (Some(x), Some(y)) = (spec.offset, spec.offset_y) {
        return (x, y);
    }
    let jog = spec.offset.unwrap_or(defaults.jog);
    let (sin, cos) = angle.to_radians().sin_cos();
    (jog * cos, jog * sin)
}
