//! The outcome of running one item, before it is scored.

use judging::judge::{Credit, Failure, Judgement};

use crate::build::NotCompiled;
use crate::probe::Fault;

/// The outcome of running one item.
#[derive(Clone, Debug)]
pub enum ItemOutcome<'a> {
    /// The item hasn't been run yet.
    Pending,
    /// The task's file isn't part of the program.
    NotCompiled(&'a NotCompiled),
    /// The item was not answered.
    Fault {
        /// The fault that prevented an answer.
        fault: Fault,
        /// Indices of the question and the element that cause the fault when run in isolation, if
        /// known.
        culprit: Option<(usize, usize)>,
    },
    /// The item was not run.
    NotRun(NotRunReason),
    /// Every question has an answer.
    Answered {
        /// The judgements of the answers.
        judgements: Vec<Judgement>,
        /// Whether the question with the wrong answer shown in the report is answered correctly
        /// when it is rerun in isolation.
        right_alone: bool,
    },
}

/// The reason an item was not run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotRunReason {
    /// Other items of its task ended with this fault, so the task was stopped.
    TaskStopped(Fault),
    /// It depends on a task that was stopped.
    NeedsStoppedTask,
    /// The submission has used up its time.
    BudgetUsedUp,
}

impl ItemOutcome<'_> {
    /// Returns the outcome with these judgements, for questions that were not rerun in isolation.
    pub fn answered(judgements: Vec<Judgement>) -> Self {
        ItemOutcome::Answered {
            judgements,
            right_alone: false,
        }
    }

    /// Returns whether all answers are right.
    pub fn is_pass(&self) -> bool {
        let ItemOutcome::Answered { judgements, .. } = self else {
            return false;
        };
        let mut judgements = judgements.iter();
        judgements.all(|judgement| judgement.credit == Credit::FULL)
    }
}

/// Returns the failure shown in an item's report and the index of its question. An item gets the
/// credit of its worst question, so the report shows that question's failure. Returns `None` if all
/// answers are right, or if there is no answer to the worst question.
pub fn worst_failure(judgements: &[Judgement]) -> Option<(usize, &Failure)> {
    let worst = judgements.iter().map(|judgement| judgement.credit).min()?;
    if worst == Credit::FULL {
        return None;
    }
    let mut all = judgements.iter().enumerate();
    let (question, judgement) = all.find(|(_, judgement)| judgement.credit == worst)?;
    Some((question, judgement.failure.as_ref()?))
}
