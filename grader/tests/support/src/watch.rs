//! Runs `cargo grade --watch` and reads its reports.

use std::io::{BufRead, BufReader, Read};
use std::process::{Child, ChildStdout, Command, Stdio};

/// A grader that waits for saved files. It is killed when this is dropped.
pub struct WatchProcess {
    child: Child,
    lines: BufReader<ChildStdout>,
}

impl WatchProcess {
    /// Adds `--watch` to a command that grades a submission, and starts the command.
    pub fn start(command: &mut Command) -> Self {
        let mut child = command
            .arg("--watch")
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let lines = BufReader::new(child.stdout.take().unwrap());
        WatchProcess { child, lines }
    }

    /// Returns the next report, up to the line that says that the grader is waiting.
    pub fn report(&mut self) -> String {
        let lines = self.lines.by_ref().lines().map(Result::unwrap);
        let mut report = String::new();
        for line in lines {
            if line.contains("save a file to grade again") {
                return report;
            }
            report += &line;
            report.push('\n');
        }
        panic!("the grader has ended: {report}");
    }
}

impl Drop for WatchProcess {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
