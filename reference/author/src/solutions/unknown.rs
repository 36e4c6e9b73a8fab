//! Wrong solutions of no known kind: `mistakes/unknown/*.toml` in the folder of an assignment's
//! solutions. They are changes to the reference. No hint is written for them, so they tell whether
//! wrong code gets a hint that is not true of it.

use judging::assignment::Task;
use serde::Deserialize;

use crate::solutions::Solutions;
use crate::solutions::catalogue::{CatalogueError, Change, Mistake, read_mistakes};
use crate::solutions::sources::Sources;

/// A wrong solution of no known kind.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UnknownMistake {
    /// The task's id, a dot, and a name that no known mistake has.
    pub id: String,
    /// A description of what the wrong code does.
    pub title: String,
    /// The known mistakes whose hints are true of it all the same.
    #[serde(default)]
    pub true_hints: Vec<String>,
    /// The changes to the reference.
    #[serde(rename = "change")]
    pub changes: Vec<Change>,
}

/// The reason why unknown mistakes cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum UnknownError {
    /// The files cannot be listed or read, or a change does not apply.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
    /// Its id is that of a known mistake or of no task, or one of its hints does not exist.
    #[error(
        "{0} in mistakes/unknown: its id must begin with a task and a dot, and be no known mistake's; \
         `true_hints` names known mistakes"
    )]
    Names(String),
}

/// Reads the unknown mistakes of an assignment, in the order of their files, and applies them to the
/// reference.
pub fn unknown_mistakes(
    solutions: &Solutions,
    reference: &Sources,
) -> Result<Vec<(UnknownMistake, Mistake, Sources)>, UnknownError> {
    let workbench = &solutions.workbench;
    let handed_out = workbench.handed_out();
    let folder = workbench
        .root()
        .join(handed_out.solutions())
        .join("mistakes/unknown");
    let mut all = Vec::new();
    for (_, unknown) in read_mistakes::<UnknownMistake>(&folder)? {
        let is_known = |id: &String| {
            let mut known = solutions.mistakes.iter();
            known.any(|(mistake, _)| mistake.id == *id)
        };
        let has_task = Task::in_id(&unknown.id).is_some();
        if !has_task || is_known(&unknown.id) || !unknown.true_hints.iter().all(is_known) {
            return Err(UnknownError::Names(unknown.id));
        }
        let mistake = Mistake {
            id: unknown.id.clone(),
            title: unknown.title.clone(),
            changes: unknown.changes.clone(),
            ..Mistake::default()
        };
        let sources = mistake.apply(reference)?;
        all.push((unknown, mistake, sources));
    }
    Ok(all)
}
