//! The terminal report without colours.

use crate::format::{FormatContext, FormatSpec, StudentView};
use crate::inputs::task_selection::TaskSelection;
use crate::report::text::report;

/// The format.
pub static FORMAT: FormatSpec = FormatSpec {
    id: "text",
    file: "report.txt",
    render: Some(render),
    ..FormatSpec::EMPTY
};

/// Renders the report.
fn render(view: &StudentView, context: &FormatContext) -> String {
    let report = report(&view.visible, &TaskSelection::All, context.hints);
    let mut text = anstream::adapter::strip_str(&report).to_string();
    if let Some(counted) = view.counted_text() {
        text.push_str(&format!("  {counted}\n"));
    }
    if let Some(unfinished) = view.unfinished_notice() {
        text.push_str(&format!("  {unfinished}\n"));
    }
    text
}
