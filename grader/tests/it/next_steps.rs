//! After a success, the report says what to do next, and links to the built handout.

use std::fs;
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
fn a_complete_task_leads_to_the_chapter_of_the_next() {
    let graded = with_solved(&["camera.rs"]).grade();
    assert_eq!(
        next(&graded),
        ["next    Task 2: triangles, handout/src/triangle.md"]
    );
    // In lecture order, whichever task is complete.
    let graded = with_solved(&["camera.rs", "sphere.rs"]).grade();
    assert_eq!(
        next(&graded),
        ["next    Task 2: triangles, handout/src/triangle.md"]
    );
    let files = ["camera.rs", "triangle.rs", "sphere.rs", "bbox.rs"];
    let graded = with_solved(&files).grade();
    let line = "next    Task 3: building a BVH, handout/src/building.md";
    assert_eq!(next(&graded), [line]);
    assert_eq!(next(&Submission::starter("new").grade()), [""; 0]);
}

#[test]
fn the_last_task_leads_to_a_picture_and_a_challenge() {
    let graded = Submission::reference("full").grade();
    let lines = [
        "next    `cargo render cornell-box` draws with your code",
        "handout/src/traversal.md, \"A challenge\"",
    ];
    assert_eq!(next(&graded), lines);
}

#[test]
fn one_complete_task_leads_to_the_others() {
    let submission = with_solved(&["camera.rs"]);
    let graded = submission.grade_with(&["--task", "camera"]);
    assert_eq!(
        next(&graded),
        ["next    `cargo grade` shows what the other tasks need"]
    );
    assert_eq!(next(&submission.grade_with(&["--task", "bbox"])), [""; 0]);
}

#[test]
fn there_is_no_advice_for_staff_or_a_platform() {
    let submission = Submission::reference("full");
    let exam = submission.path().join("exam.json");
    fs::write(&exam, RAYS.practice_exam).unwrap();
    let exam = exam.to_string_lossy().into_owned();
    for arguments in [["--exam", &exam], ["--format", "text"]] {
        assert_eq!(next(&submission.grade_with(&arguments)), [""; 0]);
    }
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
    let line = [
        &grader_path(),
        out.to_str().unwrap(),
        submission.path().to_str().unwrap(),
    ]
    .map(|word| format!("'{word}'"));
    let line = format!("{} --out {} {}", line[0], line[1], line[2]);
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

#[cfg(target_os = "linux")]
fn grader_path() -> String {
    env!("CARGO_BIN_EXE_grader").to_owned()
}
