//! Tests of the workflow that grades every push. The workflow is parsed with a strict model of
//! GitHub's format.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::BUNDLE;

/// A simple workflow: no matrix, no services, no reusable workflows.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Workflow {
    #[serde(rename = "name")]
    _name: String,
    on: BTreeMap<Event, Option<()>>,
    permissions: BTreeMap<String, String>,
    jobs: BTreeMap<String, Job>,
}

#[derive(Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "snake_case")]
enum Event {
    Push,
    WorkflowDispatch,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Job {
    runs_on: String,
    timeout_minutes: u32,
    steps: Vec<Step>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Step {
    #[serde(rename = "name")]
    _name: Option<String>,
    uses: Option<String>,
    #[serde(rename = "with")]
    _with: Option<BTreeMap<String, String>>,
    run: Option<String>,
}

fn workflow() -> Workflow {
    let text = BUNDLE.text(".github/workflows/grade.yml").unwrap();
    serde_saphyr::from_str(text).unwrap()
}

#[test]
fn is_one_short_read_only_job_on_every_push() {
    let workflow = workflow();
    assert!(workflow.on.contains_key(&Event::Push));
    assert_eq!(
        workflow.permissions,
        [("contents".into(), "read".into())].into()
    );
    let [job] = workflow.jobs.values().collect::<Vec<_>>()[..] else {
        panic!("{:?}", workflow.jobs.keys());
    };
    assert!(job.runs_on.starts_with("ubuntu-") && job.timeout_minutes <= 30);
    for step in &job.steps {
        assert!(step.uses.is_some() != step.run.is_some(), "{step:?}");
    }
}

#[test]
fn actions_are_pinned_to_commits() {
    for step in workflow().jobs.values().flat_map(|job| &job.steps) {
        if let Some(action) = &step.uses {
            let (_, commit) = action.split_once('@').unwrap();
            let digits = commit.chars().filter(char::is_ascii_hexdigit).count();
            assert_eq!((digits, commit.len()), (40, 40), "{action}");
        }
    }
}

#[test]
fn a_run_does_not_fail_for_lack_of_points() {
    for step in workflow().jobs.values().flat_map(|job| &job.steps) {
        let run = step.run.as_deref().unwrap_or_default();
        assert!(!run.contains("--require"), "{run}");
    }
}

#[test]
fn the_last_step_grades_and_shows_the_points() {
    let workflow = workflow();
    let steps = workflow.jobs.values().flat_map(|job| &job.steps);
    let last = steps.last().and_then(|step| step.run.clone()).unwrap();
    assert_eq!(last, "cargo grade --out score --format github");
}
