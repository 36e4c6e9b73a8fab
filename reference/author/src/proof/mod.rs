//! Tests that the exam catches every known mistake and gives full marks to correct code, by
//! grading many [solutions](crate::solutions).

pub mod calibrate;
pub mod catches;
pub mod failures;
pub mod grade;
pub mod matrix;
pub mod mutants;
mod progress;
pub mod prove;
pub mod recognition;
pub mod summary;

use grader::exam_source::ExamSourceError;
use grader::files::PathError;

use crate::solutions::SolutionsError;
use crate::solutions::recording::RecordingError;
use crate::solutions::workbench::WorkbenchError;

/// The reason why a proof cannot be run.
#[derive(Debug, thiserror::Error)]
pub enum ProofError {
    /// The solutions cannot be used.
    #[error(transparent)]
    Solutions(#[from] SolutionsError),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] PathError),
    /// A solution cannot be built or run.
    #[error(transparent)]
    Workbench(#[from] WorkbenchError),
    /// The practice exam cannot be used.
    #[error(transparent)]
    Exam(#[from] ExamSourceError),
    /// An exam's picture cannot be recorded.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// Mistakes do not lose the points that they must lose.
    #[error(
        "the practice exam and reference/mistakes do not agree; fix the items or the mistakes:\n{}",
        .0.join("\n")
    )]
    Problems(Vec<String>),
    /// The lists of failed items cannot be written as text.
    #[error("cannot write the lists of failed items: {0}")]
    FailedItems(#[from] toml::ser::Error),
}
