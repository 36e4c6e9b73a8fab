//! The results of entries, in memory and in storage.

use std::collections::BTreeMap;

use grader::policy::{ItemPoints, TaskPoints};
use judging::sanitize::sanitize;
use serde::de::Error;
use serde::{Deserialize, Serialize};

use crate::entry::EntryInfo;

/// The maximum length of a fault's message, in characters.
const MAX_FAULT_CHARS: usize = 2_000;

/// The result of an entry.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct EntryResult {
    /// The entry's id, which is the name of its folder.
    #[serde(skip)]
    pub id: String,
    /// Information about the submission, such as who handed it in.
    #[serde(rename = "about")]
    pub info: EntryInfo,
    /// The outcome of grading the entry.
    #[serde(flatten)]
    pub outcome: EntryOutcome,
}

/// The outcome of grading an entry.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "state", content = "why", rename_all = "snake_case")]
pub enum EntryOutcome {
    /// The entry was graded. A stored stamp doesn't include the score, which is in `score.json`.
    Graded(#[serde(with = "without_score")] Box<ScoreSummary>),
    /// There was nothing to grade, for this reason. The teacher decides how many points the
    /// submission gets.
    #[serde(rename = "no_submission")]
    NothingToGrade(String),
    /// The grader or the machine failed, for this reason. The next run tries again.
    Fault(String),
}

/// Stores an outcome without its score.
mod without_score {
    use serde::{Deserialize, Deserializer, Serializer};

    use super::ScoreSummary;

    #[expect(clippy::borrowed_box, reason = "serde passes a reference")]
    pub(super) fn serialize<S: Serializer>(
        _: &Box<ScoreSummary>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        serializer.serialize_unit()
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Box<ScoreSummary>, D::Error> {
        <()>::deserialize(deserializer).map(|()| Box::default())
    }
}

/// The parts of `score.json` that the class's files need.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
pub struct ScoreSummary {
    /// The sum of the points of all tasks.
    pub points: u32,
    /// The maximum number of points.
    pub max_points: u32,
    /// The tasks, in lecture order.
    pub tasks: Vec<TaskScore>,
    /// The notes about the submission's files.
    #[serde(default)]
    pub build: FileNotes,
}

/// The parts of a score's build report that the class's files need.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
pub struct FileNotes {
    /// The files that could not be compiled.
    #[serde(default)]
    pub not_compiled: Vec<UncompiledFile>,
    /// Notes about files that look like task files or archives but were not graded.
    #[serde(default)]
    pub ignored_copies: Vec<String>,
}

/// A file that could not be compiled.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct UncompiledFile {
    /// The file's name, such as `sphere.rs`.
    pub file: String,
    /// Whether the file is missing from the submission.
    #[serde(default, rename = "missing")]
    pub is_missing: bool,
}

/// The score of a task.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
pub struct TaskScore {
    /// The task's id, such as `sphere`.
    pub id: String,
    /// The task's human-readable title.
    pub title: String,
    /// The sum of its items' points.
    pub points: u32,
    /// The maximum number of points.
    pub max_points: u32,
    /// The items, in the order of the exam.
    pub items: Vec<ItemScore>,
}

/// Returns the tasks of an exam with 0 points each. `items` contains the maximum points for each
/// item.
pub fn exam_tasks(items: &BTreeMap<String, u32>) -> Vec<TaskScore> {
    let mut tasks: BTreeMap<&str, TaskScore> = BTreeMap::new();
    for (id, points) in items {
        let name = id.split('.').next().unwrap_or(id);
        let task = tasks.entry(name).or_default();
        name.clone_into(&mut task.id);
        task.max_points += points;
        task.items.push(ItemScore {
            id: id.clone(),
            max_points: *points,
            ..ItemScore::default()
        });
    }
    tasks.into_values().collect()
}

/// The score of an item.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
pub struct ItemScore {
    /// The item's id, such as `sphere.from_inside`.
    pub id: String,
    /// The item's title: a sentence that describes the correct behaviour.
    pub title: String,
    /// The points that the submission got for the item.
    pub points: u32,
    /// The maximum number of points.
    pub max_points: u32,
    /// The verdict, as in `score.json`.
    pub verdict: String,
    /// The id of the item that blocks this one, if any.
    #[serde(default, rename = "by")]
    pub blocked_by: Option<String>,
    /// The explanation of the verdict, in a sentence.
    pub message: String,
    /// The known mistakes that give the same answers, starting with the most likely one.
    pub hints: Vec<Hint>,
}

impl TaskScore {
    /// Returns the task in the form that the policy uses, including the points that staff gave by
    /// hand.
    pub fn for_policy(&self, manual: i32) -> TaskPoints<'_> {
        let items = self.items.iter().map(|item| ItemPoints {
            id: &item.id,
            points: item.points,
            max_points: item.max_points,
            blocked_by: item.blocked_by.as_deref(),
        });
        TaskPoints {
            id: &self.id,
            points: self.points,
            max_points: self.max_points,
            manual,
            items: items.collect(),
        }
    }
}

/// A known mistake.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct Hint {
    /// The text of the hint.
    pub hint: String,
}

