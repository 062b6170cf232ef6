//! Errors of a cycle that do not depend on its points.

use super::problem::Problem;
use crate::diag::Code;
use crate::toolpath::CycleKind::{self, *};
use crate::toolpath::CycleSpec;

/// Checks a cycle for options that belong to another kind of cycle, exclude each other, or are impossible.
///
/// # Errors
/// The first problem, with its code.
pub fn check(spec: &CycleSpec) -> Result<(), Problem> {
    let problem = |code, message: &str, help: &str| Err(Problem::new(code, message, help));
    options(spec)?;
    if spec.feed.is_none() && !matches!(spec.kind, Manual | Custom1 | Custom2 | Custom3) {
        return problem(Code::PC005, "the cycle has no feed", "give `feed`");
    }
    if spec.ratio.is_some_and(|ratio| ratio <= 0.0) {
        let help = "give a ratio above zero, or remove it";
        return problem(Code::PC006, "a `ratio` of 0: the tool would never come out", help);
    }
    if spec.dwell.is_some() && spec.revs.is_some() {
        return problem(
            Code::PC016,
            "the dwell is given in seconds and in revolutions",
            "keep one of `dwell` and `revs`",
        );
    }
    if spec.norevr && spec.rapout {
        return problem(Code::PC016, "the tap has both `norevr` and `rapout`", "keep `norevr` or `rapout`");
    }
    if spec.mode.is_some() && (spec.norevr || spec.rapout) {
        let help = "take `mode` (DEEP or BRKCHP) out, or `norevr` and `rapout`";
        return problem(Code::PC016, "a tap that pecks and does not reverse", help);
    }
    if spec.kind == Bore && spec.orient.is_none() && (spec.offset.is_some() || spec.jog.is_some()) {
        let message = "the spindle angle at which the tool moves off the wall is missing";
        return problem(Code::PC015, message, "give `orient`, or take `offset` and `jog` out");
    }
    if spec.starts.is_some_and(|starts| !(1.0..=100.0).contains(&starts) || starts.fract() != 0.0) {
        return problem(
            Code::PC036,
            "`starts` is not a whole number from 1 to 100",
            "give the number of starts of the thread",
        );
    }
    if spec.starts.is_some_and(|starts| starts > 1.0) && spec.rigid != Some(true) && spec.mode.is_none() {
        return problem(Code::PC020, "several starts with a floating tap", "make the tap rigid, or take `starts` out");
    }
    if let Some(step) = [spec.step, spec.first_step].into_iter().flatten().find(|&step| step <= 0.0) {
        return Err(Problem::new(Code::PC028, format!("a step of {step}"), "give a step above zero"));
    }
    if !spec.pecks.is_empty() && spec.step.or(spec.first_step).is_some() {
        return problem(Code::PC031, "absolute pecks and steps in one cycle", "keep `pecks`, or `depth` and `step`");
    }
    if !spec.pecks.is_empty() && spec.decr.is_some() {
        return problem(
            Code::PC030,
            "absolute pecks can't shrink",
            "take `decr` out, or give `step` instead of `pecks`",
        );
    }
    webs(spec)?;
    countersink(spec)
}

/// Checks that the options are allowed for the kind of cycle.
fn options(spec: &CycleSpec) -> Result<(), Problem> {
    // a tap may have steps, because a sequence can print them
    let pecks: &[CycleKind] = &[Deep, Chipbreak, Tap, LTap];
    let steps_back: &[CycleKind] = &[Deep, Chipbreak, Tap, LTap, Thru];
    let table: [(bool, &str, &[CycleKind]); 20] = [
        (spec.step.is_some(), "step", pecks),
        (spec.first_step.is_some(), "first_step", pecks),
        (spec.decr.is_some(), "decr", pecks),
        (spec.min_step.is_some(), "min_step", pecks),
        (!spec.pecks.is_empty(), "pecks", pecks),
        (spec.back.is_some(), "back", steps_back),
        (spec.times.is_some(), "times", &[Chipbreak]),
        (spec.orient.is_some(), "orient", &[Bore, Back, Tap, LTap]),
        (spec.offset.is_some(), "offset", &[Bore, Back]),
        (spec.offset_y.is_some(), "offset_y", &[Bore, Back]),
        (spec.jog.is_some(), "jog", &[Bore, Back]),
        (spec.ratio.is_some(), "ratio", &[Tap, LTap, Ream]),
        (spec.starts.is_some(), "starts", &[Tap, LTap]),
        (spec.rigid.is_some(), "rigid", &[Tap, LTap]),
        (spec.mode.is_some(), "mode", &[Tap, LTap]),
        (spec.norevr, "norevr", &[Tap, LTap]),
        (spec.rapout, "rapout", &[Tap, LTap]),
        (spec.diameter.or(spec.angle).is_some(), "diameter` and `angle", &[Csink]),
        (spec.hole_diameter.is_some(), "hole_diameter", &[Csink]),
        (!spec.webs.is_empty(), "webs", &[Thru]),
    ];
    if matches!(spec.kind, Custom1 | Custom2 | Custom3) {
        return Ok(()); // only the form defines the options of a custom cycle
    }
    let wrong = table.iter().find(|(given, _, kinds)| *given && !kinds.contains(&spec.kind));
    let manual = spec.kind == Manual
        && (spec.feed.or(spec.depth).or(spec.return_height).or(spec.dwell).or(spec.revs).or(spec.rapto).is_some());
    match wrong {
        None if manual => {
            let help = "remove all keys except `clear`";
            Err(Problem::new(Code::PC017, "a manual cycle can only go to its clearance and stop", help))
        }
        None => Ok(()),
        Some((_, name, kinds)) => {
            let message = format!("`{}` has no `{name}`", spec.kind.name());
            let names: Vec<_> = kinds.iter().map(|kind| kind.name()).collect();
            Err(Problem::new(Code::PC017, message, format!("only for {}: remove it", names.join(", "))))
        }
    }
}

fn webs(spec: &CycleSpec) -> Result<(), Problem> {
    if !spec.webs.is_empty() && spec.webs.len().is_multiple_of(2) {
        let message = format!("{} depths of webs", spec.webs.len());
        let help = "give the end of the first web, then the start and the end of each further web";
        return Err(Problem::new(Code::PC022, message, help));
    }
    match spec.webs.windows(2).find(|pair| pair[0] > pair[1]) {
        Some(pair) => {
            let message = format!("the web depth {} is followed by the smaller depth {}", pair[0], pair[1]);
            Err(Problem::new(Code::PC023, message, "give each web a greater depth than the web before"))
        }
        None => Ok(()),
    }
}

fn countersink(spec: &CycleSpec) -> Result<(), Problem> {
    if spec.kind != Csink || spec.depth.is_some() && spec.diameter.is_none() && spec.angle.is_none() {
        return Ok(());
    }
    let Some(diameter) = spec.diameter else {
        return Err(Problem::new(Code::PC024, "a countersink without its diameter", "give `diameter`"));
    };
    let Some(angle) = spec.angle else {
        return Err(Problem::new(Code::PC025, "a countersink without its angle", "give `angle`"));
    };
    if angle <= 0.0 || angle >= 180.0 {
        let message = format!("a countersink of {angle} degrees");
        return Err(Problem::new(Code::PC026, message, "give an angle between 0 and 180"));
    }
    match spec.hole_diameter.filter(|&hole| hole >= diameter) {
        Some(hole) => {
            let message = format!("the hole, {hole}, is not smaller than its countersink, {diameter}");
            Err(Problem::new(Code::PC027, message, "give a smaller `hole_diameter`"))
        }
        None => Ok(()),
    }
}
