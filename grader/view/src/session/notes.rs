//! Remarks about the submission: tasks that are not written yet, panics, and faults.

use grader::handed_out::RAYS;
use protocol::{ElementOutcome, Panic};
use serde::Serialize;
use view_probe::messages::Part;

use super::{BuildState, Session};

/// A remark about the submission.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Note {
    /// The text.
    pub text: String,
    /// The file and line, such as `sphere.rs:72`.
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
            ElementOutcome::Value(size) if size.nodes == 0 && size.primitives > 0 => {
                add(
                    format!(
                        "{}: no tree yet, so each ray may test all {} primitives.",
                        title("build"),
                        size.primitives
                    ),
                    self.line_of("bvh.rs", "pub fn build"),
                );
            }
            ElementOutcome::Value(_) | ElementOutcome::Skipped => {}
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

    /// Returns the file and line in which a declaration of the submission begins.
    fn line_of(&self, file: &str, declaration: &str) -> Option<String> {
        let mut files = self.submission.as_ref()?.files.iter();
        let (_, text) = files.find(|(known, _)| known.name == file)?;
        let mut lines = text.as_ref().ok()?.lines();
        let number = lines.position(|line| line.trim_start().starts_with(declaration))?;
        Some(format!("{file}:{}", number + 1))
    }

    /// Adds the panics of some pixels.
    pub(super) fn add_panic(&mut self, panic: &Panic, pixel: [u32; 2], count: u64) {
        let mut known = self.panics.iter_mut();
        match known.find(|known| known.location == panic.location) {
            Some(known) => known.count += count,
            None => self.panics.push(PanicNote {
                message: panic.message.clone(),
                location: panic.location.clone(),
                pixel,
                count,
            }),
        }
    }
}

/// Returns the title of a task.
fn title(id: &str) -> &'static str {
    let mut tasks = RAYS.assignment.tasks.iter();
    tasks
        .find(|task| task.id == id)
        .map_or("this task", |task| task.title)
}
