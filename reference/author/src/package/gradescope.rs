//! Gradescope's zip: two scripts at its root, the grader with the crates that it is built from, the
//! reference, and the final exam.

use std::path::Path;

use crate::bundle::parts::take;
use crate::bundle::{Bundle, crates};
use crate::package::{NoPackage, grading_part, inside};

/// What Gradescope runs, and what both of these call.
const SCRIPTS: [(&str, &str); 3] = [
    ("setup.sh", include_str!("own/gradescope/setup.sh")),
    (
        "run_autograder",
        include_str!("own/gradescope/run_autograder"),
    ),
    ("pathtracing/grade", include_str!("own/gradescope/grade")),
];
/// What of the reference is asked in place of what a submission lacks.
const REFERENCE: [&str; 2] = ["reference/src", "reference/carried"];

/// All files of the zip.
pub(super) fn package(root: &Path, exam: &str, policy: &str) -> Result<Bundle, NoPackage> {
    let students = Bundle::collect(root, None)?;
    let mut package = Bundle::default();
    for (path, contents) in grading_part(&students) {
        package.put(inside(path), contents.clone());
    }
    for part in REFERENCE {
        take(&root.join(part), &inside(part), &mut package)?;
    }
    let lock = students.text("Cargo.lock").unwrap_or_default();
    for (path, contents) in crates::fetched(lock)? {
        package.put(inside(&format!("crates/registry/{path}")), contents);
    }
    package.put(inside("exam.json"), exam);
    package.put(inside("policy.toml"), policy);
    for (path, text) in SCRIPTS {
        package.put(path, text);
    }
    Ok(package)
}
