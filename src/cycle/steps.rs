//! The motions of the tool at one point of a cycle (docs/cycles.md).

use super::bore::{back_bore, bore};
use super::pecks::{Peck, peck};
use super::plan::{Defaults, Plan, Step};
use super::problem::Problem;
use super::tap::tap;
use crate::diag::Code;
use crate::toolpath::{CycleKind, CycleSpec};

/// The steps at one point, and buffers for planning. Steps and buffers are reused for the next hole, so that no memory
/// is allocated for a hole.
#[derive(Debug, Default)]
pub struct Steps {
    /// Steps of the plan, in their order.
    pub list: Vec<Step>,
    pecks: Vec<Peck>,
}

/// Plans the steps at one point. The tool begins above the point at the height `top` and returns to this height.
///
/// # Errors
/// The cycle can't be made of single moves, or the values of the cycle contradict each other.
pub fn plan(spec: &CycleSpec, plan: &Plan, top: f64, defaults: &Defaults, out: &mut Steps) -> Result<(), Problem> {
    use CycleKind as K;
    let Steps { list: steps, pecks } = out;
    steps.clear();
    let Plan { clear, bottom, feed, dwell, .. } = *plan;
    let mut enter = clear;
    steps.push(Step::Rapid(clear));
    if let Some(rapto) = spec.rapto.filter(|_| spec.kind != K::Back) {
        enter = clear - rapto;
        let (lowest, what) = match spec.kind {
            K::Thru => (-webs(spec, &[-bottom])[0], "the bottom of the first web"),
            K::Csink => (contact(spec).unwrap_or(bottom), "the top of the hole"),
            _ => (bottom, "the bottom"),
        };
        // 0.1 - 0.4 is slightly less than -0.3
        if enter < lowest - 1e-9 {
            let message = format!("the extra rapid of {rapto} from the clearance plane ends below {what}");
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
            if let Some(contact) = contact(spec) {
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
            let message = "the form has no sequence for the custom cycle";
            return Err(Problem::new(Code::PC001, message, "add the sequence to the form, or use another `kind`"));
        }
    }
    steps.push(Step::Rapid(top));
    Ok(())
}

/// The height at which the cone of a countersink meets the existing hole, if the job gives the diameter of this hole.
fn contact(spec: &CycleSpec) -> Option<f64> {
    let (hole, angle) = (spec.hole_diameter?, spec.angle?);
    Some(-(hole / 2.0) / (angle.to_radians() / 2.0).tan())
}

/// The end of the first web, then the start and end of each further web, as positive depths. If the job lists no webs,
/// there is one web to the depth `whole`.
fn webs<'s>(spec: &'s CycleSpec, whole: &'s [f64; 1]) -> &'s [f64] {
    if spec.webs.is_empty() { whole } else { &spec.webs }
}

/// Drills through webs, given by the end of the first web, then the start and end of each further web.
fn thru(spec: &CycleSpec, plan: &Plan, defaults: &Defaults, steps: &mut Vec<Step>) {
    let whole = [-plan.bottom];
    let webs = webs(spec, &whole);
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
        // the extra rapid ends in the first web; in the next case, it ends in the edge of the existing hole
        let webs = |s: &mut CycleSpec, rapto| (s.depth, s.webs, s.rapto) = (None, vec![0.3, 0.6, 1.0], Some(rapto));
        assert!(steps(|s| webs(s, 0.4), CycleKind::Thru).is_ok());
        assert_eq!(steps(|s| webs(s, 0.5), CycleKind::Thru), Err(Code::PC013));
        let sink = |s: &mut CycleSpec, rapto| {
            (s.depth, s.diameter, s.hole_diameter, s.angle, s.rapto) =
                (None, Some(1.0), Some(0.5), Some(90.0), Some(rapto));
        };
        assert!(steps(|s| sink(s, 0.3), CycleKind::Csink).is_ok());
        assert_eq!(steps(|s| sink(s, 0.4), CycleKind::Csink), Err(Code::PC013));
        assert_eq!(steps(|_| (), CycleKind::Custom1), Err(Code::PC001));
        // the depth is 1: webs and the countersink must have the same depth
        let sink_to = |s: &mut CycleSpec, diameter| (s.diameter, s.angle) = (Some(diameter), Some(90.0));
        for (end, other) in [(1.0, false), (0.9, true), (1.1, true)] {
            let result = other.then_some(Code::PC016);
            assert_eq!(steps(|s| s.webs = vec![0.3, 0.6, end], CycleKind::Thru).err(), result, "webs to {end}");
            assert_eq!(steps(|s| sink_to(s, 2.0 * end), CycleKind::Csink).err(), result, "countersink to {end}");
        }
        assert!(steps(|s| sink_to(s, 2.001), CycleKind::Csink).is_ok(), "a rounded depth");
    }

    /// Reference motions of a thread that only a control can tap. The thread has two starts, and the second start is
    /// offset by half a lead.
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
