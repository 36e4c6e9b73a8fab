//! Converts the times in an export's file names and files to formats that policies can read.

use crate::names::is_number;

/// Returns a platform's time with the usual punctuation, or `None` for any other text. Times
/// without a zone are local times.
pub fn normalize_time(text: &str) -> Option<String> {
    // The first form is a local time from Blackboard. The second is from older versions of Sakai,
    // and ends in milliseconds.
    with_signs(text, "0000-00-00-00-00-00", "0000-00-00 00:00:00")
        .or_else(|| with_signs(text, "00000000000000000", "0000-00-00 00:00:00 UTC"))
        .or_else(|| with_month(text))
}

/// Returns the digits of a time with the punctuation of `written`, if the time matches `form`. In
/// `form`, `0` stands for a digit.
fn with_signs(text: &str, form: &str, written: &str) -> Option<String> {
    let as_form = |sign: char| if sign.is_ascii_digit() { '0' } else { sign };
    let mut digits = text.chars().filter(char::is_ascii_digit);
    let is_of_form = text.chars().map(as_form).eq(form.chars());
    let signs = written.chars().map(|sign| {
        if sign == '0' {
            digits.next()
        } else {
            Some(sign)
        }
    });
    signs.collect::<Option<String>>().filter(|_| is_of_form)
}

/// Converts a time from Brightspace, such as `Nov 20, 2026 1134 PM`. The colon is omitted in file
/// names.
fn with_month(text: &str) -> Option<String> {
    let (time, half) = match text.rsplit_once(' ')? {
        (time, half @ ("AM" | "PM")) => (time, format!(" {half}")),
        _ => (text, String::new()),
    };
    let (date, clock) = time.rsplit_once(' ')?;
    let digits = clock.replacen(':', "", 1);
    let is_clock = is_number(&digits) && (3..=4).contains(&digits.len());
    let is_year = |word: &str| word.len() == 4 && is_number(word);
    let has_year = || date.split(' ').any(is_year);
    let has_month = || date.chars().any(char::is_alphabetic) && !date.contains(" - ");
    let (hour, minute) = digits.split_at_checked(digits.len().checked_sub(2)?)?;
    (is_clock && has_year() && has_month()).then(|| format!("{date} {hour}:{minute}{half}"))
}

#[cfg(test)]
mod tests {
    use grader::policy::read_time;
    use jiff::tz::TimeZone;

    use super::*;

    #[test]
    fn times_of_platforms_can_be_read_by_policies() {
        let zone = TimeZone::get("America/New_York").unwrap();
        for (text, expected) in [
            ("2026-11-20-23-34-05", "2026-11-21T04:34:05Z"),
            ("20261120233405123", "2026-11-20T23:34:05Z"),
            ("Nov 20, 2026 1134 PM", "2026-11-21T04:34:00Z"),
            ("Nov 20, 2026 9:04 AM", "2026-11-20T14:04:00Z"),
            ("20 November 2026 2334", "2026-11-21T04:34:00Z"),
        ] {
            let written = normalize_time(text).unwrap();
            let time = read_time(&written, Some(&zone)).unwrap();
            assert_eq!(time.to_string(), expected, "{text}");
        }
        for other in [
            "",
            "hw 2",
            "2026-11-20",
            "Nov 20, 2026",
            "12026-11-20-23-34-05",
            "é 2026 93 PM",
        ] {
            assert_eq!(normalize_time(other), None, "{other}");
        }
    }
}
