//! Parses and validates exam files. An invalid exam is rejected before any question is sent.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use glam::UVec2;
use protocol::{LightQuestion, Question};
use serde::{Deserialize, Serialize};

use crate::assignment::Assignment;
use crate::content_hash::file_hash;
use crate::exam::{Exam, Item, Key};
use crate::judge::table::judged_quantities;

/// Maximum number of pixels along one side of a picture. The committed exams use 64.
const MAX_PICTURE_SIDE: u32 = 4096;

/// An exam and the hash of its file.
#[derive(Clone, Debug)]
pub struct ExamFile {
    /// The exam that the file contains.
    pub exam: Exam,
    /// BLAKE2b hash of the file's bytes, in hexadecimal.
    pub hash: String,
}

/// The name of an exam and the hash of its file, which together identify it.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ExamName {
    /// Name of the exam, such as `practice`.
    pub id: String,
    /// Hash of the exam file's bytes.
    pub hash: String,
}

impl ExamFile {
    /// Returns the name and the hash, which are written to the score.
    pub fn name(&self) -> ExamName {
        ExamName {
            id: self.exam.id.clone(),
            hash: self.hash.clone(),
        }
    }
}

/// Reasons for rejecting an exam.
#[derive(Debug, thiserror::Error)]
pub enum ExamError {
    /// The file is not JSON, or not an exam.
    #[error(
        "the exam {path} is not valid: {source}; `cargo author exam --seed S` writes a valid one"
    )]
    Json {
        /// Path of the exam file.
        path: PathBuf,
        /// Line, column and cause.
        source: serde_json::Error,
    },
    /// The file is an exam, but not a valid one.
    #[error(
        "the exam {path} is not valid: {problem}; `cargo author exam --seed S` writes a valid one"
    )]
    Invalid {
        /// Path of the exam file.
        path: PathBuf,
        /// The first problem found.
        problem: String,
    },
}

/// Parses and validates the bytes of an exam file for an assignment. `path` is only used in error
/// messages.
pub fn parse(path: &Path, bytes: &[u8], assignment: &Assignment) -> Result<ExamFile, ExamError> {
    let invalid = |problem| ExamError::Invalid {
        path: path.to_owned(),
        problem,
    };
    let exam: Exam = serde_json::from_slice(bytes).map_err(|source| {
        // A file in another format may have other fields, so a message about the version is more
        // helpful than the parser's error.
        let format: Option<Format> = serde_json::from_slice(bytes).ok();
        let other = format.and_then(|format| format_problem(format.schema));
        other.map_or_else(
            || ExamError::Json {
                path: path.to_owned(),
                source,
            },
            invalid,
        )
    })?;
    match problem(&exam, assignment) {
        Some(problem) => Err(invalid(problem)),
        None => Ok(ExamFile {
            exam,
            hash: file_hash(bytes),
        }),
    }
}

/// The version of an exam file's format. Every version of the format has this field.
#[derive(Deserialize)]
struct Format {
    schema: u32,
}

/// The assignment that an exam file is for.
#[derive(Deserialize)]
struct ForAssignment {
    assignment: String,
}

/// Returns the id of the assignment that an exam file is for, or `None` if the file doesn't name
/// one. The exam need not be valid.
pub fn assignment_id(bytes: &[u8]) -> Option<String> {
    let exam: Option<ForAssignment> = serde_json::from_slice(bytes).ok();
    exam.map(|exam| exam.assignment)
}

/// Returns the problem to report if the file's format isn't the version that this grader reads.
fn format_problem(schema: u32) -> Option<String> {
    (schema != Exam::SCHEMA).then(|| {
        let known = Exam::SCHEMA;
        format!("its format is version {schema}, but this grader reads version {known}")
    })
}

/// Returns the first problem found in an exam, if any.
fn problem(exam: &Exam, assignment: &Assignment) -> Option<String> {
    if let Some(problem) = format_problem(exam.schema) {
        return Some(problem);
    }
    if exam.assignment != assignment.id {
        return Some(format!(
            "it is for the assignment `{}`, but this grader grades `{}`",
            exam.assignment, assignment.id
        ));
    }
    if exam.items.is_empty() {
        return Some("it has no items".to_owned());
    }
    let mut ids_before = BTreeSet::new();
    for item in &exam.items {
        let problem = unknown_task(item, assignment);
        let problem = problem.or_else(|| item_problem(item, &ids_before));
        let problem = problem.or_else(|| signatures_problem(item, exam.mistakes.len()));
        if let Some(problem) = problem {
            return Some(format!("item {}: {problem}", item.id));
        }
        ids_before.insert(item.id.as_str());
    }
    None
}

