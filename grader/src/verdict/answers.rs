//! The score of an item that the submission answered. The answers can be wrong, and a panic counts
//! as an answer.

use judging::describe;
use judging::exam::Item;
use judging::judge::{Credit, Failure, FailureKind, Judgement};
use judging::sanitize::sanitize;
use judging::scene;
use judging::symptom::{SPREAD, Symptom};
use protocol::Panic;

use super::clue;
use super::item_outcome::worst_failure;
use super::sections::{chapter, explains_crashes, section_on_panic};
use crate::handed_out::HandedOut;
use crate::score::{CodeLocation, Evidence, ItemScore, Verdict};

/// Maximum length of a student's or the compiler's text in a message, in characters.
const MAX_TEXT_CHARS: usize = 2_000;
/// The folder of the test harness, as in the locations of panics. The harness refuses answers that
/// are too large to send.
const HARNESS: &str = "framework/src/harness/";

/// Adds the points for these answers to the score of an item and, if any are wrong, describes the
/// worst failure.
pub(super) fn score_answers(
    item: &Item,
    judgements: &[Judgement],
    score: &mut ItemScore,
    handed_out: &HandedOut,
) {
    let credit = judgements.iter().map(|judgement| judgement.credit).min();
    let credit = credit.unwrap_or(Credit::NONE);
    score.points = credit.apply(item.points);
    if credit == Credit::FULL {
        score.verdict = Verdict::Pass;
        return;
    }
    score.look = Some(item.look.clone());
    score.section = item.section.clone();

    let Some((question, failure)) = worst_failure(judgements) else {
        score.verdict = Verdict::Protocol;
        return;
    };
    let info = handed_out.assignment.info(item.task);
    score.called = info.called_by(&item.questions[question].question);
    let partial = |verdict| match score.points {
        0 => verdict,
        _ => Verdict::Partial,
    };
    let (verdict, got, wanted) = match &failure.kind {
        FailureKind::Wrong {
            what,
            side,
            got,
            wanted,
        } => {
            score.symptom = Some(Symptom {
                what: what.clone().into(),
                side: *side,
            });
            score.wrong_answers = wrong_answers(item, judgements, (question, failure));
            score.message = wrong_answer_message(
                what,
                score.wrong_answers,
                item.number(question, failure.element),
            );
            (partial(Verdict::Wrong), got.clone(), wanted.clone())
        }
        FailureKind::Uneven { got, wanted } => {
            score.symptom = Some(Symptom::of(SPREAD));
            score.message = "wrong: the directions aren't spread evenly".to_owned();
            (partial(Verdict::Wrong), got.clone(), wanted.clone())
        }
        FailureKind::Panicked(panic) if panic.is_unimplemented() => {
            score.verdict = Verdict::Unimplemented;
            let location = sanitize(&panic.location, MAX_TEXT_CHARS);
            let stub = if panic.message.starts_with("not yet") {
                "todo!"
            } else {
                "unimplemented!"
            };
            score.message = format!("{location} still contains `{stub}`");
            score.at = CodeLocation::from_panic(&panic.location, handed_out);
            score.look = None;
            score.section = chapter(item, handed_out);
            return;
        }
        FailureKind::Panicked(panic) => {
            score.message = sanitize(&panic_message(panic), MAX_TEXT_CHARS);
            score.at = CodeLocation::from_panic(&panic.location, handed_out);
            let unknown = score.at.is_some().then_some(clue::UNKNOWN_PANIC);
            score.clue = clue::of_panic(&panic.message)
                .or(unknown)
                .map(str::to_owned);
            if score.clue.is_some() && !explains_crashes(item, info) {
                // The item's advice is about wrong answers.
                score.section =
                    section_on_panic(&panic.message, info).or_else(|| chapter(item, handed_out));
            }
            let wanted = describe::answer::judged(&item.questions[question], failure.element);
            (partial(Verdict::Panicked), "a panic".to_owned(), wanted)
        }
        FailureKind::Protocol(why) => {
            score.verdict = Verdict::Protocol;
            score.message = format!("the program sent an invalid answer: {why}");
            return;
        }
    };
    score.verdict = verdict;
    let mut evidence = evidence(item, (question, failure.element), [got, wanted]);
    if matches!(failure.kind, FailureKind::Uneven { .. }) {
        evidence.asked = describe::all_elements(&item.questions[question].question);
    }
    score.evidence = Some(evidence);
}

/// Returns a message that says where the code panicked.
fn panic_message(Panic { location, message }: &Panic) -> String {
    if location.replace('\\', "/").contains(HARNESS) {
        // The location would look like a mistake in the given code.
        message.clone()
    } else if let Some(library) = library_of(location) {
        // The path differs between machines, and isn't in the student's code.
        format!("a call to {library} panicked: {message}")
    } else {
        format!("panicked at {location}: {message}")
    }
}

/// Returns the name of the library that a panic's location is in, or `None` if it is in the
/// submission or the given code.
fn library_of(location: &str) -> Option<String> {
    let location = location.replace('\\', "/");
    if location.starts_with("/rustc/") {
        return Some("the standard library".to_owned());
    }
    // The path of a crate's sources is `registry/src/INDEX/NAME-VERSION`.
    let (_, source) = location.split_once("/registry/src/")?;
    let (name, _version) = source.split('/').nth(1)?.rsplit_once('-')?;
    Some(format!("the crate {name}"))
}

/// Returns a message that gives the number of wrong answers and says `what` is wrong with the
/// answer shown, which is the one with this number.
fn wrong_answer_message(what: &str, wrong: Option<(usize, usize)>, number: usize) -> String {
    match wrong {
        Some((1, of)) if of > 1 => format!("1 of {of} answers is wrong: {what}"),
        Some((wrong, of)) if of > 1 => {
            format!("{wrong} of {of} answers are wrong; in #{number}: {what}")
        }
        Some(_) | None => format!("wrong: {what}"),
    }
}

/// Returns the number of wrong answers and the total, counted across all questions of the item. The
/// pixels of a rendered picture are counted individually.
fn wrong_answers(
    item: &Item,
    judgements: &[Judgement],
    (question, failure): (usize, &Failure),
) -> Option<(usize, usize)> {
    let (_, of) = failure.count?;
    if of != item.questions[question].question.count() {
        return failure.count;
    }
    let failures = judgements
        .iter()
        .filter_map(|judgement| judgement.failure.as_ref());
    let wrong = failures.map(|failure| failure.count.map_or(1, |(wrong, _)| wrong));
    Some((wrong.sum(), item.count()))
}

/// Returns the evidence for an element of a question, with the submitted and the expected answer.
pub(super) fn evidence(
    item: &Item,
    (question, element): (usize, usize),
    answers: [String; 2],
) -> Evidence {
    let asked = &item.questions[question].question;
    let [got, wanted] = answers;
    Evidence {
        number: item.number(question, element),
        asked: describe::element(asked, element),
        got,
        wanted,
        can_be_shown: scene::can_be_shown(asked),
    }
}
