//! What the tool does at one point of a cycle (cycles.md section 1.5).

use super::pecks::{PeckDepth, pecks};
use crate::toolpath::{CycleKind, CycleSpec};

/// What a form gives where a cycle names nothing, in the units of the cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
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
}

/// Why a cycle can't be made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Its code, `cycle.depth.missing`.
    pub code: &'static str,
    /// A sentence.
    pub message: String,
}

impl Problem {
    /// A problem with this code.
    pub fn new(code: &'static str, message: impl Into<String>) -> Problem {
        Problem { code, message: message.into() }
    }
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
    /// Start it in the direction it had before the cycle.
    SpindleStart,
    /// Turn it the other way.
    SpindleReverse,
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
        let depth = own_depth.or(spec.depth).or_else(|| sink_depth(spec)).or_else(|| spec.webs.last().copied());
        let depth = match (depth, spec.kind) {
            (Some(depth), _) => depth,
            (None, CycleKind::Manual) => -clear,
            (None, _) => return Err(Problem::new("cycle.depth.missing", "the cycle has no depth: give `depth`")),
        };
        if clear + depth < 0.0 {
            let message =
                format!("the bottom, {depth} below the point, is above the clearance plane, {clear} above it");
            return Err(Problem::new("cycle.depth.above_clear", message));
        }
        let feed = match (spec.feed, spec.kind) {
            (Some(feed), _) => feed,
            (None, CycleKind::Manual) => 0.0,
            (None, _) => return Err(Problem::new("cycle.feed.missing", "the cycle has no feed: give `feed`")),
        };
        let dwell = match (spec.dwell, spec.revs) {
            (Some(_), Some(_)) => {
                return Err(Problem::new("cycle.option.exclusive", "a cycle has either `dwell` or `revs`"));
            }
            (Some(seconds), None) => Some(seconds),
            (None, Some(revs)) => match rpm.filter(|&rpm| rpm > 0.0) {
                Some(rpm) => Some(60.0 * revs / rpm),
                None => return Err(Problem::new("cycle.feed.no_spindle", "`revs` needs a turning spindle")),
            },
            (None, None) => (spec.kind == CycleKind::Face).then_some(defaults.dwell),
        };
        Ok(Plan { clear, bottom: -depth, feed, dwell })
    }
}

/// Depth of a countersink from its geometry: (k / 2) / tan(l / 2).
fn sink_depth(spec: &CycleSpec) -> Option<f64> {
    let (diameter, angle) = (spec.diameter?, spec.angle?);
    (spec.kind == CycleKind::Csink && angle < 180.0).then(|| diameter / 2.0 / (angle.to_radians() / 2.0).tan())
}

/// The steps at one point, and what planning needs; kept from hole to hole so that a hole allocates nothing.
#[derive(Debug, Default)]
pub struct Steps {
    /// The steps.
    pub list: Vec<Step>,
    pecks: Vec<PeckDepth>,
}

