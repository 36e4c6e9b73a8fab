//! Converts points to final points in exact integer arithmetic and rounds once at the end.

use jiff::Timestamp;

use crate::policy::final_points::{Deduction, FinalPoints};
use crate::policy::{Extension, LatePolicy, Lateness, PercentBase, Policy, Rounding, TaskPoints};

impl Policy {
    /// Returns the final points for `points` out of `max_points`. They are scaled, reduced for
    /// lateness, capped and rounded.
    pub fn final_points(&self, points: u32, max_points: u32, lateness: Lateness) -> FinalPoints {
        self.counted_points_with(points, max_points, 0, lateness)
    }

    /// Like [`final_points`](Self::final_points), but first adds the points that staff gave
    /// manually.
    pub fn counted_points_with(
        &self,
        points: u32,
        max_points: u32,
        manual: i32,
        lateness: Lateness,
    ) -> FinalPoints {
        let whole_exam = TaskPoints {
            id: "",
            points: points.min(max_points),
            max_points,
            manual,
            items: Vec::new(),
        };
        self.count(&[whole_exam], lateness)
    }

    /// Returns the final points for these tasks. First, items are removed, the points that staff
    /// gave manually are added, and tasks are reweighted. Then lateness is taken into account.
    pub fn count(&self, tasks: &[TaskPoints], lateness: Lateness) -> FinalPoints {
        let basis = self.points.basis(tasks);
        let out_of = self.points.out_of.unwrap_or(basis.out_of);
        let late_days = self.late.late_days(lateness);
        let (fraction, deduction) = self.late.apply(basis.earned, basis.all, late_days);
        FinalPoints {
            points: fraction.of(out_of, self.points.rounding),
            max_points: out_of,
            earned: tasks.iter().map(|task| task.points).sum(),
            earned_of: tasks.iter().map(|task| task.max_points).sum(),
            manual: tasks.iter().map(|task| task.manual).sum(),
            changes: basis.changes,
            late_days,
            is_assumed: lateness.is_assumed,
            deduction,
        }
    }

    /// Returns the lateness of a submission that was handed in at `submitted`, given these
    /// extensions. Returns `None` if the policy doesn't set a due time.
    pub fn lateness(&self, submitted: Timestamp, extensions: &[Extension]) -> Option<Lateness> {
        let due = self.extended_due(extensions)?;
        Some(Lateness::since(due, submitted, self.late.timezone.as_ref()))
    }

    /// Returns the due time after applying these extensions, or `None` if the policy doesn't set
    /// one.
    pub fn extended_due(&self, extensions: &[Extension]) -> Option<Timestamp> {
        Some(self.late.extended(self.late.due?, extensions))
    }

    /// Returns the extensions for a person or group with these names and identifiers.
    pub fn extensions_of<'a>(
        &self,
        names: impl Iterator<Item = &'a str> + Clone,
    ) -> impl Iterator<Item = Extension> {
        let is_meant = move |key: &str| {
            let key = key.to_lowercase();
            names.clone().any(|name| name.to_lowercase() == key)
        };
        let extensions = self.late.extensions.iter();
        extensions.filter_map(move |(key, extension)| is_meant(key).then_some(*extension))
    }
}

impl LatePolicy {
    /// Returns a due time after applying the latest of these extensions.
    pub(super) fn extended(&self, due: Timestamp, extensions: &[Extension]) -> Timestamp {
        let extensions = extensions.iter();
        let extended = extensions.map(|extension| extension.apply(due, self.timezone.as_ref()));
        extended.max().unwrap_or(due)
    }

    /// Returns the number of days that have started since the due time, or 0 within the grace
    /// period.
    fn late_days(&self, lateness: Lateness) -> u32 {
        if lateness.seconds <= u64::from(self.grace_minutes) * 60 {
            0
        } else {
            lateness.days
        }
    }

    /// Returns the share of the maximum points that is awarded, and the consequence of being late.
    fn apply(&self, points: u128, max_points: u128, late_days: u32) -> (Fraction, Deduction) {
        // Points are in hundredths here so that percentages of them are integers.
        let (points, all) = (points * 100, max_points * 100);
        let share = |numerator| Fraction {
            numerator,
            denominator: all,
        };
        if let Some(after_days) = self.closed_after_days.filter(|days| late_days > *days) {
            return (share(0), Deduction::Closed { after_days });
        }
        let days = late_days.saturating_sub(self.free_days);
        if days == 0 {
            let deduction = match late_days {
                0 => Deduction::None,
                _ => Deduction::FreeDays,
            };
            return (share(points), deduction);
        }
        let percent = days.saturating_mul(self.percent_per_day).min(100);
        let of = match self.percent_of {
            PercentBase::Earned => points,
            PercentBase::Possible => all,
        };
        let part = points.saturating_sub(of / 100 * u128::from(percent));
        let most = all / 100 * u128::from(self.most_percent);
        if part > most {
            return (share(most), Deduction::Limit(self.most_percent));
        }
        let deduction = match percent {
            0 => Deduction::None,
            percent => Deduction::Percent {
                percent,
                of: self.percent_of,
                free_days: self.free_days,
            },
        };
        (share(part), deduction)
    }
}

