//! Finds out whether a wrong answer depends on earlier calls. If so, the question is answered
//! correctly when rerun in isolation, in a new process.

use std::io;

use judging::exam::{Item, Key};
use judging::judge::{Failure, FailureKind, Judgement, element_error};

use crate::probe::{Allowance, Launcher};
use crate::verdict::item_outcome::worst_failure;

/// Reruns, in isolation, the question whose wrong answer the report shows. Returns whether the new
/// answer is correct. The time that the rerun takes is deducted from the allowance.
pub fn is_right_alone(
    launcher: &Launcher,
    item: &Item,
    judgements: &[Judgement],
    allowance: &mut Allowance,
) -> io::Result<bool> {
    let failure = worst_failure(judgements).filter(|(_, failure)| is_answer(failure));
    let Some((index, failure)) = failure else {
        return Ok(false);
    };
    let question = &item.questions[index];
    if let Key::Radiance { .. } | Key::SpreadEvenly { .. } = question.key {
        // A rendered picture is a single question and takes too long to run twice. A single
        // direction is never spread unevenly.
        return Ok(false);
    }
    let Some(limits) = allowance.next_item() else {
        return Ok(false);
    };
    let single = question.single(failure.element);
    let mut probe = launcher.start(allowance.budget().total_cpu())?;
    let answered = probe.ask([&single.question], limits);
    allowance.spend(probe.take_time_used());
    let Ok(answers) = answered else {
        return Ok(false);
    };
    let is_right = |answer| element_error(&single, answer, 0).is_none();
    Ok(answers.first().is_some_and(is_right))
}

/// Returns whether the code has been written and has given an answer.
fn is_answer(failure: &Failure) -> bool {
    match &failure.kind {
        FailureKind::Wrong { .. } | FailureKind::Uneven { .. } => true,
        FailureKind::Panicked(panic) => !panic.is_unimplemented(),
        FailureKind::Protocol(_) => false,
    }
}
