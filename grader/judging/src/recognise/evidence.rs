//! A submission's answers to the items of one task, and the known mistakes that explain them.

use std::collections::{BTreeMap, BTreeSet};

use crate::exam::{Exam, Item};
use crate::signatures::ObservedAnswer;

/// A mistake that produces no answers at all is only named if at least this many items fail.
const MIN_FAILED_ITEMS: usize = 3;
/// The corresponding minimum for a mistake that doesn't explain all answers on its own.
const MIN_FAILED_ITEMS_OF_SEVERAL: usize = 5;

/// The answers to a task's items, together with the answers that known mistakes would give.
pub(super) struct Evidence<'a> {
    exam: &'a Exam,
    items: Vec<ObservedItem<'a>>,
    /// The mistakes that affect any of the items, in catalogue order.
    mistakes: BTreeSet<usize>,
}

/// The answers to one item.
struct ObservedItem<'a> {
    item: &'a Item,
    answers: &'a [ObservedAnswer],
    /// For each mistake that affects the item, the wrong answers that the mistake gives, keyed by
    /// element.
    wrong: BTreeMap<usize, BTreeMap<usize, &'a ObservedAnswer>>,
}

impl<'a> Evidence<'a> {
    pub(super) fn new(exam: &'a Exam, items: Vec<(&'a Item, &'a [ObservedAnswer])>) -> Self {
        let items = items.into_iter().map(|(item, answers)| ObservedItem {
            item,
            answers,
            wrong: wrong_answers(item),
        });
        let items: Vec<ObservedItem> = items.collect();
        let mistakes = items.iter().flat_map(|item| item.wrong.keys().copied());
        Evidence {
            mistakes: mistakes.collect(),
            exam,
            items,
        }
    }

    /// Returns the mistakes to name.
    pub(super) fn causes(&self) -> Vec<usize> {
        let mut sole = self.with_enough_failures(self.sole_causes(), MIN_FAILED_ITEMS);
        sole.retain(|&mistake| !self.misses_everything(mistake));
        if !sole.is_empty() {
            return sole;
        }
        let mut causes = self.causes_in_pairs();
        if causes.is_empty() {
            causes = self.partial_causes();
        }
        self.with_enough_failures(causes, MIN_FAILED_ITEMS_OF_SEVERAL)
    }

    /// Returns whether a mistake explains an item: the mistake must change at least one answer to
    /// the item, and all of the submission's answers to the item must match the mistake's.
    pub(super) fn explains(&self, mistake: usize, item: &Item) -> bool {
        let mut affected = self.affected(mistake);
        affected.any(|other| other.item.id == item.id && other.is_explained_by(&[mistake]))
    }

    /// Returns `causes` without the mistakes that have too little evidence. A mistake that gives
    /// wrong answers is kept. Many mistakes end in a panic or an overflow, so a mistake that does
    /// nothing else must affect at least `min_items` items and be the only candidate. If it panics
    /// in a way that few others do, one item fewer is enough.
    fn with_enough_failures(&self, mut causes: Vec<usize>, min_items: usize) -> Vec<usize> {
        let hints: BTreeSet<&str> = causes.iter().map(|&mistake| self.hint(mistake)).collect();
        causes.retain(|&mistake| {
            let mut answers = self.wrong_answers(mistake);
            let is_unusual_panic = answers.any(|answer| answer.is_unusual_panic());
            let items = self.affected(mistake).count() + usize::from(is_unusual_panic);
            self.is_informative(mistake) || hints.len() == 1 && items >= min_items
        });
        causes
    }

    /// Returns the mistakes that explain all answers.
    fn sole_causes(&self) -> Vec<usize> {
        let explains_all = |mistake| {
            self.items
                .iter()
                .all(|item| item.is_explained_by(&[mistake]))
        };
        let mistakes = self.mistakes.iter().copied();
        mistakes.filter(|&mistake| explains_all(mistake)).collect()
    }

    /// Returns the mistakes whose hint is in every pair that explains all answers, provided that in
    /// one of these pairs each mistake explains an item on its own. Without this condition, the
    /// second mistake might only account for what the first doesn't explain, and it could do the
    /// same if the answers came from an unknown mistake. For the same reason, at least three out of
    /// five answers to the items that a mistake affects must match the mistake's.
    fn causes_in_pairs(&self) -> Vec<usize> {
        let mut hints: Option<BTreeSet<&str>> = None;
        let mut members = BTreeSet::new();
        for &one in &self.mistakes {
            for &other in self.mistakes.range(one + 1..) {
                if self.is_explained_by_pair(one, other) {
                    let pair = BTreeSet::from([self.hint(one), self.hint(other)]);
                    let both_needed =
                        self.affects_more_than(one, other) && self.affects_more_than(other, one);
                    if both_needed && self.is_distinctive(one) && self.is_distinctive(other) {
                        members.extend([one, other]);
                    }
                    hints = Some(match hints {
                        None => pair,
                        Some(hints) => hints.intersection(&pair).copied().collect(),
                    });
                }
            }
        }
        let hints = hints.unwrap_or_default();
        members.retain(|&mistake| {
            let (agreeing, differing) = self.agreement(mistake);
            hints.contains(self.hint(mistake)) && 2 * agreeing >= 3 * differing
        });
        members.into_iter().collect()
    }

