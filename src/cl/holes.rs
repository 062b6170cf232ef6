//! The points of a cycle, each of which is a hole.

use super::cycle_dialects::Heights;
use super::fault::{Done, fault};
use super::job::Job;
use super::state::{Arcs, CodedReturn, Cycle, Motion, State};
use crate::diag::Code;
use crate::toolpath::{CycleSpec, Event, Hole};

/// Tolerance for rounded heights, in the file's units.
const BELOW_TOP: f64 = 1e-4;

/// Tolerance between a height and the same height above a point, both rounded, in the file's units.
const ROUNDED: f64 = 5e-4;

/// Handles a point while a cycle is active.
pub(super) fn point(at: [f64; 3], state: &mut State<'_>) -> Done {
    let Some(mut spec) = state.cycle.active.take() else { return Ok(()) };
    let State { job, motion, arcs, cycle, .. } = state;
    let done = hole(at, &mut spec, motion, arcs, cycle, job);
    cycle.active = Some(spec);
    done
}

fn hole(
    at: [f64; 3],
    spec: &mut CycleSpec,
    motion: &mut Motion,
    arcs: &mut Arcs,
    cycle: &mut Cycle,
    job: &mut Job<'_>,
) -> Done {
    let at = match cycle.heights {
        Some(heights) => top(at, heights, spec, job)?,
        None => at,
    };
    if !job.holes_are_open() {
        job.turns()?;
        // sinks measure the return plane from the first point; if the clearance is higher, they use the clearance
        spec.return_height = return_plane(at, spec, motion, cycle)?.map(|plane| plane - at[2]);
        job.open_holes(spec)?;
    }
    job.push(Event::Hole(Hole { at: job.axes(at)?, depth: None }))?;
    // the tool's position after the hole is known only if the clearance is known
    motion.position = spec.clear.map(|clear| {
        let plane = cycle.plane.flatten().unwrap_or(f64::MIN);
        [at[0], at[1], plane.max(at[2] + clear)]
    });
    arcs.heading = None;
    Ok(())
}

/// The top of a hole whose bottom is given. Calculates the clearance above the top from the heights of the cycle.
fn top(bottom: [f64; 3], heights: Heights, spec: &mut CycleSpec, job: &mut Job<'_>) -> Done<[f64; 3]> {
    let top = bottom[2] + heights.depth;
    let clear = heights.retract - top;
    if clear < -BELOW_TOP {
        let message = format!("the feed of the cycle begins at {}, but the top of this hole is {top}", heights.retract);
        return fault(Code::PC004, message, "raise the retract height in the CAM system");
    }
    let clear = clear.max(0.0);
    if spec.clear.is_none_or(|before| (before - clear).abs() > BELOW_TOP) {
        job.close_holes()?;
        spec.clear = Some(clear);
    }
    Ok([bottom[0], bottom[1], top])
}

/// The height to which the tool returns after each hole. The height is determined at the first point and applies to the
/// whole cycle.
fn return_plane(at: [f64; 3], spec: &CycleSpec, motion: &Motion, cycle: &mut Cycle) -> Done<Option<f64>> {
    if let Some(plane) = cycle.plane {
        return Ok(plane);
    }
    let plane = match cycle.returns {
        None => None,
        Some(CodedReturn::Above(above)) => Some(at[2] + above),
        Some(CodedReturn::Height { height, above }) => {
            if let Some(above) = above.filter(|above| (at[2] + above - height).abs() > ROUNDED) {
                let message = format!(
                    "the return plane is at {height}, and also {above} above the first point, which is at {}",
                    at[2]
                );
                return fault(Code::PC040, message, "let the CAM system write the file again");
            }
            Some(height)
        }
        Some(CodedReturn::Clearance) => match spec.clear {
            Some(clear) => Some(at[2] + clear),
            None => {
                let help = "write CLEAR in the cycle, or a height after RETURN";
                return fault(Code::PC040, "RETURN without a height, and no CLEAR before it", help);
            }
        },
        Some(CodedReturn::Start) => match motion.position {
            Some(position) => Some(position[2]),
            None => {
                let help = "put a GOTO before the cycle, or give CYCLE/RETURN a height";
                return fault(Code::PC040, "CYCLE/RETURN,ON, but the height of the tool is unknown", help);
            }
        },
    };
    cycle.plane = Some(plane);
    Ok(plane)
}
