//! Simulates a GitHub runner as a workflow step sees it: its user, home directory, environment
//! variables, and the files that a step writes to.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use grader::files::{self, AtPath};

use crate::bundle::crates;
use crate::package::trial::TrialError;
use crate::package::trial::machine::{Job, JobResult, Limits, Machine, User};

const HOME: &str = "/home/runner";
/// The folder in which GitHub's runners check out a repository with this name.
pub const CHECKOUT: &str = "/home/runner/work/pathtracing/pathtracing";
/// The environment variables of every step. Cargo is offline, and uses the crates in the home
/// directory.
const VARIABLES: [&str; 9] = [
    "CI=true",
    "GITHUB_ACTIONS=true",
    "GITHUB_ACTOR=alice",
    "GITHUB_REPOSITORY=gfx-f26/pathtracing-alice",
    "GITHUB_OUTPUT=/home/runner/step/output",
    "GITHUB_STEP_SUMMARY=/home/runner/step/summary.md",
    "RUNNER_TEMP=/tmp",
    "CARGO_NET_OFFLINE=true",
    "CARGO_TERM_COLOR=never",
];

/// A machine with the home directory of a runner's user.
#[derive(Debug)]
pub struct Runner(Machine);

/// The result of a step.
#[derive(Debug)]
pub struct StepResult {
    /// The result of the step's command.
    pub job: JobResult,
    /// The summary that the run's page shows.
    pub summary: String,
}

impl Runner {
    /// Creates a runner with the crates of a lock file. Returns `None` if this system does not
    /// support simulated machines.
    pub fn create(root: &Path, lock: &str) -> Result<Option<Self>, TrialError> {
        let Some(machine) = Machine::create(root)? else {
            return Ok(None);
        };
        let registry = machine.host_path(HOME).join(".cargo/registry");
        for (path, contents) in crates::registry_files(lock)? {
            files::write_with_parents(registry.join(path), &contents)?;
        }
        Ok(Some(Runner(machine)))
    }

    /// Converts a path on the runner to a path on the host.
    pub fn host_path(&self, path: &str) -> PathBuf {
        self.0.host_path(path)
    }

    /// Creates a checkout with one commit, which contains the files that `fill` writes.
    pub fn create_checkout(
        &self,
        fill: impl FnOnce(&Path) -> Result<(), TrialError>,
    ) -> Result<(), TrialError> {
        let checkout = &self.host_path(CHECKOUT);
        for folder in [checkout, &self.host_path("/home/runner/step")] {
            self.0.remove(folder)?;
            files::create_dir_all(folder)?;
        }
        for file in ["output", "summary.md"] {
            files::write(self.host_path("/home/runner/step").join(file), "")?;
        }
        fill(checkout)?;
        for words in [
            "init --quiet",
            "add .",
            "commit --quiet --allow-empty --message submission",
        ] {
            let mut git = Command::new("git");
            git.args([
                "-c",
                "user.name=alice",
                "-c",
                "user.email=alice@example.org",
            ])
            .args(words.split(' '))
            .env("GIT_COMMITTER_DATE", "2026-11-20T21:09:58+01:00")
            .current_dir(checkout);
            git.output().at("run", "git")?;
        }
        Ok(())
    }

    /// Runs a step in the checkout.
    pub fn run_step(&self, variables: &[&str], words: &[&str]) -> Result<StepResult, TrialError> {
        let workspace = format!("GITHUB_WORKSPACE={CHECKOUT}");
        let own = VARIABLES.into_iter().chain([workspace.as_str()]);
        let variables: Vec<&str> = own.chain(variables.iter().copied()).collect();
        let job = self.0.run(Job {
            user: User::Runner,
            limits: Limits::Platform,
            folder: CHECKOUT,
            variables: &variables,
            command: words,
        })?;
        let summary = self.host_path("/home/runner/step/summary.md");
        Ok(StepResult {
            job,
            summary: fs::read_to_string(summary).unwrap_or_default(),
        })
    }
}
