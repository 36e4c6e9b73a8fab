//! The points for all tasks on one line, for small terminals.

use crate::inputs::task_selection::TaskSelection;
use crate::score::{Score, TaskScore};

/// Returns the points for each selected task and, if all tasks are selected, the total.
pub fn short_table(score: &Score, selection: &TaskSelection) -> String {
    let tasks = score.tasks.iter();
    let tasks = tasks
        .filter(|task| selection.includes(task.id))
        .map(of_task);
    let tasks: Vec<String> = tasks.collect();
    let tasks = tasks.join(", ");
    if selection.is_all() {
        format!("  {} / {}: {tasks}", score.points, score.max_points)
    } else {
        format!("  {tasks}")
    }
}

fn of_task(task: &TaskScore) -> String {
    if task.points == task.max_points {
        format!("{} ✓", task.id)
    } else {
        format!("{} {}/{}", task.id, task.points, task.max_points)
    }
}
