//! The step output `result` that GitHub Classroom's reporter read
//! (<https://github.com/classroom-resources/autograding-grading-reporter>). The service has ended;
//! courses that kept its workflows have the reporter still.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use crate::format::size::{fit, truncate};
use crate::format::{FormatContext, StudentView, item_text};

/// What a step's output may hold, in bytes.
const MAX_BYTES: usize = 1 << 20;

/// One line for `$GITHUB_OUTPUT`.
pub fn render(seen: &StudentView, around: &FormatContext) -> String {
    fit(MAX_BYTES, |longest| {
        let result = result(seen, around, longest).to_string();
        format!("result={}\n", STANDARD.encode(result))
    })
}

fn result(seen: &StudentView, around: &FormatContext, longest: usize) -> Value {
    let tests: Vec<Value> = seen
        .visible_items()
        .map(|(task, item)| {
            let has_all = item.points == item.max_points;
            let said = item_text::item_text(seen, item, around);
            json!({
                "name": format!("{}: {}", item.id, item.title),
                "status": if has_all { "pass" } else { "fail" },
                // Without it, the reporter's total is no number.
                "score": item.points,
                "message": if has_all { Value::Null } else { truncate(&said, longest).into() },
                "test_code": "",
                "filename": task.id.file(),
                "line_no": item.at.as_ref().map_or(0, |at| at.line),
            })
        })
        .collect();
    let status = match (
        seen.visible.complete,
        seen.visible.points == seen.visible.max_points,
    ) {
        (false, _) => "error",
        (true, true) => "pass",
        (true, false) => "fail",
    };
    json!({
        "version": 1,
        "status": status,
        "max_score": seen.visible.max_points,
        "tests": tests,
    })
}
