//! `cargo author mistakes`, `mutants`, `prove`, `calibrate` and `hints`.

use std::path::Path;

use anyhow::Error;
use grader::printing::print_error_line;
use grader::task_selection::TaskSelection;
use judging::exam::Exam;

use super::{CommandResult, PRACTICE, generate, record_result, report, solutions, written};
use crate::authoring::Authoring;
use crate::cli::{CalibrateArgs, HintsArgs, MistakesArgs, ProveArgs, RecordArgs};
use crate::exams;
use crate::generated_file::Mode;
use crate::proof::calibrate::{FEW_SEEDS, MANY_SEEDS, table};
use crate::proof::failures::{SeedCounts, THINNEST};
use crate::proof::mutants::{self, SAMPLE_STEP};
use crate::proof::recognition::{
    recognise, recognise_independent, recognise_pairs, recognise_unknown, recognise_with_seeds,
};
use crate::proof::{self, failures, matrix};
use crate::solutions::Solutions;
use crate::solutions::failed_items::FailedItems;

/// Writes or checks the lists of items that each mistake fails, and the table for the practice
/// exam.
pub(super) fn mistakes(
    root: &Path,
    authoring: &'static Authoring,
    args: &MistakesArgs,
) -> CommandResult {
    let (mode, handed_out) = (args.check.mode(), authoring.handed_out);
    let mut solutions = solutions(authoring)?;
    let practice = exams::load_practice(root, authoring)?;
    if args.table {
        return write_table_of_mistakes(&solutions, &practice, Mode::Write);
    }
    if let Some(task) = &args.task {
        let tasks = parse_tasks(task, authoring)?;
        return write_lists_of_tasks(root, &solutions.only_mistakes(&tasks), &practice);
    }
    let default = match mode {
        Mode::Write => failures::MANY_SEEDS,
        Mode::Check => failures::FEW_SEEDS,
    };
    let seeds = args.seeds.map_or(default, SeedCounts::of);
    let (failed, detections) = failures::failed_items(&solutions, &practice, seeds)?;
    let thin = detections.problems();
    let caught = failed.fails.len() - thin.len();
    let line = format!(
        "{caught} of {} mistakes clearly caught, with {} seeds each, or {} for the {THINNEST} that \
         are caught least clearly",
        failed.fails.len(),
        seeds.all,
        seeds.thinnest
    );
    // Record the result before writing the files. Otherwise, the table would say that there were
    // uncommitted changes.
    record_result(
        (args.record, authoring),
        "mistakes",
        &written(&(0..seeds.all)),
        &line,
    )?;
    let committed = FailedItems::load(root, handed_out)?;
    if mode == Mode::Check {
        let mut problems = failures::problems(&committed, &failed);
        problems.extend(detections.problems());
        let line = format!("{} seeds, {} mistakes", failed.seeds, failed.fails.len());
        report(&problems, &line)?;
    }
    // A check with the same number of seeds must find the same lists.
    if mode == Mode::Write || failed.seeds == committed.seeds {
        generate(&[failed.generated_file(handed_out)?], mode, "mistakes")?;
    }
    if mode == Mode::Write {
        generate(&[detections.generated_file(handed_out)], mode, "mistakes")?;
        solutions.set_failed_items(&failed);
    }
    write_table_of_mistakes(&solutions, &practice, mode)?;
    report(&thin, &line)
}

/// Updates the lists of the mistakes in these solutions, with as many seeds as the other lists.
fn write_lists_of_tasks(root: &Path, solutions: &Solutions, practice: &Exam) -> CommandResult {
    let handed_out = solutions.workbench.handed_out();
    let mut lists = FailedItems::load(root, handed_out)?;
    let seeds = SeedCounts {
        all: lists.seeds,
        thinnest: lists.seeds,
    };
    let (failed, detections) = failures::failed_items(solutions, practice, seeds)?;
    let line = format!("{} mistakes, {} seeds", failed.fails.len(), failed.seeds);
    lists.fails.extend(failed.fails);
    generate(
        &[lists.generated_file(handed_out)?],
        Mode::Write,
        "mistakes",
    )?;
    report(&detections.problems(), &line)
}

