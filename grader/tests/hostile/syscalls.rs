//! What the compiler refuses is no wall: calls to the system, made by a program with `unsafe` code
//! in the place of a submission.

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
    cpu: Duration::from_secs(10),
    file: 0,
};
const WALL_LIMIT: Duration = Duration::from_secs(60);
/// Its last line.
const END_LINE: &str = "end";

/// The calls that are not refused at this level. Not to be asked at `none`: there they leave
/// something behind.
pub fn allowed_calls(level: Isolation) -> Vec<String> {
    if !cfg!(target_arch = "x86_64") {
        eprintln!("SKIPPED: the numbers of system calls are known for x86_64 only");
        return Vec::new();
    }
    let folder = TempDir::new().expect("a folder");
    let program = build_scanner(folder.path());
    let launcher = PathBuf::from(env!("CARGO_BIN_EXE_grader"));
    let sandbox = Sandbox::at(level).with_launcher(launcher);
    let started = sandbox.start(
        Command::new(&program),
        folder.path(),
        Profile::Probe,
        LIMITS,
    );
    let mut process = started.expect("it starts");
    let stdout = process.child.stdout.take().expect("it is piped");
    let said = Capture::start(stdout, 1 << 16);
    let deadline = Instant::now() + WALL_LIMIT;
    while process.exit_reason().is_none() && Instant::now() < deadline {
        thread::sleep(Duration::from_millis(5));
    }
    process.kill();
    said.wait_for_end(Duration::from_secs(1));

    let said = said.head();
    let open = said
        .lines()
        .filter(|line| *line != END_LINE)
        .map(str::to_owned);
    match said.ends_with("end\n") {
        true => open.collect(),
        false => vec![format!("did not come to its end: {said:?}")],
    }
}

/// Linked as a submission is that is to be confined.
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
