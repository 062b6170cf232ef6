//! Tapping: feed and spindle are synchronised. With a floating holder, single moves can tap the thread; rigid tapping
//! requires a tapping cycle of the control.

use super::pecks::{Peck, pecks};
use super::plan::{Defaults, Plan, Step};
use super::problem::Problem;
use crate::diag::Code;
use crate::toolpath::{CycleKind, CycleSpec};

/// Feeds down, reverses the spindle, and feeds out. A rigid tap is planned only for the comparison with a program.
pub(super) fn tap(
    spec: &CycleSpec,
    plan: &Plan,
    enter: f64,
    defaults: &Defaults,
    list: &mut Vec<Peck>,
    steps: &mut Vec<Step>,
) -> Result<(), Problem> {
    let dwell = plan.dwell.map(Step::Dwell);
    if spec.rapout || spec.norevr {
        steps.push(Step::Feed(plan.bottom, plan.feed));
        steps.extend(dwell);
        return Ok(());
    }
    let rigid = spec.rigid == Some(true) || spec.mode.is_some();
    if rigid && !defaults.rigid {
        let message = "a rigid or pecking tap must be synchronized with the spindle: single moves can't do this";
        return Err(Problem::new(
            Code::PC021,
            message,
            "give the form a Tap sequence with the tapping cycle of the control",
        ));
    }
    let starts = spec.starts.unwrap_or(1.0).max(1.0) as u32;
    let lead = plan.lead.unwrap_or(0.0);
    let ratio = spec.ratio.unwrap_or(1.0);
    for start in 0..starts {
        let lower = lead * f64::from(start) / f64::from(starts);
        let out = plan.clear - lower;
        if start > 0 {
            steps.push(Step::Rapid(out));
        }
        pecks(spec, plan, defaults, list)?;
        let last = list.len() - 1;
        for (i, peck) in list.iter().enumerate() {
            steps.push(Step::Feed(peck.height, plan.feed));
            if i == last {
                steps.extend(dwell);
                steps.extend([Step::SpindleReverse(ratio), Step::Feed(out, plan.feed * ratio), Step::SpindleStart]);
            } else if spec.mode == Some(CycleKind::Deep) {
                let in_out = plan.feed * ratio;
                steps.extend([Step::SpindleReverse(ratio), Step::Feed(enter - lower, in_out), Step::SpindleStart]);
                steps.push(Step::Feed(peck.height, in_out));
            } else {
                let back = spec.back.unwrap_or(defaults.back_chipbreak);
                let up = (peck.height + back).min(out);
                steps.extend([Step::SpindleReverse(1.0), Step::Feed(up, plan.feed), Step::SpindleStart]);
            }
        }
    }
    Ok(())
}
