//! The declaration of an item: everything about it, in one place.

use judging::exam::{ExamQuestion, Item};
use judging::section::Section;
use judging::symptom::Symptom;

use crate::domains::Domain;
use crate::items::complete;
use crate::seed::{Rng, Seed};

/// A task as declared by its authors: its items and the parts of the contract they don't test.
#[derive(Debug)]
pub struct AuthoredTask {
    /// The items, in the exam's order.
    pub items: &'static [Declaration],
    /// Changes the items' questions after they have been generated.
    pub finish: fn(Seed, &mut [DeclaredItem]),
    /// The sentences of the method's documentation that no item tests, each with the reason.
    pub untested: &'static [(&'static str, &'static str)],
    /// The domains of the functions that the items call, except those that an earlier task declares.
    pub domains: &'static [&'static dyn Domain],
}

impl AuthoredTask {
    /// A task without items, as a starting point for declarations. Its whole contract is considered
    /// tested.
    pub const NEW: AuthoredTask = AuthoredTask {
        items: &[],
        finish: |_, _| {},
        untested: &[],
        domains: &[],
    };

    /// Generates the items. Their questions differ from those of the items in `practice`.
    pub fn draw(&self, seed: Seed, practice: &[Item]) -> Vec<DeclaredItem> {
        complete::draw_items(seed, self, practice)
    }
}

/// An item whose questions haven't been generated yet.
#[derive(Clone, Copy, Debug)]
pub struct Declaration {
    /// The task's id, a dot, and a name, such as `sphere.near_side`.
    pub id: &'static str,
    /// The points for answering all questions correctly. Most items are worth one point.
    pub points: u32,
    /// A sentence that states the requirement. Students see it as feedback.
    pub title: &'static str,
    /// A hint on where to look for the mistake.
    pub look: &'static str,
    /// The symptoms that `look` and `section` are about. Empty if they are about all symptoms. For
    /// any other symptom, the report shows the task's clue for that symptom.
    pub look_fits: &'static [Symptom],
    /// The section of the handout that teaches the requirement.
    pub section: &'static str,
    /// The sentences of the method's documentation that the item tests, each quoted in full or up
    /// to an ellipsis.
    pub tests: &'static [&'static str],
    /// Generates the item's questions.
    pub questions: fn(&mut Rng) -> Vec<ExamQuestion>,
    /// The group that the item belongs to, if items in other tasks need that group.
    pub group: Option<Group>,
    /// The groups of items in earlier tasks that the item depends on.
    pub needs: &'static [Group],
}

/// A group of items that items in later tasks need as a whole.
///
/// An item needs a group only if mistakes in that group could make the item fail even though its
/// own task is solved correctly. A student who fails an item and one of the items it needs is
/// advised to fix the needed item first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Group(pub &'static str);

/// An item whose dependencies are still given as groups rather than as item ids.
#[derive(Clone, Debug)]
pub struct DeclaredItem {
    item: Item,
    group: Option<Group>,
    needs: &'static [Group],
}

impl DeclaredItem {
    /// Returns the item, without the ids of the items that it needs.
    pub(super) fn item(&self) -> &Item {
        &self.item
    }

    /// Returns the item's questions, so that more can be added.
    pub(super) fn questions(&mut self) -> &mut Vec<ExamQuestion> {
        &mut self.item.questions
    }
}

impl Declaration {
    /// The default fields of an item that is worth one point, belongs to no group and needs no
    /// group.
    pub const ALONE: Declaration = Declaration {
        id: "",
        points: 1,
        title: "",
        look: "",
        look_fits: &[],
        section: "",
        tests: &[],
        questions: |_| Vec::new(),
        group: None,
        needs: &[],
    };

    /// Returns the default fields of an item that is worth one point and belongs to this group but
    /// needs no group.
    pub const fn in_group(group: Group) -> Self {
        Declaration {
            group: Some(group),
            ..Declaration::ALONE
        }
    }

    /// Generates the item's questions.
    pub(super) fn draw(&self, seed: Seed) -> DeclaredItem {
        let questions = (self.questions)(&mut seed.rng(self.id));
        let item = Item {
            title: self.title.to_owned(),
            look: self.look.to_owned(),
            look_fits: self.look_fits.to_vec(),
            section: Some(Section::new(self.section)),
            ..Item::new(self.id, self.points, questions)
        };
        DeclaredItem {
            item,
            group: self.group,
            needs: self.needs,
        }
    }
}

/// Returns the items, each with the ids of all items in the groups that it needs.
pub fn resolve(declared: Vec<DeclaredItem>) -> Vec<Item> {
    let members = |group: Group| {
        let members = declared.iter().filter(move |it| it.group == Some(group));
        members.map(|it| it.item.id.clone())
    };
    let resolved = declared
        .iter()
        .map(|DeclaredItem { item, needs, .. }| Item {
            needs: needs.iter().flat_map(|&group| members(group)).collect(),
            ..item.clone()
        });
    resolved.collect()
}

#[cfg(test)]
mod tests {
    use judging::assignment::Task;

    use super::*;
    use crate::items::groups;

    fn declared(id: &'static str, group: Option<Group>, needs: &'static [Group]) -> DeclaredItem {
        let declaration = Declaration {
            id,
            section: "start.md",
            group,
            needs,
            ..Declaration::ALONE
        };
        declaration.draw(Seed(1))
    }

    #[test]
    fn an_item_needs_all_items_of_its_groups_group_by_group() {
        let items = resolve(vec![
            declared("triangle.inside", Some(groups::TRIANGLE_HITS), &[]),
            declared("triangle.tiny", None, &[]),
            declared("triangle.outside", Some(groups::TRIANGLE_HITS), &[]),
            declared("bbox.through", Some(groups::BOXES), &[]),
            declared(
                "traverse.deep",
                None,
                &[groups::BOXES, groups::TRIANGLE_HITS],
            ),
        ]);
        let needs: Vec<usize> = items.iter().map(|item| item.needs.len()).collect();
        assert_eq!(needs, [0, 0, 0, 0, 3]);
        let expected = ["bbox.through", "triangle.inside", "triangle.outside"];
        assert_eq!(items[4].needs, expected);
        assert_eq!(items[4].task, Task::in_id("traverse.deep").unwrap());
    }
}
