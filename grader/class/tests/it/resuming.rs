//! Runs that are killed and resumed, and runs with `--regrade`.

use std::fs;
use std::process::Stdio;
use std::thread;
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::harness::{TestClass, assert_contains, comparable_files};

const ITEMS: [&str; 2] = ["camera.offset", "sphere.radius"];
const KILLS: u32 = 20;

fn sample_class(name: &str) -> TestClass {
    TestClass::named(name)
        .with_reference("ann")
        .with_starter("bob")
        .with_reference("carl")
        .with_replaced("carl/sphere.rs", "self.radius", "1.0 * self.radius")
        .with_reference("dora")
        .with("dora/bbox.rs", "fn (")
        .with("eve.zip", "PK\x03\x04")
}

#[test]
fn a_killed_run_resumes_to_the_same_results() {
    let class = sample_class("class");
    let exam = class.small_exam(&ITEMS);
    let began = Instant::now();
    class.graded(&exam, &[]);
    let duration = began.elapsed();
    let wanted = comparable_files(&class.out());
    fs::remove_dir_all(class.out()).unwrap();

    let mut killed = 0;
    for round in 0..KILLS {
        let mut run = class.command(&exam, &[]);
        let mut run = run
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        // Kill the runs at times spread over most of a run's duration.
        thread::sleep(duration * ((7 * round) % KILLS) / KILLS * 4 / 5 + Duration::from_millis(1));
        killed += u32::from(run.try_wait().unwrap().is_none());
        run.kill().unwrap();
        run.wait().unwrap();
    }
    assert!(killed > 0, "no run was killed");
    // A run that is killed while writing a file leaves a temporary file behind. That may not have
    // happened above, so add such files here.
    for folder in ["", "students/ann"] {
        let folder = class.out().join(folder);
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join(".tmpZ81xPq"), "half of a f").unwrap();
    }
    class.graded(&exam, &[]);
    assert_eq!(comparable_files(&class.out()), wanted);
}

#[test]
fn refuses_to_mix_incomparable_scores_and_regrade_reports_the_changes() {
    let class = sample_class("class");
    let exam = class.small_exam(&ITEMS);
    class.graded(&exam, &[]);

    let (worth, other) = exam_with_changed_points(&class, &exam, -1);

    let error = class.refused(&other, &[]);
    assert_contains(&error, &["because the exam changed: use --regrade"]);

    let text = class.graded(&other, &["--regrade"]);
    let expected = [
        "regraded: 3 scores changed (changed settings: the exam)",
        &format!("camera.offset {worth} → {}: pass", worth - 1),
    ];
    assert_contains(&text, &expected);
    assert!(class.out().join("students/ann/previous.json").is_file());
    // A run without changes grades nothing and prints the same report.
    let again = class.graded(&other, &[]);
    assert!(again.contains("regraded: 3 scores changed"), "{again}");
    // After another change, only drift.json shows what the regrade changed.
    let drift = class.read("drift.json");
    let policy = [("policy", "[points]\nout_of = 10\n")];
    let later = class.graded_with(&other, &policy, &[]);
    assert_contains(&later, &["changed (changed: the policy)"]);
    assert!(!later.contains("regraded"), "{later}");
    assert!(
        !class
            .read("class.html")
            .contains("Scores changed by the regrade")
    );
    assert_eq!(class.read("drift.json"), drift);

    let class = TestClass::named("new").with_reference("ann");
    let error = class.refused(&class.small_exam(&ITEMS), &["--regrade"]);
    assert_contains(
        &error,
        &["contains no scores that could be compared with new ones"],
    );
}

/// Changes the points for the camera's item. Returns the original points and the path of the new
/// exam.
fn exam_with_changed_points(class: &TestClass, exam: &str, by: i64) -> (i64, String) {
    let mut other: Value = serde_json::from_slice(&fs::read(exam).unwrap()).unwrap();
    let camera = &mut other["items"][0];
    assert_eq!(camera["id"], "camera.offset");
    let worth = camera["points"].as_i64().unwrap();
    camera["points"] = (worth + by).into();
    let name = format!("revalued-{by}.json");
    (worth, class.write_beside(&name, &other.to_string()))
}

#[test]
fn a_changed_submission_keeps_its_old_score_and_removed_students_are_named() {
    let class = sample_class("class");
    let exam = class.small_exam(&ITEMS);
    class.graded(&exam, &[]);
    let old = class.read("students/bob/score.json");
    let class = class.with_reference("bob");
    for name in ["carl", "dora"] {
        fs::remove_dir_all(class.input().join(name)).unwrap();
    }
    let class = class.with_folder("carl");
    let text = class.graded(&exam, &[]);
    let expected = [
        "  bob: 0 → 3\n",
        "      camera.offset 0 → 2: pass; previously",
        "  carl: 3 → no score\n",
        "  dora: 3 points\n",
    ];
    assert_contains(&text, &expected);
    assert_eq!(class.read("students/bob/replaced.json"), old);
    assert!(class.out().join("students/dora/report.html").is_file());
    assert!(!class.read("grades.csv").contains("dora"));
    let page = class.read("class.html");
    assert_contains(&page, &["<strong>0 → 3</strong>", "dora: 3 points"]);
    assert!(!text.contains("ann: "), "{text}");

    // Each change is only listed until the next one.
    let policy = [("policy", "[points]\nout_of = 10\n")];
    let later = class.graded_with(&exam, &policy, &[]);
    assert!(!later.contains("changed submissions"), "{later}");

    // A regrade compares the new scores with the previous scores.
    let (_, other) = exam_with_changed_points(&class, &exam, -1);
    let text = class.graded(&other, &["--regrade"]);
    assert!(text.contains("  bob: 3 → 2\n"), "{text}");
    assert!(!text.contains("changed submissions"), "{text}");
}

/// Ann's files change between the first run and the regrade, and Bob's files after the regrade.
#[test]
fn a_regrade_does_not_list_submissions_whose_files_changed() {
    let class = TestClass::named("class")
        .with_starter("ann")
        .with_starter("bob")
        .with_reference("carl");
    let exam = class.small_exam(&ITEMS);
    class.graded(&exam, &[]);
    let class = class.with_reference("ann");
    let (_, other) = exam_with_changed_points(&class, &exam, -1);
    let regraded = class.graded(&other, &["--regrade"]);
    let listed = |text: &str| {
        let (regrade, rest) = text
            .split_once("regraded: ")
            .unwrap()
            .1
            .split_once("\n\n")
            .unwrap();
        (regrade.to_owned(), rest.to_owned())
    };
    let (regrade, rest) = listed(&regraded);
    assert_contains(
        &regrade,
        &[
            "1 score changed (changed settings: the exam)",
            "  carl: 3 → 2\n",
        ],
    );
    assert!(!regrade.contains("ann"), "{regrade}");
    let changed = "changed submissions";
    assert_contains(&rest, &[changed, "  ann: 0 → 2\n"]);

    let class = class.with_reference("bob");
    let text = class.graded(&other, &[]);
    assert_contains(&text, &[changed, "  bob: 0 → 2\n"]);
    assert!(
        !text.contains("regraded") && !text.contains("ann: "),
        "{text}"
    );
    let drift: Value = serde_json::from_str(&class.read("drift.json")).unwrap();
    let ids = drift.as_array().unwrap().iter().map(|change| &change["id"]);
    assert_eq!(ids.collect::<Vec<_>>(), ["carl"]);
}
