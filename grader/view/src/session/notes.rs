//! Remarks about the submission: tasks that are not written yet, panics, and faults.

use grader::handed_out::{RAYS, TaskMethod};
use protocol::{ElementOutcome, Panic};
use serde::Serialize;
use view_probe::messages::{Part, TreeSize};

use super::{BuildState, Session, View};
use crate::program::FileError;

/// The maximum number of panics that are listed.
const MAX_PANICS: usize = 20;

/// A remark about the submission.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Note {
    /// The text.
    pub text: String,
    /// The file, line and column, such as `sphere.rs:72:9`.
    pub location: Option<String>,
}

/// A panic while drawing.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PanicNote {
    /// The message.
    pub message: String,
    /// The file and line.
    pub location: String,
    /// The first pixel, from the bottom left.
    pub pixel: [u32; 2],
    /// The number of pixels.
    pub count: u64,
}

impl Session {
    /// Returns the remarks, the most important first.
    pub(super) fn notes(&self) -> Vec<Note> {
        let mut notes = Vec::new();
        let mut add = |text: String, location: Option<String>| notes.push(Note { text, location });
        if let Some(fault) = &self.fault {
            add(fault.clone(), None);
        }
        if let Some(why) = &self.loading_error {
            add(why.clone(), None);
        }
        if let Some(BuildState::Broken(why)) = &self.recording {
            add(
                format!("The program that records tests cannot be built: {why}"),
                None,
            );
        }
        if let (View::Tests, Some(BuildState::Failed(errors))) = (self.view, &self.recording) {
            add(recording_failed(errors), None);
        }
        let Some(opened) = &self.opened else {
            return notes;
        };
        for (part, panic) in &opened.missing {
            let (task, effect) = match part {
                Part::Camera => ("camera", "the viewer's own camera is used"),
                Part::Triangle => ("triangle", "triangles are left out"),
                Part::Sphere => ("sphere", "spheres are left out"),
                Part::BBox => ("bbox", "boxes cannot be tested"),
            };
            let title = title(task);
            add(
                format!("{title}: not written yet, so {effect}."),
                Some(panic.location.clone()),
            );
        }
        match &opened.tree {
            ElementOutcome::Panicked(panic) => add(
                format!("{}: panicked: {}", title("build"), panic.message),
                Some(panic.location.clone()),
            ),
            ElementOutcome::Value(size) => self.add_notes_about_tree(*size, &mut add),
            ElementOutcome::Skipped => {}
        }
        if let Some(why) = &self.tree_fault {
            let text = format!("The tree cannot be shown: {why}");
            let build = self.task_method("build");
            add(text, build.as_ref().map(line_in_tree));
        }
        if self.invalid_paths > 0 {
            add(
                format!(
                    "{} paths are black, because a hit contains NaN or infinity, a normal of \
                     length zero, or an unknown material.",
                    self.invalid_paths
                ),
                None,
            );
        }
        notes
    }

    fn add_notes_about_tree(&self, size: TreeSize, mut add: impl FnMut(String, Option<String>)) {
        let [build, traverse] = ["build", "traverse"].map(|task| self.task_method(task));
        let is_unwritten = |method: &Option<TaskMethod>| {
            let method = method.as_ref();
            method.is_some_and(|method| !method.is_changed)
        };
        let effect = match size.primitives {
            0 => String::new(),
            count => format!(", so each ray tests all {count} primitives"),
        };
        if size.nodes == 0 && is_unwritten(&build) {
            let text = format!("{}: not written yet{effect}.", title("build"));
            add(text, build.as_ref().map(line_in_tree));
        } else if size.nodes == 0 && size.primitives > 0 {
            let text = format!("{}: the tree has no nodes.", title("build"));
            add(text, build.as_ref().map(line_in_tree));
        }
        if is_unwritten(&traverse) {
            let text = format!("{}: not written yet{effect}.", title("traverse"));
            add(text, traverse.as_ref().map(line_in_tree));
        }
        if size.primitives == 0 && !self.subject.data.shapes.is_empty() {
            let text = "Nothing can be drawn yet: write the `hit` of triangles or spheres first.";
            add(text.to_owned(), None);
        }
    }

    /// Returns the method of a task in the submission, if it is found.
    fn task_method(&self, task: &str) -> Option<TaskMethod> {
        let task = RAYS.assignment.find(task)?;
        RAYS.task_method(task.task(), self.text(task.file)?).ok()
    }

    fn text(&self, file: &str) -> Option<&str> {
        let mut files = self.submission.as_ref()?.files.iter();
        let (_, text) = files.find(|(known, _)| known.name == file)?;
        text.as_deref().ok()
    }

    /// Adds the panics of some pixels.
    pub(super) fn add_panic(&mut self, panic: &Panic, pixel: [u32; 2], count: u64) {
        let mut known = self.panics.iter();
        match known.position(|known| known.location == panic.location) {
            Some(known) => self.panics[known].count += count,
            // The first ones are enough to start with.
            None if self.panics.len() == MAX_PANICS => {}
            None => self.panics.push(PanicNote {
                message: panic.message.clone(),
                location: panic.location.clone(),
                pixel,
                count,
            }),
        }
    }
}

/// Returns the file and line of a method in `bvh.rs`.
fn line_in_tree(method: &TaskMethod) -> String {
    format!("bvh.rs:{}", method.line)
}

/// Returns the reason why tests cannot be recorded.
pub(super) fn recording_failed(errors: &[FileError]) -> String {
    format!(
        "Your files compile, but not with the changes that record the tests, so the tests cannot be \
         shown: {}",
        errors.first().map_or("", |error| &error.text)
    )
}

/// Returns the title of a task.
fn title(id: &str) -> &'static str {
    let mut tasks = RAYS.assignment.tasks.iter();
    tasks
        .find(|task| task.id == id)
        .map_or("this task", |task| task.title)
}
