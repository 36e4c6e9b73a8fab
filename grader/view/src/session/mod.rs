//! The state of the viewer: the scene, the camera, the picture so far and the work to do. It starts
//! no threads and reads no files or clocks.

mod commands;
mod jobs;
mod notes;
mod page_state;
mod picture;
mod results;
mod state;
mod tests_summary;
mod timing;
mod values;

use std::sync::Arc;
use std::time::{Duration, Instant};

use framework::render::renderer::PathSettings;
use framework::scene::Camera;
use glam::UVec2;
use view_probe::messages::{OpenOutcome, TreeSize};
use view_probe::scene_data::Aim;

use crate::model::explanation::Explanation;
use crate::model::tiles::Tiles;
use crate::model::tree::TreeModel;
use crate::model::viewpoint::Viewpoint;
use crate::program::{BuildState, Files};
use crate::subject::Subject;

pub use commands::Command;
pub use jobs::{Job, ScheduledJob, Worker};
pub use notes::{Note, PanicNote};
pub use page_state::PageState;
use picture::PictureSoFar;
pub use state::{Key, PageFields, PinnedTarget, Resources, View};
use tests_summary::TestAverages;
use timing::Timing;

/// The time from a page's last request until drawing pauses.
const WATCHED_FOR: Duration = Duration::from_secs(40);

