//! The summary on the page of a run, in GitHub's Markdown.

use std::fmt::{self, Write};

use crate::format::item_text::{build_report, headline, item_text};
use crate::format::size::{fit, truncate};
use crate::format::{FormatContext, StudentView};
use crate::score::{ItemScore, TaskScore};

/// What a step's summary may hold, in bytes.
const MAX_BYTES: usize = 1 << 20;

/// The whole text.
pub fn summary(seen: &StudentView, around: &FormatContext) -> String {
    fit(MAX_BYTES, |longest| {
        let mut text = String::new();
        write_summary(&mut text, seen, around, longest).expect("text takes text");
        text
    })
}

fn write_summary(
    out: &mut String,
    seen: &StudentView,
    around: &FormatContext,
    longest: usize,
) -> fmt::Result {
    writeln!(out, "## {}\n", escape_markdown(&headline(seen)))?;
    if let Some(unfinished) = seen.unfinished_notice() {
        writeln!(out, "**{}**\n", escape_markdown(&unfinished))?;
    }
    writeln!(out, "| task | points | of |\n|---|---:|---:|")?;
    for task in &seen.visible.tasks {
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
    for task in &seen.visible.tasks {
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
            write_item(out, seen, item, around, longest)?;
        }
    }
    let files = build_report(seen);
    if !files.is_empty() {
        writeln!(
            out,
            "\n### The files\n\n{}",
            fence(&truncate(&files, 4 * longest))
        )?;
    }
    Ok(())
}

fn write_item(
    out: &mut String,
    seen: &StudentView,
    item: &ItemScore,
    around: &FormatContext,
    longest: usize,
) -> fmt::Result {
    let (title, words) = (escape_markdown(&item.title), item.verdict.label());
    let (points, of) = (item.points, item.max_points);
    let text = item_text(seen, item, around);
    if text.is_empty() {
        return writeln!(out, "- {title}: {words}, {points} of {of}");
    }
    writeln!(
        out,
        "<details><summary>{title}: {words}, {points} of {of}</summary>\n\n{}\n\n</details>",
        fence(&truncate(&text, longest))
    )
}

/// Text as it stands, in a block that no line of it can end.
fn fence(text: &str) -> String {
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat((longest + 1).max(3));
    format!("{fence}text\n{text}\n{fence}")
}

/// Text without meaning for Markdown, in one line.
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
