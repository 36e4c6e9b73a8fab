//! One item.

use maud::{Markup, PreEscaped, html};

use super::elements::{command, evidence_table, plain_text};
use super::pictures;
use super::prose::prose;
use crate::describe;
use crate::drawing;
use crate::exam::Item;
use crate::report_answers::ReportAnswers;
use crate::rerun_command::RerunCommand;
use crate::score::{ItemScore, Verdict};

/// An item that lacks points: what happened, where to look, how to ask again.
pub(super) fn failing(
    score: &ItemScore,
    item: Option<&Item>,
    exhibits: &ReportAnswers,
    again: Option<&RerunCommand>,
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
                (figure(score, item, exhibits))
                (look(score))
                (hints(score))
                @if let Some(again) = again {
                    p .again { "Ask it again: " (command(&score.rerun_command(again))) }
                    @if let Some(item) = item { (pictures::failing(item, exhibits, again)) }
                }
            }
        }
    }
}

/// An item with all of its points.
pub(super) fn passed(score: &ItemScore, item: Option<&Item>, exhibits: &ReportAnswers) -> Markup {
    html! {
        (plain_text(&score.title)) " "
        span .facts {
            span .points { (score.points) " / " (score.max_points) } " "
            code { (plain_text(&score.id)) }
        }
        @if let Some(item) = item { (pictures::passed(item, exhibits)) }
    }
}

/// In words; the sign before them says no more.
fn verdict(score: &ItemScore) -> Markup {
    let (class, sign) = match score.verdict {
        Verdict::Pass => ("good", "✓"),
        Verdict::Partial => ("part", "◐"),
        Verdict::Wrong
        | Verdict::Panicked
        | Verdict::TimedOut
        | Verdict::OutOfMemory
        | Verdict::Crashed
        | Verdict::Protocol
        | Verdict::NotCompiled => ("bad", "✗"),
        Verdict::Unimplemented | Verdict::Blocked { .. } | Verdict::Pending => ("none", "–"),
    };
    html! {
        span class=(format!("verdict {class}")) { (sign) " " (score.verdict.label()) }
    }
}

/// Asked, got, wanted. Nothing of an item that its reader is not to know.
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

/// Where there is no evidence, the three say why.
fn missing_evidence(score: &ItemScore, item: &Item) -> (String, String, String) {
    let count = item.count();
    let first = item.questions.first();
    let first = first.filter(|asked| asked.question.count() > 0);
    let three = |asked: &str, got: &str, wanted: &str| {
        (asked.to_owned(), got.to_owned(), wanted.to_owned())
    };
    let all = format!("{count} questions, one after the other");
    match &score.verdict {
        // What is not written yet is asked for by its first question.
        Verdict::Unimplemented => match first {
            Some(first) => (
                describe::element(&first.question, 0),
                "no answer: it is not written yet".to_owned(),
                describe::answer::wanted(first, 0).join(", or "),
            ),
            None => three(
                &all,
                "no answer: it is not written yet",
                "an answer to each",
            ),
        },
        Verdict::NotCompiled => three(
            "nothing: the file is not part of the program",
            "no answer",
            "a file that compiles",
        ),
        Verdict::Blocked { by } => three(
            &all,
            &format!("answers that rest on {by}, so nothing can be said of them"),
            &format!("{by} first"),
        ),
        Verdict::Pending => three("nothing yet", "no answer", "a run that is not stopped"),
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

/// Where to look, and what to read.
fn look(score: &ItemScore) -> Markup {
    html! {
        @if let Some(look) = &score.look {
            p .look { strong { "Look: " } (prose(look)) }
        }
        @if let Some(section) = &score.section {
            p .look { strong { "Read: " } (plain_text(&section.location())) }
        }
    }
}

/// The question that leads there, and folded away what is wrong.
fn hints(score: &ItemScore) -> Markup {
    html! {
        @for (place, hint) in score.hints.iter().enumerate() {
            div .hint {
                p {
                    strong { @if place == 0 { "Hint: " } @else { "Or: " } }
                    (prose(&hint.nudge))
                }
                details #(format!("{}-hint-{place}", score.id)) {
                    summary { "Say what is wrong" }
                    p { (prose(&hint.hint)) }
                }
            }
        }
    }
}

/// The question that went wrong, drawn, where it can be. Of what is not written yet, the first one:
/// that is what is to be written.
fn figure(score: &ItemScore, item: Option<&Item>, exhibits: &ReportAnswers) -> Markup {
    let number = match (&score.evidence, &score.verdict) {
        (Some(evidence), _) => Some(evidence.number),
        (None, Verdict::Unimplemented) => Some(1),
        (None, _) => None,
    };
    let drawing = number.zip(item).and_then(|(number, item)| {
        let (question, element) = item.element(number)?;
        let answer = exhibits.answer(&item.id, question);
        drawing::draw(&item.questions[question], element, answer)
    });
    html! {
        @if let Some(drawing) = drawing {
            figure .drawing {
                // It holds numbers and our own words only.
                (PreEscaped(drawing.svg))
                figcaption { (plain_text(&drawing.caption)) }
            }
        }
    }
}
