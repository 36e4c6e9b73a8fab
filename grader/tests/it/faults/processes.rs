//! Running processes, as Linux lists them in `/proc`.

use std::fs;
use std::thread;
use std::time::{Duration, Instant};

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

/// Returns the name, state and parent of a process.
fn stat(process: u32) -> Option<(String, String, u32)> {
    let stat = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    let (name, rest) = stat.rsplit_once(')')?;
    let mut words = rest.split_whitespace();
    let (state, parent) = (words.next()?.to_owned(), words.next()?.parse().ok()?);
    Some((name.split_once('(')?.1.to_owned(), state, parent))
}

pub fn child_named(name: &str, parent: u32) -> Option<u32> {
    let processes = fs::read_dir("/proc").unwrap().flatten();
    let mut numbers = processes.filter_map(|entry| entry.file_name().to_str()?.parse().ok());
    numbers.find(|number| {
        stat(*number).is_some_and(|(called, _, its)| called == name && its == parent)
    })
}

/// Returns the CPU time that a process has used so far.
pub fn cpu_time(process: u32) -> Option<Duration> {
    let stat = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    // Fields 14 and 15, user and system time, in hundredths of a second. Field 2, the name, may
    // contain spaces, so fields are counted from the last parenthesis.
    let (_, rest) = stat.rsplit_once(')')?;
    let words: Vec<&str> = rest.split_whitespace().collect();
    let ticks = words.get(11)?.parse::<u64>().ok()? + words.get(12)?.parse::<u64>().ok()?;
    Some(Duration::from_millis(10 * ticks))
}

pub fn is_running(process: u32) -> bool {
    stat(process).is_some_and(|(_, state, _)| state != "Z")
}
