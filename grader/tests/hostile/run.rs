//! One run of the real binary, watched from outside.

use std::fs;
use std::io::Read;
use std::os::unix::process::CommandExt;
use std::process::{Child, Command, Stdio};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use grader::sandbox::Isolation;
use serde_json::Value;

use crate::canary::Canaries;
use crate::entry::Entry;

/// What became of one run.
pub struct GraderRun {
    /// Not there if it had to be ended.
    pub exit_code: Option<i32>,
    pub elapsed: Duration,
    /// The most memory that the grader itself has used, in bytes.
    pub memory: u64,
    /// The most files that it has had open at once.
    pub open_files: usize,
    /// Both streams.
    pub printed: String,
    pub score: Option<String>,
    pub page: Option<String>,
}

impl GraderRun {
    /// The score file without what may differ from run to run.
    pub fn reproducible_score(&self) -> Option<Value> {
        let mut score: Value = serde_json::from_str(self.score.as_ref()?).ok()?;
        let fields = score.as_object_mut()?;
        fields.remove("timings");
        Some(score)
    }
}

/// Whatever outlives its parent becomes ours, and is found.
pub fn become_subreaper() {
    let own = rustix::process::getpid();
    rustix::process::set_child_subreaper(Some(own)).expect("Linux can do this");
}

/// Grades one submission. Never waits for longer than it may take.
pub fn grade(entry: &Entry, canaries: &Canaries, level: Isolation) -> GraderRun {
    let folder = tempfile::TempDir::new().expect("a folder");
    let submission = folder.path().join("submission");
    let submission = entry.write(&submission, canaries);
    let out = canaries.out();

    let began = Instant::now();
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
        read(child.stdout.take().expect("it is piped")),
        read(child.stderr.take().expect("it is piped")),
    ];
    let mut most = PeakUsage::default();
    let exit_code = wait_for_exit(&mut child, began + entry.wall(), &mut most);
    let took = began.elapsed();
    let text = |name| fs::read_to_string(out.join(name)).ok();
    GraderRun {
        exit_code,
        elapsed: took,
        memory: most.memory,
        open_files: most.files,
        printed: printed
            .map(|thread| thread.join().expect("it reads"))
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

/// What the grader itself has held at once.
#[derive(Default)]
struct PeakUsage {
    memory: u64,
    files: usize,
}

impl PeakUsage {
    fn sample(&mut self, child: &Child) {
        let process = format!("/proc/{}", child.id());
        let files = fs::read_dir(format!("{process}/fd")).map_or(0, Iterator::count);
        self.files = self.files.max(files);
        self.memory = self.memory.max(peak_memory(&process).unwrap_or(0));
    }
}

fn wait_for_exit(child: &mut Child, deadline: Instant, most: &mut PeakUsage) -> Option<i32> {
    loop {
        if let Some(status) = child.try_wait().expect("it is ours") {
            return status.code();
        }
        most.sample(child);
        if Instant::now() >= deadline {
            child.kill().ok();
            child.wait().ok();
            return None;
        }
        thread::sleep(Duration::from_millis(5));
    }
}

fn peak_memory(process: &str) -> Option<u64> {
    let status = fs::read_to_string(format!("{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes << 10)
}
