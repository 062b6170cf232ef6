//! Holes in pecks: a control's cycle may make other pecks than the job, and the same hole.

use std::io::{BufRead, Seek};

use super::cut::{ACROSS, ALL, Cut, DEPTH, What, number, over, same, same_dwell, shown};
use super::intent::{Done, Expected};
use super::pauses;
use super::state::Sides;
use super::states;
use super::tables::{LEFT, LONGER};
use crate::diag::Code;

/// What the program's strokes in a hole came to.
#[derive(Clone, Copy, Debug)]
struct Strokes {
    count: u64,
    longest: f64,
    /// The tool came out between all pecks.
    out: bool,
    deepest: f64,
    /// A dwell at the deepest place, before another stroke.
    dwell: Option<f64>,
    line: u64,
}

/// The program's cuts in this hole, of which the first was met already.
pub(super) fn pecks<R: BufRead + Seek>(s: &mut Sides<R>, hole: &Expected) -> Done {
    let tolerance = s.limits.tolerance;
    let pecks = std::mem::take(&mut s.hole.pecks);
    let start = Strokes { count: 0, longest: 0.0, out: true, deepest: hole.plane, dwell: None, line: 0 };
    let mut strokes = start;
    let mut identical = true;
    let mut count = 0;
    while let Some(found) = s.next()? {
        let wanted = pecks.get(count);
        let is_one = wanted.is_some_and(|wanted| is_same(wanted, &found, tolerance));
        // at the bottom, what is not of the same block's cycle is another hole, or another item of the job
        let same_block = found.by_cycle && found.line == strokes.line;
        // up again at feed goes only a tap
        let other_item = found.end()[DEPTH] < found.from[DEPTH] || !hole.is_tap;
        let at_bottom = strokes.deepest <= hole.bottom + tolerance;
        if count > 0 && (!stays_in(s, hole, &found) || at_bottom && other_item && !same_block && !is_one) {
            break;
        }
        strokes.line = found.line;
        identical &= is_one;
        if count > 0 {
            pauses::between_pecks(s, hole);
        }
        let lowest = s.program.passage.rapids.iter().map(|rapid| rapid.to[DEPTH]).fold(f64::INFINITY, f64::min);
        // a rapid in the hole stays where it was cut
        if count > 0 && lowest < strokes.deepest - tolerance {
            let deepest = strokes.deepest;
            s.found(Code::PV009, found.line, "look at the clearance of the pecks", || {
                let (low, cut) = (number(lowest), number(deepest));
                format!("a rapid goes to Z{low} in the hole at {}, cut to Z{cut} so far", over(&hole.at))
            });
        }
        let What::Line { to } = found.what else { break };
        if !same(&hole.at, &to, ACROSS, tolerance) {
            if hole.custom {
                let why = format!("the custom cycle at {} leaves the axis of its hole", over(&hole.at));
                return s.unproven(why, "what a custom cycle does, only its form knows", found.line);
            }
            s.found(Code::PV001, found.line, "look at X and Y of the pecks", || {
                format!("a peck of the hole at {} goes to {}", over(&hole.at), shown(&to, 0b111))
            });
        }
        stroke(s, &found, hole, &mut strokes, count > 0);
        peck_state(s, &pecks, &found, hole, [strokes.deepest, to[DEPTH]], count);
        strokes.deepest = strokes.deepest.min(to[DEPTH]);
        count += 1;
        s.program.take();
    }
    let Strokes { deepest, line, .. } = strokes;
    if !hole.custom {
        check(s, &pecks, hole, &strokes);
    }
    if (deepest - hole.bottom).abs() > tolerance {
        let at = over(&hole.at);
        if hole.custom {
            let why = format!(
                "the custom cycle at {at} goes to Z{} in its first hole, the job to Z{}",
                number(deepest),
                number(hole.bottom)
            );
            return s.unproven(why, "what a custom cycle does, only its form knows", line);
        }
        s.found(Code::PV004, line, "print Z[d] at every hole where it changes", || {
            format!("the hole at {at} is cut to Z{}, the job's to Z{}", number(deepest), number(hole.bottom))
        });
    }
    if s.hole.waits_inside {
        let (wanted, is) = (hole.dwell.unwrap_or(0.0), strokes.dwell.unwrap_or(0.0));
        if !same_dwell(wanted, is) {
            s.found(Code::PV010, line, "print P[dwell] in the cycle", || {
                format!("the dwell at the bottom is {} s, the job's {} s", number(is), number(wanted))
            });
        }
    }
    identical &= count == pecks.len();
    s.report.allowed.pecks += u64::from(!identical && !hole.custom);
    s.hole.pecks = pecks;
    s.hole.pecks.clear();
    Ok(())
}

