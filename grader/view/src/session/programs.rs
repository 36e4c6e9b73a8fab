//! The work that is to be done by the programs, and its results.

use std::sync::Arc;
use std::time::{Duration, Instant};

use view_probe::messages::{Aim, Draw, Quantity};

use super::{BuildState, Pinned, Session, View};
use crate::program::Program;
use crate::subject::Subject;

/// The time after which a program returns the pixels that it has drawn.
const SLICE_MS: u32 = 30;
/// The limit of CPU time for some pixels, and for one.
const DRAW_LIMITS: [Duration; 2] = [Duration::from_secs(5), Duration::from_secs(2)];
/// The limit of CPU time for opening a scene, and for each shape in it.
const OPEN_LIMIT: [Duration; 2] = [Duration::from_secs(10), Duration::from_micros(60)];
/// The maximum memory of all programs together, in bytes.
const MAX_MEMORY: u64 = 3 << 30;
/// The least and the most memory that a program may use, in bytes: the most is enough for some
/// millions of triangles. In between, all programs share the available memory.
const PROGRAM: [u64; 2] = [1 << 30, 4 << 30];
/// An estimate of the memory that a program needs for each shape, while it builds the tree.
const BYTES_PER_SHAPE: u64 = 700;

/// Identifies what a job belongs to. A result with an old key is dropped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Key {
    /// Changes with the program.
    pub program: u64,
    /// Changes with the scene.
    pub scene: u64,
    /// Changes with the camera.
    pub aim: u64,
}

/// A program, and the scene and camera that a job needs.
#[derive(Clone, Debug)]
pub struct Work<J> {
    /// The key.
    pub key: Key,
    /// The program.
    pub program: Program,
    /// The scene.
    pub subject: Arc<Subject>,
    /// The camera.
    pub aim: Aim,
    /// The limit of CPU time for opening the scene.
    pub open_limit: Duration,
    /// The limit of the program's memory, in bytes.
    pub memory: u64,
    /// The job.
    pub job: J,
}

/// A job of a program that draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawJob {
    /// Draw some pixels of a tile.
    Draw {
        /// The tile.
        tile: usize,
        /// The request.
        draw: Draw,
        /// The limit of CPU time.
        limit: Duration,
    },
    /// Return the tree.
    Tree,
}

/// A job of the program that records.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RecordingJob {
    /// Count the tests of some pixels.
    Draw {
        /// The tile.
        tile: usize,
        /// The request.
        draw: Draw,
        /// The limit of CPU time.
        limit: Duration,
    },
    /// Explain a pixel.
    Explain(Pinned),
}

impl Session {
    /// Returns the key of new work.
    pub fn key(&self) -> Key {
        self.numbers
    }

    /// Returns whether a result with this key is still wanted from a program. As soon as the files
    /// are compiled again, it is not: a program that hangs must not compete with the compiler.
    pub fn is_wanted(&self, key: Key) -> bool {
        let is_ready = matches!(self.drawing, BuildState::Ready(_));
        is_ready && (key.program, key.scene) == (self.numbers.program, self.numbers.scene)
    }

    /// Returns work for the drawing program with this index, if there is some.
    pub fn next_drawing(&mut self, worker: usize, now: Instant) -> Option<Work<DrawJob>> {
        let BuildState::Ready(program) = self.drawing.clone() else {
            return None;
        };
        let is_idle = self.fault.is_some() || !self.is_watched(now);
        if is_idle || worker >= self.programs() {
            return None;
        }
        let job = if self.is_tree_wanted && self.tree.is_none() && !self.is_tree_busy {
            self.is_tree_busy = true;
            DrawJob::Tree
        } else {
            let milliseconds = if self.is_careful { 0 } else { SLICE_MS };
            let taken = match self.view {
                View::Shaded => self
                    .light
                    .take(|sample| Quantity::Light { sample }, milliseconds),
                View::Clay | View::Normals | View::Depth | View::Uv | View::Bvh => {
                    self.hits.take(|_| Quantity::Hit, milliseconds)
                }
                View::Tests => None,
            };
            let (tile, draw) = taken?;
            let limit = DRAW_LIMITS[usize::from(self.is_careful)];
            DrawJob::Draw { tile, draw, limit }
        };
        self.timing_mut().start(now);
        Some(self.work(program, job))
    }

    /// Returns work for the program that records, if there is some.
    pub fn next_recording(&mut self, now: Instant) -> Option<Work<RecordingJob>> {
        let Some(BuildState::Ready(program)) = self.recording.clone() else {
            return None;
        };
        let is_unexplained = self.explanation.is_none() && self.explanation_fault.is_none();
        if let Some(pinned) = self.pinned
            && is_unexplained
            && !self.is_explanation_busy
        {
            self.is_explanation_busy = true;
            return Some(Work {
                aim: pinned.aim,
                ..self.work(program, RecordingJob::Explain(pinned))
            });
        }
        if self.view != View::Tests || self.fault.is_some() || !self.is_watched(now) {
            return None;
        }
        let milliseconds = if self.is_careful { 0 } else { SLICE_MS };
        let (tile, draw) = self.tests.take(|_| Quantity::Tests, milliseconds)?;
        self.timing_mut().start(now);
        let limit = DRAW_LIMITS[usize::from(self.is_careful)];
        Some(self.work(program, RecordingJob::Draw { tile, draw, limit }))
    }

    fn work<J>(&self, program: Program, job: J) -> Work<J> {
        let shapes = u32::try_from(self.subject.data.shapes.len()).unwrap_or(u32::MAX);
        let [fixed, per_shape] = OPEN_LIMIT;
        Work {
            key: self.numbers,
            program,
            subject: Arc::clone(&self.subject),
            aim: self.aim(),
            memory: (self.memory / (self.programs() as u64 + 1)).clamp(PROGRAM[0], PROGRAM[1]),
            open_limit: (fixed + shapes * per_shape).max(10 * self.last_opening),
            job,
        }
    }

    /// Returns the number of programs that draw at the same time: one per core, or fewer if the tree
    /// is large, since each has a tree of its own, and so has the program that records.
    pub fn programs(&self) -> usize {
        let shapes = self.subject.data.shapes.len() as u64;
        let fit = self.memory.min(MAX_MEMORY) / (shapes * BYTES_PER_SHAPE).max(1);
        usize::try_from(fit.saturating_sub(1))
            .unwrap_or(usize::MAX)
            .clamp(1, self.cores)
    }
}
