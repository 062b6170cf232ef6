//! Compares threads of a lathe. The passes in the program may differ from the passes of the job. The last passes must
//! end at the same depth, and no pass may cut deeper than 1.5 times the job's deepest pass.

use super::begin::unsaid;
use super::cut::{Cut, DEPTH, RADIUS, Rapid, number, place, same, shown};
use super::intent::{Done, Threaded};
use super::modal;
use super::passage::Passage;
use super::sides::Sides;
use super::tables::{LONGER, PITCH};
use crate::diag::Code;

impl Threaded {
    /// The depth of one of the program's cuts as a pass of this thread; `None`: the cut is not a pass of this thread.
    fn depth(&self, found: &Cut, tolerance: f64) -> Option<f64> {
        let near = |a: f64, b: f64| (a - b).abs() <= 2.0 * tolerance;
        let to = found.end();
        let along = near(found.from[DEPTH], self.begin[DEPTH]) && near(to[DEPTH], self.end);
        let across = near(found.from[RADIUS] - to[RADIUS], self.taper);
        let is_one = found.lead.is_some() && found.unknown == 0 && along && across;
        is_one.then(|| (to[RADIUS] - self.crest) * self.inward)
    }

    /// Whether the thread `other` is equal and begins at the same Z. The approach moves may differ.
    fn is_again(&self, other: &Threaded) -> bool {
        self.begin[DEPTH] == other.begin[DEPTH] && *self == Threaded { begin: self.begin, ..other.clone() }
    }

    /// Whether a rapid between passes crosses uncut material of the thread. Moves along the axis must be outside of the
    /// crest. The move to the depth of a pass must be at the position where the passes begin.
    fn is_crossed(&self, a: &Rapid, b: &Rapid, tolerance: f64) -> bool {
        let outermost = [self.crest, self.crest + self.taper].map(|crest| crest * self.inward).into_iter();
        let crest = outermost.fold(f64::INFINITY, f64::min);
        let beside = |rapid: &Rapid| rapid.to[RADIUS] * self.inward <= crest + tolerance;
        let moves_along = (a.to[DEPTH] - b.to[DEPTH]).abs() > tolerance;
        let begins = |rapid: &Rapid| (rapid.to[DEPTH] - self.begin[DEPTH]).abs() <= 2.0 * tolerance;
        let goes_in = !beside(b) && (b.to[RADIUS] - a.to[RADIUS]) * self.inward > tolerance;
        (a.unknown | b.unknown) != 0 || moves_along && !(beside(a) && beside(b)) || goes_in && !begins(b)
    }
}

