//! The command line of `cargo class`.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, value_parser};
use grader::exam_source::ExamSource;
use grader::handed_out::HandedOut;
use grader::options::{Dependents, GradeOptions};
use grader::probe::Budget;
use grader::sandbox::Isolation;
use grader::select_isolation::IsolationRequest;

use crate::layout_kind::LayoutChoice;
use crate::list_kind::ListKind;
use crate::shard::Shard;

/// Grades a class: an export from a learning platform, or a folder with a subfolder or archive for
/// each student.
///
/// You can stop this command at any time. When you run it again, it resumes where it left off. Exit
/// codes: 0 every submission was graded or had nothing to grade; 2 the command line, the input or a
/// list is invalid; 3 some submissions could not be graded because of a problem with the grader or
/// the machine: run it again.
#[derive(Clone, Debug, Parser)]
#[command(
    name = "cargo class",
    bin_name = "cargo class",
    version,
    subcommand_negates_reqs = true,
    args_conflicts_with_subcommands = true
)]
pub struct Cli {
    /// The subcommand; without one, a class is graded.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// The arguments for grading.
    #[command(flatten)]
    pub class: ClassArguments,
}

/// The subcommands.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Merge the results of several shards into one class
    Merge(MergeArguments),
}

/// The arguments for grading a class.
#[derive(Clone, Debug, Default, Args)]
pub struct ClassArguments {
    /// The platform's export (a folder or archive), or a folder with a subfolder or archive for
    /// each student
    #[arg(required_unless_present = "replay")]
    pub input: Option<PathBuf>,

    /// Output folder; an interrupted run resumes from it
    #[arg(long, value_name = "FOLDER", required_unless_present = "dry_run")]
    pub out: Option<PathBuf>,

    /// List the files that would be graded for each student, but don't grade them
    #[arg(long)]
    pub dry_run: bool,

    /// Grade only a few submissions and estimate how long the rest will take
    #[arg(long, requires = "out", conflicts_with_all = ["dry_run", "regrade", "shard"])]
    pub estimate: bool,

    /// Write each student's additions to the starter into this new folder, with names removed, for
    /// a similarity checker; the key and a list of identical submissions are written next to it
    #[arg(long, value_name = "FOLDER")]
    pub similarity_input: Option<PathBuf>,

    /// Grade everything again, keep the old scores, and list whose points changed and why
    #[arg(long, conflicts_with = "dry_run")]
    pub regrade: bool,

    /// Grade only part K of N, such as 2/8; `cargo class merge` combines the parts
    #[arg(long, value_name = "K/N", conflicts_with = "regrade")]
    pub shard: Option<Shard>,

    /// Folder of corrected submissions: a subfolder or archive for each, named after the submission
    /// or one of its students. The corrected files replace the original ones, but the original
    /// submission time still applies. Pass this option on every run
    #[arg(long, value_name = "FOLDER", conflicts_with = "replay")]
    pub corrected: Option<PathBuf>,

    /// Rerun one question of a graded submission (for example, `ann sphere.from_inside#7`) and show
    /// the full answer; ID is the submission's folder, or anything that identifies one of its
    /// students. If there are several attempts, the one that counts is used
    #[arg(long, value_names = ["ID", "ITEM[#N]"], num_args = 2, requires = "out")]
    #[arg(conflicts_with_all = ["input", "dry_run", "estimate", "regrade", "shard", "similarity_input"])]
    pub replay: Option<Vec<String>>,

    /// Number of submissions to grade at a time; default: one per core
    #[arg(long, value_name = "COUNT", value_parser = value_parser!(u16).range(1..=512))]
    pub jobs: Option<u16>,

    /// How to read the input.
    #[command(flatten)]
    pub choice: LayoutChoice,

    /// The options for grading each submission.
    #[command(flatten)]
    pub grading: GradingArguments,

    /// The roster and the gradebooks.
    #[command(flatten)]
    pub lists: Lists,
}

/// Options for grading each submission, with the same meaning as in `cargo grade`.
#[derive(Clone, Debug, Default, Args)]
pub struct GradingArguments {
    /// The assignment; default: the exam file's assignment, or rays
    #[arg(long, value_name = "ID", value_parser = HandedOut::find)]
    pub assignment: Option<&'static HandedOut>,

    /// Exam file; default: the practice exam
    #[arg(long, value_name = "FILE")]
    pub exam: Option<PathBuf>,

    /// Policy file: points, late days, caps; `cargo grade --policy-default` prints the default
    #[arg(long, value_name = "FILE")]
    pub policy: Option<PathBuf>,

    /// CPU time limit for each item, in seconds; default: 50 times what the slowest passing item
    /// has taken, but at least 2 and at most 10 seconds
    #[arg(long, value_name = "SECONDS", value_parser = value_parser!(u64).range(1..=Budget::MAX_SECONDS))]
    pub cpu_limit: Option<u64>,

    /// How strictly submissions are isolated from this machine; default: full if the machine
    /// supports it, otherwise no-namespaces; if it supports neither, nothing is graded
    #[arg(long, value_name = "LEVEL")]
    pub isolation: Option<Isolation>,

