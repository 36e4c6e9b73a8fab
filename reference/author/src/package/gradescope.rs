//! The package for Gradescope: a zip file with two scripts at its root, the grader and its crates,
//! the reference and the final exam.

use std::path::Path;

use anyhow::Result;
use grader::handed_out::HandedOut;

use crate::bundle::folders::copy_tree;
use crate::bundle::{Bundle, crates};
use crate::package::{grader_files, package_path};

/// The two scripts that Gradescope runs, and the script that both of them call.
const SCRIPTS: [(&str, &str); 3] = [
    ("setup.sh", include_str!("templates/gradescope/setup.sh")),
    (
        "run_autograder",
        include_str!("templates/gradescope/run_autograder"),
    ),
    (
        "pathtracing/grade",
        include_str!("templates/gradescope/grade"),
    ),
];
/// The placeholder in the scripts for the names of the task files.
const TASK_FILES: &str = "TASK_FILES";

/// Collects all files for the zip. The grader is part of the students' bundle, and the reference's
/// parts come from the workspace at `root`.
pub(super) fn package(
    root: &Path,
    handed_out: &HandedOut,
    students: &Bundle,
    exam: &str,
    policy: &str,
) -> Result<Bundle> {
    let mut package = Bundle::default();
    for (path, contents) in grader_files(students) {
        package.insert(package_path(path), contents.clone());
    }
    // The grader takes substituted parts from these folders.
    let substitution = format!("{}/substitution", handed_out.solutions());
    for part in [handed_out.reference, &substitution] {
        copy_tree(&root.join(part), &package_path(part), &mut package)?;
    }
    let lock = students.text("Cargo.lock").unwrap_or_default();
    for (path, contents) in crates::registry_files(lock)? {
        package.insert(package_path(&format!("crates/registry/{path}")), contents);
    }
    package.insert(package_path("exam.json"), exam);
    package.insert(package_path("policy.toml"), policy);
    for (path, text) in SCRIPTS {
        package.insert(path, text.replace(TASK_FILES, &handed_out.file_list()));
    }
    Ok(package)
}
