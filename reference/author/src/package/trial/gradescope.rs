//! The trial of the package for Gradescope: sets it up and runs it as the platform does, as root in
//! a container without a network.

use std::fs;
use std::path::Path;
use std::time::Duration;

use grader::doctor::package;
use grader::files::{self, AtPath};
use grader::handed_out::HandedOut;
use serde::Deserialize;
use zip::ZipArchive;

use crate::package::trial::machine::{Job, JobResult, Limits, Machine, User};
use crate::package::trial::submission::TrialSubmission;
use crate::package::trial::thief::ProtectedData;
use crate::package::trial::{TrialError, check_time};

/// The folder of the trial, relative to the workspace's root.
const TRIAL_FOLDER: &str = "target/package/gradescope";
/// Gradescope's time limit for a submission.
const TIME_LIMIT: Duration = Duration::from_secs(600);
/// The metadata file that Gradescope provides with a submission. It does not affect the score.
const METADATA: &str = r#"{"id": 1, "created_at": "2026-11-20T21:09:58.000000-08:00", "users": [
{"email": "alice@example.edu", "id": 7, "name": "Alice"}], "assignment": {"id": 3, "course_id": 2,
"title": "Path Tracer", "due_date": "2026-11-21T00:00:00.000000-08:00", "late_due_date": null,
"release_date": "2026-11-01T00:00:00.000000-08:00", "group_submission": false, "group_size": null,
"total_points": "100.0"}, "submission_method": "upload", "previous_submissions": []}"#;
/// The score file that the package's script writes for staff.
const SCORE_FILE: &str = "opt/pathtracing/target/graded/score.json";

/// The parts of `results.json` that are checked.
#[derive(Deserialize)]
struct Results {
    score: u64,
    output: String,
    extra_data: Option<ExtraData>,
    #[serde(default)]
    tests: Vec<Test>,
}

#[derive(Deserialize)]
struct ExtraData {
    exam: String,
    isolation: String,
    complete: bool,
}

#[derive(Deserialize)]
struct Test {
    max_score: u64,
}

/// Runs the trial of the package in the file `zip`, and returns the problems found.
pub fn check(
    handed_out: &'static HandedOut,
    workspace: &Path,
    zip: &Path,
) -> Result<Vec<String>, TrialError> {
    let mut problems = package::problems(zip, handed_out)?;
    let workspace = &workspace.canonicalize().at("read", workspace)?;
    let Some(machine) = Machine::create(&workspace.join(TRIAL_FOLDER))? else {
        return Ok(problems);
    };
    unpack(&machine, zip)?;
    // Gradescope's own images have no Rust, and setup.sh downloads it. A course's image may have it.
    let path = machine.install_rustup()?;
    let exam = machine.host_path("autograder/source/pathtracing/exam.json");
    let exam = files::read_to_string(&exam)?;
    let setup = run(
        &machine,
        &path,
        Limits::None,
        &["bash", "/autograder/source/setup.sh"],
    )?;
    if setup.code != Some(0) {
        problems.push(format!("setup.sh failed:\n{}", setup.output));
        return Ok(problems);
    }
    let all = [
        TrialSubmission::Reference,
        TrialSubmission::Starter,
        TrialSubmission::Empty,
        TrialSubmission::Thief,
    ];
    for submission in all {
        let folder = machine.host_path("autograder/submission");
        submission.write_to(handed_out, workspace, &folder)?;
        clear_results(&machine)?;
        let job = run(
            &machine,
            &path,
            Limits::Platform,
            &["/autograder/run_autograder"],
        )?;
        check_time(submission.description(), &job, TIME_LIMIT, &mut problems);
        problems.extend(problem(&machine, submission, &job));
        if submission == TrialSubmission::Thief {
            problems.extend(theft_problems(
                &machine,
                &ProtectedData::collect(handed_out, workspace, &exam)?,
                &job,
            )?);
        }
    }
    Ok(problems)
}

/// Unpacks the zip as Gradescope does after an upload.
fn unpack(machine: &Machine, zip: &Path) -> Result<(), TrialError> {
    let source = machine.host_path("autograder/source");
    files::create_dir_all(&source)?;
    let file = fs::File::open(zip).at("read", zip)?;
    ZipArchive::new(file)?.extract(&source)?;
    let entry = machine.host_path("autograder/run_autograder");
    files::copy(source.join("run_autograder"), &entry)?;
    let metadata = machine.host_path("autograder/submission_metadata.json");
    Ok(files::write(&metadata, METADATA)?)
}

fn run(
    machine: &Machine,
    path: &str,
    limits: Limits,
    command: &[&str],
) -> Result<JobResult, TrialError> {
    machine.run(Job {
        user: User::Container,
        limits,
        folder: "/autograder",
        variables: &[path],
        command,
    })
}

fn clear_results(machine: &Machine) -> Result<(), TrialError> {
    let results = machine.host_path("autograder/results");
    machine.remove(&results)?;
    Ok(files::create_dir_all(&results)?)
}

fn read(machine: &Machine, path: &str) -> String {
    fs::read_to_string(machine.host_path(path)).unwrap_or_default()
}

/// Returns the problem with the results file, if there is one.
fn problem(machine: &Machine, submission: TrialSubmission, job: &JobResult) -> Option<String> {
    let (name, points) = (submission.description(), submission.points());
    let output = &job.output;
    let results = read(machine, "autograder/results/results.json");
    let results: Results = match serde_json::from_str(&results) {
        Ok(results) => results,
        Err(error) => {
            return Some(format!(
                "{name} has no valid results.json ({error}):\n{output}"
            ));
        }
    };
    let all: u64 = results.tests.iter().map(|test| test.max_score).sum();
    let is_complete = match (&results.extra_data, submission) {
        (None, TrialSubmission::Empty) => all == 0,
        (Some(extra), _) => {
            println!(
                "          {} exam, isolation {}",
                extra.exam, extra.isolation
            );
            all == 100 && extra.complete && extra.exam != "practice"
        }
        (None, _) => false,
    };
    let is_correct = job.code == Some(0) && is_complete && results.score == points;
    (!is_correct).then(|| {
        format!(
            "{name} has {} of {all} points, but should have {points}: {}\n{output}",
            results.score, results.output
        )
    })
}

/// Returns a problem for each secret that the attacking submission stole. Also returns a problem if
/// the submission steals nothing even without isolation, since its failure would then prove
/// nothing.
fn theft_problems(
    machine: &Machine,
    protected: &ProtectedData,
    job: &JobResult,
) -> Result<Vec<String>, TrialError> {
    let results = read(machine, "autograder/results/results.json");
    let all = [results, read(machine, SCORE_FILE), job.output.clone()];
    let stolen = all.iter().flat_map(|text| protected.found_in(text));
    let mut problems: Vec<String> = stolen.map(|what| format!("stolen: {what}")).collect();

    let home = "/opt/pathtracing";
    let open = machine.run(Job {
        user: User::Container,
        limits: Limits::None,
        folder: home,
        variables: &["CARGO_HOME=/opt/pathtracing/crates"],
        command: &[
            "target/release/grader",
            "/autograder/submission",
            "--isolation=none",
            "--exam=exam.json",
            "--out=target/open",
        ],
    })?;
    let score = read(machine, "opt/pathtracing/target/open/score.json");
    let count = protected.found_in(&score).len();
    println!("          {count} lines and keys would be stolen without isolation");
    if count == 0 {
        problems.push(format!(
            "the attacking submission steals nothing even without isolation, so its failure proves \
             nothing: adapt trial/thief.rs\n{}",
            open.output
        ));
    }
    Ok(problems)
}
