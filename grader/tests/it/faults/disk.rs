//! A disk that is full, and a system without disks in memory.

use std::fs;
use std::process::{Command, Output};
use std::thread;

use seccompiler::{
    BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter,
    SeccompRule, apply_filter,
};
use serde_json::Value;

use super::workspace::WorkspaceCopy;
use crate::harness::{FULL_POINTS, Submission, grader};

/// Mounts a disk of a size at a place, runs what follows, and prints the score that is on the disk.
const SCRIPT: &str = r#"
    mount -t tmpfs -o "size=$1" none "$2" || exit 99
    disk=$2
    shift 2
    "$@" >/dev/null
    code=$?
    cat "$disk/out/score.json" 2>/dev/null
    exit $code"#;
/// Its exit code where nothing can be mounted.
const MOUNT_FAILED: i32 = 99;

/// Grades on a disk of this size, in kilobytes. `None` where this system does not let us mount one.
fn grade_on_disk(
    kilobytes: usize,
    workspace: &WorkspaceCopy,
    submission: &Submission,
) -> Option<Output> {
    let disk = workspace.path().join("target/grade/work");
    fs::create_dir_all(&disk).unwrap();
    let mut command = Command::new("unshare");
    command.args([
        "--mount",
        "--user",
        "--map-root-user",
        "sh",
        "-c",
        SCRIPT,
        "sh",
    ]);
    command.arg(format!("{kilobytes}k")).arg(&disk);
    command
        .arg(env!("CARGO_BIN_EXE_grader"))
        .arg(submission.path());
    command
        .arg("--no-reference")
        .arg("--out")
        .arg(disk.join("out"));
    let output = command.current_dir(workspace.path()).output();
    let output = output.ok().filter(|output| {
        let refused = String::from_utf8_lossy(&output.stderr).contains("unshare: ");
        output.status.code() != Some(MOUNT_FAILED) && !refused
    });
    if output.is_none() {
        assert!(std::env::var_os("CI").is_none(), "no disk can be mounted");
        eprintln!("SKIPPED: this system lets nobody mount a disk in a namespace of their own");
    }
    output
}

/// From one that holds nothing to one that holds all: wherever it is full, that is no student's fault.
#[test]
fn a_full_disk_is_reported_and_gives_no_score() {
    let (workspace, submission) = (
        WorkspaceCopy::with_dependencies(),
        Submission::reference("any"),
    );
    let mut whole = Vec::new();
    for kilobytes in [4, 1_000, 3_000, 200_000] {
        let Some(output) = grade_on_disk(kilobytes, &workspace, &submission) else {
            return;
        };
        let error = String::from_utf8_lossy(&output.stderr);
        let score: Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
        match output.status.code() {
            Some(0) => {
                assert_eq!(
                    score["points"],
                    FULL_POINTS.iter().sum::<u64>(),
                    "{kilobytes} kB"
                );
                whole.push(kilobytes);
            }
            code => {
                assert_eq!(code, Some(3), "{kilobytes} kB: {error}");
                // The page may be what did not fit, after a score that is whole.
                let is_whole = score["complete"] == true;
                assert!(!is_whole || score["points"] == 100, "{kilobytes} kB");
                let told = ["No space left on device", "the disk is full"];
                assert!(
                    told.iter().any(|why| error.contains(why)),
                    "{kilobytes} kB: {error}"
                );
            }
        }
    }
    assert!(
        whole.contains(&200_000) && !whole.contains(&1_000),
        "{whole:?}"
    );
}

/// Refuses to mount what lies in memory, from here on for this thread and all that it starts.
fn deny_tmpfs_mounts() {
    // These flags and no others: what the sandbox says of its new root.
    let flags = libc::MS_NOSUID | libc::MS_NODEV;
    let asked = SeccompCondition::new(3, SeccompCmpArgLen::Qword, SeccompCmpOp::Eq, flags);
    let rule = SeccompRule::new(vec![asked.unwrap()]).unwrap();
    let filter = SeccompFilter::new(
        [(libc::SYS_mount, vec![rule])].into(),
        SeccompAction::Allow,
        SeccompAction::Errno(libc::ENODEV as u32),
        std::env::consts::ARCH.try_into().unwrap(),
    );
    let program: BpfProgram = filter.unwrap().try_into().unwrap();
    apply_filter(&program).unwrap();
}

#[test]
fn without_tmpfs_full_isolation_is_refused_and_nothing_is_graded() {
    let submission = Submission::reference("any");
    let out = submission.path().join("out");
    let mut command = grader();
    command.arg(submission.path()).arg("--out").arg(&out);
    command.args(["--no-reference", "--isolation", "full"]);
    let graded = thread::spawn(move || {
        deny_tmpfs_mounts();
        command.output().unwrap()
    });
    super::assert_grader_fault(
        &graded.join().unwrap(),
        &out,
        "isolation full is not reached",
    );
}
