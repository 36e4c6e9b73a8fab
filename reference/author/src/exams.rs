//! Generates exams and their files.

use std::path::Path;

use anyhow::{Result, bail};
use grader::error::Error;
use grader::exam_source::ExamSource;
use judging::exam::Exam;
use serde::Serialize;

use crate::authoring::Authoring;
use crate::drawing_data::with_drawing_data;
use crate::generated_file::GeneratedFile;
use crate::hints::with_hints;
use crate::items;
use crate::seed::Seed;
use crate::solutions::Solutions;
use crate::solutions::workbench::Workbench;

/// Generates the file with an assignment's practice exam.
pub fn generated_file(authoring: &'static Authoring) -> Result<GeneratedFile> {
    let practice = exam_text(authoring, "practice", Seed::PRACTICE)?;
    Ok(GeneratedFile::new(authoring.practice_exam, practice))
}

/// Reads the committed practice exam of the workspace at `root`.
pub fn load_practice(root: &Path, authoring: &Authoring) -> Result<Exam, Error> {
    let file = ExamSource::File(root.join(authoring.practice_exam));
    Ok(file.load(authoring.handed_out)?.exam)
}

/// Generates the text of a final exam. Its questions test the same ideas as the practice exam, with
/// different numbers.
pub fn final_exam_text(authoring: &'static Authoring, seed: u64) -> Result<String> {
    if Seed(seed) == Seed::PRACTICE {
        bail!("seed {seed} belongs to the practice exam; choose a different one");
    }
    exam_text(authoring, "final", Seed(seed))
}

fn exam_text(authoring: &'static Authoring, id: &str, seed: Seed) -> Result<String> {
    let solutions = Solutions::load(Workbench::open(authoring)?)?;
    let exam = generate(id, seed, &solutions)?;
    Ok(to_text(&with_drawing_data(with_hints(exam, &solutions)?))?)
}

/// Generates an exam without hints. The reference renders its pictures.
pub fn generate(id: &str, seed: Seed, solutions: &Solutions) -> Result<Exam> {
    let exam = assemble(solutions.workbench.authoring(), id, seed)?;
    solutions.recorder.record(exam)
}

/// Assembles an exam without hints or recorded pictures. Each item comes after the items it needs.
/// A final exam shares no question with the practice exam that students have.
pub fn assemble(authoring: &Authoring, id: &str, seed: Seed) -> Result<Exam> {
    let handed_out = authoring.handed_out;
    let practice = if seed == Seed::PRACTICE {
        Vec::new()
    } else {
        ExamSource::Practice.load(handed_out)?.exam.items
    };
    let items = items::items(authoring.tasks, seed, &practice);
    Ok(Exam::new(handed_out.assignment, id, items))
}

/// Writes the exam as JSON with one item per line, so that a diff shows which items changed.
fn to_text(exam: &Exam) -> Result<String, serde_json::Error> {
    let (mistakes, items) = (json_lines(&exam.mistakes)?, json_lines(&exam.items)?);
    // Let serde write the fields before the two lists.
    let empty = Exam {
        mistakes: Vec::new(),
        ..exam.filter_items(|_| false)
    };
    let empty = serde_json::to_string(&empty)?;
    let head = empty
        .strip_suffix("\"items\":[]}")
        .expect("the items are the last field");
    Ok(format!(
        "{head}\"mistakes\":[\n{mistakes}\n],\"items\":[\n{items}\n]}}\n"
    ))
}

/// Returns the elements of a JSON list, one per line.
fn json_lines(values: &[impl Serialize]) -> Result<String, serde_json::Error> {
    let lines = values.iter().map(serde_json::to_string);
    Ok(lines.collect::<Result<Vec<String>, _>>()?.join(",\n"))
}

#[cfg(test)]
mod tests {
    use judging::signatures::KnownMistake;

    use super::*;
    use crate::authoring::RAYS;

    #[test]
    fn the_practice_seed_gives_no_final_exam() {
        let error = final_exam_text(&RAYS, Seed::PRACTICE.0).unwrap_err();
        assert_eq!(
            error.to_string(),
            "seed 2025 belongs to the practice exam; choose a different one"
        );
    }

    #[test]
    fn text_parses_back_to_the_exam() {
        let exam = Exam {
            assignment: "another".to_owned(),
            mistakes: vec![KnownMistake {
                id: "bbox.none".to_owned(),
                nudge: "Really?".to_owned(),
                hint: "No.".to_owned(),
                section: None,
            }],
            ..items::exam_of_boxes()
        };
        let text = to_text(&exam).unwrap();
        assert_eq!(serde_json::from_str::<Exam>(&text).unwrap(), exam);
        assert_eq!(
            text.lines().count(),
            exam.mistakes.len() + exam.items.len() + 3
        );
    }
}
