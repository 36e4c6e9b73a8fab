//! Tests for the command line arguments and their output.

use grader::format::FORMATS;
use grader::handed_out::RAYS;
use insta::assert_snapshot;

use crate::cases::PANICKING;
use crate::harness::{FULL_POINTS, Submission, assert_fails, grader, workspace};

fn assert_wrong_use(arguments: &[&str], why: &str) {
    let output = grader().args(arguments).output().unwrap();
    assert_fails(&output, 2, why);
}

#[test]
fn help_lists_the_options_for_students() {
    assert_snapshot!(help("--help"));
    // `-h` lists the same options, each with the first line of its description.
    let short = help("-h");
    let options = |text: &str| -> Vec<String> {
        let words = text
            .split([' ', '\n'])
            .filter(|word| word.starts_with("--"));
        words.map(str::to_owned).collect()
    };
    assert!(options(&short).contains(&"--watch".to_owned()), "{short}");
    let of_staff = "--untrusted".to_owned();
    assert!(!options(&short).contains(&of_staff), "{short}");
    let end = "the options for course staff and CI.";
    assert!(short.trim_end().ends_with(end), "{short}");
}

#[test]
fn help_for_staff_lists_every_option() {
    let help = help("--help-staff");
    let start = help.find("Formats: ").unwrap();
    let end = start + help[start..].find("\n\n").unwrap();
    // The snapshot doesn't depend on the formats, so that adding a format only changes that
    // format's own files.
    let listed: Vec<&str> = help[start..end].split_whitespace().skip(1).collect();
    let known = FORMATS.map(|format| format.id).join(", ");
    assert_eq!(listed.join(" "), known);
    let help = format!("{}Formats: FORMATS{}", &help[..start], &help[end..]);
    assert_snapshot!(help);
}

fn help(flag: &str) -> String {
    let output = grader().arg(flag).env("COLUMNS", "80").output().unwrap();
    assert!(output.status.success(), "{output:?}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn a_path_without_a_submission_is_a_usage_error() {
    let empty = tempfile::TempDir::new().unwrap();
    for (path, why) in [
        (
            empty.path().to_str().unwrap(),
            "contains none of camera.rs, triangle.rs",
        ),
        ("nowhere", "nowhere does not exist: pass the folder"),
        (
            "triangel",
            "triangel does not exist (did you mean triangle?)",
        ),
        (
            "traversal",
            "traversal does not exist (did you mean traverse?)",
        ),
        (
            "sphere.near_side",
            "sphere.near_side does not exist (did you mean --replay sphere.near_side?)",
        ),
        ("Cargo.toml", "is neither a folder nor a valid .zip"),
    ] {
        assert_wrong_use(&[path], why);
    }
}

#[test]
fn exits_with_1_below_the_required_points() {
    let graded = Submission::not_compiling().grade_with(&["--require", "100"]);
    assert_eq!(graded.exit_code(), 1);
    assert!(graded.score.is_some());
    let graded = Submission::reference("full").grade_with(&["--require", "100"]);
    assert_eq!(graded.points(), *FULL_POINTS);

    for options in [&["--require", "101"][..], &["--require", "101", "--next"]] {
        let refused = Submission::starter("refused").grade_with(options);
        let why = "--require 101 cannot be met: the assignment has only 100 points";
        assert_fails(&refused.output, 2, why);
    }
}

#[test]
fn grading_one_task_reports_it_alone_and_writes_no_score() {
    let graded = Submission::panicking().grade_with(&["--task", "sphere"]);
    assert_eq!(graded.exit_code(), 0);
    assert!(graded.score.is_none());
    assert_snapshot!(graded.report());
}

#[test]
fn timings_list_each_stage() {
    let graded = Submission::reference("timed").grade_with(&["--task", "camera", "--timings"]);
    let report = graded.report();
    let (_, table) = report.split_once("where the time went").unwrap();
    let millis = |stage: &str| {
        let line = table.lines().find(|line| line.trim().starts_with(stage));
        let number = line.unwrap().split_whitespace().last().unwrap();
        number.parse::<f64>().unwrap()
    };
    // No compiler needs less than 10 ms, and a task that was not graded took no time.
    assert!(millis("compiling") > 10.0, "{report}");
    assert!(millis("answering: camera") > 0.0, "{report}");
    assert_eq!(millis("answering: traverse"), 0.0, "{report}");
    assert!(millis("total") > millis("compiling"), "{report}");
}

#[test]
fn replays_one_question() {
    let submission = Submission::panicking();
    let items = PANICKING.items("sphere");
    let mut panicked = items.iter().filter(|item| item["verdict"] == "panicked");
    let item = panicked.next().unwrap();
    let (id, number) = (item["id"].as_str().unwrap(), &item["evidence"]["number"]);
    let replayed = replay(&submission, &format!("{id}#{number}"));
    // The panic names the path of the file, which differs in each run.
    let folder = submission.path().display().to_string();
    assert_snapshot!(replayed.replace(&folder, "SUBMISSION"));
}

#[test]
fn replay_says_what_is_wrong_with_an_answer() {
    let counting = "distance: {
                use std::sync::atomic::{AtomicU32, Ordering};
                static CALLS: AtomicU32 = AtomicU32::new(0);
                t + CALLS.fetch_add(1, Ordering::Relaxed) as f32
            },";
    for (file, from, to, item, texts) in [
        (
            "sphere.rs",
            "distance: t,",
            "distance: if ray.origin.x > 0.0 { t / 2.0 } else { t },",
            "sphere.from_inside",
            &["\nverdict  wrong: distance; the error is"][..],
        ),
        (
            "sphere.rs",
            "distance: t,",
            "distance: t,",
            "camera.corners",
            &["every answer to camera.corners is correct"],
        ),
        (
            "sphere.rs",
            "distance: t,",
            counting,
            "sphere.from_inside",
            &[
                "verdict  correct in isolation, but not when asked together",
                "distance; the error is",
            ],
        ),
        (
            "bvh.rs",
            "cost < best.cost",
            "cost > best.cost",
            "build.cost_town",
            &[
                "\nverdict  wrong: SAH cost: ",
                " times the cost with the best split at every node (the root splits ",
                "\n  39: ",
                " more nodes\n",
            ],
        ),
        // One primitive more than a leaf may hold.
        (
            "bvh.rs",
            "return items.len() / 2; // All",
            "return 0; // All",
            "build.coincident",
            &["\nsmallest the stack still overflows with 2 of the primitives: triangle ("],
        ),
        (
            "sphere.rs",
            "use protocol::",
            "use protocols::",
            "sphere.near_side",
            &[
                "protocols",
                "sphere.near_side cannot be run until this file compiles\n",
            ],
        ),
        // An error in a different task's file doesn't matter.
        (
            "camera.rs",
            "use protocol::",
            "use protocols::",
            "sphere.near_side",
            &["every answer to sphere.near_side is correct"],
        ),
    ] {
        let submission = Submission::reference("replayed").with_replaced(file, from, to);
        let text = replay(&submission, item);
        for expected in texts {
            assert!(text.contains(expected), "{expected}: {text}");
        }
        assert!(
            !text.contains("\n  40: "),
            "a tree is cut after 40 nodes: {text}"
        );
    }
}

