//! The trial of Gradescope's zip: set up and run as the platform does it, as the root of a container,
//! without a network.

use std::fs;
use std::path::Path;
use std::time::Duration;

use grader::doctor::package;
use serde::Deserialize;
use zip::ZipArchive;

use crate::package::trial::handed_in::HandedIn;
use crate::package::trial::machine::{Ended, Job, Limits, Machine, Who};
use crate::package::trial::thief::Loot;
use crate::package::trial::{NotTried, at, timed};

/// Where it is tried, from the workspace's root.
const PLACE: &str = "target/package/gradescope";
/// What Gradescope gives a submission.
const PLATFORM: Duration = Duration::from_secs(600);
/// What Gradescope lays beside a submission; none of it changes a score.
const METADATA: &str = r#"{"id": 1, "created_at": "2026-11-20T21:09:58.000000-08:00", "users": [
{"email": "alice@example.edu", "id": 7, "name": "Alice"}], "assignment": {"id": 3, "course_id": 2,
"title": "Path Tracer", "due_date": "2026-11-21T00:00:00.000000-08:00", "late_due_date": null,
"release_date": "2026-11-01T00:00:00.000000-08:00", "group_submission": false, "group_size": null,
"total_points": "100.0"}, "submission_method": "upload", "previous_submissions": []}"#;
/// What its scripts are kept by, beside a score: for staff.
const SCORE: &str = "opt/pathtracing/target/graded/score.json";

/// What is read of `results.json`.
#[derive(Deserialize)]
struct Results {
    score: u64,
    output: String,
    extra_data: Option<Extra>,
    #[serde(default)]
    tests: Vec<Test>,
}

#[derive(Deserialize)]
struct Extra {
    exam: String,
    isolation: String,
    complete: bool,
}

#[derive(Deserialize)]
struct Test {
    max_score: u64,
}

/// Tries the zip, and tells what is not as it should be.
pub fn check(workspace: &Path, zip: &Path) -> Result<Vec<String>, NotTried> {
    let mut complaints = package::complaints(zip)?;
    let workspace = &workspace.canonicalize().map_err(at(workspace))?;
    let Some(machine) = Machine::empty(&workspace.join(PLACE))? else {
        return Ok(complaints);
    };
    unpack(&machine, zip)?;
    let exam = machine.inside("autograder/source/pathtracing/exam.json");
    let exam = fs::read_to_string(&exam).map_err(at(&exam))?;
    let set_up = run(
        &machine,
        Limits::None,
        &["bash", "/autograder/source/setup.sh"],
    )?;
    if set_up.code != Some(0) {
        complaints.push(format!("setup.sh failed:\n{}", set_up.said));
        return Ok(complaints);
    }
    let all = [
        HandedIn::Reference,
        HandedIn::Starter,
        HandedIn::Nothing,
        HandedIn::Thief,
    ];
    for handed_in in all {
        let submission = machine.inside("autograder/submission");
        handed_in.lay_out(workspace, &submission)?;
        clear_results(&machine)?;
        let ended = run(&machine, Limits::Platform, &["/autograder/run_autograder"])?;
        timed(handed_in.words(), &ended, PLATFORM, &mut complaints);
        complaints.extend(complaint(&machine, handed_in, &ended));
        if handed_in == HandedIn::Thief {
            complaints.extend(stolen(&machine, &Loot::of(workspace, &exam)?, &ended)?);
        }
    }
    Ok(complaints)
}

/// As when the zip was uploaded.
fn unpack(machine: &Machine, zip: &Path) -> Result<(), NotTried> {
    let source = machine.inside("autograder/source");
    fs::create_dir_all(&source).map_err(at(&source))?;
    let file = fs::File::open(zip).map_err(at(zip))?;
    ZipArchive::new(file)?.extract(&source)?;
    let entry = machine.inside("autograder/run_autograder");
    fs::copy(source.join("run_autograder"), &entry).map_err(at(&entry))?;
    let metadata = machine.inside("autograder/submission_metadata.json");
    fs::write(&metadata, METADATA).map_err(at(&metadata))
}

fn run(machine: &Machine, limits: Limits, words: &[&str]) -> Result<Ended, NotTried> {
    machine.run(Job {
        who: Who::Container,
        limits,
        folder: "/autograder",
        variables: &[],
        words,
    })
}

fn clear_results(machine: &Machine) -> Result<(), NotTried> {
    let results = machine.inside("autograder/results");
    machine.clear(&results)?;
    fs::create_dir_all(&results).map_err(at(&results))
}

fn read(machine: &Machine, path: &str) -> String {
    fs::read_to_string(machine.inside(path)).unwrap_or_default()
}

/// What is wrong with the results.
fn complaint(machine: &Machine, handed_in: HandedIn, ended: &Ended) -> Option<String> {
    let (whose, points) = (handed_in.words(), handed_in.points());
    let said = &ended.said;
    let results = read(machine, "autograder/results/results.json");
    let results: Results = match serde_json::from_str(&results) {
        Ok(results) => results,
        Err(error) => return Some(format!("{whose} has no results.json ({error}):\n{said}")),
    };
    let all: u64 = results.tests.iter().map(|test| test.max_score).sum();
    let is_whole = match (&results.extra_data, handed_in) {
        (None, HandedIn::Nothing) => all == 0,
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
fn stolen(machine: &Machine, loot: &Loot, ended: &Ended) -> Result<Vec<String>, NotTried> {
    let results = read(machine, "autograder/results/results.json");
    let all = [results, read(machine, SCORE), ended.said.clone()];
    let told = all.iter().flat_map(|text| loot.told_in(text));
    let mut complaints: Vec<String> = told.map(|what| format!("it is stolen: {what}")).collect();

    let home = "/opt/pathtracing";
    let open = machine.run(Job {
        who: Who::Container,
        limits: Limits::None,
        folder: home,
        variables: &["CARGO_HOME=/opt/pathtracing/crates"],
        words: &[
            "target/release/grader",
            "/autograder/submission",
            "--isolation=none",
            "--exam=exam.json",
            "--out=target/open",
        ],
    })?;
    let score = read(machine, "opt/pathtracing/target/open/score.json");
    let told = loot.told_in(&score).len();
    println!("          {told} lines and keys would be stolen without isolation");
    if told == 0 {
        complaints.push(format!(
            "without isolation it steals nothing either, so it shows nothing: adapt trial/thief.rs\n{}",
            open.said
        ));
    }
    Ok(complaints)
}
