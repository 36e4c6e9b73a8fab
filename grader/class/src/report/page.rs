//! `class.html`: the class on one self-contained page, with everyone's points, their distribution,
//! the most common mistakes, and a link to each report.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use grader::svg::number;
use judging::sanitize::sanitize;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use sha2::{Digest, Sha256};

use crate::distribution::Distribution;
use crate::model::{ClassRow, GradedClass};
use crate::outcome::ScoreSummary;
use crate::summary::ClassSummary;

const STYLE: &str = include_str!("page.css");

/// Renders the page of a class.
pub fn render_page(class: &GradedClass, summary: &ClassSummary) -> String {
    let count = match class.rows.len() {
        1 => "1 submission".to_owned(),
        count => format!("{count} submissions"),
    };
    let title = format!("{count}, {} exam", class.exam);
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
                    (distribution(summary))
                    (mistake_sections(summary))
                    (submissions_section(class))
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
            }
        }
    };
    page.into_string()
}

/// Returns a content security policy that forbids scripts and external resources, and allows only
/// [`STYLE`].
fn content_security_policy() -> String {
    let hash = STANDARD.encode(Sha256::digest(STYLE));
    format!("default-src 'none'; style-src 'sha256-{hash}'; base-uri 'none'; form-action 'none'")
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
            table {
                caption { "Number of submissions by points: each column is a tenth of the maximum" }
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
            }
        }
    }
}

/// Renders a distribution as ten columns, with the numbers as text for screen readers.
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
        svg .bars viewBox="0 0 118 42" role="img" aria-label=(label) {
            @for (x, height) in columns {
                rect x=(x) y=(number(41.0 - height)) width="10" height=(number(height)) {}
            }
            path d="M0 41.5H118" {}
        }
    }
}

fn mistake_sections(summary: &ClassSummary) -> Markup {
    html! {
        section aria-labelledby="mistakes" {
            h2 #mistakes { "Most common mistakes" }
            @if summary.mistakes.is_empty() { p { "No known mistake was recognised." } }
            ul .counted {
                @for mistake in &summary.mistakes {
                    li { strong { (mistake.count) " × " } (sanitized(&mistake.hint)) }
                }
            }
        }
        section aria-labelledby="failed" {
            h2 #failed { "Items failed most often" }
            ul .counted {
                @for failed in &summary.failed_most {
                    li {
                        strong { (failed.count) " × " }
                        (sanitized(&failed.title)) " " code { (sanitized(&failed.item)) }
                    }
                }
            }
        }
        @if !summary.outliers.is_empty() {
            section aria-labelledby="look" {
                h2 #look { "Submissions that need attention" }
                ul {
                    @for outlier in &summary.outliers {
                        li { strong { (sanitized(&outlier.id)) } ": " (sanitized(&outlier.why)) }
                    }
                }
            }
        }
    }
}

fn submissions_section(class: &GradedClass) -> Markup {
    let first = class.scores().next();
    let tasks = first.map_or(&[][..], |(_, score)| score.tasks.as_slice());
    html! {
        section aria-labelledby="students" {
            h2 #students { "Submissions" }
            div .wide {
                table {
                    thead {
                        tr {
                            th scope="col" { "Who" }
                            th scope="col" .number { "Counts" }
                            th scope="col" .number { "Points" }
                            @for task in tasks { th scope="col" .number { (sanitized(&task.title)) } }
                            th scope="col" { "Notes" }
                        }
                    }
                    tbody {
                        @for row in &class.rows { (submission_row(row, tasks.len())) }
                        @for person in &class.missing {
                            tr {
                                th scope="row" { (sanitized(person.display_name())) }
                                td .number { "–" }
                                td .number { "–" }
                                @for _ in tasks { td {} }
                                td { "nothing submitted" }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn submission_row(row: &ClassRow, tasks: usize) -> Markup {
    let who = sanitized(&row.result.info.display_names());
    html! {
        tr {
            @match row.result.score() {
                Some(score) => (score_cells(row, score, who)),
                None => {
                    th scope="row" { (who) }
                    td .number { "–" }
                    td .number { "–" }
                    @for _ in 0..tasks { td {} }
                    td { strong { (row.status()) } ": " (sanitized(row.why())) }
                },
            }
        }
    }
}

fn score_cells(row: &ClassRow, score: &ScoreSummary, who: Markup) -> Markup {
    let late = row.counted.map_or(0, |counted| counted.late_days);
    let counts = row.counted.map(|counted| counted.points.to_string());
    html! {
        th scope="row" { a href=(report_link(&row.result.id)) { (who) } }
        td .number { strong { (counts.as_deref().unwrap_or("–")) } }
        td .number { (score.points) }
        @for task in &score.tasks {
            td .number .less[task.points < task.max_points] { (task.points) }
        }
        td {
            @if row.counted.is_none() { strong { (row.status()) } ": " (sanitized(row.why())) }
            @else if late == 1 { "1 late day" } @else if late > 1 { (late) " late days" } }
    }
}

/// Returns the link to a report. An id may have letters of any language, which are percent-encoded.
fn report_link(id: &str) -> String {
    let byte = |byte: u8| match byte {
        b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'_' | b'.' => {
            char::from(byte).to_string()
        }
        other => format!("%{other:02X}"),
    };
    let id: String = id.bytes().map(byte).collect();
    format!("students/{id}/report.html")
}

/// Returns untrusted text, shortened and without control characters that could affect the text
/// around it.
fn sanitized(text: &str) -> Markup {
    html! { (sanitize(text, 300)) }
}
