//! The points from which final points are computed: the exam's points after the policy has removed
//! items and changed the points for tasks.

use std::collections::BTreeSet;

use crate::machine::printing::counted;
use crate::policy::{PointsPolicy, VoidPoints};

/// The points that a submission earned for a task.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TaskPoints<'a> {
    /// The task's id.
    pub id: &'a str,
    /// The points earned.
    pub points: u32,
    /// The maximum number of points.
    pub max_points: u32,
    /// The points that staff added or deducted manually.
    pub manual: i32,
    /// The items, each listed after the items that it depends on.
    pub items: Vec<ItemPoints<'a>>,
}

/// The points that a submission earned for an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ItemPoints<'a> {
    /// The item's id.
    pub id: &'a str,
    /// The points earned.
    pub points: u32,
    /// The maximum number of points.
    pub max_points: u32,
    /// The id of the item that prevented this one from being graded, if any.
    pub blocked_by: Option<&'a str>,
}

/// The share of the points that a submission earned, before lateness is considered.
pub(super) struct Basis {
    /// The numerator of the share.
    pub earned: u128,
    /// The denominator of the share. It equals the numerator for a perfect submission.
    pub all: u128,
    /// The maximum number of points in the course if the policy doesn't set one.
    pub out_of: u32,
    /// Sentences about the differences from the exam, without full stops.
    pub changes: Vec<String>,
}

/// A task's share of the exam: `points` · `weight` / `of`.
struct Share {
    points: i128,
    weight: i128,
    of: i128,
    /// The maximum of the share.
    max_points: u32,
}

impl PointsPolicy {
    /// Removes items and reweights tasks.
    pub(super) fn basis(&self, tasks: &[TaskPoints]) -> Basis {
        let out = self.items_out(tasks);
        let shares = tasks.iter().filter_map(|task| self.share(task, &out));
        let shares: Vec<Share> = shares.collect();
        let denominator = shares.iter().map(|share| share.of).fold(1, lcm);
        let earned = shares.iter();
        let earned = earned.map(|share| denominator / share.of * share.weight * share.points);
        let max_points = shares.iter().map(|share| u128::from(share.max_points));
        let all = max_points.sum::<u128>() * denominator.unsigned_abs();
        Basis {
            earned: u128::try_from(earned.sum::<i128>()).unwrap_or(0).min(all),
            all,
            out_of: tasks.iter().map(|task| self.course_points(task)).sum(),
            changes: self.changes(tasks, &out),
        }
    }

    /// Returns a task's share without the items in `out`, or `None` if no items are left.
    fn share(&self, task: &TaskPoints, out: &BTreeSet<&str>) -> Option<Share> {
        let items = task.items.iter().filter(|item| out.contains(item.id));
        let sum = |points: fn(&ItemPoints) -> u32| items.clone().map(points).sum::<u32>();
        let (lost, max_lost) = (sum(|item| item.points), sum(|item| item.max_points));
        let rest = task.points.saturating_sub(lost);
        let (points, max_points) = match self.void_points {
            VoidPoints::Give => (rest + max_lost, task.max_points),
            VoidPoints::Shrink | VoidPoints::Scale => {
                (rest, task.max_points.saturating_sub(max_lost))
            }
        };
        // Manual points must not make up for points lost in another task.
        let points = i128::from(points) + i128::from(task.manual);
        let points = points.clamp(0, i128::from(max_points));
        let (weight, of, max_points) = match self.tasks.get(task.id) {
            Some(own) => (i128::from(*own), i128::from(max_points), *own),
            None => (1, 1, max_points),
        };
        (of > 0 && max_points > 0).then_some(Share {
            points,
            weight,
            of,
            max_points,
        })
    }

