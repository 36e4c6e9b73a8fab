//! After a success, the report says what to do next, and links to the built handout.

use std::fs;
#[cfg(target_os = "linux")]
use std::path::Path;
#[cfg(target_os = "linux")]
use std::process::Command;

use grader::handed_out::RAYS;

#[cfg(target_os = "linux")]
use crate::harness::linked_workspace;
use crate::harness::{GradeRun, Submission, workspace};

/// The starter with these files of the reference.
fn with_solved(files: &[&str]) -> Submission {
    let submission = Submission::starter("evening");
    files.iter().fold(submission, |submission, file| {
        let text = fs::read(workspace().join("reference/src").join(file)).unwrap();
        submission.with(file, text)
    })
}

/// Returns the lines of the report's advice.
fn next(graded: &GradeRun) -> Vec<String> {
    let report = graded.report();
    let lines = report
        .lines()
        .skip_while(|line| !line.starts_with("  next "));
    let lines = lines.take_while(|line| !line.is_empty());
    lines.map(|line| line.trim().to_owned()).collect()
}

#[test]
fn a_complete_task_leads_to_the_next_in_lecture_order() {
    let triangles = "next    Task 2: triangles, handout/src/triangle.md";
    let building = "next    Task 3: building a BVH, handout/src/building.md";
    let four = ["camera.rs", "triangle.rs", "sphere.rs", "bbox.rs"];
    for (files, line) in [
        (&four[..1], triangles),
        (&["camera.rs", "sphere.rs"], triangles),
        (&four, building),
    ] {
        assert_eq!(next(&with_solved(files).grade()), [line]);
    }
    assert_eq!(next(&Submission::starter("new").grade()), [""; 0]);
}

#[test]
fn the_last_task_leads_to_a_picture_and_a_challenge_but_not_for_staff_or_a_platform() {
    let submission = Submission::reference("full");
    let lines = [
        "next    `cargo render cornell-box` draws with your code",
        "handout/src/traversal.md, \"A challenge\"",
    ];
    assert_eq!(next(&submission.grade()), lines);
    let exam = submission.path().join("exam.json");
    fs::write(&exam, RAYS.practice_exam).unwrap();
    let exam = exam.to_string_lossy().into_owned();
    for arguments in [["--exam", &exam], ["--format", "text"]] {
        assert_eq!(next(&submission.grade_with(&arguments)), [""; 0]);
    }
}

#[test]
fn one_complete_task_leads_to_the_others() {
    let submission = with_solved(&["camera.rs"]);
    let graded = submission.grade_with(&["--task", "camera"]);
    let line = "next    `cargo grade` shows what the other tasks need";
    assert_eq!(next(&graded), [line]);
    assert_eq!(next(&submission.grade_with(&["--task", "bbox"])), [""; 0]);
}

/// Runs the grader in a workspace with a built handout of one page.
#[cfg(target_os = "linux")]
#[test]
fn what_to_read_is_a_link_if_there_is_a_book() {
    let folder = linked_workspace();
    let book = folder.path().join("handout/book");
    fs::create_dir_all(&book).unwrap();
    fs::write(book.join("index.html"), "").unwrap();
    fs::write(book.join("triangle.html"), "").unwrap();
    let url = format!("file://{}/triangle.html", book.display());

    let submission = with_solved(&["camera.rs"]);
    let out = submission.path().join("out");
    let mut grade = Command::new(env!("CARGO_BIN_EXE_grader"));
    grade
        .current_dir(folder.path())
        .arg("--out")
        .args([&out, &submission.path()]);
    let output = grade.env("CLICOLOR_FORCE", "1").output().unwrap();
    assert!(output.status.success(), "{output:?}");
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        text.contains("handout/src/triangle.md") && !text.contains(&url),
        "{text}"
    );

    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains(&format!("<a href=\"{url}")), "{page}");
    assert!(!page.contains("sphere.html"), "the book has no such page");

    // `script` runs a command on a terminal of its own.
    let grader = Path::new(env!("CARGO_BIN_EXE_grader")).display();
    let (out, folder_of_files) = (out.display(), submission.path());
    let line = format!("'{grader}' --out '{out}' '{}'", folder_of_files.display());
    let mut script = Command::new("script");
    script
        .args(["-qec", &line, "/dev/null"])
        .current_dir(folder.path());
    script
        .env("TERM", "xterm-256color")
        .env_remove("NO_COLOR")
        .env_remove("CI");
    let Ok(output) = script.output() else {
        assert!(
            std::env::var_os("CI").is_none(),
            "there is no `script` for a terminal"
        );
        eprintln!("SKIPPED: links on a terminal, because there is no `script`");
        return;
    };
    let text = String::from_utf8(output.stdout).unwrap();
    let start = format!("\x1b]8;;{url}\x1b\\handout/src/triangle.md\x1b]8;;\x1b\\");
    assert!(text.contains(&start), "{text:?}");
}
