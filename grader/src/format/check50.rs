//! check50's JSON
//! (<https://cs50.readthedocs.io/projects/check50/en/latest/json_specification.html>).
//!
//! `passed` is true, false or null. Null means that a check didn't run or didn't finish.

use serde_json::{Value, json};

use crate::format::item_text::{item_message, item_text};
use crate::format::{FormatContext, FormatSpec, StudentView};
use crate::score::{ItemScore, Verdict, VerdictKind};

/// The format.
pub static FORMAT: FormatSpec = FormatSpec {
    id: "check50",
    file: "check50.json",
    render: Some(render),
    ..FormatSpec::EMPTY
};

/// Renders the JSON file.
fn render(view: &StudentView, context: &FormatContext) -> String {
    let results: Vec<Value> = view
        .visible_items()
        .map(|(_, item)| result(view, item, context))
        .chain(view.counted_text().map(counted_result))
        .collect();
    super::to_json(&json!({
        "slug": format!("pathtracing/{}", view.visible.exam.id),
        "results": results,
        "version": env!("CARGO_PKG_VERSION"),
    }))
}

fn result(view: &StudentView, item: &ItemScore, context: &FormatContext) -> Value {
    let passed = passed(&item.verdict);
    let rationale = match item_message(item) {
        nothing if nothing.is_empty() => item.verdict.label().to_owned(),
        message => message,
    };
    let help = item_text(view, item, context);
    let help = help.split_once('\n').map(|(_, help)| help);
    let cause = match passed {
        Some(true) => Value::Null,
        Some(false) | None => json!({ "rationale": rationale, "help": help }),
    };
    // A dependency must be the name of another result, but hidden items have no result.
    let dependency = if let Verdict::Blocked { by } = &item.verdict {
        let mut items = view.visible_items();
        items.any(|(_, item)| item.id == *by).then_some(by)
    } else {
        None
    };
    json!({
        "name": item.id,
        "description": item.title,
        "passed": passed,
        "log": [],
        "cause": cause,
        "data": { "points": item.points, "max_points": item.max_points },
        "dependency": dependency,
    })
}

/// Returns a check that explains the grade. The format doesn't provide another place for such an
/// explanation.
fn counted_result(text: String) -> Value {
    json!({
        "name": "counted",
        "description": text,
        "passed": true,
        "log": [],
        "cause": Value::Null,
        "data": {},
        "dependency": Value::Null,
    })
}

fn passed(verdict: &Verdict) -> Option<bool> {
    match verdict.kind() {
        VerdictKind::Passed => Some(true),
        VerdictKind::Failed | VerdictKind::Unwritten => Some(false),
        VerdictKind::NoAnswer
        | VerdictKind::NotCompiled
        | VerdictKind::Blocked
        | VerdictKind::Pending => None,
    }
}