    /// Leave items that depend on a failed task blocked instead of grading them with the reference's
    /// parts
    #[arg(long)]
    pub no_reference: bool,
}

/// The roster and the gradebooks of a class, as CSV files, and the files to make from the grades.
#[derive(Clone, Debug, Default, Args)]
pub struct Lists {
    /// The policy file, or `None` for the default policy. Grading and merging each have a separate
    /// option for it.
    #[arg(skip)]
    pub policy: Option<PathBuf>,

    /// The list of people included in the platform's download along with the submissions.
    #[arg(skip)]
    pub downloaded: Option<PathBuf>,

    /// Roster with at least one of the columns name, email, sid and username; optional columns:
    /// group (one submission counts for the whole group) and datetime (the submission time)
    #[arg(long, value_name = "CSV")]
    pub roster: Option<PathBuf>,

    /// Grade even if more than half of the submissions don't match anyone in the roster or
    /// gradebook
    #[arg(long)]
    pub accept_unlisted: bool,

    /// Manual points and comments, with the columns student, task, delta, comment, author and,
    /// optionally, date; the points are added before lateness is considered
    #[arg(long, value_name = "CSV")]
    pub manual_points: Option<PathBuf>,

    /// Write hand-back.zip with a page for each student, named the way Canvas and Moodle expect
    #[arg(long)]
    pub hand_back: bool,

    /// Write a copy of the class to this folder for human graders, with pseudonyms instead of
    /// names; the key is anonymous-key.json in the output folder
    #[arg(long, value_name = "FOLDER")]
    pub anonymous: Option<PathBuf>,

    /// Show similar submissions side by side, given an earlier --similarity-input folder and a
    /// checker's results (Dolos's pairs.csv, or JPlag's results.csv or archive). Pass this option
    /// on every run
    #[arg(long, value_names = ["FOLDER", "RESULTS"], num_args = 2)]
    pub similar: Vec<PathBuf>,

    /// Gradebook exported from Canvas; the points are written to a copy
    #[arg(long, value_name = "CSV")]
    pub canvas: Option<PathBuf>,

    /// Column of the Canvas gradebook: its title, or the assignment's number
    #[arg(long, value_name = "TITLE", requires = "canvas")]
    pub column: Option<String>,

    /// Grading worksheet from Moodle; the points are written to a copy
    #[arg(long, value_name = "CSV")]
    pub moodle: Option<PathBuf>,

    /// Grades downloaded from Gradescope; the points are written to a copy
    #[arg(long, value_name = "CSV")]
    pub gradescope: Option<PathBuf>,

    /// Stop using a list from an earlier run; by default, a list that you leave out is taken from
    /// the last run
    #[arg(long, value_name = "LIST")]
    pub drop_list: Vec<ListKind>,
}

/// The arguments of `cargo class merge`.
#[derive(Clone, Debug, Args)]
pub struct MergeArguments {
    /// The assignment; default: rays
    #[arg(long, value_name = "ID", value_parser = HandedOut::find)]
    pub assignment: Option<&'static HandedOut>,

    /// Output folders of the shards
    #[arg(required = true)]
    pub shards: Vec<PathBuf>,

    /// Output folder for the merged class
    #[arg(long, value_name = "FOLDER")]
    pub out: PathBuf,

    /// Policy file; default: the one that the shards were graded with
    #[arg(long, value_name = "FILE")]
    pub policy: Option<PathBuf>,

    /// The roster and the gradebooks.
    #[command(flatten)]
    pub lists: Lists,
}

impl Lists {
    /// Returns the path of a list.
    pub fn get(&self, kind: ListKind) -> Option<PathBuf> {
        self.clone().path(kind).take()
    }

    /// Returns a mutable reference to the path of a list.
    pub fn path(&mut self, kind: ListKind) -> &mut Option<PathBuf> {
        match kind {
            ListKind::Policy => &mut self.policy,
            ListKind::Roster => &mut self.roster,
            ListKind::ManualPoints => &mut self.manual_points,
            ListKind::Canvas => &mut self.canvas,
            ListKind::Moodle => &mut self.moodle,
            ListKind::Gradescope => &mut self.gradescope,
            ListKind::Downloaded => &mut self.downloaded,
        }
    }
}

impl GradingArguments {
    /// Returns the options for grading each submission.
    pub fn resolve(&self) -> GradeOptions {
        let exam = ExamSource::from_option(self.exam.clone());
        let level = self.isolation.map(IsolationRequest::Level);
        let isolation = level.unwrap_or(IsolationRequest::Untrusted);
        let budget = self.cpu_limit.map(Budget::from_seconds);
        GradeOptions {
            handed_out: exam.assignment(self.assignment),
            exam,
            policy: self.policy.clone(),
            dependents: Dependents::new(self.no_reference),
            isolation,
            budget: budget.unwrap_or_default(),
            ..GradeOptions::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn command_line_definition_is_valid() {
        Cli::command().debug_assert();
    }
}