    /// Returns whether two mistakes explain all answers, and whether most of these answers are
    /// certain. An answer that both mistakes change is open, because the result can be anything.
    fn is_explained_by_pair(&self, one: usize, other: usize) -> bool {
        let (mut certain, mut open) = (0, 0);
        for item in &self.items {
            if !item.is_explained_by(&[one, other]) {
                return false;
            }
            // If both mistakes change a number, the result differs from what either mistake gives
            // on its own.
            let alone = [one, other].map(|mistake| item.is_explained_by(&[mistake]));
            if alone[0] != alone[1] && item.is_changed_differently_by(one, other) {
                return false;
            }
            let counts = item.certain_and_open(one, other);
            certain += counts.0;
            open += counts.1;
        }
        certain >= open
    }

    /// Returns whether a mistake affects an item that `other` leaves correct.
    fn affects_more_than(&self, mistake: usize, other: usize) -> bool {
        let mut affected = self.affected(mistake);
        affected.any(|item| !item.wrong.contains_key(&other))
    }

    /// Returns the mistakes that explain every item they affect. There must be several such items,
    /// they must make up most of the wrong items, and no mistake with a different hint may explain
    /// these items and every other item that it affects.
    fn partial_causes(&self) -> Vec<usize> {
        let wrong = self.items.iter().filter(|item| item.is_wrong()).count();
        let is_cause = |mistake: usize| {
            let affected: Vec<_> = self.affected(mistake).collect();
            let explains = |mistake| affected.iter().all(|item| item.is_explained_by(&[mistake]));
            let is_rival = |other| {
                let has_other_hint = self.hint(other) != self.hint(mistake);
                let mut items = self.affected(other);
                has_other_hint
                    && explains(other)
                    && items.all(|item| item.is_explained_by(&[other]))
            };
            let mut others = self.mistakes.iter().copied();
            affected.len() >= 2
                && self.is_distinctive(mistake)
                && 2 * affected.len() > wrong
                && explains(mistake)
                && !self.has_same_defect_elsewhere(mistake)
                && !others.any(is_rival)
        };
        let mistakes = self.mistakes.iter().copied();
        mistakes.filter(|&mistake| is_cause(mistake)).collect()
    }

    /// Returns, for the items that a mistake affects, how many wrong answers match the mistake's
    /// and how many answers differ from the mistake's. Misses don't count as matches, because too
    /// many mistakes lead to misses.
    fn agreement(&self, mistake: usize) -> (usize, usize) {
        let (mut agreeing, mut differing) = (0, 0);
        for item in self.affected(mistake) {
            let correct = item.item.signatures.correct_answers.iter();
            for (element, (answer, correct)) in item.answers.iter().zip(correct).enumerate() {
                let wrong = item.wrong[&mistake].get(&element);
                if answer.matches(wrong.unwrap_or(&correct)) {
                    agreeing += usize::from(wrong.is_some() && !answer.is_miss());
                } else {
                    differing += 1;
                }
            }
        }
        (agreeing, differing)
    }

    /// Returns whether items that the mistake would leave correct fail in the same way as the items
    /// that it affects: a tree shows the same defect, or several items lack an answer for the same
    /// reason. If so, the failures have a different cause. A single item without an answer proves
    /// nothing, since different code with the same mistake may give no answer.
    fn has_same_defect_elsewhere(&self, mistake: usize) -> bool {
        let wrong: Vec<_> = self.wrong_answers(mistake).collect();
        let has_same_defect = |answer: &ObservedAnswer| {
            let is_same = |defect| {
                wrong
                    .iter()
                    .any(|other| other.tree_defect() == Some(defect))
            };
            answer.tree_defect().is_some_and(is_same)
        };
        let is_missing_alike = |answer: &ObservedAnswer| {
            answer.is_uninformative() && wrong.iter().any(|other| answer.matches(other))
        };
        let items = self.items.iter();
        let elsewhere = items.filter(|item| !item.wrong.contains_key(&mistake));
        let elsewhere: Vec<_> = elsewhere.map(|item| item.answers).collect();
        let missing = elsewhere
            .iter()
            .filter(|answers| answers.iter().any(is_missing_alike));
        missing.count() > 1 || elsewhere.into_iter().flatten().any(has_same_defect)
    }

