//! The reports on the terminal: a summary of the class, the changes to gradebooks, and the changes
//! of a regrade.

use std::fmt::{self, Write};

use anstyle::Style;
use judging::sanitize::sanitize_line;

use crate::distribution::Distribution;
use crate::final_grades::GradeChanges;
use crate::gradebook::FilledGradebook;
use crate::hand_back::HandBack;
use crate::regrade_diff::{Drift, RegradeChanges, RemovedEntry};
use crate::summary::ClassSummary;

const STRONG: Style = Style::new().bold();
const FAINT: Style = Style::new().dimmed();
/// The characters for the columns of a bar chart, from the lowest to the highest.
const COLUMNS: [char; 9] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
/// The maximum length of the reasons why a submission needs attention, which may name many files.
const MAX_WHY_CHARS: usize = 1_000;
/// The maximum number of changes to list for a gradebook or a regrade.
const MAX_LINES: usize = 40;

/// Renders the summary.
pub fn render_summary(summary: &ClassSummary) -> String {
    let mut text = String::new();
    write_summary(&mut text, summary).expect("writing to a string succeeds");
    text
}

fn write_summary(out: &mut String, summary: &ClassSummary) -> fmt::Result {
    let ClassSummary { graded, exam, .. } = summary;
    let exam = one_line(exam);
    writeln!(out, "\n{STRONG}  {graded} graded, {exam} exam{STRONG:#}")?;
    let others = [
        (
            summary.nothing_to_grade,
            "without anything that can be graded",
        ),
        (
            summary.not_graded,
            "not graded because of the grader or the machine: run this again",
        ),
        (summary.missing, "on a roster, but submitted nothing"),
        (
            summary.unclear_times,
            "without final points, since it is unclear when they were submitted: see class.html",
        ),
        (
            summary.undecided,
            "without final points, since the same person handed in several: see class.html",
        ),
        (
            summary.superseded,
            "that do not count, since another one of the same person does",
        ),
        (
            summary.undated,
            "counted as on time, since their submission time is unknown",
        ),
    ];
    for (count, description) in others.iter().filter(|(count, _)| *count > 0) {
        writeln!(out, "  {count} {description}")?;
    }
    if let Some(points) = &summary.points {
        writeln!(out)?;
        write_distribution(out, "all", points)?;
    }
    for task in &summary.tasks {
        write_distribution(out, &one_line(&task.title), &task.points)?;
    }
    let failed = summary.failed_most.iter();
    let failed = failed.map(|failed| (failed.count, format!("{}  {}", failed.item, failed.title)));
    write_counts(out, "items failed most often", failed)?;
    let mistakes = summary.mistakes.iter();
    let mistakes = mistakes.map(|mistake| (mistake.count, mistake.hint.clone()));
    write_counts(out, "most common mistakes", mistakes)?;
    if !summary.outliers.is_empty() {
        writeln!(out, "\n{STRONG}  submissions that need attention{STRONG:#}")?;
    }
    for outlier in &summary.outliers {
        writeln!(
            out,
            "  {}: {}",
            one_line(&outlier.title()),
            sanitize_line(&outlier.why, MAX_WHY_CHARS)
        )?;
    }
    writeln!(out)
}

fn write_distribution(out: &mut String, title: &str, distribution: &Distribution) -> fmt::Result {
    let highest = distribution.bins.iter().max().copied().unwrap_or(0).max(1);
    let column = |count: &usize| match count {
        0 => '·',
        count => COLUMNS[(8 * count).div_ceil(highest)],
    };
    let bars: String = distribution.bins.iter().map(column).collect();
    let Distribution {
        mean,
        of,
        lower_quartile,
        median,
        upper_quartile,
        ..
    } = distribution;
    writeln!(
        out,
        "  {title:24} {bars}  {mean:>5.1} / {of:<3} {FAINT}quartiles {lower_quartile}, {median}, {upper_quartile}{FAINT:#}"
    )
}

fn write_counts(
    out: &mut String,
    title: &str,
    lines: impl Iterator<Item = (usize, String)>,
) -> fmt::Result {
    let mut lines = lines.peekable();
    if lines.peek().is_some() {
        writeln!(out, "\n{STRONG}  {title}{STRONG:#}")?;
    }
    for (count, text) in lines {
        writeln!(out, "  {count:>4}  {}", one_line(&text))?;
    }
    Ok(())
}

