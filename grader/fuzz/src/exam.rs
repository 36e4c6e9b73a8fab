//! Exam files: an instructor's, from another version or a hand that slipped.

use std::path::Path;

use grader::exam_file::parse;
use grader::verdict::pending_score;
use protocol::wire;

/// A file that is taken can be asked, down to the bytes on the wire.
pub fn read(bytes: &[u8]) {
    match parse(Path::new("any.json"), bytes) {
        Err(bad) => assert!(!bad.to_string().is_empty()),
        Ok(file) => {
            pending_score(&file.exam, file.name(), "any");
            for item in &file.exam.items {
                for asked in &item.questions {
                    let _ = asked.question.max_answer_bytes();
                    wire::encode(7, &asked.question).expect("it can be asked");
                }
                assert!(item.element(item.count()).is_some());
            }
        }
    }
}