/// The state of the viewer.
#[derive(Debug)]
pub struct Session {
    pub(crate) shown: PageFields,
    /// Whether the picture has changed since it was last composed.
    pub is_dirty: bool,
    settings: PathSettings,
    pub(crate) subject: Arc<Subject>,
    /// The reason the last scene was not loaded.
    loading_error: Option<String>,
    viewpoint: Viewpoint,
    drawing: BuildState,
    recording: Option<BuildState>,
    is_recording_wanted: bool,
    numbers: Key,
    /// Counts the compiled versions of the submission.
    version_of_files: u64,
    /// The files, as last compiled.
    files: Option<Arc<Files>>,
    opened: Option<OpenOutcome>,
    /// How long the scene took to open last time.
    last_opening: Duration,
    /// Whether building the tree takes a long time.
    is_build_slow: bool,
    pub(crate) picture: PictureSoFar,
    /// The averages for an earlier version of the code, using the same camera.
    averages_before: Option<TestAverages>,
    pub(crate) tree: Option<Arc<TreeModel>>,
    is_tree_wanted: bool,
    is_tree_busy: bool,
    /// The reason the tree could not be read.
    tree_fault: Option<String>,
    pinned: Option<PinnedTarget>,
    pub(crate) explanation: Option<Arc<Explanation>>,
    /// Changes with the explanation.
    explanation_number: u64,
    is_explanation_busy: bool,
    explanation_fault: Option<String>,
    watched_at: Instant,
    resources: Resources,
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
        let film = film.unwrap_or(subject.camera().pinhole.film);
        let shown = PageFields {
            version: 1,
            scenes,
            film,
            samples,
            ..PageFields::default()
        };
        let mut session = Session {
            shown,
            is_dirty: false,
            settings,
            viewpoint: subject.viewpoint,
            subject: Arc::new(subject),
            loading_error: None,
            drawing: BuildState::Compiling,
            recording: None,
            is_recording_wanted: false,
            numbers: Key::default(),
            version_of_files: 0,
            files: None,
            opened: None,
            last_opening: Duration::ZERO,
            is_build_slow: false,
            picture: PictureSoFar::new(film, samples, now),
            averages_before: None,
            tree: None,
            is_tree_wanted: false,
            is_tree_busy: false,
            tree_fault: None,
            pinned: None,
            explanation: None,
            explanation_number: 0,
            is_explanation_busy: false,
            explanation_fault: None,
            watched_at: now,
            resources,
        };
        session.show_subject(now);
        session
    }

    /// Replaces the scene.
    pub fn open(&mut self, subject: Subject, now: Instant) {
        self.shown.loading = None;
        self.loading_error = None;
        self.shown.film = subject.camera().pinhole.film;
        self.viewpoint = subject.viewpoint;
        self.subject = Arc::new(subject);
        self.numbers.scene += 1;
        self.opened = None;
        self.is_build_slow = false;
        self.pinned = None;
        self.set_explanation(None);
        self.forget_tree();
        self.show_subject(now);
    }

    /// Reports that the scene being loaded is invalid.
    pub fn opening_failed(&mut self, why: String) {
        self.shown.loading = None;
        self.loading_error = Some(why);
        self.shown.version += 1;
    }

    /// Starts showing a new subject. If it is a question about a ray, the ray is explained
    /// immediately.
    fn show_subject(&mut self, now: Instant) {
        if let Some(question) = &self.subject.question {
            self.is_tree_wanted = true;
            self.shown.view = View::Normals;
            if question.ray.is_some() {
                self.pinned = Some(PinnedTarget {
                    aim: self.aim(),
                    pixel: None,
                    sample: None,
                });
                self.is_recording_wanted = true;
            }
        }
        self.restart(now);
    }

    /// Returns the current camera.
    pub fn camera(&self) -> Camera {
        // Use the film's aspect ratio, like `Scene::on_film`.
        let own = *self.subject.camera();
        let film = self.shown.film;
        let mut camera = own;
        camera.pinhole.film = film;
        if !own.fixed_aspect {
            camera.pinhole.aspect_ratio = film.x as f32 / film.y as f32;
        }
        camera.placement = self.viewpoint.placement;
        camera
    }

    fn aim(&self) -> Aim {
        Aim {
            camera: self.camera(),
            settings: self.settings,
        }
    }

    /// Returns the key for new work.
    pub fn key(&self) -> Key {
        self.numbers
    }

    /// Starts the picture again after the camera or the scene has changed.
    fn restart(&mut self, now: Instant) {
        self.averages_before = None;
        self.draw_again(now);
    }

    /// Starts the picture again after the camera, the program or the scene has changed.
    fn draw_again(&mut self, now: Instant) {
        self.numbers.aim += 1;
        self.shown.is_picture_complete = false;
        self.picture = PictureSoFar::new(self.shown.film, self.shown.samples, now);
        self.shown.panics.clear();
        self.shown.version += 1;
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
        self.picture.timing(self.shown.view.layer())
    }

    fn timing_mut(&mut self) -> &mut Timing {
        self.picture.timing_mut(self.shown.view.layer())
    }

    /// Returns the progress of the displayed layer.
    fn tiles(&self) -> &Tiles {
        self.picture.tiles(self.shown.view.layer())
    }

    /// Returns the number of samples that every pixel in the displayed layer has.
    fn complete_samples(&self) -> u32 {
        self.tiles().complete_samples().min(self.shown.samples)
    }

    /// Returns whether everything the picture needs besides its pixels is available.
    fn has_colours(&self) -> bool {
        self.shown.view != View::Bvh || self.tree.is_some()
    }

    /// Returns whether part of the new picture can be shown. Until then, the old one stays.
    pub fn has_picture(&self) -> bool {
        self.tiles().has_coarse_picture() && self.has_colours()
    }

    /// Returns whether the picture is complete.
    pub fn is_complete(&self) -> bool {
        self.tiles().is_complete() && self.has_colours()
    }

    /// Returns the time since the picture was started.
    pub fn age(&self, now: Instant) -> Duration {
        now.saturating_duration_since(self.picture.started_at)
    }

    /// Reports that the page shows a new picture. `is_complete` says whether it contains all
    /// samples.
    pub fn show_picture(&mut self, key: Key, is_complete: bool) {
        self.shown.picture += 1;
        self.shown.is_picture_complete = is_complete && key == self.numbers && !self.is_dirty;
        // While there is no program, the picture is composed from old pixels.
        self.shown.is_stale &= !matches!(self.drawing, BuildState::Ready(_));
        self.shown.version += 1;
    }

    /// Returns the size of the tree, if it has been built.
    fn tree_size(&self) -> Option<TreeSize> {
        self.opened.as_ref()?.tree.value().copied()
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
        self.shown.version += 1;
    }
}
