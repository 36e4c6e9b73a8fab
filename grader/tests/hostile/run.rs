//! Runs the real program and measures its resource usage from outside.

use std::fs;
use std::io::Read;
use std::os::unix::process::CommandExt;
use std::process::{Child, Command, Stdio};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use grader::sandbox::Isolation;
use serde_json::Value;
use test_support::processes::peak_memory;

use crate::canary::Canaries;
use crate::entry::Entry;

/// The result of one run of the grader.
pub struct GraderRun {
    /// The exit code. `None` if the grader took too long and was killed.
    pub exit_code: Option<i32>,
    pub elapsed: Duration,
    /// The peak memory of the grader itself, in bytes.
    pub memory: u64,
    /// The highest number of files that the grader had open at once.
    pub open_files: usize,
    /// The standard output and standard error.
    pub printed: String,
    pub score: Option<String>,
    pub page: Option<String>,
}

impl GraderRun {
    /// Returns the score file without the timings, which differ from run to run.
    pub fn reproducible_score(&self) -> Option<Value> {
        let mut score: Value = serde_json::from_str(self.score.as_ref()?).ok()?;
        let fields = score.as_object_mut()?;
        fields.remove("timings");
        Some(score)
    }
}

/// Makes this process the parent of all descendants that outlive their own parent, so that it can
/// find them.
pub fn become_subreaper() {
    let own = rustix::process::getpid();
    rustix::process::set_child_subreaper(Some(own)).expect("Linux can do this");
}

/// Grades one submission. Kills the grader if it takes longer than the entry allows.
pub fn grade(entry: &Entry, canaries: &Canaries, level: Isolation) -> GraderRun {
    let folder = tempfile::TempDir::new().expect("temporary folder");
    let submission = folder.path().join("submission");
    let submission = entry.write(&submission, canaries);
    let out = canaries.out();

    let started = Instant::now();
    let mut child = Command::new(env!("CARGO_BIN_EXE_grader"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .arg(&submission)
        .arg("--out")
        .arg(&out)
        .args(["--isolation", level.name()])
        .args(&entry.expect.arguments)
        .env(Canaries::VARIABLE, canaries.secret())
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .process_group(0)
        .spawn()
        .expect("the grader starts");
    let printed = [
        read(child.stdout.take().expect("standard output is piped")),
        read(child.stderr.take().expect("standard error is piped")),
    ];
    let mut peak = PeakUsage::default();
    let exit_code = wait_for_exit(&mut child, started + entry.wall(), &mut peak);
    let elapsed = started.elapsed();
    let text = |name| fs::read_to_string(out.join(name)).ok();
    GraderRun {
        exit_code,
        elapsed,
        memory: peak.memory,
        open_files: peak.files,
        printed: printed
            .map(|thread| thread.join().expect("the reader thread does not panic"))
            .concat(),
        score: text("score.json"),
        page: text("report.html"),
    }
}

fn read(mut pipe: impl Read + Send + 'static) -> JoinHandle<String> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        pipe.read_to_end(&mut bytes).ok();
        String::from_utf8_lossy(&bytes).into_owned()
    })
}

/// The peak resource usage of the grader itself.
#[derive(Default)]
struct PeakUsage {
    memory: u64,
    files: usize,
}

impl PeakUsage {
    fn sample(&mut self, child: &Child) {
        let files = fs::read_dir(format!("/proc/{}/fd", child.id())).map_or(0, Iterator::count);
        self.files = self.files.max(files);
        self.memory = self.memory.max(peak_memory(child.id()).unwrap_or(0));
    }
}

fn wait_for_exit(child: &mut Child, deadline: Instant, peak: &mut PeakUsage) -> Option<i32> {
    loop {
        if let Some(status) = child.try_wait().expect("it is our child") {
            return status.code();
        }
        peak.sample(child);
        if Instant::now() >= deadline {
            child.kill().ok();
            child.wait().ok();
            return None;
        }
        thread::sleep(Duration::from_millis(5));
    }
}
