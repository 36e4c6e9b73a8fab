//! Recognises the known mistakes behind wrong answers.
//!
//! A false hint is worse than none, so a mistake is named only in three cases, and only at items to which
//! every answer is that of the mistake. If it gives no answers at all, several items must fail as they do
//! with it. If no ray hits anything with it, it is never named, since any code that finds nothing answers
//! like it.
//!
//! 1. It alone explains all answers in the task.
//! 2. It explains them together with one other mistake, and no other pair does without it. Most answers
//!    must be those of one of the two: where both change an answer, anything can come out.
//! 3. It explains every item that it affects, which are most of the wrong ones, and no other known
//!    mistake explains these items. Other items of the task may be wrong for another reason.

mod evidence;

use std::collections::{BTreeMap, BTreeSet};

use protocol::{Answer, ElementOutcome};

use crate::exam::{Exam, Item, Key};
use crate::observe::observe;
use crate::recognise::evidence::Evidence;
use crate::signatures::{KnownMistake, NoAnswerReason, ObservedAnswer};

/// Maximum number of mistakes to name for an item. If there are more, none is named, because a long
/// list would not help.
pub const MAX_MISTAKES: usize = 3;

/// The number of items with rays that should hit something, from which on it is telling if none does.
const MIN_ITEMS_WITHOUT_HITS: usize = 3;

/// The observations of a submission's answers in one task.
#[derive(Clone, Debug, Default)]
pub struct Observations {
    /// The answers to the signature elements of each item, by item id.
    answers: BTreeMap<String, Vec<ObservedAnswer>>,
    /// The number of answered items in which a ray should hit something.
    items_to_hit: usize,
    /// Whether there is any answer other than that a ray misses.
    has_other_than_miss: bool,
}

impl Observations {
    /// Records the answers to an item, or the reason why there are none.
    pub fn record(&mut self, item: &Item, answers: Result<&[Answer], NoAnswerReason>) {
        if let Ok(answers) = answers {
            self.items_to_hit += usize::from(can_be_hit(item));
            self.has_other_than_miss |= answers.iter().any(has_other_than_miss);
        }
        if item.signatures.elements.is_empty() {
            return;
        }
        let observed = match answers {
            Ok(answers) => {
                let all = observe(item, answers);
                let elements = item.signatures.elements.iter();
                elements
                    .map(|&element| {
                        all.get(element as usize)
                            .cloned()
                            .unwrap_or(ObservedAnswer::NoAnswer(NoAnswerReason::Other))
                    })
                    .collect()
            }
            Err(why) => vec![ObservedAnswer::NoAnswer(why); item.signatures.elements.len()],
        };
        self.answers.insert(item.id.clone(), observed);
    }

    /// Returns whether all of a task's items were answered, and not one ray hits anything.
    pub fn misses_everything<'a>(&self, items: impl IntoIterator<Item = &'a Item>) -> bool {
        let to_hit = items.into_iter().filter(|item| can_be_hit(item)).count();
        let all_answered = self.items_to_hit == to_hit;
        all_answered && to_hit >= MIN_ITEMS_WITHOUT_HITS && !self.has_other_than_miss
    }

    /// Returns the known mistakes that explain every answer to an item. There are several if the answers
    /// do not distinguish them.
    pub fn explain<'a>(&self, exam: &'a Exam, item: &Item) -> Vec<&'a KnownMistake> {
        let items = exam.items.iter().filter(|other| other.task == item.task);
        let observed =
            items.filter_map(|item| Some((item, self.answers.get(&item.id)?.as_slice())));
        let evidence = Evidence::new(exam, observed.collect());

        let mut named = evidence.causes();
        named.retain(|&mistake| evidence.explains(mistake, item));
        // Mistakes that no question distinguishes share a hint.
        let mut hints = BTreeSet::new();
        let mistakes = named.into_iter().map(|mistake| &exam.mistakes[mistake]);
        let named: Vec<_> = mistakes.filter(|m| hints.insert(&m.hint)).collect();
        if named.len() > MAX_MISTAKES {
            Vec::new()
        } else {
            named
        }
    }
}

/// Returns whether one of an item's rays hits something, if the answers are correct. A picture does not
/// count: it needs other tasks too, and may lack an answer because of them.
fn can_be_hit(item: &Item) -> bool {
    item.questions.iter().any(|question| match &question.key {
        Key::Table { rows, .. } => (0..rows.count()).any(|row| rows.is_present(row)),
        Key::Tree { .. } | Key::FirstHits { .. } | Key::Radiance { .. } => false,
    })
}

/// Returns whether a row of a table has another answer than that nothing is hit.
fn has_other_than_miss(answer: &Answer) -> bool {
    let rows = answer.rows().unwrap_or_default();
    !rows
        .iter()
        .all(|row| matches!(row, ElementOutcome::Value(None)))
}

#[cfg(test)]
mod tests;
