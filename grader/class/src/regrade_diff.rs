//! Compares the scores from a regrade with the earlier ones and finds out whose points changed,
//! for which items, and why.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::error::Error;
use crate::final_grades::GradeChanges;
use crate::names::with_detail;
use crate::outcome::{EntryResult, ItemScore, ScoreSummary, id_and_names};
use crate::run::Run;
use crate::store::{PREVIOUS, REPLACED, Store};

/// The differences from earlier runs.
#[derive(Clone, Debug, Default)]
pub struct Changes {
    /// The changes made by a regrade. `None` in a folder's first round.
    pub regrade: Option<RegradeChanges>,
    /// The scores that changed because the submission changed.
    pub resubmitted: Vec<ScoreChange>,
    /// Sentences about the entries that are no longer in the input.
    pub removed: Vec<String>,
    /// The final grades that changed. `None` if there are no earlier grades to compare with.
    pub grades: Option<GradeChanges>,
}

/// The changes made by a regrade.
#[derive(Clone, Debug)]
pub struct RegradeChanges {
    /// The scores that changed.
    pub scores: Vec<ScoreChange>,
    /// The settings that changed.
    pub causes: Vec<&'static str>,
}

/// Returns the changes that a regrade made, or `None` in a folder's first round. Submissions whose
/// files have changed are left out.
pub fn find_regrade_changes(
    store: &Store,
    run: &Run,
    results: &[EntryResult],
) -> Result<Option<RegradeChanges>, Error> {
    let Some(before) = &run.before else {
        return Ok(None);
    };
    Ok(Some(RegradeChanges {
        scores: find_score_changes(store, results, PREVIOUS)?,
        causes: before.differences(&run.settings),
    }))
}

/// Compares each result with its entry's earlier score in the file [`PREVIOUS`] or
/// [`REPLACED`].
pub fn find_score_changes(
    store: &Store,
    results: &[EntryResult],
    earlier: &str,
) -> Result<Vec<ScoreChange>, Error> {
    let mut changes = Vec::new();
    for result in results {
        // If the files changed too, the new score says nothing about the regrade.
        if earlier == PREVIOUS && store.earlier_score(&result.id, REPLACED)?.is_some() {
            continue;
        }
        let was = store.earlier_score(&result.id, earlier)?;
        changes.extend(was.and_then(|was| compare_scores(&result.id, &was, result.score())));
    }
    Ok(changes)
}

/// Returns a sentence about each entry in the stores that isn't among `ids`, including its people
/// and points. An entry in several stores is only listed once.
pub fn find_removed(stores: &[&Store], ids: &[&str]) -> Result<Vec<String>, Error> {
    let mut known: BTreeSet<String> = ids.iter().map(|id| (*id).to_owned()).collect();
    let mut removed = Vec::new();
    for store in stores {
        for id in store.ids()? {
            let Some(result) = store.result(&id)?.filter(|_| !known.contains(&id)) else {
                continue;
            };
            let who = id_and_names(&id, &result.info.display_names());
            removed.push(match result.score() {
                Some(score) => format!("{who}: {} points", score.points),
                None => format!("{who}: no score"),
            });
            known.insert(id);
        }
    }
    Ok(removed)
}

/// A score that changed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ScoreChange {
    /// The entry's id.
    pub id: String,
    /// The points before the regrade.
    pub was: u32,
    /// The points after the regrade. `None` if the entry no longer has a score.
    pub now: Option<u32>,
    /// The items whose points changed.
    pub items: Vec<ItemChange>,
}

/// A change in the points of an item.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ItemChange {
    /// The item's id.
    pub item: String,
    /// The points before the regrade. `None` if the item was not in the exam.
    pub was: Option<u32>,
    /// The points after the regrade. `None` if the item is no longer in the exam.
    pub now: Option<u32>,
    /// The reason: the verdict and message after the regrade and, if points were gained, also the
    /// verdict and message before it.
    pub why: String,
}

/// Compares the scores of an entry. Returns `None` if nothing changed.
fn compare_scores(id: &str, was: &ScoreSummary, now: Option<&ScoreSummary>) -> Option<ScoreChange> {
    let items = now.map_or_else(Vec::new, |now| item_changes(was, now));
    let is_same = now.is_some_and(|now| now.points == was.points) && items.is_empty();
    (!is_same).then(|| ScoreChange {
        id: id.to_owned(),
        was: was.points,
        now: now.map(|now| now.points),
        items,
    })
}

