//! The package for classroom50: a folder with two files, the entry-point script and an archive of
//! the grader. Students can read all of it, so it uses the practice exam.

use anyhow::Result;
use grader::handed_out::HandedOut;

use crate::bundle::{ASSIGNMENT_ID, Bundle, archive};
use crate::package::grader_files;

/// The file name and the contents of the script that the runner starts.
const ENTRY_POINT: (&str, &str) = (
    "autograder.py",
    include_str!("templates/classroom50/autograder.py"),
);

/// Collects all files for the folder. The grader is part of the students' bundle.
pub(super) fn package(students: &Bundle, policy: &str, handed_out: &HandedOut) -> Result<Bundle> {
    let mut grader = Bundle::default();
    for (path, contents) in grader_files(students) {
        grader.insert(path, contents.clone());
    }
    grader.insert("policy.toml", policy);
    let mut package = Bundle::default();
    package.insert("pathtracing.zip", archive::zip(&grader)?);
    let (name, script) = ENTRY_POINT;
    package.insert(
        name,
        script.replace(ASSIGNMENT_ID, handed_out.assignment.id),
    );
    Ok(package)
}
