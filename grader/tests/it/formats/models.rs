//! Strict models of each platform's documented format: no unknown keys, no missing keys, and totals
//! that match.

use std::collections::BTreeSet;

use grader::handed_out::RAYS;
use quick_junit::{Report, TestCaseStatus};
use serde::Deserialize;
use serde_json::Value;

/// Panics if the text does not match the documentation of its platform.
pub fn check(format: &str, text: &str) {
    match format {
        "gradescope" => gradescope(text),
        "classroom50" => classroom50(text),
        "junit" => junit(text),
        "check50" => check50(text),
        "prairielearn" => prairielearn(text),
        "html" => assert!(!text.contains("src=\"") && text.ends_with("</html>")),
        "github" => assert!(text.len() < 1 << 20 && text.starts_with("## ")),
        "text" => assert!(!text.contains('\u{1b}'), "it contains an escape sequence"),
        "json" => {}
        other => panic!("there is no model of the format {other}"),
    }
}

/// Returns the text in a readable form for snapshots.
pub fn readable(format: &str, text: &str) -> String {
    match format {
        "html" => without_element(without_element(text, "style"), "script"),
        // The replacement doesn't change the meaning of the XML. It is needed because quick-junit
        // ignores properties with a separate end tag.
        "junit" => {
            let text = text.replace("></property>", "/>");
            let report = Report::deserialize_from_str(&text).unwrap();
            report.to_string().unwrap()
        }
        _ => text.to_owned(),
    }
}

/// Returns the page without this element, which is the same on every page.
fn without_element(page: impl AsRef<str>, element: &str) -> String {
    let (before, rest) = page.as_ref().split_once(&format!("<{element}>")).unwrap();
    let (_, after) = rest.split_once(&format!("</{element}>")).unwrap();
    format!("{before}{after}")
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "only their presence is tested")]
struct Gradescope {
    score: f64,
    execution_time: Option<f64>,
    output: String,
    output_format: TextFormat,
    test_output_format: TextFormat,
    test_name_format: TextFormat,
    visibility: Visibility,
    stdout_visibility: Visibility,
    extra_data: Value,
    tests: Vec<GradescopeTest>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "only their presence is tested")]
struct GradescopeTest {
    // A test without points only shows text.
    score: Option<f64>,
    max_score: Option<f64>,
    status: Option<Status>,
    name: String,
    name_format: TextFormat,
    number: String,
    output: String,
    output_format: TextFormat,
    tags: Vec<String>,
    visibility: Visibility,
    extra_data: Value,
}

#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum TextFormat {
    Text,
    Html,
    SimpleFormat,
    Md,
    Ansi,
}

#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum Visibility {
    Hidden,
    AfterDueDate,
    AfterPublished,
    Visible,
}

#[derive(Deserialize, PartialEq)]
#[serde(rename_all = "snake_case")]
enum Status {
    Passed,
    Failed,
}

