//! Checks a bundle's archive as a student would use it: unpacks it with an empty home directory,
//! compiles it as an editor does, runs the commands that its documents show, and grades the starter
//! (0 points) and the reference (100).

mod home;
mod shell_commands;

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use grader::files::{self, AtPath, PathError};
use grader::handed_out::HandedOut;
use serde::Deserialize;
use zip::result::ZipError;

use crate::bundle::check::home::{Home, HomeError};
use crate::bundle::{Bundle, archive};

/// The folder of the check, relative to the workspace's root. Compiled files stay there for the
/// next check.
const TEST_FOLDER: &str = "target/bundle";
/// The documents whose commands are run.
const DOCUMENTS: [&str; 2] = ["README.md", "handout/src/start.md"];
/// The command that editors run when a folder is opened and after each save. A fresh bundle has no errors
/// and no warnings.
const EDITOR_COMMAND: [&str; 5] = [
    "cargo",
    "check",
    "--workspace",
    "--all-targets",
    "--keep-going",
];
/// The score file that `cargo grade` writes, relative to the unpacked folder.
const SCORE_FILE: &str = "target/grade/student/score.json";

/// The reason why the bundle cannot be checked.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// The archive cannot be created or unpacked.
    #[error("cannot create or unpack the archive: {0}")]
    Zip(#[from] ZipError),
    /// The home directory cannot be created.
    #[error(transparent)]
    Home(#[from] HomeError),
    /// A file operation failed.
    #[error(transparent)]
    File(#[from] PathError),
}

/// The fields of a score file that are checked.
#[derive(Deserialize)]
struct Score {
    points: u32,
}

/// A command that a document shows, and its result.
struct CommandRun {
    command: String,
    /// The exit code, or `None` if the command was killed by a signal.
    code: Option<i32>,
    stderr: String,
}

/// Checks the archive of an assignment's bundle, made from the workspace at `root`, and returns the
/// problems found.
pub fn check(
    root: &Path,
    handed_out: &HandedOut,
    bundle: &Bundle,
) -> Result<Vec<String>, CheckError> {
    let unpacked = archive::unzip(&archive::zip(bundle)?)?;
    if unpacked != *bundle {
        return Ok(vec![
            "the archive does not unpack to the bundle's files".to_owned(),
        ]);
    }
    let root = &root.canonicalize().at("read", root)?;
    let test_folder = root.join(TEST_FOLDER);
    let lock = bundle.text("Cargo.lock").unwrap_or_default();
    let home = Home::create(&test_folder, lock)?;
    let folder = test_folder.join(archive::TOP_FOLDER);
    unpack_fresh(&folder, &unpacked)?;

    let commands =
        shell_commands::commands(DOCUMENTS.into_iter().filter_map(|path| unpacked.text(path)));
    let mut problems = Vec::new();
    let editor = EDITOR_COMMAND.map(str::to_owned).to_vec();
    for run in run_commands(&[editor], &home, &folder)? {
        // Not any warning: cargo also warns before it repeats a download.
        if run.code != Some(0) || run.stderr.contains(" generated ") {
            problems.push(run.problem("the starter"));
        }
    }
    for run in run_commands(&commands, &home, &folder)? {
        // The stubs make `cargo examples` exit with code 101, and `cargo render` with code 1.
        let is_expected = matches!(run.code, Some(0 | 1 | 101));
        if !is_expected || run.stderr.contains("could not compile") {
            problems.push(run.problem("the starter"));
        }
    }
    check_points(0, "the starter", &folder, &mut problems);

    let from = root.join(handed_out.reference);
    let to = folder.join(handed_out.student).join("src");
    for file in handed_out.files {
        files::copy(from.join(file.name), to.join(file.name))?;
    }
    for run in run_commands(&commands, &home, &folder)? {
        if run.code != Some(0) {
            problems.push(run.problem("the reference"));
        }
    }
    check_points(100, "the reference", &folder, &mut problems);
    Ok(problems)
}

fn unpack_fresh(folder: &Path, bundle: &Bundle) -> Result<(), PathError> {
    if folder.exists() {
        fs::remove_dir_all(folder).at("remove", folder)?;
    }
    archive::write_files(bundle, folder)
}

/// Runs each command in turn, and prints how long it took.
fn run_commands(
    commands: &[Vec<String>],
    home: &Home,
    folder: &Path,
) -> Result<Vec<CommandRun>, CheckError> {
    let one = |words: &Vec<String>| {
        let [program, arguments @ ..] = words.as_slice() else {
            unreachable!("shell_commands::commands skips empty lines");
        };
        let start = Instant::now();
        let mut command = Command::new(home.program(program));
        home.apply_to(&mut command);
        let output = command.args(arguments).current_dir(folder).output();
        let output = output.at("run", program)?;
        let run = CommandRun {
            command: words.join(" "),
            code: output.status.code(),
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
        };
        let seconds = start.elapsed().as_secs_f64();
        eprintln!("{seconds:6.1} s  {}", run.command);
        Ok(run)
    };
    commands.iter().map(one).collect()
}

fn check_points(points: u32, solution: &str, folder: &Path, problems: &mut Vec<String>) {
    let score = fs::read(folder.join(SCORE_FILE)).ok();
    let score = score.and_then(|text| serde_json::from_slice::<Score>(&text).ok());
    match score {
        Some(score) if score.points == points => {}
        Some(score) => problems.push(format!(
            "{solution} has {} points in the bundle, but should have {points}",
            score.points
        )),
        None => problems.push(format!(
            "{solution} has no score in the bundle: there is no valid {SCORE_FILE}"
        )),
    }
}

impl CommandRun {
    fn problem(&self, solution: &str) -> String {
        let end = self
            .code
            .map_or("was killed by a signal".to_owned(), |code| {
                format!("exited with code {code}")
            });
        let CommandRun {
            command, stderr, ..
        } = self;
        format!("with {solution}, `{command}` {end}:\n{stderr}")
    }
}
