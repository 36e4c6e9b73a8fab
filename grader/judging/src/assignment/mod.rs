//! Assignments as data: the tasks of each assignment, with their files and points. Anything that
//! depends on the number, order or names of the tasks is derived from this data.

mod light;
mod rays;

use std::fmt;

use arrayvec::ArrayString;
use protocol::Question;
use serde::{Deserialize, Serialize};

use crate::signatures::PanicKind;
use crate::symptom::Symptom;

pub use light::{LIGHT, LIGHT_FILES};
pub use rays::{RAYS, RAYS_FILES};

/// The maximum length of a task's id, in bytes.
const MAX_ID_BYTES: usize = 24;

/// A set of tasks worth 100 points.
#[derive(Debug, PartialEq, Eq)]
pub struct Assignment {
    /// The id that the command line and exam files use.
    pub id: &'static str,
    /// The human-readable title.
    pub title: &'static str,
    /// The folders where a submission's files are expected, in order of preference. The empty path
    /// is the submission's top level.
    pub folders: &'static [&'static str],
    /// Names of the project's other folders. Files in these folders, however deeply nested, are
    /// never handed in.
    pub other_folders: &'static [&'static str],
    /// The tasks, in lecture order.
    pub tasks: &'static [TaskInfo],
    /// The command that draws a picture with the complete code.
    pub render: Option<&'static str>,
    /// The section of the handout with a challenge to try after the last task.
    pub challenge: Option<&'static str>,
}

/// One task: a method, or a few, to write.
#[derive(Debug, PartialEq, Eq)]
pub struct TaskInfo {
    /// The id that the command line and files use.
    pub id: &'static str,
    /// The human-readable title.
    pub title: &'static str,
    /// The submitted file that contains the method.
    pub file: &'static str,
    /// The methods to write, each as `Type::name`. Free functions have only a name.
    pub methods: &'static [&'static str],
    /// The total points of the task's items.
    pub points: u32,
    /// The handout's page about the task.
    pub chapter: &'static str,
    /// The clues for failures whose cause isn't obvious.
    pub clues: TaskClues,
}

/// A file that students write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TaskFile {
    /// The file name, such as `sphere.rs`.
    pub name: &'static str,
    /// The text of the file in the starter.
    pub starter: &'static str,
    /// Declarations that other files use. If one is missing, the compiler reports errors in those
    /// files instead of this one.
    pub required_declarations: &'static [&'static str],
}

/// Clues to what is wrong with a task's code, for failures whose cause isn't obvious.
#[derive(Debug, PartialEq, Eq)]
pub struct TaskClues {
    /// Where to look if every ray misses. A sentence before it says that they do. `None` if none of
    /// the task's rays should hit anything.
    pub if_nothing_is_hit: Option<&'static str>,
    /// The clue for code that overflows the stack. `None` if nothing is known about the recursion.
    pub if_stack_overflows: Option<&'static str>,
    /// The section of the handout about recursion that doesn't end. `None` if the chapter doesn't
    /// discuss it.
    pub section_if_stack_overflows: Option<&'static str>,
    /// The sections that also explain a panic or a stack overflow in the items that refer to them.
    pub sections_on_crashes: &'static [&'static str],
    /// The sections about panics in the task's code, by the kind of panic. The chapter is about all
    /// other kinds.
    pub sections_on_panics: &'static [(PanicKind, &'static str)],
    /// The section of the handout about code that keeps state from one call to the next. `None` if
    /// the chapter doesn't discuss it.
    pub section_on_kept_state: Option<&'static str>,
    /// The clues for wrong answers to items whose own advice is about another symptom. The first
    /// clue that covers the symptom is used.
    pub by_symptom: &'static [SymptomClue],
}

/// The clue for answers with an error in one quantity, or in one of several quantities whose errors
/// share a cause.
#[derive(Debug, PartialEq, Eq)]
pub struct SymptomClue {
    /// The quantities. If the clue only applies when a quantity is too small, too large or
    /// reversed, that side is specified too.
    pub symptoms: &'static [Symptom],
    /// The clue.
    pub clue: &'static str,
    /// The section of the handout to read.
    pub section: &'static str,
}

impl TaskClues {
    /// No clues.
    pub const NONE: TaskClues = TaskClues {
        if_nothing_is_hit: None,
        if_stack_overflows: None,
        section_if_stack_overflows: None,
        sections_on_crashes: &[],
        sections_on_panics: &[],
        section_on_kept_state: None,
        by_symptom: &[],
    };

    /// Returns the clue for a symptom, if any.
    pub fn of_symptom(&self, symptom: &Symptom) -> Option<&'static SymptomClue> {
        let mut clues = self.by_symptom.iter();
        clues.find(|clue| clue.symptoms.iter().any(|own| own.includes(symptom)))
    }
}

/// The id of a task, such as `sphere`. Its assignment resolves it to a [`TaskInfo`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Task(ArrayString<MAX_ID_BYTES>);

