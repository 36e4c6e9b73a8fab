//! One direct call of `rustc`: no manifest, build script, configuration or fingerprint beside a
//! submission is ever read, and its files' times mean nothing.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use crate::build::dependencies::Dependencies;
use crate::build::diagnostics::{self, Diagnostic};
use crate::build::toolchain::Toolchain;
use crate::capture::Capture;
use crate::given::GIVEN_FILES;
use crate::sandbox::{Ending, Limits, Process};

/// The crate's root: the given `lib.rs`, and a way in.
const ROOT: &str = "probe.rs";
const ENTRY: &str = "
/// Answers the grader.
fn main() -> std::process::ExitCode {
    framework::probe::main(&world::Student)
}
";

const LIMITS: Limits = Limits {
    memory: 4 << 30,
    cpu: Duration::from_secs(60),
    file: 256 << 20,
};
/// The back-stop for a compiler that waits instead of working.
const WALL: Duration = Duration::from_secs(90);
/// How much is kept of what the compiler says.
const KEPT: usize = 1 << 20;

/// What became of one call of the compiler.
#[derive(Debug)]
pub enum Compiled {
    /// A program.
    Probe(PathBuf),
    /// Errors.
    Errors(Vec<Diagnostic>),
    /// The compiler did not come to an end by itself, or said nothing that we understand.
    Failed(String),
}

/// Compiles the five files, given as name and text, together with ours, in `folder`.
pub fn compile(
    files: &[(&str, &str)],
    folder: &Path,
    toolchain: &Toolchain,
    dependencies: &Dependencies,
) -> io::Result<Compiled> {
    fs::create_dir_all(folder)?;
    for (name, text) in files.iter().chain(&GIVEN_FILES) {
        fs::write(folder.join(name), text)?;
    }
    let [(_, lib), ..] = GIVEN_FILES;
    fs::write(folder.join(ROOT), format!("{lib}{ENTRY}"))?;

    let mut rustc = Command::new(&toolchain.rustc);
    rustc
        .env_clear()
        .env("PATH", std::env::var_os("PATH").unwrap_or_default())
        .env("TMPDIR", folder)
        .args(arguments(dependencies))
        .arg(ROOT);
    let mut process = Process::start(&mut rustc, folder, LIMITS)?;
    let messages = Capture::start(process.child.stderr.take().expect("it is piped"), KEPT);

    let deadline = Instant::now() + WALL;
    let ending = loop {
        match process.ending() {
            Some(ending) => break ending,
            None if Instant::now() >= deadline => {
                process.kill();
                let seconds = WALL.as_secs();
                return Ok(Compiled::Failed(format!(
                    "the compiler was stopped after {seconds} s"
                )));
            }
            None => thread::sleep(Duration::from_millis(1)),
        }
    };
    messages.settle(Duration::from_secs(1));

    let probe = folder.join("probe");
    if ending.is_success() && probe.is_file() {
        return Ok(Compiled::Probe(probe));
    }
    let errors = diagnostics::errors(&messages.head());
    Ok(if errors.is_empty() {
        Compiled::Failed(failure(ending))
    } else {
        Compiled::Errors(errors)
    })
}

fn failure(ending: Ending) -> String {
    match ending {
        Ending::Code(code) => format!("the compiler ended with exit code {code}"),
        Ending::Signal(signal) => format!(
            "the compiler was ended by signal {signal}: too much time or memory, or code that it can not digest"
        ),
    }
}

/// The same flags for everyone: students, TAs, CI.
fn arguments(dependencies: &Dependencies) -> Vec<OsString> {
    let mut arguments: Vec<OsString> = [
        "--edition=2024",
        "--crate-name=submission",
        "--crate-type=bin",
        "-Copt-level=2",
        "-Ccodegen-units=1",
        "-Cdebuginfo=0",
        "-Coverflow-checks=on",
        "-Cpanic=unwind",
        "-Funsafe_code",
        "-Awarnings",
        "--error-format=json",
        "-o",
        "probe",
    ]
    .map(OsString::from)
    .to_vec();
    let mut folder = OsString::from("-Ldependency=");
    folder.push(&dependencies.folder);
    arguments.push(folder);
    for (name, rlib) in &dependencies.externs {
        let mut path = OsString::from(format!("{name}="));
        path.push(rlib);
        arguments.extend([OsString::from("--extern"), path]);
    }
    arguments
}
