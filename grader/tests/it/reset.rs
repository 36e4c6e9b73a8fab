//! `cargo grade --reset` resets a task without losing anything a student wrote.

use std::fs;
use std::path::Path;
use std::process::Output;

use clap::CommandFactory;
use grader::cli::Arguments;
use grader::handed_out::RAYS;

use crate::harness::{FULL_POINTS, Submission, assert_fails, grader};

fn reset_at(path: &Path, arguments: &[&str]) -> Output {
    let mut command = grader();
    command.arg(path).arg("--reset");
    command.args(arguments).output().unwrap()
}

fn reset(submission: &Submission, arguments: &[&str]) -> Output {
    reset_at(&submission.path(), arguments)
}

fn assert_refused(output: &Output, why: &str) {
    assert_fails(output, 2, why);
}

fn text(submission: &Submission, file: &str) -> String {
    fs::read_to_string(submission.path().join(file)).unwrap()
}

fn starter(file: &str) -> &'static str {
    RAYS.task_file(file).unwrap().starter
}

/// Returns the reference with a helper that a student has added.
fn solved() -> Submission {
    let helper = "impl Node {\n    fn mine(&self) -> char {\n        '}'\n    }\n}\n\n#[cfg(test)]";
    Submission::reference("solved").with_replaced("bvh.rs", "#[cfg(test)]", helper)
}

#[test]
fn a_task_starts_afresh_and_everything_else_stays() {
    let submission = solved();
    let before = text(&submission, "bvh.rs");
    let output = reset(&submission, &["Traverse"]);
    let message = String::from_utf8(output.stdout.clone()).unwrap();
    assert!(output.status.success(), "{output:?}");
    for part in [
        "Bvh::hit reset to the version that was handed out",
        "bvh.rs.bak-1",
    ] {
        assert!(message.contains(part), "{message}");
    }

    assert_eq!(text(&submission, "bvh.rs.bak-1"), before);
    let after = text(&submission, "bvh.rs");
    for part in ["traces.fold(None, Trace::nearer)", "fn mine(&self)"] {
        assert!(after.contains(part), "{after}");
    }
    let graded = submission.grade();
    let points = graded.points();
    assert_eq!(points["build"], FULL_POINTS["build"]);
    assert!(points["traverse"] < FULL_POINTS["traverse"], "{points:?}");
    // The report mentions the old file in the folder, but the file doesn't affect the grade.
    let report = graded.report();
    let note = "note: bvh.rs.bak-1 differs from bvh.rs and is ignored";
    assert_eq!(report.matches("note:").count(), 1, "{report}");
    assert!(report.contains(note), "{report}");

    // The second copy gets a different name, even if the first copy is now empty.
    fs::write(submission.path().join("bvh.rs.bak-1"), "").unwrap();
    assert!(reset(&submission, &["build,bbox"]).status.success());
    assert_eq!(text(&submission, "bvh.rs.bak-1"), "");
    assert_eq!(text(&submission, "bvh.rs.bak-2"), after);
    assert!(submission.path().join("bbox.rs.bak-1").is_file());
}

#[test]
fn the_name_of_a_file_means_the_whole_file() {
    for name in ["bvh", "BVH.rs"] {
        let submission = solved();
        let before = text(&submission, "bvh.rs");
        assert!(reset(&submission, &[name]).status.success());
        assert_eq!(text(&submission, "bvh.rs"), starter("bvh.rs"));
        assert_eq!(text(&submission, "bvh.rs.bak-1"), before);
    }
    let submission = solved().without("sphere.rs");
    assert!(reset(&submission, &["sphere.rs"]).status.success());
    assert_eq!(text(&submission, "sphere.rs"), starter("sphere.rs"));
    assert!(!submission.path().join("sphere.rs.bak-1").exists());
}

#[test]
fn a_task_as_handed_out_is_left_alone() {
    let submission = Submission::starter("fresh");
    let output = reset(&submission, &["sphere"]);
    let message = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{output:?}");
    assert!(message.contains("nothing to reset"), "{message}");
    assert!(!submission.path().join("sphere.rs.bak-1").exists());
}

