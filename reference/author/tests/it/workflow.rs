//! Tests of the workflow that grades every push. It is parsed with a strict model of GitHub's
//! format.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::harness::BUNDLE;

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

#[test]
fn is_one_short_read_only_job_of_pinned_actions_that_shows_the_points_of_every_push() {
    let text = BUNDLE.text(".github/workflows/grade.yml").unwrap();
    let workflow: Workflow = serde_saphyr::from_str(text).unwrap();
    assert!(workflow.on.contains_key(&Event::Push));
    assert_eq!(
        workflow.permissions,
        [("contents".into(), "read".into())].into()
    );
    let [job] = workflow.jobs.values().collect::<Vec<_>>()[..] else {
        panic!("{:?}", workflow.jobs.keys());
    };
    assert!(job.runs_on.starts_with("ubuntu-") && job.timeout_minutes <= 30);
    for Step { uses, run, .. } in &job.steps {
        assert!(uses.is_some() != run.is_some(), "{uses:?} {run:?}");
        // Actions are pinned to commits.
        if let Some(action) = uses {
            let (_, commit) = action.split_once('@').unwrap();
            let digits = commit.chars().filter(char::is_ascii_hexdigit).count();
            assert_eq!((digits, commit.len()), (40, 40), "{action}");
        }
    }
    // The workflow shows the points and doesn't fail if some are missing.
    let last = job.steps.last().and_then(|step| step.run.as_deref());
    assert_eq!(
        last,
        Some("cargo grade --assignment rays --out score --format github")
    );
    let mut runs = job.steps.iter().filter_map(|step| step.run.as_deref());
    assert!(!runs.any(|run| run.contains("--require")));
}
