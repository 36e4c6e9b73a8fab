//! `cargo grade --watch`, and how long its reports are in coming.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};

/// A grader that waits for saves; ended when dropped.
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
        let mut child = child.expect("it can be started");
        let lines = BufReader::new(child.stdout.take().expect("it is a pipe"));
        let mut watching = WatchProcess { child, lines };
        watching.report();
        watching
    }

    /// Waits for the next report.
    pub fn report(&mut self) {
        let mut line = String::new();
        while !line.contains("save a file to grade again") {
            line.clear();
            let read = self.lines.read_line(&mut line).expect("it writes text");
            assert!(read > 0, "it has ended");
        }
    }
}

impl Drop for WatchProcess {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
