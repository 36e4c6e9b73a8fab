//! The list of sentences, the items that ask them, and the reasons for what is not asked.

use judging::assignment::TaskInfo;
use serde::Deserialize;

use super::cells::Cell;

/// The list of sentences and reasons.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Listed {
    pub sentence: Vec<Sentence>,
    #[serde(default)]
    not_asked: Vec<Reason>,
}

/// A sentence of the contract.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Sentence {
    /// The task whose method's documentation contains it.
    pub task: String,
    pub text: String,
    /// The items that ask it.
    #[serde(default)]
    pub items: Vec<String>,
    /// The reason why no item asks it.
    pub why_not: Option<String>,
}

/// Cells that are not asked, with the reason.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Reason {
    task: String,
    /// The items of the sentences that it is about, all others being asked; or all of the task.
    #[serde(default)]
    items: Vec<String>,
    cells: Vec<String>,
    why: String,
}

impl Listed {
    /// Returns the reason why a sentence is not asked at a cell.
    pub(super) fn reason(&self, task: &TaskInfo, entry: &Sentence, cell: Cell) -> Option<&str> {
        let mut reasons = self
            .not_asked
            .iter()
            .filter(|reason| reason.task == task.id);
        let fits = |reason: &&Reason| {
            let is_about =
                reason.items.is_empty() || reason.items.iter().any(|id| entry.items.contains(id));
            is_about && reason.cells.iter().any(|it| it == cell)
        };
        reasons.find(fits).map(|reason| reason.why.as_str())
    }
}
