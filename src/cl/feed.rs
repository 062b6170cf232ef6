//! Feeds: FEDRAT, feeds in motion statements, and dwells.

use super::dialect::Dialect;
use super::fault::{Done, fault};
use super::feed_unit::Feed;
use super::job::{Job, Waiting};
use super::missing::no_start;
use super::state::{Feeds, Motion, State};
use super::words::{Word, numbers};
use crate::diag::Code;
use crate::toolpath::{Event, Units};

/// Millimetres in an inch.
const MM: f64 = 25.4;

/// The feed that a unit word and a number give, in the file's units. `None`: the unit word is unknown.
pub(super) fn feed_of(job: &mut Job<'_>, unit: &str, value: f64) -> Done<Option<Feed>> {
    match unit {
        "PERMIN" | "UPM" => return Ok(Some(Feed::Minute(value))),
        "PERREV" | "UPR" => return Ok(Some(Feed::Revolution(value))),
        _ => {}
    }
    let inches = if job.units()? == Units::Mm { MM } else { 1.0 };
    Ok(Some(match unit {
        "IPM" => Feed::Minute(value * inches),
        "MMPM" => Feed::Minute(value * inches / MM),
        "IPR" => Feed::Revolution(value * inches),
        "MMPR" => Feed::Revolution(value * inches / MM),
        // in PostWorks, a value below 1 is the lead of the thread
        "TPI" if job.notes.dialect() == Dialect::Ncl && value < 1.0 => Feed::Revolution(value),
        "TPI" => Feed::Revolution(inches / value),
        _ => return Ok(None),
    }))
}

/// Converts a feed to the unit of the job: per minute, or per revolution on lathes. Some conversions need a fixed spindle speed.
pub(super) fn counted(job: &Job<'_>, feed: Feed) -> Done<f64> {
    match (feed, job.spindle.rpm()) {
        (Feed::Revolution(value), _) if job.turns_part() => Ok(value),
        (Feed::Minute(value), Some(rpm)) if job.turns_part() => Ok(value / rpm),
        (Feed::Minute(_), None) if job.turns_part() => {
            let help = "write the feed per revolution, as FEDRAT/0.2,MMPR";
            fault(Code::PC009, "a feed per minute on a lathe, but the spindle has no fixed speed", help)
        }
        (Feed::Minute(value), _) => Ok(value),
        (Feed::Revolution(value), Some(rpm)) => Ok(value * rpm),
        (Feed::Revolution(_), None) => {
            let help = "put SPINDL/speed,RPM,CLW before it";
            fault(Code::PC009, "a feed per revolution, but the spindle does not turn", help)
        }
    }
}

/// Reads FEDRAT: a number and its unit, in either order.
pub(super) fn fedrat(words: &[Word], state: &mut State<'_>) -> Done {
    if is_ignored("FEDRAT", state) {
        return Ok(());
    }
    let value = words.iter().find_map(Word::number);
    let feed = match (words, value) {
        ([Word::Number(value)], _) => Some(Feed::Minute(*value)),
        ([Word::Name(unit), Word::Number(value)] | [Word::Number(value), Word::Name(unit)], _) => {
            feed_of(&mut state.job, unit, *value)?.filter(|_| unit != "TPI")
        }
        _ => None,
    };
    let Some(feed) = feed else {
        let help = "write FEDRAT/value,MMPM, or IPM, PERMIN, MMPR, IPR, PERREV";
        return fault(Code::PL002, "a FEDRAT that can't be read", help);
    };
    if value.is_some_and(|value| value <= 0.0) {
        return fault(Code::PL001, "a feed that is not above zero", "give a feed above zero");
    }
    set_feed(feed, state);
    Ok(())
}

/// Sets a feed that is part of a motion statement.
pub(super) fn feed_on_goto(value: f64, state: &mut State<'_>) -> Done {
    if value <= 0.0 {
        return fault(Code::PL001, "a feed that is not above zero", "give a feed above zero");
    }
    if is_ignored("a feed in a motion statement", state) {
        return Ok(());
    }
    let feed = match state.feeds.feed {
        Some(Feed::Revolution(_)) => Feed::Revolution(value),
        _ => Feed::Minute(value),
    };
    set_feed(feed, state);
    Ok(())
}

/// Whether a feed is ignored because a cycle is active. `what` names the feed in the warning. Autodesk repeats the feed of a
/// cycle at each of its points, so there is no warning then.
fn is_ignored(what: &str, state: &mut State<'_>) -> bool {
    if state.cycle.is_active() && state.cycle.heights.is_none() {
        let help = "write the feed in the CYCLE statement";
        state.job.notes.warn(Code::PC052, format!("{what} inside a cycle is ignored"), help);
    }
    state.cycle.is_active()
}

/// Sets the feed for the following cuts. After CYCLE/OFF, a feed makes the next motion a cut.
fn set_feed(feed: Feed, state: &mut State<'_>) {
    state.feeds = Feeds { feed: Some(feed), cut_off: None };
    state.motion.rapid_after_cycle = false;
}

/// The feed for the next motion. `None`: the sink already has this feed.
#[inline]
pub(super) fn feed_to_say(feeds: &Feeds, job: &mut Job<'_>) -> Done<Option<f64>> {
    if let Some(line) = feeds.cut_off {
        let message = format!("the tool change in line {line} ended a cycle: this point has no cycle and no feed");
        let help = "put CYCLE/OFF before the tool change, and CYCLE or FEDRAT before this point";
        return fault(Code::PC043, message, help);
    }
    let Some(feed) = feeds.feed else {
        let help = "put FEDRAT first, or give the feed with `--assume-feed 200`, in units of the file per minute";
        return fault(Code::PR011, "a feed motion before any feed", help);
    };
    job.turns()?;
    let feed = counted(job, feed)?;
    Ok(job.feed_to_say(feed))
}

/// If the first motion is a cut, pushes a rapid to the tool's position before it.
#[inline]
pub(super) fn approach(motion: &Motion, feeds: &Feeds, job: &mut Job<'_>) -> Done {
    if !job.is_unmoved() || feeds.feed.is_none() {
        return Ok(()); // the missing feed is reported first
    }
    match motion.position {
        Some(from) => {
            let from = job.axes(from)?;
            job.wait(Waiting::Rapid(from))
        }
        None => no_start(job),
    }
}

/// Reads DELAY/seconds, or DELAY with revolutions (REV).
pub(super) fn delay(words: &[Word], job: &mut Job<'_>) -> Done {
    let seconds = match (numbers(words).as_deref(), words) {
        (Some([seconds]), _) => *seconds,
        (None, [Word::Name(name), Word::Number(n)] | [Word::Number(n), Word::Name(name)]) if name == "REV" => {
            let Some(rpm) = job.spindle.rpm() else {
                return fault(
                    Code::PC009,
                    "a DELAY in revolutions, but the spindle does not turn",
                    "write DELAY/seconds",
                );
            };
            n / rpm * 60.0
        }
        _ => return fault(Code::PL001, "a DELAY that can't be read", "write DELAY/seconds or DELAY/REV,turns"),
    };
    if seconds < 0.0 {
        return fault(Code::PL001, "a DELAY below zero", "write DELAY/seconds");
    }
    job.between(Event::Dwell(seconds))
}
