//! The state of the viewer: the scene, the camera, the picture so far, and the work that is to be
//! done. It starts no threads and reads no files or clocks.

mod builds;
mod commands;
mod jobs;
mod notes;
mod picture;
mod results;
mod timing;
mod view;
mod view_state;

use std::sync::Arc;
use std::time::{Duration, Instant};

use framework::scene::Camera;
use glam::{UVec2, Vec3};
use grader::submission::Submission;
use protocol::Trace;
use view_probe::messages::{Aim, Opened, TestCounts};

use crate::model::explanation::Explanation;
use crate::model::layer::Layer;
use crate::model::tree::TreeModel;
use crate::model::viewpoint::Viewpoint;
use crate::subject::{PathSettings, Subject, aim};

pub use builds::BuildState;
pub use commands::Command;
pub use jobs::{DrawJob, Key, RecordingJob, Work};
pub use notes::{Note, PanicNote};
use timing::Timing;
pub use view::View;

/// The time after the last request of a page until drawing pauses.
const WATCHED_FOR: Duration = Duration::from_secs(40);

/// The cores and the memory that the programs may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Resources {
    /// The number of programs that draw at the same time.
    pub cores: usize,
    /// The memory of all programs together, in bytes.
    pub memory: u64,
}

/// The pixel or ray that is explained. It stays the same when the camera moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pinned {
    /// The camera at the time of the click.
    pub aim: Aim,
    /// The pixel, or `None` for the exam's ray.
    pub pixel: Option<UVec2>,
    /// The number of the path, or `None` for the ray through the centre of the pixel.
    pub sample: Option<u32>,
}

/// The state of the viewer.
#[derive(Debug)]
pub struct Session {
    /// Changes with everything that the page shows.
    pub version: u64,
    /// Whether the picture has changed since it was last composed.
    pub is_dirty: bool,
    settings: PathSettings,
    scenes: Vec<String>,
    pub(crate) subject: Arc<Subject>,
    /// The scene that is being loaded.
    loading: Option<String>,
    /// The reason why the last scene was not loaded.
    loading_error: Option<String>,
    pub(crate) view: View,
    pub(crate) exposure: f32,
    film: UVec2,
    samples: u32,
    viewpoint: Viewpoint,
    drawing: BuildState,
    recording: Option<BuildState>,
    is_recording_wanted: bool,
    numbers: Key,
    /// Counts the versions of the submission that were compiled.
    version_of_files: u64,
    /// The submission's files, as they were last compiled.
    submission: Option<Arc<Submission>>,
    opened: Option<Opened>,
    /// The time that opening the scene last took.
    last_opening: Duration,
    /// The reason why drawing has stopped.
    fault: Option<String>,
    /// The number of pixels that have ended the program.
    faults: u32,
    /// Whether each request draws a single pixel, to find the one that ends the program.
    is_careful: bool,
    panics: Vec<PanicNote>,
    invalid_paths: u64,
    pub(crate) light: Layer<Vec3>,
    pub(crate) hits: Layer<Option<Trace>>,
    pub(crate) tests: Layer<TestCounts>,
    pub(crate) tree: Option<Arc<TreeModel>>,
    is_tree_wanted: bool,
    is_tree_busy: bool,
    /// The reason why the tree could not be read.
    tree_fault: Option<String>,
    pinned: Option<Pinned>,
    pub(crate) explanation: Option<Arc<Explanation>>,
    /// Changes with the explanation.
    explanation_number: u64,
    is_explanation_busy: bool,
    explanation_fault: Option<String>,
    /// The times of drawing the three layers.
    timings: [Timing; 3],
    started_at: Instant,
    watched_at: Instant,
    cores: usize,
    memory: u64,
    /// The number of the picture that is on the page.
    pub picture_number: u64,
    /// Whether the picture on the page is of an earlier version of the code.
    is_stale: bool,
    /// Whether the picture on the page has all samples of the present camera and program.
    is_picture_complete: bool,
}

