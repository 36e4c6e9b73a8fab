//! classroom50's `result.json`, version 1
//! (<https://github.com/foundation50/classroom50>, `schemas/result-v1.schema.json`).
//!
//! The runner's environment variables say whose submission this is, and the runner checks that the
//! file repeats their values.

use serde_json::{Value, json};

use crate::format::item_text::{item_message, item_text};
use crate::format::{FormatContext, FormatSpec, StudentView};
use crate::score::Verdict;

/// The format.
pub static FORMAT: FormatSpec = FormatSpec {
    id: "classroom50",
    file: "classroom50.json",
    render: Some(render),
    variables: &VARIABLES,
    ..FormatSpec::EMPTY
};

/// The environment variables that describe the submission. The runner sets all of them except the
/// last.
const VARIABLES: [&str; 9] = [
    "CLASSROOM",
    "ASSIGNMENT",
    "ASSIGNMENT_TYPE",
    "OWNER",
    "SUBMISSION_TAG",
    "COMMIT_URL",
    "RELEASE_URL",
    "REVIEW_URL",
    // The date of the graded commit, which is set by the autograder package's script.
    "SUBMITTED_AT",
];

/// Renders `result.json`.
fn render(view: &StudentView, context: &FormatContext) -> String {
    let of = |name: &str| context.variables.get(name).cloned().unwrap_or_default();
    let review = match of("REVIEW_URL") {
        none if none.is_empty() => of("COMMIT_URL"),
        review => review,
    };
    let tests: Vec<Value> =
        view.visible_items()
            .map(|(_, item)| {
                json!({
                    "test-name": format!("{}: {}", item.id, item.title),
                    "passed": item.verdict == Verdict::Pass,
                    "score": item.points,
                    "max-score": item.max_points,
                    "outcome": item.verdict.label(),
                    "message": item_message(item),
                    "output": item_text(view, item, context),
                })
            })
            // The format has no other place for an explanation of the score.
            .chain(view.counted_text().map(
                |text| json!({ "test-name": text, "passed": true, "score": 0, "max-score": 0 }),
            ))
            .collect();
    super::to_json(&json!({
        "schema": "classroom50/result/v1",
        "classroom": of("CLASSROOM"),
        "assignment": of("ASSIGNMENT"),
        "assignment_type": of("ASSIGNMENT_TYPE"),
        "owner": of("OWNER"),
        "submission": of("SUBMISSION_TAG"),
        "commit": of("COMMIT_URL"),
        "release": of("RELEASE_URL"),
        "review": review,
        "datetime": of("SUBMITTED_AT"),
        "score": view.counted.points,
        "max-score": view.counted.max_points,
        "tests": tests,
    }))
}
