//! The arguments and subcommands of `cargo author`.

use std::ops::Range;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use crate::authoring::Authoring;
use crate::generated_file::Mode;
use crate::light::LightFiles;
use crate::package::Platform;

/// The default output folders: one for the complete book, and one for the book with only the
/// students' chapters.
const DEFAULT_BOOK: &str = "target/handout";
const DEFAULT_STUDENTS_BOOK: &str = "target/students-handout";

/// Writes every generated file in this repository and tests the exam
#[derive(Debug, Parser)]
#[command(name = "cargo author", bin_name = "cargo author", version)]
pub struct Cli {
    /// The subcommand to run.
    #[command(subcommand)]
    pub command: Command,
    /// The assignment; default: rays
    #[arg(long, value_name = "ID", value_parser = Authoring::find, global = true)]
    pub assignment: Option<&'static Authoring>,
}

/// The subcommands of `cargo author`.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Generate the starter from the reference's marked files
    Starter(CheckArgs),
    /// Write the practice exam
    Exams(CheckArgs),
    /// Print the final exam for a seed
    Exam {
        /// The seed that all questions are generated from; keep it secret
        #[arg(long)]
        seed: u64,
    },
    /// Write the handout's lists of tasks and check its links, names and commands
    Handout {
        /// Change nothing; fail if a list differs from what would be written
        #[arg(long, conflicts_with = "book")]
        check: bool,
        /// Build the book into this folder; only available with `cargo book`
        #[arg(long, value_name = "FOLDER", num_args = 0..=1)]
        book: Option<Option<PathBuf>>,
        /// With --book: leave out the chapters for instructors; the default folder is
        /// target/students-handout
        #[arg(long, requires = "book")]
        students: bool,
    },
    /// Draw the handout's pictures of correct and wrong solutions
    Gallery(CheckArgs),
    /// Write the students' bundle, as an archive or as a folder for a Git repository
    Bundle(BundleArgs),
    /// Write the autograder package that instructors upload to a platform
    Package(PackageArgs),
    /// List the items that each known mistake fails with every seed, and write the table of those
    /// it fails in the practice exam
    Mistakes(MistakesArgs),
    /// Write the table that shows which items test each sentence of the contract
    Coverage(CheckArgs),
    /// Measure how well hints recognise known and unknown mistakes, using the practice exam or
    /// final exams
    Hints(HintsArgs),
    /// Make many small mechanical changes to the reference (operators, bodies, epsilons, confused
    /// names, dropped properties, kept state) and grade each mutant
    Mutants {
        /// Grade only a fixed sample of the mutants
        #[arg(long)]
        fast: bool,
        /// Grade only the mutants of one task (e.g. sphere) or of all tasks in a file (e.g. bvh)
        #[arg(long, value_name = "TASK", conflicts_with = "record")]
        task: Option<String>,
        /// Whether to record the result.
        #[command(flatten)]
        record: RecordArgs,
    },
    /// Grade every variant with the exams for all seeds, and every mistake with the exams for the
    /// first few seeds
    Prove(ProveArgs),
    /// Measure how far correct answers and mistakes are from every threshold of the exam
    Calibrate(CalibrateArgs),
}

/// The arguments of `cargo author bundle`.
#[derive(Clone, Debug, Args)]
pub struct BundleArgs {
    /// A file name that ends with .zip, or a new folder
    #[arg(long, value_name = "PATH", required_unless_present = "check")]
    pub out: Option<PathBuf>,
    /// The students' book to include as handout/book, as built by `cargo book --students`
    #[arg(long, value_name = "FOLDER")]
    pub book: Option<PathBuf>,
    /// Part two's files: solved, so that part one's pictures are fully lit, or stubs for students
    /// to fill in
    #[arg(long, value_name = "FILES", value_enum, default_value_t)]
    pub light: LightFiles,
    /// Leave out the files that students write, so that they can unpack the archive over an older
    /// version; needs the same value of --light as that version
    #[arg(long, conflicts_with = "check", requires = "light")]
    pub update: bool,
    /// Unpack the bundle in an empty home directory, run the commands in its documentation, and
    /// grade the starter and the reference
    #[arg(long)]
    pub check: bool,
}

/// The arguments of `cargo author package`.
#[derive(Clone, Debug, Args)]
pub struct PackageArgs {
    /// The platform that the package is for
    pub platform: Platform,
    /// A file name that ends with .zip, or a new folder
    #[arg(long, value_name = "PATH")]
    pub out: PathBuf,
    /// The final exam's seed, a long number that is hard to guess (gradescope only)
    #[arg(long, value_name = "S", conflicts_with = "exam")]
    pub exam_seed: Option<u64>,
    /// The final exam, as written by `cargo author exam` (gradescope only)
    #[arg(long, value_name = "FILE")]
    pub exam: Option<PathBuf>,
    /// The policy on points, lateness and visibility; `cargo grade --policy-default` prints the
    /// default
    #[arg(long, value_name = "FILE")]
    pub policy: Option<PathBuf>,
    /// Part two's files in the package, as for `cargo author bundle`
    #[arg(long, value_name = "FILES", value_enum, default_value_t)]
    pub light: LightFiles,
    /// Set up and run the package the way the platform does, with no network and half a core; grade
    /// the reference, the starter, an empty submission and, for gradescope, a malicious one (on
    /// Linux, as root or with sudo)
    #[arg(long)]
    pub check: bool,
}

