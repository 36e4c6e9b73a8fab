//! Final exams don't share any questions with the practice exam, whose answers are public. An item
//! is regenerated until the practice exam's answers no longer earn points for it.

use judging::exam::{ExamQuestion, Item, Key};
use judging::judge::{Credit, judge, one_row_answers_all};
use protocol::Answer;

use crate::items::{Declaration, DeclaredItem};
use crate::seed::Seed;

/// Generates an item whose questions all differ from the same item's questions in the practice
/// exam.
pub(super) fn draw_distinct(seed: Seed, item: &Declaration, practice: &Item) -> DeclaredItem {
    const MAX_ATTEMPTS: usize = 1000;
    let is_distinct = |drawn: &DeclaredItem| !shares_a_question(drawn.item(), practice);
    std::iter::successors(Some(seed), |seed| Some(seed.next()))
        .take(MAX_ATTEMPTS)
        .map(|seed| item.draw(seed))
        .find(is_distinct)
        .expect("some seed gives numbers that differ from those of the practice exam")
}

/// Returns whether the correct answer to a question of one item would earn points for a question of
/// the other item.
///
/// Some questions are skipped. If the answer is the same for all rows, e.g. the length of a
/// direction, or if no ray hits anything, only one answer is possible. A tree answers only
/// questions about its own primitives, which depend on the seed. Directions that must only be
/// spread evenly have no answers that could be shared. A picture that hasn't been
/// recorded yet depends on a random number, which also depends on the seed.
pub fn shares_a_question(item: &Item, other: &Item) -> bool {
    let answers = other.questions.iter();
    let answers: Vec<Answer> = answers.filter_map(|asked| asked.key.answer()).collect();
    let is_drawn = |question: &&ExamQuestion| match &question.key {
        Key::Table { rows, .. } => {
            (0..rows.count()).any(|row| rows.is_present(row)) && !one_row_answers_all(question)
        }
        Key::FirstHits { .. } => true,
        Key::Radiance { pixels, .. } => !pixels.is_empty(),
        Key::Tree { .. } | Key::SpreadEvenly { .. } => false,
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
        let drawn = [&camera::TASK, &bbox::TASK].map(|task| task.draw(seed, &[]));
        for drawn in drawn.iter().flatten() {
            assert!(shares_a_question(drawn.item(), drawn.item()), "{drawn:?}");
        }
        let trees = build::TASK.draw(seed, &[]);
        assert!(!shares_a_question(trees[0].item(), trees[0].item()));
    }

    #[test]
    fn an_item_that_shares_a_question_is_drawn_again() {
        // A small film can only have a few sizes, so some seeds give the same size as the practice
        // exam.
        let sizes = |seed, practice: &[Item]| camera::TASK.draw(seed, practice).remove(0);
        let practice = sizes(Seed::PRACTICE, &[]);
        let corners = camera::CORNERS;
        let shares = |seed: &Seed| shares_a_question(corners.draw(*seed).item(), practice.item());
        let seed = (0..100).map(Seed).find(shares).unwrap();
        let other = sizes(seed, std::slice::from_ref(practice.item()));
        assert!(!shares_a_question(other.item(), practice.item()));
    }
}
