//! The subcommands of `cargo author`. Each generates, measures or checks something, prints the
//! result and, if requested, adds it to the table of long runs.

mod archives;
mod book;
mod proofs;

use std::io::{self, Write};
use std::ops::Range;
use std::path::Path;
use std::slice;

use anyhow::bail;
use grader::handed_out::HandedOut;
use grader::printing::print_error_line;

use crate::authoring::Authoring;
use crate::cli::{Command, RecordArgs};
use crate::coverage::coverage;
use crate::exams;
use crate::generated_file::{GeneratedFile, Mode, write_or_check};
use crate::handout;
use crate::long_runs;
use crate::solutions::Solutions;
use crate::solutions::workbench::Workbench;
use crate::starter;

/// The workspace's root. The paths of generated files are relative to it.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
/// The text that the table of long runs shows instead of seeds for a run with the practice exam.
const PRACTICE: &str = "practice";

/// The result of a command. The caller prints the error.
pub type CommandResult = anyhow::Result<()>;

/// Runs a subcommand for an assignment.
pub fn run(command: Command, authoring: &'static Authoring) -> CommandResult {
    let root = Path::new(ROOT);
    match command {
        Command::Starter(check) => {
            let mut files = starter::generated_files(root, authoring.handed_out)?;
            files.push(starter::reference_root(root, authoring.handed_out)?);
            generate(&files, check.mode(), "starter")
        }
        Command::Exams(check) => {
            let practice = exams::generated_file(authoring)?;
            generate(&[practice], check.mode(), "exams")
        }
        Command::Exam { seed } => {
            let exam = exams::final_exam_text(authoring, seed)?;
            Ok(io::stdout().write_all(exam.as_bytes())?)
        }
        Command::Handout {
            check,
            book,
            students,
        } => {
            let mode = if check || book.is_some() {
                Mode::Check
            } else {
                Mode::Write
            };
            let files = handout::tasks::generated_files(root, authoring.handed_out)?;
            let files = handout::gallery::with_pictures(root, authoring, files)?;
            generate(&files, mode, "handout")?;
            book::handout(root, authoring, book, students)
        }
        Command::Gallery(check) => handout::gallery::write_or_check(root, authoring, check.mode()),
        Command::Bundle(args) => archives::bundle(root, authoring, &args),
        Command::Package(args) => archives::package(root, authoring, &args),
        Command::Mistakes(args) => proofs::mistakes(root, authoring, &args),
        Command::Mutants { fast, task, record } => {
            proofs::mutants(authoring, fast, task.as_deref(), record)
        }
        Command::Coverage(check) => {
            let practice = exams::load_practice(root, authoring)?;
            let coverage = coverage(root, authoring, &practice)?;
            generate(slice::from_ref(&coverage.table), check.mode(), "coverage")?;
            report(&coverage.problems, &coverage.summary_line())
        }
        Command::Hints(args) => proofs::hints(root, authoring, args),
        Command::Prove(args) => proofs::prove(authoring, args),
        Command::Calibrate(args) => proofs::calibrate(root, authoring, args),
    }
}

/// Writes generated files, or compares them with the files on disk. `name` is the subcommand of
/// `cargo author` that writes them.
fn generate(files: &[GeneratedFile], mode: Mode, name: &str) -> CommandResult {
    let command = format!("cargo author {name}");
    write_or_check(files, Path::new(ROOT), mode, &command)
}

/// Builds all variants and mistakes.
fn solutions(authoring: &'static Authoring) -> anyhow::Result<Solutions> {
    Solutions::load(Workbench::open(authoring)?)
}

/// Prints the problems and the summary line. Fails if any problems were found.
fn report(problems: &[String], line: &str) -> CommandResult {
    for problem in problems {
        print_error_line(problem);
    }
    println!("{line}");
    match problems.len() {
        0 => Ok(()),
        1 => bail!("1 problem was found: see above"),
        count => bail!("{count} problems were found: see above"),
    }
}

/// Adds the result of a run to the table of long runs if `--record` was given. The name of the run
/// begins with the id of the assignment, unless it is the default one.
fn record_result(
    (wanted, authoring): (RecordArgs, &Authoring),
    run: &str,
    exams: &str,
    line: &str,
) -> CommandResult {
    let handed_out = authoring.handed_out;
    let run = if handed_out == <&HandedOut>::default() {
        run.to_owned()
    } else {
        format!("{}: {run}", handed_out.assignment.id)
    };
    if wanted.record {
        long_runs::record(Path::new(ROOT), &run, exams, line)?;
    }
    Ok(())
}

/// Formats seeds the way they are written on the command line.
fn written(seeds: &Range<u64>) -> String {
    format!("{}..{}", seeds.start, seeds.end)
}
