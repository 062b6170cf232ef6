//! Converts a CYCLE statement to a cycle with clearances, dwells, depths, steps and feeds in the file's units.

use super::coded::Coded;
use super::cycle_words::Opt;
use super::fault::{Done, fault};
use super::feed::{counted, feed_of};
use super::job::Job;
use super::state::Cycle;
use crate::cycle::stepped_pecks;
use crate::diag::Code;
use crate::toolpath::{CycleKind, CycleSpec, Orient, Peck, SpindleTurn};

/// The cycle that a statement describes. Feeds are per minute, in the file's units.
pub(super) fn spec(cycle: &mut Cycle, job: &mut Job<'_>, coded: &Coded) -> Done<CycleSpec> {
    let kind = coded.kind.unwrap_or(CycleKind::Drill);
    if coded.has(Opt::Float) && coded.has(Opt::Rigid) {
        return fault(Code::PC016, "FLOAT and RIGID in one cycle", "keep FLOAT or RIGID");
    }
    let left = coded.has(Opt::Invers);
    let mut spec = CycleSpec::new(if left { CycleKind::LTap } else { kind });
    spec.mode = coded.mode;
    spec.emulate = cycle.emulate;
    spec.steps_from_point = true;
    let second = clearances(cycle, coded, kind, &mut spec)?;
    spec.norevr = coded.has(Opt::Norevr);
    (spec.dwell, spec.revs) = (coded.number(Opt::Dwell), coded.number(Opt::Rev));
    cycle.dwell.fill(&mut spec);
    spec.rapto = coded.number(Opt::Rapto);
    spec.decr = coded.number(Opt::Decr);
    spec.min_step = coded.number(Opt::Minstp);
    spec.times = coded.number(Opt::Times);
    if spec.times.is_some_and(|n| n < 1.0 || n.fract() != 0.0) {
        return fault(Code::PC036, "TIMES is not a whole number", "write TIMES,2");
    }
    spec.ratio = coded.number(Opt::Ratio);
    spec.starts = coded.number(Opt::Multrd);
    if spec.starts.is_some_and(|n| !(1.0..=100.0).contains(&n) || n.fract() != 0.0) {
        return fault(Code::PC036, "MULTRD is not a whole number of starts", "write MULTRD,2");
    }
    spec.rigid = (coded.has(Opt::Rigid) || coded.has(Opt::Float)).then(|| coded.has(Opt::Rigid));
    spec.rapout = coded.has(Opt::Rapout);
    let angle = |numbers: &[f64]| numbers.first().map_or(Orient::ByForm, |&angle| Orient::At(angle));
    spec.orient = coded.numbers(Opt::Orient).map(angle);
    if matches!(kind, CycleKind::Bore | CycleKind::Back) {
        spec.jog = coded.number(Opt::Back);
        match coded.numbers(Opt::Ofsetl) {
            Some([x, y]) => (spec.offset, spec.offset_y) = (Some(*x), Some(*y)),
            offset => spec.offset = offset.and_then(|n| n.first().copied()).or(second),
        }
    } else {
        spec.back = coded.number(Opt::Back).or(second);
    }
    spec.diameter = coded.number(Opt::Diamet);
    spec.angle = coded.number(Opt::Tlangl);
    spec.hole_diameter = coded.number(Opt::Holdia);
    depths(job, coded, kind, &mut spec)?;
    let turns = job.spindle.now.turn;
    if kind == CycleKind::Tap && turns.is_some_and(|t| (t == SpindleTurn::Ccw) != left && t != SpindleTurn::Off) {
        job.notes.warn(Code::PC054, "a tap whose direction is opposite to the spindle's", "check INVERS and SPINDL");
    }
    Ok(spec)
}

