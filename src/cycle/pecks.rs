//! Depths of a peck cycle.

use super::plan::Problem;
use crate::toolpath::CycleSpec;

/// Most pecks of one hole: more is a slip of the decimal point.
const MOST_PECKS: usize = 10_000;

/// Depths that differ by less are one (units of any length).
const SAME: f64 = 1e-9;

/// One peck: the height it feeds to, and its feed where it has its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeckDepth {
    /// Height above the point; negative below it.
    pub height: f64,
    /// Its feed, if not the cycle's.
    pub feed: Option<f64>,
}

/// The pecks from the clearance plane `from` (a height) down to `bottom`.
///
/// Steps count from the clearance plane like a control's Q; absolute pecks count from the point. `list` is cleared
/// first: it is the caller's, so that a hole allocates nothing.
pub fn pecks(
    spec: &CycleSpec,
    from: f64,
    bottom: f64,
    (step, least): (Option<f64>, f64),
    list: &mut Vec<PeckDepth>,
) -> Result<(), Problem> {
    list.clear();
    if !spec.pecks.is_empty() {
        let mut reached = from;
        for peck in &spec.pecks {
            if -peck.to >= reached - SAME {
                return Err(Problem::new("cycle.depth.order", "absolute pecks must go deeper one by one"));
            }
            reached = (-peck.to).max(bottom);
            list.push(PeckDepth { height: reached, feed: peck.feed });
        }
        if reached > bottom + SAME {
            list.push(PeckDepth { height: bottom, feed: None });
        }
        return Ok(());
    }
    let Some(step) = step else {
        list.push(PeckDepth { height: bottom, feed: None });
        return Ok(());
    };
    let decr = spec.decr.unwrap_or(0.0);
    let first = spec.first_step.unwrap_or(step);
    // distances below `from`; k * step rather than a running sum keeps the depths exact
    let total = from - bottom;
    let (mut reached, mut next, mut repeats) = (0.0, first, 0);
    while reached + next < total - SAME {
        if list.len() == MOST_PECKS {
            return Err(Problem::new("cycle.step.nonpositive", format!("more than {MOST_PECKS} pecks in one hole")));
        }
        repeats += 1;
        if decr == 0.0 {
            reached = first + f64::from(repeats - 1) * step;
            next = step;
        } else {
            reached += next;
            let shrunk = step - decr * f64::from(repeats);
            next = shrunk.max(least);
            if next <= 0.0 {
                return Err(Problem::new(
                    "cycle.decr.exhausted",
                    "the pecks shrink to nothing before the bottom is reached",
                ));
            }
        }
        list.push(PeckDepth { height: from - reached, feed: None });
    }
    list.push(PeckDepth { height: bottom, feed: None });
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::toolpath::CycleKind;

    fn heights(spec: &CycleSpec, from: f64, bottom: f64, step: Option<f64>) -> Vec<f64> {
        let mut list = Vec::new();
        pecks(spec, from, bottom, (step, 0.0), &mut list).unwrap();
        list.iter().map(|p| (p.height * 1e6).round() / 1e6).collect()
    }

    #[test]
    fn steps_count_from_the_clearance_plane_and_the_last_is_cut_short() {
        let spec = CycleSpec::new(CycleKind::Deep);
        assert_eq!(heights(&spec, 0.1, -0.375, Some(0.125)), [-0.025, -0.15, -0.275, -0.375]);
        assert_eq!(heights(&spec, 0.0, -0.3, Some(0.1)), [-0.1, -0.2, -0.3]);
        assert_eq!(heights(&spec, 0.0, -0.3, None), [-0.3]);
    }

    #[test]
    fn shrinking_steps_stop_at_the_least_or_are_refused() {
        let mut spec = CycleSpec::new(CycleKind::Deep);
        spec.decr = Some(1.0);
        let mut list = Vec::new();
        pecks(&spec, 0.0, -10.0, (Some(4.0), 2.0), &mut list).unwrap();
        assert_eq!(list.iter().map(|p| p.height).collect::<Vec<_>>(), [-4.0, -7.0, -9.0, -10.0]);
        spec.decr = Some(2.0);
        assert_eq!(pecks(&spec, 0.0, -20.0, (Some(6.0), 0.0), &mut list).unwrap_err().code, "cycle.decr.exhausted");
    }
}
