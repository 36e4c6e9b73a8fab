//! Archives from students' machines and course platforms.

use std::fs;
use std::sync::LazyLock;

use grader::handed_out::RAYS;
use grader::submission::Submission;
use tempfile::TempDir;

static FOLDER: LazyLock<TempDir> = LazyLock::new(|| TempDir::new().expect("temporary folder"));

/// Reads the bytes as a submission. The result must be the task files or an error.
pub fn read(bytes: &[u8]) {
    let path = FOLDER.path().join("any.zip");
    fs::write(&path, bytes).expect("the file can be written");
    match Submission::collect(&path, &RAYS) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(submission) => assert_eq!(submission.files.len(), 5),
    }
}
