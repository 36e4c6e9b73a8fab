//! Mutants: mechanical changes to the reference's task files. They complement the catalogue of
//! mistakes that people make, and are generated without any knowledge of the exam.

pub mod equivalent;
mod families;
mod state;
mod visit;

use std::collections::BTreeMap;

use anyhow::{Context, Result};
use judging::assignment::{Assignment, Task, TaskInfo};

use crate::solutions::solution::{Expected, Solution};
use crate::solutions::sources::Sources;

/// Returns all mutants, sorted by name. A name consists of the file, the family, the change and the
/// function. Identical names are numbered.
pub fn mutants(reference: &Sources) -> Result<Vec<Solution>> {
    let mut found = Vec::new();
    let assignment = reference.handed_out().assignment;
    for file in reference.handed_out().files {
        let text = reference.text(file.name).unwrap_or_default();
        let mut numbers: BTreeMap<String, u32> = BTreeMap::new();
        let changes = families::changes(text);
        for change in changes.with_context(|| format!("cannot parse {}", file.name))? {
            let what = change.what.split_whitespace().collect::<Vec<_>>().join(" ");
            let name = format!("{}: {what}, in {}", file.name, change.function);
            let number = numbers.entry(name.clone()).or_default();
            *number += 1;
            let name = match number {
                1 => name,
                number => format!("{name}, again {number}"),
            };
            let (before, after) = (&text[..change.bytes.start], &text[change.bytes.end..]);
            let text = format!("{before}{}{after}", change.now);
            found.push(Solution {
                id: name,
                title: String::new(),
                sources: reference.clone().with_file(file.name, text),
                expected: Expected {
                    tasks: tasks_of(assignment, file.name, &change.function),
                    ..Expected::default()
                },
            });
        }
    }
    found.sort_by(|a, b| a.id.cmp(&b.id));
    Ok(found)
}

/// Returns the tasks that students write a function with this name in, or all tasks in the file if
/// there are none.
fn tasks_of(assignment: &Assignment, file: &str, function: &str) -> Vec<Task> {
    let in_file = || assignment.tasks.iter().filter(|task| task.file == file);
    let is_named = |path: &&str| path.rsplit("::").next() == Some(function);
    let own = in_file().filter(|task| task.methods.iter().any(is_named));
    let own: Vec<Task> = own.map(TaskInfo::task).collect();
    if own.is_empty() {
        return in_file().map(TaskInfo::task).collect();
    }
    own
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use grader::handed_out::RAYS;

    use super::*;

    #[test]
    fn every_family_changes_every_file_and_nothing_else() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let reference = Sources::reference(&root, &RAYS).expect("the reference can be read");
        let all = mutants(&reference).expect("the reference is Rust code");
        assert!(all.len() > 700, "only {} mutants", all.len());
        for family in [
            "operator",
            "body",
            "epsilon",
            "number",
            "initial value",
            "name",
            "operands",
            "dropped",
            "condition",
            "state",
        ] {
            let family = format!(": {family}: ");
            assert!(
                all.iter().any(|mutant| mutant.id.contains(&family)),
                "{family}"
            );
        }
        for Solution { id, sources, .. } in &all {
            let changed = RAYS.files.iter();
            let changed =
                changed.filter(|file| sources.text(file.name) != reference.text(file.name));
            let changed: Vec<&str> = changed.map(|file| file.name).collect();
            assert_eq!(changed, [id.split(':').next().unwrap_or_default()], "{id}");
        }
    }

    #[test]
    fn a_mutant_is_of_the_task_whose_method_it_changes_or_of_all_tasks_of_the_file() {
        let tasks = |function| -> Vec<&str> {
            let tasks = tasks_of(RAYS.assignment, "bvh.rs", function);
            tasks
                .into_iter()
                .map(|task| RAYS.assignment.info(task).id)
                .collect()
        };
        assert_eq!(tasks("hit"), ["traverse"]);
        assert_eq!(tasks("build"), ["build"]);
        assert_eq!(tasks("build_node"), ["build", "traverse"]);
    }
}
