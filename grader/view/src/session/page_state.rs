//! The state as seen by the page.

use std::time::Instant;

use framework::math::tan;
use glam::{UVec2, Vec3};
use serde::Serialize;
use view_probe::messages::SubmissionPart;

use super::notes::recording_failed;
use super::tests_summary::TestsSummary;
use super::{Note, PageFields, PinnedTarget, Session};
use crate::program::{BuildState, FileError};
use crate::subject::ExamRay;

/// The state as seen by the page.
#[derive(Debug, Serialize)]
pub struct PageState<'a> {
    #[serde(flatten)]
    shown: &'a PageFields,
    subject: &'a str,
    about: &'a str,
    question: Option<&'a ExamRay>,
    own_film: UVec2,
    camera: CameraState,
    build: &'static str,
    /// Whether the tree is being built.
    is_opening: bool,
    /// The method that is still running, if building the tree takes a long time.
    slow_build: Option<Note>,
    /// The location of the declaration of `Bvh::hit`.
    traversal: Option<String>,
    /// Whether drawing has ended because the program failed.
    has_stopped: bool,
    errors: Vec<FileError>,
    notes: Vec<Note>,
    complete_samples: u32,
    progress: f64,
    is_complete: bool,
    tests: Option<TestsSummary>,
    rays_per_second: f64,
    seconds: f64,
    seconds_left: Option<f64>,
    programs: usize,
    has_tree: bool,
    tree_levels: u32,
    tree_number: String,
    pinned: Option<PinnedState>,
    explanation: Option<u64>,
    explanation_fault: Option<String>,
}

/// The camera. The page needs it to draw lines over the picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
struct CameraState {
    position: Vec3,
    /// The axes pointing right, up and backward.
    axes: [[f32; 3]; 3],
    /// Half the height of the picture at a distance of 1.
    half_height: f32,
    aspect_ratio: f32,
    is_own: bool,
}

/// The explained pixel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
struct PinnedState {
    #[serde(flatten)]
    target: PinnedTarget,
    /// Whether the camera hasn't moved since the pixel was clicked, so that the pixel can be
    /// marked.
    is_here: bool,
}

impl Session {
    /// Returns the state as seen by the page.
    pub fn page_state(&self, now: Instant) -> PageState<'_> {
        let camera = self.camera();
        let (build, errors) = self.build_state();
        let is_ready = build == "ready";
        let progress = self.tiles().progress();
        let seconds = self.timing().drawn_for(now).as_secs_f64();
        let is_complete = self.is_complete();
        let is_drawing = !is_complete && self.picture.fault.is_none() && is_ready;
        let is_opening = is_ready && self.opened.is_none() && self.picture.fault.is_none();
        let left = seconds * (1.0 - progress) / progress;
        PageState {
            shown: &self.shown,
            subject: &self.subject.name,
            about: &self.subject.data.scene.about,
            question: self.subject.question.as_ref(),
            own_film: self.subject.camera().pinhole.film,
            camera: CameraState {
                position: camera.placement.position,
                axes: camera.placement.axes.to_cols_array_2d(),
                half_height: tan(0.5 * camera.pinhole.vertical_fov.to_radians()),
                aspect_ratio: camera.pinhole.aspect_ratio,
                is_own: self.viewpoint == self.subject.viewpoint,
            },
            build,
            is_opening,
            slow_build: self.note_on_slow_build().filter(|_| is_opening),
            traversal: self.line_of(SubmissionPart::Traversal),
            has_stopped: is_ready && self.picture.fault.is_some(),
            errors,
            notes: self.notes(),
            complete_samples: self.complete_samples(),
            progress,
            is_complete,
            tests: self.tests_summary(),
            rays_per_second: self.timing().rays_per_second(),
            seconds,
            seconds_left: (is_drawing && left.is_finite()).then_some(left),
            programs: self.programs(),
            has_tree: self
                .tree
                .as_ref()
                .is_some_and(|tree| tree.index.has_nodes()),
            tree_levels: self.tree.as_ref().map_or(0, |tree| tree.index.levels()),
            tree_number: format!("{}.{}", self.numbers.program, self.numbers.scene),
            pinned: self.pinned.map(|target| PinnedState {
                target,
                is_here: target.aim == self.aim(),
            }),
            explanation: self.explanation.as_ref().map(|_| self.explanation_number),
            explanation_fault: self.explanation_problem(),
        }
    }

    fn build_state(&self) -> (&'static str, Vec<FileError>) {
        match &self.drawing {
            BuildState::Compiling => ("compiling", Vec::new()),
            BuildState::Ready(_) => ("ready", Vec::new()),
            BuildState::Failed(errors) => ("failed", errors.clone()),
            BuildState::Broken(why) => (
                "failed",
                vec![FileError {
                    file: String::new(),
                    line: None,
                    text: why.clone(),
                }],
            ),
        }
    }

    /// Returns the reason the pinned pixel isn't explained.
    fn explanation_problem(&self) -> Option<String> {
        self.pinned?;
        if let (BuildState::Failed(_) | BuildState::Broken(_), None) =
            (&self.drawing, &self.explanation)
        {
            return Some("The pixel will be explained as soon as your files compile.".to_owned());
        }
        if let (Some(_), None) = (&self.picture.fault, &self.opened) {
            return Some(
                "The pixel will be explained as soon as the scene can be opened.".to_owned(),
            );
        }
        match &self.recording {
            Some(BuildState::Failed(errors)) => Some(recording_failed(errors)),
            Some(BuildState::Broken(why)) => Some(why.clone()),
            Some(BuildState::Compiling | BuildState::Ready(_)) | None => {
                self.explanation_fault.clone()
            }
        }
    }
}
