//! Untrusted code, graded by the real binary at each isolation level. Attempts to read files and to
//! use the network are in the hostile corpus.

use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::process::Stdio;
use std::sync::LazyLock;

use tempfile::TempDir;
use test_support::processes::{children, eventually, is_running};

use crate::cases::PANICKING;
use crate::harness::{FULL_POINTS, GradeRun, Submission, grader};

/// Every isolation level. If a machine doesn't support a level, the tests at that level are skipped
/// with a message, or fail if `CI` is set.
const LEVELS: [&str; 2] = ["full", "no-namespaces"];
const SECRET: &str = "the final exam";

/// Creates a folder with a secret in the file `key`, which every user of this machine may read.
fn secret_folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::set_permissions(folder.path(), Permissions::from_mode(0o755)).unwrap();
    fs::write(folder.path().join("key"), SECRET).unwrap();
    folder
}

/// Returns the reference with additional code, which runs before each camera ray is created.
fn running(what: &str) -> Submission {
    let method = "let height = 2.0 * framework";
    Submission::reference("mallory").with_replaced(
        "camera.rs",
        method,
        &format!("{what}\n{method}"),
    )
}

/// Returns the submission's output during the camera task.
fn camera_output(graded: &GradeRun) -> String {
    let printed = &graded.score()["tasks"][0]["printed"];
    printed.as_str().unwrap_or_default().to_owned()
}

fn grade_at(submission: &Submission, level: &str) -> GradeRun {
    submission.grade_with(&["--isolation", level])
}

/// Returns whether `--doctor` reports that this machine supports a level.
fn is_available(level: &str) -> bool {
    static DIAGNOSIS: LazyLock<String> = LazyLock::new(|| {
        let output = grader().arg("--doctor").output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    });
    let diagnosis = &*DIAGNOSIS;
    let mut lines = diagnosis.lines().map(str::split_whitespace);
    let works = lines.any(|mut words| words.next() == Some(level) && words.next() == Some("works"));
    assert!(
        works || std::env::var_os("CI").is_none(),
        "isolation level {level} is not available here:\n{diagnosis}"
    );
    if !works {
        eprintln!("SKIPPED: isolation level {level} is not available here:\n{diagnosis}");
    }
    works
}

#[test]
fn the_compiler_cannot_read_files_for_a_submission() {
    let folder = secret_folder();
    let key = folder.path().join("key");
    let submission = running(&format!("println!(\"{{}}\", include_str!({key:?}));"));
    assert!(camera_output(&grade_at(&submission, "none")).starts_with(SECRET));
    for level in LEVELS.into_iter().filter(|level| is_available(level)) {
        let graded = grade_at(&submission, level);
        assert_eq!(graded.verdicts("camera"), ["not_compiled"], "{level}");
        assert!(!graded.score().to_string().contains(SECRET), "{level}");
    }
}

#[test]
fn isolation_does_not_change_the_score() {
    let submission = Submission::panicking();
    let comparable = |graded: &GradeRun| {
        let mut score = graded.score();
        for field in ["isolation", "timings"] {
            score.as_object_mut().unwrap().remove(field);
        }
        score
    };
    assert_eq!(PANICKING.score()["isolation"], "none");
    for level in LEVELS.into_iter().filter(|level| is_available(level)) {
        let graded = grade_at(&submission, level);
        assert_eq!(comparable(&graded), comparable(&PANICKING), "{level}");
    }
}

#[test]
fn untrusted_code_is_graded_at_the_best_level_and_the_report_says_so() {
    if !is_available("full") {
        return;
    }
    let graded = Submission::reference("alice").grade_with(&["--untrusted"]);
    assert_eq!(graded.points(), *FULL_POINTS);
    assert_eq!(graded.score()["isolation"], "full");
    let report = graded.report();
    assert!(report.contains("isolation: full"), "{report}");
}

#[test]
fn no_process_survives_a_killed_grader() {
    let submission = running("loop { std::hint::black_box(0); }");
    let isolated = LEVELS.into_iter().filter(|level| is_available(level));
    for level in isolated.chain(["none"]) {
        let mut command = submission.command();
        command.args(["--isolation", level]).stdout(Stdio::null());
        let mut grader = command.spawn().unwrap();
        let children = || children(grader.id()).into_iter();
        let probe = eventually(|| children().find(|pid| is_probe(*pid)));
        grader.kill().unwrap();
        grader.wait().unwrap();
        eventually(|| (!is_running(probe)).then_some(()));
    }
}

/// Returns whether the process is a probe, rather than the launcher or the compiler.
fn is_probe(pid: u32) -> bool {
    let arguments = fs::read(format!("/proc/{pid}/cmdline")).unwrap_or_default();
    let mut words = arguments.split(|byte| *byte == 0);
    let first = words.next().unwrap_or_default();
    first.ends_with(b"/probe") || first.starts_with(b"/proc/self/fd/")
}
