//! Trials of packages. Each package is set up and run as it would be on its platform, with
//! submissions whose points are known.

mod machine;
mod setup;
mod submission;

use std::fs;
use std::path::Path;
use std::time::Duration;

use anyhow::Result;
use grader::doctor::package;
use grader::files::{self, AtPath};

use crate::authoring::Authoring;
use crate::bundle::{Bundle, archive};
use crate::package::Platform;
use crate::package::trial::machine::{JobResult, Machine};
use crate::package::trial::setup::{Setup, points};
use crate::package::trial::submission::{REACHED, TrialSubmission, submissions};

/// The folder for trials, relative to the workspace's root.
const TRIAL_FOLDER: &str = "target/package";
/// The command that regrades the last submission of Gradescope's trial without isolation.
const GRADE_WITHOUT_ISOLATION: &str = "cd /opt/pathtracing && source ./environment && \
    CARGO_HOME=/opt/pathtracing/crates target/release/grader /autograder/submission \
    --isolation=none --exam=exam.json --out=target/open";
/// The score file that Gradescope's script writes for staff.
const SCORE_FILE: &str = "/opt/pathtracing/target/graded/score.json";

/// Runs the trial of the package at `path` and returns the problems found. If this system cannot
/// simulate a platform's machine, this only checks that the package is complete.
pub fn check(
    authoring: &Authoring,
    workspace: &Path,
    platform: Platform,
    package: &Bundle,
    path: &Path,
) -> Result<Vec<String>> {
    let handed_out = authoring.handed_out;
    let mut problems = package::problems(path, handed_out)?;
    let workspace = &workspace.canonicalize().at("read", workspace)?;
    let name = format!("{TRIAL_FOLDER}/{platform:?}").to_lowercase();
    let Some(machine) = Machine::create(&workspace.join(name))? else {
        return Ok(problems);
    };
    let setup = Setup::new(&machine, platform, package, path)?;
    for submission in submissions(authoring, workspace, platform)? {
        for folder in setup.run.cleared {
            let folder = machine.host_path(folder);
            machine.remove(&folder)?;
            files::create_dir_all(&folder)?;
        }
        archive::write_files(&setup.checkout, &machine.host_path(setup.run.folder))?;
        submission.write_to(handed_out, &machine.host_path(setup.run.task_files))?;
        let job = setup.run(&machine, true, &setup.command)?;
        problems.extend(time_problem(submission.name, &job, setup.run.time_limit));
        problems.extend(problem(&machine, &setup, &submission, &job));
    }
    if platform == Platform::Gradescope {
        problems.extend(harmless_attack(&machine, &setup)?);
    }
    Ok(problems)
}

/// Prints the time a submission took. Returns a problem if the time is more than half of the
/// platform's limit. The time on half a core is estimated from the CPU time, so it doesn't depend
/// on this machine's load.
fn time_problem(name: &str, job: &JobResult, limit: Duration) -> Option<String> {
    let wall_time = job.wall_time.as_secs_f64();
    let Some(usage) = job.usage else {
        println!("{wall_time:6.1} s  {name}");
        return None;
    };
    let time = 2 * usage.cpu;
    let memory = usage.peak_memory.map_or(String::new(), |bytes| {
        format!(", {} MiB peak memory", bytes >> 20)
    });
    println!(
        "{:6.1} s on half a core ({wall_time:.1} s wall time){memory}: {name}",
        time.as_secs_f64(),
    );
    (time > limit / 2).then(|| {
        format!(
            "{name} took {time:.0?} on half a core, more than half the platform's limit of \
             {limit:.0?}"
        )
    })
}

/// Returns the problem with a submission's result, if any: its points are wrong, or its attack
/// managed to read a file.
fn problem(
    machine: &Machine,
    setup: &Setup,
    submission: &TrialSubmission,
    job: &JobResult,
) -> Option<String> {
    let read = |path: &str| fs::read_to_string(machine.host_path(path)).unwrap_or_default();
    let result = read(setup.run.result);
    let code = match submission.points {
        Some(_) => 0,
        None => setup.run.empty_code,
    };
    let output = &job.output;
    if job.code != Some(code) || points(&result) != submission.points {
        let expected = submission.points.unwrap_or(0);
        return Some(format!(
            "{} should get {expected} points: {result:.300}\n{output}",
            submission.name
        ));
    }
    let shown = [result, output.clone(), read(SCORE_FILE)];
    let stolen = shown.iter().find(|text| text.contains(REACHED))?;
    Some(format!("{} has read a file:\n{stolen}", submission.name))
}

/// Regrades the last submission, an attack, without isolation. Returns a problem if the attack
/// cannot read anything even then, since its failure with isolation would prove nothing.
fn harmless_attack(machine: &Machine, setup: &Setup) -> Result<Option<String>> {
    let command = ["bash", "-c", GRADE_WITHOUT_ISOLATION].map(str::to_owned);
    let job = setup.run(machine, false, &command)?;
    let score = machine.host_path("/opt/pathtracing/target/open/score.json");
    let is_harmless = !files::read_to_string(score)?.contains(REACHED);
    Ok(is_harmless.then(|| {
        format!(
            "the malicious submission can't read anything even without isolation, so its failure \
             doesn't prove anything: update the assignment's attacks\n{}",
            job.output
        )
    }))
}
