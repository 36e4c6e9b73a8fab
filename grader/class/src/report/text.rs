//! The class on a terminal: how points spread, what most have failed, whom to look at; what a
//! gradebook would change; what a regrade has.

use std::fmt::{self, Write};

use anstyle::Style;
use grader::tame::tame;

use crate::drift::Drift;
use crate::gradebook::Filled;
use crate::spread::Spread;
use crate::summary::Summary;

const STRONG: Style = Style::new().bold();
const FAINT: Style = Style::new().dimmed();
/// A column of so many points, from none to all.
const COLUMNS: [char; 9] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
/// The most lines of a gradebook's or a regrade's changes.
const MOST: usize = 40;

/// The summary.
pub fn summary(summary: &Summary) -> String {
    let mut text = String::new();
    write_summary(&mut text, summary).expect("text takes text");
    text
}

fn write_summary(out: &mut String, summary: &Summary) -> fmt::Result {
    let Summary { graded, exam, .. } = summary;
    writeln!(out, "\n{STRONG}  {graded} graded, {exam} exam{STRONG:#}")?;
    let others = [
        (
            summary.nothing_to_grade,
            "handed in nothing that can be graded",
        ),
        (
            summary.not_graded,
            "not graded, for reasons that are not theirs: run this again",
        ),
        (summary.missing, "in the lists, and handed in nothing"),
        (
            summary.undated,
            "of them count as in time: nothing says when they came",
        ),
    ];
    for (count, words) in others.iter().filter(|(count, _)| *count > 0) {
        writeln!(out, "  {count} {words}")?;
    }
    if let Some(points) = &summary.points {
        writeln!(out)?;
        spread(out, "all", points)?;
    }
    for task in &summary.tasks {
        spread(out, &task.title, &task.points)?;
    }
    let failed = summary.failed_most.iter();
    let failed = failed.map(|failed| (failed.count, format!("{}  {}", failed.item, failed.title)));
    list(out, "failed most", failed)?;
    let mistakes = summary.mistakes.iter();
    let mistakes = mistakes.map(|mistake| (mistake.count, mistake.hint.clone()));
    list(out, "made most", mistakes)?;
    if !summary.outliers.is_empty() {
        writeln!(out, "\n{STRONG}  to be looked at{STRONG:#}")?;
    }
    for outlier in &summary.outliers {
        writeln!(out, "  {}: {}", line(&outlier.id), line(&outlier.why))?;
    }
    writeln!(out)
}

fn spread(out: &mut String, title: &str, spread: &Spread) -> fmt::Result {
    let highest = spread.bins.iter().max().copied().unwrap_or(0).max(1);
    let column = |count: &usize| match count {
        0 => '·',
        count => COLUMNS[(8 * count).div_ceil(highest)],
    };
    let bars: String = spread.bins.iter().map(column).collect();
    let Spread {
        mean,
        of,
        lower_quartile,
        median,
        upper_quartile,
        ..
    } = spread;
    writeln!(
        out,
        "  {title:24} {bars}  {mean:>5.1} / {of:<3} {FAINT}quarters {lower_quartile}, {median}, {upper_quartile}{FAINT:#}"
    )
}

fn list(
    out: &mut String,
    title: &str,
    lines: impl Iterator<Item = (usize, String)>,
) -> fmt::Result {
    let mut lines = lines.peekable();
    if lines.peek().is_some() {
        writeln!(out, "\n{STRONG}  {title}{STRONG:#}")?;
    }
    for (count, words) in lines {
        writeln!(out, "  {count:>4}  {}", line(&words))?;
    }
    Ok(())
}

/// What a list's copy changes, before it is written.
pub fn filled(filled: &Filled) -> String {
    let mut text = format!("\n{STRONG}  {}{STRONG:#}\n", line(&filled.title));
    let width = filled.changes.iter().map(|c| c.who.chars().count()).max();
    let width = width.unwrap_or(0);
    for change in filled.changes.iter().take(MOST) {
        let was = match change.was.trim() {
            "" => "–",
            was => was,
        };
        let who = line(&change.who);
        text += &format!("  {who:width$}  {} → {}\n", line(was), change.now);
    }
    let more = filled.changes.len().saturating_sub(MOST);
    if more > 0 {
        text += &format!("  and {more} more\n");
    }
    if filled.changes.is_empty() {
        text += "  nothing changes\n";
    }
    for warning in &filled.warnings {
        text += &format!("  ! {}\n", line(warning));
    }
    text
}

/// What a regrade has changed; `because` is what is not as it was.
pub fn drifts(drifts: &[Drift], because: &[&str]) -> String {
    let because = match because {
        [] => "of what scores follow from, nothing is different".to_owned(),
        because => format!("different now: {}", because.join(", ")),
    };
    let count = match drifts.len() {
        0 => "nobody's points changed".to_owned(),
        count => format!("{count} changed"),
    };
    let mut text = format!("\n{STRONG}  regraded: {count}{STRONG:#} ({because})\n");
    for drift in drifts.iter().take(MOST) {
        let now = drift
            .now
            .map_or("no score".to_owned(), |now| now.to_string());
        text += &format!("  {}: {} → {now}\n", line(&drift.id), drift.was);
        let points = |points: Option<u32>| points.map_or("–".to_owned(), |p| p.to_string());
        for change in &drift.items {
            let (was, now) = (points(change.was), points(change.now));
            text += &format!(
                "      {} {was} → {now}: {}\n",
                change.item,
                line(&change.why)
            );
        }
    }
    let more = drifts.len().saturating_sub(MOST);
    if more > 0 {
        text += &format!("  and {more} more, in drift.json\n");
    }
    text
}

/// One line, whatever stands in it.
fn line(text: &str) -> String {
    tame(text, 160).replace('\n', " ")
}
