//! The tasks to grade, as people write them.

use judging::assignment::{Assignment, Task, TaskInfo};

use crate::inputs::nearest_name::suggestion;

/// The tasks to grade.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum TaskSelection {
    /// All tasks.
    #[default]
    All,
    /// Some of the tasks. Their points aren't a score.
    Only(Vec<Task>),
}

impl TaskSelection {
    /// Selects tasks by name: a task's id, or a file's name with or without `.rs`, which selects
    /// all tasks in it. Names are case-insensitive. Several names are separated by commas.
    ///
    /// # Errors
    ///
    /// A message for the command line if a name is unknown.
    pub fn parse(text: &str, assignment: &Assignment) -> Result<Self, String> {
        let named = NamedTasks::parse_list(text, assignment)?;
        let tasks = named.into_iter().flat_map(|named| match named {
            NamedTasks::Task(task) => vec![task],
            NamedTasks::File(file) => assignment.tasks_in(file).collect(),
        });
        Ok(TaskSelection::Only(tasks.collect()))
    }

    /// Returns whether the task is selected.
    pub fn includes(&self, task: Task) -> bool {
        match self {
            TaskSelection::All => true,
            TaskSelection::Only(tasks) => tasks.contains(&task),
        }
    }

    /// Returns whether all tasks are selected, which is required for a score.
    pub fn is_all(&self) -> bool {
        *self == TaskSelection::All
    }
}

/// A task, or all tasks of a file, as people write them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NamedTasks {
    /// The task with this id.
    Task(Task),
    /// All tasks in the file with this name.
    File(&'static str),
}

impl NamedTasks {
    /// Returns the tasks with these names, separated by commas. See [`TaskSelection::parse`].
    ///
    /// # Errors
    ///
    /// A message for the command line if a name is unknown.
    pub fn parse_list(text: &str, assignment: &Assignment) -> Result<Vec<Self>, String> {
        let names = text.split(',').map(str::trim);
        names.map(|name| Self::parse(name, assignment)).collect()
    }

    /// Returns the task with this id or, failing that, the file with this name.
    fn parse(name: &str, assignment: &Assignment) -> Result<Self, String> {
        let is = |known: &str| known.eq_ignore_ascii_case(name);
        let tasks = || assignment.tasks.iter();
        if let Some(task) = tasks().find(|task| is(task.id)) {
            return Ok(NamedTasks::Task(task.task()));
        }
        if let Some(task) = tasks().find(|task| is(task.file) || is(stem(task))) {
            return Ok(NamedTasks::File(task.file));
        }
        let names = tasks().flat_map(|task| [task.id, stem(task)]);
        Err(format!(
            "unknown task{}; the tasks are {}",
            suggestion(name, names),
            assignment.id_list()
        ))
    }
}

/// Returns the name of a task's file without `.rs`.
fn stem(task: &TaskInfo) -> &'static str {
    task.file.strip_suffix(".rs").unwrap_or(task.file)
}

#[cfg(test)]
mod tests {
    use judging::assignment::RAYS;

    use super::*;

    fn selected(text: &str) -> Result<Vec<String>, String> {
        match TaskSelection::parse(text, &RAYS)? {
            TaskSelection::All => panic!("a name selects some tasks only"),
            TaskSelection::Only(tasks) => Ok(tasks.iter().map(Task::to_string).collect()),
        }
    }

    #[test]
    fn selects_tasks_by_id_and_by_file() {
        assert_eq!(selected("Sphere"), Ok(vec!["sphere".to_owned()]));
        let both = Ok(vec!["build".to_owned(), "traverse".to_owned()]);
        for name in ["bvh", "BVH.rs", "build,traverse", "build, traverse"] {
            assert_eq!(selected(name), both, "{name}");
        }
    }

    #[test]
    fn suggests_the_nearest_name() {
        let tasks = RAYS.id_list();
        for (name, suggestion) in [("sphre", " (did you mean sphere?)"), ("light", "")] {
            let expected = format!("unknown task{suggestion}; the tasks are {tasks}");
            assert_eq!(selected(name), Err(expected));
        }
    }
}
