//! Computes the lateness of submissions, according to the platform's information and the policy.

use grader::policy::{CountedPoints, Lateness, Policy, TimeError, read_time};

use crate::entry::EntryInfo;
use crate::outcome::ScoreSummary;

/// A submission time that decides about points, but cannot be read. Nobody's points may depend on a
/// guess, so that the submission has no final points until a person corrects the time.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the submission time {text:?} cannot be used: {why}")]
pub struct UnclearTime {
    /// The time as the platform or roster writes it.
    text: String,
    /// The reason why it cannot be used.
    why: TimeError,
}

/// Returns the final points of a score, after the policy has been applied.
pub fn apply_policy(
    policy: &Policy,
    info: &EntryInfo,
    score: &ScoreSummary,
) -> Result<CountedPoints, UnclearTime> {
    let lateness = lateness(policy, info)?;
    Ok(policy.counted_points(score.points, score.max_points, lateness))
}

/// Returns how late a submission is. If its submission time is known and the policy has a due time,
/// these two decide; otherwise, the platform's late flag does.
fn lateness(policy: &Policy, info: &EntryInfo) -> Result<Lateness, UnclearTime> {
    let exact = match (&info.submitted, policy.late.due) {
        (Some(text), Some(_)) => {
            let time = read_time(text, policy.late.timezone.as_ref());
            let time = time.map_err(|why| UnclearTime {
                text: text.clone(),
                why,
            })?;
            policy.lateness(time)
        }
        (_, None) | (None, _) => None,
    };
    Ok(exact.unwrap_or(if info.late {
        // Without both times, a submission with a late flag counts as one second past the grace
        // period.
        Lateness {
            seconds: u64::from(policy.late.grace_minutes) * 60 + 1,
        }
    } else {
        Lateness::NONE
    }))
}

/// Returns whether the policy has a due time, but the submission has neither a time nor a late
/// flag. Such a submission counts as on time.
pub fn is_undated(policy: &Policy, info: &EntryInfo) -> bool {
    policy.late.due.is_some() && !info.late && info.submitted.is_none()
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert_eq!(apply_policy(&policy, &late, &score).unwrap().points, 72);
        assert_eq!(
            apply_policy(&policy, &EntryInfo::default(), &score)
                .unwrap()
                .points,
            80
        );
        assert!(!is_undated(&policy, &EntryInfo::default()));
        policy.late.due = "2026-11-20T23:59:59Z".parse().ok();
        assert!(is_undated(&policy, &EntryInfo::default()) && !is_undated(&policy, &late));
    }
}
