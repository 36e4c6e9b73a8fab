//! PrairieLearn's `/grade/results/results.json`
//! (<https://prairielearn.readthedocs.io/en/latest/externalGrading/>, "Grading results").
//!
//! Where nothing compiles the attempt is not gradable, and costs the student no attempt.

use serde_json::{Value, json};

use crate::format::item_text::{build_report, headline, item_message, item_text};
use crate::format::size::{fit, truncate};
use crate::format::{FormatContext, StudentView};

/// What PrairieLearn takes, in bytes, with room to spare.
const MAX_BYTES: usize = 1_000_000;

/// The whole file.
pub fn render(seen: &StudentView, around: &FormatContext) -> String {
    fit(MAX_BYTES, |longest| {
        super::to_json(&results(seen, around, longest))
    })
}

fn results(seen: &StudentView, around: &FormatContext, longest: usize) -> Value {
    let said_of_files = truncate(&build_report(seen), 4 * longest);
    let counted = seen.counted;
    if seen.nothing_compiled() {
        return json!({ "gradable": false, "score": 0.0, "format_errors": [said_of_files] });
    }
    let tests: Vec<Value> = seen
        .visible_items()
        .map(|(task, item)| {
            json!({
                "name": item.title,
                "description": task.title,
                "points": item.points,
                "max_points": item.max_points,
                "message": truncate(&item_message(item), longest),
                "output": truncate(&item_text(seen, item, around), longest),
            })
        })
        .collect();
    let message = seen.unfinished_notice().unwrap_or_else(|| headline(seen));
    json!({
        "gradable": true,
        "score": f64::from(counted.points) / f64::from(counted.max_points.max(1)),
        "message": message,
        "output": said_of_files,
        "tests": tests,
    })
}
