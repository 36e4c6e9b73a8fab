//! One item as students may see it.

use judging::assignment::Task;

use crate::policy::Visibility;
use crate::score::ItemScore;

/// An item and its visibility to students.
#[derive(Clone, Debug, PartialEq)]
pub struct ItemView {
    /// The task that the item belongs to.
    pub task: Task,
    /// The item, without the parts that the policy hides.
    pub item: ItemScore,
    /// How much of the item students may see, and when.
    pub visibility: Visibility,
}

/// Returns whether students may see everything about these items.
pub(super) fn shows_everything(items: &[ItemView]) -> bool {
    items
        .iter()
        .all(|entry| entry.visibility == Visibility::All)
}
