//! Reads times as learning platforms write them.

use jiff::Timestamp;
use jiff::civil::{Date, DateTime, Time};
use jiff::fmt::strtime::BrokenDownTime;
use jiff::tz::TimeZone;

/// Forms with an offset from UTC: ISO 8601, Gradescope's exports, RFC 2822.
const WITH_OFFSET: [&str; 6] = [
    "%Y-%m-%dT%H:%M:%S%.f%:z",
    "%Y-%m-%dT%H:%M:%S%.f%z",
    "%Y-%m-%d %H:%M:%S%.f %z",
    "%Y-%m-%d %H:%M:%S%.f %:z",
    "%Y-%m-%d %H:%M %z",
    "%a, %d %b %Y %H:%M:%S %z",
];
/// Forms without one, in which the order of day and month is certain: ISO 8601, Moodle's
/// worksheets, Canvas's pages, and German dates.
const WITHOUT_OFFSET: [&str; 15] = [
    "%Y-%m-%dT%H:%M:%S%.f",
    "%Y-%m-%dT%H:%M",
    "%Y-%m-%d %H:%M:%S%.f",
    "%Y-%m-%d %H:%M",
    "%Y-%m-%d %I:%M %p",
    "%A, %d %B %Y, %I:%M %p",
    "%A, %d %B %Y, %H:%M",
    "%A, %d %B %Y %I:%M %p",
    "%d %B %Y, %I:%M %p",
    "%d %B %Y, %H:%M",
    "%d.%m.%Y %H:%M:%S",
    "%d.%m.%Y %H:%M",
    "%d.%m.%Y, %H:%M",
    "%B %d, %Y at %I:%M %p",
    "%B %d, %Y %I:%M %p",
];
/// The forms of the time of day after a date with slashes.
const TIMES_OF_DAY: [&str; 4] = ["%H:%M:%S", "%H:%M", "%I:%M %p", "%I:%M:%S %p"];

/// The reason why a text is no point in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TimeError {
    /// The text has no known form.
    #[error("it is not a date and time in a known form, such as 2026-11-20 23:59:59 +0100")]
    UnknownForm,
    /// The day and the month cannot be told apart.
    #[error("it could be two different dates: write it as 2026-11-20 23:59:59 +0100")]
    AmbiguousDate,
    /// There is no offset from UTC, and no time zone is known.
    #[error("it has no time zone: set `timezone` under [late] in the policy")]
    NoTimeZone,
}

/// Reads a time as a platform writes it. A time without an offset from UTC is a local time in
/// `zone`; if clocks show it twice because they are set back, the first of the two is meant, which is
/// better for a student.
pub fn read_time(text: &str, zone: Option<&TimeZone>) -> Result<Timestamp, TimeError> {
    let text = normalise(text);
    let mut forms = WITH_OFFSET.iter();
    let exact = forms.find_map(|form| parse(form, &text)?.to_timestamp().ok());
    if let Some(time) = exact {
        return Ok(time);
    }
    let local = local_time(&text)?;
    let zone = zone.ok_or(TimeError::NoTimeZone)?;
    let instant = zone.to_ambiguous_timestamp(local).earlier();
    instant.map_err(|_| TimeError::UnknownForm)
}

/// Writes white space and the names of UTC in one way.
fn normalise(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    let text = words.join(" ");
    // The name of a time zone, as in RFC 9557, says no more than the offset before it.
    let text = match text.split_once('[') {
        Some((before, _)) if text.ends_with(']') => before,
        Some(_) | None => &text,
    };
    for name in [" UTC", " GMT", " Z", "Z"] {
        if let Some(before) = text.strip_suffix(name) {
            return format!("{} +0000", without_separator(before));
        }
    }
    text.to_owned()
}

/// Replaces the `T` between the date and the time by a space, but none in the name of a day.
fn without_separator(text: &str) -> String {
    match text.split_once('T') {
        Some((date, time)) if date.ends_with(|sign: char| sign.is_ascii_digit()) => {
            format!("{date} {time}")
        }
        Some(_) | None => text.to_owned(),
    }
}