/// Renders the changes in the copy of a gradebook.
pub fn render_gradebook(filled: &FilledGradebook) -> String {
    let mut text = format!("\n{STRONG}  {}{STRONG:#}\n", one_line(&filled.title));
    let width = filled.changes.iter().map(|c| c.who.chars().count()).max();
    let width = width.unwrap_or(0);
    for change in filled.changes.iter().take(MAX_LINES) {
        let was = match change.was.trim() {
            "" => "–",
            was => was,
        };
        let who = one_line(&change.who);
        text += &format!("  {who:width$}  {} → {}\n", one_line(was), change.now);
    }
    let more = filled.changes.len().saturating_sub(MAX_LINES);
    if more > 0 {
        text += &format!("  and {more} more\n");
    }
    if filled.changes.is_empty() {
        text += "  nothing changes\n";
    }
    for warning in &filled.warnings {
        text += &format!("  ! {}\n", one_line(warning));
    }
    text
}

/// Renders the contents of the archive to hand back.
pub fn render_hand_back(hand_back: &HandBack) -> String {
    let pages = match hand_back.pages {
        1 => "1 page".to_owned(),
        pages => format!("{pages} pages"),
    };
    let mut text = format!("\n{STRONG}  to hand back: {pages}{STRONG:#}\n");
    for line in &hand_back.left_out {
        text += &format!("  ! not in it: {}\n", one_line(line));
    }
    text
}

/// Renders the changes of a regrade.
pub fn render_regrade(regrade: &RegradeChanges) -> String {
    let causes = match regrade.causes.as_slice() {
        [] => "no setting changed".to_owned(),
        causes => format!("changed settings: {}", causes.join(", ")),
    };
    let drifts = with_changed_points(&regrade.drifts);
    let count = match drifts.len() {
        0 => "no score changed".to_owned(),
        1 => "1 score changed".to_owned(),
        count => format!("{count} scores changed"),
    };
    let title = format!("regraded: {count}{STRONG:#} ({causes})");
    let same = match regrade.drifts.len() - drifts.len() {
        0 => String::new(),
        count => format!("  {count} more with the same points for other items, in drift.json\n"),
    };
    render_drifts(&title, &drifts) + &more(&drifts, ", in drift.json") + &same
}

/// Renders the scores that changed because their submission did.
pub fn render_resubmitted(drifts: &[Drift]) -> String {
    let drifts = with_changed_points(drifts);
    if drifts.is_empty() {
        return String::new();
    }
    let title = format!("changed submissions{STRONG:#} (replaced.json has the earlier score)");
    render_drifts(&title, &drifts) + &more(&drifts, "")
}

/// Renders the final grades that changed, with the causes.
pub fn render_grade_changes(grades: &GradeChanges) -> String {
    if grades.changes.is_empty() && grades.causes.is_empty() {
        return String::new();
    }
    let causes = match grades.causes.as_slice() {
        [] => String::new(),
        causes => format!(" (changed: {})", causes.join(", ")),
    };
    let mut text = format!(
        "\n{STRONG}  {}{STRONG:#}{causes}\n",
        count_grades(grades.changes.len())
    );
    // A grade that changes unnoticed is found weeks later, so all of them are listed.
    for change in &grades.changes {
        text += &format!("  {}\n", one_line(&change.to_string()));
    }
    text
}

/// Returns a title that says how many final grades changed.
pub fn count_grades(count: usize) -> String {
    match count {
        0 => "no final grade changed".to_owned(),
        1 => "1 final grade changed".to_owned(),
        count => format!("{count} final grades changed"),
    }
}

/// Renders the entries that are no longer in the input.
pub fn render_removed(removed: &[RemovedEntry]) -> String {
    if removed.is_empty() {
        return String::new();
    }
    let mut text = format!(
        "\n{STRONG}  no longer in the input{STRONG:#} (not in the tables; their folders are kept)\n"
    );
    for entry in removed {
        text += &format!("  {}\n", one_line(&entry.to_string()));
    }
    text
}

/// Returns the scores whose total changed.
pub fn with_changed_points(drifts: &[Drift]) -> Vec<&Drift> {
    let drifts = drifts.iter();
    drifts.filter(|drift| drift.changes_points()).collect()
}

fn render_drifts(title: &str, drifts: &[&Drift]) -> String {
    let mut text = format!("\n{STRONG}  {title}\n");
    for drift in drifts.iter().take(MAX_LINES) {
        let now = drift
            .now
            .map_or("no score".to_owned(), |now| now.to_string());
        text += &format!("  {}: {} → {now}\n", one_line(&drift.id), drift.was);
        let points = |points: Option<u32>| points.map_or("–".to_owned(), |p| p.to_string());
        for change in &drift.items {
            let (was, now) = (points(change.was), points(change.now));
            text += &format!(
                "      {} {was} → {now}: {}\n",
                one_line(&change.item),
                one_line(&change.why)
            );
        }
    }
    text
}

fn more(drifts: &[&Drift], location: &str) -> String {
    match drifts.len().saturating_sub(MAX_LINES) {
        0 => String::new(),
        more => format!("  and {more} more{location}\n"),
    }
}

/// Returns untrusted text on one line, shortened and without control characters.
pub fn one_line(text: &str) -> String {
    sanitize_line(text, 160)
}
