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
        let fault = self.picture.fault.iter().filter(|_| is_ready).cloned();
        let mut notes: Vec<Note> = fault.chain(texts).collect();
        if let (Some(panic), View::Shaded) = (&self.picture.no_light, self.shown.view) {
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
        let Some(opened) = &self.opened else {
            return notes;
        };
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
        match &opened.tree {
            ElementOutcome::Panicked(panic) => add(
                format!("`Bvh::build` panicked: {}", panic.message),
                Some(panic.location.clone()),
            ),
            ElementOutcome::Value(size) => self.add_notes_about_tree(*size, &mut add),
            ElementOutcome::Skipped => {}
        }
        let checkup = self.tree.as_ref().filter(|tree| tree.index.has_nodes());
        for kind in checkup.into_iter().flat_map(|tree| &tree.checkup.kinds) {
            let text = format!("The tree has defects. {} ({}).", kind.title, kind.count);
            add(text, self.line_of(SubmissionPart::Build));
        }
        if let Some(why) = &self.tree_fault {
            let text = format!("The tree cannot be shown: {why}");
            add(text, self.line_of(SubmissionPart::Build));
        }
        for text in self.picture.problems.notes() {
            let (first, rest) = text.split_at(1);
            add(format!("{}{rest}.", first.to_uppercase()), None);
        }
        notes
    }

    /// Returns the note on a program that failed, and on the method at fault, if it has been found.
    pub(super) fn note_on_fault(&self, part: Option<SubmissionPart>, fault: &Fault) -> Note {
        let Some(part) = part else {
            return Note::without_location(fault.to_string());
        };
        let (_, method) = task_and_method(part);
        Note {
            text: format!("`{method}`: {fault}"),
            location: self.line_of(part),
        }
    }

    /// Returns the note on `Bvh::build` if it is taking a long time.
    pub(super) fn note_on_slow_build(&self) -> Option<Note> {
        let (_, method) = task_and_method(SubmissionPart::Build);
        self.is_build_slow.then(|| Note {
            text: format!("`{method}` is still running: is there an infinite loop?"),
            location: self.line_of(SubmissionPart::Build),
        })
    }

    fn add_notes_about_tree(&self, size: TreeSize, mut add: impl FnMut(String, Option<String>)) {
        let effect = match size.primitives {
            0 => String::new(),
            count => format!(", so each ray tests all {count} primitives"),
        };
        let [build, traversal] = [SubmissionPart::Build, SubmissionPart::Traversal];
        let has_traversal = !self.is_from_starter(traversal);
        if size.nodes == 0 && self.is_from_starter(build) {
            // Unlike the starter's `Bvh::hit`, a correct traversal finds nothing without a tree.
            let effect = if has_traversal {
                ", so `Bvh::hit` has no tree to traverse"
            } else {
                &effect
            };
            let text = format!("`Bvh::build` is not written yet{effect}.");
            add(text, self.line_of(build));
        } else if size.nodes == 0 && size.primitives > 0 {
            let text = "`Bvh::build` returned a tree without nodes.".to_owned();
            add(text, self.line_of(build));
        }
        if !has_traversal {
            let text = format!("`Bvh::hit` is not written yet{effect}.");
            add(text, self.line_of(traversal));
        }
        if size.primitives == 0 && !self.subject.data.scene.shapes.is_empty() {
            let text = "Nothing can be drawn yet: write the `hit` method for triangles or spheres \
                first.";
            add(text.to_owned(), None);
        }
    }

    /// Returns whether a part's method is still the one in the starter.
    fn is_from_starter(&self, part: SubmissionPart) -> bool {
        let found = self.task_and_methods(part);
        found.is_some_and(|(_, methods)| !methods.is_changed)
    }

    /// Returns the file and line where a part's method is declared.
    pub(super) fn line_of(&self, part: SubmissionPart) -> Option<String> {
        let (task, methods) = self.task_and_methods(part)?;
        Some(format!("{}:{}", task.file, methods.line))
    }

    /// Returns a part's task and its methods in the submission, if they are found. The assignment
    /// doesn't include the task if the part's code is given to the students.
    fn task_and_methods(&self, part: SubmissionPart) -> Option<(&TaskInfo, TaskMethods)> {
        let Files { rays, light } = self.files.as_deref()?;
        let (id, _) = task_and_method(part);
        [rays, light].into_iter().find_map(|files| {
            let task = files.handed_out.assignment.find(id)?;
            Some((task, files.task_methods(task)?))
        })
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
