//! The files and archives of a submission, and compiler messages, which quote its code.

use std::fs;
use std::sync::LazyLock;

use grader::build::diagnostics::errors;
use grader::handed_out::RAYS;
use grader::submission::Submission;
use judging::sanitize::sanitize;
use tempfile::TempDir;

static FOLDER: LazyLock<TempDir> = LazyLock::new(|| TempDir::new().expect("temporary folder"));

/// Reads the bytes as an archive from a student's machine or a course platform. The result must be
/// the task files or an error.
pub fn read_archive(bytes: &[u8]) {
    let path = FOLDER.path().join("any.zip");
    fs::write(&path, bytes).expect("the file can be written");
    match Submission::collect(&path, &RAYS) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(submission) => assert_eq!(submission.files.len(), 5),
    }
}

/// Compares the bytes with the starter's files and makes them safe to print, as the grader does
/// with a source file before compiling it.
pub fn read_source(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    for file in RAYS.files {
        let _ = RAYS.changed_methods(file, &text);
    }
    let sanitized = sanitize(&text, 1000);
    let is_printable = |c: char| c == '\n' || !c.is_control();
    assert!(sanitized.chars().all(is_printable), "{sanitized:?}");
    assert!(sanitized.chars().count() <= 10_001);
}

/// Reads the bytes as compiler messages, one per line.
pub fn read_diagnostics(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    for error in errors(&text) {
        let _ = (error.blamed_file(RAYS.files), error.text());
    }
}
