//! Reads, builds and runs the solutions in this repository: the reference, known mistakes, known
//! correct variants and mutants.
//!
//! `reference/mistakes` contains mistakes, which are small changes to the reference or to a
//! variant. `reference/variants` contains other correct solutions, and [`mutants`] makes mechanical
//! changes. Each solution is built and run like any submission. The exams' recorded keys and hints
//! come from solutions, and the proof grades the solutions.

pub mod catalogue;
pub mod failed_items;
pub mod methods;
pub mod mutants;
pub mod recording;
pub mod solution;
pub mod sources;
pub mod variants;
pub mod workbench;

use std::path::Path;

use anyhow::{Result, anyhow, bail};
use grader::files;
use grader::task_selection::TaskSelection;
use serde::de::DeserializeOwned;

use crate::solutions::catalogue::{Mistake, mistakes, mistakes_in_other_forms};
use crate::solutions::failed_items::FailedItems;
use crate::solutions::recording::Recorder;
use crate::solutions::solution::Solution;
use crate::solutions::variants::variants;
use crate::solutions::workbench::Workbench;

/// The known mistakes and variants, and the tools to build and run them.
#[derive(Debug)]
pub struct Solutions {
    /// The catalogue of known mistakes, with their hints.
    pub catalogue: Vec<Mistake>,
    /// Known wrong solutions, in the order of the catalogue.
    pub mistakes: Vec<Solution>,
    /// The known mistakes in other forms of the reference's code.
    pub mistakes_in_other_forms: Vec<Solution>,
    /// Known correct solutions, in the order of the list.
    pub variants: Vec<Solution>,
    /// The workbench that builds the solutions.
    pub workbench: Workbench,
    /// The recorder for the exams' pictures.
    pub recorder: Recorder,
}

impl Solutions {
    /// Reads all mistakes and variants and applies the mistakes to the reference.
    pub fn load(workbench: Workbench) -> Result<Self> {
        let root = workbench.root();
        let handed_out = workbench.handed_out();
        let recorder = Recorder::open(&workbench)?;
        let catalogue = mistakes(root, handed_out)?;
        let applied = catalogue.iter();
        let applied = applied.map(|mistake| mistake.solution(recorder.reference()));
        let variants = variants(root, handed_out)?.into_iter();
        let variants = variants.map(|variant| variant.solution(recorder.reference(), root));
        let in_other_forms = mistakes_in_other_forms(root, &catalogue, recorder.reference())?;
        let failed = FailedItems::load(root, handed_out)?;
        let mut solutions = Solutions {
            mistakes: applied.collect::<Result<_>>()?,
            mistakes_in_other_forms: in_other_forms,
            variants: variants.collect::<Result<_>>()?,
            catalogue,
            recorder,
            workbench,
        };
        solutions.set_failed_items(&failed);
        Ok(solutions)
    }

    /// Updates the lists of items that the mistakes fail regardless of the seed.
    pub fn set_failed_items(&mut self, failed: &FailedItems) {
        for mistake in &mut self.mistakes {
            mistake.expected.fails = failed.of_mistake(&mistake.id).to_vec();
        }
    }

    /// Returns a known mistake.
    pub fn mistake(&self, id: &str) -> Option<&Solution> {
        self.mistakes.iter().find(|mistake| mistake.id == id)
    }

    /// Returns whether two mistakes, identified by their ids, share a hint.
    pub fn have_same_hint(&self, one: &str, other: &str) -> bool {
        let hint = |id: &str| {
            let mut mistakes = self.catalogue.iter();
            mistakes.find(|mistake| mistake.id == id).map(|m| &m.hint)
        };
        hint(one) == hint(other)
    }

    /// Returns whether the first mistake's hint is also true for the second mistake.
    pub fn is_hint_true_of(&self, hint: &str, mistake: &str) -> bool {
        let mut fits = self.catalogue.iter().filter(|other| {
            let true_of = other.also_true_of.iter().any(|id| id == mistake);
            true_of || other.id == mistake
        });
        fits.any(|other| self.have_same_hint(&other.id, hint))
    }

    /// Returns whether a mistake's hint is true for code with both mistakes of a pair. All mistakes
    /// are identified by their ids.
    pub fn is_hint_true_of_pair(&self, hint: &str, pair: [&str; 2]) -> bool {
        let is_pair = |[one, other]: &[String; 2]| {
            pair == [one.as_str(), other.as_str()] || pair == [other.as_str(), one.as_str()]
        };
        let mut mistakes = self.catalogue.iter();
        pair.into_iter()
            .any(|mistake| self.is_hint_true_of(hint, mistake))
            || mistakes.any(|mistake| {
                mistake.true_of_pairs.iter().any(is_pair) && self.have_same_hint(&mistake.id, hint)
            })
    }

    /// Keeps the mistakes in these tasks and drops all other mistakes.
    pub fn only_mistakes(mut self, tasks: &TaskSelection) -> Self {
        self.mistakes
            .retain(|mistake| tasks.includes(mistake.task()));
        self
    }

    /// Keeps one variant and drops all other variants and all mistakes.
    pub fn only_variant(mut self, id: &str) -> Result<Self> {
        self.mistakes.clear();
        self.variants.retain(|variant| variant.id == id);
        if self.variants.is_empty() {
            let folder = self.workbench.handed_out().solutions();
            bail!("unknown variant {id}: see {folder}/variants/variants.toml for a list");
        }
        Ok(self)
    }
}

/// Reads a TOML file. If the file isn't valid TOML or doesn't have the expected keys, the error
/// says where.
pub fn read_toml<T: DeserializeOwned>(path: &Path) -> Result<T> {
    let text = files::read_to_string(path)?;
    toml::from_str(&text).map_err(|error| anyhow!("{}: {error}", path.display()))
}
