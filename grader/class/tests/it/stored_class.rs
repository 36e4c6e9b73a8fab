//! Random classes in the state after grading. Their files are written without grading, since the
//! tests that use them are about what happens to scores afterwards.

use std::fs;
use std::path::{Path, PathBuf};

use class::entry::{EntryInfo, Person};
use class::outcome::{EntryOutcome, EntryResult, ScoreSummary};
use class::run::{RoundState, Run, Settings};
use class::shard::Shard;
use class::store::Store;
use grader::handed_out::RAYS;
use judging::content_hash::file_hash;
use proptest::collection::vec;
use proptest::prelude::*;
use serde_json::{Value, json};

/// A graded submission.
#[derive(Clone, Debug)]
pub struct StoredEntry {
    /// The points of each task. `None` if there was nothing to grade.
    pub points: Option<Vec<u32>>,
    /// The number of people who handed in the submission.
    pub people: usize,
    /// The hours between the due time, 2026-11-20 12:00 UTC, and the submission.
    pub hours_late: i64,
    /// The manual points for the first task. Everyone who handed in the submission gets them,
    /// unless they would take the task's total out of range.
    pub manual: i32,
    /// Whether an earlier version of the submission was graded and got no points.
    pub is_resubmitted: bool,
}

/// Returns a class of at most seven submissions.
pub fn stored_class() -> impl Strategy<Value = Vec<StoredEntry>> {
    vec(stored_entry(), 1..8)
}

fn stored_entry() -> impl Strategy<Value = StoredEntry> {
    let tasks = RAYS.assignment.tasks.iter();
    let points: Vec<_> = tasks.map(|task| 0..=task.points).collect();
    let points = prop::option::weighted(0.85, points);
    (points, 1..3usize, -30..80i64, -3..4i32, any::<bool>()).prop_map(
        |(points, people, hours_late, manual, is_resubmitted)| StoredEntry {
            points,
            people,
            hours_late,
            manual,
            is_resubmitted,
        },
    )
}

impl StoredEntry {
    /// Returns the manual points, or 0 if they would take the first task's total out of range or if
    /// there was nothing to grade.
    pub fn possible_manual(&self) -> i32 {
        let most = RAYS.assignment.tasks[0].points;
        let sum = |points: &Vec<u32>| points[0].checked_add_signed(self.manual);
        match self.points.as_ref().map(sum) {
            Some(Some(sum)) if sum <= most => self.manual,
            Some(_) | None => 0,
        }
    }
}

/// Returns the id of the submission at this index in the class.
pub fn id(index: usize) -> String {
    format!("s{index:02}")
}

/// Returns the people of a submission.
pub fn people(index: usize, entry: &StoredEntry) -> Vec<Person> {
    let person = |member: usize| {
        let who = format!("{index}{member}");
        Person {
            email: format!("u{who}@example.edu"),
            sid: format!("n{who}"),
            login: format!("u{who}"),
            ..Person::named(format!("Ann {who}"))
        }
    };
    (0..entry.people).map(person).collect()
}

fn score(points: &[u32]) -> Value {
    let tasks = RAYS.assignment.tasks.iter().zip(points);
    let tasks: Vec<Value> = tasks
        .map(|(task, points)| {
            let item = json!({
                "id": format!("{}.item", task.id), "title": "It works", "points": points,
                "max_points": task.points, "verdict": "failed", "message": "", "hints": [],
            });
            json!({
                "id": task.id, "title": task.title, "points": points,
                "max_points": task.points, "items": [item],
            })
        })
        .collect();
    let max_points: u32 = RAYS.assignment.tasks.iter().map(|task| task.points).sum();
    json!({ "points": points.iter().sum::<u32>(), "max_points": max_points, "tasks": tasks })
}

/// Writes a shard of the class in the state after a finished run. If `stale` is true, it also
/// contains an entry for somebody who has since left the class.
pub fn write_shard(folder: &Path, class: &[StoredEntry], shard: Option<Shard>, stale: bool) {
    let store = Store::new(folder);
    let all: Vec<(usize, &StoredEntry)> = class.iter().enumerate().collect();
    let own = shard.unwrap_or(Shard::ALL).select(all);
    for (index, entry) in &own {
        write_entry(&store, &id(*index), people(*index, entry), entry);
    }
    if stale {
        let gone = StoredEntry {
            points: Some(vec![0; RAYS.assignment.tasks.len()]),
            people: 1,
            hours_late: 0,
            manual: 0,
            is_resubmitted: false,
        };
        write_entry(&store, "gone", vec![Person::named("Gone")], &gone);
    }
    let ids: Vec<String> = (0..class.len()).map(id).collect();
    let tasks = RAYS.assignment.tasks.iter();
    let items = tasks.map(|task| (format!("{}.item", task.id), task.points));
    let run = Run {
        shard,
        state: RoundState::Finished,
        entries: own.iter().map(|(index, _)| id(*index)).collect(),
        class: file_hash(ids.join("\n").as_bytes()),
        items: items.collect(),
        ..Run::first_round(Settings {
            exam: "small".to_owned(),
            exam_hash: "0123456789abcdef".to_owned(),
            grader: "grader".to_owned(),
            built_with: "compiler".to_owned(),
            isolation: "none".to_owned(),
            options: String::new(),
        })
    };
    store.write_run(&run).unwrap();
}

fn write_entry(store: &Store, id: &str, people: Vec<Person>, entry: &StoredEntry) {
    let folder = store.entry_folder(id);
    fs::create_dir_all(&folder).unwrap();
    let outcome = match &entry.points {
        Some(points) => {
            let text = score(points).to_string();
            fs::write(folder.join("score.json"), &text).unwrap();
            let page = "<!--counted--><!--/counted-->";
            fs::write(folder.join("report.html"), page).unwrap();
            fs::write(folder.join("feedback.html"), page).unwrap();
            if entry.is_resubmitted {
                let none = score(&vec![0; points.len()]).to_string();
                fs::write(folder.join("replaced.json"), none).unwrap();
            }
            EntryOutcome::Graded(Box::new(ScoreSummary::parse(&text).unwrap()))
        }
        None => EntryOutcome::NothingToGrade("it has no task files".to_owned()),
    };
    let due: jiff::Timestamp = "2026-11-20T12:00:00Z".parse().unwrap();
    let submitted = due + jiff::SignedDuration::from_hours(entry.hours_late);
    let result = EntryResult {
        id: id.to_owned(),
        info: EntryInfo {
            people,
            submitted: Some(submitted.to_string()),
            from: id.to_owned(),
            ..EntryInfo::default()
        },
        outcome,
    };
    store.save_result(&result, "key", 1).unwrap();
}

/// Writes all shards of a class. Returns their folders.
pub fn write_shards(root: &Path, class: &[StoredEntry], of: usize, stale: bool) -> Vec<PathBuf> {
    let write = |part: usize| {
        let folder = root.join(format!("{part}-of-{of}"));
        let shard: Shard = format!("{part}/{of}").parse().unwrap();
        write_shard(&folder, class, Some(shard), stale && part == of);
        folder
    };
    (1..=of).map(write).collect()
}
