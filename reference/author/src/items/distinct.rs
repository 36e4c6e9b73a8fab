//! Final exams share no question with the practice exam, whose answers everybody has. An item is
//! drawn again as long as the practice exam's answers would earn points in it.

use std::sync::LazyLock;

use judging::exam::{ExamQuestion, Item, Key};
use judging::judge::{Credit, judge};
use protocol::Answer;

use crate::items::{Declaration, DeclaredItem};
use crate::seed::Seed;

/// The items of the practice exam.
static PRACTICE: LazyLock<Vec<DeclaredItem>> =
    LazyLock::new(|| super::declared_items(Seed::PRACTICE).collect());

/// Draws items. Those of a final exam differ from those of the practice exam in every question.
pub(super) fn draw_items(seed: Seed, items: &[Declaration]) -> Vec<DeclaredItem> {
    let items = items.iter().map(|item| match seed {
        Seed::PRACTICE => item.draw(seed),
        seed => draw_distinct(seed, item),
    });
    items.collect()
}

fn draw_distinct(seed: Seed, item: &Declaration) -> DeclaredItem {
    const MAX_ATTEMPTS: usize = 1000;
    let is_distinct = |drawn: &DeclaredItem| {
        let practice = PRACTICE.iter().map(DeclaredItem::item);
        let mut same = practice.filter(|other| other.id == drawn.item().id);
        !same.any(|other| shares_a_question(drawn.item(), other))
    };
    std::iter::successors(Some(seed), |seed| Some(seed.next()))
        .take(MAX_ATTEMPTS)
        .map(|seed| item.draw(seed))
        .find(is_distinct)
        .expect("some numbers differ from those of the practice exam")
}

/// Returns whether the correct answer to a question of the one item earns points for a question of
/// the other.
///
/// Some questions are left out. If no ray hits anything, there is only one answer. A tree is an
/// answer to its own primitives only, and these are drawn by the seed.
pub fn shares_a_question(item: &Item, other: &Item) -> bool {
    let answers = other.questions.iter();
    let answers: Vec<Answer> = answers.filter_map(|asked| asked.key.answer()).collect();
    let is_drawn = |question: &&ExamQuestion| match &question.key {
        Key::Table { rows, .. } => (0..rows.count()).any(|row| rows.is_present(row)),
        Key::FirstHits { .. } | Key::Radiance { .. } => true,
        Key::Tree { .. } => false,
    };
    let mut drawn = item.questions.iter().filter(is_drawn);
    drawn.any(|question| {
        let mut credits = answers.iter().map(|answer| judge(question, answer).credit);
        credits.any(|credit: Credit| credit.apply(item.points) > 0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::items::{bbox, build, camera};

    #[test]
    fn an_item_shares_its_questions_with_itself_except_trees() {
        let seed = Seed(1);
        for drawn in camera::items(seed).iter().chain(&bbox::items(seed)) {
            assert!(shares_a_question(drawn.item(), drawn.item()), "{drawn:?}");
        }
        let trees = build::items(seed);
        assert!(!shares_a_question(trees[0].item(), trees[0].item()));
    }

    #[test]
    fn an_item_that_shares_a_question_is_drawn_again() {
        // There are few sizes of a small film, so some seeds draw one of the practice exam's.
        let sizes = |seed| camera::items(seed).remove(0);
        let practice = sizes(Seed::PRACTICE);
        let corners = camera::CORNERS;
        let shares = |seed: &Seed| shares_a_question(corners.draw(*seed).item(), practice.item());
        let seed = (0..100).map(Seed).find(shares).unwrap();
        assert!(!shares_a_question(sizes(seed).item(), practice.item()));
    }
}
