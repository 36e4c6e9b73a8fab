//! Runs the tasks of an exam on several threads. Each task runs in its own processes.
//!
//! The results don't depend on the number of threads. Everything that affects an item's result
//! comes from its own task or from earlier tasks, whose results it waits for. The only exception is
//! how much of the submission's budget the earlier tasks use up. If they turn out to have used so
//! much that some items shouldn't have been run, the caller discards those items (see
//! [`Allowance::holds_after`]).

use std::collections::BTreeSet;
use std::io;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::vec;

use judging::assignment::Task;
use judging::exam::{Exam, Item};
use protocol::Answer;

use crate::build::Build;
use crate::probe::{Allowance, Budget, TimeUsed};
use crate::run_exam::task_sessions::{BlockingItem, FinishedTask, TaskSessions};
use crate::score::ItemScore;

/// The results of earlier tasks that affect later tasks.
#[derive(Clone, Debug, Default)]
pub struct PriorResults {
    /// The items that have earned no points, including those that haven't been graded yet.
    without_points: BTreeSet<String>,
    /// The tasks that were stopped before all their items were run.
    stopped: BTreeSet<Task>,
    /// The time that finished tasks have used.
    pub used: TimeUsed,
}

impl PriorResults {
    /// Returns the results before any item is graded.
    pub fn new(exam: &Exam) -> Self {
        PriorResults {
            without_points: exam.items.iter().map(|item| item.id.clone()).collect(),
            ..PriorResults::default()
        }
    }

    /// Records the score of an item.
    pub fn record(&mut self, line: &ItemScore) {
        if line.points > 0 {
            self.without_points.remove(&line.id);
        } else {
            self.without_points.insert(line.id.clone());
        }
    }

    /// Records the results of a finished task.
    pub fn finish(&mut self, task: Task, finished: &FinishedTask) {
        if finished.is_stopped {
            self.stopped.insert(task);
        }
        self.used += finished.used;
    }

    /// Returns the first item without points that this item depends on, if any.
    pub fn blocking_item<'a>(&self, item: &'a Item) -> Option<BlockingItem<'a>> {
        let mut needs = item.needs.iter();
        let id = needs.find(|id| self.without_points.contains(*id))?;
        let task = Task::in_id(id);
        Some(BlockingItem {
            id,
            is_of_stopped_task: task.is_some_and(|task| self.stopped.contains(&task)),
        })
    }
}

/// An item with its results.
#[derive(Debug)]
pub struct GradedItem<'a> {
    /// The item.
    pub item: &'a Item,
    /// Its score.
    pub line: ItemScore,
    /// The answers, if any.
    pub answers: Vec<Answer>,
    /// The task's allowance after this item.
    pub allowance: Allowance,
}

/// A message from the thread that runs a task.
#[derive(Debug)]
pub enum TaskEvent<'a> {
    /// An item was graded.
    Graded(Box<GradedItem<'a>>),
    /// All items were graded. This is the last message.
    Finished(FinishedTask),
    /// The grader failed. This is the last message.
    Failed(io::Error),
}

/// The run was cancelled, because its results are no longer wanted.
#[derive(Debug)]
struct Cancelled;

/// The tasks to run, shared by the threads that run them.
pub struct TaskRuns<'a> {
    exam: &'a Exam,
    build: &'a Build,
    budget: Budget,
    /// The tasks that haven't been started, in order.
    queue: Mutex<vec::IntoIter<(Task, Sender<TaskEvent<'a>>)>>,
    progress: Mutex<Progress>,
    changed: Condvar,
}

/// The state of the run.
#[derive(Debug)]
struct Progress {
    results: PriorResults,
    /// The tasks that haven't been finished, in order.
    unfinished: Vec<Task>,
    is_cancelled: bool,
}

impl<'a> TaskRuns<'a> {
    /// Returns the runs of these tasks and the receiver for each task's messages. `results` are the
    /// results of all earlier tasks.
    pub fn new(
        exam: &'a Exam,
        build: &'a Build,
        budget: Budget,
        tasks: &[Task],
        results: PriorResults,
    ) -> (Self, Vec<Receiver<TaskEvent<'a>>>) {
        let (queue, receivers): (Vec<_>, Vec<_>) = tasks
            .iter()
            .map(|task| {
                let (sender, receiver) = channel();
                ((*task, sender), receiver)
            })
            .unzip();
        let runs = TaskRuns {
            exam,
            build,
            budget,
            queue: Mutex::new(queue.into_iter()),
            progress: Mutex::new(Progress {
                results,
                unfinished: tasks.to_vec(),
                is_cancelled: false,
            }),
            changed: Condvar::new(),
        };
        (runs, receivers)
    }

