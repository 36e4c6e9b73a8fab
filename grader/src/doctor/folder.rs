//! The packages that are folders: classroom50's, and a template repository.

use std::fs;
use std::path::Path;

use crate::doctor::package_contents::{POLICY, PackageContents, policy_problem, read_package};
use crate::exam_file;
use crate::given_files::TASK_FILES;

/// What classroom50 starts, and what that unpacks.
const CLASSROOM50: [&str; 2] = ["autograder.py", "pathtracing.zip"];
/// What such a folder may hold, in bytes.
const MAX_FOLDER_BYTES: u64 = 10 << 20;
/// What the grader is built from, in that zip.
const REQUIRED_FOLDERS: [&str; 2] = [
    "pathtracing/grader/src/",
    "pathtracing/student/framework/src/",
];
/// What makes a folder a template for GitHub.
const WORKFLOW: &str = ".github/workflows/grade.yml";
/// What a template holds beside the five files.
const TEMPLATE_PATHS: [&str; 4] = [
    "Cargo.lock",
    ".cargo/config.toml",
    "grader/src",
    "student/framework/src",
];
/// What a template must not hold, because students read it.
const PRIVATE_PATHS: [&str; 3] = ["reference", "exam.json", "grader/tests"];

/// What is wrong, a sentence each with what to do.
pub(super) fn problems(path: &Path) -> Vec<String> {
    if path.join(WORKFLOW).is_file() {
        return template_problems(path);
    }
    if !CLASSROOM50.iter().any(|name| path.join(name).exists()) {
        return vec![format!(
            "it is no package: a folder for classroom50 holds {}, a template for GitHub {WORKFLOW}; Gradescope's is a zip",
            CLASSROOM50.join(" and ")
        )];
    }
    classroom50_problems(path)
}

fn classroom50_problems(path: &Path) -> Vec<String> {
    let mut complaints = Vec::new();
    let mut size = 0;
    for name in CLASSROOM50 {
        match fs::metadata(path.join(name)) {
            Ok(metadata) => size += metadata.len(),
            Err(_) => complaints.push(format!(
                "there is no {name}: `cargo author package classroom50` writes both files of such a folder"
            )),
        }
    }
    if size > MAX_FOLDER_BYTES {
        let size = size >> 20;
        complaints.push(format!("it holds {size} MiB, and classroom50 takes 10"));
    }
    if complaints.is_empty() {
        match read_package(&path.join(CLASSROOM50[1])) {
            Ok(contents) => complaints.extend(grader_zip_problems(&contents)),
            Err(error) => complaints.push(format!(
                "{error}; for this folder `cargo author package classroom50`"
            )),
        }
    }
    complaints
}

/// What is wrong with the grader's zip, which asks the practice exam.
fn grader_zip_problems(contents: &PackageContents) -> Vec<String> {
    let mut complaints = contents.damage_problems();
    complaints.extend(contents.empty_folder_problems(&REQUIRED_FOLDERS, "classroom50"));
    match (contents.bytes_of(POLICY), exam_file::load(None)) {
        (Some(policy), Ok(practice)) => complaints.extend(policy_problem(policy, &practice.exam)),
        (_, Err(error)) => complaints.push(error.to_string()),
        (None, _) => complaints.push(format!(
            "there is no {POLICY}: `cargo author package classroom50` writes it"
        )),
    }
    complaints
}

fn template_problems(path: &Path) -> Vec<String> {
    let files = TASK_FILES.map(|file| format!("student/src/{}", file.name));
    let wanted = files.iter().map(String::as_str).chain(TEMPLATE_PATHS);
    let missing = wanted.filter(|name| !path.join(name).exists());
    let told =
        missing.map(|name| format!("there is no {name}: `cargo author package github` writes it"));
    let secret = PRIVATE_PATHS.iter().filter(|name| path.join(name).exists());
    let leaks = secret.map(|name| {
        format!("it holds {name}, which students are not to read: push only what `cargo author package github` writes")
    });
    told.chain(leaks).collect()
}