fn parse(form: &str, text: &str) -> Option<BrokenDownTime> {
    BrokenDownTime::parse(form, text).ok()
}

fn local_time(text: &str) -> Result<DateTime, TimeError> {
    let mut forms = WITHOUT_OFFSET.iter();
    let found = forms.find_map(|form| parse(form, text)?.to_datetime().ok());
    match found {
        Some(time) => Ok(time),
        None => with_slashes(text),
    }
}

/// Reads a date such as `11/20/2026` or `20/11/2026`, and a time of day.
fn with_slashes(text: &str) -> Result<DateTime, TimeError> {
    let (date, time) = text.split_once(' ').ok_or(TimeError::UnknownForm)?;
    let numbers: Option<Vec<i16>> = date
        .trim_end_matches(',')
        .split('/')
        .map(|number| number.parse().ok())
        .collect();
    let Some(&[one, other, year]) = numbers.as_deref() else {
        return Err(TimeError::UnknownForm);
    };
    // A year of two digits is none: it could be the day.
    if year < 1000 {
        return Err(TimeError::UnknownForm);
    }
    let date = |month: i16, day: i16| {
        let (month, day) = (i8::try_from(month).ok()?, i8::try_from(day).ok()?);
        Date::new(year, month, day).ok()
    };
    let date = match (date(one, other), date(other, one)) {
        (Some(one), Some(other)) if one != other => return Err(TimeError::AmbiguousDate),
        (Some(date), _) | (None, Some(date)) => date,
        (None, None) => return Err(TimeError::UnknownForm),
    };
    let mut forms = TIMES_OF_DAY.iter();
    let time: Option<Time> = forms.find_map(|form| parse(form, time)?.to_time().ok());
    Ok(date.to_datetime(time.ok_or(TimeError::UnknownForm)?))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn berlin() -> TimeZone {
        TimeZone::get("Europe/Berlin").unwrap()
    }

    fn read(text: &str) -> Result<String, TimeError> {
        read_time(text, Some(&berlin())).map(|time| time.to_string())
    }

    #[test]
    fn reads_the_forms_that_platforms_write() {
        for (text, expected) in [
            // Gradescope: its metadata and its CSV.
            ("2026-11-20 22:01:05.000000000 Z", "2026-11-20T22:01:05Z"),
            ("2026-11-25 10:00:00 -0800", "2026-11-25T18:00:00Z"),
            ("2026-11-25 10:00:00 +0100", "2026-11-25T09:00:00Z"),
            ("2026-11-20 22:01:05 UTC", "2026-11-20T22:01:05Z"),
            ("\t2026-11-20\u{a0} 22:01:05\tUTC\n", "2026-11-20T22:01:05Z"),
            // classroom50 and Canvas's interface for programs.
            ("2026-11-20T10:00:00Z", "2026-11-20T10:00:00Z"),
            ("2026-11-20T23:01:05.25+01:00", "2026-11-20T22:01:05.25Z"),
            // git.
            ("Fri, 20 Nov 2026 23:01:05 +0100", "2026-11-20T22:01:05Z"),
            // Moodle's worksheet, in English.
            ("Friday, 27 November 2026, 11:12 PM", "2026-11-27T22:12:00Z"),
            ("Friday, 27 November 2026, 23:12", "2026-11-27T22:12:00Z"),
            // Spreadsheets.
            ("2026-11-25 10:00", "2026-11-25T09:00:00Z"),
            ("25.11.2026 10:00", "2026-11-25T09:00:00Z"),
            ("25.7.2026 10:00:30", "2026-07-25T08:00:30Z"),
            ("11/25/2026 10:00 AM", "2026-11-25T09:00:00Z"),
            ("25/11/2026, 10:00", "2026-11-25T09:00:00Z"),
            ("5/5/2026 10:00", "2026-05-05T08:00:00Z"),
            ("25/11/2026 10:00:30", "2026-11-25T09:00:30Z"),
            // The first year of four digits.
            ("25/11/1000 10:00", "1000-11-25T09:06:32Z"),
        ] {
            assert_eq!(read(text).as_deref(), Ok(expected), "{text}");
        }
    }

    #[test]
    fn what_is_ambiguous_or_unknown_is_no_time() {
        assert_eq!(read("04/05/2026 10:00"), Err(TimeError::AmbiguousDate));
        for text in [
            "yesterday",
            "",
            "2026-11-25",
            "Freitag, 27. November 2026, 23:12",
            "13/13/2026 10:00",
            "2026-02-30 10:00",
            "1795212065",
            // The year could be the day.
            "25/11/26 10:00",
            "25/11/999 10:00",
            // The name of a time zone ends.
            "2026-11-25 10:00[Europe/Berlin",
        ] {
            assert_eq!(read(text), Err(TimeError::UnknownForm), "{text}");
        }
        let local = read_time("2026-11-25 10:00", None);
        assert_eq!(local, Err(TimeError::NoTimeZone));
    }

    #[test]
    fn a_repeated_hour_counts_for_the_student() {
        // Clocks in Berlin show 02:30 twice on this day: at 00:30 and at 01:30 UTC.
        assert_eq!(
            read("2026-10-25 02:30").as_deref(),
            Ok("2026-10-25T00:30:00Z")
        );
        // They never show this time.
        assert_eq!(
            read("2026-03-29 02:30").as_deref(),
            Ok("2026-03-29T00:30:00Z")
        );
    }

    proptest! {
        #[test]
        fn every_form_is_read_back(seconds in 0i64..4_000_000_000) {
            let zone = berlin();
            let time = Timestamp::from_second(seconds / 60 * 60).unwrap();
            let zoned = time.to_zoned(zone.clone());
            for form in WITH_OFFSET {
                let text = zoned.strftime(form).to_string();
                prop_assert_eq!(read_time(&text, None), Ok(time), "{}", text);
            }
            // In a repeated hour, the first of the two is meant.
            let earlier = zone.to_ambiguous_timestamp(zoned.datetime()).earlier().unwrap();
            for form in WITHOUT_OFFSET {
                let text = zoned.strftime(form).to_string();
                prop_assert_eq!(read_time(&text, Some(&zone)), Ok(earlier), "{}", text);
            }
        }

        #[test]
        fn the_names_of_utc_are_read_back(seconds in 0i64..4_000_000_000) {
            let time = Timestamp::from_second(seconds / 60 * 60).unwrap();
            let zoned = time.to_zoned(TimeZone::UTC);
            for form in WITH_OFFSET {
                let form = form.trim_end_matches("%:z").trim_end_matches("%z");
                for name in ["Z", " Z", " UTC", " GMT"] {
                    let text = format!("{}{name}", zoned.strftime(form.trim_end()));
                    prop_assert_eq!(read_time(&text, None), Ok(time), "{}", text);
                }
            }
        }

        #[test]
        fn the_forms_of_jiff_are_read_back(
            nanoseconds in 0i128..4_000_000_000_000_000_000,
            zone in prop::sample::select(vec!["Europe/Berlin", "America/New_York", "UTC"]),
        ) {
            let time = Timestamp::from_nanosecond(nanoseconds).unwrap();
            let zoned = time.to_zoned(TimeZone::get(zone).unwrap());
            let rfc = jiff::fmt::rfc2822::to_string(&zoned).unwrap();
            for text in [time.to_string(), zoned.to_string(), format!("{:.9}", zoned)] {
                prop_assert_eq!(read_time(&text, None), Ok(time), "{}", text);
            }
            let whole = Timestamp::from_second(time.as_second()).unwrap();
            prop_assert_eq!(read_time(&rfc, None), Ok(whole), "{}", rfc);
        }

        #[test]
        fn any_text_is_read_or_refused(text: String) {
            _ = read(&text);
        }
    }
}
