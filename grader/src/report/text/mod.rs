//! The terminal report, for students, 80 columns wide.

use std::fmt::{self, Write};

use anstyle::{AnsiColor, Style};
use judging::sanitize::{sanitize, sanitize_line};
use judging::section::Section;

use crate::report::shared_hints::{explained_items, with_something_new};
use crate::sandbox::Isolation;
use crate::score::{Hint, ItemScore, Score, TaskScore, Verdict};
use crate::task_selection::TaskSelection;

const WIDTH: usize = 80;
const BAR_WIDTH: usize = 20;
/// The maximum number of lines of a compiler message to show.
const MAX_COMPILER_LINES: usize = 20;

const STRONG: Style = Style::new().bold();
const FAINT: Style = Style::new().dimmed();
const GOOD: Style = AnsiColor::Green.on_default();
const PART: Style = AnsiColor::Yellow.on_default();
const BAD: Style = AnsiColor::Red.on_default();

/// The level of detail of a hint about a recognised mistake.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HintDetail {
    /// A question that points toward the mistake.
    #[default]
    Nudge,
    /// A description of the mistake.
    Full,
}

/// Renders the report on the selected tasks with ANSI colours, which the output stream strips if
/// necessary.
pub fn report(score: &Score, tasks: &TaskSelection, hints: HintDetail) -> String {
    let mut text = String::new();
    write_report(&mut text, score, tasks, hints).expect("writing to a string cannot fail");
    text
}

fn write_report(
    out: &mut String,
    score: &Score,
    selection: &TaskSelection,
    hints: HintDetail,
) -> fmt::Result {
    let shown = |task: &&TaskScore| selection.includes(task.id);
    let tasks: Vec<&TaskScore> = score.tasks.iter().filter(shown).collect();

    writeln!(out)?;
    if selection.is_all() {
        write_headline(out, score)?;
    }
    for task in &tasks {
        write_task_line(out, task)?;
    }
    // Single-line messages are omitted here, because the items of the task show them.
    let compiler_messages = score
        .build
        .not_compiled
        .iter()
        .filter(|file| file.message.contains('\n'));
    for file in compiler_messages {
        write_compiler_message(out, &file.message)?;
    }
    for task in &tasks {
        let failing = task.items.iter();
        let failing: Vec<&ItemScore> = failing
            .filter(|item| item.points < item.max_points)
            .collect();
        // The first failing item of each task is enough to start with. A report on selected tasks
        // also has the other items that have evidence, and tells more than the first.
        let shown = if selection.is_all() {
            failing.iter().take(1).copied().collect()
        } else {
            with_something_new(&failing)
        };
        let mut explained = 0;
        for item in &shown {
            let same_hint = explained_items(item, &failing);
            explained += same_hint.len();
            write_item(out, item, hints, &same_hint)?;
            write_command(out, "again", &item.rerun_command(&score.rerun_command))?;
            if let Some(view) = item.view_command(&score.rerun_command) {
                write_command(out, "view", &view)?;
            }
        }
        let others = failing.len() - shown.len() - explained;
        let how = if selection.is_all() {
            format!(": {}", score.rerun_command.task(task.id.id()))
        } else {
            String::new()
        };
        write_hidden_count(out, others, &how)?;
        if let Some(printed) = &task.printed {
            write_printed(out, task, printed)?;
        }
    }
    for note in &score.build.notes {
        let note = sanitize_line(note, usize::MAX);
        writeln!(out, "\n{FAINT}  note: {note}{FAINT:#}")?;
    }
    writeln!(out)
}

fn write_headline(out: &mut String, score: &Score) -> fmt::Result {
    let title = format!("  {}, {} exam", score.submission, score.exam.id);
    let title = sanitize_line(&title, usize::MAX);
    let points = format!("{} / {}", score.points, score.max_points);
    let gap = WIDTH.saturating_sub(2 + title.chars().count() + points.len());
    writeln!(out, "{STRONG}{title}{:gap$}{points}{STRONG:#}\n", "")?;
    // Students who grade their own work need no isolation.
    if score.isolation > Isolation::None {
        writeln!(out, "{FAINT}  isolation: {}{FAINT:#}\n", score.isolation)?;
    }
    Ok(())
}

fn write_task_line(out: &mut String, task: &TaskScore) -> fmt::Result {
    let style = points_style(task.points, task.max_points);
    let filled = (BAR_WIDTH as u32 * task.points) / task.max_points.max(1);
    let bar: String = (0..BAR_WIDTH as u32)
        .map(|i| if i < filled { '█' } else { '·' })
        .collect();
    let (passed, all) = (passed_count(task), task.items.len());
    writeln!(
        out,
        "  {:24} {style}{bar}{style:#}  {:>3} / {:<3} {FAINT}{passed:>5} of {all} passed{FAINT:#}",
        task.title, task.points, task.max_points,
    )
}

