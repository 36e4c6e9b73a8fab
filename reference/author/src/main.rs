//! Writes all that is generated: `cargo author --help`.

use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

use author::bundle::secrets::Secrets;
use author::bundle::{self, Bundle, archive};
use author::cli::{Cli, Command};
use author::generated::{Generated, Mode, deliver};
use author::package::{self, Course, Platform, trial};
use author::proof::calibrate::{FEW_SEEDS, MANY_SEEDS, calibrate, table};
use author::proof::exhibits::{Exhibits, NotProven};
use author::proof::matrix;
use author::proof::mutants::{self, Extent};
use author::proof::prove::prove;
use author::proof::recognition::recognise;
use author::proof::workbench::Workbench;
use author::{exams, handout, scenes, starter};
use clap::Parser;

/// The workspace's root, where all paths of generated files start.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

fn main() -> ExitCode {
    match run(Cli::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

type Done = Result<(), Box<dyn std::error::Error>>;

fn run(command: Command) -> Done {
    let root = Path::new(ROOT);
    match command {
        Command::Starter(check) => put(&starter::generated(root)?, check.mode(), "starter"),
        Command::Exams(check) => put(&exams::generated()?, check.mode(), "exams"),
        Command::Exam { seed } => {
            let exam = exams::final_text(seed)?;
            Ok(io::stdout().write_all(exam.as_bytes())?)
        }
        Command::Scenes(check) => put(&scenes::generated(), check.mode(), "scenes"),
        Command::Handout { check, book } => make_handout(root, check.mode(), book.as_deref()),
        Command::Bundle { out, book, check } => {
            let bundle = Bundle::collect(root, book.as_deref())?;
            hand_out(root, &bundle, out.as_deref(), check)
        }
        Command::Package {
            platform,
            out,
            exam_seed,
            exam,
            policy,
            check,
        } => {
            let course = Course::new(exam_seed, exam.as_deref(), policy.as_deref())?;
            let package = package::collect(root, platform, course)?;
            pack(root, platform, &package, &out, check)
        }
        Command::Mistakes(check) => put(&[matrix::generated()?], check.mode(), "mistakes"),
        Command::Mutants { fast, check } => ask_mutants(root, Extent::new(fast), check.mode()),
        Command::Hints => {
            let recognition = recognise(&exhibits()?, &exams::practice(root)?)?;
            println!("{recognition}");
            Ok(())
        }
        Command::Prove {
            seeds,
            mistakes,
            variant,
            write,
        } => {
            let exhibits = match variant {
                Some(id) => exhibits()?.only(&id)?,
                None => exhibits()?,
            };
            let summary = prove(&exhibits, seeds, mistakes)?;
            if write {
                let record = summary.record(&today(), &commit(root)?);
                put(&[record], Mode::Write, "prove")?;
            }
            conclude(&summary.complaints(), &summary.line())
        }
        Command::Calibrate {
            seeds,
            mistakes,
            check,
        } => {
            if check {
                table::check(root)?;
            }
            let usual = if check { FEW_SEEDS } else { MANY_SEEDS };
            let calibration = calibrate(&exhibits()?, seeds.unwrap_or(usual), mistakes)?;
            if !check {
                put(&[table::generated(&calibration)], Mode::Write, "calibrate")?;
            }
            conclude(&calibration.margins.complaints(), &calibration.line())
        }
    }
}

/// Writes or compares what is generated; `name` is the command that writes it.
fn put(files: &[Generated], mode: Mode, name: &str) -> Done {
    let mend = format!("cargo author {name}");
    Ok(deliver(files, Path::new(ROOT), mode, &mend)?)
}

fn make_handout(root: &Path, mode: Mode, book: Option<&Path>) -> Done {
    put(&handout::generated(), mode, "handout")?;
    let complaints = handout::complaints(root, &exams::practice(root)?)?;
    conclude(
        &complaints,
        "the handout: every link, name and command is there",
    )?;
    book.map_or(Ok(()), |folder| make_book(root, &root.join(folder)))
}

#[cfg(feature = "book")]
fn make_book(root: &Path, folder: &Path) -> Done {
    handout::book::build(root, folder)?;
    println!("{}", folder.join("index.html").display());
    Ok(())
}

#[cfg(not(feature = "book"))]
fn make_book(_: &Path, _: &Path) -> Done {
    Err("this program was built without mdBook; `cargo book` builds one with it".into())
}

fn exhibits() -> Result<Exhibits, NotProven> {
    Exhibits::prepare(Workbench::open()?)
}

/// Hands out what students get; refuses if there is a secret in it.
fn hand_out(root: &Path, bundle: &Bundle, out: Option<&Path>, check: bool) -> Done {
    let secrets = Secrets::gather(root, bundle)?;
    let leaks = secrets.search(bundle);
    let mut complaints: Vec<String> = leaks.iter().map(ToString::to_string).collect();
    if check && leaks.is_empty() {
        complaints = bundle::check::check(root, bundle)?;
    }
    let (count, size) = (bundle.files.len(), bundle.size() / 1000);
    let line = format!("{count} files, {size} kB, {secrets} in none of them");
    conclude(&complaints, &line)?;
    if let Some(out) = out {
        archive::write(bundle, out)?;
    }
    Ok(())
}

/// Writes a platform's package. What students can read is searched for secrets before.
fn pack(root: &Path, platform: Platform, package: &Bundle, out: &Path, check: bool) -> Done {
    match platform {
        Platform::Gradescope => {
            let is_zip = out.extension().is_some_and(|extension| extension == "zip");
            if !is_zip {
                return Err("Gradescope takes a zip: let --out end with .zip".into());
            }
            out.parent().map_or(Ok(()), std::fs::create_dir_all)?;
            std::fs::write(out, archive::zip_below(package, "")?)?;
            let (count, size) = (package.files.len(), package.size() / 1_000_000);
            println!("{count} files, {size} MB unpacked: {}", out.display());
            match check {
                true => conclude(
                    &trial::gradescope::check(root, out)?,
                    "it grades as Gradescope runs it",
                ),
                false => Ok(()),
            }
        }
        Platform::Classroom50 => {
            archive::write_folder(package, out)?;
            println!("{} files: {}", package.files.len(), out.display());
            match check {
                true => conclude(
                    &trial::classroom50::check(root, out)?,
                    "it grades a checkout as classroom50 runs it",
                ),
                false => Ok(()),
            }
        }
        Platform::Github => {
            hand_out(root, package, Some(out), false)?;
            match check {
                true => conclude(
                    &trial::github::check(root, package)?,
                    "its workflow grades a checkout",
                ),
                false => Ok(()),
            }
        }
    }
}

fn ask_mutants(root: &Path, extent: Extent, mode: Mode) -> Done {
    let list = mutants::list(root, mode)?;
    put(&[list.generated()], mode, "mutants")?;
    let findings = mutants::ask(&list, extent)?;
    println!("{}", extent.words());
    conclude(&findings.complaints(), &findings.line())
}

/// Says what was found, and fails if there is something to complain of.
fn conclude(complaints: &[String], line: &str) -> Done {
    for complaint in complaints {
        eprintln!("{complaint}");
    }
    println!("{line}");
    match complaints.len() {
        0 => Ok(()),
        count => Err(format!("{count} findings that should not be: see above").into()),
    }
}

fn today() -> String {
    jiff::Timestamp::now().strftime("%F").to_string()
}

/// The commit that is checked out, and whether something was changed since.
fn commit(root: &Path) -> io::Result<String> {
    let git = std::process::Command::new("git")
        .args(["describe", "--always", "--dirty", "--abbrev=12"])
        .current_dir(root)
        .output()?;
    Ok(String::from_utf8_lossy(&git.stdout).trim().to_owned())
}
