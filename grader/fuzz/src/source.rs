//! Fuzzes the checks that the grader applies to a student's source file before compiling it.

use grader::handed_out::RAYS;
use judging::sanitize::sanitize;

/// Compares the bytes with the starter's files and makes them safe to print.
pub fn read(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    for file in RAYS.files {
        let _ = RAYS.changed_methods(file, &text);
    }
    let sanitized = sanitize(&text, 1000);
    let is_printable = |c: char| c == '\n' || !c.is_control();
    assert!(sanitized.chars().all(is_printable), "{sanitized:?}");
    assert!(sanitized.chars().count() <= 10_001);
}
