//! Tests of `--watch` with an output that is not a terminal.

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, ChildStdout, Command, Stdio};

use crate::harness::{Submission, assert_fails, grader};

/// A grader process that waits for changes. The process is killed when this is dropped.
pub struct WatchProcess {
    child: Child,
    lines: BufReader<ChildStdout>,
}

impl WatchProcess {
    pub fn start(submission: &Submission) -> Self {
        Self::start_with(submission, |command| command)
    }

    fn start_with(submission: &Submission, add: impl Fn(&mut Command) -> &mut Command) -> Self {
        let mut command = submission.command();
        command.arg("--watch").stdout(Stdio::piped());
        let mut child = add(&mut command).spawn().unwrap();
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

#[test]
fn grades_every_save_and_updates_the_score_file() {
    let submission = Submission::not_compiling();
    let sphere = submission.path().join("sphere.rs");
    let right = fs::read_to_string(Submission::reference("right").path().join("sphere.rs"));
    let score = || {
        let text = fs::read(submission.out().join("score.json")).unwrap();
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

/// Runs on Linux only, where the program that opens a page is found by its name.
#[cfg(target_os = "linux")]
#[test]
fn opens_the_page_once_and_from_then_on_the_page_reloads_itself() {
    use std::os::unix::fs::PermissionsExt;

    let submission = Submission::starter("alice");
    let programs = submission.path().join("programs");
    let opened = submission.path().join("opened.txt");
    let script = format!("#!/bin/sh\necho \"$1\" >> '{}'\n", opened.display());
    fs::create_dir(&programs).unwrap();
    fs::write(programs.join("xdg-open"), script).unwrap();
    fs::set_permissions(programs.join("xdg-open"), fs::Permissions::from_mode(0o755)).unwrap();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders = [programs].into_iter().chain(std::env::split_paths(&path));
    let path = std::env::join_paths(folders).unwrap();

    let mut watching = WatchProcess::start_with(&submission, |command| {
        command.arg("--open").env("DISPLAY", ":99");
        command.env("PATH", &path)
    });
    watching.report();
    // Twice, so that a page that is opened after every grading has been opened when we look.
    for comment in ["// one save", "// another save"] {
        let sphere = submission.path().join("sphere.rs");
        let code = fs::read_to_string(&sphere).unwrap();
        fs::write(&sphere, format!("{code}{comment}\n")).unwrap();
        watching.report();
    }
    let page = submission.out().join("report.html");
    let opened = fs::read_to_string(opened).unwrap();
    assert_eq!(opened, format!("{}\n", page.display()));
    let page = fs::read_to_string(page).unwrap();
    assert!(page.contains("<body data-reload>"));
}

#[test]
fn fails_at_once_without_a_submission() {
    let output = grader().args(["--watch", "nowhere"]).output().unwrap();
    assert_fails(&output, 2, "nowhere: name the folder");
}
