//! Compares straight cuts. A program may divide a straight cut into parts.

use super::cut::{
    ACROSS, ALL, Cut, DEPTH, Place, What, apart, is_straight, lies_between, number, over, same, shown, turn_as_far,
    turned_otherwise, turns_between, with_turns,
};
use super::intent::{Done, Expected};
use super::modal;
use super::sides::Sides;
use crate::diag::Code;
use crate::toolpath::FeedMode;

/// The largest number of consecutive cuts with a wrong end; the comparison ends after more of them.
const MOST_SLIPS: u32 = 3;

/// Compares a straight cut. The program may make the cut as one cut, or in parts that lie on the job's cut.
pub(super) fn line(s: &mut Sides<'_>, cut: &Cut, first: &Cut, hole: Option<&Expected>) -> Done {
    let tolerance = s.limits.tolerance;
    let end = cut.end();
    let is_tap = hole.is_some_and(|hole| hole.is_tap);
    // the program may count its angles from another turn than the job
    let turns = turns_between(&first.from, &cut.from);
    let is_end = |to: &Place| same(to, &end, ALL, tolerance) && turn_as_far([&cut.from, &end], [&cut.from, to]);
    let mut found = first.clone();
    let mut parts = 1;
    loop {
        let to = with_turns(&found.end(), &turns);
        if is_end(&to) || !lies_between(&cut.from, &to, &end, tolerance) {
            break;
        }
        modal::feeds(s, &in_parts(cut, &found), &found, is_tap);
        s.program.take();
        let next = s.next()?.filter(|next| {
            let is_line = match &next.what {
                What::Line { .. } => true,
                What::Arc(turn) => is_straight(next, turn, tolerance), // part of a helix whose circle is smaller than the digits
            };
            let next = with_turns(&next.end(), &turns);
            is_line && s.program.passage.is_plain() && (is_end(&next) || lies_between(&to, &next, &end, tolerance))
        });
        let Some(next) = next else { return ends(s, cut, (&to, found.line), hole) };
        found = next;
        parts += 1;
        modal::compare(s, cut, &found, is_tap);
    }
    modal::feeds(s, &in_parts(cut, &found), &found, is_tap);
    s.report.allowed.parts += u64::from(parts > 1);
    ends(s, cut, (&with_turns(&found.end(), &turns), found.line), hole)?;
    s.program.take();
    Ok(())
}

/// Checks that the straight cut of the job and the last part of it in the program end at the same position. `is`: the
/// end of this part, with the turns of the job.
fn ends(s: &mut Sides<'_>, cut: &Cut, (is, line): (&Place, u64), hole: Option<&Expected>) -> Done {
    let tolerance = s.limits.tolerance;
    let (from, end, is) = (&cut.from, cut.end(), *is);
    if same(&end, &is, ALL, tolerance) {
        let turned = turned_otherwise([from, &end], [from, &is]);
        if turned == 0 {
            s.slips = 0;
            return Ok(());
        }
        return turns_otherwise(s, &end, turned, line);
    }
    s.slipped = Some([end, is]);
    if let Some(hole) = hole
        && same(&end, &is, ACROSS, tolerance)
    {
        // the tool leaves the hole at feed and goes farther up than in the job, but not above the job's greatest height
        let upward = is[DEPTH] > end[DEPTH] && end[DEPTH] > from[DEPTH];
        if hole.feeds_out && upward && s.hole.highest.is_some_and(|highest| is[DEPTH] <= highest + tolerance) {
            s.report.allowed.outs += 1;
            return Ok(());
        }
        s.found(Code::PV004, line, "print Z[d] at every hole where the depth changes", || {
            format!(
                "the hole at {} is cut to Z{}, but the job's hole to Z{}",
                over(&end),
                number(is[DEPTH]),
                number(end[DEPTH])
            )
        });
        return Ok(());
    }
    let message = || format!("a cut goes to {}, but the job's cut goes to {}", shown(&is, 0b111), shown(&end, 0b111));
    let help = "check the words that the form prints for this move";
    s.slips += 1;
    if s.slips > MOST_SLIPS {
        return s.differs(Code::PV001, line, message(), help); // the cuts after this one do not correspond
    }
    s.found(Code::PV001, line, help, message);
    Ok(())
}

/// Reports a cut in which these axes turn otherwise than in the job.
pub(super) fn turns_otherwise<T>(s: &mut Sides<'_>, end: &Place, axes: u8, line: u64) -> Done<T> {
    let message = format!(
        "in the move to {} the part turns in another direction than in the job, or by more turns",
        shown(end, 0b111 | axes)
    );
    s.differs(Code::PV001, line, message, "check the travel of the rotary axis (`Limits`)")
}

/// The required values for one part of a cut. In inverse time mode, the required feed is scaled by the length of the
/// part.
fn in_parts(cut: &Cut, part: &Cut) -> Cut {
    let length = |cut: &Cut| apart(&cut.from, &cut.end());
    let share = length(part) / length(cut);
    match cut.mode {
        FeedMode::InverseTime => Cut { feed: cut.feed.map(|feed| feed / share), ..cut.clone() },
        _ => cut.clone(),
    }
}
