//! Merging the shards of a history, and when that must be possible.

use std::collections::BTreeSet;

use class::grade::Completion;
use serde_json::Value;

use super::{History, text};
use crate::comparison::EXPORT;
use crate::faulty_disk::DiskFault;
use crate::observed::{Keys, observe};
use crate::world::{PARTS, STUDENTS, Target};

impl History {
    pub(super) fn merge(&mut self) -> Result<(), String> {
        let disk = self.disk_fault(Target::Merged);
        self.merge_with(disk)
    }

    pub(super) fn merge_with(&mut self, disk: DiskFault) -> Result<(), String> {
        let is_possible = self.can_merge();
        // Merged entries keep the keys from their shards.
        self.models.entry(Target::Merged).or_default().keys = self.keys();
        let more = [self.manual_option(), EXPORT.to_vec()].concat();
        let ended = self.world.merge(&more, disk);
        self.log
            .push(format!("merge with {disk:?}: {}", text(&ended)));
        let keys = &mut self.models.get_mut(&Target::Merged).unwrap().keys;
        let observed = observe(&self.world.folder(Target::Merged), keys)?;
        if ended.result.is_ok() != is_possible && !ended.had_disk_fault {
            return Err(format!(
                "a merge that is possible: {is_possible}: {}",
                text(&ended)
            ));
        }
        if disk == DiskFault::None {
            self.operations.insert(Target::Merged, ended.operations);
        }
        let is_complete = matches!(ended.result, Ok(Completion::Complete));
        // The shards may have been graded before the last submissions came in.
        if is_complete && self.parts_are_current() {
            self.check_leftovers(Target::Merged)?;
            let parts = (1..=PARTS).map(|part| &self.models[&Target::Part(part)].observed);
            let history: Vec<_> = [&observed].into_iter().chain(parts).collect();
            self.fresh
                .compare(&self.world, Target::Merged, &history, true)?;
        }
        self.models.get_mut(&Target::Merged).unwrap().observed = observed;
        Ok(())
    }

    fn keys(&self) -> Keys {
        let parts = (1..=PARTS).filter_map(|part| self.models.get(&Target::Part(part)));
        parts.flat_map(|part| part.keys.clone()).collect()
    }

    pub(super) fn can_merge(&self) -> bool {
        let runs =
            (1..=PARTS).map(|part| self.models.get(&Target::Part(part))?.observed.run.clone());
        let runs: Option<Vec<Value>> = runs.collect();
        runs.is_some_and(|runs| {
            let same = |name: &str| runs.iter().all(|run| run[name] == runs[0][name]);
            let hash = |run: &Value, kind: &str| run["lists"][kind]["hash"].clone();
            let same_list = |kind: &str| {
                runs.iter()
                    .all(|run| hash(run, kind) == hash(&runs[0], kind))
            };
            let finished = runs.iter().all(|run| run["state"] == "finished");
            let own = self.has_own_manual_points();
            let has_manual = own || runs[0]["lists"]["manual-points"].is_object();
            let mut ids = runs
                .iter()
                .flat_map(|run| run["entries"].as_array().unwrap());
            let has_student = ids.any(|id| id == STUDENTS[0]);
            finished
                && same("settings")
                && same("class")
                && same_list("policy")
                && (own || same_list("manual-points"))
                && (has_student || !has_manual)
        })
    }

    /// Returns whether manual points are passed to the next merge or were passed to an earlier one.
    fn has_own_manual_points(&self) -> bool {
        let merged = self.models.get(&Target::Merged);
        let run = merged.and_then(|model| model.observed.run.as_ref());
        let list = run.map(|run| &run["lists"]["manual-points"]);
        let is_own = |list: &Value| list.is_object() && list["is_of_parts"].is_null();
        self.world.manual > 0 || list.is_some_and(is_own)
    }

    pub(super) fn parts_are_current(&self) -> bool {
        let class = self.expected(Target::Whole);
        let policy = Some(self.world.policy).filter(|number| *number > 0);
        let policy = policy.map(|number| format!("policy-{number}.toml"));
        let mut ids = BTreeSet::new();
        for part in 1..=PARTS {
            let observed = &self.models[&Target::Part(part)].observed;
            // Scores don't show the exam if there was nothing to grade.
            if observed.exam() != Some(self.world.exam) {
                return false;
            }
            let run = observed.run.as_ref().expect("it was merged");
            for id in run["entries"].as_array().unwrap() {
                let id = id.as_str().unwrap();
                let score = observed.entries[id].graded();
                if class.get(id) != Some(&score) || observed.list("policy") != policy.as_deref() {
                    return false;
                }
                ids.insert(id.to_owned());
            }
        }
        ids.len() == class.len()
    }
}
