//! How long an item may take.

use std::time::{Duration, Instant};

use super::fault::TimeLimit;

/// What one item may use.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    /// CPU time, which is what counts.
    pub cpu: Duration,
}

impl Budget {
    /// Wall time is only a back-stop: on a machine under load it says nothing of the code.
    pub fn wall(self) -> Duration {
        4 * self.cpu + Duration::from_secs(5)
    }
}

/// When the item was asked, and what it may use.
pub(super) struct BudgetTracker {
    started: Instant,
    /// What the process had used when it was first looked at.
    cpu_at_first_check: Option<Duration>,
    budget: Budget,
}

impl BudgetTracker {
    /// Begins now.
    pub(super) fn start(budget: Budget) -> Self {
        BudgetTracker {
            started: Instant::now(),
            cpu_at_first_check: None,
            budget,
        }
    }

    /// Which time is over, if any is, now that the process has used so much. What it had used when
    /// this was asked first does not count: most items are answered before anybody asks, and to find
    /// out takes longer than they do.
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
