//! The total time that a submission may use, and how it is divided among its items.

use std::time::Duration;

use super::limits::{ItemLimits, TimeUsed};

/// The total time that a submission may wait in all items. It is enough for all of its methods to
/// wait until they are stopped.
const TOTAL_WAITING: Duration = Duration::from_secs(40);

/// The time that a submission may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// The minimum CPU time limit of an item.
    least: Duration,
    /// The maximum CPU time limit of an item.
    most: Duration,
}

impl Default for Budget {
    /// Returns a budget whose limit adapts to the submission's own speed. Correct items take
    /// milliseconds, so an endless loop is usually noticed after two seconds. On a slow machine, or
    /// for slow but correct code, the limit rises to ten.
    fn default() -> Self {
        Budget {
            least: Duration::from_secs(2),
            most: Duration::from_secs(10),
        }
    }
}

impl Budget {
    /// The largest CPU time limit of an item that can be chosen, in seconds.
    pub const MAX_SECONDS: u64 = 600;
    /// An item may take this many times as long as the slowest item that has passed.
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

    /// Returns the limits of an item that is run on its own.
    pub fn single_item(self) -> ItemLimits {
        ItemLimits {
            cpu_if_printing: self.most,
            ..ItemLimits::from_cpu(self.least)
        }
    }
}

/// The remaining budget of a submission while it is graded.
#[derive(Clone, Debug)]
pub struct Allowance {
    budget: Budget,
    used: TimeUsed,
    /// The CPU time of the slowest item that has passed.
    slowest_passed: Duration,
}

impl Allowance {
    /// Returns the whole budget.
    pub fn new(budget: Budget) -> Self {
        Allowance {
            budget,
            used: TimeUsed::default(),
            slowest_passed: Duration::ZERO,
        }
    }

    /// Returns the budget.
    pub fn budget(&self) -> Budget {
        self.budget
    }

    /// Returns the limits of the next item, or `None` if the budget is used up. The last item may
    /// exceed the budget.
    pub fn next_item(&self) -> Option<ItemLimits> {
        let Allowance {
            budget,
            used,
            slowest_passed,
        } = *self;
        if used.cpu >= budget.total_cpu() || used.waiting >= TOTAL_WAITING {
            return None;
        }
        let own_speed = Budget::SLOWER_THAN_PASSED * slowest_passed;
        let cpu = own_speed.clamp(budget.least, budget.most);
        Some(ItemLimits {
            cpu_if_printing: budget.most,
            ..ItemLimits::from_cpu(cpu)
        })
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
        let mut allowance = Allowance::new(Budget::default());
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
        let mut allowance = Allowance::new(Budget::from_seconds(1));
        allowance.passed(Duration::from_millis(900));
        assert_eq!(allowance.next_item().unwrap().cpu.as_secs(), 1);
    }

    #[test]
    fn a_budget_is_used_up_by_slow_items_and_by_waiting_ones() {
        for (item, most) in [(seconds(9, 0), 14), (seconds(0, 2), 20)] {
            let mut allowance = Allowance::new(Budget::default());
            let mut items = 0;
            while allowance.next_item().is_some() {
                allowance.spend(item);
                items += 1;
            }
            assert_eq!(items, most);
        }
    }
}
