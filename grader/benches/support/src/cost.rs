//! Measures wall time, and the CPU time of this process and its children.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use nix::sys::resource::{UsageWho, getrusage};
use nix::sys::time::TimeVal;

/// The wall time and CPU time of an operation. On a busy machine, only CPU times can be compared.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    /// Wall time.
    pub wall: Duration,
    /// CPU time of this process and of its children.
    pub cpu: Duration,
}

impl Cost {
    /// Measures a function.
    pub fn of(work: impl FnOnce()) -> Cost {
        let (wall, cpu) = (Instant::now(), used());
        work();
        Cost {
            wall: wall.elapsed(),
            cpu: used() - cpu,
        }
    }

    /// Measures a run of a program. Panics if the program fails.
    pub fn of_program(command: &mut Command) -> Cost {
        Cost::of(|| {
            let status = command.stdout(Stdio::null()).status();
            let status = status.expect("the program can be started");
            assert!(status.success(), "{command:?} failed");
        })
    }
}

/// Returns the CPU time used so far. The CPU time of a child process is included once the child has
/// been waited for.
fn used() -> Duration {
    let [own, children] = [UsageWho::RUSAGE_SELF, UsageWho::RUSAGE_CHILDREN].map(|who| {
        let usage = getrusage(who).expect("the system reports CPU time");
        duration(usage.user_time()) + duration(usage.system_time())
    });
    own + children
}

fn duration(time: TimeVal) -> Duration {
    let micros = time.tv_sec() * 1_000_000 + time.tv_usec();
    Duration::from_micros(u64::try_from(micros).expect("CPU time is not negative"))
}
