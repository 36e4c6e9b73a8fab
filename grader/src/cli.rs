//! The command line, as data.

use std::path::PathBuf;

use clap::Parser;

use crate::exam::Task;
use crate::format::OutputSpec;
use crate::question_ref::QuestionRef;
use crate::sandbox::Isolation;

/// Grades a path-tracing submission: builds it, asks it, judges its answers, writes a score.
///
/// Exit codes: 0 graded, whatever the score; 1 graded, and below --require; 2 the command line,
/// the submission's place or the exam is at fault; 3 the grader itself is.
#[derive(Clone, Debug, Parser)]
#[command(name = "cargo grade", bin_name = "cargo grade", version)]
pub struct Arguments {
    /// The folder, .zip, .tar or .tar.gz with the five files (at its top, in src/, or in
    /// student/src/); default: student
    pub submission: Option<PathBuf>,

    /// The exam to ask, - for standard input; default: the practice exam
    #[arg(long, value_name = "FILE")]
    pub exam: Option<PathBuf>,

    /// Where to write score.json and report.html; default: target/grade/NAME
    #[arg(long, value_name = "FOLDER")]
    pub out: Option<PathBuf>,

    /// Exit with 1 if there are fewer points
    #[arg(long, value_name = "POINTS")]
    pub require: Option<u32>,

    /// Ask one task only, and write no score
    #[arg(long, value_name = "TASK", value_parser = parse_task)]
    pub task: Option<Task>,

    /// Ask one question again, such as sphere.from_inside#7, and show all of its answer
    #[arg(long, value_name = "ITEM#N", conflicts_with_all = ["task", "require", "out"])]
    pub replay: Option<QuestionRef>,

    /// Grade again whenever a file is saved, what failed first; Ctrl-C ends it
    #[arg(long, conflicts_with_all = ["replay", "require"])]
    pub watch: bool,

    /// Judge as on a student's machine: what rests on a failed task is blocked, and not asked again
    /// with the reference's part in its place
    #[arg(long)]
    pub no_reference: bool,

    /// The code is somebody else's: keep it apart from this machine, or do not grade it
    #[arg(long)]
    pub untrusted: bool,

    /// Keep it apart at this level, and no less; --untrusted takes the best of full and
    /// no-namespaces
    #[arg(long, value_name = "LEVEL")]
    pub isolation: Option<Isolation>,

    /// Say what submissions are built with here, how far they can be kept apart, and what is missing
    #[arg(long)]
    pub doctor: bool,

    /// With --doctor: look at a package for Gradescope, classroom50 or GitHub instead, as they
    /// will see it
    #[arg(long, value_name = "FILE", requires = "doctor")]
    pub package: Option<PathBuf>,

    /// Say what is wrong, not only a nudge, where a known mistake is recognised
    #[arg(long)]
    pub hints: bool,

    /// Grade again, even if nothing has changed since the last time
    #[arg(long)]
    pub fresh: bool,

    /// Open the report, a page, when it is written
    #[arg(long, conflicts_with_all = ["task", "replay"])]
    pub open: bool,

    /// Also write what students and platforms read: json, text, html, gradescope, classroom50, junit, github,
    /// github-classroom, check50, prairielearn, of what the policy lets students see; with =PATH
    /// there, else where the platform says, else to --out
    #[arg(long, value_name = "FORMAT", num_args = 1.., value_delimiter = ',')]
    #[arg(conflicts_with_all = ["task", "replay", "watch"])]
    pub format: Vec<OutputSpec>,

    /// What points count for and what students see of them; --policy-default shows what holds else
    #[arg(long, value_name = "FILE")]
    pub policy: Option<PathBuf>,

    /// Gradescope's submission_metadata.json, which says when it was handed in and due, for the
    /// policy's late days
    #[arg(long, value_name = "FILE")]
    pub gradescope_metadata: Option<PathBuf>,

    /// Print the default policy, which explains itself, and do nothing else
    #[arg(long)]
    pub policy_default: bool,

    /// Say at the end where the time went
    #[arg(long, conflicts_with_all = ["replay", "watch"])]
    pub timings: bool,

    /// CPU time that an item may use, in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..=600))]
    pub cpu_limit: u64,

    /// Print the schema of score.json, and do nothing else
    #[arg(long)]
    pub schema: bool,
}

fn parse_task(text: &str) -> Result<Task, String> {
    let known = || Task::ALL.map(Task::id).join(", ");
    let task = Task::ALL.into_iter().find(|task| task.id() == text);
    task.ok_or_else(|| format!("the tasks are {}", known()))
}
