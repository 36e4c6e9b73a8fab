//! CPU time and memory of running processes, on Linux. Elsewhere nothing is known.

use std::fs;
use std::time::Duration;

/// The unit of CPU times, on all usual machines.
const TICK: Duration = Duration::from_millis(10);

/// Returns a process, and all processes that it has started.
pub fn family(parent: u32) -> Vec<u32> {
    let entries = fs::read_dir("/proc").into_iter().flatten().flatten();
    let processes = entries.filter_map(|entry| entry.file_name().to_str()?.parse().ok());
    let children: Vec<u32> = processes
        .filter(|process| parent_of(*process) == Some(parent))
        .collect();
    let below = children.into_iter().flat_map(family);
    [parent].into_iter().chain(below).collect()
}

fn parent_of(process: u32) -> Option<u32> {
    value(process, "PPid:")?.parse().ok()
}

/// Returns the CPU time that a process has used, with that of threads that have ended.
pub fn cpu_time(process: u32) -> Option<Duration> {
    let text = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    // The name in parentheses can contain spaces.
    let (_, fields) = text.rsplit_once(')')?;
    let mut times = fields.split_whitespace().skip(11).map(str::parse::<u32>);
    let ticks = times.next()?.ok()? + times.next()?.ok()?;
    Some(ticks * TICK)
}

/// Returns the largest memory that a process has had, in bytes.
pub fn peak_memory(process: u32) -> Option<u64> {
    let kibibytes: u64 = value(process, "VmHWM:")?.split(' ').next()?.parse().ok()?;
    Some(kibibytes << 10)
}

/// Returns a value of a process's status.
fn value(process: u32, name: &str) -> Option<String> {
    let text = fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = text.lines().find(|line| line.starts_with(name))?;
    Some(line[name.len()..].trim().to_owned())
}