    /// Returns the ids of the items that are ignored for this submission: the items that the policy
    /// removes, and the items that couldn't be graded because they depend on a removed item.
    fn items_out<'a>(&self, tasks: &[TaskPoints<'a>]) -> BTreeSet<&'a str> {
        let mut out = BTreeSet::new();
        for item in tasks.iter().flat_map(|task| &task.items) {
            if self.is_void(item.id) || item.blocked_by.is_some_and(|by| out.contains(by)) {
                out.insert(item.id);
            }
        }
        out
    }

    /// Returns the ids of the items without an effect on this submission's final points: those that
    /// are removed or couldn't be graded for this reason, and those of tasks that are left out.
    pub fn ignored_items(&self, tasks: &[TaskPoints]) -> BTreeSet<String> {
        let is_left_out = |task: &&TaskPoints| self.tasks.get(task.id) == Some(&0);
        let left_out = tasks.iter().filter(is_left_out);
        let left_out = left_out.flat_map(|task| &task.items).map(|item| item.id);
        let all = self.items_out(tasks).into_iter().chain(left_out);
        all.map(str::to_owned).collect()
    }

    /// Returns the ids of the items that cost this submission final points.
    pub fn failing_items(&self, tasks: &[TaskPoints]) -> BTreeSet<String> {
        let ignored = self.ignored_items(tasks);
        let items = tasks.iter().flat_map(|task| &task.items);
        let failing = items.filter(|item| item.points < item.max_points);
        let failing = failing.map(|item| item.id.to_owned());
        failing.filter(|id| !ignored.contains(id)).collect()
    }

    /// Returns whether the policy removes this item.
    pub fn is_void(&self, item: &str) -> bool {
        self.void.iter().any(|void| void == item)
    }

    /// Returns the maximum number of points for a task in the course, which is the same for
    /// everybody.
    fn course_points(&self, task: &TaskPoints) -> u32 {
        let void = task.items.iter().filter(|item| self.is_void(item.id));
        let void: u32 = void.map(|item| item.max_points).sum();
        let own = self.tasks.get(task.id).copied();
        match self.void_points {
            VoidPoints::Shrink if void > 0 && void >= task.max_points => 0,
            VoidPoints::Shrink => own.unwrap_or(task.max_points.saturating_sub(void)),
            VoidPoints::Scale | VoidPoints::Give => own.unwrap_or(task.max_points),
        }
    }

    /// Returns sentences about the differences from the exam.
    fn changes(&self, tasks: &[TaskPoints], out: &BTreeSet<&str>) -> Vec<String> {
        let mut changes = Vec::new();
        for task in tasks {
            match self.tasks.get(task.id) {
                Some(own) if *own == task.max_points => {}
                Some(0) => changes.push(format!("{} doesn't count", task.id)),
                Some(own) => changes.push(format!(
                    "{} is worth {own} instead of {}",
                    task.id,
                    counted(task.max_points as usize, "point")
                )),
                None => {}
            }
        }
        let (result, blocked_result) = match self.void_points {
            VoidPoints::Shrink => ("", "the other items are worth more instead"),
            VoidPoints::Scale => (
                ", and the other items are worth more instead",
                "the other items are worth more instead",
            ),
            VoidPoints::Give => (
                ", and everyone gets the points for it",
                "its points are awarded",
            ),
        };
        let items = tasks.iter().flat_map(|task| &task.items);
        for item in items.filter(|item| out.contains(item.id)) {
            let who = format!(
                "{} ({})",
                item.id,
                counted(item.max_points as usize, "point")
            );
            changes.push(match item.blocked_by {
                Some(by) if !self.is_void(item.id) => {
                    format!("{who} could not be graded because of {by}, so {blocked_result}")
                }
                Some(_) | None => format!("{who} was removed from the exam{result}"),
            });
        }
        changes
    }
}

/// Returns the least common multiple of two positive numbers.
fn lcm(one: i128, other: i128) -> i128 {
    let (mut a, mut b) = (one, other);
    while b != 0 {
        (a, b) = (b, a % b);
    }
    one / a * other
}