/// If one question ends the program, the answers to the other questions are lost too, even though
/// those questions aren't to blame.
#[test]
fn replay_tells_a_right_answer_that_is_lost_to_another_question() {
    let submission = Submission::reference("exiting").with_replaced(
        "sphere.rs",
        "distance: t,",
        "distance: if ray.origin.x.to_bits() % 16 == 3 { std::process::exit(0) } else { t },",
    );
    let text = replay(&submission, "sphere.from_inside");
    let number = |text: &str| text.lines().next().unwrap_or_default().to_owned();
    let culprit = number(&text);
    assert!(
        text.contains("verdict  wrong: there is no answer"),
        "{text}"
    );
    let first = "sphere.from_inside#1";
    assert_ne!(culprit, first, "{text}");
    let text = replay(&submission, first);
    let lost = format!(
        "verdict  correct in isolation, but the item got no answers because {culprit} ended the \
         program: "
    );
    assert!(text.contains(&lost), "{text}");
    assert!(!text.contains("keeps something"), "{text}");
}

/// The answers would come from the code that was handed out.
#[test]
fn replay_says_that_a_method_is_not_written_yet() {
    let starter =
        |file: &str| std::fs::read(workspace().join("grader/starter").join(file)).unwrap();
    let submission = Submission::reference("stubs").with("bvh.rs", starter("bvh.rs"));
    for (item, method) in [
        ("build.partition", "Bvh::build ("),
        ("traverse.closest_hit", "Bvh::hit ("),
    ] {
        let text = replay(&submission, item);
        let expected = format!("{item} can only be run once {method}");
        assert!(text.starts_with(&expected), "{text}");
        assert!(
            text.contains("bvh.rs:") && !text.contains("verdict"),
            "{text}"
        );
    }
    let submission = Submission::reference("stub").with("bbox.rs", starter("bbox.rs"));
    let text = replay(&submission, "traverse.closest_hit");
    let note = "note: traverse.closest_hit also calls BBox::hit (";
    assert!(text.starts_with(note), "{text}");
    assert!(text.contains("\nverdict  wrong"), "{text}");
}

fn replay(submission: &Submission, question: &str) -> String {
    let output = grader()
        .arg(submission.path())
        .args(["--replay", question])
        .output()
        .unwrap();
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn a_name_that_is_unknown_leads_to_the_known_ones() {
    let tasks = RAYS.assignment.id_list();
    for (option, name, why) in [
        ("--task", "box", tasks.as_str()),
        (
            "--format",
            "gradescop",
            "the formats are json, text, html, gradescope,",
        ),
        (
            "--replay",
            "from_inside",
            "(did you mean sphere.from_inside or bbox.from_inside?)",
        ),
        (
            "--replay",
            "sphere.from_insde",
            "(did you mean sphere.from_inside?); the items in this task are: sphere.",
        ),
        (
            "--replay",
            "spere.uv",
            "(did you mean sphere.uv?); the items are: camera.",
        ),
        ("--replay", "sphere#", "such as sphere.from_inside#7"),
        (
            "--replay",
            "sphere.uv#99999",
            "sphere.uv has no question 99999",
        ),
    ] {
        assert_wrong_use(&[option, name], why);
    }
}

/// Only runs on Linux, since other systems always have a desktop.
#[cfg(target_os = "linux")]
#[test]
fn without_a_desktop_prints_the_path_of_the_page_and_succeeds() {
    let submission = Submission::starter("alice");
    let mut command = submission.command();
    for variable in ["DISPLAY", "WAYLAND_DISPLAY", "WSL_DISTRO_NAME"] {
        command.env_remove(variable);
    }
    let graded = submission.run(command.arg("--open"));
    let page = submission.out().join("report.html");
    assert!(page.is_file());
    let page = page.display();
    let line = format!("no desktop session is available: open {page} yourself");
    assert_fails(&graded.output, 0, &line);
    let report = String::from_utf8(graded.output.stdout).unwrap();
    let mut lines = report.lines();
    assert!(lines.any(|line| line.ends_with("report.html")), "{report}");
}
