//! Pecking: the depths, and the moves between them.

use super::plan::{Defaults, Plan, Step};
use super::problem::Problem;
use crate::diag::Code;
use crate::toolpath::{self, CycleKind, CycleSpec, MOST_PECKS};

/// If two depths differ by less than this value, they are equal (in inches or millimetres).
const SAME: f64 = 1e-9;

/// One peck: its depth, and its feed if the peck has a feed of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peck {
    /// Height above the point; negative if below the point.
    pub height: f64,
    /// Feed of the peck if it differs from the cycle's feed, in the feed mode of the cycle (units per minute or per
    /// revolution).
    pub feed: Option<f64>,
}

/// Pecks with full retracts, or chip breaks with a full retract after every `times` pecks.
pub(super) fn peck(
    spec: &CycleSpec,
    plan: &Plan,
    from: f64,
    defaults: &Defaults,
    list: &mut Vec<Peck>,
    steps: &mut Vec<Step>,
) -> Result<(), Problem> {
    let deep = spec.kind == CycleKind::Deep;
    let back = spec.back.unwrap_or(if deep { defaults.back_deep } else { defaults.back_chipbreak });
    pecks(spec, plan, defaults, list)?;
    let last = list.len() - 1;
    for (i, peck) in list.iter().enumerate() {
        if peck.height > from {
            let message = "the extra rapid ends below the first peck";
            return Err(Problem::new(Code::PC013, message, "give a smaller `rapto`"));
        }
        steps.push(Step::Feed(peck.height, peck.feed.unwrap_or(plan.feed)));
        if i == last {
            steps.extend(plan.dwell.map(Step::Dwell));
            break;
        }
        if defaults.dwell_at_steps {
            steps.extend(plan.dwell.map(Step::Dwell));
        }
        let full = deep || spec.times.is_some_and(|m| m >= 1.0 && (i + 1) % (m as usize) == 0);
        if full {
            steps.push(Step::Rapid(plan.clear));
            if defaults.dwell_at_retracts {
                steps.extend(plan.dwell.map(Step::Dwell));
            }
        }
        steps.push(Step::Rapid((peck.height + back).min(plan.clear)));
    }
    Ok(())
}

/// The pecks down to the bottom of a plan. `list` is cleared first; the caller owns `list`, so that no memory is
/// allocated for a hole.
pub(super) fn pecks(spec: &CycleSpec, plan: &Plan, defaults: &Defaults, list: &mut Vec<Peck>) -> Result<(), Problem> {
    list.clear();
    let bottom = plan.bottom;
    let pecks = matches!(spec.kind, CycleKind::Deep | CycleKind::Chipbreak) || spec.mode.is_some();
    if !spec.pecks.is_empty() {
        return absolute(spec, plan, list);
    }
    match spec.step.or(defaults.step).filter(|_| pecks) {
        Some(step) => stepped(spec, plan, (step, defaults), list),
        None => {
            list.push(Peck { height: bottom, feed: None });
            Ok(())
        }
    }
}

fn absolute(spec: &CycleSpec, plan: &Plan, list: &mut Vec<Peck>) -> Result<(), Problem> {
    let mut reached = plan.clear;
    for peck in &spec.pecks {
        if -peck.to >= reached - SAME && !(list.is_empty() && -peck.to <= reached) {
            let message = format!("the peck to {} does not go deeper than the peck before", peck.to);
            return Err(Problem::new(
                Code::PC004,
                message,
                "give each absolute peck a greater depth than the peck before",
            ));
        }
        reached = (-peck.to).max(plan.bottom);
        list.push(Peck { height: reached, feed: peck.feed });
    }
    if reached > plan.bottom + SAME {
        list.push(Peck { height: plan.bottom, feed: None });
    }
    Ok(())
}

/// Plans pecks from steps. The steps are measured from the clearance plane, as for Q on a control, or from the point,
/// as in APT.
fn stepped(
    spec: &CycleSpec,
    plan: &Plan,
    (step, defaults): (f64, &Defaults),
    list: &mut Vec<Peck>,
) -> Result<(), Problem> {
    let exhausted = || {
        let message = "the steps become zero before the bottom is reached";
        Problem::new(Code::PC029, message, "give a smaller `decr`, or a `min_step`")
    };
    let from = if spec.steps_from_point { 0.0 } else { plan.clear };
    let decr = spec.decr.unwrap_or(0.0);
    let first = spec.first_step.unwrap_or(step);
    let least = spec.min_step.unwrap_or(defaults.min_step);
    // distances below `from`; the depths are exact, because k * step replaces a running sum
    let total = from - plan.bottom;
    let (mut reached, mut next, mut repeats) = (0.0, first, 0);
    while reached + next < total - SAME {
        if list.len() == MOST_PECKS {
            let message = format!("more than {MOST_PECKS} pecks in one hole");
            return Err(Problem::new(Code::PC028, message, "give a larger `step`"));
        }
        repeats += 1;
        if decr == 0.0 {
            reached = first + f64::from(repeats - 1) * step;
            next = step;
        } else {
            reached += next;
            next = (step - decr * f64::from(repeats)).max(least);
            if next <= 0.0 {
                return Err(exhausted());
            }
        }
        list.push(Peck { height: from - reached, feed: None });
    }
    list.push(Peck { height: plan.bottom, feed: None });
    Ok(())
}