/// Compares all passes of the program for a thread of the job.
pub(super) fn thread(s: &mut Sides<'_>, cut: &Cut, thread: &Threaded) -> Done {
    let tolerance = s.limits.tolerance;
    let whole = thread.passes.last().copied().unwrap_or(0.0);
    let help = "check the words that the form prints for the thread: AutoThread, CanThread, or Thread and ThreadPasses";
    let (mut reached, mut coarsest, mut count, mut line) = (0.0f64, 0.0f64, 0usize, 0);
    let mut as_job = true;
    while let Some(found) = s.next()? {
        let Some(depth) = thread.depth(&found, tolerance) else { break };
        // after the last pass, a pass with another depth or lead, or after a stop, belongs to the next thread
        let is_cut = count > 0 && (reached - whole).abs() <= 2.0 * tolerance;
        let lead = found.lead.unwrap_or(0.0);
        let has_lead = (lead - thread.lead).abs() <= PITCH * thread.lead;
        let is_other = (depth - whole).abs() > 2.0 * tolerance;
        if is_cut && (is_other || !has_lead || is_parted(&s.program.passage)) {
            break;
        }
        let from = Rapid { to: found.from, unknown: found.unknown, kept: 0, spin: None };
        if count == 0 {
            // the approach from a position outside of the thread
            s.job.rapids.push(from);
            super::pauses::compare(s);
            super::rapids::compare(s, true, found.line);
        } else {
            between(s, thread, from, found.line)?;
        }
        modal::compare(s, &cut_of(cut, &found), &found, false);
        if !has_lead {
            s.found(Code::PV006, found.line, "print F[frate] with the thread", || {
                format!("the lead of the thread is {}, but {} in the job", number(lead), number(thread.lead))
            });
        }
        if depth < -2.0 * tolerance {
            s.found(Code::PV023, found.line, help, || {
                let crest = number(thread.crest);
                format!("a pass of the thread at X{} does not reach the crest at X{crest}", number(found.end()[RADIUS]))
            });
        }
        as_job &= thread.passes.get(count).is_some_and(|pass| (pass - depth).abs() <= 2.0 * tolerance);
        coarsest = coarsest.max(depth - reached);
        reached = reached.max(depth);
        count += 1;
        line = found.line;
        s.program.take();
    }
    let made = s.threaded.take().filter(|(before, _)| thread.is_again(before)).map_or(0, |(_, more)| more);
    let again = count == 0
        && made >= thread.passes.len()
        && !is_parted(&s.job)
        && s.agreed.as_ref().is_some_and(|[wanted, _]| *wanted == cut.state);
    if again {
        // the job has the same thread twice: the program made the passes of both together
        s.threaded = Some((thread.clone(), made - thread.passes.len()));
        leave(s, thread, whole);
        return Ok(());
    }
    if count == 0 {
        let found = s.next()?;
        let (line, is) = found.map_or((0, "nothing".into()), |found| {
            let from = match unsaid(found.unknown) {
                Some(axes) => format!("an unknown position ({axes} is not printed)"),
                None => shown(&found.from, 0b101),
            };
            (found.line, format!("a cut from {from} to {}", shown(&found.end(), 0b101)))
        });
        let message = format!(
            "the job cuts a thread from Z{} to Z{}, but the program {is}",
            number(thread.begin[DEPTH]),
            number(thread.end)
        );
        return s.differs(Code::PV017, line, message, help);
    }
    if (reached - whole).abs() > 2.0 * tolerance {
        s.found(Code::PV004, line, help, || {
            format!("the thread is {} deep, but {} in the job", number(reached), number(whole))
        });
    }
    let longest =
        thread.passes.iter().fold((0.0, 0.0f64), |(before, longest), pass| (*pass, longest.max(pass - before))).1;
    if coarsest > LONGER * longest + 2.0 * tolerance {
        s.found(Code::PV023, line, help, || {
            format!("a pass of the thread cuts {} deep, but at most {} in the job", number(coarsest), number(longest))
        });
    }
    s.report.allowed.threads += u64::from(!as_job || count != thread.passes.len());
    s.threaded = Some((thread.clone(), count.saturating_sub(thread.passes.len())));
    leave(s, thread, whole);
    Ok(())
}

/// Ends a thread and sets the job's position after it.
fn leave(s: &mut Sides<'_>, thread: &Threaded, whole: f64) {
    s.hole.inside = None;
    s.report.counts.cuts += 1;
    // the tool goes out of the last pass, then back to the position where the passes begin
    let mut out = thread.begin;
    out[DEPTH] = thread.end;
    let end = Rapid {
        to: place(&[thread.crest + thread.inward * whole, 0.0, thread.end, 0.0, 0.0, 0.0]),
        unknown: 0,
        kept: 0,
        spin: None,
    };
    s.job.begin(end);
    s.job.rapids.push(Rapid { to: out, unknown: 0, kept: 0, spin: None });
    s.job.rapids.push(Rapid { to: thread.begin, unknown: 0, kept: 0, spin: None });
}

/// Whether two passes have a stop, a dwell or a change of frame between them.
fn is_parted(passage: &Passage) -> bool {
    passage.changed() || !passage.stops.is_empty() || !passage.waits.is_empty()
}

/// The values required for a pass. The lead of the pass is compared separately.
fn cut_of(cut: &Cut, found: &Cut) -> Cut {
    Cut { feed: None, line: found.line, ..cut.clone() }
}

/// Checks the path between two passes: out of the thread, back along the thread, and in for the next pass.
fn between(s: &mut Sides<'_>, thread: &Threaded, to: Rapid, line: u64) -> Done {
    let tolerance = s.limits.tolerance;
    let passage = &s.program.passage;
    let mut at = s.program.start();
    let mut low = None;
    for rapid in passage.rapids.iter().chain([&to]) {
        low = low.or(thread.is_crossed(&at, rapid, tolerance).then_some(rapid.to));
        at = *rapid;
    }
    if is_parted(passage) || !same(&at.to, &to.to, super::cut::ALL, tolerance) {
        let message = "a stop, a dwell or another tool between the passes of a thread".to_owned();
        return s.differs(Code::PV001, line, message, "check the words that the form prints between the passes");
    }
    if let Some(to) = low {
        s.found(Code::PV009, line, "retract across the thread first", || {
            format!("between passes a rapid goes to {} through the crest of the thread", shown(&to, 0b101))
        });
    }
    Ok(())
}
