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
use maud::{DOCTYPE, Markup, PreEscaped, html};
use sha2::{Digest, Sha256};

use crate::distribution::Distribution;
use crate::graded_class::GradedClass;
use crate::regrade_diff::Changes;
use crate::similar_pairs::SimilarPair;
use crate::summary::{Cause, ClassSummary, Outlier};
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
    let title = format!("{submissions}, {} exam", class.exam);
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
                        (summary.missing) " without a submission."
                    }
                }
                main {
                    (attention(&summary.outliers))
                    (distribution(summary))
                    (causes(&summary.causes))
                    (failure_rates(summary))
                    (times::section(class))
                    (changes::sections(changes))
                    (submissions::section(class))
                    (similar::section(class, similar))
                }
                footer {
                    p {
                        "Exam " code { (sanitized(&class.exam)) } ", "
                        code { (sanitized(class.exam_hash.get(..12).unwrap_or_default())) }
                        "; isolation " code { (sanitized(&class.isolation)) }
                        ". The same data for programs: "
                        code { "class.json" } ", " code { "grades.csv" } ", in the same folder."
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

fn distribution(summary: &ClassSummary) -> Markup {
    let all = summary.points.iter().map(|points| ("All tasks", points));
    let tasks = summary
        .tasks
        .iter()
        .map(|task| (task.title.as_str(), &task.points));
    html! {
        section aria-labelledby="spread" {
            h2 #spread { "Points" }
            div .wide tabindex="0" role="region" aria-labelledby="spread" { table {
                caption { "Number of submissions (upwards) by points (to the right), in tenths of the maximum" }
                thead {
                    tr {
                        th scope="col" { "Task" }
                        th scope="col" { "Distribution" }
                        th scope="col" .number { "Mean" }
                        th scope="col" .number { "Median" }
                        th scope="col" .number { "Maximum" }
                    }
                }
                tbody {
                    @for (title, distribution) in all.chain(tasks) {
                        tr {
                            th scope="row" { (sanitized(title)) }
                            td { (bars(distribution)) }
                            td .number { (format!("{:.1}", distribution.mean)) }
                            td .number { (distribution.median) }
                            td .number { (distribution.of) }
                        }
                    }
                }
            } }
        }
    }
}

/// Renders a distribution as ten columns with axes, and the numbers as text for screen readers.
fn bars(distribution: &Distribution) -> Markup {
    let highest = distribution.bins.iter().max().copied().unwrap_or(0).max(1);
    let counts: Vec<String> = distribution.bins.iter().map(ToString::to_string).collect();
    let label = format!(
        "from the lowest tenth to the highest: {}",
        counts.join(", ")
    );
    let columns = distribution.bins.iter().enumerate();
    let columns = columns.map(|(index, count)| (12 * index, 40.0 * *count as f64 / highest as f64));
    html! {
        svg .bars viewBox="-16 -4 142 60" role="img" aria-label=(label) {
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
    html! {
        @if !outliers.is_empty() {
            section aria-labelledby="look" {
                h2 #look { "Submissions that need attention" }
                ul {
                    @for outlier in outliers {
                        @let link = outlier.has_report.then(|| submissions::report_link(&outlier.id));
                        li {
                            strong { a href=[link] { (sanitized(&outlier.title())) } }
                            ": " (sanitized(&outlier.why))
                        }
                    }
                }
            }
        }
    }
}

fn causes(causes: &[Cause]) -> Markup {
    html! {
        section aria-labelledby="causes" {
            h2 #causes { "Root causes of lost points" }
            @if causes.is_empty() { p { "Nobody lost a point." } }
            ul .counted {
                @for cause in causes {
                    li {
                        strong { (cause.count) " × " } (prose(&cause.text))
                        @for item in &cause.items { " " code { (sanitized(item)) } }
                    }
                }
            }
        }
    }
}

/// Renders how often each task and item was failed, in each section. Items are collapsed.
fn failure_rates(summary: &ClassSummary) -> Markup {
    let table = |of_items: bool| {
        let rates = summary.failed.iter();
        let rates = rates.filter(|rate| rate.id.contains('.') == of_items);
        html! {
            div .wide tabindex="0" role="region" aria-labelledby="rates" { table {
                thead { tr {
                    th scope="col" { @if of_items { "Item" } @else { "Task" } }
                    @for (section, graded) in &summary.sections {
                        th scope="col" .number { (sanitized(section)) " (" (graded) ")" }
                    }
                } }
                tbody { @for rate in rates { tr {
                    th scope="row" { code { (sanitized(&rate.id)) } }
                    @for (section, graded) in &summary.sections {
                        @let count = rate.counts.get(section).copied().unwrap_or(0);
                        td .number { (count) " (" (100 * count / graded) " %)" }
                    }
                } } }
            } }
        }
    };
    html! {
        section aria-labelledby="rates" {
            h2 #rates { "Submissions without full points, in each section" }
            (table(false))
            details { summary { "Each item" } (table(true)) }
        }
    }
}

/// Returns untrusted text, shortened and without control characters that could affect the text
/// around it.
fn sanitized(text: &str) -> Markup {
    html! { (sanitize(text, 1_000)) }
}