impl Session {
    /// Creates the state for a subject. `scenes` are the names that the page may choose.
    pub fn new(
        subject: Subject,
        scenes: Vec<String>,
        settings: PathSettings,
        film: Option<UVec2>,
        samples: u32,
        resources: Resources,
        now: Instant,
    ) -> Self {
        let film = film.unwrap_or(subject.camera.pinhole.film);
        let mut session = Session {
            version: 1,
            is_dirty: false,
            settings,
            scenes,
            view: View::Shaded,
            exposure: 0.0,
            film,
            samples,
            viewpoint: subject.viewpoint,
            subject: Arc::new(subject),
            loading: None,
            loading_error: None,
            drawing: BuildState::Compiling,
            recording: None,
            is_recording_wanted: false,
            numbers: Key::default(),
            version_of_files: 0,
            submission: None,
            opened: None,
            last_opening: Duration::ZERO,
            fault: None,
            faults: 0,
            is_careful: false,
            panics: Vec::new(),
            invalid_paths: 0,
            light: Layer::new(film, samples),
            hits: Layer::new(film, 1),
            tests: Layer::new(film, 1),
            tree: None,
            is_tree_wanted: false,
            is_tree_busy: false,
            tree_fault: None,
            pinned: None,
            explanation: None,
            explanation_number: 0,
            is_explanation_busy: false,
            explanation_fault: None,
            timings: Default::default(),
            started_at: now,
            watched_at: now,
            cores: resources.cores,
            memory: resources.memory,
            picture_number: 0,
            is_stale: false,
            is_picture_complete: false,
        };
        session.show_subject(now);
        session
    }

    /// Replaces the scene.
    pub fn open(&mut self, subject: Subject, now: Instant) {
        self.loading = None;
        self.loading_error = None;
        self.film = subject.camera.pinhole.film;
        self.viewpoint = subject.viewpoint;
        self.subject = Arc::new(subject);
        self.numbers.scene += 1;
        self.pinned = None;
        self.set_explanation(None);
        self.forget_tree();
        self.show_subject(now);
    }

    /// Reports that the scene that is being loaded is invalid.
    pub fn opening_failed(&mut self, why: String) {
        self.loading = None;
        self.loading_error = Some(why);
        self.version += 1;
    }

    /// Starts with a new subject. The exam's ray is explained at once.
    fn show_subject(&mut self, now: Instant) {
        if let Some(question) = &self.subject.question {
            self.is_tree_wanted = true;
            self.view = View::Normals;
            if question.ray.is_some() {
                self.pinned = Some(Pinned {
                    aim: self.aim(),
                    pixel: None,
                    sample: None,
                });
                self.is_recording_wanted = true;
            }
        }
        self.restart(now);
    }

    /// Returns the camera as it is now.
    pub fn camera(&self) -> Camera {
        // Takes the aspect ratio of the film like `Scene::on_film`.
        let own = self.subject.camera;
        let mut camera = own;
        camera.pinhole.film = self.film;
        if !own.fixed_aspect {
            camera.pinhole.aspect_ratio = self.film.x as f32 / self.film.y as f32;
        }
        camera.placement = self.viewpoint.placement;
        camera
    }

    pub(crate) fn aim(&self) -> Aim {
        aim(&self.camera(), self.settings)
    }

    /// Starts the picture again: with another camera, program or scene.
    fn restart(&mut self, now: Instant) {
        self.numbers.aim += 1;
        self.is_picture_complete = false;
        self.light = Layer::new(self.film, self.samples);
        self.hits = Layer::new(self.film, 1);
        self.tests = Layer::new(self.film, 1);
        self.fault = None;
        self.faults = 0;
        self.is_careful = false;
        self.panics.clear();
        self.invalid_paths = 0;
        self.started_at = now;
        self.timings = Default::default();
        self.version += 1;
    }

    /// Reports that a page is open.
    pub fn watch(&mut self, now: Instant) {
        if !self.is_watched(now) {
            let paused_at = self.watched_at + WATCHED_FOR;
            self.timing_mut().stop(paused_at);
        }
        self.watched_at = now;
    }

    /// Returns whether a page is open.
    fn is_watched(&self, now: Instant) -> bool {
        now.saturating_duration_since(self.watched_at) < WATCHED_FOR
    }

    fn timing(&self) -> &Timing {
        &self.timings[self.view.layer()]
    }

    fn timing_mut(&mut self) -> &mut Timing {
        &mut self.timings[self.view.layer()]
    }

    fn forget_tree(&mut self) {
        self.tree = None;
        self.tree_fault = None;
        self.is_tree_busy = false;
    }

    fn set_explanation(&mut self, explanation: Option<Explanation>) {
        self.explanation = explanation.map(Arc::new);
        self.explanation_number += 1;
        self.is_explanation_busy = false;
        self.explanation_fault = None;
        self.version += 1;
    }
}