fn gradescope(text: &str) {
    assert!(text.len() <= 256 << 10, "{} bytes", text.len());
    let results: Gradescope = serde_json::from_str(text).unwrap();
    let sum: f64 = results.tests.iter().filter_map(|test| test.score).sum();
    assert_eq!(results.score, sum, "totals match");
    let numbers: BTreeSet<&String> = results.tests.iter().map(|test| &test.number).collect();
    assert_eq!(numbers.len(), results.tests.len(), "numbers differ");
    for test in &results.tests {
        let has_all = test.score == test.max_score;
        let says_so = test.status.as_ref().map(|status| *status == Status::Passed);
        assert!(
            says_so.is_none_or(|passed| passed == has_all),
            "{}",
            test.name
        );
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Classroom50 {
    schema: String,
    classroom: String,
    assignment: String,
    #[serde(rename = "assignment_type")]
    assignment_type: AssignmentType,
    owner: String,
    submission: String,
    commit: String,
    release: String,
    review: String,
    datetime: String,
    score: u32,
    max_score: u32,
    tests: Vec<Classroom50Test>,
}

#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum AssignmentType {
    Individual,
    Group,
}

/// A test in classroom50's results. Unlike elsewhere, classroom50 allows additional keys here and
/// keeps them.
#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
struct Classroom50Test {
    test_name: String,
    passed: bool,
    score: u32,
    max_score: u32,
}

fn classroom50(text: &str) {
    let result: Classroom50 = serde_json::from_str(text).unwrap();
    assert_eq!(result.schema, "classroom50/result/v1");
    assert!(matches!(result.assignment_type, AssignmentType::Individual));
    assert!(result.submission.starts_with("submit/"));
    let names = [&result.classroom, &result.assignment, &result.owner];
    let links = [&result.commit, &result.release, &result.review];
    assert!(names.iter().chain(&links).all(|text| !text.is_empty()));
    let shape: String = result
        .datetime
        .chars()
        .map(|c| if c.is_ascii_digit() { '0' } else { c })
        .collect();
    assert_eq!(shape, "0000-00-00T00:00:00Z");
    assert!(result.score <= result.max_score);
    for test in &result.tests {
        assert!(!test.test_name.is_empty() && test.score <= test.max_score);
        assert_eq!(test.passed, test.score == test.max_score);
    }
    assert_eq!(
        result.score,
        result.tests.iter().map(|test| test.score).sum::<u32>()
    );
}

fn junit(text: &str) {
    roxmltree::Document::parse(text).expect("well-formed XML");
    let report = Report::deserialize_from_str(text).expect("valid JUnit XML");
    let suites = report.test_suites.iter();
    let suites: Vec<&str> = suites.map(|suite| suite.name.as_str()).collect();
    let tasks: Vec<&str> = RAYS.assignment.tasks.iter().map(|task| task.id).collect();
    assert_eq!(suites, tasks);
    let suites = report.test_suites.iter();
    let cases: Vec<_> = suites.flat_map(|suite| &suite.test_cases).collect();
    let failed = cases
        .iter()
        .filter(|case| matches!(case.status, TestCaseStatus::NonSuccess { .. }));
    assert_eq!(report.tests, cases.len());
    assert_eq!(report.failures + report.errors, failed.count());
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "only their presence is tested")]
struct Check50 {
    slug: String,
    results: Vec<Check50Result>,
    version: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "only their presence is tested")]
struct Check50Result {
    name: String,
    description: String,
    passed: Option<bool>,
    log: Vec<String>,
    cause: Option<Cause>,
    data: Value,
    dependency: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "only their presence is tested")]
struct Cause {
    rationale: String,
    help: Option<String>,
}

fn check50(text: &str) {
    let report: Check50 = serde_json::from_str(text).unwrap();
    let names: BTreeSet<&str> = report.results.iter().map(|result| &*result.name).collect();
    for result in &report.results {
        assert_eq!(
            result.passed == Some(true),
            result.cause.is_none(),
            "{}",
            result.name
        );
        let known = result
            .dependency
            .as_deref()
            .is_none_or(|name| names.contains(name));
        assert!(known, "{:?}", result.dependency);
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "only their presence is tested")]
struct PrairieLearn {
    gradable: bool,
    score: f64,
    message: Option<String>,
    output: Option<String>,
    format_errors: Option<Vec<String>>,
    #[serde(default)]
    tests: Vec<PrairieLearnTest>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "only their presence is tested")]
struct PrairieLearnTest {
    name: String,
    description: String,
    points: f64,
    max_points: f64,
    message: String,
    output: String,
}

fn prairielearn(text: &str) {
    assert!(text.len() < 1_000_000);
    let results: PrairieLearn = serde_json::from_str(text).unwrap();
    assert!((0.0..=1.0).contains(&results.score));
    assert_eq!(results.gradable, results.format_errors.is_none());
    let sum = |points: fn(&PrairieLearnTest) -> f64| results.tests.iter().map(points).sum::<f64>();
    let share = sum(|test| test.points) / sum(|test| test.max_points).max(1.0);
    assert!((results.score - share).abs() < 1e-9);
}
