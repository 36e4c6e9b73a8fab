//! The trial of the template repository: what its workflow runs, in a student's checkout, as the
//! runner's user.

use std::fs;
use std::path::Path;
use std::time::Duration;

use grader::given::TASK_FILES;

use crate::bundle::{Bundle, archive};
use crate::package::trial::handed_in::HandedIn;
use crate::package::trial::runner::{Runner, Step};
use crate::package::trial::{NotTried, at, timed};

/// Where it is tried, from the workspace's root.
const PLACE: &str = "target/package/github";
const WORKFLOW: &str = ".github/workflows/grade.yml";
/// What the workflow gives a push.
const PLATFORM: Duration = Duration::from_secs(20 * 60);
/// What is compiled stays from one push to the next, as the workflow's cache keeps it.
const VARIABLES: [&str; 1] = ["CARGO_TARGET_DIR=/home/runner/built"];

/// Tries the repository, and tells what is not as it should be.
pub fn check(workspace: &Path, template: &Bundle) -> Result<Vec<String>, NotTried> {
    let mut complaints = Vec::new();
    let workspace = &workspace.canonicalize().map_err(at(workspace))?;
    let lock = template.text("Cargo.lock").unwrap_or_default();
    let Some(runner) = Runner::empty(&workspace.join(PLACE), lock)? else {
        return Ok(complaints);
    };
    let commands = commands(template.text(WORKFLOW).unwrap_or_default());
    if commands.is_empty() {
        complaints.push(format!("{WORKFLOW} grades nothing"));
    }
    for handed_in in [HandedIn::Reference, HandedIn::Starter, HandedIn::Nothing] {
        runner.check_out(|checkout| {
            archive::lay_out(template, checkout).map_err(at(checkout))?;
            hand_in(handed_in, workspace, &checkout.join("student/src"))
        })?;
        for command in &commands {
            let words: Vec<&str> = command.split_whitespace().collect();
            let step = runner.step(&VARIABLES, &words)?;
            timed(handed_in.words(), &step.ended, PLATFORM, &mut complaints);
            if !is_right(handed_in, &step) {
                let (whose, summary) = (handed_in.words(), &step.summary);
                complaints.push(format!("{whose}: {summary:.300}\n{}", step.ended.said));
            }
        }
    }
    Ok(complaints)
}

/// Puts what is handed in over the template's five files.
fn hand_in(handed_in: HandedIn, workspace: &Path, source: &Path) -> Result<(), NotTried> {
    let folder = &source.with_file_name("handed-in");
    handed_in.lay_out(workspace, folder)?;
    for file in TASK_FILES {
        let (from, to) = (folder.join(file.name), source.join(file.name));
        fs::remove_file(&to).map_err(at(&to))?;
        if from.exists() {
            fs::rename(&from, &to).map_err(at(&from))?;
        }
    }
    fs::remove_dir_all(folder).map_err(at(folder))
}

/// What the workflow runs of ours: the toolchain is on the machine already.
fn commands(workflow: &str) -> Vec<String> {
    let runs = workflow
        .lines()
        .filter_map(|line| line.trim().strip_prefix("run: "));
    runs.filter(|command| command.starts_with("cargo "))
        .map(str::to_owned)
        .collect()
}

/// Whether the run's page shows the points, and each first mistake stands beside its line.
fn is_right(handed_in: HandedIn, step: &Step) -> bool {
    let says = |text: &str| step.ended.said.lines().any(|line| line.starts_with(text));
    let points = format!("## {} of 100 points", handed_in.points());
    let is_shown = step.summary.starts_with(&points);
    match handed_in {
        HandedIn::Reference => step.ended.code == Some(0) && is_shown && !says("::error"),
        HandedIn::Starter => {
            step.ended.code == Some(0)
                && is_shown
                && says("::error file=student/src/camera.rs,line=")
        }
        HandedIn::Nothing | HandedIn::Thief => {
            step.ended.code == Some(2) && step.ended.said.contains("camera.rs, triangle.rs")
        }
    }
}
