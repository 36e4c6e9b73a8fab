//! The program `cargo author`: writes every generated file, and tests the exam. Its option `--help`
//! lists all commands.

use std::io::{self, Write};
use std::ops::Range;
use std::path::Path;
use std::process::ExitCode;
use std::slice;

use author::bundle::secrets::Secrets;
use author::bundle::{self, Bundle, archive};
use author::cli::{Cli, Command, RecordArgs, book_folder};
use author::coverage::coverage;
use author::generated_file::{GeneratedFile, Mode, write_or_check};
use author::long_runs;
use author::package::{self, Course, Platform, trial};
use author::proof::by_heart::grade_by_heart;
use author::proof::calibrate::{FEW_SEEDS, MANY_SEEDS, calibrate, table};
use author::proof::mutants::{self, MutantSelection};
use author::proof::prove::prove;
use author::proof::recognition::{
    recognise, recognise_independent, recognise_pairs, recognise_unknown, recognise_with_seeds,
};
use author::proof::{failures, matrix};
use author::solutions::failed_items::FailedItems;
use author::solutions::sources::Sources;
use author::solutions::workbench::Workbench;
use author::solutions::{Solutions, SolutionsError};
use author::{exams, handout, scenes, starter};
use clap::Parser;
use grader::files;
use grader::handed_out::{HandedOut, RAYS};
use judging::exam::Exam;

/// The workspace's root. The paths of generated files are relative to it.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
/// The assignment of all commands.
const HANDED_OUT: &HandedOut = &RAYS;
/// The entry of the table of long runs in place of seeds.
const PRACTICE: &str = "practice";

