//! The command line, as data.

use clap::{Args, Parser, Subcommand};

use crate::generated::Mode;

/// Writes all that is generated in this repository.
#[derive(Debug, Parser)]
#[command(name = "cargo author", bin_name = "cargo author", version)]
pub struct Cli {
    /// What to write.
    #[command(subcommand)]
    pub command: Command,
}

/// What can be written.
#[derive(Clone, Copy, Debug, Subcommand)]
pub enum Command {
    /// The starter, from the reference's marked files
    Starter(Check),
    /// The practice exam
    Exams(Check),
    /// Any other exam, to standard output
    Exam {
        /// What all questions follow from; keep a final exam's secret
        #[arg(long)]
        seed: u64,
    },
    /// The scenes' meshes
    Scenes(Check),
}

/// Whether to write at all.
#[derive(Clone, Copy, Debug, Args)]
pub struct Check {
    /// Change nothing; fail if a file is not as it would be written
    #[arg(long)]
    pub check: bool,
}

impl Check {
    /// The mode that was asked for.
    pub fn mode(self) -> Mode {
        if self.check { Mode::Check } else { Mode::Write }
    }
}
