//! How late something came, from what the platform says and the policy.

use grader::policy::{Counted, Lateness, Policy};
use jiff::Timestamp;

use crate::entry::About;
use crate::outcome::Told;

/// What a score counts for.
pub fn counted(policy: &Policy, about: &About, score: &Told) -> Counted {
    policy.counted(score.points, score.max_points, lateness(policy, about))
}

/// By the moment, where it is known and there is a due time; else by what the platform calls late.
fn lateness(policy: &Policy, about: &About) -> Lateness {
    let moment = about.submitted.as_deref().and_then(moment);
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
pub fn is_undated(policy: &Policy, about: &About) -> bool {
    let is_dated = about.submitted.as_deref().and_then(moment).is_some();
    policy.late.due.is_some() && !about.late && !is_dated
}

/// Seconds since 1970, of `2026-11-20 22:01:05.000000000 Z` and its likes.
fn moment(text: &str) -> Option<i64> {
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
    fn gradescopes_moments_are_read() {
        let seconds = Some(1_795_212_065);
        assert_eq!(moment("2026-11-20 22:01:05.000000000 Z"), seconds);
        assert_eq!(moment("2026-11-20 22:01:05 UTC"), seconds);
        assert_eq!(moment("2026-11-20T23:01:05+01:00"), seconds);
        assert_eq!(moment("Friday, 20 November"), None);
    }

    #[test]
    fn what_a_platform_calls_late_is_late_by_a_day() {
        let mut policy = Policy::default();
        policy.late.percent_per_day = 10;
        policy.late.grace_minutes = 5;
        let score = Told {
            points: 80,
            max_points: 100,
            tasks: Vec::new(),
        };
        let late = About {
            late: true,
            ..About::default()
        };
        assert_eq!(counted(&policy, &late, &score).points, 72);
        assert_eq!(counted(&policy, &About::default(), &score).points, 80);
        assert!(!is_undated(&policy, &About::default()));
        policy.late.due = "2026-11-20T23:59:59Z".parse().ok();
        assert!(is_undated(&policy, &About::default()) && !is_undated(&policy, &late));
    }
}
