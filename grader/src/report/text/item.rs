//! A failing item in the terminal report.

use std::fmt::{self, Write};

use judging::sanitize::{sanitize, sanitize_line};

use super::{FAINT, HintDetail, STRONG, WIDTH, points_style};
use crate::machine::printing::{counted, wrap};
use crate::score::{Hint, ItemScore, TaskScore};

/// Writes an item and the ids of other items with the same hint.
pub(super) fn write_item(
    out: &mut String,
    item: &ItemScore,
    hints: HintDetail,
    same_hint: &[&str],
) -> fmt::Result {
    let style = points_style(item.points, item.max_points);
    let verdict = item.verdict.label();
    let gap = (WIDTH - 2).saturating_sub(item.id.chars().count() + verdict.chars().count());
    writeln!(
        out,
        "\n  {STRONG}{}{STRONG:#}{:gap$}{style}{verdict}{style:#}",
        item.id, ""
    )?;
    for line in wrap(&item.title, WIDTH - 4) {
        writeln!(out, "    {line}")?;
    }
    let hint = hint_text(&item.hints, hints, same_hint);
    let mut rows = item.rows(item.message.clone(), hint).into_iter();
    rows.try_for_each(|(label, text)| write_row(out, label, &text))
}

/// Joins the hints of an item at the requested level of detail.
pub fn joined_hints(hints: &[Hint], detail: HintDetail) -> String {
    let texts = hints.iter().map(|hint| match detail {
        HintDetail::Nudge => hint.nudge.as_str(),
        HintDetail::Full => hint.hint.as_str(),
    });
    texts.collect::<Vec<_>>().join(" Or: ")
}

/// Joins the hints of an item and adds the ids of the other items that they explain. Returns `None`
/// if there are no hints.
fn hint_text(hints: &[Hint], detail: HintDetail, same_hint: &[&str]) -> Option<String> {
    let more = match detail {
        HintDetail::Nudge => " (run with --hints for more)",
        HintDetail::Full => "",
    };
    let explained = match same_hint.len() {
        0 => String::new(),
        count => format!(
            "\nThe same mistake explains {}: {}",
            counted(count, "more item"),
            same_hint.join(", ")
        ),
    };
    let hint = joined_hints(hints, detail);
    (!hints.is_empty()).then(|| format!("{hint}{more}{explained}"))
}

/// Writes a label and its text, wrapped to the report's width, with continuation lines indented.
fn write_row(out: &mut String, label: &str, text: &str) -> fmt::Result {
    const INDENT: usize = 12;
    let mut lines = wrap(&sanitize(text, usize::MAX), WIDTH - INDENT).into_iter();
    let first = lines.next().unwrap_or_default();
    writeln!(out, "    {FAINT}{label:<7}{FAINT:#} {first}")?;
    lines.try_for_each(|line| writeln!(out, "{:INDENT$}{line}", ""))
}

/// Writes a command to run for the item.
pub(super) fn write_command(out: &mut String, label: &str, command: &str) -> fmt::Result {
    let command = sanitize_line(command, usize::MAX);
    writeln!(out, "    {FAINT}{label:<7} {command}{FAINT:#}")
}

/// Writes the number of failing items that aren't shown, after the word `intro` and followed by
/// `how`, which says how to see them.
pub(super) fn write_hidden_count(
    out: &mut String,
    intro: &str,
    count: usize,
    how: &str,
) -> fmt::Result {
    if count == 0 {
        return Ok(());
    }
    let items = counted(count, "more item");
    let how = sanitize_line(how, usize::MAX);
    writeln!(out, "    {FAINT}{intro} {items} in this task{how}{FAINT:#}")
}

/// The maximum number of compiler warnings shown for a task.
pub const MAX_WARNINGS: usize = 3;

/// If a task has a wrong or missing answer, writes the first few of the task's warnings, which may
/// explain that answer.
pub(super) fn write_warnings(out: &mut String, task: &TaskScore) -> fmt::Result {
    let mut shown = task.relevant_warnings().iter().take(MAX_WARNINGS);
    shown.try_for_each(|warning| write_row(out, "warning", warning))
}

pub(super) fn write_printed(out: &mut String, task: &TaskScore, printed: &str) -> fmt::Result {
    const MAX_PRINTED_LINES: usize = 5;
    writeln!(
        out,
        "\n  {FAINT}printed during \"{}\":{FAINT:#}",
        task.title
    )?;
    for line in printed.lines().take(MAX_PRINTED_LINES) {
        let line = sanitize_line(line, WIDTH - 5);
        writeln!(out, "  {FAINT}│{FAINT:#} {line}")?;
    }
    if printed.lines().count() > MAX_PRINTED_LINES {
        writeln!(out, "  {FAINT}`--replay` shows the rest{FAINT:#}")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hint_is_as_detailed_as_requested() {
        let hint = |name: &str| Hint {
            nudge: format!("Is it {name}?"),
            hint: format!("It is {name}."),
        };
        let hints = [hint("a"), hint("b")];
        let text = |detail| hint_text(&hints, detail, &["sphere.uv"]).unwrap();
        let more = "\nThe same mistake explains 1 more item: sphere.uv";
        let nudges = "Is it a? Or: Is it b? (run with --hints for more)";
        assert_eq!(text(HintDetail::Nudge), format!("{nudges}{more}"));
        let full = "It is a. Or: It is b.";
        assert_eq!(text(HintDetail::Full), format!("{full}{more}"));
        assert_eq!(hint_text(&[], HintDetail::Full, &[]), None);
    }
}
