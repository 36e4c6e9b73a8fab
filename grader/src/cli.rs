//! The command line.

use std::path::PathBuf;

use clap::Parser;

use crate::format::OutputSpec;
use crate::question_ref::QuestionRef;
use crate::sandbox::Isolation;
use judging::exam::Task;

/// Grades a path-tracing submission: builds it, runs the exam and writes a score
///
/// Exit codes: 0 graded, whatever the score; 1 graded, but below --require; 2 invalid command line,
/// submission or exam; 3 the grader itself failed.
#[derive(Clone, Debug, Parser)]
#[command(name = "cargo grade", bin_name = "cargo grade", version)]
pub struct Arguments {
    /// The folder, .zip, .tar or .tar.gz with the five task files (at its top, in src/, or in
    /// student/src/); default: student
    pub submission: Option<PathBuf>,

    /// The exam file, or - for standard input; default: the practice exam
    #[arg(long, value_name = "FILE")]
    pub exam: Option<PathBuf>,

    /// The folder for score.json and report.html; default: target/grade/NAME
    #[arg(long, value_name = "FOLDER")]
    pub out: Option<PathBuf>,

    /// Exit with code 1 if the score is below POINTS
    #[arg(long, value_name = "POINTS")]
    pub require: Option<u32>,

    /// Grade one task only, and write no score
    #[arg(long, value_name = "TASK", value_parser = parse_task)]
    pub task: Option<Task>,

    /// Run one question again, such as sphere.from_inside#7, and show the whole answer
    #[arg(long, value_name = "ITEM#N", conflicts_with_all = ["task", "require", "out"])]
    pub replay: Option<QuestionRef>,

    /// Grade again whenever a file is saved, starting with what failed; stop with Ctrl-C
    #[arg(long, conflicts_with_all = ["replay", "require"])]
    pub watch: bool,

    /// Block items that depend on a failed task, as on a student's machine, instead of grading them
    /// with the reference's parts
    #[arg(long)]
    pub no_reference: bool,

    /// Treat the code as untrusted: run it in a sandbox, or refuse to grade it
    #[arg(long)]
    pub untrusted: bool,

    /// Require this isolation level; --untrusted takes the better of full and no-namespaces
    #[arg(long, value_name = "LEVEL")]
    pub isolation: Option<Isolation>,

    /// Show the compiler, the available isolation levels, and what is missing on this machine
    #[arg(long)]
    pub doctor: bool,

    /// With --doctor: check a package for Gradescope, classroom50 or GitHub instead, as the
    /// platform will see it
    #[arg(long, value_name = "FILE", requires = "doctor")]
    pub package: Option<PathBuf>,

    /// If a known mistake is recognised, show its full hint instead of a nudge
    #[arg(long)]
    pub hints: bool,

    /// Grade again, even if nothing has changed since the last time
    #[arg(long)]
    pub fresh: bool,

    /// Open the HTML report when it is written
    #[arg(long, conflicts_with_all = ["task", "replay"])]
    pub open: bool,

    /// Also write these formats: json, text, html, gradescope, classroom50, junit, github,
    /// github-classroom, check50, prairielearn. They contain what the policy lets students see.
    /// Each is written to =PATH if given, else where the platform expects it, else to the --out
    /// folder
    #[arg(long, value_name = "FORMAT", num_args = 1.., value_delimiter = ',')]
    #[arg(conflicts_with_all = ["task", "replay", "watch"])]
    pub format: Vec<OutputSpec>,

    /// The course's policy: how points count and what students see; --policy-default prints the
    /// default
    #[arg(long, value_name = "FILE")]
    pub policy: Option<PathBuf>,

    /// Gradescope's submission_metadata.json, which has the submission time and the due date for
    /// the policy's late days
    #[arg(long, value_name = "FILE")]
    pub gradescope_metadata: Option<PathBuf>,

    /// Print the default policy, with comments on every key, and exit
    #[arg(long)]
    pub policy_default: bool,

    /// Print at the end how long each step took
    #[arg(long, conflicts_with_all = ["replay", "watch"])]
    pub timings: bool,

    /// CPU time limit of an item, in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..=600))]
    pub cpu_limit: u64,

    /// Print the JSON schema of score.json and exit
    #[arg(long)]
    pub schema: bool,
}

fn parse_task(text: &str) -> Result<Task, String> {
    let known = || Task::ALL.map(Task::id).join(", ");
    let task = Task::ALL.into_iter().find(|task| task.id() == text);
    task.ok_or_else(|| format!("unknown task; the tasks are {}", known()))
}
