//! What the tool does at one point of a cycle (cycles.md section 1.5).

use super::bore::{back_bore, bore};
use super::pecks::{Peck, peck};
use super::problem::Problem;
use super::tap::tap;
use crate::diag::Code;
use crate::toolpath::{CycleKind, CycleSpec};

/// What a form gives where a cycle names nothing, in the units of the cycle.
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
    /// Countersinks by the formula that GENER's manual prints, tan(l / 2) k / 2.
    pub sink_as_printed: bool,
    /// Taps that only a control can make are planned too: for those who compare, not for those who print.
    pub rigid: bool,
}

/// One step; heights are above the point along the tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// Rapid to a height over the point.
    Rapid(f64),
    /// Rapid to a height, aside from the point by x and y.
    RapidAside(f64, f64, f64),
    /// Feed to a height.
    Feed(f64, f64),
    /// Dwell in seconds.
    Dwell(f64),
    /// Stop the spindle.
    SpindleStop,
    /// Start it in the direction, and with the speed, that it had before the cycle.
    SpindleStart,
    /// Turn it the other way, at this many times its speed.
    SpindleReverse(f64),
    /// Stop it at an angle.
    Orient(f64),
    /// Let the operator act.
    ProgramStop,
}

/// The cycle's planes and feed, with the defaults filled in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Where the feed begins, above the point.
    pub clear: f64,
    /// The bottom, above the point, so mostly negative.
    pub bottom: f64,
    /// The feed.
    pub feed: f64,
    /// The dwell at the bottom in seconds.
    pub dwell: Option<f64>,
    /// How far the feed goes in a revolution, where the spindle speed is known.
    pub lead: Option<f64>,
}

