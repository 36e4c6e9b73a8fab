//! Independent mistakes: known mistakes in the code of a variant, where they look as in the solution
//! of a student who never saw the reference. They are in `mistakes/independent/*.toml` in the folder
//! of an assignment's solutions.

use judging::assignment::Task;
use serde::Deserialize;

use crate::solutions::Solutions;
use crate::solutions::catalogue::{CatalogueError, Change, apply_changes, read_mistakes};
use crate::solutions::sources::Sources;

/// A known mistake in a variant.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IndependentMistake {
    /// The id of the known mistake.
    pub id: String,
    /// The id of the variant.
    pub variant: String,
    /// Other known mistakes that the changed code makes as well, because of how the variant is
    /// written. Their hints are true of it, too.
    #[serde(default)]
    pub also: Vec<String>,
    /// The changes to the variant, completed with its given code.
    #[serde(rename = "change")]
    pub changes: Vec<Change>,
}

/// The reason why independent mistakes cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum IndependentError {
    /// The files cannot be listed or read.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
    /// It names a mistake that is not known, or a variant that does not exist or solves other tasks.
    #[error(
        "{0}: the catalogue of mistakes must have all ids, and variants.toml the variant, which must \
         solve the mistake's task"
    )]
    Names(String),
    /// The text that it changes does not occur exactly once.
    #[error(
        "{name} no longer applies: its `was` occurs {count} times in {file} with its given code, \
         instead of once; adapt it in mistakes/independent"
    )]
    DoesNotApply {
        /// The ids of the mistake and the variant.
        name: String,
        /// The name of the file that it changes.
        file: String,
        /// The number of occurrences.
        count: usize,
    },
}

/// Reads the independent mistakes of an assignment, in the order of their files, and applies them to
/// their variants.
pub fn independent_mistakes(
    solutions: &Solutions,
) -> Result<Vec<(IndependentMistake, Sources)>, IndependentError> {
    let workbench = &solutions.workbench;
    let handed_out = workbench.handed_out();
    let folder = workbench
        .root()
        .join(handed_out.solutions())
        .join("mistakes/independent");
    let all = read_mistakes::<IndependentMistake>(&folder)?.into_iter();
    all.map(|(_, mistake)| {
        let sources = mistake.apply(solutions)?;
        Ok((mistake, sources))
    })
    .collect()
}

impl IndependentMistake {
    /// Returns the ids of the mistake and the variant, for people to read.
    pub fn name(&self) -> String {
        format!("{} in {}", self.id, self.variant)
    }

    /// Returns the variant with this mistake.
    pub fn apply(&self, solutions: &Solutions) -> Result<Sources, IndependentError> {
        let is_known = |id: &String| {
            let mut mistakes = solutions.mistakes.iter();
            mistakes.any(|(mistake, _)| mistake.id == *id)
        };
        let mut variants = solutions.variants.iter();
        let task = Task::in_id(&self.id).filter(|_| is_known(&self.id));
        let variant = variants.find(|(variant, _)| variant.id == self.variant);
        let found = task.zip(variant).filter(|(task, (variant, sources))| {
            let assignment = sources.handed_out().assignment;
            variant.tasks(assignment).contains(task) && self.also.iter().all(is_known)
        });
        let Some((_, (variant, sources))) = found else {
            return Err(IndependentError::Names(self.name()));
        };
        apply_changes(
            sources.clone(),
            &self.changes,
            &variant.file(),
            |file, count| IndependentError::DoesNotApply {
                name: self.name(),
                file: file.to_owned(),
                count,
            },
        )
    }
}
