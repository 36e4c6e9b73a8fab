//! `class.html`: the class on one self-contained page, with everyone's points, their distribution,
//! the most common mistakes, and a link to each report.

mod changes;
mod similar;
mod submissions;
mod times;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use grader::report::html::prose;
use grader::svg::number;
use judging::sanitize::sanitize;
use maud::{DOCTYPE, Markup, PreEscaped, Render, html};
use sha2::{Digest, Sha256};

use crate::distribution::Distribution;
use crate::graded_class::GradedClass;
use crate::names::joined;
use crate::regrade_diff::Changes;
use crate::similar_pairs::SimilarPair;
use crate::summary::{Cause, ClassSummary, Outlier, attention_groups};
use grader::printing::counted;

const STYLE: &str = include_str!("page.css");
/// The script that sorts the table of submissions.
const SCRIPT: &str = include_str!("page.js");

/// Renders the page of a class.
pub fn render_page(
    class: &GradedClass,
    summary: &ClassSummary,
    changes: &Changes,
    similar: &[SimilarPair],
) -> String {
    let submissions = counted(class.rows.len(), "submission");
    let title = format!("{submissions}, {} exam", summary.exam);
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(content_security_policy());
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { (sanitized(&title)) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    h1 { (sanitized(&title)) }
                    p {
                        (summary.graded) " graded, " (summary.nothing_to_grade)
                        " with nothing to grade, " (summary.not_graded) " not graded, "
                        @if summary.superseded > 0 { (summary.superseded) " replaced by another attempt, " }
                        @if summary.by_test_student > 0 {
                            (summary.by_test_student) " submitted by Canvas's test student, "
                        }
                        (summary.missing) " without a submission."
                    }
                }
                main {
                    @if !summary.outliers.is_empty() { (attention(&summary.outliers)) }
                    (distribution(summary))
                    (causes(&summary.causes))
                    (failure_rates(summary))
                    (times::times(class))
                    (changes::changes(changes))
                    (submissions::submissions(class))
                    @if !similar.is_empty() { (similar::similar(class, similar)) }
                }
                footer {
                    p {
                        "Exam " code { (sanitized(&summary.exam)) } ", "
                        code { (sanitized(summary.exam_hash.get(..12).unwrap_or_default())) }
                        "; isolation " code { (sanitized(&summary.isolation)) }
                        ". The same data is in a machine-readable form in "
                        code { "class.json" } " and " code { "grades.csv" } " in the same folder."
                    }
                }
                script { (PreEscaped(SCRIPT)) }
            }
        }
    };
    page.into_string()
}

/// Returns a content security policy that forbids external resources and allows only [`STYLE`] and
/// [`SCRIPT`].
fn content_security_policy() -> String {
    let [style, script] = [STYLE, SCRIPT].map(|text| STANDARD.encode(Sha256::digest(text)));
    format!(
        "default-src 'none'; style-src 'sha256-{style}'; script-src 'sha256-{script}'; \
         base-uri 'none'; form-action 'none'"
    )
}

/// Returns a share in percent. It is only 0 or 100 if the count is 0 or complete.
fn percent(count: usize, all: usize) -> usize {
    let rounded = (100 * count + all / 2) / all;
    match count {
        0 => 0,
        count if count == all => 100,
        _ => rounded.clamp(1, 99),
    }
}

/// Renders a section with a heading. `id` identifies the heading.
fn section(id: &str, title: &str, contents: &Markup) -> Markup {
    html! { section aria-labelledby=(id) { h2 id=(id) { (title) } (contents) } }
}

/// Renders a table that scrolls in a narrow window. `id` is the id of its section.
fn wide(id: &str, table: &Markup) -> Markup {
    html! { div .wide tabindex="0" role="region" aria-labelledby=(id) { (table) } }
}

/// Renders the header of a table with text columns, number columns and, unless `last` is empty, one
/// more text column.
fn header<T: Render>(texts: &[&str], numbers: impl Iterator<Item = T>, last: &str) -> Markup {
    html! { thead { tr {
        @for title in texts { th scope="col" { (title) } }
        @for title in numbers { th scope="col" .number { (title) } }
        @if !last.is_empty() { th scope="col" { (last) } }
    } } }
}