impl Plan {
    /// The planes of a cycle at a point with its own depth or the cycle's.
    ///
    /// # Errors
    /// A depth or feed that is missing, a depth above the clearance.
    pub fn of(
        spec: &CycleSpec,
        own_depth: Option<f64>,
        defaults: &Defaults,
        rpm: Option<f64>,
    ) -> Result<Plan, Problem> {
        let clear = spec.clear.unwrap_or(defaults.clear);
        let depth = own_depth.or_else(|| spec.deepest()).or_else(|| sink_depth(spec, defaults));
        let depth = match (depth, spec.kind) {
            (Some(depth), _) => depth,
            (None, CycleKind::Manual) => -clear,
            (None, _) => return Err(Problem::new(Code::PC002, "the cycle has no depth", "give `depth`")),
        };
        if clear + depth < 0.0 {
            let message =
                format!("the bottom, {depth} below the point, is above the clearance plane, {clear} above it");
            return Err(Problem::new(Code::PC003, message, "give a deeper `depth` or a higher `clear`"));
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
                        "a dwell in revolutions, and the spindle does not turn",
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

/// Depth of a countersink: by its geometry (k / 2) / tan(l / 2), or as GENER's manual prints it.
fn sink_depth(spec: &CycleSpec, defaults: &Defaults) -> Option<f64> {
    let (diameter, angle) = (spec.diameter?, spec.angle?);
    let tangent = (angle.to_radians() / 2.0).tan();
    let depth = if defaults.sink_as_printed { tangent * diameter / 2.0 } else { diameter / 2.0 / tangent };
    (spec.kind == CycleKind::Csink).then_some(depth)
}

/// The steps at one point, and what planning needs; kept from hole to hole so that a hole allocates nothing.
#[derive(Debug, Default)]
pub struct Steps {
    /// The steps.
    pub list: Vec<Step>,
    pecks: Vec<Peck>,
}

/// Plans the steps at one point. The tool is over the point at `top`, a height, and comes back there.
///
/// # Errors
/// What can't be made of single moves, or makes no sense.
pub fn plan(spec: &CycleSpec, plan: &Plan, top: f64, defaults: &Defaults, out: &mut Steps) -> Result<(), Problem> {
    use CycleKind as K;
    let Steps { list: steps, pecks } = out;
    steps.clear();
    let Plan { clear, bottom, feed, dwell, .. } = *plan;
    let mut enter = clear;
    steps.push(Step::Rapid(clear));
    if let Some(rapto) = spec.rapto.filter(|_| spec.kind != K::Back) {
        enter = clear - rapto;
        if enter < bottom {
            let message = format!("the extra rapid of {rapto} from the clearance plane ends below the bottom");
            return Err(Problem::new(Code::PC013, message, "give a smaller `rapto`"));
        }
        steps.push(Step::Rapid(enter));
    }
    let dwell_step = dwell.map(Step::Dwell);
    match spec.kind {
        K::Drill | K::Face => {
            steps.push(Step::Feed(bottom, feed));
            steps.extend(dwell_step);
        }
        K::Tap | K::LTap => tap(spec, plan, enter, defaults, pecks, steps)?,
        K::Ream => {
            steps.push(Step::Feed(bottom, feed));
            steps.extend(dwell_step);
            steps.push(Step::Feed(clear, feed * spec.ratio.unwrap_or(1.0)));
        }
        K::Bore => return bore(spec, plan, top, defaults, steps),
        K::Back => return back_bore(spec, plan, top, defaults, steps),
        K::Deep | K::Chipbreak => peck(spec, plan, enter, defaults, pecks, steps)?,
        K::Thru => thru(spec, plan, defaults, steps),
        K::Csink => {
            if let (Some(hole), Some(angle)) = (spec.hole_diameter, spec.angle) {
                let contact = -(hole / 2.0) / (angle.to_radians() / 2.0).tan();
                let above = (contact + defaults.sink_clear.unwrap_or(clear)).min(enter);
                if above > bottom && above < enter {
                    steps.push(Step::Rapid(above));
                }
            }
            steps.push(Step::Feed(bottom, feed));
            steps.extend(dwell_step);
        }
        K::Manual => {
            steps.push(Step::ProgramStop);
            return Ok(());
        }
        K::Custom1 | K::Custom2 | K::Custom3 => {
            let message = "only the form knows what a custom cycle does, and it has no such sequence";
            return Err(Problem::new(Code::PC001, message, "add the sequence to the form, or take another `kind`"));
        }
    }
    steps.push(Step::Rapid(top));
    Ok(())
}

/// Drilling through webs: end, then start and end of each further web.
fn thru(spec: &CycleSpec, plan: &Plan, defaults: &Defaults, steps: &mut Vec<Step>) {
    let whole = [-plan.bottom];
    let webs = if spec.webs.is_empty() { &whole[..] } else { &spec.webs };
    let back = spec.back.unwrap_or(defaults.back_thru);
    let mut reached = -webs[0];
    steps.push(Step::Feed(reached, plan.feed));
    for pair in webs[1..].chunks_exact(2) {
        steps.push(Step::Rapid((-pair[0] + back).min(reached)));
        reached = -pair[1];
        steps.push(Step::Feed(reached, plan.feed));
    }
    steps.extend(plan.dwell.map(Step::Dwell));
}

#[cfg(test)]
mod tests {
    use super::Step::*;
    use super::*;
    use crate::cycle::check;

    const DEFAULTS: Defaults = Defaults {
        clear: 0.1,
        step: None,
        min_step: 0.0,
        back_deep: 0.05,
        back_chipbreak: 0.05,
        back_thru: 0.05,
        dwell: 0.5,
        dwell_at_steps: false,
        dwell_at_retracts: false,
        orient: 0.0,
        jog: 0.02,
        sink_clear: None,
        sink_as_printed: false,
        rigid: false,
    };

    fn steps(edit: impl FnOnce(&mut CycleSpec), kind: CycleKind) -> Result<Vec<Step>, Code> {
        let mut spec = CycleSpec::new(kind);
        (spec.depth, spec.feed) = (Some(1.0), Some(5.0));
        edit(&mut spec);
        check(&spec).map_err(|p| p.code)?;
        let planes = Plan::of(&spec, None, &DEFAULTS, None).map_err(|p| p.code)?;
        let mut out = Steps::default();
        plan(&spec, &planes, 0.2, &DEFAULTS, &mut out).map_err(|p| p.code)?;
        Ok(out.list)
    }

    #[test]
    fn holes_are_fed_and_left_as_their_kind_says() {
        assert_eq!(steps(|_| (), CycleKind::Drill).unwrap(), [Rapid(0.1), Feed(-1.0, 5.0), Rapid(0.2)]);
        assert_eq!(steps(|_| (), CycleKind::Face).unwrap(), [Rapid(0.1), Feed(-1.0, 5.0), Dwell(0.5), Rapid(0.2)]);
        assert_eq!(steps(|_| (), CycleKind::Ream).unwrap(), [Rapid(0.1), Feed(-1.0, 5.0), Feed(0.1, 5.0), Rapid(0.2)]);
        assert_eq!(
            steps(|_| (), CycleKind::Tap).unwrap(),
            [Rapid(0.1), Feed(-1.0, 5.0), SpindleReverse(1.0), Feed(0.1, 5.0), SpindleStart, Rapid(0.2)]
        );
        assert_eq!(
            steps(|s| s.step = Some(0.6), CycleKind::Chipbreak).unwrap(),
            [Rapid(0.1), Feed(-0.5, 5.0), Rapid(-0.45), Feed(-1.0, 5.0), Rapid(0.2)]
        );
        assert_eq!(
            steps(|s| s.step = Some(0.6), CycleKind::Deep).unwrap(),
            [Rapid(0.1), Feed(-0.5, 5.0), Rapid(0.1), Rapid(-0.45), Feed(-1.0, 5.0), Rapid(0.2)]
        );
    }

    #[test]
    fn what_makes_no_sense_is_refused_by_name() {
        assert_eq!(steps(|s| s.depth = None, CycleKind::Drill), Err(Code::PC002));
        assert_eq!(steps(|s| s.depth = Some(-0.2), CycleKind::Drill), Err(Code::PC003));
        assert_eq!(steps(|s| s.feed = None, CycleKind::Drill), Err(Code::PC005));
        assert_eq!(steps(|s| s.rigid = Some(true), CycleKind::Tap), Err(Code::PC021));
        assert_eq!(steps(|s| s.offset = Some(0.1), CycleKind::Bore), Err(Code::PC015));
        assert_eq!(steps(|_| (), CycleKind::Back), Err(Code::PC012));
        assert_eq!(steps(|s| s.webs = vec![0.5, 1.0], CycleKind::Thru), Err(Code::PC022));
        assert_eq!(steps(|s| s.rapto = Some(2.0), CycleKind::Drill), Err(Code::PC013));
        assert_eq!(steps(|_| (), CycleKind::Custom1), Err(Code::PC001));
    }

    /// Reference motions of what only a control can make: two starts, the second a lead's half lower.
    #[test]
    fn rigid_taps_are_planned_for_comparison() {
        let mut spec = CycleSpec::new(CycleKind::Tap);
        (spec.depth, spec.feed, spec.clear) = (Some(10.0), Some(900.0), Some(5.0));
        (spec.rigid, spec.starts) = (Some(true), Some(2.0));
        let defaults = Defaults { rigid: true, ..DEFAULTS };
        let planes = Plan::of(&spec, None, &defaults, Some(300.0)).unwrap();
        let mut out = Steps::default();
        plan(&spec, &planes, 5.0, &defaults, &mut out).unwrap();
        let pass = |clear| [Rapid(clear), Feed(-10.0, 900.0), SpindleReverse(1.0), Feed(clear, 900.0), SpindleStart];
        assert_eq!(out.list, [&pass(5.0)[..], &pass(3.5), &[Rapid(5.0)]].concat());
    }
}
