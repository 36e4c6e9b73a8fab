//! Sets up a package on a machine as its platform does.

use std::fs::File;
use std::path::Path;
use std::time::Duration;

use anyhow::{Context, Result, ensure};
use grader::files::{self, AtPath};
use serde_json::Value;
use zip::ZipArchive;

use crate::bundle::{Bundle, archive, crates};
use crate::package::Platform;
use crate::package::trial::machine::{JobResult, Machine};

/// The metadata file that Gradescope provides with a submission. It doesn't affect the score.
const METADATA: &str = r#"{"id": 1, "created_at": "2026-11-20T21:09:58.000000-08:00", "users": [
{"email": "alice@example.edu", "id": 7, "name": "Alice"}], "assignment": {"id": 3, "course_id": 2,
"title": "Path Tracer", "due_date": "2026-11-21T00:00:00.000000-08:00", "late_due_date": null,
"release_date": "2026-11-01T00:00:00.000000-08:00", "group_submission": false, "group_size": null,
"total_points": "100.0"}, "submission_method": "upload", "previous_submissions": []}"#;
/// The folder where GitHub's runners check out a repository named `pathtracing`.
const CHECKOUT: &str = "/home/runner/work/pathtracing/pathtracing";
/// The environment variables of a workflow step on GitHub's and classroom50's runners. Cargo is
/// offline, uses the crates in the home folder and reuses compiled files for the next submission.
const RUNNER_VARIABLES: [&str; 17] = [
    "CI=true",
    "GITHUB_ACTIONS=true",
    "GITHUB_ACTOR=alice",
    "GITHUB_REPOSITORY=gfx-f26/pathtracing-alice",
    "GITHUB_STEP_SUMMARY=/home/runner/step/summary.md",
    "GITHUB_WORKSPACE=/home/runner/work/pathtracing/pathtracing",
    "RUNNER_TEMP=/tmp",
    "CARGO_NET_OFFLINE=true",
    "CARGO_TERM_COLOR=never",
    "CARGO_TARGET_DIR=/home/runner/built",
    "CLASSROOM=gfx-f26",
    "ASSIGNMENT=pathtracer",
    "ASSIGNMENT_TYPE=individual",
    "USERNAME=alice",
    "SUBMISSION_TAG=submit/2026-11-20T21-10-05Z-a1b2c3d",
    "COMMIT_URL=https://example.org/commit/a1b2c3d",
    "CLASSROOM50_BUNDLE_DIR=/home/runner/autograder",
];
/// Commits all files of a checkout and runs a command there.
const COMMIT_AND_RUN: &str = "git init --quiet && git add . && \
    git -c user.name=alice -c user.email=alice@example.org \
    commit --quiet --allow-empty --message submission && exec \"$@\"";

/// How a platform runs a package. All paths are on the platform's machine.
#[derive(Debug)]
pub struct PlatformRun {
    user: &'static str,
    /// The working folder.
    pub folder: &'static str,
    /// The folders to empty before each submission.
    pub cleared: [&'static str; 2],
    /// The folder for the submission's task files.
    pub task_files: &'static str,
    /// The file that the platform reads the points from.
    pub result: &'static str,
    /// The exit code when there is nothing to grade.
    pub empty_code: i32,
    /// The time limit for a submission.
    pub time_limit: Duration,
}

const GRADESCOPE: PlatformRun = PlatformRun {
    user: "container",
    folder: "/autograder",
    cleared: ["/autograder/submission", "/autograder/results"],
    task_files: "/autograder/submission",
    result: "/autograder/results/results.json",
    empty_code: 0,
    time_limit: Duration::from_secs(10 * 60),
};
const CLASSROOM50: PlatformRun = PlatformRun {
    task_files: "/home/runner/work/pathtracing/pathtracing/student",
    result: "/home/runner/work/pathtracing/pathtracing/result.json",
    time_limit: Duration::from_secs(15 * 60),
    ..GITHUB
};
const GITHUB: PlatformRun = PlatformRun {
    user: "runner",
    folder: CHECKOUT,
    cleared: [CHECKOUT, "/home/runner/step"],
    task_files: "/home/runner/work/pathtracing/pathtracing/student/src",
    result: "/home/runner/step/summary.md",
    empty_code: 2,
    time_limit: Duration::from_secs(20 * 60),
};

/// A package set up on a machine.
#[derive(Debug)]
pub struct Setup {
    /// How the platform runs the package.
    pub run: PlatformRun,
    /// The files in the working folder that accompany each submission.
    pub checkout: Bundle,
    /// The grading command.
    pub command: Vec<String>,
    variables: Vec<String>,
}

impl Setup {
    /// Sets up the package at `path`.
    pub fn new(
        machine: &Machine,
        platform: Platform,
        package: &Bundle,
        path: &Path,
    ) -> Result<Self> {
        match platform {
            Platform::Gradescope => Setup::gradescope(machine, path),
            Platform::Classroom50 => {
                let autograder = machine.host_path("/home/runner/autograder");
                archive::write_files(package, &autograder)?;
                let grader = archive::unzip(&files::read(path.join("pathtracing.zip"))?)?;
                let command = "python3 /home/runner/autograder/autograder.py";
                Setup::runner(machine, CLASSROOM50, &grader, command)
            }
            Platform::Github => {
                let workflow = package.text(".github/workflows/grade.yml");
                let lines = workflow.unwrap_or_default().lines().map(str::trim);
                // The other commands install the toolchain, which the machine already has.
                let command = lines
                    .filter_map(|line| line.strip_prefix("run: "))
                    .find(|command| command.starts_with("cargo "))
                    .context("the workflow has no step that runs a cargo command")?;
                let setup = Setup::runner(machine, GITHUB, package, command)?;
                let checkout = package.clone();
                Ok(Setup { checkout, ..setup })
            }
        }
    }

