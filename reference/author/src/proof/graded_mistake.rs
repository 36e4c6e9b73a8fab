//! A mistake and its score in an exam.

use grader::score::{ItemScore, Score};

use crate::proof::catalogue::Mistake;

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
        let mistake = self.mistake;
        let tasks = mistake.tasks();
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
        for id in &mistake.fails {
            if !self.lost_items().any(|item| item.id == *id) {
                problems.push(format!("{} does not fail {id}", mistake.id));
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
