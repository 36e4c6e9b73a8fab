//! Extensions: later due times for individual people or groups.

use jiff::Timestamp;
use jiff::tz::TimeZone;
use serde::{Deserialize, Deserializer};
use toml::Value;

use crate::policy::lateness::after_days;
use crate::policy::time_parser::{
    MOST_DAYS, TimeError, are_far_apart, has_plausible_year, read_time,
};

/// A later due time for a person or a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extension {
    /// This many days after the due time that applies to everybody.
    Days(u16),
    /// An individual due time.
    Until(Timestamp),
}

impl Extension {
    /// Reads an extension from a roster: a number of days, or a time. A time without an offset from
    /// UTC is a local time in `zone`.
    pub fn parse(text: &str, zone: Option<&TimeZone>) -> Result<Self, TimeError> {
        match text.trim().parse() {
            Ok(days) => Ok(Extension::Days(days)),
            Err(_) => read_time(text, zone).map(Extension::Until),
        }
    }

    /// Returns the due time after applying this extension. The result is never earlier than the
    /// regular due time. If a time zone is given, days are calendar days in that zone.
    pub fn apply(self, due: Timestamp, zone: Option<&TimeZone>) -> Timestamp {
        match self {
            Extension::Days(days) => after_days(due, days.into(), zone),
            Extension::Until(own) => own.max(due),
        }
    }

    /// Returns whether the extension is so long, or ends so long before the due time, that it must
    /// be a mistake.
    pub fn is_far_from(self, due: Option<Timestamp>) -> bool {
        match self {
            Extension::Days(days) => i64::from(days) > MOST_DAYS,
            Extension::Until(own) => due.is_some_and(|due| are_far_apart(own, due)),
        }
    }
}

impl<'de> Deserialize<'de> for Extension {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let extension = match Value::deserialize(deserializer)? {
            Value::Integer(days) => u16::try_from(days).ok().map(Extension::Days),
            Value::Datetime(time) => {
                let time = time.to_string().parse().ok();
                time.filter(|time| has_plausible_year(*time))
                    .map(Extension::Until)
            }
            Value::String(_)
            | Value::Float(_)
            | Value::Boolean(_)
            | Value::Array(_)
            | Value::Table(_) => None,
        };
        extension.ok_or_else(|| {
            serde::de::Error::custom(
                "must be a whole number of days, or a date and time with an offset, such as \
                 2026-11-25T23:59:59+01:00",
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::policy::{Lateness, Policy};

    #[test]
    fn a_cell_of_a_roster_is_a_number_of_days_or_a_time() {
        let read = |text| Extension::parse(text, None);
        assert_eq!(read(" 2 "), Ok(Extension::Days(2)));
        let until = Extension::Until("2026-11-24T11:00:00Z".parse().unwrap());
        assert_eq!(read(" 2026-11-24 12:00:00 +0100 "), Ok(until));
        assert_eq!(read("2026-11-24 12:00"), Err(TimeError::NoTimeZone));
        assert_eq!(read("two"), Err(TimeError::UnknownForm));
    }

    #[test]
    fn the_latest_extension_that_names_a_person_counts() {
        let text = "[late]\ndue = 2026-11-20T12:00:00Z\n[late.extensions]\n'Ann@x.edu' = 2\n\
                    'Team A' = 2026-11-24T12:00:00+01:00\n'early' = 2026-11-01T12:00:00Z\n";
        let policy: Policy = toml::from_str(text).unwrap();
        let late = |names: &[&str]| {
            let extensions: Vec<_> = policy.extensions_of(names.iter().copied()).collect();
            let submitted = "2026-11-23T12:00:00Z".parse().unwrap();
            policy.lateness(submitted, &extensions).unwrap()
        };
        let days = |days: u64| Lateness::of_seconds(days * 24 * 60 * 60);
        assert_eq!(late(&["bob"]), days(3));
        assert_eq!(late(&["early"]), days(3));
        assert_eq!(late(&["ann", "ann@X.edu"]), days(1));
        assert_eq!(late(&["ann@x.edu", "team a"]), Lateness::NONE);
        for bad in [
            "-1",
            "'2 days'",
            "1.5",
            "2026-11-24",
            "0026-11-24T12:00:00Z",
        ] {
            let text = format!("[late.extensions]\nann = {bad}");
            let error = toml::from_str::<Policy>(&text).unwrap_err().to_string();
            assert!(error.contains("a whole number of days, or"), "{error}");
        }
    }

    #[test]
    fn an_extension_of_days_ends_at_the_same_time_of_day() {
        let text = "[late]\ndue = 2026-10-23T23:59:00+02:00\ntimezone = 'Europe/Berlin'";
        let policy: Policy = toml::from_str(text).unwrap();
        // Clocks are set back on 25 October.
        let end = policy.extended_due(&[Extension::Days(2)]);
        assert_eq!(end, "2026-10-25T23:59:00+01:00".parse().ok());
        assert_eq!(policy.extended_due(&[Extension::Days(0)]), policy.late.due);
    }

    #[test]
    fn an_extension_is_at_most_half_a_year_from_the_due_time() {
        let due = "2026-10-23T23:59:00Z".parse().ok();
        let until = |text: &str| Extension::Until(text.parse().unwrap());
        for (extension, due, is_far) in [
            (Extension::Days(183), None, false),
            // Spreadsheets represent a date as the number of days since 1899.
            (Extension::Days(46318), None, true),
            (until("2025-10-25T23:59:00Z"), due, true),
            (until("2027-10-25T23:59:00Z"), due, true),
            (until("2026-10-01T23:59:00Z"), due, false),
            (until("2025-10-25T23:59:00Z"), None, false),
        ] {
            assert_eq!(extension.is_far_from(due), is_far, "{extension:?}");
        }
    }
}
