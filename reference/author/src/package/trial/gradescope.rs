//! The trial of Gradescope's zip: set up and run as the platform does it, as the root of a container,
//! without a network.

use std::fs;
use std::path::Path;
use std::time::Duration;

use grader::doctor::package;
use serde::Deserialize;
use zip::ZipArchive;

use crate::package::trial::machine::{Job, JobResult, Limits, Machine, User};
use crate::package::trial::submission::TrialSubmission;
use crate::package::trial::thief::ProtectedData;
use crate::package::trial::{TrialError, check_time, io_error};

/// Where it is tried, from the workspace's root.
const TRIAL_FOLDER: &str = "target/package/gradescope";
/// What Gradescope gives a submission.
const TIME_LIMIT: Duration = Duration::from_secs(600);
/// What Gradescope lays beside a submission; none of it changes a score.
const METADATA: &str = r#"{"id": 1, "created_at": "2026-11-20T21:09:58.000000-08:00", "users": [
{"email": "alice@example.edu", "id": 7, "name": "Alice"}], "assignment": {"id": 3, "course_id": 2,
"title": "Path Tracer", "due_date": "2026-11-21T00:00:00.000000-08:00", "late_due_date": null,
"release_date": "2026-11-01T00:00:00.000000-08:00", "group_submission": false, "group_size": null,
"total_points": "100.0"}, "submission_method": "upload", "previous_submissions": []}"#;
/// What its scripts are kept by, beside a score: for staff.
const SCORE_FILE: &str = "opt/pathtracing/target/graded/score.json";

/// What is read of `results.json`.
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

/// Tries the zip, and tells what is not as it should be.
pub fn check(workspace: &Path, zip: &Path) -> Result<Vec<String>, TrialError> {
    let mut complaints = package::problems(zip)?;
    let workspace = &workspace.canonicalize().map_err(io_error(workspace))?;
    let Some(machine) = Machine::create(&workspace.join(TRIAL_FOLDER))? else {
        return Ok(complaints);
    };
    unpack(&machine, zip)?;
    let exam = machine.host_path("autograder/source/pathtracing/exam.json");
    let exam = fs::read_to_string(&exam).map_err(io_error(&exam))?;
    let set_up = run(
        &machine,
        Limits::None,
        &["bash", "/autograder/source/setup.sh"],
    )?;
    if set_up.code != Some(0) {
        complaints.push(format!("setup.sh failed:\n{}", set_up.output));
        return Ok(complaints);
    }
    let all = [
        TrialSubmission::Reference,
        TrialSubmission::Starter,
        TrialSubmission::Empty,
        TrialSubmission::Thief,
    ];
    for handed_in in all {
        let submission = machine.host_path("autograder/submission");
        handed_in.write_to(workspace, &submission)?;
        clear_results(&machine)?;
        let ended = run(&machine, Limits::Platform, &["/autograder/run_autograder"])?;
        check_time(handed_in.description(), &ended, TIME_LIMIT, &mut complaints);
        complaints.extend(problem(&machine, handed_in, &ended));
        if handed_in == TrialSubmission::Thief {
            complaints.extend(theft_problems(
                &machine,
                &ProtectedData::collect(workspace, &exam)?,
                &ended,
            )?);
        }
    }
    Ok(complaints)
}

/// As when the zip was uploaded.
fn unpack(machine: &Machine, zip: &Path) -> Result<(), TrialError> {
    let source = machine.host_path("autograder/source");
    fs::create_dir_all(&source).map_err(io_error(&source))?;
    let file = fs::File::open(zip).map_err(io_error(zip))?;
    ZipArchive::new(file)?.extract(&source)?;
    let entry = machine.host_path("autograder/run_autograder");
    fs::copy(source.join("run_autograder"), &entry).map_err(io_error(&entry))?;
    let metadata = machine.host_path("autograder/submission_metadata.json");
    fs::write(&metadata, METADATA).map_err(io_error(&metadata))
}

fn run(machine: &Machine, limits: Limits, words: &[&str]) -> Result<JobResult, TrialError> {
    machine.run(Job {
        user: User::Container,
        limits,
        folder: "/autograder",
        variables: &[],
        command: words,
    })
}

fn clear_results(machine: &Machine) -> Result<(), TrialError> {
    let results = machine.host_path("autograder/results");
    machine.remove(&results)?;
    fs::create_dir_all(&results).map_err(io_error(&results))
}

fn read(machine: &Machine, path: &str) -> String {
    fs::read_to_string(machine.host_path(path)).unwrap_or_default()
}

/// What is wrong with the results.
fn problem(machine: &Machine, handed_in: TrialSubmission, ended: &JobResult) -> Option<String> {
    let (whose, points) = (handed_in.description(), handed_in.points());
    let said = &ended.output;
    let results = read(machine, "autograder/results/results.json");
    let results: Results = match serde_json::from_str(&results) {
        Ok(results) => results,
        Err(error) => return Some(format!("{whose} has no results.json ({error}):\n{said}")),
    };
    let all: u64 = results.tests.iter().map(|test| test.max_score).sum();
    let is_whole = match (&results.extra_data, handed_in) {
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
    let is_right = ended.code == Some(0) && is_whole && results.score == points;
    (!is_right).then(|| {
        format!(
            "{whose} has {} points of {all} and should have {points}: {}\n{said}",
            results.score, results.output
        )
    })
}

/// What the thief got; and whether it would have got something, had nobody kept it from it: else its
/// failure says nothing.
fn theft_problems(
    machine: &Machine,
    loot: &ProtectedData,
    ended: &JobResult,
) -> Result<Vec<String>, TrialError> {
    let results = read(machine, "autograder/results/results.json");
    let all = [results, read(machine, SCORE_FILE), ended.output.clone()];
    let told = all.iter().flat_map(|text| loot.found_in(text));
    let mut complaints: Vec<String> = told.map(|what| format!("it is stolen: {what}")).collect();

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
    let told = loot.found_in(&score).len();
    println!("          {told} lines and keys would be stolen without isolation");
    if told == 0 {
        complaints.push(format!(
            "without isolation it steals nothing either, so it shows nothing: adapt trial/thief.rs\n{}",
            open.output
        ));
    }
    Ok(complaints)
}
