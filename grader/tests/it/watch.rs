//! Tests of `--watch` with an output that is not a terminal.

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, ChildStdout, Stdio};

use crate::harness::{Submission, grader};

/// A grader process that waits for changes. The process is killed when this is dropped.
struct WatchProcess {
    child: Child,
    lines: BufReader<ChildStdout>,
}

impl WatchProcess {
    fn start(submission: &Submission) -> Self {
        let mut child = grader()
            .arg("--watch")
            .arg(submission.path())
            .args(["--no-reference", "--out"])
            .arg(submission.path().join("out"))
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let lines = BufReader::new(child.stdout.take().unwrap());
        WatchProcess { child, lines }
    }

    /// Returns the next report, up to the line that says that the grader is waiting.
    fn report(&mut self) -> String {
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

#[test]
fn grades_every_save_and_updates_the_score_file() {
    let submission = Submission::not_compiling();
    let sphere = submission.path().join("sphere.rs");
    let right = fs::read_to_string(Submission::reference("right").path().join("sphere.rs"));
    let score = || {
        let text = fs::read(submission.path().join("out/score.json")).unwrap();
        let score: serde_json::Value = serde_json::from_slice(&text).unwrap();
        (score["points"].as_u64(), score["complete"].as_bool())
    };

    let mut watching = WatchProcess::start(&submission);
    let report = watching.report();
    assert!(report.contains("sphere.rs does not compile"), "{report}");
    let (points, complete) = score();
    assert!(points < Some(100) && complete == Some(true));

    fs::write(&sphere, right.unwrap()).unwrap();
    let report = watching.report();
    assert!(report.contains("100 / 100"), "{report}");
    assert_eq!(score(), (Some(100), Some(true)));

    // The file is missing for a while, as it is when an editor moves the old file away before it
    // writes the new one.
    let aside = submission.path().join("sphere.away");
    fs::rename(&sphere, &aside).unwrap();
    let report = watching.report();
    assert!(report.contains("sphere.rs is missing"), "{report}");
    fs::rename(&aside, &sphere).unwrap();
    assert!(watching.report().contains("100 / 100"));
}

#[test]
fn fails_at_once_without_a_submission() {
    let output = grader().args(["--watch", "nowhere"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
}
