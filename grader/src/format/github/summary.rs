//! The summary on the page of a run, in GitHub's Markdown.

use std::fmt::{self, Write};

use crate::format::said::{headline, of_files, said};
use crate::format::size::{cut, within};
use crate::format::{Around, Seen};
use crate::score::{ItemScore, TaskScore};

/// What a step's summary may hold, in bytes.
const MOST: usize = 1 << 20;

/// The whole text.
pub fn summary(seen: &Seen, around: &Around) -> String {
    within(MOST, |longest| {
        let mut text = String::new();
        write_summary(&mut text, seen, around, longest).expect("text takes text");
        text
    })
}

fn write_summary(out: &mut String, seen: &Seen, around: &Around, longest: usize) -> fmt::Result {
    writeln!(out, "## {}\n", escaped(&headline(seen)))?;
    if let Some(unfinished) = seen.unfinished() {
        writeln!(out, "**{}**\n", escaped(&unfinished))?;
    }
    writeln!(out, "| task | points | of |\n|---|---:|---:|")?;
    for task in &seen.now.tasks {
        let TaskScore {
            title,
            points,
            max_points,
            ..
        } = task;
        writeln!(out, "| {} | {points} | {max_points} |", escaped(title))?;
    }
    for task in &seen.now.tasks {
        let lost = task
            .items
            .iter()
            .filter(|item| item.points < item.max_points);
        let lost: Vec<&ItemScore> = lost.collect();
        if lost.is_empty() {
            continue;
        }
        writeln!(out, "\n### {}\n", escaped(&task.title))?;
        for item in lost {
            write_item(out, seen, item, around, longest)?;
        }
    }
    let files = of_files(seen);
    if !files.is_empty() {
        writeln!(
            out,
            "\n### The files\n\n{}",
            fenced(&cut(&files, 4 * longest))
        )?;
    }
    Ok(())
}

fn write_item(
    out: &mut String,
    seen: &Seen,
    item: &ItemScore,
    around: &Around,
    longest: usize,
) -> fmt::Result {
    let (title, words) = (escaped(&item.title), item.verdict.words());
    let (points, of) = (item.points, item.max_points);
    let said = said(seen, item, around);
    if said.is_empty() {
        return writeln!(out, "- {title}: {words}, {points} of {of}");
    }
    writeln!(
        out,
        "<details><summary>{title}: {words}, {points} of {of}</summary>\n\n{}\n\n</details>",
        fenced(&cut(&said, longest))
    )
}

/// Text as it stands, in a block that no line of it can end.
fn fenced(text: &str) -> String {
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat((longest + 1).max(3));
    format!("{fence}text\n{text}\n{fence}")
}

/// Text without meaning for Markdown, in one line.
fn escaped(text: &str) -> String {
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
    use super::{escaped, fenced};

    #[test]
    fn no_text_leaves_its_block_or_its_cell() {
        assert_eq!(fenced("a\n````\n# b"), "`````text\na\n````\n# b\n`````");
        assert_eq!(escaped("a|<b>\n# c"), "a\\|&lt;b&gt; \\# c");
    }
}
