//! Renders one item of a task.

use judging::describe;
use judging::exam::Item;
use maud::{Markup, PreEscaped, html};

use super::elements::{command, evidence_table, plain_text};
use super::pictures;
use super::prose::prose;
use crate::drawing;
use crate::report::answers::ReportAnswers;
use crate::score::rerun_command::RerunCommand;
use crate::score::{ItemScore, Verdict, VerdictKind};
use crate::workspace::book::Book;

/// Renders an item that lost points: what happened, where to look, and how to run the item again.
pub(super) fn failing(
    score: &ItemScore,
    item: Option<&Item>,
    answers: &ReportAnswers,
    rerun: Option<&RerunCommand>,
    book: Option<&Book>,
    is_open: bool,
) -> Markup {
    html! {
        details .item id=(score.id) open[is_open] {
            summary {
                h3 { (plain_text(&score.title)) }
                span .facts {
                    (verdict(score))
                    span .points { (score.points) " / " (score.max_points) }
                    code { (plain_text(&score.id)) }
                }
            }
            div .body {
                @if !score.message.is_empty() { p { (plain_text(&score.message)) } }
                (evidence(score, item))
                (figure(score, item, answers))
                (look(score, book))
                (hints(score))
                @if let Some(rerun) = rerun {
                    p .rerun { "Run it again: " (command(&score.rerun_command(rerun))) }
                    @if let Some(view) = score.view_command(rerun) {
                        p .rerun { "See what your code does: " (command(&view)) }
                    }
                    @if let Some(item) = item { (pictures::failing(item, answers, rerun)) }
                }
            }
        }
    }
}

/// Renders an item with full points.
pub(super) fn passed(score: &ItemScore, item: Option<&Item>, answers: &ReportAnswers) -> Markup {
    html! {
        (plain_text(&score.title)) " "
        span .facts {
            span .points { (score.points) " / " (score.max_points) } " "
            code { (plain_text(&score.id)) }
        }
        @if let Some(item) = item { (pictures::passed(item, answers)) }
    }
}

/// Renders the verdict, both as a symbol and as text.
fn verdict(score: &ItemScore) -> Markup {
    let (class, sign) = match score.verdict.kind() {
        VerdictKind::Passed => ("good", "✓"),
        VerdictKind::Failed if score.verdict == Verdict::Partial => ("part", "◐"),
        VerdictKind::Failed | VerdictKind::NoAnswer | VerdictKind::NotCompiled => ("bad", "✗"),
        VerdictKind::Unwritten | VerdictKind::Blocked | VerdictKind::Pending => ("none", "–"),
    };
    html! {
        span class=(format!("verdict {class}")) { (sign) " " (score.verdict.label()) }
    }
}

/// Renders the rows `asked`, `got` and `wanted`, or nothing if the reader may not see the item.
fn evidence(score: &ItemScore, item: Option<&Item>) -> Markup {
    match (&score.evidence, item) {
        (Some(evidence), _) => evidence_table(&evidence.asked, &evidence.got, &evidence.wanted),
        (None, Some(item)) => {
            let (asked, got, wanted) = missing_evidence(score, item);
            evidence_table(&asked, &got, &wanted)
        }
        (None, None) => html! {},
    }
}

/// Returns the three rows for an item without evidence, which explain why there is none.
fn missing_evidence(score: &ItemScore, item: &Item) -> (String, String, String) {
    let count = item.count();
    let first = item.questions.first();
    let first = first.filter(|question| question.question.count() > 0);
    let rows = |asked: &str, got: &str, wanted: &str| {
        (asked.to_owned(), got.to_owned(), wanted.to_owned())
    };
    let all = format!("{count} questions, one after the other");
    match &score.verdict {
        // The first question shows what the code should do.
        Verdict::Unimplemented => match first {
            Some(first) => (
                describe::element(&first.question, 0),
                "no answer: it is not written yet".to_owned(),
                describe::answer::wanted(first, 0).join(", or "),
            ),
            None => rows(
                &all,
                "no answer: it is not written yet",
                "an answer to each",
            ),
        },
        Verdict::NotCompiled => rows(
            "nothing: the file is not part of the program",
            "no answer",
            "a file that compiles",
        ),
        Verdict::Blocked { by } => rows(
            &all,
            &format!("answers that depend on {by}, so they cannot be judged yet"),
            &format!("fix {by} first"),
        ),
        Verdict::Pending => rows("nothing yet", "no answer", "a run that is not stopped"),
        Verdict::Pass
        | Verdict::Partial
        | Verdict::Wrong
        | Verdict::Panicked
        | Verdict::TimedOut
        | Verdict::OutOfMemory
        | Verdict::Crashed
        | Verdict::Protocol => (
            all,
            format!("no answer: {}", score.message),
            "an answer to each".to_owned(),
        ),
    }
}

/// Renders where to look in the code, and what to read, with a link if there is a book.
fn look(score: &ItemScore, book: Option<&Book>) -> Markup {
    html! {
        @if let Some(look) = score.where_to_look() {
            p .look { strong { "Look: " } (prose(look)) }
        }
        @if let Some(section) = &score.section {
            p .look {
                strong { "Read: " }
                @match book.and_then(|book| book.url(section)) {
                    Some(url) => a href=(url) { (plain_text(&section.location())) },
                    None => (plain_text(&section.location())),
                }
            }
        }
    }
}

/// Renders each hint: the nudge, and the full hint in a folded section.
fn hints(score: &ItemScore) -> Markup {
    html! {
        @for (index, hint) in score.hints.iter().enumerate() {
            div .hint {
                p {
                    strong { @if index == 0 { "Hint: " } @else { "Or: " } }
                    (prose(&hint.nudge))
                }
                details #(format!("{}-hint-{index}", score.id)) {
                    summary { "Show what is wrong" }
                    p { (prose(&hint.hint)) }
                }
            }
        }
    }
}

/// Renders a drawing of the question that went wrong, if it can be drawn. If the code is not
/// written yet, draws the first question.
fn figure(score: &ItemScore, item: Option<&Item>, answers: &ReportAnswers) -> Markup {
    let number = match (&score.evidence, &score.verdict) {
        (Some(evidence), _) => Some(evidence.number),
        (None, Verdict::Unimplemented) => Some(1),
        (None, _) => None,
    };
    let drawing = number.zip(item).and_then(|(number, item)| {
        let (question, element) = item.element(number)?;
        let answer = answers.answer(&item.id, question);
        drawing::draw(&item.questions[question], element, answer)
    });
    html! {
        @if let Some(drawing) = drawing {
            figure .drawing {
                // This is safe without escaping, because the drawing has already escaped its text.
                (PreEscaped(drawing.svg))
                figcaption { (plain_text(&drawing.caption)) }
            }
        }
    }
}
