//! classroom50's folder: its entry point, and the grader in an archive beside it. Students can read
//! all of it, so it asks the practice exam.

use std::path::Path;

use crate::bundle::{Bundle, archive};
use crate::package::{NoPackage, grading_part};

/// What the runner starts.
const ENTRY: (&str, &str) = (
    "autograder.py",
    include_str!("own/classroom50/autograder.py"),
);

/// All files of the folder.
pub(super) fn package(root: &Path, policy: &str) -> Result<Bundle, NoPackage> {
    let students = Bundle::collect(root, None)?;
    let mut grader = Bundle::default();
    for (path, contents) in grading_part(&students) {
        grader.put(path, contents.clone());
    }
    grader.put("policy.toml", policy);
    let mut package = Bundle::default();
    package.put("pathtracing.zip", archive::zip(&grader)?);
    package.put(ENTRY.0, ENTRY.1);
    Ok(package)
}
