//! Recognises the known mistakes behind wrong answers.
//!
//! A false hint is worse than none, so a mistake is named only in four cases. If it gives no answers at
//! all, several items must fail as they do with it. If no ray hits anything with it, it is never named,
//! since any code that finds nothing answers like it.
//!
//! 1. It alone explains all answers in the task.
//! 2. It explains them together with one other mistake, and no other pair does without it. Most answers
//!    must be those of one of the two: where both change an answer, anything can come out.
//! 3. It explains every item that it affects, which are most of the wrong ones, and no other known
//!    mistake explains these items. Other items of the task may be wrong for another reason.
//! 4. It explains nearly all answers to the items that it affects, which are most of the wrong ones,
//!    and no other known mistake comes close. A second mistake may have changed the others.

mod evidence;

use std::collections::{BTreeMap, BTreeSet};

use protocol::Answer;

use crate::exam::{Exam, Item};
use crate::observe::observe;
use crate::recognise::evidence::Evidence;
use crate::signatures::{KnownMistake, NoAnswerReason, ObservedAnswer};

/// Maximum number of mistakes to name for an item. If there are more, none is named, because a long
/// list would not help.
pub const MAX_MISTAKES: usize = 3;

/// A submission's answers to the signature elements of each item, by item id.
#[derive(Clone, Debug, Default)]
pub struct Observations(BTreeMap<String, Vec<ObservedAnswer>>);

impl Observations {
    /// Records the answers to an item, or the reason why there are none.
    pub fn record(&mut self, item: &Item, answers: Result<&[Answer], NoAnswerReason>) {
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
        self.0.insert(item.id.clone(), observed);
    }

    /// Returns the known mistakes that explain an item. There are several if the answers do not
    /// distinguish them, or if each of two explains a part.
    pub fn explain<'a>(&self, exam: &'a Exam, item: &Item) -> Vec<&'a KnownMistake> {
        let items = exam.items.iter().filter(|other| other.task == item.task);
        let observed = items.filter_map(|item| Some((item, self.0.get(&item.id)?.as_slice())));
        let evidence = Evidence::new(exam, observed.collect());

        let mut named = evidence.causes();
        named.retain(|&mistake| evidence.affects(mistake, item));
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

#[cfg(test)]
mod tests;
