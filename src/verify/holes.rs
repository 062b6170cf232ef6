//! Compares pecked holes. The cycle of a control may make the job's hole with other pecks than the job.

use super::cut::{ACROSS, Cut, DEPTH, What, number, over, same, same_dwell, same_ends, shown};
use super::intent::{Done, Expected};
use super::modal;
use super::pauses;
use super::sides::{Limits, Sides};
use super::strokes::{Strokes, lost, retracts_instead};
use crate::diag::Code;

/// Compares the program's cuts in this hole with the job's cuts. The program was already run to its first cut in the
/// hole.
pub(super) fn compare_pecks(s: &mut Sides<'_>, hole: &Expected) -> Done {
    let Limits { tolerance, increment, .. } = s.limits;
    let pecks = std::mem::take(&mut s.hole.pecks);
    let (wanted_strokes, mut strokes) = (s.hole.strokes, Strokes::over(hole.plane));
    let begins = begins(&pecks);
    // the longest dwell at the bottom before another cut, and the line of the last cut
    let (mut waited, mut line) = (0.0f64, 0);
    // whether a canned cycle of the control made the last cut
    let mut by_cycle = false;
    let mut identical = true;
    let mut count = 0;
    while let Some(found) = s.next()? {
        let wanted = pecks.get(count);
        let is_one = wanted.is_some_and(|wanted| same_ends(wanted, &found, tolerance));
        // at the bottom, another cut belongs to this hole only if the cycle of the same block makes it
        let same_block = found.by_cycle && found.line == line;
        // only a tap that is printed as single moves feeds up again; a tapping cycle of the control leaves the hole itself
        let other_item = found.end()[DEPTH] < found.from[DEPTH] || !hole.is_tap || by_cycle;
        let at_bottom = strokes.deepest <= hole.bottom + tolerance;
        if count > 0 && (!stays_in(s, hole, &found) || at_bottom && other_item && !same_block && !is_one) {
            break;
        }
        (line, by_cycle) = (found.line, found.by_cycle);
        identical &= is_one;
        if count > 0 {
            pauses::between_pecks(s, hole);
        }
        let lowest = s.program.passage.rapids.iter().map(|rapid| rapid.to[DEPTH]).fold(f64::INFINITY, f64::min);
        // a rapid in the hole must not go deeper than the hole was cut
        if count > 0 && lowest < strokes.deepest - tolerance {
            let deepest = strokes.deepest;
            s.found(Code::PV009, found.line, "check the clearance of the pecks", || {
                let (low, cut) = (number(lowest), number(deepest));
                format!("a rapid goes to Z{low} in the hole at {}, but the hole is cut only to Z{cut}", over(&hole.at))
            });
        }
        let What::Line { to } = found.what else { break };
        if !same(&hole.at, &to, ACROSS, tolerance) {
            if hole.custom {
                let why = format!("the custom cycle at {} leaves the axis of its hole", over(&hole.at));
                return s.unproven(why, "the moves of a custom cycle are defined only in the form", found.line);
            }
            s.found(Code::PV001, found.line, "check X and Y of the pecks", || {
                format!("a peck of the hole at {} goes to {}", over(&hole.at), shown(&to, 0b111))
            });
        }
        let deepest = strokes.deepest;
        if count > 0 && (found.from[DEPTH] - deepest).abs() <= tolerance {
            waited = waited.max(s.program.passage.waits.iter().map(|wait| wait.what).sum());
        }
        if to[DEPTH] < deepest {
            waited = 0.0;
        }
        peck_state(s, (&pecks, &begins), &found, hole, [deepest, to[DEPTH]], count);
        s.program.passage.rapids.iter().for_each(|rapid| strokes.comes_to(rapid.to[DEPTH]));
        strokes.comes_to(found.from[DEPTH]);
        strokes.cut(to[DEPTH], increment, tolerance);
        count += 1;
        s.program.take();
    }
    let deepest = strokes.deepest;
    if !hole.custom {
        check(s, hole, [&wanted_strokes, &strokes], line);
    }
    if (deepest - hole.bottom).abs() > tolerance {
        let at = over(&hole.at);
        if hole.custom {
            let why = format!(
                "the custom cycle at {at} goes to Z{} in its first hole, but the job goes to Z{}",
                number(deepest),
                number(hole.bottom)
            );
            return s.unproven(why, "the moves of a custom cycle are defined only in the form", line);
        }
        s.found(Code::PV004, line, "print Z[d] at every hole where the depth changes", || {
            format!("the hole at {at} is cut to Z{}, but the job's hole to Z{}", number(deepest), number(hole.bottom))
        });
    }
    // only a tap has another cut after the dwell at the bottom
    if hole.is_tap {
        let wanted = hole.dwell.unwrap_or(0.0);
        if !same_dwell(wanted, waited) {
            s.found(Code::PV010, line, "print P[dwell] in the cycle, or P0 if the job has no dwell", || {
                format!("the dwell at the bottom is {} s, but {} s in the job", number(waited), number(wanted))
            });
        }
    }
    identical &= count == pecks.len() && wanted_strokes.counts == strokes.counts;
    let other = u64::from(!identical && !hole.custom);
    match retracts_instead(&wanted_strokes, &strokes) {
        true => s.report.allowed.retracts += other,
        false => s.report.allowed.pecks += other,
    }
    s.hole.pecks = pecks;
    s.hole.pecks.clear();
    Ok(())
}

