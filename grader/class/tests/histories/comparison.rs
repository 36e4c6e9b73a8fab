//! Compares the files of a run that ended well with those of a run in a new folder.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde_json::Value;

use crate::faulty_disk::DiskFault;
use crate::observed::{Observed, all_files};
use crate::recorded_grader::ProcessFault;
use crate::world::{Target, World};

/// The options that write everything that is made of the grades.
pub const EXPORT: [&str; 2] = ["--hand-back", "--canvas=ROOT/gradebook.csv"];
/// The files that these options write.
const EXPORTED: [&str; 2] = ["canvas.csv", "hand-back.zip"];
/// The files that say what a folder has been through, which a new folder has not. They are compared
/// with the model.
const HISTORY: [&str; 4] = ["run.json", "drift.json", "previous.json", "replaced.json"];

type Files = BTreeMap<PathBuf, Vec<u8>>;

/// The files of runs in new folders.
#[derive(Debug, Default)]
pub struct FreshRuns(BTreeMap<(Vec<(&'static str, Option<u32>)>, usize, usize), Files>);

impl FreshRuns {
    /// Returns the files of a run in a new folder, of the class as it is now.
    fn files(&mut self, world: &World) -> &Files {
        let submissions = world
            .submissions
            .iter()
            .map(|(name, version)| (*name, *version));
        let key = (submissions.collect(), world.exam, world.policy);
        self.0.entry(key).or_insert_with(|| {
            let ended = world.grade(Target::Fresh, &EXPORT, DiskFault::None, ProcessFault::None);
            ended.result.expect("nothing goes wrong");
            let files = all_files(&world.folder(Target::Fresh));
            world.remove(Target::Fresh);
            files
        })
    }

    /// Compares the files in a folder with those of a fresh run. `is_exported` says whether the
    /// gradebooks are those of the last run.
    pub fn compare(
        &mut self,
        world: &World,
        target: Target,
        observed: &Observed,
        is_exported: bool,
    ) -> Result<(), String> {
        let found = all_files(&world.folder(target));
        let expected = self.files(world);
        for (name, expected) in expected {
            let last = name.file_name().unwrap_or_default().to_string_lossy();
            if !is_exported && EXPORTED.contains(&&*last) || HISTORY.contains(&&*last) {
                continue;
            }
            if last == "class.html" && has_changes(world, observed) {
                continue;
            }
            let Some(found) = found.get(name) else {
                return Err(format!("{target:?} lacks {}", name.display()));
            };
            let is_same = match &*last {
                "entry.json" => stamp(found) == stamp(expected),
                _ => found == expected,
            };
            if !is_same {
                let (found, expected) = (
                    String::from_utf8_lossy(found),
                    String::from_utf8_lossy(expected),
                );
                let place = first_difference(&found, &expected);
                return Err(format!("{target:?}: {} differs: {place}", name.display()));
            }
        }
        Ok(())
    }
}

/// Returns whether the page of the class lists changes, which a fresh run does not.
fn has_changes(world: &World, observed: &Observed) -> bool {
    let entries = observed.entries.iter();
    observed
        .run
        .as_ref()
        .is_some_and(|run| !run["before"].is_null())
        || entries.clone().any(|(_, files)| files.replaced.is_some())
        || entries
            .into_iter()
            .any(|(id, _)| !world.submissions.contains_key(id.as_str()))
}

/// Returns a stamp without the key and the round.
fn stamp(bytes: &[u8]) -> Value {
    let mut stamp: Value = serde_json::from_slice(bytes).unwrap();
    stamp["key"] = Value::Null;
    stamp["round"] = Value::Null;
    stamp
}

fn first_difference(one: &str, other: &str) -> String {
    let mut pairs = one.lines().zip(other.lines());
    let pair = pairs.find(|(one, other)| one != other);
    let (one, other) = pair.unwrap_or(("(its end)", "(its end)"));
    let short = |line: &str| line.chars().take(300).collect::<String>();
    format!("{} instead of {}", short(one), short(other))
}