/// Reads CLEAR. The first number of CLEAR also applies to later cycles. The result is the second number, which applies
/// to this cycle only.
fn clearances(cycle: &mut Cycle, coded: &Coded, kind: CycleKind, spec: &mut CycleSpec) -> Done<Option<f64>> {
    let clear = coded.numbers(Opt::Clear);
    cycle.clear = clear.map(|numbers| numbers[0]).or(cycle.clear);
    spec.clear = cycle.clear;
    let Some(second) = clear.and_then(|numbers| numbers.get(1)).copied() else { return Ok(None) };
    let jogs = matches!(kind, CycleKind::Bore | CycleKind::Back);
    if !jogs && !matches!(kind, CycleKind::Deep | CycleKind::Chipbreak | CycleKind::Thru) && coded.mode.is_none() {
        let help = "keep the first number of CLEAR";
        return fault(Code::PC010, "this cycle has no second clearance", help);
    }
    if coded.has(if jogs { Opt::Ofsetl } else { Opt::Back }) {
        let help = "keep the second number of CLEAR, or BACK or OFSETL";
        return fault(Code::PC011, "the second clearance is given twice", help);
    }
    Ok(Some(second))
}

/// Reads depths, steps and feeds.
fn depths(job: &mut Job<'_>, coded: &Coded, kind: CycleKind, spec: &mut CycleSpec) -> Done {
    let pecks = matches!(kind, CycleKind::Deep | CycleKind::Chipbreak) || coded.mode.is_some();
    let feeds = coded.groups.iter().filter(|group| group.feed.is_some()).count();
    if feeds > 1 && (!pecks || coded.mode.is_some()) {
        return fault(Code::PC007, "two feeds, but the cycle takes one", "keep one feed");
    }
    let mut last = None;
    let mut of_groups = Vec::new();
    for group in &coded.groups {
        if let Some((unit, value)) = &group.feed {
            last = feed_of(job, unit, *value)?.map(|feed| counted(job, feed)).transpose()?;
        }
        of_groups.push(last);
    }
    spec.feed = of_groups.iter().copied().flatten().next();
    let depths: Vec<f64> = coded.groups.iter().flat_map(|group| group.depths.iter().copied()).collect();
    let steps: Vec<f64> = coded.groups.iter().flat_map(|group| group.steps.iter().copied()).collect();
    if kind == CycleKind::Thru {
        spec.depth = depths.last().copied();
        spec.webs = depths;
        return Ok(());
    }
    if depths.len() > 1 && !pecks {
        return fault(Code::PC034, "more than one depth", "keep one depth, or drill with DEEP or BRKCHP");
    }
    spec.depth = depths.last().copied();
    if depths.len() > 1 {
        if !steps.is_empty() {
            return fault(
                Code::PC031,
                "absolute depths and steps in one cycle",
                "keep the depths, or one depth and STEP",
            );
        }
        let with_feeds = coded.groups.iter().zip(&of_groups);
        spec.pecks =
            with_feeds.flat_map(|(group, feed)| group.depths.iter().map(|&to| Peck { to, feed: *feed })).collect();
        if spec.pecks.iter().any(|peck| peck.feed.is_none()) {
            return fault(Code::PC005, "the cycle has no feed", "give MMPM, IPM or another feed word after its depths");
        }
        return Ok(());
    }
    match (steps.as_slice(), spec.depth) {
        ([], _) if spec.decr.is_some() && pecks => {
            fault(Code::PC030, "DECR without STEP", "give STEP, or take DECR out")
        }
        ([], _) => Ok(()),
        ([step], _) if feeds <= 1 => {
            spec.step = Some(*step);
            Ok(())
        }
        (_, None) => fault(Code::PC002, "the cycle has no depth", "give DEPTH"),
        (_, Some(depth)) => {
            let mut list = Vec::new();
            for (group, feed) in coded.groups.iter().zip(&of_groups) {
                list.extend(group.steps.iter().map(|&step| (step, *feed)));
            }
            spec.pecks = stepped_pecks(depth, &list, spec.decr.take(), spec.min_step.take())?;
            Ok(())
        }
    }
}
