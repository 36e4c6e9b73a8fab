//! classroom50's folder: its entry point, and the grader in an archive beside it. Students can read
//! all of it, so it asks the practice exam.

use std::path::Path;

use crate::bundle::{Bundle, archive};
use crate::package::{PackageError, grader_files};

/// What the runner starts.
const ENTRY_POINT: (&str, &str) = (
    "autograder.py",
    include_str!("own/classroom50/autograder.py"),
);

/// All files of the folder.
pub(super) fn package(root: &Path, policy: &str) -> Result<Bundle, PackageError> {
    let students = Bundle::collect(root, None)?;
    let mut grader = Bundle::default();
    for (path, contents) in grader_files(&students) {
        grader.insert(path, contents.clone());
    }
    grader.insert("policy.toml", policy);
    let mut package = Bundle::default();
    package.insert("pathtracing.zip", archive::zip(&grader)?);
    package.insert(ENTRY_POINT.0, ENTRY_POINT.1);
    Ok(package)
}
