//! How late something came, from what the platform says and the policy.

use grader::policy::{CountedPoints, Lateness, Policy};
use jiff::Timestamp;

use crate::entry::EntryInfo;
use crate::outcome::ScoreSummary;

/// What a score counts for.
pub fn apply_policy(policy: &Policy, about: &EntryInfo, score: &ScoreSummary) -> CountedPoints {
    policy.counted_points(score.points, score.max_points, lateness(policy, about))
}

/// By the moment, where it is known and there is a due time; else by what the platform calls late.
fn lateness(policy: &Policy, about: &EntryInfo) -> Lateness {
    let moment = about.submitted.as_deref().and_then(parse_timestamp);
    let exact = moment.and_then(|moment| policy.lateness(moment));
    exact.unwrap_or(match about.late {
        // Nobody knows by how much: by the least that there is.
        true => Lateness {
            seconds: u64::from(policy.late.grace_minutes) * 60 + 1,
        },
        false => Lateness::NONE,
    })
}

/// Whether nobody knows if it was late, though that would cost something: it counts as in time.
pub fn is_undated(policy: &Policy, about: &EntryInfo) -> bool {
    let is_dated = about
        .submitted
        .as_deref()
        .and_then(parse_timestamp)
        .is_some();
    policy.late.due.is_some() && !about.late && !is_dated
}

/// Seconds since 1970, of `2026-11-20 22:01:05.000000000 Z` and its likes.
fn parse_timestamp(text: &str) -> Option<i64> {
    // Gradescope's file has a space before the zone.
    let text = text.trim().replacen(" Z", "Z", 1).replacen(" +", "+", 1);
    let text = text.replacen(" UTC", "Z", 1);
    let moment: Timestamp = text.parse().ok()?;
    Some(moment.as_second())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_gradescope_timestamps() {
        let seconds = Some(1_795_212_065);
        assert_eq!(parse_timestamp("2026-11-20 22:01:05.000000000 Z"), seconds);
        assert_eq!(parse_timestamp("2026-11-20 22:01:05 UTC"), seconds);
        assert_eq!(parse_timestamp("2026-11-20T23:01:05+01:00"), seconds);
        assert_eq!(parse_timestamp("Friday, 20 November"), None);
    }

    #[test]
    fn a_late_flag_without_a_time_counts_as_one_day() {
        let mut policy = Policy::default();
        policy.late.percent_per_day = 10;
        policy.late.grace_minutes = 5;
        let score = ScoreSummary {
            points: 80,
            max_points: 100,
            tasks: Vec::new(),
        };
        let late = EntryInfo {
            late: true,
            ..EntryInfo::default()
        };
        assert_eq!(apply_policy(&policy, &late, &score).points, 72);
        assert_eq!(
            apply_policy(&policy, &EntryInfo::default(), &score).points,
            80
        );
        assert!(!is_undated(&policy, &EntryInfo::default()));
        policy.late.due = "2026-11-20T23:59:59Z".parse().ok();
        assert!(is_undated(&policy, &EntryInfo::default()) && !is_undated(&policy, &late));
    }
}
