//! What the compiler says, which quotes what a submission wrote.

use grader::build::diagnostics::errors;

/// The compiler's messages, line by line.
pub fn read(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    for error in errors(&text) {
        let _ = (error.blamed_file(), error.text());
    }
}
