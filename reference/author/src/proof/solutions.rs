//! All that a proof asks: every mistake and every variant, put together from their files.

use std::io;
use std::path::PathBuf;

use grader::exam::{Exam, Item, Task};
use grader::exam_file::ExamError;
use rayon::prelude::*;

use crate::proof::catalogue::{CatalogueError, Mistake, mistakes};
use crate::proof::graded_mistake::GradedMistake;
use crate::proof::sources::{ReadError, Sources};
use crate::proof::variants::{Variant, VariantsError, variants};
use crate::proof::workbench::{BuiltSolution, Workbench, WorkbenchError};
use crate::recording::{Recorder, RecordingError};

/// There is no proof: our fault, or the machine's.
#[derive(Debug, thiserror::Error)]
pub enum ProofError {
    /// The mistakes can not be used.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
    /// The variants can not be used.
    #[error(transparent)]
    Variants(#[from] VariantsError),
    /// A file can not be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A solution can not be built or asked.
    #[error(transparent)]
    Workbench(#[from] WorkbenchError),
    /// The practice exam can not be used.
    #[error(transparent)]
    Exam(#[from] ExamError),
    /// There is no exam.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// Mistakes are not judged as they should be.
    #[error(
        "the practice exam and reference/mistakes do not agree; mend the items or the mistakes:\n{}",
        .0.join("\n")
    )]
    Problems(Vec<String>),
    /// There is nothing of this name to ask.
    #[error("there is no variant {0}: reference/variants/variants.toml lists them")]
    UnknownVariant(String),
    /// What was found out can not be kept.
    #[error("can not write {}: {source}", path.display())]
    Write {
        /// Where.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// All that is asked.
#[derive(Debug)]
pub struct Solutions {
    /// Wrong ones, in the order of the catalogue.
    pub mistakes: Vec<(Mistake, Sources)>,
    /// Right ones, in the order of the list.
    pub variants: Vec<(Variant, Sources)>,
    /// What builds them.
    pub workbench: Workbench,
    /// What draws the exams' pictures.
    pub recorder: Recorder,
}

impl Solutions {
    /// Reads everything, and applies it to the reference.
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

    /// One variant alone, and no mistakes.
    pub fn only_variant(mut self, id: &str) -> Result<Self, ProofError> {
        self.mistakes.clear();
        self.variants.retain(|(variant, _)| variant.id == id);
        match self.variants.len() {
            0 => Err(ProofError::UnknownVariant(id.to_owned())),
            _ => Ok(self),
        }
    }

    /// What every mistake earns in an exam.
    pub fn grade_mistakes(&self, exam: &Exam) -> Result<Vec<GradedMistake<'_>>, ProofError> {
        self.mistakes
            .par_iter()
            .map(|(mistake, sources)| self.grade_mistake(mistake, sources, exam))
            .collect()
    }

    /// What one mistake earns.
    pub fn grade_mistake<'a>(
        &self,
        mistake: &'a Mistake,
        sources: &Sources,
        exam: &Exam,
    ) -> Result<GradedMistake<'a>, ProofError> {
        let score = self.build(sources, &mistake.id)?.score(exam)?;
        Ok(GradedMistake { mistake, score })
    }

    /// The items in which a variant loses points and should not.
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

/// The items of these tasks, and those that need one of them.
pub fn tasks_and_dependents(exam: &Exam, tasks: &[Task]) -> Exam {
    let of_tasks = |id: &String| {
        let task = id.split('.').next();
        tasks.iter().any(|other| Some(other.id()) == task)
    };
    exam.filter_items(|item: &Item| of_tasks(&item.id) || item.needs.iter().any(of_tasks))
}
