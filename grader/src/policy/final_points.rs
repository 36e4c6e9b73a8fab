//! The final points for a submission, and the sentence that explains them.

use std::fmt;

use crate::machine::printing::counted;
use crate::policy::PercentBase;

/// The final points for a submission, and the facts that explain them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FinalPoints {
    /// The submission's final points.
    pub points: u32,
    /// The final points for a perfect submission that is handed in on time.
    pub max_points: u32,
    /// The points that the submission earned in the exam.
    pub earned: u32,
    /// The maximum number of points in the exam.
    pub earned_of: u32,
    /// The points that staff added or deducted manually.
    pub manual: i32,
    /// Sentences, without full stops, about items and tasks whose points differ from those in the
    /// exam.
    pub changes: Vec<String>,
    /// The number of days that have started since the due time, including free days.
    pub late_days: u32,
    /// Whether the submission time isn't known, so that `late_days` is assumed.
    pub is_assumed: bool,
    /// The consequence of being late.
    pub deduction: Deduction,
}

/// The consequence of being late.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deduction {
    /// No deduction: the submission is on time, or the policy has no rule for late submissions.
    None,
    /// All late days are free.
    FreeDays,
    /// A percentage is deducted.
    Percent {
        /// The total percentage deducted for all late days that aren't free.
        percent: u32,
        /// The points that the percentage refers to.
        of: PercentBase,
        /// The number of late days that are free.
        free_days: u32,
    },
    /// The points are limited to this percentage of the maximum.
    Limit(u32),
    /// The submission is too late: after this many days, no points are given.
    Closed {
        /// The number of days.
        after_days: u32,
    },
}

impl fmt::Display for FinalPoints {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} of {} points", self.points, self.max_points)
    }
}

impl FinalPoints {
    /// Returns a sentence that states the final points and explains them.
    pub fn explanation(&self) -> String {
        let Self {
            earned, earned_of, ..
        } = self;
        let manual_points = counted(self.manual.unsigned_abs() as usize, "point");
        let manual = match self.manual {
            0 => String::new(),
            1.. => format!(", {manual_points} added by hand"),
            _ => format!(", {manual_points} deducted by hand"),
        };
        let lateness = self.lateness().map(|text| format!(", {text}"));
        let lateness = lateness.unwrap_or_default();
        let earned = format!("{earned} of {earned_of} points earned{manual}{lateness}");
        let changes = self.changes.iter().map(|change| format!("; {change}"));
        let changes: String = changes.collect();
        format!("{self} count towards the grade: {earned}{changes}.")
    }

    /// Returns [`explanation`](Self::explanation), or `None` if the final points are the same as
    /// the points earned and the submission is on time.
    pub fn explanation_if_changed(&self) -> Option<String> {
        self.is_changed().then(|| self.explanation())
    }

    /// Returns the rules that apply to this submission. The submission's points are left out, since
    /// they would reveal the points for hidden items. Returns `None` if no rule applies.
    pub fn rules(&self) -> Option<String> {
        let mut rules = Vec::new();
        if self.max_points != self.earned_of {
            let Self {
                max_points,
                earned_of,
                ..
            } = self;
            rules.push(format!("{earned_of} points are scaled to {max_points}"));
        }
        rules.extend_from_slice(&self.changes);
        rules.extend(self.lateness());
        let is_changed = !rules.is_empty();
        is_changed.then(|| format!("These rules apply to the grade: {}.", rules.join("; ")))
    }

    fn is_changed(&self) -> bool {
        (self.points, self.max_points) != (self.earned, self.earned_of)
            || self.late_days > 0
            || self.manual != 0
            || !self.changes.is_empty()
    }

