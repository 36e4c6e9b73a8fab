//! The trial of the template repository for GitHub: runs the commands of its workflow in a
//! student's checkout, as the runner's user.

use std::fs;
use std::path::Path;
use std::time::Duration;

use grader::files::AtPath;
use grader::handed_out::HandedOut;

use crate::bundle::{Bundle, archive};
use crate::package::trial::runner::{Runner, StepResult};
use crate::package::trial::submission::TrialSubmission;
use crate::package::trial::{TrialError, check_time};

/// The folder of the trial, relative to the workspace's root.
const TRIAL_FOLDER: &str = "target/package/github";
/// The workflow's file in the template.
const WORKFLOW: &str = ".github/workflows/grade.yml";
/// The workflow's time limit for a push.
const TIME_LIMIT: Duration = Duration::from_secs(20 * 60);
/// The environment variable that makes the next push reuse compiled files, as the workflow's cache
/// does.
const VARIABLES: [&str; 1] = ["CARGO_TARGET_DIR=/home/runner/built"];

/// Runs the trial of the template repository, and returns the problems found.
pub fn check(
    handed_out: &HandedOut,
    workspace: &Path,
    template: &Bundle,
) -> Result<Vec<String>, TrialError> {
    let mut problems = Vec::new();
    let workspace = &workspace.canonicalize().at("read", workspace)?;
    let lock = template.text("Cargo.lock").unwrap_or_default();
    let Some(runner) = Runner::create(&workspace.join(TRIAL_FOLDER), lock)? else {
        return Ok(problems);
    };
    let commands = grading_commands(template.text(WORKFLOW).unwrap_or_default());
    if commands.is_empty() {
        problems.push(format!("{WORKFLOW} has no step that runs a cargo command"));
    }
    for submission in [
        TrialSubmission::Reference,
        TrialSubmission::Starter,
        TrialSubmission::Empty,
    ] {
        runner.create_checkout(|checkout| {
            archive::write_files(template, checkout)?;
            replace_task_files(
                handed_out,
                submission,
                workspace,
                &checkout.join(handed_out.student),
            )
        })?;
        for command in &commands {
            let words: Vec<&str> = command.split_whitespace().collect();
            let step = runner.run_step(&VARIABLES, &words)?;
            check_time(
                submission.description(),
                &step.job,
                TIME_LIMIT,
                &mut problems,
            );
            if !is_correct(submission, &step) {
                let (name, summary) = (submission.description(), &step.summary);
                problems.push(format!("{name}: {summary:.300}\n{}", step.job.output));
            }
        }
    }
    Ok(problems)
}

/// Replaces the template's task files with those of the submission.
fn replace_task_files(
    handed_out: &HandedOut,
    submission: TrialSubmission,
    workspace: &Path,
    source: &Path,
) -> Result<(), TrialError> {
    let folder = &source.with_file_name("submission");
    submission.write_to(handed_out, workspace, folder)?;
    for file in handed_out.files {
        let (from, to) = (folder.join(file.name), source.join(file.name));
        fs::remove_file(&to).at("remove", &to)?;
        if from.exists() {
            fs::rename(&from, &to).at("rename", &from)?;
        }
    }
    Ok(fs::remove_dir_all(folder).at("remove", folder)?)
}

/// Returns the workflow's cargo commands. The other commands install the toolchain, which the
/// machine already has.
fn grading_commands(workflow: &str) -> Vec<String> {
    let runs = workflow
        .lines()
        .filter_map(|line| line.trim().strip_prefix("run: "));
    runs.filter(|command| command.starts_with("cargo "))
        .map(str::to_owned)
        .collect()
}

/// Returns whether the step reported the submission correctly: its points and an annotation at the
/// first mistake, or an error if it has nothing to grade.
fn is_correct(submission: TrialSubmission, step: &StepResult) -> bool {
    let has_line = |start: &str| step.job.output.lines().any(|line| line.starts_with(start));
    let points = format!("## {} of 100 points", submission.points());
    let is_shown = step.summary.starts_with(&points);
    match submission {
        TrialSubmission::Reference => step.job.code == Some(0) && is_shown && !has_line("::error"),
        TrialSubmission::Starter => {
            step.job.code == Some(0)
                && is_shown
                && has_line("::error file=student/src/camera.rs,line=")
        }
        TrialSubmission::Empty | TrialSubmission::Thief => {
            step.job.code == Some(2) && step.job.output.contains("camera.rs, triangle.rs")
        }
    }
}
