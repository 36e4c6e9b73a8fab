//! Tests every format with the same score: checks the numbers and compares each text with a
//! snapshot.

use serde_json::Value;

pub mod sample;

use super::{FORMATS, FormatSpec, StudentView};
use crate::score::Verdict;
use sample::{LATE, RESTRICTED};

fn format(id: &str) -> &'static FormatSpec {
    let mut formats = FORMATS.into_iter();
    formats.find(|format| format.id == id).unwrap()
}

/// Returns the rendered file of the format with this id.
fn rendered(id: &str, view: &StudentView) -> String {
    format(id).render.unwrap()(view, &sample::context())
}

fn json(id: &str, view: &StudentView) -> Value {
    serde_json::from_str(&rendered(id, view)).unwrap()
}

/// Returns check50's result for the item with this id.
fn check50_result(view: &StudentView, id: &str) -> Value {
    let results = json("check50", view)["results"].take();
    let mut results = results.as_array().unwrap().iter();
    results.find(|result| result["name"] == id).unwrap().clone()
}

/// Returns the sum of the numbers under `key` in a file's tests. A test without this key adds
/// nothing.
fn sum(file: &Value, key: &str) -> u64 {
    let tests = file["tests"].as_array().unwrap().iter();
    tests.filter_map(|test| test[key].as_u64()).sum()
}

/// Returns the value of `key` in each entry of a list, without quotes.
fn column(list: &Value, key: &str) -> Vec<String> {
    let text = |entry: &Value| match entry[key].as_str() {
        Some(text) => text.to_owned(),
        None => entry[key].to_string(),
    };
    list.as_array().unwrap().iter().map(text).collect()
}

/// Lists each format with its file, the number of runner variables it needs, the variable that
/// contains the path of a file to append to, and whether it is rendered for students.
#[test]
fn each_format_has_its_own_name_and_file() {
    let formats = FORMATS.map(|format| {
        let (shared, variables) = (format.shared_file, format.variables.len());
        (
            format.id,
            format.file,
            variables,
            shared,
            format.render.is_some(),
        )
    });
    let expected = [
        ("json", "score.json", 0, None, false),
        ("text", "report.txt", 0, None, true),
        ("html", "feedback.html", 0, None, true),
        ("gradescope", "gradescope.json", 0, None, true),
        ("classroom50", "classroom50.json", 9, None, true),
        ("junit", "junit.xml", 0, None, true),
        ("github", "github.md", 0, Some("GITHUB_STEP_SUMMARY"), true),
        ("check50", "check50.json", 0, None, true),
        ("prairielearn", "prairielearn.json", 0, None, true),
    ];
    assert_eq!(formats, expected);
}

