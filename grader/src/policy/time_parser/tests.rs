//! Tests for reading times.

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
        // Gradescope's metadata and CSV files.
        ("2026-11-20 22:01:05.000000000 Z", "2026-11-20T22:01:05Z"),
        ("2026-11-25 10:00:00 -0800", "2026-11-25T18:00:00Z"),
        ("2026-11-25 10:00:00 +0100", "2026-11-25T09:00:00Z"),
        ("2026-11-20 22:01:05 UTC", "2026-11-20T22:01:05Z"),
        ("\t2026-11-20\u{a0} 22:01:05\tUTC\n", "2026-11-20T22:01:05Z"),
        // classroom50 and Canvas's API.
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
        ("25.11.2026 11:00 pm", "2026-11-25T22:00:00Z"),
        ("25-Nov-2026 11:00PM", "2026-11-25T22:00:00Z"),
        ("25-11-2026 10:00", "2026-11-25T09:00:00Z"),
        ("2026/11/25 10:00", "2026-11-25T09:00:00Z"),
        // The first and last plausible years.
        ("1.1.2000 1:00", "2000-01-01T00:00:00Z"),
        ("31.12.2099 1:00", "2099-12-31T00:00:00Z"),
    ] {
        assert_eq!(read(text).as_deref(), Ok(expected), "{text}");
    }
}

#[test]
fn a_year_of_two_digits_is_one_from_2000() {
    for text in [
        "25.11.26 10:00",
        "25.11.26, 10:00:00",
        "11/25/26 10:00 AM",
        "25-Nov-26 10:00",
        "25 November 26, 10:00",
        "Wed, 25 Nov 26 10:00:00 +0100",
    ] {
        assert_eq!(read(text).as_deref(), Ok("2026-11-25T09:00:00Z"), "{text}");
    }
    // The first number could also be the year.
    for text in ["25/10/26 10:00", "26-10-25 10:00", "26-10-25T10:00:00Z"] {
        assert_eq!(read(text), Err(TimeError::AmbiguousDate), "{text}");
    }
}

#[test]
fn a_year_in_which_no_course_takes_place_is_a_mistake() {
    let texts = "25.10.0026 23:30|0026-10-25 23:30|0026-10-25T23:30:00Z|25.10.1926 23:30|\
                 25 October 3026, 11:30 PM|10/25/1999 11:30 PM|2100-01-01 01:00";
    for text in texts.split('|') {
        assert_eq!(read(text), Err(TimeError::ImplausibleYear), "{text}");
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
        "25/11/999 10:00",
        "25.11.026 10:00",
        "25.11/2026 10:00",
        "2026-11-25 24:00",
        "2026-11-25 13:00 PM",
        "2026-11-25 0:30 AM",
        // This date is a Wednesday.
        "Friday, 25 November 2026, 10:00 AM",
        // The bracket after the time zone's name isn't closed.
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
    fn every_form_is_read_back(seconds in 946_771_200i64..4_000_000_000) {
        let zone = berlin();
        let time = Timestamp::from_second(seconds / 60 * 60).unwrap();
        let zoned = time.to_zoned(zone.clone());
        // In a repeated hour, the first occurrence is used.
        let earlier = zone.to_ambiguous_timestamp(zoned.datetime()).earlier().unwrap();
        let dates = NAMED_DATES.iter().chain(&["%Y-%m-%d", "%Y/%m/%d", "%d.%m.%Y", "%d.%m.%y"]);
        for (date, hour) in dates.flat_map(|date| TIMES_OF_DAY.map(|hour| (date, hour))) {
            for between in [" ", ", ", " at "] {
                let local = zoned.strftime(&format!("{date}{between}{hour}")).to_string();
                prop_assert_eq!(read_time(&local, Some(&zone)), Ok(earlier), "{}", local);
                for offset in OFFSETS {
                    let text = format!("{local} {}", zoned.strftime(offset));
                    prop_assert_eq!(read_time(&text, None), Ok(time), "{}", text);
                }
                let utc = time.to_zoned(TimeZone::UTC);
                let utc = utc.strftime(&format!("{date}{between}{hour}")).to_string();
                for name in ["Z", " Z", " UTC", " GMT"] {
                    let text = format!("{utc}{name}");
                    prop_assert_eq!(read_time(&text, None), Ok(time), "{}", text);
                }
            }
        }
    }

    #[test]
    fn the_forms_of_jiff_are_read_back(
        nanoseconds in 946_771_200_000_000_000i128..4_000_000_000_000_000_000,
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
