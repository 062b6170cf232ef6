//! Date and time of printing: from --date, from SOURCE_DATE_EPOCH, else the local time.

use jiff::civil::DateTime;
use jiff::{Timestamp, Zoned};
use postform::internals::render::Clock;

/// Reads --date.
pub fn parse(text: &str) -> Result<Clock, String> {
    Clock::parse(text).ok_or_else(|| "write a date, as 2026-03-31, or a date and time, as 2026-03-31T14:05".to_owned())
}

/// Date and time of printing if --date is not given.
pub fn now() -> Result<Clock, String> {
    const EPOCH: &str = "SOURCE_DATE_EPOCH";
    let Ok(seconds) = std::env::var(EPOCH) else { return Ok(of(Zoned::now().datetime())) };
    let seconds = seconds.trim().parse().ok().and_then(|seconds| Timestamp::from_second(seconds).ok());
    let Some(stamp) = seconds else {
        return Err(format!(
            "error: {EPOCH} is not a number of seconds since 1970\n  help: give --date, or unset {EPOCH}"
        ));
    };
    Ok(of(stamp.to_zoned(jiff::tz::TimeZone::UTC).datetime()))
}

fn of(moment: DateTime) -> Clock {
    Clock { date: moment.date().to_string(), time: moment.strftime("%H:%M").to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_day_may_have_a_time() {
        let clock = |date: &str, time: &str| Clock { date: date.into(), time: time.into() };
        assert_eq!(parse("2026-03-31").unwrap(), clock("2026-03-31", ""));
        assert_eq!(parse("2026-03-31T14:05").unwrap(), clock("2026-03-31", "14:05"));
        assert_eq!(parse("2026-03-31 14:05:59").unwrap(), clock("2026-03-31", "14:05"));
        for wrong in ["", "today", "31.3.2026", "2026-02-30", "2026-03-31T25:00"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}