/// Returns the tasks with a name given on the command line.
fn parse_tasks(name: &str, authoring: &Authoring) -> anyhow::Result<TaskSelection> {
    TaskSelection::parse(name, authoring.handed_out.assignment).map_err(Error::msg)
}

/// Writes or checks the table for the practice exam.
fn write_table_of_mistakes(solutions: &Solutions, practice: &Exam, mode: Mode) -> CommandResult {
    let table = matrix::generated_file(solutions, practice)?;
    generate(&[table], mode, "mistakes")
}

/// Generates mutants of the reference and grades all of them, a fixed sample, or only the mutants
/// of some tasks.
pub(super) fn mutants(
    authoring: &'static Authoring,
    fast: bool,
    task: Option<&str>,
    record: RecordArgs,
) -> CommandResult {
    let tasks = task.map(|task| parse_tasks(task, authoring));
    let tasks = tasks.transpose()?.unwrap_or_default();
    let findings = mutants::run(authoring, &tasks, if fast { SAMPLE_STEP } else { 1 })?;
    let of_task = task.map_or(String::new(), |task| format!(" of {task}"));
    if fast {
        println!("selected: one in {SAMPLE_STEP} mutants{of_task}, sorted by name");
    } else {
        println!("selected: all mutants{of_task}");
    }
    let line = format!("mutants: {}", findings.summary_line());
    record_result(
        (record, authoring),
        "mutants of the reference",
        PRACTICE,
        &line,
    )?;
    report(&findings.problems(), &line)
}

/// Grades the variants with the exams for all seeds, and the mistakes with only the first few
/// exams.
pub(super) fn prove(authoring: &'static Authoring, args: ProveArgs) -> CommandResult {
    let all = solutions(authoring)?;
    let selected = match &args.variant {
        Some(id) => all.only_variant(id)?,
        None => all,
    };
    let seeds = written(&args.seeds);
    let summary = proof::prove::prove(&selected, args.seeds, args.mistakes)?;
    record_result(
        (args.record, authoring),
        "prove",
        &seeds,
        &summary.summary_line(),
    )?;
    for note in summary.notes() {
        print_error_line(note);
    }
    report(&summary.problems(), &summary.summary_line())
}

/// Measures the margins of all thresholds. Writes or checks their table.
pub(super) fn calibrate(
    root: &Path,
    authoring: &'static Authoring,
    args: CalibrateArgs,
) -> CommandResult {
    let default = if args.check { FEW_SEEDS } else { MANY_SEEDS };
    let seeds = args.seeds.unwrap_or(default);
    let written = written(&seeds);
    let calibration = proof::calibrate::calibrate(&solutions(authoring)?, seeds, args.mistakes)?;
    let line = calibration.summary_line();
    record_result((args.record, authoring), "calibrate", &written, &line)?;
    if args.check {
        table::check(root, authoring.handed_out, &calibration)?;
    } else {
        let table = table::generated_file(authoring.handed_out, &calibration);
        generate(&[table], Mode::Write, "calibrate")?;
    }
    report(&calibration.margins.problems(), &line)
}

/// Measures how well mistakes are recognised, prints the result and, if requested, records it.
pub(super) fn hints(root: &Path, authoring: &'static Authoring, args: HintsArgs) -> CommandResult {
    let solutions = solutions(authoring)?;
    let practice = exams::load_practice(root, authoring)?;
    let seeds = args.seeds.as_ref().map(written);
    let (run, recognition) = if let Some(seeds) = args.seeds {
        ("hints", recognise_with_seeds(&solutions, seeds)?)
    } else if args.independent {
        let recognition = recognise_independent(&solutions, &practice)?;
        ("hints --independent", recognition)
    } else if args.unknown {
        let recognition = recognise_unknown(&solutions, &practice, 1)?;
        ("hints --unknown", recognition)
    } else if let Some(count) = args.pairs {
        let recognition = recognise_pairs(&solutions, &practice, count)?;
        ("hints --pairs", recognition)
    } else {
        ("hints, one exam", recognise(&solutions, &practice)?)
    };
    // The summary line doesn't mention the problems, so a result with problems isn't recorded.
    report(&recognition.problems, &recognition.to_string())?;
    record_result(
        (args.record, authoring),
        run,
        seeds.as_deref().unwrap_or(PRACTICE),
        &recognition.summary_line,
    )
}
