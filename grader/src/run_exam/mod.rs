//! Runs an exam item by item. A failure in one item doesn't affect the next.

mod leaked_state;
pub mod task_session;

use std::collections::BTreeSet;
use std::io;
use std::time::Instant;

use judging::assignment::Task;
use judging::exam::{Exam, Item};
use protocol::Answer;

use crate::build::{Build, SubstitutedProgram};
use crate::probe::{Allowance, Budget};
use crate::report::answers::ReportAnswers;
use crate::run_exam::task_session::{TaskSession, TimeSpent};
use crate::score::{ItemScore, Score};
use crate::verdict::explain::explain_items;
use crate::verdict::item_outcome::{ItemOutcome, NotRun};
use crate::verdict::{blocked_score, blocking_item, item_score, substituted_score};

/// Grades every item of `exam` and records its score. After each item, `progress` is called with
/// the score and the answers to draw. If `progress` returns an error, grading stops.
pub fn run_exam<E: From<io::Error>>(
    exam: &Exam,
    build: &Build,
    budget: Budget,
    score: &mut Score,
    mut progress: impl FnMut(&mut Score, &ReportAnswers) -> Result<(), E>,
) -> Result<(), E> {
    let mut report_answers = ReportAnswers::default();
    let mut allowance = Allowance::new(budget);
    let mut stopped = BTreeSet::new();
    for task in build.handed_out.assignment.tasks() {
        let items: Vec<&Item> = exam.items.iter().filter(|item| item.task == task).collect();
        // Use one process per task, so that a task cannot affect the next.
        let mut sessions = TaskSessions::new(build);
        for item in items {
            let (line, answers) = sessions.grade_item(item, score, &stopped, &mut allowance)?;
            report_answers.record(item, &line, answers);
            score.record(line);
            score.update_totals();
            progress(score, &report_answers)?;
        }
        if sessions.own.is_stopped() {
            stopped.insert(task);
        }
        let spent = sessions.spent();
        score.timings.stages.asking.push((task, spent.asking));
        if let Some(scores) = score.tasks.iter_mut().find(|scores| scores.id == task) {
            let started_at = Instant::now();
            scores.printed = sessions.finish(exam, &mut scores.items);
            let stages = &mut score.timings.stages;
            stages.start += spent.start;
            stages.judging += spent.judging + started_at.elapsed();
        }
    }
    score.complete = true;
    progress(score, &report_answers)
}

/// The processes of one task: the submission's own program and, if needed, the one with substituted
/// parts.
struct TaskSessions<'a> {
    build: &'a Build,
    own: TaskSession<'a>,
    /// Whether the submission's own program had a fault in an item that depends on a failed item.
    has_blocked_fault: bool,
    substituted: Option<TaskSession<'a>>,
}

impl<'a> TaskSessions<'a> {
    fn new(build: &'a Build) -> Self {
        TaskSessions {
            build,
            own: TaskSession::new(build, build.probe.as_deref()),
            has_blocked_fault: false,
            substituted: None,
        }
    }

    /// Grades one item and returns its score and answers. The items it depends on must already be
    /// graded. `stopped` lists the tasks that were stopped early.
    fn grade_item(
        &mut self,
        item: &Item,
        others: &Score,
        stopped: &BTreeSet<Task>,
        allowance: &mut Allowance,
    ) -> io::Result<(ItemScore, Vec<Answer>)> {
        let handed_out = self.build.handed_out;
        let file = handed_out.assignment.info(item.task).file;
        if let Some(why) = self.build.not_compiled.get(file) {
            let outcome = ItemOutcome::NotCompiled(why);
            return Ok((item_score(item, &outcome, handed_out), Vec::new()));
        }
        let blocking = blocking_item(item, others);
        // The reason that stopped that task, or another item that depends on it, would stop this
        // item too.
        let is_hopeless = blocking
            .is_some_and(|blocking| stopped.contains(&blocking.task) || self.has_blocked_fault);
        let (outcome, answers) = if is_hopeless {
            (ItemOutcome::NotRun(NotRun::NeedsStoppedTask), Vec::new())
        } else {
            self.own.ask(item, allowance)?
        };
        match blocking {
            Some(_) => self.has_blocked_fault |= matches!(outcome, ItemOutcome::Fault { .. }),
            None => self.own.count_fault(&outcome),
        }
        let line = item_score(item, &outcome, handed_out);
        let Some(by) = blocking.map(|blocking| blocking.id) else {
            return Ok((line, answers));
        };
        match self.build.substituted_program(file)? {
            SubstitutedProgram::NoReference => Ok((blocked_score(by, line), answers)),
            SubstitutedProgram::NotCompiled if is_hopeless => {
                Ok((blocked_score(by, line), answers))
            }
            SubstitutedProgram::NotCompiled => Ok((line, answers)),
            SubstitutedProgram::Program(program) => {
                let substituted = self
                    .substituted
                    .get_or_insert_with(|| TaskSession::new(self.build, Some(program)));
                let (outcome, answers) = substituted.ask(item, allowance)?;
                substituted.count_fault(&outcome);
                let substituted_item = item_score(item, &outcome, handed_out);
                Ok((substituted_score(by, &line, substituted_item), answers))
            }
        }
    }