    /// Returns whether a mistake gives at least one wrong answer, as opposed to merely failing to
    /// answer.
    fn is_informative(&self, mistake: usize) -> bool {
        let mut wrong = self.wrong_answers(mistake);
        wrong.any(|answer| !answer.is_uninformative())
    }

    /// Returns whether a mistake does more than make every ray miss: it gives a wrong answer other
    /// than a miss, or leaves a hit correct in an item that it affects.
    fn is_distinctive(&self, mistake: usize) -> bool {
        let mut affected = self.affected(mistake);
        affected.any(|item| {
            let wrong = &item.wrong[&mistake];
            let mut correct = item.item.signatures.correct_answers.iter().enumerate();
            wrong.values().any(|answer| !answer.is_miss())
                || correct
                    .any(|(element, answer)| !answer.is_miss() && !wrong.contains_key(&element))
        })
    }

    /// Returns whether, with this mistake, no ray in the task hits anything. Any code that never
    /// finds a hit gives the same answers.
    fn misses_everything(&self, mistake: usize) -> bool {
        self.items.iter().all(|item| {
            let wrong = item.wrong.get(&mistake);
            let mut correct = item.item.signatures.correct_answers.iter().enumerate();
            correct.all(|(element, correct)| {
                let wrong = wrong.and_then(|wrong| wrong.get(&element));
                wrong.unwrap_or(&correct).is_miss()
            })
        })
    }

    fn wrong_answers(&self, mistake: usize) -> impl Iterator<Item = &'a ObservedAnswer> {
        let affected = self.affected(mistake);
        affected.flat_map(move |item| item.wrong[&mistake].values().copied())
    }

    fn affected(&self, mistake: usize) -> impl Iterator<Item = &ObservedItem<'a>> {
        let items = self.items.iter();
        items.filter(move |item| item.wrong.contains_key(&mistake))
    }

    fn hint(&self, mistake: usize) -> &'a str {
        &self.exam.mistakes[mistake].hint
    }
}

impl ObservedItem<'_> {
    /// Returns whether any answer is wrong.
    fn is_wrong(&self) -> bool {
        !self.is_explained_by(&[])
    }

    /// Returns whether these mistakes together explain all answers: an answer that none of them
    /// changes must be correct, and any other must be a combination of the mistakes' answers and
    /// the correct one.
    fn is_explained_by(&self, mistakes: &[usize]) -> bool {
        let correct = self.item.signatures.correct_answers.iter();
        let mut answers = self.answers.iter().zip(correct).enumerate();
        answers.all(|(element, (answer, correct))| {
            let wrong = mistakes
                .iter()
                .filter_map(|mistake| self.wrong.get(mistake));
            let wrong: Vec<_> = wrong
                .filter_map(|wrong| wrong.get(&element).copied())
                .collect();
            answer.is_made_of(correct, &wrong)
        })
    }

    /// Returns whether there is an answer whose numbers the two mistakes change in different ways.
    fn is_changed_differently_by(&self, one: usize, other: usize) -> bool {
        let (Some(by_one), Some(by_other)) = (self.wrong.get(&one), self.wrong.get(&other)) else {
            return false;
        };
        let is_number = |answer: &ObservedAnswer| matches!(answer, ObservedAnswer::Numbers(_));
        by_one.iter().any(|(element, answer)| {
            let both = by_other.get(element);
            both.is_some_and(|other| {
                is_number(answer) && is_number(other) && !answer.matches(other)
            })
        })
    }

    /// Counts the answers that the two mistakes change. Returns how many match one of the mistakes,
    /// and how many match neither. Only an answer that both mistakes change can match neither.
    fn certain_and_open(&self, one: usize, other: usize) -> (usize, usize) {
        let wrong =
            |mistake: usize, element: usize| self.wrong.get(&mistake)?.get(&element).copied();
        let (mut certain, mut open) = (0, 0);
        for (element, answer) in self.answers.iter().enumerate() {
            match (wrong(one, element), wrong(other, element)) {
                (None, None) => {}
                (Some(one), Some(other)) if !answer.matches(one) && !answer.matches(other) => {
                    open += 1;
                }
                (Some(_), _) | (None, Some(_)) => certain += 1,
            }
        }
        (certain, open)
    }
}

/// Returns each mistake's wrong answers, keyed by element.
fn wrong_answers(item: &Item) -> BTreeMap<usize, BTreeMap<usize, &ObservedAnswer>> {
    let mut wrong = BTreeMap::new();
    for answers in &item.signatures.mistake_answers {
        let elements = answers.answers.iter();
        let by_element: BTreeMap<usize, &ObservedAnswer> = elements
            .map(|(element, answer)| (*element as usize, answer))
            .collect();
        for &mistake in &answers.mistakes {
            wrong.insert(mistake as usize, by_element.clone());
        }
    }
    wrong
}
