//! Feeds: FEDRAT, feeds that ride on motions, dwells.

use super::dialect::Dialect;
use super::fault::{Done, fault};
use super::job::Job;
use super::state::{Feed, Feeds, State};
use super::words::{Word, numbers};
use crate::diag::Code;
use crate::toolpath::{Event, Units};

/// Millimetres in an inch.
const MM: f64 = 25.4;

/// The feed that a unit word and a number mean, in lengths of the file. `None`: no such word.
pub(super) fn feed_of(job: &Job<'_>, unit: &str, value: f64) -> Done<Option<Feed>> {
    if matches!(unit, "PERMIN" | "PERREV") {
        return Ok(Some(if unit == "PERMIN" { Feed::Minute(value) } else { Feed::Revolution(value) }));
    }
    let inches = if job.units()? == Units::Mm { MM } else { 1.0 };
    Ok(Some(match unit {
        "IPM" => Feed::Minute(value * inches),
        "MMPM" => Feed::Minute(value * inches / MM),
        "IPR" => Feed::Revolution(value * inches),
        "MMPR" => Feed::Revolution(value * inches / MM),
        // PostWorks: below 1 it is the lead
        "TPI" if job.notes.dialect() == Dialect::Ncl && value < 1.0 => Feed::Revolution(value),
        "TPI" => Feed::Revolution(inches / value),
        _ => return Ok(None),
    }))
}

/// A feed in lengths a minute; per revolution it needs a turning spindle.
pub(super) fn per_minute(job: &Job<'_>, feed: Feed) -> Done<f64> {
    match (feed, job.spindle.rpm()) {
        (Feed::Minute(value), _) => Ok(value),
        (Feed::Revolution(value), Some(rpm)) => Ok(value * rpm),
        (Feed::Revolution(_), None) => {
            let help = "put SPINDL/speed,RPM,CLW before it";
            fault(Code::PC009, "a feed per revolution, and the spindle does not turn", help)
        }
    }
}

/// FEDRAT: a number and its unit in any order.
pub(super) fn fedrat(words: &[Word], state: &mut State<'_>) -> Done {
    if state.cycle.is_active() {
        let help = "say the feed in the CYCLE statement";
        state.job.notes.warn(Code::PC052, "FEDRAT inside a cycle is ignored", help);
        return Ok(());
    }
    let value = words.iter().find_map(Word::number);
    let feed = match (words, value) {
        ([Word::Number(value)], _) => Some(Feed::Minute(*value)),
        ([Word::Name(unit), Word::Number(value)] | [Word::Number(value), Word::Name(unit)], _) => {
            feed_of(&state.job, unit, *value)?.filter(|_| unit != "TPI")
        }
        _ => None,
    };
    let Some(feed) = feed else {
        let help = "write FEDRAT/value,MMPM, or IPM, PERMIN, MMPR, IPR, PERREV";
        return fault(Code::PL002, "a FEDRAT that can't be read", help);
    };
    if value.is_some_and(|value| value <= 0.0) {
        return fault(Code::PL001, "a feed that is not above zero", "give the feed");
    }
    state.feeds = Feeds { feed: Some(feed), cut_off: None };
    state.motion.rapid_after_cycle = false;
    Ok(())
}

/// A feed that rides on a motion.
pub(super) fn feed_on_goto(value: f64, feeds: &mut Feeds) -> Done {
    if value <= 0.0 {
        return fault(Code::PL001, "a feed that is not above zero", "give the feed");
    }
    let feed = match feeds.feed {
        Some(Feed::Revolution(_)) => Feed::Revolution(value),
        _ => Feed::Minute(value),
    };
    *feeds = Feeds { feed: Some(feed), cut_off: None };
    Ok(())
}

/// The feed of the next motion, where the sink does not have it yet.
#[inline]
pub(super) fn feed_to_say(feeds: &Feeds, job: &mut Job<'_>) -> Done<Option<f64>> {
    if let Some(line) = feeds.cut_off {
        let message = format!("the tool change in line {line} ended a cycle, and nothing says how this point is cut");
        let help = "put CYCLE/OFF before the tool change, and CYCLE or FEDRAT before this point";
        return fault(Code::PC043, message, help);
    }
    let Some(feed) = feeds.feed else {
        return fault(Code::PR011, "a feed motion before any feed", "put FEDRAT before it");
    };
    let feed = per_minute(job, feed)?;
    Ok(job.feed_to_say(feed))
}

/// DELAY/seconds, or revolutions with REV.
pub(super) fn delay(words: &[Word], job: &mut Job<'_>) -> Done {
    let seconds = match (numbers(words).as_deref(), words) {
        (Some([seconds]), _) => *seconds,
        (None, [Word::Name(name), Word::Number(n)] | [Word::Number(n), Word::Name(name)]) if name == "REV" => {
            n / per_minute(job, Feed::Revolution(1.0))? * 60.0
        }
        _ => return fault(Code::PL001, "a DELAY that can't be read", "write DELAY/seconds or DELAY/REV,turns"),
    };
    if seconds < 0.0 {
        return fault(Code::PL001, "a DELAY below zero", "write DELAY/seconds");
    }
    job.between(Event::Dwell(seconds))
}
