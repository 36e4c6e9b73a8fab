//! The solutions that a proof grades: every mistake and every variant.

use std::io;
use std::path::PathBuf;

use grader::exam_source::ExamSourceError;
use judging::exam::{Exam, Item, Task};
use rayon::prelude::*;

use crate::proof::catalogue::{CatalogueError, Mistake, mistakes};
use crate::proof::graded_mistake::GradedMistake;
use crate::proof::sources::{ReadError, Sources};
use crate::proof::variants::{Variant, VariantsError, variants};
use crate::proof::workbench::{BuiltSolution, Workbench, WorkbenchError};
use crate::recording::{Recorder, RecordingError};

/// The reason why a proof cannot be run.
#[derive(Debug, thiserror::Error)]
pub enum ProofError {
    /// The mistakes cannot be used.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
    /// The variants cannot be used.
    #[error(transparent)]
    Variants(#[from] VariantsError),
    /// A file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A solution cannot be built or run.
    #[error(transparent)]
    Workbench(#[from] WorkbenchError),
    /// The practice exam cannot be used.
    #[error(transparent)]
    Exam(#[from] ExamSourceError),
    /// The exam's picture cannot be recorded.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// Some mistakes do not lose the points that they must lose.
    #[error(
        "the practice exam and reference/mistakes do not agree; fix the items or the mistakes:\n{}",
        .0.join("\n")
    )]
    Problems(Vec<String>),
    /// There is no variant with this id.
    #[error("there is no variant {0}: see reference/variants/variants.toml for a list")]
    UnknownVariant(String),
    /// Results cannot be saved.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
}

/// The known mistakes and variants with their sources, and the tools to build and grade them.
#[derive(Debug)]
pub struct Solutions {
    /// Known wrong solutions, in the order of the catalogue.
    pub mistakes: Vec<(Mistake, Sources)>,
    /// Known correct solutions, in the order of `variants.toml`.
    pub variants: Vec<(Variant, Sources)>,
    /// The workbench that builds the solutions.
    pub workbench: Workbench,
    /// The recorder of the exams' pictures.
    pub recorder: Recorder,
}

impl Solutions {
    /// Reads all mistakes and variants, and applies them to the reference.
    pub fn load(workbench: Workbench) -> Result<Self, ProofError> {
        let root = workbench.root();
        let reference = Sources::reference(root)?;
        let mistakes: Result<Vec<_>, CatalogueError> = mistakes(root)?
            .into_iter()
            .map(|mistake| {
                let sources = mistake.apply(&reference)?;
                Ok((mistake, sources))
            })
            .collect();
        let variants: Result<Vec<_>, ReadError> = variants(root)?
            .into_iter()
            .map(|variant| {
                let sources = variant.apply(&reference, root)?;
                Ok((variant, sources))
            })
            .collect();
        Ok(Solutions {
            mistakes: mistakes?,
            variants: variants?,
            recorder: Recorder::open(&workbench)?,
            workbench,
        })
    }

    /// Keeps only this variant, and drops all other variants and all mistakes.
    pub fn only_variant(mut self, id: &str) -> Result<Self, ProofError> {
        self.mistakes.clear();
        self.variants.retain(|(variant, _)| variant.id == id);
        match self.variants.len() {
            0 => Err(ProofError::UnknownVariant(id.to_owned())),
            _ => Ok(self),
        }
    }

    /// Grades every mistake with an exam.
    pub fn grade_mistakes(&self, exam: &Exam) -> Result<Vec<GradedMistake<'_>>, ProofError> {
        self.mistakes
            .par_iter()
            .map(|(mistake, sources)| self.grade_mistake(mistake, sources, exam))
            .collect()
    }

    /// Grades one mistake with an exam.
    pub fn grade_mistake<'a>(
        &self,
        mistake: &'a Mistake,
        sources: &Sources,
        exam: &Exam,
    ) -> Result<GradedMistake<'a>, ProofError> {
        let score = self.build(sources, &mistake.id)?.score(exam)?;
        Ok(GradedMistake { mistake, score })
    }

    /// Returns the items in which a variant loses points although it must not.
    pub fn variant_losses(
        &self,
        variant: &Variant,
        sources: &Sources,
        exam: &Exam,
    ) -> Result<Vec<String>, ProofError> {
        let exam = tasks_and_dependents(exam, &variant.tasks());
        let score = self.build(sources, &variant.id)?.score(&exam)?;
        let lost = score.items().filter(|item| item.points < item.max_points);
        let lost = lost.filter(|item| !variant.may_lose.contains(&item.id));
        Ok(lost
            .map(|item| format!("{}: {}", item.id, item.message))
            .collect())
    }

    fn build(&self, sources: &Sources, id: &str) -> Result<BuiltSolution, WorkbenchError> {
        self.workbench.build(sources, id)
    }
}

/// Returns the exam with only the items of these tasks and the items that depend on one of them.
pub fn tasks_and_dependents(exam: &Exam, tasks: &[Task]) -> Exam {
    let of_tasks = |id: &String| {
        let task = id.split('.').next();
        tasks.iter().any(|other| Some(other.id()) == task)
    };
    exam.filter_items(|item: &Item| of_tasks(&item.id) || item.needs.iter().any(of_tasks))
}
