//! The submission's programs, and the errors of the compiler.

use std::sync::Arc;
use std::time::Instant;

use grader::submission::Submission;

use super::Session;
use crate::program::{FileError, Program};

/// A program, or the reason why there is none.
#[derive(Clone, Debug, Default)]
pub enum BuildState {
    /// The compiler is at work.
    #[default]
    Compiling,
    /// The program is ready.
    Ready(Program),
    /// The submission does not compile.
    Failed(Vec<FileError>),
    /// The compiler could not be run.
    Broken(String),
}

impl Session {
    /// Reports that the files have been saved, and are being compiled.
    pub fn compiling(&mut self, submission: Submission) {
        self.version_of_files += 1;
        self.submission = Some(Arc::new(submission));
        self.drawing = BuildState::Compiling;
        self.is_picture_complete = false;
        self.recording = None;
        self.is_stale = self.picture_number > 0;
        self.version += 1;
    }

    /// Reports errors, or the program. The camera and the pixel stay.
    pub fn built(&mut self, state: BuildState, now: Instant) {
        if let BuildState::Ready(_) = state {
            self.numbers.program += 1;
            self.opened = None;
            self.forget_tree();
            // The same pixel is explained again, with the new program.
            self.set_explanation(None);
            self.restart(now);
        }
        self.drawing = state;
        self.version += 1;
    }

    /// Returns the files and their version, if a program that records is wanted for them.
    pub fn wanted_recording(&self) -> Option<(u64, Arc<Submission>)> {
        let is_ready = matches!(self.drawing, BuildState::Ready(_));
        let is_wanted = is_ready && self.is_recording_wanted && self.recording.is_none();
        let submission = self.submission.as_ref().filter(|_| is_wanted)?;
        Some((self.version_of_files, Arc::clone(submission)))
    }

    /// Reports the program that records, which was built from this version of the files.
    pub fn built_recording(&mut self, state: BuildState, version_of_files: u64) {
        if version_of_files == self.version_of_files {
            self.recording = Some(state);
            self.is_explanation_busy = false;
            if self.pinned.is_some() {
                self.explanation_number += 1;
            }
            self.version += 1;
        }
    }
}
