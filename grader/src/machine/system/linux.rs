//! Limits and measures the resource usage of other processes, which only Linux supports.

use std::fs;
use std::io;
use std::process::Child;
use std::time::Duration;

use rustix::process::{Resource, Rlimit, prlimit};

use super::unix::pid;
use super::{Limits, ProcessTime};

/// Seconds of CPU time between the soft limit, which a process may ignore, and the hard limit,
/// which kills it.
const CPU_GRACE_SECONDS: u64 = 1;

/// Sets resource limits for a process that has just started.
pub fn set_limits(child: &Child, limits: Limits) -> io::Result<()> {
    // The child has been running for a moment without limits. This is safe, because a probe does
    // nothing before its first question, which is sent later.
    for (resource, most) in resources(limits) {
        match prlimit(pid(child), resource, rlimit(resource, most)) {
            // The process has already ended. The caller will notice when it waits for it.
            Ok(_) | Err(rustix::io::Errno::SRCH) => {}
            Err(error) => return Err(error.into()),
        }
    }
    Ok(())
}

/// Returns each limited resource of a process, with its limit.
pub fn resources(limits: Limits) -> impl Iterator<Item = (Resource, u64)> {
    let all = [
        (Resource::As, limits.memory),
        (Resource::Cpu, limits.cpu.as_secs().max(1)),
        (Resource::Fsize, limits.file),
        (Resource::Core, 0),
    ];
    let data = limits.data.map(|most| (Resource::Data, most));
    all.into_iter().chain(data)
}

/// Returns the soft and the hard limit. They differ only for CPU time. A process that exceeds the
/// hard limit is sent SIGKILL, just like a process that runs out of memory. At the soft limit,
/// which is lower, the process is first sent SIGXCPU, so that the two causes can be distinguished.
pub fn rlimit(resource: Resource, most: u64) -> Rlimit {
    let is_cpu = resource == Resource::Cpu;
    let grace = if is_cpu { CPU_GRACE_SECONDS } else { 0 };
    Rlimit {
        current: Some(most),
        maximum: Some(most + grace),
    }
}

/// Returns how a process has used its time so far.
pub fn process_time(child: &Child) -> Option<ProcessTime> {
    Some(ProcessTime {
        cpu: cpu_time(child)?,
        delayed: delayed(child)?,
        is_asleep: is_asleep(child)?,
    })
}

/// Returns the CPU time that a process has used so far.
pub fn cpu_time(child: &Child) -> Option<Duration> {
    // utime and stime (proc_pid_stat(5)).
    cpu_time_fields(child, 2)
}

/// Returns the CPU time used so far by a process and by those of its children that it has waited
/// for.
pub fn cpu_time_with_children(child: &Child) -> Option<Duration> {
    // utime, stime, cutime and cstime (proc_pid_stat(5)).
    cpu_time_fields(child, 4)
}

/// Returns the sum of the first `count` times in a process's `stat` file, where the times begin at
/// field 14.
fn cpu_time_fields(child: &Child, count: usize) -> Option<Duration> {
    let stat = fs::read_to_string(format!("/proc/{}/stat", child.id())).ok()?;
    // The second field is a name in parentheses that may contain spaces, so count the fields from
    // the end of the name.
    let (_, fields) = stat.rsplit_once(')')?;
    let times = fields.split_whitespace().skip(11).take(count);
    let times: Option<Vec<u64>> = times.map(|ticks| ticks.parse().ok()).collect();
    let times = times.filter(|times| times.len() == count)?;
    let hertz = rustix::param::clock_ticks_per_second();
    Some(Duration::from_secs_f64(
        times.iter().sum::<u64>() as f64 / hertz as f64,
    ))
}

/// Returns the longest time that any thread of a process has waited for a processor.
///
/// The longest time is used because the sum over many threads could exceed the time that has
/// passed.
fn delayed(child: &Child) -> Option<Duration> {
    let delays = of_each_thread(child, "schedstat")?.filter_map(|schedstat| {
        // The second field is the time on the run queue, in nanoseconds (Linux,
        // Documentation/scheduler/sched-stats.rst).
        schedstat.split_whitespace().nth(1)?.parse().ok()
    });
    delays.max().map(Duration::from_nanos)
}

/// Returns whether no thread of a process is running, ready to run (state `R`), or waiting for the
/// system to read a page or a disk (`D`).
fn is_asleep(child: &Child) -> Option<bool> {
    let mut stats = of_each_thread(child, "stat")?;
    Some(!stats.any(|stat| {
        // The state follows the name, which is in parentheses (proc_pid_stat(5)).
        let after_name = stat.rsplit_once(')').map(|(_, fields)| fields.trim_start());
        after_name.is_some_and(|fields| fields.starts_with(['R', 'D']))
    }))
}

/// Returns the contents of a file about each thread of a process.
fn of_each_thread(child: &Child, file: &str) -> Option<impl Iterator<Item = String>> {
    let threads = fs::read_dir(format!("/proc/{}/task", child.id())).ok()?;
    Some(threads.filter_map(move |thread| fs::read_to_string(thread.ok()?.path().join(file)).ok()))
}

/// Returns the resident memory of a process, in bytes.
pub fn memory(child: &Child) -> Option<u64> {
    let pages = fs::read_to_string(format!("/proc/{}/statm", child.id())).ok()?;
    let pages: u64 = pages.split_whitespace().nth(1)?.parse().ok()?;
    Some(pages * rustix::param::page_size() as u64)
}
