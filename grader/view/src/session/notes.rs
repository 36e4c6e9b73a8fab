//! Remarks about the submission: tasks that haven't been written yet, panics and faults.

use glam::UVec2;
use grader::handed_out::TaskMethod;
use grader::submission::Submission;
use judging::assignment::TaskInfo;
use protocol::{ElementOutcome, Panic};
use serde::Serialize;
use view_probe::messages::{Part, TreeSize};

use super::{Session, View};
use crate::program::{BuildState, FileError};

/// The maximum number of panics to list.
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
    pub pixel: UVec2,
    /// The number of pixels.
    pub count: u64,
}

impl Session {
    /// Returns the remarks, most important first.
    pub(super) fn notes(&self) -> Vec<Note> {
        let recording = match (&self.recording, self.shown.view) {
            (Some(BuildState::Broken(why)), _) => Some(format!(
                "The program that records tests cannot be built: {why}"
            )),
            (Some(BuildState::Failed(errors)), View::Tests) => Some(recording_failed(errors)),
            _ => None,
        };
        let texts = [self.fault.clone(), self.loading_error.clone(), recording];
        let mut notes: Vec<Note> = texts.into_iter().flatten().map(without_location).collect();
        let (Some(opened), Some(submission)) = (&self.opened, &self.submission) else {
            return notes;
        };
        let task = |id| task(submission, id);
        let mut add = |text: String, location: Option<String>| notes.push(Note { text, location });
        for (part, panic) in &opened.missing {
            let (id, method, effect) = match part {
                Part::Camera => (
                    "camera",
                    "Camera::sample_ray",
                    "the viewer's own camera is used",
                ),
                Part::Triangle => ("triangle", "Triangle::hit", "triangles are left out"),
                Part::Sphere => ("sphere", "Sphere::hit", "spheres are left out"),
                Part::BBox => ("bbox", "BBox::hit", "boxes cannot be tested"),
            };
            let title = task(id).map_or(method, |task| task.title);
            let text = format!("{title}: not written yet, so {effect}.");
            add(text, Some(panic.location.clone()));
        }
        let build = task("build");
        match &opened.tree {
            ElementOutcome::Panicked(panic) => add(
                format!("{}: panicked: {}", title_of_build(build), panic.message),
                Some(panic.location.clone()),
            ),
            ElementOutcome::Value(size) => {
                self.add_notes_about_tree(*size, [build, task("traverse")], &mut add)
            }
            ElementOutcome::Skipped => {}
        }
        if let Some(why) = &self.tree_fault {
            let text = format!("The tree cannot be shown: {why}");
            add(text, self.line_of(build));
        }
        if self.invalid_paths > 0 {
            let text = format!(
                "{} paths are black, because a hit contains NaN or infinity, a normal of length \
                 zero, or an unknown shape.",
                self.invalid_paths
            );
            add(text, None);
        }
        notes
    }

    fn add_notes_about_tree(
        &self,
        size: TreeSize,
        [build, traverse]: [Option<&TaskInfo>; 2],
        mut add: impl FnMut(String, Option<String>),
    ) {
        let effect = match size.primitives {
            0 => String::new(),
            count => format!(", so each ray tests all {count} primitives"),
        };
        let not_written = |task: &TaskInfo| format!("{}: not written yet{effect}.", task.title);
        let is_from_starter = |task: &&TaskInfo| self.is_from_starter(task);
        let unwritten = build.filter(|task| size.nodes == 0 && is_from_starter(task));
        if let Some(build) = unwritten {
            add(not_written(build), self.line_of(Some(build)));
        } else if size.nodes == 0 && size.primitives > 0 {
            let text = format!("{}: the tree has no nodes.", title_of_build(build));
            add(text, self.line_of(build));
        }
        if let Some(traverse) = traverse.filter(is_from_starter) {
            add(not_written(traverse), self.line_of(Some(traverse)));
        }
        if size.primitives == 0 && !self.subject.data.shapes.is_empty() {
            let text = "Nothing can be drawn yet: write the `hit` of triangles or spheres first.";
            add(text.to_owned(), None);
        }
    }

    /// Returns whether a task's method is the starter's.
    fn is_from_starter(&self, task: &TaskInfo) -> bool {
        self.method(task).is_some_and(|method| !method.is_changed)
    }

    /// Returns a task's method in the submission, if it is found.
    fn method(&self, task: &TaskInfo) -> Option<TaskMethod> {
        self.submission.as_ref()?.task_method(task)
    }

    /// Returns the file and line where a task's method is declared.
    fn line_of(&self, task: Option<&TaskInfo>) -> Option<String> {
        let task = task?;
        Some(format!("{}:{}", task.file, self.method(task)?.line))
    }

    /// Adds the panics of some pixels.
    pub(super) fn add_panic(&mut self, panic: &Panic, pixel: UVec2, count: u64) {
        let mut known = self.shown.panics.iter();
        match known.position(|known| known.location == panic.location) {
            Some(known) => self.shown.panics[known].count += count,
            // The first ones are enough to start with.
            None if self.shown.panics.len() == MAX_PANICS => {}
            None => self.shown.panics.push(PanicNote {
                message: panic.message.clone(),
                location: panic.location.clone(),
                pixel,
                count,
            }),
        }
    }
}

fn without_location(text: String) -> Note {
    Note {
        text,
        location: None,
    }
}

/// Returns why tests cannot be recorded.
pub(super) fn recording_failed(errors: &[FileError]) -> String {
    format!(
        "Your files compile, but not with the changes that record the tests, so the tests cannot be \
         shown: {}",
        errors.first().map_or("", |error| &error.text)
    )
}

/// Returns the task with this id. An assignment may have none, because that part may be given code.
fn task(submission: &Submission, id: &str) -> Option<&'static TaskInfo> {
    submission.handed_out.assignment.find(id)
}

/// Returns the title of the task that builds the tree, or the method's name.
fn title_of_build(task: Option<&TaskInfo>) -> &str {
    task.map_or("Bvh::build", |task| task.title)
}
