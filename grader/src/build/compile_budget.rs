//! The time that the compiler and the linker may use for one submission.

use std::ops::AddAssign;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Time used by the compiler and the linker.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct CompileTime {
    /// CPU time.
    pub(super) cpu: Duration,
    /// Wall time.
    pub(super) wall: Duration,
}

impl CompileTime {
    /// The time limits for a submission. An ordinary submission takes a second or two of CPU time
    /// per compiler call and rarely needs more than three calls. The wall time limit stops a
    /// compiler that only waits.
    pub(super) const MOST: Self = CompileTime {
        cpu: Duration::from_secs(60),
        wall: Duration::from_secs(180),
    };
    /// If less than this time remains, there is no point in starting a compiler.
    const LEAST: Duration = Duration::from_secs(1);
}

impl AddAssign for CompileTime {
    fn add_assign(&mut self, more: CompileTime) {
        self.cpu += more.cpu;
        self.wall += more.wall;
    }
}

/// The time used for a submission, including all attempts and all of its programs.
#[derive(Clone, Debug, Default)]
pub(super) struct CompileBudget(Arc<Mutex<CompileTime>>);

impl CompileBudget {
    /// Returns the remaining time, or `None` if it is used up.
    pub(super) fn left(&self) -> Option<CompileTime> {
        let used = *self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let left = CompileTime {
            cpu: CompileTime::MOST.cpu.saturating_sub(used.cpu),
            wall: CompileTime::MOST.wall.saturating_sub(used.wall),
        };
        (left.cpu.min(left.wall) >= CompileTime::LEAST).then_some(left)
    }

    /// Records the time used by a call.
    pub(super) fn spend(&self, time: CompileTime) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) += time;
    }
}

/// Returns the message for a submission that has used up its time.
pub(super) fn used_up_message() -> String {
    let CompileTime { cpu, wall } = CompileTime::MOST;
    format!(
        "the compiler was stopped: a submission may take at most {} s of CPU time and {} s of wall \
         time to compile. Look for a constant, a macro or a type that expands without end",
        cpu.as_secs(),
        wall.as_secs()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn calls_share_the_time_until_either_kind_is_used_up() {
        let seconds = |cpu, wall| CompileTime {
            cpu: Duration::from_secs(cpu),
            wall: Duration::from_secs(wall),
        };
        for (call, calls) in [
            (seconds(25, 25), 3),
            (seconds(1, 75), 3),
            (seconds(60, 60), 1),
        ] {
            let budget = CompileBudget::default();
            let mut made = 0;
            while budget.left().is_some() {
                budget.spend(call);
                made += 1;
            }
            assert_eq!(made, calls);
        }
    }
}
