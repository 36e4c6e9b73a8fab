//! Remarks about the submission: methods that haven't been written yet, panics and faults.

use std::fmt;

use glam::UVec2;
use grader::handed_out::TaskMethods;
use grader::probe::Fault;
use judging::assignment::TaskInfo;
use protocol::{ElementOutcome, Panic};
use serde::Serialize;
use view_probe::messages::{SubmissionPart, TreeSize};

use super::{Session, View};
use crate::program::{BuildState, FileError, Files};

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

impl Note {
    pub(super) fn without_location(text: String) -> Self {
        Note {
            text,
            location: None,
        }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.text)?;
        match &self.location {
            Some(location) => write!(f, " ({location})"),
            None => Ok(()),
        }
    }
}

/// A panic while drawing.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PanicNote {
    /// The message.
    pub message: String,
    /// The file and line.
    pub location: String,
    /// The first pixel, counted from the bottom left.
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
            (Some(BuildState::Failed(errors)), View::Tests | View::Mistakes) => {
                Some(recording_failed(errors))
            }
            _ => None,
        };
        let texts = [self.loading_error.clone(), recording];
        let texts = texts.into_iter().flatten().map(Note::without_location);
        // If the new files don't compile, it doesn't matter why the last version stopped.
        let is_ready = matches!(self.drawing, BuildState::Ready(_));
        let fault = self.fault.iter().filter(|_| is_ready).cloned();
        let mut notes: Vec<Note> = fault.chain(texts).collect();
        if let (Some(panic), View::Shaded) = (&self.no_light, self.shown.view) {
            let why = if panic.is_unimplemented() {
                "not written yet".to_owned()
            } else {
                format!("panicked: {}", panic.message)
            };
            notes.push(Note {
                text: format!("Part two: {why}, so the picture is drawn in clay."),
                location: Some(panic.location.clone()),
            });
        }
        let (Some(opened), Some(files)) = (&self.opened, &self.files) else {
            return notes;
        };
        let task = |id| task(files, id);
        let mut add = |text: String, location: Option<String>| notes.push(Note { text, location });
        for (part, panic) in &opened.missing {
            let (_, method) = task_and_method(*part);
            let effect = match part {
                SubmissionPart::Camera => "the viewer's own camera is used",
                SubmissionPart::Triangle => "triangles are left out",
                SubmissionPart::Sphere => "spheres are left out",
                SubmissionPart::BBox => "boxes cannot be tested",
                SubmissionPart::Build | SubmissionPart::Traversal | SubmissionPart::Light => {
                    "the tree cannot be used"
                }
            };
            let text = format!("`{method}` is not written yet, so {effect}.");
            add(text, Some(panic.location.clone()));
        }
        let build = task("build");
        match &opened.tree {
            ElementOutcome::Panicked(panic) => add(
                format!("`Bvh::build` panicked: {}", panic.message),
                Some(panic.location.clone()),
            ),
            ElementOutcome::Value(size) => {
                self.add_notes_about_tree(*size, [build, task("traverse")], &mut add)
            }
            ElementOutcome::Skipped => {}
        }
        let checkup = self.tree.as_ref().filter(|tree| tree.index.has_nodes());
        for kind in checkup.into_iter().flat_map(|tree| &tree.checkup.kinds) {
            let text = format!("The tree has defects. {} ({}).", kind.title, kind.count);
            add(text, self.line_of(build));
        }
        if let Some(why) = &self.tree_fault {
            let text = format!("The tree cannot be shown: {why}");
            add(text, self.line_of(build));
        }
        for text in self.problems.notes() {
            let (first, rest) = text.split_at(1);
            add(format!("{}{rest}.", first.to_uppercase()), None);
        }
        notes
    }

    /// Returns the note on a method that failed or didn't return.
    pub(super) fn note_on_fault(&self, part: SubmissionPart, fault: &Fault) -> Note {
        let (_, method) = task_and_method(part);
        Note {
            text: format!("`{method}`: {fault}"),
            location: self.line_of_part(part),
        }
    }

    /// Returns the note on `Bvh::build` if it is taking a long time.
    pub(super) fn note_on_slow_build(&self) -> Option<Note> {
        let (_, method) = task_and_method(SubmissionPart::Build);
        self.is_build_slow.then(|| Note {
            text: format!("`{method}` is still running: is there an infinite loop?"),
            location: self.line_of_part(SubmissionPart::Build),
        })
    }

    /// Returns the file and line where a part's method is declared.
    pub(super) fn line_of_part(&self, part: SubmissionPart) -> Option<String> {
        let (id, _) = task_and_method(part);
        self.line_of(task(self.files.as_deref()?, id))
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
        let not_written =
            |method: &str, effect: &str| format!("`{method}` is not written yet{effect}.");
        let is_from_starter = |task: &&TaskInfo| self.is_from_starter(task);
        let traverse = traverse.filter(is_from_starter);
        let unwritten = build.filter(|task| size.nodes == 0 && is_from_starter(task));
        if let Some(build) = unwritten {
            // Unlike the starter's `Bvh::hit`, a correct traversal finds nothing without a tree.
            let effect = match traverse {
                Some(_) => &effect,
                None => ", so `Bvh::hit` has no tree to traverse",
            };
            add(not_written("Bvh::build", effect), self.line_of(Some(build)));
        } else if size.nodes == 0 && size.primitives > 0 {
            let text = "`Bvh::build` returned a tree without nodes.".to_owned();
            add(text, self.line_of(build));
        }
        if let Some(traverse) = traverse {
            add(
                not_written("Bvh::hit", &effect),
                self.line_of(Some(traverse)),
            );
        }
        if size.primitives == 0 && !self.subject.data.shapes.is_empty() {
            let text = "Nothing can be drawn yet: write the `hit` method for triangles or spheres \
                first.";
            add(text.to_owned(), None);
        }
    }

    /// Returns whether a task's method is still the one in the starter.
    fn is_from_starter(&self, task: &TaskInfo) -> bool {
        self.method(task).is_some_and(|method| !method.is_changed)
    }

    /// Returns a task's method in the submission, if it is found.
    fn method(&self, task: &TaskInfo) -> Option<TaskMethods> {
        let Files { rays, light } = self.files.as_deref()?;
        let mut parts = [rays, light].into_iter();
        parts.find_map(|part| part.task_methods(task))
    }

    /// Returns the file and line where a task's method is declared.
    fn line_of(&self, task: Option<&TaskInfo>) -> Option<String> {
        let task = task?;
        Some(format!("{}:{}", task.file, self.method(task)?.line))
    }

    /// Adds a panic that occurred in `count` pixels.
    pub(super) fn add_panic(&mut self, panic: &Panic, pixel: UVec2, count: u64) {
        let mut known = self.shown.panics.iter();
        match known.position(|known| known.location == panic.location) {
            Some(known) => self.shown.panics[known].count += count,
            // The panics that are already listed are enough to start with.
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

/// Returns the message that explains why tests cannot be recorded.
pub(super) fn recording_failed(errors: &[FileError]) -> String {
    format!(
        "Your files compile, but not together with the code that records the tests, so the tests \
         cannot be shown: {}",
        errors.first().map_or("", |error| &error.text)
    )
}

/// Returns the task with this id, or `None` if the assignment doesn't include it because the part's
/// code is given to the students.
fn task(files: &Files, id: &str) -> Option<&'static TaskInfo> {
    let mut parts = [&files.rays, &files.light].into_iter();
    parts.find_map(|part| part.handed_out.assignment.find(id))
}

/// Returns a part's task id and method name.
fn task_and_method(part: SubmissionPart) -> (&'static str, &'static str) {
    match part {
        SubmissionPart::Camera => ("camera", "Camera::sample_ray"),
        SubmissionPart::Triangle => ("triangle", "Triangle::hit"),
        SubmissionPart::Sphere => ("sphere", "Sphere::hit"),
        SubmissionPart::BBox => ("bbox", "BBox::hit"),
        SubmissionPart::Build => ("build", "Bvh::build"),
        SubmissionPart::Traversal => ("traverse", "Bvh::hit"),
        SubmissionPart::Light => ("path", "radiance"),
    }
}
