//! Gradescope's `results.json`
//! (<https://gradescope-autograders.readthedocs.io/en/latest/specs/>, "Output Format").
//!
//! Gradescope applies a test's `visibility` itself, and hides the total while a test is hidden.
//! Therefore, this format also lists hidden items one by one.

use serde_json::{Value, json};

use crate::format::FormatSpec;
use crate::format::item_text::{build_report, headline, item_text};
use crate::format::size::{fit, truncate};
use crate::format::{FormatContext, ItemView, StudentView};
use crate::policy::Visibility;
use crate::score::{Verdict, VerdictKind};

/// The format.
pub static FORMAT: FormatSpec = FormatSpec {
    id: "gradescope",
    file: "gradescope.json",
    render: Some(render),
    ..FormatSpec::EMPTY
};

/// The maximum size in bytes. Gradescope doesn't document a limit, but similar platforms truncate
/// files at half this size.
const MAX_BYTES: usize = 256 << 10;

/// Renders `results.json`.
fn render(view: &StudentView, context: &FormatContext) -> String {
    fit(MAX_BYTES, |max_chars| {
        super::to_json(&results(view, context, max_chars))
    })
}

fn results(view: &StudentView, context: &FormatContext, max_chars: usize) -> Value {
    let score = &view.visible;
    let tests = score.tasks.iter().zip(1..).flat_map(|(task, number)| {
        let entries = view.all_items.iter().filter(|entry| entry.task == task.id);
        entries.zip(1..).map(move |(entry, position)| {
            let number = format!("{number}.{position}");
            test(view, entry, number, context, max_chars)
        })
    });
    let tests = tests.chain(counted_test(view, score.tasks.len() + 1));
    let mut results = json!({
        "score": view.counted.points,
        "output": truncate(&output(view), 4 * max_chars),
        "output_format": "text",
        "test_output_format": "text",
        "test_name_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "extra_data": {
            "exam": score.exam.id,
            "isolation": score.isolation,
            "complete": score.complete,
            "points": score.points,
            "max_points": score.max_points,
        },
        "tests": tests.collect::<Vec<_>>(),
    });
    if let Some(milliseconds) = view.milliseconds() {
        results["execution_time"] = (milliseconds as f64 / 1000.0).into();
    }
    results
}

/// Returns the text shown above the tests. It omits the total if some items are hidden, since the
/// total includes their points.
fn output(view: &StudentView) -> String {
    let all_shown = view
        .all_items
        .iter()
        .all(|entry| entry.visibility.is_shown_now());
    let (points, counted) = if all_shown {
        (headline(view), view.counted_text())
    } else {
        let not_all = "Some items are not shown yet.".to_owned();
        (not_all, view.counted.rules())
    };
    let parts = [
        view.unfinished_notice(),
        Some(points),
        counted,
        Some(build_report(view)),
    ];
    let parts = parts.into_iter().flatten().filter(|part| !part.is_empty());
    parts.collect::<Vec<_>>().join("\n\n")
}

/// Returns a test that is worth no points and explains the total. Such a test is needed if the
/// total includes hidden items: when Gradescope shows students the total, they should also see how
/// it was calculated.
fn counted_test(view: &StudentView, number: usize) -> Option<Value> {
    let items = view.all_items.iter().map(|entry| entry.visibility);
    let hidden: Vec<Visibility> = items.filter(|shown| !shown.is_shown_now()).collect();
    let is_only_late = hidden.iter().all(|shown| *shown == Visibility::AfterDue);
    let visibility = visibility(if is_only_late {
        Visibility::AfterDue
    } else {
        Visibility::AfterPublished
    });
    let text = view.counted_text().filter(|_| !hidden.is_empty())?;
    Some(json!({
        "name": "What counts towards the grade",
        "name_format": "text",
        "number": number.to_string(),
        "output": text,
        "output_format": "text",
        "tags": [],
        "visibility": visibility,
        "extra_data": {},
    }))
}

fn test(
    view: &StudentView,
    entry: &ItemView,
    number: String,
    context: &FormatContext,
    max_chars: usize,
) -> Value {
    let item = &entry.item;
    let verdict = serde_json::to_value(&item.verdict).expect("a verdict is text");
    let mut test = json!({
        "name": item.title,
        "name_format": "text",
        "number": number,
        "score": item.points,
        "max_score": item.max_points,
        "output": truncate(&item_text(view, item, context), max_chars),
        "output_format": "text",
        "tags": [entry.task],
        "visibility": visibility(entry.visibility),
        "extra_data": { "id": item.id, "verdict": verdict["verdict"] },
    });
    if let Some(status) = status(&item.verdict) {
        test["status"] = status.into();
    }
    test
}

/// Returns Gradescope's status, or `None` for an item that isn't graded yet.
fn status(verdict: &Verdict) -> Option<&'static str> {
    match verdict.kind() {
        VerdictKind::Passed => Some("passed"),
        VerdictKind::Pending => None,
        VerdictKind::Failed
        | VerdictKind::Unwritten
        | VerdictKind::NoAnswer
        | VerdictKind::NotCompiled
        | VerdictKind::Blocked => Some("failed"),
    }
}

fn visibility(visibility: Visibility) -> &'static str {
    match visibility {
        Visibility::All | Visibility::Feedback | Visibility::Points => "visible",
        Visibility::AfterDue => "after_due_date",
        Visibility::AfterPublished => "after_published",
        Visibility::Hidden => "hidden",
    }
}
