//! Reads times in the formats used by learning platforms.

use jiff::civil::{Date, Time};
use jiff::fmt::strtime::BrokenDownTime;
use jiff::tz::{Offset, TimeZone};
use jiff::{SignedDuration, Timestamp};

/// Formats of dates in which the month is a name, as found in RFC 2822, Moodle's worksheets,
/// Canvas's pages and spreadsheets. The year comes last in all of them.
const NAMED_DATES: [&str; 9] = [
    "%A, %d %B %Y",
    "%a, %d %b %Y",
    "%A, %B %d, %Y",
    "%d %B %Y",
    "%d %b %Y",
    "%d-%b-%Y",
    "%d-%B-%Y",
    "%B %d, %Y",
    "%b %d, %Y",
];
const TIMES_OF_DAY: [&str; 4] = ["%H:%M:%S%.f", "%H:%M", "%I:%M:%S %p", "%I:%M %p"];
const OFFSETS: [&str; 2] = ["%z", "%:z"];

/// The reason a string cannot be read as a point in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TimeError {
    /// The text isn't in a known format.
    #[error("it is not a date and time in a recognised format, such as 2026-11-20 23:59:59 +0100")]
    UnknownForm,
    /// The day, the month and the year cannot be distinguished.
    #[error("it is ambiguous: write it as 2026-11-20 23:59:59 +0100")]
    AmbiguousDate,
    /// No course takes place in this year.
    #[error("its year is not between 2000 and 2099: correct it")]
    ImplausibleYear,
    /// The time is so far from the due time that one of the two must be wrong.
    #[error(
        "it is more than half a year from the due time: correct either this time or `due` under \
         [late] in the policy"
    )]
    FarFromDue,
    /// The offset from UTC is missing, and no time zone is known.
    #[error("it has no time zone: set `timezone` under [late] in the policy")]
    NoTimeZone,
}

/// Reads a time in a platform's format. A time without an offset from UTC is a local time in
/// `zone`. If clocks show that time twice because they are set back, the first occurrence is used,
/// which is better for students.
pub fn read_time(text: &str, zone: Option<&TimeZone>) -> Result<Timestamp, TimeError> {
    let text = normalise(text);
    let (date, rest) = named_date(&text).map_or_else(|| numeric_date(&text), Ok)?;
    let (time, offset) = time_and_offset(rest).ok_or(TimeError::UnknownForm)?;
    let local = date.to_datetime(time);
    let instant = match (offset, zone) {
        (Some(offset), _) => offset.to_timestamp(local),
        (None, Some(zone)) => zone.to_ambiguous_timestamp(local).earlier(),
        (None, None) => return Err(TimeError::NoTimeZone),
    };
    let instant = instant.map_err(|_| TimeError::UnknownForm)?;
    if has_plausible_year(instant) {
        Ok(instant)
    } else {
        Err(TimeError::ImplausibleYear)
    }
}

/// Returns whether a course could take place in the year of this time. Years such as 26, 1926 and
/// 3026 are mistakes.
pub(super) fn has_plausible_year(time: Timestamp) -> bool {
    (2000..2100).contains(&Offset::UTC.to_datetime(time).year())
}

/// The greatest plausible distance in days between a time and its due time. A time farther away
/// than this is nearer to the same date in another year, and a wrong year is a frequent mistake.
pub(super) const MOST_DAYS: i64 = 183;

/// Returns whether two times are so far apart that they cannot belong to the same assignment.
pub fn are_far_apart(one: Timestamp, other: Timestamp) -> bool {
    one.duration_since(other).abs() > SignedDuration::from_hours(24 * MOST_DAYS)
}

/// Normalises whitespace and the names of UTC.
fn normalise(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    let text = words.join(" ");
    // The name of a time zone, as in RFC 9557, adds no information to the offset before it.
    let text = match text.split_once('[') {
        Some((before, _)) if text.ends_with(']') => before,
        Some(_) | None => &text,
    };
    let mut names = [" UTC", " GMT", " Z", "Z"].iter();
    let before = names.find_map(|name| text.strip_suffix(name));
    before.map_or_else(|| text.to_owned(), |before| format!("{before} +0000"))
}

/// Reads a date that contains the name of a month. Returns the date and the rest of the text.
fn named_date(text: &str) -> Option<(Date, &str)> {
    NAMED_DATES.iter().find_map(|form| {
        let (mut parsed, end) = BrokenDownTime::parse_prefix(form, text).ok()?;
        let (date, rest) = text.split_at_checked(end)?;
        let year = date.rsplit(|sign: char| !sign.is_ascii_digit()).next()?;
        parsed.set_year(Some(full_year(year)?)).ok()?;
        Some((parsed.to_date().ok()?, rest))
    })
}

/// Parses a year that is written with four digits or, as in spreadsheets, with two digits for a
/// year from 2000 on.
fn full_year(digits: &str) -> Option<i16> {
    let year: i16 = digits.parse().ok()?;
    match digits.len() {
        4 => Some(year),
        2 => Some(2000 + year),
        _ => None,
    }
}

/// Reads a date that consists of three numbers. Returns the date and the rest of the text.
fn numeric_date(text: &str) -> Result<(Date, &str), TimeError> {
    let end = text.find([' ', ',', 'T']).ok_or(TimeError::UnknownForm)?;
    let (date, rest) = text.split_at(end);
    let is_separator = |sign: char| ".-/".contains(sign);
    let separator = date.chars().find(|sign| is_separator(*sign));
    let separator = separator.ok_or(TimeError::UnknownForm)?;
    let numbers: Vec<&str> = date.split(separator).collect();
    let &[first, second, third] = numbers.as_slice() else {
        return Err(TimeError::UnknownForm);
    };
    let [year_last, year_first] = [(third, first), (first, third)].map(|(year, day)| {
        // A number of more than two digits isn't a day.
        let year = full_year(year).filter(|_| day.len() <= 2);
        move |month: &str, day: &str| Date::new(year?, month.parse().ok()?, day.parse().ok()?).ok()
    });
    let day_first = year_last(second, first);
    // With dots, the day is always first.
    let others = match separator {
        '.' if first.len() <= 2 => [None, None],
        _ => [year_last(first, second), year_first(second, third)],
    };
    let mut found = others.into_iter().chain([day_first]).flatten();
    let date = found.next().ok_or(TimeError::UnknownForm)?;
    if found.all(|other| other == date) {
        Ok((date, rest))
    } else {
        Err(TimeError::AmbiguousDate)
    }
}

/// Reads the time of day after a date, and the offset from UTC, if any.
fn time_and_offset(text: &str) -> Option<(Time, Option<Offset>)> {
    let text = text.strip_prefix(['T', ',', ' '])?.trim_start();
    let text = text.strip_prefix("at ").unwrap_or(text);
    TIMES_OF_DAY.iter().find_map(|form| {
        let (parsed, end) = BrokenDownTime::parse_prefix(form, text).ok()?;
        let time = parsed.to_time().ok()?;
        match text.get(end..)?.trim_start() {
            "" => Some((time, None)),
            rest => {
                let parse = |form: &&str| BrokenDownTime::parse(form, rest).ok()?.offset();
                let offset = OFFSETS.iter().find_map(parse)?;
                Some((time, Some(offset)))
            }
        }
    })
}

#[cfg(test)]
mod tests;
