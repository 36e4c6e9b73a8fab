//! The terminal report for students, which is 80 columns wide.

mod item;
mod short_table;

use std::collections::BTreeSet;
use std::fmt::{self, Write};

use anstream::adapter::strip_str;
use anstyle::{AnsiColor, Style};
use judging::assignment::Task;
use judging::sanitize::{sanitize, sanitize_line};

use crate::inputs::task_selection::TaskSelection;
use crate::report::failing_items::{explained_items, most_informative_first, most_new};
use crate::report::text::item::{
    write_command, write_hidden_count, write_item, write_printed, write_warnings,
};
use crate::sandbox::Isolation;
use crate::score::{ItemScore, Score, TaskScore, Verdict, VerdictKind};

pub use item::{MAX_WARNINGS, joined_hints};
pub use short_table::short_table;

const WIDTH: usize = 80;
const BAR_WIDTH: usize = 20;
/// The maximum number of lines of a compiler error to show.
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

/// Results that a report still shows although they are for an earlier version of the submission.
#[derive(Clone, Copy, Debug, Default)]
pub struct OldResults<'a> {
    /// The ids of the items that haven't been graded again.
    pub items: Option<&'a BTreeSet<String>>,
    /// Whether the compiler's messages are old because the submission hasn't been compiled again.
    pub build: bool,
}

impl OldResults<'_> {
    fn includes(&self, item: &ItemScore) -> bool {
        self.items.is_some_and(|old| old.contains(&item.id))
    }
}

/// The order of the failing items in a report on selected tasks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ItemOrder {
    /// The item to begin with comes first, at the top of a screen that may be cut off below.
    FirstOnTop,
    /// The item to begin with comes last, next to the prompt.
    FirstAtPrompt,
}

/// A report in parts, so that they can be rearranged on a small terminal.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReportParts {
    /// The name of the submission and its points. Empty if only some tasks are graded.
    pub headline: String,
    /// One line for each task.
    pub table: String,
    /// The compiler's errors and notes, and each task's failing items. Each part is preceded by an
    /// empty line.
    pub details: Vec<Detail>,
}

/// A part of a report that follows its table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Detail {
    /// The task that the part is about, if any.
    pub task: Option<Task>,
    /// The text, with an empty line before each item.
    pub text: String,
}

impl ReportParts {
    /// Returns the text below the table.
    pub fn details_text(&self) -> String {
        self.details
            .iter()
            .map(|detail| detail.text.as_str())
            .collect()
    }
}

/// Renders the report on the selected tasks, with ANSI colours. The output stream strips the
/// colours if necessary.
pub fn report(score: &Score, tasks: &TaskSelection, hints: HintDetail) -> String {
    let order = ItemOrder::FirstAtPrompt;
    let parts = report_parts(score, tasks, hints, OldResults::default(), order);
    let details = parts.details_text();
    let no_hint = no_hint(score, tasks, hints);
    format!("\n{}{}{details}{no_hint}\n", parts.headline, parts.table)
}

/// Returns a line to print if detailed hints are requested and answers are wrong, but not as those
/// of a known mistake.
fn no_hint(score: &Score, selection: &TaskSelection, hints: HintDetail) -> &'static str {
    let tasks = score
        .tasks
        .iter()
        .filter(|task| selection.includes(task.id));
    let items = || tasks.clone().flat_map(|task| &task.items);
    let is_wrong = items().any(|item| item.verdict.kind() == VerdictKind::Failed);
    let has_hint = items().any(|item| !item.hints.is_empty());
    if hints == HintDetail::Full && is_wrong && !has_hint {
        "\n  --hints: no known mistake explains all of these answers\n"
    } else {
        ""
    }
}

/// Renders the parts of the report. Old results are grey.
pub fn report_parts(
    score: &Score,
    tasks: &TaskSelection,
    hints: HintDetail,
    old: OldResults,
    order: ItemOrder,
) -> ReportParts {
    let mut parts = ReportParts::default();
    write_parts(&mut parts, score, tasks, hints, old, order)
        .expect("writing to a string cannot fail");
    parts
}

