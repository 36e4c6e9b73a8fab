//! Runs an exam item by item. A failure in one item doesn't affect the next.

mod leaked_state;
mod task_runs;
pub mod task_session;
mod task_sessions;

use std::io;
use std::sync::mpsc::Receiver;
use std::thread;
use std::time::Instant;

use judging::assignment::Task;
use judging::exam::Exam;

use crate::build::Build;
use crate::probe::Budget;
use crate::report::answers::ReportAnswers;
use crate::run_exam::task_runs::{GradedItem, PriorResults, TaskEvent, TaskRuns};
use crate::run_exam::task_sessions::FinishedTask;
use crate::score::Score;
use crate::verdict::explain::explain_items;

/// Grades every item of `exam` and records its score. After each item, in the exam's order,
/// `progress` is called with the score and the answers to draw. If `progress` returns an error,
/// grading stops.
///
/// Up to `threads` tasks run at the same time, which doesn't affect the score.
pub fn run_exam<E: From<io::Error>>(
    exam: &Exam,
    build: &Build,
    budget: Budget,
    threads: usize,
    score: &mut Score,
    progress: impl FnMut(&mut Score, &ReportAnswers) -> Result<(), E>,
) -> Result<(), E> {
    let mut run = ExamRun {
        exam,
        build,
        budget,
        score,
        report_answers: ReportAnswers::default(),
        results: PriorResults::new(exam),
        progress,
    };
    let tasks = exam.tasks_in_order(build.handed_out.assignment);
    let done = run.run_tasks(&tasks, threads)?;
    // When the tasks run one after another, each one knows how much of the budget is left.
    run.run_tasks(&tasks[done..], 1)?;
    run.score.complete = true;
    (run.progress)(run.score, &run.report_answers)
}

/// An exam that is being run. Results are recorded in the exam's order.
struct ExamRun<'a, P> {
    exam: &'a Exam,
    build: &'a Build,
    budget: Budget,
    score: &'a mut Score,
    report_answers: ReportAnswers,
    /// The recorded results.
    results: PriorResults,
    progress: P,
}

impl<P, E> ExamRun<'_, P>
where
    P: FnMut(&mut Score, &ReportAnswers) -> Result<(), E>,
    E: From<io::Error>,
{
    /// Runs these tasks on this many threads. Returns the number of tasks that are done. The others
    /// must be run again, because too little of the budget was left for them.
    fn run_tasks(&mut self, tasks: &[Task], threads: usize) -> Result<usize, E> {
        let results = self.results.clone();
        let (runs, receivers) = TaskRuns::new(self.exam, self.build, self.budget, tasks, results);
        thread::scope(|scope| {
            for _ in 0..threads.min(tasks.len()) {
                scope.spawn(|| runs.work());
            }
            let done = self.record_tasks(tasks, &receivers);
            runs.cancel();
            done
        })
    }

    /// Records the results of tasks as they arrive. Returns the number of tasks that are done.
    fn record_tasks(
        &mut self,
        tasks: &[Task],
        receivers: &[Receiver<TaskEvent>],
    ) -> Result<usize, E> {
        for (done, (task, events)) in tasks.iter().zip(receivers).enumerate() {
            match self.record_items(events)? {
                Some(finished) => self.record_task(*task, finished),
                None => return Ok(done),
            }
        }
        Ok(tasks.len())
    }

    /// Records the scores of a task's items as they arrive. Returns the other results, or `None` if
    /// an item shouldn't have been run, because the tasks before it have used up the budget.
    fn record_items(&mut self, events: &Receiver<TaskEvent>) -> Result<Option<FinishedTask>, E> {
        for event in events {
            match event {
                TaskEvent::Graded(graded) => {
                    let GradedItem {
                        item,
                        line,
                        answers,
                        allowance,
                    } = *graded;
                    if !allowance.holds_after(self.results.used) {
                        return Ok(None);
                    }
                    self.report_answers.record(item, &line, answers);
                    self.results.record(&line);
                    self.score.record(line);
                    self.score.update_totals();
                    (self.progress)(self.score, &self.report_answers)?;
                }
                TaskEvent::Finished(finished) => return Ok(Some(finished)),
                TaskEvent::Failed(error) => return Err(error.into()),
            }
        }
        Err(io::Error::other("a thread running a task panicked").into())
    }

    /// Adds hints, which depend on the answers to the whole task.
    fn record_task(&mut self, task: Task, finished: FinishedTask) {
        self.results.finish(task, &finished);
        let spent = finished.spent;
        let stages = &mut self.score.timings.stages;
        stages.asking.push((task, spent.asking));
        let mut tasks = self.score.tasks.iter_mut();
        if let Some(scores) = tasks.find(|scores| scores.id == task) {
            let started_at = Instant::now();
            let (own, substituted) = (&finished.own, finished.substituted.as_ref());
            let handed_out = self.build.handed_out;
            explain_items(self.exam, &mut scores.items, own, substituted, handed_out);
            scores.printed = finished.printed;
            stages.start += spent.start;
            stages.judging += spent.judging + started_at.elapsed();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::build::NotCompiled;
    use crate::handed_out::RAYS;
    use crate::score::Verdict;
    use crate::score::tests::small_exam::{exam, pending};

    #[test]
    fn every_item_of_a_submission_that_does_not_compile_is_recorded() {
        let folder = tempfile::tempdir().unwrap();
        let why = NotCompiled::MissingDeclaration("x");
        let files = RAYS.file_names().map(|file| (file, why.clone()));
        let build = Build::without_programs(folder.path(), files.collect());
        let exam = exam(&["sphere.uv", "bbox.flat", "sphere.normal"]);
        let mut score = pending(&exam);
        let mut progress = Vec::new();
        run_exam(
            &exam,
            &build,
            Budget::default(),
            2,
            &mut score,
            |score, _| {
                let items = score.items();
                let items = items.filter(|item| item.verdict == Verdict::Pending);
                progress.push((items.count(), score.complete));
                io::Result::Ok(())
            },
        )
        .unwrap();
        assert_eq!(progress, [(2, false), (1, false), (0, false), (0, true)]);
        let mut items = score.items();
        assert!(items.all(|item| item.verdict == Verdict::NotCompiled));
        assert!(score.tasks.iter().all(|task| task.printed.is_none()));
        let asked: Vec<&str> = score
            .timings
            .stages
            .asking
            .iter()
            .map(|(task, _)| task.id())
            .collect();
        // The exam's tasks come first.
        let (own, rest): (Vec<&str>, Vec<&str>) = RAYS
            .assignment
            .tasks
            .iter()
            .map(|info| info.id)
            .partition(|id| ["sphere", "bbox"].contains(id));
        assert_eq!(asked, [own, rest].concat());
    }

    #[test]
    fn grading_stops_if_the_progress_cannot_be_written() {
        let folder = tempfile::tempdir().unwrap();
        let build = Build::without_programs(folder.path(), BTreeMap::new());
        let exam = exam(&["sphere.uv", "sphere.normal"]);
        let mut score = pending(&exam);
        let mut calls = 0;
        let stopped = run_exam(&exam, &build, Budget::default(), 2, &mut score, |_, _| {
            calls += 1;
            Err(io::Error::other("the disk is full"))
        });
        assert!(stopped.is_err());
        assert_eq!((calls, score.complete), (1, false));
    }
}
