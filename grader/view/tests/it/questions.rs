//! Questions from the practice exam, and other people's submissions.

use std::collections::BTreeSet;
use std::env;
use std::io::Write;

use grader::grade::grade;
use grader::handed_out::RAYS;
use grader::options::GradeOptions;
use grader::report::text::report;
use grader::task_selection::TaskSelection;
use serde_json::{Value, json};

use crate::expected_tests::{Expected, listed_tests, marks};
use crate::harness::{SLIDES_HIT, Submission, Viewer, view};

#[test]
fn a_question_about_traversal_shows_the_exams_tree_and_the_steps() {
    let viewer = Viewer::start(&Submission::reference(), "--item traverse.prunes#3");
    let state = viewer.wait_for_picture();
    assert_eq!(state["subject"], "traverse.prunes#3");
    assert!(state["question"]["wanted"][0].is_string(), "{state:#}");
    let state = viewer.wait_for(|state| state["has_tree"] == true);
    assert!(state["tree_levels"].as_u64() > Some(1));
    let explanation = viewer.explanation();
    let ray = &explanation["rays"][0];
    assert_eq!(ray["kind"], "ray from the exam");
    assert!(ray["boxes"].as_u64() > Some(0), "{ray}");
}

/// Returns the tests listed for a ray from the exam, and the marked nodes, each with the rule that
/// was broken.
fn tests_and_marks(submission: &Submission, item: &str) -> (Vec<String>, Vec<(String, u32)>) {
    let viewer = Viewer::start(submission, &format!("--item {item}"));
    let ray = &viewer.explanation()["rays"][0];
    (listed_tests(ray), marks(ray))
}

#[test]
fn in_a_tree_with_decoys_exactly_the_wrong_steps_of_the_slides_pseudo_code_are_marked() {
    let reference = Submission::reference();
    let slides = Submission::reference();
    slides.replace_traversal(SLIDES_HIT);
    let mut wrong_steps = 0;
    for (item, number) in [
        ("traverse.prunes", 1),
        ("traverse.prunes", 3),
        ("traverse.skips_missed", 1),
        ("traverse.skips_missed", 2),
        ("traverse.nearer_first", 1),
    ] {
        let name = format!("{item}#{number}");
        let expected = Expected::of_question(item, number);
        let correct = expected.tests_of_question();
        let (tests, marks) = tests_and_marks(&reference, &name);
        assert_eq!((tests, marks), (correct.clone(), Vec::new()), "{name}");

        let (tests, marks) = tests_and_marks(&slides, &name);
        let correct = expected.entered(&correct);
        let entered = expected.entered(&tests);
        let wrong: BTreeSet<u32> = entered.difference(&correct).copied().collect();
        // If nodes are visited in a different order, it can be right to enter a node beyond the
        // closest hit, because that hit may not be known yet.
        for (rule, node) in &marks {
            let is_wrong = wrong.contains(node) || rule == "beyond_closest_hit";
            assert!(is_wrong, "{name}: {rule} {node}, {wrong:?}");
        }
        let marks: BTreeSet<u32> = marks.into_iter().map(|(_, node)| node).collect();
        // Below a wrong node, the traversal may look correct again. A box that the ray misses by
        // less than the margin isn't judged. In the last two questions, the slides' traversal
        // enters such boxes: in one case, the box's sibling contains the ray's origin; in the
        // other, the ray misses both siblings, and the traversal enters the first of them.
        let judged = wrong.iter().filter(|node| !expected.barely_misses(**node));
        let first_wrong = judged.filter(|node| {
            let parent = expected.parent(**node);
            let mut above = std::iter::successors(parent, |node| expected.parent(*node));
            above.all(|node| correct.contains(&node) && !marks.contains(&node))
        });
        for node in first_wrong {
            assert!(marks.contains(node), "{name}: node {node} is not marked");
            wrong_steps += 1;
        }
    }
    assert!(wrong_steps >= 4, "{wrong_steps}");
}

#[test]
fn the_command_in_a_report_opens_the_wrong_question() {
    let submission = Submission::reference();
    submission.replace(
        "bvh.rs",
        "if second_begins <= ray.range.max {",
        "if second_begins <= f32::MAX {",
    );
    let options = GradeOptions {
        submission: Some(submission.path().to_owned()),
        tasks: TaskSelection::parse("traverse", RAYS.assignment).unwrap(),
        ..GradeOptions::default()
    };
    let graded = grade(&options).unwrap();
    let report = report(&graded.score, &options.tasks, options.hints);
    let report = anstream::adapter::strip_str(&report).to_string();
    let mut lines = report.lines().map(|line| line.trim().split_once(' '));
    let command = lines.find_map(|line| line.filter(|(label, _)| *label == "view"));
    let command = command.unwrap_or_else(|| panic!("{report}")).1.trim();
    let words = command.strip_prefix("cargo view ").unwrap().split(' ');
    let question = command.rsplit_once(' ').unwrap().1;
    assert!(question.starts_with("traverse.prunes#"), "{command}");

    let viewer = Viewer::run(view().args(words)).unwrap();
    let state = viewer.wait_for_picture();
    assert_eq!(state["subject"], question);
    let ray = &viewer.explanation()["rays"][0];
    let marks = marks(ray);
    let is_beyond = |(rule, _): &(String, u32)| rule == "beyond_closest_hit";
    assert!(marks.iter().any(is_beyond), "{marks:?}");
}

#[test]
fn questions_about_shapes_boxes_and_builders_have_something_to_show() {
    let submission = Submission::reference();
    let viewer = Viewer::start(&submission, "--item sphere.from_inside#1");
    viewer.wait_for_picture();
    let ray = &viewer.explanation()["rays"][0];
    assert_eq!((&ray["primitives"], &ray["notes"]), (&json!(1), &json!([])));

    let viewer = Viewer::start(&submission, "--item bbox.through#1");
    let state = viewer.wait_for(|state| state["question"] != Value::Null);
    assert_eq!(state["question"]["boxes"].as_array().unwrap().len(), 1);

    let viewer = Viewer::start(&submission, "--item build.contains#1");
    viewer.wait_for(|state| state["has_tree"] == true);
}

#[test]
fn someone_elses_submission_runs_in_the_sandbox() {
    let submission = Submission::reference();
    // This makes the camera read a file, which the sandbox forbids.
    let read = "assert!(std::fs::read(\"/etc/hostname\").is_err(), \"read a file\");";
    submission.insert_into_camera(read);
    let arguments = "flat --size 16x12 --samples 1";
    let viewer = match Viewer::try_start(&submission, &format!("{arguments} --untrusted")) {
        Ok(viewer) => viewer,
        Err(error) => {
            assert!(error.contains("cannot be graded here"), "{error}");
            assert!(
                env::var_os("CI").is_none(),
                "CI is set, but there is no sandbox: {error}"
            );
            // A passing test hides the output of `eprintln!`.
            std::io::stderr()
                .write_all(b"SKIPPED: there is no sandbox on this machine\n")
                .unwrap();
            return;
        }
    };
    let state = viewer
        .wait_for(|state| state["is_picture_complete"] == true || state["notes"] != json!([]));
    // The system call either fails or ends the program.
    let message = format!("{} {}", state["panics"], state["notes"]);
    assert!(!message.contains("read a file"), "{message}");
    drop(viewer);

    let trusted = Viewer::start(&submission, arguments);
    let state = trusted.wait_for_picture();
    assert_eq!(state["panics"][0]["message"], "read a file");
}
