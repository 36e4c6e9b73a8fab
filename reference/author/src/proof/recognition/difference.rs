//! The items in which a mistake in a variant answers differently than in the reference.

use grader::probe::Fault;
use judging::exam::{Exam, Item};
use judging::observe::observe;
use judging::signatures::ObservedAnswer;

use crate::solutions::workbench::Answers;

/// Returns the items in which a solution's answers are not those that the exam has recorded of a known
/// mistake, each with the number of answers that differ.
pub(super) fn items_unlike_signature(
    exam: &Exam,
    mistake: &str,
    answers: &[(&Item, Answers)],
) -> Vec<String> {
    let mut known = exam.mistakes.iter();
    let index = known.position(|known| known.id == mistake);
    let mut unlike = Vec::new();
    for (item, answers) in answers {
        let recorded = recorded_answers(item, index);
        let got = answers.as_deref().map(|answers| observe(item, answers));
        let elements = item.signatures.elements.iter().zip(&recorded);
        let differing = elements.filter(|(element, recorded)| {
            let reason = |fault: &Fault| ObservedAnswer::NoAnswer(fault.no_answer_reason());
            match &got {
                Ok(all) => {
                    let got = all.get(**element as usize);
                    !got.is_some_and(|got| got.matches(recorded))
                }
                Err(fault) => !reason(fault).matches(recorded),
            }
        });
        let (count, of) = (differing.count(), recorded.len());
        if count > 0 {
            unlike.push(format!("{} ({count} of {of})", item.id));
        }
    }
    unlike
}

/// Returns the answers to an item's signature elements that the exam has recorded of a mistake.
fn recorded_answers(item: &Item, mistake: Option<usize>) -> Vec<ObservedAnswer> {
    let signatures = &item.signatures;
    let mut answers = signatures.correct_answers.clone();
    let mut all = signatures.mistake_answers.iter();
    let own = all.find(|answers| {
        let mut mistakes = answers.mistakes.iter();
        mistakes.any(|&index| Some(index as usize) == mistake)
    });
    for (element, wrong) in own.iter().flat_map(|own| &own.answers) {
        if let Some(answer) = answers.get_mut(*element as usize) {
            answer.clone_from(wrong);
        }
    }
    answers
}
