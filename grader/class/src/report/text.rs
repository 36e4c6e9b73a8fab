//! The reports for the terminal: a summary of the class, the changes to gradebooks, and the changes
//! made by a regrade.

use anstyle::Style;
use judging::sanitize::sanitize_line;

use crate::distribution::Distribution;
use crate::final_grades::GradeChanges;
use crate::gradebook::{CellChange, FilledGradebook};
use crate::hand_back::HandBack;
use crate::names::joined;
use crate::regrade_diff::{Changes, ItemChange, RegradeChanges, ScoreChange};
use crate::summary::{Cause, ClassSummary, attention_groups};
use grader::printing::{counted, wrap};

const STRONG: Style = Style::new().bold();
const FAINT: Style = Style::new().dimmed();
/// The characters for the columns of a bar chart, from the lowest to the highest.
const COLUMNS: [char; 9] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
/// The maximum length of a sentence that says what to do, in characters. Such a sentence may name
/// many files.
const MAX_SENTENCE_CHARS: usize = 1_000;
/// The maximum length of a line that lists submissions, in characters.
const MAX_WIDTH: usize = 90;
/// The maximum number of changes to list for a gradebook or a regrade.
const MAX_LINES: usize = 40;

/// Renders the summary.
pub fn render_summary(summary: &ClassSummary) -> String {
    let ClassSummary { graded, exam, .. } = summary;
    let counts = [
        (summary.nothing_to_grade, "with nothing to grade"),
        (
            summary.not_graded,
            "not graded because of a problem with the grader or the machine: run this command \
             again",
        ),
        (summary.missing, "on a roster, but without a submission"),
        (
            summary.unclear_times,
            "without final points, because it is unclear when they were submitted: see class.html",
        ),
        (
            summary.drafts,
            "saved only as a draft, so there are no final points yet: see class.html",
        ),
        (
            summary.unclear_people,
            "without final points, because it is unclear who handed them in: see class.html",
        ),
        (
            summary.unlisted,
            "handed in by people who aren't on the lists: see class.html",
        ),
        (
            summary.undecided,
            "without final points, because the same person handed in several submissions: see \
             class.html",
        ),
        (
            summary.superseded,
            "not counted because another submission by the same person counts",
        ),
        (
            summary.by_test_student,
            "submitted by Canvas's test student",
        ),
        (
            summary.undated,
            "counted as on time or 1 day late because their submission time is unknown",
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
        one_line(&format!("{count:>4}  {text}  {}", joined(items, ", ")))
    });
    let mut attention = Vec::new();
    for (heading, submissions) in attention_groups(&summary.outliers) {
        attention.push(format!("{}:", sentence(&heading)));
        for (detail, submissions) in submissions {
            let titles = submissions.iter().map(|outlier| one_line(&outlier.title()));
            let line = [sentence(detail), joined(titles, ", ")];
            let line = joined(line.iter().filter(|text| !text.is_empty()), ": ");
            let lines = wrap(&line, MAX_WIDTH);
            attention.extend(lines.iter().map(|line| format!("  {line}")));
        }
    }
    let lists = [
        ("submissions that need attention", attention),
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
    let quartiles = format!("quartiles {lower_quartile}, {median}, {upper_quartile}");
    format!("  {title:24} {bars}  {mean:>5.1} / {of:<3} {FAINT}{quartiles}{FAINT:#}\n")
}

/// Renders the changes to the copy of a gradebook.
pub fn render_gradebook(filled: &FilledGradebook) -> String {
    let changes = filled.changes.iter();
    let widths = changes.clone().map(|change| change.who.chars().count());
    let width = widths.max().unwrap_or(0);
    let line = |change: &CellChange| {
        let was = Some(change.was.trim()).filter(|was| !was.is_empty());
        let (who, was) = (one_line(&change.who), one_line(was.unwrap_or("–")));
        format!("{who:width$}  {was} → {}", change.now)
    };
    let is_unchanged = filled.changes.is_empty();
    let none = is_unchanged.then(|| "nothing changes".to_owned());
    let warnings = filled.warnings.iter();
    let warnings = warnings.map(|warning| format!("! {}", sentence(warning)));
    let lines = changes.take(MAX_LINES).map(line);
    let lines = lines.chain(more(filled.changes.len(), "")).chain(none);
    let lines = lines.chain(warnings);
    section(&one_line(&filled.title), "", lines)
}

/// Renders how many pages the archive to hand back contains, and whose pages were left out.
pub fn render_hand_back(hand_back: &HandBack) -> String {
    let title = format!("to hand back: {}", counted(hand_back.pages, "page"));
    let left_out = hand_back.left_out.iter();
    let left_out = left_out.map(|line| format!("! left out: {}", sentence(line)));
    section(&title, "", left_out)
}

/// Renders the differences from earlier runs, if any.
pub fn render_changes(changes: &Changes) -> String {
    let mut text: String = changes.regrade.iter().map(render_regrade).collect();
    let resubmitted = with_changed_points(&changes.resubmitted);
    if !resubmitted.is_empty() {
        let rest = " (see replaced.json for the earlier score)";
        text += &section("changed submissions", rest, change_lines(&resubmitted, ""));
    }
    let grades = changes.grades.iter().filter(|grades| !grades.is_empty());
    text.extend(grades.map(render_grade_changes));
    if !changes.removed.is_empty() {
        let rest = " (not in the tables; their folders are kept)";
        let removed = changes.removed.iter().map(|entry| one_line(entry));
        text += &section("no longer in the input", rest, removed);
    }
    text
}

fn render_regrade(regrade: &RegradeChanges) -> String {
    let causes = match regrade.causes.as_slice() {
        [] => "no settings changed".to_owned(),
        causes => format!("changed settings: {}", causes.join(", ")),
    };
    let changes = with_changed_points(&regrade.scores);
    let title = format!("regraded: {} changed", count_or_no(changes.len(), "score"));
    let count = regrade.scores.len() - changes.len();
    let same = format!(
        "{count} more in drift.json, with the same total but different points for some items"
    );
    let same = (count > 0).then_some(same);
    let lines = change_lines(&changes, ", in drift.json").chain(same);
    section(&title, &format!(" ({causes})"), lines)
}

fn render_grade_changes(grades: &GradeChanges) -> String {
    let causes = match grades.causes.as_slice() {
        [] => String::new(),
        causes => format!(" (changed: {})", causes.join(", ")),
    };
    let count = count_or_no(grades.changes.len(), "final grade");
    let title = format!("{count} changed");
    // List all grades, because a change that is overlooked now would only be noticed weeks later.
    let changes = grades.changes.iter().map(|change| sentence(change));
    section(&title, &causes, changes)
}

/// Returns the scores whose total changed, rather than only its distribution among the items.
pub fn with_changed_points(changes: &[ScoreChange]) -> Vec<&ScoreChange> {
    let changes = changes.iter();
    changes
        .filter(|change| change.now != Some(change.was))
        .collect()
}

/// Returns a score's points after a change.
pub fn points_now(change: &ScoreChange) -> String {
    let now = change.now.map(|now| now.to_string());
    now.unwrap_or_else(|| "no score".to_owned())
}

/// Returns an item's points before and after a change.
pub fn points_of_item(change: &ItemChange) -> [String; 2] {
    let text = |points: u32| points.to_string();
    [change.was, change.now].map(|points| points.map_or("–".to_owned(), text))
}

/// Returns lines about the first scores that changed, and a line with the number of changes that
/// aren't listed. `location` says where to find them.
fn change_lines(changes: &[&ScoreChange], location: &str) -> impl Iterator<Item = String> {
    let mut lines = Vec::new();
    for change in changes.iter().take(MAX_LINES) {
        let now = points_now(change);
        lines.push(format!("{}: {} → {now}", one_line(&change.id), change.was));
        lines.extend(change.items.iter().map(|change| {
            let [was, now] = points_of_item(change);
            let (item, why) = (one_line(&change.item), one_line(&change.why));
            format!("    {item} {was} → {now}: {why}")
        }));
    }
    lines.into_iter().chain(more(changes.len(), location))
}

/// Returns a line about changes that aren't listed, if any.
fn more(all: usize, location: &str) -> Option<String> {
    let more = all.saturating_sub(MAX_LINES);
    (more > 0).then(|| format!("and {more} more{location}"))
}

fn count_or_no(number: usize, noun: &str) -> String {
    match number {
        0 => format!("no {noun}"),
        number => counted(number, noun),
    }
}

/// Returns a sentence that says what to do, on one line. The sentence may contain untrusted text.
pub fn sentence(text: &str) -> String {
    sanitize_line(text, MAX_SENTENCE_CHARS)
}

/// Returns untrusted text on one line, shortened and without control characters.
pub fn one_line(text: &str) -> String {
    sanitize_line(text, 160)
}
