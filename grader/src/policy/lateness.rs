//! The lateness of a submission, in seconds and in calendar days.

use jiff::tz::TimeZone;
use jiff::{Span, Timestamp};

/// One day, in seconds.
const DAY: u64 = 24 * 60 * 60;

/// The time between the due time and the submission.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Lateness {
    /// Seconds after the due time, or 0 if the submission is on time.
    pub seconds: u64,
    /// Days since the due time. A day that has only started counts in full.
    pub(super) days: u32,
    /// Whether the time isn't known, so that the lateness is assumed.
    pub is_assumed: bool,
}

impl Lateness {
    /// The lateness of a submission that is on time.
    pub const NONE: Lateness = Lateness {
        seconds: 0,
        days: 0,
        is_assumed: false,
    };

    /// Returns the lateness of a submission that is this many seconds late. Every day counts as 24
    /// hours, since the time of the submission is unknown.
    pub fn of_seconds(seconds: u64) -> Self {
        let days = u32::try_from(seconds.div_ceil(DAY)).unwrap_or(u32::MAX);
        Lateness {
            seconds,
            days,
            ..Lateness::NONE
        }
    }

    /// Returns this lateness, for a submission whose time isn't known.
    #[must_use]
    pub fn assumed(mut self, is_assumed: bool) -> Self {
        self.is_assumed = is_assumed;
        self
    }

    /// Returns the time from `due` to the submission, in full seconds. If a time zone is given,
    /// days are calendar days in that zone, some of which have 23 or 25 hours.
    pub(super) fn since(due: Timestamp, submitted: Timestamp, zone: Option<&TimeZone>) -> Self {
        let seconds = u64::try_from(submitted.duration_since(due).as_secs()).unwrap_or(0);
        let by_hours = Lateness::of_seconds(seconds);
        // Clocks change by less than a day, so the number of calendar days differs by at most one.
        let is_over = |days: &u32| {
            let end = after_days(due, (*days).into(), zone);
            submitted.duration_since(end).as_secs() <= 0
        };
        let around = by_hours.days.saturating_sub(1)..=by_hours.days.saturating_add(1);
        let days = around.into_iter().find(is_over).unwrap_or(by_hours.days);
        Lateness { days, ..by_hours }
    }
}

/// Returns the same time of day this number of days later. If clocks skip that time, a later time
/// is returned. If clocks show that time twice, its second occurrence is returned. Both choices are
/// in the student's favour.
pub(super) fn after_days(due: Timestamp, days: i64, zone: Option<&TimeZone>) -> Timestamp {
    if days == 0 {
        return due;
    }
    let zone = zone.cloned().unwrap_or(TimeZone::UTC);
    let span = Span::new().try_days(days);
    let local = span.and_then(|span| zone.to_datetime(due).checked_add(span));
    let later = local.and_then(|local| zone.to_ambiguous_timestamp(local).later());
    later.unwrap_or(Timestamp::MAX)
}

#[cfg(test)]
mod tests {
    use crate::policy::Policy;

    #[test]
    fn days_are_those_of_the_calendar() {
        let days = |zone: &str, due: &str, submitted: &str| {
            let policy: Policy = toml::from_str(&format!("[late]\ndue = {due}\n{zone}")).unwrap();
            let lateness = policy.lateness(submitted.parse().unwrap(), &[]).unwrap();
            policy.final_points(1, 1, lateness).late_days
        };
        let berlin = "timezone = 'Europe/Berlin'";
        // Winter time begins on 25 October at 3:00, so this day has 25 hours.
        let due = "2026-10-24T23:59:00+02:00";
        assert_eq!(days(berlin, due, "2026-10-25T23:59:00+01:00"), 1);
        assert_eq!(days(berlin, due, "2026-10-25T23:59:01+01:00"), 2);
        assert_eq!(days("", due, "2026-10-25T23:59:00+01:00"), 2);
        assert_eq!(days(berlin, due, "2026-10-30T23:59:00+01:00"), 6);
        // Summer time begins on 28 March at 2:00, so this day has 23 hours.
        let due = "2027-03-27T23:59:00+01:00";
        assert_eq!(days(berlin, due, "2027-03-28T23:59:00+02:00"), 1);
        assert_eq!(days(berlin, due, "2027-03-28T23:59:01+02:00"), 2);
        assert_eq!(days("", due, "2027-03-28T23:59:01+02:00"), 1);
        // Clocks skip 2:30 on the day after the first due time and show it twice on the day after
        // the second.
        let due = "2027-03-27T02:30:00+01:00";
        assert_eq!(days(berlin, due, "2027-03-28T03:30:00+02:00"), 1);
        assert_eq!(days(berlin, due, "2027-03-28T03:30:01+02:00"), 2);
        let due = "2026-10-24T02:30:00+02:00";
        assert_eq!(days(berlin, due, "2026-10-25T02:30:00+01:00"), 1);
        assert_eq!(days(berlin, due, "2026-10-25T02:30:01+01:00"), 2);
    }
}
