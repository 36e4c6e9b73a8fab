//! Untrusted code, graded by an unprivileged user. The test is skipped unless root runs it, because
//! otherwise all tests run unprivileged anyway.

use std::fs::{self, Permissions};
use std::os::unix::fs::{PermissionsExt, chown};
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use crate::faults::workspace::WorkspaceCopy;
use crate::harness::{Submission, grade_into, workspace};

/// A user that exists on every system and owns nothing.
const NOBODY: u32 = 65_534;
/// A script that runs the command after `--` as another user, in its own mount namespace. Other
/// users cannot read root's home, so the script mounts a tmpfs over it that contains only the
/// folders named before `--`.
const SCRIPT: &str = r#"
    set -e
    mount --make-rprivate / || exit 99
    stage=$(mktemp -d)
    mount -t tmpfs none "$stage"
    home=$1; user=$2; shift 2
    n=0
    for folder in "$@"; do
        [ "$folder" = -- ] && break
        n=$((n + 1)); mkdir "$stage/$n"; mount --bind "$folder" "$stage/$n"
    done
    mount -t tmpfs -o mode=755 none "$home"
    n=0
    while [ "$1" != -- ]; do
        n=$((n + 1)); mkdir -p "$1"; mount --bind "$stage/$n" "$1"; shift
    done
    shift
    exec setpriv --reuid="$user" --regid="$user" --clear-groups "$@""#;

fn is_root() -> bool {
    use std::os::unix::fs::MetadataExt;
    fs::metadata("/proc/self").unwrap().uid() == 0
}

fn skip(why: &str) {
    assert!(std::env::var_os("CI").is_none(), "{why}");
    eprintln!("SKIPPED: {why}");
}

/// Returns the folder of the toolchain that runs these tests.
fn toolchain_folder() -> PathBuf {
    let cargo = Path::new(env!("CARGO"));
    cargo.ancestors().nth(2).unwrap().to_owned()
}

/// Grades as the user `nobody`. Returns `None` if this system doesn't allow that.
fn grade_as_nobody(submission: &Submission, arguments: &[&str]) -> Option<Value> {
    let copy = WorkspaceCopy::with_dependencies();
    let grade = copy.path().join("target/grade");
    let out = grade.join("out");
    for folder in [copy.path(), submission.path().parent().unwrap()] {
        fs::set_permissions(folder, Permissions::from_mode(0o755)).unwrap();
    }
    for folder in [&grade, &grade.join(".cache")] {
        chown(folder, Some(NOBODY), Some(NOBODY)).unwrap();
    }

    let grader = Path::new(env!("CARGO_BIN_EXE_grader"));
    let project = workspace().canonicalize().unwrap();
    let home = PathBuf::from(std::env::var_os("HOME").unwrap_or("/root".into()));
    let needed = [
        toolchain_folder(),
        project,
        grader.parent().unwrap().to_owned(),
    ];
    let at_home = needed.iter().filter(|folder| folder.starts_with(&home));

    let mut command = Command::new("unshare");
    command
        .args(["--mount", "sh", "-c", SCRIPT, "sh"])
        .arg(&home);
    command.arg(NOBODY.to_string());
    let grade = grade_into(&submission.path(), &out);
    command.args(at_home).arg("--").arg(grade.get_program());
    command.args(grade.get_args()).args(arguments);
    command.env("CARGO", toolchain_folder().join("bin/cargo"));
    let output = command.current_dir(copy.path()).output().ok()?;
    let error = String::from_utf8_lossy(&output.stderr);
    let programs = ["unshare: ", "mount: ", "setpriv: "];
    if programs.iter().any(|program| error.starts_with(program)) || output.status.code() == Some(99)
    {
        return None;
    }
    assert_eq!(output.status.code(), Some(0), "{error}");
    let score = fs::read(out.join("score.json")).unwrap();
    Some(serde_json::from_slice(&score).unwrap())
}

#[test]
fn an_unprivileged_user_grades_untrusted_code_as_well_as_root() {
    if !is_root() {
        eprintln!("SKIPPED: all tests run as an unprivileged user already");
        return;
    }
    let key = tempfile::TempDir::new().unwrap();
    fs::set_permissions(key.path(), Permissions::from_mode(0o755)).unwrap();
    fs::write(key.path().join("key"), "the final exam").unwrap();
    let key = key.path().join("key");

    // The submission attempts things that its user may do outside the sandbox. Otherwise, it is
    // correct.
    let attempt = format!(
        "if std::fs::read({key:?}).is_ok() || std::net::UdpSocket::bind(\"127.0.0.1:0\").is_ok() {{ \
         println!(\"done\"); }}"
    );
    let method = "let height = 2.0 * framework";
    let mallory = Submission::reference("mallory");
    let mallory = mallory.with_replaced("camera.rs", method, &format!("{attempt}\n{method}"));
    for level in ["none", "no-namespaces", "full"] {
        let Some(score) = grade_as_nobody(&mallory, &["--isolation", level]) else {
            skip("cannot switch to the user nobody: this needs unshare, mount and setpriv");
            return;
        };
        let printed = score["tasks"][0]["printed"].as_str().unwrap_or_default();
        assert_eq!(printed.starts_with("done"), level == "none", "{level}");
        assert_eq!(score["points"], 100, "{level}");
        assert_eq!(score["isolation"], level);
    }
}
