//! The time limits for an item and the time used so far.

use std::ops::{Add, AddAssign};
use std::time::{Duration, Instant};

use super::fault::TimeLimit;
use crate::machine::system::ProcessTime;

/// The amount of output, in bytes, above which a program is considered to print a lot.
const MUCH_OUTPUT_BYTES: u64 = 64 << 10;

/// The time limits for an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ItemLimits {
    /// The CPU time limit. This is the limit that infinite loops exceed.
    pub cpu: Duration,
    /// The CPU time limit of a program that prints a lot. Printing on every call takes a thousand
    /// times as long as a correct answer.
    pub cpu_if_printing: Duration,
    /// The limit on the time that the program spends waiting, e.g. sleeping. Waiting for a
    /// processor isn't included, because on a busy machine it says nothing about the code.
    pub waiting: Duration,
}

impl ItemLimits {
    /// Returns limits that allow this much CPU time.
    pub const fn from_cpu(cpu: Duration) -> Self {
        ItemLimits {
            cpu,
            cpu_if_printing: cpu,
            waiting: Duration::from_secs(3),
        }
    }

    /// Returns the CPU time limit of a program that has printed this many bytes.
    fn cpu_after_printing(self, bytes: u64) -> Duration {
        if bytes > MUCH_OUTPUT_BYTES {
            self.cpu_if_printing
        } else {
            self.cpu
        }
    }
}

/// The time that a program has used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TimeUsed {
    /// CPU time, or wall time on systems that don't report CPU time.
    pub cpu: Duration,
    /// Time it spent waiting for something other than a processor.
    pub waiting: Duration,
}

impl Add for TimeUsed {
    type Output = TimeUsed;

    fn add(mut self, more: TimeUsed) -> TimeUsed {
        self += more;
        self
    }
}

impl AddAssign for TimeUsed {
    fn add_assign(&mut self, more: TimeUsed) {
        self.cpu += more.cpu;
        self.waiting += more.waiting;
    }
}

/// Measures an item's time against its limits.
#[derive(Debug)]
pub struct Stopwatch {
    limits: ItemLimits,
    started: Instant,
    /// The time of the first check, and the process's times at that point.
    first: Option<(Instant, ProcessTime)>,
    used: TimeUsed,
}

impl Stopwatch {
    /// Starts measuring.
    pub fn start(limits: ItemLimits) -> Self {
        Stopwatch {
            limits,
            started: Instant::now(),
            first: None,
            used: TimeUsed::default(),
        }
    }

    /// Returns the limit that was exceeded, if any. Measuring starts at the first check: most items
    /// are finished by then, and asking the system for a process's CPU time takes longer than
    /// answering such an item.
    ///
    /// `printed` is the number of bytes that the program has printed since the start. On systems
    /// that don't report a process's CPU time, wall time is limited instead.
    pub fn exceeded(&mut self, now: Option<ProcessTime>, printed: u64) -> Option<TimeLimit> {
        let cpu = self.limits.cpu_after_printing(printed);
        let waiting = self.limits.waiting;
        let instant = Instant::now();
        let Some(now) = now else {
            self.used.cpu = instant - self.started;
            let wall = 2 * cpu + waiting;
            return (self.used.cpu >= wall).then_some(TimeLimit::Wall);
        };
        let (first_instant, first) = *self.first.get_or_insert((instant, now));
        self.used = used(instant - first_instant, first, now);
        if self.used.cpu >= cpu {
            return Some(TimeLimit::Cpu);
        }
        // A program that wants a processor and doesn't get one isn't waiting, but the system only adds
        // up that time once the program has a processor again.
        (now.is_asleep && self.used.waiting >= waiting).then_some(TimeLimit::Waiting)
    }

    /// Returns the time used up to the last check.
    pub fn used(&self) -> TimeUsed {
        self.used
    }
}

/// Returns the time that a process used between two measurements that are `wall` apart.
fn used(wall: Duration, first: ProcessTime, now: ProcessTime) -> TimeUsed {
    let cpu = now.cpu.saturating_sub(first.cpu);
    let delayed = now.delayed.saturating_sub(first.delayed);
    TimeUsed {
        cpu,
        waiting: wall.saturating_sub(cpu + delayed),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Duration = Duration::from_secs(1);

    #[test]
    fn time_without_a_processor_is_waiting_unless_the_process_wanted_one() {
        let time = |cpu, delayed| ProcessTime {
            cpu: cpu * SECOND,
            delayed: delayed * SECOND,
            is_asleep: true,
        };
        let waiting = |cpu, delayed| {
            let used = used(10 * SECOND, time(1, 1), time(cpu, delayed));
            used.waiting.as_secs()
        };
        assert_eq!(waiting(1, 1), 10, "it sleeps");
        assert_eq!(waiting(1, 11), 0, "others have the processor");
        assert_eq!(waiting(4, 3), 5);
        assert_eq!(waiting(21, 1), 0, "two threads run");
    }

    #[test]
    fn only_a_program_that_sleeps_is_waiting() {
        let limits = ItemLimits {
            waiting: Duration::ZERO,
            ..ItemLimits::from_cpu(SECOND)
        };
        let exceeded = |is_asleep| {
            let now = ProcessTime {
                cpu: Duration::ZERO,
                delayed: Duration::ZERO,
                is_asleep,
            };
            Stopwatch::start(limits).exceeded(Some(now), 0)
        };
        assert_eq!(exceeded(true), Some(TimeLimit::Waiting));
        assert_eq!(exceeded(false), None, "other programs have all processors");
    }

    #[test]
    fn printing_takes_time() {
        let limits = ItemLimits {
            cpu_if_printing: 5 * SECOND,
            ..ItemLimits::from_cpu(SECOND)
        };
        assert_eq!(limits.cpu_after_printing(1_000), SECOND);
        assert_eq!(limits.cpu_after_printing(1_000_000), 5 * SECOND);
    }

    #[test]
    fn without_measurements_wall_time_is_limited() {
        let limits = ItemLimits {
            waiting: Duration::ZERO,
            ..ItemLimits::from_cpu(Duration::ZERO)
        };
        let exceeded = Stopwatch::start(limits).exceeded(None, 0);
        assert_eq!(exceeded, Some(TimeLimit::Wall));
        let limits = ItemLimits::from_cpu(600 * SECOND);
        assert_eq!(Stopwatch::start(limits).exceeded(None, 0), None);
    }
}
