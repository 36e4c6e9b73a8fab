//! A course's policy: how final points are computed, what lateness costs, and what students see.
//!
//! A policy never changes a score. `score.json` contains a submission's points regardless of when
//! it was handed in. The final points are computed from those points.

mod exam_names;
mod exam_points;
mod extension;
mod final_points;
mod late;
mod lateness;
mod read;
mod submission_time;
mod time_parser;
mod visibility;

use std::collections::BTreeMap;

use jiff::Timestamp;
use jiff::tz::TimeZone;
use serde::Deserialize;

pub use exam_points::{ItemPoints, TaskPoints};
pub use extension::Extension;
pub use final_points::{Deduction, FinalPoints};
pub use lateness::Lateness;
pub use submission_time::SubmissionTime;
pub use time_parser::{TimeError, are_far_apart, read_time};
pub use visibility::Visibility;

/// The default policy, as a file with a comment on every key.
pub const DEFAULT: &str = include_str!("default.toml");

/// A course's policy. `default.toml` explains every key.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Policy {
    /// The conversion of points to final points.
    pub points: PointsPolicy,
    /// Deductions for late submissions.
    pub late: LatePolicy,
    /// How to choose among several submissions by the same person.
    pub attempts: AttemptsPolicy,
    /// Visibility of results.
    pub visibility: VisibilityPolicy,
}

/// The conversion of points to final points.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PointsPolicy {
    /// Points for a perfect submission. `None` means the exam's maximum.
    pub out_of: Option<u32>,
    /// Rounding of the final points.
    pub rounding: Rounding,
    /// The ids of items that are removed from the exam after it has been graded.
    pub void: Vec<String>,
    /// How the points for these items are treated.
    pub void_points: VoidPoints,
    /// Points for the tasks that don't keep their points from the exam, keyed by the task's id. A
    /// task with 0 points is left out.
    pub tasks: BTreeMap<String, u32>,
}

/// How the points for removed items are treated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VoidPoints {
    /// The maximum is reduced by the points for these items.
    #[default]
    Shrink,
    /// The maximum stays the same, and the points for the other items are scaled up to make up for
    /// them.
    Scale,
    /// Everybody gets full points for these items.
    Give,
}

/// The rounding of fractions of a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rounding {
    /// Rounding to the integer below.
    Down,
    /// Rounding to the nearest integer. Halves are rounded up.
    #[default]
    Nearest,
    /// Rounding to the integer above.
    Up,
}

/// Deductions for late submissions.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct LatePolicy {
    /// The due time. If it isn't set, the platform's due time is used.
    #[serde(deserialize_with = "read::due_time")]
    pub due: Option<Timestamp>,
    /// The time zone for counting days and for times without an offset from UTC.
    #[serde(deserialize_with = "read::time_zone")]
    pub timezone: Option<TimeZone>,
    /// Grace period after the due time, in minutes.
    pub grace_minutes: u32,
    /// Number of late days that cost nothing.
    pub free_days: u32,
    /// Cost of each further day, in percent.
    pub percent_per_day: u32,
    /// Whether `percent_per_day` is a percentage of the points earned or of the maximum.
    pub percent_of: PercentBase,
    /// Maximum final points for a late submission, as a percentage of all points.
    pub most_percent: u32,
    /// Number of days after which a submission gets no points, or `None` if there is no such limit.
    pub closed_after_days: Option<u32>,
    /// Later due times, keyed by a person's name or identifier, or by a group's name.
    pub extensions: BTreeMap<String, Extension>,
}

/// How to choose among several submissions by the same person.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct AttemptsPolicy {
    /// The rule that decides which submission counts.
    pub counts: AttemptRule,
}

/// The rule for choosing one of several submissions by the same person.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AttemptRule {
    /// No submission, until staff have chosen one.
    #[default]
    Ask,
    /// The submission that was handed in last.
    Latest,
    /// The submission with the most final points.
    Best,
}

/// The points that a percentage refers to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PercentBase {
    /// The points that the submission earned.
    #[default]
    Earned,
    /// The points for a perfect submission.
    Possible,
}

/// The visibility of exam items to students.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct VisibilityPolicy {
    /// Visibility of the practice exam, which is handed out to students.
    pub practice: Visibility,
    /// Visibility of all other exams.
    #[serde(rename = "final")]
    pub other_exams: Visibility,
    /// Exceptions for individual tasks or items, keyed by id.
    pub items: BTreeMap<String, Visibility>,
}

impl Default for LatePolicy {
    fn default() -> Self {
        LatePolicy {
            due: None,
            timezone: None,
            grace_minutes: 0,
            free_days: 0,
            percent_per_day: 0,
            percent_of: PercentBase::Earned,
            most_percent: 100,
            closed_after_days: None,
            extensions: BTreeMap::new(),
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

#[cfg(test)]
mod tests;