#[test]
fn a_method_that_is_not_found_is_left_alone_and_the_remedy_is_named() {
    let cases = [
        ("pub fn hit(", "pub fn hit_it(", "it was renamed or removed"),
        (
            "impl Sphere {",
            "impl Sphere {{",
            "the file's braces do not match",
        ),
        (
            "#[cfg(test)]",
            "impl Sphere { fn hit() {} }\n#[cfg(test)]",
            "several methods",
        ),
    ];
    for (from, to, reason) in cases {
        let submission = Submission::reference("lost").with_replaced("sphere.rs", from, to);
        let files = || fs::read_dir(submission.path()).unwrap().count();
        let (before, count) = (text(&submission, "sphere.rs"), files());
        // The other task could be reset, but nothing changes if there is an error.
        let output = reset(&submission, &["bbox,sphere"]);
        let why = format!("cannot find Sphere::hit in sphere.rs: {reason}");
        let remedy = "`cargo grade --reset sphere.rs` replaces the whole";
        for text in [&why, remedy] {
            assert_refused(&output, text);
        }
        assert_eq!((text(&submission, "sphere.rs"), files()), (before, count));

        assert!(reset(&submission, &["sphere.rs"]).status.success());
        assert_eq!(text(&submission, "sphere.rs"), starter("sphere.rs"));
    }
}

#[test]
fn archives_unknown_tasks_and_folders_without_tasks_are_refused() {
    let submission = Submission::reference("alice").with("alice.zip", "PK");
    let archive = submission.path().join("alice.zip");
    assert_refused(
        &reset_at(&archive, &["bbox"]),
        "if this is an archive, unpack it first",
    );
    assert_refused(&reset(&submission, &["sphre"]), "did you mean sphere?");
    let unknown = reset(&submission, &["wrld"]);
    for text in ["did you mean world?", "world.rs, main.rs"] {
        assert_refused(&unknown, text);
    }
    let empty = tempfile::tempdir().unwrap();
    assert_refused(
        &reset_at(empty.path(), &["bvh"]),
        "contains none of camera.rs",
    );
}

#[test]
fn with_copies_in_several_folders_the_folder_with_the_most_files_is_reset() {
    let submission = Submission::reference("twice").with("src/bvh.rs", "// old");
    let output = reset(&submission, &["bvh.rs"]);
    assert!(output.status.success(), "{output:?}");
    assert_eq!(text(&submission, "bvh.rs"), starter("bvh.rs"));
    assert_eq!(text(&submission, "src/bvh.rs"), "// old");
    let message = String::from_utf8_lossy(&output.stdout);
    let other = "src/bvh.rs is another copy of this file and wasn't changed";
    assert!(message.contains(other), "{message}");
}

#[cfg(unix)]
#[test]
fn links_are_not_followed() {
    use std::os::unix::fs::symlink;

    let other = solved();
    let before = text(&other, "bvh.rs");
    let linked = Submission::reference("linked").without("bvh.rs");
    symlink(other.path().join("bvh.rs"), linked.path().join("bvh.rs")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    symlink(other.path(), folder.path().join("src")).unwrap();
    for path in [
        linked.path(),
        folder.path().to_owned(),
        folder.path().join("src"),
    ] {
        assert_refused(&reset_at(&path, &["bvh"]), "is a link");
    }
    assert_eq!(text(&other, "bvh.rs"), before);
    // A link with a copy's name isn't followed either.
    symlink(linked.path().join("new"), other.path().join("bvh.rs.bak-1")).unwrap();
    assert!(reset(&other, &["bvh"]).status.success());
    assert_eq!(text(&other, "bvh.rs.bak-2"), before);
    assert!(!linked.path().join("new").exists());
}

#[test]
fn no_option_for_grading_goes_with_it() {
    let submission = Submission::reference("kept");
    let before = text(&submission, "sphere.rs");
    let command = Arguments::command();
    let options = command.get_arguments().filter(|arg| !arg.is_positional());
    let mut count = 0;
    for option in options {
        let long = option.get_long().unwrap();
        let value = match long {
            "reset" | "assignment" | "help-staff" => continue,
            "task" => "sphere",
            "replay" => "sphere.uv",
            "isolation" => "none",
            "cpu-limit" | "require" => "5",
            "format" => "html",
            _ => "x",
        };
        let with_value = [&format!("--{long}"), value];
        let words = 1 + usize::from(option.get_action().takes_values());
        let arguments = [&["sphere"], &with_value[..words]].concat();
        let output = reset(&submission, &arguments);
        assert_refused(&output, "cannot be used with");
        count += 1;
    }
    assert!(count > 15, "{count}");
    assert_eq!(text(&submission, "sphere.rs"), before);
}