fn main() -> ExitCode {
    match run(Cli::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

type CommandResult = Result<(), Box<dyn std::error::Error>>;

fn run(command: Command) -> CommandResult {
    let root = Path::new(ROOT);
    match command {
        Command::Starter(check) => generate(
            &starter::generated_files(root, HANDED_OUT)?,
            check.mode(),
            "starter",
        ),
        Command::Exams(check) => generate(&exams::generated_files()?, check.mode(), "exams"),
        Command::Exam { seed } => {
            let exam = exams::final_exam_text(seed)?;
            Ok(io::stdout().write_all(exam.as_bytes())?)
        }
        Command::Scenes(check) => generate(&scenes::generated_files(), check.mode(), "scenes"),
        Command::Handout {
            check,
            book,
            students,
        } => {
            make_handout(root, check.mode())?;
            let Some(folder) = book else {
                return Ok(());
            };
            make_book(root, &root.join(book_folder(folder, students)), students)
        }
        Command::Bundle {
            out,
            book,
            update,
            check,
        } => {
            let mut bundle = Bundle::collect(root, HANDED_OUT, book.as_deref())?;
            // With the students' files: what their starter contains is no secret.
            let secrets = Secrets::gather(root, HANDED_OUT, &bundle)?;
            if update {
                bundle = bundle.without_students_files(HANDED_OUT);
            }
            write_bundle(root, &bundle, &secrets, out.as_deref(), check)
        }
        Command::Package {
            platform,
            out,
            exam_seed,
            exam,
            policy,
            check,
        } => {
            let course = Course::new(HANDED_OUT, exam_seed, exam.as_deref(), policy.as_deref())?;
            let package = package::collect(root, HANDED_OUT, platform, course)?;
            write_package(root, platform, &package, &out, check)
        }
        Command::Mistakes { table: true, .. } => {
            let practice = exams::load_practice(root)?;
            write_table_of_mistakes(&solutions()?, &practice, Mode::Write)
        }
        Command::Mistakes {
            seeds,
            check,
            record,
            ..
        } => run_mistakes(root, seeds, check.mode(), record),
        Command::Mutants {
            fast,
            check,
            record,
        } => run_mutants(root, MutantSelection::new(fast), check.mode(), record),
        Command::Systematic { fast, record } => run_systematic(MutantSelection::new(fast), record),
        Command::Coverage(check) => {
            let practice = exams::load_practice(root)?;
            let coverage = coverage(root, HANDED_OUT, &practice)?;
            generate(slice::from_ref(&coverage.table), check.mode(), "coverage")?;
            report(&coverage.problems, &coverage.summary_line())
        }
        Command::Hints {
            independent: true,
            record,
            ..
        } => {
            let practice = exams::load_practice(root)?;
            let recognition = recognise_independent(&solutions()?, &practice)?;
            record_result(
                record,
                "hints --independent",
                PRACTICE,
                &recognition.summary_line(),
            )?;
            report(&recognition.problems(), &recognition.to_string())
        }
        Command::Hints {
            unknown: true,
            record,
            ..
        } => {
            let practice = exams::load_practice(root)?;
            let reference = Sources::reference(root, HANDED_OUT)?;
            let recognition = recognise_unknown(&solutions()?, &practice, &reference)?;
            record_result(
                record,
                "hints --unknown",
                PRACTICE,
                &recognition.summary_line(),
            )?;
            report(&recognition.problems, &recognition.to_string())
        }
        Command::Hints {
            seeds: Some(seeds),
            record,
            ..
        } => {
            let recognition = recognise_with_seeds(&solutions()?, seeds.clone())?;
            println!("{recognition}");
            record_result(
                record,
                "hints",
                &written(&seeds),
                &recognition.summary_line(),
            )
        }
        Command::Hints {
            pairs: Some(count),
            record,
            ..
        } => {
            let practice = exams::load_practice(root)?;
            let reference = Sources::reference(root, HANDED_OUT)?;
            let recognition = recognise_pairs(&solutions()?, &practice, &reference, count)?;
            println!("{recognition}");
            record_result(
                record,
                "hints --pairs",
                PRACTICE,
                &recognition.summary_line(),
            )
        }
        Command::Hints { record, .. } => {
            let recognition = recognise(&solutions()?, &exams::load_practice(root)?)?;
            println!("{recognition}");
            record_result(
                record,
                "hints, one exam",
                PRACTICE,
                &recognition.summary_line(),
            )
        }
        Command::Prove {
            seeds,
            mistakes,
            variant,
            record,
        } => {
            let selected = match variant {
                Some(id) => solutions()?.only_variant(&id)?,
                None => solutions()?,
            };
            let summary = prove(&selected, seeds.clone(), mistakes)?;
            record_result(record, "prove", &written(&seeds), &summary.summary_line())?;
            for note in summary.notes() {
                eprintln!("{note}");
            }
            report(&summary.problems(), &summary.summary_line())
        }
        Command::ByHeart { seeds, out, record } => {
            let practice = exams::load_practice(root)?;
            let result = grade_by_heart(&solutions()?, &practice, seeds.clone())?;
            if let Some(folder) = out {
                result.sources.write(&folder)?;
            }
            record_result(record, "by-heart", &written(&seeds), &result.summary_line())?;
            report(&result.problems(), &result.summary_line())
        }
        Command::Calibrate {
            seeds,
            mistakes,
            check,
            record,
        } => {
            if check {
                table::check(root)?;
            }
            let default = if check { FEW_SEEDS } else { MANY_SEEDS };
            let seeds = seeds.unwrap_or(default);
            let calibration = calibrate(&solutions()?, seeds.clone(), mistakes)?;
            let line = calibration.summary_line();
            record_result(record, "calibrate", &written(&seeds), &line)?;
            if !check {
                generate(
                    &[table::generated_file(&calibration)],
                    Mode::Write,
                    "calibrate",
                )?;
            }
            report(&calibration.margins.problems(), &line)
        }
    }
}

/// Writes generated files, or compares them with the files on disk. `name` is the subcommand of
/// `cargo author` that writes them.
fn generate(files: &[GeneratedFile], mode: Mode, name: &str) -> CommandResult {
    let command = format!("cargo author {name}");
    Ok(write_or_check(files, Path::new(ROOT), mode, &command)?)
}

fn make_handout(root: &Path, mode: Mode) -> CommandResult {
    generate(&handout::generated_files(), mode, "handout")?;
    let problems = handout::problems(root, &exams::load_practice(root)?)?;
    report(
        &problems,
        "handout: every link, name and command was checked",
    )
}

#[cfg(feature = "book")]
fn make_book(root: &Path, folder: &Path, students: bool) -> CommandResult {
    if students {
        handout::book::build_for_students(&Bundle::collect(root, &RAYS, None)?, folder)?;
    } else {
        handout::book::build(root, folder)?;
    }
    println!("{}", folder.join("index.html").display());
    Ok(())
}

#[cfg(not(feature = "book"))]
fn make_book(_: &Path, _: &Path, _: bool) -> CommandResult {
    Err("this program was built without mdBook: run `cargo book` instead".into())
}

fn solutions() -> Result<Solutions, SolutionsError> {
    Solutions::load(Workbench::open(HANDED_OUT)?)
}

/// Writes the students' bundle. Fails if the bundle contains a secret.
fn write_bundle(
    root: &Path,
    bundle: &Bundle,
    secrets: &Secrets,
    out: Option<&Path>,
    check: bool,
) -> CommandResult {
    let leaks = secrets.search(bundle);
    let mut problems: Vec<String> = leaks.iter().map(ToString::to_string).collect();
    if check && leaks.is_empty() {
        problems = bundle::check::check(root, HANDED_OUT, bundle)?;
    }
    let (count, size) = (bundle.files.len(), bundle.size() / 1000);
    let version = bundle.version();
    let version = version.map_or(String::new(), |version| format!("version {version}, "));
    let line = format!("{version}{count} files, {size} kB, searched for {secrets}");
    report(&problems, &line)?;
    if let Some(out) = out {
        archive::write(bundle, out)?;
    }
    Ok(())
}

/// Writes a platform's package. A template repository is searched for secrets first.
fn write_package(
    root: &Path,
    platform: Platform,
    package: &Bundle,
    out: &Path,
    check: bool,
) -> CommandResult {
    match platform {
        Platform::Gradescope => {
            let is_zip = out.extension().is_some_and(|extension| extension == "zip");
            if !is_zip {
                return Err(
                    "Gradescope needs a zip file: choose a name for --out that ends with .zip"
                        .into(),
                );
            }
            files::write_with_parents(out, archive::zip_with_prefix(package, "")?)?;
            let (count, size) = (package.files.len(), package.size() / 1_000_000);
            println!("{count} files, {size} MB unpacked: {}", out.display());
            if check {
                report(
                    &trial::gradescope::check(HANDED_OUT, root, out)?,
                    "the package grades correctly when run as on Gradescope",
                )
            } else {
                Ok(())
            }
        }
        Platform::Classroom50 => {
            archive::write_folder(package, out)?;
            println!("{} files: {}", package.files.len(), out.display());
            if check {
                report(
                    &trial::classroom50::check(HANDED_OUT, root, out)?,
                    "the package grades a checkout correctly when run as on classroom50",
                )
            } else {
                Ok(())
            }
        }
        Platform::Github => {
            let secrets = Secrets::gather(root, HANDED_OUT, package)?;
            write_bundle(root, package, &secrets, Some(out), false)?;
            if check {
                report(
                    &trial::github::check(HANDED_OUT, root, package)?,
                    "the template's workflow grades a checkout correctly",
                )
            } else {
                Ok(())
            }
        }
    }
}

/// Writes the lists of the items that each mistake fails and the table of the practice exam, or
/// checks them.
fn run_mistakes(root: &Path, seeds: Option<u64>, mode: Mode, record: RecordArgs) -> CommandResult {
    let mut solutions = solutions()?;
    let practice = exams::load_practice(root)?;
    let default = match mode {
        Mode::Write => failures::MANY_SEEDS,
        Mode::Check => failures::FEW_SEEDS,
    };
    let seeds = seeds.unwrap_or(default);
    let (failed, catches) = failures::failed_items(&solutions, &practice, seeds)?;
    let thin = catches.problems();
    let caught = failed.fails.len() - thin.len();
    let line = format!(
        "mistakes {}, clearly caught {caught}, seeds {}",
        failed.fails.len(),
        failed.seeds
    );
    // Before the files are written, so that they do not count as changes of the commit.
    record_result(record, "mistakes", &written(&(0..seeds)), &line)?;
    let committed = FailedItems::load(root, HANDED_OUT)?;
    if mode == Mode::Check {
        let mut problems = failures::problems(&committed, &failed);
        problems.extend(catches.problems());
        let line = format!("seeds {}, mistakes {}", failed.seeds, failed.fails.len());
        report(&problems, &line)?;
    }
    // A check with as many seeds must find the same lists.
    if mode == Mode::Write || failed.seeds == committed.seeds {
        generate(&[failed.generated_file(HANDED_OUT)?], mode, "mistakes")?;
    }
    if mode == Mode::Write {
        generate(&[catches.generated_file(HANDED_OUT)], mode, "mistakes")?;
        solutions.set_failed_items(&failed);
    }
    write_table_of_mistakes(&solutions, &practice, mode)?;
    report(&thin, &line)
}

/// Writes or checks the table of the practice exam.
fn write_table_of_mistakes(solutions: &Solutions, practice: &Exam, mode: Mode) -> CommandResult {
    let table = matrix::generated_file(solutions, practice)?;
    generate(&[table], mode, "mistakes")
}

fn run_mutants(
    root: &Path,
    selection: MutantSelection,
    mode: Mode,
    record: RecordArgs,
) -> CommandResult {
    let list = mutants::list(HANDED_OUT, root, mode)?;
    generate(&[list.generated_file()], mode, "mutants")?;
    let findings = mutants::run(HANDED_OUT, &list, selection)?;
    println!("{}", selection.description());
    let line = format!("mutants: {}", findings.summary_line());
    record_result(record, "mutants of the reference", PRACTICE, &line)?;
    report(&findings.problems(), &line)
}

fn run_systematic(selection: MutantSelection, record: RecordArgs) -> CommandResult {
    let findings = mutants::run_systematic(HANDED_OUT, selection)?;
    println!("{}", selection.description());
    let line = format!("systematic mistakes: {}", findings.summary_line());
    record_result(record, "systematic", PRACTICE, &line)?;
    report(&findings.problems(), &line)
}

/// Prints the problems and the summary line. Fails if there are problems.
fn report(problems: &[String], line: &str) -> CommandResult {
    for problem in problems {
        eprintln!("{problem}");
    }
    println!("{line}");
    match problems.len() {
        0 => Ok(()),
        1 => Err("1 problem was found: see above".into()),
        count => Err(format!("{count} problems were found: see above").into()),
    }
}

/// Writes the result of a run into the table of long runs, if that is wanted.
fn record_result(wanted: RecordArgs, run: &str, exams: &str, line: &str) -> CommandResult {
    if wanted.record {
        long_runs::record(Path::new(ROOT), run, exams, line)?;
    }
    Ok(())
}

/// Returns seeds as they are written on the command line.
fn written(seeds: &Range<u64>) -> String {
    format!("{}..{}", seeds.start, seeds.end)
}
