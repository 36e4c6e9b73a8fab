//! A page for students, which doesn't contain the exam.

use crate::format::{FormatContext, FormatSpec, StudentView};
use crate::report::html::{feedback, with_counted, with_next_step};

/// The format.
pub static FORMAT: FormatSpec = FormatSpec {
    id: "html",
    file: "feedback.html",
    render: Some(render),
    ..FormatSpec::EMPTY
};

/// Renders the page.
pub fn render(view: &StudentView, _: &FormatContext) -> String {
    let page = with_next_step(&feedback(&view.visible), &view.failing);
    with_counted(&page, view.counted_text().as_slice())
}
