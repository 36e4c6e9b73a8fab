//! Checks the packages that are folders: the classroom50 package and the template repository for
//! GitHub.

use std::fs;
use std::path::Path;

use crate::doctor::package::{POLICY, PackageContents, policy_problem, read_package};
use crate::handed_out::HandedOut;
use crate::inputs::exam_source::ExamSource;

/// The script that classroom50 runs, and the zip that the script unpacks.
const CLASSROOM50: [&str; 2] = ["autograder.py", "pathtracing.zip"];
/// The maximum total size that classroom50 accepts for both files, in bytes.
const MAX_FOLDER_BYTES: u64 = 10 << 20;
/// The folders in classroom50's zip that the grader is built from.
const REQUIRED_FOLDERS: [&str; 2] = [
    "pathtracing/grader/src/",
    "pathtracing/student/framework/src/",
];
/// The file that identifies a folder as a template for GitHub.
const WORKFLOW: &str = ".github/workflows/grade.yml";
/// Paths that a template must have besides the task files.
const TEMPLATE_PATHS: [&str; 4] = [
    "Cargo.lock",
    ".cargo/config.toml",
    "grader/src",
    "student/framework/src",
];
/// Paths that a template must not have, because students can read them.
const PRIVATE_PATHS: [&str; 3] = ["reference", "exam.json", "grader/tests"];

/// Returns a message for each problem, including what to do about it.
pub(super) fn problems(path: &Path, handed_out: &HandedOut) -> Vec<String> {
    if path.join(WORKFLOW).is_file() {
        return template_problems(path, handed_out);
    }
    if !CLASSROOM50.iter().any(|name| path.join(name).exists()) {
        return vec![format!(
            "it is not a package: a folder for classroom50 contains {}, a template for GitHub \
             contains {WORKFLOW}, and a package for Gradescope is a zip",
            CLASSROOM50.join(" and ")
        )];
    }
    classroom50_problems(path, handed_out)
}

fn classroom50_problems(path: &Path, handed_out: &HandedOut) -> Vec<String> {
    let mut problems = Vec::new();
    let mut size = 0;
    for name in CLASSROOM50 {
        match fs::metadata(path.join(name)) {
            Ok(metadata) => size += metadata.len(),
            Err(_) => problems.push(format!(
                "{name} is missing: `cargo author package classroom50` creates the two files that \
                 this folder needs"
            )),
        }
    }
    if size > MAX_FOLDER_BYTES {
        let size = size >> 20;
        problems.push(format!(
            "it is {size} MiB, but classroom50 accepts at most 10 MiB"
        ));
    }
    if problems.is_empty() {
        match read_package(&path.join(CLASSROOM50[1])) {
            Ok(contents) => problems.extend(grader_zip_problems(&contents, handed_out)),
            Err(error) => problems.push(format!(
                "{error}; for this folder, use `cargo author package classroom50`"
            )),
        }
    }
    problems
}

/// Returns a message for each problem with the grader's zip. Its policy is checked against the
/// practice exam, because classroom50 grades with that exam.
fn grader_zip_problems(contents: &PackageContents, handed_out: &HandedOut) -> Vec<String> {
    let mut problems = contents.damage_problems();
    problems.extend(contents.empty_folder_problems(&REQUIRED_FOLDERS, "classroom50"));
    let practice = ExamSource::Practice.load(handed_out);
    match (contents.inspected.get(POLICY), practice) {
        (Some(policy), Ok(practice)) => problems.extend(policy_problem(policy, &practice.exam)),
        (_, Err(error)) => problems.push(error.to_string()),
        (None, _) => problems.push(format!(
            "{POLICY} is missing: `cargo author package classroom50` creates it"
        )),
    }
    problems
}

fn template_problems(path: &Path, handed_out: &HandedOut) -> Vec<String> {
    let files = handed_out.files.iter();
    let files: Vec<String> = files
        .map(|file| format!("student/src/{}", file.name))
        .collect();
    let required = files.iter().map(String::as_str).chain(TEMPLATE_PATHS);
    let missing = required.filter(|name| !path.join(name).exists());
    let problems =
        missing.map(|name| format!("{name} is missing: `cargo author package github` creates it"));
    let secret = PRIVATE_PATHS.iter().filter(|name| path.join(name).exists());
    let leaks = secret.map(|name| {
        format!(
            "it contains {name}, which students must not read: push only what `cargo author \
                 package github` creates"
        )
    });
    problems.chain(leaks).collect()
}
