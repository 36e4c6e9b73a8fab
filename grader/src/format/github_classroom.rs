//! The step output `result` for GitHub Classroom's reporter
//! (<https://github.com/classroom-resources/autograding-grading-reporter>). The service has been
//! discontinued, but courses that kept its workflows still use the reporter.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use crate::format::size::{fit, truncate};
use crate::format::{FormatContext, FormatSpec, StudentView, item_text};

/// The format.
pub static FORMAT: FormatSpec = FormatSpec {
    id: "github-classroom",
    file: "github-classroom.txt",
    render: Some(render),
    // Other commands of the same step may have written to this file already.
    shared_file: Some("GITHUB_OUTPUT"),
    ..FormatSpec::EMPTY
};

/// The maximum size of a step's output in bytes.
const MAX_BYTES: usize = 1 << 20;

/// Renders one line for `$GITHUB_OUTPUT`.
fn render(view: &StudentView, context: &FormatContext) -> String {
    fit(MAX_BYTES, |max_chars| {
        let result = result(view, context, max_chars).to_string();
        format!("result={}\n", STANDARD.encode(result))
    })
}

fn result(view: &StudentView, context: &FormatContext, max_chars: usize) -> Value {
    let tests: Vec<Value> = view
        .visible_items()
        .map(|(task, item)| {
            let has_all = item.points == item.max_points;
            let text = item_text::item_text(view, item, context);
            json!({
                "name": format!("{}: {}", item.id, item.title),
                "status": if has_all { "pass" } else { "fail" },
                // If a test had no score, the reporter's total would be NaN.
                "score": item.points,
                "message": if has_all { Value::Null } else { truncate(&text, max_chars).into() },
                "test_code": "",
                "filename": context.file_of(task.id),
                "line_no": item.at.as_ref().map_or(0, |at| at.line),
            })
        })
        // The reporter shows names only, and its total is the sum of these scores.
        .chain(view.counted_text().map(|text| {
            json!({
                "name": text,
                "status": "pass",
                "score": 0,
                "message": Value::Null,
                "test_code": "",
                "filename": "",
                "line_no": 0,
            })
        }))
        .collect();
    let status = match (
        view.visible.complete,
        view.visible.points == view.visible.max_points,
    ) {
        (false, _) => "error",
        (true, true) => "pass",
        (true, false) => "fail",
    };
    json!({
        "version": 1,
        "status": status,
        "max_score": view.visible.max_points,
        "tests": tests,
    })
}
