//! Archives: whatever a student's machine or a course's platform has packed.

use std::fs;
use std::sync::LazyLock;

use grader::submission::Submission;
use tempfile::TempDir;

static FOLDER: LazyLock<TempDir> = LazyLock::new(|| TempDir::new().expect("a folder"));

/// The bytes as a submission: five files, or a reason.
pub fn read(bytes: &[u8]) {
    let path = FOLDER.path().join("any.zip");
    fs::write(&path, bytes).expect("a file");
    match Submission::collect(&path) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(submission) => assert_eq!(submission.files.len(), 5),
    }
}
