//! What the confined program may use.

use std::io;

use rustix::process::{Resource, Rlimit, setrlimit};

use super::super::launch_request::{LaunchRequest, Profile};
use super::while_doing;
use crate::system::CPU_GRACE_SECONDS;

/// Threads of a probe beside its own two. A user of its own is counted alone.
const PROBE_THREADS: u64 = 34;
/// The compiler, its threads, the linker and its helpers.
const COMPILER_PROCESSES: u64 = 256;
/// The stack of a program's first thread, in bytes; a submission runs on one of its own.
const STACK: u64 = 8 << 20;

/// Sets them, once and for all: soft and hard alike, but for CPU time. There the hard one kills as
/// the system does when it runs out of memory; the soft one comes first, and by a signal of its own.
pub(super) fn set(order: &LaunchRequest, own_user: Option<u32>) -> io::Result<()> {
    let limits = order.limits;
    let (processes, open_files) = match order.profile {
        Profile::Probe => (PROBE_THREADS, 16),
        Profile::Compiler { .. } => (COMPILER_PROCESSES, 1024),
    };
    // The number of processes counts all that a user has: no measure for one that has others.
    let processes = own_user.map(|_| (Resource::Nproc, processes));
    let all = [
        (Resource::As, limits.memory),
        (Resource::Cpu, limits.cpu.as_secs().max(1)),
        (Resource::Fsize, limits.file),
        (Resource::Core, 0),
        (Resource::Memlock, 0),
        (Resource::Msgqueue, 0),
        (Resource::Stack, STACK),
        (Resource::Nofile, open_files),
    ];
    for (resource, most) in all.into_iter().chain(processes) {
        let limit = Rlimit {
            current: Some(most),
            maximum: Some(
                most + if resource == Resource::Cpu {
                    CPU_GRACE_SECONDS
                } else {
                    0
                },
            ),
        };
        setrlimit(resource, limit).map_err(while_doing("set a limit"))?;
    }
    Ok(())
}
