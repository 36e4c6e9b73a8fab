//! Renders the section on a task, with its items, and the section on the submitted files.

use judging::describe;
use judging::exam::Item;
use maud::{Markup, PreEscaped, html};

use super::Page;
use super::elements::{command, evidence_table, plain_text, prose};
use super::pictures;
use crate::drawing;
use crate::report::answers::ReportAnswers;
use crate::report::failing_items::most_informative_first;
use crate::score::{ItemScore, Score, TaskScore, Verdict, VerdictKind};
use crate::workspace::book::Book;

/// Renders the files that didn't compile and the notes. Renders nothing if there are neither.
pub(super) fn files(score: &Score) -> Markup {
    let build = &score.build;
    if build.not_compiled.is_empty() && build.all_notes().next().is_none() {
        return html! {};
    }
    html! {
        section aria-labelledby="files" {
            h2 #files { "Your files" }
            @for file in &build.not_compiled {
                h3 { code { (plain_text(&file.file)) } " was not used" }
                pre { (plain_text(&file.message)) }
            }
            @if build.all_notes().next().is_some() {
                ul .notes {
                    @for note in build.all_notes() { li { (plain_text(note)) } }
                }
            }
        }
    }
}

/// Renders one task: failing items first, then the printed output, then the passed items.
pub(super) fn section(page: &Page, task: &TaskScore) -> Markup {
    let failing = most_informative_first(task);
    let is_passed = |item: &&ItemScore| item.points == item.max_points;
    let passed: Vec<&ItemScore> = task.items.iter().filter(is_passed).collect();
    html! {
        section aria-labelledby=(task.id) {
            h2 #(task.id) {
                (task.title)
                span .points { " " (task.points) " / " (task.max_points) }
            }
            @if !task.relevant_warnings().is_empty() {
                p { "The compiler warns:" }
                ul .notes {
                    @for warning in task.relevant_warnings() { li { (plain_text(warning)) } }
                }
            }
            @for (index, score) in failing.iter().enumerate() {
                // Only open the first item, which is enough to start with.
                (failing_item(page, score, index == 0))
            }
            @if let Some(printed) = &task.printed {
                details #(format!("{}-printed", task.id)) .printed {
                    summary { "What your code printed" }
                    pre { (plain_text(printed)) }
                }
            }
            @if !passed.is_empty() {
                details #(format!("{}-passed", task.id)) .passed {
                    summary { "✓ " (passed.len()) " passed" }
                    ul {
                        @for score in &passed {
                            li { (passed_item(page, score)) }
                        }
                    }
                }
            }
        }
    }
}

/// Renders an item that lost points: what happened, where to look and how to run the item again.
fn failing_item(page: &Page, score: &ItemScore, is_open: bool) -> Markup {
    let item = exam_item(page, score);
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
                (figure(score, item, page.answers))
                (look(score, page.book))
                (hints(score))
                @if let Some(rerun) = page.rerun {
                    p .rerun { "Run it again: " (command(&score.rerun_command(rerun))) }
                    @if let Some(view) = score.view_command(rerun) {
                        p .rerun { "See what your code does: " (command(&view)) }
                    }
                    @if let Some(item) = item { (pictures::failing(item, page.answers, rerun)) }
                }
            }
        }
    }
}

/// Renders an item with full points.
fn passed_item(page: &Page, score: &ItemScore) -> Markup {
    html! {
        (plain_text(&score.title)) " "
        span .facts {
            span .points { (score.points) " / " (score.max_points) } " "
            code { (plain_text(&score.id)) }
        }
        @if let Some(item) = exam_item(page, score) { (pictures::passed(item, page.answers)) }
    }
}

/// Returns the exam's item, if the reader may see it.
fn exam_item<'a>(page: &Page<'a>, score: &ItemScore) -> Option<&'a Item> {
    page.exam.items.iter().find(|item| item.id == score.id)
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
        (None, Some(item)) => missing_evidence(score, item),
        (None, None) => html! {},
    }
}

/// Renders the three rows for an item without evidence, which explain why there is none.
fn missing_evidence(score: &ItemScore, item: &Item) -> Markup {
    let first = item.questions.first();
    let first = first.filter(|question| question.question.count() > 0);
    let all = format!("{} questions, one after another", item.count());
    match &score.verdict {
        Verdict::Unimplemented => {
            let got = "no answer: the method is not written yet";
            // The first question shows what the code should do.
            match first {
                Some(first) => evidence_table(
                    &describe::element(&first.question, 0),
                    got,
                    &describe::answer::wanted(first, 0).join(", or "),
                ),
                None => evidence_table(&all, got, "an answer to each question"),
            }
        }
        Verdict::NotCompiled => evidence_table(
            "nothing: the file is not part of the program",
            "no answer",
            "a file that compiles",
        ),
        Verdict::Blocked { by } => evidence_table(
            &all,
            &format!("answers that can't be judged yet because they depend on {by}"),
            &format!("fix {by} first"),
        ),
        Verdict::Pending => evidence_table(
            "nothing yet",
            "no answer",
            "a run that stays within its limits",
        ),
        Verdict::Pass
        | Verdict::Partial
        | Verdict::Wrong
        | Verdict::Panicked
        | Verdict::TimedOut
        | Verdict::OutOfMemory
        | Verdict::Crashed
        | Verdict::Protocol => {
            let got = format!("no answer: {}", score.message);
            evidence_table(&all, &got, "an answer to each question")
        }
    }
}

/// Renders the advice on where to look in the code and which section to read, with a link if there
/// is a book.
fn look(score: &ItemScore, book: Option<&Book>) -> Markup {
    html! {
        @if let Some(look) = score.where_to_look() {
            p .look { strong { "Look: " } (prose(look)) }
        }
        @if let Some(section) = score.where_to_read() {
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

/// Renders each hint's nudge, with the full hint in a collapsed section.
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

/// Renders a drawing of the question with the wrong answer, if it can be drawn. If the code isn't
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
                // Escaping is unnecessary here, because the text in the drawing has already been
                // escaped.
                (PreEscaped(drawing.svg))
                figcaption { (plain_text(&drawing.caption)) }
            }
        }
    }
}
