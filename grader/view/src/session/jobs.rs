//! The builds of the submission's programs and the work for these programs.

use std::sync::Arc;
use std::time::{Duration, Instant};

use view_probe::messages::{Draw, MAX_SAMPLES, Quantity};
use view_probe::scene_data::Aim;

use super::{Key, PinnedTarget, Session};
use crate::program::{BuildState, Files, Program};
use crate::subject::Subject;

/// The time after which a program returns the pixels it has drawn.
const SLICE_MS: u32 = 30;
/// The CPU time limit for a few rays: a fixed amount, and an additional amount for each shape that
/// the rays may be tested against. If a method hangs, this is noticed and reported within three
/// seconds.
const CALL_LIMIT: [Duration; 2] = [Duration::from_secs(1), Duration::from_micros(5)];
/// The CPU time limit for building the tree: a fixed amount, and an additional amount for each
/// shape in the tree.
const OPEN_LIMIT: [Duration; 2] = [Duration::from_secs(3), Duration::from_micros(60)];
/// The maximum memory for all programs together, in bytes. The number of programs is chosen
/// accordingly.
const MAX_MEMORY: u64 = 3 << 30;
/// The minimum and maximum memory limits for a program, in bytes. The maximum is enough for several
/// million triangles. Within these bounds, each program gets an equal share of the available
/// memory.
const PROGRAM: [u64; 2] = [1 << 30, 4 << 30];
/// An estimate of the memory that a program needs per shape while building the tree.
const BYTES_PER_SHAPE: u64 = 700;

/// A thread that runs one of the programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Worker {
    /// Runs the program that draws. The number is the worker's index among the drawing workers.
    Drawing(usize),
    /// Runs the program that records.
    Recording,
}

/// A job, with the program, the scene and the camera that it needs.
#[derive(Clone, Debug)]
pub struct ScheduledJob {
    /// The key.
    pub key: Key,
    /// The program.
    pub program: Program,
    /// The scene.
    pub subject: Arc<Subject>,
    /// The camera.
    pub aim: Aim,
    /// The CPU time limit for building the tree.
    pub open_limit: Duration,
    /// The CPU time limit for a few rays.
    pub call_limit: Duration,
    /// The program's memory limit, in bytes.
    pub memory: u64,
    /// The number of samples of an explained pixel to list.
    pub listed_samples: u32,
    /// The job.
    pub job: Job,
}

/// A job for a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Job {
    /// Draw some pixels of a tile.
    Draw {
        /// The tile.
        tile: usize,
        /// The request.
        draw: Draw,
        /// The CPU time limit.
        limit: Duration,
    },
    /// Return the tree.
    Tree,
    /// Explain a pixel. Needs the program that records.
    Explain(PinnedTarget),
}

/// The builds.
impl Session {
    /// Records that the files have been saved and are being compiled.
    pub fn compiling(&mut self, files: Files) {
        self.version_of_files += 1;
        self.files = Some(Arc::new(files));
        self.drawing = BuildState::Compiling;
        self.shown.is_picture_complete = false;
        self.recording = None;
        self.shown.is_stale = self.shown.picture > 0;
        self.shown.version += 1;
    }

    /// Records the result of a build: the errors or the program. The camera and the pinned pixel
    /// stay unchanged.
    pub fn built(&mut self, state: BuildState, now: Instant) {
        if let BuildState::Ready(_) = state {
            self.numbers.program += 1;
            self.opened = None;
            self.is_build_slow = false;
            self.forget_tree();
            // Explain the same pixel again with the new program.
            self.set_explanation(None);
            self.keep_averages();
            self.draw_again(now);
        }
        self.drawing = state;
        self.shown.version += 1;
    }

    /// Returns the files and their version if a recording program is needed for them.
    pub fn wanted_recording(&self) -> Option<(u64, Arc<Files>)> {
        let is_ready = matches!(self.drawing, BuildState::Ready(_));
        let is_wanted = is_ready && self.is_recording_wanted && self.recording.is_none();
        let files = self.files.as_ref().filter(|_| is_wanted)?;
        Some((self.version_of_files, Arc::clone(files)))
    }

