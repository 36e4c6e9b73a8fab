//! One student's disaster is one student's: there is a line for each, and the others' points are
//! untouched.

use serde_json::Value;

use crate::harness::{TestClass, successful_stdout};

const ITEMS: [&str; 2] = ["camera.offset", "sphere.radius"];

#[test]
fn a_faulty_submission_does_not_affect_the_others() {
    let place = TestClass::named("class")
        .with_reference("fine")
        .with_starter("=starter")
        .with_reference("panics")
        .with_replaced(
            "panics/camera.rs",
            "pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {",
            "pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {\n        assert!(pixel.x > 1_000_000);",
        )
        .with_reference("broken")
        .with("broken/sphere.rs", "fn (")
        .with("bad.zip", "PK\x03\x04 and no more")
        .with_folder("empty");
    let exam = place.small_exam(&ITEMS);
    let output = place.grade(&exam, &[]);
    let text = successful_stdout(&output);
    let grades = place.read("grades.csv");
    let line = |id: &str| {
        let begin = format!("{id},");
        let line = grades.lines().find(|line| line.starts_with(&begin));
        line.unwrap_or_else(|| panic!("{id}: {grades}")).to_owned()
    };
    let summary: Value = serde_json::from_str(&place.read("class.json")).unwrap();
    let most = summary["points"]["of"].as_u64().unwrap();
    assert!(line("fine").contains(&format!("graded,{most},{most},{most}")));
    // A name that a spreadsheet would calculate is shown instead.
    assert!(line("_starter").contains("'=starter,,,,graded,0,0,"));
    assert!(
        line("bad").contains("nothing to grade,,,"),
        "{}",
        line("bad")
    );
    assert!(line("bad").contains("it is damaged"), "{}", line("bad"));
    assert!(line("empty").contains("nothing was handed in"));
    let points = |id: &str| -> u64 { line(id).split(',').nth(6).unwrap().parse().unwrap() };
    assert!((1..most).contains(&points("panics")), "{grades}");
    assert!((1..most).contains(&points("broken")), "{grades}");

    assert_eq!(summary["graded"], 4);
    assert_eq!(summary["nothing_to_grade"], 2);
    assert!(text.contains("to be looked at"), "{text}");
    let page = place.read("class.html");
    assert!(page.contains("href=\"students/fine/report.html\""));
    assert!(!page.contains("=starter</script"), "names are text");
}

#[test]
fn late_days_cost_what_the_policy_says() {
    let metadata = "---\nsubmission_1:\n  :submitters:\n  - :name: Late\n    :email: l@x.edu\n  :created_at: 2026-11-21 00:10:00.000000000 Z\nsubmission_2:\n  :submitters:\n  - :name: Early\n    :email: e@x.edu\n  :created_at: 2026-11-20 00:10:00.000000000 Z\n";
    let place = TestClass::named("export")
        .with("submission_metadata.yml", metadata)
        .with_reference("submission_1")
        .with_reference("submission_2");
    let exam = place.small_exam(&ITEMS);
    let policy = place.write_beside(
        "policy.toml",
        "[points]\nout_of = 50\n[late]\ndue = 2026-11-20T23:59:59Z\npercent_per_day = 10\n",
    );
    successful_stdout(&place.grade(&exam, &["--policy", &policy]));
    let grades = place.read("grades.csv");
    assert!(
        grades.contains("submission_1,Late,l@x.edu,,,graded,45,"),
        "{grades}"
    );
    assert!(
        grades.contains("submission_2,Early,e@x.edu,,,graded,50,"),
        "{grades}"
    );

    // Whoever goes on and forgets it is told.
    let again = place.grade(&exam, &[]);
    successful_stdout(&again);
    let error = String::from_utf8(again.stderr).unwrap();
    assert!(
        error.contains("the policy is not that of the last run"),
        "{error}"
    );
}
