//! The trial of the package for classroom50: runs its entry point in a student's checkout, with the
//! runner's environment variables, as the runner's user.

use std::fs;
use std::path::Path;
use std::time::Duration;

use grader::doctor::package;
use grader::files::{self, AtPath};
use grader::handed_out::HandedOut;
use serde_json::Value;

use crate::bundle::{Bundle, archive};
use crate::package::trial::runner::{CHECKOUT, Runner, StepResult};
use crate::package::trial::submission::TrialSubmission;
use crate::package::trial::{TrialError, check_time};

/// The folder of the trial, relative to the workspace's root.
const TRIAL_FOLDER: &str = "target/package/classroom50";
/// Classroom50's time limit for a submission.
const TIME_LIMIT: Duration = Duration::from_secs(15 * 60);
/// The package's folder on the runner.
const AUTOGRADER_FOLDER: &str = "/home/runner/autograder";
/// The runner's environment variables, and `CARGO_TARGET_DIR`, with which the next submission
/// reuses compiled files.
const VARIABLES: [&str; 10] = [
    "CLASSROOM=gfx-f26",
    "ASSIGNMENT=pathtracer",
    "ASSIGNMENT_TYPE=individual",
    "USERNAME=alice",
    "SUBMISSION_TAG=submit/2026-11-20T21-10-05Z-a1b2c3d",
    "COMMIT_URL=https://example.org/commit/a1b2c3d",
    "RELEASE_URL=https://example.org/releases/1",
    "REVIEW_URL=https://example.org/compare/1",
    "CLASSROOM50_BUNDLE_DIR=/home/runner/autograder",
    "CARGO_TARGET_DIR=/home/runner/built",
];

/// Runs the trial of the package in `folder`, and returns the problems found.
pub fn check(
    handed_out: &HandedOut,
    workspace: &Path,
    folder: &Path,
) -> Result<Vec<String>, TrialError> {
    let mut problems = package::problems(folder, handed_out)?;
    let workspace = &workspace.canonicalize().at("read", workspace)?;
    let packed = files::read(folder.join("pathtracing.zip"))?;
    let grader = archive::unzip(&packed)?;
    let lock = grader.text("Cargo.lock").unwrap_or_default();
    let Some(runner) = Runner::create(&workspace.join(TRIAL_FOLDER), lock)? else {
        return Ok(problems);
    };
    let target = runner.host_path(AUTOGRADER_FOLDER);
    archive::write_files(&autograder_files(folder)?, &target)?;
    for submission in [
        TrialSubmission::Reference,
        TrialSubmission::Starter,
        TrialSubmission::Empty,
    ] {
        runner.create_checkout(|checkout| {
            submission.write_to(handed_out, workspace, &checkout.join(handed_out.student))
        })?;
        let step = runner.run_step(
            &VARIABLES,
            &["python3", "/home/runner/autograder/autograder.py"],
        )?;
        check_time(
            submission.description(),
            &step.job,
            TIME_LIMIT,
            &mut problems,
        );
        let checkout = runner.host_path(CHECKOUT);
        if !is_correct(submission, &checkout, &step) {
            let result = fs::read_to_string(checkout.join("result.json")).unwrap_or_default();
            problems.push(format!(
                "{}: {result:.300}\n{}",
                submission.description(),
                step.job.output
            ));
        }
    }
    Ok(problems)
}

/// Reads both files of the package.
fn autograder_files(folder: &Path) -> Result<Bundle, TrialError> {
    let mut bundle = Bundle::default();
    for name in ["autograder.py", "pathtracing.zip"] {
        let contents = files::read(folder.join(name))?;
        bundle.insert(name, contents);
    }
    Ok(bundle)
}

/// Returns whether the files that the runner reads are correct. The script must not write a step
/// summary, because the runner itself shows the text of the release on the run's page. For an empty
/// submission, there must be no result file: the runner reports a missing file as an error.
fn is_correct(submission: TrialSubmission, checkout: &Path, step: &StepResult) -> bool {
    let result = fs::read(checkout.join("result.json")).ok();
    let result: Option<Value> = result.and_then(|text| serde_json::from_slice(&text).ok());
    let Some(result) = result else {
        let is_explained = step.job.output.contains("camera.rs, triangle.rs");
        return submission == TrialSubmission::Empty && step.job.code == Some(2) && is_explained;
    };
    let is_identified = result["owner"] == "alice" && result["datetime"] == "2026-11-20T20:09:58Z";
    let is_score_right = result["score"] == submission.points() && result["max-score"] == 100;
    let body = fs::read_to_string(checkout.join("release-body.md")).unwrap_or_default();
    let is_shown = !body.is_empty() && step.summary.is_empty();
    step.job.code == Some(0) && is_score_right && is_identified && is_shown
}
