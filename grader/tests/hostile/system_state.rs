//! Processes, files and kernel objects that may outlive a submission.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use test_support::processes::{children, is_running, name};

use crate::canary::Canaries;

/// The maximum time to wait for a killed process to disappear.
const EXIT_TIMEOUT: Duration = Duration::from_millis(500);

/// A snapshot of processes, files and kernel objects, as lines of text.
pub struct SystemState(BTreeSet<String>);

impl SystemState {
    pub fn snapshot(canaries: &Canaries) -> Self {
        let mut all = BTreeSet::new();
        all.extend(adopted_processes());
        all.extend(marked_files(&canaries.mark));
        all.extend(cache_entries());
        for list in [
            "sysvipc/shm",
            "sysvipc/sem",
            "sysvipc/msg",
            "keys",
            "self/mounts",
        ] {
            all.extend(kernel_table(list));
        }
        SystemState(all)
    }

    /// Returns the lines that were added or removed.
    pub fn differences(&self, after: &SystemState) -> Vec<String> {
        self.0.symmetric_difference(&after.0).cloned().collect()
    }
}

/// Returns the lines of a kernel table, without the fields that change on their own.
fn kernel_table(list: &str) -> Vec<String> {
    let text = fs::read_to_string(Path::new("/proc").join(list)).unwrap_or_default();
    // The second to fourth words of a key are its flags, usage count and remaining lifetime.
    let stable = |line: &str| match list {
        "keys" => {
            let mut words = line.split_whitespace();
            let name = words.next().unwrap_or_default().to_owned();
            words
                .skip(3)
                .fold(name, |all, word| format!("{all} {word}"))
        }
        _ => line.to_owned(),
    };
    let lines = text.lines().filter(|line| !line.trim().is_empty());
    lines
        .map(|line| format!("{list}: {}", stable(line)))
        .collect()
}

/// Returns the processes whose parent has exited. They are children of this process, which is a
/// subreaper. Waits for processes that were just killed to disappear.
fn adopted_processes() -> Vec<String> {
    let deadline = Instant::now() + EXIT_TIMEOUT;
    loop {
        let processes = running_children();
        if processes.is_empty() || Instant::now() >= deadline {
            return processes;
        }
        thread::sleep(Duration::from_millis(5));
    }
}

fn running_children() -> Vec<String> {
    let children = children(std::process::id()).into_iter();
    let running = children.filter(|process| is_running(*process));
    let names = running.map(|process| format!("process {process} ({:?})", name(process)));
    names.collect()
}

/// Returns the files that an entry deliberately left behind in the folders that it might be able to
/// write to.
fn marked_files(mark: &str) -> Vec<String> {
    let project = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let home = std::env::var_os("HOME").map(PathBuf::from);
    let folders = [
        Some(PathBuf::from("/tmp")),
        Some(PathBuf::from("/var/tmp")),
        Some(PathBuf::from("/dev/shm")),
        Some(project.join("target/grade")),
        Some(project),
        home,
    ];
    let entries = folders
        .iter()
        .flatten()
        .filter_map(|folder| fs::read_dir(folder).ok());
    let paths = entries
        .flat_map(Iterator::flatten)
        .map(|entry| entry.path());
    let marked = paths.filter(|path| path.to_string_lossy().contains(mark));
    marked
        .map(|path| format!("file {}", path.display()))
        .collect()
}

/// Returns the cached files, which the grader reuses for later submissions, and the build
/// directories. None of them may change.
fn cache_entries() -> Vec<String> {
    let grade = Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/grade/.cache");
    let mut found = Vec::new();
    for cache in ["dependencies", "parts"] {
        list_files(&grade.join(cache), &mut found);
    }
    let build_dirs = fs::read_dir(grade.join("work")).into_iter().flatten();
    let build_dirs = build_dirs.flatten().map(|entry| entry.path());
    found.extend(build_dirs.map(|path| format!("build directory {}", path.display())));
    found
}

fn list_files(folder: &Path, found: &mut Vec<String>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        let Ok(metadata) = path.symlink_metadata() else {
            continue;
        };
        if metadata.is_dir() {
            list_files(&path, found);
        }
        // A folder's modification time changes whenever the folder is used.
        let detail = if metadata.is_dir() {
            String::new()
        } else {
            format!(" {} {:?}", metadata.len(), metadata.modified().ok())
        };
        found.push(format!("cache {}{detail}", path.display()));
    }
}