fn distribution(summary: &ClassSummary) -> Markup {
    let all = summary.points.iter().map(|points| ("All tasks", points));
    let tasks = summary.tasks.iter();
    let tasks = tasks.map(|task| (task.title.as_str(), &task.points));
    let numbers = ["Mean", "Median", "Maximum"];
    let table = html! { table {
        caption {
            "Number of submissions (vertical) by points (horizontal), in tenths of the maximum"
        }
        (header(&["Task", "Distribution"], numbers.iter(), ""))
        tbody { @for (title, distribution) in all.chain(tasks) { tr {
            th scope="row" { (sanitized(title)) }
            td { (bars(distribution)) }
            td .number { (format!("{:.1}", distribution.mean)) }
            td .number { (distribution.median) }
            td .number { (distribution.of) }
        } } }
    } };
    section("spread", "Points", &wide("spread", &table))
}

/// Renders a distribution as ten columns with axes, and the numbers as text for screen readers.
fn bars(distribution: &Distribution) -> Markup {
    let highest = distribution.bins.iter().max().copied().unwrap_or(0).max(1);
    let counts = joined(distribution.bins.iter().map(ToString::to_string), ", ");
    let label = format!("from the lowest tenth to the highest: {counts}");
    let columns = distribution.bins.iter().enumerate();
    let columns = columns.map(|(index, count)| (12 * index, 40.0 * *count as f64 / highest as f64));
    html! {
        svg .bars viewBox="-28 -4 154 60" role="img" aria-label=(label) {
            @for (x, height) in columns {
                rect x=(x) y=(number(41.0 - height)) width="10" height=(number(height)) {}
            }
            path d="M0 41.5H118M-1.5 41V0" {}
            text x="-4" y="6" .end { (highest) }
            text x="-4" y="42" .end { "0" }
            text x="0" y="53" { "0" }
            text x="118" y="53" .end { (distribution.of) }
        }
    }
}

fn attention(outliers: &[Outlier]) -> Markup {
    let groups = html! {
        @for (heading, submissions) in attention_groups(outliers) {
            h3 { (sanitized(&heading)) }
            ul { @for (detail, submissions) in submissions { li {
                @if !detail.is_empty() { (sanitized(detail)) ": " }
                @for (index, outlier) in submissions.iter().enumerate() {
                    @let link = outlier.has_report.then(|| submissions::report_link(&outlier.id));
                    @if index > 0 { ", " }
                    a href=[link] { (sanitized(&outlier.title())) }
                }
            } } }
        }
    };
    section("look", "Submissions that need attention", &groups)
}

fn causes(causes: &[Cause]) -> Markup {
    let list = html! {
        @if causes.is_empty() { p { "Nobody lost any points." } }
        ul .counted { @for cause in causes { li {
            strong { (cause.count) " × " } (prose(&cause.text))
            @for item in &cause.items { " " code { (sanitized(item)) } }
        } } }
    };
    section("causes", "Root causes of lost points", &list)
}

/// Renders the failure rates for each task and item in each section. The table of items is
/// collapsed.
fn failure_rates(summary: &ClassSummary) -> Markup {
    let table = |title: &str, is_of_items: bool| {
        let rates = summary.failed.iter();
        let rates = rates.filter(|rate| rate.id.contains('.') == is_of_items);
        let sections = summary.sections.iter();
        let sections =
            sections.map(|(section, graded)| html! { (sanitized(section)) " (" (graded) ")" });
        let table = html! { table {
            (header(&[title], sections, ""))
            tbody { @for rate in rates { tr {
                th scope="row" { code { (sanitized(&rate.id)) } }
                @for (section, graded) in &summary.sections {
                    @let count = rate.counts.get(section).copied().unwrap_or(0);
                    td .number { (count) " (" (percent(count, *graded)) "%)" }
                }
            } } }
        } };
        wide("rates", &table)
    };
    let title = "Submissions without full marks, by section";
    let items = html! { details { summary { "By item" } (table("Item", true)) } };
    section("rates", title, &html! { (table("Task", false)) (items) })
}

/// Returns untrusted text, shortened and without control characters that could affect the text
/// around it.
fn sanitized(text: &str) -> Markup {
    html! { (sanitize(text, 1_000)) }
}
