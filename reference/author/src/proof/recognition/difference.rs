//! The items in which a mistake in a variant answers differently than in the reference.

use grader::probe::Fault;
use judging::exam::{Exam, Item};
use judging::observe::observe;
use judging::signatures::ObservedAnswer;

use crate::proof::ProofError;
use crate::solutions::Solutions;
use crate::solutions::catalogue::Mistake;
use crate::solutions::sources::Sources;
use crate::solutions::workbench::WorkbenchError;

/// Returns the items of a mistake's task in which a solution's answers are not those that the exam
/// has recorded of the mistake, each with the number of answers that differ.
pub fn items_unlike_signature(
    solutions: &Solutions,
    exam: &Exam,
    mistake: &Mistake,
    sources: &Sources,
) -> Result<Vec<String>, ProofError> {
    let solution = solutions.workbench.build(sources, &mistake.id)?;
    let index = exam
        .mistakes
        .iter()
        .position(|known| known.id == mistake.id);
    let mut unlike = Vec::new();
    for item in exam.items.iter().filter(|item| item.task == mistake.task()) {
        let recorded = recorded_answers(item, index);
        let answers = solution.answers(item).map_err(WorkbenchError::from)?;
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
    Ok(unlike)
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
