//! Compares the files from a successful run with those from a run in a new folder.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde_json::Value;

use crate::faulty_disk::DiskFault;
use crate::observed::{Files, Observed, all_files};
use crate::recorded_grader::ProcessFault;
use crate::world::{Target, World};

/// The options for writing all files derived from the grades.
pub const EXPORT: [&str; 2] = ["--hand-back", "--canvas=ROOT/gradebook.csv"];
/// The files that record a folder's history. A new folder starts without one, so these files are
/// compared with the model instead.
const HISTORY: [&str; 5] = [
    "run.json",
    "drift.json",
    "final-grades.json",
    "previous.json",
    "replaced.json",
];

/// Everything that the files of a run in a new folder depend on.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Class {
    submissions: BTreeMap<&'static str, Option<u32>>,
    exam: usize,
    policy: usize,
    options: Vec<String>,
}

type Contents = BTreeMap<PathBuf, Vec<u8>>;

/// The files that runs wrote into new folders, keyed by class.
#[derive(Debug, Default)]
pub struct FreshRuns(BTreeMap<Class, Contents>);

impl FreshRuns {
    /// Returns the files that a run with the current class writes into a new folder.
    fn files(&mut self, world: &World, observed: &Observed) -> &Contents {
        // A gradebook also lists everyone who should have submitted something.
        let exported = observed.list("canvas").map(|_| EXPORT.map(str::to_owned));
        let exported = exported.into_iter().flatten();
        let manual = observed.list("manual-points");
        let manual = manual.map(|name| format!("--manual-points=ROOT/{name}"));
        let options: Vec<String> = exported.chain(manual).collect();
        let class = Class {
            submissions: world.submissions.clone(),
            exam: world.exam,
            policy: world.policy,
            options: options.clone(),
        };
        self.0.entry(class).or_insert_with(|| {
            let more: Vec<&str> = options.iter().map(String::as_str).collect();
            let ended = world.grade(Target::Fresh, &more, DiskFault::None, ProcessFault::None);
            ended.result.expect("nothing goes wrong");
            let files = all_files(&world.folder(Target::Fresh));
            world.remove(Target::Fresh);
            files
        })
    }

    /// Compares the files in a folder with those from a fresh run that uses all of the folder's
    /// lists. `history` describes the folder, followed by the folders merged into it.
    /// `is_handed_back` says whether the run used [`EXPORT`].
    pub fn compare(
        &mut self,
        world: &World,
        target: Target,
        history: &[&Observed],
        is_handed_back: bool,
    ) -> Result<(), String> {
        let found = all_files(&world.folder(target));
        let expected = self.files(world, history[0]);
        for (name, expected) in expected {
            let last = name.file_name().unwrap_or_default().to_string_lossy();
            if HISTORY.contains(&&*last) {
                continue;
            }
            if last == "class.html" && has_changes(world, history) {
                continue;
            }
            let Some(found) = found.get(name) else {
                // Lists are remembered. The archive to hand back is only written on request, but
                // then kept up to date.
                if last == "hand-back.zip" && !is_handed_back {
                    continue;
                }
                return Err(format!("{target:?} lacks {}", name.display()));
            };
            let is_same = match &*last {
                "entry.json" => stamp(found, target) == stamp(expected, target),
                _ => found == expected,
            };
            if !is_same {
                let [found, expected] =
                    [found, expected].map(|bytes| String::from_utf8_lossy(bytes));
                let place = first_difference(&found, &expected);
                return Err(format!("{target:?}: {} differs: {place}", name.display()));
            }
        }
        Ok(())
    }
}

/// Returns whether the class's page lists changes, which a fresh run's page doesn't.
fn has_changes(world: &World, history: &[&Observed]) -> bool {
    let mut history = history.iter();
    history.any(|observed| lists_changes(world, observed))
}

fn lists_changes(world: &World, observed: &Observed) -> bool {
    let is_changed = |(id, files): (&String, &Files)| {
        files.replaced.is_some() || !world.submissions.contains_key(id.as_str())
    };
    let run = observed.run.as_ref();
    run.is_some_and(|run| !run["before"].is_null())
        || observed.has_changed_grades
        || observed.entries.iter().any(is_changed)
}

/// Returns a stamp without the key and the round. After a merge, the people come from the lists
/// that the shards were graded with.
fn stamp(bytes: &[u8], target: Target) -> Value {
    let mut stamp: Value = serde_json::from_slice(bytes).unwrap();
    if target == Target::Merged {
        stamp["about"] = Value::Null;
    }
    stamp["key"] = Value::Null;
    stamp["round"] = Value::Null;
    stamp
}

/// Returns both texts, starting shortly before the first difference.
fn first_difference(one: &str, other: &str) -> String {
    let same = one.chars().zip(other.chars());
    let same = same.take_while(|(one, other)| one == other);
    let from = same.count().saturating_sub(60);
    let short = |text: &str| text.chars().skip(from).take(160).collect::<String>();
    format!("{:?} instead of {:?}", short(one), short(other))
}