/// An exact fraction.
#[derive(Clone, Copy, Debug)]
struct Fraction {
    numerator: u128,
    denominator: u128,
}

impl Fraction {
    /// Returns this share of the points, rounded.
    fn of(self, points: u32, rounding: Rounding) -> u32 {
        let (exact, all) = (self.numerator * u128::from(points), self.denominator.max(1));
        let rounded = match rounding {
            Rounding::Down => exact / all,
            Rounding::Nearest => (2 * exact + all) / (2 * all),
            Rounding::Up => exact.div_ceil(all),
        };
        u32::try_from(rounded).unwrap_or(u32::MAX)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn policy(text: &str) -> Policy {
        toml::from_str(text).unwrap()
    }

    fn hours(hours: u64) -> Lateness {
        Lateness::of_seconds(hours * 60 * 60)
    }

    /// Each row is a policy, points out of 100, hours after the due time, and the expected final
    /// points.
    #[test]
    fn points_are_scaled_reduced_for_lateness_and_rounded_once() {
        let out_of = |rounding: &str| format!("[points]\nout_of = 50\nrounding = '{rounding}'");
        let late = |rules: &str| format!("[late]\npercent_per_day = 10\n{rules}");
        let (possible, grace) = (late("percent_of = 'possible'"), late("grace_minutes = 60"));
        let free = late("free_days = 2\nmost_percent = 50");
        for (text, points, hours_late, counted) in [
            (String::new(), 87, 0, 87),
            (String::new(), 87, 1000, 87),
            (out_of("down"), 87, 0, 43),
            (out_of("nearest"), 87, 0, 44),
            (out_of("up"), 87, 0, 44),
            (out_of("up"), 100, 0, 50),
            // 10% of 87 is 8.7, which leaves 78.3. Half of that is 39.15. Nothing is rounded in
            // between.
            (format!("{}\n{}", out_of("down"), late("")), 87, 1, 39),
            (late(""), 80, 25, 64),
            (possible.clone(), 80, 25, 60),
            (possible, 10, 25, 0),
            ("[late]\npercent_per_day = 60".to_owned(), 80, 25, 0),
            (grace.clone(), 100, 1, 100),
            (grace, 100, 2, 90),
            (free.clone(), 100, 48, 100),
            (free, 100, 49, 50),
        ] {
            let found = policy(&text).final_points(points, 100, hours(hours_late));
            assert_eq!(found.points, counted, "{text}");
        }
    }

    #[test]
    fn nothing_counts_after_the_last_day() {
        let policy = policy("[late]\nfree_days = 5\nclosed_after_days = 2");
        let closed = Deduction::Closed { after_days: 2 };
        for (late, expected) in [(48, (70, Deduction::FreeDays, 2)), (49, (0, closed, 3))] {
            let found = policy.final_points(70, 100, hours(late));
            assert_eq!((found.points, found.deduction, found.late_days), expected);
        }
    }

    #[test]
    fn points_given_by_hand_count_up_to_the_maximum() {
        for (points, of, manual, sum) in [
            (90, 100, 7, 97),
            (90, 100, 30, 100),
            (5, 100, -7, 0),
            // An exam without points is worth 0.
            (0, 0, 0, 0),
        ] {
            let counted = Policy::default().counted_points_with(points, of, manual, Lateness::NONE);
            let FinalPoints {
                earned,
                manual: by_hand,
                points: found,
                ..
            } = counted;
            assert_eq!((earned, by_hand, found), (points, manual, sum));
        }
    }

    #[test]
    fn due_times_are_compared_across_time_zones() {
        // `date -d 2026-11-20T23:59:59+01:00 +%s`
        let time = 1_795_215_599;
        let late = |policy: &Policy, after: i64| {
            let submitted = Timestamp::from_second(time + after).unwrap();
            policy.lateness(submitted, &[])
        };
        for same in ["2026-11-20T23:59:59+01:00", "2026-11-20T22:59:59Z"] {
            let due = policy(&format!("[late]\ndue = {same}"));
            assert_eq!(late(&due, 0), Some(Lateness::NONE), "{same}");
            assert_eq!(late(&due, -9), Some(Lateness::NONE), "{same}");
            assert_eq!(late(&due, 9), Some(Lateness::of_seconds(9)), "{same}");
        }
        assert_eq!(late(&Policy::default(), 0), None);
    }

    #[test]
    fn a_limit_is_named_only_if_it_costs_points() {
        let percent = Deduction::Percent {
            percent: 10,
            of: PercentBase::Earned,
            free_days: 0,
        };
        for (text, late, deduction) in [
            ("", 0, Deduction::None),
            ("", 1, Deduction::None),
            ("[late]\nmost_percent = 99", 1, Deduction::Limit(99)),
            (
                "[late]\npercent_per_day = 10\nmost_percent = 90",
                1,
                percent,
            ),
        ] {
            let found = policy(text).final_points(100, 100, hours(late));
            assert_eq!(found.deduction, deduction, "{text}");
        }
    }
}
