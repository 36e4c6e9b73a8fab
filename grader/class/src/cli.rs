//! The command line, as data.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use grader::sandbox::Isolation;

use crate::shard::Shard;

/// Grades a class: what a learning platform exports, a folder of folders, or of archives.
///
/// Killed at any moment and started again, it grades only what is missing. Exit codes: 0 all were
/// graded or had nothing to grade; 2 the command line, the input or a list is at fault; 3 some
/// could not be graded for reasons of ours or the machine's: start it again.
#[derive(Clone, Debug, Parser)]
#[command(
    name = "cargo class",
    bin_name = "cargo class",
    version,
    subcommand_negates_reqs = true,
    args_conflicts_with_subcommands = true
)]
pub struct Cli {
    /// Something else than grading.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Grading.
    #[command(flatten)]
    pub class: ClassArguments,
}

/// What can be done beside grading.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Make one class of the shards that several machines have graded
    Merge(MergeArguments),
}

/// What to grade, and how.
#[derive(Clone, Debug, Args)]
pub struct ClassArguments {
    /// The export, its archive, or the folder with a folder or archive for each student
    #[arg(required = true)]
    pub input: Option<PathBuf>,

    /// Where results go, and where a run that was stopped goes on
    #[arg(long, value_name = "FOLDER", required_unless_present = "dry_run")]
    pub out: Option<PathBuf>,

    /// Say who would be graded from what, and do nothing else
    #[arg(long)]
    pub dry_run: bool,

    /// Grade all again, keep the old scores, and say whose points changed and why
    #[arg(long, conflicts_with = "dry_run")]
    pub regrade: bool,

    /// Grade the Kth part of N, such as 2/8; `cargo class merge` joins the parts
    #[arg(long, value_name = "K/N", conflicts_with = "regrade")]
    pub shard: Option<Shard>,

    /// How many at a time; default: one for each core
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=512))]
    pub jobs: Option<u16>,

    /// How each submission is graded.
    #[command(flatten)]
    pub grading: GradingOptions,

    /// Which lists there are.
    #[command(flatten)]
    pub lists: Lists,
}

/// How each submission is graded: as `cargo grade` does it.
#[derive(Clone, Debug, Args)]
pub struct GradingOptions {
    /// The exam to ask; default: the practice exam
    #[arg(long, value_name = "FILE")]
    pub exam: Option<PathBuf>,

    /// What counts: points, late days, caps; `cargo grade --policy-default` prints one
    #[arg(long, value_name = "FILE")]
    pub policy: Option<PathBuf>,

    /// CPU time that an item may use, in seconds
    #[arg(long, value_name = "SECONDS")]
    pub cpu_limit: Option<u64>,

    /// Keep submissions apart from this machine at this level; default: the best of full and
    /// no-namespaces that it has, and nothing is graded if it has neither
    #[arg(long, value_name = "LEVEL")]
    pub isolation: Option<Isolation>,

    /// Block what rests on a failed task, and do not ask it again with the reference's part
    #[arg(long)]
    pub no_reference: bool,
}

/// Lists of the class, and of its grades.
#[derive(Clone, Debug, Default, Args)]
pub struct Lists {
    /// Who is in the class: a CSV with columns such as name, email, sid, username; with group,
    /// what one hands in is for all of a group; with datetime, when it came
    #[arg(long, value_name = "CSV")]
    pub roster: Option<PathBuf>,

    /// Canvas's exported gradebook, whose copy gets the points
    #[arg(long, value_name = "CSV")]
    pub canvas: Option<PathBuf>,

    /// The gradebook's column: its title, or the assignment's number
    #[arg(long, value_name = "TITLE", requires = "canvas")]
    pub column: Option<String>,

    /// Moodle's grading worksheet, whose copy gets the points
    #[arg(long, value_name = "CSV")]
    pub moodle: Option<PathBuf>,

    /// Gradescope's downloaded grades, whose copy gets the points
    #[arg(long, value_name = "CSV")]
    pub gradescope: Option<PathBuf>,
}

/// What to join.
#[derive(Clone, Debug, Args)]
pub struct MergeArguments {
    /// The shards' output folders
    #[arg(required = true)]
    pub shards: Vec<PathBuf>,

    /// Where the class goes
    #[arg(long, value_name = "FOLDER")]
    pub out: PathBuf,

    /// What counts, as when the shards were graded
    #[arg(long, value_name = "FILE")]
    pub policy: Option<PathBuf>,

    /// Which lists there are.
    #[command(flatten)]
    pub lists: Lists,
}

impl GradingOptions {
    /// The same as a command line of `cargo grade`, so that no default can be another one.
    pub fn to_arguments(&self) -> Vec<OsString> {
        let mut words: Vec<OsString> = vec!["cargo grade".into()];
        let files = [("--exam", &self.exam), ("--policy", &self.policy)];
        for (option, file) in files {
            if let Some(file) = file {
                words.extend([option.into(), file.into()]);
            }
        }
        if let Some(limit) = self.cpu_limit {
            words.extend(["--cpu-limit".into(), limit.to_string().into()]);
        }
        match self.isolation {
            Some(level) => words.extend(["--isolation".into(), level.name().into()]),
            None => words.push("--untrusted".into()),
        }
        if self.no_reference {
            words.push("--no-reference".into());
        }
        words
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