    /// Returns the time spent by both processes.
    fn spent(&self) -> TimeSpent {
        let substituted = self.substituted.as_ref().map(TaskSession::spent);
        self.own.spent() + substituted.unwrap_or_default()
    }

    /// Adds hints, which need the answers to the whole task. Returns the submission's output.
    fn finish(mut self, exam: &Exam, lines: &mut [ItemScore]) -> Option<String> {
        let substituted = self.substituted.as_ref().map(TaskSession::observations);
        let own = self.own.observations();
        explain_items(exam, lines, own, substituted, self.build.handed_out);
        self.own.printed()
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::build::NotCompiled;
    use crate::handed_out::RAYS;
    use crate::score::Verdict;
    use crate::score::tests::small_exam::{boxes, exam, item, pending};

    #[test]
    fn every_item_of_a_submission_that_does_not_compile_is_recorded() {
        let folder = tempfile::tempdir().unwrap();
        let why = NotCompiled::MissingDeclaration("x");
        let files = RAYS.file_names().map(|file| (file, why.clone()));
        let build = Build::without_programs(folder.path(), files.collect());
        let exam = exam(&["sphere.uv", "bbox.flat", "sphere.normal"]);
        let mut score = pending(&exam);
        let mut progress = Vec::new();
        run_exam(&exam, &build, Budget::default(), &mut score, |score, _| {
            let items = score.items();
            let items = items.filter(|item| item.verdict == Verdict::Pending);
            progress.push((items.count(), score.complete));
            io::Result::Ok(())
        })
        .unwrap();
        assert_eq!(progress, [(2, false), (1, false), (0, false), (0, true)]);
        let mut items = score.items();
        assert!(items.all(|item| item.verdict == Verdict::NotCompiled));
        assert!(score.tasks.iter().all(|task| task.printed.is_none()));
        let asked = score.timings.stages.asking.iter().map(|(task, _)| *task);
        assert!(asked.eq(RAYS.assignment.tasks()));
    }

    #[test]
    fn grading_stops_if_the_progress_cannot_be_written() {
        let folder = tempfile::tempdir().unwrap();
        let build = Build::without_programs(folder.path(), BTreeMap::new());
        let exam = exam(&["sphere.uv", "sphere.normal"]);
        let mut score = pending(&exam);
        let mut calls = 0;
        let stopped = run_exam(&exam, &build, Budget::default(), &mut score, |_, _| {
            calls += 1;
            Err(io::Error::other("the disk is full"))
        });
        assert!(stopped.is_err());
        assert_eq!((calls, score.complete), (1, false));
    }

    #[test]
    fn an_item_is_not_run_if_what_it_depends_on_would_stop_it() {
        let folder = tempfile::tempdir().unwrap();
        let build = Build::without_programs(folder.path(), BTreeMap::new());
        let others = pending(&exam(&["bbox.flat"]));
        let bbox = Task::in_id("bbox.flat").unwrap();
        let mut dependent = item("traverse.root", vec![boxes(1)]);
        dependent.needs = vec!["bbox.flat".to_owned()];
        let verdict = |item: &Item, stopped: &[Task], has_blocked_fault: bool| {
            let mut sessions = TaskSessions::new(&build);
            sessions.has_blocked_fault = has_blocked_fault;
            let stopped = stopped.iter().copied().collect();
            let mut allowance = Allowance::new(Budget::default());
            let graded = sessions.grade_item(item, &others, &stopped, &mut allowance);
            graded.unwrap().0.verdict
        };
        let blocked = Verdict::Blocked {
            by: "bbox.flat".to_owned(),
        };
        assert_eq!(verdict(&dependent, &[bbox], false), blocked);
        assert_eq!(verdict(&dependent, &[], true), blocked);
        // Otherwise, it is run, here on a submission without a program.
        assert_eq!(verdict(&dependent, &[], false), Verdict::Pending);
        let independent = item("traverse.flat", vec![boxes(1)]);
        assert_eq!(verdict(&independent, &[bbox], true), Verdict::Pending);
    }
}
