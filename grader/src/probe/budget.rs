//! Time budgets of items.

use std::time::{Duration, Instant};

use super::fault::TimeLimit;

/// The time budget of an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// The CPU time limit. This is the limit that endless loops exceed.
    pub cpu: Duration,
}

impl Default for Budget {
    fn default() -> Self {
        Budget::from_seconds(Budget::DEFAULT_SECONDS)
    }
}

impl Budget {
    /// The default limit of CPU time, in seconds.
    pub const DEFAULT_SECONDS: u64 = 10;
    /// The largest limit of CPU time that can be chosen, in seconds.
    pub const MAX_SECONDS: u64 = 600;

    /// Returns a budget with this limit of CPU time, in seconds.
    pub fn from_seconds(seconds: u64) -> Self {
        Budget {
            cpu: Duration::from_secs(seconds),
        }
    }

    /// Returns the wall time limit. It is generous, because on a busy machine wall time says
    /// nothing about the code.
    pub fn wall(self) -> Duration {
        4 * self.cpu + Duration::from_secs(5)
    }
}

/// Tracks how much of its budget an item has used.
pub(super) struct BudgetTracker {
    started: Instant,
    /// CPU time of the process at the first check.
    cpu_at_first_check: Option<Duration>,
    budget: Budget,
}

impl BudgetTracker {
    /// Starts tracking the time of an item.
    pub(super) fn start(budget: Budget) -> Self {
        BudgetTracker {
            started: Instant::now(),
            cpu_at_first_check: None,
            budget,
        }
    }

    /// Returns the exceeded limit, if there is one. CPU time before the first check does not count:
    /// most items are answered before that, and reading the CPU time at the start of an item would
    /// take longer than answering it.
    pub(super) fn exceeded(&mut self, cpu_now: Option<Duration>) -> Option<TimeLimit> {
        self.cpu_at_first_check = self.cpu_at_first_check.or(cpu_now);
        let cpu = cpu_now.zip(self.cpu_at_first_check);
        let cpu = cpu.map(|(now, then)| now.saturating_sub(then));
        if cpu.is_some_and(|used| used >= self.budget.cpu) {
            return Some(TimeLimit::Cpu(self.budget.cpu));
        }
        let wall = self.budget.wall();
        (self.started.elapsed() >= wall).then_some(TimeLimit::Wall(wall))
    }
}