/// Compares the rendered text of each format with a snapshot, except for the HTML page, whose style
/// sheet is too long.
#[test]
fn everything_is_shown_of_the_practice_exam() {
    let mut settings = insta::Settings::clone_current();
    settings.set_omit_expression(true);
    settings.add_filter(r#""version": "[0-9.]+""#, r#""version": "1.2.3""#);
    settings.bind(|| {
        for format in FORMATS {
            let is_short = format.id != "html" && format.render.is_some();
            if is_short {
                insta::assert_snapshot!(format.id, rendered(format.id, &sample::late()));
            }
        }
    });
}

#[test]
fn the_page_says_how_many_points_count() {
    let sentence = "16 of 56 points count towards the grade: 9 of 28 points earned";
    assert!(rendered("html", &sample::late()).contains(sentence));
    let on_time = rendered("html", &sample::open());
    assert!(on_time.contains("unit length") && !on_time.contains("towards the grade"));
}

#[test]
fn the_points_of_all_tests_are_those_earned() {
    let views = [sample::open(), sample::late(), sample::restricted()];
    for view in views {
        for (format, points, max_points) in [
            ("gradescope", "score", "max_score"),
            ("classroom50", "score", "max-score"),
            ("prairielearn", "points", "max_points"),
        ] {
            let file = json(format, &view);
            assert_eq!((sum(&file, points), sum(&file, max_points)), (9, 28));
        }
        let rows = rendered("github", &view);
        let row = rows.lines().find(|row| row.contains("spheres")).unwrap();
        assert_eq!(row, "| Task 2: spheres | 3 | 5 |");
    }
}

#[test]
fn an_explanation_of_the_grade_is_one_more_test() {
    let (on_time, late) = (sample::open(), sample::late());
    for (id, list) in [("classroom50", "tests"), ("check50", "results")] {
        let count = |view: &StudentView| json(id, view)[list].as_array().unwrap().len();
        assert_eq!((count(&on_time), count(&late)), (14, 15), "{id}");
    }
}

#[test]
fn a_dependency_is_named_only_if_it_is_shown() {
    let blocked = |view: &StudentView| check50_result(view, "traverse.closest_hit");
    assert_eq!(blocked(&sample::open())["dependency"], "bbox.flat");
    assert_eq!(blocked(&sample::restricted())["dependency"], Value::Null);
}

#[test]
fn a_check_without_a_message_is_explained_by_its_verdict() {
    let points_only = sample::view(&sample::of_final_exam(sample::score()), RESTRICTED, 0);
    for (id, verdict) in [
        ("sphere.far_root", "partial"),
        ("sphere.from_inside", "wrong"),
    ] {
        let result = check50_result(&points_only, id);
        assert_eq!(result["cause"]["rationale"], verdict);
    }
}

#[test]
fn a_review_without_a_link_of_its_own_is_at_the_commit() {
    let mut context = sample::context();
    context.variables.insert("REVIEW_URL", String::new());
    let file = format("classroom50").render.unwrap()(&sample::open(), &context);
    let file: Value = serde_json::from_str(&file).unwrap();
    assert_eq!(file["review"], "the COMMIT_URL");
}

#[test]
fn gradescope_shows_no_status_of_an_item_that_is_not_graded() {
    let unfinished = sample::view(&sample::unfinished_score(), "", 0);
    let statuses = column(&json("gradescope", &unfinished)["tests"], "status");
    assert_eq!(statuses[0], "passed");
    assert!(statuses[1..4].iter().all(|status| status == "failed"));
    assert_eq!(statuses.last().unwrap(), "null");
}

#[test]
fn gradescope_shows_each_item_when_the_policy_says() {
    let file = json("gradescope", &sample::restricted());
    let visibility = column(&file["tests"], "visibility");
    let (last, items) = visibility.split_last().unwrap();
    let mut expected = ["visible"; 14];
    expected[7] = "after_due_date";
    (expected[10], expected[11]) = ("after_published", "hidden");
    assert_eq!(items, expected);
    assert_eq!(last, "after_published", "the explanation of the total");
    assert_eq!(column(&file["tests"], "number").last().unwrap(), "7");
}

#[test]
fn gradescope_tells_no_total_that_includes_hidden_points() {
    let file = json("gradescope", &sample::restricted());
    let output = file["output"].as_str().unwrap();
    let rules = "Some items are not shown yet.\n\nThese rules apply to the grade: 28 points are scaled to 56; handed \
                 in 1 day late, so 10% of the points earned are deducted.\n\nerror: expected";
    assert!(output.starts_with(rules), "{output}");
    // A program can choose how long it runs.
    assert_eq!(file.get("execution_time"), None);
}

#[test]
fn gradescope_explains_a_total_when_it_is_shown() {
    let last = |policy: &str, late_days: u64| {
        let view = sample::view(&sample::of_final_exam(sample::score()), policy, late_days);
        let tests = json("gradescope", &view)["tests"].take();
        tests.as_array().unwrap().last().unwrap().clone()
    };
    let after_due = "[visibility.items]\nbbox = 'after_due'";
    let until_due = last(&format!("{LATE}\n{after_due}"), 1);
    assert_eq!(until_due["name"], "What counts towards the grade");
    assert_eq!(until_due["visibility"], "after_due_date");
    // If everything is shown, the text above the tests explains the total.
    assert_eq!(last(LATE, 1)["name"], "any hit");
    assert_eq!(last(after_due, 0)["name"], "any hit");
}

#[test]
fn a_submission_of_which_nothing_compiles_costs_no_attempt() {
    let mut score = sample::score();
    for task in &mut score.tasks {
        for line in &mut task.items {
            let (id, points) = (&line.id, line.max_points);
            *line = sample::item(id, 0, points, Verdict::NotCompiled, "does not compile");
        }
    }
    let file = json("prairielearn", &sample::view(&score, "", 0));
    assert_eq!(file["gradable"], false);
    let errors = file["format_errors"][0].as_str().unwrap();
    assert!(errors.starts_with("error: expected `;`"), "{errors}");
    assert_eq!(json("prairielearn", &sample::open())["gradable"], true);
}

#[test]
fn long_compiler_errors_are_shown_in_full() {
    let mut score = sample::score();
    score.build.not_compiled[0].message = "x".repeat(10_000);
    let view = sample::view(&score, "", 0);
    for id in ["gradescope", "prairielearn", "github"] {
        assert!(rendered(id, &view).contains(&"x".repeat(10_000)), "{id}");
    }
}

#[test]
fn an_unfinished_grade_is_announced() {
    let unfinished = sample::view(&sample::unfinished_score(), "", 0);
    let notice = "UNFINISHED: 13 of 14 items have been graded; the others have no points yet";
    for id in ["text", "gradescope", "prairielearn", "github"] {
        assert!(rendered(id, &unfinished).contains(notice), "{id}");
        let finished = rendered(id, &sample::open());
        assert!(!finished.contains("UNFINISHED"), "{id}");
    }
    for id in ["html", "junit", "check50", "classroom50"] {
        let label = Verdict::Pending.label();
        assert!(rendered(id, &unfinished).contains(label), "{id}");
    }
}