/// Converts a list of steps, each with its feed, to absolute pecks. The last step repeats until `depth` is reached.
/// Each repeated step is smaller than the step before it by `decr`, but not smaller than `least`. Steps that are not
/// needed are left out. The unit of the lengths does not matter.
///
/// # Errors
/// A step is zero or negative, or the steps shrink to zero.
///
/// ```
/// use postform::internals::cycle::stepped_pecks;
/// let depths = |pecks: Vec<postform::toolpath::Peck>| pecks.iter().map(|p| p.to).collect::<Vec<_>>();
/// assert_eq!(stepped_pecks(7.0, &[(4.0, None), (2.0, None)], None, None).map(depths), Ok(vec![4.0, 6.0, 7.0]));
/// ```
pub fn stepped_pecks(
    depth: f64,
    steps: &[(f64, Option<f64>)],
    decr: Option<f64>,
    least: Option<f64>,
) -> Result<Vec<toolpath::Peck>, Problem> {
    let mut list = Vec::new();
    let (mut reached, mut shrunk) = (0.0, 0.0);
    let decr = decr.unwrap_or(0.0);
    for k in 0.. {
        let Some(&(step, feed)) = steps.get(k).or(steps.last()) else { break };
        if k >= steps.len() {
            shrunk += decr;
        }
        let step = if shrunk > 0.0 { (step - shrunk).max(least.unwrap_or(0.0)) } else { step };
        if step <= 0.0 {
            let (code, message) = match shrunk > 0.0 {
                true => (Code::PC029, "the steps become zero before the depth is reached"),
                false => (Code::PC028, "a step that is not above zero"),
            };
            return Err(Problem::new(code, message, "give larger steps, a smaller `decr`, or a least step"));
        }
        if list.len() == MOST_PECKS {
            let message = format!("more than {MOST_PECKS} pecks in one hole");
            return Err(Problem::new(Code::PC028, message, "give larger steps"));
        }
        reached += step;
        let last = reached >= depth - SAME;
        list.push(toolpath::Peck { to: if last { depth } else { reached }, feed });
        if last {
            break;
        }
    }
    Ok(list)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::toolpath::CycleKind;

    fn planned(spec: &CycleSpec, from: f64, bottom: f64, list: &mut Vec<Peck>) -> Result<(), Problem> {
        pecks(spec, &Plan { clear: from, bottom, feed: 1.0, dwell: None, lead: None }, &Defaults::default(), list)
    }

    fn heights(spec: &CycleSpec, from: f64, bottom: f64, step: Option<f64>) -> Vec<f64> {
        let mut list = Vec::new();
        planned(&CycleSpec { step, ..spec.clone() }, from, bottom, &mut list).unwrap();
        list.iter().map(|p: &Peck| (p.height * 1e6).round() / 1e6).collect()
    }

    #[test]
    fn steps_count_from_the_clearance_plane_and_the_last_is_cut_short() {
        let spec = CycleSpec::new(CycleKind::Deep);
        assert_eq!(heights(&spec, 0.1, -0.375, Some(0.125)), [-0.025, -0.15, -0.275, -0.375]);
        assert_eq!(heights(&spec, 0.0, -0.3, Some(0.1)), [-0.1, -0.2, -0.3]);
        assert_eq!(heights(&spec, 0.0, -0.3, None), [-0.3]);
        let apt = CycleSpec { steps_from_point: true, ..spec };
        assert_eq!(heights(&apt, 0.1, -0.375, Some(0.125)), [-0.125, -0.25, -0.375]);
    }

    #[test]
    fn shrinking_steps_stop_at_the_least_or_are_refused() {
        let mut spec = CycleSpec::new(CycleKind::Deep);
        spec.decr = Some(1.0);
        let mut list = Vec::new();
        (spec.step, spec.min_step) = (Some(4.0), Some(2.0));
        planned(&spec, 0.0, -10.0, &mut list).unwrap();
        assert_eq!(list.iter().map(|p| p.height).collect::<Vec<_>>(), [-4.0, -7.0, -9.0, -10.0]);
        spec.decr = Some(2.0);
        (spec.step, spec.min_step) = (Some(6.0), None);
        assert_eq!(planned(&spec, 0.0, -20.0, &mut list).unwrap_err().code, Code::PC029);
    }
}
