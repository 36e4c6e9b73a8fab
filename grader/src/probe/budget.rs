//! The total time that a submission may use, and how it is divided among its items.

use std::time::Duration;

use super::limits::{ItemLimits, TimeUsed};

/// The total time that a submission may spend waiting, across all items. This is enough even if
/// each of the submission's methods waits until it is stopped.
const TOTAL_WAITING: Duration = Duration::from_secs(40);

/// The time that a submission may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// The minimum CPU time limit for an item.
    least: Duration,
    /// The maximum CPU time limit for an item.
    most: Duration,
}

impl Default for Budget {
    /// Returns a budget in which the time limit adapts to the submission's own speed. Correct items
    /// take milliseconds, so an infinite loop is usually noticed after two seconds. On a slow
    /// machine, or for slow but correct code, the limit rises to ten seconds.
    fn default() -> Self {
        Budget {
            least: Duration::from_secs(2),
            most: Duration::from_secs(10),
        }
    }
}

impl Budget {
    /// The largest CPU time limit that can be chosen for an item, in seconds.
    pub const MAX_SECONDS: u64 = 600;
    /// An item may take this many times as long as the slowest item of its task that has passed.
    pub const SLOWER_THAN_PASSED: u32 = 50;

    /// Returns a budget with a fixed CPU time limit for each item, in seconds.
    pub fn from_seconds(seconds: u64) -> Self {
        let limit = Duration::from_secs(seconds);
        Budget {
            least: limit,
            most: limit,
        }
    }

    /// Returns the CPU time for all items together. By default, this is two minutes.
    pub fn total_cpu(self) -> Duration {
        12 * self.most
    }

    /// Returns whether a submission that has used this much time has used up its budget.
    fn is_used_up(self, used: TimeUsed) -> bool {
        used.cpu >= self.total_cpu() || used.waiting >= TOTAL_WAITING
    }

    /// Returns the limits for an item that is run on its own.
    pub fn single_item(self) -> ItemLimits {
        ItemLimits {
            cpu_if_printing: self.most,
            ..ItemLimits::from_cpu(self.least)
        }
    }
}

/// The remaining budget of a submission while one of its tasks is graded.
#[derive(Clone, Debug)]
pub struct Allowance {
    budget: Budget,
    /// The time that the tasks before this one have used, as far as is known.
    before: TimeUsed,
    /// The time that this task has used.
    used: TimeUsed,
    /// The CPU time of the slowest of the task's items that have passed. Items of other tasks don't
    /// affect this task's limits, because they may be running at the same time.
    slowest_passed: Duration,
}

impl Allowance {
    /// Returns the allowance for a task. `before` is the time that the tasks before it have used.
    pub fn new(budget: Budget, before: TimeUsed) -> Self {
        Allowance {
            budget,
            before,
            used: TimeUsed::default(),
            slowest_passed: Duration::ZERO,
        }
    }

    /// Returns the budget.
    pub fn budget(&self) -> Budget {
        self.budget
    }

    /// Returns the time that the task has used.
    pub fn used(&self) -> TimeUsed {
        self.used
    }

    /// Returns the limits for the next item, or `None` if the budget is used up. The last item may
    /// exceed the budget.
    pub fn next_item(&self) -> Option<ItemLimits> {
        if self.budget.is_used_up(self.before + self.used) {
            return None;
        }
        let Budget { least, most } = self.budget;
        let own_speed = Budget::SLOWER_THAN_PASSED * self.slowest_passed;
        Some(ItemLimits {
            cpu_if_printing: most,
            ..ItemLimits::from_cpu(own_speed.clamp(least, most))
        })
    }

    /// Returns whether this task would have run the same items so far if it had been known from the
    /// start that the tasks before it would use `before`.
    pub fn holds_after(&self, before: TimeUsed) -> bool {
        before == self.before || !self.budget.is_used_up(before + self.used)
    }

    /// Records the time used.
    pub fn spend(&mut self, used: TimeUsed) {
        self.used += used;
    }

    /// Records the CPU time of an item that has passed.
    pub fn passed(&mut self, cpu: Duration) {
        self.slowest_passed = self.slowest_passed.max(cpu);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seconds(cpu: u64, waiting: u64) -> TimeUsed {
        TimeUsed {
            cpu: Duration::from_secs(cpu),
            waiting: Duration::from_secs(waiting),
        }
    }

    #[test]
    fn the_limit_follows_the_slowest_passed_item() {
        let mut allowance = Allowance::new(Budget::default(), TimeUsed::default());
        let cpu = |allowance: &Allowance| allowance.next_item().unwrap().cpu.as_millis();
        assert_eq!(cpu(&allowance), 2_000);
        allowance.passed(Duration::from_millis(10));
        assert_eq!(cpu(&allowance), 2_000);
        allowance.passed(Duration::from_millis(100));
        allowance.passed(Duration::from_millis(60));
        assert_eq!(cpu(&allowance), 5_000);
        allowance.passed(Duration::from_secs(1));
        assert_eq!(cpu(&allowance), 10_000);
    }

    #[test]
    fn a_chosen_limit_does_not_change() {
        let mut allowance = Allowance::new(Budget::from_seconds(1), TimeUsed::default());
        allowance.passed(Duration::from_millis(900));
        assert_eq!(allowance.next_item().unwrap().cpu.as_secs(), 1);
    }

    #[test]
    fn a_budget_is_used_up_by_slow_items_and_by_waiting_ones() {
        for (item, most) in [(seconds(9, 0), 14), (seconds(0, 2), 20)] {
            let mut allowance = Allowance::new(Budget::default(), TimeUsed::default());
            let mut items = 0;
            while allowance.next_item().is_some() {
                allowance.spend(item);
                items += 1;
            }
            assert_eq!(items, most);
        }
    }

    #[test]
    fn a_task_holds_unless_the_tasks_before_it_leave_too_little() {
        let mut allowance = Allowance::new(Budget::default(), seconds(50, 0));
        allowance.spend(seconds(20, 5));
        assert!(allowance.holds_after(seconds(99, 34)));
        assert!(!allowance.holds_after(seconds(100, 34)));
        assert!(!allowance.holds_after(seconds(99, 35)));
        // If the time used by the earlier tasks was known from the start, the task has already kept
        // to the budget.
        allowance.spend(seconds(90, 0));
        assert!(allowance.holds_after(seconds(50, 0)));
        assert!(allowance.next_item().is_none());
    }
}
