//! Compares straight cuts. A program may divide a straight cut into parts.

use super::cut::{
    ACROSS, ALL, Cut, DEPTH, What, apart, is_straight, lies_between, number, over, same, shown, turn_as_far,
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
    let mut found = first.clone();
    let mut parts = 1;
    loop {
        let to = found.end();
        if same(&to, &end, ALL, tolerance) || !lies_between(&cut.from, &to, &end, tolerance) {
            break;
        }
        modal::feeds(s, &in_parts(cut, &found), &found, is_tap);
        s.program.take();
        let next = s.next()?.filter(|next| {
            let is_line = match &next.what {
                What::Line { .. } => true,
                What::Arc(turn) => is_straight(next, turn, tolerance), // part of a helix whose circle is smaller than the digits
            };
            is_line
                && s.program.passage.is_plain()
                && (same(&next.end(), &end, ALL, tolerance) || lies_between(&to, &next.end(), &end, tolerance))
        });
        let Some(next) = next else { return ends(s, cut, &found, hole) };
        found = next;
        parts += 1;
        modal::compare(s, cut, &found, is_tap);
    }
    modal::feeds(s, &in_parts(cut, &found), &found, is_tap);
    s.report.allowed.parts += u64::from(parts > 1);
    ends(s, cut, &found, hole)?;
    s.program.take();
    Ok(())
}

/// Checks that both straight cuts end at the same position.
fn ends(s: &mut Sides<'_>, cut: &Cut, found: &Cut, hole: Option<&Expected>) -> Done {
    let tolerance = s.limits.tolerance;
    let (from, end, is, line) = (&cut.from, cut.end(), found.end(), found.line);
    if same(&end, &is, ALL, tolerance) {
        if turn_as_far([from, &end], [&found.from, &is]) {
            s.slips = 0;
            return Ok(());
        }
        let message = format!(
            "in the move to {} the part turns in another direction than in the job, or by more turns",
            shown(&end, ALL)
        );
        return s.differs(Code::PV001, line, message, "check the travel of the rotary axis (`Limits`)");
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
