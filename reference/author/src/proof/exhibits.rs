//! All that a proof asks: every mistake and every variant, put together from their files.

use std::io;
use std::path::PathBuf;

use grader::exam::{Exam, Item, Task};
use grader::exam_file::BadExam;
use rayon::prelude::*;

use crate::proof::catalogue::{BadCatalogue, Mistake, mistakes};
use crate::proof::sources::{Sources, Unreadable};
use crate::proof::tried::Tried;
use crate::proof::variants::{BadVariants, Variant, variants};
use crate::proof::workbench::{NotTried, Solution, Workbench};
use crate::recorded::{NotRecorded, Recorder};

/// There is no proof: our fault, or the machine's.
#[derive(Debug, thiserror::Error)]
pub enum NotProven {
    /// The mistakes can not be used.
    #[error(transparent)]
    Catalogue(#[from] BadCatalogue),
    /// The variants can not be used.
    #[error(transparent)]
    Variants(#[from] BadVariants),
    /// A file can not be read.
    #[error(transparent)]
    Unreadable(#[from] Unreadable),
    /// A solution can not be built or asked.
    #[error(transparent)]
    NotTried(#[from] NotTried),
    /// The practice exam can not be used.
    #[error(transparent)]
    Exam(#[from] BadExam),
    /// There is no exam.
    #[error(transparent)]
    NotRecorded(#[from] NotRecorded),
    /// Mistakes are not judged as they should be.
    #[error(
        "the practice exam and reference/mistakes do not agree; mend the items or the mistakes:\n{}",
        .0.join("\n")
    )]
    Problems(Vec<String>),
    /// There is nothing of this name to ask.
    #[error("there is no variant {0}: reference/variants/variants.toml lists them")]
    NoVariant(String),
    /// What was found out can not be kept.
    #[error("can not write {}: {source}", path.display())]
    Unwritable {
        /// Where.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// All that is asked.
#[derive(Debug)]
pub struct Exhibits {
    /// Wrong ones, in the order of the catalogue.
    pub mistakes: Vec<(Mistake, Sources)>,
    /// Right ones, in the order of the list.
    pub variants: Vec<(Variant, Sources)>,
    /// What builds them.
    pub workbench: Workbench,
    /// What draws the exams' pictures.
    pub recorder: Recorder,
}

impl Exhibits {
    /// Reads everything, and applies it to the reference.
    pub fn prepare(workbench: Workbench) -> Result<Self, NotProven> {
        let root = workbench.root();
        let reference = Sources::reference(root)?;
        let mistakes: Result<Vec<_>, BadCatalogue> = mistakes(root)?
            .into_iter()
            .map(|mistake| {
                let sources = mistake.apply(&reference)?;
                Ok((mistake, sources))
            })
            .collect();
        let variants: Result<Vec<_>, Unreadable> = variants(root)?
            .into_iter()
            .map(|variant| {
                let sources = variant.apply(&reference, root)?;
                Ok((variant, sources))
            })
            .collect();
        Ok(Exhibits {
            mistakes: mistakes?,
            variants: variants?,
            recorder: Recorder::open(&workbench)?,
            workbench,
        })
    }

    /// One variant alone, and no mistakes.
    pub fn only(mut self, id: &str) -> Result<Self, NotProven> {
        self.mistakes.clear();
        self.variants.retain(|(variant, _)| variant.id == id);
        match self.variants.len() {
            0 => Err(NotProven::NoVariant(id.to_owned())),
            _ => Ok(self),
        }
    }

    /// What every mistake earns in an exam.
    pub fn try_mistakes(&self, exam: &Exam) -> Result<Vec<Tried<'_>>, NotProven> {
        self.mistakes
            .par_iter()
            .map(|(mistake, sources)| self.tried(mistake, sources, exam))
            .collect()
    }

    /// What one mistake earns.
    pub fn tried<'a>(
        &self,
        mistake: &'a Mistake,
        sources: &Sources,
        exam: &Exam,
    ) -> Result<Tried<'a>, NotProven> {
        let score = self.solution(sources, &mistake.id)?.score(exam)?;
        Ok(Tried { mistake, score })
    }

    /// The items in which a variant loses points and should not.
    pub fn variant_losses(
        &self,
        variant: &Variant,
        sources: &Sources,
        exam: &Exam,
    ) -> Result<Vec<String>, NotProven> {
        let exam = what_rests_on(exam, &variant.tasks());
        let score = self.solution(sources, &variant.id)?.score(&exam)?;
        let lost = score.items().filter(|item| item.points < item.max_points);
        let lost = lost.filter(|item| !variant.may_lose.contains(&item.id));
        Ok(lost
            .map(|item| format!("{}: {}", item.id, item.message))
            .collect())
    }

    fn solution(&self, sources: &Sources, id: &str) -> Result<Solution, NotTried> {
        self.workbench.build(sources, id)
    }
}

/// The items of these tasks, and those that need one of them.
pub fn what_rests_on(exam: &Exam, tasks: &[Task]) -> Exam {
    let of_tasks = |id: &String| {
        let task = id.split('.').next();
        tasks.iter().any(|other| Some(other.id()) == task)
    };
    exam.only(|item: &Item| of_tasks(&item.id) || item.needs.iter().any(of_tasks))
}
