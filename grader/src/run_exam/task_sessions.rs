//! Grades the items of one task. An item that depends on a failed item is graded with substituted
//! parts.

use std::io;

use judging::exam::Item;
use judging::recognise::Observations;
use protocol::Answer;

use crate::build::{Build, SubstitutedProgram};
use crate::probe::{Allowance, TimeUsed};
use crate::run_exam::task_session::{TaskSession, TimeSpent};
use crate::score::ItemScore;
use crate::verdict::item_outcome::{ItemOutcome, NotRunReason};
use crate::verdict::{blocked_score, item_score, substituted_score, unwritten_score};

/// An item that earned no points and that another item depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BlockingItem<'a> {
    /// Its id.
    pub id: &'a str,
    /// Whether its task was stopped early.
    pub is_of_stopped_task: bool,
}

/// The results of a task, apart from the scores of its items.
#[derive(Debug)]
pub struct FinishedTask {
    /// Whether the task was stopped before all its items were run.
    pub is_stopped: bool,
    /// Time spent, by activity.
    pub spent: TimeSpent,
    /// The part of the submission's time budget that the task has used.
    pub used: TimeUsed,
    /// The submission's output.
    pub printed: Option<String>,
    /// The observations from the submission's own program.
    pub own: Observations,
    /// The observations from the program with substituted parts, if it was used.
    pub substituted: Option<Observations>,
}

/// The processes of one task: the submission's own program and, if needed, the one with substituted
/// parts.
pub struct TaskSessions<'a> {
    build: &'a Build,
    own: TaskSession<'a>,
    /// Whether the submission's own program had a fault in an item that depends on a failed item.
    has_blocked_fault: bool,
    substituted: Option<TaskSession<'a>>,
}

impl<'a> TaskSessions<'a> {
    /// Creates the sessions. Their processes aren't started until the first item.
    pub fn new(build: &'a Build) -> Self {
        TaskSessions {
            build,
            own: TaskSession::new(build, build.probe.as_deref()),
            has_blocked_fault: false,
            substituted: None,
        }
    }

    /// Grades one item and returns its score and answers. `blocking` is the first item without
    /// points that this item depends on.
    pub fn grade_item(
        &mut self,
        item: &Item,
        blocking: Option<BlockingItem>,
        allowance: &mut Allowance,
    ) -> io::Result<(ItemScore, Vec<Answer>)> {
        let handed_out = self.build.handed_out;
        let file = handed_out.assignment.info(item.task).file;
        if let Some(why) = self.build.not_compiled.get(file) {
            let outcome = ItemOutcome::NotCompiled(why);
            return Ok((item_score(item, &outcome, handed_out), Vec::new()));
        }
        // If the blocking item's task was stopped, or if another blocked item had a fault, this
        // item would be stopped for the same reason.
        let is_hopeless =
            blocking.is_some_and(|blocking| blocking.is_of_stopped_task || self.has_blocked_fault);
        let (outcome, answers) = if is_hopeless {
            (
                ItemOutcome::NotRun(NotRunReason::NeedsStoppedTask),
                Vec::new(),
            )
        } else {
            self.own.ask(item, blocking.is_some(), allowance)?
        };
        match blocking {
            Some(_) => self.has_blocked_fault |= matches!(outcome, ItemOutcome::Fault { .. }),
            None => self.own.count_fault(&outcome),
        }
        let line = item_score(item, &outcome, handed_out);
        // Code that isn't written yet depends on nothing. Its own `todo!` is more informative.
        if let Some(method) = self.build.methods.get(&item.task)
            && !method.is_changed
            && line.points == 0
            && line.at.as_ref().is_none_or(|at| at.file != file)
        {
            return Ok((
                unwritten_score(item, file, method.line, handed_out),
                answers,
            ));
        }
        let Some(by) = blocking.map(|blocking| blocking.id) else {
            return Ok((line, answers));
        };
        match self.build.substituted_program(file)? {
            SubstitutedProgram::NoReference => Ok((blocked_score(by, line, !is_hopeless), answers)),
            SubstitutedProgram::NotCompiled if is_hopeless => {
                Ok((blocked_score(by, line, false), answers))
            }
            SubstitutedProgram::NotCompiled => Ok((line, answers)),
            SubstitutedProgram::Program(program) => {
                let substituted = self
                    .substituted
                    .get_or_insert_with(|| TaskSession::new(self.build, Some(program)));
                let (outcome, answers) = substituted.ask(item, false, allowance)?;
                substituted.count_fault(&outcome);
                let substituted_item = item_score(item, &outcome, handed_out);
                Ok((substituted_score(by, &line, substituted_item), answers))
            }
        }
    }

    /// Ends the processes. Returns the results that are only known at the end. `used` is the time
    /// that the task has taken from the submission's budget.
    pub fn finish(mut self, used: TimeUsed) -> FinishedTask {
        let substituted = self.substituted;
        let substituted_spent = substituted.as_ref().map(TaskSession::spent);
        FinishedTask {
            is_stopped: self.own.is_stopped(),
            spent: self.own.spent() + substituted_spent.unwrap_or_default(),
            used,
            printed: self.own.printed(),
            substituted: substituted.map(TaskSession::into_observations),
            own: self.own.into_observations(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::probe::Budget;
    use crate::score::Verdict;
    use crate::score::tests::small_exam::{boxes, item};

    #[test]
    fn an_item_is_not_run_if_what_it_depends_on_would_stop_it() {
        let folder = tempfile::tempdir().unwrap();
        let build = Build::without_programs(folder.path(), BTreeMap::new());
        let item = item("traverse.root", vec![boxes(1)]);
        let blocking = |is_of_stopped_task| BlockingItem {
            id: "bbox.flat",
            is_of_stopped_task,
        };
        let verdict = |blocking, has_blocked_fault: bool| {
            let mut sessions = TaskSessions::new(&build);
            sessions.has_blocked_fault = has_blocked_fault;
            let mut allowance = Allowance::new(Budget::default(), TimeUsed::default());
            let graded = sessions.grade_item(&item, blocking, &mut allowance);
            graded.unwrap().0.verdict
        };
        let blocked = Verdict::Blocked {
            by: "bbox.flat".to_owned(),
        };
        assert_eq!(verdict(Some(blocking(true)), false), blocked);
        assert_eq!(verdict(Some(blocking(false)), true), blocked);
        // Otherwise, the item is run. It stays pending here, because the submission has no program.
        assert_eq!(verdict(Some(blocking(false)), false), Verdict::Pending);
        assert_eq!(verdict(None, true), Verdict::Pending);
    }
}
