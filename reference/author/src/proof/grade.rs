//! Grades solutions with an exam and compares the points they lose with the expected loss.

use anyhow::Result;
use grader::score::{ItemScore, Score};
use judging::assignment::Task;
use judging::exam::{Exam, Item};

use crate::solutions::solution::Solution;
use crate::solutions::workbench::{BuiltSolution, Workbench};

/// Returns the items where a variant loses points that it must not lose.
pub fn variant_losses(
    workbench: &Workbench,
    variant: &Solution,
    exam: &Exam,
) -> Result<Vec<String>> {
    let exam = tasks_and_dependents(exam, &variant.expected.tasks);
    let built = workbench.build(&variant.sources, &variant.id)?;
    let graded = GradedSolution::new(variant, &built, &exam)?;
    let lost = graded.lost_items();
    let lost = lost.filter(|item| !variant.expected.may_lose.contains(&item.id));
    Ok(lost
        .map(|item| format!("{}: {}", item.id, item.message))
        .collect())
}

/// Returns the exam with only the items of these tasks and the items that depend on any of the
/// tasks.
pub fn tasks_and_dependents(exam: &Exam, tasks: &[Task]) -> Exam {
    let of_tasks = |id: &String| Task::in_id(id).is_some_and(|task| tasks.contains(&task));
    exam.filter_items(|item: &Item| of_tasks(&item.id) || item.needs.iter().any(of_tasks))
}

/// A solution and its score in an exam.
#[derive(Debug)]
pub struct GradedSolution<'a> {
    /// The solution.
    pub solution: &'a Solution,
    /// Its score.
    pub score: Score,
}

impl<'a> GradedSolution<'a> {
    /// Grades a solution.
    pub fn new(solution: &'a Solution, built: &BuiltSolution, exam: &Exam) -> Result<Self> {
        let score = built.score(exam)?;
        Ok(GradedSolution { solution, score })
    }

    /// Returns the differences between a mistake's expected and actual loss of points.
    pub fn problems(&self) -> Vec<String> {
        let id = &self.solution.id;
        let passed = self.passed_items().into_iter();
        let passed = passed.map(|item| format!("{id} does not fail {item}"));
        self.task_problems().into_iter().chain(passed).collect()
    }

    /// Returns the listed items that a mistake passes.
    pub fn passed_items(&self) -> Vec<String> {
        let is_passed = |id: &&String| !self.lost_items().any(|item| item.id == **id);
        let listed = self.solution.expected.fails.iter();
        listed.filter(is_passed).cloned().collect()
    }

    /// Returns the problems that don't depend on the seed: the mistake loses no points in its own
    /// task, or it loses points in an undeclared task.
    pub fn task_problems(&self) -> Vec<String> {
        let Solution { id, expected, .. } = self.solution;
        let is_of = |item: &ItemScore, task: &Task| item.id.starts_with(&format!("{task}."));
        let own = self.solution.task();
        let mut problems = Vec::new();
        if !self.lost_items().any(|item| is_of(item, &own)) {
            problems.push(format!("{id} costs no points in its own task"));
        }
        for item in self.lost_items() {
            if !expected.tasks.iter().any(|task| is_of(item, task)) {
                let item = &item.id;
                problems.push(format!(
                    "{id} costs points in {item}, which belongs to another task"
                ));
            }
        }
        problems
    }

    fn lost_items(&self) -> impl Iterator<Item = &ItemScore> {
        self.score
            .items()
            .filter(|item| item.points < item.max_points)
    }
}
