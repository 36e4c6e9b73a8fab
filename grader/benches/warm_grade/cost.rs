//! What a piece of work costs: wall time, and CPU time of ourselves and of all that we start.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use nix::sys::resource::{UsageWho, getrusage};
use nix::sys::time::TimeVal;

/// Two times. On a machine with other work, only the second is worth a comparison.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    pub wall: Duration,
    pub cpu: Duration,
}

impl Cost {
    pub fn of(work: impl FnOnce()) -> Cost {
        let (wall, cpu) = (Instant::now(), used());
        work();
        Cost {
            wall: wall.elapsed(),
            cpu: used() - cpu,
        }
    }

    /// Of a program, which must succeed.
    pub fn of_program(command: &mut Command) -> Cost {
        Cost::of(|| {
            let status = command.stdout(Stdio::null()).status();
            let status = status.expect("it can be started");
            assert!(status.success(), "{command:?} failed");
        })
    }
}

/// CPU time so far; that of a child counts once it has been waited for.
fn used() -> Duration {
    let [own, children] = [UsageWho::RUSAGE_SELF, UsageWho::RUSAGE_CHILDREN].map(|who| {
        let usage = getrusage(who).expect("the system counts");
        duration(usage.user_time()) + duration(usage.system_time())
    });
    own + children
}

fn duration(time: TimeVal) -> Duration {
    let micros = time.tv_sec() * 1_000_000 + time.tv_usec();
    Duration::from_micros(u64::try_from(micros).expect("time goes on"))
}
