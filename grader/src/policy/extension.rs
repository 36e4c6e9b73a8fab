//! Extensions: later due times for single people or groups.

use jiff::tz::TimeZone;
use jiff::{SignedDuration, Timestamp};
use serde::{Deserialize, Deserializer};
use toml::Value;

use crate::policy::written_time::{TimeError, read_time};

/// A later due time for a person or a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extension {
    /// This number of days after everybody's due time.
    Days(u16),
    /// A due time of their own.
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

    /// Returns the due time with this extension. It is never before everybody's due time.
    pub fn apply(self, due: Timestamp) -> Timestamp {
        match self {
            Extension::Days(days) => {
                let days = SignedDuration::from_hours(24 * i64::from(days));
                due.checked_add(days).unwrap_or(Timestamp::MAX)
            }
            Extension::Until(own) => own.max(due),
        }
    }
}

impl<'de> Deserialize<'de> for Extension {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let extension = match Value::deserialize(deserializer)? {
            Value::Integer(days) => u16::try_from(days).ok().map(Extension::Days),
            Value::Datetime(time) => time.to_string().parse().ok().map(Extension::Until),
            Value::String(_)
            | Value::Float(_)
            | Value::Boolean(_)
            | Value::Array(_)
            | Value::Table(_) => None,
        };
        extension.ok_or_else(|| {
            serde::de::Error::custom(
                "must be a number of days, or a date and time with an offset, such as \
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
        let days = |days: u64| Lateness {
            seconds: days * 24 * 60 * 60,
        };
        assert_eq!(late(&["bob"]), days(3));
        assert_eq!(late(&["early"]), days(3));
        assert_eq!(late(&["ann", "ann@X.edu"]), days(1));
        assert_eq!(late(&["ann@x.edu", "team a"]), Lateness::NONE);
        for bad in ["-1", "'2 days'", "1.5", "2026-11-24"] {
            let text = format!("[late.extensions]\nann = {bad}");
            let error = toml::from_str::<Policy>(&text).unwrap_err();
            assert!(
                error.to_string().contains("a number of days, or"),
                "{error}"
            );
        }
    }
}
