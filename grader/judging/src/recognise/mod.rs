//! Recognises the known mistakes behind wrong answers.
//!
//! A false hint is worse than none, so a mistake is only named in the three cases below, and only
//! for items where every answer matches the mistake's. If the mistake gives no answers at all,
//! several items must fail in the way that the mistake makes them fail. If it makes every ray miss,
//! it is never named, because any code that finds nothing gives the same answers.
//!
//! 1. On its own, it explains all answers in the task.
//! 2. Together with one other mistake, it explains all answers in the task, and every pair of
//!    mistakes that does so includes it. Most answers must match one of the two, because where both
//!    change an answer, the result can be anything.
//! 3. It explains every item it affects, these items make up most of the wrong items, and no other
//!    known mistake explains them. Other items of the task may be wrong for another reason.

mod evidence;

use std::collections::{BTreeMap, BTreeSet};

use protocol::{Answer, ElementOutcome};

use crate::exam::{Exam, Item, Key};
use crate::observe::observe;
use crate::recognise::evidence::Evidence;
use crate::signatures::{KnownMistake, NoAnswerReason, ObservedAnswer};

/// Maximum number of mistakes to name for an item. If there are more, none is named, because a long
/// list wouldn't help.
pub const MAX_MISTAKES: usize = 3;

/// The minimum number of answered items with rays that should hit something. With fewer, "nothing
/// is ever hit" isn't reported.
const MIN_ITEMS_WITHOUT_HITS: usize = 3;

/// The observations about a submission's answers to the items of one task.
#[derive(Clone, Debug, Default)]
pub struct Observations {
    /// The answers to the signature elements of each item, keyed by item id.
    answers: BTreeMap<String, Vec<ObservedAnswer>>,
    /// The number of answered items where a ray should hit something.
    items_to_hit: usize,
    /// Whether any answer is something other than a miss.
    has_other_than_miss: bool,
}

impl Observations {
    /// Records the answers to an item, or the reason that they are missing. Answers of code that
    /// isn't written yet say nothing about the code that is, so the item is left out.
    pub fn record(&mut self, item: &Item, answers: Result<&[Answer], NoAnswerReason>) {
        if let Ok(answers) = answers {
            if answers.iter().any(Answer::is_unwritten) {
                return;
            }
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

    /// Returns whether all of a task's items were answered but no ray hits anything.
    pub fn misses_everything<'a>(&self, items: impl IntoIterator<Item = &'a Item>) -> bool {
        let to_hit = items.into_iter().filter(|item| can_be_hit(item)).count();
        let all_answered = self.items_to_hit == to_hit;
        all_answered && to_hit >= MIN_ITEMS_WITHOUT_HITS && !self.has_other_than_miss
    }

    /// Returns the known mistakes that explain every answer to an item. If the answers cannot
    /// distinguish between several mistakes, all of them are returned.
    pub fn explain<'a>(&self, exam: &'a Exam, item: &Item) -> Vec<&'a KnownMistake> {
        let items = exam.items.iter().filter(|other| other.task == item.task);
        let observed =
            items.filter_map(|item| Some((item, self.answers.get(&item.id)?.as_slice())));
        let evidence = Evidence::new(exam, observed.collect());

        let mut named = evidence.causes();
        named.retain(|&mistake| evidence.explains(mistake, item));
        // Mistakes that no question can distinguish share a hint.
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

/// Returns whether at least one of an item's rays should hit something. Pictures are ignored,
/// because they also depend on other tasks, where a mistake can leave a picture without an answer.
fn can_be_hit(item: &Item) -> bool {
    item.questions.iter().any(|question| match &question.key {
        Key::Table { rows, .. } => (0..rows.count()).any(|row| rows.is_present(row)),
        Key::Tree { .. }
        | Key::FirstHits { .. }
        | Key::Radiance { .. }
        | Key::SpreadEvenly { .. } => false,
    })
}

/// Returns whether any row of a table is something other than a miss.
fn has_other_than_miss(answer: &Answer) -> bool {
    let rows = answer.rows().unwrap_or_default();
    !rows
        .iter()
        .all(|row| matches!(row, ElementOutcome::Value(None)))
}

#[cfg(test)]
mod tests;