/// Counts a stroke, and the dwell before it.
fn stroke<R: BufRead + Seek>(s: &Sides<R>, found: &Cut, hole: &Expected, strokes: &mut Strokes, later: bool) {
    let tolerance = s.limits.tolerance;
    let to = found.end()[DEPTH];
    let passage = &s.program.passage;
    if later {
        let at_bottom = (found.from[DEPTH] - strokes.deepest).abs() <= tolerance || strokes.dwell.is_none();
        let waited: f64 = passage.waits.iter().map(|wait| wait.what).sum();
        strokes.dwell = Some(waited).filter(|waited| at_bottom && *waited > 0.0).or(strokes.dwell);
    }
    if strokes.count > 0 && to < strokes.deepest - tolerance {
        strokes.out &= passage.rapids.iter().any(|rapid| rapid.to[DEPTH] >= hole.plane - tolerance);
    }
    if to < strokes.deepest {
        strokes.count += 1;
        strokes.longest = strokes.longest.max(strokes.deepest - to);
        strokes.dwell = None;
    }
}

/// Spindle, registers and feed of a stroke: those of the job's pecks that cut in the same place.
fn peck_state<R: BufRead + Seek>(
    s: &mut Sides<R>,
    pecks: &[Cut],
    found: &Cut,
    hole: &Expected,
    [deepest, to]: [f64; 2],
    count: usize,
) {
    let tolerance = s.limits.tolerance;
    let Some(first) = pecks.first() else { return };
    let up = to > found.from[DEPTH];
    let cuts = || pecks.iter().filter(|peck| (peck.end()[DEPTH] > peck.from[DEPTH]) == up);
    // a stroke that cuts nothing new goes with any
    let top = deepest.max(to);
    let within = |peck: &&Cut| {
        let [high, low] = [peck.from[DEPTH].max(peck.end()[DEPTH]), peck.from[DEPTH].min(peck.end()[DEPTH])];
        to >= deepest || (low < top - tolerance && high > to + tolerance)
    };
    let meant = || cuts().filter(within).chain(cuts().take(1)).chain(std::iter::once(first));
    let is_meant = |peck: &&Cut| match (peck.feed, found.feed) {
        (Some(wanted), Some(is)) if peck.mode == found.mode => states::is_feed(wanted, is, hole.is_tap),
        _ => true,
    };
    // the job's own peck in this place, where the program pecks as the job does: holes may have thousands
    let own =
        pecks.get(count).filter(|peck| (peck.end()[DEPTH] > peck.from[DEPTH]) == up && within(peck) && is_meant(peck));
    let found_one = own.or_else(|| cuts().filter(within).find(is_meant));
    let wanted = found_one.or_else(|| meant().next()).unwrap_or(first).clone();
    if count > 0 {
        states::compare(s, &wanted, found, hole.is_tap);
        if s.tools {
            super::ways::moved_with(s, found.line);
        }
    }
    let same_mode = wanted.mode != crate::toolpath::FeedMode::InverseTime;
    if same_mode {
        states::feeds(s, &wanted, found, hole.is_tap);
    }
}

/// Checks the pecks of a hole: other pecks are as good, but pecks they must be, out of the hole between them where the
/// job's are.
fn check<R: BufRead + Seek>(s: &mut Sides<R>, pecks: &[Cut], hole: &Expected, strokes: &Strokes) {
    let mut deepest = hole.plane;
    let (mut count, mut longest) = (0, 0.0f64);
    for peck in pecks {
        let to = peck.end()[DEPTH];
        if to < deepest {
            let length = deepest - to;
            count += u64::from(length > (LEFT * longest).max(2.0 * s.limits.tolerance));
            longest = longest.max(length);
            deepest = to;
        }
    }
    let help = "print Q[vbite] with G83 or G73, as the job's kind is";
    if count > 1 && (strokes.count < 2 || strokes.longest > LONGER * longest) {
        let is = number(strokes.longest);
        s.found(Code::PV023, strokes.line, help, || {
            format!("the hole at {} is cut {is} at once, the job pecks by {}", over(&hole.at), number(longest))
        });
    }
    if count > 1 && hole.retracts && !strokes.out {
        s.found(Code::PV023, strokes.line, help, || {
            format!("between pecks the tool stays in the hole at {}, the job brings it out", over(&hole.at))
        });
    }
}

/// Is the program's next cut in this hole too?
fn stays_in<R: BufRead + Seek>(s: &Sides<R>, hole: &Expected, found: &Cut) -> bool {
    let here = |place: &_| same(&hole.at, place, ACROSS, s.limits.tolerance);
    let passage = &s.program.passage;
    // behind a change of tool it is another hole at this place
    !passage.changed()
        && here(&found.from)
        && here(&found.end())
        && passage.rapids.iter().all(|rapid| rapid.unknown == 0 && here(&rapid.to))
}

fn is_same(wanted: &Cut, found: &Cut, tolerance: f64) -> bool {
    same(&wanted.from, &found.from, ALL, tolerance) && same(&wanted.end(), &found.end(), ALL, tolerance)
}
