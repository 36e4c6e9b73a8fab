//! Tests of `--watch` when the output isn't a terminal.

use std::fs;

use test_support::WatchProcess;
#[cfg(target_os = "linux")]
use test_support::programs::{path_with, write_program};

use crate::harness::{Submission, assert_fails, grader};

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

    let mut watching = WatchProcess::start(&mut submission.command());
    let report = watching.report();
    assert!(report.contains("sphere.rs does not compile"), "{report}");
    let (points, complete) = score();
    assert!(points < Some(100) && complete == Some(true));

    fs::write(&sphere, right.unwrap()).unwrap();
    let report = watching.report();
    assert!(report.contains("100 / 100"), "{report}");
    assert_eq!(score(), (Some(100), Some(true)));

    // The file is missing for a while, as when an editor moves the old file away before writing the
    // new one.
    let aside = submission.path().join("sphere.away");
    fs::rename(&sphere, &aside).unwrap();
    let report = watching.report();
    assert!(report.contains("sphere.rs is missing"), "{report}");
    fs::rename(&aside, &sphere).unwrap();
    assert!(watching.report().contains("100 / 100"));
}

/// Only runs on Linux, where the program that opens a page is looked up on the PATH by its name.
#[cfg(target_os = "linux")]
#[test]
fn opens_the_page_once_and_from_then_on_the_page_reloads_itself() {
    let submission = Submission::starter("alice");
    let programs = submission.path().join("programs");
    let opened = submission.path().join("opened.txt");
    let script = format!("echo \"$1\" >> '{}'\n", opened.display());
    write_program(&programs.join("xdg-open"), &script);

    let mut command = submission.command();
    command.arg("--open").env("DISPLAY", ":99");
    let mut watching = WatchProcess::start(command.env("PATH", path_with(&programs)));
    watching.report();
    // Save twice. If the page were opened after every grading, it would have been opened again by
    // the time of the check.
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
    assert_fails(&output, 2, "nowhere does not exist: pass the folder");
}
