//! The report on a terminal: for a student, at 80 columns.

use std::fmt::{self, Write};

use anstyle::{AnsiColor, Style};

use crate::exam::Task;
use crate::sandbox::Isolation;
use crate::score::{Hint, ItemScore, Score, TaskScore, Verdict};
use crate::section::Section;
use crate::tame::tame;

const WIDTH: usize = 80;
const BAR: usize = 20;
/// The most lines that are shown of a compiler's message.
const COMPILER_LINES: usize = 20;

const STRONG: Style = Style::new().bold();
const FAINT: Style = Style::new().dimmed();
const GOOD: Style = AnsiColor::Green.on_default();
const PART: Style = AnsiColor::Yellow.on_default();
const BAD: Style = AnsiColor::Red.on_default();

/// How much is said of a mistake that is recognised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hints {
    /// A question that leads there.
    Nudge,
    /// What is wrong.
    Full,
}

/// The whole report, with colours: the stream that takes it drops them where they do not belong.
/// With `only`, that task alone.
pub fn report(score: &Score, only: Option<Task>, hints: Hints) -> String {
    let mut text = String::new();
    write_report(&mut text, score, only, hints).expect("text takes text");
    text
}

fn write_report(out: &mut String, score: &Score, only: Option<Task>, hints: Hints) -> fmt::Result {
    let shown = |task: &&TaskScore| only.is_none_or(|only| only == task.id);
    let tasks: Vec<&TaskScore> = score.tasks.iter().filter(shown).collect();

    writeln!(out)?;
    if only.is_none() {
        headline(out, score)?;
    }
    for task in &tasks {
        task_line(out, task)?;
    }
    // A single line stands at the task's item already.
    let told = score
        .build
        .not_compiled
        .iter()
        .filter(|file| file.message.contains('\n'));
    for file in told {
        compiler(out, &file.message)?;
    }
    for task in &tasks {
        let failing = task.items.iter();
        let failing: Vec<&ItemScore> = failing
            .filter(|item| item.points < item.max_points)
            .collect();
        // Of many tasks the first item that fails is enough to begin with; of one, all that say more.
        let says_more = |item: &&&ItemScore| only.is_some() && item.evidence.is_some();
        let others = failing.iter().skip(1).filter(says_more);
        let shown: Vec<&&ItemScore> = failing.first().into_iter().chain(others).collect();
        for line in &shown {
            item(out, line, hints)?;
            ask_again(out, &line.again(&score.again))?;
        }
        let others = failing.len() - shown.len();
        match only {
            Some(_) => more(out, others, "")?,
            None => more(
                out,
                others,
                &format!(": {}", score.again.task(task.id.id())),
            )?,
        }
        if let Some(printed) = &task.printed {
            printed_lines(out, task, printed)?;
        }
    }
    for note in &score.build.notes {
        writeln!(out, "\n{FAINT}  note: {note}{FAINT:#}")?;
    }
    writeln!(out)
}

fn headline(out: &mut String, score: &Score) -> fmt::Result {
    let title = format!("  {}, {} exam", score.submission, score.exam.id);
    let points = format!("{} / {}", score.points, score.max_points);
    let gap = WIDTH.saturating_sub(2 + title.chars().count() + points.len());
    writeln!(out, "{STRONG}{title}{:gap$}{points}{STRONG:#}\n", "")?;
    // Of one's own work there is nothing to say.
    if score.isolation > Isolation::None {
        writeln!(out, "{FAINT}  kept apart: {}{FAINT:#}\n", score.isolation)?;
    }
    Ok(())
}

fn task_line(out: &mut String, task: &TaskScore) -> fmt::Result {
    let style = style(task.points, task.max_points);
    let filled = (BAR as u32 * task.points) / task.max_points.max(1);
    let bar: String = (0..BAR as u32)
        .map(|i| if i < filled { '█' } else { '·' })
        .collect();
    let (passed, all) = (passed(task), task.items.len());
    writeln!(
        out,
        "  {:24} {style}{bar}{style:#}  {:>3} / {:<3} {FAINT}{passed:>5} of {all} passed{FAINT:#}",
        task.title, task.points, task.max_points,
    )
}