/// Returns a message if the item's task doesn't belong to the assignment.
fn unknown_task(item: &Item, assignment: &Assignment) -> Option<String> {
    if assignment.find(item.task.id()).is_some() {
        return None;
    }
    Some(format!(
        "unknown task `{}`; the tasks are {}",
        item.task,
        assignment.id_list()
    ))
}

fn item_problem(item: &Item, ids_before: &BTreeSet<&str>) -> Option<String> {
    if !item.id.starts_with(&format!("{}.", item.task)) {
        return Some(format!("its id does not start with `{}.`", item.task));
    }
    if ids_before.contains(item.id.as_str()) {
        return Some("another item has the same id".to_owned());
    }
    if let Some(needed) = item
        .needs
        .iter()
        .find(|id| !ids_before.contains(id.as_str()))
    {
        return Some(format!("it needs `{needed}`, which must come before it"));
    }
    if item.points == 0 || item.questions.is_empty() {
        return Some("it has no points or no questions".to_owned());
    }
    let question_problem = |(number, question): (usize, &crate::exam::ExamQuestion)| {
        if let Some(film) = question
            .question
            .film()
            .filter(|film| film.max_element() > MAX_PICTURE_SIDE)
        {
            let UVec2 { x, y } = film;
            return Some(format!(
                "question {number} asks for {x} x {y} pixels; the maximum is {MAX_PICTURE_SIDE} per side"
            ));
        }
        let (fits, keys) = match_key(&question.question, &question.key);
        let count = question.question.count();
        match (fits, keys == count) {
            (false, _) => Some(format!(
                "question {number} has a key for a different kind of question"
            )),
            (true, false) => Some(format!(
                "question {number} has {count} elements, but its key has {keys}"
            )),
            (true, true) => {
                let problem = question.drawing_data.problem(&question.question)?;
                Some(format!("question {number}: {problem}"))
            }
        }
    };
    (1..).zip(&item.questions).find_map(question_problem)
}

/// Returns the reason that the item's signatures are invalid, or `None` if they are valid.
fn signatures_problem(item: &Item, mistakes: usize) -> Option<String> {
    let count: usize = item
        .questions
        .iter()
        .map(|question| question.question.count())
        .sum();
    let signatures = &item.signatures;
    let has_bad_element = signatures
        .elements
        .iter()
        .any(|element| *element as usize >= count);
    let has_bad_mistake = signatures.mistake_answers.iter().any(|mistake| {
        let answers = mistake.answers.iter();
        mistake
            .mistakes
            .iter()
            .any(|index| *index as usize >= mistakes)
            || answers
                .map(|(index, _)| *index as usize)
                .any(|index| index >= signatures.elements.len())
    });
    (has_bad_element
        || has_bad_mistake
        || signatures.correct_answers.len() != signatures.elements.len())
    .then(|| "its signatures refer to unknown mistakes or elements".to_owned())
}

/// Returns whether the key fits the question. Also returns the number of elements in the key.
fn match_key(question: &Question, key: &Key) -> (bool, usize) {
    match (key, question) {
        (Key::Table { judged, rows, .. }, question) => {
            let fits = question
                .table()
                .is_some_and(|table| judged_quantities(table, judged, rows).is_some());
            (fits, rows.count())
        }
        (Key::FirstHits { hits, alternatives }, Question::Hit(table)) => {
            let inside = alternatives
                .iter()
                .all(|(index, _)| (*index as usize) < hits.len());
            (table.rows.view().is_some() && inside, hits.len())
        }
        (Key::Tree { .. }, Question::Build { .. }) => (true, 1),
        (Key::Radiance { pixels, .. }, Question::Radiance { film, .. }) => {
            let all = film.x as usize * film.y as usize;
            (pixels.len() == all, 1)
        }
        (Key::SpreadEvenly { .. }, Question::Light(LightQuestion::UniformSphere(table))) => {
            (true, table.rows.count())
        }
        (
            Key::FirstHits { .. }
            | Key::SpreadEvenly { .. }
            | Key::Tree { .. }
            | Key::Radiance { .. },
            _,
        ) => (false, 0),
    }
}