impl Assignment {
    /// Returns the ids of the tasks, in lecture order.
    pub fn tasks(&self) -> impl Iterator<Item = Task> + Clone {
        self.tasks.iter().map(TaskInfo::task)
    }

    /// Returns the total points of all tasks.
    pub fn points(&self) -> u32 {
        self.tasks.iter().map(|task| task.points).sum()
    }

    /// Returns the task with this id, or `None` if it isn't part of the assignment.
    pub fn find(&self, id: &str) -> Option<&'static TaskInfo> {
        self.tasks.iter().find(|task| task.id == id)
    }

    /// Returns the ids of the tasks as a list to show in a message, such as `a, b, c`.
    pub fn id_list(&self) -> String {
        let ids: Vec<&str> = self.tasks.iter().map(|task| task.id).collect();
        ids.join(", ")
    }

    /// Returns a task of this assignment.
    ///
    /// # Panics
    ///
    /// If the task isn't part of the assignment. This can't happen for ids from exam files, because
    /// every exam file is checked when it is read.
    pub fn info(&self, task: Task) -> &'static TaskInfo {
        let info = self.find(task.id());
        info.unwrap_or_else(|| panic!("the assignment {} has no task {task}", self.id))
    }

    /// Returns the tasks whose method is in this file.
    pub fn tasks_in<'a>(&self, file: &'a str) -> impl Iterator<Item = Task> + use<'a> {
        let tasks = self.tasks.iter().filter(move |task| task.file == file);
        tasks.map(TaskInfo::task)
    }
}

impl TaskInfo {
    /// Returns the names of the methods as a list for use in a sentence, such as `` `Lights::sample`
    /// and `Lights::pdf` ``, with `and` as the conjunction.
    pub fn method_names(&self, conjunction: &str) -> String {
        let names = self.methods.iter().map(|path| self.method_name(path));
        let names: Vec<String> = names.collect();
        match names.split_last() {
            Some((last, [])) => last.clone(),
            Some((last, others)) => format!("{} {conjunction} {last}", others.join(", ")),
            None => String::new(),
        }
    }

    /// Returns the name of one of the methods for use in a sentence. If the task has only one method,
    /// its type is left out.
    pub fn method_name(&self, path: &str) -> String {
        match (self.methods, path.rsplit_once("::")) {
            ([_], Some((_, name))) => format!("`{name}`"),
            _ => format!("`{path}`"),
        }
    }

    /// Returns the constructor to write for a method's type, unless the method is that constructor.
    pub fn constructor_of(&self, method: &str) -> Option<&'static str> {
        let (of_type, name) = method.rsplit_once("::")?;
        let mut methods = self.methods.iter().copied();
        let constructor =
            methods.find(|other| other.rsplit_once("::") == Some((of_type, "new")))?;
        (name != "new").then_some(constructor)
    }

    /// Returns the method that a question calls, if it is one of the task's.
    pub fn called_by(&self, question: &Question) -> Option<&'static str> {
        let table = question.table()?;
        let mut methods = self.methods.iter().copied();
        methods.find(|method| *method == table.name())
    }

    /// Returns the task's id.
    pub fn task(&self) -> Task {
        Task(ArrayString::from(self.id).expect("ids in the table are short"))
    }
}

impl Task {
    /// Returns the task named in the id of an item or a mistake: the part before the first dot. The
    /// assignment may not have a task with this name.
    pub fn in_id(id: &str) -> Option<Task> {
        let (task, _) = id.split_once('.')?;
        ArrayString::from(task).ok().map(Task)
    }

    /// Returns the id as text.
    pub fn id(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Task {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for Task {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Task".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({
            "description": "The id of a task, such as `sphere`.",
            "type": "string"
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tasks_of_an_assignment_are_worth_100_points_and_have_different_ids() {
        let mut ids = std::collections::BTreeSet::new();
        for assignment in [&RAYS, &LIGHT] {
            assert_eq!(assignment.points(), 100);
            assert!(assignment.tasks().all(|task| ids.insert(task)));
        }
    }

    #[test]
    fn only_a_type_whose_constructor_is_to_be_written_has_one() {
        let environment = LIGHT.find("environment").unwrap();
        let new = Some("Environment::new");
        assert_eq!(environment.constructor_of("Environment::pdf"), new);
        for other in ["Environment::new", "uniform_sphere"] {
            assert_eq!(environment.constructor_of(other), None, "{other}");
        }
        let camera = RAYS.find("camera").unwrap();
        assert_eq!(camera.constructor_of("Camera::sample_ray"), None);
    }

    #[test]
    fn finds_the_tasks_of_a_file() {
        let tasks: Vec<Task> = RAYS.tasks_in("bvh.rs").collect();
        assert_eq!(
            tasks.iter().map(Task::id).collect::<Vec<_>>(),
            ["build", "traverse"]
        );
    }
}
