//! Records the keys that only the reference can provide. The reference runs in a probe and answers
//! over a pipe, like any submission.

use std::io;
use std::time::Duration;

use glam::Vec3;
use grader::files::{self, PathError};
use grader::probe::{Fault, ItemLimits};
use protocol::{Answer, ElementOutcome, Question};

use crate::solutions::sources::Sources;
use crate::solutions::workbench::{BuiltSolution, Workbench, WorkbenchError};

/// The path of the radiance item's scene, relative to the workspace root.
const SCENE: &str = "scenes/cornell-box.json";

/// The time limit for rendering a picture.
const LIMITS: ItemLimits = ItemLimits::from_cpu(Duration::from_secs(60));

/// The reason why the reference's picture could not be recorded.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    /// The scene or the reference could not be read.
    #[error(transparent)]
    File(#[from] PathError),
    /// The reference could not be built.
    #[error("cannot build the reference: {0}")]
    Build(#[from] WorkbenchError),
    /// The probe could not be started.
    #[error("cannot start the reference's probe: {0}")]
    Start(#[from] io::Error),
    /// The probe did not answer.
    #[error("the reference did not answer: {0:?}")]
    Fault(Fault),
    /// The answer is not a picture.
    #[error("the reference did not render the picture: {0}")]
    UnexpectedAnswer(String),
}

/// The reference, ready to render pictures of the Cornell box.
#[derive(Debug)]
pub struct Recorder {
    scene: String,
    sources: Sources,
    reference: BuiltSolution,
}

impl Recorder {
    /// Reads the scene and the reference's files, and builds the reference.
    pub fn open(workbench: &Workbench) -> Result<Self, RecordingError> {
        let scene = files::read_to_string(workbench.root().join(SCENE))?;
        let sources = Sources::reference(workbench.root(), workbench.handed_out())?;
        let reference = workbench.build(&sources, "reference")?;
        Ok(Recorder {
            scene,
            sources,
            reference,
        })
    }

    /// Returns the reference's files.
    pub fn reference(&self) -> &Sources {
        &self.sources
    }

    /// Returns the text of the Cornell box's scene file.
    pub fn scene(&self) -> &str {
        &self.scene
    }

    /// Returns the reference's answer to a question about a picture: linear red, green and blue of
    /// each pixel, row by row from the bottom.
    pub fn record(&self, question: &Question) -> Result<Vec<Vec3>, RecordingError> {
        let mut probe = self.reference.launcher().start(LIMITS.cpu)?;
        let answers = probe
            .ask([question], LIMITS)
            .map_err(RecordingError::Fault)?;
        match answers.into_iter().next() {
            Some(Answer::Picture(ElementOutcome::Value(pixels))) => Ok(pixels),
            Some(Answer::Picture(ElementOutcome::Panicked(panic))) => {
                Err(RecordingError::UnexpectedAnswer(panic.message))
            }
            other => Err(RecordingError::UnexpectedAnswer(format!("{other:?}"))),
        }
    }
}