fn passed(task: &TaskScore) -> usize {
    let passed = |item: &&ItemScore| item.verdict == Verdict::Pass;
    task.items.iter().filter(passed).count()
}

fn style(points: u32, max_points: u32) -> Style {
    match points {
        0 => BAD,
        _ if points == max_points => GOOD,
        _ => PART,
    }
}

fn compiler(out: &mut String, message: &str) -> fmt::Result {
    writeln!(out)?;
    for line in message.lines().take(COMPILER_LINES) {
        writeln!(out, "  {BAD}│{BAD:#} {line}")?;
    }
    if message.lines().count() > COMPILER_LINES {
        writeln!(out, "  {BAD}│{BAD:#} …")?;
    }
    Ok(())
}

fn item(out: &mut String, item: &ItemScore, hints: Hints) -> fmt::Result {
    let style = style(item.points, item.max_points);
    let words = item.verdict.words();
    let gap = (WIDTH - 2).saturating_sub(item.id.chars().count() + words.chars().count());
    writeln!(
        out,
        "\n  {STRONG}{}{STRONG:#}{:gap$}{style}{words}{style:#}",
        item.id, ""
    )?;
    for line in wrap(&item.title, WIDTH - 4) {
        writeln!(out, "    {line}")?;
    }
    let hint = said(&item.hints, hints);
    let section = item.section.as_ref().map(Section::words);
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
            row(out, label, text)?;
        }
    }
    Ok(())
}

/// What the mistakes that a wrong answer looks like would do well to hear, if it looks like any.
fn said(known: &[Hint], hints: Hints) -> Option<String> {
    let one = |known: &Hint| match hints {
        Hints::Nudge => known.nudge.clone(),
        Hints::Full => known.hint.clone(),
    };
    let all: Vec<String> = known.iter().map(one).collect();
    let more = match hints {
        Hints::Nudge => " (--hints says more)",
        Hints::Full => "",
    };
    (!all.is_empty()).then(|| format!("{}{more}", all.join(" Or: ")))
}

/// A label and its text, wrapped within the width, later lines indented.
fn row(out: &mut String, label: &str, text: &str) -> fmt::Result {
    const INDENT: usize = 12;
    let mut lines = wrap(text, WIDTH - INDENT).into_iter();
    let first = lines.next().unwrap_or_default();
    writeln!(out, "    {FAINT}{label:<7}{FAINT:#} {first}")?;
    lines.try_for_each(|line| writeln!(out, "{:INDENT$}{line}", ""))
}

fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines = Vec::new();
    for paragraph in text.lines() {
        let mut line = String::new();
        for word in paragraph.split_whitespace() {
            let room = line.chars().count() + 1 + word.chars().count() <= width;
            if !line.is_empty() && !room {
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

/// How to ask the same again.
fn ask_again(out: &mut String, command: &str) -> fmt::Result {
    writeln!(out, "    {FAINT}{:<7} {command}{FAINT:#}", "again")
}

/// How many items are not shown, and how to see them.
fn more(out: &mut String, count: usize, how: &str) -> fmt::Result {
    let items = match count {
        0 => return Ok(()),
        1 => "item",
        _ => "items",
    };
    writeln!(
        out,
        "    {FAINT}and {count} more {items} of this task{how}{FAINT:#}"
    )
}

fn printed_lines(out: &mut String, task: &TaskScore, printed: &str) -> fmt::Result {
    const MOST: usize = 5;
    writeln!(out, "\n  {FAINT}printed during {}:{FAINT:#}", task.title)?;
    for line in printed.lines().take(MOST) {
        let line = tame(line, WIDTH - 5);
        writeln!(out, "  {FAINT}│{FAINT:#} {line}")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::wrap;

    #[test]
    fn lines_are_broken_between_words() {
        assert_eq!(wrap("one two three", 7), ["one two", "three"]);
        assert_eq!(wrap("a\nlonger-than-that", 4), ["a", "longer-than-that"]);
    }
}