    /// Records the result of building the recording program from this version of the files.
    pub fn built_recording(&mut self, state: BuildState, version_of_files: u64) {
        if version_of_files == self.version_of_files {
            self.recording = Some(state);
            self.is_explanation_busy = false;
            if self.pinned.is_some() {
                self.explanation_number += 1;
            }
            self.shown.version += 1;
        }
    }
}

/// The work.
impl Session {
    /// Returns whether a result with this key is still wanted from a program. No result is wanted
    /// while the files are being compiled again, because a hanging program must not compete with
    /// the compiler.
    pub fn is_wanted(&self, key: Key) -> bool {
        matches!(self.drawing, BuildState::Ready(_)) && key.has_tree_of(&self.numbers)
    }

    /// Returns work for a program, if any.
    pub fn next_job(&mut self, worker: Worker, now: Instant) -> Option<ScheduledJob> {
        let state = match worker {
            Worker::Drawing(_) => Some(&self.drawing),
            Worker::Recording => self.recording.as_ref(),
        };
        let Some(BuildState::Ready(program)) = state.cloned() else {
            return None;
        };
        let is_recording = worker == Worker::Recording;
        if is_recording && let Some(pinned) = self.next_explanation() {
            let work = self.scheduled_job(program, Job::Explain(pinned));
            let aim = pinned.aim;
            return Some(ScheduledJob { aim, ..work });
        }
        let is_superfluous = matches!(worker, Worker::Drawing(index) if index >= self.programs());
        if self.picture.fault.is_some() || !self.is_watched(now) || is_superfluous {
            return None;
        }
        let layer = self.shown.view.layer();
        // Every tree is checked, but usually not before a coarse picture can be seen.
        let is_tree_wanted = self.is_tree_wanted || self.tiles().has_coarse_picture();
        let job = if !is_recording && is_tree_wanted && self.tree.is_none() && !self.is_tree_busy {
            self.is_tree_busy = true;
            Job::Tree
        } else if is_recording == (layer == Quantity::Tests) {
            let is_careful = self.picture.is_careful;
            let milliseconds = if is_careful { 0 } else { SLICE_MS };
            let (tile, draw) = self.picture.tiles_mut(layer).take(layer, milliseconds)?;
            let limit = self.limit(CALL_LIMIT);
            let limit = if is_careful { limit / 2 } else { limit };
            Job::Draw { tile, draw, limit }
        } else {
            return None;
        };
        self.timing_mut().start(now);
        Some(self.scheduled_job(program, job))
    }

    /// Returns the pinned pixel, unless it has already been explained or is being explained.
    fn next_explanation(&mut self) -> Option<PinnedTarget> {
        let is_open = self.explanation.is_none() && self.explanation_fault.is_none();
        let pinned = self
            .pinned
            .filter(|_| is_open && !self.is_explanation_busy)?;
        self.is_explanation_busy = true;
        Some(pinned)
    }

    fn scheduled_job(&self, program: Program, job: Job) -> ScheduledJob {
        let share = self.resources.memory / (self.programs() as u64 + 1);
        ScheduledJob {
            key: self.numbers,
            program,
            subject: Arc::clone(&self.subject),
            aim: self.aim(),
            memory: share.clamp(PROGRAM[0], PROGRAM[1]),
            open_limit: self.limit(OPEN_LIMIT).max(10 * self.last_opening),
            call_limit: self.limit(CALL_LIMIT),
            listed_samples: self.shown.samples.min(MAX_SAMPLES as u32),
            job,
        }
    }

    /// Returns the time limit for the scene: a fixed amount, and an additional amount for each
    /// shape.
    fn limit(&self, [fixed, per_shape]: [Duration; 2]) -> Duration {
        let shapes = u32::try_from(self.subject.data.scene.shapes.len()).unwrap_or(u32::MAX);
        fixed + shapes * per_shape
    }

    /// Returns the number of programs that draw at the same time: one per core, or fewer if the
    /// tree is large, since each of them builds its own tree, as does the recording program.
    pub fn programs(&self) -> usize {
        let shapes = self.subject.data.scene.shapes.len() as u64;
        let fit = self.resources.memory.min(MAX_MEMORY) / (shapes * BYTES_PER_SHAPE).max(1);
        usize::try_from(fit.saturating_sub(1))
            .unwrap_or(usize::MAX)
            .clamp(1, self.resources.cores)
    }
}