/// The contents of `entry.json`. The file is written last, so if it exists, the entry is complete.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Stamp {
    /// The cache key: a hash of the submission and everything else its score depends on. Empty if
    /// there is no score.
    pub key: String,
    /// The round that the entry was graded in.
    pub round: u32,
    /// The result, without its id (the folder's name) and its score (stored in a separate file).
    #[serde(flatten)]
    pub result: EntryResult,
}

impl ScoreSummary {
    /// Parses a score file. Since the file may come from another machine, it is rejected if it
    /// contains more points than an exam can have.
    pub fn parse(text: &str) -> Result<Self, serde_json::Error> {
        /// The maximum number of points in a score file. No exam has more, and the sum over a class
        /// doesn't overflow.
        const MAX_POINTS: u32 = 100_000;
        let score: ScoreSummary = serde_json::from_str(text)?;
        match score.all_points().max() {
            Some(points) if points > MAX_POINTS => Err(serde_json::Error::custom(format!(
                "{points} points is more than an exam can have"
            ))),
            Some(_) | None => Ok(score),
        }
    }

    fn all_points(&self) -> impl Iterator<Item = u32> {
        let tasks = self.tasks.iter();
        let tasks = tasks.flat_map(|task| [task.points, task.max_points]);
        let items = self.items().flat_map(|item| [item.points, item.max_points]);
        tasks.chain(items).chain([self.points, self.max_points])
    }

    /// Returns the tasks in the form that the policy uses, without manual points.
    pub fn for_policy(&self) -> Vec<TaskPoints<'_>> {
        let tasks = self.tasks.iter();
        tasks.map(|task| task.for_policy(0)).collect()
    }

    /// Returns the items of all tasks.
    pub fn items(&self) -> impl Iterator<Item = &ItemScore> {
        self.tasks.iter().flat_map(|task| &task.items)
    }
}

impl EntryOutcome {
    /// Returns the outcome for a failure of the grader or the machine. `why` is the reason.
    pub fn fault(why: &str) -> Self {
        EntryOutcome::Fault(sanitize(why, MAX_FAULT_CHARS))
    }

    /// Returns the reason that there is no score, or an empty string if there is a score.
    pub fn why(&self) -> &str {
        match self {
            EntryOutcome::Graded(_) => "",
            EntryOutcome::NothingToGrade(why) | EntryOutcome::Fault(why) => why,
        }
    }
}

impl EntryResult {
    /// Returns the notes about files that look like task files or archives but were not graded.
    pub fn ignored_copies(&self) -> &[String] {
        self.score()
            .map_or(&[], |score| &score.build.ignored_copies)
    }

    /// Returns the names of the files that the exam tests but that a graded submission lacks.
    pub fn missing_files(&self) -> impl Iterator<Item = &str> {
        self.score().into_iter().flat_map(|score| {
            let files = score.build.not_compiled.iter();
            let files = files.filter_map(|file| file.is_missing.then_some(file.file.as_str()));
            files.filter(|file| score.items().any(|item| item.message.starts_with(file)))
        })
    }

    /// Returns the score, if any.
    pub fn score(&self) -> Option<&ScoreSummary> {
        match &self.outcome {
            EntryOutcome::Graded(score) => Some(score),
            EntryOutcome::NothingToGrade(_) | EntryOutcome::Fault(_) => None,
        }
    }
}

/// Returns an entry's id and, if they differ from it, the names of its people.
pub fn id_and_names(id: &str, names: &str) -> String {
    match names {
        names if names == id => id.to_owned(),
        names => format!("{id} ({names})"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parses a score file where one number has this value and all others are small.
    fn parse(place: usize, number: u64) -> Result<ScoreSummary, serde_json::Error> {
        let mut numbers = [1; 6];
        numbers[place] = number;
        let [points, max, task, task_max, item, item_max] = numbers;
        ScoreSummary::parse(&format!(
            r#"{{"points": {points}, "max_points": {max}, "tasks": [{{
                "id": "sphere", "title": "", "points": {task}, "max_points": {task_max},
                "items": [{{"id": "sphere.uv", "title": "", "points": {item},
                    "max_points": {item_max}, "verdict": "pass", "message": "", "hints": []}}]
            }}]}}"#
        ))
    }

    #[test]
    fn no_number_in_a_score_file_may_be_more_than_an_exam_has() {
        for place in 0..6 {
            assert!(parse(place, 100_000).is_ok(), "{place}");
            let error = parse(place, 100_001).unwrap_err().to_string();
            assert_eq!(error, "100001 points is more than an exam can have");
        }
        assert!(parse(0, 1 << 32).is_err());
    }

    #[test]
    fn a_score_has_the_items_of_all_tasks_and_only_graded_entries_have_one() {
        let score = parse(0, 7).unwrap();
        let ids: Vec<&str> = score.items().map(|item| item.id.as_str()).collect();
        assert_eq!(ids, ["sphere.uv"]);
        let result = |outcome| EntryResult {
            id: String::new(),
            info: EntryInfo::default(),
            outcome,
        };
        let graded = result(EntryOutcome::Graded(Box::new(score.clone())));
        assert_eq!(graded.score(), Some(&score));
        let why = String::new;
        assert_eq!(result(EntryOutcome::NothingToGrade(why())).score(), None);
        assert_eq!(result(EntryOutcome::Fault(why())).score(), None);
    }
}
