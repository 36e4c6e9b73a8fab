//! The memory available on this machine and in its control groups. Containers and batch systems
//! limit memory with control groups, and kill a process in a group that exceeds its limit.

use std::fs;
use std::path::{Path, PathBuf};

/// The folder where systems mount control group file systems.
const MOUNTS: &str = "/sys/fs/cgroup";

/// Returns the number of bytes that this process and its children can still use before the system
/// has to kill a process, if known.
pub fn available_memory() -> Option<u64> {
    let groups = fs::read_to_string("/proc/self/cgroup").unwrap_or_default();
    let machine = fs::read_to_string("/proc/meminfo").ok();
    let machine = machine.and_then(|text| value(&text, "MemAvailable:"));
    let machine = machine.map(|kibibytes| kibibytes << 10);
    smallest(machine, left_in_groups(Path::new(MOUNTS), &groups))
}

/// The names of a control group's files. They differ between the two versions of control groups
/// (Linux, Documentation/admin-guide/cgroup-v1/memory.rst and cgroup-v2.rst).
struct Files {
    limit: &'static str,
    usage: &'static str,
    /// The entries in `memory.stat` for file pages, which the system can drop.
    cache: [&'static str; 2],
}

const VERSION_1: Files = Files {
    limit: "memory.limit_in_bytes",
    usage: "memory.usage_in_bytes",
    cache: ["total_inactive_file", "total_active_file"],
};
const VERSION_2: Files = Files {
    limit: "memory.max",
    usage: "memory.current",
    cache: ["inactive_file", "active_file"],
};

/// Returns the memory available in the groups listed in `/proc/self/cgroup` and in all groups above
/// them.
fn left_in_groups(mounts: &Path, groups: &str) -> Option<u64> {
    let mut least = None;
    for line in groups.lines() {
        let mut fields = line.splitn(3, ':').skip(1);
        let (Some(controllers), Some(path)) = (fields.next(), fields.next()) else {
            continue;
        };
        let (files, mount) = match controllers {
            "" if mounts.join("unified").is_dir() => (&VERSION_2, mounts.join("unified")),
            "" => (&VERSION_2, mounts.to_owned()),
            _ if controllers.split(',').any(|name| name == "memory") => {
                (&VERSION_1, mounts.join("memory"))
            }
            _ => continue,
        };
        // In a container, the path may be that of the group on the host, while the mount only shows
        // the container's own group. In that case, only the mount itself exists.
        let group: PathBuf = mount.join(path.trim_start_matches('/'));
        for folder in group.ancestors().take_while(|it| it.starts_with(&mount)) {
            least = smallest(least, left_in_group(folder, files));
        }
    }
    least
}

/// Returns the memory available in one group, or `None` if it is unlimited.
fn left_in_group(folder: &Path, files: &Files) -> Option<u64> {
    let read = |name| fs::read_to_string(folder.join(name)).ok();
    let limit: u64 = read(files.limit)?.trim().parse().ok()?;
    let usage: u64 = read(files.usage)?.trim().parse().ok()?;
    let statistics = read("memory.stat").unwrap_or_default();
    let cache = files
        .cache
        .map(|name| value(&statistics, name).unwrap_or(0));
    let in_use = usage.saturating_sub(cache.iter().sum());
    Some(limit.saturating_sub(in_use))
}

/// Returns the number that follows a name at the start of a line.
fn value(text: &str, name: &str) -> Option<u64> {
    let mut lines = text.lines().map(str::split_whitespace);
    let mut line = lines.find(|line| line.clone().next() == Some(name))?;
    line.nth(1)?.parse().ok()
}

fn smallest(a: Option<u64>, b: Option<u64>) -> Option<u64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    }
}

#[cfg(test)]
mod tests {
    use tempfile::TempDir;

    use super::*;

    const MIB: u64 = 1 << 20;

    fn write(mounts: &TempDir, folder: &str, files: &[(&str, String)]) {
        let folder = mounts.path().join(folder);
        fs::create_dir_all(&folder).unwrap();
        for (name, text) in files {
            fs::write(folder.join(name), text).unwrap();
        }
    }

    #[test]
    fn the_tightest_group_counts_and_cached_files_do_not() {
        let mounts = TempDir::new().unwrap();
        let left = || left_in_groups(mounts.path(), "0::/job/step/task\n");
        let cached = 20 * MIB;
        let step = [
            ("memory.max", format!("{}\n", 100 * MIB)),
            ("memory.current", format!("{}\n", 51 * MIB)),
            (
                "memory.stat",
                format!("anon 9\ninactive_file {cached}\nactive_file {MIB}\n"),
            ),
        ];
        write(&mounts, "job/step", &step);
        assert_eq!(left(), Some(70 * MIB));
        let job = [("memory.max", 90), ("memory.current", 80)];
        write(
            &mounts,
            "job",
            &job.map(|(file, mib)| (file, (mib * MIB).to_string())),
        );
        assert_eq!(left(), Some(10 * MIB));
        write(&mounts, "job", &[("memory.max", "max\n".to_owned())]);
        assert_eq!(left(), Some(70 * MIB));
    }

    #[test]
    fn a_container_of_version_1_sees_its_own_group_at_the_mount() {
        let mounts = TempDir::new().unwrap();
        let statistics = format!("total_inactive_file {MIB}\ntotal_active_file {MIB}\n");
        let own = [
            ("memory.limit_in_bytes", (8 * MIB).to_string()),
            ("memory.usage_in_bytes", (3 * MIB).to_string()),
            ("memory.stat", statistics),
        ];
        write(&mounts, "memory", &own);
        let groups = "9:name=systemd:/\n4:cpu,memory:/docker/0123\n0::/\n";
        assert_eq!(left_in_groups(mounts.path(), groups), Some(7 * MIB));
        assert_eq!(left_in_groups(mounts.path(), "4:cpu:/\n"), None);
    }

    #[test]
    fn this_machine_has_some_memory() {
        assert!(available_memory().is_some_and(|bytes| bytes > MIB));
    }
}
