//! Runs the grader's own small programs in the same way as submissions.

use std::io::{self, Write};
use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use crate::build::rustc::Rustc;
use crate::machine::capture::Capture;
use crate::machine::system::{self, Limits};
use crate::sandbox::{Profile, Sandbox};

/// The limits for a program.
const LIMITS: Limits = Limits {
    memory: 1 << 30,
    data: None,
    cpu: Duration::from_secs(10),
    file: 0,
};
/// Wall time limit for a program, which takes only milliseconds unless the machine is very busy.
const WALL_LIMIT: Duration = Duration::from_secs(30);
/// Maximum length of a program's output, in bytes.
const MAX_OUTPUT_BYTES: usize = 1 << 16;

/// The output of the control program that [`Rustc::compile_honest`] compiles.
const HONEST_OUTPUT: &str = "end\n";

/// Returns an error unless the control program, compiled next to `folder`, runs to completion. The
/// control program uses the most memory that a program may use without being considered out of
/// memory.
pub(super) fn check_run(rustc: &Rustc, folder: &Path) -> io::Result<()> {
    let (_folder, program) = rustc.compile_honest(folder)?;
    if run(&rustc.sandbox, &program, "")? == HONEST_OUTPUT {
        return Ok(());
    }
    Err(io::Error::other(
        "the system killed the program (signal 9), which used little memory, and also a small test \
         program: give this machine more memory, or grade fewer submissions at a time",
    ))
}

/// Runs a program. Returns its standard error or, if that is empty, its standard output.
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
    // Writing fails if the program has already ended. In that case, the program's output says why
    // it ended.
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
