//! The recipe for GitHub Actions and the workflows of this repository, checked against
//! SchemaStore's schema for GitHub workflows.

use std::path::PathBuf;

use serde_json::Value;

use super::assert_exam_and_policy;
use super::schema::{Schema, parse_yaml};
use crate::harness::{files_below, source, workspace};

/// The recipe, the workflow for students, and the workflows that test this repository and the
/// bundle.
const WORKFLOWS: [&str; 4] = [
    "grader/class/recipes/github-matrix.yml",
    "reference/author/src/bundle/templates/grade.yml",
    ".github/workflows/ci.yml",
    ".github/workflows/bundle.yml",
];

#[test]
fn every_workflow_matches_the_published_schema() {
    let schema = Schema::read("github-workflow.json");
    for path in WORKFLOWS {
        let text = source(path);
        schema.check(path, &parse_yaml(&text));
        for (from, to) in [
            ("runs-on:", "run-on:"),
            ("timeout-minutes: ", "timeout-minutes: about "),
            ("uses:", "use:"),
            ("contents: read", "contents: reading"),
        ] {
            schema.check_that_it_rejects(&text, from, to);
        }
    }
}

#[test]
fn no_workflow_is_left_out() {
    let folders = ["grader/class/recipes", "reference/author/src", ".github"];
    let files = folders.map(|folder| files_below(&workspace().join(folder)));
    let is_workflow = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "yml");
    let mut found: Vec<PathBuf> = files.concat().into_iter().filter(is_workflow).collect();
    found.sort();
    let mut expected = WORKFLOWS.map(|path| workspace().join(path));
    expected.sort();
    assert_eq!(found, expected);
}

/// Returns the commands of a job.
fn commands(job: &Value) -> String {
    let steps = job["steps"].as_array().unwrap().iter();
    let commands = steps.filter_map(|step| step["run"].as_str());
    commands.collect::<Vec<&str>>().join("\n")
}

/// Checks requirements that the schema doesn't enforce.
#[test]
fn the_recipe_grades_every_part_and_then_merges() {
    let text = source(WORKFLOWS[0]);
    let workflow = parse_yaml(&text);
    // The workflow must not start on every push.
    assert_eq!(
        workflow["on"],
        serde_json::json!({ "workflow_dispatch": {} })
    );
    assert_eq!(
        workflow["permissions"],
        serde_json::json!({ "contents": "read" })
    );
    let jobs = workflow["jobs"].as_object().unwrap();
    assert!(
        jobs.values()
            .all(|job| job["timeout-minutes"].as_u64() > Some(0))
    );

    let shard = &jobs["shard"];
    // A failing shard must not stop the others.
    assert_eq!(shard["strategy"]["fail-fast"], false);
    let parts = shard["strategy"]["matrix"]["part"].as_array().unwrap();
    let expected: Vec<Value> = (1..=parts.len()).map(Value::from).collect();
    assert_eq!(*parts, expected);
    let grade = commands(shard);
    assert_exam_and_policy(&grade);
    assert!(grade.contains("--shard \"$PART/$PARTS\""), "{grade}");
    assert!(text.contains("PARTS: ${{ strategy.job-total }}"));
    assert!(workflow["env"]["OPTIONS"].is_string());

    let merge = &jobs["merge"];
    assert_eq!(merge["needs"], "shard");
    assert!(commands(merge).contains("cargo class merge"));
}
