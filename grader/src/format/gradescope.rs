//! Gradescope's `results.json`
//! (<https://gradescope-autograders.readthedocs.io/en/latest/specs/>, "Output Format").
//!
//! A test's `visibility` hides it and, if it is hidden now, the total as well: that is Gradescope's
//! own rule, and why hidden items stand here one by one.

use serde_json::{Map, Value, json};

use crate::exam::Task;
use crate::format::item_text::{build_report, headline, item_text};
use crate::format::size::{fit, truncate};
use crate::format::{FormatContext, ItemView, StudentView};
use crate::policy::Visibility;
use crate::score::Verdict;

/// Gradescope publishes no limit; its neighbours begin to cut at half of this, in bytes.
const MAX_BYTES: usize = 256 << 10;

/// The whole file.
pub fn render(seen: &StudentView, around: &FormatContext) -> String {
    fit(MAX_BYTES, |longest| {
        super::to_json(&results(seen, around, longest))
    })
}

fn results(seen: &StudentView, around: &FormatContext, longest: usize) -> Value {
    let score = &seen.visible;
    let milliseconds = score.timings.build_ms + score.timings.exam_ms;
    let tests = Task::ALL.iter().zip(1..).flat_map(|(task, number)| {
        let lines = seen.all_items.iter().filter(|line| line.task == *task);
        lines.zip(1..).map(move |(line, place)| {
            let number = format!("{number}.{place}");
            test(seen, line, number, around, longest)
        })
    });
    json!({
        "score": seen.counted.points,
        "execution_time": milliseconds as f64 / 1000.0,
        "output": truncate(&output(seen), 4 * longest),
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
    })
}

/// What stands above all tests. A total that hidden items are part of is not for here.
fn output(seen: &StudentView) -> String {
    let all_shown = seen
        .all_items
        .iter()
        .all(|line| line.visibility.is_shown_now());
    let points = all_shown.then(|| headline(seen));
    let not_all = (!all_shown).then(|| "Some items are not shown yet.".to_owned());
    let parts = [
        seen.unfinished_notice(),
        points,
        not_all,
        Some(build_report(seen)),
    ];
    let parts = parts.into_iter().flatten().filter(|part| !part.is_empty());
    parts.collect::<Vec<_>>().join("\n\n")
}

fn test(
    seen: &StudentView,
    line: &ItemView,
    number: String,
    around: &FormatContext,
    longest: usize,
) -> Value {
    let item = &line.item;
    let mut test = Map::new();
    test.insert("name".into(), item.title.clone().into());
    test.insert("name_format".into(), "text".into());
    test.insert("number".into(), number.into());
    test.insert("score".into(), item.points.into());
    test.insert("max_score".into(), item.max_points.into());
    if let Some(status) = status(&item.verdict) {
        test.insert("status".into(), status.into());
    }
    test.insert(
        "output".into(),
        truncate(&item_text(seen, item, around), longest).into(),
    );
    test.insert("output_format".into(), "text".into());
    test.insert("tags".into(), json!([line.task]));
    test.insert("visibility".into(), visibility(line.visibility).into());
    let verdict = serde_json::to_value(&item.verdict).expect("a verdict is text");
    test.insert(
        "extra_data".into(),
        json!({ "id": item.id, "verdict": verdict["verdict"] }),
    );
    Value::Object(test)
}

/// None for what is not known yet: a test may have none.
fn status(verdict: &Verdict) -> Option<&'static str> {
    match verdict {
        Verdict::Pass => Some("passed"),
        Verdict::Pending => None,
        Verdict::Partial
        | Verdict::Wrong
        | Verdict::Panicked
        | Verdict::Unimplemented
        | Verdict::TimedOut
        | Verdict::OutOfMemory
        | Verdict::Crashed
        | Verdict::Protocol
        | Verdict::NotCompiled
        | Verdict::Blocked { .. } => Some("failed"),
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
