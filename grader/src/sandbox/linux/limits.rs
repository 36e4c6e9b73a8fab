//! Sets the resource limits of a confined program.

use std::io;

use rustix::process::{Resource, setrlimit};

use super::super::launch_request::{LaunchRequest, Profile};
use super::while_doing;
use crate::machine::system::{resources, rlimit};

/// The maximum number of threads in a probe, including the two that every probe has. This limit is
/// only set if the probe runs as a dedicated user that runs nothing else.
const PROBE_THREADS: u64 = 34;
/// The maximum total number of processes and threads for the compiler, the linker and their
/// helpers.
const COMPILER_PROCESSES: u64 = 256;
/// The stack size of a program's main thread, in bytes. A submission runs in a different thread,
/// with its own stack size.
const STACK: u64 = 8 << 20;

/// Sets all limits.
pub(super) fn set(request: &LaunchRequest, user: Option<u32>) -> io::Result<()> {
    let (processes, open_files) = match request.profile {
        Profile::Probe => (PROBE_THREADS, 16),
        Profile::Compiler { .. } => (COMPILER_PROCESSES, 1024),
    };
    // This limit applies to all of a user's processes together, so it only works for a dedicated
    // user.
    let processes = user.map(|_| (Resource::Nproc, processes));
    let others = [
        (Resource::Memlock, 0),
        (Resource::Msgqueue, 0),
        (Resource::Stack, STACK),
        (Resource::Nofile, open_files),
    ];
    let all = resources(request.limits).chain(others).chain(processes);
    for (resource, most) in all {
        setrlimit(resource, rlimit(resource, most)).map_err(while_doing("set a limit"))?;
    }
    Ok(())
}
