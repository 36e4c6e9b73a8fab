//! Makes system calls from a program that runs in place of a submission. The program contains
//! `unsafe` code, because the sandbox must be safe even if a submission gets around the compiler's
//! ban on `unsafe`.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use grader::capture::Capture;
use grader::sandbox::{Isolation, Profile, Sandbox};
use grader::system::Limits;
use tempfile::TempDir;

const LIMITS: Limits = Limits {
    memory: 1 << 30,
    data: None,
    cpu: Duration::from_secs(10),
    file: 0,
};
const WALL_LIMIT: Duration = Duration::from_secs(60);
/// The last line that the program prints.
const END_LINE: &str = "end";

/// Returns the system calls that aren't refused at this level. Don't call this at level `none`,
/// where the system calls succeed and leave something behind.
pub fn allowed_calls(level: Isolation) -> Vec<String> {
    if !cfg!(target_arch = "x86_64") {
        eprintln!("SKIPPED: system call numbers are known for x86_64 only");
        return Vec::new();
    }
    let folder = TempDir::new().expect("temporary folder");
    let program = build_scanner(folder.path());
    let launcher = PathBuf::from(env!("CARGO_BIN_EXE_grader"));
    let sandbox = Sandbox::at(level).with_launcher(launcher);
    let started = sandbox.start(
        Command::new(&program),
        folder.path(),
        Profile::Probe,
        LIMITS,
    );
    let mut process = started.expect("the sandbox starts the program");
    let stdout = process
        .child
        .stdout
        .take()
        .expect("standard output is piped");
    let output = Capture::start(stdout, 1 << 16);
    let deadline = Instant::now() + WALL_LIMIT;
    while process.exit_reason().is_none() && Instant::now() < deadline {
        thread::sleep(Duration::from_millis(5));
    }
    process.kill();
    output.wait_for_end(Duration::from_secs(1));

    let output = output.head();
    let allowed = output
        .lines()
        .filter(|line| *line != END_LINE)
        .map(str::to_owned);
    if output.ends_with("end\n") {
        allowed.collect()
    } else {
        vec![format!("did not run to its end: {output:?}")]
    }
}

/// Compiles the program and links it statically, like a confined submission.
fn build_scanner(folder: &Path) -> PathBuf {
    let program = folder.join("scan");
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let status = Command::new(rustc)
        .args([
            "--edition=2024",
            "-Copt-level=1",
            "-Ctarget-feature=+crt-static",
        ])
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/hostile/scan.rs"))
        .arg("-o")
        .arg(&program)
        .status();
    assert!(status.expect("there is a compiler").success());
    program
}
