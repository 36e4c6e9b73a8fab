//! Grades mistakes and variants with an exam.

use grader::score::{ItemScore, Score};
use judging::assignment::Task;
use judging::exam::{Exam, Item};
use rayon::prelude::*;

use crate::solutions::Solutions;
use crate::solutions::catalogue::Mistake;
use crate::solutions::sources::Sources;
use crate::solutions::variants::Variant;
use crate::solutions::workbench::{Workbench, WorkbenchError};

/// Grades every mistake.
pub fn grade_mistakes<'a>(
    solutions: &'a Solutions,
    exam: &Exam,
) -> Result<Vec<GradedMistake<'a>>, WorkbenchError> {
    solutions
        .mistakes
        .par_iter()
        .map(|(mistake, sources)| grade_mistake(&solutions.workbench, mistake, sources, exam))
        .collect()
}

/// Grades one mistake.
pub fn grade_mistake<'a>(
    workbench: &Workbench,
    mistake: &'a Mistake,
    sources: &Sources,
    exam: &Exam,
) -> Result<GradedMistake<'a>, WorkbenchError> {
    let score = workbench.build(sources, &mistake.id)?.score(exam)?;
    Ok(GradedMistake { mistake, score })
}

/// Returns the items in which a variant loses points although it must not.
pub fn variant_losses(
    workbench: &Workbench,
    variant: &Variant,
    sources: &Sources,
    exam: &Exam,
) -> Result<Vec<String>, WorkbenchError> {
    let tasks = variant.tasks(workbench.handed_out().assignment);
    let exam = tasks_and_dependents(exam, &tasks);
    let score = workbench.build(sources, &variant.id)?.score(&exam)?;
    let lost = score.items().filter(|item| item.points < item.max_points);
    let lost = lost.filter(|item| !variant.may_lose.contains(&item.id));
    Ok(lost
        .map(|item| format!("{}: {}", item.id, item.message))
        .collect())
}

/// Returns the exam with only the items of these tasks and the items that depend on one of them.
pub fn tasks_and_dependents(exam: &Exam, tasks: &[Task]) -> Exam {
    let of_tasks = |id: &String| Task::in_id(id).is_some_and(|task| tasks.contains(&task));
    exam.filter_items(|item: &Item| of_tasks(&item.id) || item.needs.iter().any(of_tasks))
}

/// A mistake and its score in an exam.
#[derive(Debug)]
pub struct GradedMistake<'a> {
    /// The mistake.
    pub mistake: &'a Mistake,
    /// Its score.
    pub score: Score,
}

impl GradedMistake<'_> {
    /// Returns the differences between the expected and the actual loss of points.
    pub fn problems(&self) -> Vec<String> {
        let id = &self.mistake.id;
        let passed = self.passed_items().into_iter();
        let passed = passed.map(|item| format!("{id} does not fail {item}"));
        self.task_problems().into_iter().chain(passed).collect()
    }

    /// Returns the listed items that the mistake passes.
    pub fn passed_items(&self) -> Vec<String> {
        let is_passed = |id: &&String| !self.lost_items().any(|item| item.id == **id);
        let listed = self.mistake.fails.iter();
        listed.filter(is_passed).cloned().collect()
    }

    /// Returns the differences that are problems with any seed: no loss in the mistake's own task,
    /// or a loss in a task that it does not declare.
    pub fn task_problems(&self) -> Vec<String> {
        let mistake = self.mistake;
        let tasks: Vec<_> = mistake.tasks().collect();
        let mut problems = Vec::new();
        if !self
            .lost_items()
            .any(|item| item.id.starts_with(&format!("{}.", mistake.task())))
        {
            problems.push(format!("{} costs nothing in its own task", mistake.id));
        }
        let of_tasks = |item: &ItemScore| {
            tasks
                .iter()
                .any(|task| item.id.starts_with(&format!("{task}.")))
        };
        for item in self.lost_items().filter(|item| !of_tasks(item)) {
            problems.push(format!(
                "{} costs points in {}, an item of another task",
                mistake.id, item.id
            ));
        }
        problems
    }

    fn lost_items(&self) -> impl Iterator<Item = &ItemScore> {
        self.score
            .items()
            .filter(|item| item.points < item.max_points)
    }
}