fn write_parts(
    parts: &mut ReportParts,
    score: &Score,
    selection: &TaskSelection,
    hints: HintDetail,
    old: OldResults,
    order: ItemOrder,
) -> fmt::Result {
    let shown = |task: &&TaskScore| selection.includes(task.id);
    let mut tasks: Vec<&TaskScore> = score.tasks.iter().filter(shown).collect();

    let is_old = |task: &TaskScore| task.items.iter().any(|item| old.includes(item));
    if selection.is_all() {
        write_headline(&mut parts.headline, score)?;
        grey_if(tasks.iter().any(|task| is_old(task)), &mut parts.headline);
    }
    for task in &tasks {
        let mut line = String::new();
        write_task_line(&mut line, task)?;
        grey_if(is_old(task), &mut line);
        parts.table.push_str(&line);
    }
    let out = &mut String::new();
    // Omit single-line messages here, because the task's items show them.
    let compiler_messages = score
        .build
        .not_compiled
        .iter()
        .filter(|file| file.message.contains('\n'));
    for file in compiler_messages {
        write_compiler_message(out, &file.message)?;
    }
    // Show notes before the items, because a note can explain why they fail.
    for note in score.build.all_notes() {
        let note = sanitize_line(note, usize::MAX);
        writeln!(out, "\n  note: {note}")?;
    }
    grey_if(old.build, out);
    parts.details.push(Detail {
        task: None,
        text: std::mem::take(out),
    });
    let is_failing = |task: &&&TaskScore| task.points < task.max_points;
    let most = match tasks.iter().filter(is_failing).count() {
        1 if !selection.is_all() => 2,
        _ => 1,
    };
    let is_reversed = !selection.is_all() && order == ItemOrder::FirstAtPrompt;
    if is_reversed {
        tasks.reverse();
    }
    for task in &tasks {
        let mut shown = most_new(task, most);
        if is_reversed {
            shown.reverse();
        }
        let mut text = String::new();
        let how = if selection.is_all() {
            format!(": {}", score.rerun_command.task(task.id.id()))
        } else {
            String::new()
        };
        let others = Others {
            how: &how,
            come_first: is_reversed,
        };
        write_failing_items(&mut text, task, &shown, score, others, hints)?;
        grey_if(is_old(task), &mut text);
        parts.details.push(Detail {
            task: Some(task.id),
            text,
        });
    }
    Ok(())
}

/// The line about a task's failing items that aren't shown.
#[derive(Clone, Copy)]
struct Others<'a> {
    /// The end of the line, which says how to see these items.
    how: &'a str,
    /// Whether the line comes before the items that are shown.
    come_first: bool,
}

/// Writes these failing items of a task, and the number of its other failing items.
fn write_failing_items(
    out: &mut String,
    task: &TaskScore,
    shown: &[&ItemScore],
    score: &Score,
    others: Others,
    hints: HintDetail,
) -> fmt::Result {
    let failing = most_informative_first(task);
    let explained: usize = shown
        .iter()
        .map(|item| explained_items(item, &failing).len())
        .sum();
    let count = failing.len() - shown.len() - explained;
    let hidden = failing
        .iter()
        .filter(|item| shown.iter().all(|other| other.id != item.id));
    let how = format!("{}{}", waiting(hidden.copied()), others.how);
    if others.come_first && count > 0 {
        writeln!(out)?;
        write_hidden_count(out, "not listed:", count, &how)?;
    }
    for item in shown {
        write_item(out, item, hints, &explained_items(item, &failing))?;
        write_command(out, "again", &item.rerun_command(&score.rerun_command))?;
        if let Some(view) = item.view_command(&score.rerun_command) {
            write_command(out, "view", &view)?;
        }
    }
    if !others.come_first {
        write_hidden_count(out, "and", count, &how)?;
    }
    write_warnings(out, task)?;
    match &task.printed {
        Some(printed) => write_printed(out, task, printed),
        None => Ok(()),
    }
}

/// Returns the end of a sentence that says how many of these items are waiting for an item of
/// another task.
fn waiting<'a>(items: impl Iterator<Item = &'a ItemScore>) -> String {
    let blockers = items.map(|item| {
        let Verdict::Blocked { by } = &item.verdict else {
            return None;
        };
        Some(by.as_str())
    });
    let blockers: Vec<Option<&str>> = blockers.collect();
    let names: BTreeSet<&str> = blockers.iter().copied().flatten().collect();
    let names = names.into_iter().collect::<Vec<_>>().join(" and ");
    match blockers.iter().flatten().count() {
        0 => String::new(),
        1 if blockers.len() == 1 => format!(", waiting for {names}"),
        count if count == blockers.len() => format!(", all waiting for {names}"),
        count => format!(", {count} of them waiting for {names}"),
    }
}

/// Greys out all lines if they are old.
fn grey_if(is_old: bool, text: &mut String) {
    if is_old {
        let lines = strip_str(text).to_string();
        let lines = lines
            .lines()
            .map(|line| format!("{FAINT}{line}{FAINT:#}\n"));
        *text = lines.collect();
    }
}

fn write_headline(out: &mut String, score: &Score) -> fmt::Result {
    let version = score.bundle.as_ref();
    let version = version.map_or(String::new(), |version| format!(", version {version}"));
    let title = format!("  {}, {} exam{version}", score.submission, score.exam.id);
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
    // The errors in the file, with empty lines between them.
    for (number, error) in message.split("\n\n").enumerate() {
        if number > 0 {
            writeln!(out, "  {BAD}│{BAD:#}")?;
        }
        for line in error.lines().take(MAX_COMPILER_LINES) {
            writeln!(out, "  {BAD}│{BAD:#} {line}")?;
        }
        if error.lines().count() > MAX_COMPILER_LINES {
            writeln!(out, "  {BAD}│{BAD:#} …")?;
        }
    }
    Ok(())
}
