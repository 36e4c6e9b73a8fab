//! The recipe for GitHub Actions and the workflows of this repository, checked with SchemaStore's
//! schema of GitHub workflows.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::schema::{Schema, parse_yaml};
use super::{assert_exam_and_policy, recipe};
use crate::harness::workspace;

/// The recipe, the workflow that students get, and those that test this repository and the bundle.
const WORKFLOWS: [&str; 4] = [
    "grader/class/recipes/github-matrix.yml",
    "reference/author/src/bundle/templates/grade.yml",
    ".github/workflows/ci.yml",
    ".github/workflows/bundle.yml",
];

fn read(path: &str) -> String {
    fs::read_to_string(workspace().join(path)).unwrap()
}

#[test]
fn every_workflow_matches_the_published_schema() {
    let schema = Schema::read("github-workflow.json");
    for path in WORKFLOWS {
        let text = read(path);
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

/// Adds the workflows below a folder: every file that ends in `.yml`.
fn collect_workflows(folder: &Path, workflows: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect_workflows(&path, workflows);
        } else if path.extension().is_some_and(|ending| ending == "yml") {
            workflows.push(path);
        }
    }
}

#[test]
fn no_workflow_is_left_out() {
    let mut found = Vec::new();
    for folder in ["grader/class/recipes", "reference/author/src", ".github"] {
        collect_workflows(&workspace().join(folder), &mut found);
    }
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

/// Checks what the schema allows, but the recipe must not do.
#[test]
fn the_recipe_grades_every_part_and_then_merges() {
    let text = fs::read_to_string(recipe("github-matrix.yml")).unwrap();
    let workflow = parse_yaml(&text);
    // It must not start with every push.
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
    // A failing part must not stop the others.
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
