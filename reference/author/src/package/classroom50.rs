//! The package for classroom50: a folder with two files, the entry-point script and an archive of
//! the grader. Students can read all of it, so it uses the practice exam.

use anyhow::Result;

use crate::bundle::{Bundle, archive};
use crate::package::grader_files;

/// The file name and the contents of the script that the runner starts.
const ENTRY_POINT: (&str, &str) = (
    "autograder.py",
    include_str!("templates/classroom50/autograder.py"),
);

/// Collects all files for the folder. The grader is part of the students' bundle.
pub(super) fn package(students: &Bundle, policy: &str) -> Result<Bundle> {
    let mut grader = Bundle::default();
    for (path, contents) in grader_files(students) {
        grader.insert(path, contents.clone());
    }
    grader.insert("policy.toml", policy);
    let mut package = Bundle::default();
    package.insert("pathtracing.zip", archive::zip(&grader)?);
    package.insert(ENTRY_POINT.0, ENTRY_POINT.1);
    Ok(package)
}
