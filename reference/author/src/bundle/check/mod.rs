//! The trial of the archive: unpacked on a machine that has Rust and nothing else, it does what its
//! texts say, gives the starter no point and the solution all of them.

mod home;
mod shell_commands;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use grader::given_files::TASK_FILES;
use serde::Deserialize;
use zip::result::ZipError;

use crate::bundle::check::home::{Home, HomeError};
use crate::bundle::{Bundle, archive};

/// Where it is tried, from the workspace's root. What was compiled there stays for the next time.
const TEST_FOLDER: &str = "target/bundle";
/// The texts whose commands are tried.
const DOCUMENTS: [&str; 2] = ["README.md", "handout/src/start.md"];
/// Where `cargo grade` leaves what it found out, from the unpacked folder.
const SCORE_FILE: &str = "target/grade/student/score.json";

/// The archive was not tried: our fault, or the machine's.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// The archive can not be made or unpacked.
    #[error("the archive: {0}")]
    Zip(#[from] ZipError),
    /// There is no empty home.
    #[error(transparent)]
    Home(#[from] HomeError),
    /// The system does not let us.
    #[error("can not use {}: {source}", path.display())]
    Io {
        /// What.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
}

/// What is read of the score file.
#[derive(Deserialize)]
struct Score {
    points: u32,
}

/// A command of the texts, and how it ended.
struct CommandRun {
    command: String,
    code: Option<i32>,
    stderr: String,
}

/// Tries the archive of the workspace at `root`, and tells what is not as it should be.
pub fn check(root: &Path, bundle: &Bundle) -> Result<Vec<String>, CheckError> {
    let unpacked = archive::unzip(&archive::zip(bundle)?)?;
    if unpacked != *bundle {
        return Ok(vec!["the archive unpacks to something else".to_owned()]);
    }
    let root = &root.canonicalize().map_err(io_error(root))?;
    let place = root.join(TEST_FOLDER);
    let lock = bundle.text("Cargo.lock").unwrap_or_default();
    let home = Home::create(&place, lock)?;
    let folder = place.join(archive::TOP_FOLDER);
    unpack_fresh(&folder, &unpacked).map_err(io_error(&folder))?;

    let commands =
        shell_commands::commands(DOCUMENTS.into_iter().filter_map(|path| unpacked.text(path)));
    let mut complaints = Vec::new();
    for tried in run_commands(&commands, &home, &folder)? {
        // A stub ends an example with 101 and a picture with 1; nothing else is in order.
        let in_order = matches!(tried.code, Some(0 | 1 | 101));
        if !in_order || tried.stderr.contains("could not compile") {
            complaints.push(tried.problem("the starter"));
        }
    }
    check_points(0, "the starter", &folder, &mut complaints);

    for file in TASK_FILES {
        let (from, to) = (root.join("reference/src"), folder.join("student/src"));
        fs::copy(from.join(file.name), to.join(file.name)).map_err(io_error(&to))?;
    }
    for tried in run_commands(&commands, &home, &folder)? {
        if tried.code != Some(0) {
            complaints.push(tried.problem("the reference"));
        }
    }
    check_points(100, "the reference", &folder, &mut complaints);
    Ok(complaints)
}

fn io_error(path: &Path) -> impl FnOnce(io::Error) -> CheckError {
    let path = path.to_owned();
    move |source| CheckError::Io { path, source }
}

fn unpack_fresh(folder: &Path, bundle: &Bundle) -> io::Result<()> {
    if folder.exists() {
        fs::remove_dir_all(folder)?;
    }
    archive::write_files(bundle, folder)
}

/// Runs each command in turn, and says on the terminal how long it took.
fn run_commands(
    commands: &[Vec<String>],
    home: &Home,
    folder: &Path,
) -> Result<Vec<CommandRun>, CheckError> {
    let one = |words: &Vec<String>| {
        let [program, arguments @ ..] = words.as_slice() else {
            unreachable!("a line without words is no command");
        };
        let began = Instant::now();
        let mut command = Command::new(home.program(program));
        home.apply_to(&mut command);
        let output = command.args(arguments).current_dir(folder).output();
        let output = output.map_err(io_error(Path::new(program)))?;
        let tried = CommandRun {
            command: words.join(" "),
            code: output.status.code(),
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
        };
        let seconds = began.elapsed().as_secs_f64();
        eprintln!("{seconds:6.1} s  {}", tried.command);
        Ok(tried)
    };
    commands.iter().map(one).collect()
}

fn check_points(points: u32, whose: &str, folder: &Path, complaints: &mut Vec<String>) {
    let score = fs::read(folder.join(SCORE_FILE)).ok();
    let score = score.and_then(|text| serde_json::from_slice::<Score>(&text).ok());
    match score {
        Some(score) if score.points == points => {}
        Some(score) => complaints.push(format!(
            "{whose} has {} points in the bundle, and should have {points}",
            score.points
        )),
        None => complaints.push(format!(
            "{whose} has no score in the bundle: no {SCORE_FILE}"
        )),
    }
}

impl CommandRun {
    fn problem(&self, whose: &str) -> String {
        let code = self
            .code
            .map_or("a signal".to_owned(), |code| code.to_string());
        let CommandRun {
            command,
            stderr: said,
            ..
        } = self;
        format!("with {whose}, `{command}` ended with {code}:\n{said}")
    }
}