/// The depth of the hole before each peck. Only material below this depth is new for the peck, so no two pecks cut the
/// same material.
fn begins(pecks: &[Cut]) -> Vec<f64> {
    let depths = pecks.iter().scan(f64::INFINITY, |deepest, peck| {
        let before = *deepest;
        *deepest = before.min(peck.end()[DEPTH]);
        Some(before)
    });
    depths.collect()
}

/// Compares a stroke of the program with a peck of the job that cuts the same material, at least in part. The spindle,
/// the registers and the feed are compared.
fn peck_state(
    s: &mut Sides<'_>,
    (pecks, begins): (&[Cut], &[f64]),
    found: &Cut,
    hole: &Expected,
    [deepest, to]: [f64; 2],
    count: usize,
) {
    let tolerance = s.limits.tolerance;
    let Some(first) = pecks.first() else { return };
    let up = to > found.from[DEPTH];
    let is_way = |peck: &Cut| (peck.end()[DEPTH] > peck.from[DEPTH]) == up;
    // a stroke that cuts nothing new may match any peck
    let within = |peck: &Cut, begin: f64| {
        to >= deepest || (peck.end()[DEPTH] < deepest - tolerance && begin.min(peck.from[DEPTH]) > to + tolerance)
    };
    let is_meant = |peck: &Cut| match (peck.feed, found.feed) {
        (Some(wanted), Some(is)) if peck.mode == found.mode => modal::is_feed(wanted, is, hole.is_tap),
        _ => true,
    };
    let all = || pecks.iter().zip(begins).filter(|(peck, _)| is_way(peck));
    let cutting = || all().filter(|(peck, begin)| within(peck, **begin));
    // try the job's peck with the same index first, because a hole may have thousands of pecks
    let own = pecks.get(count).zip(begins.get(count)).filter(|(peck, begin)| {
        is_way(peck) && (same_ends(peck, found, tolerance) || within(peck, **begin) && is_meant(peck))
    });
    let meant = own.or_else(|| cutting().find(|(peck, _)| is_meant(peck)));
    let any = || cutting().next().or_else(|| all().next());
    let wanted = meant.or_else(any).map_or(first, |(peck, _)| peck).clone();
    if count > 0 {
        modal::compare(s, &wanted, found, hole.is_tap);
        if s.tools {
            super::rapids::moved_with(s, found.line);
        }
    }
    let same_mode = wanted.mode != crate::toolpath::FeedMode::InverseTime;
    if same_mode {
        modal::feeds(s, &wanted, found, hole.is_tap);
    }
}

/// Checks the pecks of a hole. The pecks may differ from the job's pecks. But if the job pecks the hole, the program
/// must also peck it, and the tool must leave the hole as often as in the job.
fn check(s: &mut Sides<'_>, hole: &Expected, [wanted, made]: [&Strokes; 2], line: u64) {
    let help = "print Q[vbite] with G83 or G73, according to the kind of cycle in the job";
    for lost in lost(wanted, made, hole.comes_out, s.limits.tolerance) {
        s.found(Code::PV023, line, help, || format!("in the hole at {} {}", over(&hole.at), lost.text("the job")));
    }
}

/// Whether the program's next cut is also in this hole.
fn stays_in(s: &Sides<'_>, hole: &Expected, found: &Cut) -> bool {
    let here = |place: &_| same(&hole.at, place, ACROSS, s.limits.tolerance);
    let passage = &s.program.passage;
    // after a tool change it is another hole at the same position
    !passage.changed()
        && here(&found.from)
        && here(&found.end())
        && passage.rapids.iter().all(|rapid| rapid.unknown == 0 && here(&rapid.to))
}
