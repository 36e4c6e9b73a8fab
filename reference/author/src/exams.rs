//! Whole exams.

use std::path::Path;

use grader::exam::{Exam, Item};
use grader::exam_file::{self, BadExam};

use crate::generated::Generated;
use crate::hints::with_hints;
use crate::items::{bbox, build, camera, sphere, traverse, triangle};
use crate::proof::exhibits::{Exhibits, NotProven};
use crate::proof::workbench::Workbench;
use crate::recorded::{NotRecorded, Recorded, Recorder};
use crate::seed::Seed;
use crate::shown::with_shown;

/// The version of the exam file's format.
const SCHEMA: u32 = 1;

/// What the practice exam follows from. It is handed out with its keys, so this is no secret.
const PRACTICE: Seed = Seed(2025);

/// Where the practice exam stands, from the workspace's root.
const PRACTICE_FILE: &str = "grader/exams/practice.json";

/// Why there is no exam.
#[derive(Debug, thiserror::Error)]
pub enum NoExam {
    /// What the reference and the mistakes must say was not said.
    #[error(transparent)]
    NotProven(#[from] NotProven),
    /// The exam can not be put into text.
    #[error("can not write the exam: {0}")]
    Text(#[from] serde_json::Error),
}

/// The files with exams in this repository.
pub fn generated() -> Result<Vec<Generated>, NoExam> {
    let practice = whole_text("practice", PRACTICE)?;
    Ok(vec![Generated::new(PRACTICE_FILE, practice)])
}

/// The practice exam that is committed in the workspace at `root`.
pub fn practice(root: &Path) -> Result<Exam, BadExam> {
    Ok(exam_file::load(Some(&root.join(PRACTICE_FILE)))?.exam)
}

/// The file of an exam of other questions about the same ideas.
pub fn final_text(seed: u64) -> Result<String, NoExam> {
    whole_text("final", Seed(seed))
}

fn whole_text(id: &str, seed: Seed) -> Result<String, NoExam> {
    let exhibits = Exhibits::prepare(Workbench::open().map_err(NotProven::from)?)?;
    let exam = whole(id, seed, &exhibits.recorder).map_err(NotProven::from)?;
    Ok(text(&with_shown(with_hints(exam, &exhibits)?))?)
}

/// A whole exam, with the reference's picture.
pub fn whole(id: &str, seed: Seed, recorder: &Recorder) -> Result<Exam, NotRecorded> {
    let recorded = recorder.cornell_box(|scene| traverse::radiance_question(seed, scene))?;
    Ok(exam(id, seed, recorded))
}

/// An exam: each item after those that it needs.
pub fn exam(id: &str, seed: Seed, recorded: Recorded) -> Exam {
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
fn text(exam: &Exam) -> Result<String, serde_json::Error> {
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
    use grader::tells::KnownMistake;

    use super::*;

    #[test]
    fn the_text_is_the_exam() {
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
        let text = text(&exam).unwrap();
        assert_eq!(serde_json::from_str::<Exam>(&text).unwrap(), exam);
        assert_eq!(
            text.lines().count(),
            exam.mistakes.len() + exam.items.len() + 3
        );
    }
}
