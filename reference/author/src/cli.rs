//! The command line, as data.

use std::ops::Range;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use crate::generated_file::Mode;
use crate::package::Platform;

/// Where the book goes unless told otherwise: beside everything else that is built.
const DEFAULT_BOOK: &str = "target/handout";

/// Writes all that is generated in this repository.
#[derive(Debug, Parser)]
#[command(name = "cargo author", bin_name = "cargo author", version)]
pub struct Cli {
    /// What to write.
    #[command(subcommand)]
    pub command: Command,
}

/// What can be written.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// The starter, from the reference's marked files
    Starter(CheckArgs),
    /// The practice exam
    Exams(CheckArgs),
    /// Any other exam, to standard output
    Exam {
        /// What all questions follow from; keep a final exam's secret
        #[arg(long)]
        seed: u64,
    },
    /// The scenes' meshes
    Scenes(CheckArgs),
    /// The handout's figures; with `--check`, its links, names and commands as well
    Handout {
        /// Whether to write the figures.
        #[command(flatten)]
        check: CheckArgs,
        /// Make it into a book, in this folder; only `cargo book` can
        #[arg(long, value_name = "FOLDER", num_args = 0..=1, default_missing_value = DEFAULT_BOOK)]
        book: Option<PathBuf>,
    },
    /// What students get, as an archive or as a folder for a Git repository
    Bundle {
        /// A name that ends with .zip, or a new folder
        #[arg(long, value_name = "PLACE", required_unless_present = "check")]
        out: Option<PathBuf>,
        /// The handout as a built book, to be put into handout/book
        #[arg(long, value_name = "FOLDER")]
        book: Option<PathBuf>,
        /// Unpack it on an empty home, do what its texts say, grade the starter and the reference
        #[arg(long)]
        check: bool,
    },
    /// What staff uploads to a platform that grades
    Package {
        /// Where it is graded
        platform: Platform,
        /// A name that ends with .zip, or a new folder
        #[arg(long, value_name = "PLACE")]
        out: PathBuf,
        /// The final exam's seed: a long number that nobody guesses; for gradescope only
        #[arg(long, value_name = "S", conflicts_with = "exam")]
        exam_seed: Option<u64>,
        /// The final exam, as `cargo author exam` has written it; for gradescope only
        #[arg(long, value_name = "FILE")]
        exam: Option<PathBuf>,
        /// What counts, and who sees what; default: `cargo grade --policy-default`
        #[arg(long, value_name = "FILE")]
        policy: Option<PathBuf>,
        /// Set it up and run it as the platform does, without a network, within half of a core, and
        /// grade the reference, the starter and what steals there; on Linux, as root or with sudo
        #[arg(long)]
        check: bool,
    },
    /// The table of which known mistake fails which item of the practice exam
    Mistakes(CheckArgs),
    /// How well the practice exam's hints recognise known mistakes, and take unknown ones for others
    Hints,
    /// The list of mutants that cargo-mutants makes of the reference; and ask each of them
    Mutants {
        /// Ask only a fixed part of them
        #[arg(long)]
        fast: bool,
        /// Whether to write the list.
        #[command(flatten)]
        check: CheckArgs,
    },
    /// Ask every variant of every seed's exam, and every mistake of the first few
    Prove {
        /// The seeds, such as 0..1000
        #[arg(long, value_parser = parse_seeds)]
        seeds: Range<u64>,
        /// How many of the seeds the mistakes are asked as well
        #[arg(long, default_value_t = 10)]
        mistakes: u64,
        /// Ask this variant alone, such as bvh.wide, and no mistakes
        #[arg(long, value_name = "ID", conflicts_with_all = ["mistakes", "write"])]
        variant: Option<String>,
        /// Write down what was found out, with date and commit
        #[arg(long)]
        write: bool,
    },
    /// Measure how far right answers and mistakes are from every threshold of the exam
    Calibrate {
        /// The seeds that every variant is asked; without any 0..200, with `--check` 0..2
        #[arg(long, value_parser = parse_seeds)]
        seeds: Option<Range<u64>>,
        /// How many of the seeds the mistakes are asked as well
        #[arg(long, default_value_t = 3)]
        mistakes: u64,
        /// Change nothing, and ask a few seeds only; fail if a margin is too small
        #[arg(long)]
        check: bool,
    },
}

fn parse_seeds(text: &str) -> Result<Range<u64>, String> {
    let (start, end) = text
        .split_once("..")
        .ok_or("two numbers are meant: 0..1000")?;
    let number = |text: &str| {
        text.parse::<u64>()
            .map_err(|error| format!("{text:?}: {error}"))
    };
    let range = number(start)?..number(end)?;
    if range.is_empty() {
        return Err("no seed lies between these".to_owned());
    }
    Ok(range)
}

/// Whether to write at all.
#[derive(Clone, Copy, Debug, Args)]
pub struct CheckArgs {
    /// Change nothing; fail if a file is not as it would be written
    #[arg(long)]
    pub check: bool,
}

impl CheckArgs {
    /// The mode that was asked for.
    pub fn mode(self) -> Mode {
        if self.check { Mode::Check } else { Mode::Write }
    }
}
