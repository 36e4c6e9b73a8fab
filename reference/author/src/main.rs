//! The program `cargo author`: writes every generated file, and tests the exam. Its option `--help`
//! lists all commands.

use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;
use std::slice;

use author::bundle::secrets::Secrets;
use author::bundle::{self, Bundle, archive};
use author::cli::{Cli, Command, book_folder};
use author::coverage::coverage;
use author::generated_file::{GeneratedFile, Mode, write_or_check};
use author::package::{self, Course, Platform, trial};
use author::proof::by_heart::grade_by_heart;
use author::proof::calibrate::{FEW_SEEDS, MANY_SEEDS, calibrate, table};
use author::proof::mutants::{self, MutantSelection};
use author::proof::prove::prove;
use author::proof::recognition::{
    recognise, recognise_independent, recognise_pairs, recognise_with_seeds,
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
            if update {
                bundle = bundle.without_students_files(HANDED_OUT);
            }
            write_bundle(root, &bundle, out.as_deref(), check)
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
        Command::Mistakes { seeds, check, .. } => run_mistakes(root, seeds, check.mode()),
        Command::Mutants { fast, check } => {
            run_mutants(root, MutantSelection::new(fast), check.mode())
        }
        Command::Systematic { fast } => run_systematic(MutantSelection::new(fast)),
        Command::Coverage(check) => {
            let practice = exams::load_practice(root)?;
            let coverage = coverage(root, HANDED_OUT, &practice)?;
            generate(slice::from_ref(&coverage.table), check.mode(), "coverage")?;
            report(&coverage.problems, &coverage.summary_line())
        }
        Command::Hints {
            independent: true, ..
        } => {
            let practice = exams::load_practice(root)?;
            let recognition = recognise_independent(&solutions()?, &practice)?;
            report(&recognition.problems(), &recognition.to_string())
        }
        Command::Hints { seeds, pairs, .. } => {
            let solutions = solutions()?;
            match (seeds, pairs) {
                (Some(seeds), _) => println!("{}", recognise_with_seeds(&solutions, seeds)?),
                (None, Some(count)) => {
                    let practice = exams::load_practice(root)?;
                    let reference = Sources::reference(root, HANDED_OUT)?;
                    println!(
                        "{}",
                        recognise_pairs(&solutions, &practice, &reference, count)?
                    );
                }
                (None, None) => {
                    println!("{}", recognise(&solutions, &exams::load_practice(root)?)?)
                }
            }
            Ok(())
        }
        Command::Prove {
            seeds,
            mistakes,
            variant,
            write,
        } => {
            let selected = match variant {
                Some(id) => solutions()?.only_variant(&id)?,
                None => solutions()?,
            };
            let summary = prove(&selected, seeds, mistakes)?;
            if write {
                let record = summary.record(&today(), &commit(root)?);
                generate(&[record], Mode::Write, "prove")?;
            }
            for note in summary.notes() {
                eprintln!("{note}");
            }
            report(&summary.problems(), &summary.summary_line())
        }
        Command::ByHeart { seeds, out, write } => {
            let result = grade_by_heart(&solutions()?, &exams::load_practice(root)?, seeds)?;
            if let Some(folder) = out {
                result.sources.write(&folder)?;
            }
            if write {
                generate(&[result.record()], Mode::Write, "by-heart")?;
            }
            report(&result.problems(), &result.summary_line())
        }
        Command::Calibrate {
            seeds,
            mistakes,
            check,
        } => {
            if check {
                table::check(root)?;
            }
            let default = if check { FEW_SEEDS } else { MANY_SEEDS };
            let calibration = calibrate(&solutions()?, seeds.unwrap_or(default), mistakes)?;
            if !check {
                generate(
                    &[table::generated_file(&calibration)],
                    Mode::Write,
                    "calibrate",
                )?;
            }
            report(&calibration.margins.problems(), &calibration.summary_line())
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
fn write_bundle(root: &Path, bundle: &Bundle, out: Option<&Path>, check: bool) -> CommandResult {
    let secrets = Secrets::gather(root, HANDED_OUT, bundle)?;
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
            write_bundle(root, package, Some(out), false)?;
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
fn run_mistakes(root: &Path, seeds: Option<u64>, mode: Mode) -> CommandResult {
    let mut solutions = solutions()?;
    let practice = exams::load_practice(root)?;
    let default = match mode {
        Mode::Write => failures::MANY_SEEDS,
        Mode::Check => failures::FEW_SEEDS,
    };
    let seeds = seeds.unwrap_or(default);
    let (failed, catches) = failures::failed_items(&solutions, &practice, seeds)?;
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
    let thin = catches.problems();
    let caught = failed.fails.len() - thin.len();
    let line = format!(
        "mistakes {}, clearly caught {caught}, seeds {}",
        failed.fails.len(),
        failed.seeds
    );
    report(&thin, &line)
}

/// Writes or checks the table of the practice exam.
fn write_table_of_mistakes(solutions: &Solutions, practice: &Exam, mode: Mode) -> CommandResult {
    let table = matrix::generated_file(solutions, practice)?;
    generate(&[table], mode, "mistakes")
}

fn run_mutants(root: &Path, selection: MutantSelection, mode: Mode) -> CommandResult {
    let list = mutants::list(HANDED_OUT, root, mode)?;
    generate(&[list.generated_file()], mode, "mutants")?;
    let findings = mutants::run(HANDED_OUT, &list, selection)?;
    println!("{}", selection.description());
    report(
        &findings.problems(),
        &format!("mutants: {}", findings.summary_line()),
    )
}

fn run_systematic(selection: MutantSelection) -> CommandResult {
    let findings = mutants::run_systematic(HANDED_OUT, selection)?;
    println!("{}", selection.description());
    report(
        &findings.problems(),
        &format!("systematic mistakes: {}", findings.summary_line()),
    )
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

fn today() -> String {
    jiff::Timestamp::now().strftime("%F").to_string()
}

/// Returns the checked-out commit, with `-dirty` appended if there are uncommitted changes.
fn commit(root: &Path) -> io::Result<String> {
    let git = std::process::Command::new("git")
        .args(["describe", "--always", "--dirty", "--abbrev=12"])
        .current_dir(root)
        .output()?;
    Ok(String::from_utf8_lossy(&git.stdout).trim().to_owned())
}