fn item_changes(was: &ScoreSummary, now: &ScoreSummary) -> Vec<ItemChange> {
    fn find<'a>(score: &'a ScoreSummary, id: &str) -> Option<&'a ItemScore> {
        score.items().find(|item| item.id == id)
    }
    let gone = was.items().filter(|item| find(now, &item.id).is_none());
    let all = now.items().chain(gone);
    let changes = all.filter_map(|ItemScore { id, .. }| {
        let (was, now) = (find(was, id), find(now, id));
        let [was_points, now_points] = [was, now].map(|item| item.map(|item| item.points));
        (was_points != now_points).then(|| ItemChange {
            item: id.clone(),
            was: was_points,
            now: now_points,
            why: reason(was, now),
        })
    });
    changes.collect()
}

fn reason(was: Option<&ItemScore>, now: Option<&ItemScore>) -> String {
    let explain = |item: &ItemScore| with_detail(&item.verdict, &item.message);
    match (was, now) {
        // The new message alone doesn't say why the points were lost before.
        (Some(was), Some(now)) if now.points > was.points => {
            format!("{}; previously {}", explain(now), explain(was))
        }
        (_, Some(now)) => explain(now),
        (_, None) => "no longer in the exam".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outcome::{FileNotes, TaskScore};

    fn score(items: &[(&str, u32, &str)]) -> ScoreSummary {
        let item = |(id, points, verdict): &(&str, u32, &str)| ItemScore {
            id: (*id).to_owned(),
            points: *points,
            max_points: 2,
            verdict: (*verdict).to_owned(),
            ..ItemScore::default()
        };
        let items: Vec<ItemScore> = items.iter().map(item).collect();
        let points = items.iter().map(|item| item.points).sum();
        ScoreSummary {
            points,
            max_points: 2 * items.len() as u32,
            build: FileNotes::default(),
            tasks: vec![TaskScore {
                id: String::new(),
                title: String::new(),
                points,
                max_points: 0,
                items,
            }],
        }
    }

    #[test]
    fn reports_item_changes_even_if_the_total_is_unchanged() {
        let was = score(&[("a", 2, "pass"), ("b", 0, "wrong"), ("c", 1, "partial")]);
        let now = score(&[("a", 0, "timed_out"), ("b", 2, "pass"), ("d", 1, "partial")]);
        let change = compare_scores("x", &was, Some(&now)).unwrap();
        let changes: Vec<_> = change
            .items
            .iter()
            .map(|c| (c.item.as_str(), c.was, c.now))
            .collect();
        let wanted = [
            ("a", Some(2), Some(0)),
            ("b", Some(0), Some(2)),
            ("d", None, Some(1)),
            ("c", Some(1), None),
        ];
        assert_eq!(changes, wanted);
        assert_eq!(change.items[1].why, "pass; previously wrong");
    }

    #[test]
    fn points_that_were_gained_are_explained_by_the_verdict_before() {
        let with_message = |verdict: &str, points, message: &str| {
            let mut score = score(&[("a", points, verdict)]);
            score.tasks[0].items[0].message = message.to_owned();
            score
        };
        let why = |was: &ScoreSummary, now: &ScoreSummary| {
            compare_scores("x", was, Some(now)).unwrap().items[0]
                .why
                .clone()
        };
        let (wrong, partial) = (
            with_message("wrong", 0, "3 of 4 answers are wrong"),
            with_message("partial", 1, "1 of 4 answers is wrong"),
        );
        assert_eq!(
            why(&wrong, &partial),
            "partial: 1 of 4 answers is wrong; previously wrong: 3 of 4 answers are wrong"
        );
        assert_eq!(why(&partial, &wrong), "wrong: 3 of 4 answers are wrong");
        let other = score(&[("b", 1, "partial")]);
        let change = compare_scores("x", &other, Some(&wrong)).unwrap();
        let reasons: Vec<&str> = change.items.iter().map(|item| item.why.as_str()).collect();
        assert_eq!(
            reasons,
            ["wrong: 3 of 4 answers are wrong", "no longer in the exam"]
        );
    }

    #[test]
    fn a_total_that_differs_is_a_change_even_if_no_item_does() {
        let was = score(&[("a", 2, "pass")]);
        assert_eq!(compare_scores("x", &was, Some(&was.clone())), None);
        let now = ScoreSummary {
            points: 1,
            ..was.clone()
        };
        let change = compare_scores("x", &was, Some(&now)).unwrap();
        assert_eq!(
            (change.was, change.now, change.items),
            (2, Some(1), Vec::new())
        );
        let gone = compare_scores("x", &was, None).unwrap();
        assert_eq!((gone.was, gone.now, gone.items), (2, None, Vec::new()));
    }
}
