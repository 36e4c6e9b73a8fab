//! Running processes, as listed by Linux in `/proc`. Other systems don't provide this information.

use std::fs;
use std::thread;
use std::time::{Duration, Instant};

/// The unit of CPU times in `/proc`, which is the same on all common machines.
const TICK: Duration = Duration::from_millis(10);

/// Waits until `happened` returns a value. The time limit is long, because other jobs may slow down
/// the machine.
pub fn eventually<T>(mut happened: impl FnMut() -> Option<T>) -> T {
    let deadline = Instant::now() + Duration::from_secs(300);
    loop {
        if let Some(what) = happened() {
            return what;
        }
        assert!(Instant::now() < deadline, "timed out");
        thread::sleep(Duration::from_millis(5));
    }
}

/// Returns the name of a process and the words that follow the name in `/proc`: the state, the
/// parent and so on.
fn stat(process: u32) -> Option<(String, Vec<String>)> {
    let stat = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    // The name in parentheses may contain spaces and parentheses.
    let (name, rest) = stat.rsplit_once(')')?;
    let words = rest.split_whitespace().map(str::to_owned);
    Some((name.split_once('(')?.1.to_owned(), words.collect()))
}

/// Returns the name of a process.
pub fn name(process: u32) -> Option<String> {
    stat(process).map(|(name, _)| name)
}

/// Returns whether a process is still running.
pub fn is_running(process: u32) -> bool {
    stat(process).is_some_and(|(_, words)| words[0] != "Z")
}

/// Returns the processes that a process has started or adopted.
pub fn children(parent: u32) -> Vec<u32> {
    let parent = parent.to_string();
    let entries = fs::read_dir("/proc").into_iter().flatten().flatten();
    let processes = entries.filter_map(|entry| entry.file_name().to_str()?.parse().ok());
    let is_child = |process: &u32| stat(*process).is_some_and(|(_, words)| words[1] == parent);
    processes.filter(is_child).collect()
}

/// Returns a process and all processes it has started.
pub fn family(parent: u32) -> Vec<u32> {
    let below = children(parent).into_iter().flat_map(family);
    [parent].into_iter().chain(below).collect()
}

/// Returns the CPU time used by a process, including threads that have ended.
pub fn cpu_time(process: u32) -> Option<Duration> {
    let (_, words) = stat(process)?;
    let ticks = words[11].parse::<u32>().ok()? + words[12].parse::<u32>().ok()?;
    Some(ticks * TICK)
}

/// Returns the peak memory of a process, in bytes.
pub fn peak_memory(process: u32) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kibibytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kibibytes << 10)
}
