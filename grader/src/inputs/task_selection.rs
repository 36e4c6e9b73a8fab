//! The tasks to grade, as selected by users.

use judging::assignment::{Assignment, Task, TaskInfo};

use crate::handed_out::HandedOut;
use crate::inputs::nearest_name::suggestion;

/// The tasks to grade.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum TaskSelection {
    /// All tasks.
    #[default]
    All,
    /// Only some of the tasks. Their points alone don't make up a score.
    Only(Vec<Task>),
}

impl TaskSelection {
    /// Selects tasks by name. A name is either a task's id or a file's name, with or without `.rs`.
    /// The name of a file selects all tasks in that file. Names are case-insensitive. Several names
    /// are separated by commas.
    ///
    /// # Errors
    ///
    /// A message for the command line if a name is unknown.
    pub fn parse(text: &str, assignment: &Assignment) -> Result<Self, String> {
        let named = TaskOrFile::parse_list(text, assignment)?;
        let tasks = named.into_iter().flat_map(|named| match named {
            TaskOrFile::Task(task) => vec![task],
            TaskOrFile::File(file) => assignment.tasks_in(file).collect(),
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

/// A task or a file, as named by users.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TaskOrFile {
    /// The task with this id.
    Task(Task),
    /// The file with this name, which stands for all tasks in that file. In a list of files to
    /// reset, it may also be a given file.
    File(&'static str),
}

impl TaskOrFile {
    /// Returns the tasks and files named in this comma-separated list. See
    /// [`TaskSelection::parse`].
    ///
    /// # Errors
    ///
    /// A message for the command line if a name is unknown.
    pub fn parse_list(text: &str, assignment: &Assignment) -> Result<Vec<Self>, String> {
        let names = text.split(',').map(str::trim);
        names.map(|name| Self::parse(name, assignment)).collect()
    }

    /// Like [`TaskOrFile::parse_list`], but the list may also name given files, such as `world.rs`.
    ///
    /// # Errors
    ///
    /// A message for the command line if a name is unknown.
    pub fn parse_with_given_files(
        text: &str,
        handed_out: &'static HandedOut,
    ) -> Result<Vec<Self>, String> {
        let given = || handed_out.given.iter().chain([&handed_out.main]);
        let unknown = |name: &str| {
            let files = || handed_out.file_names().chain(given().map(|file| file.name));
            let stems = files().map(|file| file.trim_end_matches(".rs"));
            let tasks = handed_out.assignment.tasks.iter().map(|task| task.id);
            format!(
                "unknown task or file{}; the tasks are {}; the files are {}",
                suggestion(name, tasks.chain(stems)),
                handed_out.assignment.id_list(),
                files().collect::<Vec<_>>().join(", ")
            )
        };
        let named = |name: &str| {
            let is = |known: &str| known.eq_ignore_ascii_case(name);
            match given().find(|file| is(file.name) || is(file.name.trim_end_matches(".rs"))) {
                Some(file) => Ok(TaskOrFile::File(file.name)),
                None => Self::parse(name, handed_out.assignment).map_err(|_| unknown(name)),
            }
        };
        text.split(',').map(str::trim).map(named).collect()
    }

    /// Returns the task with this id or, failing that, the file with this name.
    fn parse(name: &str, assignment: &Assignment) -> Result<Self, String> {
        let is = |known: &str| known.eq_ignore_ascii_case(name);
        let tasks = || assignment.tasks.iter();
        if let Some(task) = tasks().find(|task| is(task.id)) {
            return Ok(TaskOrFile::Task(task.task()));
        }
        if let Some(task) = tasks().find(|task| is(task.file) || is(stem(task))) {
            return Ok(TaskOrFile::File(task.file));
        }
        Err(format!(
            "unknown task{}; the tasks are {}",
            suggestion(name, names(assignment)),
            assignment.id_list()
        ))
    }
}

/// Returns a question to append to a message about a submission that doesn't exist if the name
/// looks like a task's or an item's, such as ` (did you mean sphere?)`, or nothing.
pub fn suggestion_for_submission(name: &str, assignment: &Assignment) -> String {
    match Task::in_id(name) {
        Some(task) if assignment.find(task.id()).is_some() && name.contains('.') => {
            format!(" (did you mean --replay {name}?)")
        }
        _ => suggestion(name, names(assignment)),
    }
}

/// Returns the names of the tasks and of their files, without `.rs`.
fn names(assignment: &Assignment) -> impl Iterator<Item = &'static str> {
    let tasks = assignment.tasks.iter();
    tasks.flat_map(|task| [task.id, stem(task)])
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
