//! Writes all that is generated: `cargo author --help`.

use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

use author::cli::{Cli, Command};
use author::generated::{Generated, Mode, deliver};
use author::proof::calibrate::margins::ENOUGH;
use author::proof::calibrate::{FEW_SEEDS, MANY_SEEDS, calibrate, table};
use author::proof::exhibits::Exhibits;
use author::proof::matrix;
use author::proof::mutants::{self, Extent};
use author::proof::prove::prove;
use author::proof::recognition::recognise;
use author::proof::workbench::Workbench;
use author::{exams, generated, scenes, starter};
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

fn run(command: Command) -> Result<(), Box<dyn std::error::Error>> {
    let root = Path::new(ROOT);
    let deliver = |files: &[Generated], mode: Mode, name: &str| {
        deliver(files, root, mode, &format!("cargo author {name}"))
    };
    match command {
        Command::Starter(check) => deliver(&starter::generated(root)?, check.mode(), "starter")?,
        Command::Exams(check) => deliver(&exams::generated()?, check.mode(), "exams")?,
        Command::Exam { seed } => {
            let exam = exams::final_text(seed)?;
            io::stdout().write_all(exam.as_bytes())?;
        }
        Command::Scenes(check) => deliver(&scenes::generated(), check.mode(), "scenes")?,
        Command::Mistakes(check) => deliver(&[matrix::generated()?], check.mode(), "mistakes")?,
        Command::Mutants { fast, check } => {
            let list = mutants::list(root, check.mode())?;
            deliver(&[list.generated()], check.mode(), "mutants")?;
            let extent = Extent::new(fast);
            let findings = mutants::ask(&list, extent)?;
            for complaint in findings.complaints() {
                eprintln!("{complaint}");
            }
            println!("{}", extent.words());
            println!("{}", findings.line());
            if !findings.complaints().is_empty() {
                return Err("not every mutant fares as it should: see above".into());
            }
        }
        Command::Hints => {
            let exhibits = Exhibits::prepare(Workbench::open()?)?;
            let recognition = recognise(&exhibits, &exams::practice(root)?)?;
            println!("{recognition}");
        }
        Command::Prove {
            seeds,
            mistakes,
            write,
        } => {
            let exhibits = Exhibits::prepare(Workbench::open()?)?;
            let summary = prove(&exhibits, seeds, mistakes)?;
            for complaint in summary.complaints() {
                eprintln!("{complaint}");
            }
            println!("{}", summary.line());
            if write {
                let record = summary.record(&today(), &commit(root)?);
                generated::deliver(&[record], root, Mode::Write, "prove")?;
            }
            if !summary.is_proven() {
                return Err("the exam is not proven: see above".into());
            }
        }
        Command::Calibrate {
            seeds,
            mistakes,
            check,
        } => {
            if check {
                table::check(root)?;
            }
            let exhibits = Exhibits::prepare(Workbench::open()?)?;
            let usual = if check { FEW_SEEDS } else { MANY_SEEDS };
            let calibration = calibrate(&exhibits, seeds.unwrap_or(usual), mistakes)?;
            if !check {
                let table = table::generated(&calibration);
                deliver(&[table], Mode::Write, "calibrate")?;
            }
            let complaints = calibration.margins.complaints();
            for complaint in &complaints {
                eprintln!("{complaint}");
            }
            println!("{}", calibration.line());
            if !complaints.is_empty() {
                return Err(format!("margins below {ENOUGH}: see above").into());
            }
        }
    }
    Ok(())
}
