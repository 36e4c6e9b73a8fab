//! The summary on a run's page, in GitHub Flavored Markdown.

use std::fmt::{self, Write};

use crate::format::item_text::{build_report, headline, item_text};
use crate::format::size::{fit, truncate};
use crate::format::{FormatContext, StudentView};
use crate::score::{ItemScore, TaskScore};

/// The maximum size of a step's summary, in bytes.
const MAX_BYTES: usize = 1 << 20;

/// Renders the summary.
pub fn summary(view: &StudentView, context: &FormatContext) -> String {
    fit(MAX_BYTES, |max_chars| {
        let mut text = String::new();
        write_summary(&mut text, view, context, max_chars)
            .expect("writing to a string cannot fail");
        text
    })
}

fn write_summary(
    out: &mut String,
    view: &StudentView,
    context: &FormatContext,
    max_chars: usize,
) -> fmt::Result {
    writeln!(out, "## {}\n", escape_markdown(&headline(view)))?;
    if let Some(counted) = view.counted_text() {
        writeln!(out, "{}\n", escape_markdown(&counted))?;
    }
    if let Some(unfinished) = view.unfinished_notice() {
        writeln!(out, "**{}**\n", escape_markdown(&unfinished))?;
    }
    writeln!(out, "| task | points | of |\n|---|---:|---:|")?;
    for task in &view.visible.tasks {
        let TaskScore {
            title,
            points,
            max_points,
            ..
        } = task;
        writeln!(
            out,
            "| {} | {points} | {max_points} |",
            escape_markdown(title)
        )?;
    }
    for task in &view.visible.tasks {
        let lost = task
            .items
            .iter()
            .filter(|item| item.points < item.max_points);
        let lost: Vec<&ItemScore> = lost.collect();
        if lost.is_empty() {
            continue;
        }
        writeln!(out, "\n### {}\n", escape_markdown(&task.title))?;
        for item in lost {
            write_item(out, view, item, context, max_chars)?;
        }
    }
    let files = build_report(view);
    if !files.is_empty() {
        writeln!(
            out,
            "\n### Files\n\n{}",
            fence(&truncate(&files, 4 * max_chars))
        )?;
    }
    Ok(())
}

fn write_item(
    out: &mut String,
    view: &StudentView,
    item: &ItemScore,
    context: &FormatContext,
    max_chars: usize,
) -> fmt::Result {
    let (title, verdict) = (escape_markdown(&item.title), item.verdict.label());
    let (points, of) = (item.points, item.max_points);
    let text = item_text(view, item, context);
    if text.is_empty() {
        return writeln!(out, "- {title}: {verdict}, {points} of {of}");
    }
    writeln!(
        out,
        "<details><summary>{title}: {verdict}, {points} of {of}</summary>\n\n{}\n\n</details>",
        fence(&truncate(&text, max_chars))
    )
}

/// Puts text into a code block. The fence is longer than any run of backticks in the text, so that
/// no line of the text can close it.
fn fence(text: &str) -> String {
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat((longest + 1).max(3));
    format!("{fence}text\n{text}\n{fence}")
}

/// Escapes text for Markdown and puts it on one line.
fn escape_markdown(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '\n' | '\r' => escaped.push(' '),
            '\\' | '`' | '*' | '_' | '[' | ']' | '|' | '#' | '~' | '@' => {
                escaped.push('\\');
                escaped.push(c);
            }
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::{escape_markdown, fence};

    #[test]
    fn no_text_can_leave_its_block_or_cell() {
        assert_eq!(fence("a\n````\n# b"), "`````text\na\n````\n# b\n`````");
        assert_eq!(escape_markdown("a|<b>\n# c"), "a\\|&lt;b&gt; \\# c");
    }
}
