//! Computes the lateness of submissions, according to the platform's information and the policy.

use grader::policy::{CountedPoints, Lateness, Policy};
use jiff::Timestamp;

use crate::entry::EntryInfo;
use crate::outcome::ScoreSummary;

/// Returns the final points of a score, after the policy has been applied.
pub fn apply_policy(policy: &Policy, info: &EntryInfo, score: &ScoreSummary) -> CountedPoints {
    policy.counted_points(score.points, score.max_points, lateness(policy, info))
}

/// Returns how late a submission is. If its submission time is known and the policy has a due time,
/// these two decide; otherwise, the platform's late flag does.
fn lateness(policy: &Policy, info: &EntryInfo) -> Lateness {
    let time = info.submitted.as_deref().and_then(parse_timestamp);
    let exact = time.and_then(|time| policy.lateness(time));
    exact.unwrap_or(if info.late {
        // Without both times, a submission with a late flag counts as one second past the grace
        // period.
        Lateness {
            seconds: u64::from(policy.late.grace_minutes) * 60 + 1,
        }
    } else {
        Lateness::NONE
    })
}

/// Returns whether the policy has a due time, but the submission has neither a time nor a late
/// flag. Such a submission counts as on time.
pub fn is_undated(policy: &Policy, info: &EntryInfo) -> bool {
    let is_dated = info
        .submitted
        .as_deref()
        .and_then(parse_timestamp)
        .is_some();
    policy.late.due.is_some() && !info.late && !is_dated
}

/// Parses a time such as `2026-11-20 22:01:05.000000000 Z`.
fn parse_timestamp(text: &str) -> Option<Timestamp> {
    // Gradescope's file has a space before the time zone.
    let text = text.trim().replacen(" Z", "Z", 1).replacen(" +", "+", 1);
    let text = text.replacen(" UTC", "Z", 1);
    text.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_gradescope_timestamps() {
        let seconds = Timestamp::from_second(1_795_212_065).ok();
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