/// The arguments of `cargo author mistakes`.
#[derive(Clone, Debug, Args)]
pub struct MistakesArgs {
    /// The number of seeds to grade the mistakes with, counting from 0; the default is 20, or 1
    /// with `--check`. The 50 least clearly caught mistakes are graded with ten times as many
    /// seeds
    #[arg(long, value_name = "N")]
    pub seeds: Option<u64>,
    /// Write only the table, which takes a minute; leave the lists unchanged
    #[arg(long, conflicts_with_all = ["seeds", "check"])]
    pub table: bool,
    /// Grade only the mistakes in one task (e.g. sphere) or in all tasks in a file (e.g. bvh), and
    /// write only their lists
    #[arg(long, value_name = "TASK", conflicts_with_all = ["seeds", "table", "check", "record"])]
    pub task: Option<String>,
    /// Whether to write the lists and the table, or to check them.
    #[command(flatten)]
    pub check: CheckArgs,
    /// Whether to record the result.
    #[command(flatten)]
    pub record: RecordArgs,
}

/// The arguments of `cargo author hints`.
#[derive(Clone, Debug, Args)]
pub struct HintsArgs {
    /// The seeds of final exams, such as 0..20
    #[arg(long, value_parser = parse_seeds)]
    pub seeds: Option<Range<u64>>,
    /// Measure pairs of mistakes in the same task: all of them, or only the given number
    #[arg(long, value_name = "N", conflicts_with = "seeds")]
    #[allow(
        clippy::option_option,
        reason = "the option can be absent, have no value, or have a value"
    )]
    pub pairs: Option<Option<usize>>,
    /// Measure known mistakes in the code of variants, with the practice exam; fail if one of them
    /// costs no points
    #[arg(long, conflicts_with_all = ["seeds", "pairs"])]
    pub independent: bool,
    /// Grade wrong solutions that aren't known mistakes with the practice exam; fail if any of them
    /// loses no points
    #[arg(long, conflicts_with_all = ["seeds", "pairs", "independent"])]
    pub unknown: bool,
    /// Whether to record the result.
    #[command(flatten)]
    pub record: RecordArgs,
}

/// The arguments of `cargo author prove`.
#[derive(Clone, Debug, Args)]
pub struct ProveArgs {
    /// The seeds, such as 0..1000
    #[arg(long, value_parser = parse_seeds)]
    pub seeds: Range<u64>,
    /// The number of seeds to grade the mistakes with, counting from the first
    #[arg(long, default_value_t = 10)]
    pub mistakes: u64,
    /// Grade only this variant, such as bvh.wide, and no mistakes
    #[arg(long, value_name = "ID", conflicts_with_all = ["mistakes", "record"])]
    pub variant: Option<String>,
    /// Whether to record the result.
    #[command(flatten)]
    pub record: RecordArgs,
}

/// The arguments of `cargo author calibrate`.
#[derive(Clone, Debug, Args)]
pub struct CalibrateArgs {
    /// The seeds that every variant is graded with; the default is 0..200, or 0..2 with
    /// `--check`
    #[arg(long, value_parser = parse_seeds)]
    pub seeds: Option<Range<u64>>,
    /// The number of seeds to grade the mistakes with, counting from the first
    #[arg(long, default_value_t = 3)]
    pub mistakes: u64,
    /// Change nothing and use only a few seeds; fail if a margin is too small
    #[arg(long)]
    pub check: bool,
    /// Whether to record the result.
    #[command(flatten)]
    pub record: RecordArgs,
}

/// Returns the folder to build a book into, given the folder named on the command line, if any.
pub fn book_folder(folder: Option<PathBuf>, students: bool) -> PathBuf {
    let default = if students {
        DEFAULT_STUDENTS_BOOK
    } else {
        DEFAULT_BOOK
    };
    folder.unwrap_or_else(|| PathBuf::from(default))
}

fn parse_seeds(text: &str) -> Result<Range<u64>, String> {
    let (start, end) = text
        .split_once("..")
        .ok_or("expected a range of seeds, such as 0..1000")?;
    let number = |text: &str| {
        text.parse::<u64>()
            .map_err(|error| format!("{text:?}: {error}"))
    };
    let range = number(start)?..number(end)?;
    if range.is_empty() {
        return Err("the range is empty".to_owned());
    }
    Ok(range)
}

/// The `--check` flag of commands that write files.
#[derive(Clone, Copy, Debug, Args)]
pub struct CheckArgs {
    /// Change nothing; fail if a file differs from what would be written
    #[arg(long)]
    pub check: bool,
}

/// The `--record` flag of commands that take a long time.
#[derive(Clone, Copy, Debug, Args)]
pub struct RecordArgs {
    /// Add the result to the table of long runs, with the date and the commit
    #[arg(long)]
    pub record: bool,
}

impl CheckArgs {
    /// Returns the mode that the flag selects.
    pub fn mode(self) -> Mode {
        if self.check { Mode::Check } else { Mode::Write }
    }
}
