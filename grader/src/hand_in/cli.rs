//! The command line of `cargo handin`.

use std::path::PathBuf;

use clap::Parser;

/// Makes the archive to hand in, checks it as the grader will, and says what it holds
///
/// Exit codes: 0 made; 1 made, but a file does not compile, or nothing is written yet; 2 invalid
/// command line or folder; 3 the machine failed.
#[derive(Clone, Debug, Default, Parser)]
#[command(name = "cargo handin", bin_name = "cargo handin", version)]
pub struct HandInArguments {
    /// The folder with the task files; default: student
    pub folder: Option<PathBuf>,

    /// The archive to write; default: handin.zip in the assignment's folder
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}
