//! `cargo handin` makes an archive that the grader can read and describes its contents.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use grader::handed_out::RAYS;
use insta::assert_snapshot;

use crate::harness::{Submission, assert_fails, grade_into, workspace};

fn hand_in(folder: &Path, out: &Path) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_handin"));
    command.current_dir(workspace());
    command.arg(folder).arg("--out").arg(out).output().unwrap()
}

/// Makes an archive next to the submission. Returns the exit code and the output.
fn hand_in_beside(submission: &Submission) -> (Option<i32>, String) {
    let out = submission.path().with_extension("zip");
    let output = hand_in(&submission.path(), &out);
    let text = String::from_utf8(output.stdout).unwrap() + &String::from_utf8_lossy(&output.stderr);
    let folder = out.parent().unwrap().to_string_lossy().into_owned();
    (output.status.code(), text.replace(&folder, "FOLDER"))
}

#[test]
fn the_archive_is_graded_like_the_folder_and_has_the_same_bytes_each_time() {
    let submission = Submission::reference("alice")
        .with("notes.rs", "// Mine.\n")
        .with("bvh.rs.bak-1", "old");
    let (code, text) = hand_in_beside(&submission);
    assert_eq!(code, Some(0), "{text}");
    assert_snapshot!(text);
    let archive = submission.path().with_extension("zip");
    let first = fs::read(&archive).unwrap();

    let mut zip = zip::ZipArchive::new(fs::File::open(&archive).unwrap()).unwrap();
    let mut names: Vec<String> = Vec::new();
    for index in 0..zip.len() {
        let file = zip.by_index(index).unwrap();
        assert_eq!(file.last_modified().unwrap().year(), 2000);
        names.push(file.name().unwrap().into_owned());
    }
    let mut expected: Vec<&str> = RAYS.file_names().collect();
    expected.sort_unstable();
    assert_eq!(names, expected);

    let mut command = grade_into(&archive, &submission.out());
    let graded = submission.run(command.args(["--no-reference", "--require", "100"]));
    assert_eq!(graded.exit_code(), 0, "{}", graded.error());
    assert_eq!(hand_in_beside(&submission).0, Some(0));
    assert!(fs::read(&archive).unwrap() == first);
}

#[test]
fn what_does_not_compile_or_is_missing_is_named_and_the_archive_is_made() {
    let submission = Submission::starter("bob")
        .with_replaced("bbox.rs", "impl BBox {", "impl BBox {\n    fn mine() {}\n")
        .with_replaced("sphere.rs", "todo!(", "let mine = ray.direction; todo!(")
        .with("camera.rs", [0xff, 0xfe])
        .without("triangle.rs");
    let (code, text) = hand_in_beside(&submission);
    assert_eq!(code, Some(1), "{text}");
    assert_snapshot!(text);
    assert!(submission.path().with_extension("zip").is_file());
}

#[test]
fn without_a_line_of_ones_own_the_exit_code_is_1() {
    let submission = Submission::starter("carol");
    let (code, text) = hand_in_beside(&submission);
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains("bvh.rs          unmodified"), "{text}");
    assert!(text.contains("You haven't written anything yet"), "{text}");
    assert!(submission.path().with_extension("zip").is_file());
}

#[test]
fn an_archive_with_work_that_is_gone_is_kept() {
    let submission = Submission::reference("erin");
    assert_eq!(hand_in_beside(&submission).0, Some(0));
    let archive = submission.path().with_extension("zip");
    let good = fs::read(&archive).unwrap();

    // The assignment was unpacked again over the student's own work.
    let starter = Submission::starter("fresh");
    let text = |file: &str| fs::read(starter.path().join(file)).unwrap();
    let lost = submission
        .with("bvh.rs", text("bvh.rs"))
        .with("camera.rs", text("camera.rs"));
    let (code, text) = hand_in_beside(&lost);
    assert_eq!(code, Some(0), "{text}");
    let note = "note: the previous archive contained your work in camera.rs, bvh.rs. A copy of that \
                archive is kept as FOLDER/erin.zip.bak-1.";
    assert!(text.contains(note), "{text}");
    let kept = archive.with_extension("zip.bak-1");
    assert!(fs::read(&kept).unwrap() == good);

    // The new archive contains everything, so the old one is replaced.
    let (_, text) = hand_in_beside(&lost);
    assert!(!text.contains("is kept"), "{text}");
    assert!(!archive.with_extension("zip.bak-2").exists());
}

#[test]
fn a_todo_that_is_left_is_named() {
    let (root, stub) = (
        "let root = discriminant.sqrt();",
        "let root: f32 = todo!(\"the root\");",
    );
    let submission = Submission::reference("fay").with_replaced("sphere.rs", root, stub);
    let (code, text) = hand_in_beside(&submission);
    assert_eq!(code, Some(0), "{text}");
    let note = "lines of your own; still contains `todo!` (line ";
    assert!(text.contains(note), "{text}");
    assert_eq!(text.matches("todo!").count(), 1, "{text}");
}

#[cfg(unix)]
#[test]
fn without_arguments_packs_ones_own_work_into_the_assignments_folder() {
    let folder = crate::harness::linked_workspace();
    let below = folder.path().join("handout");
    fs::create_dir(&below).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_handin"));
    let output = command.current_dir(&below).output().unwrap();
    // The workspace contains the starter, unless its owner has solved a task.
    assert!(matches!(output.status.code(), Some(0 | 1)), "{output:?}");
    let text = String::from_utf8(output.stdout).unwrap();
    let count = RAYS.files.len();
    assert!(
        text.contains(&format!("handin.zip: {count} files")),
        "{text}"
    );
    assert!(folder.path().join("handin.zip").is_file());
}

#[test]
fn wrong_use_exits_with_2_and_a_folder_that_cannot_be_written_with_3() {
    let submission = Submission::reference("dan");
    let out = submission.path().join("out.zip");
    let file = submission.path().join("bvh.rs");
    let empty = tempfile::tempdir().unwrap();
    for (folder, why) in [
        (file.as_path(), "is a file: pass the folder"),
        (empty.path(), "contains none of camera.rs"),
        (Path::new("nowhere"), "nowhere does not exist"),
    ] {
        assert_fails(&hand_in(folder, &out), 2, why);
        assert!(!out.exists());
    }
    let output = hand_in(&submission.path(), &file.join("out.zip"));
    assert_fails(&output, 3, "cannot write");
}
