//! The solutions of this repository: the reference, known mistakes, known correct variants, and
//! mutants; how they are read, built and run.
//!
//! `reference/mistakes` contains known mistakes, which are small changes to the reference,
//! `reference/variants` other correct solutions, and `reference/mutants` mechanical changes. Each
//! is built and run like any submission. The exams take their recorded keys and their hints from
//! solutions, and the proof grades them.

pub mod catalogue;
pub mod failed_items;
pub mod independent;
pub mod mutants;
pub mod recording;
pub mod sources;
pub mod toml_file;
pub mod unknown;
pub mod variants;
pub mod workbench;

use grader::files::PathError;

use crate::solutions::catalogue::{CatalogueError, Mistake, mistakes};
use crate::solutions::failed_items::FailedItems;
use crate::solutions::independent::IndependentError;
use crate::solutions::recording::{Recorder, RecordingError};
use crate::solutions::sources::Sources;
use crate::solutions::toml_file::TomlFileError;
use crate::solutions::unknown::UnknownError;
use crate::solutions::variants::{Variant, VariantError, variants};
use crate::solutions::workbench::{Workbench, WorkbenchError};

/// The reason why solutions cannot be read, built or run.
#[derive(Debug, thiserror::Error)]
pub enum SolutionsError {
    /// The mistakes cannot be used.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
    /// The list of variants cannot be used.
    #[error(transparent)]
    Variants(#[from] TomlFileError),
    /// A variant cannot be used.
    #[error(transparent)]
    Variant(#[from] VariantError),
    /// A file cannot be read.
    #[error(transparent)]
    File(#[from] PathError),
    /// A solution cannot be built or run.
    #[error(transparent)]
    Workbench(#[from] WorkbenchError),
    /// The exam's picture cannot be recorded.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// An independent mistake cannot be used.
    #[error(transparent)]
    Independent(Box<IndependentError>),
    /// The unknown mistakes cannot be used.
    #[error(transparent)]
    Unknown(Box<UnknownError>),
    /// There is no variant with this id.
    #[error("there is no variant {0}: see reference/variants/variants.toml for a list")]
    UnknownVariant(String),
}

impl From<UnknownError> for SolutionsError {
    fn from(error: UnknownError) -> Self {
        SolutionsError::Unknown(Box::new(error))
    }
}

impl From<IndependentError> for SolutionsError {
    fn from(error: IndependentError) -> Self {
        SolutionsError::Independent(Box::new(error))
    }
}

/// The known mistakes and variants with their sources, and the means to build and run them.
#[derive(Debug)]
pub struct Solutions {
    /// Known wrong solutions, in the order of the catalogue.
    pub mistakes: Vec<(Mistake, Sources)>,
    /// Known correct solutions, in the order of the list.
    pub variants: Vec<(Variant, Sources)>,
    /// The workbench that builds the solutions.
    pub workbench: Workbench,
    /// The recorder of the exams' pictures.
    pub recorder: Recorder,
}

impl Solutions {
    /// Reads all mistakes and variants, and applies them to the reference.
    pub fn load(workbench: Workbench) -> Result<Self, SolutionsError> {
        let root = workbench.root();
        let handed_out = workbench.handed_out();
        let reference = Sources::reference(root, handed_out)?;
        let mistakes: Result<Vec<_>, CatalogueError> = mistakes(root, handed_out)?
            .into_iter()
            .map(|mistake| {
                let sources = mistake.apply(&reference)?;
                Ok((mistake, sources))
            })
            .collect();
        let variants: Result<Vec<_>, VariantError> = variants(root)?
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

    /// Replaces the lists of the items that each mistake fails with every seed.
    pub fn set_failed_items(&mut self, failed: &FailedItems) {
        for (mistake, _) in &mut self.mistakes {
            mistake.fails = failed.of_mistake(&mistake.id).to_vec();
        }
    }

    /// Returns whether two mistakes, given by their ids, have the same hint.
    pub fn have_same_hint(&self, one: &str, other: &str) -> bool {
        let hint = |id: &str| {
            let mut mistakes = self.mistakes.iter().map(|(mistake, _)| mistake);
            mistakes.find(|mistake| mistake.id == id).map(|m| &m.hint)
        };
        hint(one) == hint(other)
    }

    /// Returns whether the hint of the first mistake is true of the second.
    pub fn is_hint_true_of(&self, hint: &str, mistake: &str) -> bool {
        let mut fits = self.mistakes.iter().filter(|(other, _)| {
            let true_of = other.also_true_of.iter().any(|id| id == mistake);
            true_of || other.id == mistake
        });
        fits.any(|(other, _)| self.have_same_hint(&other.id, hint))
    }

    /// Returns whether the hint of a mistake is true of code that makes two others, given by their ids.
    pub fn is_hint_true_of_pair(&self, hint: &str, pair: [&str; 2]) -> bool {
        let is_pair = |[one, other]: &[String; 2]| {
            pair == [one.as_str(), other.as_str()] || pair == [other.as_str(), one.as_str()]
        };
        let mut mistakes = self.mistakes.iter().map(|(mistake, _)| mistake);
        pair.into_iter()
            .any(|mistake| self.is_hint_true_of(hint, mistake))
            || mistakes.any(|mistake| {
                mistake.true_of_pairs.iter().any(is_pair) && self.have_same_hint(&mistake.id, hint)
            })
    }

    /// Keeps one variant, and drops all others and the mistakes.
    pub fn only_variant(mut self, id: &str) -> Result<Self, SolutionsError> {
        self.mistakes.clear();
        self.variants.retain(|(variant, _)| variant.id == id);
        match self.variants.len() {
            0 => Err(SolutionsError::UnknownVariant(id.to_owned())),
            _ => Ok(self),
        }
    }
}
