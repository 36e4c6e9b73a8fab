//! `cargo grade --reset` starts a task afresh, and loses nothing that a student wrote.

use std::fs;
use std::process::Output;

use clap::CommandFactory;
use grader::cli::Arguments;
use grader::handed_out::RAYS;

use crate::harness::{Submission, grader};

fn reset(submission: &Submission, arguments: &[&str]) -> Output {
    let mut command = grader();
    command.arg(submission.path()).arg("--reset");
    command.args(arguments).output().unwrap()
}

/// Returns the exit code and the error.
fn refusal(output: &Output) -> (Option<i32>, String) {
    let error = String::from_utf8(output.stderr.clone()).unwrap();
    (output.status.code(), error)
}

fn text(submission: &Submission, file: &str) -> String {
    fs::read_to_string(submission.path().join(file)).unwrap()
}

fn starter(file: &str) -> &'static str {
    RAYS.task_file(file).unwrap().starter
}

/// The reference with a helper of a student's own.
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
    assert!(
        message.contains("Bvh::hit is as handed out again"),
        "{message}"
    );
    assert!(message.contains("bvh.rs.bak-1"), "{message}");

    assert_eq!(text(&submission, "bvh.rs.bak-1"), before);
    let after = text(&submission, "bvh.rs");
    assert!(
        after.contains("traces.fold(None, Trace::nearer)"),
        "{after}"
    );
    assert!(after.contains("fn mine(&self)"), "{after}");
    let graded = submission.grade();
    let points = graded.points();
    let full = |task: usize| u64::from(RAYS.assignment.tasks[task].points);
    assert!(points[4] == full(4) && points[5] < full(5), "{points:?}");
    // The old file is in the folder, and is named, but does not matter.
    let report = graded.report();
    let note = "note: bvh.rs.bak-1 differs from bvh.rs, and is ignored";
    assert_eq!(report.matches("note:").count(), 1, "{report}");
    assert!(report.contains(note), "{report}");

    // The second copy has another name, also if nothing but the name is left of the first.
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
    let message = String::from_utf8(output.stdout.clone()).unwrap();
    assert!(
        output.status.success() && message.contains("nothing has changed"),
        "{message}"
    );
    assert!(!submission.path().join("sphere.rs.bak-1").exists());
}

#[test]
fn a_method_that_is_not_found_is_left_alone_and_the_remedy_is_named() {
    let cases = [
        ("pub fn hit(", "pub fn hit_it(", "it was renamed or removed"),
        ("impl Sphere {", "impl Sphere {{", "its braces do not match"),
        (
            "#[cfg(test)]",
            "impl Sphere { fn hit() {} }\n#[cfg(test)]",
            "there are several",
        ),
    ];
    for (from, to, reason) in cases {
        let submission = Submission::reference("lost").with_replaced("sphere.rs", from, to);
        let files = || fs::read_dir(submission.path()).unwrap().count();
        let (before, count) = (text(&submission, "sphere.rs"), files());
        // The other task could start afresh, but nothing changes if there is an error.
        let (code, error) = refusal(&reset(&submission, &["bbox,sphere"]));
        assert_eq!(code, Some(2), "{error}");
        let why = format!("cannot find Sphere::hit in sphere.rs: {reason}");
        assert!(error.contains(&why), "{error}");
        assert!(
            error.contains("`cargo grade --reset sphere.rs` replaces the whole"),
            "{error}"
        );
        assert_eq!((text(&submission, "sphere.rs"), files()), (before, count));

        assert!(reset(&submission, &["sphere.rs"]).status.success());
        assert_eq!(text(&submission, "sphere.rs"), starter("sphere.rs"));
    }
}

#[test]
fn archives_unknown_tasks_and_folders_without_tasks_are_refused() {
    let submission = Submission::reference("alice").with("alice.zip", "PK");
    let archive = submission.path().join("alice.zip");
    let output = grader()
        .arg(archive)
        .args(["--reset", "bbox"])
        .output()
        .unwrap();
    let (code, error) = refusal(&output);
    assert!(
        code == Some(2) && error.contains("unpack an archive first"),
        "{error}"
    );

    let (code, error) = refusal(&reset(&submission, &["sphre"]));
    assert!(
        code == Some(2) && error.contains("did you mean sphere?"),
        "{error}"
    );

    let copies = Submission::reference("twice").with("src/bvh.rs", "");
    let (code, error) = refusal(&reset(&copies, &["bvh"]));
    assert!(
        code == Some(2) && error.contains("in its top level and src"),
        "{error}"
    );

    let empty = tempfile::tempdir().unwrap();
    let output = grader()
        .arg(empty.path())
        .args(["--reset", "bvh"])
        .output()
        .unwrap();
    let (code, error) = refusal(&output);
    assert!(
        code == Some(2) && error.contains("has none of camera.rs"),
        "{error}"
    );
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
        let output = grader()
            .arg(&path)
            .args(["--reset", "bvh"])
            .output()
            .unwrap();
        let (code, error) = refusal(&output);
        assert!(code == Some(2) && error.contains("is a link"), "{error}");
    }
    assert_eq!(text(&other, "bvh.rs"), before);
    // A link with the name of a copy is not followed either.
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
        let other = match long {
            "reset" | "help-staff" => continue,
            "task" => vec!["--task", "sphere"],
            "replay" => vec!["--replay", "sphere.uv"],
            "isolation" => vec!["--isolation", "none"],
            "cpu-limit" | "require" => vec!["--require", "5"],
            "format" => vec!["--format", "html"],
            _ if option.get_action().takes_values() => vec![long, "x"],
            _ => vec![long],
        };
        let mut arguments: Vec<String> = other.iter().map(|word| (*word).to_owned()).collect();
        arguments[0] = format!("--{long}");
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let (code, error) = refusal(&reset(&submission, &[&["sphere"], &arguments[..]].concat()));
        assert_eq!(code, Some(2), "--{long}: {error}");
        assert!(error.contains("cannot be used with"), "--{long}: {error}");
        count += 1;
    }
    assert!(count > 15, "{count}");
    assert_eq!(text(&submission, "sphere.rs"), before);
}
