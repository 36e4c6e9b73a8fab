//! A course's rules, as data: what points count for, what lateness costs, what students see.
//!
//! Nothing here changes a score: `score.json` says what a submission is worth as if in time, and
//! what counts follows from it and from the policy.

mod late;
mod read;
mod submission_time;
mod visibility;

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::value::Datetime;

pub use late::{CountedPoints, Lateness};
pub use read::PolicyError;
pub use submission_time::{SubmissionTime, SubmissionTimeError};
pub use visibility::Visibility;

/// The documented file that says what holds without a policy.
pub const DEFAULT: &str = include_str!("default.toml");

/// What counts, and who sees what. `default.toml` says what each line means.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Policy {
    /// What points count for.
    pub points: PointsPolicy,
    /// What lateness costs.
    pub late: LatePolicy,
    /// What students see.
    pub visibility: VisibilityPolicy,
}

/// What points count for.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PointsPolicy {
    /// What a perfect submission counts for; without it, as much as the exam has.
    pub out_of: Option<u32>,
    /// What becomes of fractions, at the very end.
    pub rounding: Rounding,
}

/// What becomes of fractions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rounding {
    /// To the whole number below.
    Down,
    /// To the nearest whole number, halves up.
    #[default]
    Nearest,
    /// To the whole number above.
    Up,
}

/// What lateness costs.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct LatePolicy {
    /// The last second in time.
    pub due: Option<Datetime>,
    /// So much later is still in time.
    pub grace_minutes: u32,
    /// So many late days cost nothing.
    pub free_days: u32,
    /// What each further day costs.
    pub percent_per_day: u32,
    /// Of what.
    pub percent_of: PercentBase,
    /// The most that a late submission can count for, in percent of all points.
    pub most_percent: u32,
    /// After so many days, nothing counts.
    pub closed_after_days: Option<u32>,
}

/// What a percentage is of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PercentBase {
    /// Of the submission's own points.
    #[default]
    Earned,
    /// Of all that could be had.
    Possible,
}

/// What students see of an exam's items.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct VisibilityPolicy {
    /// Of the practice exam, which they have.
    pub practice: Visibility,
    /// Of any other.
    #[serde(rename = "final")]
    pub other_exams: Visibility,
    /// Exceptions, by task or item.
    pub items: BTreeMap<String, Visibility>,
}

impl Default for LatePolicy {
    fn default() -> Self {
        LatePolicy {
            due: None,
            grace_minutes: 0,
            free_days: 0,
            percent_per_day: 0,
            percent_of: PercentBase::Earned,
            most_percent: 100,
            closed_after_days: None,
        }
    }
}

impl Default for VisibilityPolicy {
    fn default() -> Self {
        VisibilityPolicy {
            practice: Visibility::All,
            other_exams: Visibility::Feedback,
            items: BTreeMap::new(),
        }
    }
}
