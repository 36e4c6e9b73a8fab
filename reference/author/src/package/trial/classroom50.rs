//! The trial of classroom50's folder: its entry point in a student's checkout, with what the runner
//! sets.

use std::fs;
use std::path::Path;
use std::process::Command;

use grader::given::TASK_FILES;
use serde_json::Value;

use crate::package::trial::{NotTried, at};

/// Where it is tried, from the workspace's root. What was compiled there stays for the next time.
const PLACE: &str = "target/package/classroom50";
/// As the runner sets them.
const RUNNER: [(&str, &str); 8] = [
    ("CLASSROOM", "gfx-f26"),
    ("ASSIGNMENT", "pathtracer"),
    ("ASSIGNMENT_TYPE", "individual"),
    ("USERNAME", "alice"),
    ("SUBMISSION_TAG", "submit/2026-11-20T21-10-05Z-a1b2c3d"),
    ("COMMIT_URL", "https://example.org/commit/a1b2c3d"),
    ("RELEASE_URL", "https://example.org/releases/1"),
    ("REVIEW_URL", "https://example.org/compare/1"),
];

/// Tries the folder, and tells what is not as it should be.
pub fn check(workspace: &Path, folder: &Path) -> Result<Vec<String>, NotTried> {
    let folder = &folder.canonicalize().map_err(at(folder))?;
    let place = &workspace.canonicalize().map_err(at(workspace))?.join(PLACE);
    let mut complaints = Vec::new();
    for (whose, files, points) in [
        ("reference", "reference/src", 100),
        ("starter", "grader/starter", 0),
    ] {
        let checkout = &place.join(whose);
        check_out(&workspace.join(files), checkout)?;
        let output = Command::new("python3")
            .arg(folder.join("autograder.py"))
            .current_dir(checkout)
            .envs(RUNNER)
            .env("CLASSROOM50_BUNDLE_DIR", folder)
            .env("CARGO_TARGET_DIR", place.join("built"))
            .output()
            .map_err(at(Path::new("python3")))?;
        let result = fs::read(checkout.join("result.json")).unwrap_or_default();
        let result: Value = serde_json::from_slice(&result).unwrap_or_default();
        let is_right = result["score"] == points && result["max-score"] == 100;
        let is_theirs = result["owner"] == "alice" && result["datetime"] == "2026-11-20T20:09:58Z";
        let has_page = checkout.join("release-body.md").is_file();
        if !(output.status.success() && is_right && is_theirs && has_page) {
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            complaints.push(format!("the {whose}: {result:.300}\n{said}"));
        }
    }
    Ok(complaints)
}

/// A student's repository with one commit.
fn check_out(files: &Path, checkout: &Path) -> Result<(), NotTried> {
    if checkout.exists() {
        fs::remove_dir_all(checkout).map_err(at(checkout))?;
    }
    let source = checkout.join("student/src");
    fs::create_dir_all(&source).map_err(at(&source))?;
    for file in TASK_FILES {
        let from = files.join(file.name);
        fs::copy(&from, source.join(file.name)).map_err(at(&from))?;
    }
    let git = |arguments: &[&str]| {
        let mut git = Command::new("git");
        git.args([
            "-c",
            "user.name=alice",
            "-c",
            "user.email=alice@example.org",
        ])
        .args(arguments)
        .env("GIT_COMMITTER_DATE", "2026-11-20T21:09:58+01:00")
        .current_dir(checkout);
        git.output().map_err(at(Path::new("git")))
    };
    git(&["init", "--quiet"])?;
    git(&["add", "."])?;
    git(&["commit", "--quiet", "--message", "hand in"])?;
    Ok(())
}