    /// Returns the number of late days and their consequence, or `None` if the submission is on
    /// time.
    fn lateness(&self) -> Option<String> {
        if self.late_days == 0 {
            return None;
        }
        let days = |days: u32| counted(days as usize, "day");
        let late = match days(self.late_days) {
            days if self.is_assumed => {
                format!(
                    "handed in late (counted as {days}, because the submission time is unknown)"
                )
            }
            days => format!("handed in {days} late"),
        };
        Some(match self.deduction {
            Deduction::None => format!("{late}, with no deduction"),
            Deduction::FreeDays => format!("{late}, which is within the free days"),
            Deduction::Percent {
                percent,
                of,
                free_days,
            } => {
                let base = match of {
                    PercentBase::Earned => "the points earned",
                    PercentBase::Possible => "all points",
                };
                let after = match free_days {
                    0 => ", so".to_owned(),
                    days => format!("; after {},", counted(days as usize, "free day")),
                };
                format!("{late}{after} {percent}% of {base} are deducted")
            }
            Deduction::Limit(percent) => {
                format!("{late}, and late work can earn at most {percent}% of the points")
            }
            Deduction::Closed { after_days: 0 } => {
                format!("{late}, and late work earns no points")
            }
            Deduction::Closed { after_days } => {
                format!(
                    "{late}, and work that is more than {} late earns no points",
                    days(after_days)
                )
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::FinalPoints;
    use crate::policy::{Lateness, Policy};

    /// Returns the final points for a submission that earned `earned` of 100 points and was handed
    /// in `hours` hours late. Staff added `manual` points, which may be negative.
    fn counted(policy: &str, earned: u32, manual: i32, hours: u64) -> FinalPoints {
        let policy: Policy = toml::from_str(policy).unwrap();
        let late = Lateness::of_seconds(hours * 60 * 60);
        policy.counted_points_with(earned, 100, manual, late)
    }

    #[test]
    fn explains_what_staff_changed_and_each_consequence_of_being_late() {
        let out_of_50 = counted("[points]\nout_of = 50", 90, 0, 0);
        let by_hand = [1, 2, -1, -2].map(|manual| counted("", 90, manual, 0));
        let late = [
            ("", 47),
            ("free_days = 2\npercent_per_day = 10", 47),
            ("free_days = 1\npercent_per_day = 10", 47),
            ("percent_per_day = 10\npercent_of = 'possible'", 47),
            ("percent_per_day = 10\nmost_percent = 50", 47),
            ("closed_after_days = 1", 47),
            ("closed_after_days = 0", 47),
            ("percent_per_day = 10", 1),
            ("percent_per_day = 10\nfree_days = 2", 49),
            ("closed_after_days = 2", 49),
        ];
        let late = late.map(|(rules, hours)| counted(&format!("[late]\n{rules}"), 90, 0, hours));
        let all = [out_of_50].into_iter().chain(late).chain(by_hand);
        let lines: Vec<String> = all.map(|points| points.explanation()).collect();
        insta::assert_snapshot!("explanations", lines.join("\n"));
    }

    #[test]
    fn points_that_count_as_earned_need_no_explanation() {
        assert_eq!(counted("", 90, 0, 0).explanation_if_changed(), None);
        for changed in [
            counted("[points]\nout_of = 50", 90, 0, 0),
            // Half of 0 points is still 0, but the maximum differs.
            counted("[points]\nout_of = 50", 0, 0, 0),
            counted("", 90, 1, 0),
            // Staff tried to give more points than the maximum, but the points cannot exceed it.
            counted("", 100, 1, 0),
            counted("", 90, 0, 1),
            counted("[late]\npercent_per_day = 10", 90, 0, 1),
        ] {
            let explanation = changed.explanation();
            assert_eq!(changed.explanation_if_changed(), Some(explanation));
        }
    }

    #[test]
    fn rules_do_not_tell_the_points_of_a_submission() {
        assert_eq!(counted("", 90, 5, 0).rules(), None);
        for (policy, hours, rules) in [
            ("[points]\nout_of = 50", 0, "100 points are scaled to 50."),
            ("", 25, "handed in 2 days late, with no deduction."),
            (
                "[points]\nout_of = 50\n[late]\npercent_per_day = 10",
                1,
                "100 points are scaled to 50; handed in 1 day late, so 10% of the points earned are \
                 deducted.",
            ),
        ] {
            let expected = format!("These rules apply to the grade: {rules}");
            assert_eq!(counted(policy, 90, 5, hours).rules(), Some(expected));
        }
    }
}
