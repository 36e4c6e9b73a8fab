//! PrairieLearn's `/grade/results/results.json`
//! (<https://prairielearn.readthedocs.io/en/latest/externalGrading/>, "Grading results").
//!
//! If no file compiles, the submission is marked as not gradable, so that it doesn't cost the
//! student an attempt.

use serde_json::{Value, json};

use crate::format::item_text::{build_report, headline_with_counted, item_message, item_text};
use crate::format::size::{fit, truncate};
use crate::format::{FormatContext, FormatSpec, StudentView};

/// The format.
pub static FORMAT: FormatSpec = FormatSpec {
    id: "prairielearn",
    file: "prairielearn.json",
    render: Some(render),
    ..FormatSpec::EMPTY
};

/// The maximum size of `results.json`, in bytes. It is well below PrairieLearn's own limit.
const MAX_BYTES: usize = 1_000_000;

/// Renders `results.json`.
fn render(view: &StudentView, context: &FormatContext) -> String {
    fit(MAX_BYTES, |max_chars| {
        super::to_json(&results(view, context, max_chars))
    })
}

fn results(view: &StudentView, context: &FormatContext, max_chars: usize) -> Value {
    let build_text = truncate(&build_report(view), 4 * max_chars);
    let counted = &view.counted;
    if view.nothing_compiled() {
        return json!({ "gradable": false, "score": 0.0, "format_errors": [build_text] });
    }
    let tests: Vec<Value> = view
        .visible_items()
        .map(|(task, item)| {
            json!({
                "name": item.title,
                "description": task.title,
                "points": item.points,
                "max_points": item.max_points,
                "message": truncate(&item_message(item), max_chars),
                "output": truncate(&item_text(view, item, context), max_chars),
            })
        })
        .collect();
    let message = view
        .unfinished_notice()
        .unwrap_or_else(|| headline_with_counted(view));
    json!({
        "gradable": true,
        "score": f64::from(counted.points) / f64::from(counted.max_points.max(1)),
        "message": message,
        "output": build_text,
        "tests": tests,
    })
}
