//! The last line of the terminal report after a success: what to do next.

use judging::assignment::Assignment;
use judging::section::Section;

use crate::inputs::task_selection::TaskSelection;
use crate::sandbox::Isolation;
use crate::score::{Score, TaskScore};

/// Returns what to do next if at least one of the selected tasks is complete, with an empty line
/// after it. The advice is only for students who grade their own work with the practice exam.
pub fn next_step(score: &Score, selection: &TaskSelection, assignment: &Assignment) -> String {
    let is_own_work = score.rerun_command.exam.is_none() && score.isolation == Isolation::None;
    if !is_own_work {
        return String::new();
    }
    let is_complete = |task: &TaskScore| task.points == task.max_points;
    let selected = || {
        score
            .tasks
            .iter()
            .filter(|task| selection.includes(task.id))
    };
    if !selected().any(is_complete) {
        return String::new();
    }
    match selected().find(|task| !is_complete(task)) {
        Some(task) => row(&title_and_chapter(task)),
        // The tasks that were not selected were not graded.
        None if !selection.is_all() => row("`cargo grade` shows what the other tasks need"),
        None => row(&after_all_points(assignment)),
    }
}

/// Returns a task's title and the handout's chapter about it, if any.
fn title_and_chapter(task: &TaskScore) -> String {
    match &task.chapter {
        Some(chapter) => format!("{}, {}", task.title, chapter.location()),
        None => task.title.clone(),
    }
}

/// Returns advice on what to do after completing the assignment.
fn after_all_points(assignment: &Assignment) -> String {
    let picture = assignment
        .render
        .map(|command| format!("`{command}` draws with your code"));
    let challenge = assignment
        .challenge
        .map(|section| Section::new(section).location());
    let steps: Vec<String> = picture.into_iter().chain(challenge).collect();
    match steps.len() {
        0 => "`cargo handin` packs the files that you hand in".to_owned(),
        _ => steps.join("\n          "),
    }
}

fn row(text: &str) -> String {
    format!("  next    {text}\n\n")
}
