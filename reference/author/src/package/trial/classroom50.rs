//! The trial of classroom50's folder: its entry point in a student's checkout, with what the runner
//! sets, as its user.

use std::fs;
use std::path::Path;
use std::time::Duration;

use grader::doctor::package;
use serde_json::Value;

use crate::bundle::{Bundle, archive};
use crate::package::trial::runner::{CHECKOUT, Runner, StepResult};
use crate::package::trial::submission::TrialSubmission;
use crate::package::trial::{TrialError, check_time, io_error};

/// Where it is tried, from the workspace's root.
const TRIAL_FOLDER: &str = "target/package/classroom50";
/// What classroom50 gives a submission.
const TIME_LIMIT: Duration = Duration::from_secs(15 * 60);
/// The teacher's folder, on the runner.
const AUTOGRADER_FOLDER: &str = "/home/runner/autograder";
/// As the runner sets them. What is compiled stays from one submission to the next, to save time here.
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

/// Tries the folder, and tells what is not as it should be.
pub fn check(workspace: &Path, folder: &Path) -> Result<Vec<String>, TrialError> {
    let mut complaints = package::problems(folder)?;
    let workspace = &workspace.canonicalize().map_err(io_error(workspace))?;
    let packed = fs::read(folder.join("pathtracing.zip")).map_err(io_error(folder))?;
    let grader = archive::unzip(&packed)?;
    let lock = grader.text("Cargo.lock").unwrap_or_default();
    let Some(runner) = Runner::create(&workspace.join(TRIAL_FOLDER), lock)? else {
        return Ok(complaints);
    };
    let theirs = runner.host_path(AUTOGRADER_FOLDER);
    archive::write_files(&autograder_files(folder)?, &theirs).map_err(io_error(&theirs))?;
    for handed_in in [
        TrialSubmission::Reference,
        TrialSubmission::Starter,
        TrialSubmission::Empty,
    ] {
        runner.create_checkout(|checkout| {
            handed_in.write_to(workspace, &checkout.join("student/src"))
        })?;
        let step = runner.run_step(
            &VARIABLES,
            &["python3", "/home/runner/autograder/autograder.py"],
        )?;
        check_time(
            handed_in.description(),
            &step.job,
            TIME_LIMIT,
            &mut complaints,
        );
        let checkout = runner.host_path(CHECKOUT);
        if !is_correct(handed_in, &checkout, &step) {
            let result = fs::read_to_string(checkout.join("result.json")).unwrap_or_default();
            complaints.push(format!(
                "{}: {result:.300}\n{}",
                handed_in.description(),
                step.job.output
            ));
        }
    }
    Ok(complaints)
}

/// Both files of the folder.
fn autograder_files(folder: &Path) -> Result<Bundle, TrialError> {
    let mut bundle = Bundle::default();
    for name in ["autograder.py", "pathtracing.zip"] {
        let contents = fs::read(folder.join(name)).map_err(io_error(folder))?;
        bundle.insert(name, contents);
    }
    Ok(bundle)
}

/// Whether what the runner reads is there; it shows the release's words on the run's page itself.
/// Where nothing was handed in, there is no result, and the runner publishes that as an error.
fn is_correct(handed_in: TrialSubmission, checkout: &Path, step: &StepResult) -> bool {
    let result = fs::read(checkout.join("result.json")).ok();
    let result: Option<Value> = result.and_then(|text| serde_json::from_slice(&text).ok());
    let Some(result) = result else {
        let is_told = step.job.output.contains("camera.rs, triangle.rs");
        return handed_in == TrialSubmission::Empty && step.job.code == Some(2) && is_told;
    };
    let is_theirs = result["owner"] == "alice" && result["datetime"] == "2026-11-20T20:09:58Z";
    let is_right = result["score"] == handed_in.points() && result["max-score"] == 100;
    let body = fs::read_to_string(checkout.join("release-body.md")).unwrap_or_default();
    let is_shown = !body.is_empty() && step.summary.is_empty();
    step.job.code == Some(0) && is_right && is_theirs && is_shown
}
