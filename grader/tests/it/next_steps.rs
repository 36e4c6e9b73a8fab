//! After a success, the report says what to do next and links to the built handout.

use std::fs;
use std::process::Command;

use grader::handed_out::RAYS;

use crate::cases::REFERENCE;
use crate::harness::{GradeRun, Submission, grade_into, linked_workspace, shell_line, workspace};

/// Returns the starter with these files replaced by the reference's.
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
    let tasks = RAYS.assignment.tasks.iter();
    let before_building = tasks.take_while(|task| task.id != "build");
    let before_building: Vec<&str> = before_building.map(|task| task.file).collect();
    for (files, line) in [
        (
            &[][..],
            "next    Task 1: camera rays, handout/src/camera.md",
        ),
        (&["camera.rs"], triangles),
        (&["camera.rs", "sphere.rs"], triangles),
        (&before_building, building),
    ] {
        assert_eq!(next(&with_solved(files).grade()), [line]);
    }
}

#[test]
fn the_last_task_leads_to_a_picture_and_a_challenge_but_not_for_staff_or_a_platform() {
    let lines = [
        "next    `cargo render cornell-box` draws with your code",
        "handout/src/traversal.md, \"A challenge\"",
        "the next assignment, \"Path tracing: materials, lights and paths\",",
        "begins in handout/src/light/materials.md",
    ];
    assert_eq!(next(&REFERENCE), lines);
    let submission = Submission::reference("full");
    let exam = submission.file_option("--exam", "exam.json", RAYS.practice_exam);
    for arguments in [exam, ["--format", "text"].map(str::to_owned)] {
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
#[test]
fn what_to_read_is_a_link_if_there_is_a_book() {
    let folder = linked_workspace();
    let book = folder.path().join("handout/book");
    fs::create_dir_all(&book).unwrap();
    fs::write(book.join("index.html"), "").unwrap();
    fs::write(book.join("triangle.html"), "").unwrap();
    let url = format!("file://{}/triangle.html", book.display());

    let submission = with_solved(&["camera.rs"]);
    let mut grade = grade_into(&submission.path(), &submission.out());
    grade.current_dir(folder.path());
    let graded = submission.run(grade.env("CLICOLOR_FORCE", "1"));
    assert_eq!(graded.exit_code(), 0, "{}", graded.error());
    let text = graded.report();
    assert!(text.contains("handout/src/triangle.md"), "{text}");
    assert!(!text.contains(&url), "{text}");

    let page = graded.page();
    assert!(page.contains(&format!("<a href=\"{url}")), "{page}");
    assert!(!page.contains("sphere.html"), "the book has no such page");

    // `script` runs a command in its own terminal.
    let mut script = Command::new("script");
    script.args(["-qec", &shell_line(&grade), "/dev/null"]);
    script.current_dir(folder.path());
    script.env("TERM", "xterm-256color");
    script.env_remove("NO_COLOR").env_remove("CI");
    let Ok(output) = script.output() else {
        let in_ci = std::env::var_os("CI").is_some();
        assert!(!in_ci, "there is no `script` for a terminal");
        eprintln!("SKIPPED: links on a terminal, because there is no `script`");
        return;
    };
    let text = String::from_utf8(output.stdout).unwrap();
    let start = format!("\x1b]8;;{url}\x1b\\handout/src/triangle.md\x1b]8;;\x1b\\");
    assert!(text.contains(&start), "{text:?}");
}
