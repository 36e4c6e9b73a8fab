//! A full disk, and a system without `tmpfs`.

use std::fs;
use std::process::{Command, Output};
use std::thread;

use seccompiler::{
    BpfProgram, SeccompAction, SeccompCmpArgLen, SeccompCmpOp, SeccompCondition, SeccompFilter,
    SeccompRule, apply_filter,
};
use serde_json::Value;

use super::workspace::WorkspaceCopy;
use crate::harness::{Submission, grade_into};

/// A script that mounts a `tmpfs` of a certain size at a path, runs a command, and prints the score
/// file on that disk. Its arguments are the size, the path, and the command.
const SCRIPT: &str = r#"
    mount -t tmpfs -o "size=$1" none "$2" || exit 99
    disk=$2
    shift 2
    "$@" >/dev/null
    code=$?
    cat "$disk/out/score.json" 2>/dev/null
    exit $code"#;
/// The exit code of the script if it cannot mount the disk.
const MOUNT_FAILED: i32 = 99;

/// Grades on a disk of this size in kilobytes. Returns `None` if this system doesn't allow the
/// mount.
fn grade_on_disk(
    kilobytes: usize,
    workspace: &WorkspaceCopy,
    submission: &Submission,
) -> Option<Output> {
    let disk = workspace.path().join("target/grade/.cache/work");
    fs::create_dir_all(&disk).unwrap();
    let grade = grade_into(&submission.path(), &disk.join("out"));
    let mut command = Command::new("unshare");
    command.args(["--mount", "--user", "--map-root-user"]);
    command.args(["sh", "-c", SCRIPT, "sh"]);
    command.arg(format!("{kilobytes}k")).arg(&disk);
    command.arg(grade.get_program()).args(grade.get_args());
    command.arg("--no-reference");
    let output = command.current_dir(workspace.path()).output();
    let output = output.ok().filter(|output| {
        let refused = String::from_utf8_lossy(&output.stderr).contains("unshare: ");
        output.status.code() != Some(MOUNT_FAILED) && !refused
    });
    if output.is_none() {
        assert!(std::env::var_os("CI").is_none(), "cannot mount a disk");
        eprintln!("SKIPPED: this system does not allow mounts in a user namespace");
    }
    output
}

/// Grades on disks of increasing size, from one that is too small for anything to one where
/// everything fits. A full disk must never cost the student points.
#[test]
fn a_full_disk_is_reported_and_gives_no_score() {
    let workspace = WorkspaceCopy::with_dependencies();
    let submission = Submission::reference("any");
    let mut complete = Vec::new();
    for kilobytes in [4, 1_000, 3_000, 200_000] {
        let Some(output) = grade_on_disk(kilobytes, &workspace, &submission) else {
            return;
        };
        let error = String::from_utf8_lossy(&output.stderr).to_lowercase();
        let score: Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
        match output.status.code() {
            Some(0) => {
                assert_eq!(score["points"], 100, "{kilobytes} kB");
                complete.push(kilobytes);
            }
            code => {
                assert_eq!(code, Some(3), "{kilobytes} kB: {error}");
                // The file that didn't fit may be the page, which is written after a complete
                // score.
                let is_complete = score["complete"] == true;
                assert!(!is_complete || score["points"] == 100, "{kilobytes} kB");
                let reasons = ["no space left on device", "the disk is full"];
                let says_why = reasons.iter().any(|reason| error.contains(reason));
                assert!(says_why, "{kilobytes} kB: {error}");
            }
        }
    }
    let [least, most] = [1_000, 200_000].map(|size| complete.contains(&size));
    assert!(most && !least, "{complete:?}");
}

/// Denies `tmpfs` mounts to this thread and all processes it starts from now on.
fn deny_tmpfs_mounts() {
    // Only mounts with exactly these flags are denied: the sandbox mounts its new root with them.
    let flags = libc::MS_NOSUID | libc::MS_NODEV;
    let condition = SeccompCondition::new(3, SeccompCmpArgLen::Qword, SeccompCmpOp::Eq, flags);
    let rule = SeccompRule::new(vec![condition.unwrap()]).unwrap();
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
    let graded = thread::spawn(move || {
        deny_tmpfs_mounts();
        submission.grade_with(&["--isolation", "full"])
    });
    let why = "isolation level full is not available";
    super::assert_grader_fault(&graded.join().unwrap(), why);
}
