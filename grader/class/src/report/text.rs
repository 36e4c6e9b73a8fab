//! The reports on the terminal: a summary of the class, the changes to gradebooks, and the changes
//! of a regrade.

use anstyle::Style;
use judging::sanitize::sanitize_line;

use crate::distribution::Distribution;
use crate::final_grades::GradeChanges;
use crate::gradebook::{CellChange, FilledGradebook};
use crate::hand_back::HandBack;
use crate::regrade_diff::{Drift, ItemChange, RegradeChanges};
use crate::summary::{Cause, ClassSummary};
use grader::printing::counted;

const STRONG: Style = Style::new().bold();
const FAINT: Style = Style::new().dimmed();
/// The characters for the columns of a bar chart, from the lowest to the highest.
const COLUMNS: [char; 9] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
/// The maximum length of the reasons a submission needs attention, which may name many files.
const MAX_WHY_CHARS: usize = 1_000;
/// The maximum number of changes to list for a gradebook or a regrade.
const MAX_LINES: usize = 40;

/// Renders the summary.
pub fn render_summary(summary: &ClassSummary) -> String {
    let ClassSummary { graded, exam, .. } = summary;
    let counts = [
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
    let counts = counts.iter().filter(|(count, _)| *count > 0);
    let counts = counts.map(|(count, description)| format!("{count} {description}"));
    let title = format!("{graded} graded, {} exam", one_line(exam));
    let mut text = section(&title, "", counts);
    if let Some(points) = &summary.points {
        text += &format!("\n{}", distribution_line("all", points));
    }
    for task in &summary.tasks {
        text += &distribution_line(&one_line(&task.title), &task.points);
    }
    let causes = summary.causes.iter();
    let causes = causes.map(|Cause { text, items, count }| {
        let items: Vec<&str> = items.iter().map(String::as_str).collect();
        one_line(&format!("{count:>4}  {text}  {}", items.join(", ")))
    });
    let outliers = summary.outliers.iter().map(|outlier| {
        let why = sanitize_line(&outlier.why, MAX_WHY_CHARS);
        format!("{}: {why}", one_line(&outlier.title()))
    });
    let lists: [(&str, Vec<String>); 2] = [
        ("submissions that need attention", outliers.collect()),
        ("root causes of lost points", causes.collect()),
    ];
    for (title, lines) in lists.into_iter().filter(|(_, lines)| !lines.is_empty()) {
        text += &section(title, "", lines);
    }
    text + "\n"
}

/// Renders lines below a heading whose first words, `strong`, are emphasised.
fn section(strong: &str, rest: &str, lines: impl IntoIterator<Item = String>) -> String {
    let lines = lines.into_iter().map(|line| format!("  {line}\n"));
    format!("\n{STRONG}  {strong}{STRONG:#}{rest}\n") + &lines.collect::<String>()
}

fn distribution_line(title: &str, distribution: &Distribution) -> String {
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
    format!(
        "  {title:24} {bars}  {mean:>5.1} / {of:<3} {FAINT}quartiles {lower_quartile}, {median}, {upper_quartile}{FAINT:#}\n"
    )
}

/// Renders the changes to the copy of a gradebook.
pub fn render_gradebook(filled: &FilledGradebook) -> String {
    let changes = filled.changes.iter();
    let widths = changes.clone().map(|change| change.who.chars().count());
    let width = widths.max().unwrap_or(0);
    let line = |change: &CellChange| {
        let was = match change.was.trim() {
            "" => "–",
            was => was,
        };
        let (who, was) = (one_line(&change.who), one_line(was));
        format!("{who:width$}  {was} → {}", change.now)
    };
    let is_unchanged = filled.changes.is_empty();
    let none = is_unchanged.then(|| "nothing changes".to_owned());
    let warnings = filled.warnings.iter();
    let warnings = warnings.map(|warning| format!("! {}", one_line(warning)));
    let lines = changes.take(MAX_LINES).map(line);
    let lines = lines
        .chain(more(filled.changes.len(), ""))
        .chain(none)
        .chain(warnings);
    section(&one_line(&filled.title), "", lines)
}

/// Renders the contents of the archive to hand back.
pub fn render_hand_back(hand_back: &HandBack) -> String {
    let title = format!("to hand back: {}", counted(hand_back.pages, "page"));
    let left_out = hand_back.left_out.iter();
    let left_out = left_out.map(|line| format!("! not in it: {}", one_line(line)));
    section(&title, "", left_out)
}

/// Renders the changes of a regrade.
pub fn render_regrade(regrade: &RegradeChanges) -> String {
    let causes = match regrade.causes.as_slice() {
        [] => "no setting changed".to_owned(),
        causes => format!("changed settings: {}", causes.join(", ")),
    };
    let drifts = with_changed_points(&regrade.drifts);
    let title = format!("regraded: {} changed", count_or_no(drifts.len(), "score"));
    let same = match regrade.drifts.len() - drifts.len() {
        0 => None,
        count => Some(format!(
            "{count} more with the same points for other items, in drift.json"
        )),
    };
    let lines = drift_lines(&drifts, ", in drift.json").chain(same);
    section(&title, &format!(" ({causes})"), lines)
}

/// Renders the scores that changed because their submission changed.
pub fn render_resubmitted(drifts: &[Drift]) -> String {
    let drifts = with_changed_points(drifts);
    if drifts.is_empty() {
        return String::new();
    }
    let rest = " (replaced.json has the earlier score)";
    section("changed submissions", rest, drift_lines(&drifts, ""))
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
    let title = format!(
        "{} changed",
        count_or_no(grades.changes.len(), "final grade")
    );
    // All grades are listed, because a change that goes unnoticed is only found weeks later.
    let changes = grades.changes.iter().map(|change| one_line(change));
    section(&title, &causes, changes)
}

/// Renders the entries that are no longer in the input.
pub fn render_removed(removed: &[String]) -> String {
    if removed.is_empty() {
        return String::new();
    }
    let rest = " (not in the tables; their folders are kept)";
    let removed = removed.iter().map(|entry| one_line(entry));
    section("no longer in the input", rest, removed)
}

/// Returns the scores whose total changed.
pub fn with_changed_points(drifts: &[Drift]) -> Vec<&Drift> {
    let drifts = drifts.iter();
    drifts.filter(|drift| drift.changes_points()).collect()
}

/// Returns a score's points after a change.
pub fn points_now(drift: &Drift) -> String {
    drift
        .now
        .map_or("no score".to_owned(), |now| now.to_string())
}

/// Returns an item's points before and after a change.
pub fn points_of_item(change: &ItemChange) -> [String; 2] {
    let text = |points: u32| points.to_string();
    [change.was, change.now].map(|points| points.map_or("–".to_owned(), text))
}

/// Returns lines about the first scores that changed, and the number of others. `location` says where
/// those can be found.
fn drift_lines(drifts: &[&Drift], location: &str) -> impl Iterator<Item = String> {
    let mut lines = Vec::new();
    for drift in drifts.iter().take(MAX_LINES) {
        let now = points_now(drift);
        lines.push(format!("{}: {} → {now}", one_line(&drift.id), drift.was));
        lines.extend(drift.items.iter().map(|change| {
            let [was, now] = points_of_item(change);
            let (item, why) = (one_line(&change.item), one_line(&change.why));
            format!("    {item} {was} → {now}: {why}")
        }));
    }
    lines.into_iter().chain(more(drifts.len(), location))
}

/// Returns a line about changes that aren't listed, if any.
fn more(all: usize, location: &str) -> Option<String> {
    match all.saturating_sub(MAX_LINES) {
        0 => None,
        more => Some(format!("and {more} more{location}")),
    }
}

fn count_or_no(number: usize, noun: &str) -> String {
    match number {
        0 => format!("no {noun}"),
        number => counted(number, noun),
    }
}

/// Returns untrusted text on one line, shortened and without control characters.
pub fn one_line(text: &str) -> String {
    sanitize_line(text, 160)
}
