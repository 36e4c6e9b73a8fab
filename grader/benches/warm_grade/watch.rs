//! Runs `cargo grade --watch` and waits for its reports.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};

/// A running grader that waits for saved files. It is killed when this value is dropped.
pub struct WatchProcess {
    child: Child,
    lines: BufReader<ChildStdout>,
}

impl WatchProcess {
    pub fn start(folder: &Path) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
        command.arg("--watch").arg(folder);
        command.arg("--out").arg(folder.join("out"));
        let child = command.stdout(Stdio::piped()).spawn();
        let mut child = child.expect("the grader can be started");
        let lines = BufReader::new(child.stdout.take().expect("the stream is piped"));
        let mut watcher = WatchProcess { child, lines };
        watcher.report();
        watcher
    }

    /// Waits for the next report.
    pub fn report(&mut self) {
        let mut line = String::new();
        while !line.contains("save a file to grade again") {
            line.clear();
            let read = self
                .lines
                .read_line(&mut line)
                .expect("the grader writes text");
            assert!(read > 0, "the grader has ended");
        }
    }
}

impl Drop for WatchProcess {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