#[cfg(test)]
mod tests {
    use super::{ItemPoints, TaskPoints};
    use crate::policy::{FinalPoints, Lateness, Policy};

    fn item(id: &'static str, points: u32, max_points: u32) -> ItemPoints<'static> {
        ItemPoints {
            id,
            points,
            max_points,
            blocked_by: None,
        }
    }

    /// Returns an exam worth 30 points. The submission earned 7 of 10 points for building and 4 of
    /// 20 for traversal. In the traversal task, an item worth 5 points is blocked by `build.town`
    /// and in turn blocks an item worth 1 point.
    fn tasks() -> [TaskPoints<'static>; 2] {
        let blocked = |id, max_points, by| ItemPoints {
            blocked_by: Some(by),
            ..item(id, 0, max_points)
        };
        let task = |id, manual, items: Vec<ItemPoints<'static>>| TaskPoints {
            id,
            points: items.iter().map(|item| item.points).sum(),
            max_points: items.iter().map(|item| item.max_points).sum(),
            manual,
            items,
        };
        let build = vec![item("build.leaves", 7, 7), item("build.town", 0, 3)];
        let traverse = vec![
            item("traverse.flat", 4, 14),
            blocked("traverse.town", 5, "build.town"),
            blocked("traverse.far", 1, "traverse.town"),
        ];
        [task("build", 0, build), task("traverse", 0, traverse)]
    }

    fn count(policy: &str, tasks: &[TaskPoints]) -> FinalPoints {
        let policy = format!("[points]\n{policy}");
        let policy = Policy::from_text("policy.toml".as_ref(), &policy).unwrap();
        policy.count(tasks, Lateness::NONE)
    }

    #[test]
    fn each_rule_is_explained_with_its_result() {
        let void = |rest: &str| format!("void = ['build.town']\n{rest}");
        let lines = [
            String::new(),
            void(""),
            void("void_points = 'scale'"),
            void("void_points = 'give'"),
            void("out_of = 100"),
            void("tasks = { build = 30 }"),
            void("tasks = { build = 30 }\nvoid_points = 'give'"),
            "tasks = { build = 30, traverse = 0 }".to_owned(),
            "tasks = { build = 1, traverse = 3 }\nout_of = 100".to_owned(),
            "void = ['build.leaves', 'build.town']".to_owned(),
        ];
        let lines = lines.map(|policy| {
            let explanation = count(&policy, &tasks()).explanation();
            format!("{}\n    {explanation}", policy.replace('\n', "; "))
        });
        insta::assert_snapshot!(lines.join("\n"));
    }

    #[test]
    fn a_perfect_submission_gets_the_maximum_and_an_empty_one_nothing() {
        for policy in [
            "void = ['build.town']",
            "void = ['build.town']\nvoid_points = 'scale'",
            "tasks = { build = 7, traverse = 11 }",
            "void = ['traverse.flat', 'build.leaves']\ntasks = { build = 7 }",
        ] {
            let of_all = |share: u32| {
                let mut tasks = tasks();
                for task in &mut tasks {
                    task.points = task.max_points * share;
                    for item in &mut task.items {
                        item.points = item.max_points * share;
                        item.blocked_by = None;
                    }
                }
                count(policy, &tasks)
            };
            let best = of_all(1);
            assert_eq!(best.points, best.max_points, "{policy}");
            assert_eq!(of_all(0).points, 0, "{policy}");
        }
    }

    #[test]
    fn points_by_hand_are_scaled_with_their_task_and_stay_within_the_maximum() {
        let by_hand = |manual: i32| {
            let mut tasks = tasks();
            tasks[0].manual = manual;
            count("tasks = { build = 20, traverse = 0 }", &tasks).points
        };
        assert_eq!([-99, -1, 0, 1, 99].map(by_hand), [0, 12, 14, 16, 20]);
    }
}
