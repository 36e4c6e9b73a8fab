//! Compiles and runs small programs of our own in the way in which submissions are compiled and
//! run.

use std::fs;
use std::io::{self, Write};
use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use crate::build::rustc::{CompileOutcome, Crate, CrateKind, Rustc};
use crate::capture::Capture;
use crate::sandbox::{Profile, Sandbox};
use crate::system::{self, Limits};

/// The limits of a program.
const LIMITS: Limits = Limits {
    memory: 1 << 30,
    data: None,
    cpu: Duration::from_secs(10),
    file: 0,
};
/// Wall time limit of a program. It takes milliseconds, unless the machine is very busy.
const WALL_LIMIT: Duration = Duration::from_secs(30);
/// Maximum length of a program's output, in bytes.
const MAX_OUTPUT_BYTES: usize = 1 << 16;

/// Compiles a program or library in a new folder in `work`.
pub(super) fn compile(
    rustc: &Rustc,
    work: &Path,
    name: &str,
    text: &str,
    kind: CrateKind,
) -> io::Result<CompileOutcome> {
    let folder = work.join(name);
    let root = format!("{name}.rs");
    fs::create_dir(&folder)?;
    fs::write(folder.join(&root), text)?;
    rustc.for_own_code().compile(&Crate {
        name,
        kind,
        folder: &folder,
        root: &root,
        links: &[],
        dependency_folder: None,
    })
}

/// Runs a program, and returns what it prints to standard error or, if that is nothing, to standard
/// output.
pub(super) fn run(sandbox: &Sandbox, program: &Path, input: &str) -> io::Result<String> {
    let mut command = Command::new(program);
    system::clear_environment(&mut command);
    let folder = program.parent().unwrap_or(Path::new("."));
    let mut process = sandbox.start(command, folder, Profile::Probe, LIMITS)?;
    let stdout = process.child.stdout.take().expect("the stream is piped");
    let stderr = process.child.stderr.take().expect("the stream is piped");
    let output = Capture::start(stdout, MAX_OUTPUT_BYTES);
    let errors = Capture::start(stderr, MAX_OUTPUT_BYTES);
    let mut stdin = process.child.stdin.take().expect("the stream is piped");
    // If the program has already ended, its output says why.
    stdin.write_all(input.as_bytes()).ok();

    let deadline = Instant::now() + WALL_LIMIT;
    while process.exit_reason().is_none() && Instant::now() < deadline {
        thread::sleep(Duration::from_millis(1));
    }
    process.kill();
    output.wait_for_end(Duration::from_secs(1));
    errors.wait_for_end(Duration::from_secs(1));
    Ok(match errors.head() {
        errors if errors.is_empty() => output.head(),
        errors => errors,
    })
}