/// Plans the steps at one point. The tool is over the point at `top`, a height, and comes back there.
///
/// # Errors
/// What can't be made of single moves, or makes no sense.
pub fn plan(spec: &CycleSpec, plan: &Plan, top: f64, defaults: &Defaults, out: &mut Steps) -> Result<(), Problem> {
    use CycleKind as K;
    let Steps { list: steps, pecks } = out;
    steps.clear();
    let Plan { clear, bottom, feed, dwell } = *plan;
    let mut enter = clear;
    steps.push(Step::Rapid(clear));
    if let Some(rapto) = spec.rapto.filter(|_| spec.kind != K::Back) {
        enter = clear - rapto;
        if enter < bottom {
            return Err(Problem::new("cycle.rapto.beyond_depth", "`rapto` goes below the bottom"));
        }
        steps.push(Step::Rapid(enter));
    }
    let dwell_step = dwell.map(Step::Dwell);
    match spec.kind {
        K::Drill | K::Face => {
            steps.push(Step::Feed(bottom, feed));
            steps.extend(dwell_step);
        }
        K::Tap | K::LTap => tap(spec, plan, steps)?,
        K::Ream => {
            steps.push(Step::Feed(bottom, feed));
            steps.extend(dwell_step);
            steps.push(Step::Feed(clear, feed * spec.ratio.unwrap_or(1.0)));
        }
        K::Bore => {
            steps.push(Step::Feed(bottom, feed));
            steps.extend(dwell_step);
            match spec.orient {
                None => {
                    if spec.offset.is_some() || spec.jog.is_some() {
                        let message = "`offset` and `jog` need `orient`: the tool moves off the wall at a known angle";
                        return Err(Problem::new("cycle.bore.jog_without_orient", message));
                    }
                    steps.extend([Step::SpindleStop, Step::Rapid(top), Step::SpindleStart]);
                }
                Some(angle) => {
                    let (x, y) = aside(spec, angle, defaults);
                    steps.extend([
                        Step::Orient(angle),
                        Step::RapidAside(bottom + spec.jog.unwrap_or(0.0), -x, -y),
                        Step::RapidAside(top, -x, -y),
                        Step::Rapid(top),
                        Step::SpindleStart,
                    ]);
                }
            }
            return Ok(());
        }
        K::Back => return back_bore(spec, plan, top, defaults, steps),
        K::Deep | K::Chipbreak => peck(spec, plan, enter, defaults, pecks, steps)?,
        K::Thru => thru(spec, plan, defaults, steps)?,
        K::Csink => {
            if sink_depth(spec).is_none() && spec.depth.is_none() {
                return Err(Problem::new("cycle.csink.diamet_missing", "a countersink needs `diameter` and `angle`"));
            }
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
            return Err(Problem::new("cycle.type.unknown", message));
        }
    }
    steps.push(Step::Rapid(top));
    Ok(())
}

/// Feed down, reverse, feed out. A rigid tap keeps step with the spindle, which single moves can't.
fn tap(spec: &CycleSpec, plan: &Plan, steps: &mut Vec<Step>) -> Result<(), Problem> {
    if spec.rigid == Some(true) || spec.mode.is_some() || spec.starts.is_some() {
        let message = "a rigid, pecking or multiple-start tap needs a cycle of the control";
        return Err(Problem::new("cycle.rigid.unavailable", message));
    }
    if spec.norevr && spec.rapout {
        return Err(Problem::new("cycle.option.exclusive", "a tap has either `norevr` or `rapout`"));
    }
    let Plan { clear, bottom, feed, dwell } = *plan;
    steps.push(Step::Feed(bottom, feed));
    steps.extend(dwell.map(Step::Dwell));
    if spec.rapout || spec.norevr {
        return Ok(());
    }
    if spec.ratio.is_some_and(|ratio| ratio != 1.0) {
        let message = "a tap that comes out at another feed must change the spindle speed with it: take `ratio` out";
        return Err(Problem::new("cycle.rigid.unavailable", message));
    }
    steps.extend([Step::SpindleReverse, Step::Feed(clear, feed), Step::SpindleStart]);
    Ok(())
}

