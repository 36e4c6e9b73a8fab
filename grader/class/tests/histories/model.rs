//! A model of a results folder: what is known about it, and the results that the next run may
//! produce.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use crate::observed::{Files, Keys, Observed, ScoreId};
use crate::recorded_grader::score;

/// The model of a folder where a class is graded.
#[derive(Debug, Default)]
pub struct Model {
    /// The folder's last observed state.
    pub observed: Observed,
    /// The cache keys seen so far in this course.
    pub keys: Keys,
    /// For each entry, its last stamped score and the round of that score. The score must not be
    /// lost before a new one exists.
    kept: BTreeMap<String, (u64, ScoreId)>,
    /// The regrades that were still unfinished when the next regrade started. Their scores are
    /// discarded, but their stamps stay until the entry is graded again.
    abandoned: BTreeSet<u64>,
    /// The scores that the current round is compared with.
    before: BTreeMap<String, ScoreId>,
    /// The last scores of entries that later had nothing to grade. If reading such an entry has
    /// failed since, a regrade may be compared with this score.
    dropped: BTreeMap<String, ScoreId>,
}

impl Model {
    /// Checks that the model allows the folder's state after a command, and remembers this state.
    pub fn update(&mut self, now: Observed) -> Result<(), String> {
        let was = &self.observed;
        if now.round() < was.round() || was.run.is_some() && now.run.is_none() {
            return Err(format!(
                "round {} became round {}",
                was.round(),
                now.round()
            ));
        }
        for id in was.entries.keys() {
            if !now.entries.contains_key(id) {
                return Err(format!("the files of {id} are gone"));
            }
        }
        if now.round() > was.round() && was.is_unfinished_regrade() {
            self.abandoned.insert(was.round());
            let before = self.before.iter();
            self.kept = before
                .map(|(id, score)| (id.clone(), (0, *score)))
                .collect();
        } else if now.round() > was.round() {
            let kept = self.kept.iter();
            self.before = kept.map(|(id, (_, score))| (id.clone(), *score)).collect();
        }
        for (id, files) in &now.entries {
            self.update_entry(id, files, now.round())?;
        }
        if now.is_finished() {
            check_finished(&now)?;
        }
        self.observed = now;
        Ok(())
    }

    fn update_entry(&mut self, id: &str, files: &Files, round: u64) -> Result<(), String> {
        let was = self.kept.get(id).copied();
        if let Some((stamped_in, score)) = was {
            let places = [files.score, files.replaced, files.previous];
            if !places.contains(&Some(score)) {
                return Err(format!("{score:?} of {id} is lost: {files:?}"));
            }
            let now = files.graded();
            let is_replaced = now.is_some_and(|now| now != score);
            if is_replaced && stamped_in == round && files.replaced != Some(score) {
                return Err(format!(
                    "{score:?} of {id} was replaced, and not kept: {files:?}"
                ));
            }
        }
        match (files.graded(), files.state()) {
            (Some(score), _) => {
                let stamped_in = files.round().unwrap_or_default();
                if !self.abandoned.contains(&stamped_in) {
                    self.kept.insert(id.to_owned(), (stamped_in, score));
                }
            }
            // Staff have been informed that there is nothing to grade.
            (None, Some("no_submission")) => {
                let dropped = self.kept.remove(id);
                self.dropped
                    .extend(dropped.map(|(_, score)| (id.to_owned(), score)));
            }
            (None, _) => {}
        }
        Ok(())
    }

    /// Compares a folder with the model after a successful command. `class` contains the required
    /// scores of its entries, or `None` if there is nothing to grade.
    pub fn check_success(&self, class: &BTreeMap<&str, Option<ScoreId>>) -> Result<(), String> {
        if !self.observed.is_finished() || self.observed.is_unfinished_regrade() {
            return Err("the run ended well, and is not marked as finished".to_owned());
        }
        for (id, expected) in class {
            let files = self.observed.entries.get(*id).cloned().unwrap_or_default();
            if files.graded() != *expected {
                return Err(format!("{id} has {files:?} instead of {expected:?}"));
            }
            if files.stamp.is_none() {
                return Err(format!("{id} has no stamp"));
            }
            let is_regrade = self.observed.round() > 1;
            let before = self.before.get(*id).copied().filter(|_| is_regrade);
            let is_dropped = before.is_none() && files.previous == self.dropped.get(*id).copied();
            if is_regrade && files.previous != before && !is_dropped {
                return Err(format!(
                    "{id} is compared with {files:?} instead of {before:?}"
                ));
            }
        }
        Ok(())
    }

    /// Compares the list of changes after a regrade with the scores that changed. `now` contains
    /// the scores of the class.
    pub fn check_score_changes(
        &self,
        file: &str,
        now: &BTreeMap<&str, Option<ScoreId>>,
    ) -> Result<(), String> {
        let list: Vec<Value> = serde_json::from_str(file).map_err(|error| error.to_string())?;
        let found = list.iter().filter_map(|change| change["id"].as_str());
        let found: BTreeSet<&str> = found.collect();
        let points = |id: &str, known: ScoreId| -> Vec<u32> {
            let score = score(id, known.version, known.exam);
            score.items().map(|item| item.points).collect()
        };
        let changes = self.score_changes(now);
        let is_changed = |(id, was): &&(String, ScoreId)| {
            now[id.as_str()].is_none_or(|now| points(id, now) != points(id, *was))
        };
        let expected = changes.iter().filter(is_changed).map(|(id, _)| id.as_str());
        let expected: BTreeSet<&str> = expected.collect();
        if found == expected {
            Ok(())
        } else {
            Err(format!(
                "drift.json lists {found:?} instead of {expected:?}"
            ))
        }
    }

    /// Returns the ids of the class's entries whose scores a regrade changed, together with the
    /// previous scores. If an entry's files changed too, it isn't among them.
    fn score_changes(&self, class: &BTreeMap<&str, Option<ScoreId>>) -> Vec<(String, ScoreId)> {
        let ids = class.keys().copied();
        let entries = &self.observed.entries;
        let before = ids.filter_map(|id| {
            let files = entries.get(id).filter(|files| files.replaced.is_none())?;
            Some((id.to_owned(), files.previous?))
        });
        before
            .filter(|(id, was)| class[id.as_str()] != Some(*was))
            .collect()
    }
}

/// Checks that every entry of a finished run is graded.
fn check_finished(observed: &Observed) -> Result<(), String> {
    let run = observed.run.as_ref().expect("it is finished");
    for id in run["entries"].as_array().into_iter().flatten() {
        let id = id.as_str().unwrap_or_default();
        let files = observed.entries.get(id);
        if files.and_then(|files| files.stamp.as_ref()).is_none() {
            return Err(format!(
                "the run is marked as finished, but {id} is not done"
            ));
        }
    }
    Ok(())
}
