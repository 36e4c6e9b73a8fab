//! The trial of classroom50's folder: its entry point in a student's checkout, with what the runner
//! sets, as its user.

use std::fs;
use std::path::Path;
use std::time::Duration;

use grader::doctor::package;
use serde_json::Value;

use crate::bundle::{Bundle, archive};
use crate::package::trial::handed_in::HandedIn;
use crate::package::trial::runner::{CHECKOUT, Runner, Step};
use crate::package::trial::{NotTried, at, timed};

/// Where it is tried, from the workspace's root.
const PLACE: &str = "target/package/classroom50";
/// What classroom50 gives a submission.
const PLATFORM: Duration = Duration::from_secs(15 * 60);
/// The teacher's folder, on the runner.
const FOLDER: &str = "/home/runner/autograder";
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
pub fn check(workspace: &Path, folder: &Path) -> Result<Vec<String>, NotTried> {
    let mut complaints = package::complaints(folder)?;
    let workspace = &workspace.canonicalize().map_err(at(workspace))?;
    let packed = fs::read(folder.join("pathtracing.zip")).map_err(at(folder))?;
    let grader = archive::unzip(&packed)?;
    let lock = grader.text("Cargo.lock").unwrap_or_default();
    let Some(runner) = Runner::empty(&workspace.join(PLACE), lock)? else {
        return Ok(complaints);
    };
    let theirs = runner.inside(FOLDER);
    archive::lay_out(&teachers(folder)?, &theirs).map_err(at(&theirs))?;
    for handed_in in [HandedIn::Reference, HandedIn::Starter, HandedIn::Nothing] {
        runner.check_out(|checkout| handed_in.lay_out(workspace, &checkout.join("student/src")))?;
        let step = runner.step(
            &VARIABLES,
            &["python3", "/home/runner/autograder/autograder.py"],
        )?;
        timed(handed_in.words(), &step.ended, PLATFORM, &mut complaints);
        let checkout = runner.inside(CHECKOUT);
        if !is_right(handed_in, &checkout, &step) {
            let result = fs::read_to_string(checkout.join("result.json")).unwrap_or_default();
            complaints.push(format!(
                "{}: {result:.300}\n{}",
                handed_in.words(),
                step.ended.said
            ));
        }
    }
    Ok(complaints)
}

/// Both files of the folder.
fn teachers(folder: &Path) -> Result<Bundle, NotTried> {
    let mut bundle = Bundle::default();
    for name in ["autograder.py", "pathtracing.zip"] {
        let contents = fs::read(folder.join(name)).map_err(at(folder))?;
        bundle.put(name, contents);
    }
    Ok(bundle)
}

/// Whether what the runner reads is there; it shows the release's words on the run's page itself.
/// Where nothing was handed in, there is no result, and the runner publishes that as an error.
fn is_right(handed_in: HandedIn, checkout: &Path, step: &Step) -> bool {
    let result = fs::read(checkout.join("result.json")).ok();
    let result: Option<Value> = result.and_then(|text| serde_json::from_slice(&text).ok());
    let Some(result) = result else {
        let is_told = step.ended.said.contains("camera.rs, triangle.rs");
        return handed_in == HandedIn::Nothing && step.ended.code == Some(2) && is_told;
    };
    let is_theirs = result["owner"] == "alice" && result["datetime"] == "2026-11-20T20:09:58Z";
    let is_right = result["score"] == handed_in.points() && result["max-score"] == 100;
    let body = fs::read_to_string(checkout.join("release-body.md")).unwrap_or_default();
    let is_shown = !body.is_empty() && step.summary.is_empty();
    step.ended.code == Some(0) && is_right && is_theirs && is_shown
}