/// Pecks with full retracts, or chip breaks with a full retract every `times`.
fn peck(
    spec: &CycleSpec,
    plan: &Plan,
    from: f64,
    defaults: &Defaults,
    list: &mut Vec<PeckDepth>,
    steps: &mut Vec<Step>,
) -> Result<(), Problem> {
    let deep = spec.kind == CycleKind::Deep;
    let back = spec.back.unwrap_or(if deep { defaults.back_deep } else { defaults.back_chipbreak });
    let least = spec.min_step.unwrap_or(defaults.min_step);
    pecks(spec, plan.clear, plan.bottom, (spec.step.or(defaults.step), least), list)?;
    let last = list.len() - 1;
    for (i, peck) in list.iter().enumerate() {
        if peck.height > from {
            return Err(Problem::new("cycle.rapto.beyond_depth", "`rapto` goes below the first peck"));
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

/// Drilling through webs: end, then start and end of each further web.
fn thru(spec: &CycleSpec, plan: &Plan, defaults: &Defaults, steps: &mut Vec<Step>) -> Result<(), Problem> {
    let whole = [-plan.bottom];
    let webs = if spec.webs.is_empty() { &whole[..] } else { &spec.webs };
    if webs.len() % 2 == 0 {
        return Err(Problem::new("cycle.thru.pairs", "`webs` is an end, then a start and an end for each further web"));
    }
    if webs.windows(2).any(|pair| pair[0] > pair[1]) {
        return Err(Problem::new("cycle.thru.order", "the webs must go deeper one by one"));
    }
    let back = spec.back.unwrap_or(defaults.back_thru);
    let mut reached = -webs[0];
    steps.push(Step::Feed(reached, plan.feed));
    for pair in webs[1..].chunks(2) {
        steps.push(Step::Rapid((-pair[0] + back).min(reached)));
        reached = -pair[1];
        steps.push(Step::Feed(reached, plan.feed));
    }
    steps.extend(plan.dwell.map(Step::Dwell));
    Ok(())
}

/// Down beside the hole, across, up to the bottom that is cut from below, and out the same way.
fn back_bore(
    spec: &CycleSpec,
    plan: &Plan,
    top: f64,
    defaults: &Defaults,
    steps: &mut Vec<Step>,
) -> Result<(), Problem> {
    let Some(below) = spec.rapto else {
        let message = "a back bore needs `rapto`: how far below the point the tool goes before it cuts upward";
        return Err(Problem::new("cycle.rapto.required", message));
    };
    if -below > plan.bottom {
        return Err(Problem::new("cycle.back.depth_below_rapto", "the cut of a back bore ends below its beginning"));
    }
    let angle = spec.orient.unwrap_or(defaults.orient);
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

/// How far the tool moves off the wall at a spindle angle.
fn aside(spec: &CycleSpec, angle: f64, defaults: &Defaults) -> (f64, f64) {
    let jog = spec.offset.unwrap_or(defaults.jog);
    let (sin, cos) = angle.to_radians().sin_cos();
    (jog * cos, jog * sin)
}

#[cfg(test)]
mod tests {
    use super::Step::*;
    use super::*;

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
    };

    fn steps(edit: impl FnOnce(&mut CycleSpec), kind: CycleKind) -> Result<Vec<Step>, &'static str> {
        let mut spec = CycleSpec::new(kind);
        (spec.depth, spec.feed) = (Some(1.0), Some(5.0));
        edit(&mut spec);
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
            [Rapid(0.1), Feed(-1.0, 5.0), SpindleReverse, Feed(0.1, 5.0), SpindleStart, Rapid(0.2)]
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
        assert_eq!(steps(|s| s.depth = None, CycleKind::Drill), Err("cycle.depth.missing"));
        assert_eq!(steps(|s| s.depth = Some(-0.2), CycleKind::Drill), Err("cycle.depth.above_clear"));
        assert_eq!(steps(|s| s.feed = None, CycleKind::Drill), Err("cycle.feed.missing"));
        assert_eq!(steps(|s| s.rigid = Some(true), CycleKind::Tap), Err("cycle.rigid.unavailable"));
        assert_eq!(steps(|s| s.offset = Some(0.1), CycleKind::Bore), Err("cycle.bore.jog_without_orient"));
        assert_eq!(steps(|_| (), CycleKind::Back), Err("cycle.rapto.required"));
        assert_eq!(steps(|s| s.webs = vec![0.5, 1.0], CycleKind::Thru), Err("cycle.thru.pairs"));
        assert_eq!(steps(|s| s.rapto = Some(2.0), CycleKind::Drill), Err("cycle.rapto.beyond_depth"));
        assert_eq!(steps(|_| (), CycleKind::Custom1), Err("cycle.type.unknown"));
    }
}