fn passed_count(task: &TaskScore) -> usize {
    let passed = |item: &&ItemScore| item.verdict == Verdict::Pass;
    task.items.iter().filter(passed).count()
}

fn points_style(points: u32, max_points: u32) -> Style {
    match points {
        0 => BAD,
        _ if points == max_points => GOOD,
        _ => PART,
    }
}

fn write_compiler_message(out: &mut String, message: &str) -> fmt::Result {
    writeln!(out)?;
    let message = sanitize(message, usize::MAX);
    for line in message.lines().take(MAX_COMPILER_LINES) {
        writeln!(out, "  {BAD}│{BAD:#} {line}")?;
    }
    if message.lines().count() > MAX_COMPILER_LINES {
        writeln!(out, "  {BAD}│{BAD:#} …")?;
    }
    Ok(())
}

/// Writes an item and the ids of other items with the same hint.
fn write_item(
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
    let section = item.section.as_ref().map(Section::location);
    let rows = [
        ("what", Some(&item.message)),
        (
            "asked",
            item.evidence.as_ref().map(|evidence| &evidence.asked),
        ),
        ("got", item.evidence.as_ref().map(|evidence| &evidence.got)),
        (
            "wanted",
            item.evidence.as_ref().map(|evidence| &evidence.wanted),
        ),
        ("look", item.look.as_ref()),
        ("hint", hint.as_ref()),
        ("read", section.as_ref()),
    ];
    for (label, text) in rows {
        if let Some(text) = text.filter(|text| !text.is_empty()) {
            write_row(out, label, text)?;
        }
    }
    Ok(())
}

/// Joins the hints of an item, and names the other items that they explain. Returns `None` if there
/// are none.
fn hint_text(hints: &[Hint], detail: HintDetail, same_hint: &[&str]) -> Option<String> {
    let text = |hint: &Hint| match detail {
        HintDetail::Nudge => hint.nudge.clone(),
        HintDetail::Full => hint.hint.clone(),
    };
    let all: Vec<String> = hints.iter().map(text).collect();
    let more = match detail {
        HintDetail::Nudge => " (run with --hints for more)",
        HintDetail::Full => "",
    };
    let explained = match same_hint.len() {
        0 => String::new(),
        1 => format!("\nThe same mistake explains 1 more item: {}", same_hint[0]),
        count => format!(
            "\nThe same mistake explains {count} more items: {}",
            same_hint.join(", ")
        ),
    };
    (!all.is_empty()).then(|| format!("{}{more}{explained}", all.join(" Or: ")))
}

/// Writes a label and its text, wrapped to the width, with later lines indented.
fn write_row(out: &mut String, label: &str, text: &str) -> fmt::Result {
    const INDENT: usize = 12;
    let mut lines = wrap(&sanitize(text, usize::MAX), WIDTH - INDENT).into_iter();
    let first = lines.next().unwrap_or_default();
    writeln!(out, "    {FAINT}{label:<7}{FAINT:#} {first}")?;
    lines.try_for_each(|line| writeln!(out, "{:INDENT$}{line}", ""))
}

fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines = Vec::new();
    for paragraph in text.lines() {
        let mut line = String::new();
        for word in paragraph.split_whitespace() {
            let fits = line.chars().count() + 1 + word.chars().count() <= width;
            if !line.is_empty() && !fits {
                lines.push(std::mem::take(&mut line));
            }
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
        lines.push(line);
    }
    lines
}

/// Writes a command about the item.
fn write_command(out: &mut String, label: &str, command: &str) -> fmt::Result {
    let command = sanitize_line(command, usize::MAX);
    writeln!(out, "    {FAINT}{label:<7} {command}{FAINT:#}")
}

/// Writes the number of failing items that are not shown, and `how` to see them.
fn write_hidden_count(out: &mut String, count: usize, how: &str) -> fmt::Result {
    let items = match count {
        0 => return Ok(()),
        1 => "item",
        _ => "items",
    };
    let how = sanitize_line(how, usize::MAX);
    writeln!(
        out,
        "    {FAINT}and {count} more {items} of this task{how}{FAINT:#}"
    )
}

fn write_printed(out: &mut String, task: &TaskScore, printed: &str) -> fmt::Result {
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
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::wrap;

    #[test]
    fn wraps_between_words() {
        assert_eq!(wrap("one two three", 7), ["one two", "three"]);
        assert_eq!(wrap("a\nlonger-than-that", 4), ["a", "longer-than-that"]);
    }
}