    /// Runs tasks until none is left or the run is cancelled.
    pub fn work(&self) {
        let next = || lock(&self.queue).next();
        while let Some((task, events)) = next() {
            if let Err(Cancelled) = self.run_task(task, &events) {
                return;
            }
        }
    }

    /// Stops each thread before its next item.
    pub fn cancel(&self) {
        lock(&self.progress).is_cancelled = true;
        self.changed.notify_all();
    }

    /// Runs a task. If the receiver no longer exists, the run has been cancelled, so errors from
    /// `send` are ignored.
    fn run_task(&self, task: Task, events: &Sender<TaskEvent<'a>>) -> Result<(), Cancelled> {
        let mut sessions = TaskSessions::new(self.build);
        let before = lock(&self.progress).results.used;
        let mut allowance = Allowance::new(self.budget, before);
        for item in self.exam.items.iter().filter(|item| item.task == task) {
            let blocking = self.wait_for_blocking_item(item)?;
            let (line, answers) = match sessions.grade_item(item, blocking, &mut allowance) {
                Ok(graded) => graded,
                Err(error) => {
                    events.send(TaskEvent::Failed(error)).ok();
                    return Err(Cancelled);
                }
            };
            lock(&self.progress).results.record(&line);
            let graded = GradedItem {
                item,
                line,
                answers,
                allowance: allowance.clone(),
            };
            events.send(TaskEvent::Graded(Box::new(graded))).ok();
        }
        let finished = sessions.finish(allowance.used());
        let mut progress = lock(&self.progress);
        progress.results.finish(task, &finished);
        progress.unfinished.retain(|unfinished| *unfinished != task);
        self.changed.notify_all();
        events.send(TaskEvent::Finished(finished)).ok();
        Ok(())
    }

    /// Waits until the tasks that an item depends on are finished. Returns the first item without
    /// points that this item depends on.
    fn wait_for_blocking_item<'b>(
        &self,
        item: &'b Item,
    ) -> Result<Option<BlockingItem<'b>>, Cancelled> {
        let needed: BTreeSet<Task> = item.needs.iter().flat_map(|id| Task::in_id(id)).collect();
        let must_wait = |progress: &mut Progress| {
            // A task never waits for a later task, which may not have been started.
            let mut before = progress
                .unfinished
                .iter()
                .take_while(|task| **task != item.task);
            !progress.is_cancelled && before.any(|task| needed.contains(task))
        };
        let progress = self.changed.wait_while(lock(&self.progress), must_wait);
        let progress = progress.unwrap_or_else(PoisonError::into_inner);
        if progress.is_cancelled {
            return Err(Cancelled);
        }
        Ok(progress.results.blocking_item(item))
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::score::tests::small_exam::{boxes, exam, item};

    #[test]
    fn the_first_item_that_earned_nothing_blocks_those_that_depend_on_it() {
        let ids = [
            "triangle.inside",
            "bbox.through",
            "bbox.flat",
            "traverse.root",
        ];
        let mut results = PriorResults::new(&exam(&ids));
        let mut dependent = item("traverse.root", vec![boxes(1)]);
        dependent.needs = ids[..3].iter().map(|id| (*id).to_owned()).collect();
        let mut earn = |id: &str, points| {
            let mut line = ItemScore::pending(id, "title", 4);
            line.points = points;
            results.record(&line);
            results
                .blocking_item(&dependent)
                .map(|blocking| blocking.id)
        };
        for (id, points, blocking) in [
            ("triangle.inside", 1, Some("bbox.through")),
            ("bbox.through", 4, Some("bbox.flat")),
            // The item itself has no points either, but doesn't block itself.
            ("bbox.flat", 1, None),
            ("triangle.inside", 0, Some("triangle.inside")),
        ] {
            assert_eq!(earn(id, points), blocking);
        }
    }
}
