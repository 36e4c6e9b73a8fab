//! Compiler messages, which quote a submission's code.

use grader::build::diagnostics::errors;
use grader::handed_out::RAYS;

/// Reads the bytes as compiler messages, one per line.
pub fn read(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    for error in errors(&text) {
        let _ = (error.blamed_file(RAYS.files), error.text());
    }
}