    /// Unpacks a zip the way Gradescope does after an upload and runs its script `setup.sh`.
    fn gradescope(machine: &Machine, zip: &Path) -> Result<Self> {
        let source = machine.host_path("/autograder/source");
        files::create_dir_all(&source)?;
        ZipArchive::new(File::open(zip).at("read", zip)?)?.extract(&source)?;
        let entry = machine.host_path("/autograder/run_autograder");
        files::copy(source.join("run_autograder"), &entry)?;
        let metadata = machine.host_path("/autograder/submission_metadata.json");
        files::write(&metadata, METADATA)?;
        let setup = Setup {
            run: GRADESCOPE,
            checkout: Bundle::default(),
            command: vec!["/autograder/run_autograder".to_owned()],
            // Gradescope's own images don't include Rust, so setup.sh downloads it there. This
            // machine is like a course's own image, which may include Rust.
            variables: vec![machine.install_rustup()?],
        };
        let script = ["bash", "/autograder/source/setup.sh"].map(str::to_owned);
        let job = setup.run(machine, false, &script)?;
        ensure!(job.code == Some(0), "setup.sh failed:\n{}", job.output);
        Ok(setup)
    }

    /// Sets up a runner for a command that grades a checkout. The runner gets the crates that the
    /// grader needs.
    fn runner(machine: &Machine, run: PlatformRun, grader: &Bundle, command: &str) -> Result<Self> {
        let registry = machine.host_path("/home/runner/.cargo/registry");
        let lock = grader.text("Cargo.lock").unwrap_or_default();
        for (path, contents) in crates::registry_files(lock)? {
            files::write_with_parents(registry.join(path), &contents)?;
        }
        let commit = ["sh", "-c", COMMIT_AND_RUN, "sh"].into_iter();
        let command = commit.chain(command.split_whitespace());
        Ok(Setup {
            run,
            checkout: Bundle::default(),
            command: command.map(str::to_owned).collect(),
            variables: RUNNER_VARIABLES.map(str::to_owned).to_vec(),
        })
    }

    /// Runs a command as the platform does, with or without its limits.
    pub fn run(
        &self,
        machine: &Machine,
        is_limited: bool,
        command: &[String],
    ) -> Result<JobResult> {
        let PlatformRun { user, folder, .. } = self.run;
        machine.run(user, folder, &self.variables, is_limited, command)
    }
}

/// Returns the points in a complete `results.json` or `result.json`, or in the heading of a
/// summary. Returns `None` if nothing was graded.
pub fn points(result: &str) -> Option<u64> {
    if let Some(summary) = result.strip_prefix("## ") {
        return summary.split_once(" of 100 points")?.0.parse().ok();
    }
    let result: Value = serde_json::from_str(result).ok()?;
    let is_complete = match result.get("tests") {
        Some(_) => {
            let extra = result.get("extra_data")?;
            println!("          isolation {}", extra["isolation"]);
            extra["complete"] == true && extra["exam"] != "practice"
        }
        None => result["max-score"] == 100,
    };
    is_complete.then(|| result["score"].as_u64()).flatten()
}
