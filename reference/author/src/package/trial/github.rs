//! The trial of the template repository: what its workflow runs, in a student's checkout, as the
//! runner's user.

use std::fs;
use std::path::Path;
use std::time::Duration;

use grader::given_files::TASK_FILES;

use crate::bundle::{Bundle, archive};
use crate::package::trial::runner::{Runner, StepResult};
use crate::package::trial::submission::TrialSubmission;
use crate::package::trial::{TrialError, check_time, io_error};

/// Where it is tried, from the workspace's root.
const TRIAL_FOLDER: &str = "target/package/github";
const WORKFLOW: &str = ".github/workflows/grade.yml";
/// What the workflow gives a push.
const TIME_LIMIT: Duration = Duration::from_secs(20 * 60);
/// What is compiled stays from one push to the next, as the workflow's cache keeps it.
const VARIABLES: [&str; 1] = ["CARGO_TARGET_DIR=/home/runner/built"];

/// Tries the repository, and tells what is not as it should be.
pub fn check(workspace: &Path, template: &Bundle) -> Result<Vec<String>, TrialError> {
    let mut complaints = Vec::new();
    let workspace = &workspace.canonicalize().map_err(io_error(workspace))?;
    let lock = template.text("Cargo.lock").unwrap_or_default();
    let Some(runner) = Runner::create(&workspace.join(TRIAL_FOLDER), lock)? else {
        return Ok(complaints);
    };
    let commands = grading_commands(template.text(WORKFLOW).unwrap_or_default());
    if commands.is_empty() {
        complaints.push(format!("{WORKFLOW} grades nothing"));
    }
    for handed_in in [
        TrialSubmission::Reference,
        TrialSubmission::Starter,
        TrialSubmission::Empty,
    ] {
        runner.create_checkout(|checkout| {
            archive::write_files(template, checkout).map_err(io_error(checkout))?;
            replace_task_files(handed_in, workspace, &checkout.join("student/src"))
        })?;
        for command in &commands {
            let words: Vec<&str> = command.split_whitespace().collect();
            let step = runner.run_step(&VARIABLES, &words)?;
            check_time(
                handed_in.description(),
                &step.job,
                TIME_LIMIT,
                &mut complaints,
            );
            if !is_correct(handed_in, &step) {
                let (whose, summary) = (handed_in.description(), &step.summary);
                complaints.push(format!("{whose}: {summary:.300}\n{}", step.job.output));
            }
        }
    }
    Ok(complaints)
}

/// Puts what is handed in over the template's five files.
fn replace_task_files(
    handed_in: TrialSubmission,
    workspace: &Path,
    source: &Path,
) -> Result<(), TrialError> {
    let folder = &source.with_file_name("handed-in");
    handed_in.write_to(workspace, folder)?;
    for file in TASK_FILES {
        let (from, to) = (folder.join(file.name), source.join(file.name));
        fs::remove_file(&to).map_err(io_error(&to))?;
        if from.exists() {
            fs::rename(&from, &to).map_err(io_error(&from))?;
        }
    }
    fs::remove_dir_all(folder).map_err(io_error(folder))
}

/// What the workflow runs of ours: the toolchain is on the machine already.
fn grading_commands(workflow: &str) -> Vec<String> {
    let runs = workflow
        .lines()
        .filter_map(|line| line.trim().strip_prefix("run: "));
    runs.filter(|command| command.starts_with("cargo "))
        .map(str::to_owned)
        .collect()
}

/// Whether the run's page shows the points, and each first mistake stands beside its line.
fn is_correct(handed_in: TrialSubmission, step: &StepResult) -> bool {
    let says = |text: &str| step.job.output.lines().any(|line| line.starts_with(text));
    let points = format!("## {} of 100 points", handed_in.points());
    let is_shown = step.summary.starts_with(&points);
    match handed_in {
        TrialSubmission::Reference => step.job.code == Some(0) && is_shown && !says("::error"),
        TrialSubmission::Starter => {
            step.job.code == Some(0) && is_shown && says("::error file=student/src/camera.rs,line=")
        }
        TrialSubmission::Empty | TrialSubmission::Thief => {
            step.job.code == Some(2) && step.job.output.contains("camera.rs, triangle.rs")
        }
    }
}
