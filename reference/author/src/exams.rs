//! Whole exams.

use std::path::Path;

use grader::exam::{Exam, Item};
use grader::exam_file::{self, ExamError};

use crate::drawing_data::with_drawing_data;
use crate::generated_file::GeneratedFile;
use crate::hints::with_hints;
use crate::items::{bbox, build, camera, sphere, traverse, triangle};
use crate::proof::solutions::{ProofError, Solutions};
use crate::proof::workbench::Workbench;
use crate::recording::{RecordedPicture, Recorder, RecordingError};
use crate::seed::Seed;

/// The version of the exam file's format.
const SCHEMA: u32 = 1;

/// What the practice exam follows from. It is handed out with its keys, so this is no secret.
const PRACTICE: Seed = Seed(2025);

/// Where the practice exam stands, from the workspace's root.
const PRACTICE_FILE: &str = "grader/exams/practice.json";

/// Why there is no exam.
#[derive(Debug, thiserror::Error)]
pub enum ExamGenerationError {
    /// What the reference and the mistakes must say was not said.
    #[error(transparent)]
    Solutions(#[from] ProofError),
    /// The exam can not be put into text.
    #[error("can not write the exam: {0}")]
    Text(#[from] serde_json::Error),
}

/// The files with exams in this repository.
pub fn generated_files() -> Result<Vec<GeneratedFile>, ExamGenerationError> {
    let practice = exam_text("practice", PRACTICE)?;
    Ok(vec![GeneratedFile::new(PRACTICE_FILE, practice)])
}

/// The practice exam that is committed in the workspace at `root`.
pub fn load_practice(root: &Path) -> Result<Exam, ExamError> {
    Ok(exam_file::load(Some(&root.join(PRACTICE_FILE)))?.exam)
}

/// The file of an exam of other questions about the same ideas.
pub fn final_exam_text(seed: u64) -> Result<String, ExamGenerationError> {
    exam_text("final", Seed(seed))
}

fn exam_text(id: &str, seed: Seed) -> Result<String, ExamGenerationError> {
    let exhibits = Solutions::load(Workbench::open().map_err(ProofError::from)?)?;
    let exam = generate(id, seed, &exhibits.recorder).map_err(ProofError::from)?;
    Ok(to_text(&with_drawing_data(with_hints(exam, &exhibits)?))?)
}

/// A whole exam, with the reference's picture.
pub fn generate(id: &str, seed: Seed, recorder: &Recorder) -> Result<Exam, RecordingError> {
    let recorded = recorder.record_cornell_box(|scene| traverse::radiance_question(seed, scene))?;
    Ok(assemble(id, seed, recorded))
}

/// An exam: each item after those that it needs.
pub fn assemble(id: &str, seed: Seed, recorded: RecordedPicture) -> Exam {
    let tasks: [fn(Seed) -> Vec<Item>; 6] = [
        camera::items,
        triangle::items,
        sphere::items,
        bbox::items,
        build::items,
        traverse::items,
    ];
    let items = tasks.into_iter().flat_map(|items| items(seed));
    Exam {
        schema: SCHEMA,
        id: id.to_owned(),
        mistakes: Vec::new(),
        items: items
            .chain([traverse::radiance_item(seed, recorded)])
            .collect(),
    }
}

/// The exam as a file: an item a line, so that a difference shows which items it is in.
fn to_text(exam: &Exam) -> Result<String, serde_json::Error> {
    let items: Vec<String> = exam
        .items
        .iter()
        .map(serde_json::to_string)
        .collect::<Result<_, _>>()?;
    let id = serde_json::to_string(&exam.id)?;
    let mistakes: Vec<String> = exam
        .mistakes
        .iter()
        .map(serde_json::to_string)
        .collect::<Result<_, _>>()?;
    let schema = exam.schema;
    let (mistakes, items) = (mistakes.join(",\n"), items.join(",\n"));
    Ok(format!(
        "{{\"schema\":{schema},\"id\":{id},\"mistakes\":[\n{mistakes}\n],\"items\":[\n{items}\n]}}\n"
    ))
}

#[cfg(test)]
mod tests {
    use grader::signatures::KnownMistake;

    use super::*;

    #[test]
    fn text_parses_back_to_the_exam() {
        let exam = Exam {
            schema: SCHEMA,
            id: "a \"test\"".to_owned(),
            mistakes: vec![KnownMistake {
                id: "bbox.none".to_owned(),
                nudge: "Really?".to_owned(),
                hint: "No.".to_owned(),
                section: None,
            }],
            items: bbox::items(Seed(1)),
        };
        let text = to_text(&exam).unwrap();
        assert_eq!(serde_json::from_str::<Exam>(&text).unwrap(), exam);
        assert_eq!(
            text.lines().count(),
            exam.mistakes.len() + exam.items.len() + 3
        );
    }
}
