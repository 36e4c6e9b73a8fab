//! Exam files, which may come from a different version of the grader or have been edited by hand.

use std::path::Path;

use grader::handed_out::RAYS;
use grader::verdict::pending_score;
use judging::exam_file::parse;
use protocol::wire;

/// Reads the bytes as an exam. If the exam is valid, it must be possible to encode its questions.
pub fn read(bytes: &[u8]) {
    match parse(Path::new("any.json"), bytes, RAYS.assignment) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(file) => {
            pending_score(&file.exam, file.name(), "any", &RAYS);
            for item in &file.exam.items {
                for exam_question in &item.questions {
                    let _ = exam_question.question.max_answer_bytes();
                    wire::encode(7, &exam_question.question).expect("the question can be encoded");
                }
                assert!(item.element(item.count()).is_some());
            }
        }
    }
}
